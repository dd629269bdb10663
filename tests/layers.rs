//! Layer images: a kit is sliced at the pixels of its printer, and images are judged like
//! toolpaths.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use common::{
    ELLIPSOID, SL1S, assert_exit, equipoise, files, json, list, number, path, printed, words,
};
use serde_json::Value;

/// Returns the folder with the kit of these tests, which is made once.
fn bench() -> &'static Path {
    static BENCH: OnceLock<PathBuf> = OnceLock::new();
    BENCH.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("layers");
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        fs::create_dir_all(&folder).unwrap();
        let options = "--goal stand --up y --least-angle 2 --printer prusa-sl1s --size 30mm \
            --pitch 0.3mm";
        let kit = folder.join("kit");
        let usual = ["prepare", ELLIPSOID, "--out", path(&kit)];
        assert_exit(&equipoise(&[&usual[..], &words(options)].concat()), 0);
        fs::write(folder.join("sl1s.ini"), SL1S).unwrap();
        folder
    })
}

fn json_of(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// Slices the kit into the folder of this name.
fn slice(name: &str, options: &str) -> (Output, PathBuf) {
    let out = bench().join(name);
    let kit = bench().join("kit");
    let usual = ["--json", "slice", path(&kit), "--out", path(&out)];
    (equipoise(&[&usual[..], &words(options)].concat()), out)
}

fn judge(file: &Path) -> Output {
    let kit = bench().join("kit");
    equipoise(&["--json", "verify", path(&kit), "--gcode", path(file)])
}

/// Holds every part of a judgement against its file: volume within this share, centre and spread.
fn assert_exact(judgement: &Value, volume_ratio: f64) {
    let parts = list(judgement, "parts");
    assert!(parts.len() > 1);
    for part in parts {
        let off = number(part, "/volume_ratio") - 1.0;
        assert!(off.abs() <= volume_ratio, "volume off by {off}");
        let off_mm = number(part, "/center_off_mm");
        assert!(off_mm <= 2e-3, "centre off by {off_mm} mm");
        for axis in 0..3 {
            let spread = number(part, &format!("/spread_ratio/{axis}"));
            assert!((spread - 1.0).abs() <= 2e-4, "spread {spread}");
        }
    }
}

#[test]
fn a_kit_at_the_pixels_of_its_printer_weighs_what_its_parts_do_on_any_number_of_threads() {
    let (output, folder) = slice("stack", "--format png-stack --threads 1");
    assert_exit(&output, 0);
    let said = json(&output);
    assert_exact(&said["judgement"], 1e-4);
    let plate = &said["layers"]["plates"][0];
    assert_eq!(number(plate, "/pixel_mm/0"), 0.05);
    let written = files(&folder);
    assert!(written.len() as f64 > number(plate, "/layers"));
    let (_, again) = slice("stack-2", "--format png-stack --threads 2");
    assert!(files(&again) == written, "other bytes on two threads");
    assert_exit(&judge(&folder.join("layers.json")), 0);
}

#[test]
fn an_sl1_of_our_own_keeps_the_promise_and_needs_the_display_of_its_machine() {
    let profile = bench().join("sl1s.ini");
    let (output, folder) = slice("sl1", &format!("--format sl1 --profile {}", path(&profile)));
    assert_exit(&output, 0);
    assert_exact(&json(&output)["judgement"], 1e-4);
    assert!(folder.join("plate.sl1").is_file());
    let (output, folder) = slice("no-display", "--format sl1");
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(
        said.contains("needs the display and the exposure"),
        "{said}"
    );
    let blind = bench().join("blind.ini");
    fs::write(&blind, SL1S.replace("display_width = 128\n", "")).unwrap();
    assert!(!folder.exists());
    let (output, _) = slice(
        "no-width",
        &format!("--format sl1 --profile {}", path(&blind)),
    );
    assert_exit(&output, 2);
    assert!(printed(&output).contains("`display_width`"));
    let small = bench().join("small.ini");
    let tiny = SL1S.replace("display_width = 128", "display_width = 12.8");
    fs::write(&small, tiny.replace("pixels_x = 2560", "pixels_x = 256")).unwrap();
    let (output, folder) = slice(
        "too-small",
        &format!("--format sl1 --profile {}", path(&small)),
    );
    assert_exit(&output, 2);
    assert!(printed(&output).contains("beyond the display"));
    assert!(!folder.exists());
    let coarse = bench().join("coarse.ini");
    let text = SL1S.replace("\nlayer_height = 0.05", "\nlayer_height = 0.1");
    fs::write(&coarse, text).unwrap();
    let options = format!("--format sl1 --profile {}", path(&coarse));
    let (output, _) = slice("coarse", &options);
    assert_exit(&output, 2);
    assert!(printed(&output).contains("exposes layers of 0.1 mm"));
    let (output, _) = slice("needless", "--format png-stack --slicer any");
    assert_exit(&output, 2);
    assert!(printed(&output).contains("--slicer says nothing"));
}

#[test]
fn images_of_another_size_or_layer_are_named_for_what_they_are() {
    let (output, folder) = slice("wrong", "--format png-stack --threads 2");
    assert_exit(&output, 0);
    let list = folder.join("layers.json");
    let right = fs::read_to_string(&list).unwrap();
    // The same images as thicker layers: longer along z.
    fs::write(
        &list,
        right.replace("\"layer_mm\": 0.05", "\"layer_mm\": 0.052"),
    )
    .unwrap();
    let output = judge(&list);
    assert_exit(&output, 1);
    assert!(
        printed(&output).contains("\"scale\""),
        "{}",
        printed(&output)
    );
    // Every second image, as layers of twice the height.
    let plate = json_of(&right)["plates"][0].clone();
    let count = number(&plate, "/layers") as usize / 2;
    for layer in 1..count {
        let image = |layer: usize| folder.join(format!("plate/{layer:05}.png"));
        fs::copy(image(2 * layer), image(layer)).unwrap();
    }
    let halved = format!("\"layers\": {count}");
    let right = right.replace(&format!("\"layers\": {}", plate["layers"]), &halved);
    fs::write(
        &list,
        right.replace("\"layer_mm\": 0.05", "\"layer_mm\": 0.1"),
    )
    .unwrap();
    let output = judge(&list);
    assert_exit(&output, 1);
    assert!(
        printed(&output).contains("\"layer-height\""),
        "{}",
        printed(&output)
    );
}

#[test]
fn a_filament_printer_has_no_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let options = "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 40mm --pitch 1mm";
    let usual = ["prepare", ELLIPSOID, "--out", path(&kit)];
    assert_exit(&equipoise(&[&usual[..], &words(options)].concat()), 0);
    let output = equipoise(&["slice", path(&kit), "--format", "png-stack"]);
    assert_exit(&output, 2);
    assert!(
        printed(&output).contains("shows no pixels"),
        "{}",
        printed(&output)
    );
}

#[test]
fn the_images_of_another_slicer_agree_with_the_parts() {
    if Command::new("prusa-slicer").arg("--help").output().is_err() {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
        return;
    }
    let folder = bench();
    let (plate, sliced) = (folder.join("kit/plate.3mf"), folder.join("theirs.sl1"));
    let output = Command::new("prusa-slicer")
        .args([
            "--export-sla",
            "--dont-arrange",
            "--load",
            path(&folder.join("sl1s.ini")),
        ])
        .args(["-o", path(&sliced), path(&plate)])
        .output()
        .unwrap();
    assert!(sliced.is_file(), "{}", printed(&output));
    let output = judge(&sliced);
    assert_exit(&output, 0);
    // That slicer closes gaps up to 0.05 mm and rounds its pixels otherwise. Walls of 1 mm and less
    // get up to 0.03 % more.
    assert_exact(&json(&output), 5e-4);
}
