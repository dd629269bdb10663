//! A changed motion in `motion.glb` is found by the judge.

use std::fs;
use std::path::Path;

use crate::common::{assert_exit, equipoise, json, path, printed, telescope_judge_says};

/// Returns the number at a pointer.
fn at(value: &serde_json::Value, pointer: &str) -> usize {
    value.pointer(pointer).unwrap().as_u64().unwrap() as usize
}

/// Moves one key of the first joint aside, in the animation of all joints and in its own, and
/// leaves all else. The judge must tell which parts are then off.
pub fn lie_about_the_scene(kit: &Path) {
    for (index, name) in ["open", "J01"].into_iter().enumerate() {
        lie_about_an_animation(kit, index, name);
    }
}

fn lie_about_an_animation(kit: &Path, index: usize, name: &str) {
    let file = kit.join("motion.glb");
    let right = fs::read(&file).unwrap();
    let length = u32::from_le_bytes(right[12..16].try_into().unwrap()) as usize;
    let scene: serde_json::Value = serde_json::from_slice(&right[20..20 + length]).unwrap();
    let animation = format!("/animations/{index}");
    assert_eq!(scene.pointer(&animation).unwrap()["name"], name);
    let output = at(&scene, &format!("{animation}/samplers/0/output"));
    let view = at(&scene, &format!("/accessors/{output}/bufferView"));
    let start = 28 + length + at(&scene, &format!("/bufferViews/{view}/byteOffset"));
    let mut wrong = right.clone();
    let old = f32::from_le_bytes(wrong[start..start + 4].try_into().unwrap());
    wrong[start..start + 4].copy_from_slice(&(old + 0.1).to_le_bytes());
    fs::write(&file, wrong).unwrap();
    let checked = equipoise(&["--json", "verify", path(kit)]);
    assert_exit(&checked, 1);
    let found = json(&checked);
    let mut checks = found.as_array().unwrap().iter();
    let check = checks
        .find(|check| check["kind"] == "motion-scene")
        .unwrap();
    assert_eq!(check["pass"], false);
    let said = check.to_string();
    assert!(said.contains("S02 is 0.1"), "{said}");
    assert!(said.contains(&format!("of `{name}`")), "{said}");
    if let Some(output) = telescope_judge_says(kit) {
        assert_exit(&output, 1);
        let said = printed(&output);
        assert!(said.contains(&format!("animation {name} is 0.1")), "{said}");
    }
    fs::write(&file, right).unwrap();
}
