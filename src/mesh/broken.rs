//! The edges and triangles of a mesh that keep it from bounding a solid.

use super::TriMesh;
use super::crossings::crossing_pairs;
use super::edges::{EdgeKind, EdgeTable, edge_kind};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Point;

/// The edges and triangles that are broken in a mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Broken {
    /// The ends of each edge that is not shared by exactly two triangles which run in opposite
    /// directions.
    pub edges: Vec<[Point; 2]>,
    /// True for each triangle that crosses another one.
    pub crossing: Vec<bool>,
}

impl Broken {
    /// Finds what is broken. Costs as much as [`Crossings::of`](super::Crossings::of).
    ///
    /// # Errors
    /// The watch was stopped.
    pub fn of(mesh: &TriMesh, watch: &Watch) -> Result<Self, Cancelled> {
        let table = EdgeTable::of(mesh);
        let bad = table
            .edges()
            .filter(|sides| edge_kind(sides) != EdgeKind::Paired);
        let ends = bad.map(|sides| [sides[0].low, sides[0].high]);
        let edges = ends.map(|ends| ends.map(|v| mesh.vertices()[v as usize]));
        let edges = edges.collect();
        let mut crossing = vec![false; mesh.triangles().len()];
        let pairs = crossing_pairs(mesh, watch)?;
        let crossed = pairs.as_flattened().iter();
        crossed.for_each(|&t| crossing[t as usize] = true);
        Ok(Self { edges, crossing })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::cuboid;

    fn count(mesh: &TriMesh) -> (usize, usize) {
        let broken = Broken::of(mesh, &Watch::silent()).unwrap();
        let crossing = broken.crossing.into_iter().filter(|crosses| *crosses);
        (broken.edges.len(), crossing.count())
    }

    #[test]
    fn rims_and_triangles_that_cross_are_found_and_nothing_else() {
        let cube = cuboid(&Point::origin(), &Point::new(1.0, 1.0, 1.0));
        assert_eq!(count(&cube), (0, 0));
        let open = TriMesh::new(cube.vertices().to_vec(), cube.triangles()[1..].to_vec()).unwrap();
        assert_eq!(count(&open), (3, 0));
        let through = cuboid(&Point::new(0.3, 0.4, -0.5), &Point::new(0.5, 0.7, 0.5));
        let (edges, crossing) = count(&cube.joined(&through));
        // Eight triangles of the sides of the second box pass through the floor.
        assert!(edges == 0 && crossing >= 9, "{edges} {crossing}");
    }
}
