//! Shells: the connected pieces of a surface, with their volumes and their nesting.

use robust::{Coord, Coord3D, orient2d, orient3d};

use super::TriMesh;
use super::edges::{EdgeKind, EdgeTable, edge_kind};
use super::tri_mesh::signed_volume_mm3;
use super::union_find::UnionFind;
use crate::geom::{Aabb, Point};

/// The connected pieces of a mesh.
#[derive(Debug, Clone)]
pub(crate) struct Shells {
    /// The shell of each triangle.
    of_triangle: Vec<u32>,
    /// The triangles of each shell, ascending.
    members: Vec<Vec<u32>>,
}

impl Shells {
    /// Finds the shells of `mesh`. Triangles that share an edge are in one shell. Those that
    /// meet only at a vertex, or at an edge of three or more triangles, are not.
    pub fn of(mesh: &TriMesh, table: &EdgeTable) -> Self {
        let mut sets = UnionFind::new(mesh.triangles().len());
        for sides in table.edges().filter(|sides| joins(edge_kind(sides))) {
            sets.merge(sides[0].triangle() as u32, sides[1].triangle() as u32);
        }
        let (of_triangle, count) = sets.labels();
        let mut members = vec![Vec::new(); count];
        for (triangle, &shell) in of_triangle.iter().enumerate() {
            members[shell as usize].push(triangle as u32);
        }
        Self {
            of_triangle,
            members,
        }
    }

    /// Returns the number of shells.
    pub fn count(&self) -> usize {
        self.members.len()
    }

    /// Returns the shell of triangle `index`.
    pub fn shell_of(&self, index: usize) -> usize {
        self.of_triangle[index] as usize
    }

    /// Returns the triangles of each shell, ascending.
    pub fn members(&self) -> &[Vec<u32>] {
        &self.members
    }

    /// Returns the signed volume of each shell, computed about its own first corner, mm³.
    pub fn volumes_mm3(&self, mesh: &TriMesh) -> Vec<f64> {
        let volume = |triangles: &Vec<u32>| {
            let [apex, ..] = mesh.corners(triangles[0] as usize);
            triangles
                .iter()
                .map(|&t| signed_volume_mm3(&mesh.corners(t as usize), &apex))
                .sum()
        };
        self.members.iter().map(volume).collect()
    }

    /// Returns, for each shell, the shells that enclose it, ascending. The shells must be
    /// closed and must not cross.
    pub fn enclosing(&self, mesh: &TriMesh) -> Vec<Vec<usize>> {
        let boxes: Vec<Aabb> = self
            .members
            .iter()
            .map(|triangles| shell_box(mesh, triangles))
            .collect();
        let encloses = |outer: usize, inner: usize| {
            outer != inner
                && contains(&boxes[outer], &boxes[inner])
                && winds_around(
                    mesh,
                    &self.members[outer],
                    &mesh.corners(self.members[inner][0] as usize)[0],
                )
        };
        let shells = 0..self.count();
        shells
            .clone()
            .map(|inner| {
                shells
                    .clone()
                    .filter(|&outer| encloses(outer, inner))
                    .collect()
            })
            .collect()
    }
}

/// Returns true if the two triangles on an edge of this kind belong to one shell.
pub(crate) fn joins(kind: EdgeKind) -> bool {
    matches!(kind, EdgeKind::Paired | EdgeKind::Misoriented)
}

/// Returns the bounding box of these triangles.
pub(crate) fn shell_box(mesh: &TriMesh, triangles: &[u32]) -> Aabb {
    let corners = triangles.iter().flat_map(|&t| mesh.corners(t as usize));
    corners.fold(Aabb::EMPTY, |aabb, corner| aabb.grown_over(&corner))
}

fn contains(outer: &Aabb, inner: &Aabb) -> bool {
    outer.union(inner) == *outer
}

/// Returns true if these triangles, taken as one closed surface, wind around `point`.
///
/// They do if the triangles above it, counted +1 if they face up and −1 if they face down, do not
/// cancel.
///
/// Exact (Shewchuk's predicates). A point straight below an edge or a vertex counts as moved by (ε,
/// ε²), so each crossing counts once.
fn winds_around(mesh: &TriMesh, triangles: &[u32], point: &Point) -> bool {
    triangles
        .iter()
        .map(|&t| crossing_above(&mesh.corners(t as usize), point))
        .sum::<i32>()
        != 0
}

/// Returns +1 or −1 if the triangle lies above the point and faces up or down, else 0.
fn crossing_above(corners: &[Point; 3], point: &Point) -> i32 {
    let [a, b, c] = corners;
    let spans = |x: fn(&Point) -> f64| {
        let (p, low, high) = (x(point), x(a).min(x(b)).min(x(c)), x(a).max(x(b)).max(x(c)));
        low <= p && p <= high
    };
    if !spans(|p| p.x) || !spans(|p| p.y) {
        return 0;
    }
    let turns = [
        side_of_edge(a, b, point),
        side_of_edge(b, c, point),
        side_of_edge(c, a, point),
    ];
    let facing = if turns == [1; 3] {
        1
    } else if turns == [-1; 3] {
        -1
    } else {
        return 0;
    };
    let [a, b, c, p] = [a, b, c, point].map(|p| Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    });
    let below = f64::from(facing) * orient3d(a, b, c, p);
    if below > 0.0 { facing } else { 0 }
}

/// Returns the side of the edge on which the point lies: +1 left, −1 right, 0 if the edge is
/// vertical. The point is seen from above and counts as moved by (ε, ε²).
fn side_of_edge(from: &Point, to: &Point, point: &Point) -> i32 {
    let [a, b, p] = [from, to, point].map(|p| Coord { x: p.x, y: p.y });
    let turn = orient2d(a, b, p);
    let turn = if turn != 0.0 { turn } else { from.y - to.y };
    let turn = if turn != 0.0 { turn } else { to.x - from.x };
    if turn > 0.0 {
        1
    } else if turn < 0.0 {
        -1
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    fn cube(half: f64) -> TriMesh {
        cuboid(
            &Point::new(-half, -half, -half),
            &Point::new(half, half, half),
        )
    }

    fn shells(mesh: &TriMesh) -> Shells {
        Shells::of(mesh, &EdgeTable::of(mesh))
    }

    #[test]
    fn nested_boxes_are_found_even_straight_below_edges_and_corners() {
        let mesh = cube(1.0)
            .joined(&cube(3.0))
            .joined(&cube(2.0))
            .joined(&ball(&Point::new(9.0, 0.0, 0.0), 1.0, 1));
        let shells = shells(&mesh);
        assert_eq!(shells.count(), 4);
        assert_eq!(
            shells.enclosing(&mesh),
            [vec![1, 2], vec![], vec![1], vec![]]
        );
    }

    #[test]
    fn a_point_is_wound_around_when_the_ball_holds_it() {
        let mesh = ball(&Point::origin(), 1.0, 2);
        let all: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        for (i, v) in mesh.vertices().iter().enumerate() {
            let factor = if i % 2 == 0 { 0.9 } else { 1.1 };
            assert_eq!(
                winds_around(&mesh, &all, &(v * factor)),
                factor < 1.0,
                "{v}"
            );
        }
    }

    #[test]
    fn shells_keep_their_own_volumes() {
        let mesh = cube(1.0).joined(&cube(2.0).reversed());
        // Twelve sums of exact thirds, each rounded once: a few units in the last place.
        for (found, volume) in shells(&mesh).volumes_mm3(&mesh).iter().zip([8.0, -64.0]) {
            assert!((found / volume - 1.0).abs() < 1e-14);
        }
    }
}
