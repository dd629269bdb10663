//! The prompts of a terminal: a list to choose from, and a line to type.

use std::fmt::{self, Display};

use inquire::{InquireError, Select, Text};

use crate::cli::show::say;

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

/// The help below a list.
const LIST_HELP: &str = "↑ ↓ and Enter, or type a few letters";

/// A line of a list.
enum Line<T> {
    /// An answer.
    Choice(T),
    /// The words that are shown if no answer has the letters that were typed.
    Otherwise(String),
}

impl<T: Display> Display for Line<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Choice(choice) => choice.fmt(f),
            Self::Otherwise(words) => f.write_str(words),
        }
    }
}

/// Asks for one of a list. Letters filter it, arrows move in it. If they leave nothing of it,
/// `otherwise` stands there; who chooses that is asked again.
///
/// # Errors
/// There is no answer.
pub fn choose<T: Display + Clone>(
    question: &str,
    choices: &[T],
    otherwise: &str,
) -> Result<T, Unanswered> {
    let answers: Vec<String> = choices.iter().map(ToString::to_string).collect();
    let score = |letters: &str, line: &Line<T>, shown: &str, index: usize| {
        let score = |words: &str| Select::<Line<T>>::DEFAULT_SCORER(letters, line, words, index);
        match line {
            Line::Choice(_) => score(shown),
            Line::Otherwise(_) => {
                let is_found = answers.iter().any(|words| score(words).is_some());
                (!is_found).then_some(0)
            }
        }
    };
    loop {
        let mut lines: Vec<Line<T>> = choices.iter().cloned().map(Line::Choice).collect();
        lines.push(Line::Otherwise(otherwise.to_owned()));
        let ask = Select::new(question, lines)
            .with_page_size(SHOWN_LINES)
            .with_scorer(&score)
            .with_help_message(LIST_HELP);
        if let Line::Choice(choice) = ask.prompt()? {
            return Ok(choice);
        }
    }
}

/// Asks for a line until `read` can read it; an empty line is the default. `read` returns the
/// reason why it cannot, which is shown before the next, empty field.
///
/// # Errors
/// There is no answer.
pub fn enter<T>(
    question: &str,
    default: &str,
    help: &str,
    read: impl Fn(&str) -> Result<T, String>,
) -> Result<T, Unanswered> {
    loop {
        let mut ask = Text::new(question).with_help_message(help);
        if !default.is_empty() {
            ask = ask.with_default(default);
        }
        match read(&ask.prompt()?) {
            Ok(answer) => return Ok(answer),
            Err(why) => say(&format!("# {why}")),
        }
    }
}
