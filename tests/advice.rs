//! Advice as a user meets it: remedies that give a kit, the best axis, and what a model could
//! become.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use common::{
    ELLIPSOID, assert_exit, equipoise, json, list, make_kit, number, prepare_quickly, text, words,
};
use serde_json::Value;

/// The remedies for a wall of 12 mm: too little can be emptied to move the centre of mass over the
/// contact point.
fn remedies() -> Vec<Value> {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("thick");
    let refused = prepare_quickly(&kit, "--goal top --up z --wall 12mm");
    assert_exit(&refused, 1);
    assert!(!kit.exists());
    list(&json(&refused), "remedies").to_vec()
}

#[test]
fn every_remedy_with_an_amount_was_confirmed_by_a_solve() {
    let remedies = remedies();
    let kinds: Vec<&str> = remedies
        .iter()
        .map(|remedy| remedy["kind"].as_str().unwrap())
        .collect();
    let expected = "least-size greatest-wall nearest-contact nearest-axis least-ballast";
    assert_eq!(kinds, words(expected));
    for remedy in remedies {
        let is_confirmed = remedy["confirmed"].is_object();
        assert_eq!(remedy["amount"].is_number(), is_confirmed, "{remedy:#}");
    }
}

#[test]
#[ignore = "long: 15 s, and tests/remedies.rs types every remedy; run with -- --ignored"]
fn a_recommended_wall_gives_a_kit() {
    let remedies = remedies();
    let setting = &remedies[1]["settings"][0];
    assert_eq!(setting["key"], "wall");
    let wall = setting["value"].as_str().unwrap();
    let folder = tempfile::tempdir().unwrap();
    make_kit(
        &folder.path().join("thin"),
        &format!("--goal top --up z --wall {wall}"),
    );
}

#[test]
fn the_best_axis_spins_at_a_lower_speed_than_the_upright_one_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let make = |name: &str, up: &str| {
        let goal = format!("--goal top --wall 1.5mm --up={up}");
        make_kit(&folder.path().join(name), &goal)
    };
    let [upright, best] = [make("upright", "z"), make("best", "auto")];
    let [slow, fast] = [&best, &upright].map(|sheet| number(sheet, "/assembly/critical_speed_rpm"));
    assert!(slow < fast, "{slow} {fast}");
    assert!(upright["goal"]["choice"].is_null());
    let choice = best["goal"]["choice"].as_str().unwrap();
    assert!(
        choice.contains("`up = ") && choice.contains("was chosen"),
        "{choice}"
    );
}

#[test]
fn inspect_asks_for_the_size_of_a_model_in_another_unit_before_anything_else() {
    let output = equipoise(&["inspect", ELLIPSOID, "--scale", "0.001"]);
    assert_exit(&output, 0);
    let said = text(&output.stdout);
    assert!(said.contains("--size=100mm") && said.contains("once its size is known"));
    assert!(!said.contains("hollowed with a wall"), "{said}");
}

#[test]
fn inspect_lists_what_the_model_could_become() {
    let options = "--size 60mm --printer objet-connex350 --wall 1.5mm";
    let arguments = [&["inspect", ELLIPSOID][..], &words(options)].concat();
    let said = text(&equipoise(&arguments).stdout);
    let expected = [
        "with a wall of 1.524 mm, as (best first)",
        "spins upright from",
    ];
    assert!(expected.iter().all(|words| said.contains(words)), "{said}");
    let facts = json(&equipoise(&[&arguments[..], &["--json"]].concat()));
    let prospects = list(&facts["could_become"], "prospects");
    let is_yoyo = |prospect: &Value| prospect["kind"] == "yoyo" && prospect["possible"] == true;
    assert!(prospects.iter().any(is_yoyo), "{prospects:?}");
}
