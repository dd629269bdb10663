//! Obstacles and errors of planning and cutting.

use crate::{
    base::{
        setting::{Key, Setting},
        toml_text::TextFault,
        verdict::Verdict,
        watch::Cancelled,
    },
    cut::{
        ids::{CutId, PartId, PinId, VoidId},
        seam::clear::KeepClear,
    },
    mesh::ClipError,
};

/// The reason why a body has no plan, or a plan no parts: an answer, not a failure.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Obstacle {
    /// No plane of the family opens these voids wide enough.
    #[error(
        "no plane opens void {} wide enough: the widest opening found is {widest_mm:.2} mm, asked are {needed_mm:.2} mm; {}",
        list(voids),
        remedy_for_closed(*is_free)
    )]
    Unopenable {
        /// The voids.
        voids: Vec<VoidId>,
        /// The widest opening found for the worst of them, mm.
        widest_mm: f64,
        /// The required opening, mm.
        needed_mm: f64,
        /// False if planes were left out because of where their seams run.
        is_free: bool,
    },
    /// A part would enclose a cavity.
    #[error(
        "the cuts leave {cavities} of its voids closed in a part ({part}); add a cut through them, or leave the cuts to the planner (`{}`)",
        Setting::new(Key::Cut, "auto")
    )]
    ClosedCavity {
        /// The part.
        part: PartId,
        /// The number of cavities.
        cavities: usize,
    },
    /// The seam of an ordered cut enters a ball that is to be kept clear.
    #[error(
        "the seam of cut {cut} enters the ball {ball} (X,Y,Z,R, mm) that is to be kept clear; move the cut, or leave out this `{}`",
        Setting::open(Key::KeepClear)
    )]
    SeamInBall {
        /// The cut's id.
        cut: CutId,
        /// The ball.
        ball: KeepClear,
    },
    /// A pin of the plan does not stand on a cut face.
    #[error(
        "pin {pin} does not stand between two cut faces; move it or drop it from the plan; without any pins in it they are placed anew"
    )]
    PinOffFace {
        /// The pin's id.
        pin: PinId,
    },
}

/// The reason why planning or cutting failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CutError {
    /// A length of the request is not positive or not finite.
    #[error("{name} is {value}, but must be a positive number")]
    BadRequest {
        /// The field of the request.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// There are more voids than a plan can tell apart.
    #[error("there are {voids} voids, but a plan handles at most {limit}; fill the smallest")]
    TooManyVoids {
        /// The number of voids.
        voids: usize,
        /// The greatest number that a plan handles.
        limit: usize,
    },
    /// A cut of the plan has a normal without length or a point that is not finite.
    #[error(
        "cut {cut} is degenerate: its normal must have a length and all its numbers must be finite"
    )]
    DegenerateCut {
        /// The cut's id.
        cut: CutId,
    },
    /// Cuts that limit each other, a cut limited to both sides of another, or a limit to a cut that
    /// is not in the plan.
    #[error(
        "a cut is kept to a side of a missing cut, or to both sides of one, or two cuts wait for each other. Name in `within` one side of cuts that can be made before"
    )]
    CircularCuts,
    /// There is no plan or there are no parts, but the caller needs them.
    #[error(transparent)]
    Obstacle(#[from] Obstacle),
    /// The catalogue of rods cannot be read.
    #[error(transparent)]
    Rods(#[from] TextFault),
    /// A boolean operation failed.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Returns the remedy for a void that no plane opens.
fn remedy_for_closed(is_free: bool) -> String {
    if is_free {
        return "fill the void or accept a smaller opening".to_owned();
    }
    format!(
        "the planes whose seams may run there do not; make the balls of `{}` smaller, or `{}`",
        Setting::open(Key::KeepClear),
        Setting::new(Key::Seam, "hidden")
    )
}

/// Joins the ids with commas.
fn list(voids: &[VoidId]) -> String {
    let ids: Vec<String> = voids.iter().map(VoidId::to_string).collect();
    ids.join(", ")
}

/// Turns an obstacle into the answer no; other errors stay errors.
pub(crate) fn verdict<T>(result: Result<T, CutError>) -> Result<Verdict<T, Obstacle>, CutError> {
    match result {
        Ok(found) => Ok(Verdict::Found(found)),
        Err(CutError::Obstacle(why)) => Ok(Verdict::No(why)),
        Err(error) => Err(error),
    }
}
