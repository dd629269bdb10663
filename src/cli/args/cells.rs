//! The arguments of `cells`.

use std::path::PathBuf;

use clap::Args;

use super::FieldChoice;
use super::values::{numbers, scale, sides, words};
use crate::base::units::Length;
use crate::cells::{Norm, Start};
use crate::job::{ModelUnit, Scaling};
use crate::kit::Existing;

/// The arguments of `cells`.
#[derive(Debug, Args)]
pub struct CellsArgs {
    /// The model: an STL, OBJ, PLY or 3MF file
    pub model: PathBuf,
    /// The cells and their first sites.
    #[command(flatten, next_help_heading = "Cells")]
    pub cells: SizeArgs,
    /// The relaxation.
    #[command(flatten, next_help_heading = "Relaxation")]
    pub relaxation: RelaxationArgs,
    /// The walls between the cells.
    #[command(flatten, next_help_heading = "Walls")]
    pub walls: WallArgs,
    /// The size of the model.
    #[command(flatten, next_help_heading = "Size of the model")]
    pub scaling: ModelSizeArgs,
    /// The folder to write [default: the model's name and -cells]
    #[arg(long, value_name = "FOLDER", help_heading = "Output")]
    pub out: Option<PathBuf>,
    /// Replace the folder if it exists
    #[arg(long, help_heading = "Output")]
    pub force: bool,
}

/// The arguments for the sizes of cells and their first sites.
#[derive(Debug, Args)]
pub struct SizeArgs {
    /// The size of a cell: there are as many as cubes of this side fill the model
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        required_unless_present_any = ["density", "sites"],
        conflicts_with_all = ["density", "sites"]
    )]
    pub size: Option<Length>,
    /// Let walls between the cells make this density, in words or as a field.toml; it needs a wall
    ///
    /// A cell of side a between walls t has the density 1 - (1 - t/a)³. So uniform:30% makes cells
    /// of one size, and ramp:0,0,1@20mm..60mm:0.2..0.5 makes them smaller upward.
    #[arg(long, value_name = "FIELD", allow_hyphen_values = true)]
    pub density: Option<FieldChoice>,
    /// First sites of your own: one x,y,z (mm) a line, or the vertices of an OBJ file
    ///
    /// They are in the coordinates of the model as scaled.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["start", "seed"])]
    pub sites: Option<PathBuf>,
    /// The throw of the first sites: apart from each other, or anywhere [default: poisson]
    #[arg(long, value_parser = words::<Start>(Start::WORDS))]
    pub start: Option<Start>,
    /// The seed of the throw; the same one gives the same sites [default: 0]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
}

/// The arguments for the relaxation.
#[derive(Debug, Args)]
pub struct RelaxationArgs {
    /// The distance that is made small: linf makes near cubes, l2 near round cells [default: linf]
    #[arg(long, value_parser = words::<Norm>(Norm::WORDS))]
    pub norm: Option<Norm>,
    /// The number of steps
    #[arg(
        long,
        value_name = "N",
        default_value_t = 50,
        value_parser = clap::value_parser!(u32).range(0..=MOST_STEPS)
    )]
    pub iterations: u32,
    /// Stop once no site moves farther than this in a step
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub stop: Option<Length>,
    /// Turn the cells so that one of their axes lies along this direction
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_parser = numbers::<3>,
        allow_hyphen_values = true,
        conflicts_with_all = ["align", "frames"]
    )]
    pub axis: Option<[f64; 3]>,
    /// Turn the cells along the model's principal axes of inertia
    #[arg(long, conflicts_with = "frames")]
    pub align: bool,
    /// Turn each cell as the nearest line of this file says: x,y,z,ax,ay,az,bx,by,bz
    ///
    /// That is a place, the first axis there and a direction toward the second.
    #[arg(long, value_name = "FILE", conflicts_with = "stretch")]
    pub frames: Option<PathBuf>,
    /// Stretch the cells: the ratio of their sides along their axes, such as 1,1,2
    ///
    /// With an axis of your own the third number is along it.
    #[arg(long, value_name = "A,B,C", value_parser = sides)]
    pub stretch: Option<[f64; 3]>,
}

/// The most steps of a relaxation.
const MOST_STEPS: i64 = 100_000;

/// The arguments for the walls between cells.
#[derive(Debug, Args)]
pub struct WallArgs {
    /// Write a printable solid for this printer: a known one's id, or a profile file
    ///
    /// Its least wall, or the wall that you give, lies between the cells and around them. What no
    /// openings drain stays solid.
    #[arg(long, value_name = "ID|FILE")]
    pub printer: Option<String>,
    /// The wall between two cells and around them [default: the printer's minimum]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub wall: Option<Length>,
}

/// The arguments for the size of the model, where the size is that of a cell.
#[derive(Debug, Clone, Args)]
#[group(multiple = false)]
pub struct ModelSizeArgs {
    /// The model's longest side, such as 100mm or 4in
    ///
    /// Without it the file's numbers are taken as they are.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub model_size: Option<Length>,
    /// Multiply the file's numbers by this factor to get mm
    #[arg(long, value_name = "FACTOR", value_parser = scale, allow_hyphen_values = true)]
    pub scale: Option<f64>,
    /// The unit of the numbers in an STL, OBJ or PLY file; a 3MF file states its own [default: mm]
    #[arg(long, value_parser = words::<ModelUnit>(ModelUnit::WORDS))]
    pub unit: Option<ModelUnit>,
}

impl CellsArgs {
    /// Returns the treatment of a folder that exists.
    pub fn existing(&self) -> Existing {
        if self.force {
            Existing::Replace
        } else {
            Existing::Keep
        }
    }
}

impl ModelSizeArgs {
    /// Returns the scaling that was ordered, or mm by default.
    pub fn scaling(&self) -> Scaling {
        match (self.model_size, self.scale) {
            (Some(size), _) => Scaling::Size(size),
            (None, Some(factor)) => Scaling::Factor(factor),
            (None, None) => Scaling::Unit(self.unit.unwrap_or(ModelUnit::Mm)),
        }
    }
}
