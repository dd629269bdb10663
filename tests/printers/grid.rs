//! Walls, pins, sockets and cut faces that land on the grid of a printer.

use serde_json::Value;

use crate::common::{assert_exit, list, number, prepare, words};

/// Tells if a row of the sheet's table must be a whole number of steps.
///
/// Walls, pins and sockets must be along the coarser of x and y: on oblong pixels the finer cannot
/// be too. Pins and sockets must be along z. Walls have any number of layers.
fn must_be_whole(row: &Value, coarser: &str) -> bool {
    let [what, along] = ["what", "along"].map(|key| row[key].as_str().unwrap());
    let is_peg = what.starts_with("pin") || what.starts_with("socket");
    match along {
        "z" => is_peg,
        "tilted" => false,
        along => (is_peg || what == "wall") && along == coarser,
    }
}

/// Makes the same job on a printer and checks its table of grid steps.
fn assert_on_grid(printer: &str, coarser: &str) {
    let folder = tempfile::tempdir().unwrap();
    let sizes = "--goal top --up z --size 60mm --wall 1.5mm --pitch 0.3mm --printer";
    let kit = folder.path().join("kit");
    assert_exit(&prepare(&kit, &[&words(sizes)[..], &[printer]].concat()), 0);
    let sheet = crate::common::checklist(&kit);
    assert_eq!(sheet["verdict"], "pass");
    let rows = list(&sheet, "grid");
    for row in rows {
        let is_whole = row["is_whole"] == true;
        assert!(is_whole || !must_be_whole(row, coarser), "{row}");
        let steps_mm = number(row, "/steps") * number(row, "/step_mm");
        assert!((number(row, "/given_mm") - steps_mm).abs() < 1e-9, "{row}");
        let is_wall_of_pixels = row["what"] == "wall" && printer != "prusa-mk4";
        let is_thin = is_wall_of_pixels && steps_mm < 1.5 - 1e-9;
        assert!(!is_thin, "a wall may come out thinner than asked: {row}");
    }
    for cut in list(&sheet, "cuts") {
        let start = format!("cut face {} ", cut["id"].as_str().unwrap());
        let is_level =
            |row: &&Value| row["what"].as_str().unwrap().starts_with(&start) && row["along"] == "z";
        let level: Vec<&Value> = rows.iter().filter(is_level).collect();
        let has_whole = level.iter().any(|row| row["is_whole"] == true);
        assert!(
            has_whole || level.is_empty(),
            "none ends at a layer: {level:?}"
        );
    }
}

#[test]
fn a_job_lands_on_the_oblong_pixels_of_a_display() {
    assert_on_grid("elegoo-saturn-4-ultra", "y");
}

#[test]
#[ignore = "long: 10 s of a third printer; run with -- --ignored"]
fn a_job_lands_on_the_pixels_of_polyjet() {
    assert_on_grid("objet-connex350", "x");
}

#[test]
fn a_job_lands_on_the_lines_of_filament() {
    assert_on_grid("prusa-mk4", "x");
}
