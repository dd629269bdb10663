//! The arguments for a volume mesh to be written.

use std::path::PathBuf;

use clap::Args;

use crate::base::units::Length;

/// The arguments for a volume mesh to be written.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct TetsArgs {
    /// Write a volume mesh with the densities into this .msh or .vtk file, for simulation
    ///
    /// It is an approximation: its error is told. In inspect it needs a field, in prepare a graded
    /// interior.
    #[arg(long, value_name = "FILE", help_heading = "Volume mesh")]
    pub tets: Option<PathBuf>,
    /// The longest edge of its tetrahedra [default: a 40th of the size]
    #[arg(
        long,
        value_name = "LENGTH",
        requires = "tets",
        help_heading = "Volume mesh"
    )]
    pub tets_edge: Option<Length>,
}
