//! The poses that a job of a telescope orders.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::as_text;

/// A place that a tip is to reach.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Reach {
    /// The tip: that of a curve, or the limb of a figure that ends there.
    pub tip: String,
    /// The place in the frame of the curve or the model, mm.
    pub place: [f64; 3],
}

/// A text that names no tip and place.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no tip with a place; remedy: give TIP=X,Y,Z in mm, such as tip=40,0,120")]
pub struct ReachError(String);

impl FromStr for Reach {
    type Err = ReachError;

    fn from_str(text: &str) -> Result<Self, ReachError> {
        let fault = || ReachError(text.to_owned());
        let (tip, place) = text.split_once('=').ok_or_else(fault)?;
        let numbers = place.split(',').map(|number| number.trim().parse().ok());
        let numbers: Option<Vec<f64>> = numbers.collect();
        let place = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        let is_finite = |place: &[f64; 3]| place.iter().all(|number| number.is_finite());
        let place = place.filter(is_finite).ok_or_else(fault)?;
        let tip = tip.trim().to_owned();
        if tip.is_empty() {
            return Err(fault());
        }
        Ok(Self { tip, place })
    }
}

impl fmt::Display for Reach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.place;
        write!(f, "{}={x},{y},{z}", self.tip)
    }
}

as_text!(Reach);

/// A pose file that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read the pose file {}; remedy: check the path and its permissions", path.display())]
pub struct PoseReadError {
    /// The file.
    pub path: PathBuf,
    /// The system's error.
    pub source: std::io::Error,
}

/// A pose file. The job holds its text, so that it replays away from the file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PoseChoice {
    /// The name of the file, for messages.
    pub source: String,
    /// Its text.
    pub text: String,
}

impl PoseChoice {
    /// Reads the pose file at `path`.
    ///
    /// # Errors
    /// The file cannot be read as text.
    pub fn read(path: &Path) -> Result<Self, PoseReadError> {
        let text = std::fs::read_to_string(path).map_err(|source| PoseReadError {
            path: path.to_owned(),
            source,
        })?;
        let source = path.to_string_lossy().into_owned();
        Ok(Self { source, text })
    }

    /// Returns the choice as a kit tells it: without the folder in which the file lay.
    pub fn in_kit(&self) -> Self {
        let name = Path::new(&self.source).file_name();
        let named = name.map(|name| name.to_string_lossy().into_owned());
        Self {
            source: named.unwrap_or_else(|| self.source.clone()),
            text: self.text.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reach_is_a_tip_with_a_place_and_nothing_else() {
        let reach = Reach {
            tip: "A".to_owned(),
            place: [-1.0, 2.5, 3.0],
        };
        assert_eq!("A=-1, 2.5,3".parse(), Ok(reach.clone()));
        assert_eq!(reach.to_string(), "A=-1,2.5,3");
        for bad in ["", "tip", "=1,2,3", "tip=1,2", "tip=1,2,3,4", "tip=nan,0,0"] {
            assert!(bad.parse::<Reach>().is_err(), "{bad}");
        }
    }
}
