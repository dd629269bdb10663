//! Exact distances: from a point to a mesh, signed, and between two meshes.

use std::collections::HashMap;

use rayon::prelude::*;

use super::TriMesh;
use crate::geom::triangle::Feature;
use crate::geom::{Bvh, Nearest, Point, Vector};

/// Number of triangles measured with one common bound. Fewer lose the bound too often, more balance
/// the load worse.
const CHUNK: usize = 256;

/// Stride of the vertices that are measured for the first bound of the distance between two meshes.
const VERTEX_STRIDE: usize = 16;

/// A mesh prepared for distance queries.
///
/// Building costs O(n log n); a query about O(log n).
#[derive(Debug, Clone)]
pub struct MeshDistance {
    bvh: Bvh,
    triangles: Vec<[u32; 3]>,
    normals: Pseudonormals,
}

impl MeshDistance {
    /// Prepares the triangles of `mesh`.
    pub fn new(mesh: &TriMesh) -> Self {
        Self {
            bvh: Bvh::new(mesh.iter_corners()),
            triangles: mesh.triangles().to_vec(),
            normals: Pseudonormals::new(mesh),
        }
    }

    /// Returns the tree over the triangles.
    pub fn bvh(&self) -> &Bvh {
        &self.bvh
    }

    /// Returns the distance from `p` to the surface, mm: positive inside, negative outside; −∞
    /// for an empty mesh.
    ///
    /// Exact up to rounding. The sign is that of the angle-weighted pseudonormal (Bærentzen &
    /// Aanæs, "Signed Distance Computation Using the Angle Weighted Pseudonormal", IEEE TVCG
    /// 11, 2005). It is right for closed meshes free of self-intersection; for others use
    /// [`Bvh::winding`].
    pub fn signed(&self, p: &Point) -> f64 {
        let Some(nearest) = self.bvh.closest(p, f64::INFINITY, &[]) else {
            return f64::NEG_INFINITY;
        };
        let outward = self.pseudonormal(&nearest).dot(&(p - nearest.point));
        nearest.distance_squared.sqrt() * if outward > 0.0 { -1.0 } else { 1.0 }
    }

    /// Returns the least distance between this surface and that of `other`, mm; 0 if they meet.
    /// Exact up to rounding.
    ///
    /// Infinite if either is empty. Runs on all threads; the result does not depend on their
    /// number.
    pub fn min_distance_to(&self, other: &TriMesh) -> f64 {
        least_distance_mm(&self.bvh, other)
    }

    fn pseudonormal(&self, nearest: &Nearest) -> Vector {
        let triangle = nearest.triangle as usize;
        match nearest.feature {
            Feature::Face => self.normals.faces[triangle],
            Feature::Edge(i) => self.normals.edges[triangle][i as usize],
            Feature::Vertex(i) => {
                self.normals.vertices[self.triangles[triangle][i as usize] as usize]
            }
        }
    }
}

/// Returns the least distance between the triangles of a tree and those of `other`, mm; 0 if they
/// meet. Exact up to rounding.
///
/// Infinite if either is empty. Runs on all threads; the result does not depend on their number.
pub fn least_distance_mm(bvh: &Bvh, other: &TriMesh) -> f64 {
    let vertices: Vec<&Point> = other.vertices().iter().step_by(VERTEX_STRIDE).collect();
    let to_vertices = vertices.par_chunks(CHUNK).map(|chunk| {
        chunk.iter().fold(f64::INFINITY, |best: f64, p| {
            let nearest = bvh.closest(p, best, &[]);
            nearest.map_or(best, |n| best.min(n.distance_squared.sqrt()))
        })
    });
    let first_bound = least(to_vertices);
    let indices: Vec<usize> = (0..other.triangles().len()).collect();
    least(indices.par_chunks(CHUNK).map(|chunk| {
        chunk.iter().fold(first_bound, |best, &i| {
            bvh.triangle_distance(&other.corners(i), best)
        })
    }))
}

/// Returns the least of some numbers; infinite if there are none.
fn least(numbers: impl IndexedParallelIterator<Item = f64>) -> f64 {
    let numbers: Vec<f64> = numbers.collect();
    numbers.into_iter().fold(f64::INFINITY, f64::min)
}

/// The outward pseudonormals of faces, edges and vertices; not normalised.
#[derive(Debug, Clone)]
struct Pseudonormals {
    faces: Vec<Vector>,
    edges: Vec<[Vector; 3]>,
    vertices: Vec<Vector>,
}

impl Pseudonormals {
    fn new(mesh: &TriMesh) -> Self {
        let faces: Vec<Vector> = mesh
            .iter_corners()
            .map(|corners| unit_normal(&corners))
            .collect();
        Self {
            edges: edge_normals(mesh, &faces),
            vertices: vertex_normals(mesh, &faces),
            faces,
        }
    }
}

/// Returns the unit normal; zero for a triangle without area.
fn unit_normal([a, b, c]: &[Point; 3]) -> Vector {
    (b - a)
        .cross(&(c - a))
        .try_normalize(0.0)
        .unwrap_or_else(Vector::zeros)
}

/// Returns, for each edge of each triangle, the sum of the normals on both sides.
fn edge_normals(mesh: &TriMesh, faces: &[Vector]) -> Vec<[Vector; 3]> {
    let key = |t: &[u32; 3], i: usize| {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        (a.min(b), a.max(b))
    };
    let mut sums: HashMap<(u32, u32), Vector> = HashMap::with_capacity(3 * faces.len() / 2);
    for (t, normal) in mesh.triangles().iter().zip(faces) {
        (0..3).for_each(|i| *sums.entry(key(t, i)).or_insert_with(Vector::zeros) += normal);
    }
    let sum = |t: &[u32; 3], i: usize| sums.get(&key(t, i)).copied().unwrap_or_else(Vector::zeros);
    mesh.triangles()
        .iter()
        .map(|t| [0, 1, 2].map(|i| sum(t, i)))
        .collect()
}

/// Returns, for each vertex, the sum of the normals around it, weighted by their angles.
fn vertex_normals(mesh: &TriMesh, faces: &[Vector]) -> Vec<Vector> {
    let mut sums = vec![Vector::zeros(); mesh.vertices().len()];
    for ((t, corners), normal) in mesh.triangles().iter().zip(mesh.iter_corners()).zip(faces) {
        for i in 0..3 {
            let (to_next, to_last) = (
                corners[(i + 1) % 3] - corners[i],
                corners[(i + 2) % 3] - corners[i],
            );
            sums[t[i] as usize] += normal * to_next.angle(&to_last);
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::triangle::triangle_triangle_distance_squared;

    /// A box from `min` to `max`, with each face cut along a diagonal.
    fn block(min: [f64; 3], max: [f64; 3]) -> TriMesh {
        let pick = |bits: usize, axis: usize| {
            if bits >> axis & 1 == 1 {
                max[axis]
            } else {
                min[axis]
            }
        };
        let vertices = (0..8)
            .map(|bits| Point::new(pick(bits, 0), pick(bits, 1), pick(bits, 2)))
            .collect();
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = quads
            .iter()
            .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
            .collect();
        TriMesh::new(vertices, triangles).unwrap()
    }

    #[test]
    fn the_signed_distance_to_a_box_is_the_closed_form() {
        let distance = MeshDistance::new(&block([0.0; 3], [4.0, 6.0, 8.0]));
        let cases = [
            ([2.0, 3.0, 4.0], 2.0),
            ([1.0, 3.0, 4.0], 1.0),
            ([0.5, 0.25, 0.75], 0.25),
            ([-1.0, 3.0, 4.0], -1.0),
            ([-3.0, -4.0, 4.0], -5.0),
            ([5.0, 8.0, 10.0], -3.0),
        ];
        for ([x, y, z], expected) in cases {
            let found = distance.signed(&Point::new(x, y, z));
            assert!((found - expected).abs() < 1e-14, "{x} {y} {z}: {found}");
        }
    }

    #[test]
    fn the_side_agrees_with_the_winding_of_a_ray() {
        let distance = MeshDistance::new(&block([0.1, 0.2, 0.3], [4.0, 6.0, 8.0]));
        for i in 0..2000 {
            let t = f64::from(i);
            let p = Point::new(
                (t * 0.754_877).fract(),
                (t * 0.569_840).fract(),
                (t * 0.430_159).fract(),
            ) * 9.0;
            assert_eq!(
                distance.signed(&p) > 0.0,
                distance.bvh().winding(&p) > 0,
                "{p}"
            );
        }
    }

    #[test]
    fn two_boxes_are_as_far_apart_as_their_facing_sides() {
        let a = block([0.0; 3], [4.0, 6.0, 8.0]);
        let distance = MeshDistance::new(&a);
        let beside = block([7.0, 1.0, 1.0], [9.0, 2.0, 2.0]);
        assert_eq!(distance.min_distance_to(&beside), 3.0);
        assert_eq!(
            distance.min_distance_to(&block([1.0; 3], [3.0, 5.0, 7.0])),
            1.0
        );
        assert_eq!(distance.min_distance_to(&block([1.0; 3], [9.0; 3])), 0.0);
        assert_eq!(distance.min_distance_to(&TriMesh::default()), f64::INFINITY);
    }

    #[test]
    fn the_distance_between_meshes_is_that_of_all_pairs_whatever_the_threads() {
        let wavy = |shift: f64| {
            let n = 24u32;
            let height =
                |i: u32, j: u32| (f64::from(i) * 0.9 + shift).sin() * (f64::from(j) * 0.7).cos();
            let vertex = |k| {
                Point::new(
                    f64::from(k % n),
                    f64::from(k / n),
                    height(k % n, k / n) + 3.0 * shift,
                )
            };
            let corner = |k: u32| k / (n - 1) * n + k % (n - 1);
            let quad = |k| {
                [
                    [corner(k), corner(k) + 1, corner(k) + n + 1],
                    [corner(k), corner(k) + n + 1, corner(k) + n],
                ]
            };
            TriMesh::new(
                (0..n * n).map(vertex).collect(),
                (0..(n - 1) * (n - 1)).flat_map(quad).collect(),
            )
            .unwrap()
        };
        let (a, b) = (wavy(0.0), wavy(1.1));
        let distance = MeshDistance::new(&a);
        let brute = a
            .iter_corners()
            .flat_map(|s| {
                b.iter_corners()
                    .map(move |t| triangle_triangle_distance_squared(&s, &t))
            })
            .fold(f64::INFINITY, f64::min)
            .sqrt();
        let with_threads = |n| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(n)
                .build()
                .unwrap();
            pool.install(|| distance.min_distance_to(&b))
        };
        assert!((with_threads(1) - brute).abs() < 1e-12);
        assert_eq!(with_threads(1).to_bits(), with_threads(2).to_bits());
    }
}
