//! The lattice's corners, pushed off the surface so that no triangle is a sliver, with the function
//! sampled there.

use super::field::{Field, Known, Sample};
use super::lattice::{Key, Links, SLOTS, Slot, grid, key};
use super::octree::Octree;
use super::runs::map_in_runs;
use super::table::IndexMap;
use crate::base::watch::{Cancelled, Watch};

/// Distance to which a corner too near the surface is pushed, as a share of its smallest cell. More
/// would endanger the tetrahedra, whose least height is about 0.4 cells; less leaves thin
/// triangles.
const PUSH_RATIO: f64 = 0.1;

/// A corner of the lattice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Place in the regular lattice.
    raw: Known,
    /// Place after pushing.
    pub placed: Known,
    /// Size of the smallest leaf around it, units.
    size: i32,
    /// Number of times it was moved.
    pub version: u32,
    /// True if it must stay on the octree's boundary.
    is_fixed: bool,
}

/// All corners met so far, numbered in the order in which they were met.
#[derive(Default)]
pub(super) struct Nodes {
    index: IndexMap,
    nodes: Vec<Node>,
    /// For each corner, whether it lies in the region; kept apart so that many fit the cache.
    positive: Vec<bool>,
}

/// The numbers of the corners of a leaf's tetrahedra.
#[derive(Debug, Clone)]
pub(super) struct Numbers {
    used: u64,
    numbers: Vec<u32>,
}

impl Numbers {
    /// Returns the number of the corner in a slot, which must be in use.
    #[inline]
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
    /// Returns the number of corners.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns a corner by its number.
    #[inline]
    pub fn node(&self, number: u32) -> &Node {
        &self.nodes[number as usize]
    }

    /// Returns whether a corner lies in the region.
    #[inline]
    pub fn is_positive(&self, number: u32) -> bool {
        self.positive[number as usize]
    }

    /// Adds or updates every corner of the leaves' tetrahedra, and returns their numbers for each
    /// leaf.
    pub fn prepare(
        &mut self,
        tree: &Octree,
        leaves: &[(u32, Links)],
        field: &impl Field,
        watch: &Watch,
    ) -> Result<Vec<Numbers>, Cancelled> {
        let need = |i: usize| needs_of(tree, leaves[i].0, &leaves[i].1);
        let needs: Vec<(u64, Vec<Need>)> = map_in_runs(leaves.len(), watch, need)?;
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
        let node = |i: usize| make_node(tree, &fresh[i], field);
        let new_nodes: Vec<Node> = map_in_runs(fresh.len(), watch, node)?;
        self.positive
            .extend(new_nodes.iter().map(|node| node.raw.sample.is_positive()));
        self.nodes.extend(new_nodes);
        self.place_again(tree, shrunk, field, watch)?;
        Ok(numbers)
    }

    /// Returns the number of a corner: its own if the corner is known, otherwise the next free one.
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

    /// Places corners again whose smallest cell has shrunk.
    fn place_again(
        &mut self,
        tree: &Octree,
        mut numbers: Vec<u32>,
        field: &impl Field,
        watch: &Watch,
    ) -> Result<(), Cancelled> {
        numbers.sort_unstable();
        numbers.dedup();
        let place = |i: usize| place(tree, self.node(numbers[i]), field);
        let placed: Vec<Known> = map_in_runs(numbers.len(), watch, place)?;
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
        Ok(())
    }
}

/// Returns the slots in use as a set of bits, and the corners of a leaf's tetrahedra, each once, in
/// the order of their slots.
fn needs_of(tree: &Octree, leaf: u32, links: &Links) -> (u64, Vec<Need>) {
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

fn make_node(tree: &Octree, need: &Need, field: &impl Field) -> Node {
    let position = grid(need.key);
    let raw = sample_corner(tree, need, field);
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

/// Samples the function at a corner. At the leaf's own centre the sample is known already.
fn sample_corner(tree: &Octree, need: &Need, field: &impl Field) -> Known {
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

/// Pushes a corner along the gradient, away from the surface. It stays in place if the push would
/// cross the surface or bring it nearer.
fn place(tree: &Octree, node: &Node, field: &impl Field) -> Known {
    let Known { at, sample } = node.raw;
    let clear_mm = PUSH_RATIO * tree.length_mm(node.size);
    if node.is_fixed || sample.value.abs() >= clear_mm {
        return node.raw;
    }
    let side = if sample.is_positive() { 1.0 } else { -1.0 };
    let moved = at + sample.gradient * (side * clear_mm - sample.value);
    let there = field.sample(&moved, &[node.raw]);
    if is_farther(&there, &sample) {
        Known {
            at: moved,
            sample: there,
        }
    } else {
        node.raw
    }
}

fn is_farther(there: &Sample, here: &Sample) -> bool {
    there.is_positive() == here.is_positive() && there.value.abs() > here.value.abs()
}
