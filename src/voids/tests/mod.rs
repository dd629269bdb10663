//! Tests of whole cavities and voids, and the checks that they share.

mod cavities;
mod densities;
mod quadrics;

use super::shapes::{ball, block, prism, revolved};
use super::{Cavity, CavitySpec, VoidError, Voids, grow_bodies, without_slivers};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::triangle::triangle_triangle_distance_squared;
use crate::geom::{Aabb, Bvh, Frame, Point, Quadric, Vector};
use crate::mesh::{Csg, MeshDistance, Solid, TriMesh};
use crate::shell::Keep;
use crate::shell::fixtures::cells;

fn signed_volume(mesh: &TriMesh) -> f64 {
    mesh.signed_volume_mm3()
}

/// Half a pixel of a 600 dpi printer.
const TOLERANCE_MM: f64 = 0.021;

fn spec(wall_mm: f64, keeps: &[Keep]) -> CavitySpec<'_> {
    CavitySpec {
        wall_mm,
        tolerance_mm: TOLERANCE_MM,
        quadric_tolerance_mm: TOLERANCE_MM,
        keeps,
        min_void_mm: 0.0,
    }
}

fn cavity_of(mesh: &TriMesh, spec: &CavitySpec) -> Cavity {
    Cavity::extract(&Solid::new(mesh.clone()).unwrap(), spec, &Watch::silent()).unwrap()
}

/// Extracts the cavity and checks the promises that hold for every cavity.
fn sound_cavity(mesh: &TriMesh, spec: &CavitySpec) -> Cavity {
    let cavity = cavity_of(mesh, spec);
    assert_sound(cavity.mesh());
    let wall_mm = MeshDistance::new(mesh).min_distance_to(cavity.mesh());
    assert!(wall_mm >= spec.wall_mm - 0.01, "{wall_mm}");
    cavity
}

/// Asserts that the mesh is closed, 2-manifold (every vertex in one fan) and free of
/// self-intersection, by testing every pair of triangles.
fn assert_sound(mesh: &TriMesh) {
    Solid::new(mesh.clone()).unwrap();
    assert_eq!(fans(mesh), mesh.vertices().len());
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let boxes: Vec<Aabb> = corners.iter().map(Aabb::of_points).collect();
    let mut order: Vec<usize> = (0..corners.len()).collect();
    order.sort_by(|&i, &j| boxes[i].min.x.total_cmp(&boxes[j].min.x));
    for (k, &i) in order.iter().enumerate() {
        for &j in order[k + 1..]
            .iter()
            .take_while(|&&j| boxes[j].min.x <= boxes[i].max.x)
        {
            let shared = mesh.triangles()[i]
                .iter()
                .any(|v| mesh.triangles()[j].contains(v));
            let apart = (0..3)
                .any(|a| boxes[i].min[a] > boxes[j].max[a] || boxes[j].min[a] > boxes[i].max[a]);
            assert!(
                shared
                    || apart
                    || triangle_triangle_distance_squared(&corners[i], &corners[j]) > 0.0,
                "triangles {:?} and {:?} meet",
                corners[i],
                corners[j]
            );
        }
    }
}

/// Counts the fans: the connected runs of triangles around a vertex.
fn fans(mesh: &TriMesh) -> usize {
    let mut next = std::collections::HashMap::new();
    for &[a, b, c] in mesh.triangles() {
        for (v, from, to) in [(a, b, c), (b, c, a), (c, a, b)] {
            assert!(next.insert((v, from), to).is_none());
        }
    }
    let mut seen = std::collections::HashSet::new();
    let mut keys: Vec<_> = next.keys().copied().collect();
    keys.sort_unstable();
    let mut count = 0;
    for (v, start) in keys {
        let mut from = start;
        count += usize::from(!seen.contains(&(v, from)));
        while seen.insert((v, from)) {
            from = next[&(v, from)];
        }
    }
    count
}

/// Returns points of every triangle: its corners, the middles of its sides and its centroid.
fn samples(mesh: &TriMesh) -> Vec<Point> {
    let of = |t: [Point; 3]| {
        let [a, b, c] = t.map(|p| p.coords);
        [
            a,
            b,
            c,
            (a + b) / 2.0,
            (b + c) / 2.0,
            (c + a) / 2.0,
            (a + b + c) / 3.0,
        ]
        .map(Point::from)
    };
    mesh.iter_corners().flat_map(of).collect()
}

const EVERYTHING: Quadric = Quadric([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
