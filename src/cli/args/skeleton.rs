//! The arguments of `skeleton`.

use std::path::PathBuf;

use clap::Args;

use super::scaling::ScalingArgs;
use crate::base::units::Length;
use crate::job::telescope::Root;

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
