//! The place of ballast as a worker measures it: from two edges of its panel.

use super::made::Made;
use super::mass::Weighed;
use crate::panels::Panel;
use crate::sheet::core_kit::{BallastEdge, BallastRow, EdgeDistance};

/// The share of an edge at each end that is not looked at: fingers of the next edge reach there.
const END_RATIO: f64 = 0.1;
/// The least sine of the angle between the two edges: 30°.
const LEAST_SINE: f64 = 0.5;

/// Returns the panel with the ballast, and its index; `None` without any.
fn panel<'a>(made: &'a Made, weighed: &Weighed) -> Option<(usize, &'a Panel)> {
    let index = weighed.ballast.first()?.panel.checked_sub(1)?;
    let panel = made.built.shell.panels.panels.get(index)?;
    Some((index, panel))
}

/// Returns the outline of the panel with the ballast, mm; empty without any.
pub fn ballast_panel(made: &Made, weighed: &Weighed) -> Vec<[f64; 2]> {
    let found = panel(made, weighed);
    found.map_or_else(Vec::new, |(_, panel)| panel.outline.corners().to_vec())
}

/// Returns the edges of that panel, each moved out to the tips of its fingers.
pub fn ballast_edges(made: &Made, weighed: &Weighed) -> Vec<BallastEdge> {
    let Some((index, panel)) = panel(made, weighed) else {
        return Vec::new();
    };
    let edges = made.built.shell.panels.edges.iter();
    let own = edges.filter(|edge| edge.panels.contains(&index));
    own.map(|edge| {
        let [first, second] = edge.panels;
        let ends_mm = edge.ends.map(|end| {
            let local = panel.frame.to_local(&end);
            [local.x, local.y]
        });
        BallastEdge {
            to: if first == index { second } else { first } + 1,
            ends_mm: at_tips(panel.outline.corners(), ends_mm),
        }
    })
    .collect()
}

/// Returns the line along the outermost points of an outline between both ends, counterclockwise.
fn at_tips(outline: &[[f64; 2]], [start, end]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let count = outline.len().max(1) as f64;
    let middle = outline.iter().fold([0.0; 2], |sum, at| {
        [sum[0] + at[0] / count, sum[1] + at[1] / count]
    });
    let forward = Line::new([start, end]);
    let [start, end] = if forward.out_mm(middle) <= 0.0 {
        [start, end]
    } else {
        [end, start]
    };
    let line = Line::new([start, end]);
    let [low, high] = [END_RATIO, 1.0 - END_RATIO].map(|share| share * line.length_mm);
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    let reaches = sides.flat_map(|(&a, &b)| {
        let [(from, a_mm), (to, b_mm)] = [a, b].map(|at| (line.along_mm(at), line.out_mm(at)));
        let is_apart = from.max(to) < low || from.min(to) > high;
        let height = |at: f64| match to - from {
            0.0 => a_mm.max(b_mm),
            run => a_mm + (b_mm - a_mm) * (at - from) / run,
        };
        let ends = [from, to].map(|at| height(at.clamp(low, high)));
        (!is_apart).then_some(ends).into_iter().flatten()
    });
    let out_mm = reaches.fold(f64::NEG_INFINITY, f64::max);
    let out_mm = if out_mm.is_finite() { out_mm } else { 0.0 };
    let moved = |[x, y]: [f64; 2]| [x + line.way[1] * out_mm, y - line.way[0] * out_mm];
    [moved(start), moved(end)]
}

/// A line in a panel; out is to its right.
struct Line {
    start: [f64; 2],
    /// The unit direction.
    way: [f64; 2],
    length_mm: f64,
}

impl Line {
    fn new([start, end]: [[f64; 2]; 2]) -> Self {
        let [x, y] = [end[0] - start[0], end[1] - start[1]];
        let length_mm = x.hypot(y);
        Self {
            start,
            way: [x / length_mm, y / length_mm],
            length_mm,
        }
    }

    fn along_mm(&self, [x, y]: [f64; 2]) -> f64 {
        (x - self.start[0]) * self.way[0] + (y - self.start[1]) * self.way[1]
    }

    fn out_mm(&self, [x, y]: [f64; 2]) -> f64 {
        (x - self.start[0]) * self.way[1] - (y - self.start[1]) * self.way[0]
    }
}

/// Returns the distances of all pieces from two edges each.
pub fn ballast_rows(edges: &[BallastEdge], weighed: &Weighed) -> Vec<BallastRow> {
    let pieces = weighed.ballast.iter();
    let rows = pieces.map(|piece| BallastRow {
        from: from_two(edges, piece.at_mm),
    });
    rows.collect()
}

/// Returns the distances from the nearest edge, and from the nearest one across it.
fn from_two(edges: &[BallastEdge], at_mm: [f64; 2]) -> Vec<EdgeDistance> {
    let mut all: Vec<(Line, EdgeDistance)> = edges
        .iter()
        .map(|edge| {
            let line = Line::new(edge.ends_mm);
            let distance_mm = -line.out_mm(at_mm);
            let to = edge.to;
            (line, EdgeDistance { to, distance_mm })
        })
        .collect();
    all.sort_by(|a, b| a.1.distance_mm.total_cmp(&b.1.distance_mm));
    let Some(((first, nearest), others)) = all.split_first() else {
        return Vec::new();
    };
    let sine = |line: &Line| (first.way[0] * line.way[1] - first.way[1] * line.way[0]).abs();
    let across = others.iter().find(|(line, _)| sine(line) >= LEAST_SINE);
    let steepest = || {
        let steeper = others.iter();
        steeper.max_by(|a, b| sine(&a.0).total_cmp(&sine(&b.0)))
    };
    let second = across.or_else(steepest);
    let second = second.map(|(_, distance)| *distance);
    [*nearest].into_iter().chain(second).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A panel of 100 x 60 mm, with a finger of 3 mm on its lower edge.
    const OUTLINE: [[f64; 2]; 8] = [
        [0.0, 0.0],
        [40.0, 0.0],
        [40.0, -3.0],
        [60.0, -3.0],
        [60.0, 0.0],
        [100.0, 0.0],
        [100.0, 60.0],
        [0.0, 60.0],
    ];

    #[test]
    fn a_piece_is_measured_from_the_tips_of_two_edges_across_each_other() {
        let edge = |to: usize, ends_mm: [[f64; 2]; 2]| BallastEdge {
            to,
            ends_mm: at_tips(&OUTLINE, ends_mm),
        };
        let edges = [
            // Its ends come in either order.
            edge(4, [[100.0, 0.0], [0.0, 0.0]]),
            edge(2, [[100.0, 0.0], [100.0, 60.0]]),
            edge(5, [[100.0, 60.0], [0.0, 60.0]]),
            edge(3, [[0.0, 60.0], [0.0, 0.0]]),
        ];
        assert_eq!(edges[0].ends_mm, [[0.0, -3.0], [100.0, -3.0]]);
        assert_eq!(edges[2].ends_mm, [[100.0, 60.0], [0.0, 60.0]]);
        let found = |at_mm: [f64; 2]| {
            let rows = from_two(&edges, at_mm).into_iter();
            rows.map(|row| (row.to, row.distance_mm))
                .collect::<Vec<_>>()
        };
        assert_eq!(found([70.0, 20.0]), [(4, 23.0), (2, 30.0)]);
        // The upper edge is nearer than any other one, but runs along the nearest.
        assert_eq!(found([45.0, 31.0]), [(5, 29.0), (3, 45.0)]);
    }
}
