//! Bodies with known offsets, for the tests of this room.

use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// The box from `min` to `max`.
pub fn block(min: [f64; 3], max: [f64; 3]) -> TriMesh {
    let pick = |bits: usize, axis: usize| if bits >> axis & 1 == 1 { max[axis] } else { min[axis] };
    let vertices = (0..8).map(|bits| Point::new(pick(bits, 0), pick(bits, 1), pick(bits, 2))).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    TriMesh::new(vertices, triangles).unwrap()
}

/// A ball: an octahedron, each side cut into 2^`depth`, projected to the sphere.
pub fn ball(center: Point, radius: f64, depth: u32) -> TriMesh {
    let mut triangles: Vec<[Vector; 3]> = Vec::new();
    for signs in 0..8 {
        let s = |bit: i32| if signs >> bit & 1 == 1 { -1.0 } else { 1.0 };
        let t = [Vector::x() * s(0), Vector::y() * s(1), Vector::z() * s(2)];
        triangles.push(if s(0) * s(1) * s(2) > 0.0 { t } else { [t[0], t[2], t[1]] });
    }
    for _ in 0..depth {
        let cut = |[a, b, c]: [Vector; 3]| {
            let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    welded(triangles.iter().map(|t| t.map(|v| center + v * radius)))
}

/// The mesh of these triangles with equal corners joined.
pub fn welded(triangles: impl Iterator<Item = [Point; 3]>) -> TriMesh {
    let mut index = std::collections::HashMap::new();
    let mut vertices = Vec::new();
    let mut number = |p: Point| {
        *index.entry([p.x + 0.0, p.y + 0.0, p.z + 0.0].map(f64::to_bits)).or_insert_with(|| {
            vertices.push(p);
            vertices.len() as u32 - 1
        })
    };
    let triangles = triangles.map(|t| t.map(&mut number)).collect();
    TriMesh::new(vertices, triangles).unwrap()
}

/// The prism over a counter-clockwise polygon, star-shaped about its first corner, from z = 0 to `height`.
pub fn prism(polygon: &[[f64; 2]], height: f64) -> TriMesh {
    let n = polygon.len();
    let at = |i: usize, z: f64| Point::new(polygon[i % n][0], polygon[i % n][1], z);
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([at(i, 0.0), at(i + 1, 0.0), at(i + 1, height)]);
        triangles.push([at(i, 0.0), at(i + 1, height), at(i, height)]);
    }
    for i in 1..n - 1 {
        triangles.push([at(0, height), at(i, height), at(i + 1, height)]);
        triangles.push([at(0, 0.0), at(i + 1, 0.0), at(i, 0.0)]);
    }
    welded(triangles.into_iter())
}

/// The body of revolution about z of an outline (radius, z) that starts and ends on the axis, upward.
pub fn revolved(outline: &[[f64; 2]], sides: usize) -> TriMesh {
    let at = |[r, z]: [f64; 2], k: usize| {
        let angle = (k % sides) as f64 * std::f64::consts::TAU / sides as f64;
        Point::new(r * angle.cos(), r * angle.sin(), z)
    };
    let mut triangles = Vec::new();
    for pair in outline.windows(2) {
        for k in 0..sides {
            let [a, b, c, d] = [at(pair[0], k), at(pair[0], k + 1), at(pair[1], k + 1), at(pair[1], k)];
            triangles.extend(
                [[a, b, c], [a, c, d]].into_iter().filter(|t| t[0] != t[1] && t[1] != t[2] && t[0] != t[2]),
            );
        }
    }
    welded(triangles.into_iter())
}
