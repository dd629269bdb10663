//! Shells that are printed in each other: how they lie, and what the shop is told.

use super::asked::Asked;
use super::poses::{Laid, Lies, lay_down};
use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::printer::{Support, Sure};
use crate::telescope::nest::Telescope;

/// The most by which a shell may bend in place, rad: beyond it the mouth comes down to the tail.
const MOST_BEND_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Bend from which the sheet tells by how much cones hang over, rad: one degree.
const TOLD_BEND_RAD: f64 = 0.017_453;

/// Lean of the cones of flange, lip and ring, degrees.
const CONE_DEG: f64 = 45.0;

/// Returns by how much the shells bend and by how much they may, degrees, if that is too much to
/// be printed in place.
pub fn find_overhang(asked: &Asked, telescope: &Telescope) -> Option<[f64; 2]> {
    if !telescope.sizes.is_in_place() {
        return None;
    }
    let most_rad = asked.steepest_rad().min(MOST_BEND_RAD);
    let bend_rad = bend_rad(telescope);
    (bend_rad > most_rad).then(|| [bend_rad, most_rad].map(f64::to_degrees))
}

/// Returns by how much the shells bend from tail to mouth, rad.
fn bend_rad(telescope: &Telescope) -> f64 {
    let [tail_mm, mouth_mm] = telescope.ends_mm();
    telescope.shells[0].helix.curvature * (mouth_mm - tail_mm)
}

/// Lays all shells down in each other, on their tails. `root` is the root's mesh.
pub fn lay_nested(telescope: &Telescope, root: &TriMesh) -> Laid {
    let [tail_mm, _] = telescope.ends_mm();
    let tail = telescope.shells[0].helix.frame_at(tail_mm);
    let ahead: Vector = tail.axes.column(0).into();
    Laid {
        pose: lay_down(root, &-ahead),
        lies: Lies::InPlace,
    }
}

/// Returns the warnings of a telescope that is printed in place.
pub fn warnings(asked: &Asked, telescope: &Telescope) -> Vec<String> {
    if !telescope.sizes.is_in_place() {
        return Vec::new();
    }
    let untried = (asked.slide.sure != Sure::Measured).then(|| {
        format!(
            "The clearance of {} mm in place was never tried on this machine. Print the two \
             innermost shells alone first, in each other, and try if they come free.",
            asked.slide.value
        )
    });
    let bend_rad = bend_rad(telescope);
    let hangs = asked.shop.printer.support == Support::Breakaway && bend_rad > TOLD_BEND_RAD;
    let hangs = hangs.then(|| {
        format!(
            "The shells bend by {:.0}°. On the inside of the bend their cones hang over by {:.0}°: \
             look at a first print there.",
            bend_rad.to_degrees(),
            CONE_DEG + bend_rad.to_degrees()
        )
    });
    untried.into_iter().chain(hangs).collect()
}
