//! The checklist held against the job and against the profile of the printer that it names.

use serde_json::{Value, json};

use crate::job::Job;
use crate::printer::Printer;
use crate::sheet::Checklist;
use crate::sheet::from_run::{material_row, printer_row};

/// Returns what the checklist says otherwise than the job, or than the profile of a built-in
/// printer, a sentence each. A shop's own profile is no part of the kit.
pub(super) fn find_false_job(sheet: &Checklist, job: &Job) -> Vec<String> {
    let mut faults = Faults(Vec::new());
    let path = &job.model.path;
    let file = path
        .file_name()
        .map(|name| name.to_string_lossy().into_owned());
    faults.compare("job", &json!(sheet.job), &json!(job.name()));
    faults.compare(
        "model.file",
        &json!(sheet.model.file),
        &json!(file.unwrap_or_default()),
    );
    faults.compare(
        "model.sha256",
        &json!(sheet.model.sha256),
        &json!(job.model.sha256),
    );
    faults.compare(
        "model.repair",
        &json!(sheet.model.repair),
        &json!(job.repair),
    );
    faults.compare(
        "goal.kind",
        &json!(sheet.goal.aim.kind),
        &json!(job.goal.kind),
    );
    let asked_mm = job.wall.map(|wall| wall.mm());
    faults.compare(
        "wall.asked_mm",
        &json!(sheet.wall.asked_mm),
        &json!(asked_mm),
    );
    faults.judge_rounds(sheet, job);
    let is_known = |printer: &Printer| printer.id == job.printer.id;
    let known = Printer::all()
        .unwrap_or_default()
        .into_iter()
        .find(is_known);
    if let Some(printer) = known {
        faults.judge_printer(sheet, job, &printer);
    }
    faults.0
}

/// The faults found so far, a sentence each.
struct Faults(Vec<String>);

impl Faults {
    /// Compares a stated value with the right one, key by key.
    fn compare(&mut self, at: &str, stated: &Value, right: &Value) {
        match (stated, right) {
            (Value::Object(rows), Value::Object(found)) if rows.len() == found.len() => {
                for (key, right) in found {
                    let stated = rows.get(key).unwrap_or(&Value::Null);
                    self.compare(&format!("{at}.{key}"), stated, right);
                }
            }
            _ if stated == right => {}
            _ => self
                .0
                .push(format!("{at} is {stated} on the checklist, not {right}")),
        }
    }

    /// Compares the rounds in which the kit was sliced, and its own toolpaths.
    fn judge_rounds(&mut self, sheet: &Checklist, job: &Job) {
        let infill = sheet.infill.as_ref();
        let stated = match &sheet.laid {
            Some(laid) => (Some(laid.beyond), laid.misses_mm.as_slice()),
            None => (
                infill.and_then(|infill| infill.beyond),
                infill.map_or(&[][..], |infill| infill.misses_mm.as_slice()),
            ),
        };
        let beyond = job.sliced.last().map(|round| round.beyond);
        let misses_mm: Vec<f64> = job.sliced.iter().map(|round| round.miss_mm).collect();
        self.compare("laid.beyond", &json!(stated.0), &json!(beyond));
        let slicer_ratio = infill.and_then(|infill| infill.slicer_ratio);
        let right = job.sliced.last().and_then(|round| round.infill_ratio);
        self.compare("infill.slicer_ratio", &json!(slicer_ratio), &json!(right));
        self.compare("laid.misses_mm", &json!(stated.1), &json!(misses_mm));
        let mut own = json!(job.toolpaths);
        let plates = own.get_mut("plates").and_then(Value::as_array_mut);
        for plate in plates.into_iter().flatten() {
            let sha256 = plate.as_object_mut().and_then(|row| row.remove("sha256"));
            let file = plate["file"].as_str().unwrap_or_default();
            let at = format!("the hash of {file} when it was sliced");
            let listed = json!(sheet.files.get(file));
            self.compare(&at, &listed, &sha256.unwrap_or_default());
        }
        self.compare("toolpaths", &json!(sheet.toolpaths), &own);
    }

    fn judge_printer(&mut self, sheet: &Checklist, job: &Job, printer: &Printer) {
        let size_mm = sheet.model.size_mm.into_iter().fold(0.0, f64::max);
        let wall_mm = printer.least_wall_mm(size_mm).value;
        let row = printer_row(printer, wall_mm);
        self.compare("printer", &json!(sheet.printer), &json!(row));
        if let Ok(material) = printer.material(job.printer.material.as_deref()) {
            let row = material_row(material);
            self.compare("material", &json!(sheet.material), &json!(row));
        }
        let size_mm = printer.plate().map(|plate| plate.size_mm());
        for plate in &sheet.plates {
            let at = format!("plates[{}].size_mm", plate.file);
            self.compare(&at, &json!(plate.size_mm), &json!(size_mm));
        }
        let method = printer.cleaning_method();
        for void in &sheet.voids {
            let at = |key: &str| format!("voids[{}].{key}", void.id);
            self.compare(&at("method"), &json!(void.method), &json!(method));
            self.compare(&at("clean"), &json!(void.clean), &json!(printer.cleaning));
        }
    }
}
