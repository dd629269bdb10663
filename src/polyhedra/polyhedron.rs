//! A convex polyhedron inside a model, with the proof that it is inside.

use super::convex::{Convex, Edge};
use super::ground::Ground;
use super::limits::{Breach, Limits};
use super::separation::{Separation, SeparationError};
use super::side::Side;
use crate::geom::{Aabb, Plane, Point, Vector};
use crate::mesh::{MeshError, TriMesh};

/// A convex polyhedron that keeps a distance from the surface of a model.
///
/// It is made only with its [`Separation`], so one that exists is proved to be inside.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    faces: Vec<Face>,
    corners: Vec<Point>,
    edges: Vec<Edge>,
    volume_mm3: f64,
    separation: Separation,
    breaches: Vec<Breach>,
}

/// A face of a polyhedron, or a plane that only parts it from something.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Its plane; the normal points outward.
    pub plane: Plane,
    /// Its corners as indices, counterclockwise from outside. Empty for a plane that parts two
    /// polyhedra and does not touch this one.
    pub outline: Vec<u32>,
    /// The area, mm²; 0 for an empty outline.
    pub area_mm2: f64,
    /// The centroid of the area; a point of the plane for an empty outline.
    pub centroid: Point,
    /// True if it lies on a plane that parts two polyhedra.
    pub is_locked: bool,
}

/// The reason that planes bound no polyhedron inside a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NotInside {
    /// The planes leave nothing, or bound nothing.
    #[error("the planes bound no body")]
    Unbounded,
    /// The body is outside of the model.
    #[error("the polyhedron is outside of the model")]
    Outside,
    /// The surface comes too near.
    #[error(transparent)]
    Near(#[from] SeparationError),
}

impl Polyhedron {
    /// Builds the polyhedron below the planes and proves that it keeps the distance.
    ///
    /// Breaches of the limits are noted, not refused.
    pub fn new(
        ground: &Ground,
        distance_mm: f64,
        sides: &[Side],
        limits: &Limits,
    ) -> Result<Self, NotInside> {
        let planes: Vec<Plane> = sides.iter().map(|side| side.plane).collect();
        let within = ground.obstacles().aabb();
        let body = Convex::of_planes(&planes, &within).ok_or(NotInside::Unbounded)?;
        if !body.is_bounded() {
            return Err(NotInside::Unbounded);
        }
        let separation = Separation::find(&planes, ground.obstacles(), distance_mm)?;
        let breaches = limits.breaches(&body, &planes);
        let polyhedron = Self::assembled(&body, sides, separation, breaches);
        // With every piece parted, one point tells the side.
        if ground.distance().bvh().winding(&polyhedron.middle()) <= 0 {
            return Err(NotInside::Outside);
        }
        Ok(polyhedron)
    }

    fn assembled(
        body: &Convex,
        sides: &[Side],
        separation: Separation,
        breaches: Vec<Breach>,
    ) -> Self {
        let outlines = body.outlines(sides.len());
        let measures = body.measures(sides.len());
        let mut corners = Vec::new();
        let mut known: Vec<u32> = Vec::new();
        let mut renumber = |corner: u32| match known.iter().position(|&k| k == corner) {
            Some(at) => at as u32,
            None => {
                known.push(corner);
                corners.push(body.at(corner));
                known.len() as u32 - 1
            }
        };
        let faces = sides.iter().zip(outlines).zip(measures);
        let faces = faces.map(|((side, outline), measure)| Face {
            plane: side.plane,
            outline: outline.into_iter().map(&mut renumber).collect(),
            area_mm2: measure.map_or(0.0, |measure| measure.area_mm2),
            centroid: measure.map_or_else(|| side.plane.foot(), |measure| measure.centroid),
            is_locked: side.is_locked,
        });
        Self {
            faces: faces.collect(),
            corners,
            edges: body.edges(),
            volume_mm3: body.volume_mm3(),
            separation,
            breaches,
        }
    }

    /// Returns the faces and the planes that only part; the certificate counts in this order.
    pub fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// Returns the corners.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// Returns the edges, each with the indices of its two faces.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Returns the edges of the polyhedron with all planes moved inward by a distance, mm; empty if
    /// that leaves nothing. Faces keep their indices.
    pub fn edges_inside(&self, by_mm: f64) -> Vec<Edge> {
        let moved = |face: &Face| Plane {
            offset_mm: face.plane.offset_mm - by_mm,
            ..face.plane
        };
        let planes: Vec<Plane> = self.faces.iter().map(moved).collect();
        let body = Convex::of_planes(&planes, &Aabb::of_points(&self.corners));
        body.map_or_else(Vec::new, |body| body.edges())
    }

    /// Returns the volume, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.volume_mm3
    }

    /// Returns the area of all faces, mm².
    pub fn area_mm2(&self) -> f64 {
        self.faces.iter().map(|face| face.area_mm2).sum()
    }

    /// Returns the certificate.
    pub fn separation(&self) -> &Separation {
        &self.separation
    }

    /// Returns the limits that it breaks; empty if it keeps all.
    pub fn breaches(&self) -> &[Breach] {
        &self.breaches
    }

    /// Returns the planes of the faces, in their order.
    pub fn planes(&self) -> Vec<Plane> {
        self.faces.iter().map(|face| face.plane).collect()
    }

    /// Returns the number of faces that have an area.
    pub fn panel_count(&self) -> usize {
        self.faces.iter().filter(|face| face.area_mm2 > 0.0).count()
    }

    /// Returns the corners of a face in space, counterclockwise from outside.
    pub fn outline(&self, face: usize) -> Vec<Point> {
        let outline = &self.faces[face].outline;
        outline
            .iter()
            .map(|&corner| self.corners[corner as usize])
            .collect()
    }

    /// Returns the face that looks down most along a direction.
    pub fn bottom_face(&self, up: &Vector) -> Option<usize> {
        lowest(self.faces.iter().enumerate(), up)
    }

    /// Returns the mean of the corners, a point inside.
    pub fn middle(&self) -> Point {
        let sum: Vector = self.corners.iter().map(|p| p.coords).sum();
        Point::from(sum / self.corners.len().max(1) as f64)
    }

    /// Returns the surface as triangles; every face is a fan about its first corner.
    pub fn mesh(&self) -> Result<TriMesh, MeshError> {
        let fans = self.faces.iter().flat_map(|face| {
            let pairs = face.outline.get(1..).unwrap_or_default().windows(2);
            pairs.map(|pair| [face.outline[0], pair[0], pair[1]])
        });
        TriMesh::new(self.corners.clone(), fans.collect())
    }
}

/// Returns the index of the face with an area that looks down most along a direction.
pub(super) fn lowest<'a>(
    faces: impl Iterator<Item = (usize, &'a Face)>,
    up: &Vector,
) -> Option<usize> {
    let faces = faces.filter(|(_, face)| face.area_mm2 > 0.0);
    let steep = faces.map(|(index, face)| (up.dot(&face.plane.normal), index));
    let lowest = steep.reduce(|a, b| if b.0 < a.0 { b } else { a });
    lowest.map(|(_, index)| index)
}
