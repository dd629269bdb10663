//! The program as a user runs it: kits, their verdicts, replay, and the same bytes on any number of
//! threads.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;

/// The shipped model: filled solid it cannot spin.
const ELLIPSOID: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/examples/models/tilted-ellipsoid.stl"
);

fn equipoise(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Prepares the shipped model as a small top, which is quick; the pitch keeps the columns few.
fn prepare_top(out: &Path, more: &[&str]) -> Output {
    let out = out.to_str().unwrap();
    let usual = [
        "prepare",
        ELLIPSOID,
        "--printer",
        "objet-connex350",
        "--goal",
        "top",
        "--size",
        "60mm",
    ];
    let finer = ["--wall", "1.5mm", "--pitch", "0.3mm", "--out", out];
    equipoise(&[&usual[..], &finer[..], more].concat())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Every file of a folder by its path in it.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path
                    .strip_prefix(folder)
                    .unwrap()
                    .to_string_lossy()
                    .into_owned();
                found.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    found
}

#[test]
fn a_top_is_the_same_bytes_on_one_thread_and_two_and_when_it_is_replayed() {
    let folder = tempfile::tempdir().unwrap();
    let [one, two, again] = ["one", "two", "again"].map(|name| folder.path().join(name));
    let output = prepare_top(&one, &["--threads", "1"]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}{}",
        text(&output.stdout),
        text(&output.stderr)
    );
    let said = text(&output.stdout);
    assert!(
        said.contains("Spins upright from") && said.contains("promises kept"),
        "{said}"
    );
    assert!(
        said.lines().count() <= 10 + said.matches("warning: ").count(),
        "{said}"
    );
    let kit = files(&one);
    for file in [
        "checklist.html",
        "checklist.json",
        "job.toml",
        "hollowed.stl",
    ] {
        assert!(kit.contains_key(file), "{file} is missing");
    }
    assert_eq!(
        prepare_top(&two, &["--threads", "2"]).status.code(),
        Some(0)
    );
    let job = one.join("job.toml");
    let replay = equipoise(&[
        "-q",
        "prepare",
        "--job",
        job.to_str().unwrap(),
        "--out",
        again.to_str().unwrap(),
    ]);
    assert_eq!(replay.status.code(), Some(0), "{}", text(&replay.stderr));
    for other in [files(&two), files(&again)] {
        let differing: Vec<&String> = kit
            .keys()
            .filter(|name| other.get(*name) != kit.get(*name))
            .collect();
        assert!(
            differing.is_empty() && other.len() == kit.len(),
            "these differ: {differing:?}"
        );
    }
    a_written_kit_verifies_until_a_part_is_changed(&one);
    an_existing_kit_is_replaced_only_with_force(&one);
}

fn a_written_kit_verifies_until_a_part_is_changed(kit: &Path) {
    let kit_name = kit.to_str().unwrap();
    assert_eq!(equipoise(&["verify", kit_name]).status.code(), Some(0));
    let part = files(kit)
        .into_keys()
        .find(|name| name.starts_with("parts/"))
        .unwrap();
    let mut bytes = fs::read(kit.join(&part)).unwrap();
    let last = bytes.len() - 20;
    bytes[last] ^= 0x10;
    fs::write(kit.join(&part), bytes).unwrap();
    let changed = equipoise(&["verify", kit_name]);
    assert_ne!(changed.status.code(), Some(0), "{}", text(&changed.stdout));
}

fn an_existing_kit_is_replaced_only_with_force(kit: &Path) {
    let before = files(kit);
    let refused = prepare_top(kit, &[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        text(&refused.stderr).contains("--force"),
        "{}",
        text(&refused.stderr)
    );
    assert_eq!(files(kit), before);
    assert_eq!(prepare_top(kit, &["--force"]).status.code(), Some(0));
    assert_ne!(files(kit), before);
}

/// At so coarse a pitch there is one level of columns only, whose proof must count as that of finer
/// ones does.
#[test]
fn an_impossible_goal_is_proved_on_the_coarsest_columns_too() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("kit");
    let usual = [
        "prepare",
        ELLIPSOID,
        "--printer",
        "objet-connex350",
        "--goal",
        "top",
        "--size",
        "60mm",
    ];
    let coarse = [
        "--wall",
        "12mm",
        "--pitch",
        "2mm",
        "--out",
        out.to_str().unwrap(),
    ];
    let output = equipoise(&[&usual[..], &coarse[..]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("Impossible") && !out.exists());
}

#[test]
fn an_impossible_goal_is_an_answer_with_the_reason_and_remedies_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("kit");
    // What a wall of 12 mm leaves to be emptied is too little to bring the centre of mass over the
    // contact.
    let usual = [
        "prepare",
        ELLIPSOID,
        "--printer",
        "objet-connex350",
        "--goal",
        "top",
        "--size",
        "60mm",
    ];
    let thick = [
        "--wall",
        "12mm",
        "--pitch",
        "0.3mm",
        "--out",
        out.to_str().unwrap(),
    ];
    let output = equipoise(&[&usual[..], &thick[..]].concat());
    let said = text(&output.stdout);
    assert_eq!(
        output.status.code(),
        Some(1),
        "{said}{}",
        text(&output.stderr)
    );
    assert!(
        said.contains("Impossible") && said.contains("remedy"),
        "{said}"
    );
    assert!(!out.exists());
    let quiet = equipoise(&[&["-q"], &usual[..], &thick[..]].concat());
    assert_eq!(
        (text(&quiet.stderr), quiet.stdout.len(), quiet.status.code()),
        (said, 0, Some(1))
    );
}

#[test]
fn the_cuts_of_a_kit_can_be_edited_and_given_back() {
    let folder = tempfile::tempdir().unwrap();
    let [kit, moved, cuts] = ["kit", "moved", "mine.toml"].map(|name| folder.path().join(name));
    assert_eq!(prepare_top(&kit, &[]).status.code(), Some(0));
    let plan = text(&fs::read(kit.join("cuts.toml")).unwrap());
    assert!(
        plan.contains("[[cuts]]") && plan.contains("[[pins]]"),
        "{plan}"
    );
    // A person moves the cut by 2 mm along its normal, names it, and lets the pins be placed anew.
    let order: toml::Table = toml::from_str(&plan).unwrap();
    let numbers = |key: &str| -> Vec<f64> { order["cuts"][0][key].clone().try_into().unwrap() };
    let (point, normal) = (numbers("point_mm"), numbers("normal"));
    let point: Vec<f64> = point
        .iter()
        .zip(&normal)
        .map(|(p, n)| p + 2.0 * n)
        .collect();
    let mine = format!("[[cuts]]\nid = \"waist\"\npoint_mm = {point:?}\nnormal = {normal:?}\n");
    fs::write(&cuts, &mine).unwrap();
    let output = prepare_top(&moved, &["--cut", cuts.to_str().unwrap()]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}{}",
        text(&output.stdout),
        text(&output.stderr)
    );
    let written = text(&fs::read(moved.join("cuts.toml")).unwrap());
    assert!(
        written.contains("\"waist\"") && written.contains("[[pins]]"),
        "{written}"
    );
    let job = text(&fs::read(moved.join("job.toml")).unwrap());
    assert!(
        job.contains("[[plan.cuts]]"),
        "the job replays without the file: {job}"
    );
    fs::write(&cuts, mine.replace("normal", "nromal")).unwrap();
    let refused = prepare_top(
        &folder.path().join("none"),
        &["--cut", cuts.to_str().unwrap()],
    );
    assert_eq!(refused.status.code(), Some(2));
    assert!(
        text(&refused.stderr).contains("mine.toml:4:1: unknown field `nromal`"),
        "{}",
        text(&refused.stderr)
    );
}
