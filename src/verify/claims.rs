//! The claims of the checklist about voids, joints, pins, ids, sizes and the goal, held against the
//! files.

use std::collections::BTreeSet;

use serde_json::Value;

use super::hardware::mass_moments;
use super::limits::CONTACT_LIMIT_MM;
use super::{Evidence, FigureName, Hardware, Judgement, Peg};
use crate::geom::{Plane, Point, Vector};
use crate::goal::GoalKind;
use crate::mesh::{area_mm2, foot_area_mm2};

/// A stated opening may differ from the found one by this share, since the widest disc is found by
/// steps.
const OPENING_RATIO: f64 = 5e-3;
/// The area of a joint may differ by this share from that of the faces in the files.
const AREA_RATIO: f64 = 1e-3;
/// Area that may lie in the plane of a cut by chance, mm²: a sliver of the outside that touches it.
const SLIVER_MM2: f64 = 0.05;
/// The area of a foot may differ by this share, or by this share of 1 mm² if it is less. It is the
/// same section of the same file.
const FOOT_RATIO: f64 = 1e-6;
/// The mass of a rod may differ by this share from that of its volume.
const MASS_RATIO: f64 = 1e-6;
/// Points within this distance of a cut lie in it, and sizes within it are equal, mm.
const NEAR_MM: f64 = 1e-3;
/// Directions with at least this cosine are equal.
const SAME_COSINE: f64 = 1.0 - 1e-9;

/// The claims that are false, a sentence each.
struct Claims<'a> {
    sheet: &'a Value,
    evidence: &'a Evidence,
    judgement: &'a Judgement,
    /// The planes of the cuts, with their ids.
    cuts: Vec<(&'a str, Plane)>,
    faults: Vec<String>,
}

/// Finds the false claims of a checklist. Keys that it lacks are skipped: kits of older versions do
/// not have all.
pub(super) fn find_false_claims(
    sheet: &Value,
    evidence: &Evidence,
    judgement: &Judgement,
) -> Vec<String> {
    let promised = evidence.promise.cuts.iter();
    let cuts = rows(sheet, "cuts").iter().zip(promised).map(|(row, cut)| {
        let plane = Plane::through(&Point::from(cut.point_mm), &Vector::from(cut.normal));
        (text(row, "id"), plane)
    });
    let mut claims = Claims {
        sheet,
        evidence,
        judgement,
        cuts: cuts.collect(),
        faults: Vec::new(),
    };
    claims.judge_voids();
    claims.judge_drains();
    claims.judge_joints();
    claims.judge_pegs();
    claims.judge_marks();
    claims.judge_size();
    claims.judge_feet();
    claims.judge_hardware();
    claims.judge_goal();
    claims.faults
}

impl Claims<'_> {
    fn blame(&mut self, at: &str, stated: &Value, found: impl std::fmt::Display) {
        let fault = format!("{at} states {stated}, the files have {found}");
        self.faults.push(fault);
    }

    /// Blames a stated number that is farther from the found one than this. Missing ones are
    /// skipped.
    fn compare(&mut self, at: &str, stated: &Value, found: f64, slack: f64) {
        let is_near = |stated: f64| (stated - found).abs() <= slack;
        if !stated.is_null() && !stated.as_f64().is_some_and(is_near) {
            self.blame(at, stated, found);
        }
    }

    /// Judges the openings of the voids, the cuts that open them, and the parts that hold them.
    fn judge_voids(&mut self) {
        let (sheet, judgement) = (self.sheet, self.judgement);
        for (row, facts) in rows(sheet, "voids").iter().zip(&judgement.voids) {
            let at = |key: &str| format!("voids[{}].{key}", facts.id);
            if let Some(found) = facts.opening_mm() {
                let slack = OPENING_RATIO * found;
                self.compare(&at("opening_mm"), &row["opening_mm"], found, slack);
            }
            let cuts = facts.cuts.iter().filter_map(|&cut| self.cuts.get(cut));
            let cuts: BTreeSet<&str> = cuts.map(|(id, _)| *id).collect();
            let parts = &self.evidence.parts;
            let holders = facts.holders.iter().filter_map(|&part| parts.get(part));
            let holders: BTreeSet<&str> = holders.map(|part| part.id.as_str()).collect();
            let holes = judgement.holes.iter();
            let holes = holes.filter(|hole| hole.void.as_ref() == Some(&facts.id));
            let holes: BTreeSet<&str> = holes.map(|hole| hole.id.as_str()).collect();
            let found = [
                ("opened_by", cuts),
                ("drained_by", holes),
                ("parts", holders),
            ];
            for (key, found) in found {
                let stated = row[key].as_array();
                let stated: Option<BTreeSet<&str>> =
                    stated.map(|names| names.iter().filter_map(Value::as_str).collect());
                if stated.is_some_and(|stated| stated != found) {
                    self.blame(&at(key), &row[key], format!("{found:?}"));
                }
            }
        }
    }

    /// Judges the volume that each drain hole takes.
    fn judge_drains(&mut self) {
        let found = self.judgement.drained_mm3.clone();
        for (index, found) in found.into_iter().enumerate() {
            let stated = self.sheet["drains"][index]["volume_mm3"].clone();
            let at = format!("drains[{index}].volume_mm3");
            self.compare(&at, &stated, found, AREA_RATIO * found);
        }
    }

    /// Judges the parts and the areas of the joints by the faces in their planes.
    fn judge_joints(&mut self) {
        let cuts = self.cuts.clone();
        for (cut, plane) in &cuts {
            let joints: Vec<&Value> = rows(self.sheet, "joints")
                .iter()
                .filter(|joint| text(joint, "cut") == *cut)
                .collect();
            let mut whole = [0.0; 2];
            for (index, part) in self.evidence.parts.iter().enumerate() {
                let faces = self.face_areas_mm2(index, cut, plane);
                for side in [0, 1] {
                    whole[side] += faces[side];
                    let own = joints
                        .iter()
                        .filter(|joint| joint["parts"][side].as_str() == Some(&part.id));
                    let areas = own.map(|joint| joint["area_mm2"].as_f64().unwrap_or(0.0));
                    let stated: f64 = areas.sum();
                    let slack_mm2 = AREA_RATIO * stated.max(faces[side]) + SLIVER_MM2;
                    if (stated - faces[side]).abs() > slack_mm2 {
                        let at = format!("the joints of {} in {cut}: area_mm2", part.id);
                        self.blame(&at, &stated.into(), faces[side]);
                    }
                }
            }
        }
        let known = |joint: &&Value| cuts.iter().any(|(id, _)| text(joint, "cut") == *id);
        let joints = rows(self.sheet, "joints").iter();
        for joint in joints.filter(|joint| !joint["cut"].is_null() && !known(joint)) {
            let at = format!("joints[{}].cut", text(joint, "id"));
            self.blame(&at, &joint["cut"], "no such cut");
        }
    }

    /// Returns the areas of a part's faces in a cut, mm²: of those that face along its normal, and
    /// of the others. Pins, sockets and ids do not lessen them.
    fn face_areas_mm2(&self, index: usize, cut: &str, plane: &Plane) -> [f64; 2] {
        let (part, promised) = (
            &self.evidence.parts[index],
            &self.evidence.promise.parts[index],
        );
        let mut areas = [0.0; 2];
        for corners in part.mesh.iter_corners() {
            let [a, b, c] = corners.map(|p| part.pose.to_model(&p));
            if [a, b, c].iter().all(|p| plane.distance(p).abs() <= NEAR_MM) {
                let double = (b - a).cross(&(c - a)).dot(&plane.normal);
                areas[usize::from(double < 0.0)] += double.abs() / 2.0;
            }
        }
        // A pin stands out of its part, a socket and an id reach into it.
        let pins = promised.pins.iter().map(|pin| (pin, 0, pin.base_mm2()));
        let sockets = promised.sockets.iter();
        let sockets = sockets.map(|socket| (socket, 1, socket.mouth_mm2()));
        for (peg, reversed, area_mm2) in pins.chain(sockets) {
            if self.cut_of(&peg.joint) == Some(cut) {
                let is_against = Vector::from(peg.axis).dot(&plane.normal) < 0.0;
                areas[usize::from(is_against) ^ reversed] += area_mm2;
            }
        }
        for mark in promised.marks.iter().filter(|mark| mark.cut == cut) {
            let is_along = Vector::from(mark.axis).dot(&plane.normal) > 0.0;
            areas[usize::from(is_along)] += mark.volume_mm3 / mark.depth_mm;
        }
        areas
    }

    /// Returns the cut of a joint.
    fn cut_of(&self, joint: &str) -> Option<&str> {
        let mut joints = rows(self.sheet, "joints").iter();
        let found = joints.find(|row| text(row, "id") == joint)?;
        found["cut"].as_str()
    }

    /// Judges whether every pin and socket stands in the cut of its joint, on a part of it.
    fn judge_pegs(&mut self) {
        let evidence = self.evidence;
        for part in &evidence.promise.parts {
            for peg in part.pins.iter().chain(&part.sockets) {
                let mut joints = evidence.promise.joints.iter();
                let is_of_part = joints.any(|joint| {
                    joint.id == peg.joint
                        && (joint.parts.contains(&part.id) || joint.parts[0].is_empty())
                });
                let plane = self
                    .cut_of(&peg.joint)
                    .and_then(|cut| self.cuts.iter().find(|(id, _)| *id == cut));
                let stands = plane.is_none_or(|(_, plane)| {
                    let along = Vector::from(peg.axis).normalize().dot(&plane.normal);
                    plane.distance(&Point::from(peg.center_mm)).abs() <= NEAR_MM
                        && along.abs() >= SAME_COSINE
                });
                if !(is_of_part && stands) {
                    let at = format!("parts[{}]: joint of {}", part.id, peg.id);
                    self.blame(&at, &peg.joint.as_str().into(), "another");
                }
            }
        }
    }

    /// Judges whether every engraved id names its part, in a cut that the sheet has.
    fn judge_marks(&mut self) {
        let evidence = self.evidence;
        for part in &evidence.promise.parts {
            let number = part.id.trim_start_matches(['P', '0']);
            for mark in &part.marks {
                let at = format!("parts[{}].marks: ", part.id);
                if mark.text != part.id && mark.text != number {
                    self.blame(&(at.clone() + "text"), &mark.text.as_str().into(), &part.id);
                }
                let lies_in = |plane: &Plane| {
                    let middles = mark.strokes_mm.iter().map(|p| Point::from(*p));
                    middles
                        .map(|p| plane.distance(&p).abs())
                        .fold(0.0, f64::max)
                        <= NEAR_MM
                };
                let mut cuts = self.cuts.iter();
                if !cuts.any(|(id, plane)| *id == mark.cut && lies_in(plane)) {
                    self.blame(&(at + "cut"), &mark.cut.as_str().into(), "another");
                }
            }
        }
    }

    /// Judges the size of the finished object.
    fn judge_size(&mut self) {
        let stated = &self.sheet["finished_size_mm"];
        let parts = self.evidence.parts.iter();
        let points = parts.flat_map(|part| {
            let vertices = part.mesh.vertices().iter();
            vertices.map(|p| part.pose.to_model(p))
        });
        let hardware = self.evidence.promise.hardware.iter();
        let points = points.chain(hardware.flat_map(bounds));
        let empty = [
            Vector::repeat(f64::INFINITY),
            Vector::repeat(f64::NEG_INFINITY),
        ];
        let [low, high] = points.fold(empty, |[low, high], p| {
            [low.inf(&p.coords), high.sup(&p.coords)]
        });
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let at = format!("finished_size_mm along {name}");
            self.compare(&at, &stated[axis], (high - low)[axis], NEAR_MM);
        }
    }

    /// Judges the areas on which parts stand on the plate.
    fn judge_feet(&mut self) {
        let evidence = self.evidence;
        for (row, part) in rows(self.sheet, "parts").iter().zip(&evidence.parts) {
            let found_mm2 = foot_area_mm2(&part.mesh);
            let at = format!("parts[{}].support.foot_mm2", part.id);
            let stated = &row["support"]["foot_mm2"];
            self.compare(&at, stated, found_mm2, FOOT_RATIO * found_mm2.max(1.0));
        }
    }

    /// Judges the masses of the hardware and the dowels.
    fn judge_hardware(&mut self) {
        let promise = &self.evidence.promise;
        for rod in promise.hardware.iter().chain(&promise.dowels) {
            let found_g = mass_moments(std::slice::from_ref(rod)).volume();
            let at = format!("{}.mass_g", rod.id);
            self.compare(&at, &rod.mass_g.into(), found_g, MASS_RATIO * found_g);
        }
    }

    /// Judges the contact of a top, and whether the figures are those of the goal's objective.
    fn judge_goal(&mut self) {
        let (goal, kind) = (&self.sheet["goal"], self.evidence.promise.goal.kind);
        let gap_mm = match self.judgement.spin {
            Some(spin) if !spin.has_tip => spin.gap_mm,
            _ => 0.0,
        };
        let has_tip = self.judgement.spin.is_some_and(|spin| spin.has_tip);
        if !has_tip {
            self.compare(
                "goal.contact_gap_mm",
                &goal["contact_gap_mm"],
                gap_mm,
                CONTACT_LIMIT_MM,
            );
        }
        let Some(objective) = goal["objective"].as_str() else {
            return;
        };
        let promised = figures_of(kind, objective);
        if promised.is_empty() {
            self.blame("goal.objective", &objective.into(), "another goal");
        }
        let stated = &self.sheet["certificate"]["figure"];
        let certified = serde_json::from_value(stated.clone()).ok();
        if certified.is_none() && !stated.is_null() {
            self.blame("certificate.figure", stated, "no such figure");
        }
        let promise = self.evidence.promise.promise.map(|promise| promise.figure);
        let figures = [
            ("certificate.figure", certified),
            ("promise.figure", promise),
        ];
        for (at, figure) in figures {
            // The certificate of infill near a wished one bounds how far it is from it.
            let is_change = at == "certificate.figure"
                && figure == Some(FigureName::InfillChangeRatio)
                && self.evidence.promise.infill.is_some();
            let is_other = |figure: FigureName| !promised.contains(&figure);
            if !is_change && figure.is_some_and(is_other) {
                self.blame(at, &objective.into(), "a figure of another objective");
            }
        }
    }
}

impl Peg {
    /// Returns the area of a pin's base, mm².
    fn base_mm2(&self) -> f64 {
        let sheets = self.pin_relief().base;
        sheets.iter().map(area_mm2).sum()
    }

    /// Returns the area of a socket's mouth, mm².
    fn mouth_mm2(&self) -> f64 {
        let sheets = self.socket_relief().mouth;
        sheets.iter().map(area_mm2).sum()
    }
}

/// Returns the figures by which an objective is judged and certified; empty if the goal has no such
/// objective.
fn figures_of(kind: GoalKind, objective: &str) -> &'static [FigureName] {
    use FigureName as F;
    match (kind, objective) {
        (GoalKind::Top, "critical_speed") => &[F::CriticalSpeedRpm],
        (GoalKind::Top, "spin_it") => &[F::CriticalSpeedRpm, F::SpinItRatio],
        (GoalKind::Yoyo, "spin_it") => &[F::SpinItRatio],
        (GoalKind::Top | GoalKind::Yoyo, "dominance") => &[F::DominanceRatio],
        (GoalKind::Stand, "toppling_angle") => &[F::TopplesDeg],
        (GoalKind::Stand, "lowest_center") => &[F::CenterHeightMm],
        (GoalKind::Float, "metacentric_height") => &[F::MetacentricHeightMm],
        (GoalKind::Balance, "least_removed") => &[F::MassG, F::BalanceGradeMmS],
        (GoalKind::Balance, "least_unbalance") => &[F::BalanceGradeMmS],
        (GoalKind::Match, "least_change") => &[F::InfillChangeRatio],
        _ => &[],
    }
}

/// Returns corners of boxes about the ends of a rod.
fn bounds(rod: &Hardware) -> [Point; 4] {
    let [from, to] = [rod.from_mm, rod.to_mm].map(Point::from);
    let along = (to - from).normalize();
    let radius = 0.5 * rod.diameter_mm;
    let disc = along.map(|x| radius * (1.0 - x * x).max(0.0).sqrt());
    let (end, reach) = if rod.round_end {
        (to - along * radius, Vector::repeat(radius))
    } else {
        (to, disc)
    };
    [from - disc, from + disc, end - reach, end + reach]
}

/// Returns the rows of a table of the checklist.
fn rows<'a>(sheet: &'a Value, table: &str) -> &'a [Value] {
    sheet[table].as_array().map_or(&[], Vec::as_slice)
}

/// Returns a text of a row; empty if it has none.
fn text<'a>(row: &'a Value, key: &str) -> &'a str {
    row[key].as_str().unwrap_or_default()
}
