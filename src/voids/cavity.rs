//! The cavity of a model, and the voids that a quadric cuts out of it.

use super::coarsen::coarsen;
use super::error::VoidError;
use super::offset::{CavitySpec, draw_offset_surface};
use super::region::{Canvas, Region, positive_region};
use super::split::{Voids, split_into_voids};
use crate::base::watch::Watch;
use crate::geom::{Aabb, Bvh, Frame, Point, Quadric};
use crate::mesh::{Csg, MeshDistance, Solid, TriMesh, bodies, primitives};
use crate::repair::unfold;

/// Tolerance of quadrics in a coarse cavity, in strays of its surface. They are drawn within half
/// of it, and far from any wall.
const QUADRIC_STRAYS: f64 = 3.0;

/// The cavity: the whole region that may be emptied.
///
/// It depends on the model, the wall and the keeps, but not on a quadric; so it is extracted once
/// and cut many times. Its surface is closed, 2-manifold and free of self-intersection. It keeps
/// the wall and the keeps within 0.009 mm, measured between triangles. It strays from the true
/// surface by more than the tolerance only at sharp outward creases, where it stays inside.
#[derive(Clone)]
pub struct Cavity {
    body: Csg,
    mesh: TriMesh,
    bvh: Bvh,
    quadric_tolerance_mm: f64,
    min_void_mm: f64,
}

impl Cavity {
    /// Extracts the region of `solid` that lies deeper than the wall and outside the keeps. The
    /// cavity may be empty.
    pub fn extract(solid: &Solid, spec: &CavitySpec, watch: &Watch) -> Result<Self, VoidError> {
        for (name, value_mm) in [
            ("the wall", spec.wall_mm),
            ("the tolerance", spec.tolerance_mm),
        ] {
            if !(value_mm > 0.0 && value_mm.is_finite()) {
                return Err(VoidError::NotPositive { name, value_mm });
            }
        }
        let mesh = draw_offset_surface(solid, spec, watch)?;
        watch.check()?;
        let (body, bvh) = rayon::join(|| Csg::of_mesh(&mesh), || Bvh::new(mesh.iter_corners()));
        Ok(Self {
            body: body?,
            bvh,
            mesh,
            quadric_tolerance_mm: spec.quadric_tolerance_mm,
            min_void_mm: spec.min_void_mm,
        })
    }

    /// Returns the surface, oriented outward as a body of air. It has no triangles if the wall
    /// leaves nothing.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// Returns the union of the cavity's parts near the given points.
    ///
    /// Each place is a point and a box. Of the bodies of the cavity inside the box, the one that
    /// holds the point is taken, or else the nearest one. The mesh is empty if the cavity reaches
    /// into none of the boxes.
    pub fn parts_near(&self, places: &[(Point, Aabb)]) -> Result<TriMesh, VoidError> {
        let mut all = Csg::of_mesh(&TriMesh::default())?;
        for (at, within) in places {
            let within = Csg::of_mesh(&primitives::cuboid(&within.min, &within.max))?;
            let parts = bodies(&self.body.intersect(&within)?.to_mesh()?).into_iter();
            let with_depths = parts.map(|part| (MeshDistance::new(&part).signed(at), part));
            if let Some((_, part)) = with_depths.max_by(|a, b| a.0.total_cmp(&b.0)) {
                all = all.union(&Csg::of_mesh(&part)?)?;
            }
        }
        Ok(all.to_mesh()?)
    }

    /// Returns the voids: the parts of the cavity in which `quadric` is positive.
    ///
    /// The quadric is given in `frame`; the voids come in model coordinates, the largest first.
    /// Material that would float loose in a void is emptied with it. On the quadric a void's
    /// surface is true within half the tolerance. Elsewhere it is the cavity's own surface, so it
    /// keeps the wall as the cavity does.
    pub fn void_bodies(
        &self,
        quadric: &Quadric,
        frame: &Frame,
        watch: &Watch,
    ) -> Result<Voids, VoidError> {
        let parts = self.region(quadric, frame, watch)?;
        split_into_voids(&parts, self.min_void_mm, watch)
    }

    /// Returns all of the cavity in which `quadric` is positive, as voids are drawn, in model
    /// coordinates. Nothing is too small, and cores within it stay what they are: they do not float
    /// where infill is laid.
    pub fn region(
        &self,
        quadric: &Quadric,
        frame: &Frame,
        watch: &Watch,
    ) -> Result<TriMesh, VoidError> {
        let canvas = Canvas {
            body: &self.bvh,
            tolerance_mm: self.quadric_tolerance_mm,
            watch,
        };
        Ok(match positive_region(quadric, frame, canvas)? {
            Region::Nothing => TriMesh::default(),
            Region::Everything => self.mesh.clone(),
            Region::Part(region) => self.body.intersect(&region)?.to_mesh()?,
        })
    }

    /// Returns all of the cavity inside a closed body, as [`Self::region`] does for a quadric.
    pub fn region_within(&self, body: &TriMesh) -> Result<TriMesh, VoidError> {
        Ok(self.body.intersect(&Csg::of_mesh(body)?)?.to_mesh()?)
    }

    /// Returns the voids inside a closed body, as [`Self::void_bodies`] does for a quadric.
    pub fn void_bodies_within(&self, body: &TriMesh, watch: &Watch) -> Result<Voids, VoidError> {
        split_into_voids(&self.region_within(body)?, self.min_void_mm, watch)
    }

    /// Returns the cavity with a coarse surface, which strays by at most `stray_mm` more. It is for
    /// a search: its wall is not kept.
    pub fn coarsened(&self, stray_mm: f64, watch: &Watch) -> Result<Self, VoidError> {
        let mesh = coarsen(&self.mesh, stray_mm, watch)?;
        Ok(Self {
            body: Csg::of_mesh(&mesh)?,
            bvh: Bvh::new(mesh.iter_corners()),
            mesh,
            quadric_tolerance_mm: self.quadric_tolerance_mm.max(QUADRIC_STRAYS * stray_mm),
            ..*self
        })
    }

    /// Returns the cavity less `solid`: one body, or several whose surfaces do not touch. The wall
    /// is kept as before.
    pub fn without(&self, solid: &TriMesh) -> Result<Self, VoidError> {
        let body = self.body.subtract(&Csg::of_mesh(solid)?)?;
        let mesh = body.to_mesh()?;
        Ok(Self {
            body,
            bvh: Bvh::new(mesh.iter_corners()),
            mesh,
            ..*self
        })
    }
}

/// Returns the void without the slivers that the rounding of a file would fold.
///
/// Slivers are collapsed; folds that are left are mended by [`unfold`]. No point of the surface
/// moves by more than 2e-5 mm, except at those folds.
pub fn without_slivers(void: &Solid, watch: &Watch) -> Result<Solid, VoidError> {
    watch.check()?;
    let body = Csg::of_solid(void)?;
    let simple = body.without_slivers_watched(watch)?.to_mesh()?;
    watch.check()?;
    Ok(Solid::new(unfold(&simple, watch)?)?)
}
