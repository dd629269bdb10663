//! Profiles as a shop meets them: a slicer's bundle imported, coupons sliced, and a profile of the
//! shop's own calibrated and used.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

mod bundle;
use crate::common;
mod grid;
mod slide;

use std::fs;
use std::path::Path;
use std::process::Command;

use common::{ELLIPSOID, assert_exit, checklist, equipoise_in, list, printed, words};
use equipoise::printer::Printer;

/// Runs the program in a folder, where it must succeed; returns everything that was printed.
fn run(folder: &Path, arguments: &str) -> String {
    let output = equipoise_in(folder, &words(arguments));
    assert_exit(&output, 0);
    printed(&output)
}

/// Makes a profile in a folder and calibrates it by three coupons of 8 cm³.
fn make_profile(folder: &Path) -> String {
    run(
        folder,
        "printers new --from objet-connex350 --out shop.toml",
    );
    let lot = "--lot 7B --date 2026-11-21 --clearance 0.15";
    let weights = "--weighed 9.45 --weighed 9.47 --weighed 9.46 --volume 8000";
    run(
        folder,
        &format!("printers calibrate shop.toml {lot} {weights}"),
    )
}

/// Prepares the shipped model in a folder with the printer that its `equipoise.toml` names.
fn prepare_in(folder: &Path) {
    let default = "printer = \"shop.toml\"\n";
    fs::write(folder.join("equipoise.toml"), default).unwrap();
    let sizes = "--goal top --up z --size 60mm --wall 1.5mm --pitch 0.3mm --out kit";
    let arguments = [&["-q", "prepare", ELLIPSOID][..], &words(sizes)].concat();
    assert_exit(&equipoise_in(folder, &arguments), 0);
}

#[test]
fn a_new_profile_prints_its_coupons() {
    let folder = tempfile::tempdir().unwrap();
    run(
        folder.path(),
        "printers new --from objet-connex350 --out shop.toml",
    );
    run(folder.path(), "coupon --printer shop.toml --out coupons");
    let bodies = "density.stl comb.stl trial-pin.stl pins.stl walls-x.stl walls-y.stl";
    for file in words(bodies).into_iter().chain(["coupon.html"]) {
        assert!(folder.path().join("coupons").join(file).is_file(), "{file}");
    }
}

#[test]
fn weighed_coupons_give_a_measured_density() {
    let folder = tempfile::tempdir().unwrap();
    let said = make_profile(folder.path());
    for words in ["vero-white: 1.1825 g/cm³", "(was 0.2)"] {
        assert!(said.contains(words), "{said}");
    }
    let profile = Printer::read(&folder.path().join("shop.toml")).unwrap();
    assert!(profile.material(None).unwrap().is_measured());
}

#[test]
fn a_kit_by_the_shops_default_printer_states_its_sources() {
    let folder = tempfile::tempdir().unwrap();
    make_profile(folder.path());
    prepare_in(folder.path());
    let sheet = checklist(&folder.path().join("kit"));
    assert_eq!(sheet["printer"]["id"], "shop");
    assert_eq!(sheet["material"]["density_sure"], "measured");
    assert!(common::number(&sheet, "/material/density_spread_ratio") < 0.02);
    let sources = sheet["printer"]["sources"].to_string();
    for words in [
        "lot 7B, 2026-11-21",
        "default of polyjet",
        "build volume: not known",
    ] {
        assert!(sources.contains(words), "{sources}");
    }
}

/// The shrinkage of the profile along x, y and z.
const SHRINKAGE_RATIO: [f64; 3] = [0.02, 0.02, 0.01];

#[test]
fn part_files_make_up_for_shrinkage_and_are_judged_at_nominal_size() {
    let folder = tempfile::tempdir().unwrap();
    make_profile(folder.path());
    let shop = folder.path().join("shop.toml");
    let text = fs::read_to_string(&shop).unwrap();
    let row = |key: &str, value: &str| {
        let source = "source = \"a bar of 100 mm\", sure = \"measured\"";
        format!("{key} = {{ value = {value}, {source} }}\n")
    };
    let own = row("compensates_shrinkage", "false");
    let numbers = row("shrinkage_xy_ratio", "0.02") + &row("shrinkage_z_ratio", "0.01");
    let text = text.replace("[numbers]\n", &format!("{own}[numbers]\n{numbers}"));
    fs::write(&shop, text).unwrap();
    prepare_in(folder.path());
    run(folder.path(), "verify kit");
    let kit = folder.path().join("kit");
    for part in list(&checklist(&kit), "parts") {
        let bytes = fs::read(kit.join(part["file"].as_str().unwrap())).unwrap();
        let mesh = equipoise::io::decode_model(&bytes).unwrap();
        let size: [f64; 3] = mesh.aabb().size().into();
        for (axis, shrinkage) in SHRINKAGE_RATIO.into_iter().enumerate() {
            let ratio = size[axis] / part["size_mm"][axis].as_f64().unwrap();
            assert!((ratio - 1.0 / (1.0 - shrinkage)).abs() < 1e-6, "{ratio}");
        }
    }
}

/// Wrong command lines about profiles, and a part of the message to each.
const MISTAKES: [(&str, &str); 7] = [
    (
        "printers calibrate prusa-mk4 --lot 1 --wall 1",
        "is a shipped printer",
    ),
    (
        "printers new --from prusa-mk5 --out n.toml",
        "did you mean `prusa-mk4`?",
    ),
    ("printers new --from prusa-mk4 --out taken.toml", "--force"),
    ("printers import b.ini", "choose one (--printer)"),
    (
        "printers import b.ini --printer A --out n.toml",
        "`pixel_x_mm` is not set",
    ),
    ("printers import taken.toml", "is none of .ini"),
    (
        "coupon --printer prusa-mk4 --material vero",
        "does not print `vero`",
    ),
];

#[test]
fn mistakes_about_profiles_are_reported_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let printers = "[printer:A]\nx = 1\n[printer:B]\nx = 1\n";
    fs::write(folder.path().join("b.ini"), printers).unwrap();
    fs::write(folder.path().join("taken.toml"), "").unwrap();
    let spaced = [
        &words("printers new --from prusa-mk4 --out n.toml --id")[..],
        &["My Own"],
    ];
    let mistakes = MISTAKES.map(|(arguments, expected)| (words(arguments), expected));
    let spaced = (spaced.concat(), "lower-case letters");
    for (arguments, expected) in mistakes.into_iter().chain([spaced]) {
        let output = equipoise_in(folder.path(), &arguments);
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(said.contains(expected), "{arguments:?}: {said}");
        let files = fs::read_dir(folder.path()).unwrap().count();
        assert_eq!(files, 2, "{arguments:?} left something behind");
    }
}

#[test]
fn a_slicer_takes_every_coupon_without_repair() {
    if Command::new("prusa-slicer").arg("--help").output().is_err() {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "coupon --printer prusa-mk4 --out coupons");
    for file in ["density", "comb", "trial-pin", "pins", "walls-x", "walls-y"] {
        let path = folder.path().join(format!("coupons/{file}.stl"));
        let output = Command::new("prusa-slicer")
            .arg("--info")
            .arg(path)
            .output();
        let said = printed(&output.unwrap());
        for words in ["manifold = yes", "number_of_parts =  1"] {
            assert!(said.contains(words), "{file}: {said}");
        }
        for words in ["open_edges", "facets_r"] {
            assert!(!said.contains(words), "{file}: {said}");
        }
    }
}
