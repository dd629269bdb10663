//! The arguments of `slice`.

use std::path::PathBuf;

use clap::Args;

use super::{FieldChoice, ScalingArgs};
use crate::kit::Existing;
use crate::slice::SliceFormat;

/// The arguments of `slice`.
#[derive(Debug, Args)]
pub struct SliceArgs {
    /// The folder of the kit, or a model that is printed in two materials
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
    /// The two materials of a model.
    #[command(flatten, next_help_heading = "Two materials")]
    pub dither: DitherArgs,
}

/// The arguments for a model that is printed in two materials.
#[derive(Debug, Args)]
pub struct DitherArgs {
    /// Print a model in two materials, with this density over that of the heavier one
    ///
    /// The printer sets drops of both (PolyJet), and the images are a png-stack for each. A ramp is
    /// ramp:0,0,1@20mm..60mm:0.95..1. Lengths are those of the model as scaled, in its axes.
    #[arg(
        long,
        value_name = "FIELD",
        allow_hyphen_values = true,
        requires_all = ["materials", "printer"]
    )]
    pub field: Option<FieldChoice>,
    /// The ids of the two materials in the printer's profile
    #[arg(long, value_name = "A,B", value_parser = two_materials, requires = "field")]
    pub materials: Option<[String; 2]>,
    /// The printer: a known one's id, or a profile file
    #[arg(long, value_name = "ID|FILE", requires = "field")]
    pub printer: Option<String>,
    /// The size of the model.
    #[command(flatten, next_help_heading = "Two materials")]
    pub scaling: ScalingArgs,
}

/// Reads the ids of two materials.
fn two_materials(text: &str) -> Result<[String; 2], String> {
    let ids = text.split_once(',').filter(|(_, rest)| !rest.contains(','));
    let ids = ids.map(|(a, b)| [a.trim().to_owned(), b.trim().to_owned()]);
    let ids = ids.filter(|ids| ids.iter().all(|id| !id.is_empty()));
    ids.ok_or_else(|| "give the ids of two materials, such as vero-white,tango".to_owned())
}

impl SliceArgs {
    /// Returns whether the folder may be replaced.
    pub fn existing(&self) -> Existing {
        if self.force {
            Existing::Replace
        } else {
            Existing::Keep
        }
    }

    /// Returns an option that says nothing in the format that was asked for; `None` if all count.
    pub fn needless(&self) -> Option<&'static str> {
        let is_dithered = self.dither.field.is_some();
        match self.format {
            _ if !is_dithered && self.dither.scaling.size.is_some() => Some("--size"),
            _ if !is_dithered && !self.dither.scaling.is_open() => Some("--scale or --unit"),
            Some(SliceFormat::Gcode | SliceFormat::Sl1) if is_dithered => Some("--field"),
            None if is_dithered && self.slicer.is_some() => Some("--slicer"),
            None if is_dithered && self.quote => Some("--quote"),
            None if is_dithered && self.profile.is_some() => Some("--profile"),
            None | Some(SliceFormat::Gcode) => None,
            _ if self.slicer.is_some() => Some("--slicer"),
            _ if self.quote => Some("--quote"),
            Some(SliceFormat::Stack) if self.profile.is_some() => Some("--profile"),
            Some(_) => None,
        }
    }
}
