//! `equipoise slice`: a kit's plates become toolpaths by a real slicer, and are judged at once.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

use common::{
    ELLIPSOID, assert_exit, equipoise, equipoise_in, files, has_slicer, list, number, path,
    printed, sum, words,
};
use serde_json::Value;

/// A kit for a filament printer.
struct Bench {
    folder: PathBuf,
    sheet: Value,
}

/// Returns the kit of these tests, which is made once.
fn bench() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slice");
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        fs::create_dir_all(&folder).unwrap();
        let kit = folder.join("kit");
        let options = "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 40mm \
            --pitch 0.4mm";
        let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
        let output = equipoise(&[&usual[..], &words(options)].concat());
        assert_exit(&output, 0);
        let sheet = common::json(&output);
        Bench { folder, sheet }
    })
}

impl Bench {
    fn kit(&self) -> PathBuf {
        self.folder.join("kit")
    }

    /// Slices the kit into the folder of this name.
    fn slice(&self, name: &str, options: &[&str]) -> (Output, PathBuf) {
        let out = self.folder.join(name);
        let kit = self.kit();
        let usual = ["--json", "slice", path(&kit), "--out", path(&out)];
        (equipoise(&[&usual[..], options].concat()), out)
    }
}

impl Bench {
    /// Slices the kit as it is, once.
    fn right(&self) -> &'static (Output, PathBuf) {
        static RIGHT: OnceLock<(Output, PathBuf)> = OnceLock::new();
        RIGHT.get_or_init(|| self.slice("right", &[]))
    }
}

#[test]
fn the_plates_of_a_kit_become_toolpaths_that_keep_its_promise() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let before = files(&bench.kit());
    let (output, folder) = bench.right();
    assert_exit(output, 0);
    let found = common::json(output);
    let causes = list(&found["judgement"], "causes");
    assert!(
        causes.iter().all(|cause| cause["is_wrong"] == false),
        "{causes:?}"
    );
    let plates = list(&found["slices"], "plates");
    assert_eq!(plates.len(), 1);
    assert!(folder.join("plate.gcode").is_file());
    let written = fs::read(folder.join("slices.json")).unwrap();
    let written: Value = serde_json::from_slice(&written).unwrap();
    assert_eq!(written, found["slices"]);
    // The plate weighs what the sheet says, jigs included.
    let jigs_g: f64 = list(&bench.sheet, "jigs")
        .iter()
        .map(|jig| number(jig, "/mass_g"))
        .sum();
    let sheet_g = sum(list(&bench.sheet, "parts"), "/mass_g") + jigs_g;
    let parts_g = number(&plates[0], "/parts_g");
    assert!(
        (parts_g / sheet_g - 1.0).abs() < 0.02,
        "{parts_g} {sheet_g}"
    );
    let rest_g = number(&plates[0], "/filament_g") - parts_g;
    let support_g = number(&plates[0], "/support_g");
    assert!(
        support_g > 0.0 && rest_g >= support_g - 0.05,
        "{support_g} {rest_g}"
    );
    assert!(number(&plates[0], "/minutes") > 5.0);
    assert_eq!(files(&bench.kit()), before, "the kit is as it was");
}

#[test]
fn a_profile_of_the_slicer_changes_no_size_line_or_layer_of_the_kit() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let profile = bench.folder.join("shop.ini");
    let text = "# a shop's own\nlayer_height = 0.3\nfill_density = 15%\nfilament_density = 1.04\n\
        perimeter_extrusion_width = 0.7\nexternal_perimeter_extrusion_width = 0.7\n\
        xy_size_compensation = -0.2\nspiral_vase = 0\nperimeter_speed = 20\ninfill_speed = 20\nsolid_infill_speed = 20\n";
    fs::write(&profile, text).unwrap();
    let (usual, _) = bench.right();
    let (slow, _) = bench.slice("shop", &["--profile", path(&profile)]);
    assert_exit(&slow, 0);
    let [usual, slow] = [usual, &slow].map(common::json);
    let of = |found: &Value, pointer: &str| number(found, &format!("/slices/plates/0{pointer}"));
    assert_eq!(of(&usual, "/layers"), of(&slow, "/layers"));
    assert!((of(&usual, "/parts_g") / of(&slow, "/parts_g") - 1.0).abs() < 0.005);
    assert!(
        of(&slow, "/minutes") > 1.2 * of(&usual, "/minutes"),
        "its speeds hold"
    );
    assert!(slow["slices"]["profile_sha256"].is_string());
}

#[test]
fn what_cannot_be_sliced_is_told_with_a_remedy_and_writes_nothing() {
    let bench = bench();
    let remedy = "name the folder of a kit";
    let cases: [(&[&str], &str); 3] = [
        (
            &["--slicer", "no-such-slicer"],
            "install one (on Debian: apt-get install",
        ),
        (&["--slicer", "echo"], "does not name itself as PrusaSlicer"),
        (&["--profile", "no-such.ini"], "cannot read no-such.ini"),
    ];
    for (options, wanted) in cases {
        let (output, folder) = bench.slice("refused", options);
        assert_exit(&output, 2);
        assert!(printed(&output).contains(wanted), "{}", printed(&output));
        assert!(!folder.exists());
    }
    let empty = bench.folder.join("empty");
    fs::create_dir_all(&empty).unwrap();
    let output = equipoise(&["slice", path(&empty)]);
    assert_exit(&output, 2);
    assert!(printed(&output).contains(remedy), "{}", printed(&output));
    fs::write(empty.join("job.toml"), "schema = 1\n").unwrap();
    fs::write(empty.join("checklist.json"), r#"{"kind":"telescope"}"#).unwrap();
    let output = equipoise(&["slice", path(&empty)]);
    assert_exit(&output, 2);
    assert!(
        printed(&output).contains("a telescope's"),
        "{}",
        printed(&output)
    );
    fs::write(empty.join("checklist.json"), r#"{"kind":"core"}"#).unwrap();
    let output = equipoise(&["slice", path(&empty)]);
    assert_exit(&output, 2);
    assert!(printed(&output).contains("an object on a base"));
    // A folder of something else is not replaced.
    let other = bench.folder.join("other");
    fs::create_dir_all(&other).unwrap();
    fs::write(other.join("letter.txt"), "dear").unwrap();
    let (output, _) = bench.slice("other", &["--force"]);
    assert_exit(&output, 2);
    assert!(other.join("letter.txt").is_file());
}

/// Writes a program that names itself as a slicer, and runs these lines in place of one.
#[cfg(unix)]
fn write_slicer(file: &Path, lines: &str) {
    use std::os::unix::fs::PermissionsExt;
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = --help ]; then echo PrusaSlicer-2.5.0 based on Slic3r; exit; fi\n\
         while [ $# -gt 0 ]; do if [ \"$1\" = -o ]; then out=$2; fi; shift; done\n{lines}\n"
    );
    fs::write(file, text).unwrap();
    fs::set_permissions(file, fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn the_traps_of_slicers_are_found_whatever_their_exit_code_says() {
    let bench = bench();
    let file = bench.folder.join("false-slicer");
    for (lines, named) in [
        (
            "echo G1 >$out; echo 'print warning: Empty layer between 37.6 and 48'; exit 0",
            "cannot print a layer of plate.3mf",
        ),
        (
            "echo G1 >$out; echo 'key = fill_pattern loaded = wavy substituted = stars'; exit 0",
            "changed a setting of plate.3mf: key",
        ),
        ("echo 'Nothing to print'; exit 0", "wrote no toolpaths"),
        (
            "echo 'Objects could not fit on the bed' >&2; kill -ABRT $$",
            "could not fit on the bed",
        ),
        ("echo 'G1 X1 Y1 E1' >$out; exit 0", "names no print time"),
    ] {
        write_slicer(&file, lines);
        let (output, folder) = bench.slice("trap", &["--slicer", path(&file)]);
        assert_exit(&output, 2);
        assert!(
            printed(&output).contains(named),
            "{lines}: {}",
            printed(&output)
        );
        assert!(!folder.exists());
    }
}

#[test]
fn a_setting_that_a_real_slicer_does_not_know_is_no_toolpath() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let profile = bench.folder.join("wavy.ini");
    fs::write(&profile, "fill_pattern = wavy\n").unwrap();
    let (output, folder) = bench.slice("wavy", &["--profile", path(&profile)]);
    assert_exit(&output, 2);
    assert!(
        printed(&output).contains("fill_pattern"),
        "{}",
        printed(&output)
    );
    assert!(!folder.exists());
}

#[test]
fn a_quote_needs_the_shops_rates_and_says_what_to_write() {
    let bench = bench();
    let shop = bench.folder.join("no-rates");
    fs::create_dir_all(&shop).unwrap();
    let file = shop.join("equipoise.toml");
    let kit = bench.kit();
    let quote = |text: &str| {
        fs::write(&file, text).unwrap();
        let output = equipoise_in(&shop, &["slice", path(&kit), "--quote", "--out", "quoted"]);
        assert_exit(&output, 2);
        assert!(!shop.join("quoted").exists());
        printed(&output)
    };
    let printer = "printer = \"prusa-mk4\"\n";
    let said = quote(printer);
    for line in ["[rates]", "machine_per_hour = ", "material_per_kg = "] {
        assert!(said.contains(line), "{line}: {said}");
    }
    let said = quote(&format!("{printer}{}", RATES.replace("pla = ", "petg = ")));
    assert!(said.contains("add `pla = …` to material_per_kg"), "{said}");
    let said = quote(&format!("{printer}{}", RATES.replace("setup", "set_up")));
    assert!(
        said.contains("equipoise.toml:9:1: ") && said.contains("`set_up`"),
        "{said}"
    );
}

/// A shop's rates.
const RATES: &str = "[rates]\ncurrency = \"EUR\"\nmachine_per_hour = 3\nlabour_per_hour = 42\n\
    minutes_per_order = 10\nminutes_per_part = 6\nminutes_per_joint = 4\nsetup = 5\n\
    tax_percent = 19\nmaterial_per_kg = { pla = 24.0 }\n";

#[test]
fn a_quote_adds_up_and_is_a_page_and_a_line_of_a_table() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let shop = bench.folder.join("rates");
    fs::create_dir_all(&shop).unwrap();
    let text = format!("printer = \"prusa-mk4\"\n{RATES}");
    fs::write(shop.join("equipoise.toml"), text).unwrap();
    let kit = bench.kit();
    let order = [
        "--json",
        "slice",
        path(&kit),
        "--quote",
        "--out",
        "quoted",
        "--force",
    ];
    let output = equipoise_in(&shop, &order);
    assert_exit(&output, 0);
    let found = common::json(&output);
    let quote = &found["quote"];
    let prices = sum(list(quote, "lines"), "/price");
    assert!((number(quote, "/costs") - prices).abs() < 1e-9);
    let machine = number(quote, "/machine_min") / 60.0 * 3.0;
    assert!((number(quote, "/lines/2/price") - machine).abs() <= 0.005 + 1e-9);
    let parts = number(&found["slices"], "/plates/0/parts_g") * 0.024;
    assert!((number(quote, "/lines/0/price") - parts).abs() <= 0.005 + 1e-9);
    let total = format!("{:.2}", number(quote, "/total"));
    let page = fs::read_to_string(shop.join("quoted/quote.html")).unwrap();
    assert!(page.contains(&total), "{total}");
    let table = fs::read_to_string(shop.join("quoted/quote.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 2);
    // A comma between quotes parts no fields.
    let outside = |line: &str| -> String { line.split('"').step_by(2).collect() };
    let count = |line: &str| outside(line).split(',').count();
    assert_eq!(count(lines[0]), count(lines[1]));
    assert!(
        lines[1].contains(&total) && lines[1].ends_with("EUR"),
        "{table}"
    );
}
