//! Solids for tests, and a small random number generator.

use std::collections::HashMap;

use crate::geom::{Point, Vector};
use crate::mesh::{Solid, TriMesh};

/// A generator of pseudorandom numbers, the same on every machine (splitmix64; Steele, Lea & Flood,
/// OOPSLA 2014).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns a number uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a unit vector uniform on the sphere.
    pub(crate) fn direction(&mut self) -> Vector {
        loop {
            let v = Vector::from_fn(|_, _| 2.0 * self.unit() - 1.0);
            if (0.01..1.0).contains(&v.norm_squared()) {
                return v.normalize();
            }
        }
    }
}

/// Returns the union of cubes of a lattice of side `size_mm`. Two cubes must share a face or be
/// apart.
pub(crate) fn cells(cells: &[[i32; 3]], size_mm: f64) -> Solid {
    let mut vertices = Vec::new();
    let mut indices: HashMap<[i32; 3], u32> = HashMap::new();
    let mut triangles = Vec::new();
    for cell in cells {
        for axis in 0..3 {
            for side in 0..2 {
                let mut neighbour = *cell;
                neighbour[axis] += 2 * side - 1;
                if cells.contains(&neighbour) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[du, dv]| {
                    let mut corner = *cell;
                    corner[axis] += side;
                    corner[u] += du;
                    corner[v] += dv;
                    *indices.entry(corner).or_insert_with(|| {
                        vertices.push(Point::from(corner.map(|c| f64::from(c) * size_mm)));
                        vertices.len() as u32 - 1
                    })
                });
                let [a, b, c, d] = if side == 1 {
                    quad
                } else {
                    [quad[3], quad[2], quad[1], quad[0]]
                };
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    Solid::new(TriMesh::new(vertices, triangles).unwrap()).unwrap()
}

/// Returns a sphere of `radius_mm` with its vertices moved outward by `bump(direction)` mm. It is
/// an icosahedron whose faces are split into four `levels` times.
pub(crate) fn bumpy_ball(
    radius_mm: f64,
    levels: usize,
    mut bump: impl FnMut(&Vector) -> f64,
) -> Solid {
    let (mut directions, mut triangles) = icosahedron();
    for _ in 0..levels {
        triangles = split(&mut directions, &triangles);
    }
    let vertices = directions
        .iter()
        .map(|d| Point::from(d * (radius_mm + bump(d))))
        .collect();
    Solid::new(TriMesh::new(vertices, triangles).unwrap()).unwrap()
}

fn icosahedron() -> (Vec<Vector>, Vec<[u32; 3]>) {
    let g = (1.0 + 5.0f64.sqrt()) / 2.0;
    let corners = [
        [-1.0, g, 0.0],
        [1.0, g, 0.0],
        [-1.0, -g, 0.0],
        [1.0, -g, 0.0],
        [0.0, -1.0, g],
        [0.0, 1.0, g],
        [0.0, -1.0, -g],
        [0.0, 1.0, -g],
        [g, 0.0, -1.0],
        [g, 0.0, 1.0],
        [-g, 0.0, -1.0],
        [-g, 0.0, 1.0],
    ];
    let triangles = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    (
        corners.map(|c| Vector::from(c).normalize()).to_vec(),
        triangles.to_vec(),
    )
}

fn split(directions: &mut Vec<Vector>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            directions.push((directions[a as usize] + directions[b as usize]).normalize());
            directions.len() as u32 - 1
        })
    };
    let quarter = |&[a, b, c]: &[u32; 3]| {
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    triangles.iter().flat_map(quarter).collect()
}
