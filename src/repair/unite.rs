//! Uniting: makes one surface of closed shells that overlap.

use crate::base::watch::{Cancelled, Watch};
use crate::mesh::edges::EdgeTable;
use crate::mesh::shells::Shells;
use crate::mesh::{Crossings, Csg, Defects, TriMesh, shells};

/// Largest number of shells that are united. Each costs a few booleans.
const MAX_SHELLS: usize = 200;

/// Thickness up to which slivers along the seams are closed, as a share of the longest side. On a
/// model of 100 mm it is 2e-5 mm, the least that a file in single precision keeps.
const SLIVER_RATIO: f64 = 2e-7;

/// Unites the outward shells of a closed mesh if some of them cross; `None` if they do not, if one
/// lies inside another, or if the result is not proved.
///
/// The surface inside another shell goes. The rest moves by rounding only. Slivers
/// along the seams move by 2e-7 of the longest side. A mesh with cavities, or with a shell that
/// crosses itself, is left as it is: its inside is not decided by its shells.
///
/// # Errors
/// The watch was stopped.
pub(super) fn unite_shells(mesh: &TriMesh, watch: &Watch) -> Result<Option<TriMesh>, Cancelled> {
    let table = EdgeTable::of(mesh);
    let count = Shells::of(mesh, &table).count();
    if table.bad_count() > 0 || !(2..=MAX_SHELLS).contains(&count) {
        return Ok(None);
    }
    if Crossings::of_watched(mesh, watch)?.pairs == 0 {
        return Ok(None);
    }
    let Some(mut bodies) = separate(mesh) else {
        return Ok(None);
    };
    // Halves of halves: each triangle takes part in few booleans.
    while bodies.len() > 1 {
        watch.check()?;
        let pairs = bodies.chunks(2).map(|pair| match pair {
            [a, b] => a.union(b).ok(),
            _ => pair.first().cloned(),
        });
        let Some(united) = pairs.collect::<Option<Vec<Csg>>>() else {
            return Ok(None);
        };
        bodies = united;
    }
    let reach_mm = SLIVER_RATIO * mesh.longest_side_mm();
    let Some(body) = bodies.first() else {
        return Ok(None);
    };
    let Ok(united) = body.simplify_watched(reach_mm, watch)?.to_mesh() else {
        return Ok(None);
    };
    let is_sound =
        Defects::of(&united).is_none() && Crossings::of_watched(&united, watch)?.pairs == 0;
    Ok(is_sound.then_some(united))
}

/// Returns the shells as bodies; `None` if one is not sound or lies inside another.
fn separate(mesh: &TriMesh) -> Option<Vec<Csg>> {
    let parts = shells(mesh);
    let is_body = |shell: &TriMesh| Defects::of(shell).is_none() && Crossings::of(shell).pairs == 0;
    let is_in_another = |(index, one): (usize, &TriMesh)| {
        let mut others = parts[..index].iter();
        others.any(|other| are_nested(one, other))
    };
    if !parts.iter().all(is_body) || parts.iter().enumerate().any(is_in_another) {
        return None;
    }
    parts.iter().map(|part| Csg::of_mesh(part).ok()).collect()
}

/// Returns true if one of two closed surfaces lies inside the other. Such a surface may be meant as
/// a cavity that faces the wrong way, so that its owner must decide.
fn are_nested(one: &TriMesh, other: &TriMesh) -> bool {
    let both = one.clone().joined(other);
    let around = Shells::of(&both, &EdgeTable::of(&both)).enclosing(&both);
    around.iter().any(|shells| !shells.is_empty()) && Crossings::of(&both).pairs == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::{ball, cuboid};

    fn unite(mesh: &TriMesh) -> Option<TriMesh> {
        unite_shells(mesh, &Watch::silent()).unwrap()
    }

    fn cube(low: f64, high: f64) -> TriMesh {
        cuboid(&Point::new(low, low, low), &Point::new(high, high, high))
    }

    #[test]
    fn boxes_that_overlap_become_one_of_their_common_volume() {
        let united = unite(&cube(0.0, 2.0).joined(&cube(1.0, 3.0))).unwrap();
        assert!((united.signed_volume_mm3() - 15.0).abs() < 1e-9);
        assert_eq!(shells(&united).len(), 1);
    }

    #[test]
    fn a_box_inside_another_is_left_alone_for_it_may_be_meant_as_a_cavity() {
        let nested = cube(0.0, 4.0).joined(&cube(1.0, 3.0));
        assert_eq!(unite(&nested), None);
        assert_eq!(unite(&nested.joined(&cube(3.5, 6.0))), None);
    }

    #[test]
    fn bodies_apart_and_cavities_are_left_alone() {
        let apart = ball(&Point::new(9.0, 0.0, 0.0), 1.0, 1);
        assert_eq!(unite(&cube(0.0, 1.0).joined(&apart)), None);
        assert_eq!(
            unite(&cube(0.0, 4.0).joined(&cube(1.0, 3.0).reversed())),
            None
        );
        let crossed = cube(0.0, 4.0).joined(&cube(3.0, 5.0).reversed());
        assert_eq!(unite(&crossed), None);
    }
}
