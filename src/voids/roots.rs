//! The surface's vertices: the points in which the surface crosses the lattice's edges.

use super::field::{Field, Known};
use super::nodes::Nodes;
use super::runs::map_in_runs;
use super::table::IndexMap;
use crate::base::watch::{Cancelled, Watch};

/// Value of the function at which a crossing counts as found, mm: a hundredth of the accuracy
/// promised for a wall.
const ROOT_TOLERANCE_MM: f64 = 1e-4;

/// Steps after which the best crossing so far is taken. At a kink of the function the secant only
/// halves the edge.
const STEPS_MAX: usize = 24;

/// Least distance of the crossing from the edge's ends, as a share of the edge, so that no triangle
/// collapses.
const END_RATIO: f64 = 1e-3;

/// The name of a surface vertex: its edge's two corners, or the same corner of the lattice twice.
pub(super) type VertexKey = u64;

/// Returns the name of the crossing between two corners.
pub(super) fn crossing_key(a: u32, b: u32) -> VertexKey {
    (u64::from(a.min(b)) << 32) | u64::from(a.max(b))
}

/// Returns the name of a corner of the lattice that serves as a vertex.
pub(super) fn corner_key(a: u32) -> VertexKey {
    (u64::from(a) << 32) | u64::from(a)
}

/// Returns whether a name is that of a crossing.
pub(super) fn is_crossing(key: VertexKey) -> bool {
    let (a, b) = ends(key);
    a != b
}

/// Returns the two corners in a name.
fn ends(key: VertexKey) -> (u32, u32) {
    ((key >> 32) as u32, key as u32)
}

/// A crossing, with the sum of its corners' versions when it was found.
struct Root {
    key: VertexKey,
    found: Known,
    version: u32,
}

/// All crossings met so far.
#[derive(Default)]
pub(super) struct Roots {
    index: IndexMap,
    roots: Vec<Root>,
}

impl Roots {
    /// Returns the place of a vertex and the function there; `None` if it was never prepared.
    pub fn vertex<'a>(&'a self, nodes: &'a Nodes, key: VertexKey) -> Option<&'a Known> {
        let (a, b) = ends(key);
        if a == b {
            return Some(&nodes.node(a).placed);
        }
        self.index.get(&key).map(|&i| &self.roots[i as usize].found)
    }

    /// Finds the crossings again on edges whose corners have moved.
    pub fn refresh(
        &mut self,
        nodes: &Nodes,
        field: &impl Field,
        watch: &Watch,
    ) -> Result<(), Cancelled> {
        let stale = |root: &&Root| root.version != version(nodes, root.key);
        let keys: Vec<VertexKey> = self
            .roots
            .iter()
            .filter(stale)
            .map(|root| root.key)
            .collect();
        self.prepare(nodes, keys.into_iter(), field, watch)
    }

    /// Finds those crossings that are new or whose corners have moved.
    pub fn prepare(
        &mut self,
        nodes: &Nodes,
        keys: impl Iterator<Item = VertexKey>,
        field: &impl Field,
        watch: &Watch,
    ) -> Result<(), Cancelled> {
        let mut wanted: Vec<(u32, VertexKey)> = Vec::new();
        let mut count = self.roots.len() as u32;
        for key in keys {
            let number = *self.index.entry(key).or_insert(count);
            let is_new = number == count;
            count += u32::from(is_new);
            let is_stale = self
                .roots
                .get(number as usize)
                .is_some_and(|root| root.version != version(nodes, key));
            if is_new || is_stale {
                wanted.push((number, key));
            }
        }
        let find = |i: usize| find_root(nodes, wanted[i].1, field);
        let found: Vec<Root> = map_in_runs(wanted.len(), watch, find)?;
        for ((number, _), root) in wanted.into_iter().zip(found) {
            match self.roots.get_mut(number as usize) {
                Some(stale) => *stale = root,
                None => self.roots.push(root),
            }
        }
        Ok(())
    }
}

fn version(nodes: &Nodes, key: VertexKey) -> u32 {
    let (a, b) = ends(key);
    nodes.node(a).version + nodes.node(b).version
}

fn find_root(nodes: &Nodes, key: VertexKey, field: &impl Field) -> Root {
    let (a, b) = ends(key);
    let found = find_crossing(&nodes.node(a).placed, &nodes.node(b).placed, field);
    Root {
        key,
        found,
        version: version(nodes, key),
    }
}

/// Returns the zero of the function on the segment between two points of different sign, by the
/// Illinois method (Dowell & Jarratt, BIT 11, 1971).
fn find_crossing(a: &Known, b: &Known, field: &impl Field) -> Known {
    let mut bracket = Bracket {
        low: (0.0, a.sample.value),
        high: (1.0, b.sample.value),
        kept: 0,
    };
    let nearby = if a.sample.is_positive() {
        [*a, *b]
    } else {
        [*b, *a]
    };
    let mut found = *a;
    for _ in 0..STEPS_MAX {
        let t = bracket.secant().clamp(END_RATIO, 1.0 - END_RATIO);
        let at = a.at + (b.at - a.at) * t;
        found = Known {
            at,
            sample: field.sample(&at, &nearby),
        };
        let is_low = found.sample.is_positive() == a.sample.is_positive();
        let is_at_end = (t <= END_RATIO && !is_low) || (t >= 1.0 - END_RATIO && is_low);
        if is_at_end || found.sample.value.abs() <= ROOT_TOLERANCE_MM {
            break;
        }
        bracket.shrink(t, found.sample.value, is_low);
    }
    found
}

/// Two points (parameter, value) of different sign. `kept` counts how often in a row the same end
/// was replaced: below 0 the low one, above 0 the high one.
struct Bracket {
    low: (f64, f64),
    high: (f64, f64),
    kept: i32,
}

impl Bracket {
    fn secant(&self) -> f64 {
        let (low, high) = (self.low, self.high);
        if high.1 == low.1 {
            0.5 * (low.0 + high.0)
        } else {
            (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1)
        }
    }

    /// Replaces one end. An end kept for the second time in a row counts half.
    fn shrink(&mut self, t: f64, value: f64, is_low: bool) {
        if is_low {
            self.low = (t, value);
            self.high.1 *= if self.kept < 0 { 0.5 } else { 1.0 };
            self.kept = -1;
        } else {
            self.high = (t, value);
            self.low.1 *= if self.kept > 0 { 0.5 } else { 1.0 };
            self.kept = 1;
        }
    }
}
