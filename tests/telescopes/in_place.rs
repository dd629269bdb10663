//! Telescopes that are printed in each other: both judges pass them, a slicer keeps their shells
//! apart, and what cannot be printed so is refused.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::common::{
    assert_exit, checklist, equipoise, has_slicer, json, judge_telescope, list, number, path,
    printed, verify, words,
};
use super::{FIGURE, make, refuse, replay};

/// Writes a straight curve of 120 mm, upright.
fn write_mast(folder: &Path) -> std::path::PathBuf {
    let file = folder.join("mast.csv");
    fs::write(&file, "x,y,z\n0,0,0\n0,0,40\n0,0,80\n0,0,120\n").unwrap();
    file
}

#[test]
fn a_mast_is_printed_in_place_passes_both_judges_and_a_slicer_keeps_its_shells_apart() {
    let folder = tempfile::tempdir().unwrap();
    let (mast, kit) = (write_mast(folder.path()), folder.path().join("kit"));
    let order = format!("telescope {} --printer prusa-mk4 --shells 3", path(&mast));
    make(&kit, &format!("{order} --in-place --goal stand"));
    let sheet = checklist(&kit);
    assert_eq!(sheet["in_place"], true);
    // Three bodies and no cap, in one file.
    assert_eq!(list(&sheet, "parts").len(), 3);
    assert!(kit.join("in-place.3mf").is_file() && !kit.join("plate.3mf").exists());
    // All in, it is as long as one shell.
    let shell_mm = number(&sheet, "/shells/0/visible_mm");
    let overlap_mm = number(&sheet, "/joint_sizes/overlap_mm");
    assert!((number(&sheet, "/collapsed_mm/0") - shell_mm - overlap_mm).abs() < 0.01);
    assert_eq!(number(&sheet, "/clearance_mm"), 0.4);
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    assert!(!said.contains("caps"), "{said}");
    judge_telescope(&kit);
    replay(folder.path(), &kit);
    keeps_apart(&kit, 3);
    lie_about_the_nest(&kit);
}

/// Moves a shell in the file that is printed: the judge must find it.
fn lie_about_the_nest(kit: &Path) {
    let plain = kit.with_file_name("plain");
    let job = fs::read_to_string(kit.join("job.toml")).unwrap();
    let loose = kit.with_file_name("loose.toml");
    fs::write(&loose, job.replace("shells = \"3\"", "shells = \"4\"")).unwrap();
    let output = equipoise(&["telescope", "--job", path(&loose), "--out", path(&plain)]);
    assert_exit(&output, 0);
    fs::copy(plain.join("in-place.3mf"), kit.join("in-place.3mf")).unwrap();
    let (code, said) = verify(kit);
    assert_eq!(code, Some(1), "{said}");
    assert!(
        said.contains("in-place.3mf: in-place is not where it belongs"),
        "{said}"
    );
}

#[test]
fn a_bent_telescope_of_powder_is_printed_in_place_with_holes_for_the_powder() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let arc = "telescope arc:120,120 --printer formlabs-fuse1 --shells 3 --in-place";
    make(&kit, arc);
    let sheet = checklist(&kit);
    let vents = list(&sheet, "parts").iter();
    let vents = vents.filter(|part| part["vent_mm"].is_array()).count();
    assert_eq!(vents, 2, "all but the last");
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("powder leaves every shell"), "{said}");
    judge_telescope(&kit);
}

#[test]
fn what_cannot_be_printed_in_place_is_refused_with_the_reason() {
    let curve = b"0,0,0\n50,5,0\n100,20,0\n150,50,0\n";
    let said = refuse("curve.csv", curve, "--in-place --curvature each");
    assert!(
        said.contains("unlike shapes") && said.contains("--curvature=one"),
        "{said}"
    );
    let said = refuse("curve.csv", curve, "--in-place --torsion each");
    assert!(said.contains("--torsion=one"), "{said}");
    let said = refuse(
        "curve.csv",
        curve,
        "--in-place --overlap 4mm --clearance 0.4mm",
    );
    assert!(said.contains("longer overlap"), "{said}");
    for (input, printer, expected) in [
        ("arc:80,30", "formlabs-form4", "resin or support would stay"),
        (
            "arc:80,30",
            "objet-connex350",
            "resin or support would stay",
        ),
        (FIGURE, "prusa-mk4", "limbs are glued to junctures"),
    ] {
        let order = format!("telescope {input} --printer {printer} --in-place");
        let output = equipoise(&words(&order));
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(
            said.contains(expected) && said.contains("--in-place"),
            "{printer}: {said}"
        );
    }
}

#[test]
fn shells_that_bend_too_far_for_filament_are_an_answer_that_names_more_shells() {
    let bent = "telescope arc:100,170 --printer prusa-mk4 --shells 3 --in-place --json";
    let output = equipoise(&words(bent));
    assert_exit(&output, 1);
    let answer = json(&output);
    let reason = answer["reason"].as_str().unwrap();
    assert!(
        reason.contains("printed in place, its shells would bend by"),
        "{reason}"
    );
    let settings = list(&answer, "remedies").iter();
    let mut keys = settings.map(|remedy| &remedy["settings"][0]["key"]);
    assert!(
        keys.any(|key| key == "in_place" || key == "shells"),
        "{answer}"
    );
}

/// Side of a square of the raster on which beads are drawn, mm.
const CELL_MM: f64 = 0.05;

/// Asserts that a slicer lays every shell as an island of its own in all layers, but for the first
/// two and the last two.
fn keeps_apart(kit: &Path, shells: usize) {
    if !has_slicer() {
        return;
    }
    let gcode = kit.with_file_name("nested.gcode");
    let nested = kit.join("in-place.3mf");
    let settings = "--export-gcode --nozzle-diameter 0.4 --layer-height 0.2 --first-layer-height 0.2 \
                    --fill-density 100% --fill-pattern rectilinear --perimeters 2 --skirts 0 --bed-shape 0x0,250x0,250x210,0x210 \
                    --center 100,100 -o";
    let output = Command::new("prusa-slicer")
        .args(words(settings))
        .args([&gcode, &nested])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(gcode.is_file(), "{said}");
    let text = fs::read_to_string(&gcode).unwrap();
    assert!(!said.to_lowercase().contains("empty layer"), "{said}");
    let layers = beads(&text);
    assert!(layers.len() > 150, "{} layers", layers.len());
    let mut apart = 0;
    for (layer, lines) in layers.iter().skip(2).take(layers.len() - 4) {
        let found = islands(lines);
        assert_eq!(found, shells, "islands in the layer at {layer} µm");
        apart += 1;
    }
    assert!(apart > 150, "{apart} layers");
    // The lines of two walls that are drawn as wide as they and their gap are no islands.
    let (_, middle) = layers.iter().nth(layers.len() / 2).unwrap();
    let wide = middle.iter().map(|bead| Bead {
        width_mm: bead.width_mm + 2.0,
        ..*bead
    });
    assert!(islands(&wide.collect::<Vec<_>>()) < shells);
}

/// A line of filament.
#[derive(Clone, Copy)]
struct Bead {
    ends: [[f64; 2]; 2],
    width_mm: f64,
}

/// Returns the lines of each layer, by its height in µm.
fn beads(gcode: &str) -> BTreeMap<i64, Vec<Bead>> {
    let (mut at, mut laid_mm, mut width_mm, mut height) = ([0.0; 2], 0.0, 0.45, 0);
    let is_relative = gcode.lines().any(|line| line.starts_with("M83"));
    let mut layers: BTreeMap<i64, Vec<Bead>> = BTreeMap::new();
    for line in gcode.lines() {
        if let Some(width) = line.strip_prefix(";WIDTH:") {
            width_mm = width.parse().unwrap();
        } else if let Some(z) = line.strip_prefix(";Z:") {
            height = (z.parse::<f64>().unwrap() * 1000.0).round() as i64;
        } else if line.starts_with("G92 E0") {
            laid_mm = 0.0;
        } else if line.starts_with("G1 ") || line.starts_with("G0 ") {
            let plain = line.split(';').next().unwrap();
            let word = |letter: char| {
                let mut own = plain
                    .split_whitespace()
                    .filter(|word| word.starts_with(letter));
                own.next().map(|word| word[1..].parse::<f64>().unwrap())
            };
            let to = [word('X').unwrap_or(at[0]), word('Y').unwrap_or(at[1])];
            let end_mm = match (word('E'), is_relative) {
                (Some(more), true) => laid_mm + more,
                (Some(end), false) => end,
                (None, _) => laid_mm,
            };
            if end_mm > laid_mm && to != at {
                let ends = [at, to];
                layers
                    .entry(height)
                    .or_default()
                    .push(Bead { ends, width_mm });
            }
            (at, laid_mm) = (to, end_mm);
        }
    }
    layers
}

/// Returns the number of islands that lines make together.
fn islands(lines: &[Bead]) -> usize {
    let all = || lines.iter().flat_map(|bead| bead.ends);
    let widest_mm = lines.iter().map(|bead| bead.width_mm).fold(0.0, f64::max);
    let low = [0, 1].map(|i| all().map(|p| p[i]).fold(f64::INFINITY, f64::min) - widest_mm);
    let high = [0, 1].map(|i| all().map(|p| p[i]).fold(f64::NEG_INFINITY, f64::max) + widest_mm);
    let [wide, deep] = [0, 1].map(|i| ((high[i] - low[i]) / CELL_MM).ceil() as usize + 1);
    let mut filled = vec![false; wide * deep];
    for bead in lines {
        let [a, b] = bead.ends;
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let steps = (length / CELL_MM).ceil().max(1.0) as usize;
        let reach = (0.5 * bead.width_mm / CELL_MM).round() as i64;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let place = |i: usize| (a[i] + (b[i] - a[i]) * share - low[i]) / CELL_MM;
            let [x, y] = [0, 1].map(|i| place(i).round() as i64);
            for i in -reach..=reach {
                let half = ((reach * reach - i * i) as f64).sqrt() as i64;
                let row = (y + i) as usize * wide;
                filled[row + (x - half) as usize..=row + (x + half) as usize].fill(true);
            }
        }
    }
    let mut count = 0;
    for first in 0..filled.len() {
        if !filled[first] {
            continue;
        }
        count += 1;
        let mut open = vec![first];
        filled[first] = false;
        while let Some(cell) = open.pop() {
            // The border is free: it is wider than the widest line.
            for next in [cell + 1, cell - 1, cell + wide, cell - wide] {
                if std::mem::take(&mut filled[next]) {
                    open.push(next);
                }
            }
        }
    }
    count
}
