//! The least part that is worth its joint.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::{ChoiceError, as_text};

/// Least length of a part, in lengths of the thinnest pin. A shorter one cannot hold a pin and be
/// held itself.
const PIN_LENGTHS: f64 = 3.0;

/// The least share of the mass that a part has. It is also at least three pins long.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct LeastPart {
    mass_ratio: f64,
}

impl LeastPart {
    /// The usual limit, 2 %. Smaller parts get lost, and their ids are written by hand.
    pub const USUAL: Self = Self { mass_ratio: 0.02 };
    /// No limit: any part is made.
    pub const NONE: Self = Self { mass_ratio: 0.0 };
    /// Greatest limit: two parts of equal mass may stay.
    const MOST_RATIO: f64 = 0.5;

    /// Returns the least share of the mass.
    pub fn mass_ratio(self) -> f64 {
        self.mass_ratio
    }

    /// Returns true for the usual limit.
    pub fn is_usual(&self) -> bool {
        *self == Self::USUAL
    }

    /// Returns the least length of a part's longest side for pins of this length, mm; 0 without a
    /// limit.
    pub(crate) fn length_mm(self, pin_mm: f64) -> f64 {
        if self.mass_ratio > 0.0 {
            PIN_LENGTHS * pin_mm
        } else {
            0.0
        }
    }
}

as_text!(LeastPart);

impl fmt::Display for LeastPart {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}%", 100.0 * self.mass_ratio)
    }
}

impl FromStr for LeastPart {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let number = text.trim().strip_suffix('%').map(str::trim);
        let number = number.and_then(|number| number.parse::<f64>().ok());
        let ratio = number.map(|percent| percent / 100.0);
        let ratio = ratio.filter(|ratio| (0.0..=Self::MOST_RATIO).contains(ratio));
        let form = "a share of the mass from 0% to 50%, such as 2%";
        ratio
            .map(|mass_ratio| Self { mass_ratio })
            .ok_or_else(|| ChoiceError::unknown("least part", text, &[form]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_reads_as_it_prints_and_other_text_is_refused() {
        for text in ["2%", "0%", "12.5%"] {
            assert_eq!(text.parse::<LeastPart>().unwrap().to_string(), text);
        }
        assert_eq!("2 %".parse(), Ok(LeastPart::USUAL));
        assert_eq!("0%".parse(), Ok(LeastPart::NONE));
        for text in ["2", "-1%", "51%", "nan%", "small"] {
            let error = text.parse::<LeastPart>().unwrap_err().to_string();
            assert!(error.contains("from 0% to 50%"), "{error}");
        }
    }
}
