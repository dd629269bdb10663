//! The filling of the voids: a density.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::Job;
use crate::base::words::as_text;

/// A material that is poured into the voids, given by its density in g/cm³.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Filling(f64);

/// The greatest density, g/cm³: above that of any metal that can be poured. A greater number was
/// meant in kg/m³.
const GREATEST_G_CM3: f64 = 25.0;

impl Filling {
    /// Returns its density, g/cm³; positive.
    pub fn density_g_cm3(self) -> f64 {
        self.0
    }
}

impl Job {
    /// Returns true if nothing but air goes into the voids.
    pub fn is_plain(&self) -> bool {
        self.is_unfilled() && self.interior.is_hollow()
    }

    /// Returns true if neither ballast nor a filling goes into it. Its interior may be sparse.
    pub fn is_unfilled(&self) -> bool {
        self.fill.is_none() && self.ballast.is_none()
    }
}

/// A text that is not a density.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no filling; remedy: give its density in g/cm³, above 0 and at most \
     {GREATEST_G_CM3}, such as 2.3 for plaster"
)]
pub struct FillingError(String);

impl FromStr for Filling {
    type Err = FillingError;

    fn from_str(text: &str) -> Result<Self, FillingError> {
        match text.trim().parse::<f64>() {
            Ok(density) if density > 0.0 && density <= GREATEST_G_CM3 => Ok(Self(density)),
            _ => Err(FillingError(text.to_owned())),
        }
    }
}

impl fmt::Display for Filling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

as_text!(Filling);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_filling_is_a_density_in_grams_a_cubic_centimetre() {
        assert_eq!("2.3".parse::<Filling>().unwrap().density_g_cm3(), 2.3);
        assert_eq!("2.3".parse::<Filling>().unwrap().to_string(), "2.3");
        for text in ["0", "-1", "inf", "nan", "2300", "sand"] {
            assert!(
                text.parse::<Filling>()
                    .unwrap_err()
                    .to_string()
                    .contains("g/cm³"),
                "{text}"
            );
        }
    }
}
