//! Helpers for the tests that run the program.

#![allow(
    dead_code,
    clippy::panic,
    clippy::print_stderr,
    reason = "every test compiles its own copy of this module and uses a part of it"
)]

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// The shipped model, an ellipsoid with tilted axes. It spins as a top only when it is hollow.
pub const ELLIPSOID: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/examples/models/tilted-ellipsoid.stl"
);

/// The models beside the project. They are no part of it.
const SHARED_MODELS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models");
/// The variable that names another folder of the same content.
const SHARED_VARIABLE: &str = "EQUIPOISE_SHARED_MODELS";

/// Returns a file of the models beside the project; says that the test skips it if it is absent.
pub fn shared_model(name: &str) -> Option<PathBuf> {
    let file = shared_folder().join(name);
    if !file.is_file() {
        eprintln!("SKIPPED: there is no {}", file.display());
    }
    file.is_file().then_some(file)
}

/// Returns the folder of the models beside the project. They are no part of it.
pub fn shared_folder() -> PathBuf {
    std::env::var_os(SHARED_VARIABLE).map_or_else(|| SHARED_MODELS.into(), PathBuf::from)
}

/// The options of a quick run: a small model, and few columns for the solver.
pub const QUICK: &str = "--printer objet-connex350 --size 60mm --pitch 0.3mm";

/// A configuration of Prusa's SL1S, as its slicer exports it, without what is not needed here.
pub const SL1S: &str = "printer_technology = SLA\nprinter_model = SL1S\nbed_shape = 0x0,127x0,127x80,0x80\n\
    display_width = 128\ndisplay_height = 81\ndisplay_pixels_x = 2560\ndisplay_pixels_y = 1620\n\
    display_orientation = portrait\ndisplay_mirror_x = 1\ndisplay_mirror_y = 0\n\
    max_print_height = 150\nlayer_height = 0.05\ninitial_layer_height = 0.05\nexposure_time = 2\n\
    initial_exposure_time = 25\nfaded_layers = 10\nelefant_foot_compensation = 0\n\
    supports_enable = 0\npad_enable = 0\nsupport_object_elevation = 0\ngamma_correction = 1\n\
    relative_correction = 1,1\n";

/// The judge of a telescope's kit in Python.
const TELESCOPE_JUDGE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/judge/judge_telescope.py"
);
/// The packages that it imports.
const TELESCOPE_PACKAGES: &str = "manifold3d, numpy, scipy, trimesh, networkx";

/// Lets the Python judge look at the kit of a telescope, which must be right.
pub fn judge_telescope(kit: &Path) {
    if let Some(output) = telescope_judge_says(kit) {
        assert_exit(&output, 0);
    }
}

/// Returns what the Python judge says of the kit of a telescope, if there is a Python with its
/// packages.
pub fn telescope_judge_says(kit: &Path) -> Option<Output> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let run = |arguments: &[OsString]| {
        let mut command = std::process::Command::new(&python);
        command.args(arguments).output()
    };
    let import = run(&["-c".into(), format!("import {TELESCOPE_PACKAGES}").into()]);
    if !import.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED: no Python with {TELESCOPE_PACKAGES} here; pip install them");
        return None;
    }
    Some(run(&[TELESCOPE_JUDGE.into(), kit.into()]).unwrap())
}

/// Runs the program.
pub fn equipoise(arguments: &[&str]) -> Output {
    equipoise_in(Path::new("."), arguments)
}

/// Runs the program in a folder.
pub fn equipoise_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipoise"));
    let command = command.current_dir(folder).args(arguments);
    command.output().unwrap()
}

/// Returns the folder of Cura's definitions, which its engine needs; `None`, with a message, if
/// they or the engine are not here.
pub fn cura_definitions() -> Option<PathBuf> {
    let resources = std::env::var_os("EQUIPOISE_CURA_RESOURCES");
    let resources = resources.map_or("/usr/share/cura/resources".into(), PathBuf::from);
    let definitions = resources.join("definitions");
    if !definitions.join("fdmprinter.def.json").exists() {
        eprintln!(
            "SKIPPED: no Cura definitions here; set EQUIPOISE_CURA_RESOURCES to their folder"
        );
        return None;
    }
    let engine = std::process::Command::new("CuraEngine")
        .arg("help")
        .output();
    if engine.is_err() {
        eprintln!("SKIPPED: no CuraEngine here; apt-get install cura-engine");
        return None;
    }
    Some(definitions)
}

/// Runs `prepare` on the shipped model and prints the result as JSON.
pub fn prepare(out: &Path, options: &[&str]) -> Output {
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual, options].concat())
}

/// Runs `prepare` on the shipped model with the options of a quick run and these.
pub fn prepare_quickly(out: &Path, options: &str) -> Output {
    prepare(out, &words(&format!("{QUICK} {options}")))
}

/// Makes a kit as [`prepare_quickly`] does. It must keep its promises. Returns its checklist.
pub fn make_kit(out: &Path, options: &str) -> Value {
    let output = prepare_quickly(out, options);
    assert_exit(&output, 0);
    json(&output)
}

/// Runs `verify` on a kit; returns the exit code and everything that was printed.
pub fn verify(kit: &Path) -> (Option<i32>, String) {
    let output = equipoise(&["verify", path(kit)]);
    (output.status.code(), printed(&output))
}

/// Returns the regions of a graded kit's sheet, the outermost first.
pub fn levels(sheet: &Value) -> Vec<Value> {
    let outermost = sheet["infill"].clone();
    let inner = sheet["infill"]["inner"]
        .as_array()
        .cloned()
        .unwrap_or_default();
    std::iter::once(outermost).chain(inner).collect()
}

/// Prepares a job that is refused, and writes nothing; returns what was said.
pub fn refused(prepare: impl FnOnce(&Path) -> Output) -> String {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let output = prepare(&kit);
    assert_exit(&output, 2);
    assert!(!kit.exists());
    printed(&output)
}

/// Fails with everything that was printed unless the program ended with this code.
pub fn assert_exit(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}", printed(output));
}

/// Everything that was printed.
pub fn printed(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

/// The standard output, read as JSON.
pub fn json(output: &Output) -> Value {
    let read = serde_json::from_slice(&output.stdout);
    read.unwrap_or_else(|error| panic!("{error}: {}", printed(output)))
}

/// The checklist in a kit's folder.
pub fn checklist(kit: &Path) -> Value {
    serde_json::from_slice(&fs::read(kit.join("checklist.json")).unwrap()).unwrap()
}

/// The words of a command line without quotes.
pub fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// A path as an argument.
pub fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// Printed bytes as text.
pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The list under a key of a checklist; empty if the key is missing.
pub fn list<'a>(sheet: &'a Value, key: &str) -> &'a [Value] {
    sheet[key].as_array().map_or(&[], Vec::as_slice)
}

/// A number of a checklist by its JSON pointer.
pub fn number(sheet: &Value, pointer: &str) -> f64 {
    let found = sheet.pointer(pointer).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("{pointer} is missing"))
}

/// The sum of one number of each row.
pub fn sum(rows: &[Value], pointer: &str) -> f64 {
    rows.iter().map(|row| number(row, pointer)).sum()
}

/// The mass of the glue films on a checklist, g.
pub fn glue_g(sheet: &Value) -> f64 {
    let films = list(sheet, "joints").iter();
    films
        .filter_map(|joint| joint["glue"]["mass_g"].as_f64())
        .sum()
}

/// Every file of a folder by its path in it.
pub fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = PathBuf::from(path.file_name().unwrap());
        if path.is_dir() {
            let below = files(&path).into_iter();
            found.extend(below.map(|(file, bytes)| (name.join(file), bytes)));
        } else {
            found.insert(name, fs::read(&path).unwrap());
        }
    }
    found
}

/// Copies a folder with everything in it.
pub fn copy(from: &Path, to: &Path) {
    for (name, bytes) in files(from) {
        let target = to.join(name);
        fs::create_dir_all(target.parent().unwrap()).unwrap();
        fs::write(target, bytes).unwrap();
    }
}

/// Returns true if there is PrusaSlicer; says so if there is none.
pub fn has_slicer() -> bool {
    let is_there = std::process::Command::new("prusa-slicer")
        .arg("--help")
        .output()
        .is_ok();
    if !is_there {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
    }
    is_there
}
