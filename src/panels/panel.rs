//! A panel: a plane piece of sheet with its place in the model.

use super::Outline;
use crate::geom::{Frame, Point};
use crate::mesh::{TriMesh, ear_clip};

/// A round hole through a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    /// Its middle in the panel's frame, mm.
    pub at_mm: [f64; 2],
    /// The diameter, mm.
    pub diameter_mm: f64,
}

/// A panel of a base.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The index of its face of the polyhedron.
    pub face: usize,
    /// Its place: the outer side lies in the plane z = 0, and z points out of the base.
    pub frame: Frame,
    /// The thickness, mm.
    pub sheet_mm: f64,
    /// The outline, seen from outside, mm.
    pub outline: Outline,
    /// The holes.
    pub holes: Vec<Hole>,
}

impl Panel {
    /// Returns a point of the panel in the model: from outside at z = 0 to inside at z = −1
    /// thickness.
    pub fn at(&self, [x, y]: [f64; 2], depth: f64) -> Point {
        self.frame
            .to_model(&Point::new(x, y, -depth * self.sheet_mm))
    }

    /// Returns the panel as a body in its place in the model, without its holes.
    pub fn body(&self) -> TriMesh {
        prism(self.outline.corners(), |at, depth| self.at(at, depth))
    }

    /// Returns the outline as it is seen from inside: so a panel lies on its sheet, its inner face
    /// up.
    pub fn inner_outline(&self) -> Outline {
        let corners = self.outline.corners().iter().rev();
        let mirrored = Outline::new(corners.map(|at| seen_inside(*at)));
        mirrored.unwrap_or_else(|| self.outline.clone())
    }

    /// Returns the volume with its holes, mm³.
    pub fn volume_mm3(&self) -> f64 {
        let hole = |hole: &Hole| std::f64::consts::FRAC_PI_4 * hole.diameter_mm.powi(2);
        let holes_mm2: f64 = self.holes.iter().map(hole).sum();
        (self.outline.area_mm2() - holes_mm2) * self.sheet_mm
    }
}

/// Returns a point of a panel's frame as it is seen from inside: x runs the other way.
pub(super) fn seen_inside([x, y]: [f64; 2]) -> [f64; 2] {
    [-x, y]
}

/// Returns a point in a panel's frame, without its height, mm.
pub(super) fn flat(frame: &Frame, point: &Point) -> [f64; 2] {
    let local = frame.to_local(point);
    [local.x, local.y]
}

/// Returns the body between two copies of a counterclockwise ring. `place` gives the place of a
/// corner at a depth of 0, where the ring is seen from outside, and of 1.
pub(super) fn prism(corners: &[[f64; 2]], place: impl Fn([f64; 2], f64) -> Point) -> TriMesh {
    let count = corners.len() as u32;
    let on = |depth: f64| corners.iter().map(move |at| (*at, depth));
    let points = on(0.0).chain(on(1.0)).map(|(at, depth)| place(at, depth));
    let points: Vec<Point> = points.collect();
    let mut triangles = Vec::new();
    for [a, b, c] in ear_clip(&points, &(0..count).collect::<Vec<u32>>()) {
        triangles.push([a, b, c]);
        triangles.push([count + a, count + c, count + b]);
    }
    for from in 0..count {
        let to = (from + 1) % count;
        triangles.push([from, count + from, count + to]);
        triangles.push([from, count + to, to]);
    }
    TriMesh::from_parts(points, triangles)
}
