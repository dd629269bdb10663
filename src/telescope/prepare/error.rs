//! The reasons why a run reaches no answer.

use std::path::PathBuf;

use crate::ballast::BallastError;
use crate::base::setting::{Key, Setting};
use crate::base::toml_text::TextFault;
use crate::base::watch::Cancelled;
use crate::curve::{CurveError, NameError};
use crate::cut::CutError;
use crate::draw::PictureError;
use crate::error::Error;
use crate::io::threemf::PackageError;
use crate::io::{ContentError, LinesError, ReadError, StlError};
use crate::job::JobError;
use crate::job::telescope::{JunctureKind, Stance};
use crate::mesh::{ClipError, Defects};
use crate::printer::{MaterialError, ProfileError, Quantity, WallError};
use crate::repair::NotOneBody;
use crate::skeleton::SkeletonError;
use crate::telescope::error::TelescopeError;
use crate::verify::TelescopeVerifyError;
use crate::wing::Unwritable;

/// A reason why a run could not reach an answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TelescopeRunError {
    /// The file of the curve cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file holds no curve.
    #[error("{}: {fault}", path.display())]
    Lines {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: LinesError,
    },
    /// The file of a model cannot be read.
    #[error("{}: {fault}", path.display())]
    Model {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: Box<ContentError>,
    },
    /// The model bounds no solid.
    #[error("{} is not a solid: {fault}", path.display())]
    NotSolid {
        /// The file.
        path: PathBuf,
        /// The defects.
        fault: Box<Defects>,
    },
    /// The model is not one body.
    #[error("{} is not one body: {fault}", path.display())]
    NotOneBody {
        /// The file.
        path: PathBuf,
        /// The shells, or the places where it crosses itself.
        fault: Box<NotOneBody>,
    },
    /// The skeleton file cannot be used.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// There is no such skeleton.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    /// A foot that pieces of a model do not have.
    #[error(
        "junctures that are pieces of a model get no foot, so `{0}` cannot be promised; remedy: \
         `{ball}`, or leave it out",
        ball = Setting::new(Key::Junctures, JunctureKind::Ball)
    )]
    NoFoot(Setting),
    /// A tip that there is not.
    #[error("there is no tip {tip}; remedy: name one of {}", known.join(", "))]
    NoTip {
        /// The name that was given.
        tip: String,
        /// The tips that there are.
        known: Vec<String>,
    },
    /// A tip that is to be in two places.
    #[error("the tip {0} cannot be in two places; remedy: give one place for each tip")]
    TipTwice(String),
    /// Limbs that are to be printed in place.
    #[error(
        "limbs are glued to junctures, so `{own}` is for a curve alone; remedy: leave it out",
        own = Setting::new(Key::InPlace, true)
    )]
    LimbsInPlace,
    /// Shells of unlike shapes that are to be printed in place.
    #[error(
        "`{given}` gives shells of unlike shapes, whose tails lie in no one plane, so they cannot be \
         printed in each other; remedy: `{remedy}`"
    )]
    UnlikeInPlace {
        /// The setting that was asked.
        given: Setting,
        /// The setting that can be printed.
        remedy: Setting,
    },
    /// A printer that cannot print shells in each other.
    #[error(
        "{printer} cannot print shells in each other: resin or support would stay between them, and \
         its profile has no `{quantity}`; remedy: leave out `{own}`, or choose a printer that lays \
         filament or melts powder",
        own = Setting::new(Key::InPlace, true)
    )]
    NotInPlace {
        /// The printer's id.
        printer: String,
        /// The quantity that its profile lacks.
        quantity: Quantity,
    },
    /// An option of skeletons and models, with a curve.
    #[error("`{0}` is for a skeleton or a model, and a curve has no limbs; remedy: leave it out")]
    OnlyLimbs(Setting),
    /// Junctures of a model, without one.
    #[error(
        "`{0}` cuts junctures from a model, and this input holds none; remedy: give the model \
         itself (STL, OBJ, PLY, 3MF), or `{ball}`",
        ball = Setting::new(Key::Junctures, JunctureKind::Ball)
    )]
    NoModel(Setting),
    /// A limb of one shell.
    #[error(
        "a limb of one shell slides out of nothing; remedy: `{}`, or more",
        Setting::new(Key::Shells, 2)
    )]
    OneShell,
    /// The points make no curve for a telescope.
    #[error("{name}: {fault}")]
    Curve {
        /// The file, or the measures.
        name: String,
        /// The fault.
        fault: CurveError,
    },
    /// The measures name no curve.
    #[error(transparent)]
    Name(#[from] NameError),
    /// The job cannot be read, or its curve has changed.
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
    /// The measures contradict each other.
    #[error(transparent)]
    Measures(#[from] TelescopeError),
    /// A tip that is thicker than the root may be.
    #[error(
        "a tip of {tip_mm:.1} mm in radius is thicker than the root, which may be {root_mm:.1} mm; \
         remedy: make the tip thinner or the root thicker"
    )]
    TipOverRoot {
        /// Radius of the tip, mm.
        tip_mm: f64,
        /// The most that the root may be, mm.
        root_mm: f64,
    },
    /// The ballast cannot be had.
    #[error(transparent)]
    Ballast(#[from] BallastError),
    /// Ballast where there is no pocket for it.
    #[error(
        "`{0}` needs the foot of a telescope with caps; remedy: leave it out, or `{stand}` with a \
         curve whose shells are glued",
        stand = Setting::new(Key::Goal, Stance::Stand)
    )]
    NoPocket(Setting),
    /// A boolean failed.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// A juncture cannot be cut.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A juncture bounds no solid.
    #[error("a juncture is not a solid: {0}")]
    Juncture(#[from] Defects),
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
    Picture(#[from] PictureError),
    /// A stage that all kits share failed.
    #[error(transparent)]
    Shared(#[from] Error),
    /// The kit cannot be judged.
    #[error(transparent)]
    Verify(#[from] TelescopeVerifyError),
    /// A file cannot be written as text.
    #[error(transparent)]
    Unwritable(#[from] Unwritable),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl TelescopeRunError {
    /// Returns whether the caller stopped the run.
    pub(super) fn is_stop(&self) -> bool {
        matches!(
            self,
            Self::Cancelled(_) | Self::Cut(CutError::Cancelled(_)) | Self::Shared(Error::Cancelled)
        )
    }
}
