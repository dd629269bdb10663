//! Prints whose inside is made of cells: one piece of thin walls with openings, all of which drain.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stderr,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;
use crate::drains::{assert_blamed, broken};

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use common::{
    SL1S, assert_exit, checklist, equipoise, files, json, list, number, path, prepare, printed,
    verify, words,
};
use equipoise::base::watch::Watch;
use equipoise::comb::{InnerCells, InnerSizes};
use equipoise::geom::{Frame, Point, Vector};
use equipoise::mesh::primitives::{cuboid, cylinder};
use equipoise::mesh::{Csg, MeshDistance, TriMesh};
use equipoise::printer::{Printer, Undrainable};
use equipoise::verify::{Evidence, find_misstatements, judge, read_kit};
use serde_json::Value;

/// A standing model whose inside is made of cells.
const CELLS: &str = "--size 80mm --pitch 0.3mm --goal stand --up z --interior cells";
/// What the wall between two cells may lack, mm.
const LACK_MM: f64 = 0.01;

/// Prepares the shipped model with an inside of cells.
fn prepare_cells(out: &Path, options: &str) -> Output {
    prepare(out, &words(&format!("{CELLS} {options}")))
}

/// A kit of sintered powder, and its checklist. It is made once and never changed.
fn sintered() -> &'static (PathBuf, Value) {
    static MADE: OnceLock<(PathBuf, Value)> = OnceLock::new();
    MADE.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        let output = prepare_cells(&kit, "--printer formlabs-fuse1");
        assert_exit(&output, 0);
        (kit, json(&output))
    })
}

/// Asserts that an order is refused with these words, and that nothing is written.
fn assert_refused(options: &str, says: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("kit");
    let output = prepare(&out, &words(options));
    assert_exit(&output, 2);
    for words in says {
        let said = printed(&output);
        assert!(said.contains(words), "{words:?} is missing in\n{said}");
    }
    assert_eq!(files(folder.path()).len(), 0);
}

#[test]
fn a_piece_of_powder_stands_with_an_inside_of_cells_that_all_drain() {
    let (kit, sheet) = sintered();
    assert_eq!(list(sheet, "parts").len(), 1);
    assert_eq!(list(sheet, "cuts").len(), 0);
    assert!(!list(sheet, "drains").is_empty());
    let cells = &sheet["cells"];
    let (count, doors) = (list(cells, "places_mm"), list(cells, "openings_mm"));
    assert!(count.len() >= 8, "{} cells", count.len());
    assert!(doors.len() + 1 >= count.len(), "{} openings", doors.len());
    assert_eq!(number(cells, "/opening_mm"), 5.0);
    let check = |kind: &str| {
        let mut checks = list(sheet, "checks").iter();
        let found = checks.find(|check| check["kind"] == kind);
        found.unwrap_or_else(|| panic!("no check of {kind}"))
    };
    let wall_mm = number(check("cell-walls"), "/value");
    assert!(wall_mm >= number(cells, "/wall_mm") - LACK_MM, "{wall_mm}");
    assert!(number(check("cell-openings"), "/value") >= 5.0 - LACK_MM);
    let (code, said) = verify(kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn cells_weigh_what_is_promised_and_less_than_solid_print() {
    let (kit, sheet) = sintered();
    let volume = |of: &str| number(sheet, &format!("/{of}/volume_mm3"));
    let drained_mm3 = number(sheet, "/cells/drained_mm3");
    let without_mm3 = volume("solid") - volume("hollowed");
    assert!((drained_mm3 / without_mm3 - 1.0).abs() < 1e-5);
    // The piece itself, from its own file.
    let evidence = read_kit(kit).unwrap();
    let written_mm3 = evidence.parts[0].mesh.signed_volume_mm3();
    let promised_mm3 = volume("assembly");
    assert!((written_mm3 / promised_mm3 - 1.0).abs() < 1e-3);
}

#[test]
fn the_sheet_tells_the_cells_their_walls_and_what_drains() {
    let (kit, sheet) = sintered();
    let page = std::fs::read_to_string(kit.join("job.html")).unwrap();
    let count = list(&sheet["cells"], "places_mm").len();
    let words = format!("{count} cells");
    for words in [words.as_str(), "no more powder"] {
        assert!(page.contains(words), "{words:?} is missing");
    }
    let proof = std::fs::read_to_string(kit.join("certificate.html")).unwrap();
    assert!(proof.contains("Weigh the cleaned piece"));
}

#[test]
fn another_slicer_opens_the_piece_and_exposes_what_it_weighs() {
    if Command::new("prusa-slicer").arg("--help").output().is_err() {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
        return;
    }
    let (kit, sheet) = sintered();
    let folder = tempfile::tempdir().unwrap();
    let [ini, sliced] = ["sl1s.ini", "theirs.sl1"].map(|name| folder.path().join(name));
    let layer = format!("layer_height = {}", sheet["printer"]["layer_mm"]);
    std::fs::write(&ini, SL1S.replace("layer_height = 0.05", &layer)).unwrap();
    let part = kit.join(sheet["parts"][0]["file"].as_str().unwrap());
    let output = Command::new("prusa-slicer")
        .args(["--export-sla", "--center", "63.5,40", "--load", path(&ini)])
        .args(["-o", path(&sliced), path(&part)])
        .output()
        .unwrap();
    assert!(sliced.is_file(), "{}", printed(&output));
    let output = equipoise(&["--json", "verify", path(kit), "--gcode", path(&sliced)]);
    let judgement = json(&output);
    let volume_ratio = number(&judgement, "/parts/0/volume_ratio");
    assert!((volume_ratio - 1.0).abs() < 5e-4, "{volume_ratio}");
    assert_exit(&output, 0);
}

#[test]
#[ignore = "long: a minute; run with -- --ignored"]
fn a_piece_of_resin_stands_with_an_inside_of_cells_and_encloses_none() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let output = prepare_cells(&kit, "--printer formlabs-form4 --least-angle 0.5");
    assert_exit(&output, 0);
    let sheet = json(&output);
    assert!(list(&sheet["cells"], "places_mm").len() >= 8);
    assert_eq!(list(&sheet, "drains").len(), 2);
    let mut checks = list(&sheet, "checks").iter();
    let cups = checks.find(|check| check["kind"] == "cups").unwrap();
    assert!(number(cups, "/value") < 100.0, "{cups}");
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
#[ignore = "long: two kits; run with -- --ignored"]
fn a_replayed_job_with_a_size_of_cells_gives_the_same_bytes_on_one_thread() {
    let folder = tempfile::tempdir().unwrap();
    let [first, again] = ["first", "again"].map(|name| folder.path().join(name));
    let output = prepare_cells(&first, "--printer formlabs-fuse1 --cell-size 15mm");
    assert_exit(&output, 0);
    assert_eq!(checklist(&first)["cells"]["size_mm"], 15.0);
    let job = first.join("job.toml");
    let text = std::fs::read_to_string(&job).unwrap();
    assert!(text.contains("cell_size = \"15mm\"") && text.contains("interior = \"cells\""));
    let replay = ["prepare", "--threads", "1", "--job", path(&job)];
    let output = equipoise(&[&replay[..], &["--out", path(&again)]].concat());
    assert_exit(&output, 0);
    assert!(files(&first) == files(&again));
}

#[test]
fn printers_that_empty_no_cells_are_refused_with_what_to_take() {
    let says = ["lays filament", "--interior=graded"];
    assert_refused(&format!("{CELLS} --printer prusa-mk4"), &says);
    let says = ["does not drain", "--interior=hollow", "--cut=auto"];
    assert_refused(&format!("{CELLS} --printer objet-connex350"), &says);
}

#[test]
fn cells_that_do_not_fit_are_refused_with_the_size_that_does() {
    let fuse = format!("{CELLS} --printer formlabs-fuse1");
    assert_refused(&format!("{fuse} --cell-size 1mm"), &["--cell-size=6."]);
    let says = ["larger than the model", "--cell-size"];
    assert_refused(&format!("{fuse} --cell-size 90mm"), &says);
    let says = ["is not a length"];
    assert_refused(&format!("{fuse} --cell-size some"), &says);
    let hollow = fuse.replace("--interior cells", "--interior hollow");
    let says = ["--interior=cells", "--cell-size=12mm"];
    assert_refused(&format!("{hollow} --cell-size 12mm"), &says);
}

#[test]
fn what_cells_cannot_have_is_refused() {
    let fuse = format!("{CELLS} --printer formlabs-fuse1");
    assert_refused(&format!("{fuse} --drain never"), &["--drain=never"]);
    assert_refused(&format!("{fuse} --drain 3mm"), &["--drain=5mm"]);
    assert_refused(&format!("{fuse} --fill 0.9"), &["would run out"]);
    assert_refused(&format!("{fuse} --ballast auto"), &["--ballast=auto"]);
    assert_refused(
        &format!("{fuse} --density 15%..60%"),
        &["--density=15%..60%"],
    );
    let float = fuse.replace("--goal stand", "--goal float");
    assert_refused(&float, &["take in water", "--plugs"]);
}

/// Returns the evidence of the kit with a change of its uncut body and of its part.
fn changed(change: impl Fn(&Csg) -> Csg) -> Evidence {
    let mut evidence = read_kit(&sintered().0).unwrap();
    let of = |mesh: &TriMesh| Csg::of_mesh(&equipoise::repair::weld(mesh)).unwrap();
    evidence.hollowed = change(&of(&evidence.hollowed)).to_mesh().unwrap();
    let pose = evidence.parts[0].pose;
    let in_model = evidence.parts[0].mesh.map_vertices(|p| pose.to_model(p));
    let part = change(&of(&in_model)).to_mesh().unwrap();
    evidence.parts[0].mesh = part.map_vertices(|p| pose.to_print(p));
    evidence
}

/// Returns a cylinder between two points.
fn rod([from, to]: [Point; 2], radius_mm: f64) -> Csg {
    let along = to - from;
    let frame = Frame::with_axis(from, &along);
    let rod = cylinder(radius_mm, along.norm(), 48).map_vertices(|p| frame.to_model(p));
    Csg::of_mesh(&rod).unwrap()
}

/// Returns an opening longer than it is, so that its ends lie in the cells.
fn longer(ends: &[[f64; 3]; 2], by_mm: f64) -> [Point; 2] {
    let [from, to] = ends.map(Point::from);
    let along = (to - from).normalize() * by_mm;
    [from - along, to + along]
}

#[test]
fn the_judge_blames_an_opening_that_was_closed() {
    let kept = read_kit(&sintered().0).unwrap();
    let cells = kept.promise.cells.unwrap();
    let plug = rod(longer(&cells.openings_mm[0], 0.0), 3.0);
    let evidence = changed(|body| body.union(&plug).unwrap());
    assert_blamed(&evidence, "cell-openings", "");
}

#[test]
fn the_judge_blames_cells_that_were_closed_though_its_openings_are_not_stated_any_more() {
    let kept = read_kit(&sintered().0).unwrap();
    let cells = kept.promise.cells.unwrap();
    let sheet = checklist(&sintered().0);
    let hole = &list(&sheet, "drains")[0]["to_mm"];
    let hole = Point::from([0, 1, 2].map(|axis| hole[axis].as_f64().unwrap()));
    let off_mm = |at: &[f64; 3], from: &Point| (Point::from(*at) - from).norm();
    let places = cells.places_mm.iter();
    let far = places.max_by(|a, b| off_mm(a, &hole).total_cmp(&off_mm(b, &hole)));
    let far = Point::from(*far.unwrap());
    let reach_mm = 1.5 * cells.size_mm;
    let is_near = |ends: &&[[f64; 3]; 2]| ends.iter().any(|end| off_mm(end, &far) < reach_mm);
    let (near, rest): (Vec<_>, Vec<_>) = cells.openings_mm.iter().partition(is_near);
    assert!(!near.is_empty() && !rest.is_empty());
    let plug = |ends: &[[f64; 3]; 2]| rod(longer(ends, 0.0), 3.0);
    let plugs: Vec<Csg> = near.iter().map(plug).collect();
    let mut evidence = changed(|body| {
        let close = |body: Csg, plug: &Csg| body.union(plug).unwrap();
        plugs.iter().fold(body.clone(), close)
    });
    evidence.promise.cells.as_mut().unwrap().openings_mm = rest;
    assert_blamed(&evidence, "cell-openings", "cells do not drain");
    assert_blamed(&evidence, "closed-cavities", "P01: ");
}

#[test]
fn the_judge_blames_a_wall_that_was_thinned() {
    let kept = read_kit(&sintered().0).unwrap();
    let cells = kept.promise.cells.unwrap();
    let [from, to] = longer(&cells.openings_mm[0], 0.2);
    // A recess around an opening, from one side to the middle of the wall.
    let recess = rod([from, from + (to - from) * 0.5], 2.9);
    let evidence = changed(|body| body.subtract(&recess).unwrap());
    assert_blamed(&evidence, "cell-walls", "");
}

#[test]
fn the_judge_blames_a_thickness_that_is_not_the_one_of_the_files() {
    let mut evidence = read_kit(&sintered().0).unwrap();
    assert_eq!(broken(&evidence), []);
    let found = judge(&evidence, &Watch::silent()).unwrap();
    let sheet = checklist(&sintered().0);
    assert_eq!(find_misstatements(&sheet, &evidence, &found).len(), 0);
    evidence.promise.cells.as_mut().unwrap().wall_mm += 0.1;
    assert_blamed(&evidence, "cell-walls", "");
    evidence.promise.cells.as_mut().unwrap().wall_mm -= 0.5;
    let found = judge(&evidence, &Watch::silent()).unwrap();
    let said = find_misstatements(&sheet, &evidence, &found).join("; ");
    assert!(said.contains("cells.wall_mm states"), "{said}");
}

/// Small cells between walls of a millimetre.
fn sizes() -> InnerSizes {
    InnerSizes {
        size_mm: 10.0,
        wall_mm: 1.0,
        opening_mm: 2.0,
        down: None,
    }
}

fn block(high_mm: [f64; 3]) -> TriMesh {
    cuboid(&Point::origin(), &high_mm.into())
}

#[test]
fn a_region_of_cells_is_one_body_of_air_between_walls_and_as_dense_as_cubes() {
    let region = block([40.0, 40.0, 20.0]);
    let inner = InnerCells::divide(&region, sizes(), &Watch::silent()).unwrap();
    assert_eq!(inner.count(), 32);
    let voids = inner.within(&region, &Watch::silent()).unwrap();
    let [air] = &voids.made[..] else {
        panic!("{} bodies", voids.made.len())
    };
    assert_eq!(air.places.len(), 32);
    assert!(air.doors.len() >= 32, "{}", air.doors.len());
    let distance = MeshDistance::new(air.body.mesh());
    assert!(air.places.iter().all(|at| distance.signed(at) > 1.0));
    let density = 1.0 - air.body.mesh().signed_volume_mm3() / region.signed_volume_mm3();
    // Outer cells have no wall of their own on their outer sides.
    assert!(
        density > 0.12 && density < sizes().cube_density(),
        "{density}"
    );
    assert!(
        !Csg::of_mesh(air.body.mesh())
            .unwrap()
            .has_self_intersections()
    );
}

#[test]
fn the_same_cells_fill_any_part_of_their_region_and_corners_stay_solid() {
    let region = block([40.0, 40.0, 20.0]);
    let inner = InnerCells::divide(&region, sizes(), &Watch::silent()).unwrap();
    let part = inner.within(&block([40.0, 40.0, 12.0]), &Watch::silent());
    let part = part.unwrap().made;
    let high_mm = part.iter().map(|void| void.body.mesh().aabb().max.z);
    assert!(high_mm.fold(0.0, f64::max) <= 12.0 + 1e-9);
    let corner = inner.within(&block([3.0, 3.0, 3.0]), &Watch::silent());
    assert!(corner.unwrap().made.is_empty());
    let nothing = inner.within(&TriMesh::default(), &Watch::silent());
    assert!(nothing.unwrap().made.is_empty());
}

#[test]
fn openings_lie_low_where_they_are_asked_to() {
    // Two cells of 10 mm, and the wall between them.
    let region = block([20.0, 10.0, 10.0]);
    let opening = |down: Option<Vector>| {
        let sizes = InnerSizes { down, ..sizes() };
        let inner = InnerCells::divide(&region, sizes, &Watch::silent()).unwrap();
        let voids = inner.within(&region, &Watch::silent()).unwrap().made;
        let [air] = &voids[..] else {
            panic!("{} bodies", voids.len())
        };
        let [[from, to]] = &air.doors[..] else {
            panic!("{} openings", air.doors.len())
        };
        from + (to - from) * 0.5
    };
    let middle = opening(None);
    assert!((middle.y - 5.0).abs() < 1.0 && (middle.z - 5.0).abs() < 1.0);
    let low = opening(Some(Vector::new(-1.0, -1.0, -1.0).normalize()));
    assert!(low.y < 2.5 && low.z < 2.5, "{low:?}");
}

#[test]
fn usual_cells_are_those_whose_walls_hold_the_openings_of_the_process() {
    let of = |id: &str| InnerSizes::for_printer(&Printer::find(id).unwrap(), 1.0);
    for (id, opening_mm) in [("formlabs-form4", 3.5), ("formlabs-fuse1", 5.0)] {
        let sizes = of(id).unwrap();
        assert_eq!(sizes.opening_mm, opening_mm);
        assert!(sizes.size_mm > 2.0 * sizes.least_mm(), "{sizes:?}");
    }
    assert_eq!(of("prusa-mk4"), Err(Undrainable::Filament));
    assert_eq!(of("objet-connex350"), Err(Undrainable::Gel));
}
