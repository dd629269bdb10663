//! What tests that run the program share.

#![allow(
    dead_code,
    reason = "every test compiles its own copy of this module and uses a part of it"
)]

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// The shipped model, an ellipsoid that leans in its axes.
pub const ELLIPSOID: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/examples/models/tilted-ellipsoid.stl"
);

/// The program run to its end.
pub fn equipoise(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args(arguments)
        .output()
        .unwrap()
}

/// Prepares the shipped model small and coarse, which is quick; the exit code, and what is printed
/// as JSON.
pub fn prepared(out: &Path, wall: &str, goal: &[&str]) -> (Option<i32>, Value) {
    let usual = [
        "--json",
        "prepare",
        ELLIPSOID,
        "--printer",
        "objet-connex350",
        "--size",
        "60mm",
    ];
    let coarse = [
        "--wall",
        wall,
        "--pitch",
        "0.3mm",
        "--out",
        out.to_str().unwrap(),
    ];
    let output = equipoise(&[&usual[..], &coarse[..], goal].concat());
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (
        output.status.code(),
        serde_json::from_str(&printed).unwrap_or_else(|_| panic!("{printed}{said}")),
    )
}

/// The mass of the films of glue on a checklist, g.
pub fn glue_g(sheet: &Value) -> f64 {
    let joints = sheet["joints"].as_array().unwrap().iter();
    joints
        .filter_map(|joint| joint["glue"]["mass_g"].as_f64())
        .sum()
}

/// A number of a checklist by its path in it.
pub fn number(sheet: &Value, path: &str) -> f64 {
    sheet
        .pointer(path)
        .and_then(Value::as_f64)
        .unwrap_or_else(|| panic!("{path} is missing"))
}
