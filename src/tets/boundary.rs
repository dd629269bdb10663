//! The surface of a volume mesh.

use super::faces::OuterFace;
use crate::geom::Point;
use crate::mesh::edges::{EdgeKind, EdgeTable};
use crate::mesh::{Solid, TriMesh, scaled};

/// The surface of a volume mesh: the faces with a tetrahedron on one side, turned outward.
///
/// It is closed by construction, as every tetrahedron is. Where parts touch along an edge only,
/// more than two faces meet in it, and it bounds no [`Solid`].
#[derive(Debug, Clone)]
pub struct Boundary {
    mesh: TriMesh,
    solid: Option<Solid>,
    contacts: Vec<Point>,
    /// The tetrahedron inside each triangle.
    cells: Vec<u32>,
}

/// The number of a place that is not on the surface.
const INSIDE: u32 = u32::MAX;

impl Boundary {
    /// Draws the surface; `places` are those of the whole mesh, mm.
    pub(super) fn new(outer: &[OuterFace], places: &[Point]) -> Self {
        let mut numbers = vec![INSIDE; places.len()];
        let mut vertices = Vec::new();
        let mut number = |place: u32| {
            let number = &mut numbers[place as usize];
            if *number == INSIDE {
                *number = vertices.len() as u32;
                vertices.push(places[place as usize]);
            }
            *number
        };
        let triangles = outer.iter().map(|face| face.corners.map(&mut number));
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let mesh = TriMesh::from_parts(vertices, triangles);
        let contacts = contacts(&mesh);
        Self {
            solid: Solid::new(mesh.clone()).ok(),
            contacts,
            cells: outer.iter().map(|face| face.cell).collect(),
            mesh,
        }
    }

    /// Returns the surface with every length multiplied by a factor, about the origin.
    pub(super) fn scaled(self, factor: f64) -> Self {
        let mesh = scaled(&self.mesh, factor);
        Self {
            solid: self.solid.and_then(|_| Solid::new(mesh.clone()).ok()),
            contacts: self.contacts.iter().map(|at| at * factor).collect(),
            cells: self.cells,
            mesh,
        }
    }

    /// Returns the triangles, turned outward.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// Returns the surface as that of a solid; `None` if parts touch along an edge only.
    pub fn solid(&self) -> Option<&Solid> {
        self.solid.as_ref()
    }

    /// Returns the middles of the edges along which parts only touch, mm.
    pub fn contacts(&self) -> &[Point] {
        &self.contacts
    }

    /// Returns the tetrahedron inside a triangle.
    pub(super) fn cell(&self, triangle: usize) -> u32 {
        self.cells[triangle]
    }
}

fn contacts(mesh: &TriMesh) -> Vec<Point> {
    let table = EdgeTable::of(mesh);
    let at = |number: u32| mesh.vertices()[number as usize];
    let crowded = table.of_kind(EdgeKind::Crowded);
    crowded
        .map(|sides| nalgebra::center(&at(sides[0].low), &at(sides[0].high)))
        .collect()
}
