//! The toolpaths of a real slicer, right and wrong: `verify` tells how they will balance, and names
//! what is set wrong.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

mod common;

use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use common::{equipoise, list, number, path, printed, words};
use serde_json::Value;
use tempfile::TempDir;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

/// A printer's profile. Settings in the plate's own file go before those of it.
const PROFILE: &str = "layer_height = 0.2\nfirst_layer_height = 0.2\nnozzle_diameter = 0.4\n\
    filament_diameter = 1.75\nfilament_density = 1.24\nextrusion_width = 0.45\nperimeters = 2\n\
    fill_density = 100%\nfill_pattern = rectilinear\nbed_shape = 0x0,250x0,250x210,0x210\n\
    max_print_height = 220\ngcode_flavor = marlin2\ngcode_label_objects = 1\n";
/// The settings of objects in a plate, as PrusaSlicer reads them.
const SETTINGS: &str = "Metadata/Slic3r_PE_model.config";
/// The objects of a plate and their places.
const MODEL: &str = "3D/3dmodel.model";

/// A kit and its plates, as a slicer lays them.
struct Bench {
    folder: TempDir,
    sheet: Value,
}

impl Bench {
    /// Makes a small kit; `None`, with a message, if there is no slicer.
    fn new() -> Option<Self> {
        let asked = Command::new("prusa-slicer").arg("--help").output();
        if asked.is_err() {
            eprintln!(
                "SKIPPED: no prusa-slicer here; \
                 apt-get install --no-install-recommends prusa-slicer"
            );
            return None;
        }
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("profile.ini"), PROFILE).unwrap();
        let options = "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 45mm \
            --pitch 0.4mm";
        let output = common::prepare(&folder.path().join("kit"), &words(options));
        common::assert_exit(&output, 0);
        let sheet = common::json(&output);
        Some(Self { folder, sheet })
    }

    fn at(&self, file: &str) -> PathBuf {
        self.folder.path().join(file)
    }

    /// Writes a copy of the plate in which one of its files is changed.
    fn change(&self, part: &str, change: impl Fn(String) -> String) -> PathBuf {
        let mut read = ZipArchive::new(fs::File::open(self.at("kit/plate.3mf")).unwrap()).unwrap();
        let path = self.at("changed.3mf");
        let mut write = ZipWriter::new(fs::File::create(&path).unwrap());
        for index in 0..read.len() {
            let mut file = read.by_index(index).unwrap();
            let name = file.name().unwrap().to_string();
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).unwrap();
            if name == part {
                bytes = change(String::from_utf8(bytes).unwrap()).into_bytes();
            }
            write
                .start_file(name, SimpleFileOptions::default())
                .unwrap();
            write.write_all(&bytes).unwrap();
        }
        write.finish().unwrap();
        path
    }

    /// Slices a file with these options besides the profile; returns the G-code.
    fn slice(&self, file: &Path, options: &str) -> PathBuf {
        let gcode = self.at("print.gcode");
        let output = Command::new("prusa-slicer")
            .args(["--export-gcode", "--load"])
            .arg(self.at("profile.ini"))
            .args(words(options))
            .arg("-o")
            .args([&gcode, file])
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", printed(&output));
        gcode
    }

    /// Judges toolpaths; returns the exit code and the findings.
    fn verify(&self, gcode: &Path) -> (Option<i32>, Value) {
        let kit = self.at("kit");
        let typed = ["--json", "verify", path(&kit), "--gcode", path(gcode)];
        let output = equipoise(&typed);
        (output.status.code(), common::json(&output))
    }

    /// Asserts that a wrong print is named for what it is, and for nothing else.
    fn assert_named(&self, gcode: &Path, kind: &str) {
        let (code, found) = self.verify(gcode);
        assert_eq!(code, Some(1), "{kind}: {found}");
        let causes = list(&found, "causes").iter();
        let wrong = causes.filter(|cause| cause["is_wrong"] == true);
        let kinds: Vec<&str> = wrong.map(|cause| cause["kind"].as_str().unwrap()).collect();
        assert_eq!(kinds, [kind], "{found}");
    }
}

#[test]
fn the_toolpaths_of_a_slicer_balance_as_promised_and_wrong_ones_are_named() {
    let Some(bench) = Bench::new() else {
        return;
    };
    let plate = bench.at("kit/plate.3mf");
    let (code, found) = bench.verify(&bench.slice(&plate, "--dont-arrange"));
    assert_eq!(code, Some(0), "{found}");
    for part in list(&found, "parts") {
        let ratio = number(part, "/mass_g") / number(part, "/written_mass_g");
        assert!((0.998..1.02).contains(&ratio), "{part}");
    }
    let centers = ["toolpaths", "written"]
        .map(|of| [0, 1, 2].map(|axis| number(&found, &format!("/{of}/center_mm/{axis}"))));
    let squares = (0..3).map(|axis| (centers[0][axis] - centers[1][axis]).powi(2));
    assert!(squares.sum::<f64>().sqrt() < 0.15, "{centers:?}");
    let whole = |of: &str| number(&found, &format!("/{of}/topples_deg"));
    assert!((whole("toolpaths") - whole("written")).abs() < 0.5);

    // The slicer may arrange the plate anew.
    let (code, found) = bench.verify(&bench.slice(&plate, "--center 100,90"));
    assert_eq!(code, Some(0), "{found}");
    assert!(
        list(&found, "parts")
            .iter()
            .all(|part| part["is_moved"] == true)
    );

    let sparse = |xml: String| xml.replace("\"100%\"", "\"15%\"");
    let sparse = bench.change(SETTINGS, sparse);
    bench.assert_named(&bench.slice(&sparse, "--dont-arrange"), "infill");
    let gcode = bench.slice(&plate, "--dont-arrange --scale 101%");
    bench.assert_named(&gcode, "scale");
    let gcode = bench.slice(&plate, "--dont-arrange --filament-density 1.4");
    bench.assert_named(&gcode, "density");
    let thick = |xml: String| {
        let [thin, thick] = ["0.2", "0.3"].map(|mm| format!("\"layer_height\" value=\"{mm}\""));
        assert!(xml.contains(&thin), "{xml}");
        xml.replace(&thin, &thick)
    };
    let thick = bench.change(SETTINGS, thick);
    bench.assert_named(&bench.slice(&thick, "--dont-arrange"), "layer-height");
    let first = list(&bench.sheet, "parts")[0]["file"].as_str().unwrap();
    let alone = bench.slice(&bench.at("kit").join(first), "--center 125,105");
    bench.assert_named(&alone, "missing");
    let mirrored = bench.change(MODEL, |xml| mirror(&xml, &bench.sheet));
    bench.assert_named(&bench.slice(&mirrored, "--dont-arrange"), "mirror");
}

/// Mirrors every object of a plate in its place.
fn mirror(xml: &str, sheet: &Value) -> String {
    let spots = list(&list(sheet, "plates")[0], "holds");
    let mut pieces = xml.split("transform=\"");
    let mut mirrored = pieces.next().unwrap().to_owned();
    for (piece, spot) in pieces.zip(spots) {
        let (matrix, rest) = piece.split_once('"').unwrap();
        let mut values: Vec<f64> = matrix
            .split_whitespace()
            .map(|value| value.parse().unwrap())
            .collect();
        let turned_mm = 2.0 * number(spot, "/low_mm/0") + number(spot, "/size_mm/0");
        for at in [0, 3, 6] {
            values[at] = -values[at];
        }
        values[9] = turned_mm - values[9];
        let values: Vec<String> = values.iter().map(f64::to_string).collect();
        mirrored += &format!("transform=\"{}\"{rest}", values.join(" "));
    }
    mirrored
}

#[test]
fn toolpaths_that_fit_no_part_cannot_be_judged() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    common::make_kit(&kit, "--goal top --up z --wall 1.5mm");
    let cases = [
        ("", "caused by"),
        (
            "; printing object cube\nM83\nG1 Z0.2\nG1 X9 Y9 E1\n",
            "fits no part of this kit",
        ),
        (
            "; printing object P01\nM83\nG1 Z0.2\nG1 X9 Y9 E1\n",
            "its P01 has another shape",
        ),
        (
            "M83\nG1 Z0.2\nG1 X9 Y9 E1\n",
            "the size of no part or plate",
        ),
    ];
    for (text, words) in cases {
        let gcode = folder.path().join("print.gcode");
        fs::write(&gcode, text).unwrap();
        let output = equipoise(&["verify", path(&kit), "--gcode", path(&gcode)]);
        common::assert_exit(&output, 2);
        assert!(printed(&output).contains(words), "{}", printed(&output));
        assert!(printed(&output).contains("remedy:"), "{}", printed(&output));
    }
    let absent = folder.path().join("absent.gcode");
    let output = equipoise(&["verify", path(&kit), "--gcode", path(&absent)]);
    common::assert_exit(&output, 2);
    let file = kit.join("checklist.json");
    let output = equipoise(&["verify", path(&kit), "--gcode", path(&file)]);
    common::assert_exit(&output, 2);
}
