//! The manner in which a command speaks: how much, in which colours, as text or as JSON.

use std::io::IsTerminal;

/// How much is said, and whether in colour; decided once, at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Manner {
    /// Whether anything but errors is said.
    pub quiet: bool,
    /// 0: the result in a few lines; more: every check, the stages' times and the solver's steps.
    pub verbose: u8,
    /// Whether the standard error is a terminal.
    pub is_terminal: bool,
    /// Whether colours may be used on the standard error.
    pub is_coloured: bool,
    /// Whether colours may be used on the standard output.
    pub is_output_coloured: bool,
}

impl Manner {
    /// The manner for this process: bars on a terminal only; no colours where `NO_COLOR` is set to
    /// anything (no-color.org), where the terminal is dumb, or where what is written does not go to
    /// one.
    pub fn of_process(quiet: bool, verbose: u8) -> Self {
        let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let is_terminal = std::io::stderr().is_terminal();
        let may = !is_set("NO_COLOR") && !is_dumb;
        let is_output_coloured = may && std::io::stdout().is_terminal();
        Self {
            quiet,
            verbose,
            is_terminal,
            is_coloured: may && is_terminal,
            is_output_coloured,
        }
    }

    /// Whether the progress of a run is drawn.
    pub fn shows_bars(self) -> bool {
        self.is_terminal && !self.quiet
    }
}

/// The manner, and the form of the result.
#[derive(Debug, Clone, Copy)]
pub struct Voice {
    /// How the terminal is used.
    pub manner: Manner,
    /// Whether to print JSON in place of text.
    pub json: bool,
}
