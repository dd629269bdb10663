//! Whole profiles are resolved, broken ones are refused with their place.

use super::*;
use crate::printer::library::BUILT_IN;

/// A valid printer that inherits from a process; the broken ones below are made from it.
pub(super) const WHOLE: &str = r#"id = "test"
name = "Test printer"
inherits = "polyjet"
materials = ["vero-white", "pla"]
default_material = "pla"
build_volume_mm = { value = [200, 100, 150], source = "s", sure = "read" }

[numbers]
pixel_x_mm = { dpi = 600, source = "s", sure = "paper" }
pixel_y_mm = { value = 0.05, source = "s", sure = "third-party" }
layer_mm = { value = 0.03, source = "s", sure = "recalled" }

[[material]]
id = "own"
name = "Own resin"
density_g_cm3 = { value = 1.2, source = "weighed coupon", sure = "read" }
density_spread_ratio = { value = 0.01, source = "weighed coupon", sure = "read" }
"#;

pub(super) fn load(text: &str) -> Result<Printer, ProfileError> {
    resolve(
        &BUILT_IN,
        Profile {
            id: "t.toml",
            file: "t.toml",
            text,
        },
    )
}

#[test]
fn a_profile_takes_its_own_numbers_and_then_the_defaults_of_its_process() {
    let printer = load(WHOLE).unwrap();
    assert_eq!(printer.pixel_y_mm.provenance(), "third party: s");
    assert!(
        printer
            .min_wall_mm
            .provenance()
            .starts_with("read, default of polyjet: Hubs")
    );
    assert_eq!(
        printer.build_volume_mm.unwrap().value,
        [200.0, 100.0, 150.0]
    );
    let ids: Vec<&str> = printer
        .materials
        .iter()
        .map(|material| material.id.as_str())
        .collect();
    assert_eq!(
        ids,
        ["pla", "vero-white", "own"],
        "the default comes first, own materials last"
    );
}

#[test]
fn an_own_material_replaces_the_built_in_one_of_its_id() {
    let printer = load(&WHOLE.replace("\"own\"", "\"pla\"")).unwrap();
    assert_eq!(printer.materials.len(), 2);
    assert_eq!(
        printer.material(Some("pla")).unwrap().density_g_cm3.value,
        1.2
    );
}

#[test]
fn a_list_of_materials_does_not_inherit_the_default_of_another_list() {
    let text = WHOLE
        .replace("default_material = \"pla\"\n", "")
        .replace("\"vero-white\", \"pla\"", "\"pla\"");
    assert_eq!(load(&text).unwrap().material(None).unwrap().id, "pla");
}

#[test]
fn a_profile_without_a_process_must_set_every_required_value() {
    let error = load(&WHOLE.replace("inherits = \"polyjet\"\n", "")).unwrap_err();
    let ProfileError::Broken(Faults(faults)) = error else {
        panic!("{error}")
    };
    let missing = |fault: &&crate::printer::Fault| matches!(fault.problem, Problem::Missing { .. });
    assert_eq!(
        (faults.len(), faults.iter().filter(missing).count()),
        (13, 13)
    );
    assert!(
        faults[0]
            .to_string()
            .starts_with("t.toml:1:1: `min_wall_mm` is not set"),
        "{}",
        faults[0]
    );
}

#[test]
fn the_example_in_the_documentation_can_be_used() {
    let page = include_str!("../mod.rs")
        .split("//! ```")
        .nth(1)
        .unwrap()
        .trim_start_matches("toml");
    let example: String = page
        .lines()
        .map(|line| line.trim_start_matches("//!").to_owned() + "\n")
        .collect();
    let printer = load(&example).unwrap();
    assert_eq!(
        (printer.id.as_str(), printer.materials[0].id.as_str()),
        ("shop-jet", "lot-7")
    );
}

#[test]
fn all_faults_are_reported_at_once() {
    let text = WHOLE
        .replace("dpi = 600", "value = -1")
        .replace("value = 0.05", "value = 0");
    let ProfileError::Broken(Faults(faults)) = load(&text).unwrap_err() else {
        panic!()
    };
    assert_eq!(faults.len(), 2);
}

#[test]
fn a_number_without_a_source_is_refused_everywhere() {
    for (from, to) in [
        ("source = \"weighed coupon\", ", ""),
        ("source = \"s\", ", ""),
        ("150], source = \"s\"", "150]"),
    ] {
        let error = load(&WHOLE.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(error.contains("has no source"), "{error}");
    }
}

/// A folder with copies of the valid profile under these ids and with these parents.
fn folder_of(profiles: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, parent) in profiles {
        let text = WHOLE
            .replace("\"test\"", &format!("\"{name}\""))
            .replace("polyjet", parent);
        std::fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
    }
    folder
}

#[test]
fn a_profile_may_inherit_from_a_printer_and_from_a_file_in_its_folder() {
    let text = "id = \"mine\"\nname = \"Mine\"\ninherits = \"prusa-mk4\"\n[numbers]\n\
                    min_wall_mm = { value = 1.3, source = \"s\", sure = \"measured\" }\n";
    let mine = load(text).unwrap();
    assert_eq!(
        (mine.inherits.join(" "), mine.process.as_deref()),
        ("prusa-mk4 fdm".into(), Some("fdm"))
    );
    assert_eq!((mine.min_wall_mm.value, mine.pixel_x_mm.value), (1.3, 0.45));
    assert_eq!(
        mine.pixel_x_mm.process_default_of, None,
        "the machine's own number is no process default"
    );
    assert_eq!(
        mine.min_feature_mm.process_default_of.as_deref(),
        Some("fdm")
    );
    let folder = folder_of(&[("first", "formlabs-form4"), ("second", "first.toml")]);
    let second = Printer::read(&folder.path().join("second.toml")).unwrap();
    assert_eq!(second.inherits, ["first", "formlabs-form4", "sla"]);
}

#[test]
fn a_circle_of_parents_is_reported_whatever_the_spelling_of_the_paths() {
    let folder = folder_of(&[("a", "b.toml"), ("b", "c.toml"), ("c", "../NAME/a.toml")]);
    let name = folder.path().file_name().unwrap().to_str().unwrap();
    let last = folder.path().join("c.toml");
    std::fs::write(
        &last,
        std::fs::read_to_string(&last)
            .unwrap()
            .replace("NAME", name),
    )
    .unwrap();
    let error = Printer::read(&folder.path().join("a.toml"))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("c.toml:3:12: ") && error.contains("inherits from itself ("),
        "{error}"
    );
    assert_eq!(error.matches(" → ").count(), 3, "{error}");
}

#[test]
fn a_process_that_inherits_is_refused_in_its_own_file() {
    let process = "id = \"deep\"\nname = \"Deep\"\ninherits = \"polyjet\"\n";
    let processes = [Profile {
        id: "deep",
        file: "deep.toml",
        text: process,
    }];
    let library = Library {
        processes: &processes,
        ..BUILT_IN
    };
    let text = WHOLE.replace("polyjet", "deep");
    let error = resolve(
        &library,
        Profile {
            id: "t.toml",
            file: "t.toml",
            text: &text,
        },
    )
    .unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("deep.toml:3:12: the process `deep` inherits from `polyjet`"),
        "{error}"
    );
}

#[test]
fn the_hash_covers_the_profile_and_its_process() {
    let plain = load(WHOLE).unwrap().profile_sha256;
    assert_eq!(plain.len(), 64);
    assert_ne!(
        plain,
        load(&format!("{WHOLE}\n# a remark"))
            .unwrap()
            .profile_sha256
    );
    assert_ne!(
        plain,
        load(&WHOLE.replace("polyjet", "sla"))
            .unwrap()
            .profile_sha256
    );
}

proptest::proptest! {
    #[test]
    fn a_profile_damaged_anywhere_is_read_or_refused_without_a_panic(
        at in 0..WHOLE.len(),
        by in "\\PC{0,3}",
    ) {
        let damaged = format!("{}{by}{}", &WHOLE[..at], &WHOLE[(at + 1).min(WHOLE.len())..]);
        if let Err(error) = load(&damaged) {
            proptest::prop_assert!(error.to_string().contains("t.toml:"), "{error}");
        }
    }
}
