//! CuraEngine slices the plates of kits: hollow ones, and graded ones in the words of every slicer.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use common::{ELLIPSOID, assert_exit, cura_definitions, json, list, number, path, printed, words};

/// The options of a small hollow kit in two halves.
const HOLLOW: &str = "--goal stand --up y --least-angle 2 --size 40mm --pitch 0.4mm";
/// The options of a small graded kit.
const GRADED: &str =
    "--goal stand --up y --least-angle 2 --size 40mm --pitch 0.4mm --interior graded";

/// Runs the program with Cura's definitions in a folder.
fn run(definitions: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipoise"));
    command.env("CURA_ENGINE_SEARCH_PATH", definitions);
    command.args(arguments).output().unwrap()
}

/// Returns an empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("cura")
        .join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Makes a kit for a printer; returns its folder.
fn prepare(definitions: &Path, name: &str, options: &str) -> PathBuf {
    let kit = folder(name).join("kit");
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
    assert_exit(
        &run(definitions, &[&usual[..], &words(options)].concat()),
        0,
    );
    kit
}

/// Returns the hollow kit of these tests, which is made once.
fn hollow(definitions: &Path) -> &'static Path {
    static KIT: OnceLock<PathBuf> = OnceLock::new();
    KIT.get_or_init(|| {
        prepare(
            definitions,
            "hollow",
            &format!("{HOLLOW} --printer prusa-mk4"),
        )
    })
}

/// Slices a kit by CuraEngine beside it.
fn slice(definitions: &Path, kit: &Path, options: &[&str]) -> Output {
    let usual = ["--json", "slice", path(kit), "--slicer", "cura", "--force"];
    run(definitions, &[&usual[..], options].concat())
}

/// Returns the folder of the toolpaths beside a kit.
fn beside(kit: &Path) -> PathBuf {
    kit.with_file_name("kit-gcode")
}

#[test]
fn the_plates_of_a_hollow_kit_keep_its_promise() {
    let Some(definitions) = cura_definitions() else {
        return;
    };
    let kit = hollow(&definitions);
    let output = slice(&definitions, kit, &[]);
    assert_exit(&output, 0);
    let found = json(&output);
    let slicer = found["slices"]["slicer"].as_str().unwrap();
    assert!(slicer.starts_with("CuraEngine "), "{slicer}");
    let plate = &list(&found["slices"], "plates")[0];
    assert!(number(plate, "/minutes") > 5.0);
    let [parts_g, support_g, filament_g] =
        ["/parts_g", "/support_g", "/filament_g"].map(|key| number(plate, key));
    // The engine counts its brim and its support in, and nothing else.
    assert!((filament_g - parts_g - support_g).abs() < 0.1, "{plate}");
    let text = fs::read_to_string(beside(kit).join("plate.gcode")).unwrap();
    for part in list(&common::checklist(kit), "parts") {
        let label = format!(";MESH:{}\n", part["id"].as_str().unwrap());
        assert!(text.contains(&label), "{label}");
    }
    assert!(text.contains(";TIME:") && !text.contains(";TIME:6666"));
}

#[test]
fn a_profile_may_change_speeds_and_no_sizes() {
    let Some(definitions) = cura_definitions() else {
        return;
    };
    let kit = hollow(&definitions);
    let profile = kit.with_file_name("shop.ini");
    let of = |output: &Output, key: &str| number(&json(output), &format!("/slices/plates/0/{key}"));
    let usual = slice(
        &definitions,
        kit,
        &["--out", path(&kit.with_file_name("usual"))],
    );
    fs::write(
        &profile,
        "speed_infill = 10\nspeed_wall_x = 10\nline_width = 0.8\n",
    )
    .unwrap();
    let out = kit.with_file_name("slow");
    let slow = slice(
        &definitions,
        kit,
        &["--profile", path(&profile), "--out", path(&out)],
    );
    assert_exit(&slow, 0);
    assert!((of(&usual, "parts_g") - of(&slow, "parts_g")).abs() < 0.02);
    assert!(of(&slow, "minutes") > 1.2 * of(&usual, "minutes"));
    fs::write(&profile, "perimeter_speed = 10\n").unwrap();
    let output = slice(
        &definitions,
        kit,
        &["--profile", path(&profile), "--out", path(&out)],
    );
    assert_exit(&output, 2);
    assert!(printed(&output).contains("no setting perimeter_speed"));
}

/// Writes a program that names itself as the engine, and runs these lines in place of it.
#[cfg(unix)]
fn write_engine(file: &Path, lines: &str) {
    use std::os::unix::fs::PermissionsExt;
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = help ]; then echo Cura_SteamEngine version 4.13.0; exit; fi\n\
         if [ \"$1\" = --help ]; then exit 1; fi\n\
         while [ $# -gt 0 ]; do if [ \"$1\" = -o ]; then out=$2; fi; shift; done\n{lines}\n"
    );
    fs::write(file, text).unwrap();
    fs::set_permissions(file, fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn an_engine_that_lays_nothing_is_found_whatever_its_exit_code_says() {
    // No real engine is needed here, nor Cura's own list of settings.
    let list = folder("list");
    for file in ["fdmprinter.def.json", "fdmextruder.def.json"] {
        fs::write(list.join(file), "{}").unwrap();
    }
    let kit = prepare(&list, "traps", &format!("{HOLLOW} --printer prusa-mk4"));
    let engine = list.join("CuraEngine");
    let slice = |definitions: &Path| {
        let order = ["slice", path(&kit), "--slicer", path(&engine)];
        let output = run(definitions, &order);
        assert_exit(&output, 2);
        assert!(!beside(&kit).exists());
        printed(&output)
    };
    for (lines, said) in [
        (
            "echo 'no mesh' >&2; exit 0",
            "wrote no toolpaths for plate.3mf: no mesh",
        ),
        ("echo ';TIME:6666' >$out; exit 0", "wrote no toolpaths"),
        (
            "printf ';LAYER:0\\nG1 X1 Y1 E1\\n' >$out; exit 0",
            "names no print time",
        ),
        ("echo 'std::bad_alloc' >&2; exit 0", "more than 8 GiB"),
    ] {
        write_engine(&engine, lines);
        let found = slice(&list);
        assert!(found.contains(said), "{lines}: {found}");
    }
    if !Path::new("/usr/share/cura").exists() && !Path::new("/usr/local/share/cura").exists() {
        let found = slice(&folder("nothing"));
        assert!(found.contains("CURA_ENGINE_SEARCH_PATH"), "{found}");
        assert!(found.contains("apt-get install cura"), "{found}");
    }
}

#[test]
fn a_graded_kit_is_made_again_with_what_the_engine_lays() {
    let Some(definitions) = cura_definitions() else {
        return;
    };
    let options = format!("{GRADED} --printer prusa-mk4 --slice --slicer cura");
    let kit = prepare(&definitions, "rounds", &options);
    let misses = list(&common::checklist(&kit)["infill"], "misses_mm").to_vec();
    let first_mm = misses[0].as_f64().unwrap();
    let job = fs::read_to_string(kit.join("job.toml")).unwrap();
    let (_, own) = job.split_once("[toolpaths]").unwrap();
    let last = own.lines().find_map(|line| line.strip_prefix("miss_mm = "));
    let last_mm: f64 = last.unwrap().parse().unwrap();
    eprintln!("{first_mm} mm beside the promise before, {last_mm} mm after");
    assert!(first_mm > 0.02 && last_mm < 0.01, "{first_mm} {last_mm}");
    let output = slice(&definitions, &kit, &[]);
    assert_exit(&output, 0);
    let (code, said) = common::verify(&kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn an_engine_that_lays_more_infill_than_the_profile_says_is_counted_with() {
    let Some(definitions) = cura_definitions() else {
        return;
    };
    let options =
        format!("{GRADED} --printer prusa-mk4 --infill 40% --levels 3 --slice --slicer cura");
    let kit = prepare(&definitions, "more-infill", &options);
    let infill = &common::checklist(&kit)["infill"];
    let [nominal, laid, ratio] =
        ["/nominal_ratio", "/laid_ratio", "/slicer_ratio"].map(|key| number(infill, key));
    assert_eq!(nominal, 0.4);
    assert!((1.04..1.2).contains(&ratio), "{ratio}");
    // The profile's own is 0.3736.
    assert!((laid / 0.373_55 - ratio).abs() < 1e-9, "{laid}");
    let output = slice(&definitions, &kit, &[]);
    assert_exit(&output, 0);
    let laid_g = number(&json(&output), "/slices/plates/0/parts_g");
    let promised_g = number(&common::checklist(&kit), "/assembly/mass_g");
    assert!(
        (laid_g / promised_g - 1.0).abs() < 0.01,
        "{laid_g} {promised_g}"
    );
    assert_exit(&run(&definitions, &["verify", path(&kit)]), 0);
    refuse_other_ratio(&definitions, &kit);
}

/// Asserts that a job whose slicer would lay half of the infill more is refused.
fn refuse_other_ratio(definitions: &Path, kit: &Path) {
    let file = kit.join("job.toml");
    let job = fs::read_to_string(&file).unwrap();
    let lines = job
        .lines()
        .map(|line| match line.starts_with("infill_ratio = ") {
            true => "infill_ratio = 1.5",
            false => line,
        });
    let other = kit.join("other.toml");
    fs::write(&other, lines.collect::<Vec<&str>>().join("\n")).unwrap();
    let out = kit.with_file_name("other");
    let output = run(
        definitions,
        &["prepare", "--job", path(&other), "--out", path(&out)],
    );
    assert_exit(&output, 2);
    assert!(
        printed(&output).contains("[[sliced]]"),
        "{}",
        printed(&output)
    );
    assert!(!out.exists());
}

/// A printer with a table of infill, whose slicer reads a dialect.
fn dialect_profile(file: &Path, dialect: &str) {
    let text = format!(
        "id = \"own\"\nname = \"Own\"\ninherits = \"prusa-mk4\"\n\
         dialect = {{ value = \"{dialect}\", source = \"a test\", sure = \"own-choice\" }}\n"
    );
    fs::write(file, text).unwrap();
}

#[test]
fn the_plate_of_every_dialect_is_printed_alike() {
    let mut masses: Vec<[f64; 4]> = Vec::new();
    for dialect in ["prusa", "orca", "cura"] {
        let bench = folder(dialect);
        let profile = bench.join("own.toml");
        dialect_profile(&profile, dialect);
        let kit = bench.join("kit");
        let options = format!("{GRADED} --printer {}", path(&profile));
        let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
        assert_exit(
            &common::equipoise(&[&usual[..], &words(&options)].concat()),
            0,
        );
        let (code, said) = common::verify(&kit);
        assert_eq!(code, Some(0), "{dialect}: {said}");
        let page = fs::read_to_string(kit.join("job.html")).unwrap();
        let is_tried = dialect == "prusa";
        assert_eq!(
            page.contains("was tried") || page.contains("not tried with"),
            !is_tried
        );
        let mut row = |output: Output| {
            // What an engine lays in a region for the first time may break a limit (1).
            assert_ne!(output.status.code(), Some(2), "{}", printed(&output));
            let found = json(&output);
            let center = found.pointer("/judgement/toolpaths/center_mm").unwrap();
            let at = |axis: usize| center[axis].as_f64().unwrap();
            masses.push([
                number(&found, "/slices/plates/0/parts_g"),
                at(0),
                at(1),
                at(2),
            ]);
        };
        if let Some(definitions) = cura_definitions() {
            row(slice(&definitions, &kit, &[]));
        }
    }
    for row in &masses {
        for (found, first) in row.iter().zip(&masses[0]) {
            assert!((found - first).abs() < 0.01, "{masses:?}");
        }
    }
}

#[test]
fn prusaslicer_prints_the_regions_of_a_plate_in_other_words() {
    if Command::new("prusa-slicer").arg("--help").output().is_err() {
        eprintln!("SKIPPED: no prusa-slicer here; apt-get install prusa-slicer");
        return;
    }
    let bench = folder("reworded");
    let profile = bench.join("own.toml");
    let [kit, out] = ["kit", "toolpaths"].map(|name| bench.join(name));
    dialect_profile(&profile, "orca");
    let options = format!("{GRADED} --printer {}", path(&profile));
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
    assert_exit(
        &common::equipoise(&[&usual[..], &words(&options)].concat()),
        0,
    );
    let output = common::equipoise(&["--json", "slice", path(&kit), "--out", path(&out)]);
    assert_exit(&output, 0);
    let [sheet, found] = [common::checklist(&kit), json(&output)];
    let sheet_g = common::sum(list(&sheet, "parts"), "/mass_g");
    let laid_g = number(&found, "/slices/plates/0/parts_g");
    // A solid print would weigh a third more.
    assert!((laid_g / sheet_g - 1.0).abs() < 0.05, "{laid_g} {sheet_g}");
}

/// Runs these lines in place of OrcaSlicer.
#[cfg(unix)]
fn write_orca(file: &Path, lines: &str) {
    use std::os::unix::fs::PermissionsExt;
    let text = format!(
        "#!/bin/sh\nif [ \"$1\" = --help ]; then echo OrcaSlicer-2.3.2:; exit; fi\n{lines}\n"
    );
    fs::write(file, text).unwrap();
    fs::set_permissions(file, fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn orcaslicer_gets_a_plate_in_its_own_words_with_three_presets() {
    let bench = folder("orca-command");
    let [kit, seen] = ["kit", "seen"].map(|name| bench.join(name));
    let options = format!("{GRADED} --printer prusa-mk4");
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
    assert_exit(
        &common::equipoise(&[&usual[..], &words(&options)].concat()),
        0,
    );
    let orca = bench.join("orca-slicer");
    let slice = || common::equipoise(&["slice", path(&kit), "--slicer", path(&orca)]);
    // It keeps what it was given, and lays nothing.
    write_orca(
        &orca,
        &format!("cp -r . '{}'; echo \"$@\"; exit 0", path(&seen)),
    );
    let output = slice();
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(
        said.contains("OrcaSlicer 2.3.2 wrote no toolpaths"),
        "{said}"
    );
    for option in [
        "--slice 0",
        "--arrange 0",
        "--outputdir",
        "machine.json;process.json",
    ] {
        assert!(said.contains(option), "{option}: {said}");
    }
    let read = |file: &str| -> serde_json::Value {
        serde_json::from_slice(&fs::read(seen.join(file)).unwrap()).unwrap()
    };
    let [machine, process, filament] = ["machine.json", "process.json", "filament.json"].map(read);
    assert_eq!(machine["printable_area"][2], "250x210");
    assert_eq!(
        (&process["type"], &process["line_width"]),
        (&"process".into(), &"0.45".into())
    );
    assert_eq!(filament["filament_density"][0], "1.24");
    let bytes = fs::read(seen.join("plate.3mf")).unwrap();
    let orders = equipoise::io::threemf::decode_orders(&bytes).unwrap();
    assert_eq!(orders.len(), 1);
    assert_eq!(orders[0].dialect, equipoise::base::dialect::Dialect::Orca);
    let object = orders[0].objects.values().next().unwrap();
    assert_eq!(object.volumes.len(), 2, "the body and its region");
}
