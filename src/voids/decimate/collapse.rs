//! Merges a vertex into a neighbour if the old surface stays near the new one.

use super::patch::{NIL, Patch, area_vector, last, next};
use super::rules::{Rules, Stray};
use crate::geom::triangle::closest_on_triangle;
use crate::geom::{Point, Vector};

/// Longest edge merged in each pass, mm. Short edges come first, so that slivers vanish before good
/// triangles are stretched over them.
const PASS_LENGTHS_MM: [f64; 6] = [0.05, 0.15, 0.4, 1.0, 3.0, f64::INFINITY];

/// Neighbours tried for each vertex and pass, nearest first. More gain little.
const TRIES: usize = 4;

/// Cosine of the largest turn of a new triangle from the one it replaces.
const TURN_COSINE: f64 = 0.5;

/// Least height of a new triangle over its longest side, unless it was worse before. Thinner
/// triangles collapse when the file's `f32` rounds them.
const SHAPE_RATIO: f64 = 0.05;

/// Height of a new triangle beyond the vertex it replaces, below which it counts as inside, mm:
/// twice the error of the drawn vertices. With more, triangles that the rules forbid pass unseen
/// and must be done again later; with less, the rules are asked about every flat place.
const FLAT_MM: f64 = 2e-4;

/// Most removed vertices that the triangles around one vertex may stand for. The time for a merge
/// grows with them.
const POINTS_MAX: usize = 160;

/// Working memory, reused from merge to merge.
#[derive(Default)]
struct Scratch {
    fan: Vec<u32>,
    others: Vec<u32>,
    ring: Vec<u32>,
    points: Vec<u32>,
    /// Edges that may be merged, with their squared lengths, mm².
    near: Vec<(f64, u32)>,
    new_triangles: Vec<NewTriangle>,
    nearest: Vec<usize>,
}

/// A triangle as it would be after the merge.
struct NewTriangle {
    triangle: u32,
    corners: [Point; 3],
    normal: Vector,
    /// For each side, a vector in the plane that points across it into the triangle.
    inward: [Vector; 3],
    /// Height above the vertex that vanishes, mm; negative inside the body.
    outside_mm: f64,
}

impl NewTriangle {
    /// Returns whether it lies inside the old surface. Rules that allowed the old surface allow
    /// everything inside it.
    fn is_inside(&self) -> bool {
        self.outside_mm <= FLAT_MM
    }

    /// Returns whether a point lies straight above or below the triangle, no farther away than
    /// `limit_mm`.
    fn is_beside(&self, p: &Point, limit_mm: f64) -> bool {
        self.normal.dot(&(p - self.corners[0])).abs() <= limit_mm
            && (0..3).all(|i| self.inward[i].dot(&(p - self.corners[i])) >= 0.0)
    }
}

impl Patch {
    /// Merges vertices, shortest edges first, as long as the rules allow.
    pub fn decimate(&mut self, rules: Rules) {
        let mut scratch = Scratch::default();
        for length_mm in PASS_LENGTHS_MM {
            for v in 0..self.points.len() as u32 {
                let is_tried = self.tried[v as usize] >= length_mm * length_mm;
                if self.leaving[v as usize] != NIL && !self.is_locked[v as usize] && !is_tried {
                    self.remove(v, length_mm, rules, &mut scratch);
                }
            }
        }
    }

    /// Merges a vertex into the first of its nearest neighbours for which the rules hold.
    fn remove(&mut self, v: u32, length_mm: f64, rules: Rules, scratch: &mut Scratch) {
        if !self.fan(v, &mut scratch.fan) {
            return;
        }
        let at = self.points[v as usize];
        let with_length = |&edge: &u32| {
            let squared = (self.points[self.end(edge) as usize] - at).norm_squared();
            (squared, edge)
        };
        let is_due = |&(squared, _): &(f64, u32)| {
            squared <= length_mm * length_mm && squared > self.tried[v as usize]
        };
        scratch.near.clear();
        let near = scratch.fan.iter().map(with_length).filter(is_due);
        scratch.near.extend(near);
        self.tried[v as usize] = self.tried[v as usize].max(length_mm * length_mm);
        if scratch.near.is_empty() {
            return;
        }
        let by_length = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
        scratch.near.sort_unstable_by(by_length);
        self.collect_points(v, scratch);
        if scratch.points.len() > POINTS_MAX {
            return;
        }
        for i in 0..scratch.near.len().min(TRIES) {
            let (_, edge) = scratch.near[i];
            if self.is_link_simple(edge, scratch)
                && self.make_triangles(edge, scratch)
                && self.assign_points(rules.stray, scratch)
                && scratch
                    .new_triangles
                    .iter()
                    .all(|new| new.is_inside() || (rules.allows)(&new.corners))
            {
                self.merge(edge, scratch);
                return;
            }
        }
    }

    /// Collects the vertex and every removed vertex that its triangles stand for.
    fn collect_points(&self, v: u32, scratch: &mut Scratch) {
        scratch.points.clear();
        scratch.points.push(v);
        for &edge in &scratch.fan {
            scratch.points.extend(self.points_of(edge / 3));
        }
    }

    /// Returns whether the edge's ends have only the two neighbours across it in common.
    ///
    /// The surface then stays a manifold (Dey, Edelsbrunner, Guha & Nekhayev, "Topology preserving
    /// edge contraction", 1999).
    fn is_link_simple(&self, edge: u32, scratch: &mut Scratch) -> bool {
        let twin = self.twin[edge as usize];
        let across = [
            self.start[last(edge) as usize],
            self.start[last(twin) as usize],
        ];
        self.neighbours(self.end(edge), &mut scratch.others);
        scratch.ring.clear();
        scratch
            .ring
            .extend(scratch.fan.iter().map(|&e| self.end(e)));
        let others = &scratch.others;
        let common = scratch.ring.iter().filter(|v| others.contains(v)).count();
        // Two locked vertices may be joined already, outside the patch.
        let is_locked = |v: u32| self.is_locked[v as usize];
        let may_double = is_locked(self.end(edge))
            && scratch
                .ring
                .iter()
                .any(|&v| is_locked(v) && v != self.end(edge) && !across.contains(&v));
        common == 2
            && !may_double
            && !self.is_pinched[self.end(edge) as usize]
            && scratch.ring.len() > 3
            && across.iter().all(|v| others.contains(v))
    }

    /// Makes the triangles around the start of `edge` with that vertex moved to its end. Returns
    /// false if one turns too far or is thin.
    fn make_triangles(&self, edge: u32, scratch: &mut Scratch) -> bool {
        let vanishing = [edge / 3, self.twin[edge as usize] / 3];
        let target = self.points[self.end(edge) as usize];
        scratch.new_triangles.clear();
        for &leaving in scratch
            .fan
            .iter()
            .filter(|&&e| !vanishing.contains(&(e / 3)))
        {
            let rest = [next(leaving), last(leaving)]
                .map(|e| self.points[self.start[e as usize] as usize]);
            let old = [
                self.points[self.start[leaving as usize] as usize],
                rest[0],
                rest[1],
            ];
            let corners = [target, rest[0], rest[1]];
            let (before, after) = (area_vector(&old), area_vector(&corners));
            let (old_length, length) = (before.norm(), after.norm());
            let shape = length / longest_squared(&corners);
            let is_good = before.dot(&after) >= TURN_COSINE * old_length * length
                && length > 0.0
                && (shape >= SHAPE_RATIO || shape >= old_length / longest_squared(&old));
            if !is_good {
                return false;
            }
            let normal = after / length;
            let outside_mm = normal.dot(&(target - old[0]));
            scratch.new_triangles.push(NewTriangle {
                triangle: leaving / 3,
                corners,
                normal,
                inward: inward(&corners, &normal),
                outside_mm,
            });
        }
        true
    }

    /// Assigns every point to the new triangle nearest to it. Returns false if a point is too far
    /// away.
    fn assign_points(&self, stray: Stray, scratch: &mut Scratch) -> bool {
        scratch.nearest.clear();
        for &point in &scratch.points {
            match nearest_triangle(&self.points[point as usize], &scratch.new_triangles, stray) {
                Some(index) => scratch.nearest.push(index),
                None => return false,
            }
        }
        true
    }

    /// Merges the start of `edge` into its end.
    fn merge(&mut self, edge: u32, scratch: &Scratch) {
        let (v, u) = (self.start[edge as usize], self.end(edge));
        let twin = self.twin[edge as usize];
        for &leaving in &scratch.fan {
            self.start[leaving as usize] = u;
            self.first_point[(leaving / 3) as usize] = NIL;
        }
        let to_u = self.close(edge);
        self.close_back(twin);
        self.leaving[u as usize] = to_u;
        self.leaving[v as usize] = NIL;
        scratch
            .ring
            .iter()
            .for_each(|&beside| self.tried[beside as usize] = -1.0);
        for (&point, &nearest) in scratch.points.iter().zip(&scratch.nearest) {
            self.give(scratch.new_triangles[nearest].triangle, point);
        }
    }

    /// Removes the triangle of `edge` (v → u, then a), so that the triangle beyond a → v borders
    /// the one beyond u → a. Returns the half-edge from u to a.
    fn close(&mut self, edge: u32) -> u32 {
        let (beyond_ua, beyond_av) = (
            self.twin[next(edge) as usize],
            self.twin[last(edge) as usize],
        );
        let a = self.start[last(edge) as usize];
        self.is_alive[(edge / 3) as usize] = false;
        self.join(beyond_ua, beyond_av);
        self.leaving[a as usize] = next(beyond_av);
        beyond_av
    }

    /// Removes the triangle of `twin` (u → v, then b), so that the triangle beyond v → b borders
    /// the one beyond b → u.
    fn close_back(&mut self, twin: u32) {
        let (beyond_vb, beyond_bu) = (
            self.twin[next(twin) as usize],
            self.twin[last(twin) as usize],
        );
        let b = self.start[last(twin) as usize];
        self.is_alive[(twin / 3) as usize] = false;
        self.join(beyond_vb, beyond_bu);
        self.leaving[b as usize] = beyond_vb;
    }

    fn join(&mut self, e: u32, f: u32) {
        for (from, to) in [(e, f), (f, e)] {
            if from != NIL {
                self.twin[from as usize] = to;
            }
        }
    }
}

/// Returns the new triangle that stands for an old vertex, or `None` if the surface strays too far
/// from it. A vertex above the triangle means that the surface now runs inside the body.
///
/// It is the first triangle straight beside the vertex and within both limits; else the nearest.
fn nearest_triangle(p: &Point, new_triangles: &[NewTriangle], stray: Stray) -> Option<usize> {
    let close_mm = stray.inside_mm.min(stray.outside_mm);
    let straight = new_triangles
        .iter()
        .position(|new| new.is_beside(p, close_mm));
    if straight.is_some() {
        return straight;
    }
    let mut best = (f64::INFINITY, 0, Vector::zeros());
    for (i, candidate) in new_triangles.iter().enumerate() {
        let offset = p - closest_on_triangle(p, &candidate.corners).point;
        let squared = offset.norm_squared();
        if squared < best.0 {
            best = (squared, i, offset);
        }
    }
    let (squared, i, offset) = best;
    let is_inside = new_triangles.get(i)?.normal.dot(&offset) >= 0.0;
    let limit_mm = if is_inside {
        stray.inside_mm
    } else {
        stray.outside_mm
    };
    (squared <= limit_mm * limit_mm).then_some(i)
}

/// Returns for each side of a triangle a vector in its plane that points across it inward.
fn inward([a, b, c]: &[Point; 3], normal: &Vector) -> [Vector; 3] {
    [b - a, c - b, a - c].map(|side| normal.cross(&side))
}

fn longest_squared([a, b, c]: &[Point; 3]) -> f64 {
    (b - a)
        .norm_squared()
        .max((c - b).norm_squared())
        .max((a - c).norm_squared())
}
