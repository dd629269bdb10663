//! Tests of the memory of refused bosses.

use super::*;
use crate::cut::{PartId, PinSite};
use crate::mesh::TriMesh;

const DEAR: Refusal = Refusal::CostTooMuch { loss_ratio: 0.4 };

/// Returns a boss at a place on the x axis, in the joint between a cut's two parts.
fn boss(cut: &str, x_mm: f64) -> Boss {
    let pin = PinSite {
        id: "N1".into(),
        cut: cut.into(),
        center_mm: [x_mm, 0.0, 0.0],
        direction: [0.0, 0.0, 1.0],
        diameter_mm: 1.0,
        length_mm: 1.0,
        chamfer_mm: 0.1,
        socket_diameter_mm: 1.2,
        socket_depth_mm: 1.5,
        socket_chamfer_mm: 0.1,
        dowel: None,
    };
    Boss {
        pin,
        parts: [PartId::of(0), PartId::of(1)],
        body: TriMesh::default(),
        is_new: true,
    }
}

fn cost(loss_ratio: f64) -> Refusal {
    Refusal::CostTooMuch { loss_ratio }
}

/// Returns the reasons that are reported, in their order.
fn reasons(failed: &Failed) -> Vec<Refusal> {
    let remarks = failed.remarks().into_iter();
    let reason = |remark| match remark {
        Remark::NoBosses { why, .. } => Some(why),
        _ => None,
    };
    remarks.filter_map(reason).collect()
}

#[test]
fn a_joint_is_given_up_after_its_last_pattern_and_not_before() {
    let (mut failed, mine) = (Failed::default(), [boss("C1", 0.0)]);
    failed.add(&mine, DEAR, 2);
    failed.add(&[boss("C2", 0.0)], DEAR, 2);
    assert!(
        failed.given_up.is_empty(),
        "patterns of another joint count"
    );
    failed.add(&mine, DEAR, 2);
    assert_eq!(failed.given_up, [mine[0].joint()]);
}

#[test]
fn the_places_of_all_refused_bosses_are_kept_free() {
    let mut failed = Failed::default();
    failed.add(&[boss("C1", 1.0), boss("C1", 2.0)], DEAR, 3);
    failed.add(&[boss("C1", 3.0)], Refusal::CloseVoid, 3);
    assert_eq!(failed.places.iter().map(|at| at[0]).sum::<f64>(), 6.0);
    assert_eq!(failed.places.len(), 3);
}

#[test]
fn of_several_dear_patterns_the_cheapest_is_offered_again() {
    let mut failed = Failed::default();
    for (x_mm, loss_ratio) in [(1.0, 0.5), (2.0, 0.3), (3.0, 0.4)] {
        failed.add(&[boss("C1", x_mm)], cost(loss_ratio), 3);
    }
    assert_eq!(failed.dear_ones(), [[boss("C1", 2.0)]]);
}

#[test]
fn bosses_that_close_a_void_cannot_be_had_for_money() {
    let mut failed = Failed::default();
    failed.add(&[boss("C1", 0.0)], Refusal::CloseVoid, 3);
    failed.add(&[boss("C2", 0.0)], Refusal::FillVoids { ratio: 0.6 }, 3);
    assert!(failed.dear_ones().is_empty());
    assert_eq!(reasons(&failed).len(), 2);
}

#[test]
fn only_the_last_reason_of_a_joint_is_told() {
    let mut failed = Failed::default();
    failed.add(&[boss("C1", 0.0)], DEAR, 3);
    failed.add(&[boss("C2", 0.0)], Refusal::CloseVoid, 3);
    failed.explain(boss("C1", 0.0).joint(), Refusal::MoveJoint);
    assert_eq!(reasons(&failed), [Refusal::CloseVoid, Refusal::MoveJoint]);
}

#[test]
fn a_joint_that_got_its_bosses_after_all_is_forgotten_alone() {
    let mut failed = Failed::default();
    failed.add(&[boss("C1", 0.0)], cost(0.2), 3);
    failed.add(&[boss("C2", 0.0)], cost(0.3), 3);
    failed.forget(&boss("C1", 9.0).joint());
    assert_eq!(reasons(&failed), [cost(0.3)]);
    // Its old price counts no more once its bosses are lost for another reason.
    failed.add(&[boss("C1", 1.0)], Refusal::CloseVoid, 3);
    assert_eq!(failed.dear_ones(), [[boss("C2", 0.0)]]);
}
