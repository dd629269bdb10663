//! The rows about the finished object: the effect of turning a yo-yo's half, and closed cups.

use std::collections::BTreeMap;

use super::facts::Facts;
use crate::geom::{Matrix, Point, Vector};
use crate::mass::{Body, Moments};
use crate::mesh::TriMesh;
use crate::mesh::union_find::UnionFind;
use crate::repair::weld;
use crate::sheet::{Half, PartRow, TurnRow};

/// Greatest height over the plate of a vertex that lies on it, mm. Files round to 1e-5 mm, and no
/// layer is thinner than this.
const ON_PLATE_MM: f64 = 1e-3;

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
        + placed.moments_inside(&made.load, &made.hollowed);
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

/// Returns the volume of all hollows of a part in print pose whose only mouth lies flat on the
/// plate, mm³; exact for the file.
///
/// Without the triangles on the plate, the surface separates into the outside and these hollows.
/// The volume of a hollow above the plate is its negative flux −∫ z n_z dA.
pub fn cup_mm3(printed: &TriMesh) -> f64 {
    let mesh = weld(printed);
    let floor_mm = mesh.aabb().min.z;
    let is_floor = |index: usize| {
        mesh.corners(index)
            .iter()
            .all(|p| p.z - floor_mm < ON_PLATE_MM)
    };
    let rest: Vec<usize> = (0..mesh.triangles().len())
        .filter(|&index| !is_floor(index))
        .collect();
    let mut sets = UnionFind::new(mesh.vertices().len());
    for &index in &rest {
        let [a, b, c] = mesh.triangles()[index];
        sets.merge(a, b);
        sets.merge(b, c);
    }
    let mut volumes_mm3: BTreeMap<u32, f64> = BTreeMap::new();
    for &index in &rest {
        let root = sets.root(mesh.triangles()[index][0]);
        *volumes_mm3.entry(root).or_default() += under_mm3(mesh.corners(index), floor_mm);
    }
    -volumes_mm3
        .into_values()
        .filter(|volume| *volume < 0.0)
        .sum::<f64>()
}

/// Returns the volume between a triangle and the plate, mm³; negative if it faces down.
fn under_mm3([a, b, c]: [Point; 3], floor_mm: f64) -> f64 {
    let flat_mm2 = 0.5 * (b - a).cross(&(c - a)).z;
    flat_mm2 * ((a.z + b.z + c.z) / 3.0 - floor_mm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::moments_of_mesh;
    use crate::mesh::{Csg, primitives};

    fn block(low: [f64; 3], high: [f64; 3]) -> TriMesh {
        primitives::cuboid(&low.into(), &high.into())
    }

    #[test]
    fn only_a_hollow_open_just_downward_is_a_cup() {
        let body = block([0.0; 3], [20.0; 3]);
        let body = Csg::of_mesh(&body).unwrap();
        let cup = |hollow: &TriMesh| {
            let left = body.subtract(&Csg::of_mesh(hollow).unwrap()).unwrap();
            cup_mm3(&left.to_mesh().unwrap())
        };
        assert!((cup(&block([5.0, 5.0, -5.0], [15.0, 15.0, 12.0])) - 1200.0).abs() < 1e-9);
        assert_eq!(cup(&block([5.0, 5.0, 8.0], [15.0, 15.0, 25.0])), 0.0);
        assert_eq!(cup(&block([5.0, 5.0, -5.0], [15.0, 15.0, 25.0])), 0.0);
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
