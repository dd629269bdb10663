//! Screws, bolts, washers and nuts in the holes of panels.

use super::evidence::CoreEvidence;
use super::joining::of_panel;
use super::promise::{FastenerKind, FastenerPromise};
use crate::geom::{Point, Vector};

/// By how much a fastener may be beside its place, mm.
const BESIDE_MM: f64 = 1e-3;
/// By how much the length of an axis, or the cosine of two, may be off.
const AXIS_SLACK: f64 = 1e-9;

/// A hole on the axis of a fastener.
#[derive(Clone, Copy)]
struct Passed {
    /// The places at which the axis enters it and leaves it, mm from the fastener's seat.
    along_mm: [f64; 2],
    diameter_mm: f64,
}

/// Returns the faults of screws, bolts, washers and nuts, in words.
pub fn misfits(evidence: &CoreEvidence) -> Vec<String> {
    let all = &evidence.promise.fasteners;
    let of_kind = |kind: FastenerKind| all.iter().filter(move |one| one.kind == kind);
    let mut faults: Vec<String> = all.iter().flat_map(|one| unheld(evidence, one)).collect();
    for bolt in of_kind(FastenerKind::Bolt) {
        let why = loose(evidence, bolt);
        let words = |why| format!("a bolt of {} {why}", bolt.part);
        faults.extend(why.map(words));
    }
    let [bolts, nuts, washers] = [FastenerKind::Bolt, FastenerKind::Nut, FastenerKind::Washer]
        .map(|kind| of_kind(kind).count());
    if [nuts, washers] != [bolts, 2 * bolts] {
        faults.push(format!(
            "{bolts} bolts have {nuts} nuts and {washers} washers"
        ));
    }
    faults
}

/// Returns the panels whose holes a fastener does not pass, or on which its head does not bear.
fn unheld(evidence: &CoreEvidence, one: &FastenerPromise) -> Vec<String> {
    // Inserts stand in parts. A nut is held against its bolt.
    if matches!(one.kind, FastenerKind::Insert | FastenerKind::Nut) {
        return Vec::new();
    }
    let panels = [Some(one.panel), one.through].into_iter().flatten();
    let bears = |hole: Passed| {
        let is_on = hole.along_mm[0].abs() <= BESIDE_MM && hole.diameter_mm < one.head_mm[0];
        one.kind == FastenerKind::Bolt || is_on
    };
    let wrong = panels.filter_map(|panel| match passed(evidence, one, panel) {
        None => Some(format!(
            "a screw of {} passes no hole of panel {panel}",
            one.part
        )),
        Some(hole) if !bears(hole) => Some(format!(
            "a screw's head or washer of {} does not bear on panel {panel}",
            one.part
        )),
        Some(_) => None,
    });
    wrong.collect()
}

/// Returns the hole of a panel that a fastener passes, if both ends of it lie on its axis.
fn passed(evidence: &CoreEvidence, one: &FastenerPromise, panel: usize) -> Option<Passed> {
    let panel = panel.wrapping_sub(1);
    let of = evidence.panels.panels.get(panel)?;
    let frame = evidence.frame(panel);
    let axis = Vector::from(one.axis);
    let is_unit = (axis.norm() - 1.0).abs() <= AXIS_SLACK;
    if !is_unit || off_axis_mm(one, &Point::from(one.center_mm)) > BESIDE_MM {
        return None;
    }
    of.holes.iter().find_map(|hole| {
        let [x, y] = hole.at_mm;
        let depths = [0.0, -evidence.promise.sheet.thickness_mm];
        let ends = depths.map(|z| frame.to_model(&Point::new(x, y, z)));
        let along = ends.map(|end| along_mm(one, &end));
        let is_passed = ends.iter().all(|end| off_axis_mm(one, end) <= BESIDE_MM);
        let along_mm = [along[0].min(along[1]), along[0].max(along[1])];
        (is_passed && along_mm[0] >= -BESIDE_MM).then_some(Passed {
            along_mm,
            diameter_mm: hole.diameter_mm,
        })
    })
}

/// Returns how far along the axis of a fastener a point lies, mm from its seat.
fn along_mm(one: &FastenerPromise, at: &Point) -> f64 {
    (at - Point::from(one.seat_mm)).dot(&Vector::from(one.axis))
}

/// Returns the distance of a point from the axis of a fastener, mm.
fn off_axis_mm(one: &FastenerPromise, at: &Point) -> f64 {
    let from = at - Point::from(one.seat_mm);
    (from - Vector::from(one.axis) * along_mm(one, at)).norm()
}

/// Returns the reason why a bolt does not hold its two panels; `None` if it does.
fn loose(evidence: &CoreEvidence, bolt: &FastenerPromise) -> Option<&'static str> {
    let Some(through) = bolt.through else {
        return Some("passes a single panel");
    };
    let [Some(first), Some(second)] =
        [bolt.panel, through].map(|panel| passed(evidence, bolt, panel))
    else {
        return Some("does not pass both panels");
    };
    if of_panel(evidence, bolt.panel) == of_panel(evidence, through) {
        return Some("joins a polyhedron to itself");
    }
    let Some([thread_mm, length_mm]) = bolt.shaft_mm else {
        return Some("is listed without its thread and length");
    };
    let narrowest_mm = first.diameter_mm.min(second.diameter_mm);
    if !(thread_mm > 0.0 && narrowest_mm >= thread_mm) {
        return Some("is thicker than its hole");
    }
    // Both washers look at their panel, so that the one below the nut looks back.
    let nut = on_bolt(evidence, bolt, through, FastenerKind::Nut);
    let below_head = on_bolt(evidence, bolt, bolt.panel, FastenerKind::Washer);
    let below_nut = on_bolt(evidence, bolt, through, FastenerKind::Washer);
    let [Some(nut), Some(below_head), Some(below_nut)] = [nut, below_head, below_nut] else {
        return Some("has not one nut, and a washer at each end");
    };
    let nut_mm = along_mm(bolt, &Point::from(nut.seat_mm));
    let gaps_mm = [
        first.along_mm[0] - below_head.head_mm[1],
        nut_mm - second.along_mm[1] - below_nut.head_mm[1],
    ];
    if gaps_mm
        .iter()
        .any(|gap| gap.is_nan() || gap.abs() > BESIDE_MM)
    {
        return Some("does not press its washers on both panels");
    }
    if first.along_mm[1] > second.along_mm[0] + BESIDE_MM {
        return Some("passes its panels in the other order");
    }
    let reaches = length_mm + BESIDE_MM >= nut_mm + nut.head_mm[1];
    (!reaches).then_some("is too short for its nut")
}

/// Returns the only fastener of a kind on the axis of a bolt that looks at one of its panels.
fn on_bolt<'a>(
    evidence: &'a CoreEvidence,
    bolt: &FastenerPromise,
    panel: usize,
    kind: FastenerKind,
) -> Option<&'a FastenerPromise> {
    let way = if panel == bolt.panel { 1.0 } else { -1.0 };
    let all = evidence.promise.fasteners.iter();
    let mut own = all.filter(|one| {
        let [seat, middle] = [one.seat_mm, one.center_mm].map(Point::from);
        let cosine = Vector::from(one.axis).dot(&Vector::from(bolt.axis));
        one.kind == kind
            && one.panel == panel
            && (cosine - way).abs() <= AXIS_SLACK
            && off_axis_mm(bolt, &seat) <= BESIDE_MM
            && off_axis_mm(bolt, &middle) <= BESIDE_MM
    });
    own.next().filter(|_| own.next().is_none())
}
