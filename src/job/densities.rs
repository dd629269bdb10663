//! The densities of infill that a job orders, in per cent as slicers name them.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::as_text;

/// A density of infill in the words of slicers, over that of solid print.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct InfillDensity {
    percent: f64,
}

/// The least and the greatest density of infill, in the words of slicers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct DensityOrder {
    low: InfillDensity,
    high: InfillDensity,
}

/// The number of densities that a print near a wished infill has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct LevelCount(usize);

/// The share of the best figure that a print near a wished infill keeps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct KeptShare(InfillDensity);

/// Between the two densities of an order.
const TO: &str = "..";
/// Fewest levels: two at their best.
const MIN_LEVELS: usize = 2;
/// Most levels: slicers get slow with more modifiers.
const MAX_LEVELS: usize = 12;
/// Shares of the best figure that may be kept, per cent. All of it is kept by the two densities at
/// their best alone.
const KEPT_PERCENT: RangeInclusive<f64> = 1.0..=99.0;
/// The word for a density without steps.
const SMOOTH: &str = "smooth";

/// A reason why a text is no density of infill, or no number of them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DensityError {
    /// A number without its sign.
    #[error("`{0}` is no density; remedy: give it in per cent, with the sign, such as 15%")]
    NoPercent(String),
    /// A number beyond what can be laid.
    #[error("`{0}` is no density of infill; remedy: give 0% to 100%")]
    Outside(String),
    /// No two densities.
    #[error("`{0}` is no range of densities; remedy: give two, such as 15%..60%")]
    NoRange(String),
    /// The first is not below the second.
    #[error("{low} is not below {high}; remedy: give the lesser density first, such as 15%..60%")]
    Order {
        /// The first.
        low: InfillDensity,
        /// The second.
        high: InfillDensity,
    },
    /// No number of levels.
    #[error("`{0}` is no number of levels; remedy: give {MIN_LEVELS} to {MAX_LEVELS}")]
    NoCount(String),
    /// A density without steps.
    #[error(
        "a modifier has one density, so that none is smooth; remedy: give {MIN_LEVELS} to \
         {MAX_LEVELS} levels"
    )]
    Smooth,
    /// No share of a figure.
    #[error(
        "`{0}` is no share of the best figure; remedy: give {least}% to {most}%, or leave the \
         wished infill out for the best itself",
        least = KEPT_PERCENT.start(),
        most = KEPT_PERCENT.end()
    )]
    NoShare(String),
}

impl InfillDensity {
    /// All of it: solid print.
    pub const SOLID: Self = Self { percent: 100.0 };

    /// Returns the density over that of solid print. `None` beyond 0 to 1.
    pub fn of_ratio(ratio: f64) -> Option<Self> {
        // The nearest thousandth of a per cent, so that it prints as it was meant.
        let percent = (ratio * 1e5).round() / 1e3;
        (0.0..=100.0).contains(&percent).then_some(Self { percent })
    }

    /// Returns it over solid print.
    pub fn ratio(self) -> f64 {
        self.percent / 100.0
    }
}

impl DensityOrder {
    /// Returns an order of two densities.
    ///
    /// # Errors
    /// The first is not below the second.
    pub fn new(low: InfillDensity, high: InfillDensity) -> Result<Self, DensityError> {
        match low < high {
            true => Ok(Self { low, high }),
            false => Err(DensityError::Order { low, high }),
        }
    }

    /// Returns the least density.
    pub fn low(self) -> InfillDensity {
        self.low
    }

    /// Returns the greatest density.
    pub fn high(self) -> InfillDensity {
        self.high
    }
}

impl LevelCount {
    /// The usual number: more change the infill hardly less.
    pub const USUAL: Self = Self(4);

    /// Returns the number.
    pub fn count(self) -> usize {
        self.0
    }

    /// Returns true for two densities, which the goal alone places.
    pub fn is_two(self) -> bool {
        self.0 == MIN_LEVELS
    }
}

impl KeptShare {
    /// Returns the share, 0 to 1.
    pub fn ratio(self) -> f64 {
        self.0.ratio()
    }
}

impl FromStr for KeptShare {
    type Err = DensityError;

    fn from_str(text: &str) -> Result<Self, DensityError> {
        let no_share = || DensityError::NoShare(text.to_owned());
        let share: InfillDensity = text.parse().map_err(|_| no_share())?;
        match KEPT_PERCENT.contains(&share.percent) {
            true => Ok(Self(share)),
            false => Err(no_share()),
        }
    }
}

impl fmt::Display for KeptShare {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for InfillDensity {
    type Err = DensityError;

    fn from_str(text: &str) -> Result<Self, DensityError> {
        let no_percent = || DensityError::NoPercent(text.to_owned());
        let number = text.trim().strip_suffix('%').ok_or_else(no_percent)?;
        let percent: f64 = number.trim().parse().map_err(|_| no_percent())?;
        match (0.0..=100.0).contains(&percent) {
            true => Ok(Self { percent }),
            false => Err(DensityError::Outside(text.to_owned())),
        }
    }
}

impl FromStr for DensityOrder {
    type Err = DensityError;

    fn from_str(text: &str) -> Result<Self, DensityError> {
        let ends = text.split_once(TO);
        let (low, high) = ends.ok_or_else(|| DensityError::NoRange(text.to_owned()))?;
        Self::new(low.parse()?, high.parse()?)
    }
}

impl FromStr for LevelCount {
    type Err = DensityError;

    fn from_str(text: &str) -> Result<Self, DensityError> {
        match text.trim().parse() {
            Ok(count) if (MIN_LEVELS..=MAX_LEVELS).contains(&count) => Ok(Self(count)),
            _ if text.trim() == SMOOTH => Err(DensityError::Smooth),
            _ => Err(DensityError::NoCount(text.to_owned())),
        }
    }
}

impl fmt::Display for InfillDensity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}%", self.percent)
    }
}

impl fmt::Display for DensityOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{TO}{}", self.low, self.high)
    }
}

impl fmt::Display for LevelCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

as_text!(InfillDensity);
as_text!(DensityOrder);
as_text!(LevelCount);
as_text!(KeptShare);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_reads_as_it_prints() {
        for text in ["15%..60%", "0%..100%", "12.5%..30%"] {
            assert_eq!(text.parse::<DensityOrder>().unwrap().to_string(), text);
        }
        assert_eq!(
            " 40 % ".parse::<InfillDensity>().unwrap().to_string(),
            "40%"
        );
        assert_eq!("12".parse::<LevelCount>().unwrap().count(), 12);
        let third = InfillDensity::of_ratio(1.0 / 3.0).unwrap();
        assert_eq!(third.to_string(), "33.333%");
    }

    #[test]
    fn what_is_no_range_of_densities_is_refused_with_what_to_type() {
        for (text, said) in [
            ("15..60%", "with the sign, such as 15%"),
            ("15%..60", "with the sign"),
            ("1.5", "give two, such as 15%..60%"),
            ("60%..15%", "give the lesser density first"),
            ("15%..15%", "15% is not below 15%"),
            ("-1%..50%", "give 0% to 100%"),
            ("15%..101%", "give 0% to 100%"),
            ("nan%..50%", "give 0% to 100%"),
            ("", "give two"),
        ] {
            let error = text.parse::<DensityOrder>().unwrap_err().to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
    }

    #[test]
    fn a_share_of_the_best_figure_is_more_than_nothing_and_less_than_all() {
        assert_eq!("95%".parse::<KeptShare>().unwrap().ratio(), 0.95);
        for text in ["0%", "100%", "0.95", "95", "", "-5%", "nan%"] {
            let error = text.parse::<KeptShare>().unwrap_err().to_string();
            assert!(error.contains("give 1% to 99%"), "{text}: {error}");
        }
    }

    #[test]
    fn levels_are_two_to_twelve_and_never_smooth() {
        for (text, said) in [
            ("1", "give 2 to 12"),
            ("13", "give 2 to 12"),
            ("-3", "give 2 to 12"),
            ("smooth", "a modifier has one density"),
        ] {
            let error = text.parse::<LevelCount>().unwrap_err().to_string();
            assert!(error.contains(said), "{text}: {error}");
        }
    }
}
