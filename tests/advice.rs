//! What is advised, as a user types it: remedies that give a kit, the best axis, and what a model
//! could become.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

/// The shipped model, an ellipsoid that leans in its axes.
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

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Runs `prepare` on the shipped model, small and coarse, which is quick.
fn prepare(out: &Path, more: &[&str]) -> Output {
    let usual = [
        "--json",
        "prepare",
        ELLIPSOID,
        "--printer",
        "objet-connex350",
        "--size",
        "60mm",
    ];
    let coarse = ["--pitch", "0.3mm", "--out", out.to_str().unwrap()];
    equipoise(&[&usual[..], &coarse[..], more].concat())
}

fn json(output: &Output) -> Value {
    let (said, failed) = (text(&output.stdout), text(&output.stderr));
    serde_json::from_str(&said).unwrap_or_else(|_| panic!("{said}{failed}"))
}

/// A wall of 12 mm leaves too little to bring the centre of mass over the contact.
#[test]
fn a_wall_that_is_advised_gives_a_kit() {
    let folder = tempfile::tempdir().unwrap();
    let [thick, thin] = ["thick", "thin"].map(|name| folder.path().join(name));
    let refused = prepare(&thick, &["--goal", "top", "--wall", "12mm"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(!thick.exists());
    let outcome = json(&refused);
    let remedies = outcome["remedies"].as_array().unwrap();
    let kinds: Vec<&str> = remedies
        .iter()
        .map(|remedy| remedy["kind"].as_str().unwrap())
        .collect();
    assert_eq!(
        kinds,
        [
            "least-size",
            "greatest-wall",
            "nearest-contact",
            "nearest-axis",
            "least-ballast"
        ]
    );
    for remedy in remedies {
        assert_eq!(
            remedy["amount"].is_number(),
            remedy["confirmed"].is_object(),
            "{remedy:#}"
        );
    }
    let setting = &remedies[1]["settings"][0];
    assert_eq!(setting["key"], "wall");
    let wall = setting["value"].as_str().unwrap();
    let made = prepare(&thin, &["--goal", "top", "--wall", wall]);
    assert_eq!(
        made.status.code(),
        Some(0),
        "{wall}: {}",
        text(&made.stdout)
    );
}

#[test]
fn the_best_axis_is_taken_and_told_and_is_better_than_the_one_at_hand() {
    let folder = tempfile::tempdir().unwrap();
    let speed = |name: &str, up: &str| {
        let made = prepare(
            &folder.path().join(name),
            &["--goal", "top", "--wall", "1.5mm", up],
        );
        assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
        let sheet = json(&made);
        (
            sheet["assembly"]["critical_speed_rpm"].as_f64().unwrap(),
            sheet["goal"]["choice"].clone(),
        )
    };
    let (at_hand, not_chosen) = speed("upright", "--up=z");
    let (best, choice) = speed("best", "--up=auto");
    assert!(best < at_hand && not_chosen.is_null(), "{best} {at_hand}");
    assert!(choice.as_str().unwrap().contains("--up="), "{choice}");
}

#[test]
fn inspect_tells_what_the_model_could_become() {
    let usual = [
        "inspect",
        ELLIPSOID,
        "--size",
        "60mm",
        "--printer",
        "objet-connex350",
        "--wall",
        "1.5mm",
    ];
    let said = text(&equipoise(&usual).stdout);
    assert!(
        said.contains("with a wall of 1.524 mm, as") && said.contains("spins upright from"),
        "{said}"
    );
    let facts = json(&equipoise(&[&usual[..], &["--json"]].concat()));
    let prospects = facts["could_become"]["prospects"].as_array().unwrap();
    assert!(
        prospects
            .iter()
            .any(|prospect| prospect["kind"] == "yoyo" && prospect["possible"] == true)
    );
}
