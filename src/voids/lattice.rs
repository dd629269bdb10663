//! The conforming tetrahedra of a balanced octree: a graded body-centred cubic lattice.
//!
//! Two leaves that share a face make a tetrahedron with every edge of the (smaller) face: both centres and the
//! edge's two ends, the edge halved where a finer leaf touches it. Neighbours see the same halves, so the
//! tetrahedra fit together; where all leaves are equal they are those of the body-centred cubic lattice
//! (Labelle & Shewchuk, "Isosurface Stuffing", SIGGRAPH 2007).

use super::octree::{Cell, Grid, Octree};

/// A packed grid position.
pub(super) type Key = u64;

/// Bits of a packed coordinate; an octree's root is small enough for it.
const KEY_BITS: u32 = 21;

/// A tetrahedron with positive volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Tetrahedron {
    /// Its corners. Where it stands on the boundary of the octree, the last three lie there.
    pub keys: [Key; 4],
    /// The two leaves in which it lies; the same one twice on the boundary of the octree.
    pub leaves: [u32; 2],
    /// The smaller leaf's size, units.
    pub size: i32,
}

impl Tetrahedron {
    /// Whether its last three corners lie on the boundary of the octree.
    pub fn is_on_boundary(&self) -> bool {
        self.leaves[0] == self.leaves[1]
    }
}

/// The name of a grid position.
pub(super) fn key(grid: Grid) -> Key {
    grid.iter().fold(0, |key, &c| key << KEY_BITS | c as u64)
}

/// The grid position of a name.
pub(super) fn grid(key: Key) -> Grid {
    let mask = (1 << KEY_BITS) - 1;
    [2, 1, 0].map(|i| (key >> (i * KEY_BITS) & mask) as i32)
}

/// The six face directions as (axis, sign).
const FACES: [(usize, i32); 6] = [(0, -1), (0, 1), (1, -1), (1, 1), (2, -1), (2, 1)];

/// A face's corners in the two axes that follow its own, counter-clockwise about the axis.
const RING: [[i32; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

/// The direction in those two axes that leads away from the face across the edge from corner i to corner i + 1.
const ACROSS: [[i32; 2]; 4] = [[0, -1], [1, 0], [0, 1], [-1, 0]];

/// The tetrahedra that a leaf answers for: those across its faces to leaves of its size (once for each pair) or
/// larger, and to the boundary of the octree. Pairs without surface between them are left out.
pub(super) fn tetrahedra_of(tree: &Octree, leaf: u32, emit: &mut impl FnMut(Tetrahedron)) {
    let cell = tree.cell(leaf);
    for (axis, sign) in FACES {
        let direction = unit(axis, sign);
        match tree.at(cell.neighbour_corner(direction), cell.size) {
            None => on_boundary(tree, leaf, (axis, sign), emit),
            Some(other) => {
                let neighbour = tree.cell(other);
                let is_ours = neighbour.size > cell.size || sign > 0;
                if neighbour.is_leaf() && is_ours && !(cell.is_free && neighbour.is_free) {
                    let pair = ([leaf, other], neighbour.center_grid());
                    around_face(tree, (axis, sign), pair, emit);
                }
            }
        }
    }
}

/// The tetrahedra between a leaf and the boundary of the octree, unless the leaf is free and outside.
fn on_boundary(tree: &Octree, leaf: u32, face: (usize, i32), emit: &mut impl FnMut(Tetrahedron)) {
    let cell = tree.cell(leaf);
    if cell.is_free && !cell.center.sample.is_positive() {
        return;
    }
    let mut apex = cell.center_grid();
    apex[face.0] += face.1 * cell.size / 2;
    around_face(tree, face, ([leaf, leaf], apex), emit);
}

/// The tetrahedra of a leaf's centre and `apex` with the edges of the leaf's face between them.
fn around_face(
    tree: &Octree,
    (axis, sign): (usize, i32),
    (leaves, apex): ([u32; 2], Grid),
    emit: &mut impl FnMut(Tetrahedron),
) {
    let cell = tree.cell(leaves[0]);
    let centers = [key(cell.center_grid()), key(apex)];
    for i in 0..4 {
        let ends =
            [face_corner(cell, (axis, sign), RING[i]), face_corner(cell, (axis, sign), RING[(i + 1) % 4])];
        let ends = if sign > 0 { ends } else { [ends[1], ends[0]] };
        let mut segment = |from: Grid, to: Grid| {
            let keys = [centers[0], centers[1], key(from), key(to)];
            emit(Tetrahedron { keys, leaves, size: cell.size });
        };
        if is_edge_halved(tree, cell, (axis, sign), ACROSS[i]) {
            let middle = [0, 1, 2].map(|k| (ends[0][k] + ends[1][k]) / 2);
            segment(ends[0], middle);
            segment(middle, ends[1]);
        } else {
            segment(ends[0], ends[1]);
        }
    }
}

/// Whether a finer leaf touches the edge of the face: only the two places beyond the edge can be divided.
fn is_edge_halved(tree: &Octree, cell: &Cell, (axis, sign): (usize, i32), across: [i32; 2]) -> bool {
    let mut direction = in_face(axis, across);
    if tree.is_divided(cell.neighbour_corner(direction), cell.size) {
        return true;
    }
    direction[axis] = sign;
    tree.is_divided(cell.neighbour_corner(direction), cell.size)
}

fn face_corner(cell: &Cell, (axis, sign): (usize, i32), ring: [i32; 2]) -> Grid {
    let mut step = in_face(axis, ring);
    step[axis] = i32::from(sign > 0);
    [0, 1, 2].map(|i| cell.corner[i] + step[i] * cell.size)
}

fn in_face(axis: usize, [u, v]: [i32; 2]) -> Grid {
    let mut step = [0; 3];
    step[(axis + 1) % 3] = u;
    step[(axis + 2) % 3] = v;
    step
}

fn unit(axis: usize, sign: i32) -> Grid {
    let mut step = [0; 3];
    step[axis] = sign;
    step
}
