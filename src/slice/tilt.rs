//! Trims scaled toolpaths, so that their centre of mass lies where the kit promises it.

use serde::Serialize;

use crate::geom::{Point, Vector};
use crate::mass::Moments;
use crate::verify::PrintedJudgement;

/// A change of what the infill of a part lays: more on one side, and less on the other.
///
/// At x it is 1 + slope · (x − about) times as much. The mass may change a little: it stays if the
/// infill has its own centre at `about`, the centre that is wished.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tilt {
    /// The change along each axis of the model, per mm.
    pub slope_per_mm: [f64; 3],
    /// The place without a change, model frame, mm.
    pub about_mm: [f64; 3],
}

impl Tilt {
    /// Returns the factor on what the infill lays at a place of the model, at least 0.
    pub fn factor(&self, place: &Point) -> f64 {
        let arm = place - Point::from(self.about_mm);
        (1.0 + Vector::from(self.slope_per_mm).dot(&arm)).max(0.0)
    }
}

/// Returns the way from the centre of toolpaths to that of the kit's files, mm; `None` if the
/// plate does not hold all parts.
fn way(judged: &PrintedJudgement) -> Option<Vector> {
    let laid = judged.toolpaths.as_ref()?;
    Some(Point::from(judged.written.center_mm) - Point::from(laid.center_mm))
}

/// Returns how far the centre of toolpaths is beside that of the kit's files, mm; `None` if the
/// plate does not hold all parts.
pub fn off_mm(judged: &PrintedJudgement) -> Option<f64> {
    way(judged).map(|way| way.norm())
}

/// Returns the tilt that brings the centre of scaled toolpaths to that of the kit's files.
///
/// `free` are the moments of what may change, model frame. `tilt` is the change that they have.
///
/// The centre C of all that is laid, of volume V, moves to the wished C₀ if S · slope = V (C₀ − C).
/// S is the second moment about C₀ of what may change. Some of it reaches solid and changes no
/// more, so the search is repeated. `None` if the plate does not hold all parts.
pub fn trim(free: &Moments, judged: &PrintedJudgement, tilt: Option<Tilt>) -> Option<Tilt> {
    let laid_mm3 = judged.toolpaths.as_ref()?.volume_mm3;
    let wished = Point::from(judged.written.center_mm);
    let spread = free.translated(&-wished.coords).second();
    let step = spread.cholesky()?.solve(&(way(judged)? * laid_mm3));
    let so_far = tilt.map(|tilt| Vector::from(tilt.slope_per_mm));
    Some(Tilt {
        slope_per_mm: (so_far.unwrap_or_default() + step).into(),
        about_mm: wished.into(),
    })
}
