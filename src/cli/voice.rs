//! The manner in which a command prints: how much, in colour or not, as text or JSON.

use std::io::IsTerminal;

use terminal_size::{Width, terminal_size_of};

/// The amount and the colours of the text; decided once, at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Manner {
    /// True if only errors are printed.
    pub quiet: bool,
    /// 0: the result in a few lines; more: every check, the time of each phase, the solver's steps.
    pub verbose: u8,
    /// True if the standard error is a terminal.
    pub is_terminal: bool,
    /// True if a person can be asked: input and outputs are a terminal that can show questions.
    pub may_ask: bool,
    /// True if the standard error may have colours.
    pub is_coloured: bool,
    /// True if the standard output may have colours.
    pub is_output_coloured: bool,
    /// The width of the terminal that is the standard output; `None` if it is none.
    pub output_columns: Option<usize>,
}

impl Manner {
    /// Returns the manner for this process.
    ///
    /// Bars are drawn on a terminal only. There are no colours if `NO_COLOR` is set
    /// (no-color.org), if the terminal is dumb, or if the output goes elsewhere.
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
            may_ask: is_terminal
                && !is_dumb
                && std::io::stdin().is_terminal()
                && std::io::stdout().is_terminal(),
            is_coloured: may && is_terminal,
            is_output_coloured,
            output_columns: terminal_size_of(std::io::stdout())
                .map(|(Width(columns), _)| usize::from(columns)),
        }
    }

    /// Returns true if the progress of a run is drawn.
    pub fn shows_bars(self) -> bool {
        self.is_terminal && !self.quiet
    }
}

/// The manner of a command, and the form of its result.
#[derive(Debug, Clone, Copy)]
pub struct Voice {
    /// The amount and the colours of the text.
    pub manner: Manner,
    /// True if the result is printed as JSON.
    pub json: bool,
}
