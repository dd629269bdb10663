//! The arguments for the size of a model.

use clap::Args;

use super::values::{factor, words};
use crate::base::units::Length;
use crate::job::{ModelUnit, Scaling};

/// The arguments for the size of the model; at most one is given.
#[derive(Debug, Clone, Args)]
#[group(multiple = false)]
#[command(next_help_heading = "Size")]
pub struct ScalingArgs {
    /// Scale the model so that its longest side has this length
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub size: Option<Length>,
    /// Multiply the file's numbers by this factor to get mm
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_hyphen_values = true)]
    pub scale: Option<f64>,
    /// The unit of the numbers in an STL, OBJ or PLY file; a 3MF file states its own [default: mm]
    #[arg(long, value_parser = words::<ModelUnit>(ModelUnit::WORDS))]
    pub unit: Option<ModelUnit>,
}

impl ScalingArgs {
    /// Returns the scaling that was ordered, or mm by default.
    pub fn scaling(&self) -> Scaling {
        match (self.size, self.scale) {
            (Some(size), _) => Scaling::Size(size),
            (None, Some(factor)) => Scaling::Factor(factor),
            (None, None) => Scaling::Unit(self.unit.unwrap_or(ModelUnit::Mm)),
        }
    }
}
