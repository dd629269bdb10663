//! The sound kit on disk, and changes of it.

use super::*;
use crate::mesh::foot_area_mm2;

/// Writes the sound kit of the judge's tests with its papers. The checklist has only the keys that
/// the judge reads.
pub(super) fn write_kit(folder: &Path) {
    let evidence = sound_kit();
    let hollowed = stl::encode(&evidence.hollowed, "hollowed");
    fs::create_dir_all(folder.join("parts")).unwrap();
    fs::write(folder.join(HOLLOWED_FILE), &hollowed).unwrap();
    let parts: Vec<Value> = evidence
        .parts
        .iter()
        .map(|part| part_json(folder, part))
        .collect();
    let mut sheet = json!({
        "schema": SCHEMA,
        "printer": { "build_volume_mm": null, "minimum_wall_mm": 1.0 },
        "material": { "density_g_cm3": 1.2 },
        "goal": { "kind": "top", "origin_mm": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, 1.0], "objective": "critical_speed" },
        "wall": { "required_mm": 3.0 },
        "cuts": [{ "id": "C1", "point_mm": [0.0, 0.0, 16.0], "normal": [0.0, 0.0, 1.0] }],
        "joints": [{ "id": "J1", "cut": "C1", "parts": ["P01", "P02"], "clearance_mm": 0.1, "area_mm2": 564.0 }],
        "parts": parts,
        "voids": [{ "id": "V1" }],
        "files": { HOLLOWED_FILE: sha256_hex(&[&hollowed]) },
    });
    // As the program does, the checklist states the results.
    let read = Evidence {
        promise: serde_json::from_value(sheet.clone()).unwrap(),
        ..evidence
    };
    let judgement = judge(&read);
    let findings = Findings::new(&read, &judgement);
    fill_in(&mut sheet, restate(&Value::Null, &findings));
    fill_in(&mut sheet, restate_before_rounding(&findings));
    fs::write(folder.join(CHECKLIST_FILE), sheet.to_string()).unwrap();
    seal(folder);
}

/// Adds the keys of another value to a value, row by row.
fn fill_in(sheet: &mut Value, with: Value) {
    match (sheet, with) {
        (Value::Object(sheet), Value::Object(with)) => {
            with.into_iter()
                .for_each(|(key, value)| fill_in(sheet.entry(key).or_insert(Value::Null), value));
        }
        (Value::Array(sheet), Value::Array(with))
            if !sheet.is_empty() && with.iter().any(Value::is_object) =>
        {
            sheet
                .iter_mut()
                .zip(with)
                .for_each(|(sheet, value)| fill_in(sheet, value));
        }
        (sheet, with) => *sheet = with,
    }
}

/// Writes the job sheet and the list of hashes for the checklist as it is.
pub(super) fn seal(folder: &Path) {
    let json = fs::read(folder.join(CHECKLIST_FILE)).unwrap();
    let sha256 = sha256_hex(&[&json]);
    fs::write(folder.join(SHEET_FILE), format!("made for {sha256}")).unwrap();
    fs::write(folder.join(CERTIFICATE_FILE), format!("proof of {sha256}")).unwrap();
    let sheet: Value = serde_json::from_slice(&json).unwrap();
    let mut files: Vec<String> = sheet["files"]
        .as_object()
        .unwrap()
        .keys()
        .cloned()
        .collect();
    files.extend([CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE].map(str::to_owned));
    let bytes: Vec<Vec<u8>> = files
        .iter()
        .map(|file| fs::read(folder.join(file)).unwrap())
        .collect();
    let list = sums(
        files
            .iter()
            .map(String::as_str)
            .zip(bytes.iter().map(Vec::as_slice)),
    );
    fs::write(folder.join(SUMS_FILE), list).unwrap();
}

fn part_json(folder: &Path, part: &PartEvidence) -> Value {
    let (bytes, file) = (
        stl::encode(&part.mesh, &part.id),
        format!("parts/{}.stl", part.id),
    );
    fs::write(folder.join(&file), &bytes).unwrap();
    let read = stl::decode(&bytes).unwrap();
    json!({
        "id": part.id,
        "file": file,
        "sha256": sha256_hex(&[&bytes]),
        "fingerprint": Fingerprint::of(&read),
        "print_from_model": part.pose,
        "support": { "foot_mm2": foot_area_mm2(&read) },
    })
}

/// Changes the checklist of a kit.
pub(super) fn edit(folder: &Path, change: impl FnOnce(&mut Value)) {
    let path = folder.join(CHECKLIST_FILE);
    let mut sheet: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    change(&mut sheet);
    fs::write(path, sheet.to_string()).unwrap();
}

/// Judges the sound kit after a change of its folder.
pub(super) fn kit_with(change: impl FnOnce(&Path)) -> Result<Judgement, VerifyError> {
    let room = tempfile::tempdir().unwrap();
    write_kit(room.path());
    change(room.path());
    verify_kit(room.path(), &Watch::silent())
}

pub(super) fn failures(judgement: &Judgement) -> Vec<String> {
    judgement
        .checks
        .iter()
        .filter(|check| !check.pass)
        .map(|check| check.kind.to_string())
        .collect()
}
