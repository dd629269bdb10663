//! Claims on kits whose infill follows a given field without planes or balls: skins, and files of
//! sums, products and polynomials.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "figures, and a skipped test says so")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

use common::{ELLIPSOID, assert_exit, equipoise, json, levels, list, number, path, printed, words};
use equipoise::field::{Density, Profile, Skin};
use equipoise::geom::Vector;
use equipoise::io::read_model;
use equipoise::mesh::{MeshDistance, Solid, TriMesh};
use equipoise::repair::weld;
use serde_json::Value;
use tempfile::TempDir;

/// The options of small kits.
const SMALL: &str = "--goal stand --up y --least-angle 1 --size 40mm --pitch 0.4mm \
    --interior graded";
/// A printer without a word on the dialect of its plates.
const MK4: &str = "--printer prusa-mk4";
/// A skin in five densities: depth, densities of core and surface, and its words.
const SKIN: (f64, [f64; 2], &str) = (8.0, [0.2, 0.7], "skin:8mm:linear:0.2..0.7 --levels 5");
/// A field of a sum with a product and a polynomial, denser below.
const FILE: &str = r#"# Denser below and in the middle.
[field]
sum = [
    { linear = { at_origin = 0.45, gradient = [0.0, -0.006, 0.0] } },
    { product = ["skin:6mm:linear:0..1", "uniform:0.1"] },
    { polynomial = [{ coefficient = -0.0002, x = 2 }, { coefficient = -0.0002, z = 2 }] },
]
"#;
/// Largest distance of a written region from the offset that it is, mm.
const OFFSET_MM: f64 = 0.06;

/// A kit with its sheet.
struct Bench {
    kit: PathBuf,
    sheet: Value,
}

impl Bench {
    /// Returns a part or region as it is written.
    fn mesh(&self, file: &Value) -> TriMesh {
        weld(&read_model(&self.kit.join(file.as_str().unwrap())).unwrap())
    }

    /// Returns the density of the material, g/mm³.
    fn density_g_mm3(&self) -> f64 {
        let of = |at: &str| number(&self.sheet, &format!("/infill{at}"));
        let volume_mm3 = of("/volume_mm3") - of("/inner/0/volume_mm3");
        of("/mass_g") / (of("/laid_ratio") * volume_mm3)
    }
}

fn prepare(out: &Path, options: &str) -> Output {
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual[..], &words(options)].concat())
}

/// Returns an empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("drawn_{name}"));
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn bench(name: &str, options: &str) -> Bench {
    let kit = folder(name).join("kit");
    let output = prepare(&kit, &format!("{SMALL} {options}"));
    assert_exit(&output, 0);
    let sheet = json(&output);
    Bench { kit, sheet }
}

/// Returns the kit of a skin, which is made once.
fn skin() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| bench("skin", &format!("{MK4} --field {}", SKIN.2)))
}

/// Returns a file with the field of these tests.
fn field_file() -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let file = FOLDER.get_or_init(|| folder("fields")).join("dense.toml");
    fs::write(&file, FILE).unwrap();
    file
}

/// Returns the kit of a file, which is made once.
fn of_file() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    let options = || format!("{MK4} --levels 6 --field {}", path(&field_file()));
    BENCH.get_or_init(|| bench("file", &options()))
}

/// Returns the mass and the centre of a mesh with a field, by `inspect`.
fn inspected(file: &str, options: &str) -> (f64, Vector) {
    let output = equipoise(&[&["--json", "inspect", file][..], &words(options)].concat());
    let found = json(&output);
    let center = list(&found["field"]["body"], "center_mm");
    let at = |axis: usize| center[axis].as_f64().unwrap();
    (
        number(&found, "/field/mass_g"),
        Vector::new(at(0), at(1), at(2)),
    )
}

#[test]
fn the_regions_of_a_skin_are_offsets_of_the_surface_one_in_the_other() {
    let bench = skin();
    let (depth_mm, [core, surface], _) = SKIN;
    let all = levels(&bench.sheet);
    assert!(all.len() >= 4, "{all:?}");
    let outside = bench.mesh(&list(&bench.sheet, "parts")[0]["file"]);
    let surface_of = MeshDistance::new(&outside);
    for pair in all.windows(2) {
        let [around, within] = [0, 1].map(|at| pair[at]["laid_ratio"].as_f64().unwrap());
        assert!(within < around);
        let share = (0.5 * (around + within) - core) / (surface - core);
        let at_mm = depth_mm * (1.0 - share);
        let region = bench.mesh(&pair[1]["file"]);
        let depths = region.vertices().iter().map(|p| surface_of.signed(p));
        let [least, most] = depths.fold([f64::INFINITY, 0.0], |[least, most], depth| {
            [f64::min(least, depth), f64::max(most, depth)]
        });
        eprintln!("region at {at_mm:.4} mm: {least:.4} to {most:.4} mm");
        assert!(least > at_mm - 0.01 && most < at_mm + OFFSET_MM);
    }
    let (code, said) = common::verify(&bench.kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn a_skin_weighs_in_its_regions_what_it_weighs_as_a_field() {
    let bench = skin();
    let (depth_mm, densities, _) = SKIN;
    let part = bench.mesh(&list(&bench.sheet, "parts")[0]["file"]);
    let solid = Solid::new(part).unwrap();
    let field = Skin::new(&solid, depth_mm, Profile::Linear, densities).unwrap();
    let interior = bench.mesh(&bench.sheet["infill"]["file"]);
    let (within, aabb) = (MeshDistance::new(&interior), interior.aabb());
    let (mut count, mut sum) = (0.0, 0.0);
    for index in 0..60_000_u32 {
        // Points that fill the box evenly (R. Roberts' sequence).
        let step = Vector::new(0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9);
        let share = (step * f64::from(index)).map(f64::fract);
        let at = aabb.min + aabb.size().component_mul(&share);
        if within.signed(&at) > 0.0 {
            (count, sum) = (count + 1.0, sum + field.at(&at));
        }
    }
    let printed_g: f64 = levels(&bench.sheet)
        .iter()
        .map(|level| level["mass_g"].as_f64().unwrap())
        .sum();
    let volume_mm3 = number(&bench.sheet, "/infill/volume_mm3");
    let printed = printed_g / (bench.density_g_mm3() * volume_mm3);
    let exact = sum / count;
    eprintln!("mean density: {printed:.5} printed, {exact:.5} of the field");
    // A step is an eighth of the whole.
    assert!((printed - exact).abs() < 0.01, "{printed} {exact}");
}

#[test]
fn a_gaussian_skin_from_solid_print_leaves_its_densest_layer_to_the_wall() {
    let bench = bench("gauss", &format!("{MK4} --field skin:4mm:gauss:0.2..1"));
    let all = levels(&bench.sheet);
    let set: Vec<f64> = all
        .iter()
        .map(|it| it["nominal_ratio"].as_f64().unwrap())
        .collect();
    // Four densities, of which solid print is no region.
    assert_eq!(set.len(), 3, "{set:?}");
    assert!(set.iter().all(|nominal| *nominal < 0.99), "{set:?}");
    let outside = bench.mesh(&list(&bench.sheet, "parts")[0]["file"]);
    let outermost = bench.mesh(&bench.sheet["infill"]["file"]);
    let wall_mm = MeshDistance::new(&outside).min_distance_to(&outermost);
    eprintln!("solid print to a depth of {wall_mm:.4} mm");
    assert!(wall_mm > 2.0, "{wall_mm}");
    assert_eq!(common::verify(&bench.kit).0, Some(0));
}

#[test]
fn a_file_weighs_in_its_regions_what_inspect_says_of_it_on_the_kit() {
    let bench = of_file();
    let field = bench.kit.join("field.toml");
    assert_eq!(fs::read_to_string(&field).unwrap(), FILE);
    assert_eq!(bench.sheet["infill"]["field"], "field.toml");
    let (code, said) = common::verify(&bench.kit);
    assert_eq!(code, Some(0), "{said}");
    let smooth = folder("inspected").join("smooth.toml");
    // Without the skin, which would be that of the hollowed surface too.
    let text = FILE.replace(
        "    { product = [\"skin:6mm:linear:0..1\", \"uniform:0.1\"] },\n",
        "",
    );
    assert_ne!(text, FILE);
    fs::write(&smooth, text).unwrap();
    let options = format!("{MK4} --levels 6 --field {}", path(&smooth));
    let bench = self::bench("smooth", &options);
    let named = format!("--printer prusa-mk4 --field {}", path(&smooth));
    let (all_g, all) = inspected(ELLIPSOID, &format!("--size 40mm {named}"));
    let hollowed = bench.kit.join("hollowed.stl");
    let (wall_g, wall) = inspected(path(&hollowed), &format!("--unit mm {named}"));
    let exact_g = all_g - wall_g;
    let exact = (all * all_g - wall * wall_g) / exact_g;
    // The regions as they are written, in the frame of the part's file.
    let all = levels(&bench.sheet);
    let meshes: Vec<TriMesh> = all.iter().map(|it| bench.mesh(&it["file"])).collect();
    let (mut around, mut laid) = (0.0, equipoise::mass::Moments::default());
    for (level, mesh) in all.iter().zip(&meshes) {
        let density = level["laid_ratio"].as_f64().unwrap();
        laid += equipoise::mass::moments_of_mesh(mesh) * (density - around);
        around = density;
    }
    let printed_g = laid.volume() * bench.density_g_mm3();
    let pose = &list(&bench.sheet, "parts")[0]["print_from_model"];
    let center = to_model(pose, &laid.centroid().coords);
    let off_mm = (center - exact).norm();
    eprintln!(
        "{} regions: {printed_g:.4} g printed, {exact_g:.4} g of the field, centres {off_mm:.4} mm apart",
        all.len()
    );
    assert!(
        (printed_g / exact_g - 1.0).abs() < 0.01,
        "{printed_g} {exact_g}"
    );
    assert!(off_mm < 0.05, "{off_mm}");
}

/// Returns a point of a part's file in the model, by the pose on the sheet.
fn to_model(pose: &Value, at: &Vector) -> Vector {
    let entry = |row: usize, column: usize| pose[row][column].as_f64().unwrap();
    let moved = Vector::from_fn(|row, _| at[row] - entry(row, 3));
    Vector::from_fn(|column, _| (0..3).map(|row| entry(row, column) * moved[row]).sum())
}

#[test]
#[ignore = "long: two kits; tests of levels and skins hold the same; run with -- --ignored"]
fn a_kit_of_a_file_is_made_again_from_its_own_folder_alone_and_on_other_threads() {
    let bench = of_file();
    let folder = folder("again");
    let copy = folder.join("copy");
    common::copy(&bench.kit, &copy);
    // The file of the kit is for people: the job has the text.
    fs::remove_file(copy.join("field.toml")).unwrap();
    for threads in ["1", "2"] {
        let kit = folder.join(threads);
        let job = copy.join("job.toml");
        let replay = ["prepare", "--threads", threads, "--job", path(&job)];
        let output = equipoise(&[&replay[..], &["--out", path(&kit)]].concat());
        assert_exit(&output, 0);
        assert!(
            common::files(&kit) == common::files(&bench.kit),
            "{threads}"
        );
    }
    let page = fs::read_to_string(bench.kit.join("certificate.html")).unwrap();
    assert!(page.contains("The field that was ordered has") && page.contains("field.toml"));
}

#[test]
fn a_skin_is_the_same_bytes_on_one_thread_and_on_two() {
    let folder = folder("threads");
    for threads in ["1", "2"] {
        let kit = folder.join(threads);
        let job = skin().kit.join("job.toml");
        let replay = ["prepare", "--threads", threads, "--job", path(&job)];
        let output = equipoise(&[&replay[..], &["--out", path(&kit)]].concat());
        assert_exit(&output, 0);
        assert!(
            common::files(&kit) == common::files(&skin().kit),
            "{threads}"
        );
    }
}

#[test]
fn a_field_that_does_not_do_it_is_an_answer_with_the_best_densities_as_a_hint() {
    let folder = TempDir::new().unwrap();
    let (kit, file) = (folder.path().join("kit"), folder.path().join("top.toml"));
    // Dense above.
    let text = "field = { linear = { at_origin = 0.4, gradient = [0.0, 0.01, 0.0] } }\n";
    fs::write(&file, text).unwrap();
    let steep = SMALL.replace("--least-angle 1", "--least-angle 3.5");
    for field in [path(&file), "skin:8mm:linear:0.2..0.7"] {
        let output = prepare(&kit, &format!("{steep} {MK4} --field {field}"));
        assert_exit(&output, 1);
        let answer = json(&output);
        let reason = answer["reason"].as_str().unwrap();
        assert!(reason.starts_with("Not met: the field"), "{reason}");
        assert!(reason.contains("3.51° are asked"), "{reason}");
        let hints = answer["hints"].to_string();
        assert!(hints.contains("leave `field"), "{answer}");
        assert!(!kit.exists());
    }
}

#[test]
fn fields_that_cannot_be_printed_are_refused_with_the_place_and_what_to_type() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str, text: &str| {
        let file = folder.path().join(name);
        fs::write(&file, text).unwrap();
        path(&file).to_owned()
    };
    let linear = |origin: f64, slope: f64| {
        format!("field = {{ linear = {{ at_origin = {origin}, gradient = [0.0, {slope}, 0.0] }} }}")
    };
    let levels = "field = { levels = { quadric = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, \
        0.0], cuts = [1.0], densities = [0.2, 0.4] } }";
    for (options, said) in [
        (file("levels.toml", levels), "leave the levels out"),
        (file("sparse.toml", &linear(0.1, 0.001)), "lays from 0.142"),
        (file("dense.toml", &linear(0.9, 0.004)), "scale the field"),
        (
            file("none.toml", &linear(0.9, 0.1)),
            "a density lies from 0 to 1",
        ),
        (
            file("typo.toml", "[field]\nsun = []"),
            "did you mean `sum`?",
        ),
        ("missing.toml".to_owned(), "check its name"),
        ("skin:4mm:cubic:0.2..1".to_owned(), "write gauss or linear"),
        ("skin:4mm:gauss:0.05..1".to_owned(), "densities from 0.142"),
        (
            "skin:4mm:gauss:0.2..0.995".to_owned(),
            "or 1 for solid print",
        ),
        (
            "skin:4mm:gauss:0.2..1 --density 15%..60%".to_owned(),
            "leave one of them out",
        ),
        (
            format!("{} --density 15%..60%", file("a.toml", &linear(0.4, 0.001))),
            "leave one of them out",
        ),
        ("skin:4mm:gauss:0.2..1 --levels 2".to_owned(), "--levels=3"),
        ("skin:4mm:gauss:0.2..1 --levels 13".to_owned(), "2 to 12"),
        (
            "skin:400mm:linear:0.2..1".to_owned(),
            "nothing but solid print",
        ),
    ] {
        let error =
            common::refused(|kit| prepare(kit, &format!("{SMALL} {MK4} --field {options}")));
        let error = error.replace('\n', " ");
        assert!(error.contains(said), "{options}: {error}");
    }
}

#[test]
fn the_plate_of_every_dialect_has_the_regions_of_a_skin_and_is_judged() {
    for dialect in ["orca", "cura"] {
        let profile = folder(dialect).join("own.toml");
        let text = format!(
            "id = \"own\"\nname = \"Own\"\ninherits = \"prusa-mk4\"\n\
             dialect = {{ value = \"{dialect}\", source = \"a test\", sure = \"own-choice\" }}\n"
        );
        fs::write(&profile, text).unwrap();
        let options = format!("--printer {} --field {}", path(&profile), SKIN.2);
        let bench = bench(&format!("{dialect}_kit"), &options);
        assert_eq!(levels(&bench.sheet).len(), levels(&skin().sheet).len());
        let (code, said) = common::verify(&bench.kit);
        assert_eq!(code, Some(0), "{dialect}: {said}");
    }
}

#[test]
fn toolpaths_put_the_centre_of_skins_and_files_where_the_sheet_says() {
    if !common::has_slicer() {
        return;
    }
    for (name, bench) in [("skin", skin()), ("file", of_file())] {
        let toolpaths = folder(&format!("toolpaths_{name}")).join("gcode");
        let order = ["--json", "slice", path(&bench.kit), "--out"];
        let output = equipoise(&[&order[..], &[path(&toolpaths)]].concat());
        // Slicers lay more at the borders of regions, and nested ones have many: the judge says so.
        let code = output.status.code();
        assert!(matches!(code, Some(0 | 1)), "{}", printed(&output));
        let gcode = toolpaths.join("plate.gcode");
        let order = ["--json", "verify", path(&bench.kit), "--gcode"];
        let found = json(&equipoise(&[&order[..], &[path(&gcode)]].concat()));
        let part = &list(&found, "parts")[0];
        let off_mm = number(part, "/center_off_mm");
        let laid_g = number(part, "/volume_mm3") * bench.density_g_mm3();
        let promised_g = number(&bench.sheet, "/assembly/mass_g");
        let more = laid_g / promised_g - 1.0;
        eprintln!("{name}: {laid_g:.3} g laid, {promised_g:.3} g promised, {off_mm:.4} mm off");
        assert!(off_mm < 0.1, "{name}: {off_mm}");
        // Lost regions would be solid: twice the mass.
        assert!((0.0..0.15).contains(&more), "{name}: {more}");
        let checks = list(&found, "checks");
        let centers = checks.iter().find(|it| it["kind"] == "printed-centers");
        let [value, limit] = ["/value", "/limit"].map(|at| number(centers.unwrap(), at));
        assert!(value <= limit, "{name}: {value} {limit}");
    }
}
