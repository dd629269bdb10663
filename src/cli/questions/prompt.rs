//! The prompts of a terminal: a list to choose from, and a line to type.

use std::fmt::Display;

use inquire::validator::{ErrorMessage, Validation};
use inquire::{InquireError, Select, Text};

/// The lines of a list that are shown at once.
const SHOWN_LINES: usize = 8;

/// A reason why a question has no answer.
#[derive(Debug, thiserror::Error)]
pub enum Unanswered {
    /// The person pressed Ctrl-C or Esc.
    #[error("stopped before the answer")]
    Stopped,
    /// The terminal cannot show questions.
    #[error("cannot ask on this terminal; remedy: give the options, or use another terminal")]
    Terminal(#[source] InquireError),
}

impl From<InquireError> for Unanswered {
    fn from(error: InquireError) -> Self {
        match error {
            InquireError::OperationCanceled | InquireError::OperationInterrupted => Self::Stopped,
            error => Self::Terminal(error),
        }
    }
}

/// Asks for one of a list. Letters filter it, arrows move in it.
///
/// # Errors
/// There is no answer.
pub fn choose<T: Display>(question: &str, choices: Vec<T>, help: &str) -> Result<T, Unanswered> {
    let ask = Select::new(question, choices)
        .with_page_size(SHOWN_LINES)
        .with_help_message(help);
    Ok(ask.prompt()?)
}

/// Asks for a line that `read` can read; an empty line is the default. `read` returns the reason
/// why it cannot.
///
/// # Errors
/// There is no answer.
pub fn enter<T>(
    question: &str,
    default: &str,
    help: &str,
    read: impl Fn(&str) -> Result<T, String> + Clone,
) -> Result<T, Unanswered> {
    let reader = read.clone();
    let validate = move |line: &str| {
        Ok(match reader(line) {
            Ok(_) => Validation::Valid,
            Err(why) => Validation::Invalid(ErrorMessage::Custom(why)),
        })
    };
    let mut ask = Text::new(question)
        .with_help_message(help)
        .with_validator(validate);
    if !default.is_empty() {
        ask = ask.with_default(default);
    }
    read(&ask.prompt()?).map_err(|_| Unanswered::Stopped)
}
