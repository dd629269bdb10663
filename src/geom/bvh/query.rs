//! Queries: nearest point, distances of triangles and segments, winding number along a ray.

use std::ops::ControlFlow;

use super::probe::Probe;
use super::ray::{box_entry, crossing, is_above, triangle_crossing};
use super::stack::Stack;
use super::tree::Bvh;
use crate::geom::triangle::{
    Feature, TrianglePoint, closest_on_triangle, segment_triangle_distance_squared,
    triangle_triangle_distance_squared,
};
use crate::geom::{Aabb, Point, Vector};

/// The hint of a query without any.
pub const NO_HINT: u32 = u32::MAX;

/// The triangle nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The squared distance, mm².
    pub distance_squared: f64,
    /// The nearest point.
    pub point: Point,
    /// The triangle's index as the caller numbered it.
    pub triangle: u32,
    /// The part of the triangle on which the point lies.
    pub feature: Feature,
    /// A token that gives a query nearby a good first bound.
    pub hint: u32,
}

impl Bvh {
    /// Returns the point of all triangles nearest to `p`; `None` if none is nearer than
    /// `limit_mm`.
    ///
    /// `hints` are tokens of earlier answers nearby (or [`NO_HINT`]). They save time. They
    /// change the answer only among triangles that are equally near up to rounding.
    pub fn closest(&self, p: &Point, limit_mm: f64, hints: &[u32]) -> Option<Nearest> {
        let mut search = Search {
            best: limit_mm * limit_mm,
            found: None,
        };
        for &hint in hints.iter().filter(|&&hint| hint != NO_HINT) {
            search.offer(p, self, hint as usize);
        }
        self.visit(
            search,
            |aabb| aabb.distance_squared(p),
            |search| search.best,
            |search, slot| search.offer(p, self, slot),
        )
        .nearest(self)
    }

    /// Returns the least distance from a triangle to all triangles, mm; 0 if they meet,
    /// `limit_mm` if none is nearer.
    pub fn triangle_distance(&self, corners: &[Point; 3], limit_mm: f64) -> f64 {
        let probe = Probe::new(corners);
        self.visit(
            limit_mm,
            |aabb| probe.bound(aabb),
            |best| *best,
            |best, slot| {
                if probe.is_within(&self.corners[slot], *best) {
                    *best = triangle_triangle_distance_squared(corners, &self.corners[slot]).sqrt();
                }
            },
        )
    }

    /// Returns true if a triangle comes nearer than `limit_mm` to any of the triangles.
    pub fn is_triangle_within(&self, corners: &[Point; 3], limit_mm: f64) -> bool {
        let probe = Probe::new(corners);
        let aabb = Aabb::of_points(corners);
        let limit_squared = limit_mm.max(0.0).powi(2);
        let bound = |other: &Aabb| {
            let is_apart = gap_squared(&aabb, other) >= limit_squared
                || probe.is_clear_of_box(other, limit_mm);
            if is_apart { f64::INFINITY } else { 0.0 }
        };
        self.visit(
            false,
            bound,
            |hit| {
                if *hit {
                    f64::NEG_INFINITY
                } else {
                    f64::MIN_POSITIVE
                }
            },
            |hit, slot| *hit = *hit || probe.is_within(&self.corners[slot], limit_mm),
        )
    }

    /// Returns the least distance from the segment to all triangles, mm; 0 if they meet,
    /// `limit_mm` if none is nearer.
    pub fn segment_distance(&self, a: &Point, b: &Point, limit_mm: f64) -> f64 {
        let ends = [*a, *b, *b];
        let probe = Probe::new(&ends);
        self.visit(
            limit_mm,
            |aabb| probe.bound(aabb),
            |best| *best,
            |best, slot| {
                let exact = segment_triangle_distance_squared(a, b, &self.corners[slot]).sqrt();
                *best = best.min(exact);
            },
        )
    }

    /// Returns true if the segment from `a` to `b` passes through a triangle. Decided in double
    /// precision: for a segment that only touches an edge, either answer may come.
    pub fn crosses_segment(&self, a: &Point, b: &Point) -> bool {
        self.find_crossed(a, b, NO_HINT).is_some()
    }

    /// Returns a token of a triangle through which the segment from `a` to `b` passes; `None` if
    /// there is none, decided as by [`Bvh::crosses_segment`].
    ///
    /// `hint` is the token of an earlier answer nearby (or [`NO_HINT`]). It saves time.
    pub fn find_crossed(&self, a: &Point, b: &Point, hint: u32) -> Option<u32> {
        let along = b - a;
        let is_crossed = |corners: &[Point; 3]| triangle_crossing(a, &along, corners).is_some();
        if self.corners.get(hint as usize).is_some_and(is_crossed) {
            return Some(hint);
        }
        let inverse = along.map(f64::recip);
        let is_met = |index: u32| {
            let node = self.nodes.get(index as usize);
            node.is_some_and(|node| box_entry(a, &inverse, &node.aabb).is_some())
        };
        let mut stack = Stack::default();
        if is_met(0) {
            stack.push(0);
        }
        while let Some(index) = stack.pop() {
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                let crossed = Self::leaf_range(node).find(|&slot| is_crossed(&self.corners[slot]));
                if let Some(slot) = crossed {
                    return Some(slot as u32);
                }
                continue;
            }
            let children = [node.first, index + 1];
            let met = children.into_iter().filter(|&child| is_met(child));
            met.for_each(|child| stack.push(child));
        }
        None
    }

    /// Returns the first point at which the segment from `a` to `b` passes through a triangle,
    /// as a share of its length. `None` if it passes through none.
    pub fn first_crossing(&self, a: &Point, b: &Point) -> Option<f64> {
        let along = b - a;
        let inverse = along.map(f64::recip);
        let nearest = self.visit(
            f64::INFINITY,
            |aabb| box_entry(a, &inverse, aabb).unwrap_or(f64::INFINITY),
            |nearest| *nearest,
            |nearest, slot| {
                if let Some(share) = triangle_crossing(a, &along, &self.corners[slot]) {
                    *nearest = nearest.min(share);
                }
            },
        );
        nearest.is_finite().then_some(nearest)
    }

    /// Calls `see` with the triangles whose boxes overlap `aabb` (touching counts), until it
    /// breaks.
    ///
    /// `see` gets the caller's index of a triangle, and its corners. The order depends on the
    /// tree alone.
    pub fn visit_overlapping(
        &self,
        aabb: &Aabb,
        mut see: impl FnMut(u32, &[Point; 3]) -> ControlFlow<()>,
    ) {
        _ = self.visit(
            ControlFlow::Continue(()),
            |other| gap_squared(aabb, other),
            |flow| {
                if flow.is_break() {
                    f64::NEG_INFINITY
                } else {
                    f64::MIN_POSITIVE
                }
            },
            |flow, slot| {
                let corners = &self.corners[slot];
                if flow.is_continue() && gap_squared(aabb, &Aabb::of_points(corners)) <= 0.0 {
                    *flow = see(self.ids[slot], corners);
                }
            },
        );
    }

    /// Returns the winding number of the surface around `p`: the signed crossings of the ray
    /// from `p` along +z.
    ///
    /// For a closed mesh 1 inside, 0 outside; overlaps of the mesh add up. A ray through an
    /// edge or a corner counts once, by exact predicates (Shewchuk 1997). Meaningless on the
    /// surface itself.
    pub fn winding(&self, p: &Point) -> i32 {
        self.visit(
            0,
            |aabb| {
                if is_above(p, aabb) {
                    0.0
                } else {
                    f64::INFINITY
                }
            },
            |_| f64::INFINITY,
            |winding, slot| *winding += crossing(p, &self.corners[slot]),
        )
    }

    /// Traverses the tree, nearer child first, and returns the final state.
    ///
    /// `bound` gives a box's lower bound and `limit` the value below which boxes still matter.
    /// `leaf` updates the state with a triangle.
    #[inline]
    fn visit<S>(
        &self,
        mut state: S,
        bound: impl Fn(&Aabb) -> f64,
        limit: impl Fn(&S) -> f64,
        mut leaf: impl FnMut(&mut S, usize),
    ) -> S {
        let mut stack: Stack<(u32, f64)> = Stack::default();
        if let Some(root) = self.nodes.first() {
            stack.push((0, bound(&root.aabb)));
        }
        while let Some((index, lower)) = stack.pop() {
            if lower >= limit(&state) {
                continue;
            }
            let node = &self.nodes[index as usize];
            if node.count > 0 {
                Self::leaf_range(node).for_each(|slot| leaf(&mut state, slot));
                continue;
            }
            let left = (index + 1, bound(&self.nodes[index as usize + 1].aabb));
            let right = (node.first, bound(&self.nodes[node.first as usize].aabb));
            let (near, far) = if left.1 <= right.1 {
                (left, right)
            } else {
                (right, left)
            };
            for child in [far, near] {
                if child.1 < limit(&state) {
                    stack.push(child);
                }
            }
        }
        state
    }
}

/// The best answer so far of a nearest-point query.
struct Search {
    best: f64,
    found: Option<(usize, TrianglePoint)>,
}

impl Search {
    #[inline]
    fn offer(&mut self, p: &Point, bvh: &Bvh, slot: usize) {
        let Some(corners) = bvh.corners.get(slot) else {
            return;
        };
        let candidate = closest_on_triangle(p, corners);
        let distance_squared = (candidate.point - p).norm_squared();
        if distance_squared < self.best {
            self.best = distance_squared;
            self.found = Some((slot, candidate));
        }
    }

    fn nearest(self, bvh: &Bvh) -> Option<Nearest> {
        self.found
            .map(|(slot, TrianglePoint { point, feature })| Nearest {
                distance_squared: self.best,
                point,
                triangle: bvh.ids[slot],
                feature,
                hint: slot as u32,
            })
    }
}

/// Returns the squared distance between two boxes, mm²; zero if they overlap.
#[inline]
pub(super) fn gap_squared(a: &Aabb, b: &Aabb) -> f64 {
    let gap = (a.min - b.max).sup(&(b.min - a.max)).sup(&Vector::zeros());
    gap.norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deterministic numbers in [0, 1): the fractional parts of multiples of irrational numbers.
    fn noise(index: usize, axis: usize) -> f64 {
        let step = [
            0.754_877_666_246_693,
            0.569_840_290_998_053,
            0.430_159_709_001_947,
        ][axis];
        (index as f64 * step * (1.0 + 0.1 * axis as f64)).fract()
    }

    fn noise_point(index: usize, scale: f64) -> Point {
        Point::new(noise(index, 0), noise(index, 1), noise(index, 2)) * scale
    }

    #[test]
    fn a_segment_crosses_the_triangles_that_its_ends_lie_on_two_sides_of() {
        let bvh = Bvh::new(soup(300));
        let brute = |a: &Point, b: &Point| {
            soup(300)
                .iter()
                .any(|corners| segment_triangle_distance_squared(a, b, corners) < 1e-24)
        };
        let answers: Vec<bool> = (0..400)
            .map(|i| {
                let (a, b) = (noise_point(1000 + i, 1.0), noise_point(5000 + i, 1.0));
                let found = bvh.find_crossed(&a, &b, NO_HINT);
                assert_eq!(found.is_some(), brute(&a, &b), "{a} {b}");
                for hint in [0, i as u32 % 300, 1000] {
                    let hinted = bvh.find_crossed(&a, &b, hint);
                    assert_eq!(hinted.is_some(), found.is_some(), "{a} {b} {hint}");
                }
                if let Some(token) = found {
                    assert_eq!(bvh.find_crossed(&a, &b, token), found);
                }
                brute(&a, &b)
            })
            .collect();
        assert!(answers.contains(&true) && answers.contains(&false));
    }

    fn soup(count: usize) -> Vec<[Point; 3]> {
        (0..count)
            .map(|i| {
                let a = noise_point(3 * i, 10.0);
                [
                    a,
                    a + noise_point(3 * i + 1, 1.0).coords,
                    a - noise_point(3 * i + 2, 1.0).coords,
                ]
            })
            .collect()
    }

    #[test]
    fn the_closest_point_is_that_of_brute_force_with_and_without_hints() {
        let triangles = soup(500);
        let bvh = Bvh::new(triangles.clone());
        let mut hint = NO_HINT;
        for i in 0..400 {
            let p = noise_point(7 * i + 5, 12.0);
            let brute = triangles
                .iter()
                .map(|t| (closest_on_triangle(&p, t).point - p).norm_squared())
                .fold(f64::INFINITY, f64::min);
            let plain = bvh.closest(&p, f64::INFINITY, &[]).unwrap();
            let hinted = bvh.closest(&p, f64::INFINITY, &[hint]).unwrap();
            assert_eq!(plain.distance_squared, brute);
            assert_eq!(hinted.distance_squared, brute);
            hint = plain.hint;
        }
    }

    #[test]
    fn nothing_is_found_beyond_the_limit() {
        let bvh = Bvh::new(soup(50));
        let far = Point::new(100.0, 0.0, 0.0);
        assert!(bvh.closest(&far, 50.0, &[]).is_none());
        assert!(
            Bvh::new(Vec::new())
                .closest(&far, f64::INFINITY, &[])
                .is_none()
        );
    }

    #[test]
    fn triangle_and_segment_distances_are_those_of_brute_force() {
        let triangles = soup(300);
        let bvh = Bvh::new(triangles.clone());
        for i in 0..200 {
            let a = noise_point(11 * i + 3, 14.0);
            let t = [
                a,
                a + noise_point(11 * i + 4, 2.0).coords,
                a - noise_point(11 * i + 5, 2.0).coords,
            ];
            let brute = triangles
                .iter()
                .map(|s| triangle_triangle_distance_squared(&t, s))
                .fold(f64::INFINITY, f64::min)
                .sqrt();
            let found = bvh.triangle_distance(&t, f64::INFINITY);
            assert!((found - brute).abs() < 1e-12, "{found} {brute}");
            assert!(bvh.is_triangle_within(&t, brute + 1e-9));
            assert!(!bvh.is_triangle_within(&t, brute - 1e-9));
            let segment = triangles
                .iter()
                .map(|s| segment_triangle_distance_squared(&t[0], &t[1], s))
                .fold(f64::INFINITY, f64::min)
                .sqrt();
            assert!((bvh.segment_distance(&t[0], &t[1], f64::INFINITY) - segment).abs() < 1e-12);
        }
    }

    #[test]
    fn every_triangle_whose_box_overlaps_is_seen_until_the_walk_is_broken_off() {
        let triangles = soup(300);
        let bvh = Bvh::new(triangles.clone());
        for i in 0..100 {
            let low = noise_point(13 * i + 1, 10.0);
            let aabb = Aabb {
                min: low,
                max: low + noise_point(13 * i + 2, 3.0).coords,
            };
            let overlaps = |t: &[Point; 3]| gap_squared(&aabb, &Aabb::of_points(t)) <= 0.0;
            let brute: Vec<u32> = (0..300)
                .filter(|&t| overlaps(&triangles[t as usize]))
                .collect();
            let (mut seen, mut visits) = (Vec::new(), 0);
            bvh.visit_overlapping(&aabb, |t, corners| {
                assert_eq!(*corners, triangles[t as usize]);
                seen.push(t);
                ControlFlow::Continue(())
            });
            seen.sort_unstable();
            assert_eq!(seen, brute);
            bvh.visit_overlapping(&aabb, |_, _| {
                visits += 1;
                if visits < 3 {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            });
            assert_eq!(visits, brute.len().min(3));
        }
    }

    #[test]
    fn a_ray_through_edges_and_corners_is_counted_once() {
        let top = Point::new(0.0, 0.0, 1.0);
        let bottom = Point::new(0.0, 0.0, -1.0);
        let ring =
            [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Point::new(x, y, 0.0));
        let octahedron = (0..4).flat_map(|i| {
            [
                [ring[i], ring[(i + 1) % 4], top],
                [ring[(i + 1) % 4], ring[i], bottom],
            ]
        });
        let bvh = Bvh::new(octahedron);
        for inside in [
            Point::origin(),
            Point::new(0.5, 0.0, 0.1),
            Point::new(0.0, -0.25, -0.5),
        ] {
            assert_eq!(bvh.winding(&inside), 1, "{inside}");
        }
        for outside in [
            Point::new(0.0, 0.0, -2.0),
            Point::new(0.0, 0.0, 2.0),
            Point::new(1.0, 0.0, -0.5),
        ] {
            assert_eq!(bvh.winding(&outside), 0, "{outside}");
        }
    }
}
