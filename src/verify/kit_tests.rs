//! A kit on disk, judged from its folder: sound, changed, incomplete and hostile.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::judge_tests::{judge, sound_kit};
use super::sheet::{Findings, restate, restate_before_rounding};
use super::*;
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::io::stl;

mod kit;

use kit::{edit, failures, kit_with, seal, write_kit};

#[test]
fn a_sound_kit_passes_from_its_folder_alone() {
    assert!(kit_with(|_| ()).unwrap().passes());
}

#[test]
fn a_file_exchanged_for_another_is_found() {
    let judgement = kit_with(|kit| {
        fs::copy(kit.join("parts/P01.stl"), kit.join(HOLLOWED_FILE)).unwrap();
    });
    assert!(failures(&judgement.unwrap()).contains(&"changed files".to_owned()));
}

#[test]
fn a_part_of_the_same_shape_under_another_header_is_only_a_changed_file() {
    let judgement = kit_with(|kit| {
        let renamed = stl::encode(&sound_kit().parts[0].mesh, "another name");
        fs::write(kit.join("parts/P01.stl"), renamed).unwrap();
    });
    assert_eq!(failures(&judgement.unwrap()), ["changed files"]);
}

/// Returns every number of a value, by its JSON pointer.
fn numbers(at: &str, value: &Value) -> Vec<String> {
    match value {
        Value::Number(_) => vec![at.to_owned()],
        Value::Object(keys) => keys
            .iter()
            .flat_map(|(key, v)| numbers(&format!("{at}/{key}"), v))
            .collect(),
        Value::Array(rows) => rows
            .iter()
            .enumerate()
            .flat_map(|(i, v)| numbers(&format!("{at}/{i}"), v))
            .collect(),
        _ => Vec::new(),
    }
}

#[test]
fn numbers_of_the_checklist_that_follow_from_the_files_are_checked() {
    assert_numbers_are_checked(5);
}

#[test]
#[ignore = "long: a minute; run with -- --ignored"]
fn every_number_of_the_checklist_that_follows_from_the_files_is_checked() {
    assert_numbers_are_checked(1);
}

/// States one number in so many falsely, each alone.
fn assert_numbers_are_checked(one_in: usize) {
    let room = tempfile::tempdir().unwrap();
    write_kit(room.path());
    let whole = fs::read_to_string(room.path().join(CHECKLIST_FILE)).unwrap();
    let sheet: Value = serde_json::from_str(&whole).unwrap();
    let of_judge = |key: &String| {
        [
            "/solid",
            "/hollowed",
            "/assembly",
            "/parts",
            "/voids",
            "/checks",
            "/wall",
            "/model",
            "/material",
        ]
        .iter()
        .any(|table| key.starts_with(table))
    };
    let keys: Vec<String> = numbers("", &sheet).into_iter().filter(of_judge).collect();
    // Figures of three bodies, and the rows and fingerprints of two parts.
    assert!(keys.len() > 100, "{}", keys.len());
    for key in keys.into_iter().step_by(one_in) {
        let mut lie = sheet.clone();
        let old = lie.pointer(&key).unwrap().as_f64().unwrap();
        // A thousandth of the largest number in its row of numbers, and never less than one.
        let row = sheet.pointer(key.rsplit_once('/').unwrap().0).unwrap();
        let step = (old.abs().max(sheet::largest(row)) * 1e-3).max(1.0);
        *lie.pointer_mut(&key).unwrap() = json!(old + step);
        fs::write(room.path().join(CHECKLIST_FILE), lie.to_string()).unwrap();
        // A careful forger makes the job sheet and the list of hashes anew.
        seal(room.path());
        let judgement = verify_kit(room.path(), &Watch::silent()).unwrap();
        assert!(
            !judgement.passes(),
            "{key} may be {} instead of {old}",
            old + step
        );
    }
}

#[test]
fn a_false_number_is_reported_with_its_key_and_both_values() {
    let judgement = kit_with(|kit| {
        edit(kit, |sheet| sheet["parts"][1]["mass_g"] = json!(20.0));
        seal(kit);
    });
    let judgement = judgement.unwrap();
    assert_eq!(failures(&judgement), ["checklist"]);
    let words = judgement
        .checks
        .iter()
        .find_map(|check| check.detail.clone().filter(|_| !check.pass))
        .unwrap();
    assert!(
        words.starts_with("parts[P02].mass_g states 20.0, the files have "),
        "{words}"
    );
}

#[test]
fn a_kit_made_before_checks_had_kinds_passes_and_a_false_kind_is_reported() {
    let with_checks = |change: &dyn Fn(&mut Value)| {
        kit_with(|kit| {
            edit(kit, |sheet| {
                let rows = sheet["checks"].as_array_mut().unwrap();
                rows.iter_mut().for_each(change);
            });
            seal(kit);
        })
        .unwrap()
    };
    let old = with_checks(&|row| {
        row.as_object_mut().unwrap().remove("kind").unwrap();
    });
    assert!(old.passes());
    let wrong = with_checks(&|row| row["kind"] = json!("pins"));
    assert_eq!(failures(&wrong), ["checklist"]);
}

#[test]
fn papers_that_do_not_belong_together_are_reported_one_by_one() {
    let changed = |change: &dyn Fn(&Path)| {
        let judgement = kit_with(change).unwrap();
        assert_eq!(failures(&judgement), ["changed files"]);
        judgement
            .changes
            .iter()
            .map(FileChange::to_string)
            .collect::<Vec<_>>()
            .join("; ")
    };
    let append = |file: &'static str| {
        move |kit: &Path| {
            let text = fs::read_to_string(kit.join(file)).unwrap() + "\n";
            fs::write(kit.join(file), text).unwrap();
        }
    };
    let page = changed(&append(SHEET_FILE));
    assert_eq!(page, "job.html was changed: it has other bytes");
    let proof = changed(&append(CERTIFICATE_FILE));
    assert_eq!(proof, "certificate.html was changed: it has other bytes");
    let missing = changed(&|kit| fs::remove_file(kit.join(CERTIFICATE_FILE)).unwrap());
    assert_eq!(missing, "certificate.html is missing");
    assert_eq!(
        changed(&append(CHECKLIST_FILE))
            .matches("checklist.json was changed")
            .count(),
        1
    );
    let emptied = changed(&|kit| fs::write(kit.join(SUMS_FILE), "").unwrap());
    assert!(emptied.contains("SHA256SUMS was changed"), "{emptied}");
    let missing = changed(&|kit| fs::remove_file(kit.join(SUMS_FILE)).unwrap());
    assert_eq!(missing, "SHA256SUMS is missing");
    // The list made anew over a job sheet of another checklist.
    let other = changed(&|kit| {
        append(CHECKLIST_FILE)(kit);
        let page = fs::read(kit.join(SHEET_FILE)).unwrap();
        seal(kit);
        let list = fs::read_to_string(kit.join(SUMS_FILE)).unwrap();
        let own = sha256_hex(&[&fs::read(kit.join(SHEET_FILE)).unwrap()]);
        fs::write(kit.join(SHEET_FILE), &page).unwrap();
        fs::write(
            kit.join(SUMS_FILE),
            list.replace(&own, &sha256_hex(&[&page])),
        )
        .unwrap();
    });
    assert_eq!(other, "job.html belongs to another checklist.json");
}

#[test]
fn a_missing_part_is_named() {
    let error = kit_with(|kit| fs::remove_file(kit.join("parts/P02.stl")).unwrap()).unwrap_err();
    assert!(
        matches!(&error, VerifyError::Missing { .. })
            && error.to_string().contains("parts/P02.stl"),
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
        let error = kit_with(|kit| edit(kit, |sheet| sheet["parts"][0]["file"] = json!(outside)))
            .unwrap_err();
        assert!(matches!(error, VerifyError::Outside { .. }), "{outside}");
    }
}

#[test]
fn a_part_that_is_no_mesh_is_named() {
    let error =
        kit_with(|kit| fs::write(kit.join("parts/P01.stl"), "no mesh").unwrap()).unwrap_err();
    assert!(
        matches!(&error, VerifyError::Mesh { path, .. } if path.ends_with("parts/P01.stl")),
        "{error}"
    );
}

/// Returns the words of all changes of a kit.
fn changes(change: impl FnOnce(&Path)) -> String {
    let judgement = kit_with(change).unwrap();
    assert_eq!(failures(&judgement), ["changed files"]);
    let words = judgement.changes.iter().map(FileChange::to_string);
    words.collect::<Vec<_>>().join("; ")
}

#[test]
fn a_list_of_hashes_of_another_form_is_reported() {
    let with_list = |change: &dyn Fn(&str) -> String| {
        changes(|kit| {
            let list = fs::read_to_string(kit.join(SUMS_FILE)).unwrap();
            fs::write(kit.join(SUMS_FILE), change(&list)).unwrap();
        })
    };
    let nobody = "0".repeat(64);
    let forms: [&dyn Fn(&str) -> String; 7] = [
        &|list| list.replace('\n', "\r\n"),
        &|list| format!("{list}{nobody}  ../../etc/passwd\n"),
        &|list| format!("{list}{nobody}  absent.txt\n"),
        &|list| format!("{nobody}  parts/P01.stl\n{list}"),
        &|list| list.trim_end().to_owned(),
        &|list| format!("{list}\n"),
        &|list| list.to_uppercase(),
    ];
    for form in forms {
        assert_eq!(
            with_list(form),
            "SHA256SUMS was changed: it has other bytes"
        );
    }
}

#[test]
fn a_file_that_could_be_printed_and_is_not_on_the_list_is_reported_and_others_are_named() {
    for stranger in [
        "parts/evil_P03of03.STL",
        "plate_2.3mf",
        "x/y/z.gcode",
        "m.obj",
    ] {
        let words = changes(|kit| {
            let path = kit.join(stranger);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "solid").unwrap();
        });
        assert_eq!(
            words,
            format!("{stranger} does not belong to the kit: it is not on its list")
        );
    }
    let judgement = kit_with(|kit| fs::write(kit.join("README.txt"), "hello").unwrap()).unwrap();
    assert!(judgement.passes());
    assert_eq!(judgement.unlisted, ["README.txt"]);
}

#[cfg(unix)]
#[test]
fn a_link_is_no_file_of_a_kit() {
    let words = changes(|kit| {
        let outside = kit
            .parent()
            .unwrap()
            .join(kit.file_name().unwrap())
            .join("../moved.stl");
        fs::rename(kit.join("parts/P01.stl"), &outside).unwrap();
        std::os::unix::fs::symlink(&outside, kit.join("parts/P01.stl")).unwrap();
    });
    assert_eq!(
        words,
        "parts/P01.stl is a link: the kit must hold the file itself"
    );
}

#[test]
fn a_damaged_checklist_of_a_listed_kit_is_a_change_and_one_without_a_list_is_no_kit() {
    let named = |change: &dyn Fn(&Path)| {
        let room = tempfile::tempdir().unwrap();
        write_kit(room.path());
        change(room.path());
        let error = verify_kit(room.path(), &Watch::silent()).unwrap_err();
        let changes = error.changes(room.path());
        changes
            .iter()
            .map(FileChange::to_string)
            .collect::<Vec<_>>()
    };
    let checklist = |kit: &Path| kit.join(CHECKLIST_FILE);
    let missing = named(&|kit| fs::remove_file(checklist(kit)).unwrap());
    assert_eq!(missing, ["checklist.json is missing"]);
    let folder = named(&|kit| {
        fs::remove_file(checklist(kit)).unwrap();
        fs::create_dir(checklist(kit)).unwrap();
    });
    assert_eq!(folder, ["checklist.json is missing"]);
    for bytes in ["", "{", "{\"schema\": 2}"] {
        let damaged = named(&|kit| fs::write(checklist(kit), bytes).unwrap());
        assert_eq!(damaged, ["checklist.json was changed: it has other bytes"]);
    }
    let no_kit = named(&|kit| {
        fs::remove_file(checklist(kit)).unwrap();
        fs::remove_file(kit.join(SUMS_FILE)).unwrap();
    });
    assert_eq!(no_kit, [""; 0]);
}

#[test]
fn a_folder_in_the_place_of_a_file_is_a_missing_file() {
    for file in ["parts/P01.stl", HOLLOWED_FILE, SHEET_FILE, SUMS_FILE] {
        let room = tempfile::tempdir().unwrap();
        write_kit(room.path());
        fs::remove_file(room.path().join(file)).unwrap();
        fs::create_dir(room.path().join(file)).unwrap();
        let judged = verify_kit(room.path(), &Watch::silent());
        let changes = judged.map_or_else(|error| error.changes(room.path()), |kit| kit.changes);
        assert!(changes.iter().any(|change| change.file == file), "{file}");
    }
}
