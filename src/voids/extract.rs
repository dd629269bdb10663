//! Drawing a surface: refine the lattice until its triangles follow the function, then march.

use rayon::prelude::*;

use super::field::{Field, Known, Resolution};
use super::lattice::{Tetrahedron, tetrahedra_of};
use super::march::{Piece, cap, piece};
use super::nodes::Nodes;
use super::octree::{FINEST_UNITS, Octree};
use super::roots::{Roots, VertexKey};
use super::table::IndexMap;
use crate::geom::{Aabb, Point};

/// A chord whose ends' normals turn by more than this (cosine; 20°) spans a crease of the surface, not a curve:
/// a curve of the wall's radius turns less within the cells that its sag alone asks for.
const CREASE_COSINE: f64 = 0.94;

/// The surface of a function's positive region while it is being refined.
pub(super) struct Extractor<'a, F> {
    field: &'a F,
    resolution: Resolution,
    tree: Octree,
    nodes: Nodes,
    roots: Roots,
}

/// Triangles, and the two leaves in which each lies.
pub(super) struct Surface {
    /// The vertices, mm.
    pub vertices: Vec<Point>,
    /// The triangles, counter-clockwise from outside the region.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle its leaves.
    pub leaves: Vec<[u32; 2]>,
}

/// A triangle by the names of its vertices, and its leaves.
type Named = ([VertexKey; 3], [u32; 2]);

impl<'a, F: Field> Extractor<'a, F> {
    /// Starts on the region inside `aabb`, coarse everywhere; `None` if the box is too large for the finest cell.
    pub fn new(field: &'a F, aabb: &Aabb, resolution: Resolution) -> Option<Self> {
        let mut tree = Octree::new(aabb, resolution.finest_mm, field)?;
        tree.grow(field);
        Some(Self { field, resolution, tree, nodes: Nodes::default(), roots: Roots::default() })
    }

    /// All leaves.
    pub fn leaves(&self) -> Vec<u32> {
        (0..self.tree.cells().len() as u32).filter(|&i| self.tree.cell(i).is_leaf()).collect()
    }

    /// Divides leaves until the triangles in and around `dirty` keep the tolerances.
    pub fn settle(&mut self, mut dirty: Vec<u32>) {
        while !dirty.is_empty() {
            self.prepare(&dirty);
            let bent = self.bent_leaves(&dirty);
            dirty = self.divide(bent);
        }
    }

    /// Divides those of these leaves that can be, and gives the leaves that must be looked at again.
    pub fn divide(&mut self, mut leaves: Vec<u32>) -> Vec<u32> {
        leaves.sort_unstable();
        leaves.dedup();
        leaves.retain(|&i| self.tree.cell(i).size > FINEST_UNITS);
        let fresh = self.tree.refine(&leaves, self.field);
        self.tree.widened(&fresh)
    }

    /// The triangles as they are now.
    pub fn surface(&mut self) -> Surface {
        let leaves = self.leaves();
        self.prepare(&leaves);
        let named: Vec<Named> = leaves.par_iter().flat_map_iter(|&leaf| self.triangles_of(leaf)).collect();
        self.numbered(&named)
    }

    /// Of the two leaves of a triangle those to divide when it will not do: the larger one that holds surface.
    pub fn to_divide(&self, leaves: [u32; 2]) -> impl Iterator<Item = u32> {
        let size = |i: u32| if self.tree.cell(i).is_free { 0 } else { self.tree.cell(i).size };
        let largest = size(leaves[0]).max(size(leaves[1]));
        let both = leaves.map(|leaf| (leaf, size(leaf)));
        both.into_iter().filter(move |&(_, size)| size == largest && size > 0).map(|(leaf, _)| leaf)
    }

    /// Makes ready the corners and crossings that the leaves' triangles need.
    fn prepare(&mut self, leaves: &[u32]) {
        self.nodes.prepare(&self.tree, leaves, self.field);
        let keys: Vec<VertexKey> = leaves.par_iter().flat_map_iter(|&leaf| self.crossings_of(leaf)).collect();
        self.roots.prepare(&self.nodes, keys.into_iter(), self.field);
    }

    /// The crossings in a leaf's tetrahedra, each once.
    fn crossings_of(&self, leaf: u32) -> Vec<VertexKey> {
        let mut keys = Vec::new();
        self.pieces_of(leaf, &mut |piece, _| match piece {
            Piece::Triangle(t) => keys.extend(t),
            Piece::Quad(q) => keys.extend(q),
        });
        keys.sort_unstable();
        keys.dedup();
        keys
    }

    /// The pieces of surface in a leaf's tetrahedra.
    fn pieces_of(&self, leaf: u32, emit: &mut impl FnMut(Piece, [u32; 2])) {
        tetrahedra_of(&self.tree, leaf, &mut |tetrahedron| {
            let Some((corners, positive)) = self.signs(&tetrahedron) else { return };
            if let Some(piece) = piece(corners, positive) {
                emit(piece, tetrahedron.leaves);
            }
            if tetrahedron.is_on_boundary() {
                let [_, b, c, d] = corners;
                let faces = cap([b, c, d], [positive[1], positive[2], positive[3]]);
                faces.into_iter().for_each(|face| emit(Piece::Triangle(face), tetrahedron.leaves));
            }
        });
    }

    fn signs(&self, tetrahedron: &Tetrahedron) -> Option<([u32; 4], [bool; 4])> {
        let [a, b, c, d] = tetrahedron.keys.map(|key| self.nodes.number(key));
        let corners = [a?, b?, c?, d?];
        Some((corners, corners.map(|corner| self.nodes.node(corner).placed.sample.is_positive())))
    }

    /// The triangles in a leaf's tetrahedra; quadrilaterals are cut along the diagonal that bends less.
    fn triangles_of(&self, leaf: u32) -> Vec<Named> {
        let mut triangles = Vec::new();
        self.pieces_of(leaf, &mut |piece, leaves| match piece {
            Piece::Triangle(t) => triangles.push((t, leaves)),
            Piece::Quad([a, b, c, d]) => {
                let is_first = self.bend(a, c).abs() <= self.bend(b, d).abs();
                let halves = if is_first { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                triangles.extend(halves.map(|half| (half, leaves)));
            }
        });
        triangles
    }

    fn bend(&self, a: VertexKey, b: VertexKey) -> f64 {
        match (self.roots.vertex(&self.nodes, a), self.roots.vertex(&self.nodes, b)) {
            (Some(a), Some(b)) => bend_mm(a, b),
            _ => 0.0,
        }
    }

    /// The leaves to divide because a triangle's side strays too far from the surface.
    fn bent_leaves(&self, leaves: &[u32]) -> Vec<u32> {
        let bent_in = |&leaf: &u32| {
            let triangles = self.triangles_of(leaf);
            triangles.into_iter().flat_map(|named| self.bent_leaves_of(named)).collect::<Vec<u32>>()
        };
        leaves.par_iter().flat_map_iter(bent_in).collect()
    }

    fn bent_leaves_of(&self, (keys, leaves): Named) -> Vec<u32> {
        let divisible: Vec<u32> = self.to_divide(leaves).collect();
        let Some(size_mm) = divisible.first().map(|&i| self.tree.length_mm(self.tree.cell(i).size)) else {
            return Vec::new();
        };
        let is_bent = (0..3).any(|i| {
            let ends = [keys[i], keys[(i + 1) % 3]].map(|key| self.roots.vertex(&self.nodes, key));
            matches!(ends, [Some(a), Some(b)] if self.is_bent(a, b, size_mm))
        });
        if is_bent { divisible } else { Vec::new() }
    }

    /// Whether the chord between two surface points strays too far: first by the turn of the normals, then, where
    /// that leaves a doubt, by the function at its middle.
    fn is_bent(&self, a: &Known, b: &Known, size_mm: f64) -> bool {
        let bend = bend_mm(a, b);
        let Resolution { outside_mm, inside_mm, crease_mm, finest_mm } = self.resolution;
        let is_crease = bend > 0.0 && a.sample.gradient.dot(&b.sample.gradient) < CREASE_COSINE;
        let smallest_mm = if is_crease { crease_mm } else { finest_mm };
        let middle = nalgebra::center(&a.at, &b.at);
        if (-outside_mm..=inside_mm).contains(&bend)
            || size_mm <= smallest_mm
            || !self.field.matters(&middle, size_mm)
        {
            return false;
        }
        let value = self.field.sample(&middle, &[*a, *b]).value;
        !(-outside_mm..=inside_mm).contains(&value)
    }

    /// Numbers the vertices in the order in which the triangles name them.
    fn numbered(&self, named: &[Named]) -> Surface {
        let mut index = IndexMap::default();
        let mut vertices: Vec<Point> = Vec::new();
        let mut number = |key: VertexKey| {
            *index.entry(key).or_insert_with(|| {
                vertices.extend(self.roots.vertex(&self.nodes, key).map(|known| known.at));
                vertices.len() as u32 - 1
            })
        };
        let triangles = named.iter().map(|&(keys, _)| keys.map(&mut number)).collect();
        let leaves = named.iter().map(|&(_, leaves)| leaves).collect();
        Surface { vertices, triangles, leaves }
    }
}

/// How far the surface is estimated to stray from the chord between two of its points, mm: positive where the
/// chord lies inside the region.
///
/// A single crease between two planes that meet the chord at angles α and β strays |ab| αβ/(α+β), at most
/// |ab| (α+β)/4, which this is; an arc strays half of it.
fn bend_mm(a: &Known, b: &Known) -> f64 {
    (a.sample.gradient - b.sample.gradient).dot(&(b.at - a.at)) / 4.0
}
