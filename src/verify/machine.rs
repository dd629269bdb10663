//! The claims of the checklist about the machine, held against its profile and against itself.
//!
//! It is about the printer's numbers, the lengths on its grid, and the gap of the certificate.

use serde_json::Value;

use super::Evidence;
use crate::geom::{Point, Vector};
use crate::printer::Printer;

/// Numbers that were copied differ by no more than this share.
const COPY_RATIO: f64 = 1e-9;
/// A length is a whole number of steps within this share of a step.
const WHOLE_STEPS: f64 = 1e-3;
/// The optimum before cleaning may be so far from its proved bound, as a share: what an ascent that
/// ended early still accepts.
const FIRST_GAP_RATIO: f64 = 1e-2;
/// A stated gap is that of a functional; that of the figure differs from it by at most this factor.
const GAP_FACTOR: f64 = 10.0;
/// Gaps below this are rounding.
const GAP_RATIO: f64 = 1e-8;

/// The faults found so far, a sentence each.
#[derive(Default)]
struct Faults(Vec<String>);

/// Finds what the checklist claims falsely of the machine and the certificate. Keys that it lacks
/// are skipped.
pub(super) fn find_false_numbers(sheet: &Value, evidence: &Evidence) -> Vec<String> {
    let mut faults = Faults::default();
    faults.judge_printer(sheet);
    for (index, row) in sheet["grid"].as_array().into_iter().flatten().enumerate() {
        faults.judge_length(&format!("grid[{index}]"), row, sheet, evidence);
    }
    faults.judge_gap(&sheet["certificate"]);
    faults.0
}

impl Faults {
    /// Blames a stated number that is none of the right ones.
    fn compare(&mut self, at: &str, stated: &Value, right: &[f64]) {
        let is_near = |stated: f64, right: f64| {
            (stated - right).abs() <= COPY_RATIO * right.abs().max(COPY_RATIO)
        };
        let is_right = |stated: f64| right.iter().any(|&right| is_near(stated, right));
        if !stated.is_null() && !stated.as_f64().is_some_and(is_right) {
            self.0.push(format!("{at} states {stated}, not {right:?}"));
        }
    }

    /// Compares the printer with the profile of its id, if that has the stated hash.
    fn judge_printer(&mut self, sheet: &Value) {
        let stated = &sheet["printer"];
        let profiles = Printer::all().unwrap_or_default();
        let known = profiles.iter().find(|profile| {
            stated["id"] == profile.id.as_str()
                && stated["profile_sha256"] == profile.profile_sha256.as_str()
        });
        let Some(known) = known else {
            return;
        };
        let pixel = &stated["pixel_mm"];
        let cleaning = known.cleaning_rule();
        let numbers = [
            ("pixel_mm along x", &pixel[0], known.pixel_x_mm.value),
            ("pixel_mm along y", &pixel[1], known.pixel_y_mm.value),
            ("layer_mm", &stated["layer_mm"], known.layer_mm.value),
            (
                "minimum_opening_mm",
                &stated["minimum_opening_mm"],
                known.min_opening_mm.value,
            ),
            (
                "least_pin_mm",
                &stated["least_pin_mm"],
                known.pin_min_diameter_mm.value,
            ),
            (
                "cleaning.sight_ratio",
                &stated["cleaning"]["sight_ratio"],
                cleaning.sight_ratio,
            ),
        ];
        for (key, stated, right) in numbers {
            self.compare(&format!("printer.{key}"), stated, &[right]);
        }
        self.judge_infill(&sheet["infill"], known);
        if let Some(reach_mm) = cleaning.reach_mm {
            let stated = &stated["cleaning"]["reach_mm"];
            self.compare("printer.cleaning.reach_mm", stated, &[reach_mm]);
        }
        let sides = sheet["finished_size_mm"].as_array().into_iter().flatten();
        let longest_mm = sides.filter_map(Value::as_f64).fold(0.0, f64::max);
        let right_mm = known.tolerance.at_mm(longest_mm);
        self.compare(
            "size_tolerance_mm",
            &sheet["size_tolerance_mm"],
            &[right_mm],
        );
        if stated["name"] != known.name.as_str() {
            let name = &stated["name"];
            self.0
                .push(format!("printer.name states {name}, not {}", known.name));
        }
    }

    /// Compares the densities of sparse infill with what the profile's table says of them.
    fn judge_infill(&mut self, stated: &Value, known: &Printer) {
        let Some(pattern) = &known.infill else {
            return;
        };
        if stated.is_object() && stated["pattern"] != pattern.pattern.as_str() {
            let found = &stated["pattern"];
            let right = &pattern.pattern;
            self.0
                .push(format!("infill.pattern states {found}, not {right}"));
        }
        let pattern = pattern.scaled(stated["slicer_ratio"].as_f64().unwrap_or(1.0));
        let inner = stated["inner"].as_array().into_iter().flatten();
        for level in std::iter::once(stated).chain(inner) {
            if let Some(nominal) = level["nominal_ratio"].as_f64() {
                let laid = pattern.laid_ratio(nominal);
                self.compare("infill.laid_ratio", &level["laid_ratio"], &[laid]);
            }
        }
    }

    /// Judges one length on the printer's grid.
    fn judge_length(&mut self, at: &str, row: &Value, sheet: &Value, evidence: &Evidence) {
        let (pixel, layer) = (&sheet["printer"]["pixel_mm"], &sheet["printer"]["layer_mm"]);
        let steps_mm: Vec<f64> = match row["along"].as_str() {
            Some("x") => vec![&pixel[0]],
            Some("y") => vec![&pixel[1]],
            Some("z") => vec![layer],
            Some("tilted") => vec![&pixel[0], &pixel[1], layer],
            _ => Vec::new(),
        }
        .into_iter()
        .filter_map(Value::as_f64)
        .collect();
        self.compare(&format!("{at}.step_mm"), &row["step_mm"], &steps_mm);
        let number = |key: &str| row[key].as_f64().unwrap_or(f64::NAN);
        let (step_mm, steps) = (number("step_mm"), number("steps"));
        self.compare(
            &format!("{at}.given_mm"),
            &row["given_mm"],
            &[steps * step_mm],
        );
        let over = number("drawn_mm") / step_mm - steps;
        let is_whole = over.abs() <= WHOLE_STEPS;
        if row["is_whole"] != is_whole || over.abs() >= 1.0 {
            let drawn = &row["drawn_mm"];
            self.0
                .push(format!("{at} states that {drawn} mm are {steps} steps"));
        }
        let drawn_mm = drawn_lengths_mm(row, evidence);
        self.compare(&format!("{at}.drawn_mm"), &row["drawn_mm"], &drawn_mm);
        let asked = &sheet["wall"]["asked_mm"];
        if let Some(asked_mm) = asked.as_f64().filter(|_| row["what"] == "wall") {
            self.compare(&format!("{at}.asked_mm"), &row["asked_mm"], &[asked_mm]);
        }
        let stated = &row["steps_of"];
        let is_upright = row["along"] == "z" || steps_mm.last() == Some(&step_mm);
        let is_right = match stated.as_str() {
            Some("layers") => is_upright,
            Some("pixels" | "line widths") => row["along"] != "z",
            _ => stated.is_null(),
        };
        if !is_right {
            self.0.push(format!("{at}.steps_of states {stated}"));
        }
    }

    /// Judges whether value, bound and gap of the certificate agree.
    fn judge_gap(&mut self, stated: &Value) {
        let number = |key: &str| stated[key].as_f64();
        let numbers = number("value")
            .zip(number("bound"))
            .zip(number("gap_ratio"));
        let Some(((value, bound), gap)) = numbers else {
            return;
        };
        let found = (value - bound).abs() / value.abs().max(bound.abs()).max(f64::MIN_POSITIVE);
        let is_near = |a: f64, b: f64| a <= GAP_FACTOR * b + GAP_RATIO;
        let best = stated["proof"]["bound"].as_f64();
        if let Some((first, best)) = number("value_before_cleaning").zip(best) {
            let apart = (first - best).abs() / best.abs().max(f64::MIN_POSITIVE);
            if apart > FIRST_GAP_RATIO {
                self.0.push(format!(
                    "certificate.value_before_cleaning states {first}, its proof is of {best}"
                ));
            }
        }
        if !(is_near(found, gap.abs()) && is_near(gap.abs(), found)) {
            self.0.push(format!(
                "certificate.gap_ratio states {gap}, value and bound are {found} apart"
            ));
        }
    }
}

/// Returns the lengths in the files that a row of the grid may be about, mm. For other rows that is
/// what it states.
fn drawn_lengths_mm(row: &Value, evidence: &Evidence) -> Vec<f64> {
    let promise = &evidence.promise;
    let pins = promise.parts.iter().flat_map(|part| &part.pins);
    let sockets = promise.parts.iter().flat_map(|part| &part.sockets);
    match row["what"].as_str().unwrap_or_default() {
        "wall" => vec![promise.wall.required_mm],
        "pin, diameter, at least" => pins.map(|pin| pin.diameter_mm).collect(),
        "pin, length" => pins.map(|pin| pin.length_mm).collect(),
        "socket, diameter" => sockets.map(|socket| socket.diameter_mm).collect(),
        "socket, depth" => sockets.map(|socket| socket.length_mm).collect(),
        "pitch of the solver" => row["drawn_mm"].as_f64().into_iter().collect(),
        face if face.starts_with("cut face") => heights_mm(evidence),
        _ => Vec::new(),
    }
}

/// Returns the heights of all level cut planes over the plates of all parts, mm.
fn heights_mm(evidence: &Evidence) -> Vec<f64> {
    let of_part = evidence.promise.parts.iter().flat_map(|part| {
        let pose = part.print_from_model;
        let cuts = evidence.promise.cuts.iter().filter(move |cut| {
            let up = pose.rotation() * Vector::from(cut.normal).normalize();
            up.z.abs() > 1.0 - 1e-6
        });
        cuts.map(move |cut| pose.to_print(&Point::from(cut.point_mm)).z)
    });
    of_part.collect()
}
