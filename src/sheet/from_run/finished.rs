//! The rows about the finished object: the effect of turning a yo-yo's half, and cups.

use super::facts::Facts;
use crate::geom::{Matrix, Vector};
use crate::mass::{Body, Moments};
use crate::mesh::TriMesh;
use crate::poses::{Columns, Shape, cup_volume_mm3};
use crate::sheet::{Half, PartRow, TurnRow};

/// Returns the effect of turning half A of a yo-yo by a degree; `None` for a single body.
pub fn turn_row(facts: &Facts, parts: &[PartRow]) -> Option<TurnRow> {
    let (placed, made) = (facts.placed, facts.made);
    placed.string_gap_mm()?;
    let frame = &placed.placement.goal.frame;
    let written = made
        .parts
        .iter()
        .zip(parts)
        .filter(|(_, row)| row.half == Some(Half::A));
    let half = written
        .fold(Moments::default(), |sum, (part, _)| {
            sum + part.evidence().moments()
        })
        .in_frame(frame);
    let whole = made.written_moments()
        + placed.joining_moments(&made.plan)
        + placed.moments_inside(&made.load, &made.hollowed, &made.inner);
    turn_effect(&half, &whole.in_frame(frame))
}

/// Returns the effect of the turn from the moments of the half and of the whole; the axis is z.
fn turn_effect(half: &Moments, whole: &Moments) -> Option<TurnRow> {
    let (sin, cos) = 1f64.to_radians().sin_cos();
    let degree = Matrix::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let after = *whole - *half + half.rotated(&degree);
    let off = |moments: &Moments| moments.centroid().coords.xy();
    (half.volume() > 0.0).then(|| TurnRow {
        half_offset_mm: off(half).norm(),
        offset_mm_per_deg: (off(&after) - off(whole)).norm(),
        tilt_deg_per_deg: (greatest_axis(&after))
            .angle(&greatest_axis(whole))
            .to_degrees(),
    })
}

/// Returns the axis of the greatest moment, pointing up.
fn greatest_axis(moments: &Moments) -> Vector {
    let axis: Vector = Body::new(moments, 1.0)
        .principal()
        .axes
        .column(2)
        .into_owned();
    axis * axis.z.signum()
}

/// Returns the volume of resin that a part in print pose encloses against a film, mm³. Lines
/// through it are half a thinnest wall apart.
pub fn cup_mm3(printed: &TriMesh, wall_mm: f64) -> f64 {
    let columns = Columns::of(&Shape::plain(printed), &Vector::z(), 0.5 * wall_mm);
    cup_volume_mm3(&columns)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::moments_of_mesh;
    use crate::mesh::primitives;

    fn block(low: [f64; 3], high: [f64; 3]) -> TriMesh {
        primitives::cuboid(&low.into(), &high.into())
    }

    #[test]
    fn a_turned_half_moves_the_centre_by_its_lever_and_its_share() {
        // Half A is a cube 3 mm beside the axis, half B its mirror image. One degree moves the
        // centre of the whole by half of 2·3·sin(0.5°).
        let cube = |x: f64, z: f64| {
            let (low, high) = ([x - 1.0, -1.0, z - 1.0], [x + 1.0, 1.0, z + 1.0]);
            moments_of_mesh(&block(low, high))
        };
        let (half, other) = (cube(3.0, 2.0), cube(-3.0, -2.0));
        let row = turn_effect(&half, &(half + other)).unwrap();
        assert!((row.half_offset_mm - 3.0).abs() < 1e-12);
        assert!((row.offset_mm_per_deg - 3.0 * 0.5f64.to_radians().sin()).abs() < 1e-12);
        assert!(row.tilt_deg_per_deg > 0.1);
        assert!(
            turn_effect(&cube(0.0, 2.0), &(cube(0.0, 2.0) + cube(0.0, -2.0)))
                .unwrap()
                .offset_mm_per_deg
                < 1e-12
        );
    }
}
