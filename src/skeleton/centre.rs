//! Spreads the nodes of a skeleton evenly along its branches and centres them in the body.

use rayon::prelude::*;

use super::graph::{Graph, Path};
use super::tidy::depth_mm;
use crate::geom::{Bvh, Point, Vector};

/// Rounds of centring and smoothing.
const ROUNDS: usize = 3;
/// Least share of its ball that a node keeps when it is smoothed.
const KEPT_BALL_RATIO: f64 = 0.95;
/// Share of the way to the middle of its neighbours that a node is smoothed.
const SMOOTH_RATIO: f64 = 0.5;
/// Steps of the climb to the largest ball at most.
const MOST_STEPS: usize = 24;
/// First step of the climb, and the step at which it ends, as shares of the ball.
const FIRST_STEP: f64 = 0.5;
const LAST_STEP: f64 = 0.02;
/// The longest way of a node in one round, as a share of the ball there. With more, it jumps from
/// a limb into the next.
const MOST_MOVE_RATIO: f64 = 0.5;

/// Returns the graph with nodes about `spacing_mm` apart along every branch.
///
/// Branches keep two links at least, so that no two of them become one; a ring keeps three.
pub(super) fn spread(graph: &Graph, spacing_mm: f64) -> Graph {
    let mut spread = Graph::default();
    let mut number = vec![None; graph.at.len()];
    let mut node_of = |spread: &mut Graph, node: usize| {
        *number[node].get_or_insert_with(|| spread.add(graph.at[node]))
    };
    for node in graph.nodes().filter(|node| graph.degree(*node) != 2) {
        node_of(&mut spread, node);
    }
    for path in graph.paths() {
        let ends = path.ends().map(|node| node_of(&mut spread, node));
        let mut before = ends[0];
        for at in between(graph, &path, spacing_mm) {
            let node = spread.add(at);
            spread.link([before, node]);
            before = node;
        }
        spread.link([before, ends[1]]);
    }
    spread
}

/// Returns the points that divide a path evenly, without its ends.
fn between(graph: &Graph, path: &Path, spacing_mm: f64) -> Vec<Point> {
    let [first, last] = path.ends();
    let least = if first == last { 3 } else { 2 };
    let length_mm = graph.length_mm(path);
    let links = ((length_mm / spacing_mm).round() as usize).max(least);
    let mut points = Vec::new();
    let mut done_mm = 0.0;
    for step in path.nodes.windows(2) {
        let [from, to] = [step[0], step[1]].map(|node| graph.at[node]);
        let step_mm = (to - from).norm();
        while points.len() + 1 < links {
            let next_mm = length_mm * (points.len() + 1) as f64 / links as f64;
            if next_mm > done_mm + step_mm {
                break;
            }
            let share = ((next_mm - done_mm) / step_mm.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            points.push(from + (to - from) * share);
        }
        done_mm += step_mm;
    }
    points
}

/// Centres the nodes in the body by their balls, smooths the branches, and makes them straight
/// within the balls of junctures.
pub(super) fn center(graph: &mut Graph, surface: &Bvh) {
    for _ in 0..ROUNDS {
        move_all(graph, |graph, node| {
            let tangent = tangent(graph, node);
            climb(surface, &graph.at[node], tangent.as_ref())
        });
        move_all(graph, |graph, node| smooth(graph, surface, node));
    }
    for path in graph.paths() {
        straighten(graph, surface, &path.nodes);
        let back: Vec<usize> = path.nodes.into_iter().rev().collect();
        straighten(graph, surface, &back);
    }
}

/// Lays the nodes within the ball of a juncture on the line to the first node beyond it.
///
/// There the largest balls lie anywhere, so that centred nodes run to and fro.
fn straighten(graph: &mut Graph, surface: &Bvh, nodes: &[usize]) {
    let from = graph.at[nodes[0]];
    let ball_mm = depth_mm(surface, &from);
    let is_beyond = |node: &usize| (graph.at[*node] - from).norm() > ball_mm;
    let Some(steps) = nodes.iter().position(is_beyond) else {
        return;
    };
    if graph.degree(nodes[0]) < 3 {
        return;
    }
    let way = graph.at[nodes[steps]] - from;
    for (step, node) in nodes.iter().enumerate().take(steps).skip(1) {
        let at = from + way * (step as f64 / steps as f64);
        if depth_mm(surface, &at) > 0.0 {
            graph.at[*node] = at;
        }
    }
}

/// Moves every node to where `place` puts it, all at once.
fn move_all(graph: &mut Graph, place: impl Fn(&Graph, usize) -> Point + Sync) {
    let nodes: Vec<usize> = graph.nodes().collect();
    let places: Vec<Point> = nodes.par_iter().map(|node| place(graph, *node)).collect();
    for (node, place) in nodes.into_iter().zip(places) {
        graph.at[node] = place;
    }
}

/// Returns the direction of the branch at a node; `None` at a juncture and for a lone node.
fn tangent(graph: &Graph, node: usize) -> Option<Vector> {
    let linked: Vec<Point> = graph.linked(node).map(|other| graph.at[other]).collect();
    let along = match linked[..] {
        [other] => graph.at[node] - other,
        [a, b] => b - a,
        _ => return None,
    };
    along.try_normalize(0.0)
}

/// Returns the middle of the largest ball near a place; across the tangent, if there is one.
fn climb(surface: &Bvh, start: &Point, tangent: Option<&Vector>) -> Point {
    let mut at = *start;
    let mut depth = depth_mm(surface, &at);
    let ball_mm = depth.abs();
    let mut step_mm = FIRST_STEP * ball_mm;
    for _ in 0..MOST_STEPS {
        let Some(uphill) = uphill(surface, &at, depth, tangent) else {
            break;
        };
        let next = at + uphill * step_mm;
        let next_depth = depth_mm(surface, &next);
        let is_near = depth < 0.0 || (next - start).norm() <= MOST_MOVE_RATIO * ball_mm;
        if next_depth > depth && is_near {
            (at, depth) = (next, next_depth);
        } else {
            step_mm *= 0.5;
        }
        if step_mm < LAST_STEP * ball_mm {
            break;
        }
    }
    at
}

/// Returns the direction in which the ball grows, across the tangent; `None` on the surface and
/// where it grows along the tangent only.
fn uphill(surface: &Bvh, at: &Point, depth: f64, tangent: Option<&Vector>) -> Option<Vector> {
    let nearest = surface.closest(at, f64::INFINITY, &[])?;
    let away = (at - nearest.point) * depth.signum();
    let along = tangent.map_or(Vector::zeros(), |tangent| tangent * tangent.dot(&away));
    (away - along).try_normalize(f64::EPSILON * (1.0 + at.coords.norm()))
}

/// Returns the place of a node nearer to the middle of its neighbours, if its ball stays as large
/// there. Tips and junctures stay.
fn smooth(graph: &Graph, surface: &Bvh, node: usize) -> Point {
    let at = graph.at[node];
    let linked: Vec<Point> = graph.linked(node).map(|other| graph.at[other]).collect();
    let [a, b] = linked[..] else {
        return at;
    };
    let smooth = at + (nalgebra::center(&a, &b) - at) * SMOOTH_RATIO;
    if depth_mm(surface, &smooth) > KEPT_BALL_RATIO * depth_mm(surface, &at) {
        smooth
    } else {
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::cylinder;

    fn line(points: &[Point]) -> Graph {
        let mut graph = Graph::default();
        let nodes: Vec<usize> = points.iter().map(|at| graph.add(*at)).collect();
        nodes
            .windows(2)
            .for_each(|pair| graph.link([pair[0], pair[1]]));
        graph
    }

    #[test]
    fn nodes_are_spread_evenly_and_the_ends_stay() {
        let graph = line(&[0.0, 1.0, 9.0, 10.0].map(|x| Point::new(x, 0.0, 0.0)));
        let spread = spread(&graph, 2.0);
        let mut xs: Vec<f64> = spread.at.iter().map(|at| at.x).collect();
        xs.sort_by(f64::total_cmp);
        let expected = [0.0, 2.0, 4.0, 6.0, 8.0, 10.0];
        assert!(xs.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-12));
        assert_eq!((spread.count(), spread.edges().len()), (6, 5));
    }

    #[test]
    fn nodes_beside_the_axis_of_a_rod_are_centred() {
        let mesh = cylinder(4.0, 40.0, 48);
        let bvh = Bvh::new(mesh.iter_corners());
        let off = [1.0, -2.0, 2.0, -1.0, 1.0];
        let points = off.iter().enumerate();
        let points = points.map(|(i, x)| Point::new(*x, 0.5 * x, 10.0 + 5.0 * i as f64));
        let mut graph = line(&points.collect::<Vec<_>>());
        center(&mut graph, &bvh);
        for at in &graph.at {
            assert!(at.coords.xy().norm() < 0.4, "{at}");
        }
    }
}
