//! The arguments of `slice`.

use std::path::PathBuf;

use clap::Args;

/// The arguments of `slice`.
#[derive(Debug, Args)]
pub struct SliceArgs {
    /// The folder of the kit
    pub kit: PathBuf,
    /// The command of the slicer, PrusaSlicer or SuperSlicer [default: prusa-slicer]
    #[arg(long, value_name = "CMD")]
    pub slicer: Option<String>,
    /// A configuration exported by the slicer (.ini), for speeds, temperatures and the start
    ///
    /// Sizes, lines, layers and density stay those of the kit's printer.
    #[arg(long, value_name = "FILE")]
    pub profile: Option<PathBuf>,
    /// The folder to write [default: the kit's name and -gcode]
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// Replace the folder if it exists
    #[arg(long)]
    pub force: bool,
}
