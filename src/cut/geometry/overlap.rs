//! Cut faces clipped by other planes: other cuts may end on a face from either side.

use std::collections::BTreeMap;

use crate::{
    cut::geometry::chart::{Chart, Point2},
    geom::Plane,
    mesh::union_find::UnionFind,
};

/// Tolerance for a face that ends at a plane, mm: only a face that reaches farther crosses it. Caps
/// are flat to 1e-13 mm, and their ends are as exact.
const PAST_MM: f64 = 1e-7;

/// A flat region as triangles that share corners.
#[derive(Debug, Clone, Default)]
pub(crate) struct Flat {
    pub(crate) corners: Vec<Point2>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Flat {
    /// Returns the region of these triangles, with equal corners merged.
    pub(crate) fn of(triangles: &[[Point2; 3]]) -> Self {
        let mut flat = Self::default();
        let mut known: BTreeMap<[u64; 2], u32> = BTreeMap::new();
        for triangle in triangles {
            let index = triangle.map(|p| {
                *known
                    .entry([p.x.to_bits(), p.y.to_bits()])
                    .or_insert_with(|| {
                        flat.corners.push(p);
                        flat.corners.len() as u32 - 1
                    })
            });
            flat.triangles.push(index);
        }
        flat
    }

    /// Returns the triangles by their corners.
    pub(crate) fn shapes(&self) -> Vec<[Point2; 3]> {
        self.triangles
            .iter()
            .map(|t| t.map(|v| self.corners[v as usize]))
            .collect()
    }

    /// Returns the connected pieces of the region.
    pub(crate) fn pieces(&self) -> Vec<Self> {
        let mut sets = UnionFind::new(self.corners.len());
        for &[a, b, c] in &self.triangles {
            sets.merge(a, b);
            sets.merge(b, c);
        }
        let mut pieces: BTreeMap<u32, Vec<[u32; 3]>> = BTreeMap::new();
        for triangle in &self.triangles {
            pieces
                .entry(sets.root(triangle[0]))
                .or_default()
                .push(*triangle);
        }
        let piece = |triangles| Self {
            corners: self.corners.clone(),
            triangles,
        };
        pieces.into_values().map(piece).collect()
    }

    /// Returns whether the region, in the plane `own`, reaches past another plane on both sides.
    pub(crate) fn is_crossed_by(&self, own: &Plane, other: &Plane) -> bool {
        let heights = self.heights(own, other);
        heights.iter().any(|&h| h > PAST_MM) && heights.iter().any(|&h| h < -PAST_MM)
    }

    /// Returns whether the region, in the plane `own`, lies above another plane. `None` if it
    /// reaches past that plane on both sides, or on neither.
    pub(crate) fn side_of(&self, own: &Plane, other: &Plane) -> Option<bool> {
        let heights = self.heights(own, other);
        let [above, below] = [1.0, -1.0].map(|sign| heights.iter().any(|h| sign * h > PAST_MM));
        (above != below).then_some(above)
    }

    fn heights(&self, own: &Plane, other: &Plane) -> Vec<f64> {
        let chart = Chart::of_plane(own);
        self.corners
            .iter()
            .map(|p| other.distance(&chart.lift(own, p)))
            .collect()
    }

    /// Returns the part of the region above another plane, or below it.
    ///
    /// A triangle side that crosses the plane gets a corner there, the same one from both of its
    /// triangles. Source: Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17, 1974.
    pub(crate) fn clip_to_side(&self, own: &Plane, other: &Plane, is_above: bool) -> Self {
        let sign = if is_above { 1.0 } else { -1.0 };
        let heights: Vec<f64> = self
            .heights(own, other)
            .into_iter()
            .map(|h| sign * h)
            .collect();
        let mut clipped = Self {
            corners: self.corners.clone(),
            triangles: Vec::new(),
        };
        let mut crossings: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for triangle in &self.triangles {
            let mut ring: Vec<u32> = Vec::new();
            for (i, &from) in triangle.iter().enumerate() {
                let to = triangle[(i + 1) % 3];
                let is_in = |v: u32| heights[v as usize] >= 0.0;
                if is_in(from) {
                    ring.push(from);
                }
                if is_in(from) != is_in(to) {
                    let [a, b] = [from.min(to), from.max(to)];
                    ring.push(*crossings.entry([a, b]).or_insert_with(|| {
                        let [g, h] = [a, b].map(|v| heights[v as usize]);
                        let [p, q] = [a, b].map(|v| self.corners[v as usize]);
                        clipped.corners.push(p + (q - p) * (g / (g - h)));
                        clipped.corners.len() as u32 - 1
                    }));
                }
            }
            clipped
                .triangles
                .extend((2..ring.len()).map(|i| [ring[0], ring[i - 1], ring[i]]));
        }
        clipped
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cut::pieces::split::cap_of, geom::Vector};

    fn level() -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: 0.0,
        }
    }

    /// Returns a square of 4 mm about the origin of the plane z = 0, made of four triangles.
    fn square() -> Flat {
        let chart = Chart::of_plane(&level());
        let at = |x: f64, y: f64| chart.flat(&crate::geom::Point::new(x, y, 0.0));
        let corners = [at(-2.0, -2.0), at(2.0, -2.0), at(2.0, 2.0), at(-2.0, 2.0)];
        let triangles: Vec<_> = (0..4)
            .map(|i| [at(0.0, 0.0), corners[i], corners[(i + 1) % 4]])
            .collect();
        Flat::of(&triangles)
    }

    fn across(x: f64, y: f64, offset_mm: f64) -> Plane {
        Plane {
            normal: Vector::new(x, y, 0.0).normalize(),
            offset_mm,
        }
    }

    #[test]
    fn a_side_of_a_square_has_its_share_of_the_area_and_a_closed_outline() {
        for (plane, expected) in [
            (across(1.0, 0.0, 1.0), 4.0),
            (across(1.0, 1.0, 0.0), 8.0),
            (across(0.3, 1.0, -0.2), f64::NAN),
        ] {
            let sides =
                [true, false].map(|is_above| square().clip_to_side(&level(), &plane, is_above));
            let areas = sides.each_ref().map(|side| cap_of(side, 0).area_mm2);
            assert!((areas[0] + areas[1] - 16.0).abs() < 1e-12, "{areas:?}");
            assert!(
                expected.is_nan() || (areas[0] - expected).abs() < 1e-12,
                "{areas:?}"
            );
            for side in &sides {
                let cap = cap_of(side, 0);
                let middle = cap.inner_point();
                let disc = cap.outline.largest_disc(0.0).unwrap();
                assert!(
                    cap.outline.holds(&middle) && disc.radius_mm < 2.0,
                    "an inner side counts as the outline"
                );
            }
        }
    }

    #[test]
    fn a_face_that_ends_at_a_plane_is_not_crossed_by_it() {
        assert!(square().is_crossed_by(&level(), &across(1.0, 0.0, 1.9)));
        assert!(!square().is_crossed_by(&level(), &across(1.0, 0.0, 2.0)));
    }

    #[test]
    fn a_fork_clipped_to_its_prongs_is_two_pieces() {
        // A fork with two prongs above y = 0.
        let chart = Chart::of_plane(&level());
        let at = |x: f64, y: f64| chart.flat(&crate::geom::Point::new(x, y, 0.0));
        let block = |x: f64, y: f64, w: f64, h: f64| {
            [
                [at(x, y), at(x + w, y), at(x + w, y + h)],
                [at(x, y), at(x + w, y + h), at(x, y + h)],
            ]
        };
        let fork = [
            block(0.0, -1.0, 1.0, 1.0),
            block(1.0, -1.0, 1.0, 1.0),
            block(2.0, -1.0, 1.0, 1.0),
        ];
        let prongs = [block(0.0, 0.0, 1.0, 2.0), block(2.0, 0.0, 1.0, 2.0)];
        let all = Flat::of(&[fork.concat(), prongs.concat()].concat());
        assert_eq!(all.pieces().len(), 1);
        assert_eq!(
            all.clip_to_side(&level(), &across(0.0, 1.0, 0.5), true)
                .pieces()
                .len(),
            2
        );
    }
}
