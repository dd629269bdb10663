//! One piece with graded infill: a kit that is printed whole, judged by its files and by the
//! toolpaths of a real slicer.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use common::{
    ELLIPSOID, assert_exit, equipoise, files, has_slicer, json, list, number, path, printed, words,
};
use serde_json::Value;
use tempfile::TempDir;

/// The settings of objects in a plate, as PrusaSlicer reads them.
const SETTINGS: &str = "Metadata/Slic3r_PE_model.config";
/// The objects of a plate and their places.
const MODEL: &str = "3D/3dmodel.model";
/// The options of a small kit.
const SMALL: &str = "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 40mm \
    --pitch 0.4mm --interior graded";

/// A kit in one piece.
struct Bench {
    folder: PathBuf,
    sheet: Value,
}

/// Returns the kit of these tests, which is made once.
fn bench() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("graded");
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        fs::create_dir_all(&folder).unwrap();
        let output = prepare(&folder.join("kit"), SMALL);
        assert_exit(&output, 0);
        let sheet = json(&output);
        Bench { folder, sheet }
    })
}

impl Bench {
    fn kit(&self) -> PathBuf {
        self.folder.join("kit")
    }

    /// Returns the path of the file of its region.
    fn region(&self) -> PathBuf {
        let file = self.sheet.pointer("/infill/file").unwrap();
        self.kit().join(file.as_str().unwrap())
    }
}

fn prepare(out: &Path, options: &str) -> Output {
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual[..], &words(options)].concat())
}

/// Prepares a job that is refused; returns what was said.
fn refuse(options: &str) -> String {
    common::refused(|kit| prepare(kit, options))
}

/// Returns a part of a package as text.
fn text_of(package: &Path, part: &str) -> String {
    let mut archive = zip::ZipArchive::new(fs::File::open(package).unwrap()).unwrap();
    let mut text = String::new();
    archive
        .by_name(part)
        .unwrap()
        .read_to_string(&mut text)
        .unwrap();
    text
}

#[test]
fn a_graded_kit_is_one_part_with_its_region_and_keeps_its_promise() {
    let bench = bench();
    let sheet = &bench.sheet;
    assert_eq!(list(sheet, "parts").len(), 1);
    assert!(list(sheet, "cuts").is_empty() && list(sheet, "voids").is_empty());
    assert_eq!(sheet["infill"]["pattern"], "gyroid");
    assert_eq!(number(sheet, "/infill/nominal_ratio"), 0.15);
    assert_eq!(number(sheet, "/infill/laid_ratio"), 0.142);
    assert!(bench.region().is_file());
    let (code, said) = common::verify(&bench.kit());
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn the_mass_is_that_of_the_solid_less_what_the_region_lacks() {
    let sheet = &bench().sheet;
    let [volume_mm3, laid] =
        ["/infill/volume_mm3", "/infill/laid_ratio"].map(|key| number(sheet, key));
    let density_g_mm3 = number(sheet, "/material/density_g_cm3") / 1000.0;
    let solid_g = number(sheet, "/solid/mass_g");
    let expected_g = solid_g - (1.0 - laid) * volume_mm3 * density_g_mm3;
    let mass_g = number(sheet, "/assembly/mass_g");
    assert!(
        (mass_g / expected_g - 1.0).abs() < 1e-5,
        "{mass_g} {expected_g}"
    );
}

#[test]
fn the_plate_names_the_region_as_prusaslicer_wants_it() {
    let plate = bench().kit().join("plate.3mf");
    let model = text_of(&plate, MODEL);
    assert!(model.contains("<metadata name=\"slic3rpe:Version3mf\">1</metadata>"));
    let settings = text_of(&plate, SETTINGS);
    let (object, volumes) = settings.split_once("<volume ").unwrap();
    assert!(object.contains("key=\"fill_density\" value=\"100%\""));
    // Presets of machines have other values for what is laid around a region.
    for pinned in [
        "infill_overlap",
        "top_solid_layers",
        "thick_bridges",
        "solid_infill_extrusion_width",
    ] {
        assert!(object.contains(&format!("key=\"{pinned}\"")), "{pinned}");
    }
    let (body, region) = volumes.split_once("<volume ").unwrap();
    assert!(body.contains("value=\"ModelPart\"") && !body.contains("fill_density"));
    for said in [
        "key=\"volume_type\" value=\"ParameterModifier\"",
        "key=\"fill_density\" value=\"15%\"",
        "key=\"fill_pattern\" value=\"gyroid\"",
    ] {
        assert!(region.contains(said), "{said}: {region}");
    }
    assert!(!region.contains("perimeters"), "{region}");
    // The volumes take all triangles, each once.
    let ids = |volume: &str, key: &str| -> usize {
        let after = volume.split_once(&format!("{key}=\"")).unwrap().1;
        after.split('"').next().unwrap().parse().unwrap()
    };
    assert_eq!(ids(body, "firstid"), 0);
    assert_eq!(ids(body, "lastid") + 1, ids(region, "firstid"));
    assert_eq!(
        model.matches("<triangle ").count(),
        ids(region, "lastid") + 1
    );
}

#[test]
fn a_region_that_was_changed_is_told() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    common::copy(&bench().kit(), &kit);
    let region = kit.join(bench().region().strip_prefix(bench().kit()).unwrap());
    // The first triangle of the file moves by a tenth of a millimetre.
    let mut bytes = fs::read(&region).unwrap();
    let x = f32::from_le_bytes(bytes[96..100].try_into().unwrap()) + 0.1;
    bytes[96..100].copy_from_slice(&x.to_le_bytes());
    fs::write(&region, bytes).unwrap();
    let (code, said) = common::verify(&kit);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("modifiers/"), "{said}");
}

/// Packs a package again, with one of its parts changed.
fn repack(package: &Path, part: &str, edit: impl Fn(String) -> String) {
    let mut archive = zip::ZipArchive::new(fs::File::open(package).unwrap()).unwrap();
    let mut packed = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).unwrap();
        let mut text = String::new();
        entry.read_to_string(&mut text).unwrap();
        let options = zip::write::SimpleFileOptions::default();
        let name = entry.name().unwrap().into_owned();
        packed.start_file(&name, options).unwrap();
        let is_it = name == part;
        let text = if is_it { edit(text) } else { text };
        packed.write_all(text.as_bytes()).unwrap();
    }
    drop(archive);
    fs::write(package, packed.finish().unwrap().into_inner()).unwrap();
}

#[test]
fn a_plate_that_orders_other_infill_than_the_sheet_is_told() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    for (part, from, to, said) in [
        (SETTINGS, "\"15%\"", "\"15\"", "an infill of 15, not 15%"),
        (SETTINGS, "\"15%\"", "\"30%\"", "an infill of 30%, not 15%"),
        (SETTINGS, "gyroid", "lightning", "filled with lightning"),
        (
            SETTINGS,
            "ParameterModifier",
            "NegativeVolume",
            "is a NegativeVolume",
        ),
        (
            SETTINGS,
            "\"100%\"",
            "\"20%\"",
            "has an infill of 20%, not 100%",
        ),
        (MODEL, "Version3mf\">1<", "Version3mf\">0<", "at the origin"),
    ] {
        common::copy(&bench().kit(), &kit);
        repack(&kit.join("plate.3mf"), part, |text| text.replace(from, to));
        let (code, output) = common::verify(&kit);
        assert_eq!(code, Some(1), "{output}");
        assert!(output.contains(said), "{said}: {output}");
        fs::remove_dir_all(&kit).unwrap();
    }
}

#[test]
fn equal_jobs_give_equal_bytes_and_the_kits_own_job_makes_it_again() {
    let folder = TempDir::new().unwrap();
    let again = folder.path().join("again");
    let job = bench().kit().join("job.toml");
    assert!(
        fs::read_to_string(&job)
            .unwrap()
            .contains("interior = \"graded\"")
    );
    let output = equipoise(&[
        "--json",
        "prepare",
        "--job",
        path(&job),
        "--out",
        path(&again),
    ]);
    assert_exit(&output, 0);
    assert_eq!(files(&again), files(&bench().kit()));
}

#[test]
fn what_one_closed_piece_cannot_have_is_refused_with_a_remedy() {
    let with = |options: &str| {
        refuse(&format!(
            "--goal top --size 60mm --interior graded {options}"
        ))
    };
    for (options, named) in [
        ("--printer formlabs-form4", "without infill"),
        ("--printer objet-connex350", "without infill"),
        ("--printer eos-p396", "without infill"),
        ("--printer prusa-mk4 --fill 2.3", "--fill=2.3"),
        ("--printer prusa-mk4 --ballast auto", "--ballast=auto"),
        ("--printer prusa-mk4 --format stl", "STL files"),
    ] {
        let said = with(options);
        assert!(said.contains(named), "{options}: {said}");
        assert!(said.contains("--interior=hollow"), "{options}: {said}");
    }
    let folder = TempDir::new().unwrap();
    let cuts = folder.path().join("cuts.toml");
    fs::write(
        &cuts,
        "[[cuts]]\nid = \"C1\"\npoint_mm = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n",
    )
    .unwrap();
    let said = with(&format!("--printer prusa-mk4 --cut {}", path(&cuts)));
    assert!(said.contains("cuts are ordered"), "{said}");
}

#[test]
fn what_floats_is_refused_unless_its_toolpaths_are_weighed() {
    let said = refuse("--goal float --size 50mm --interior graded --printer prusa-mk4");
    assert!(said.contains("slice it (--slice)"), "{said}");
}

#[test]
fn rounds_of_another_print_are_refused() {
    let folder = TempDir::new().unwrap();
    let job = folder.path().join("job.toml");
    let own = fs::read_to_string(bench().kit().join("job.toml")).unwrap();
    let own = own.replace("tilted-ellipsoid.stl", ELLIPSOID);
    let rest = ", 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0";
    // Much more mass, a centre three millimetres aside, and no number at all.
    for beyond in [
        format!("1e9, 0.0{rest}"),
        format!("0.0, 67000.0{rest}"),
        format!("nan, 0.0{rest}"),
    ] {
        let rounds = format!("\n[[sliced]]\nmiss_mm = 0.1\nbeyond = [{beyond}]\n");
        fs::write(&job, own.clone() + &rounds).unwrap();
        let out = folder.path().join("kit");
        let output = equipoise(&["prepare", "--job", path(&job), "--out", path(&out)]);
        assert_exit(&output, 2);
        assert!(
            printed(&output).contains("another print"),
            "{}",
            printed(&output)
        );
        assert!(!out.exists());
    }
}

#[test]
fn a_sliced_print_lays_what_it_promises_and_its_job_makes_it_again_without_a_slicer() {
    if !has_slicer() {
        return;
    }
    let folder = TempDir::new().unwrap();
    let [kit, again, toolpaths] =
        ["kit", "again", "toolpaths"].map(|name| folder.path().join(name));
    let output = prepare(&kit, &format!("{SMALL} --slice"));
    assert_exit(&output, 0);
    let output = equipoise(&["--json", "slice", path(&kit), "--out", path(&toolpaths)]);
    assert_exit(&output, 0);
    let gcode = toolpaths.join("plate.gcode");
    let output = equipoise(&["--json", "verify", path(&kit), "--gcode", path(&gcode)]);
    assert_exit(&output, 0);
    let found = json(&output);
    let masses = ["/written/mass_g", "/toolpaths/mass_g"].map(|key| number(&found, key));
    assert!((masses[1] / masses[0] - 1.0).abs() < 3e-3, "{masses:?}");
    let off_mm = number(&found["parts"][0], "/center_off_mm");
    // The loop ends within a hundredth; toolpaths differ from run to run in their last digits.
    assert!(off_mm < 0.015, "{off_mm}");
    let job = kit.join("job.toml");
    let output = equipoise(&[
        "--json",
        "prepare",
        "--job",
        path(&job),
        "--out",
        path(&again),
    ]);
    assert_exit(&output, 0);
    assert_eq!(files(&again), files(&kit));
}

#[test]
fn a_goal_that_no_infill_meets_is_proved_impossible() {
    let folder = TempDir::new().unwrap();
    // In so small an ellipsoid the wall leaves too little to fill sparsely.
    let options = "--goal top --up z --printer prusa-mk4 --size 12mm --interior graded";
    let output = prepare(&folder.path().join("kit"), options);
    assert_exit(&output, 1);
    let found = json(&output);
    assert_eq!(found["verdict"], "impossible");
    assert_eq!(list(&found, "proof_quadric").len(), 10);
}

#[test]
fn the_toolpaths_of_a_real_slicer_keep_the_promise_and_those_without_the_region_are_refused() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let kit = bench.kit();
    let right = bench.folder.join("right");
    let output = equipoise(&["--json", "slice", path(&kit), "--out", path(&right)]);
    assert_exit(&output, 0);
    let gcode = right.join("plate.gcode");
    let output = equipoise(&["--json", "verify", path(&kit), "--gcode", path(&gcode)]);
    assert_exit(&output, 0);
    let found = json(&output);
    let part = &found["parts"][0];
    let off_mm = number(part, "/center_off_mm");
    assert!(off_mm < 0.1, "{off_mm}");
    // Sliced from the part's file alone, the region is solid.
    let part = bench
        .sheet
        .pointer("/parts/0/file")
        .unwrap()
        .as_str()
        .unwrap();
    let wrong = bench.folder.join("wrong.gcode");
    let sliced = Command::new("prusa-slicer")
        .args([
            "--export-gcode",
            "--fill-density",
            "100%",
            "--fill-pattern",
            "rectilinear",
        ])
        .args([
            "--layer-height",
            "0.2",
            "--first-layer-height",
            "0.2",
            "--perimeters",
            "2",
        ])
        .args([
            "--gcode-label-objects",
            "--filament-density",
            "1.24",
            "--center",
            "125,105",
        ])
        .args([
            "--extrusion-width",
            "0.45",
            "-o",
            path(&wrong),
            path(&kit.join(part)),
        ])
        .output();
    assert!(sliced.unwrap().status.success());
    let output = equipoise(&["verify", path(&kit), "--gcode", path(&wrong)]);
    assert_exit(&output, 2);
    assert!(
        printed(&output).contains("another shape"),
        "{}",
        printed(&output)
    );
}
