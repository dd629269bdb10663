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

/// Steps that use the slopes at both ends. They find almost every crossing; more would delay the
/// method that always converges.
const SLOPE_STEPS: usize = 4;

/// Newton steps to the zero of a cubic, which is needed to a share of 1e-4 only.
const CUBIC_STEPS: usize = 3;

/// Least distance of the crossing from the edge's ends, as a share of the edge, so that no triangle
/// collapses.
const END_RATIO: f64 = 1e-3;

/// The name of a surface vertex: its edge's two corners, or the same corner of the lattice twice.
pub(super) type VertexKey = u64;

/// Returns the name of the crossing between two corners.
#[inline]
pub(super) fn crossing_key(a: u32, b: u32) -> VertexKey {
    (u64::from(a.min(b)) << 32) | u64::from(a.max(b))
}

/// Returns the name of a corner of the lattice that serves as a vertex.
pub(super) fn corner_key(a: u32) -> VertexKey {
    (u64::from(a) << 32) | u64::from(a)
}

/// Returns whether a name is that of a crossing.
#[inline]
pub(super) fn is_crossing(key: VertexKey) -> bool {
    let (a, b) = ends(key);
    a != b
}

/// Bit that tells a corner of the lattice from a crossing. Neither has so many numbers: their
/// points alone would take 50 GB.
const CORNER_BIT: u32 = 1 << 31;

/// The number of a surface vertex: that of a crossing, or that of a corner with [`CORNER_BIT`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Vertex(u32);

impl Vertex {
    /// Returns the place of the vertex in a list of all crossings, then all corners.
    pub fn place(self, crossings: usize) -> usize {
        if self.0 & CORNER_BIT == 0 {
            self.0 as usize
        } else {
            crossings + (self.0 & !CORNER_BIT) as usize
        }
    }
}

/// The crossings that a leaf's pieces name.
#[derive(Clone, Copy)]
pub(super) struct Named<'a> {
    /// Their names, ascending.
    pub keys: &'a [VertexKey],
    /// Their numbers, in the same order.
    pub numbers: &'a [u32],
}

/// Returns the number of a vertex. If it is a crossing, it is among the named ones.
#[inline]
pub(super) fn vertex_of(key: VertexKey, named: Named) -> Vertex {
    match named.keys.binary_search(&key) {
        Ok(at) => Vertex(named.numbers[at]),
        Err(_) => Vertex(key as u32 | CORNER_BIT),
    }
}

/// Returns the two corners in a name.
#[inline]
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
    /// Returns the number of crossings.
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Returns the place of a vertex and the function there.
    #[inline]
    pub fn vertex<'a>(&'a self, nodes: &'a Nodes, vertex: Vertex) -> &'a Known {
        if vertex.0 & CORNER_BIT == 0 {
            &self.roots[vertex.0 as usize].found
        } else {
            &nodes.node(vertex.0 & !CORNER_BIT).placed
        }
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
        self.prepare(nodes, keys.into_iter(), field, watch)?;
        Ok(())
    }

    /// Finds those crossings that are new or whose corners have moved. Returns the number of each.
    pub fn prepare(
        &mut self,
        nodes: &Nodes,
        keys: impl Iterator<Item = VertexKey>,
        field: &impl Field,
        watch: &Watch,
    ) -> Result<Vec<u32>, Cancelled> {
        let mut wanted: Vec<(u32, VertexKey)> = Vec::new();
        let mut numbers: Vec<u32> = Vec::new();
        let mut count = self.roots.len() as u32;
        for key in keys {
            let number = *self.index.entry(key).or_insert(count);
            numbers.push(number);
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
        Ok(numbers)
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

/// Returns the zero of the function on the segment between two points of different sign. If the
/// slopes do not lead there, the Illinois method does (Dowell & Jarratt, BIT 11, 1971).
fn find_crossing(a: &Known, b: &Known, field: &impl Field) -> Known {
    let along = b.at - a.at;
    let end = |t: f64, known: &Known| End {
        t,
        value: known.sample.value,
        slope: known.sample.gradient.dot(&along),
    };
    let mut bracket = Bracket {
        low: end(0.0, a),
        high: end(1.0, b),
        kept: 0,
    };
    let nearby = if a.sample.is_positive() {
        [*a, *b]
    } else {
        [*b, *a]
    };
    let mut found = *a;
    let slope_steps = if field.is_distance() { SLOPE_STEPS } else { 0 };
    for step in 0..STEPS_MAX {
        let guess = if step < slope_steps {
            bracket.guess()
        } else {
            bracket.secant()
        };
        let t = guess.clamp(END_RATIO, 1.0 - END_RATIO);
        let at = a.at + along * t;
        found = Known {
            at,
            sample: field.sample(&at, &nearby),
        };
        let is_low = found.sample.is_positive() == a.sample.is_positive();
        let is_at_end = (t <= END_RATIO && !is_low) || (t >= 1.0 - END_RATIO && is_low);
        if is_at_end || found.sample.value.abs() <= ROOT_TOLERANCE_MM {
            break;
        }
        bracket.shrink(end(t, &found), is_low, step >= slope_steps);
    }
    found
}

/// A point of an edge: its share of the edge, the function there and its slope along the edge.
#[derive(Clone, Copy)]
struct End {
    t: f64,
    value: f64,
    slope: f64,
}

/// Two points of different sign. `kept` tells which end was replaced last: below 0 the low one,
/// above 0 the high one.
struct Bracket {
    low: End,
    high: End,
    kept: i32,
}

impl Bracket {
    fn secant(&self) -> f64 {
        let (low, high) = (self.low, self.high);
        if high.value == low.value {
            0.5 * (low.t + high.t)
        } else {
            (low.t * high.value - high.t * low.value) / (high.value - low.value)
        }
    }

    /// Returns the zero that the values and slopes at both ends suggest.
    ///
    /// A function that bends down between its ends has a crease there: it follows one tangent, then
    /// the other. Any other function is smooth: it follows a cubic.
    fn guess(&self) -> f64 {
        let (low, high) = (self.low, self.high);
        let width = high.t - low.t;
        let (from, to) = (low.slope * width, high.slope * width);
        let rise = high.value - low.value;
        let u = if from >= rise && rise >= to {
            self.crease_zero(from, to)
        } else {
            self.cubic_zero(from, to)
        };
        if u > 0.0 && u < 1.0 {
            low.t + u * width
        } else {
            self.secant()
        }
    }

    /// Returns the first zero of the two tangents, seen from the positive end, as a share of the
    /// width. Their slopes are given over the width.
    fn crease_zero(&self, from: f64, to: f64) -> f64 {
        let (low, high) = (self.low.value, self.high.value);
        let [first, second] = [-low / from, 1.0 - high / to];
        if low > 0.0 {
            let first = if from < 0.0 { first } else { 1.0 };
            first.min(second)
        } else {
            let second = if to > 0.0 { second } else { 0.0 };
            first.max(second)
        }
    }

    /// Returns the zero of the cubic with the ends' values and slopes, as a share of the width.
    fn cubic_zero(&self, from: f64, to: f64) -> f64 {
        let (low, rise) = (self.low.value, self.high.value - self.low.value);
        let cubic = from + to - 2.0 * rise;
        let square = rise - from - cubic;
        let mut u = -low / rise;
        for _ in 0..CUBIC_STEPS {
            let value = low + u * (from + u * (square + u * cubic));
            let slope = from + u * (2.0 * square + 3.0 * u * cubic);
            u -= value / slope;
        }
        u
    }

    /// Replaces one end. If `is_weighted`, an end kept for the second time in a row counts half.
    fn shrink(&mut self, to: End, is_low: bool, is_weighted: bool) {
        let weight = |is_kept: bool| if is_kept && is_weighted { 0.5 } else { 1.0 };
        if is_low {
            self.low = to;
            self.high.value *= weight(self.kept < 0);
            self.kept = -1;
        } else {
            self.high = to;
            self.low.value *= weight(self.kept > 0);
            self.kept = 1;
        }
    }
}
