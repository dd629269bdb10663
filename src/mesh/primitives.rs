//! Boxes, balls, cylinders, tori and ellipsoids as closed meshes that face outward.

use std::collections::HashMap;
use std::f64::consts::TAU;

use super::TriMesh;
use crate::geom::{Point, Vector};

/// Least number of segments of a circle: two would enclose nothing.
const MIN_SEGMENTS: u32 = 3;

/// Level of the finest [`ball`]: 20·4¹⁰ is 21 million triangles. One level more would not fit the
/// memory of a desktop computer.
const MAX_LEVEL: u32 = 10;

/// Makes the box between two opposite corners, mm: 8 vertices, 12 triangles. `min` must be less
/// than `max` in every coordinate.
pub fn cuboid(min: &Point, max: &Point) -> TriMesh {
    let pick = |bit: usize, low: f64, high: f64| if bit == 0 { low } else { high };
    let corner = |i: usize| {
        Point::new(
            pick(i & 1, min.x, max.x),
            pick(i & 2, min.y, max.y),
            pick(i & 4, min.z, max.z),
        )
    };
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles = faces
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    TriMesh::from_parts((0..8).map(corner).collect(), triangles)
}

/// Makes an icosphere, mm: 20·4^`level` triangles (level at most 10) with vertices on the sphere.
///
/// The mesh lies inside the ball, so its volume is too small. The difference is 1.8 % at level 2
/// and shrinks fourfold with each level.
pub fn ball(center: &Point, radius_mm: f64, level: u32) -> TriMesh {
    unit_icosphere(level).map_vertices(|p| center + p.coords * radius_mm)
}

/// Makes the ellipsoid with these semi-axes along x, y and z, mm: the [`ball`] of `level`, scaled.
pub fn ellipsoid(center: &Point, semi_axes_mm: &Vector, level: u32) -> TriMesh {
    unit_icosphere(level).map_vertices(|p| center + p.coords.component_mul(semi_axes_mm))
}

/// Makes an upright prism over a regular polygon inscribed in the circle, mm.
///
/// Its axis is z, its base lies on z = 0, and it has at least three segments. Its volume is that of
/// the cylinder times sin(2π/n)/(2π/n).
pub fn cylinder(radius_mm: f64, height_mm: f64, segments: u32) -> TriMesh {
    let n = segments.max(MIN_SEGMENTS);
    let rim = |z: f64| (0..n).map(move |i| on_circle(radius_mm, i, n, z));
    let mut vertices: Vec<Point> = rim(0.0).chain(rim(height_mm)).collect();
    vertices.extend([Point::origin(), Point::new(0.0, 0.0, height_mm)]);
    let (bottom, top) = (2 * n, 2 * n + 1);
    let triangles = (0..n).flat_map(|i| {
        let (a, b) = (i, (i + 1) % n);
        [
            [a, b, b + n],
            [a, b + n, a + n],
            [bottom, b, a],
            [top, a + n, b + n],
        ]
    });
    TriMesh::from_parts(vertices, triangles.collect())
}

/// Makes a ring torus about the z axis, centred on the origin, mm.
///
/// `tube_mm` must be less than `ring_mm`. It has `ring_segments` around the axis and
/// `tube_segments` around the tube, at least three of each.
pub fn torus(ring_mm: f64, tube_mm: f64, ring_segments: u32, tube_segments: u32) -> TriMesh {
    let (n, m) = (
        ring_segments.max(MIN_SEGMENTS),
        tube_segments.max(MIN_SEGMENTS),
    );
    let vertices = (0..n * m).map(|v| {
        let around_tube = on_circle(tube_mm, v % m, m, 0.0);
        on_circle(ring_mm + around_tube.x, v / m, n, around_tube.y)
    });
    let triangles = (0..n * m).flat_map(|v| {
        let (i, j) = (v / m, v % m);
        let (i2, j2) = ((i + 1) % n, (j + 1) % m);
        let [a, b, c, d] = [i * m + j, i2 * m + j, i2 * m + j2, i * m + j2];
        [[a, b, c], [a, c, d]]
    });
    TriMesh::from_parts(vertices.collect(), triangles.collect())
}

/// Returns point `i` of `n` on the circle of this radius about the z axis.
fn on_circle(radius_mm: f64, i: u32, n: u32, z: f64) -> Point {
    let (sin, cos) = (TAU * f64::from(i) / f64::from(n)).sin_cos();
    Point::new(radius_mm * cos, radius_mm * sin, z)
}

/// Splits the icosahedron `level` times, with every vertex on the unit sphere.
fn unit_icosphere(level: u32) -> TriMesh {
    (0..level.min(MAX_LEVEL)).fold(icosahedron(), |mesh, _| split_in_four(&mesh))
}

/// The faces of the icosahedron whose vertices [`icosahedron`] lists, counterclockwise seen from
/// outside.
#[rustfmt::skip]
const ICOSAHEDRON: [[u32; 3]; 20] = [
    [0, 8, 1], [0, 1, 10], [0, 5, 4], [0, 4, 8], [0, 10, 5],
    [1, 6, 7], [1, 8, 6], [1, 7, 10], [2, 3, 9], [2, 11, 3],
    [2, 4, 5], [2, 9, 4], [2, 5, 11], [3, 7, 6], [3, 6, 9],
    [3, 11, 7], [4, 9, 8], [5, 10, 11], [6, 8, 9], [7, 11, 10],
];

/// Makes the regular icosahedron in the unit sphere.
fn icosahedron() -> TriMesh {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let vertices = (0..12).map(|i| {
        let (one, phi) = (sign(i & 1), golden * sign(i & 2));
        let [x, y, z] = [[0.0, one, phi], [one, phi, 0.0], [phi, 0.0, one]][i / 4];
        Point::from(Vector::new(x, y, z).normalize())
    });
    TriMesh::from_parts(vertices.collect(), ICOSAHEDRON.to_vec())
}

fn sign(bit: usize) -> f64 {
    if bit == 0 { -1.0 } else { 1.0 }
}

/// Splits every triangle at the middles of its sides and projects the middles onto the unit sphere.
fn split_in_four(mesh: &TriMesh) -> TriMesh {
    let mut vertices = mesh.vertices().to_vec();
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
            let sum = vertices[a as usize].coords + vertices[b as usize].coords;
            vertices.push(Point::from(sum.normalize()));
            vertices.len() as u32 - 1
        })
    };
    let mut triangles = Vec::with_capacity(mesh.triangles().len() * 4);
    for &[a, b, c] in mesh.triangles() {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    TriMesh::from_parts(vertices, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;
    use std::f64::consts::PI;

    #[test]
    fn every_primitive_is_a_solid_of_the_volume_its_polyhedron_has() {
        let prism = |n: f64| (TAU / n).sin() / (TAU / n);
        let cases = [
            (
                cuboid(&Point::new(-1.0, 0.0, 2.0), &Point::new(1.0, 3.0, 6.0)),
                24.0,
            ),
            (cylinder(2.0, 5.0, 7), PI * 20.0 * prism(7.0)),
            (cylinder(2.0, 5.0, 0), PI * 20.0 * prism(3.0)),
        ];
        for (mesh, volume) in cases {
            let found = Solid::new(mesh).unwrap().mesh().signed_volume_mm3();
            assert!((found / volume - 1.0).abs() < 1e-14, "{found} {volume}");
        }
    }

    #[test]
    fn balls_ellipsoids_and_tori_are_solids_whose_volume_comes_from_below() {
        let sphere = 4.0 / 3.0 * PI;
        let cases = [
            (ball(&Point::new(5.0, 0.0, 0.0), 2.0, 0), 8.0 * sphere, 0.4),
            (
                ball(&Point::new(5.0, 0.0, 0.0), 2.0, 4),
                8.0 * sphere,
                0.006,
            ),
            (
                ellipsoid(&Point::origin(), &Vector::new(1.0, 2.0, 3.0), 4),
                6.0 * sphere,
                0.006,
            ),
            (torus(3.0, 1.0, 90, 60), TAU * PI * 3.0, 0.006),
        ];
        for (mesh, volume, missing) in cases {
            let short = 1.0 - Solid::new(mesh).unwrap().mesh().signed_volume_mm3() / volume;
            assert!(0.0 < short && short < missing, "{short}");
        }
    }

    #[test]
    fn a_ball_has_twenty_triangles_times_four_to_the_level_on_the_sphere() {
        let mesh = ball(&Point::origin(), 3.0, 3);
        assert_eq!((mesh.triangles().len(), mesh.vertices().len()), (1280, 642));
        assert!(
            mesh.vertices()
                .iter()
                .all(|p| (p.coords.norm() - 3.0).abs() < 1e-14)
        );
    }
}
