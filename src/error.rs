//! The union of the stages' errors.

mod drain;
mod graded;
mod inner_cells;
mod sliced;

use std::path::PathBuf;

pub use drain::DrainError;
pub use graded::GradedError;
pub use inner_cells::CellsError;
pub use sliced::SlicedError;

use crate::ballast::{BallastError, Order};
use crate::base::setting::{Key, Setting};
use crate::base::watch::Cancelled;
use crate::cut::CutError;
use crate::draw::PictureError;
use crate::goal::GoalError;
use crate::hardware::FitError;
use crate::interior::BuildError;
use crate::io::threemf::PackageError;
use crate::io::{ContentError, ReadError, StlError};
use crate::job::{Filling, JobError};
use crate::kit::KitError;
use crate::mend::MendError;
use crate::mesh::{ClipError, Defects};
use crate::printer::{MaterialError, ProfileError, SizeError, WallError};
use crate::repair::NotOneBody;
use crate::sheet::ChecklistError;
use crate::shell::ShellError;
use crate::slice::SliceError;
use crate::slicer::SlicerError;
use crate::thin::ThickenError;
use crate::verify::{PrintedError, VerifyError};
use crate::voids::VoidError;

/// A reason why a run could not reach an answer. An unmet goal is an answer, not an error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The model cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The model does not bound a solid.
    #[error("{} does not bound a solid{}", path.display(), or_redraw(source))]
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
    /// The model cannot be mended as ordered.
    #[error("{} cannot be repaired as ordered", path.display())]
    Mend {
        /// The model's file.
        path: PathBuf,
        /// The reason.
        source: Box<MendError>,
    },
    /// The slicer gives no figures.
    #[error(transparent)]
    Slicer(#[from] SlicerError),
    /// The job cannot be read, or its model has changed.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The printer has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The wall cannot be printed.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// The model is too small or too long.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The model cannot be thickened.
    #[error(transparent)]
    Thicken(ThickenError),
    /// The goal cannot be placed on the model.
    #[error(transparent)]
    Goal(#[from] GoalError),
    /// The hardware cannot be put in.
    #[error(transparent)]
    Hardware(#[from] FitError),
    /// The shell cannot be built.
    #[error(transparent)]
    Shell(#[from] ShellError),
    /// The columns cannot be built.
    #[error(transparent)]
    Columns(BuildError),
    /// The order for ballast cannot be processed.
    #[error(transparent)]
    Ballast(BallastError),
    /// The ballast that was ordered does not fit.
    #[error(
        "`{}` has no room inside; remedy: order fewer or smaller parts, or none",
        Setting::new(Key::Ballast, order)
    )]
    NoRoomForBallast {
        /// The order.
        order: Order,
    },
    /// The filling changes nothing.
    #[error(
        "a filling of {fill} g/cm³ is as dense as the print, {density_g_cm3} g/cm³; remedy: take \
         a lighter or a denser one, or none"
    )]
    FillLikePrint {
        /// The filling asked for.
        fill: Filling,
        /// The print's density, g/cm³.
        density_g_cm3: f64,
    },
    /// A filling and ballast were both ordered.
    #[error(
        "`{}` and `{}` do not go together; remedy: leave one of them out",
        Setting::new(Key::Fill, fill),
        Setting::new(Key::Ballast, order)
    )]
    FillAndBallast {
        /// The filling.
        fill: Filling,
        /// The ballast.
        order: Order,
    },
    /// A heavy filling was ordered for a rotor, which keeps as much material as it can.
    #[error(
        "`{}` is heavier than the print, and a rotor keeps as much mass as it can; remedy: add \
         ballast (`{}`)",
        Setting::new(Key::Fill, fill),
        Setting::new(Key::Ballast, Order::Auto)
    )]
    HeavyFillInRotor {
        /// The filling.
        fill: Filling,
    },
    /// The print cannot be graded.
    #[error(transparent)]
    Graded(#[from] GradedError),
    /// The inside is not made of cells.
    #[error(transparent)]
    Cells(CellsError),
    /// The uncut piece gets no drain holes.
    #[error(transparent)]
    Drain(#[from] DrainError),
    /// A kit is not sliced, or its rounds are refused.
    #[error(transparent)]
    Sliced(#[from] SlicedError),
    /// The surface of the voids cannot be made.
    #[error(transparent)]
    Voids(VoidError),
    /// A boolean failed.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// The cuts or the parts cannot be made.
    #[error(transparent)]
    Cut(CutError),
    /// A written STL does not read back.
    #[error(transparent)]
    Stl(#[from] StlError),
    /// A written file does not read back.
    #[error(
        "a written part does not read back: {0}; this is a fault of the program, please report it"
    )]
    ReadBack(#[from] ContentError),
    /// A package cannot be written.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A picture cannot be drawn.
    #[error(transparent)]
    Picture(PictureError),
    /// The checklist cannot be written.
    #[error(transparent)]
    Checklist(#[from] ChecklistError),
    /// The kit cannot be written.
    #[error(transparent)]
    Kit(KitError),
    /// A kit cannot be judged.
    #[error(transparent)]
    Verify(VerifyError),
    /// A kit cannot be sliced.
    #[error(transparent)]
    Slice(SliceError),
    /// The toolpaths of a kit cannot be judged.
    #[error(transparent)]
    Printed(PrintedError),
    /// The caller stopped the run.
    #[error("stopped before the end")]
    Cancelled,
}

/// Returns the remedy to let a new surface be drawn, if that leaves no defect.
fn or_redraw(defects: &Defects) -> String {
    if defects.can_draw_over() {
        let order = Setting::new(Key::Repair, "remesh");
        format!("; remedy: let a new surface be drawn around it (`{order}`), or mend it by hand")
    } else {
        String::new()
    }
}

impl From<Cancelled> for Error {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl From<CellsError> for Error {
    fn from(error: CellsError) -> Self {
        match error {
            CellsError::Comb(error) if error.is_stop() => Self::Cancelled,
            error => Self::Cells(error),
        }
    }
}

/// Converts the errors of rooms that a caller can stop. However deep a run was stopped, the error
/// says so.
macro_rules! from_stoppable {
    ($($error:ident => $variant:ident),*) => {$(
        impl From<$error> for Error {
            fn from(error: $error) -> Self {
                match error {
                    $error::Cancelled(cancelled) => cancelled.into(),
                    error => Self::$variant(error),
                }
            }
        }
    )*};
}

from_stoppable! {
    BallastError => Ballast,
    BuildError => Columns,
    CutError => Cut,
    KitError => Kit,
    PictureError => Picture,
    PrintedError => Printed,
    SliceError => Slice,
    ThickenError => Thicken,
    VerifyError => Verify,
    VoidError => Voids
}
