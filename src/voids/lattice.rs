//! The conforming tetrahedra of a balanced octree: a graded body-centred cubic lattice.
//!
//! Two leaves that share a face make a tetrahedron with every edge of the smaller face. Its corners
//! are both centres and the edge's two ends; an edge that a finer leaf touches is halved first.
//! Neighbours see the same halves, so the tetrahedra fit together. If all leaves are equal, they
//! are those of the body-centred cubic lattice (Labelle & Shewchuk, "Isosurface Stuffing", SIGGRAPH
//! 2007).

use super::octree::{Cell, Grid, NEIGHBOURS, Octree};

/// A packed grid position.
pub(super) type Key = u64;

/// Bits of a packed coordinate. An octree's root is small enough for it.
const KEY_BITS: u32 = 21;

/// Returns a grid position packed into one word.
#[inline]
pub(super) fn key(grid: Grid) -> Key {
    grid.iter().fold(0, |key, &c| key << KEY_BITS | c as u64)
}

/// Returns the grid position of a packed one.
#[inline]
pub(super) fn grid(key: Key) -> Grid {
    let mask = (1 << KEY_BITS) - 1;
    [2, 1, 0].map(|i| (key >> (i * KEY_BITS) & mask) as i32)
}

/// A corner of a leaf's tetrahedra, in the leaf's own numbering.
///
/// Slots 0 to 26 are the places 0, 1, 2 half sides along x, then y, then z. Slot 27 + f is the far
/// end across face f: a neighbour's centre, or the centre of the face itself on the boundary.
pub(super) type Slot = u8;

/// Number of slots.
pub(super) const SLOTS: Slot = 33;

/// The first far end.
const FAR: Slot = 27;

/// The leaf's own centre.
const CENTER: Slot = 13;

/// The neighbour across a leaf's face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Across {
    /// Nothing that this leaf is responsible for.
    Nothing,
    /// The boundary of the octree.
    Boundary,
    /// A leaf of the same size or larger.
    Leaf(u32),
}

/// The neighbourhood of a leaf, from which its tetrahedra follow.
#[derive(Debug, Clone, Copy)]
pub(super) struct Links {
    /// The neighbour across each face, in the order of the first six of [`NEIGHBOURS`].
    pub across: [Across; 6],
    /// Bit 4 f + i is set if edge i of face f is halved.
    halved: u32,
}

/// A tetrahedron with positive volume. If it stands on the boundary of the octree, its last three
/// corners lie there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Tetrahedron {
    /// Face of the leaf that lies inside the tetrahedron.
    pub face: usize,
    /// Corners.
    pub slots: [Slot; 4],
}

/// Corners of a face in half sides, along the two axes that follow its own, counter-clockwise about
/// the axis.
const RING: [[i32; 2]; 4] = [[0, 0], [2, 0], [2, 2], [0, 2]];

/// Directions along those two axes that lead out of the face across the edge from corner i to
/// corner i + 1.
const BEYOND: [[i32; 2]; 4] = [[0, -1], [1, 0], [0, 1], [-1, 0]];

impl Links {
    /// Returns the links of a leaf.
    ///
    /// A leaf is responsible for its faces to larger leaves, to leaves of its size (once for each
    /// pair), and to the boundary. Pairs without surface between them are left out.
    pub fn new(tree: &Octree, leaf: u32) -> Self {
        let cell = tree.cell(leaf);
        let across = [0, 1, 2, 3, 4, 5].map(|face| across(tree, cell, face));
        let is_idle = across.iter().all(|&a| a == Across::Nothing);
        Self {
            across,
            halved: if is_idle {
                0
            } else {
                find_halved_edges(tree, cell)
            },
        }
    }

    /// Calls `visit` with every tetrahedron that the leaf is responsible for.
    pub fn for_each(&self, mut visit: impl FnMut(Tetrahedron)) {
        for face in (0..6).filter(|&face| self.across[face] != Across::Nothing) {
            for i in 0..4 {
                let ends = ends(face, i);
                let middle = (ends[0] + ends[1]) / 2;
                let mut segment = |from: Slot, to: Slot| {
                    visit(Tetrahedron {
                        face,
                        slots: [CENTER, FAR + face as Slot, from, to],
                    });
                };
                if self.halved >> (4 * face + i) & 1 == 1 {
                    segment(ends[0], middle);
                    segment(middle, ends[1]);
                } else {
                    segment(ends[0], ends[1]);
                }
            }
        }
    }

    /// Returns the slots in use, as a set of bits.
    pub fn used(&self) -> u64 {
        let mut used = 0;
        self.for_each(|t| t.slots.iter().for_each(|&slot| used |= 1 << slot));
        used
    }

    /// Returns the grid position of a slot.
    pub fn position(&self, tree: &Octree, cell: &Cell, slot: Slot) -> Grid {
        let half = cell.size / 2;
        if slot < FAR {
            let steps = [slot % 3, slot / 3 % 3, slot / 9].map(i32::from);
            return [0, 1, 2].map(|i| cell.corner[i] + steps[i] * half);
        }
        let face = usize::from(slot - FAR);
        match self.across[face] {
            Across::Leaf(other) => tree.cell(other).center_grid(),
            _ => {
                let center = cell.center_grid();
                [0, 1, 2].map(|i| center[i] + NEIGHBOURS[face][i] * half)
            }
        }
    }
}

/// Returns the axis of a face, and whether the face is at its upper end.
#[inline]
fn axis(face: usize) -> (usize, bool) {
    (face / 2, face % 2 == 1)
}

/// Returns the ends of a face's edge, ordered so that the leaf's centre, the far end and these two
/// are positively oriented.
#[inline]
fn ends(face: usize, i: usize) -> [Slot; 2] {
    let (axis, is_up) = axis(face);
    let slot = |ring: [i32; 2]| {
        let mut steps = in_face(axis, ring);
        steps[axis] = if is_up { 2 } else { 0 };
        (steps[0] + 3 * steps[1] + 9 * steps[2]) as Slot
    };
    let (from, to) = (slot(RING[i]), slot(RING[(i + 1) % 4]));
    if is_up { [from, to] } else { [to, from] }
}

/// Returns the grid vector with the components u and v along the two axes that follow `axis`.
#[inline]
fn in_face(axis: usize, [u, v]: [i32; 2]) -> Grid {
    let mut steps = [0; 3];
    steps[(axis + 1) % 3] = u;
    steps[(axis + 2) % 3] = v;
    steps
}

/// Returns the neighbour across a face, or [`Across::Nothing`] if another leaf is responsible for
/// it or no surface lies between.
fn across(tree: &Octree, cell: &Cell, face: usize) -> Across {
    let Some(other) = tree.at(cell.neighbour_corner(NEIGHBOURS[face]), cell.size) else {
        let is_outside = cell.is_free && !cell.center.sample.is_positive();
        return if is_outside {
            Across::Nothing
        } else {
            Across::Boundary
        };
    };
    let neighbour = tree.cell(other);
    let is_ours = tree.is_leaf(other) && (neighbour.size > cell.size || axis(face).1);
    if is_ours && !(cell.is_free && neighbour.is_free) {
        Across::Leaf(other)
    } else {
        Across::Nothing
    }
}

/// Number of cells in a block of three by three by three.
const PLACES_AROUND: usize = 27;

/// Returns the place of the neighbour in a direction, in a block of three by three by three cells.
#[inline]
fn place_around([x, y, z]: Grid) -> usize {
    (13 + x + 3 * y + 9 * z) as usize
}

/// Returns the edges that a finer leaf touches, as bits like those of [`Links`]. Of the four places
/// around an edge only the two beyond the pair of leaves can be divided.
fn find_halved_edges(tree: &Octree, cell: &Cell) -> u32 {
    let mut divided = [false; PLACES_AROUND];
    for direction in NEIGHBOURS {
        let corner = cell.neighbour_corner(direction);
        divided[place_around(direction)] = tree.is_divided(corner, cell.size);
    }
    let mut bits = 0;
    for face in 0..6 {
        let (axis, is_up) = axis(face);
        for (i, &beyond) in BEYOND.iter().enumerate() {
            let mut direction = in_face(axis, beyond);
            let beside = divided[place_around(direction)];
            direction[axis] = if is_up { 1 } else { -1 };
            let is_halved = beside || divided[place_around(direction)];
            bits |= u32::from(is_halved) << (4 * face + i);
        }
    }
    bits
}
