//! The body to cut, prepared for the planner.

use std::sync::Arc;

use crate::{
    cut::{
        access::chamber::Chamber,
        error::CutError,
        geometry::{
            opening::{Opening, measure_opening},
            tree::CutTree,
        },
        hollowed::{Hollowed, Void},
        pieces::split::{Piece, split_for_trial},
        planner::cover::VoidSet,
        request::PlanRequest,
        seam::clear::ClearBalls,
    },
    geom::Plane,
    mass::moments_of_mesh,
    mesh::TriMesh,
};

/// The body to cut, and the data against which every plane is compared.
pub(crate) struct Scene<'a> {
    pub(crate) hollowed: &'a Hollowed,
    pub(crate) request: &'a PlanRequest,
    /// Surface of the material: the outside and the inverted voids.
    pub(crate) material: Arc<TriMesh>,
    /// The voids, prepared for cutting and line-of-sight tests.
    pub(crate) chambers: Arc<[Chamber<'a>]>,
    /// The balls that no seam enters.
    pub(crate) clear: Arc<ClearBalls>,
    pub(crate) volume_mm3: f64,
    pub(crate) diagonal_mm: f64,
}

impl<'a> Scene<'a> {
    pub(crate) fn new(hollowed: &'a Hollowed, request: &'a PlanRequest) -> Result<Self, CutError> {
        let material = hollowed.to_mesh();
        let chambers = Chamber::all(hollowed, &request.watch)?;
        let volume_mm3 = moments_of_mesh(&material).volume();
        let diagonal_mm = hollowed.outer.mesh().aabb().size().norm();
        // A cut may still move by half a layer.
        let clear = &request.seams.keep_clear;
        let clear = Arc::new(ClearBalls::new(
            clear,
            hollowed.outer.mesh(),
            request.layer_mm,
        ));
        Ok(Self {
            hollowed,
            request,
            material: Arc::new(material),
            chambers: chambers.into(),
            clear,
            volume_mm3,
            diagonal_mm,
        })
    }

    /// Returns the same body for a request that weighs seams differently and is else the same.
    pub(crate) fn weighed<'b>(&self, request: &'b PlanRequest) -> Scene<'b>
    where
        'a: 'b,
    {
        Scene {
            request,
            material: Arc::clone(&self.material),
            chambers: Arc::clone(&self.chambers),
            clear: Arc::clone(&self.clear),
            ..*self
        }
    }

    /// Returns the pieces of the body between the cuts, to be looked at.
    pub(crate) fn split(&self, tree: &CutTree) -> Result<Vec<Piece>, CutError> {
        split_for_trial(&self.material, tree, &self.request.watch)
    }

    /// Estimates the price of a plane's seam and of its slant, in circles about the model of
    /// average weight; 0 if nobody looks at it.
    pub(crate) fn estimate_seam_price(&self, plane: &Plane) -> f64 {
        let look = self.request.seams.skin.as_ref();
        look.map_or(0.0, |skin| {
            skin.estimate_ratio(plane) + skin.slant_price(plane)
        })
    }

    /// Returns the area of a ball's wall with each void's volume, but for a factor, mm².
    pub(crate) fn wall_areas_mm2(&self) -> Vec<f64> {
        let area_mm2 = |void: &Void| void.mesh().signed_volume_mm3().abs().powf(2.0 / 3.0);
        self.hollowed.voids.iter().map(area_mm2).collect()
    }

    /// Returns whether a seam may run where the plane cuts the outside.
    pub(crate) fn allows(&self, plane: &Plane) -> bool {
        let seams = &self.request.seams;
        seams.allows_lie(plane) && seams.keeps_whole(plane) && self.clear.entered(plane).is_none()
    }

    /// Returns the plane's opening into each void of `met`; `None` for voids that it misses.
    pub(crate) fn openings(&self, plane: &Plane, met: VoidSet) -> Vec<Option<Opening>> {
        let voids = self.hollowed.voids.iter().enumerate();
        voids
            .map(|(i, void)| {
                (met >> i & 1 == 1)
                    .then(|| measure_opening(void.mesh(), plane))
                    .flatten()
            })
            .collect()
    }
}
