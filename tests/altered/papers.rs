//! Papers that a forger wrote, with every hash made anew.

use equipoise::verify::CheckKind;
use serde_json::json;

use super::kits::{Kit, Room, Said, kits};
use super::seal;
use crate::common::{equipoise, path, printed};

/// Asserts that the papers of a kit, changed by the forger, break their promise.
fn assert_papers_fail(change: impl Fn(&mut Kit)) {
    let mut kit = kits()[0].clone();
    change(&mut kit);
    seal::renew_checklist(&mut kit);
    match Room::new().judge(&kit) {
        Said::Broken(kinds) => assert!(kinds.contains(&CheckKind::Papers), "{kinds:?}"),
        said => panic!("{said:?}"),
    }
}

fn replace(kit: &mut Kit, file: &str, [from, to]: [&str; 2]) {
    let text = String::from_utf8(kit.files[file].clone()).unwrap();
    assert!(text.contains(from), "{file} has no {from}");
    kit.files
        .insert(file.to_owned(), text.replace(from, to).into_bytes());
}

#[test]
fn a_number_on_the_sheet_that_the_checklist_has_not_is_reported_though_its_hash_was_renewed() {
    assert_papers_fail(|kit| replace(kit, "job.html", ["rpm", "rpn"]));
    assert_papers_fail(|kit| replace(kit, "certificate.html", ["rpm", "rpn"]));
    assert_papers_fail(|kit| replace(kit, "pictures/cut-C1.svg", ["mm", "cm"]));
}

#[test]
fn a_sheet_that_is_nothing_but_the_hash_of_the_checklist_is_reported() {
    assert_papers_fail(|kit| {
        let list = String::from_utf8(kit.files["SHA256SUMS"].clone()).unwrap();
        let hash = list
            .lines()
            .find_map(|line| line.strip_suffix("  checklist.json"));
        let hash = hash.unwrap().as_bytes().to_vec();
        kit.files.insert("job.html".to_owned(), hash);
    });
}

#[test]
fn pins_of_another_place_in_the_file_to_edit_are_reported() {
    assert_papers_fail(|kit| {
        replace(
            kit,
            "cuts.toml",
            ["[[pins]]\nid = \"N1\"", "[[pins]]\nid = \"N9\""],
        )
    });
    assert_papers_fail(|kit| replace(kit, "job.toml", ["kind = \"top\"", "kind = \"yoyo\""]));
}

#[test]
fn a_kit_of_another_version_has_its_masses_read_back_from_its_sheet() {
    let with_version = |change: &dyn Fn(&mut Kit)| {
        let mut kit = kits()[0].clone();
        let mut sheet = kit.sheet();
        sheet["tool"]["version"] = json!("0.0.9");
        kit.set_sheet(&sheet);
        change(&mut kit);
        seal::renew_checklist(&mut kit);
        Room::new().judge(&kit)
    };
    let kept = with_version(&|_| ());
    assert!(matches!(kept, Said::Kept), "{kept:?}");
    let said = with_version(&|kit| replace(kit, "job.html", ["\u{a0}g", "\u{a0}kg"]));
    assert!(
        matches!(&said, Said::Broken(kinds) if *kinds == [CheckKind::Papers]),
        "{said:?}"
    );
}

#[test]
fn a_bound_that_was_forged_with_all_papers_is_named_by_making_the_kit_again() {
    let (mut kit, mut room) = (kits()[0].clone(), Room::new());
    let verify = |room: &Room| {
        let output = equipoise(&["verify", path(&room.path()), "--replay"]);
        (output.status.code(), printed(&output))
    };
    room.lay_out(&kit);
    let (code, said) = verify(&room);
    assert_eq!(code, Some(0), "{said}");
    let mut sheet = kit.sheet();
    for key in ["value", "bound"] {
        let stated = &mut sheet["certificate"][key];
        *stated = json!(stated.as_f64().unwrap() * 0.9);
    }
    kit.set_sheet(&sheet);
    assert!(seal::print_anew(&mut kit, &mut room).is_some());
    room.lay_out(&kit);
    let (code, said) = verify(&room);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("made again from its job"), "{said}");
}
