//! The checks of pins and sockets, of cut models and of junctures in several parts.

use super::limits::{EQUAL_PINS_MM, GAP_TOLERANCE_MM, PIN_LIMIT_MM, WALL_TOLERANCE_MM};
use super::{Check, CheckKind, Limit, PegFacts};

/// Checks that pins are in the files, fit their sockets and leave the wall; empty without pins.
pub(super) fn peg_checks(pegs: &[PegFacts], least_wall_mm: f64) -> Vec<Check> {
    if pegs.is_empty() {
        return Vec::new();
    }
    let (deviation_mm, off_at) = worst_peg(pegs, |peg| Some(peg.deviation_mm));
    let (lack_mm, tight_at) = worst_peg(pegs, |peg| Some(peg.ordered_gap_mm - peg.gap_mm?));
    let (bulge_mm, thin_at) = worst_peg(pegs, |peg| Some(-peg.wall_mm));
    let wall_mm = bulge_mm.map(|bulge_mm| -bulge_mm);
    vec![
        Check::new(
            CheckKind::Pins,
            "every pin and socket has its size, within",
            deviation_mm,
            Limit::at_most(PIN_LIMIT_MM, "mm"),
        )
        .at(off_at),
        Check::new(
            CheckKind::Clearance,
            "pin gap as ordered, on each side; short by at most",
            lack_mm.map(|lack_mm| lack_mm.max(0.0)),
            Limit::at_most(GAP_TOLERANCE_MM, "mm"),
        )
        .at(tight_at),
        socket_wall_check(wall_mm, least_wall_mm).at(thin_at),
    ]
}

fn socket_wall_check(wall_mm: Option<f64>, least_wall_mm: f64) -> Check {
    let limit = Limit::at_least(least_wall_mm - WALL_TOLERANCE_MM, "mm");
    Check::new(
        CheckKind::SocketWall,
        "the wall around every socket is at least",
        wall_mm,
        limit,
    )
}

/// Returns the largest value of any pin, and the id of the first pin that has it or nearly so. A
/// pin without a value counts as infinite, so that the check fails.
fn worst_peg(
    pegs: &[PegFacts],
    value: impl Fn(&PegFacts) -> Option<f64>,
) -> (Option<f64>, Option<String>) {
    let of = |peg: &PegFacts| value(peg).unwrap_or(f64::INFINITY);
    let worst = pegs.iter().map(of).max_by(f64::total_cmp);
    let is_worst = |peg: &&PegFacts| worst.is_some_and(|worst| of(peg) >= worst - EQUAL_PINS_MM);
    (worst, pegs.iter().find(is_worst).map(|peg| peg.id.clone()))
}
