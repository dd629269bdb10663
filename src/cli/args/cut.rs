//! The arguments for cuts, pins and marks: a word, or a file with the plan.

use std::convert::Infallible;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use super::values::{share, words};
use crate::base::units::Length;
use crate::cut::{CutOrder, KeepClear, LeastPart, SeamStyle};
use crate::field::is_file_name;
use crate::job::{
    CutMode, DensityOrder, DrainOrder, Effort, FieldOrder, FieldOrderError, IdStyle, InfillDensity,
    Interior, KeptShare, LevelCount, PinStyle, PlanError,
};

/// The arguments for cutting the object and joining its parts.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Method")]
pub struct CutArgs {
    /// Cut the object to open its voids (auto), not at all (never), or as the plan in FILE says.
    /// Such a plan is a kit's cuts.toml, edited [default: auto]
    #[arg(long, value_name = "auto|never|FILE")]
    pub cut: Option<CutArg>,
    /// Drain the voids of a piece that is never cut: through holes of the least width that does
    /// (auto), or of this diameter. Never makes none, and what would stay closed is refused. For
    /// powder, resin and wax [default: auto]
    #[arg(long, value_name = "auto|never|LENGTH", allow_hyphen_values = true)]
    pub drain: Option<DrainOrder>,
    /// Print a plug for each drain hole, to be glued in once the void is empty
    #[arg(long)]
    pub plugs: bool,
    /// Hollow the inside (hollow), or print one uncut piece whose inside is sparse infill (graded)
    /// or cells that drain (cells) where that helps. Graded is for filament printers, cells are for
    /// powder, resin and wax [default: hollow]
    #[arg(long, value_parser = words::<Interior>(Interior::WORDS))]
    pub interior: Option<Interior>,
    /// The size of the cells of an inside of cells [default: the usual one of the process]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub cell_size: Option<Length>,
    /// The least and the greatest infill of a graded print, such as 15%..60%. Walls stay solid
    /// [default: the least that prints, and 100%]
    #[arg(long, value_name = "LO..HI", allow_hyphen_values = true)]
    pub density: Option<DensityOrder>,
    /// Keep the infill of a graded print near to this, such as 40%, and change it as little as the
    /// goal allows
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true)]
    pub infill: Option<InfillDensity>,
    /// The number of densities: 3 to 12 near an infill or of a field [default: 4], 2 without them
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub levels: Option<LevelCount>,
    /// Keep this share of the best that is calculated near that infill, such as 95%: of a speed, an
    /// angle or a height. Tops and yo-yos keep 80% if nothing is said
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true)]
    pub keep: Option<KeptShare>,
    /// Print a field of densities in levels: ramp or sine, fitted to the goal, or one as inspect
    /// takes it (words or a field.toml). Without it the densities are the best [default: none]
    #[arg(long, value_name = "FIELD", allow_hyphen_values = true)]
    pub field: Option<FieldArg>,
    /// Put seams where they are seen least (hidden), make them short (short), or only level ones
    /// (level) [default: hidden]
    #[arg(long, value_parser = words::<SeamStyle>(SeamStyle::WORDS))]
    pub seam: Option<SeamStyle>,
    /// Keep seams out of a ball, such as a face: its centre and radius in mm of the scaled model;
    /// once for each ball
    #[arg(long, value_name = "X,Y,Z,R", allow_hyphen_values = true)]
    pub keep_clear: Vec<KeepClear>,
    /// Make no part with a smaller share of the mass, nor one shorter than three pins [default: 2%]
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true)]
    pub least_part: Option<LeastPart>,
    /// Align the parts by pins printed on them (printed), or by dowels cut from stock rods (dowel)
    /// [default: printed]
    #[arg(long, value_name = "printed|dowel")]
    pub pins: Option<PinStyle>,
    /// Engrave the parts' ids into their cut faces if there is room (engraved), or not (none)
    /// [default: engraved]
    #[arg(long, value_name = "engraved|none")]
    pub ids: Option<IdStyle>,
    /// Take the first plan that works (quick), compare plans for a while (normal), or compare all
    /// that can be thought of (thorough) [default: normal]
    #[arg(long, value_parser = words::<Effort>(Effort::WORDS))]
    pub effort: Option<Effort>,
    /// Share of the goal's figure that joints may cost at most [default: 15%]. A printed jig holds
    /// those that would cost more
    #[arg(long, value_name = "RATIO", value_parser = share)]
    pub joint_price: Option<f64>,
}

/// The value of `--cut`.
#[derive(Debug, Clone, PartialEq)]
pub enum CutArg {
    /// A word.
    Mode(CutMode),
    /// A file that holds the cuts and optionally the pins.
    Plan(PathBuf),
}

impl FromStr for CutArg {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(text
            .parse()
            .map_or_else(|_| Self::Plan(text.into()), Self::Mode))
    }
}

/// The value of `--field`.
#[derive(Debug, Clone, PartialEq)]
pub enum FieldArg {
    /// Words.
    Words(FieldOrder),
    /// A file that holds the field.
    File(PathBuf),
}

impl FromStr for FieldArg {
    type Err = FieldOrderError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match is_file_name(text) {
            true => Ok(Self::File(text.into())),
            false => text.parse().map(Self::Words),
        }
    }
}

impl FieldArg {
    /// Returns the field; a file is read now.
    ///
    /// # Errors
    /// The file cannot be read, or is no field that can be printed.
    pub fn order(self) -> Result<FieldOrder, FieldOrderError> {
        match self {
            Self::Words(order) => Ok(order),
            Self::File(path) => FieldOrder::of_file(&path),
        }
    }
}

impl CutArg {
    /// Returns the mode, and the plan if it is a file.
    ///
    /// # Errors
    /// The file cannot be read or is not a plan.
    pub fn order(self) -> Result<(CutMode, Option<CutOrder>), PlanError> {
        match self {
            Self::Mode(mode) => Ok((mode, None)),
            Self::Plan(path) => Ok((CutMode::Auto, Some(crate::job::read_plan(&path)?))),
        }
    }
}
