//! Tidies a raw skeleton: short tips go, junctures within one ball become one.

use super::graph::{Graph, Path};
use crate::geom::{Bvh, Point};

/// A tip that reaches less far than this many radii of the ball at its juncture is a bump of that
/// ball. With less, fingers and folds get branches; with more, ears and noses lose theirs.
const BUMP_RATIO: f64 = 1.25;
/// A tip within this share of the ball at its juncture is no end of its own, however thick it is.
const INSIDE_RATIO: f64 = 0.5;

/// Returns the radius of the largest ball about a point inside a surface, mm; negative outside.
pub(super) fn depth_mm(surface: &Bvh, at: &Point) -> f64 {
    let nearest = surface.closest(at, f64::INFINITY, &[]);
    let distance_mm = nearest.map_or(0.0, |nearest| nearest.distance_squared.sqrt());
    if surface.winding(at) > 0 {
        distance_mm
    } else {
        -distance_mm
    }
}

/// Prunes bumps, then merges junctures, until there is nothing left to do.
pub(super) fn tidy(graph: &mut Graph, surface: &Bvh) {
    while let Some(bump) = shortest_bump(graph, surface) {
        let [tip, _] = tip_first(graph, &bump);
        graph.remove(tip);
        bump.inner().iter().for_each(|node| graph.remove(*node));
    }
    while merge_one(graph, surface) {}
}

/// Merges two junctures whose branch lies within the larger of their balls; false if there are
/// none.
fn merge_one(graph: &mut Graph, surface: &Bvh) -> bool {
    let is_juncture = |node: usize| graph.degree(node) > 2;
    let paths = graph.paths().into_iter();
    let mut between = paths.filter(|path| path.ends().into_iter().all(is_juncture));
    let path = between.find(|path| {
        let balls = path.ends().map(|node| depth_mm(surface, &graph.at[node]));
        graph.length_mm(path) < balls[0].max(balls[1]) && keeps_loops(graph, path)
    });
    let Some(path) = path else {
        return false;
    };
    let [a, b] = path.ends();
    let is_larger = depth_mm(surface, &graph.at[a]) >= depth_mm(surface, &graph.at[b]);
    let [kept, gone] = if is_larger { [a, b] } else { [b, a] };
    path.inner().iter().for_each(|node| graph.remove(*node));
    let others: Vec<usize> = graph.linked(gone).filter(|node| *node != kept).collect();
    graph.remove(gone);
    others.into_iter().for_each(|node| graph.link([kept, node]));
    true
}

/// Returns true if no loop is lost when both ends of a path become one.
fn keeps_loops(graph: &Graph, path: &Path) -> bool {
    let [a, b] = path.ends();
    let is_direct = path.nodes.len() == 2;
    let shares = graph
        .linked(a)
        .any(|node| graph.is_linked([node, b]) && !path.inner().contains(&node));
    a != b && !shares && (is_direct || !graph.is_linked([a, b]))
}

/// Returns the tip branch that is shortest against the ball at its juncture, if it is a bump.
fn shortest_bump(graph: &Graph, surface: &Bvh) -> Option<Path> {
    let bump = |path: Path| {
        let [tip, juncture] = tip_first(graph, &path);
        let is_tip = graph.degree(tip) == 1 && graph.degree(juncture) > 2;
        let ball_mm = depth_mm(surface, &graph.at[juncture]);
        let length_mm = graph.length_mm(&path);
        let reach_mm = length_mm + depth_mm(surface, &graph.at[tip]).max(0.0);
        let is_bump = reach_mm < BUMP_RATIO * ball_mm || length_mm < INSIDE_RATIO * ball_mm;
        let ratio = length_mm / ball_mm.max(f64::MIN_POSITIVE);
        (is_tip && is_bump).then_some((ratio, path))
    };
    let bumps = graph.paths().into_iter().filter_map(bump);
    let shortest = bumps.min_by(|(a, _), (b, _)| a.total_cmp(b));
    shortest.map(|(_, path)| path)
}

/// Returns the ends of a path, a tip before a juncture.
fn tip_first(graph: &Graph, path: &Path) -> [usize; 2] {
    let [a, b] = path.ends();
    if graph.degree(a) == 1 { [a, b] } else { [b, a] }
}
