//! The lattice's corners: the function there, pushed off the surface so that no triangle is a
//! sliver.

use rayon::prelude::*;

use super::field::{Field, Known, Sample};
use super::lattice::{Key, Links, SLOTS, Slot, grid, key};
use super::octree::Octree;
use super::table::IndexMap;

/// A corner nearer to the surface than this share of its smallest cell is pushed that far from it.
/// More would endanger the tetrahedra (their least height is about 0.4 cells), less leaves thin
/// triangles.
const PUSH_RATIO: f64 = 0.1;

/// A corner of the lattice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Where the lattice has it.
    raw: Known,
    /// Where it was pushed.
    pub placed: Known,
    /// The smallest leaf around it, units.
    size: i32,
    /// How often it was moved.
    pub version: u32,
    /// Whether it must stay on the octree's boundary.
    is_fixed: bool,
}

/// All corners met so far, numbered in the order they were met.
#[derive(Default)]
pub(super) struct Nodes {
    index: IndexMap,
    nodes: Vec<Node>,
    /// Whether each lies in the region; apart, so that many fit the cache.
    positive: Vec<bool>,
}

/// The numbers of the corners of a leaf's tetrahedra.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    used: u64,
    numbers: Vec<u32>,
}

impl Numbers {
    /// The number of the corner in a slot in use.
    pub fn at(&self, slot: Slot) -> u32 {
        let before = self.used & ((1 << slot) - 1);
        self.numbers[before.count_ones() as usize]
    }
}

/// A corner that a leaf needs.
#[derive(Debug, Clone, Copy)]
struct Need {
    key: Key,
    size: i32,
    leaf: u32,
}

impl Nodes {
    /// A corner by its number.
    pub fn node(&self, number: u32) -> &Node {
        &self.nodes[number as usize]
    }

    /// Whether a corner lies in the region.
    pub fn is_positive(&self, number: u32) -> bool {
        self.positive[number as usize]
    }

    /// Makes ready every corner of the leaves' tetrahedra, and gives their numbers for each leaf.
    pub fn prepare(
        &mut self,
        tree: &Octree,
        leaves: &[(u32, Links)],
        field: &impl Field,
    ) -> Vec<Numbers> {
        let needs: Vec<(u64, Vec<Need>)> = leaves
            .par_iter()
            .map(|entry| needs_of(tree, entry))
            .collect();
        let mut fresh: Vec<Need> = Vec::new();
        let mut shrunk: Vec<u32> = Vec::new();
        let mut numbers = Vec::with_capacity(needs.len());
        for (used, needs) in needs {
            let numbered = needs
                .iter()
                .map(|need| self.meet(need, &mut fresh, &mut shrunk))
                .collect();
            numbers.push(Numbers {
                used,
                numbers: numbered,
            });
        }
        let made: Vec<Node> = fresh
            .par_iter()
            .map(|need| make(tree, need, field))
            .collect();
        self.positive
            .extend(made.iter().map(|node| node.raw.sample.is_positive()));
        self.nodes.extend(made);
        self.replace(tree, shrunk, field);
        numbers
    }

    /// The number of a corner: of a known one, or the next one.
    fn meet(&mut self, need: &Need, fresh: &mut Vec<Need>, shrunk: &mut Vec<u32>) -> u32 {
        let known = self.nodes.len() as u32;
        let next = known + fresh.len() as u32;
        let number = *self.index.entry(need.key).or_insert(next);
        if number == next {
            fresh.push(*need);
        } else if number >= known {
            let size = &mut fresh[(number - known) as usize].size;
            *size = need.size.min(*size);
        } else if need.size < self.nodes[number as usize].size {
            self.nodes[number as usize].size = need.size;
            shrunk.push(number);
        }
        number
    }

    /// Places corners anew whose smallest cell has shrunk.
    fn replace(&mut self, tree: &Octree, mut numbers: Vec<u32>, field: &impl Field) {
        numbers.sort_unstable();
        numbers.dedup();
        let placed: Vec<Known> = numbers
            .par_iter()
            .map(|&number| place(tree, self.node(number), field))
            .collect();
        for (number, placed) in numbers.into_iter().zip(placed) {
            let node = &mut self.nodes[number as usize];
            if placed.at != node.placed.at {
                *node = Node {
                    placed,
                    version: node.version + 1,
                    ..*node
                };
            }
        }
    }
}

/// The corners of a leaf's tetrahedra, each once, in the order of their slots.
fn needs_of(tree: &Octree, &(leaf, links): &(u32, Links)) -> (u64, Vec<Need>) {
    let used = links.used();
    let cell = tree.cell(leaf);
    let slots = (0..SLOTS).filter(|&slot| used >> slot & 1 == 1);
    let need = |slot| Need {
        key: key(links.position(tree, cell, slot)),
        size: cell.size,
        leaf,
    };
    (used, slots.map(need).collect())
}

fn make(tree: &Octree, need: &Need, field: &impl Field) -> Node {
    let position = grid(need.key);
    let raw = sampled(tree, need, field);
    let is_fixed = position.iter().any(|&c| c == 0 || c == tree.root_size());
    let node = Node {
        raw,
        placed: raw,
        size: need.size,
        version: 0,
        is_fixed,
    };
    Node {
        placed: place(tree, &node, field),
        ..node
    }
}

/// The function at a corner; the leaf's own centre is known.
fn sampled(tree: &Octree, need: &Need, field: &impl Field) -> Known {
    let leaf = tree.cell(need.leaf);
    if key(leaf.center_grid()) == need.key {
        return leaf.center;
    }
    let at = tree.point(grid(need.key));
    Known {
        at,
        sample: field.sample(&at, &[leaf.center]),
    }
}

/// Where a corner is pushed: along the gradient, never across the surface.
fn place(tree: &Octree, node: &Node, field: &impl Field) -> Known {
    let Known { at, sample } = node.raw;
    let clear_mm = PUSH_RATIO * tree.length_mm(node.size);
    if node.is_fixed || sample.value.abs() >= clear_mm {
        return node.raw;
    }
    let side = if sample.is_positive() { 1.0 } else { -1.0 };
    let moved = at + sample.gradient * (side * clear_mm - sample.value);
    let there = field.sample(&moved, &[node.raw]);
    if is_further(&there, &sample) {
        Known {
            at: moved,
            sample: there,
        }
    } else {
        node.raw
    }
}

fn is_further(there: &Sample, here: &Sample) -> bool {
    there.is_positive() == here.is_positive() && there.value.abs() > here.value.abs()
}
