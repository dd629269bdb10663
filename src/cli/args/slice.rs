//! The arguments of `slice`.

use std::path::PathBuf;

use clap::Args;

use crate::slice::SliceFormat;

/// The arguments of `slice`.
#[derive(Debug, Args)]
pub struct SliceArgs {
    /// The folder of the kit
    pub kit: PathBuf,
    /// The format: gcode by a slicer, or images of layers at the printer's own pixels (png-stack,
    /// sl1) [default: gcode]
    #[arg(long, value_name = "FORMAT")]
    pub format: Option<SliceFormat>,
    /// The command of the slicer, PrusaSlicer, SuperSlicer, CuraEngine (or: cura), or
    /// OrcaSlicer (not tried) [default: prusa-slicer]
    #[arg(long, value_name = "CMD")]
    pub slicer: Option<String>,
    /// A configuration exported by the slicer (.ini), for speeds, temperatures and the start
    ///
    /// For CuraEngine it is a text with lines of setting = value, by the names of Cura's settings.
    /// Sizes, lines, layers and density stay those of the kit's printer. An sl1 takes its display
    /// and its exposure from it.
    #[arg(long, value_name = "FILE")]
    pub profile: Option<PathBuf>,
    /// The folder to write [default: the kit's name and -gcode, or -layers]
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
    /// Write a quote too, as a page and as a table, by the rates in equipoise.toml
    #[arg(long)]
    pub quote: bool,
    /// Replace the folder if it exists
    #[arg(long)]
    pub force: bool,
}

impl SliceArgs {
    /// Returns an option that says nothing in the format that was asked for; `None` if all count.
    pub fn needless(&self) -> Option<&'static str> {
        match self.format {
            None | Some(SliceFormat::Gcode) => None,
            _ if self.slicer.is_some() => Some("--slicer"),
            _ if self.quote => Some("--quote"),
            Some(SliceFormat::Stack) if self.profile.is_some() => Some("--profile"),
            Some(_) => None,
        }
    }
}
