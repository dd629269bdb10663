//! Knots: the points in which three triangles meet, where two segments of one triangle cross.

use std::collections::BTreeMap;

use robust::{Coord, orient2d};

use super::contacts::{Cuts, share_at_plane};
use crate::geom::Point;
use crate::mesh::TriMesh;

/// Largest number of segments of one triangle. All their pairs are compared: 1000 take some
/// hundredths of a second, and a surface with more is a heap of parts.
const MAX_SEGMENTS: usize = 1000;

/// The plane of a triangle seen from in front, as two of the three coordinates.
pub(super) struct View {
    axes: [usize; 2],
}

impl View {
    /// Returns the view in which the triangle is largest; its corners run counter-clockwise.
    pub fn of([a, b, c]: &[Point; 3]) -> Self {
        let normal = (b - a).cross(&(c - a));
        let drop = normal.iamax();
        let axes = [(drop + 1) % 3, (drop + 2) % 3];
        let is_seen_from_behind = normal[drop] < 0.0;
        Self {
            axes: if is_seen_from_behind {
                [axes[1], axes[0]]
            } else {
                axes
            },
        }
    }

    /// Returns the place of a point in the view.
    pub fn at(&self, p: &Point) -> Coord<f64> {
        Coord {
            x: p[self.axes[0]],
            y: p[self.axes[1]],
        }
    }
}

/// Adds the knots to the segments; `None` if three triangles do not agree whether they meet, or if
/// one has more than 1000 segments.
pub(super) fn tie_knots(mesh: &TriMesh, cuts: &mut Cuts) -> Option<()> {
    let mut seen: BTreeMap<[u32; 3], usize> = BTreeMap::new();
    for (triangle, segments) in cuts.segments_of_triangles() {
        (segments.len() <= MAX_SEGMENTS).then_some(())?;
        for others in crossing_segments(mesh, cuts, triangle, &segments)? {
            let mut three = [triangle, others[0], others[1]];
            three.sort_unstable();
            *seen.entry(three).or_default() += 1;
        }
    }
    // Each of the three triangles must see the knot once.
    seen.values().all(|&count| count == 3).then_some(())?;
    let place = cuts.segments.iter().enumerate();
    let index: BTreeMap<[u32; 2], usize> = place.map(|(i, s)| (s.triangles, i)).collect();
    for [a, b, c] in seen.into_keys() {
        let segments = [[a, b], [a, c], [b, c]].map(|pair| index.get(&pair).copied());
        let [Some(first), Some(second), Some(third)] = segments else {
            return None;
        };
        let [from, to] = ends(cuts, first).map(|v| cuts.points[v as usize]);
        let share = share_at_plane(&from, &to, &mesh.corners(c as usize))?;
        let knot = cuts.points.len() as u32;
        cuts.points.push(from + (to - from) * share);
        for segment in [first, second, third] {
            let points = &mut cuts.segments[segment].points;
            points.insert(points.len() - 1, knot);
        }
    }
    (0..cuts.segments.len()).try_for_each(|segment| sort_along(cuts, segment))
}

fn ends(cuts: &Cuts, segment: usize) -> [u32; 2] {
    let points = &cuts.segments[segment].points;
    [points[0], points[points.len() - 1]]
}

/// Returns, for each two segments of a triangle that cross, the triangles on their other sides.
fn crossing_segments(
    mesh: &TriMesh,
    cuts: &Cuts,
    triangle: u32,
    segments: &[usize],
) -> Option<Vec<[u32; 2]>> {
    let view = View::of(&mesh.corners(triangle as usize));
    let other = |segment: usize| {
        let [a, b] = cuts.segments[segment].triangles;
        if a == triangle { b } else { a }
    };
    let mut found = Vec::new();
    for (i, &one) in segments.iter().enumerate() {
        for &two in &segments[i + 1..] {
            let (a, b) = (ends(cuts, one), ends(cuts, two));
            if a.iter().any(|v| b.contains(v)) {
                continue;
            }
            let places = |ends: [u32; 2]| ends.map(|v| view.at(&cuts.points[v as usize]));
            if do_cross(places(a), places(b))? {
                found.push([other(one), other(two)]);
            }
        }
    }
    Some(found)
}

/// Returns true if two segments cross inside; `None` if an end of one touches the other.
fn do_cross(a: [Coord<f64>; 2], b: [Coord<f64>; 2]) -> Option<bool> {
    let turns =
        |[from, to]: [Coord<f64>; 2], ends: [Coord<f64>; 2]| ends.map(|p| orient2d(from, to, p));
    let (of_b, of_a) = (turns(a, b), turns(b, a));
    let is_beside = |[s, t]: [f64; 2]| s > 0.0 && t > 0.0 || s < 0.0 && t < 0.0;
    if is_beside(of_b) || is_beside(of_a) {
        return Some(false);
    }
    let is_clear = of_b.iter().chain(&of_a).all(|&turn| turn != 0.0);
    is_clear.then_some(true)
}

/// Sorts the points of a segment along it; `None` if two lie at one place.
fn sort_along(cuts: &mut Cuts, segment: usize) -> Option<()> {
    let [start, end] = ends(cuts, segment).map(|v| cuts.points[v as usize]);
    let places = &cuts.points;
    let along = |v: u32| (places[v as usize] - start).dot(&(end - start));
    let points = &mut cuts.segments[segment].points;
    let last = points.len() - 1;
    points[1..last].sort_by(|&a, &b| along(a).total_cmp(&along(b)));
    let is_rising = points
        .windows(2)
        .all(|pair| along(pair[0]) < along(pair[1]));
    is_rising.then_some(())
}
