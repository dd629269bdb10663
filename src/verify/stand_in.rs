//! Stand-ins for welding, mesh distance and reading until those rooms are merged.

use std::collections::HashMap;
use std::path::Path;

use crate::geom::{Plane, Point};
use crate::mesh::TriMesh;

/// Corners at one place become one vertex.
pub fn weld(mesh: &TriMesh) -> TriMesh {
    let mut index: HashMap<[u64; 3], u32> = HashMap::new();
    let mut vertices: Vec<Point> = Vec::new();
    let renumbered: Vec<u32> = mesh
        .vertices()
        .iter()
        .map(|p| {
            *index.entry([p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                vertices.push(*p);
                vertices.len() as u32 - 1
            })
        })
        .collect();
    let triangles = mesh.triangles().iter().map(|t| t.map(|v| renumbered[v as usize])).collect();
    TriMesh::new(vertices, triangles).unwrap_or_default()
}

/// Distance between two boxes.
pub struct MeshDistance(TriMesh);

impl MeshDistance {
    /// From this mesh.
    pub fn new(mesh: &TriMesh) -> Self {
        Self(mesh.clone())
    }

    /// To that mesh, mm: from its vertices to the planes of the triangles, right for boxes only.
    pub fn min_distance_to(&self, other: &TriMesh) -> f64 {
        let plane = |[a, b, c]: [Point; 3]| Plane::through(&a, &(b - a).cross(&(c - a)));
        let planes: Vec<Plane> = self.0.iter_corners().map(plane).collect();
        let nearest = |p: &Point| planes.iter().map(|q| q.distance(p).abs()).fold(f64::INFINITY, f64::min);
        other.vertices().iter().map(nearest).fold(f64::INFINITY, f64::min)
    }
}

/// Why a model cannot be read.
pub type ReadError = std::io::Error;

/// The triangles of an STL file.
pub fn read_model(path: &Path) -> Result<TriMesh, ReadError> {
    let mesh = stl_io::read_stl(&mut std::fs::File::open(path)?)?;
    let vertices = mesh.vertices.iter().map(|v| Point::new(v[0].into(), v[1].into(), v[2].into())).collect();
    let triangles = mesh.faces.iter().map(|f| f.vertices.map(|v| v as u32)).collect();
    Ok(TriMesh::new(vertices, triangles).unwrap_or_default())
}
