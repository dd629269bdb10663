//! Meshes with known figures, for the tests of the judge.

use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// Returns an axis-aligned block with its least corner at `corner`.
pub fn block(corner: Point, size: [f64; 3]) -> TriMesh {
    let at = |i: usize| {
        let bits = Vector::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64);
        corner + bits.component_mul(&Vector::from(size))
    };
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
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    TriMesh::new((0..8).map(at).collect(), triangles).unwrap()
}

/// Returns a ball of latitude rings: `rings` from pole to pole, twice as many around. The first
/// vertex is the north pole.
pub fn ball(center: Point, radius: f64, rings: u32) -> TriMesh {
    let around = 2 * rings;
    let at = |ring: u32, step: u32| {
        let (polar, turn) = (angle(ring, 2 * rings), angle(step, around));
        center
            + Vector::new(
                polar.sin() * turn.cos(),
                polar.sin() * turn.sin(),
                polar.cos(),
            ) * radius
    };
    let mut vertices = vec![center + Vector::z() * radius];
    vertices.extend((1..rings).flat_map(|ring| (0..around).map(move |step| at(ring, step))));
    vertices.push(center - Vector::z() * radius);
    let south = vertices.len() as u32 - 1;
    let index = |ring: u32, step: u32| match ring {
        0 => 0,
        _ if ring == rings => south,
        _ => 1 + (ring - 1) * around + step % around,
    };
    let mut triangles = Vec::new();
    for (ring, step) in (0..rings).flat_map(|ring| (0..around).map(move |step| (ring, step))) {
        let [a, b, c, d] = [
            index(ring, step),
            index(ring + 1, step),
            index(ring + 1, step + 1),
            index(ring, step + 1),
        ];
        triangles.extend(
            [[a, b, c], [a, c, d]]
                .into_iter()
                .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]),
        );
    }
    TriMesh::new(vertices, triangles).unwrap()
}

fn angle(step: u32, of: u32) -> f64 {
    std::f64::consts::TAU * f64::from(step) / f64::from(of)
}

/// Returns a block with its least corner at the origin and a pocket in its top. The wall has the
/// same thickness all around and below.
pub fn tray(size: [f64; 3], wall: f64) -> TriMesh {
    let [a, b, c] = size;
    let ring = |inset: f64, z: f64| {
        [
            [inset, inset],
            [a - inset, inset],
            [a - inset, b - inset],
            [inset, b - inset],
        ]
        .map(|[x, y]| Point::new(x, y, z))
    };
    let vertices = [
        ring(0.0, 0.0),
        ring(0.0, c),
        ring(wall, c),
        ring(wall, wall),
    ]
    .concat();
    let mut triangles = vec![[0, 2, 1], [0, 3, 2], [12, 13, 14], [12, 14, 15]];
    for (level, side) in [0, 4, 8]
        .into_iter()
        .flat_map(|level| (0..4).map(move |side| (level, side)))
    {
        let (p, q) = (level + side, level + (side + 1) % 4);
        triangles.extend([[p, q, q + 4], [p, q + 4, p + 4]]);
    }
    TriMesh::new(vertices, triangles).unwrap()
}
