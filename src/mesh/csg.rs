//! Booleans, plane cuts and simplification of closed meshes: the wrapper around `manifold-rust`.
//! Only `clip` also uses it, to fill flat outlines.

use manifold_rust::{
    linalg::Vec3,
    manifold::Manifold,
    types::{Error, MeshGL64},
};

use super::tri_mesh::smallest_first;
use super::{Defects, MeshError, Solid, TriMesh, bodies::bodies, primitives::cuboid};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Plane, Point, orthonormal_basis};

/// The reason that a boolean, a cut or an import failed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClipError {
    /// The engine refused the mesh, or an operation failed.
    #[error(
        "{operation} failed: {reason}; check that the mesh is closed, finite and free of self-intersection"
    )]
    Engine {
        /// The operation that was tried.
        operation: &'static str,
        /// The error of the engine.
        reason: &'static str,
    },
    /// The cutting plane has a normal that is not of length one, or an offset that is not
    /// finite.
    #[error(
        "the cutting plane is degenerate: its normal must have length one and its offset must be finite"
    )]
    DegeneratePlane,
    /// The result is not a solid.
    #[error("the result of a boolean is not a solid: {0}")]
    NotSolid(#[from] Defects),
    /// The result indexes a vertex that does not exist.
    #[error("the result of a boolean is not a mesh: {0}")]
    NotMesh(#[from] MeshError),
}

/// Tolerance of the squared length of a plane's normal. Rounding leaves 1e-15; a normal that was
/// never normalised is off by far more.
const UNIT_LENGTH_TOLERANCE: f64 = 1e-9;

/// Thickness up to which slivers are closed, mm. They arise when a cutting surface grazes vertices.
/// Below 1e-5 the single precision of a written file folds some of them. Above 6e-5 sheets are
/// merged that the apex of a cone keeps apart.
const SLIVER_MM: f64 = 2e-5;

/// Reach of the box that stands for a half-space, in diagonals of the body. More than half a
/// diagonal on every side keeps its other faces clear of the body.
const HALF_SPACE_RATIO: f64 = 2.0;

/// A closed mesh in the form in which it can be cut and combined.
///
/// May hold several bodies and cavities (shells that face inward). All operations work in `f64`
/// with exact decisions. The volumes of the two sides of a cut add up to about 1e-14 relative. The
/// result is bit-identical for any number of threads.
#[derive(Clone)]
pub struct Csg(Manifold);

impl Csg {
    /// Imports the body bounded by a closed, oriented mesh; shells that face inward are
    /// cavities.
    pub fn of_mesh(mesh: &TriMesh) -> Result<Self, ClipError> {
        let gl = MeshGL64 {
            num_prop: 3,
            vert_properties: mesh
                .vertices()
                .iter()
                .flat_map(|p| [p.x, p.y, p.z])
                .collect(),
            tri_verts: mesh
                .triangles()
                .iter()
                .flatten()
                .map(|&v| u64::from(v))
                .collect(),
            ..MeshGL64::default()
        };
        check_status(Manifold::from_mesh_gl64(&gl), "importing a mesh")
    }

    /// Imports the body bounded by a solid.
    pub fn of_solid(solid: &Solid) -> Result<Self, ClipError> {
        Self::of_mesh(solid.mesh())
    }

    /// Returns the convex hull of the points; empty if they lie in a plane.
    pub fn convex_hull(points: &[Point]) -> Result<Self, ClipError> {
        let points: Vec<Vec3> = points.iter().map(|p| Vec3::new(p.x, p.y, p.z)).collect();
        check_status(Manifold::hull(&points), "taking the convex hull")
    }

    /// Returns the triangles, in an order that depends on the geometry alone.
    pub fn to_mesh(&self) -> Result<TriMesh, ClipError> {
        let gl = self.0.get_mesh_gl64(-1);
        let vertices = gl
            .vert_properties
            .chunks_exact(3)
            .map(|c| [c[0], c[1], c[2]].into())
            .collect();
        let mut triangles: Vec<[u32; 3]> = gl
            .tri_verts
            .chunks_exact(3)
            .map(|t| smallest_first([t[0], t[1], t[2]].map(|v| v as u32)))
            .collect();
        triangles.sort_unstable();
        Ok(TriMesh::new(vertices, triangles)?)
    }

    /// Returns the triangles, proved to bound a solid.
    pub fn to_solid(&self) -> Result<Solid, ClipError> {
        Ok(Solid::new(self.to_mesh()?)?)
    }

    /// Returns the intersection of both bodies.
    pub fn intersect(&self, other: &Self) -> Result<Self, ClipError> {
        check_status(self.0.intersection(&other.0), "intersecting two bodies")
    }

    /// Returns this body without `other`.
    pub fn subtract(&self, other: &Self) -> Result<Self, ClipError> {
        check_status(self.0.difference(&other.0), "subtracting a body")
    }

    /// Returns the union of both bodies.
    pub fn union(&self, other: &Self) -> Result<Self, ClipError> {
        check_status(self.0.union(&other.0), "uniting two bodies")
    }

    /// Returns the parts of the body on the positive and the negative side of `plane`, in this
    /// order. Their caps are flat to about 1e-13 mm. Either part may be empty.
    ///
    /// A plane that coincides with a face may leave a sheet without volume. Keep planes off
    /// faces by about 1e-6 mm and drop components without volume.
    pub fn split_by_plane(&self, plane: &Plane) -> Result<(Self, Self), ClipError> {
        check_plane(plane)?;
        let above = self.half_space(plane)?;
        let (positive, negative) = rayon::join(
            || self.0.intersection(&above.0),
            || self.0.difference(&above.0),
        );
        Ok((
            check_status(positive, "cutting by a plane")?,
            check_status(negative, "cutting by a plane")?,
        ))
    }

    /// Returns a box that contains the part of this body on the positive side of a plane.
    pub(crate) fn half_space(&self, plane: &Plane) -> Result<Self, ClipError> {
        let aabb = self.0.bounding_box();
        let corner = |at: Vec3| Point::new(at.x, at.y, at.z);
        let (low, high) = (corner(aabb.min), corner(aabb.max));
        let reach = HALF_SPACE_RATIO * (high - low).norm().max(f64::MIN_POSITIVE);
        let center = nalgebra::center(&low, &high);
        let foot = center - plane.normal * plane.distance(&center);
        let depth = reach + plane.distance(&center).abs();
        let (u, v) = orthonormal_basis(&plane.normal);
        let unit = cuboid(&Point::new(-1.0, -1.0, 0.0), &Point::new(1.0, 1.0, 1.0));
        Self::of_mesh(
            &unit.map_vertices(|p| {
                foot + (u * p.x + v * p.y) * reach + plane.normal * (p.z * depth)
            }),
        )
    }

    /// Returns the separate bodies, each with its cavities, in the order of their first
    /// triangles.
    pub fn decompose(&self) -> Result<Vec<Self>, ClipError> {
        bodies(&self.to_mesh()?).iter().map(Self::of_mesh).collect()
    }

    /// Simplifies the body: no point of its surface moves by more than about `tolerance_mm`.
    /// Returns it unchanged if fewer triangles would make it intersect itself.
    #[must_use]
    pub fn simplify(&self, tolerance_mm: f64) -> Self {
        self.unless_worse(self.coarsen(tolerance_mm))
    }

    /// Simplifies the body like [`Self::simplify`], until the watch is stopped.
    pub fn simplify_watched(&self, tolerance_mm: f64, watch: &Watch) -> Result<Self, Cancelled> {
        watch.check()?;
        let simple = self.coarsen(tolerance_mm);
        watch.check()?;
        Ok(self.unless_worse(simple))
    }

    /// Returns the simplified body, or this one if the other intersects itself or is lost.
    fn unless_worse(&self, simple: Self) -> Self {
        let worse = simple.0.status() != Error::NoError
            || simple.is_empty() != self.is_empty()
            || simple.has_self_intersections();
        if worse { self.clone() } else { simple }
    }

    /// Simplifies the body for pictures: as [`Self::simplify`], without a check for
    /// self-intersection.
    #[must_use]
    pub fn coarsen(&self, tolerance_mm: f64) -> Self {
        Self(self.0.simplify(tolerance_mm))
    }

    /// Closes the slivers that the rounding of a file would fold. No point of the surface moves
    /// by more than 2e-5 mm.
    #[must_use]
    pub fn without_slivers(&self) -> Self {
        self.simplify(SLIVER_MM)
    }

    /// Closes slivers like [`Self::without_slivers`], until the watch is stopped.
    pub fn without_slivers_watched(&self, watch: &Watch) -> Result<Self, Cancelled> {
        self.simplify_watched(SLIVER_MM, watch)
    }

    /// Returns true if two triangles of the surface cross, overlap or coincide (exact; about 3 µs
    /// for each triangle).
    pub fn has_self_intersections(&self) -> bool {
        self.0.has_self_intersections()
    }

    /// Returns true if the body is empty.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the number of triangles of the surface.
    pub fn triangle_count(&self) -> usize {
        self.0.num_tri()
    }
}

/// Returns an error if a plane's normal is not of length one, or its offset not finite.
pub(super) fn check_plane(plane: &Plane) -> Result<(), ClipError> {
    let n = plane.normal;
    let is_unit = (n.norm_squared() - 1.0).abs() <= UNIT_LENGTH_TOLERANCE;
    if is_unit && plane.offset_mm.is_finite() {
        Ok(())
    } else {
        Err(ClipError::DegeneratePlane)
    }
}

/// Returns the body, or the error if the engine reports one.
fn check_status(body: Manifold, operation: &'static str) -> Result<Csg, ClipError> {
    match body.status() {
        Error::NoError => Ok(Csg(body)),
        error => Err(ClipError::Engine {
            operation,
            reason: error.to_str(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    /// An axis-aligned box as twelve triangles.
    fn cuboid(min: [f64; 3], max: [f64; 3]) -> TriMesh {
        let pick = |i: usize, axis: usize| {
            if i >> axis & 1 == 0 {
                min[axis]
            } else {
                max[axis]
            }
        };
        let vertices = (0..8)
            .map(|i| Point::new(pick(i, 0), pick(i, 1), pick(i, 2)))
            .collect();
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect();
        TriMesh::new(vertices, triangles).unwrap()
    }

    fn unit_box() -> TriMesh {
        cuboid([0.0; 3], [1.0; 3])
    }

    fn body(mesh: &TriMesh) -> Csg {
        Csg::of_mesh(mesh).unwrap()
    }

    fn volume(body: &Csg) -> f64 {
        body.to_solid().unwrap().mesh().signed_volume_mm3()
    }

    // Volumes near 1 of a few dozen triangles: rounding leaves about 1e-15.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn two_half_overlapping_boxes_have_the_volumes_of_their_boolean_combinations() {
        let (a, b) = (
            body(&unit_box()),
            body(&cuboid([0.5, 0.25, 0.25], [1.5, 0.75, 0.75])),
        );
        assert!((volume(&a.intersect(&b).unwrap()) - 0.125).abs() < ROUNDING);
        assert!((volume(&a.subtract(&b).unwrap()) - 0.875).abs() < ROUNDING);
        assert!((volume(&a.union(&b).unwrap()) - 1.125).abs() < ROUNDING);
    }

    #[test]
    fn both_sides_of_a_skew_cut_add_up() {
        let plane = Plane::through(&Point::new(0.4, 0.5, 0.6), &Vector::new(1.0, 2.0, 3.0));
        let (positive, negative) = body(&unit_box()).split_by_plane(&plane).unwrap();
        assert!((volume(&positive) + volume(&negative) - 1.0).abs() < ROUNDING);
        assert!(
            positive
                .to_mesh()
                .unwrap()
                .vertices()
                .iter()
                .all(|v| plane.distance(v) > -ROUNDING)
        );
        assert!(
            negative
                .to_mesh()
                .unwrap()
                .vertices()
                .iter()
                .all(|v| plane.distance(v) < ROUNDING)
        );
    }

    #[test]
    fn a_box_with_a_reversed_box_inside_is_one_body_and_its_halves_are_cups() {
        let hollow = unit_box().joined(&cuboid([0.25; 3], [0.75; 3]).reversed());
        assert_eq!(body(&hollow).decompose().unwrap().len(), 1);
        let plane = Plane {
            normal: Vector::z(),
            offset_mm: 0.5,
        };
        let (top, bottom) = body(&hollow).split_by_plane(&plane).unwrap();
        assert!((volume(&top) - 0.4375).abs() < ROUNDING);
        assert_eq!(bottom.decompose().unwrap().len(), 1);
    }

    #[test]
    fn a_box_nested_in_a_cavity_is_a_second_body() {
        let onion = unit_box()
            .joined(&cuboid([0.2; 3], [0.8; 3]).reversed())
            .joined(&cuboid([0.4; 3], [0.6; 3]));
        let volumes: Vec<f64> = body(&onion)
            .decompose()
            .unwrap()
            .iter()
            .map(volume)
            .collect();
        assert_eq!(volumes.len(), 2);
        assert!(volumes.iter().any(|v| (v - 0.784).abs() < ROUNDING));
        assert!(volumes.iter().any(|v| (v - 0.008).abs() < ROUNDING));
    }

    #[test]
    fn a_plane_beside_the_body_leaves_one_side_empty() {
        let plane = Plane {
            normal: Vector::x(),
            offset_mm: 2.0,
        };
        let (positive, negative) = body(&unit_box()).split_by_plane(&plane).unwrap();
        assert!(positive.is_empty());
        assert_eq!(negative.triangle_count(), 12);
    }

    #[test]
    fn degenerate_planes_and_open_meshes_are_refused_with_a_reason() {
        let cube = body(&unit_box());
        for normal in [
            Vector::zeros(),
            Vector::repeat(f64::NAN),
            Vector::repeat(1.0),
        ] {
            let refused = cube.split_by_plane(&Plane {
                normal,
                offset_mm: 0.0,
            });
            assert_eq!(refused.err(), Some(ClipError::DegeneratePlane));
        }
        let nowhere = Plane {
            normal: Vector::x(),
            offset_mm: f64::INFINITY,
        };
        assert_eq!(
            cube.split_by_plane(&nowhere).err(),
            Some(ClipError::DegeneratePlane)
        );
        let open = TriMesh::new(
            unit_box().vertices().to_vec(),
            unit_box().triangles()[1..].to_vec(),
        );
        assert!(matches!(
            Csg::of_mesh(&open.unwrap()).err(),
            Some(ClipError::Engine { .. })
        ));
    }

    #[test]
    fn a_box_through_the_wall_of_its_copy_intersects_itself_and_a_box_does_not() {
        assert!(!body(&unit_box()).has_self_intersections());
        let crossing = unit_box().joined(&cuboid([0.5; 3], [1.5; 3]));
        assert!(body(&crossing).has_self_intersections());
    }

    #[test]
    fn a_cut_and_a_boolean_give_the_same_bytes_on_one_thread_and_on_two() {
        let run = || {
            let rows = (0..12).map(|i| 0.31 * f64::from(i));
            let comb = rows.map(|x| body(&cuboid([x, 0.1, 0.1], [x + 0.2, 0.9, 0.7])));
            let slab = body(&cuboid([-0.5, 0.3, 0.2], [4.5, 0.6, 0.5]));
            let all = comb.fold(slab, |sum, tooth| sum.union(&tooth).unwrap());
            let plane = Plane::through(&Point::new(1.7, 0.4, 0.4), &Vector::new(0.3, 0.9, 0.2));
            let (positive, negative) = all.split_by_plane(&plane).unwrap();
            (positive.to_mesh().unwrap(), negative.to_mesh().unwrap())
        };
        let on = |threads| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap()
                .install(run)
        };
        assert_eq!(on(1), on(2));
    }
}
