//! Flat regions drawn anew with few triangles.

use std::cmp::Ordering;

use super::chain::Corners;
use crate::geom::{Aabb, Point};

/// A directed edge.
type Edge = [Point; 2];

/// Draws a flat region on a side of a box anew: with a triangle for every edge of its border.
///
/// Borders along the box's edges become as long as they can. Points that are `near_mm` from a line
/// lie on it. The triangles are signed, as those of a chain are.
pub(super) fn anew(triangles: &[Corners], bounds: &Aabb, near_mm: f64) -> Vec<Corners> {
    let (along, mut border) = part(border(triangles), bounds, near_mm);
    for (line, edges) in along.into_iter().enumerate() {
        // A line is parallel to an axis.
        border.extend(joined(edges, line % 3));
    }
    let Some(&[apex, _]) = border.first() else {
        return Vec::new();
    };
    let fan = border.iter().map(|&[from, to]| [apex, from, to]);
    let has_area = |[apex, from, to]: &Corners| apex != from && apex != to;
    fan.filter(has_area).collect()
}

/// Returns the edges of triangles without those that cancel each other.
fn border(triangles: &[Corners]) -> Vec<Edge> {
    let edges = triangles
        .iter()
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut signed: Vec<(Edge, i32)> = edges
        .map(|[from, to]| match order(from, to) {
            Ordering::Greater => ([*to, *from], -1),
            _ => ([*from, *to], 1),
        })
        .collect();
    signed.sort_by(|([a, b], _), ([c, d], _)| order(a, c).then(order(b, d)));
    let mut left = Vec::new();
    for group in signed.chunk_by(|(one, _), (other, _)| one == other) {
        let [from, to] = group[0].0;
        let count: i32 = group.iter().map(|(_, sign)| sign).sum();
        let edge = if count > 0 { [from, to] } else { [to, from] };
        left.extend(std::iter::repeat_n(edge, count.unsigned_abs() as usize));
    }
    left
}

/// Parts the edges that lie along the twelve edges of a box from the others. Line k is parallel to
/// axis k % 3.
fn part(edges: Vec<Edge>, bounds: &Aabb, near_mm: f64) -> ([Vec<Edge>; 12], Vec<Edge>) {
    let mut along: [Vec<Edge>; 12] = Default::default();
    let mut others = Vec::new();
    for edge in edges {
        let line = (0..12).find(|line| {
            let axis = line % 3;
            let is_at =
                |across: usize, end: f64| edge.iter().all(|at| (at[across] - end).abs() <= near_mm);
            let end = |across: usize, bit: usize| {
                [bounds.min[across], bounds.max[across]][((line / 3) >> bit) & 1]
            };
            let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
            is_at(one, end(one, 0)) && is_at(other, end(other, 1))
        });
        match line {
            Some(line) => along[line].push(edge),
            None => others.push(edge),
        }
    }
    (along, others)
}

/// Returns the edges along a line that have the same ends, counted with their signs.
fn joined(edges: Vec<Edge>, axis: usize) -> Vec<Edge> {
    let ends = edges
        .into_iter()
        .flat_map(|[from, to]| [(from, 1), (to, -1)]);
    let mut ends: Vec<(Point, i32)> = ends.collect();
    ends.sort_by(|(a, _), (b, _)| a[axis].total_cmp(&b[axis]).then(order(a, b)));
    let mut left = Vec::new();
    let mut open = 0;
    for pair in ends.windows(2) {
        open += pair[0].1;
        let [from, to] = [pair[0].0, pair[1].0];
        if open == 0 || from == to {
            continue;
        }
        let edge = if open > 0 { [from, to] } else { [to, from] };
        // One that goes on from the last is its longer part.
        match left.last_mut() {
            Some((last, count)) if *count == open && meets(last, &edge, open) => {
                *last = if open > 0 {
                    [last[0], to]
                } else {
                    [to, last[1]]
                };
            }
            _ => left.push((edge, open)),
        }
    }
    let many =
        |(edge, count): (Edge, i32)| std::iter::repeat_n(edge, count.unsigned_abs() as usize);
    left.into_iter().flat_map(many).collect()
}

/// Returns true if an edge goes on where the last one along its line ends.
fn meets(last: &Edge, next: &Edge, open: i32) -> bool {
    if open > 0 {
        last[1] == next[0]
    } else {
        last[0] == next[1]
    }
}

/// Returns the order of two points by their coordinates.
pub(super) fn order(a: &Point, b: &Point) -> Ordering {
    let axes = (0..3).map(|axis| a[axis].total_cmp(&b[axis]));
    axes.fold(Ordering::Equal, Ordering::then)
}
