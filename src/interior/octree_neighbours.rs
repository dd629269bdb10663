//! The pairs of leaves of an octree that share a face.

use super::leaf::Leaf;

/// Returns the pairs of leaves that share a face or a part of one, each once. The leaves must be in
/// the order of their codes.
pub(super) fn pairs(leaves: &[Leaf]) -> Vec<[u32; 2]> {
    let of_leaf = |i: usize| {
        let sides = (0..3).flat_map(|axis| [(axis, true), (axis, false)]);
        sides.filter_map(move |(axis, forward)| {
            let other = containing(leaves, &leaves[i].beside(axis, forward)?)?;
            // A larger neighbour is seen only from here; one of the same size is seen from both
            // sides.
            let is_larger = leaves[other].log_width > leaves[i].log_width;
            (is_larger || forward).then_some([i as u32, other as u32])
        })
    };
    (0..leaves.len()).flat_map(of_leaf).collect()
}

/// Returns the leaf of at least this size that holds a cell; `None` if the cell is split further,
/// or empty.
fn containing(leaves: &[Leaf], cell: &Leaf) -> Option<usize> {
    let index = leaves
        .partition_point(|leaf| leaf.code <= cell.code)
        .checked_sub(1)?;
    let leaf = &leaves[index];
    (leaf.log_width >= cell.log_width && leaf.contains(cell)).then_some(index)
}
