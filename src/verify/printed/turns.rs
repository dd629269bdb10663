//! The turns of a part on a plate that a shop may have made.

use super::limits::ALIKE_MM;
use crate::geom::{Matrix, Vector};
use nalgebra::Rotation3;

/// Steps of the angles about the vertical that are tried, degrees. Each round looks about the best
/// angle of the one before.
const STEPS_DEG: [f64; 5] = [3.0, 0.6, 0.12, 0.024, 0.005];
/// Steps to each side in every round but the first.
const AROUND: i32 = 6;

/// Returns every turn by right angles about the axes, and the mirror images of these.
pub(super) fn right_turns() -> impl Iterator<Item = Matrix> {
    const ORDERS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [1, 0, 2],
        [0, 2, 1],
        [2, 1, 0],
        [1, 2, 0],
        [2, 0, 1],
    ];
    ORDERS.into_iter().flat_map(|order| {
        (0..8_u8).map(move |signs| {
            Matrix::from_fn(|row, column| {
                let sign = if signs >> row & 1 == 1 { -1.0 } else { 1.0 };
                if order[row] == column { sign } else { 0.0 }
            })
        })
    })
}

/// Returns the best turn by any angle about the vertical, and the best one of the mirror image.
/// `miss_mm` tells how badly a turn fits. Of turns that fit alike, as those of a symmetric part,
/// the one nearest to the usual turn is taken.
pub(super) fn free_turns(
    usual: &Matrix,
    miss_mm: impl Fn(&Matrix) -> f64,
) -> impl Iterator<Item = Matrix> {
    let best = |mirror: &Matrix| {
        let turn = |deg: f64| {
            let about = Rotation3::from_axis_angle(&Vector::z_axis(), deg.to_radians());
            about.into_inner() * mirror
        };
        let whole = (360.0 / STEPS_DEG[0]) as i32;
        let mut best_deg = 0.0;
        for (round, step_deg) in STEPS_DEG.into_iter().enumerate() {
            let reach = if round == 0 { whole / 2 } else { AROUND };
            let tried = (-reach..=reach).map(|step| best_deg + f64::from(step) * step_deg);
            let missed: Vec<(f64, f64)> = tried.map(|deg| (miss_mm(&turn(deg)), deg)).collect();
            let least_mm = missed
                .iter()
                .map(|(mm, _)| *mm)
                .fold(f64::INFINITY, f64::min);
            // Later rounds look about one of them, so that only the first has to choose.
            let alike_mm = if round == 0 { ALIKE_MM } else { 0.0 };
            let alike = missed.iter().filter(|(mm, _)| *mm <= least_mm + alike_mm);
            let near = |deg: f64| (usual.transpose() * turn(deg)).trace();
            best_deg = alike
                .max_by(|(_, a), (_, b)| near(*a).total_cmp(&near(*b)))
                .map_or(best_deg, |(_, deg)| *deg);
        }
        turn(best_deg)
    };
    let mirrors = [Vector::new(1.0, 1.0, 1.0), Vector::new(-1.0, 1.0, 1.0)];
    let turns = mirrors.map(|mirror| best(&Matrix::from_diagonal(&mirror)));
    turns.into_iter()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_turn_is_found_to_hundredths_of_a_degree() {
        let wanted = Rotation3::from_axis_angle(&Vector::z_axis(), 1.234).into_inner();
        let [turn, mirrored] =
            free_turns(&Matrix::identity(), |turn| (turn - wanted).norm()).collect::<Vec<_>>()[..]
        else {
            panic!("two turns");
        };
        assert!((turn - wanted).norm() < 1e-4);
        assert!(turn.determinant() > 0.0 && mirrored.determinant() < 0.0);
    }

    #[test]
    fn of_turns_that_fit_alike_the_one_nearest_to_the_usual_turn_is_taken() {
        let about = |deg: f64| Rotation3::from_axis_angle(&Vector::z_axis(), deg.to_radians());
        let ends = [0.2, 180.2].map(|deg| about(deg).into_inner());
        // Nearer to the turned end by a thousandth, as rounding has it.
        let miss = |turn: &Matrix| {
            let [own, other] = [&ends[0], &ends[1]].map(|end| (turn - end).norm());
            (own + 1e-3).min(other)
        };
        for (usual_deg, wanted) in [(0.0, &ends[0]), (180.0, &ends[1])] {
            let found = free_turns(&about(usual_deg).into_inner(), miss)
                .next()
                .unwrap();
            assert!((found - wanted).norm() < 1e-3, "{usual_deg}");
        }
    }

    #[test]
    fn right_turns_and_their_mirror_images_are_48() {
        let turns: Vec<Matrix> = right_turns().collect();
        assert_eq!(turns.len(), 48);
        let proper = turns.iter().filter(|turn| turn.determinant() > 0.0);
        assert_eq!(proper.count(), 24);
    }
}
