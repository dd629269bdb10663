//! Indexed triangles. The only promise is that the indices are in range.

use crate::geom::{Aabb, Frame, Point};

/// Vertices and the triangles that index them.
///
/// Every index is in range and there are fewer than 2³² vertices. The mesh need not be closed,
/// oriented or finite; [`super::Solid`] proves that.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TriMesh {
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
}

/// The reason that vertices and triangles do not make a [`TriMesh`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, but there are only {vertices} vertices")]
    IndexOutOfRange {
        /// Index of the triangle, from 0.
        triangle: usize,
        /// The vertex index that it names.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
}

impl TriMesh {
    /// Makes a mesh of vertices (mm) and triangles. Fails with the first index that is out of
    /// range.
    pub fn new(vertices: Vec<Point>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        let count = vertices.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= count) {
                return Err(MeshError::IndexOutOfRange {
                    triangle,
                    vertex,
                    vertices: count,
                });
            }
        }
        Ok(Self {
            vertices,
            triangles,
        })
    }

    /// Makes a mesh of parts whose indices are in range by construction.
    pub(crate) fn from_parts(vertices: Vec<Point>, triangles: Vec<[u32; 3]>) -> Self {
        debug_assert!(
            triangles
                .iter()
                .flatten()
                .all(|&v| (v as usize) < vertices.len())
        );
        Self {
            vertices,
            triangles,
        }
    }

    /// Returns the vertices, mm.
    #[inline]
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Returns the vertices and drops the triangles.
    pub(crate) fn into_vertices(self) -> Vec<Point> {
        self.vertices
    }

    /// Returns the triangles as vertex indices.
    #[inline]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns true if there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// Returns the corners of triangle `index`.
    #[inline]
    pub fn corners(&self, index: usize) -> [Point; 3] {
        self.triangles[index].map(|v| self.vertices[v as usize])
    }

    /// Returns the corners of every triangle, in order.
    #[inline]
    pub fn iter_corners(&self) -> impl ExactSizeIterator<Item = [Point; 3]> + '_ {
        self.triangles
            .iter()
            .map(|t| t.map(|v| self.vertices[v as usize]))
    }

    /// Returns the bounding box of the vertices.
    pub fn aabb(&self) -> Aabb {
        Aabb::of_points(&self.vertices)
    }

    /// Returns the mesh with each vertex mapped by `f`.
    #[must_use]
    pub fn map_vertices(&self, f: impl Fn(&Point) -> Point) -> Self {
        Self {
            vertices: self.vertices.iter().map(f).collect(),
            triangles: self.triangles.clone(),
        }
    }

    /// Returns the longest side of the bounding box, mm; zero for a mesh without vertices.
    pub fn longest_side_mm(&self) -> f64 {
        if self.vertices.is_empty() {
            0.0
        } else {
            self.aabb().size().max()
        }
    }

    /// Returns the volume that the triangles enclose, mm³: negative if they face inward,
    /// meaningless if the mesh is open.
    ///
    /// By the divergence theorem about the centre of the bounding box, with plain summation.
    pub fn signed_volume_mm3(&self) -> f64 {
        let center = self.aabb().center();
        self.iter_corners()
            .map(|corners| signed_volume_mm3(&corners, &center))
            .sum()
    }

    /// Returns the mesh in `frame`'s own coordinates.
    #[must_use]
    pub fn in_frame(&self, frame: &Frame) -> Self {
        self.map_vertices(|p| frame.to_local(p))
    }

    /// Returns the mesh with the orientation of every triangle reversed.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let triangles = self.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        Self {
            vertices: self.vertices.clone(),
            triangles,
        }
    }

    /// Returns both meshes as one, with nothing shared; `other`'s vertices follow this mesh's.
    #[must_use]
    pub fn joined(mut self, other: &Self) -> Self {
        let shift = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|v| v + shift)));
        self
    }
}

/// Returns the mesh with every length multiplied by `factor`, about the origin.
pub fn scaled(mesh: &TriMesh, factor: f64) -> TriMesh {
    mesh.map_vertices(|p| p * factor)
}

/// Returns the signed volume of the tetrahedron that a triangle spans with `apex`, mm³: positive if
/// the triangle faces away from it.
#[inline]
pub(crate) fn signed_volume_mm3([a, b, c]: &[Point; 3], apex: &Point) -> f64 {
    let (a, b, c) = (a - apex, b - apex, c - apex);
    a.dot(&b.cross(&c)) / 6.0
}

/// Rotates a triangle so that its smallest index comes first; its orientation stays.
pub(crate) fn smallest_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
