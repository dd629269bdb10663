//! Bodies with known offset surfaces, for the tests of this room.

use crate::geom::Point;
use crate::mesh::{TriMesh, primitives};
use crate::repair::weld;

/// Returns the box from `min` to `max`.
pub fn block(min: [f64; 3], max: [f64; 3]) -> TriMesh {
    primitives::cuboid(&min.into(), &max.into())
}

/// Returns a ball of 5·4^`depth` triangles.
pub fn ball(center: Point, radius: f64, depth: u32) -> TriMesh {
    primitives::ball(&center, radius, depth - 1)
}

/// Returns the mesh of these triangles with equal corners joined.
pub fn welded(triangles: impl Iterator<Item = [Point; 3]>) -> TriMesh {
    let vertices: Vec<Point> = triangles.flatten().collect();
    let triangles = (0..vertices.len() as u32 / 3)
        .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
        .collect();
    weld(&TriMesh::new(vertices, triangles).unwrap())
}

/// Returns the prism from z = 0 to `height` over a counter-clockwise polygon that is star-shaped
/// about its first corner.
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

/// Returns the body of revolution about z of an outline (radius, z) that runs upward and starts and
/// ends on the axis.
pub fn revolved(outline: &[[f64; 2]], sides: usize) -> TriMesh {
    let at = |[r, z]: [f64; 2], k: usize| {
        let angle = (k % sides) as f64 * std::f64::consts::TAU / sides as f64;
        Point::new(r * angle.cos(), r * angle.sin(), z)
    };
    let mut triangles = Vec::new();
    for pair in outline.windows(2) {
        for k in 0..sides {
            let [a, b, c, d] = [
                at(pair[0], k),
                at(pair[0], k + 1),
                at(pair[1], k + 1),
                at(pair[1], k),
            ];
            triangles.extend(
                [[a, b, c], [a, c, d]]
                    .into_iter()
                    .filter(|t| t[0] != t[1] && t[1] != t[2] && t[0] != t[2]),
            );
        }
    }
    welded(triangles.into_iter())
}
