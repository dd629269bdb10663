//! Places along a limb.

use crate::geom::{Point, Vector};
use crate::skeleton::Chain;

/// Returns the radius that a limb has where it leaves its juncture, mm.
pub fn radius_mm(chain: &Chain) -> f64 {
    chain.radius_at_mm(chain.start_mm)
}

/// Returns the point of a limb at an arc length; behind its juncture's ball it goes on straight.
pub fn at(chain: &Chain, arc_mm: f64) -> Point {
    if arc_mm >= chain.start_mm {
        return on_nodes(chain, arc_mm);
    }
    let from = on_nodes(chain, chain.start_mm);
    from - direction(chain) * (chain.start_mm - arc_mm)
}

/// Returns the direction in which a limb leaves its juncture.
///
/// It is taken over one radius, so that a bend of the skeleton within it does not count.
pub fn direction(chain: &Chain) -> Vector {
    let reach_mm = radius_mm(chain).min(0.5 * chain.free_mm());
    let from = on_nodes(chain, chain.start_mm);
    let ahead = on_nodes(chain, chain.start_mm + reach_mm) - from;
    ahead.try_normalize(0.0).unwrap_or_else(Vector::z)
}

/// Returns the point of the line through the nodes at an arc length; beyond its end it goes on.
fn on_nodes(chain: &Chain, arc_mm: f64) -> Point {
    let arcs = chain.arcs_mm();
    let after = arcs.partition_point(|arc| *arc <= arc_mm);
    let edge = after.clamp(1, arcs.len() - 1) - 1;
    let span = (arcs[edge + 1] - arcs[edge]).max(f64::MIN_POSITIVE);
    let share = (arc_mm - arcs[edge]) / span;
    chain.points[edge] + (chain.points[edge + 1] - chain.points[edge]) * share
}
