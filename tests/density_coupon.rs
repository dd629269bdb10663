//! The density coupon: blocks of every infill that are sliced, weighed and put into a profile.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use common::{
    assert_exit, equipoise_in, files, has_slicer, json, list, number, path, printed, words,
};
use equipoise::base::watch::Watch;
use equipoise::io::gcode::{Options, Place, Toolpath, read_gcode};

/// Density of the filament whose blocks are weighed here, g/cm³. It is not that of the profile.
const DENSITY_G_CM3: f64 = 1.27;

/// Slices a plate as a shop does, with nothing set but the machine.
fn slice(plate: &Path) -> PathBuf {
    let out = plate.with_extension("gcode");
    let output = Command::new("prusa-slicer")
        .args(["--export-gcode", "--dont-arrange", "--gcode-label-objects"])
        .args(["--first-layer-height", "0.2", "--skirts", "0"])
        .args(["--first-layer-extrusion-width", "0.45"])
        .args(["--bed-shape", "0x0,250x0,250x210,0x210"])
        .args(["-o", path(&out), path(plate)])
        .output()
        .unwrap();
    assert!(out.is_file(), "{}", printed(&output));
    out
}

fn read(gcode: &Path, places: Vec<Place>) -> Toolpath {
    let options = Options {
        places,
        ..Options::default()
    };
    let plates = read_gcode(gcode, &options, &Watch::silent()).unwrap();
    plates.into_iter().next().unwrap().toolpath
}

/// Returns the plates of a folder.
fn plates(folder: &Path) -> Vec<PathBuf> {
    let all = files(folder).into_keys().map(|file| folder.join(file));
    all.filter(|file| file.extension().is_some_and(|end| end == "3mf"))
        .collect()
}

#[test]
#[ignore = "half a minute; run before a change of the coupon"]
fn the_blocks_of_a_real_slicer_give_back_the_infill_that_lies_in_their_middle() {
    if !has_slicer() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str| equipoise_in(folder.path(), &words(line));
    let coupon = run("--json coupon --density --printer prusa-mk4 --out coupon");
    assert_exit(&coupon, 0);
    let set = json(&coupon);
    let height_mm = number(&set, "/height_mm");
    // The scale: all that is laid of a block, and what lies in the middle of the large ones.
    let mut masses = BTreeMap::new();
    let mut middles = BTreeMap::new();
    for plate in plates(&folder.path().join("coupon")) {
        let gcode = slice(&plate);
        let whole = read(&gcode, Vec::new());
        for object in &whole.objects {
            let Some(label) = &object.label else { continue };
            let volume_mm3 = object.deposits.part_moments().volume();
            masses.insert(label.name.clone(), volume_mm3 * DENSITY_G_CM3 / 1000.0);
            // Of the core of the table, a square: half a side of 12.7 mm.
            let bounds = object.deposits.tallies[0].bounds;
            let middle = middle_of(&bounds);
            let place = Place {
                min_mm: middle.map(|at| at - 12.7),
                max_mm: middle.map(|at| at + 12.7),
            };
            if label.name.ends_with("-large") {
                let core = read(&gcode, vec![place]).places[0].part_moments().volume();
                let ratio = core / (25.4 * 25.4 * height_mm);
                middles.insert(label.name.clone(), ratio);
            }
        }
    }
    assert_eq!(masses.len(), list(&set, "blocks").len(), "{masses:?}");
    for block in list(&set, "blocks") {
        // The profile foretells each mass for its own filament, PLA of 1.24 g/cm³.
        let name = block["name"].as_str().unwrap();
        let expected_g = number(block, "/expected_g") * DENSITY_G_CM3 / 1.24;
        let off = masses[name] / expected_g - 1.0;
        assert!(off.abs() < 0.035, "{name}: {off}");
    }

    assert_exit(
        &run("printers new --from prusa-mk4 --id shop --out shop.toml"),
        0,
    );
    // As a balance of 0.01 g shows them.
    let infills = ["15", "20", "30", "50", "70", "90"].map(|percent| {
        let [large, small] = ["large", "small"]
            .map(|size| format!("{:.2}g", masses[&format!("{percent}percent-{size}")]));
        format!("--infill {percent}%={large},{small}")
    });
    let solid = format!("--infill 100%={:.2}g", masses["100percent-small"]);
    let line = format!(
        "printers calibrate shop.toml --lot A7 --date 2026-11-28 {} {solid}",
        infills.join(" ")
    );
    let calibrated = run(&line);
    assert_exit(&calibrated, 0);
    eprintln!("{}", printed(&calibrated));

    let shop = json(&run("--json printers show shop.toml"));
    let shipped = json(&run("--json printers show prusa-mk4"));
    let ratio = &shop["infill"]["core_ratio"];
    assert_eq!(ratio["sure"], "measured");
    assert_eq!(ratio["source"], "blocks weighed, lot A7, 2026-11-28");
    for row in list(ratio, "value") {
        let (nominal, laid) = (number(row, "/0"), number(row, "/1"));
        let table = list(&shipped["infill"]["core_ratio"], "value");
        let same = table.iter().find(|it| number(it, "/0") == nominal).unwrap();
        let off = laid / number(same, "/1") - 1.0;
        let middle = middles[&format!("{}percent-large", nominal * 100.0)];
        let off_middle = laid / middle - 1.0;
        eprintln!("{nominal}: {laid}, {off:+.4} of the table, {off_middle:+.4} of the middle");
        assert!(
            off.abs() < 0.015,
            "{nominal}: {laid} is {off} off the table"
        );
        assert!(
            off_middle.abs() < 0.02,
            "{nominal}: {laid} is {off_middle} off the middle"
        );
    }
}

/// Returns the middle of a box seen from above, mm.
fn middle_of(bounds: &equipoise::geom::Aabb) -> [f64; 2] {
    [0, 1].map(|axis| 0.5 * (bounds.min[axis] + bounds.max[axis]))
}

#[test]
fn the_same_coupon_is_the_same_bytes_and_its_sheet_has_a_line_for_every_block() {
    let folder = tempfile::tempdir().unwrap();
    for (printer, out) in [
        ("prusa-mk4", "a"),
        ("prusa-mk4", "b"),
        ("ultimaker-s5", "c"),
    ] {
        let line = format!("coupon --density --printer {printer} --out {out}");
        assert_exit(&equipoise_in(folder.path(), &words(&line)), 0);
    }
    let written = ["a", "b"].map(|name| files(&folder.path().join(name)));
    assert!(written[0] == written[1] && written[0].len() >= 3);
    let sheet = fs::read_to_string(folder.path().join("c/coupon.html")).unwrap();
    for said in [
        "15percent-large",
        "100percent-small",
        "--infill 15%=G,G",
        "30 %",
    ] {
        assert!(sheet.contains(said), "{said}");
    }
}

#[test]
fn what_has_no_infill_and_masses_that_cannot_be_are_refused_with_what_to_type() {
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str| equipoise_in(folder.path(), &words(line));
    let refused = |line: &str, said: &str| {
        let output = run(line);
        assert_exit(&output, 2);
        let text = printed(&output);
        assert!(
            text.contains(said) && text.contains("remedy"),
            "{line}: {text}"
        );
    };
    for printer in ["elegoo-saturn-4-ultra", "hp-mjf-5200", "objet-connex350"] {
        let line = format!("coupon --density --printer {printer} --out none");
        refused(&line, &format!("equipoise coupon --printer {printer}"));
    }
    assert!(!folder.path().join("none").exists());
    assert_exit(
        &run("printers new --from prusa-mk4 --id shop --out shop.toml"),
        0,
    );
    let before = files(folder.path());
    let all = "--infill 15%=6.5,2.1 --infill 20%=7.7,2.4 --infill 30%=10.5,3 --infill 50%=15.7,4.2 \
        --infill 70%=21,5.4 --infill 90%=26.4,6.7 --infill 100%=7.8";
    let right = format!("printers calibrate shop.toml --lot A {all}");
    for (line, said) in [
        (
            right.replace(" --infill 30%=10.5,3", ""),
            "30 % are missing",
        ),
        (
            right.replace("30%=", "35%="),
            "no block has an infill of 35 %",
        ),
        (
            right.replace("30%=10.5,3", "30%=3,10.5"),
            "not heavier than the small",
        ),
        (right.replace("30%=10.5,3", "30%=7,2.2"), "and 20 % has"),
        (
            right.replace("100%=7.8", "100%=5.8"),
            "weigh its blocks and the solid one",
        ),
        (
            right.replace("100%=7.8", "100%=-7.8"),
            "-7.8 g is not possible",
        ),
        (
            right.replace("100%=7.8", "100%=7.8kg"),
            "such as 15%=6.52g,2.12g",
        ),
    ] {
        let output = run(&line);
        assert_exit(&output, 2);
        assert!(
            printed(&output).contains(said),
            "{said}: {}",
            printed(&output)
        );
        assert!(
            files(folder.path()) == before,
            "{said}: the profile is as it was"
        );
    }
    assert_exit(
        &run("printers new --from objet-connex350 --id jet --out jet.toml"),
        0,
    );
    refused(
        &right.replace("shop.toml", "jet.toml"),
        "prints solid: it has no infill",
    );
    assert_exit(&run(&right), 0);
}
