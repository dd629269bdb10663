//! Signed boundaries of regions, and their cuts by planes.

use crate::geom::{Aabb, Plane, Point};
use crate::mesh::primitives;

/// A triangle, its corners counter-clockwise as seen from outside.
pub type Corners = [Point; 3];

/// The boundary of a region as a chain of signed triangles.
///
/// Triangles may overlap: those that run the other way count as less. All integrals over the region
/// are sums over the triangles. So nobody triangulates what a cut lays bare: triangles from one of
/// its points to every edge close it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chain {
    triangles: Vec<Corners>,
}

impl Chain {
    /// Makes the boundary of a region from closed triangles.
    pub fn new(triangles: Vec<Corners>) -> Self {
        Self { triangles }
    }

    /// Makes the boundary of a box. Each two triangles after another are a side.
    pub fn of_box(room: &Aabb) -> Self {
        let mesh = primitives::cuboid(&room.min, &room.max);
        Self::new(mesh.iter_corners().collect())
    }

    /// Returns the triangles.
    pub fn triangles(&self) -> &[Corners] {
        &self.triangles
    }

    /// Returns the triangles, and gives the chain up.
    pub fn into_triangles(self) -> Vec<Corners> {
        self.triangles
    }

    /// Returns true if a point lies in the region, by the solid angles of the triangles.
    pub fn holds(&self, at: &Point) -> bool {
        let angles = self.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| corner - at);
            let [long_a, long_b, long_c] = [a.norm(), b.norm(), c.norm()];
            let above = a.cross(&b).dot(&c);
            let below = long_a * long_b * long_c
                + a.dot(&b) * long_c
                + b.dot(&c) * long_a
                + c.dot(&a) * long_b;
            2.0 * above.atan2(below)
        });
        angles.sum::<f64>() > 2.0 * std::f64::consts::PI
    }

    /// Returns true if the region is empty.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Returns the volume of the region, mm³.
    pub fn volume_mm3(&self) -> f64 {
        let Some([apex, ..]) = self.triangles.first() else {
            return 0.0;
        };
        let cones = self.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|corner| corner - apex);
            a.cross(&b).dot(&c)
        });
        cones.sum::<f64>() / 6.0
    }

    /// Returns the part of the region below a plane, where normal·x is smaller.
    #[must_use]
    pub fn below(&self, plane: &Plane) -> Self {
        let mut kept = Vec::with_capacity(self.triangles.len() + 8);
        let mut edges: Vec<[Point; 2]> = Vec::new();
        for corners in &self.triangles {
            clip(corners, plane, &mut kept, &mut edges);
        }
        kept.extend(cap(&edges));
        Self::new(kept)
    }

    /// Returns the box around the triangles; an empty one for an empty region.
    pub fn bounds(&self) -> Aabb {
        Aabb::of_points(self.triangles.iter().flatten())
    }

    /// Returns the region with every corner moved by a map that keeps straight lines straight.
    #[must_use]
    pub fn mapped(&self, map: impl Fn(&Point) -> Point) -> Self {
        let moved = self
            .triangles
            .iter()
            .map(|corners| corners.map(|c| map(&c)));
        Self::new(moved.collect())
    }
}

/// Returns true unless two corners of a triangle are the same point.
fn has_area([a, b, c]: &Corners) -> bool {
    a != b && b != c && c != a
}

/// Closes what a cut lays bare, by triangles from a point of it to every edge.
pub(super) fn cap(edges: &[[Point; 2]]) -> impl Iterator<Item = Corners> {
    let apex = edges.first().map_or(Point::origin(), |edge| edge[0]);
    let fan = edges.iter().map(move |&[from, to]| [apex, to, from]);
    fan.filter(has_area)
}

/// Cuts a triangle: what is below the plane goes to `kept`, the edge along the plane to `edges`.
pub(super) fn clip(
    corners: &Corners,
    plane: &Plane,
    kept: &mut Vec<Corners>,
    edges: &mut Vec<[Point; 2]>,
) {
    let heights = corners.map(|corner| plane.distance(&corner));
    let is_above = heights.map(|height| height > 0.0);
    match is_above {
        [false, false, false] => kept.push(*corners),
        [true, true, true] => {}
        _ => {
            // Turned so that the first corner alone is on its side.
            let first = (0..3)
                .find(|&k| {
                    is_above[k] != is_above[(k + 1) % 3] && is_above[k] != is_above[(k + 2) % 3]
                })
                .unwrap_or_default();
            let [i, j, k] = [first, (first + 1) % 3, (first + 2) % 3];
            let toward_j = cross([corners[i], corners[j]], [heights[i], heights[j]]);
            let toward_k = cross([corners[i], corners[k]], [heights[i], heights[k]]);
            let parts = if is_above[i] {
                edges.push([toward_k, toward_j]);
                [
                    [toward_j, corners[j], corners[k]],
                    [toward_j, corners[k], toward_k],
                ]
            } else {
                edges.push([toward_j, toward_k]);
                // The second one has no area, and is left out.
                [[corners[i], toward_j, toward_k], [toward_j; 3]]
            };
            kept.extend(parts.iter().filter(|part| has_area(part)));
        }
    }
}

/// Returns where an edge crosses a plane, from its ends and their heights.
///
/// It has the same bits from both triangles of an edge, so the cut stays closed.
pub(super) fn cross(ends: [Point; 2], heights: [f64; 2]) -> Point {
    let [a, b] = if heights[0] > heights[1] {
        [0, 1]
    } else {
        [1, 0]
    };
    let share = heights[a] / (heights[a] - heights[b]);
    ends[a] + (ends[b] - ends[a]) * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;
    use crate::geom::Vector;

    fn unit_box() -> Aabb {
        Aabb {
            min: Point::origin(),
            max: Point::new(1.0, 1.0, 1.0),
        }
    }

    #[test]
    fn the_two_sides_of_many_cuts_have_the_volume_of_the_whole() {
        let mut random = Random::new(3);
        for _ in 0..200 {
            let mut parts = vec![Chain::of_box(&unit_box())];
            for _ in 0..4 {
                let mut at = || random.between(0.0, 1.0);
                let point = Point::new(at(), at(), at());
                let normal = Vector::new(at() - 0.5, at() - 0.5, at() - 0.5);
                let plane = Plane::through(&point, &normal);
                let halves = parts
                    .iter()
                    .flat_map(|part| [part.below(&plane), part.below(&plane.flipped())]);
                parts = halves.collect();
            }
            let sum: f64 = parts.iter().map(Chain::volume_mm3).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
            assert!(parts.iter().all(|part| part.volume_mm3() > -1e-12));
        }
    }

    #[test]
    fn a_cut_through_corners_leaves_half_a_box() {
        let plane = Plane::through(&Point::origin(), &Vector::new(1.0, -1.0, 0.0));
        let half = Chain::of_box(&unit_box()).below(&plane);
        assert!((half.volume_mm3() - 0.5).abs() < 1e-15);
        let none = Plane::through(&Point::origin(), &Vector::x());
        assert!(Chain::of_box(&unit_box()).below(&none).volume_mm3().abs() < 1e-15);
    }
}
