//! A part's surface, as far as it decides its pose.

use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// The kind of surface that a triangle of a part belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// The outside of the model, which is seen.
    Outside,
    /// A hollow that a cut has opened.
    Hollow,
    /// A cut face, or a pin on it.
    CutFace,
}

/// A pin that stands out of a cut face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peg {
    /// Point of its axis on the cut face, mm.
    pub center: Point,
    /// Unit direction in which it stands out.
    pub axis: Vector,
    /// Length, mm.
    pub length_mm: f64,
    /// Diameter, mm.
    pub diameter_mm: f64,
}

impl Peg {
    /// Returns the least height of the pin along `up`, mm.
    pub(super) fn lowest_mm(&self, up: &Vector) -> f64 {
        let rise = self.axis.dot(up);
        let aside = (1.0 - rise * rise).max(0.0).sqrt();
        up.dot(&self.center.coords) + (self.length_mm * rise).min(0.0)
            - 0.5 * self.diameter_mm * aside
    }
}

/// The surface of a part, with the kind of each triangle.
#[derive(Debug, Clone)]
pub struct Shape<'a> {
    /// The surface, closed and turned outward.
    pub(super) mesh: &'a TriMesh,
    /// The unit normals of its triangles; zero for one without area.
    pub(super) normals: Vec<Vector>,
    /// The kinds of its triangles.
    pub(super) sides: Vec<Side>,
    /// The pins that stand out of it.
    pub(super) pegs: Vec<Peg>,
}

impl<'a> Shape<'a> {
    /// Makes the shape of a part; `side` returns the kind of the triangle with this index.
    pub fn new(mesh: &'a TriMesh, pegs: Vec<Peg>, side: impl Fn(usize) -> Side) -> Self {
        let normal = |[a, b, c]: [Point; 3]| {
            let normal = (b - a).cross(&(c - a));
            normal.try_normalize(0.0).unwrap_or_else(Vector::zeros)
        };
        Self {
            mesh,
            normals: mesh.iter_corners().map(normal).collect(),
            sides: (0..mesh.triangles().len()).map(side).collect(),
            pegs,
        }
    }

    /// Makes the shape of a part that is all outside and has no pins.
    pub fn plain(mesh: &'a TriMesh) -> Self {
        Self::new(mesh, Vec::new(), |_| Side::Outside)
    }

    /// Returns whether the part would rest on a pin with `up` pointing up. A pin then reaches as
    /// low as the rest of the part, or less than `room_mm` above.
    pub fn rests_on_peg(&self, up: &Vector, room_mm: f64) -> bool {
        if self.pegs.is_empty() {
            return false;
        }
        let in_peg = |p: &Point| self.pegs.iter().any(|peg| peg.holds(p));
        let bare = self.mesh.vertices().iter().filter(|p| !in_peg(p));
        let floor_mm = bare
            .map(|p| up.dot(&p.coords))
            .fold(f64::INFINITY, f64::min);
        self.pegs
            .iter()
            .any(|peg| peg.lowest_mm(up) < floor_mm + room_mm)
    }
}

/// Distance up to which a vertex belongs to a pin's surface, mm. The file and the polygon that
/// stands for a circle differ from it by less.
const ON_PEG_MM: f64 = 1e-3;

impl Peg {
    /// Returns whether a point of the part's surface belongs to the pin, above its foot.
    fn holds(&self, at: &Point) -> bool {
        let from_base = at - self.center;
        let along = from_base.dot(&self.axis);
        let aside = (from_base - self.axis * along).norm();
        along > ON_PEG_MM
            && along < self.length_mm + ON_PEG_MM
            && aside < 0.5 * self.diameter_mm + ON_PEG_MM
    }
}
