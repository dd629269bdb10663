//! Draws a surface: refines the lattice until its triangles follow the function, then marches.

use rayon::prelude::*;

use super::error::VoidError;
use super::field::{Field, Known, Resolution};
use super::lattice::{Across, Links};
use super::march::{Piece, cap, piece};
use super::nodes::{Nodes, Numbers};
use super::octree::{CIRCUMRADIUS, FINEST_UNITS, Octree};
use super::roots::{Named, Roots, Vertex, VertexKey, is_crossing, vertex_of};
use super::runs::{flat_map_in_runs, map_in_runs, runs};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Point};
use crate::mesh::TriMesh;

/// Cosine of the turn of the normals at a chord's ends below which the chord spans a crease, not a
/// curve (20°). A curve of the wall's radius turns less within the cells that its sag alone
/// requires.
const CREASE_COSINE: f64 = 0.94;

/// The number of a vertex that has none yet.
const UNNUMBERED: u32 = u32::MAX;

/// The surface of a function's positive region while it is being refined.
pub(super) struct Extractor<'a, F> {
    field: &'a F,
    resolution: Resolution,
    tree: Octree,
    nodes: Nodes,
    roots: Roots,
    /// For each cell, the pieces of surface in its tetrahedra.
    pieces: Vec<Vec<PlacedPiece<Vertex>>>,
    watch: &'a Watch,
}

/// A piece of surface, and the two leaves in which it lies.
#[derive(Debug, Clone, Copy)]
struct PlacedPiece<V> {
    piece: Piece<V>,
    leaves: [u32; 2],
}

/// A triangle by the numbers of its vertices, and the two leaves in which it lies.
#[derive(Debug, Clone, Copy)]
struct PlacedTriangle {
    vertices: [Vertex; 3],
    leaves: [u32; 2],
}

impl<'a, F: Field> Extractor<'a, F> {
    /// Starts on the region inside `aabb`, coarse everywhere; an error if the box is too large for
    /// the finest cell.
    pub fn new(
        field: &'a F,
        aabb: &Aabb,
        resolution: Resolution,
        watch: &'a Watch,
    ) -> Result<Self, VoidError> {
        let tree = Octree::new(aabb, resolution.finest_mm, field);
        let mut tree = tree.ok_or(VoidError::TooFine {
            size_mm: aabb.size().max(),
            finest_mm: resolution.finest_mm,
        })?;
        tree.grow(field, watch)?;
        Ok(Self {
            field,
            resolution,
            tree,
            nodes: Nodes::default(),
            roots: Roots::default(),
            pieces: Vec::new(),
            watch,
        })
    }

    /// Returns all leaves.
    pub fn leaves(&self) -> Vec<u32> {
        (0..self.tree.cells().len() as u32)
            .filter(|&i| self.tree.is_leaf(i))
            .collect()
    }

    /// Divides leaves until the triangles in and around `dirty` keep the tolerances. Returns the
    /// leaves whose triangles were drawn, in ascending order.
    pub fn refine(&mut self, mut dirty: Vec<u32>) -> Result<Vec<u32>, Cancelled> {
        let mut drawn = Vec::new();
        while !dirty.is_empty() {
            self.prepare(&dirty)?;
            drawn.extend_from_slice(&dirty);
            let bent = self.bent_leaves(&dirty)?;
            dirty = self.divide(bent)?;
        }
        self.roots.refresh(&self.nodes, self.field, self.watch)?;
        drawn.sort_unstable();
        drawn.dedup();
        drawn.retain(|&leaf| self.tree.is_leaf(leaf));
        Ok(drawn)
    }

    /// Returns the leaves to divide because a triangle in `leaves` is not allowed.
    pub fn leaves_to_refine(
        &self,
        leaves: &[u32],
        allows: impl Fn(&[Point; 3]) -> bool + Sync,
    ) -> Result<Vec<u32>, Cancelled> {
        let refused_in = |i: usize| {
            let triangles = self.triangles_of(leaves[i]).into_iter();
            let refused = triangles
                .filter(|triangle| !allows(&triangle.vertices.map(|vertex| self.known(vertex).at)));
            refused
                .flat_map(|triangle| self.to_divide(triangle.leaves))
                .collect::<Vec<u32>>()
        };
        flat_map_in_runs(leaves.len(), self.watch, refused_in)
    }

    /// Divides those of `leaves` that are not the finest, and returns the leaves to check again.
    pub fn divide(&mut self, mut leaves: Vec<u32>) -> Result<Vec<u32>, Cancelled> {
        leaves.sort_unstable();
        leaves.dedup();
        leaves.retain(|&i| self.tree.cell(i).size > FINEST_UNITS);
        let fresh = self.tree.refine(&leaves, self.field, self.watch)?;
        Ok(self.tree.widened(&fresh))
    }

    /// Returns the leaves that may hold surface and reach into one of these balls.
    pub fn leaves_in(&self, balls: &[(Point, f64)]) -> Vec<u32> {
        let reaches = |leaf: &u32| {
            let cell = self.tree.cell(*leaf);
            let own_mm = CIRCUMRADIUS * self.tree.length_mm(cell.size);
            let meets = |(at, radius): &(Point, f64)| {
                (cell.center.at - at).norm_squared() < (own_mm + radius).powi(2)
            };
            !cell.is_free && balls.iter().any(meets)
        };
        let leaves = self.leaves();
        leaves.into_par_iter().filter(reaches).collect()
    }

    /// Returns the triangles as they are now.
    pub fn mesh(&self) -> Result<TriMesh, VoidError> {
        let leaves = self.leaves();
        let triangles_in = |i: usize| self.triangles_of(leaves[i]);
        let triangles: Vec<PlacedTriangle> =
            flat_map_in_runs(leaves.len(), self.watch, triangles_in)?;
        self.mesh_of(&triangles)
    }

    /// Returns the leaves to divide if a triangle between these two is not good enough: the larger
    /// of those that hold surface, or both.
    fn to_divide(&self, leaves: [u32; 2]) -> impl Iterator<Item = u32> {
        let size = |i: u32| {
            if self.tree.cell(i).is_free {
                0
            } else {
                self.tree.cell(i).size
            }
        };
        let largest = size(leaves[0]).max(size(leaves[1]));
        let both = leaves.map(|leaf| (leaf, size(leaf)));
        both.into_iter()
            .filter(move |&(_, size)| size == largest && size > 0)
            .map(|(leaf, _)| leaf)
    }

    /// Marches through the leaves' tetrahedra and finds the crossings that the pieces name.
    fn prepare(&mut self, leaves: &[u32]) -> Result<(), Cancelled> {
        let (count, watch) = (leaves.len(), self.watch);
        let link = |i: usize| (leaves[i], Links::new(&self.tree, leaves[i]));
        let linked: Vec<(u32, Links)> = map_in_runs(count, watch, link)?;
        let (tree, nodes) = (&self.tree, &mut self.nodes);
        let numbers = nodes.prepare(tree, &linked, self.field, watch)?;
        let march = |i: usize| self.march(leaves[i], &linked[i].1, &numbers[i]);
        let marched: Vec<Vec<PlacedPiece<VertexKey>>> = map_in_runs(count, watch, march)?;
        let keys: Vec<Vec<VertexKey>> = map_in_runs(count, watch, |i| crossings_of(&marched[i]))?;
        let (nodes, roots) = (&self.nodes, &mut self.roots);
        let all = keys.iter().flatten().copied();
        let found = roots.prepare(nodes, all, self.field, watch)?;
        let ends = running_ends(&keys);
        let number = |i: usize| {
            let named = Named {
                keys: &keys[i],
                numbers: &found[ends[i] - keys[i].len()..ends[i]],
            };
            let numbered = |&placed| number_vertices(placed, named);
            marched[i].iter().map(numbered).collect()
        };
        let numbered: Vec<Vec<PlacedPiece<Vertex>>> = map_in_runs(count, watch, number)?;
        self.pieces.resize(self.tree.cells().len(), Vec::new());
        for (&leaf, pieces) in leaves.iter().zip(numbered) {
            self.pieces[leaf as usize] = pieces;
        }
        Ok(())
    }

    /// Returns the pieces of surface in a leaf's tetrahedra.
    fn march(&self, leaf: u32, links: &Links, numbers: &Numbers) -> Vec<PlacedPiece<VertexKey>> {
        let mut pieces = Vec::new();
        links.for_each(|tetrahedron| {
            let corners = tetrahedron.slots.map(|slot| numbers.at(slot));
            let positive = corners.map(|corner| self.nodes.is_positive(corner));
            let across = links.across[tetrahedron.face];
            let leaves = [
                leaf,
                if let Across::Leaf(other) = across {
                    other
                } else {
                    leaf
                },
            ];
            pieces.extend(piece(corners, positive).map(|piece| PlacedPiece { piece, leaves }));
            if across == Across::Boundary {
                let [_, b, c, d] = corners;
                let faces = cap([b, c, d], [positive[1], positive[2], positive[3]]);
                pieces.extend(faces.into_iter().map(|face| PlacedPiece {
                    piece: Piece::Triangle(face),
                    leaves,
                }));
            }
        });
        pieces
    }

    /// Returns the triangles in a leaf's tetrahedra. Quadrilaterals are cut along the diagonal that
    /// bends less.
    fn triangles_of(&self, leaf: u32) -> Vec<PlacedTriangle> {
        let mut triangles = Vec::new();
        for &PlacedPiece { piece, leaves } in &self.pieces[leaf as usize] {
            match piece {
                Piece::Triangle(t) => triangles.push(PlacedTriangle {
                    vertices: t,
                    leaves,
                }),
                Piece::Quad([a, b, c, d]) => {
                    let is_first = self.bend(a, c).abs() <= self.bend(b, d).abs();
                    let halves = if is_first {
                        [[a, b, c], [a, c, d]]
                    } else {
                        [[a, b, d], [b, c, d]]
                    };
                    triangles.extend(halves.map(|vertices| PlacedTriangle { vertices, leaves }));
                }
            }
        }
        triangles
    }

    #[inline]
    fn known(&self, vertex: Vertex) -> &Known {
        self.roots.vertex(&self.nodes, vertex)
    }

    fn bend(&self, a: Vertex, b: Vertex) -> f64 {
        bend_mm(self.known(a), self.known(b))
    }

    /// Returns the leaves to divide because a triangle's side strays too far from the surface.
    fn bent_leaves(&self, leaves: &[u32]) -> Result<Vec<u32>, Cancelled> {
        let bent_in = |i: usize| {
            let triangles = self.triangles_of(leaves[i]);
            triangles
                .into_iter()
                .flat_map(|triangle| self.bent_leaves_of(triangle))
                .collect::<Vec<u32>>()
        };
        flat_map_in_runs(leaves.len(), self.watch, bent_in)
    }

    fn bent_leaves_of(&self, PlacedTriangle { vertices, leaves }: PlacedTriangle) -> Vec<u32> {
        let divisible: Vec<u32> = self.to_divide(leaves).collect();
        let Some(size_mm) = divisible
            .first()
            .map(|&i| self.tree.length_mm(self.tree.cell(i).size))
        else {
            return Vec::new();
        };
        let corners = vertices.map(|vertex| self.known(vertex));
        let is_bent = (0..3).any(|i| self.is_bent(corners[i], corners[(i + 1) % 3], size_mm));
        if is_bent { divisible } else { Vec::new() }
    }

    /// Returns whether the chord between two surface points strays too far. The turn of the normals
    /// decides first; if that leaves a doubt, the function at the middle does.
    fn is_bent(&self, a: &Known, b: &Known, size_mm: f64) -> bool {
        let bend = bend_mm(a, b);
        let Resolution {
            outside_mm,
            inside_mm,
            crease_mm,
            finest_mm,
        } = self.resolution;
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

    /// Builds the mesh; its vertices are numbered in the order in which the triangles name them.
    fn mesh_of(&self, triangles: &[PlacedTriangle]) -> Result<TriMesh, VoidError> {
        let mut index = vec![UNNUMBERED; self.roots.len() + self.nodes.len()];
        let mut vertices: Vec<Point> = Vec::new();
        let mut number = |vertex: Vertex| {
            let place = vertex.place(self.roots.len());
            if index[place] == UNNUMBERED {
                index[place] = vertices.len() as u32;
                vertices.push(self.known(vertex).at);
            }
            index[place]
        };
        let mut numbered = Vec::with_capacity(triangles.len());
        for run in runs(triangles.len()) {
            self.watch.check()?;
            let run = triangles[run].iter();
            numbered.extend(run.map(|triangle| triangle.vertices.map(&mut number)));
        }
        Ok(TriMesh::new(vertices, numbered)?)
    }
}

/// Returns the crossings that pieces of surface name, each once.
fn crossings_of(pieces: &[PlacedPiece<VertexKey>]) -> Vec<VertexKey> {
    let mut keys: Vec<VertexKey> = Vec::with_capacity(4 * pieces.len());
    let named = pieces.iter().map(|placed| placed.piece.vertices());
    named.for_each(|vertices| keys.extend(vertices));
    keys.retain(|&key| is_crossing(key));
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// Returns a piece of surface with the numbers of its vertices.
fn number_vertices(placed: PlacedPiece<VertexKey>, named: Named) -> PlacedPiece<Vertex> {
    PlacedPiece {
        piece: placed.piece.renamed(|key| vertex_of(key, named)),
        leaves: placed.leaves,
    }
}

/// Returns for each list the end of its items if all lists stand one after the other.
fn running_ends<T>(lists: &[Vec<T>]) -> Vec<usize> {
    let mut end = 0;
    let lengths = lists.iter().map(Vec::len);
    lengths
        .map(|length| {
            end += length;
            end
        })
        .collect()
}

/// Returns an estimate of the surface's distance from the chord between two of its points, mm;
/// positive if the chord lies inside the region.
///
/// A single crease between two planes that meet the chord at angles α and β strays by |ab|
/// αβ/(α+β). This is at most |ab| (α+β)/4, the value returned. An arc strays by half of it.
#[inline]
fn bend_mm(a: &Known, b: &Known) -> f64 {
    (a.sample.gradient - b.sample.gradient).dot(&(b.at - a.at)) / 4.0
}
