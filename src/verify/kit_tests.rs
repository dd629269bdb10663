//! A kit on disk, judged from its folder: sound, changed, incomplete and hostile.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::judge_tests::sound;
use super::*;
use crate::digest::sha256_hex;
use crate::io::stl;

/// Writes the sound kit of the judge's tests with a checklist of no more than the judge reads.
fn write_kit(folder: &Path) {
    let evidence = sound();
    let hollowed = stl::encode(&evidence.hollowed, "hollowed");
    fs::create_dir_all(folder.join("parts")).unwrap();
    fs::write(folder.join(HOLLOWED_FILE), &hollowed).unwrap();
    let parts: Vec<Value> = evidence.parts.iter().map(|part| part_json(folder, part)).collect();
    let sheet = json!({
        "schema": SCHEMA,
        "printer": { "build_volume_mm": null, "minimum_wall_mm": 1.0 },
        "material": { "density_g_cm3": 1.2 },
        "goal": { "kind": "top", "origin_mm": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, 1.0], "objective": "any" },
        "wall": { "required_mm": 3.0 },
        "parts": parts,
        "assembly": judge(&evidence).assembly,
        "files": { HOLLOWED_FILE: sha256_hex(&[&hollowed]) },
    });
    fs::write(folder.join(CHECKLIST_FILE), sheet.to_string()).unwrap();
}

fn part_json(folder: &Path, part: &PartEvidence) -> Value {
    let (bytes, file) = (stl::encode(&part.mesh, &part.id), format!("parts/{}.stl", part.id));
    fs::write(folder.join(&file), &bytes).unwrap();
    let fingerprint = Fingerprint::of(&stl::decode(&bytes).unwrap());
    json!({ "id": part.id, "file": file, "sha256": sha256_hex(&[&bytes]), "fingerprint": fingerprint, "print_from_model": part.pose })
}

/// Changes the checklist of a kit.
fn edit(folder: &Path, change: impl FnOnce(&mut Value)) {
    let path = folder.join(CHECKLIST_FILE);
    let mut sheet: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    change(&mut sheet);
    fs::write(path, sheet.to_string()).unwrap();
}

/// The sound kit after a change of its folder.
fn kit_with(change: impl FnOnce(&Path)) -> Result<Judgement, VerifyError> {
    let room = tempfile::tempdir().unwrap();
    write_kit(room.path());
    change(room.path());
    verify_kit(room.path())
}

fn failures(judgement: &Judgement) -> Vec<&str> {
    judgement.checks.iter().filter(|check| !check.pass).map(|check| check.name.as_str()).collect()
}

#[test]
fn a_sound_kit_passes_from_its_folder_alone() {
    assert!(kit_with(|_| ()).unwrap().passes());
}

#[test]
fn a_file_exchanged_for_another_is_found() {
    let judgement = kit_with(|kit| {
        fs::copy(kit.join("parts/P01.stl"), kit.join(HOLLOWED_FILE)).unwrap();
    });
    assert!(failures(&judgement.unwrap()).contains(&"changed files"));
}

#[test]
fn a_part_with_the_same_shape_under_another_header_is_a_changed_file_and_nothing_else() {
    let judgement = kit_with(|kit| {
        let renamed = stl::encode(&sound().parts[0].mesh, "another name");
        fs::write(kit.join("parts/P01.stl"), renamed).unwrap();
    });
    assert_eq!(failures(&judgement.unwrap()), ["changed files"]);
}

#[test]
fn a_checklist_that_lies_about_the_mass_is_found() {
    let judgement = kit_with(|kit| edit(kit, |sheet| sheet["assembly"]["mass_g"] = json!(20.0)));
    assert_eq!(failures(&judgement.unwrap()), ["checklist"]);
}

#[test]
fn a_missing_part_is_named() {
    let error = kit_with(|kit| fs::remove_file(kit.join("parts/P02.stl")).unwrap()).unwrap_err();
    assert!(
        matches!(&error, VerifyError::Missing { .. }) && error.to_string().contains("parts/P02.stl"),
        "{error}"
    );
}

#[test]
fn a_folder_without_a_checklist_is_no_kit() {
    let error = kit_with(|kit| fs::remove_file(kit.join(CHECKLIST_FILE)).unwrap()).unwrap_err();
    assert!(matches!(error, VerifyError::File { .. }));
}

#[test]
fn a_checklist_of_another_schema_or_of_nonsense_is_refused() {
    let newer = kit_with(|kit| edit(kit, |sheet| sheet["schema"] = json!(2))).unwrap_err();
    assert!(matches!(newer, VerifyError::Schema { found: 2, .. }));
    let nonsense = kit_with(|kit| fs::write(kit.join(CHECKLIST_FILE), "{").unwrap()).unwrap_err();
    assert!(matches!(nonsense, VerifyError::Checklist { .. }));
}

#[test]
fn a_checklist_that_points_outside_its_kit_is_refused() {
    for outside in ["../secret.stl", "/etc/hostname", "parts/../../x", ""] {
        let error =
            kit_with(|kit| edit(kit, |sheet| sheet["parts"][0]["file"] = json!(outside))).unwrap_err();
        assert!(matches!(error, VerifyError::Outside { .. }), "{outside}");
    }
}

#[test]
fn a_part_that_is_no_mesh_is_named() {
    let error = kit_with(|kit| fs::write(kit.join("parts/P01.stl"), "no mesh").unwrap()).unwrap_err();
    assert!(matches!(&error, VerifyError::Mesh { path, .. } if path.ends_with("parts/P01.stl")), "{error}");
}
