//! The arguments of `scale-extrusion`.

use std::path::PathBuf;

use clap::Args;

use super::FieldChoice;
use crate::job::InfillDensity;
use crate::slice::MOST_FLOW_MM3_S;

/// The arguments of `scale-extrusion`.
#[derive(Debug, Args)]
pub struct ScaleArgs {
    /// The G-code of a plate, as the slicer wrote it (.gcode)
    pub toolpaths: PathBuf,
    /// The folder of the kit whose parts it prints
    pub kit: PathBuf,
    /// The density that the parts get, in words or as a field.toml [default: what the kit states
    /// for its inside]
    ///
    /// A ramp is ramp:0,0,1@20mm..60mm:0.5..1. Lengths are those of the kit's model, in the axes of
    /// its file.
    #[arg(long, value_name = "FIELD", allow_hyphen_values = true)]
    pub field: Option<FieldChoice>,
    /// The density of sparse infill with which it was sliced [default: with a field, what the kit
    /// or the file says]
    #[arg(long, value_name = "PERCENT")]
    pub infill: Option<InfillDensity>,
    /// Most that the hot end melts, mm³/s; pieces that need more are laid more slowly
    #[arg(long, value_name = "NUMBER", value_parser = flow, default_value_t = MOST_FLOW_MM3_S)]
    pub most_flow: f64,
    /// The G-code to write
    #[arg(short, long, value_name = "FILE")]
    pub out: PathBuf,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}

/// Reads a flow above zero, mm³/s.
fn flow(text: &str) -> Result<f64, String> {
    let flow: Option<f64> = text.trim().parse().ok();
    let flow = flow.filter(|flow| flow.is_finite() && *flow > 0.0);
    flow.ok_or_else(|| "give mm³ a second above 0, such as 15".to_owned())
}
