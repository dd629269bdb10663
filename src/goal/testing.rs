//! Small solids that the tests of several rooms share.

use crate::geom::Point;
use crate::mesh::{Solid, TriMesh};

/// Returns the solid whose faces are these convex polygons, wound outward.
fn of_faces(vertices: &[[f64; 3]], faces: &[&[u32]]) -> Solid {
    let triangles = faces
        .iter()
        .flat_map(|face| face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]));
    let vertices = vertices.iter().map(|v| Point::from(*v)).collect();
    Solid::new(TriMesh::new(vertices, triangles.collect()).unwrap()).unwrap()
}

/// Returns the prism over a polygon of the xz plane, counterclockwise seen against y, from y = 0 to
/// `depth`.
pub fn prism(polygon: &[[f64; 2]], caps: &[&[u32]], depth: f64) -> Solid {
    let n = polygon.len() as u32;
    let at = |y: f64| polygon.iter().map(move |p| [p[0], y, p[1]]);
    let vertices: Vec<[f64; 3]> = at(0.0).chain(at(depth)).collect();
    let mut faces: Vec<Vec<u32>> = caps.iter().map(|cap| cap.to_vec()).collect();
    faces.extend(
        caps.iter()
            .map(|cap| cap.iter().rev().map(|v| v + n).collect()),
    );
    faces.extend((0..n).map(|i| vec![i, i + n, (i + 1) % n + n, (i + 1) % n]));
    of_faces(
        &vertices,
        &faces.iter().map(Vec::as_slice).collect::<Vec<_>>(),
    )
}

/// Returns the axis-aligned block between two corners.
pub fn block(min: [f64; 3], max: [f64; 3]) -> Solid {
    let corner = |i: usize| {
        [0, 1, 2].map(|axis| {
            if i >> axis & 1 == 0 {
                min[axis]
            } else {
                max[axis]
            }
        })
    };
    let vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
    of_faces(
        &vertices,
        &[
            &[0, 2, 3, 1],
            &[4, 5, 7, 6],
            &[0, 1, 5, 4],
            &[2, 6, 7, 3],
            &[0, 4, 6, 2],
            &[1, 3, 7, 5],
        ],
    )
}

/// Returns a plate from z = 6 to 8 on two legs of 2 mm, 10 mm wide and 4 mm deep.
pub fn arch() -> Solid {
    let outline = [
        [0., 0.],
        [2., 0.],
        [2., 6.],
        [8., 6.],
        [8., 0.],
        [10., 0.],
        [10., 8.],
        [0., 8.],
    ];
    prism(
        &outline,
        &[&[0, 1, 2, 7], &[2, 3, 6, 7], &[3, 4, 5, 6]],
        4.0,
    )
}

/// Returns the unit octahedron, which stands on a tip.
pub fn octahedron() -> Solid {
    let vertices = [
        [1., 0., 0.],
        [-1., 0., 0.],
        [0., 1., 0.],
        [0., -1., 0.],
        [0., 0., 1.],
        [0., 0., -1.],
    ];
    let up: [&[u32]; 4] = [&[0, 2, 4], &[2, 1, 4], &[1, 3, 4], &[3, 0, 4]];
    let down: [&[u32]; 4] = [&[2, 0, 5], &[1, 2, 5], &[3, 1, 5], &[0, 3, 5]];
    of_faces(&vertices, &[up, down].concat())
}
