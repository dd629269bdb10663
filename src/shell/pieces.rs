//! Builds the convex pieces whose union is the wall: a slab for each face, and the parts that edges
//! and vertices need beyond.

use rayon::prelude::*;

use super::ball::Ball;
use super::cylinder::Cylinder;
use super::keep::Keep;
use super::links::{self, Edge, Stars};
use super::normal_cone::{self, Need};
use super::piece::Piece;
use super::slab::Reach;
use crate::geom::{Frame, Point, Vector};
use crate::mesh::{Solid, TriMesh};

/// Doubled area of a triangle, over the square of its longest edge, below which its normal is not
/// used. Its edges and vertices get whole cylinders and balls instead. With a smaller limit, a
/// normal is off by more than 1e-16/limit radians. With a larger one, the slab of a triangle up to
/// limit · edge high is missed, which is off by its square.
const SLIVER_RATIO: f64 = 1e-8;
/// Margin, as a share of the wall, by which footprints of cylinders and balls are widened and slabs
/// extended out of the solid. It keeps cracks from opening between pieces by rounding. All of it
/// lies within the wall, so a larger margin costs only time. One smaller than [`normal_cone`]'s
/// tolerance (4e-6) could open cracks.
const MARGIN_RATIO: f64 = 1e-5;

/// The data from which the wall of one solid is built, in the goal frame.
pub(super) struct Builder<'a> {
    mesh: &'a TriMesh,
    normals: Vec<Option<Vector>>,
    wall_mm: f64,
    one_sided: bool,
}

impl<'a> Builder<'a> {
    /// Returns the builder for `mesh`; `one_sided` if the wall need only be right inside the solid.
    pub fn new(mesh: &'a TriMesh, wall_mm: f64, one_sided: bool) -> Self {
        let normals = (0..mesh.triangles().len()).into_par_iter();
        let normals = normals
            .map(|triangle| unit_normal(&mesh.corners(triangle)))
            .collect();
        Self {
            mesh,
            normals,
            wall_mm,
            one_sided,
        }
    }

    /// Returns every piece of the wall of `solid`, whose triangles and vertices are those of the
    /// builder's mesh.
    pub fn pieces(&self, solid: &Solid) -> Vec<Piece> {
        let stars = Stars::new(self.mesh);
        let edges = links::edges(solid);
        let mut pieces: Vec<Piece> = (0..self.normals.len())
            .into_par_iter()
            .filter_map(|triangle| self.face(triangle))
            .collect();
        pieces.par_extend(edges.par_iter().filter_map(|edge| self.edge(edge)));
        let vertices = (0..self.mesh.vertices().len()).into_par_iter();
        pieces.par_extend(vertices.filter_map(|vertex| self.vertex(vertex, stars.of(vertex))));
        pieces
    }

    /// Returns the slab behind a face; `None` for a sliver.
    fn face(&self, triangle: usize) -> Option<Piece> {
        let outward_mm = self.wall_mm * if self.one_sided { MARGIN_RATIO } else { 1.0 };
        let reach = Reach {
            inward_mm: self.wall_mm,
            outward_mm,
        };
        Some(Piece::of_face(
            &self.mesh.corners(triangle),
            &self.normals[triangle]?,
            reach,
        ))
    }

    /// Returns the part of an edge's cylinder that is needed.
    fn edge(&self, edge: &Edge) -> Option<Piece> {
        let [from, to] = edge
            .ends
            .map(|vertex| self.mesh.vertices()[vertex as usize]);
        let cylinder = Cylinder::new(from, to, self.wall_mm)?;
        let need = match edge
            .triangles
            .map(|triangle| self.normals[triangle as usize])
        {
            [Some(first), Some(second)] => {
                normal_cone::of_edge([first, second], &(to - from).normalize(), self.one_sided)
            }
            _ => Need::Whole,
        };
        match need {
            Need::Nothing => None,
            Need::Hull(hull) => Some(Piece::of_cylinder_over(
                cylinder,
                &self.scaled(hull),
                self.margin_mm(),
            )),
            Need::Whole => Some(Piece::of_cylinder(cylinder, self.margin_mm())),
        }
    }

    /// Returns the part of a vertex's ball that is needed.
    fn vertex(&self, vertex: usize, triangles: &[u32]) -> Option<Piece> {
        let ball = Ball::new(self.mesh.vertices()[vertex], self.wall_mm);
        match self.vertex_need(vertex as u32, triangles) {
            Need::Nothing => None,
            Need::Hull(hull) => Some(Piece::of_ball_over(
                ball,
                &self.scaled(hull),
                self.margin_mm(),
            )),
            Need::Whole => Some(Piece::of_ball(ball, self.margin_mm())),
        }
    }

    /// Returns which part of a vertex's ball is needed: all of it beside a sliver, none for a
    /// vertex of no triangle.
    fn vertex_need(&self, vertex: u32, triangles: &[u32]) -> Need {
        let links: Vec<[u32; 2]> = triangles
            .iter()
            .map(|&t| links::others(self.mesh.triangles()[t as usize], vertex))
            .collect();
        let point = self.mesh.vertices()[vertex as usize];
        let towards = |other: u32| (self.mesh.vertices()[other as usize] - point).normalize();
        let mut pseudonormal = Vector::zeros();
        for (&triangle, &[a, b]) in triangles.iter().zip(&links) {
            let Some(normal) = self.normals[triangle as usize] else {
                return Need::Whole;
            };
            pseudonormal += normal * towards(a).angle(&towards(b));
        }
        if links.is_empty() {
            return Need::Nothing;
        }
        let edges: Vec<Vector> = links.iter().map(|link| towards(link[0])).collect();
        let tells_sides = self.one_sided && links::is_one_ring(&links);
        normal_cone::of_vertex(&edges, tells_sides.then_some(&pseudonormal))
    }

    /// Returns vectors for a unit radius, scaled to the wall.
    fn scaled(&self, hull: Vec<Vector>) -> Vec<Vector> {
        hull.into_iter().map(|tip| tip * self.wall_mm).collect()
    }

    /// Returns the margin by which footprints are widened, mm.
    fn margin_mm(&self) -> f64 {
        self.wall_mm * MARGIN_RATIO
    }
}

/// Returns the pieces of a keep-solid region: a ball at each end and the cylinder between.
pub(super) fn pieces_of_keep(keep: &Keep, frame: &Frame) -> impl Iterator<Item = Piece> {
    let (from, to) = (frame.to_local(&keep.from), frame.to_local(&keep.to));
    let between =
        Cylinder::new(from, to, keep.radius_mm).map(|cylinder| Piece::of_cylinder(cylinder, 0.0));
    let ball = |center: Point| Piece::of_ball(Ball::new(center, keep.radius_mm), 0.0);
    [Some(ball(from)), between, (from != to).then(|| ball(to))]
        .into_iter()
        .flatten()
}

/// Returns the outer unit normal of a triangle; `None` for a sliver.
fn unit_normal(corners: &[Point; 3]) -> Option<Vector> {
    let [ab, bc, ca] = [
        corners[1] - corners[0],
        corners[2] - corners[1],
        corners[0] - corners[2],
    ];
    let longest = ab
        .norm_squared()
        .max(bc.norm_squared())
        .max(ca.norm_squared());
    let doubled_area = bc.cross(&ca);
    (doubled_area.norm() > SLIVER_RATIO * longest).then(|| doubled_area.normalize())
}
