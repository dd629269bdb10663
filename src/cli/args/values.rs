//! Readers of single values, and the text that ends the help.

use std::str::FromStr;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use crate::base::words::ChoiceError;

/// The text below the options in the help of a command.
pub(super) const EXIT_CODES: &str = "\
LENGTH takes a unit (100mm, 10cm, 0.1m, 4in, 42um); without one it is in mm.
Exit codes: 0 every promise is kept; 1 finished, but a promise is broken (by a missing or damaged \
file of a kit too) or the goal is impossible; 2 could not run: bad arguments, a model that is not \
one solid body, no kit; 130 or 143 stopped by Ctrl-C or a request to end, and nothing was written.";

/// Returns a reader of one of these words, which the help lists.
pub(super) fn words<T>(words: &'static [&'static str]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = ChoiceError> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(words).try_map(|word| word.parse::<T>())
}

/// A factor that is not positive and finite.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a positive, finite factor; remedy: give a number above zero")]
pub struct FactorError(String);

/// An angle that is not finite, or below zero.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not an angle in degrees; remedy: give a number of zero or more, without a unit")]
pub struct AngleError(String);

/// Reads an angle in degrees.
pub(super) fn angle(text: &str) -> Result<f64, AngleError> {
    match text.trim().trim_end_matches('°').parse::<f64>() {
        Ok(angle) if angle.is_finite() && angle >= 0.0 => Ok(angle),
        _ => Err(AngleError(text.to_owned())),
    }
}

/// A share that is not from 0 to 100 %.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no share; remedy: give a percentage such as 15%, or a number from 0 to 1")]
pub struct ShareError(String);

/// Reads a share: `15%` or `0.15`.
pub(super) fn share(text: &str) -> Result<f64, ShareError> {
    let (number, unit) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>().map(|value| unit * value) {
        Ok(share) if (0.0..=1.0).contains(&share) => Ok(share),
        _ => Err(ShareError(text.to_owned())),
    }
}

/// Reads a factor.
pub(super) fn factor(text: &str) -> Result<f64, FactorError> {
    match text.trim().parse::<f64>() {
        Ok(factor) if factor.is_finite() && factor > 0.0 => Ok(factor),
        _ => Err(FactorError(text.to_owned())),
    }
}
