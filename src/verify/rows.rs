//! The claims of the checklist about single rows: the lie of parts, pictures, hardware, glue, and
//! the lengths that were asked for.

use serde_json::{Value, json};

use super::Evidence;
use crate::geom::{Plane, Point, Vector};

/// The process whose parts may enclose resin.
const VAT: &str = "sla";
/// Least vertical component of the normal of a level face.
const LEVEL_COSINE: f64 = 0.9999;
/// An axis is a unit vector within this, and a matrix symmetric within this share.
const ROUNDING: f64 = 1e-9;
/// A length is drawn at most this many of the machine's largest steps off what was asked for. It
/// fits the grid in every direction.
const MAX_STEPS: f64 = 2.0 + 1e-3;

/// The words of the rows of a pin.
const PIN_DIAMETER: &str = "pin, diameter, at least";
const PIN_LENGTH: &str = "pin, length";

/// The faults found so far, a sentence each.
struct Faults(Vec<String>);

/// Finds what single rows of the checklist claim falsely. Keys that it lacks are skipped.
pub(super) fn find_false_rows(sheet: &Value, evidence: &Evidence) -> Vec<String> {
    let mut faults = Faults(Vec::new());
    let axis = Vector::from(evidence.promise.goal.axis);
    if (axis.norm() - 1.0).abs() > ROUNDING {
        let stated = &sheet["goal"]["axis"];
        faults.0.push(format!(
            "goal.axis states {stated}, which is no unit vector"
        ));
    }
    for (index, row) in rows(sheet, "parts").iter().enumerate() {
        faults.judge_part(sheet, row, index, evidence);
    }
    for (index, row) in rows(sheet, "hardware").iter().enumerate() {
        let at = format!("hardware[{index}].id");
        faults.compare(&at, &row["id"], &json!(format!("H{}", index + 1)));
    }
    for row in rows(sheet, "joints") {
        faults.judge_glue(row);
    }
    for (index, row) in rows(sheet, "grid").iter().enumerate() {
        faults.judge_length(&format!("grid[{index}]"), row, sheet);
    }
    faults.judge_pin_lengths(rows(sheet, "grid"));
    faults.0
}

impl Faults {
    /// Blames a stated value that is another one. Missing ones are skipped.
    fn compare(&mut self, at: &str, stated: &Value, right: &Value) {
        if !stated.is_null() && stated != right {
            self.0.push(format!("{at} states {stated}, not {right}"));
        }
    }

    fn judge_part(&mut self, sheet: &Value, row: &Value, index: usize, evidence: &Evidence) {
        let id = &evidence.parts[index].id;
        let at = |key: &str| format!("parts[{id}].{key}");
        let picture = json!(format!("pictures/{id}.svg"));
        self.compare(&at("picture"), &row["picture"], &picture);
        self.compare(
            &at("lies"),
            &row["lies"],
            &json!(lie(sheet, index, evidence)),
        );
        if evidence.promise.printer.process.as_deref() != Some(VAT) {
            self.compare(&at("cup_mm3"), &row["cup_mm3"], &json!(0.0));
        }
    }

    /// Judges whether the second moments of a film are symmetric.
    fn judge_glue(&mut self, joint: &Value) {
        let squares = &joint["glue"]["squares_mm4"];
        let cell = |row: usize, column: usize| squares[row][column].as_f64().unwrap_or(0.0);
        let trace: f64 = (0..3).map(|i| cell(i, i).abs()).sum();
        let pairs = [(0, 1), (0, 2), (1, 2)];
        let is_even = |(a, b)| (cell(a, b) - cell(b, a)).abs() <= ROUNDING * trace;
        if !pairs.into_iter().all(is_even) {
            let id = &joint["id"];
            self.0
                .push(format!("joints[{id}].glue.squares_mm4 is not symmetric"));
        }
    }

    /// Judges whether all pins were asked for with one ratio of length to diameter.
    fn judge_pin_lengths(&mut self, grid: &[Value]) {
        let ratios = pin_ratios(grid);
        let Some(&(_, first)) = ratios.first() else {
            return;
        };
        let others = ratios
            .iter()
            .filter(|(_, ratio)| (ratio / first - 1.0).abs() > ROUNDING);
        let faults = others.map(|(index, ratio)| {
            format!("grid[{index}].asked_mm is {ratio} diameters, that of the first pin {first}")
        });
        self.0.extend(faults);
    }

    /// Judges whether a length is drawn about as it was asked for.
    fn judge_length(&mut self, at: &str, row: &Value, sheet: &Value) {
        let number = |key: &str| row[key].as_f64().unwrap_or(f64::NAN);
        let (asked_mm, drawn_mm) = (number("asked_mm"), number("drawn_mm"));
        let what = row["what"].as_str().unwrap_or_default();
        let is_near = match what {
            PIN_DIAMETER => row["asked_mm"] == sheet["printer"]["least_pin_mm"],
            // Where the walls lack room, a pin is shorter than asked for.
            PIN_LENGTH => drawn_mm - asked_mm <= MAX_STEPS * largest_step_mm(sheet),
            _ => (drawn_mm - asked_mm).abs() <= MAX_STEPS * largest_step_mm(sheet),
        };
        if !is_near {
            let asked = &row["asked_mm"];
            self.0.push(format!(
                "{at}.asked_mm states {asked}, drawn are {drawn_mm} mm"
            ));
        }
    }
}

/// Returns the ratio of the length to the diameter that was asked for of each pin, with the index
/// of its row.
fn pin_ratios(grid: &[Value]) -> Vec<(usize, f64)> {
    let number = |row: &Value, key: &str| row[key].as_f64().unwrap_or(f64::NAN);
    let is_of = |row: &Value, what: &str| {
        let word = row["what"].as_str().unwrap_or_default();
        word.starts_with(what)
    };
    let pairs = grid.windows(2).enumerate();
    let pins =
        pairs.filter(|(_, pair)| is_of(&pair[0], PIN_DIAMETER) && is_of(&pair[1], PIN_LENGTH));
    pins.map(|(index, pair)| {
        let ratio = number(&pair[1], "asked_mm") / number(&pair[0], "drawn_mm");
        (index + 1, ratio)
    })
    .collect()
}

/// Returns the lie of a part on the plate in words: the cut faces that look down or up.
fn lie(sheet: &Value, index: usize, evidence: &Evidence) -> String {
    let part = &evidence.parts[index];
    let center = part
        .mesh
        .map_vertices(|p| part.pose.to_model(p))
        .aabb()
        .center();
    let turn = part.pose.rotation();
    let joints = rows(sheet, "joints").iter();
    let of_part = |joint: &&Value| {
        joint["parts"]
            .as_array()
            .is_some_and(|p| p.contains(&json!(part.id)))
    };
    let own: Vec<&Value> = joints.filter(of_part).map(|joint| &joint["cut"]).collect();
    let cuts = rows(sheet, "cuts").iter().zip(&evidence.promise.cuts);
    let facing = cuts
        .filter(|(row, _)| own.contains(&&row["id"]))
        .filter_map(|(row, cut)| {
            let plane = Plane::through(&Point::from(cut.point_mm), &Vector::from(cut.normal));
            let outward = -plane.normal * plane.distance(&center).signum();
            let id = row["id"].as_str().unwrap_or_default();
            match (turn * outward).z {
                z if z < -LEVEL_COSINE => Some(format!("cut face {id} down")),
                z if z > LEVEL_COSINE => Some(format!("cut face {id} up")),
                _ => None,
            }
        });
    let facing: Vec<String> = facing.collect();
    if !facing.is_empty() {
        return facing.join(", ");
    }
    let is_on_narrow_end = evidence.promise.way_of_plug(&part.id).is_some_and(|way| {
        let z = (turn * way).z;
        z < -LEVEL_COSINE
    });
    if is_on_narrow_end {
        return "narrow end down".to_owned();
    }
    match (turn * evidence.promise.goal.frame().axis()).z {
        z if z > LEVEL_COSINE => "as the model stands".to_owned(),
        z if z < -LEVEL_COSINE => "upside down".to_owned(),
        _ => "leaning, as in the picture".to_owned(),
    }
}

/// Returns the largest step of the printer, mm.
fn largest_step_mm(sheet: &Value) -> f64 {
    let printer = &sheet["printer"];
    let steps = [
        &printer["pixel_mm"][0],
        &printer["pixel_mm"][1],
        &printer["layer_mm"],
    ];
    let steps = steps.into_iter().filter_map(Value::as_f64);
    steps.fold(0.0, f64::max)
}

/// Returns the rows of a table of the checklist.
fn rows<'a>(sheet: &'a Value, table: &str) -> &'a [Value] {
    sheet[table].as_array().map_or(&[], Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(what: &str, asked_mm: f64, drawn_mm: f64) -> Value {
        json!({ "what": what, "asked_mm": asked_mm, "drawn_mm": drawn_mm })
    }

    #[test]
    fn a_pin_shorter_than_asked_for_is_no_fault_and_another_ratio_is_one() {
        let grid = |second_mm: f64| {
            [
                row(PIN_DIAMETER, 2.0, 2.032),
                row(PIN_LENGTH, 2.54, 2.032),
                row(PIN_DIAMETER, 2.0, 3.048),
                row(PIN_LENGTH, second_mm, 3.81),
            ]
        };
        let judge = |grid: &[Value]| {
            let printer =
                json!({ "pixel_mm": [0.042, 0.042], "layer_mm": 0.016, "least_pin_mm": 2.0 });
            let sheet = json!({ "printer": printer });
            let mut faults = Faults(Vec::new());
            for row in grid {
                faults.judge_length("row", row, &sheet);
            }
            faults.judge_pin_lengths(grid);
            faults.0
        };
        assert_eq!(judge(&grid(3.81)), Vec::<String>::new());
        assert_eq!(judge(&grid(3.9)).len(), 1);
        assert_eq!(
            judge(&grid(3.0)).len(),
            2,
            "longer than asked for, and of another ratio"
        );
    }
}
