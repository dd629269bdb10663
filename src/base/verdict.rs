//! An answer that may be no: a search that finds nothing has not failed.

/// The answer to "is there one?": found, or the reason why there is none.
///
/// It stands beside `Result`: an `Err` means that no answer was reached.
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub enum Verdict<T, W> {
    /// There is one.
    Found(T),
    /// There is none, and why.
    No(W),
}

impl<T, W> Verdict<T, W> {
    /// Returns what was found, `None` if the answer is no.
    pub fn found(self) -> Option<T> {
        match self {
            Self::Found(found) => Some(found),
            Self::No(_) => None,
        }
    }

    /// Returns what was found; the reason as an error if the answer is no.
    pub fn or_error<E: From<W>>(self) -> Result<T, E> {
        match self {
            Self::Found(found) => Ok(found),
            Self::No(why) => Err(why.into()),
        }
    }

    /// Applies a function to what was found.
    pub fn map<U>(self, map: impl FnOnce(T) -> U) -> Verdict<U, W> {
        match self {
            Self::Found(found) => Verdict::Found(map(found)),
            Self::No(why) => Verdict::No(why),
        }
    }
}
