//! The check of checklist.json against the files: every number that follows from them, computed
//! again.

use serde_json::{Map, Value, json};

use super::cell_walls::find_false_cells;
use super::claims::find_false_claims;
use super::limits::SHEET_LIMIT_RATIO;
use super::machine::find_false_numbers;
use super::rows::find_false_rows;
use super::{
    Check, CheckKind, Evidence, FigureName, Fingerprint, InfillLevel, InfillOrder, JointFacts,
    Judgement, Limit, PartFacts, Promise, PromisedJoint, PromisedVoid, Shells,
};
use crate::base::units::MM3_PER_CM3;
use crate::mass::moments_of_mesh;
use crate::mesh::TriMesh;
use crate::repair::weld;

/// The same limit for the model and its voids. The checklist states them from before the rounding
/// to a file's digits.
const BEFORE_ROUNDING_RATIO: f64 = 1e-4;
/// Numbers within this distance are equal in any unit, since large numbers may cancel. The same
/// triangles in another order move an axis by 1e-8 mm and tilt it by 1e-7°. A nanometre matters to
/// nobody.
const NEGLIGIBLE: f64 = 1e-6;
/// Greatest number of misstatements that are listed; the rest are counted.
const MAX_LISTED: usize = 6;

/// Checks that kits of older versions do not state. They are judged all the same.
const NEWER_CHECKS: [CheckKind; 2] = [CheckKind::OneBody, CheckKind::PartSurfaces];
/// The keys of a check's kind, with its void or figure.
const KIND_KEYS: [&str; 3] = ["kind", "void", "figure"];

/// A comparison of stated values with found ones, and the misstatements so far.
struct Comparer {
    /// Relative tolerance.
    ratio: f64,
    misstatements: Vec<String>,
}

/// The judgement of a kit with the fingerprints and shells of its files.
pub(super) struct Findings<'a> {
    evidence: &'a Evidence,
    judgement: &'a Judgement,
    /// The fingerprint of each part, and whether it is the promised one.
    prints: Vec<(Fingerprint, bool)>,
    /// The shells of the uncut result.
    shells: Shells,
}

impl<'a> Findings<'a> {
    /// Adds the fingerprints of the parts and the shells to a judgement.
    pub(super) fn new(evidence: &'a Evidence, judgement: &'a Judgement) -> Self {
        let (prints, shells) = rayon::join(
            || evidence.fingerprints(),
            || Shells::of_mesh(&weld(&evidence.hollowed)),
        );
        let prints = prints.into_iter().enumerate().map(|(part, print)| {
            let is_as_made = evidence.is_part_as_made(part, &print);
            (print, is_as_made)
        });
        Self {
            evidence,
            judgement,
            prints: prints.collect(),
            shells,
        }
    }

    /// Returns true if every part has the triangles of its promised fingerprint.
    fn are_all_as_made(&self) -> bool {
        self.prints.iter().all(|(_, is_as_made)| *is_as_made)
    }
}

/// Finds the places where the checklist disagrees with the files, a sentence each, in the order of
/// its keys.
///
/// Parts whose files do not match their fingerprints are left out with everything that depends on
/// them. They are another fault, and would hide this one.
pub fn find_misstatements(
    sheet: &Value,
    evidence: &Evidence,
    judgement: &Judgement,
) -> Vec<String> {
    let mut exact = Comparer {
        ratio: SHEET_LIMIT_RATIO,
        misstatements: Vec::new(),
    };
    let findings = Findings::new(evidence, judgement);
    exact.object("", sheet, &restate(sheet, &findings));
    let mut rough = Comparer {
        ratio: BEFORE_ROUNDING_RATIO,
        misstatements: exact.misstatements,
    };
    rough.object("", sheet, &restate_before_rounding(&findings));
    if findings.are_all_as_made() {
        let claims = find_false_claims(sheet, evidence, judgement);
        rough.misstatements.extend(claims);
        let numbers = find_false_numbers(sheet, evidence);
        rough.misstatements.extend(numbers);
        rough.misstatements.extend(find_false_rows(sheet, evidence));
        let cells = find_false_cells(&evidence.promise, judgement.cells.as_ref());
        rough.misstatements.extend(cells);
    }
    rough.misstatements
}

/// Checks that the checklist agrees with the files.
pub fn sheet_check(misstated: &[String]) -> Check {
    let promise = "the checklist states what the files hold";
    let more = misstated.len().saturating_sub(MAX_LISTED);
    let mut words = misstated[..misstated.len().min(MAX_LISTED)].join("; ");
    if more > 0 {
        words += &format!("; and {more} more");
    }
    Check::new(
        CheckKind::Checklist,
        promise,
        Some(misstated.len() as f64),
        Limit::at_most(0.0, ""),
    )
    .at((!words.is_empty()).then_some(words))
}

/// Returns the part of the checklist that follows from these files, under its own keys.
pub(super) fn restate(sheet: &Value, findings: &Findings) -> Value {
    let judgement = findings.judgement;
    let promise = &findings.evidence.promise;
    let parts = judgement.parts.iter().enumerate();
    let parts: Vec<Value> = parts
        .map(|(index, facts)| {
            if findings.prints[index].1 {
                part_row(findings, index, facts)
            } else {
                json!({})
            }
        })
        .collect();
    let mut rows = Map::new();
    rows.insert("solid".to_owned(), json!(judgement.solid));
    rows.insert("hollowed".to_owned(), json!(judgement.hollowed));
    rows.insert(
        "wall".to_owned(),
        json!({ "measured_min_mm": judgement.wall_min_mm }),
    );
    rows.insert("parts".to_owned(), json!(parts));
    let is_whole = findings.are_all_as_made();
    let found = is_whole.then_some(&judgement.joints[..]);
    rows.insert(
        "joints".to_owned(),
        json!(joint_rows(&sheet["joints"], promise, found)),
    );
    if is_whole {
        rows.extend(restate_whole(sheet, promise, judgement));
    }
    Value::Object(rows)
}

/// Returns the keys that depend on all parts.
fn restate_whole(sheet: &Value, promise: &Promise, judgement: &Judgement) -> Map<String, Value> {
    let figure = |name| judgement.assembly.value_of(name);
    let passes = judgement.checks.iter().all(|check| check.pass);
    let mut rows = Map::new();
    rows.insert("assembly".to_owned(), json!(judgement.assembly));
    rows.insert("checks".to_owned(), check_rows(&sheet["checks"], judgement));
    rows.insert(
        "verdict".to_owned(),
        json!(if passes { "pass" } else { "fail" }),
    );
    // Kits of older versions do not state on which part a top spins.
    if let (Some(spin), true) = (judgement.spin, sheet["goal"]["spins_on"].is_object()) {
        rows.insert("goal".to_owned(), json!({ "spins_on": spin }));
    }
    if let Some(promised) = promise.promise {
        rows.insert(
            "promise".to_owned(),
            json!({ "value": figure(promised.figure) }),
        );
    }
    // The judge has no figure for Spin-It's functional with weights.
    let named = serde_json::from_value(sheet["certificate"]["figure"].clone()).ok();
    if let Some(named) = named.filter(|name| *name != FigureName::SpinItRatio) {
        rows.insert(
            "certificate".to_owned(),
            json!({ "written_value": figure(named) }),
        );
    }
    rows
}

/// Returns the rows of the checks. Kits made before checks had kinds state their names alone, so
/// the kind of such a row is left out. Kits made before there was a check do not state it.
fn check_rows(stated: &Value, judgement: &Judgement) -> Value {
    let names = |check: &Check| {
        let name = json!(check.kind.to_string());
        let mut rows = stated.as_array().into_iter().flatten();
        rows.any(|row| row["name"] == name)
    };
    let is_newer = |check: &Check| NEWER_CHECKS.contains(&check.kind) && !names(check);
    let checks = judgement.checks.iter().filter(|check| !is_newer(check));
    let row = |(index, check): (usize, &Check)| {
        let is_old = stated
            .get(index)
            .is_some_and(|row| row.get("kind").is_none());
        let mut row = json!(check);
        if let Some(keys) = row.as_object_mut().filter(|_| is_old) {
            keys.retain(|key, _| !KIND_KEYS.contains(&key.as_str()));
        }
        row
    };
    checks.enumerate().map(row).collect()
}

/// Returns the keys whose values the checklist states from before the rounding to a file's digits.
pub(super) fn restate_before_rounding(findings: &Findings) -> Value {
    let Findings {
        evidence,
        judgement,
        shells,
        ..
    } = findings;
    let voids = evidence.promise.voids.iter().zip(&shells.inward);
    let void_row = |(promised, cavity): (&PromisedVoid, &TriMesh)| {
        let is_clean = judgement
            .checks
            .iter()
            .filter(|check| check.kind.void() == Some(&promised.id))
            .all(|c| c.pass);
        let mut row = json!({ "volume_mm3": moments_of_mesh(cavity).volume().abs() });
        if findings.are_all_as_made() {
            row["is_clean"] = json!(is_clean);
        }
        row
    };
    let mut rows = json!({ "voids": voids.map(void_row).collect::<Vec<_>>() });
    if let Some(infill) = &evidence.promise.infill {
        rows["infill"] = infill_rows(evidence, infill, shells);
    }
    // The file has sockets and tips of the hardware, which the model of the job has not.
    if evidence.promise.hardware.is_empty() {
        let outer = shells.outer_mesh();
        let size: [f64; 3] = outer.aabb().size().into();
        rows["model"] = json!({ "size_mm": size, "volume_mm3": moments_of_mesh(&outer).volume() });
    }
    rows
}

/// Returns the volume and the mass of the regions of each density of infill.
fn infill_rows(evidence: &Evidence, infill: &InfillOrder, shells: &Shells) -> Value {
    let density = evidence.promise.material.density_g_cm3;
    let inner = evidence.inner_in_model();
    let inner = inner.iter().map(|region| moments_of_mesh(region).volume());
    let outermost_mm3 = moments_of_mesh(&shells.inner_mesh()).volume().abs();
    let volumes: Vec<f64> = std::iter::once(outermost_mm3).chain(inner).collect();
    let row = |(index, level): (usize, &InfillLevel)| {
        let volume_mm3 = volumes.get(index).copied().unwrap_or_default();
        let within_mm3 = volumes.get(index + 1).copied().unwrap_or_default();
        let laid_mm3 = level.laid_ratio * (volume_mm3 - within_mm3);
        json!({ "volume_mm3": volume_mm3, "mass_g": laid_mm3 * density / MM3_PER_CM3 })
    };
    let levels = infill.levels();
    let mut rows: Vec<Value> = levels.iter().enumerate().map(row).collect();
    let inner = rows.split_off(1);
    let mut outermost = rows.pop().unwrap_or_default();
    if !inner.is_empty() {
        outermost["inner"] = json!(inner);
    }
    outermost
}

fn part_row(findings: &Findings, part: usize, facts: &PartFacts) -> Value {
    let promise = &findings.evidence.promise;
    let density = promise.material.density_g_cm3;
    let infill_g = promise
        .infill
        .as_ref()
        .map_or(0.0, |infill| infill.extra_g(density));
    let mut row = json!({
        "id": facts.id,
        "triangles": facts.surface.triangles,
        "volume_mm3": facts.surface.volume_mm3,
        "mass_g": facts.surface.volume_mm3 * density / MM3_PER_CM3 + infill_g,
        "size_mm": facts.size_mm,
    });
    if promise.parts[part].fingerprint.is_some() {
        row["fingerprint"] = json!(findings.prints[part].0);
    }
    row
}

/// Returns the number of pins of every joint, its play as found, and the mass of its glue.
fn joint_rows(stated: &Value, promise: &Promise, found: Option<&[JointFacts]>) -> Vec<Value> {
    let row = |(index, joint): (usize, &PromisedJoint)| {
        let pegs = promise
            .parts
            .iter()
            .flat_map(|part| part.pins.iter().chain(&part.sockets));
        let mut ids: Vec<&String> = pegs
            .filter(|peg| peg.joint == joint.id)
            .map(|peg| &peg.id)
            .collect();
        ids.sort();
        ids.dedup();
        let mut row = json!({ "id": joint.id, "pins": ids.len() });
        // Kits of older versions do not state their play.
        if let (Some(found), true) = (found, joint.held_by.is_some()) {
            row["play"] = json!(found[index].play);
            // Nor what it does to a rotor.
            if !stated[index]["unbalance_g_mm"].is_null() {
                row["unbalance_g_mm"] = json!(found[index].unbalance_g_mm);
            }
        }
        if let Some(film) = joint.glue {
            let volume_mm3 = film.face.area_mm2 * film.thickness_mm;
            row["glue"] = json!({ "mass_g": volume_mm3 * film.density_g_cm3 / MM3_PER_CM3 });
        }
        row
    };
    promise.joints.iter().enumerate().map(row).collect()
}

impl Comparer {
    /// Compares every key of `found` with the stated one. Keys that were not computed again are
    /// skipped.
    fn object(&mut self, at: &str, stated: &Value, found: &Value) {
        let Some(found) = found.as_object() else {
            return;
        };
        for (key, found) in found {
            let at = if at.is_empty() {
                key.clone()
            } else {
                format!("{at}.{key}")
            };
            self.value(&at, stated.get(key).unwrap_or(&Value::Null), found);
        }
    }

    fn value(&mut self, at: &str, stated: &Value, found: &Value) {
        match found {
            Value::Object(_) => self.object(at, stated, found),
            Value::Array(rows) if rows.iter().any(Value::is_object) || rows.is_empty() => {
                self.rows(at, stated, rows);
            }
            _ if is_near(stated, found, self.ratio * largest(found)) => {}
            _ => self
                .misstatements
                .push(format!("{at} states {stated}, the files have {found}")),
        }
    }

    /// Compares the rows of a table, named by their ids or names.
    fn rows(&mut self, at: &str, stated: &Value, found: &[Value]) {
        let stated = stated.as_array().map_or(&[][..], Vec::as_slice);
        if stated.len() != found.len() {
            self.misstatements.push(format!(
                "{at} has {} rows, the files have {}",
                stated.len(),
                found.len()
            ));
        }
        for (stated, found) in stated.iter().zip(found) {
            let name = [&stated["id"], &stated["name"]]
                .into_iter()
                .find_map(Value::as_str);
            self.object(&format!("{at}[{}]", name.unwrap_or("?")), stated, found);
        }
    }
}

/// Returns true if two values are equal, numbers within `slack` or [`NEGLIGIBLE`].
fn is_near(stated: &Value, found: &Value, slack: f64) -> bool {
    match (stated, found) {
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_near(a, b, slack))
        }
        _ => match (stated.as_f64(), found.as_f64()) {
            (Some(a), Some(b)) => (a - b).abs() <= slack.max(NEGLIGIBLE),
            _ => stated == found,
        },
    }
}

/// Returns the largest magnitude in a value. The small numbers of a vector or tensor are as exact
/// as its large ones.
pub(super) fn largest(value: &Value) -> f64 {
    match value {
        Value::Array(values) => values.iter().map(largest).fold(0.0, f64::max),
        _ => value.as_f64().map_or(0.0, f64::abs),
    }
}
