//! An octree over a solid, with one sample of a density in each finest cell, as voxels have it.

use equipoise::field::Density;
use equipoise::geom::{Point, Vector};
use equipoise::mass::Moments;
use equipoise::mesh::{MeshDistance, Solid};

/// Cells whose middle is inside of a solid.
pub struct Octree {
    /// Cells of the finest depth, as cubes that are wholly inside or as single cells.
    cubes: Vec<Cube>,
    nodes: usize,
    /// Side of a finest cell, mm.
    side_mm: f64,
}

/// A cube of finest cells.
struct Cube {
    middle: Point,
    /// Finest cells along a side.
    count: usize,
}

impl Octree {
    /// Returns the octree of a solid. Nodes that the surface crosses are halved to the depth.
    pub fn of(solid: &Solid, depth: u32) -> Self {
        let mesh = solid.mesh();
        let count = 1_usize << depth;
        let mut tree = Self {
            cubes: Vec::new(),
            nodes: 0,
            side_mm: mesh.longest_side_mm() / count as f64,
        };
        let middle = mesh.aabb().center();
        tree.visit(&MeshDistance::new(mesh), Cube { middle, count });
        tree
    }

    /// Returns the number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    fn visit(&mut self, surface: &MeshDistance, cube: Cube) {
        self.nodes += 1;
        let depth_mm = surface.signed(&cube.middle);
        let half_mm = 0.5 * self.side_mm * cube.count as f64;
        let reach_mm = 3_f64.sqrt() * half_mm;
        if depth_mm >= reach_mm || (cube.count == 1 && depth_mm > 0.0) {
            self.cubes.push(cube);
        } else if depth_mm > -reach_mm && cube.count > 1 {
            for corner in 0..8_usize {
                let side = |axis: usize| if corner >> axis & 1 == 0 { -0.5 } else { 0.5 };
                let shift = Vector::from_fn(|axis, _| side(axis) * half_mm);
                self.visit(
                    surface,
                    Cube {
                        middle: cube.middle + shift,
                        count: cube.count / 2,
                    },
                );
            }
        }
    }

    /// Returns the moments of a density with one sample in each finest cell.
    pub fn moments(&self, field: &dyn Density) -> Moments {
        let mut sum = Moments::default();
        let side_mm = self.side_mm;
        for cube in &self.cubes {
            let count = cube.count;
            let start = cube.middle - Vector::repeat(0.5 * side_mm * (count as f64 - 1.0));
            for index in 0..count.pow(3) {
                let place = [index % count, index / count % count, index / count / count];
                let at = start + Vector::from(place.map(|i| i as f64 * side_mm));
                let mut cell = Moments(Moments::monomials(at.x, at.y, at.z));
                for square in &mut cell.0[7..] {
                    *square += side_mm * side_mm / 12.0;
                }
                sum += cell * (field.at(&at) * side_mm.powi(3));
            }
        }
        sum
    }
}
