//! The program as a user runs it: kits, their verdicts, replay, and the same bytes on any number of
//! threads.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

use common::{
    ELLIPSOID, QUICK, assert_exit, copy, equipoise, equipoise_in, files, path, printed, text,
    verify, words,
};

/// Prepares the shipped model as a small top, without JSON.
fn prepare_top(out: &Path, options: &[&str]) -> Output {
    prepare_top_of(ELLIPSOID, out, options)
}

/// Prepares a model as a small top.
fn prepare_top_of(model: &str, out: &Path, options: &[&str]) -> Output {
    let usual = format!("{QUICK} --goal top --up z --wall 1.5mm");
    let start = ["prepare", model, "--out", path(out)];
    equipoise(&[&start[..], &words(&usual), options].concat())
}

/// A kit made on one thread, and what was printed meanwhile. It is made once and never changed.
fn kit() -> &'static (PathBuf, String) {
    static KIT: OnceLock<(PathBuf, String)> = OnceLock::new();
    KIT.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        let output = prepare_top(&kit, &["--threads", "1"]);
        assert_exit(&output, 0);
        (kit, text(&output.stdout))
    })
}

/// Copies the kit so that a test may change it.
fn copy_kit(folder: &Path) -> PathBuf {
    let copied = folder.join("kit");
    copy(&kit().0, &copied);
    copied
}

fn assert_same_files(one: &Path, other: &Path) {
    let [one, other] = [one, other].map(files);
    let differs = |name: &&PathBuf| one.get(*name) != other.get(*name);
    let differing: Vec<&PathBuf> = one.keys().chain(other.keys()).filter(differs).collect();
    assert!(differing.is_empty(), "these differ: {differing:?}");
}

#[test]
fn the_summary_states_the_promise_in_ten_lines() {
    let (kit, said) = kit();
    let expected = ["Spins upright from", "promises kept"];
    assert!(expected.iter().all(|words| said.contains(words)), "{said}");
    let most = 10 + said.matches("warning: ").count();
    assert!(said.lines().count() <= most, "{said}");
    for file in words("job.html checklist.json job.toml hollowed.stl") {
        assert!(kit.join(file).is_file(), "{file} is missing");
    }
}

#[test]
fn a_replayed_job_makes_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (job, again) = (kit().0.join("job.toml"), folder.path().join("again"));
    let replay = ["-q", "prepare", "--job", path(&job), "--out", path(&again)];
    assert_exit(&equipoise(&replay), 0);
    assert_same_files(&kit().0, &again);
}

#[test]
fn a_job_is_replayed_elsewhere_with_the_model_of_its_kit() {
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_kit(folder.path());
    // The model's name leads nowhere from here, but its copy lies in the kit.
    let job = fs::read_to_string(kit.join("job.toml")).unwrap();
    assert!(job.contains("path = \"tilted-ellipsoid.stl\""), "{job}");
    let replay = ["-q", "prepare", "--job", "kit/job.toml", "--out", "again"];
    assert_exit(&equipoise_in(folder.path(), &replay), 0);
    assert_same_files(&kit, &folder.path().join("again"));
}

#[test]
fn a_kit_has_the_same_bytes_whatever_path_its_model_is_typed_by() {
    let folder = tempfile::tempdir().unwrap();
    let (lies, out) = (folder.path().join("inbox"), folder.path().join("top"));
    fs::create_dir(&lies).unwrap();
    let model = lies.join("tilted-ellipsoid.stl");
    fs::copy(ELLIPSOID, &model).unwrap();
    assert_exit(&prepare_top_of(path(&model), &out, &[]), 0);
    assert_same_files(&kit().0, &out);
    let told = fs::read_to_string(out.join("job.toml")).unwrap();
    assert!(!told.contains("inbox"), "{told}");
}

#[test]
fn a_kit_verifies_until_a_part_is_changed() {
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_kit(folder.path());
    assert_eq!(verify(&kit).0, Some(0));
    let is_part = |name: &&PathBuf| name.starts_with("parts");
    let part = kit.join(files(&kit).keys().find(is_part).unwrap());
    let mut bytes = fs::read(&part).unwrap();
    let near_end = bytes.len() - 20;
    bytes[near_end] ^= 0x10;
    fs::write(&part, bytes).unwrap();
    let (code, said) = verify(&kit);
    assert_ne!(code, Some(0), "{said}");
}

#[test]
fn an_existing_kit_is_replaced_only_with_force_and_two_threads_make_the_same_bytes_as_one() {
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_kit(folder.path());
    fs::write(kit.join("job.toml"), "changed").unwrap();
    let before = files(&kit);
    let refused = prepare_top(&kit, &[]);
    assert_exit(&refused, 2);
    let said = text(&refused.stderr);
    assert!(said.contains("--force"), "{said}");
    assert_eq!(files(&kit), before);
    let on_two = ["--force", "--threads", "2"];
    assert_exit(&prepare_top(&kit, &on_two), 0);
    assert_same_files(&self::kit().0, &kit);
}

/// Asks for a wall of 12 mm. Too little can then be emptied to move the centre of mass over the
/// contact point.
fn prepare_impossible(out: &Path, pitch: &str, more: &[&str]) -> Output {
    let sizes = "--goal top --up z --printer objet-connex350 --size 60mm --wall 12mm --pitch";
    let start = [more, &["prepare", ELLIPSOID, "--out", path(out)]].concat();
    equipoise(&[&start[..], &words(sizes), &[pitch]].concat())
}

/// Such a coarse pitch leaves the solver one level of columns. Its proof must count as much as that
/// of finer levels.
#[test]
fn an_impossible_goal_is_proved_on_the_coarsest_columns_too() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let output = prepare_impossible(&kit, "2mm", &[]);
    assert_exit(&output, 1);
    assert!(text(&output.stdout).contains("Impossible") && !kit.exists());
}

#[test]
fn an_impossible_goal_gives_the_reason_and_remedies_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let output = prepare_impossible(&kit, "0.3mm", &[]);
    assert_exit(&output, 1);
    assert!(!kit.exists());
    let said = text(&output.stdout);
    let expected = ["Impossible", "remedy"];
    assert!(expected.iter().all(|words| said.contains(words)), "{said}");
    // Quiet, it says the same on the standard error.
    let quiet = prepare_impossible(&kit, "0.3mm", &["-q"]);
    assert_exit(&quiet, 1);
    assert_eq!((printed(&quiet), quiet.stdout.len()), (said, 0));
}

#[test]
fn edited_cuts_can_be_given_back() {
    let plan = fs::read_to_string(kit().0.join("cuts.toml")).unwrap();
    assert!(
        plan.contains("[[cuts]]") && plan.contains("[[pins]]"),
        "{plan}"
    );
    // A person moves the cut by 2 mm along its normal and names it. New pins are to be placed.
    let order: toml::Table = toml::from_str(&plan).unwrap();
    let numbers = |key: &str| -> Vec<f64> { order["cuts"][0][key].clone().try_into().unwrap() };
    let (point, normal) = (numbers("point_mm"), numbers("normal"));
    let moved = point.iter().zip(&normal).map(|(p, n)| p + 2.0 * n);
    let point: Vec<f64> = moved.collect();
    let mine = format!("[[cuts]]\nid = \"waist\"\npoint_mm = {point:?}\nnormal = {normal:?}\n");

    let folder = tempfile::tempdir().unwrap();
    let [cuts, kit] = ["mine.toml", "moved"].map(|name| folder.path().join(name));
    fs::write(&cuts, &mine).unwrap();
    assert_exit(&prepare_top(&kit, &["--cut", path(&cuts)]), 0);
    let written = fs::read_to_string(kit.join("cuts.toml")).unwrap();
    assert!(
        written.contains("\"waist\"") && written.contains("[[pins]]"),
        "{written}"
    );
    let job = fs::read_to_string(kit.join("job.toml")).unwrap();
    assert!(
        job.contains("[[plan.cuts]]"),
        "the job needs the file: {job}"
    );
}

#[test]
fn a_misspelt_field_of_a_cut_is_refused_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let cuts = folder.path().join("mine.toml");
    let text = "[[cuts]]\nid = \"waist\"\npoint_mm = [0, 0, 0]\nnromal = [0, 0, 1]\n";
    fs::write(&cuts, text).unwrap();
    let refused = prepare_top(&folder.path().join("none"), &["--cut", path(&cuts)]);
    assert_exit(&refused, 2);
    let said = printed(&refused);
    assert!(
        said.contains("mine.toml:4:1: unknown field `nromal`"),
        "{said}"
    );
}
