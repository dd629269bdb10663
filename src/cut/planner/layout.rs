//! Cuts, the pieces they leave, and the access they give to the voids.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        error::CutError,
        geometry::tree::CutTree,
        pieces::{
            rejoin::{Cutting, find_bridges, rejoin},
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

/// Cuts, the access they give to the voids, and the pieces they leave.
pub(crate) struct Layout {
    pub(crate) tree: CutTree,
    pub(crate) voids: Vec<VoidAccess>,
    pub(crate) pieces: Vec<Piece>,
    pub(crate) bridges: Vec<Bridge>,
}

impl Layout {
    /// Counts the pieces that are below the least part.
    pub(crate) fn count_small(&self, scene: &Scene) -> usize {
        let small = self
            .pieces
            .iter()
            .filter(|piece| self.is_small(scene, piece));
        small.count()
    }

    /// Returns true if a piece has too small a share of the material, or is too short for pins. A
    /// body that is not cut is never too small.
    pub(crate) fn is_small(&self, scene: &Scene, piece: &Piece) -> bool {
        let is_small = |piece: &Piece| {
            let whole_mm3 = scene.volume_mm3;
            scene
                .request
                .is_small_part(piece.volume_mm3, &piece.mesh, whole_mm3)
        };
        self.pieces.len() > 1 && is_small(piece)
    }

    /// Cuts the body, each cut only where it is needed. Pieces that a cut would separate needlessly
    /// stay joined.
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
        let bridges = find_bridges(&cutting, &parted)?;
        let pieces = rejoin(parted.clone(), &tree, &bridges, &scene.request.watch)?;
        // Pieces that stay joined must not seal an opening.
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
