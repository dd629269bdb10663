//! The arguments that `prepare` cannot do without, asked for all at once.

use std::fmt;
use std::path::{Path, PathBuf};

use super::quote::quoted;
use crate::goal::GoalKind;

/// The arguments of `prepare` that are missing; at least one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Missing {
    /// The model; `None` if it is missing.
    pub model: Option<PathBuf>,
    /// The goal; `None` if it is missing.
    pub goal: Option<GoalKind>,
    /// The printer; `None` if it is missing.
    pub printer: Option<String>,
    /// True if the size is missing too. The file's own numbers then count as mm.
    pub is_size_open: bool,
}

/// The values in the line to paste where nothing is known.
const EXAMPLE_GOAL: GoalKind = GoalKind::Stand;
const EXAMPLE_PRINTER: &str = "prusa-mk4";

impl Missing {
    /// Returns the case in which nothing is known.
    pub fn of_nothing() -> Self {
        Self {
            model: None,
            goal: None,
            printer: None,
            is_size_open: true,
        }
    }

    /// Returns true if something is missing.
    pub fn is_any(&self) -> bool {
        self.model.is_none() || self.goal.is_none() || self.printer.is_none()
    }

    /// Returns a line to paste, with examples for what is missing.
    fn line(&self) -> String {
        let model = self.model.as_deref().unwrap_or(Path::new("model.stl"));
        let goal = self.goal.unwrap_or(EXAMPLE_GOAL);
        let printer = self.printer.as_deref().unwrap_or(EXAMPLE_PRINTER);
        let size = if self.is_size_open {
            " --size 100mm"
        } else {
            ""
        };
        format!(
            "equipoise prepare {} --goal {goal} --printer {printer}{size}",
            quoted(&model.to_string_lossy())
        )
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let goals = format!("the goal (--goal {})", GoalKind::WORDS.join("|"));
        let parts = [
            (
                self.model.is_none(),
                "the model (an STL, OBJ, PLY or 3MF file)",
            ),
            (self.goal.is_none(), goals.as_str()),
            (
                self.printer.is_none(),
                "the printer (--printer ID; `equipoise printers list`, or equipoise.toml)",
            ),
        ];
        let parts = parts.into_iter().filter(|(is_missing, _)| *is_missing);
        let parts: Vec<&str> = parts.map(|(_, name)| name).collect();
        let (last, others) = parts.split_last().unwrap_or((&"nothing", &[]));
        let and = if others.is_empty() { "" } else { " and " };
        write!(
            f,
            "missing: {}{and}{last}; remedy: type {}",
            others.join(", "),
            self.line()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_is_missing_is_asked_for_at_once_with_a_line_to_paste() {
        let missing = Missing {
            model: Some("a b.stl".into()),
            goal: None,
            printer: None,
            is_size_open: true,
        };
        assert!(missing.is_any());
        let said = missing.to_string();
        for words in [
            "top|yoyo|stand|float|balance|match",
            "--printer ID",
            "printers list",
        ] {
            assert!(said.contains(words), "{said}");
        }
        let line = "type equipoise prepare 'a b.stl' --goal stand --printer prusa-mk4 --size 100mm";
        assert!(said.ends_with(line), "{said}");
    }
}
