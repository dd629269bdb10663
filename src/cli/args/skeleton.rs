//! The arguments of `skeleton`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use super::scaling::ScalingArgs;
use crate::base::units::Length;

/// The arguments of `skeleton`.
#[derive(Debug, Args)]
pub struct SkeletonArgs {
    /// The model: an STL, OBJ, PLY or 3MF file; or a skeleton file, which is checked
    pub model: PathBuf,
    /// The size of the model.
    #[command(flatten, next_help_heading = "Size")]
    pub scaling: ScalingArgs,
    /// The node that the limbs grow from: its number, or a place near it in mm [default: the
    /// juncture with the largest ball]
    #[arg(
        long,
        value_name = "NODE|X,Y,Z",
        allow_hyphen_values = true,
        help_heading = "Limbs"
    )]
    pub root: Option<Root>,
    /// The radius of the thinnest shell
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "1.6mm",
        allow_hyphen_values = true,
        help_heading = "Limbs"
    )]
    pub tip_radius: Length,
    /// The difference of radius between two shells: wall, stop and clearances
    #[arg(
        long,
        value_name = "LENGTH",
        default_value = "2mm",
        allow_hyphen_values = true,
        help_heading = "Limbs"
    )]
    pub shell_pitch: Length,
    /// The file to write, with a picture beside it [default: the model's name and -skeleton.toml]
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub out: Option<PathBuf>,
    /// Replace the file and its picture if they exist
    #[arg(long, help_heading = "Output")]
    pub force: bool,
}

/// The root of a skeleton as it is ordered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Root {
    /// The node of this number.
    Node(u32),
    /// The node nearest to this place, mm.
    Near([f64; 3]),
}

/// A text that names no root.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no root; remedy: give the number of a node, such as 12, or a place X,Y,Z in mm")]
pub struct RootError(String);

impl FromStr for Root {
    type Err = RootError;

    fn from_str(text: &str) -> Result<Self, RootError> {
        let fault = || RootError(text.to_owned());
        if let Ok(node) = text.trim().parse() {
            return Ok(Self::Node(node));
        }
        let numbers = text.split(',').map(|number| number.trim().parse().ok());
        let numbers: Option<Vec<f64>> = numbers.collect();
        let place = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        let is_finite = |place: &[f64; 3]| place.iter().all(|number| number.is_finite());
        place.filter(is_finite).map(Self::Near).ok_or_else(fault)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_a_number_or_a_place() {
        assert_eq!("12".parse(), Ok(Root::Node(12)));
        assert_eq!("-1, 2.5,3".parse(), Ok(Root::Near([-1.0, 2.5, 3.0])));
        for bad in ["", "-1", "1,2", "1,2,3,4", "nan,0,0", "tip", "1.5"] {
            assert!(bad.parse::<Root>().is_err(), "{bad}");
        }
    }
}
