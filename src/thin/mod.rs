//! Thin features: what of a model is thinner than a printer can print.
//!
//! The model is opened by a ball as wide as the least wall: only what some such ball inside the
//! model covers will print. Points spread over the surface stand for it. The greatest ball that
//! touches the surface from inside at a point is found by shrinking (J. Ma, S. W. Bae, S. Choi,
//! "3D medial axis point approximation using nearest neighbors and the normal field", The Visual
//! Computer 28, 2012). A point whose ball is narrower than the wall is thin. Near edges and corners
//! every body is thin; a feature is thin as a whole if it stands away from all that is not.
//!
//! * `medial`: the points, and their balls
//!
//! * `places`: the features and necks that the thin points form
//!
//! * `thicken`: the model with its thin features as thick as the wall

mod medial;
mod places;
#[cfg(test)]
mod tests;
mod thicken;

use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{TriMesh, bodies};
use medial::Touched;
use places::{Widths, sort};

pub use places::{LEAST_LENGTH_WALLS, ThinPlace};
pub use thicken::{ThickenError, Thickened, thicken};

/// A thin end that is longer than this many walls is reported.
const LEAST_TOLD_WALLS: f64 = 1.0;

/// The thin features of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct ThinFeatures {
    /// The width below which a feature is thin, mm.
    pub wall_mm: f64,
    /// The features that are lost: longer than three walls, the longest first.
    pub lost: Vec<ThinPlace>,
    /// The ends that come out shorter: longer than one wall, the longest first.
    pub ends: Vec<ThinPlace>,
    /// The pieces that only thin necks join to the rest, the largest first.
    pub necks: Vec<ThinPlace>,
}

/// Finds what of the bodies of a closed mesh is thinner than a wall.
///
/// A feature's length is right to about a wall. Necks shorter than two walls may be missed. Takes
/// about a second. The answer is the same for any number of threads.
///
/// # Errors
/// The watch was stopped.
pub fn find_thin(mesh: &TriMesh, wall_mm: f64, watch: &Watch) -> Result<ThinFeatures, Cancelled> {
    let mut found = ThinFeatures {
        wall_mm,
        lost: Vec::new(),
        ends: Vec::new(),
        necks: Vec::new(),
    };
    for body in bodies(mesh) {
        let touched = Touched::of(&body, wall_mm, watch)?;
        watch.check()?;
        let widths = Widths::of(&touched, wall_mm);
        for place in widths.features() {
            if place.length_mm > LEAST_LENGTH_WALLS * wall_mm {
                found.lost.push(place);
            } else if place.length_mm > LEAST_TOLD_WALLS * wall_mm {
                found.ends.push(place);
            }
        }
        found.necks.extend(widths.necks());
    }
    for places in [&mut found.lost, &mut found.ends, &mut found.necks] {
        sort(places);
    }
    Ok(found)
}
