//! The arguments for the size of a model.

use clap::Args;

use super::values::{scale, words};
use crate::base::units::Length;
use crate::job::{ModelUnit, Scaling};

/// The arguments for the size of the model; at most one is given.
#[derive(Debug, Clone, Args)]
#[group(multiple = false)]
pub struct ScalingArgs {
    /// Its longest side, such as 100mm or 4in
    ///
    /// Without it the file's numbers are taken as they are.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub size: Option<Length>,
    /// Multiply the file's numbers by this factor to get mm
    #[arg(long, value_name = "FACTOR", value_parser = scale, allow_hyphen_values = true)]
    pub scale: Option<f64>,
    /// The unit of the numbers in an STL, OBJ or PLY file; a 3MF file states its own [default: mm]
    #[arg(long, value_parser = words::<ModelUnit>(ModelUnit::WORDS))]
    pub unit: Option<ModelUnit>,
}

impl ScalingArgs {
    /// Returns true if nothing was said about the size.
    pub fn is_open(&self) -> bool {
        self.size.is_none() && self.scale.is_none() && self.unit.is_none()
    }

    /// Returns the scaling that was ordered, or mm by default.
    pub fn scaling(&self) -> Scaling {
        match (self.size, self.scale) {
            (Some(size), _) => Scaling::Size(size),
            (None, Some(factor)) => Scaling::Factor(factor),
            (None, None) => Scaling::Unit(self.unit.unwrap_or(ModelUnit::Mm)),
        }
    }
}
