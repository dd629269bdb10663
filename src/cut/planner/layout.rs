//! Cuts, the pieces that they leave, and how they open the voids.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        error::CutError,
        geometry::tree::CutTree,
        pieces::{
            rejoin::{Cutting, bridges, rejoined},
            split::{Piece, check_no_cavity},
        },
        plan::Bridge,
        planner::{
            limit::{LimitedCuts, limit_cuts},
            score::Scene,
        },
    },
    geom::Plane,
};

/// Cuts, how they open the voids, and the pieces they leave.
pub(crate) struct Layout {
    pub(crate) tree: CutTree,
    pub(crate) voids: Vec<VoidAccess>,
    pub(crate) pieces: Vec<Piece>,
    pub(crate) bridges: Vec<Bridge>,
}

impl Layout {
    /// The pieces between the cuts, each made only where it is needed, and left joined where a cut
    /// would part them needlessly.
    pub(crate) fn new(
        scene: &Scene,
        planes: Vec<Plane>,
        voids: Vec<VoidAccess>,
    ) -> Result<Self, CutError> {
        let LimitedCuts {
            tree,
            voids,
            pieces: parted,
        } = limit_cuts(scene, &planes, voids)?;
        let cutting = Cutting {
            hollowed: scene.hollowed,
            tree: &tree,
            request: scene.request,
        };
        let bridges = bridges(&cutting, &parted);
        let pieces = rejoined(parted.clone(), &tree, &bridges)?;
        // What stays joined must not seal what the cut opened.
        let (pieces, bridges) = if check_no_cavity(&pieces).is_ok() {
            (pieces, bridges)
        } else {
            (parted, Vec::new())
        };
        Ok(Self {
            tree,
            voids,
            pieces,
            bridges,
        })
    }
}
