//! The reasons why a run reaches no answer.

use std::path::PathBuf;

use crate::ballast::BallastError;
use crate::base::setting::{Key, Setting};
use crate::base::watch::Cancelled;
use crate::cladding::CladdingError;
use crate::cutter::{CannotCut, ProfileError as CutterError};
use crate::cutting::SheetError;
use crate::draw::PictureError;
use crate::error::Error;
use crate::goal::GoalError;
use crate::io::threemf::PackageError;
use crate::io::{ContentError, ReadError, StlError};
use crate::job::base_choice::Polyhedra;
use crate::job::base_method::BaseMethod;
use crate::job::core_kit::CoreGoal;
use crate::job::{JobError, StockItem};
use crate::mend::MendError;
use crate::mesh::{ClipError, Defects};
use crate::polyhedra::{BaseFileError, RequestError, SeparationError};
use crate::printer::{MaterialError, ProfileError, WallError};
use crate::repair::NotOneBody;
use crate::verify::CoreVerifyError;
use crate::wing::Unwritable;

/// A reason why a run could not reach an answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CoreRunError {
    /// The model cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The model cannot be mended.
    #[error("{} cannot be repaired", path.display())]
    Mend {
        /// The model's file.
        path: PathBuf,
        /// The reason.
        source: Box<MendError>,
    },
    /// The model does not bound a solid.
    #[error("{} does not bound a solid", path.display())]
    NotSolid {
        /// The model's file.
        path: PathBuf,
        /// Every defect.
        source: Box<Defects>,
    },
    /// The model is not one body.
    #[error("{} is not one body", path.display())]
    NotOneBody {
        /// The model's file.
        path: PathBuf,
        /// Its shells, or the places where it passes through itself.
        source: Box<NotOneBody>,
    },
    /// The job cannot be read, or its model has changed.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The profile of the cutter, the sheet or the fasteners cannot be used.
    #[error(transparent)]
    Cutter(#[from] CutterError),
    /// The cutter does not cut the sheet.
    #[error(transparent)]
    CannotCut(#[from] CannotCut),
    /// The printer has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The wall cannot be printed.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// The number of faces cannot be.
    #[error(transparent)]
    Faces(#[from] RequestError),
    /// Several polyhedra by the method that makes one.
    #[error(
        "the method of vertices makes one polyhedron; remedy: leave `{}` away, or give `{}`",
        Setting::new(Key::Polyhedra, .polyhedra), Setting::new(Key::Method, BaseMethod::Planes)
    )]
    VerticesOfSeveral {
        /// The number asked for.
        polyhedra: Polyhedra,
    },
    /// Fewer faces than the start of moved vertices has.
    #[error(
        "moved vertices keep the faces of their start, which has {fewest}; remedy: give `{}`, or \
         `{}`",
        Setting::new(Key::Faces, .fewest), Setting::new(Key::Method, BaseMethod::Planes)
    )]
    FewerThanStart {
        /// The faces of the start, or of the one with the fewest.
        fewest: usize,
    },
    /// The file of a base describes none of this model.
    #[error(transparent)]
    Base(#[from] BaseFileError),
    /// The goal cannot be placed.
    #[error(transparent)]
    Goal(#[from] GoalError),
    /// No stock screw passes the sheet.
    #[error(
        "no stock screw reaches through a sheet of {sheet_mm} mm; remedy: choose a thinner sheet"
    )]
    NoScrew {
        /// The thickness of the sheet, mm.
        sheet_mm: f64,
    },
    /// No stock screw passes two sheets.
    #[error(
        "no stock screw reaches through two sheets of {sheet_mm} mm, two washers and a nut; \
         remedy: choose a thinner sheet, or one polyhedron"
    )]
    NoBolt {
        /// The thickness of the sheet, mm.
        sheet_mm: f64,
    },
    /// A rod that is not on stock.
    #[error(
        "no rod `{id}` is on stock; remedy: give auto, none, or one of {}", .known.join(", ")
    )]
    NoDowel {
        /// The id.
        id: String,
        /// The ids of the rods on stock.
        known: Vec<String>,
    },
    /// A sheet at hand that the cutter's bed does not hold.
    #[error(
        "a sheet of {item} mm does not lie on the cutter's bed of {} x {} mm; remedy: name in \
         `{}` the sizes to which it is cut first",
        .bed_mm[0], .bed_mm[1], Setting::open(Key::Stock)
    )]
    StockTooLarge {
        /// The sheet.
        item: StockItem,
        /// Both sides of the bed, mm.
        bed_mm: [f64; 2],
    },
    /// The sheets cannot be cut.
    #[error(transparent)]
    Sheet(#[from] SheetError),
    /// The ballast cannot be laid.
    #[error(transparent)]
    Ballast(#[from] BallastError),
    /// Ballast for an object that need not stand.
    #[error(
        "ballast is laid so that an object stands; remedy: leave `{}` away, or give `{}`",
        Setting::open(Key::Ballast),
        Setting::new(Key::Goal, CoreGoal::Stand)
    )]
    BallastForNothing,
    /// The shell cannot be made.
    #[error(transparent)]
    Cladding(#[from] CladdingError),
    /// A boolean failed.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// A written STL does not read back.
    #[error(transparent)]
    Stl(#[from] StlError),
    /// A written file does not read back.
    #[error(
        "a written part does not read back: {0}; this is a fault of the program, please report it"
    )]
    ReadBack(#[from] ContentError),
    /// The certificate does not hold on the written model.
    #[error("the written model is nearer to the base than its certificate allows")]
    Separation(#[from] SeparationError),
    /// A package cannot be written.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A picture cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A stage that all kits share failed.
    #[error(transparent)]
    Shared(#[from] Error),
    /// The kit cannot be judged.
    #[error(transparent)]
    Verify(#[from] CoreVerifyError),
    /// A file cannot be written as text.
    #[error(transparent)]
    Unwritable(#[from] Unwritable),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
