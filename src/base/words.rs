//! Values that are read and printed as words: the macros that define them, and the error for any
//! other word.

use crate::base::toml_text::nearest_name;

/// The reason that a text is not one of the expected words, or not the expected numbers.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ChoiceError {
    /// An unknown word.
    #[error("`{text}` is not a {what}; remedy: {remedy}")]
    Unknown {
        /// The kind of word expected.
        what: &'static str,
        /// The text given.
        text: String,
        /// The nearest word, or all of them.
        remedy: String,
    },
    /// Three numbers that are not finite.
    #[error("`{0}` has a coordinate that is not finite; remedy: give three plain numbers X,Y,Z")]
    NotFinite(String),
    /// A direction of no length.
    #[error("`{0}` has no direction; remedy: give at least one coordinate that is not zero")]
    ZeroVector(String),
}

impl ChoiceError {
    /// Makes the error of a text that is none of the `known` words for a `what`; suggests the
    /// nearest word.
    pub fn unknown(what: &'static str, text: &str, known: &[&str]) -> Self {
        let remedy = match nearest_name(text, known.iter().copied()) {
            Some(word) => format!("did you mean `{word}`?"),
            None => format!("use {}", known.join(", ")),
        };
        Self::Unknown {
            what,
            text: text.to_owned(),
            remedy,
        }
    }
}

/// Parses exactly `N` numbers, finite or not, separated by commas; `None` if the text is anything
/// else.
pub fn parse_numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|number| number.trim().parse().ok())
        .collect::<Option<_>>()?;
    numbers.try_into().ok()
}

/// Defines an enum each of whose values is written as one word.
macro_rules! choice {
    (
        $(#[$about:meta])* $name:ident, $what:literal {
            $($(#[$doc:meta])* $value:ident = $word:literal,)+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        pub enum $name {
            $($(#[$doc])* #[serde(rename = $word)] $value,)+
        }

        impl $name {
                        /// The words of all values, in the order of the values.
            pub const WORDS: &'static [&'static str] = &[$($word),+];
                        /// All values, in their order.
            pub const ALL: &'static [Self] = &[$(Self::$value),+];

                        /// Returns the word for the value.
            pub fn word(self) -> &'static str {
                match self { $(Self::$value => $word,)+ }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.word())
            }
        }

        impl std::str::FromStr for $name {
            type Err = $crate::base::words::ChoiceError;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                match text {
                    $($word => Ok(Self::$value),)+
                    _ => Err($crate::base::words::ChoiceError::unknown($what, text, Self::WORDS)),
                }
            }
        }
    };
}

/// Lets serde read and write a type as text, through `FromStr` and `Display`. The type must say
/// `#[serde(try_from = "String", into = "String")]`.
macro_rules! as_text {
    ($($name:ident)+) => { $(
        impl TryFrom<String> for $name {
            type Error = <Self as std::str::FromStr>::Err;

            fn try_from(text: String) -> Result<Self, Self::Error> {
                text.parse()
            }
        }

        impl From<$name> for String {
            fn from(value: $name) -> Self {
                value.to_string()
            }
        }
    )+ };
}

pub(crate) use {as_text, choice};

#[cfg(test)]
mod tests {
    use super::*;

    choice! {
        /// Two words.
        Answer, "reply" {
            /// Yes.
            Yes = "yes",
            /// No.
            No = "no",
        }
    }

    #[test]
    fn every_word_reads_and_prints_as_itself() {
        for (word, value) in Answer::WORDS.iter().zip(Answer::ALL) {
            assert_eq!(word.parse::<Answer>().as_ref(), Ok(value));
            assert_eq!(value.to_string(), *word);
        }
        let error = "yess".parse::<Answer>().unwrap_err().to_string();
        assert_eq!(error, "`yess` is not a reply; remedy: did you mean `yes`?");
    }

    #[test]
    fn numbers_are_as_many_as_asked_for() {
        assert_eq!(parse_numbers("1, -2.5,3e-9"), Some([1.0, -2.5, 3e-9]));
        assert_eq!(parse_numbers::<3>("1,2"), None);
        assert_eq!(parse_numbers::<2>("1,two"), None);
    }
}
