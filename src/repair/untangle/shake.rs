//! Shaking: moves vertices by a hair, so that nothing touches exactly.

use crate::geom::Vector;
use crate::mesh::TriMesh;

/// Returns the mesh with every vertex moved by at most `reach_mm`. The move depends on the place
/// and the attempt alone, so that equal places stay equal.
pub(super) fn shake(mesh: &TriMesh, reach_mm: f64, attempt: usize) -> TriMesh {
    if reach_mm == 0.0 {
        return mesh.clone();
    }
    let half_side_mm = reach_mm / 3f64.sqrt();
    mesh.map_vertices(|p| {
        let start = scramble(attempt as u64);
        let mut state = p
            .iter()
            .fold(start, |state, x| scramble(state ^ x.to_bits()));
        p + Vector::from_fn(|_, _| {
            state = scramble(state);
            half_side_mm * to_unit(state)
        })
    })
}

/// Returns the next number of a sequence without visible order (Steele, Lea and Flood, "Fast
/// splittable pseudorandom number generators", OOPSLA 2014).
fn scramble(state: u64) -> u64 {
    let x = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Maps all 64-bit numbers to −1 to 1.
fn to_unit(x: u64) -> f64 {
    x as f64 / (u64::MAX / 2) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::ball;

    #[test]
    fn vertices_move_within_reach_and_equal_places_alike() {
        let ball = ball(&Point::origin(), 1.0, 3);
        let twice = ball.clone().joined(&ball);
        let shaken = shake(&twice, 1e-3, 1);
        let (one, other) = shaken.vertices().split_at(ball.vertices().len());
        assert_eq!(one, other);
        let moves: Vec<f64> = one
            .iter()
            .zip(ball.vertices())
            .map(|(a, b)| (a - b).norm())
            .collect();
        assert!(moves.iter().all(|&length| length > 0.0 && length <= 1e-3));
        // The mean of evenly spread moves in a cube of half side 1/√3 mm is 0.96/√3 = 0.55 mm.
        let mean = moves.iter().sum::<f64>() / moves.len() as f64;
        assert!((0.45e-3..0.65e-3).contains(&mean), "{mean}");
        assert_eq!(shake(&twice, 0.0, 0), twice);
    }
}
