//! Feet: the surface that touches the floor in a pose, and the part of it that is flat.

use super::shape::Shape;
use crate::geom::Vector;
use crate::mesh::union_find::UnionFind;

/// The depths of the two layers over the floor, in lengths of the model.
const LAYER_RATIOS: [f64; 2] = [0.01, 0.02];
/// Surface that looks down to within 26° (cos) can be a part of a foot: edges are often rounded.
const DOWN_COSINE: f64 = 0.9;
/// Patches smaller than this part of the largest are no feet.
const LEAST_PATCH_RATIO: f64 = 0.15;

/// The surface that touches the floor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Foot {
    /// The area in contact, as a share of the surface.
    pub contact_ratio: f64,
    /// The flat part of it.
    pub flat_ratio: f64,
    /// The number of separate patches.
    pub patches: usize,
}

impl Foot {
    /// Finds the foot of a pose in one pass over the triangles.
    ///
    /// Let a(t) be the area that looks down within a depth t of the floor. On a flat foot it does
    /// not grow with t. On the flank of a cylinder it grows as √t, on a ball as t. So (√2 a(t) −
    /// a(2t))/(√2 − 1) is the area of a flat foot, and zero or less for what is only round.
    pub fn of(shape: &Shape, up: &Vector) -> Self {
        let heights: Vec<f64> = shape
            .mesh
            .vertices()
            .iter()
            .map(|v| v.coords.dot(up))
            .collect();
        let floor_mm = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let limits = LAYER_RATIOS.map(|ratio| floor_mm + ratio * shape.length_mm);
        let mut layers_mm2 = [0.0; 2];
        let mut touching = Vec::new();
        for (index, triangle) in shape.mesh.triangles().iter().enumerate() {
            if shape.normals[index].dot(up) > -DOWN_COSINE {
                continue;
            }
            let height_mm = triangle.map(|v| heights[v as usize]);
            let height_mm = height_mm.into_iter().fold(f64::NEG_INFINITY, f64::max);
            for (layer_mm2, limit_mm) in layers_mm2.iter_mut().zip(limits) {
                if height_mm < limit_mm {
                    *layer_mm2 += shape.areas_mm2[index];
                }
            }
            if height_mm < limits[0] {
                touching.push(index);
            }
        }
        let [contact, twice] = layers_mm2.map(|layer_mm2| layer_mm2 / shape.area_mm2);
        let root = std::f64::consts::SQRT_2;
        Self {
            contact_ratio: contact,
            flat_ratio: ((root * contact - twice) / (root - 1.0)).max(0.0),
            patches: patches(shape, &touching),
        }
    }
}

/// Returns the number of patches that triangles make, small ones left out.
fn patches(shape: &Shape, touching: &[usize]) -> usize {
    let corners = |index: &usize| shape.mesh.triangles()[*index];
    let mut vertices: Vec<u32> = touching.iter().flat_map(corners).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let mut sets = UnionFind::new(vertices.len());
    let rank = |vertex: u32| vertices.partition_point(|known| *known < vertex) as u32;
    for [a, b, c] in touching.iter().map(corners) {
        sets.merge(rank(a), rank(b));
        sets.merge(rank(b), rank(c));
    }
    let (labels, count) = sets.labels();
    let mut areas_mm2 = vec![0.0; count];
    for index in touching {
        areas_mm2[labels[rank(corners(index)[0]) as usize] as usize] += shape.areas_mm2[*index];
    }
    let largest_mm2 = areas_mm2.iter().copied().fold(0.0, f64::max);
    let is_foot = |area_mm2: &&f64| **area_mm2 > LEAST_PATCH_RATIO * largest_mm2;
    areas_mm2.iter().filter(is_foot).count()
}
