//! Unstitching: separates edges at which four or more triangles meet into edges of two.

use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::mesh::edges::{EdgeTable, Side};
use crate::mesh::fans::Fans;

/// The space between two neighbouring triangles around a crowded edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wedge {
    /// Material: the bodies that touch along the edge come apart.
    Material,
    /// Air: the bodies stay joined along the edge.
    Air,
}

/// Doubles vertices so that each edge joins two triangles; `None` if that is impossible. No vertex
/// moves.
///
/// Equally many triangles must run along a crowded edge in each direction. Neighbours that enclose
/// material stay joined. If that leaves an edge crowded, those that enclose air stay joined instead
/// (Guéziec et al., "Cutting and stitching", IEEE TVCG 7, 2001).
pub(super) fn unstitch(mesh: &TriMesh) -> Option<TriMesh> {
    let table = EdgeTable::of(mesh);
    [Wedge::Material, Wedge::Air].into_iter().find_map(|wedge| {
        let pairs: Option<Vec<[Side; 2]>> = table
            .edges()
            .map(|sides| pair_sides(mesh, sides, wedge))
            .collect::<Option<Vec<_>>>()
            .map(|p| p.concat());
        let split = Fans::of_pairs(mesh, pairs?.into_iter()).split(mesh);
        (EdgeTable::of(&split).bad_count() == 0).then_some(split)
    })
}

/// Pairs the sides of one edge that run in opposite directions; `None` if they cannot be paired.
fn pair_sides(mesh: &TriMesh, sides: &[Side], wedge: Wedge) -> Option<Vec<[Side; 2]>> {
    let forward = sides.iter().filter(|side| side.forward).count();
    match sides {
        _ if 2 * forward != sides.len() || sides[0].low == sides[0].high => None,
        [a, b] => Some(vec![[*a, *b]]),
        _ => Some(match_brackets(&sort_around(mesh, sides), wedge)),
    }
}

/// Pairs sides around the edge as brackets match. Seen along the edge, material lies after a
/// triangle that runs backward and before one that runs forward.
fn match_brackets(ring: &[Side], wedge: Wedge) -> Vec<[Side; 2]> {
    let opens = |side: &Side| side.forward == (wedge == Wedge::Air);
    let mut pairs: Vec<[Side; 2]> = Vec::with_capacity(ring.len() / 2);
    let mut open: Vec<Side> = Vec::new();
    for (step, side) in ring.iter().chain(ring).enumerate() {
        if opens(side) {
            open.extend((step < ring.len()).then_some(*side));
        } else if !pairs.iter().any(|[_, closed]| closed == side) {
            pairs.extend(open.pop().map(|start| [start, *side]));
        }
    }
    pairs
}

/// Sorts the sides by the angle of their triangles around the edge, counterclockwise seen against
/// its direction.
fn sort_around(mesh: &TriMesh, sides: &[Side]) -> Vec<Side> {
    let place = |v: u32| mesh.vertices()[v as usize];
    let low = place(sides[0].low);
    let along = (place(sides[0].high) - low)
        .try_normalize(0.0)
        .unwrap_or_else(Vector::z);
    let (u, v) = crate::geom::orthonormal_basis(&along);
    let angle = |side: &Side| {
        let apex = mesh.triangles()[side.triangle()][(side.id as usize + 2) % 3];
        let arm = place(apex) - low;
        v.dot(&arm).atan2(u.dot(&arm))
    };
    let mut ring = sides.to_vec();
    ring.sort_by(|a, b| angle(a).total_cmp(&angle(b)).then(a.id.cmp(&b.id)));
    ring
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::mesh::Solid;
    use crate::mesh::primitives::cuboid;
    use crate::repair::weld;

    fn unit_cube() -> TriMesh {
        cuboid(&Point::origin(), &Point::new(1.0, 1.0, 1.0))
    }

    fn at(x: f64, y: f64, z: f64) -> TriMesh {
        unit_cube().map_vertices(|p| p + Vector::new(x, y, z))
    }

    #[test]
    fn two_boxes_that_share_an_edge_come_apart_and_keep_their_volume() {
        let touching = weld(&unit_cube().joined(&at(1.0, 1.0, 0.0)));
        assert_eq!(
            (
                touching.vertices().len(),
                EdgeTable::of(&touching).bad_count()
            ),
            (14, 1)
        );
        let apart = unstitch(&touching).unwrap();
        assert_eq!(apart.vertices().len(), 16);
        assert_eq!(Solid::new(apart).unwrap().mesh().signed_volume_mm3(), 2.0);
    }

    /// Returns the welded surface of unit cubes at these places.
    fn surface_of_cubes(cubes: &[[i8; 3]]) -> TriMesh {
        let mut all = TriMesh::default();
        for &[x, y, z] in cubes {
            let cube = at(x.into(), y.into(), z.into());
            // The faces of a box come two triangles each: low and high x, y, z.
            let nearby = [
                [x - 1, y, z],
                [x + 1, y, z],
                [x, y - 1, z],
                [x, y + 1, z],
                [x, y, z - 1],
                [x, y, z + 1],
            ];
            let bare = (0..12)
                .filter(|t| !cubes.contains(&nearby[t / 2]))
                .map(|t| cube.triangles()[t]);
            all = all.joined(&TriMesh::new(cube.vertices().to_vec(), bare.collect()).unwrap());
        }
        weld(&all)
    }

    #[test]
    fn bodies_bridged_at_both_ends_of_the_edge_they_share_are_joined_along_it() {
        // A storey with two cubes that share an upright edge, between two full storeys.
        // Separated around the material, the surfaces would still meet at both ends of the
        // edge.
        let mut cubes = vec![[0, 0, 1], [1, 1, 1]];
        cubes.extend(
            [[0, 0], [0, 1], [1, 0], [1, 1]]
                .iter()
                .flat_map(|&[x, y]| [[x, y, 0], [x, y, 2]]),
        );
        let mesh = surface_of_cubes(&cubes);
        assert_eq!(EdgeTable::of(&mesh).bad_count(), 1);
        let apart = unstitch(&mesh).unwrap();
        assert!((Solid::new(apart).unwrap().mesh().signed_volume_mm3() - 10.0).abs() < 1e-12);
    }

    #[test]
    fn a_fin_on_a_box_cannot_be_taken_apart() {
        let cube = unit_cube();
        let mut triangles = cube.triangles().to_vec();
        triangles.push([0, 1, 7]);
        assert_eq!(
            unstitch(&TriMesh::new(cube.vertices().to_vec(), triangles).unwrap()),
            None
        );
    }
}
