//! Building the hierarchy: binned surface-area heuristic, depth first.
//!
//! Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", IEEE RT 2007.

use rayon::prelude::*;

use super::tree::{Bvh, Node};
use crate::geom::{Aabb, Point};

/// Largest number of triangles of a leaf: below, box tests dominate; above, triangle tests do.
const LEAF_SIZE: usize = 8;

/// Number of bins per axis: fewer make poorer trees, more only cost building time.
const BINS: usize = 16;

/// Least number of triangles for which both halves are built in parallel. Below, the hand-over
/// costs more than it gains.
const PARALLEL_ITEMS: usize = 4096;

/// The data of a triangle that the builder needs.
#[derive(Clone, Copy)]
struct Item {
    aabb: Aabb,
    id: u32,
}

impl Item {
    /// Returns a coordinate of the centre of its box.
    #[inline]
    fn center(&self, axis: usize) -> f64 {
        (self.aabb.min[axis] + self.aabb.max[axis]) * 0.5
    }
}

impl Bvh {
    /// Builds the tree over these triangles by the surface-area heuristic in O(n log n).
    pub fn new(triangles: impl IntoIterator<Item = [Point; 3]>) -> Self {
        let triangles: Vec<[Point; 3]> = triangles.into_iter().collect();
        let items = triangles
            .par_iter()
            .with_min_len(PARALLEL_ITEMS)
            .enumerate();
        let mut items: Vec<Item> = items.map(|(id, corners)| item(id, corners)).collect();
        let nodes = if items.is_empty() {
            Vec::new()
        } else {
            subtree(&mut items, 0)
        };
        let ids: Vec<u32> = items.iter().map(|item| item.id).collect();
        let corners = ids.iter().map(|&id| triangles[id as usize]).collect();
        Self {
            nodes,
            corners,
            ids,
        }
    }
}

#[inline]
fn item(id: usize, corners: &[Point; 3]) -> Item {
    Item {
        aabb: Aabb::of_points(corners),
        id: id as u32,
    }
}

/// Builds the tree over `items`, whose first triangle is number `first` of the whole. Builds large
/// halves in parallel.
fn subtree(items: &mut [Item], first: usize) -> Vec<Node> {
    let mut nodes = Vec::with_capacity(items.len());
    if items.len() < PARALLEL_ITEMS {
        let mut spare = Vec::with_capacity(items.len());
        subdivide(items, first, &mut nodes, &mut spare);
        return nodes;
    }
    let aabb = items
        .iter()
        .fold(Aabb::EMPTY, |sum, item| sum.union(&item.aabb));
    let middle = partition(items, &mut Vec::new());
    let (left, right) = items.split_at_mut(middle);
    let (left, right) = rayon::join(|| subtree(left, first), || subtree(right, first + middle));
    nodes.push(Node {
        aabb,
        first: 1 + left.len() as u32,
        count: 0,
    });
    append_shifted(&mut nodes, &left);
    append_shifted(&mut nodes, &right);
    nodes
}

/// Appends a tree whose inner nodes number their right children from its own root.
fn append_shifted(nodes: &mut Vec<Node>, tree: &[Node]) {
    let base = nodes.len() as u32;
    let shift = |node: &Node| {
        if node.count == 0 {
            node.first + base
        } else {
            node.first
        }
    };
    nodes.extend(tree.iter().map(|node| Node {
        first: shift(node),
        ..*node
    }));
}

/// Appends the tree over `items`, whose first triangle is number `first` of the whole. `spare` is
/// room to reorder them in.
fn subdivide(items: &mut [Item], first: usize, nodes: &mut Vec<Node>, spare: &mut Vec<Item>) {
    let aabb = items
        .iter()
        .fold(Aabb::EMPTY, |sum, item| sum.union(&item.aabb));
    let index = nodes.len();
    nodes.push(Node {
        aabb,
        first: first as u32,
        count: items.len() as u32,
    });
    if items.len() <= LEAF_SIZE {
        return;
    }
    let middle = partition(items, spare);
    let (left, right) = items.split_at_mut(middle);
    nodes[index].count = 0;
    subdivide(left, first, nodes, spare);
    nodes[index].first = nodes.len() as u32;
    subdivide(right, first + middle, nodes, spare);
}

/// Reorders the items into two parts and returns the size of the first. `spare` is room for that.
fn partition(items: &mut [Item], spare: &mut Vec<Item>) -> usize {
    let centers = items
        .iter()
        .fold(Aabb::EMPTY, |sum, item| sum.grown_over(&item.aabb.center()));
    let axis = centers.size().imax();
    let (low, extent) = (centers.min[axis], centers.size()[axis]);
    let bin_of =
        |item: &Item| (((item.center(axis) - low) / extent * BINS as f64) as usize).min(BINS - 1);
    if let Some(split) = (extent > 0.0).then(|| best_split(items, bin_of)).flatten() {
        spare.clear();
        let mut middle = 0;
        for index in 0..items.len() {
            if bin_of(&items[index]) < split {
                items[middle] = items[index];
                middle += 1;
            } else {
                spare.push(items[index]);
            }
        }
        items[middle..].copy_from_slice(spare);
        return middle;
    }
    items.len() / 2
}

/// Returns the bin before which to split so that the expected cost of a query is least.
fn best_split(items: &[Item], bin_of: impl Fn(&Item) -> usize) -> Option<usize> {
    let mut bins = [(Aabb::EMPTY, 0usize); BINS];
    for item in items {
        let (aabb, count) = &mut bins[bin_of(item)];
        *aabb = aabb.union(&item.aabb);
        *count += 1;
    }
    let right = suffix_costs(&bins);
    let (mut aabb, mut count) = (Aabb::EMPTY, 0);
    let mut best = (f64::INFINITY, None);
    for split in 1..BINS {
        aabb = aabb.union(&bins[split - 1].0);
        count += bins[split - 1].1;
        let cost = half_area(&aabb) * count as f64 + right[split];
        if count > 0 && count < items.len() && cost < best.0 {
            best = (cost, Some(split));
        }
    }
    best.1
}

/// Returns, for each bin, the area times the count of everything from it on.
fn suffix_costs(bins: &[(Aabb, usize); BINS]) -> [f64; BINS] {
    let mut costs = [0.0; BINS];
    let (mut aabb, mut count) = (Aabb::EMPTY, 0);
    for split in (0..BINS).rev() {
        aabb = aabb.union(&bins[split].0);
        count += bins[split].1;
        costs[split] = half_area(&aabb) * count as f64;
    }
    costs
}

/// Returns half the surface area of a box; zero if it is empty.
#[inline]
fn half_area(aabb: &Aabb) -> f64 {
    if aabb.is_empty() {
        return 0.0;
    }
    let size = aabb.size();
    size.x * size.y + size.y * size.z + size.z * size.x
}
