//! The proof for a polyhedron of the paper's method: its faces move inward as far as it takes.
//!
//! The method samples the surface of its polyhedron. Between samples nothing is known, so that what
//! it yields cannot become a base as it is. Here the planes of its faces are taken, each as far out
//! as the farthest corner. Pieces of the model that no plane parts by the distance are parted one
//! by one, the worst first: a plane moves inward for each. Then every piece is parted, which is the
//! same certificate that growing planes have. Two rules say which plane moves, and the larger
//! polyhedron is kept.

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
    let open = OpenPieces::of(ground, &grown.planes, request.distance_mm);
    let proved = |moves_mm: Vec<f64>| -> Result<ProvedVertices, NotInside> {
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
    };
    let volume_mm3 = |proved: &ProvedVertices| proved.polyhedron.volume_mm3();
    match (proved(open.shortest()), proved(open.shared())) {
        (Ok(a), Ok(b)) => Ok(if volume_mm3(&b) > volume_mm3(&a) {
            b
        } else {
            a
        }),
        (found, Err(_)) | (Err(_), found) => found,
    }
}

/// The pieces of a model that no plane parts by the distance, the worst first.
struct OpenPieces {
    /// For each piece, by how much each plane would have to move inward to part it, mm.
    needed_mm: Vec<Vec<f64>>,
    planes: usize,
}

impl OpenPieces {
    fn of(ground: &Ground, planes: &[Plane], distance_mm: f64) -> Self {
        let obstacles = ground.obstacles();
        let parted: Vec<Vec<f64>> = planes
            .iter()
            .map(|plane| obstacles.all_parted_mm(plane))
            .collect();
        let needed = |piece: usize| -> Vec<f64> {
            let own = parted.iter().map(|parted| distance_mm - parted[piece]);
            own.collect()
        };
        let mut open: Vec<(f64, Vec<f64>)> = (0..obstacles.len())
            .map(needed)
            .map(|needed| (needed.iter().copied().fold(f64::INFINITY, f64::min), needed))
            .filter(|(least_mm, _)| *least_mm > 0.0)
            .collect();
        open.sort_by(|a, b| b.0.total_cmp(&a.0));
        Self {
            needed_mm: open.into_iter().map(|(_, needed)| needed).collect(),
            planes: planes.len(),
        }
    }

    /// Returns the move of each plane, mm, if each piece is parted by the plane that is nearest to
    /// it. No plane then moves by more than the worst piece needs.
    fn shortest(&self) -> Vec<f64> {
        self.dealt(|needed_mm, _| needed_mm)
    }

    /// Returns the move of each plane, mm, if each piece is parted by the plane that still has the
    /// shortest way to go. One that moved already may part it too.
    fn shared(&self) -> Vec<f64> {
        self.dealt(|needed_mm, moved_mm| needed_mm - moved_mm)
    }

    /// Deals each piece to the plane with the least cost of its way, given how far it has moved.
    fn dealt(&self, cost_mm: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let mut moves_mm = vec![0.0_f64; self.planes];
        for needed in &self.needed_mm {
            let costs = needed.iter().zip(&moves_mm).enumerate();
            let costs =
                costs.map(|(face, (needed_mm, moved_mm))| (cost_mm(*needed_mm, *moved_mm), face));
            if let Some((_, face)) = costs.reduce(|a, b| if b.0 < a.0 { b } else { a }) {
                moves_mm[face] = moves_mm[face].max(needed[face]);
            }
        }
        moves_mm
    }
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
                room_mm: None,
            };
            let grown = grow_by_vertices(&ground, &request, &Watch::silent()).unwrap();
            let grown = grown.found().unwrap();
            let base = Request::new(5.0, Limits::NONE);
            let proved = prove_vertices(&ground, &grown, &base).unwrap();
            // As far as the planes lacked, or farther where that keeps more volume.
            let lack_mm = (5.0 - grown.certified_mm).max(0.0);
            assert!(proved.moved_mm >= lack_mm - 1e-9, "{start}: {proved:?}");
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
            room_mm: None,
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
