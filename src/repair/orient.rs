//! Orientation: makes neighbours agree, solids face outward and cavities inward.

use crate::mesh::TriMesh;
use crate::mesh::edges::{EdgeTable, Side, edge_kind};
use crate::mesh::shells::{Shells, joins};

/// Flips triangles until neighbours across an edge agree, shell by shell.
///
/// The larger part of a shell gives the direction; of equal parts, that of the first triangle.
///
/// A one-sided surface, such as a Möbius strip, keeps some edges at which its triangles disagree.
pub(super) fn orient_neighbours(mesh: TriMesh) -> TriMesh {
    let table = EdgeTable::of(&mesh);
    let flipped = relative_flips(&mesh, &table);
    let shells = Shells::of(&mesh, &table);
    let flip_of_shell: Vec<bool> = shells
        .members()
        .iter()
        .map(|triangles| {
            2 * triangles.iter().filter(|&&t| flipped[t as usize]).count() > triangles.len()
        })
        .collect();
    flip_where(mesh, |t| flipped[t] != flip_of_shell[shells.shell_of(t)])
}

/// Returns, for each triangle, true if a flip makes it agree with the first triangle of its shell.
fn relative_flips(mesh: &TriMesh, table: &EdgeTable) -> Vec<bool> {
    let neighbours = neighbours(mesh, table);
    let mut flipped: Vec<Option<bool>> = vec![None; mesh.triangles().len()];
    let mut front = Vec::new();
    for first in 0..flipped.len() {
        if flipped[first].is_some() {
            continue;
        }
        flipped[first] = Some(false);
        front.push(first);
        while let Some(triangle) = front.pop() {
            for &(other, agrees) in neighbours[triangle].iter().flatten() {
                if flipped[other].is_none() {
                    flipped[other] = flipped[triangle].map(|turn| turn == agrees);
                    front.push(other);
                }
            }
        }
    }
    flipped.into_iter().map(|turn| turn == Some(true)).collect()
}

/// Returns, for each side of each triangle, the triangle across it and true if the two agree.
fn neighbours(mesh: &TriMesh, table: &EdgeTable) -> Vec<[Option<(usize, bool)>; 3]> {
    let mut across = vec![[None; 3]; mesh.triangles().len()];
    let mut link = |side: &Side, other: &Side| {
        across[side.triangle()][side.id as usize % 3] =
            Some((other.triangle(), side.forward != other.forward));
    };
    for sides in table.edges().filter(|sides| joins(edge_kind(sides))) {
        link(&sides[0], &sides[1]);
        link(&sides[1], &sides[0]);
    }
    across
}

/// Flips whole shells of a closed mesh so that it bounds a solid.
///
/// An outermost shell faces outward. Everything inside a shell that is flipped is flipped with it,
/// so a cavity that faces the other way than its wall stays a cavity. A shell in a cavity is a
/// solid again and faces outward.
pub(super) fn face_outward(mesh: TriMesh) -> TriMesh {
    let shells = Shells::of(&mesh, &EdgeTable::of(&mesh));
    let flips = shell_flips(&shells.volumes_mm3(&mesh), &enclosing(&shells, &mesh));
    flip_where(mesh, |t| flips[shells.shell_of(t)])
}

fn enclosing(shells: &Shells, mesh: &TriMesh) -> Vec<Vec<usize>> {
    if shells.count() > 1 {
        shells.enclosing(mesh)
    } else {
        vec![Vec::new(); shells.count()]
    }
}

/// Returns, for each shell, true if it must be flipped, given the signed volumes and the enclosing
/// shells.
fn shell_flips(volumes: &[f64], enclosing: &[Vec<usize>]) -> Vec<bool> {
    let mut from_outside: Vec<usize> = (0..volumes.len()).collect();
    from_outside.sort_by_key(|&shell| (enclosing[shell].len(), shell));
    let mut flips = vec![false; volumes.len()];
    let faces_out = |shell: usize, flips: &[bool]| (volumes[shell] > 0.0) != flips[shell];
    for shell in from_outside {
        let around = &enclosing[shell];
        let outermost = around.iter().find(|&&outer| enclosing[outer].is_empty());
        flips[shell] = outermost.is_some_and(|&outer| flips[outer]);
        let winding: i32 = around
            .iter()
            .map(|&outer| if faces_out(outer, &flips) { 1 } else { -1 })
            .sum();
        if winding <= 0 && !faces_out(shell, &flips) {
            flips[shell] = !flips[shell];
        }
    }
    flips
}

fn flip_where(mesh: TriMesh, flip: impl Fn(usize) -> bool) -> TriMesh {
    let turn = |(t, &[a, b, c]): (usize, &[u32; 3])| if flip(t) { [a, c, b] } else { [a, b, c] };
    let triangles = mesh.triangles().iter().enumerate().map(turn).collect();
    TriMesh::from_parts(mesh.into_vertices(), triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::{ball, cuboid};

    fn cube(half: f64) -> TriMesh {
        cuboid(
            &Point::new(-half, -half, -half),
            &Point::new(half, half, half),
        )
    }

    #[test]
    fn a_few_turned_triangles_are_turned_back() {
        let sound = ball(&Point::origin(), 1.0, 2);
        assert_eq!(
            orient_neighbours(flip_where(sound.clone(), |t| t % 5 == 0)),
            sound
        );
    }

    #[test]
    fn a_moebius_strip_cannot_agree() {
        let points = (0..6)
            .map(|i| Point::new(f64::from(i), f64::from(i % 2), 0.0))
            .collect();
        let strip = vec![
            [0, 1, 2],
            [1, 3, 2],
            [2, 3, 4],
            [3, 5, 4],
            [4, 5, 1],
            [5, 0, 1],
        ];
        let oriented = orient_neighbours(TriMesh::new(points, strip).unwrap());
        let misoriented = EdgeTable::of(&oriented)
            .of_kind(crate::mesh::edges::EdgeKind::Misoriented)
            .count();
        assert_eq!(misoriented, 1);
    }

    #[test]
    fn cavities_stay_cavities_and_islands_in_them_are_solids() {
        let onion = cube(4.0).joined(&cube(3.0).reversed()).joined(&cube(2.0));
        assert_eq!(face_outward(onion.clone()), onion);
        assert_eq!(face_outward(onion.reversed()), onion);
        let island_turned = cube(4.0)
            .joined(&cube(3.0).reversed())
            .joined(&cube(2.0).reversed());
        assert_eq!(face_outward(island_turned), onion);
    }

    #[test]
    fn two_solids_side_by_side_both_face_outward() {
        let apart = ball(&Point::new(9.0, 0.0, 0.0), 1.0, 0);
        assert_eq!(
            face_outward(cube(1.0).joined(&apart.reversed())),
            cube(1.0).joined(&apart)
        );
    }
}
