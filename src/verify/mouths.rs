//! The mouths of a void: the openings where a cut passes through its wall, on the surface as
//! written.

use std::collections::BTreeMap;

use crate::geom::{Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Number of sample points across the bounding box of a mouth, along each of two directions.
const ACROSS: usize = 16;
/// Number of sample points along a rim.
const ALONG: usize = 64;
/// Relative excess of their distance from the rim, so that rounding drops none of them.
const ROOM_SLACK_RATIO: f64 = 1e-9;
/// Number of points with most room from which the search climbs to the widest.
const CLIMBS: usize = 3;
/// Last step of the climb, as a share of the mouth's bounding box.
const CLIMB_RATIO: f64 = 5e-4;

/// A point in a mouth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MouthPoint {
    /// The point, model frame.
    pub at: Point,
    /// Its distance from the nearest rim, mm.
    pub room_mm: f64,
    /// The nearest point of a rim.
    pub rim: Point,
    /// The index of its mouth among those of this void and cut.
    pub mouth: usize,
}

/// A point in coordinates of the plane.
type Flat = nalgebra::Point2<f64>;

/// A point of the plane and the room around it, mm.
#[derive(Clone, Copy)]
struct Roomy {
    at: Flat,
    room_mm: f64,
}

/// A closed line of the section, with its bounding box.
struct Ring {
    segments: Vec<[Flat; 2]>,
    low: Flat,
    high: Flat,
}

/// The section of a closed surface by a plane, in coordinates of the plane.
struct Rims {
    rings: Vec<Ring>,
}

/// Samples the mouths of a void's shell (turned either way) in a plane.
///
/// The points are spread over the mouths, and along their rims with just the room for a tool of
/// this radius. The widest point of each mouth is added.
pub(super) fn sample_mouths(
    shell: &TriMesh,
    plane: &Plane,
    tool_radius_mm: f64,
) -> Vec<MouthPoint> {
    let (u, v) = plane.basis();
    let rims = Rims::of(shell, plane, [u, v]);
    let lift = |p: &Flat| plane.foot() + u * p.x + v * p.y;
    let mut points = Vec::new();
    for ring in &rims.rings {
        let mut flat = rims.grid_points(ring);
        flat.sort_by(|a, b| b.room_mm.total_cmp(&a.room_mm));
        let starts: Vec<Roomy> = flat.iter().copied().take(CLIMBS).collect();
        flat.extend(starts.into_iter().map(|start| rims.climb(ring, start)));
        flat.extend(rims.points_beside(ring, tool_radius_mm));
        points.extend(flat.into_iter().filter_map(|Roomy { at, room_mm }| {
            let (_, rim) = rims.nearest(&at)?;
            Some(MouthPoint {
                at: lift(&at),
                room_mm,
                rim: lift(&rim),
                mouth: rims.mouth(&at)?,
            })
        }));
    }
    points
}

impl Rims {
    fn of(shell: &TriMesh, plane: &Plane, [u, v]: [Vector; 2]) -> Self {
        let heights: Vec<f64> = shell.vertices().iter().map(|p| plane.distance(p)).collect();
        let flat = |p: Point| Flat::new(u.dot(&p.coords), v.dot(&p.coords));
        let at = |[a, b]: [u32; 2]| {
            let [p, q] = [a, b].map(|i| shell.vertices()[i as usize]);
            let [g, h] = [a, b].map(|i| heights[i as usize]);
            flat(p + (q - p) * (g / (g - h)))
        };
        let mut next: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
        next.extend(
            shell
                .triangles()
                .iter()
                .filter_map(|t| crossing_edges(t, &heights)),
        );
        let mut rings = Vec::new();
        while let Some((mut from, mut to)) = next.pop_first() {
            let mut segments = vec![[at(from), at(to)]];
            while let Some(after) = next.remove(&to) {
                (from, to) = (to, after);
                segments.push([at(from), at(to)]);
            }
            rings.extend(Ring::of(segments));
        }
        Self { rings }
    }

    /// Returns the distance to the nearest rim, mm, and the nearest point on it.
    fn nearest(&self, p: &Flat) -> Option<(f64, Flat)> {
        let on = self
            .rings
            .iter()
            .flat_map(|ring| &ring.segments)
            .map(|[a, b]| {
                let (along, to_p) = (b - a, p - a);
                let square = along.norm_squared();
                let share = if square > 0.0 {
                    (to_p.dot(&along) / square).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                a + along * share
            });
        on.map(|q| ((q - p).norm(), q))
            .min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Returns the room around a point, mm; negative outside the void.
    fn room_mm(&self, p: &Flat) -> f64 {
        let is_inside = self.rings.iter().filter(|ring| ring.contains(p)).count() % 2 == 1;
        let distance = self.nearest(p).map_or(0.0, |(distance, _)| distance);
        if is_inside { distance } else { -distance }
    }

    /// Returns the mouth that a point of the void lies in. The smallest ring around the point is
    /// that mouth's outer rim.
    fn mouth(&self, p: &Flat) -> Option<usize> {
        let around = self
            .rings
            .iter()
            .enumerate()
            .filter(|(_, ring)| ring.contains(p));
        let size = |ring: &Ring| (ring.high - ring.low).norm();
        around
            .min_by(|a, b| size(a.1).total_cmp(&size(b.1)))
            .map(|(index, _)| index)
    }

    /// Returns the points of a grid over the bounding box of a ring that lie in the void.
    fn grid_points(&self, ring: &Ring) -> Vec<Roomy> {
        let step = (ring.high - ring.low) / ACROSS as f64;
        let at = |i: usize| {
            let (column, row) = ((i % ACROSS) as f64 + 0.5, (i / ACROSS) as f64 + 0.5);
            ring.low + nalgebra::Vector2::new(step.x * column, step.y * row)
        };
        let points = (0..ACROSS * ACROSS).map(|i| self.measure(at(i)));
        points.filter(|point| point.room_mm > 0.0).collect()
    }

    /// Measures the room around a point.
    fn measure(&self, at: Flat) -> Roomy {
        let room_mm = self.room_mm(&at);
        Roomy { at, room_mm }
    }

    /// Returns points beside a ring, inside the void, with this room.
    fn points_beside(&self, ring: &Ring, room_mm: f64) -> Vec<Roomy> {
        let length = |[a, b]: &[Flat; 2]| (b - a).norm();
        let spacing = ring.segments.iter().map(length).sum::<f64>() / ALONG as f64;
        let (mut points, mut walked, mut next) = (Vec::new(), 0.0, 0.0);
        for segment in &ring.segments {
            let [a, b] = segment;
            let along = (b - a) / length(segment).max(f64::MIN_POSITIVE);
            while next < walked + length(segment) {
                let foot = a + along * (next - walked);
                let normal = nalgebra::Vector2::new(along.y, -along.x);
                let sides = [1.0, -1.0]
                    .map(|side| foot + normal * (side * room_mm * (1.0 + ROOM_SLACK_RATIO)));
                let beside = sides.map(|p| self.measure(p));
                points.extend(beside.into_iter().find(|point| point.room_mm >= room_mm));
                next += spacing;
            }
            walked += length(segment);
        }
        points
    }

    /// Climbs to a point with the most room by steps in eight directions. A step that gains nothing
    /// is halved.
    fn climb(&self, ring: &Ring, mut best: Roomy) -> Roomy {
        let size = (ring.high - ring.low).norm();
        let mut step = size / ACROSS as f64;
        while step > CLIMB_RATIO * size {
            let sides = (0..8).map(|i| (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos());
            let around = sides.map(|(sin, cos)| best.at + nalgebra::Vector2::new(cos, sin) * step);
            let next = around
                .map(|p| self.measure(p))
                .max_by(|a, b| a.room_mm.total_cmp(&b.room_mm));
            match next {
                Some(next) if next.room_mm > best.room_mm => best = next,
                _ => step /= 2.0,
            }
        }
        best
    }
}

impl Ring {
    fn of(segments: Vec<[Flat; 2]>) -> Option<Self> {
        let first = segments.first()?[0];
        let ends = segments.iter().flatten();
        let (low, high) = ends.fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
        Some(Self {
            segments,
            low,
            high,
        })
    }

    /// Returns true if a point lies inside, by the even-odd rule.
    fn contains(&self, p: &Flat) -> bool {
        let crosses = |[a, b]: &&[Flat; 2]| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
        };
        self.segments.iter().filter(crosses).count() % 2 == 1
    }
}

/// Returns the two edges in which a triangle crosses the plane, if it does. The first goes down,
/// the second comes up. The ends of each ascend. A corner on the plane counts as above.
fn crossing_edges(&[a, b, c]: &[u32; 3], heights: &[f64]) -> Option<([u32; 2], [u32; 2])> {
    let above = |i: u32| heights[i as usize] >= 0.0;
    let edges = [[a, b], [b, c], [c, a]];
    let down = edges.into_iter().find(|&[p, q]| above(p) && !above(q))?;
    let up = edges.into_iter().find(|&[p, q]| !above(p) && above(q))?;
    let named = |[p, q]: [u32; 2]| [p.min(q), p.max(q)];
    Some((named(down), named(up)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::test_meshes::block;

    fn level(z: f64) -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: z,
        }
    }

    #[test]
    fn the_mouth_of_a_box_is_as_wide_as_its_shorter_side() {
        for turned in [false, true] {
            let shell = block(Point::new(1.0, 2.0, 3.0), [8.0, 5.0, 6.0]);
            let shell = if turned { shell.reversed() } else { shell };
            let widest = sample_mouths(&shell, &level(4.0), 0.5)
                .into_iter()
                .max_by(|a, b| a.room_mm.total_cmp(&b.room_mm));
            let widest = widest.unwrap();
            assert!((widest.room_mm - 2.5).abs() < 0.01, "{widest:?}");
            assert!((widest.at.z - 4.0).abs() < 1e-12 && (widest.rim - widest.at).norm() > 2.49);
        }
        let block = block(Point::origin(), [8.0, 5.0, 6.0]);
        assert!(sample_mouths(&block, &level(7.0), 0.5).is_empty());
    }

    #[test]
    fn points_along_the_rim_keep_just_the_tools_room() {
        let shell = block(Point::new(1.0, 2.0, 3.0), [8.0, 5.0, 6.0]);
        let beside = |room_mm: f64| {
            sample_mouths(&shell, &level(4.0), room_mm)
                .into_iter()
                .filter(move |p| (p.room_mm - room_mm).abs() < 1e-6)
        };
        // All but the points within 0.6 mm of a corner along the rim: 8 times 0.6 of 26 mm.
        let found = beside(0.6).count() as f64 / ALONG as f64;
        assert!((found - 21.2 / 26.0).abs() < 0.1, "{found}");
        assert_eq!(beside(2.6).count(), 0, "a tool wider than the mouth");
    }

    #[test]
    fn two_mouths_of_one_cut_are_distinguished_and_a_hole_is_no_mouth() {
        let two =
            block(Point::origin(), [4.0; 3]).joined(&block(Point::new(10.0, 0.0, 0.0), [4.0; 3]));
        let mouths: std::collections::BTreeSet<usize> = sample_mouths(&two, &level(2.0), 0.5)
            .iter()
            .map(|point| point.mouth)
            .collect();
        assert_eq!(mouths.len(), 2);
        // A square frame: 1 mm of room around a column of material.
        let frame = block(Point::origin(), [10.0; 3])
            .joined(&block(Point::new(2.0, 2.0, 0.0), [6.0; 3]).reversed());
        let found = sample_mouths(&frame, &level(2.0), 0.5);
        let first = found[0].mouth;
        assert!(
            found
                .iter()
                .all(|point| point.mouth == first && point.room_mm < 1.2),
            "{found:?}"
        );
    }
}
