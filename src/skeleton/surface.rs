//! A closed surface of triangles whose edges collapse, split and flip.

use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;
use crate::mesh::edges::EdgeTable;
use crate::mesh::fans::Fans;

/// The mark of a triangle that is gone.
const GONE: [u32; 3] = [u32::MAX; 3];

/// The least number of triangles around a vertex: with two, both would lie on each other.
const LEAST_STAR: usize = 3;

/// A closed, oriented 2-manifold surface. Vertices and triangles keep their numbers while they
/// live; new ones take new numbers.
#[derive(Debug, Clone)]
pub(super) struct Surface {
    /// The place of every vertex, dead ones too, mm.
    pub at: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    /// The triangles around each vertex; empty for a dead one.
    stars: Vec<Vec<u32>>,
}

/// An edge with the two vertices across it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Diamond {
    /// The ends of the edge.
    pub ends: [u32; 2],
    /// The corners opposite to the edge: of the triangle that runs along it, and of the other.
    pub across: [u32; 2],
}

impl Surface {
    /// Takes the surface of a closed, oriented mesh; vertices in which surfaces only touch are
    /// split.
    pub fn of(mesh: &TriMesh) -> Self {
        let mesh = Fans::of(mesh, &EdgeTable::of(mesh)).split(mesh);
        let mut stars = vec![Vec::new(); mesh.vertices().len()];
        for (index, triangle) in mesh.triangles().iter().enumerate() {
            for &v in triangle {
                stars[v as usize].push(index as u32);
            }
        }
        Self {
            triangles: mesh.triangles().to_vec(),
            stars,
            at: mesh.into_vertices(),
        }
    }

    /// Returns the living triangles, in order.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        self.triangles.iter().copied().filter(|t| *t != GONE)
    }

    /// Returns the living vertices, in order.
    pub fn vertices(&self) -> impl Iterator<Item = u32> {
        (0..self.stars.len() as u32).filter(|v| self.is_alive(*v))
    }

    /// Returns true if a vertex lives.
    pub fn is_alive(&self, v: u32) -> bool {
        !self.stars[v as usize].is_empty()
    }

    /// Returns the triangles around a vertex.
    pub fn star(&self, v: u32) -> impl ExactSizeIterator<Item = [u32; 3]> {
        let star = self.stars[v as usize].iter();
        star.map(|&t| self.triangles[t as usize])
    }

    /// Returns the neighbours of a vertex, each once.
    pub fn neighbours(&self, v: u32) -> impl ExactSizeIterator<Item = u32> {
        self.star(v).map(move |t| turned(t, v)[1])
    }

    /// Returns the number of neighbours.
    pub fn valence(&self, v: u32) -> usize {
        self.stars[v as usize].len()
    }

    /// Returns every edge once, the smaller end first.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let from = |a: u32| self.neighbours(a).map(move |b| [a, b]);
        let both = self.vertices().flat_map(from);
        both.filter(|[a, b]| a < b).collect()
    }

    /// Returns the edge between two vertices with what is across; `None` if there is no such edge.
    pub fn diamond(&self, ends: [u32; 2]) -> Option<Diamond> {
        let [a, b] = ends;
        let along = |from: u32, to: u32| {
            let mut star = self.star(from).map(|t| turned(t, from));
            star.find(|t| t[1] == to).map(|t| t[2])
        };
        let across = [along(a, b)?, along(b, a)?];
        Some(Diamond { ends, across })
    }

    /// Returns the length of an edge, mm.
    pub fn length_mm(&self, [a, b]: [u32; 2]) -> f64 {
        (self.place(a) - self.place(b)).norm()
    }

    /// Returns the place of a vertex, mm.
    pub fn place(&self, v: u32) -> Point {
        self.at[v as usize]
    }

    /// Returns the corners of a triangle, mm.
    pub fn corners(&self, triangle: [u32; 3]) -> [Point; 3] {
        triangle.map(|v| self.place(v))
    }

    /// Returns the sum of the normals of the triangles around a vertex, weighted by their areas.
    pub fn normal(&self, v: u32) -> Vector {
        let normals = self.star(v).map(|t| area_vector(self.corners(t)));
        normals.sum()
    }

    /// Returns the area of the whole surface, mm².
    pub fn area_mm2(&self) -> f64 {
        let areas = self.triangles();
        areas.map(|t| area_vector(self.corners(t)).norm()).sum()
    }

    /// Returns the surface with its living vertices renumbered in their order, and the former
    /// number of each.
    pub fn compact(&self) -> (TriMesh, Vec<u32>) {
        let former: Vec<u32> = self.vertices().collect();
        let mut new = vec![u32::MAX; self.at.len()];
        for (index, v) in former.iter().enumerate() {
            new[*v as usize] = index as u32;
        }
        let triangles = self.triangles().map(|t| t.map(|v| new[v as usize]));
        let places = former.iter().map(|v| self.place(*v)).collect();
        (TriMesh::from_parts(places, triangles.collect()), former)
    }

    /// Returns true if the edge can become a point and leave a 2-manifold (the link condition).
    pub fn may_collapse(&self, Diamond { ends, across }: Diamond) -> bool {
        let [a, b] = ends;
        let shared = self
            .neighbours(a)
            .filter(|v| self.neighbours(b).any(|w| w == *v));
        across[0] != across[1]
            && shared.count() == 2
            && across.iter().all(|v| self.valence(*v) > LEAST_STAR)
            && self.valence(a) + self.valence(b) >= LEAST_STAR + 4
    }

    /// Makes the edge a point at `at`. Its first end lives on, its second dies.
    pub fn collapse(&mut self, [kept, gone]: [u32; 2], at: Point) {
        for index in std::mem::take(&mut self.stars[gone as usize]) {
            let triangle = self.triangles[index as usize];
            if triangle.contains(&kept) {
                self.remove(index, gone);
            } else {
                self.triangles[index as usize] = triangle.map(|v| if v == gone { kept } else { v });
                self.stars[kept as usize].push(index);
            }
        }
        self.at[kept as usize] = at;
    }

    /// Removes a triangle from the stars of its corners, except of one that is emptied already.
    fn remove(&mut self, index: u32, emptied: u32) {
        let triangle = std::mem::replace(&mut self.triangles[index as usize], GONE);
        for v in triangle.into_iter().filter(|v| *v != emptied) {
            self.stars[v as usize].retain(|t| *t != index);
        }
    }

    /// Puts a new vertex on an edge and returns its number.
    pub fn split(&mut self, Diamond { ends, across }: Diamond, at: Point) -> u32 {
        let [a, b] = ends;
        let middle = self.at.len() as u32;
        self.at.push(at);
        self.stars.push(Vec::new());
        let shared: Vec<u32> = self.shared(ends).collect();
        for index in shared {
            let triangle = self.triangles[index as usize];
            let half = triangle.map(|v| if v == a { middle } else { v });
            self.triangles[index as usize] = triangle.map(|v| if v == b { middle } else { v });
            self.stars[b as usize].retain(|t| *t != index);
            self.stars[middle as usize].push(index);
            self.push(half);
        }
        debug_assert!(across.iter().all(|v| self.is_alive(*v)));
        middle
    }

    /// Returns the triangles at an edge.
    fn shared(&self, [a, b]: [u32; 2]) -> impl Iterator<Item = u32> {
        let star = self.stars[a as usize].iter().copied();
        star.filter(move |t| self.triangles[*t as usize].contains(&b))
    }

    fn push(&mut self, triangle: [u32; 3]) {
        let index = self.triangles.len() as u32;
        self.triangles.push(triangle);
        for v in triangle {
            self.stars[v as usize].push(index);
        }
    }

    /// Returns true if the edge can be replaced by the one across it.
    pub fn may_flip(&self, Diamond { ends, across }: Diamond) -> bool {
        across[0] != across[1]
            && ends.iter().all(|v| self.valence(*v) > LEAST_STAR)
            && !self.neighbours(across[0]).any(|v| v == across[1])
    }

    /// Replaces the edge by the one across it.
    pub fn flip(&mut self, diamond: Diamond) {
        let [a, b] = diamond.ends;
        let [c, d] = diamond.across;
        let shared: Vec<u32> = self.shared(diamond.ends).collect();
        for (index, new) in shared.into_iter().zip([[c, d, b], [d, c, a]]) {
            let old = std::mem::replace(&mut self.triangles[index as usize], new);
            for v in old {
                self.stars[v as usize].retain(|t| *t != index);
            }
            for v in new {
                self.stars[v as usize].push(index);
            }
        }
    }
}

impl Diamond {
    /// Returns the two triangles that lie here after a flip.
    pub fn flipped(&self) -> [[u32; 3]; 2] {
        let ([a, b], [c, d]) = (self.ends, self.across);
        [[c, d, b], [d, c, a]]
    }
}

/// Turns a triangle so that it begins with one of its corners.
fn turned([a, b, c]: [u32; 3], first: u32) -> [u32; 3] {
    if a == first {
        [a, b, c]
    } else if b == first {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Returns the normal of a triangle with its area as length, mm².
pub(super) fn area_vector([a, b, c]: [Point; 3]) -> Vector {
    (b - a).cross(&(c - a)) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;
    use crate::mesh::primitives::{ball, torus};

    fn surface() -> Surface {
        Surface::of(&ball(&Point::origin(), 10.0, 2))
    }

    fn is_closed(surface: &Surface) -> bool {
        Solid::new(surface.compact().0).is_ok()
    }

    #[test]
    fn splits_flips_and_collapses_leave_a_closed_surface() {
        let mut surface = surface();
        let edges = surface.edges();
        for (turn, edge) in edges.into_iter().enumerate() {
            let Some(diamond) = surface.diamond(edge) else {
                continue;
            };
            let middle = nalgebra::center(&surface.place(edge[0]), &surface.place(edge[1]));
            match turn % 3 {
                0 => _ = surface.split(diamond, middle),
                1 if surface.may_flip(diamond) => surface.flip(diamond),
                2 if surface.may_collapse(diamond) => surface.collapse(edge, middle),
                _ => {}
            }
            assert!(is_closed(&surface), "{edge:?}");
        }
    }

    #[test]
    fn no_collapse_closes_the_hole_of_a_ring() {
        let mut surface = Surface::of(&torus(10.0, 3.0, 16, 8));
        loop {
            let edges = surface.edges().into_iter();
            let mut diamonds = edges.filter_map(|edge| surface.diamond(edge));
            let Some(diamond) = diamonds.find(|d| surface.may_collapse(*d)) else {
                break;
            };
            let at = surface.place(diamond.ends[0]);
            surface.collapse(diamond.ends, at);
        }
        // The least closed surface of genus 1 has seven vertices and fourteen triangles.
        assert!(surface.vertices().count() >= 7);
        assert_eq!(
            surface.vertices().count() * 2,
            surface.triangles().count(),
            "the genus stays 1"
        );
    }

    #[test]
    fn the_area_is_that_of_the_mesh() {
        let expected = 4.0 * std::f64::consts::PI * 100.0;
        assert!((surface().area_mm2() / expected - 1.0).abs() < 0.03);
    }
}
