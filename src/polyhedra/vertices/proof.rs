//! The proof for a polyhedron of the paper's method: its faces move inward as far as it takes.
//!
//! The method samples the surface of its polyhedron. Between samples nothing is known, so that what
//! it yields cannot become a base as it is. Here the planes of its faces are taken, each as far out
//! as the farthest corner. Pieces of the model that no plane parts by the distance are parted one
//! by one, the worst first. For each the plane that needs the shortest way moves inward. Then every
//! piece is parted, which is the same certificate that growing planes have.

use super::super::ground::Ground;
use super::super::inscribe::Request;
use super::super::polyhedron::{NotInside, Polyhedron};
use super::super::side::Side;
use super::VertexPolyhedron;
use crate::geom::Plane;

/// A polyhedron of moved vertices with the proof that it keeps its distance.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedVertices {
    /// The polyhedron below the planes that were moved inward.
    pub polyhedron: Polyhedron,
    /// The greatest way by which a plane was moved inward for the proof, mm.
    pub moved_mm: f64,
}

/// Proves that planes keep the distance of the request, moved inward where they do not.
///
/// # Errors
/// Nothing is left of the polyhedron inside the model.
pub fn prove_vertices(
    ground: &Ground,
    grown: &VertexPolyhedron,
    request: &Request,
) -> Result<ProvedVertices, NotInside> {
    let moves_mm = moves(ground, &grown.planes, request.distance_mm);
    let sides = grown.planes.iter().zip(&moves_mm);
    let sides: Vec<Side> = sides
        .map(|(plane, move_mm)| Side {
            plane: Plane {
                offset_mm: plane.offset_mm - move_mm,
                ..*plane
            },
            is_locked: false,
        })
        .collect();
    Ok(ProvedVertices {
        polyhedron: Polyhedron::new(ground, request.distance_mm, &sides, &request.limits)?,
        moved_mm: moves_mm.into_iter().fold(0.0, f64::max),
    })
}

/// Returns by how much each plane moves inward so that each piece is parted by one, mm.
fn moves(ground: &Ground, planes: &[Plane], distance_mm: f64) -> Vec<f64> {
    let obstacles = ground.obstacles();
    let parted: Vec<Vec<f64>> = planes
        .iter()
        .map(|plane| obstacles.all_parted_mm(plane))
        .collect();
    let lack = |piece: usize| {
        let best = parted.iter().map(|parted| parted[piece]);
        distance_mm - best.fold(f64::NEG_INFINITY, f64::max)
    };
    let mut open: Vec<(f64, usize)> = (0..obstacles.len())
        .map(|piece| (lack(piece), piece))
        .filter(|(lack_mm, _)| *lack_mm > 0.0)
        .collect();
    open.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut moves_mm = vec![0.0; planes.len()];
    for (_, piece) in open {
        let needed = parted.iter().enumerate();
        let needed = needed.map(|(face, parted)| (distance_mm - parted[piece], face));
        // The way that is still missing decides: a plane that moved already may part it too.
        let nearest = needed.reduce(|a, b| {
            let is_nearer = b.0 - moves_mm[b.1] < a.0 - moves_mm[a.1];
            if is_nearer { b } else { a }
        });
        if let Some((needed_mm, face)) = nearest {
            moves_mm[face] = needed_mm.max(moves_mm[face]);
        }
    }
    moves_mm
}

#[cfg(test)]
mod tests {
    use super::super::super::limits::Limits;
    use super::super::{StartSolid, VertexRequest, grow_by_vertices};
    use super::*;
    use crate::base::watch::Watch;
    use crate::geom::Point;
    use crate::mesh::{Solid, primitives};

    fn ground() -> Ground {
        let ball = primitives::ball(&Point::origin(), 60.0, 3);
        Ground::new(&Solid::new(ball).unwrap()).unwrap()
    }

    #[test]
    fn what_samples_do_not_prove_is_proved_by_planes_that_moved_inward() {
        let ground = ground();
        for &start in StartSolid::ALL {
            let request = VertexRequest {
                distance_mm: 5.0,
                start,
                samples_per_edge: 5,
            };
            let grown = grow_by_vertices(&ground, &request, &Watch::silent()).unwrap();
            let grown = grown.found().unwrap();
            let base = Request::new(5.0, Limits::NONE);
            let proved = prove_vertices(&ground, &grown, &base).unwrap();
            // As far as the planes lacked, and no farther.
            let lack_mm = (5.0 - grown.certified_mm).max(0.0);
            assert!(
                (proved.moved_mm - lack_mm).abs() < 1e-9,
                "{start}: {proved:?}"
            );
            let model = ground.solid().mesh();
            let planes = proved.polyhedron.planes();
            let kept_mm = proved.polyhedron.separation().check(model, &planes);
            assert!(kept_mm.unwrap() >= 5.0 - 1e-6);
            assert!(
                proved.polyhedron.volume_mm3() > 0.3 * grown.volume_mm3,
                "{start}"
            );
        }
    }

    #[test]
    fn planes_that_cut_the_model_move_until_nothing_is_left() {
        let ground = ground();
        let request = VertexRequest {
            distance_mm: 5.0,
            start: StartSolid::Cube,
            samples_per_edge: 3,
        };
        let grown = grow_by_vertices(&ground, &request, &Watch::silent()).unwrap();
        let mut far = grown.found().unwrap();
        for plane in &mut far.planes {
            plane.offset_mm += 500.0;
        }
        let base = Request::new(70.0, Limits::NONE);
        assert!(prove_vertices(&ground, &far, &base).is_err());
        // The same planes with a distance that has room come back to the ball.
        let base = Request::new(5.0, Limits::NONE);
        let proved = prove_vertices(&ground, &far, &base).unwrap();
        assert!(proved.moved_mm > 450.0 && proved.polyhedron.volume_mm3() > 0.0);
    }
}
