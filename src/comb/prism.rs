//! The bodies of air that openings are: prisms around a free cylinder.

use std::f64::consts::{PI, TAU};

use crate::geom::{Point, orthonormal_basis};
use crate::mesh::TriMesh;

/// Sides of an opening. With twelve it is 3.5 % wider at its corners than the free cylinder.
const SIDES: u32 = 12;

/// Returns the radius of the corners of an opening around a free cylinder of this diameter, mm.
pub(super) fn corner_mm(diameter_mm: f64) -> f64 {
    0.5 * diameter_mm / (PI / f64::from(SIDES)).cos()
}

/// Returns the area of an opening, mm².
pub(super) fn area_mm2(diameter_mm: f64) -> f64 {
    let corner_mm = corner_mm(diameter_mm);
    0.5 * f64::from(SIDES) * corner_mm * corner_mm * (TAU / f64::from(SIDES)).sin()
}

/// Returns the corners of an opening about one end of its axis, and those about the other end.
pub(super) fn rims([from, to]: [Point; 2], diameter_mm: f64) -> [Vec<Point>; 2] {
    let axis = (to - from).normalize();
    let (u, v) = orthonormal_basis(&axis);
    let corner_mm = corner_mm(diameter_mm);
    [from, to].map(|middle| {
        let corners = (0..SIDES).map(|side| {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
            middle + (u * cos + v * sin) * corner_mm
        });
        corners.collect()
    })
}

/// Returns an opening between two points as a closed body of air.
pub(super) fn prism(ends: [Point; 2], diameter_mm: f64) -> TriMesh {
    let [low, high] = rims(ends, diameter_mm);
    let corners: Vec<Point> = low.into_iter().chain(high).collect();
    let mut triangles = Vec::new();
    for side in 0..SIDES {
        let next = (side + 1) % SIDES;
        triangles.push([side, next, next + SIDES]);
        triangles.push([side, next + SIDES, side + SIDES]);
        if side > 0 && next > 0 {
            triangles.push([0, next, side]);
            triangles.push([SIDES, side + SIDES, next + SIDES]);
        }
    }
    TriMesh::from_parts(corners, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::Solid;

    #[test]
    fn an_opening_is_a_closed_body_around_its_free_cylinder() {
        let ends = [Point::new(1.0, 2.0, 3.0), Point::new(2.0, 0.0, 7.0)];
        let mesh = prism(ends, 3.0);
        let length_mm = (ends[1] - ends[0]).norm();
        let volume = mesh.signed_volume_mm3();
        assert!(
            (volume - area_mm2(3.0) * length_mm).abs() < 1e-9,
            "{volume}"
        );
        let axis = (ends[1] - ends[0]) / length_mm;
        let solid = Solid::new(mesh).unwrap();
        for corners in solid.mesh().iter_corners() {
            let [a, b, c]: [Vector; 3] = corners.map(|at| at - ends[0]);
            let normal = (b - a).cross(&(c - a)).normalize();
            let is_cap = normal.dot(&axis).abs() > 0.9;
            assert!(is_cap || (normal.dot(&a) - 1.5).abs() < 1e-9);
        }
    }
}
