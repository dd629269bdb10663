//! Whether turned shells are free: tried on the written parts, before a limb is built upon.

use super::super::made::{Made, WrittenPart};
use crate::mesh::{MeshDistance, TriMesh};
use crate::telescope::nest::JointState;

/// The distance before its stop at which a shell is turned, mm.
const BEFORE_STOP_MM: f64 = 0.02;
/// Shares of a turn at which a shell must be free.
const TURNS: [f64; 3] = [0.0, 0.5, 1.0];
/// The distance at which two surfaces touch, mm: rounding of files.
const TOUCH_MM: f64 = 1e-4;

/// Returns the reason why a limb does not turn as far as it must, if there is one.
pub fn held(made: &Made) -> Option<String> {
    let telescope = &made.best.design.telescope;
    let shells: Vec<TriMesh> = made.parts.chunks(2).map(joined).collect();
    let found = telescope.joints.iter().enumerate().find(|(joint, own)| {
        let outer = MeshDistance::new(&shells[*joint]);
        TURNS.iter().any(|share| {
            let state = JointState {
                slide_mm: telescope.visible_mm - BEFORE_STOP_MM,
                turn_rad: share * own.turn_rad,
            };
            let frame = telescope.step(*joint, &state);
            let inner = shells[joint + 1].map_vertices(|p| frame.to_model(p));
            let mut corners = inner.iter_corners();
            corners.any(|corners| outer.bvh().is_triangle_within(&corners, TOUCH_MM))
        })
    });
    found.map(|(joint, _)| {
        format!(
            "{} touches its parent as it turns",
            made.shell_id(joint + 1)
        )
    })
}

fn joined(pair: &[WrittenPart]) -> TriMesh {
    let parts = pair.iter().map(|part| part.in_shell());
    parts.fold(TriMesh::default(), |all, part| all.joined(&part))
}
