//! Surfaces inside the model: fills them, or turns them so that they bound cavities.

use std::collections::BTreeSet;

use super::order::InnerSurfaces;
use super::report::Repairs;
use super::weld::drop_unused_vertices;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::TriMesh;
use crate::mesh::crossings::crossing_pairs;
use crate::mesh::edges::EdgeTable;
use crate::mesh::shells::Shells;

/// Settles the inner surfaces of a mesh as ordered, and counts them. No vertex moves.
///
/// A closed surface inside one other bounds a cavity, whichever way it faces. Inside two it is a
/// loose body and faces outward, and so on. Takes a pass over the triangles for each pair of
/// shells.
///
/// # Errors
/// The watch was stopped.
pub fn settle_inner(
    mesh: TriMesh,
    order: InnerSurfaces,
    repairs: &mut Repairs,
    watch: &Watch,
) -> Result<TriMesh, Cancelled> {
    Ok(match settle(&mesh, order, watch)? {
        Some(settled) => {
            repairs.filled_shells += settled.filled;
            repairs.cavities = settled.cavities;
            settled.mesh
        }
        None => mesh,
    })
}

/// A closed mesh whose inner surfaces are as ordered.
struct Settled {
    mesh: TriMesh,
    /// Number of inner surfaces that were dropped, so that the model is filled.
    filled: usize,
    /// Number of inner surfaces that bound cavities.
    cavities: usize,
}

/// Settles the closed shells that lie inside others and cross none; `None` if there are none, or
/// if nothing was ordered. No vertex moves.
///
/// A shell inside one other bounds a cavity, whichever way it faces; inside two it is a loose body
/// and faces outward, and so on. Takes a pass over the triangles for each pair of shells.
///
/// # Errors
/// The watch was stopped.
fn settle(
    mesh: &TriMesh,
    order: InnerSurfaces,
    watch: &Watch,
) -> Result<Option<Settled>, Cancelled> {
    let table = EdgeTable::of(mesh);
    let shells = Shells::of(mesh, &table);
    if order == InnerSurfaces::Refuse || table.bad_count() > 0 || shells.count() < 2 {
        return Ok(None);
    }
    let pairs = crossing_pairs(mesh, watch)?;
    let crossed = pairs.as_flattened().iter();
    let crossed: BTreeSet<usize> = crossed.map(|&t| shells.shell_of(t as usize)).collect();
    let around = shells.enclosing(mesh);
    let depth = |shell: usize| {
        if crossed.contains(&shell) {
            0
        } else {
            around[shell].len()
        }
    };
    let inner = (0..shells.count()).filter(|&shell| depth(shell) > 0);
    let inner: Vec<usize> = inner.collect();
    if inner.is_empty() {
        return Ok(None);
    }
    let is_filled = order == InnerSurfaces::Fill;
    let volumes = shells.volumes_mm3(mesh);
    let turned = |shell: usize| (volumes[shell] < 0.0) != (depth(shell) % 2 == 1);
    let triangles = mesh.triangles().iter().enumerate();
    let triangles = triangles.filter_map(|(t, &[a, b, c])| {
        let shell = shells.shell_of(t);
        match depth(shell) {
            0 => Some([a, b, c]),
            _ if is_filled => None,
            _ if turned(shell) => Some([a, c, b]),
            _ => Some([a, b, c]),
        }
    });
    let settled = TriMesh::from_parts(mesh.vertices().to_vec(), triangles.collect());
    let cavities = inner.iter().filter(|&&shell| depth(shell) % 2 == 1).count();
    Ok(Some(Settled {
        mesh: drop_unused_vertices(settled),
        filled: if is_filled { inner.len() } else { 0 },
        cavities: if is_filled { 0 } else { cavities },
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::cuboid;

    fn cube(half: f64) -> TriMesh {
        cuboid(
            &Point::new(-half, -half, -half),
            &Point::new(half, half, half),
        )
    }

    fn settled(mesh: &TriMesh, order: InnerSurfaces) -> Option<Settled> {
        settle(mesh, order, &Watch::silent()).unwrap()
    }

    #[test]
    fn a_box_in_a_box_is_filled_or_a_cavity_as_ordered_whichever_way_it_faces() {
        for inner in [cube(1.0), cube(1.0).reversed()] {
            let nested = cube(2.0).joined(&inner);
            let filled = settled(&nested, InnerSurfaces::Fill).unwrap();
            assert_eq!((filled.mesh, filled.filled), (cube(2.0), 1));
            let hollow = settled(&nested, InnerSurfaces::Cavities).unwrap();
            assert_eq!(hollow.cavities, 1);
            assert!((hollow.mesh.signed_volume_mm3() - 56.0).abs() < 1e-12);
            assert!(settled(&nested, InnerSurfaces::Refuse).is_none());
        }
    }

    #[test]
    fn a_body_in_a_cavity_stays_a_body() {
        let onion = cube(3.0).joined(&cube(2.0)).joined(&cube(1.0).reversed());
        let settled = settled(&onion, InnerSurfaces::Cavities).unwrap();
        assert_eq!(settled.cavities, 1);
        assert!((settled.mesh.signed_volume_mm3() - (216.0 - 64.0 + 8.0)).abs() < 1e-12);
    }

    #[test]
    fn bodies_beside_and_through_each_other_are_left_alone() {
        let apart = cube(1.0).map_vertices(|p| Point::new(p.x + 9.0, p.y, p.z));
        assert!(settled(&cube(1.0).joined(&apart), InnerSurfaces::Fill).is_none());
        let through = cube(1.0).map_vertices(|p| Point::new(p.x + 0.5, p.y + 0.25, p.z + 0.125));
        assert!(settled(&cube(1.0).joined(&through), InnerSurfaces::Fill).is_none());
    }
}
