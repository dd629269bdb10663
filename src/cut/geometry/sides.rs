//! The pieces that a plane would divide a body into, and their volumes, without cutting it.

use crate::{
    cut::geometry::section::{Ring, Section},
    geom::{Plane, Point},
    mesh::{TriMesh, union_find::UnionFind},
};

/// A body seen from a plane: its section, and the pieces on both sides.
pub(crate) struct Sides<'a> {
    mesh: &'a TriMesh,
    plane: Plane,
    pub(crate) section: Section,
    /// The polygons of the section, as indices of rings.
    pub(crate) polygons: Vec<Vec<usize>>,
    /// The piece of each vertex, named by one of its vertices.
    piece_of: Vec<u32>,
}

impl<'a> Sides<'a> {
    /// Finds the pieces, given the section of the mesh by the plane. Surfaces on one side belong to
    /// one piece if they share an edge there or a polygon of the section. Linear in the triangles.
    pub(crate) fn new(mesh: &'a TriMesh, plane: Plane, section: Section) -> Self {
        let polygons = section.groups();
        let mut sets = UnionFind::new(mesh.vertices().len());
        let above: Vec<bool> = mesh
            .vertices()
            .iter()
            .map(|p| plane.distance(p) >= 0.0)
            .collect();
        for &[a, b, c] in mesh.triangles() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if above[from as usize] == above[to as usize] {
                    sets.merge(from, to);
                }
            }
        }
        for group in &polygons {
            let outer = &section.rings[group[0]];
            for hole in group[1..].iter().map(|&i| &section.rings[i]) {
                sets.merge(outer.above, hole.above);
                sets.merge(outer.below, hole.below);
            }
        }
        let piece_of = (0..mesh.vertices().len() as u32)
            .map(|v| sets.root(v))
            .collect();
        Self {
            mesh,
            plane,
            section,
            polygons,
            piece_of,
        }
    }

    /// Returns the plane.
    pub(crate) fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Returns the pieces above and below the plane that polygon `group` of the section joins.
    pub(crate) fn neighbours(&self, group: usize) -> [u32; 2] {
        let ring = &self.section.rings[self.polygons[group][0]];
        [
            self.piece_of[ring.above as usize],
            self.piece_of[ring.below as usize],
        ]
    }

    /// Returns the diameter of the largest disc in polygon `group`, mm; 0 if it is at most
    /// `floor_mm`.
    pub(crate) fn disc_diameter_mm(&self, group: usize, floor_mm: f64) -> f64 {
        let disc = self
            .section
            .outline(&self.polygons[group])
            .largest_disc(floor_mm / 2.0);
        disc.map_or(0.0, |disc| 2.0 * disc.radius_mm)
    }

    /// Returns the diameter of the largest disc in polygon `group`, mm. Only those holes count that
    /// `is_kept` accepts; the others are filled.
    pub(crate) fn filled_disc_diameter_mm(
        &self,
        group: usize,
        is_kept: impl Fn(&Ring) -> bool,
    ) -> f64 {
        let (outer, holes) = self.polygons[group].split_at(1);
        let holes = holes
            .iter()
            .filter(|&&hole| is_kept(&self.section.rings[hole]));
        let rings: Vec<usize> = outer.iter().chain(holes).copied().collect();
        let disc = self.section.outline(&rings).largest_disc(0.0);
        disc.map_or(0.0, |disc| 2.0 * disc.radius_mm)
    }

    /// Returns the greatest distance of a vertex of `piece` from the plane, mm.
    pub(crate) fn depth_mm(&self, piece: u32) -> f64 {
        let vertices = self.mesh.vertices().iter().zip(&self.piece_of);
        vertices
            .filter(|&(_, &of)| of == piece)
            .map(|(p, _)| self.plane.distance(p).abs())
            .fold(0.0, f64::max)
    }

    /// Returns the pieces that the plane leaves, with their volumes, mm³. Shells of cavities that
    /// the plane misses are left out, so these cavities count as material.
    ///
    /// Each piece is summed from tetrahedra with a corner in the plane, to which its flat cap adds
    /// nothing.
    pub(crate) fn piece_volumes_mm3(&self) -> Vec<(u32, f64)> {
        let mut volume_of = vec![0.0; self.mesh.vertices().len()];
        for (triangle, corners) in self.mesh.triangles().iter().zip(self.mesh.iter_corners()) {
            self.add_triangle(*triangle, corners, &mut volume_of);
        }
        (0u32..)
            .zip(volume_of)
            .filter(|&(_, volume)| volume > 0.0)
            .collect()
    }

    /// Adds the part of one triangle above the plane to its piece there, and the part below
    /// likewise.
    fn add_triangle(&self, triangle: [u32; 3], corners: [Point; 3], volume_of: &mut [f64]) {
        let foot = self.plane.foot();
        let heights = corners.map(|p| self.plane.distance(&p));
        let wedge = |p: [Point; 3]| (p[0] - foot).dot(&(p[1] - foot).cross(&(p[2] - foot))) / 6.0;
        let lone = (0..3).find(|&i| {
            let side = |k: usize| heights[k % 3] >= 0.0;
            side(i) != side(i + 1) && side(i) != side(i + 2)
        });
        let Some(i) = lone else {
            volume_of[self.piece_of[triangle[0] as usize] as usize] += wedge(corners);
            return;
        };
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let meet = |to: usize| {
            corners[i] + (corners[to] - corners[i]) * (heights[i] / (heights[i] - heights[to]))
        };
        let tip = wedge([corners[i], meet(j), meet(k)]);
        volume_of[self.piece_of[triangle[i] as usize] as usize] += tip;
        volume_of[self.piece_of[triangle[j] as usize] as usize] +=
            wedge([meet(j), corners[j], corners[k]]) + wedge([meet(j), corners[k], meet(k)]);
    }
}
