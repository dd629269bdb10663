//! Holds the house in order: which room may see which, and the rules every file keeps.

#![allow(
    clippy::print_stdout,
    reason = "the figures are shown with --nocapture"
)]
#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

mod arrows;
mod functions;
mod map;
mod names;
mod prose;
mod scanner;
mod wording;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use scanner::first_word;

/// Who may see whom: a room and everything it may import. A new arrow is a decision, written down
/// here.
///
/// base → geom → mesh → repair → io | shell → mass → goal | printer → interior → hollow → ballast →
/// job | voids → cut → report → pipeline → cli. `verify` sees nothing of shell, interior, hollow,
/// voids and cut: the judge does not know the accused.
const ARROWS: &[(&str, &[&str])] = &[
    ("base", &[]),
    ("geom", &["base"]),
    // Curves are points and motions: no mesh, so that what is asked is fitted before it is built.
    ("curve", &["base", "geom"]),
    ("mesh", &["base", "geom"]),
    ("repair", &["base", "geom", "mesh"]),
    // G-code is weighed bead by bead as it is read, so that no file is too long. Volume meshes are
    // checked as they are read.
    ("io", &["repair", "geom", "mass", "mesh", "base", "tets"]),
    ("shell", &["geom", "mesh", "base"]),
    ("thin", &["geom", "mesh", "base"]),
    // A skeleton is found in a solid alone; what shells need comes as two lengths.
    ("skeleton", &["base", "geom", "mesh"]),
    ("mass", &["geom", "mesh", "base"]),
    // A density is a function in space: it is integrated over a mesh, and knows no printer.
    ("field", &["base", "geom", "mass", "mesh"]),
    // Tetrahedra are weighed with their densities, and sample those that are known as a field.
    ("tets", &["base", "field", "geom", "mass", "mesh"]),
    // Layer images are made of a mesh alone; what machine shows them comes as pixels and layers.
    ("raster", &["geom", "mass", "mesh", "base"]),
    ("goal", &["geom", "mass", "mesh", "shell", "base"]),
    ("hardware", &["geom", "goal", "mass", "mesh", "base"]),
    ("printer", &["base"]),
    ("interior", &["geom", "mass", "mesh", "base", "shell"]),
    (
        "hollow",
        // The best density is a field of levels or a clamped quadric.
        &[
            "field", "geom", "goal", "interior", "mass", "mesh", "base", "shell",
        ],
    ),
    (
        "ballast",
        &[
            "geom", "goal", "hollow", "interior", "mass", "mesh", "printer", "base", "shell",
        ],
    ),
    (
        "advice",
        &[
            "geom", "goal", "hollow", "interior", "mass", "mesh", "base", "shell",
        ],
    ),
    (
        "voids",
        // The level sets of a density are drawn as those of a quadric are.
        &[
            "field", "printer", "repair", "geom", "mass", "mesh", "base", "shell",
        ],
    ),
    // A new surface is drawn as voids are; the ladder below knows nothing of drawing.
    ("mend", &["base", "geom", "mesh", "repair", "voids"]),
    ("poses", &["base", "geom", "mesh"]),
    // A base is found in a solid alone: it knows of sheets and printers only lengths and angles.
    ("polyhedra", &["base", "geom", "mesh"]),
    // Cells are geometry of sites in a closed surface; which surface, they do not ask.
    ("cells", &["base", "geom", "mesh"]),
    // Printed cells are voids between walls, inside a skin that is drawn as for any void.
    (
        "comb",
        &["base", "cells", "geom", "mesh", "printer", "voids"],
    ),
    // Profiles of cutters, sheets and fasteners are data, checked as those of printers are.
    ("cutter", &["base"]),
    // Outlines and joints are plane geometry, and a polyhedron gives panels their places. The sheet
    // is a thickness: what is cut from which one is for the rooms above.
    ("panels", &["base", "geom", "mesh", "polyhedra"]),
    // Panels become drawings for one cutter and one sheet. Which panels they are, it does not ask.
    ("cutting", &["cutter", "io", "panels"]),
    // The shell around a base is cut by its faces, hollowed as voids are and screwed to its panels.
    // Parts are turned for the printer's room by the directions of poses; a room is three lengths.
    // Pins between parts are those between the parts of a cut model.
    (
        "cladding",
        &[
            "base",
            "cut",
            "cutter",
            "geom",
            "mesh",
            "panels",
            "polyhedra",
            "poses",
            "shell",
            "voids",
        ],
    ),
    (
        "cut",
        &[
            "repair", "geom", "mass", "mesh", "poses", "printer", "base", "voids",
        ],
    ),
    // What a kit says of its rods is held against the catalogue of fasteners.
    (
        "verify",
        &[
            "repair", "base", "cutter", "geom", "goal", "io", "mass", "mesh", "printer", "thin",
        ],
    ),
    ("draw", &["base", "geom", "mesh"]),
    (
        "sheet",
        &[
            "ballast", "base", "cut", "geom", "goal", "hardware", "hollow", "mass", "mesh",
            "poses", "printer", "repair", "run", "verify",
        ],
    ),
    (
        "page",
        &[
            "base", "draw", "geom", "goal", "mass", "mesh", "poses", "repair", "sheet", "verify",
        ],
    ),
    // What kits of all other kinds end with: files, a checklist and pages, or an answer.
    ("wing", &["base", "kit", "sheet", "verify"]),
    // Telescopes have a line of their own, from a curve to a kit. They share the parts' files, the
    // papers and the judge with other kits, and see nothing of hollowing. A juncture larger than
    // the printer's room is cut as models are.
    (
        "telescope",
        &[
            // Its stock is that of ballast in prints, but it lies in a foot.
            "ballast", "base", "curve", "cut", "draw", "error", "geom", "goal", "io", "job", "kit",
            "make", "mass", "mesh", "page", "printer", "repair", "sheet", "skeleton", "verify",
            "wing",
        ],
    ),
    // Objects on a base have a line of their own, from a model to a kit. It joins the rooms of
    // bases, panels and shells, and shares files, papers and the judge with other kits.
    (
        "core_kit",
        &[
            // Its stock is that of ballast in prints, but it lies on a panel.
            "ballast",
            "base",
            "cladding",
            // A printer says how thick pins are, and how wide their sockets.
            "cut",
            "cutter",
            "cutting",
            "draw",
            "error",
            "geom",
            "goal",
            "io",
            "job",
            "kit",
            "make",
            "mass",
            "mend",
            "mesh",
            "page",
            "panels",
            "polyhedra",
            "printer",
            "repair",
            "sheet",
            "verify",
            "wing",
        ],
    ),
    // `prepare` prints a kit's papers with the press, and `verify` on the command line again.
    (
        "press",
        &[
            "base", "cut", "draw", "error", "geom", "job", "mesh", "page", "printer", "repair",
            "sheet", "verify",
        ],
    ),
    ("kit", &["base"]),
    // A slicer is another program: it gets a plate and a profile, and gives toolpaths. For one that
    // reads no packages, the plate is taken apart into meshes.
    ("slicer", &["base", "geom", "io", "mesh", "printer"]),
    // Slicing a kit reads its job and its plates, and draws them as layers for machines of pixels.
    // The judge looks at the slices afterwards. Two materials are weighed while they are dithered.
    (
        "slice",
        &[
            "base", "field", "geom", "io", "job", "kit", "mass", "mesh", "printer", "raster",
            "slicer", "verify",
        ],
    ),
    // A quote puts the shop's rates on what was sliced.
    ("quote", &["base", "page", "printer", "sheet", "slice"]),
    // Sleeves are swept as shells are.
    (
        "coupon",
        &[
            "base",
            "curve",
            "cutter",
            "geom",
            "io",
            "kit",
            "mesh",
            "page",
            "panels",
            "printer",
            "telescope",
        ],
    ),
    // A job may order a field of densities by its numbers, and names the polyhedron from which the
    // vertices of a base start.
    (
        "job",
        &[
            "ballast",
            "cut",
            "base",
            "field",
            "goal",
            "polyhedra",
            "repair",
        ],
    ),
    // A run may slice its kit, and tells why that failed.
    (
        "error",
        &[
            "base", "repair", "ballast", "comb", "cut", "draw", "field", "goal", "hardware",
            "hollow", "interior", "io", "job", "kit", "mend", "mesh", "printer", "sheet", "shell",
            "slice", "slicer", "thin", "verify", "voids",
        ],
    ),
    // The cells of an inside are divided once, and drawn again in every round.
    (
        "run",
        &[
            "advice", "ballast", "base", "comb", "cut", "field", "geom", "goal", "hardware",
            "hollow", "interior", "job", "mass", "mesh", "printer", "repair", "thin", "verify",
        ],
    ),
    (
        "open",
        // A printer says which holes empty a void of one piece.
        &[
            "ballast", "base", "cut", "error", "field", "geom", "goal", "hollow", "job", "mass",
            "mesh", "printer", "run", "voids",
        ],
    ),
    (
        "make",
        &[
            "base", "cut", "draw", "error", "geom", "io", "job", "mass", "mesh", "open", "printer",
            "repair", "run", "verify",
        ],
    ),
    // A kit is sliced, and solved for again with what its toolpaths lay.
    (
        "prepare",
        &[
            "advice", "ballast", "base", "comb", "cut", "error", "field", "geom", "goal",
            "hardware", "hollow", "interior", "io", "job", "kit", "make", "mass", "mend", "mesh",
            "open", "page", "press", "printer", "repair", "run", "sheet", "shell", "slice",
            "slicer", "thin", "verify", "voids",
        ],
    ),
    (
        "cli",
        &[
            "repair",
            "advice",
            "ballast",
            // `cells` divides a model that is typed, and makes it of them.
            "cells",
            "comb",
            "core_kit",
            "coupon",
            "cut",
            "cutter",
            "draw",
            "error",
            // `inspect` measures the field that is typed.
            "field",
            "geom",
            "goal",
            "io",
            "job",
            "kit",
            "mass",
            "mend",
            "mesh",
            "page",
            "prepare",
            "press",
            "printer",
            "quote",
            "base",
            "run",
            "sheet",
            "skeleton",
            "slice",
            "telescope",
            "tets",
            "verify",
            "wing",
        ],
    ),
    ("guide", &[]),
    (
        "lib",
        &[
            "advice",
            "ballast",
            "cells",
            "cladding",
            "comb",
            "core_kit",
            "coupon",
            "curve",
            "cutter",
            "cutting",
            "draw",
            "error",
            "field",
            "geom",
            "goal",
            "hardware",
            "hollow",
            "interior",
            "io",
            "make",
            "mass",
            "mend",
            "mesh",
            "open",
            "page",
            "panels",
            "polyhedra",
            "poses",
            "press",
            "quote",
            "repair",
            "run",
            "sheet",
            "shell",
            "skeleton",
            "slice",
            "slicer",
            "telescope",
            "tets",
            "voids",
            "wing",
        ],
    ),
    ("main", &["cli"]),
];

/// Traces of work that was not finished.
const SCAFFOLDING: [&str; 4] = ["TODO", "FIXME", "XXX", "HACK"];
/// The lints by which the compiler and clippy refuse code.
const LINTS: [&str; 7] = [
    "unsafe_code = \"forbid\"",
    "missing_docs = \"warn\"",
    "unwrap_used = \"warn\"",
    "expect_used = \"warn\"",
    "panic = \"warn\"",
    "dbg_macro = \"warn\"",
    "todo = \"warn\"",
];
/// Calls that print, which only the command line may make.
const PRINTS: [&str; 4] = ["println!(", "eprintln!(", "print!(", "eprint!("];

#[test]
fn every_room_sees_only_the_rooms_it_may() {
    let allowed: BTreeMap<&str, &[&str]> = ARROWS.iter().copied().collect();
    let wrong = scanner::program().flat_map(|source| {
        let here = source.room();
        let may = allowed.get(here).copied();
        let strange = rooms_seen(&source.code)
            .into_iter()
            .filter(move |seen| *seen != here && !may.is_some_and(|may| may.contains(seen)));
        strange.map(|seen| format!("{} sees {seen}", source.path.display()))
    });
    holds(
        wrong,
        "an arrow points the wrong way, or a room is missing in ARROWS",
    );
}

#[test]
fn the_rooms_form_no_circle() {
    let mut placed = BTreeSet::new();
    while placed.len() < ARROWS.len() {
        let next = ARROWS
            .iter()
            .find(|(room, sees)| !placed.contains(room) && sees.iter().all(|s| placed.contains(s)));
        let Some((room, _)) = next else {
            panic!("a circle among the rooms besides {placed:?}")
        };
        placed.insert(room);
    }
}

#[test]
fn every_file_says_first_what_lives_in_it() {
    let wrong = scanner::program().filter(|source| !source.text.starts_with("//! "));
    holds(
        wrong.map(|source| source.path.display().to_string()),
        "the first line must be `//! …`",
    );
}

#[test]
fn nothing_is_left_unfinished() {
    let wrong = scanner::program().flat_map(|source| {
        let left = SCAFFOLDING
            .iter()
            .filter(|word| source.text.contains(**word));
        left.map(|word| format!("{}: {word}", source.path.display()))
    });
    holds(wrong, "finish it, or open an issue");
}

#[test]
fn only_the_command_line_prints() {
    let quiet = scanner::program().filter(|source| !matches!(source.room(), "cli" | "main"));
    let prints = quiet.flat_map(|source| {
        let calls = PRINTS
            .iter()
            .flat_map(|call| source.code.match_indices(call));
        calls.map(|(at, call)| format!("{}: {call}", source.place(at)))
    });
    holds(prints, "return a value, or report progress");
}

#[test]
fn the_compiler_keeps_out_unsafe_code_panics_and_undocumented_items() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let library = fs::read_to_string(root.join("src/lib.rs")).unwrap();
    assert!(library.contains("#![forbid(unsafe_code)]"));
    let manifest = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    for lint in LINTS {
        assert!(manifest.contains(lint), "{lint} is missing in Cargo.toml");
    }
}

#[test]
fn rooms_are_seen_by_the_paths_that_name_them() {
    let code = "use crate::{geom::{Point, Vector}, mesh};\nlet x = crate::io::name(crate::Error);";
    assert_eq!(rooms_seen(code), BTreeSet::from(["geom", "io", "mesh"]));
}

/// Fails with every fault on its own line.
fn holds(faults: impl Iterator<Item = String>, remedy: &str) {
    at_most(0, faults, remedy);
}

/// Fails with every fault on its own line if there are more than a ceiling allows.
fn at_most(ceiling: usize, faults: impl Iterator<Item = String>, remedy: &str) {
    let faults: Vec<String> = faults.collect();
    println!("{} of at most {ceiling}: {remedy}", faults.len());
    assert!(
        faults.len() <= ceiling,
        "{remedy} ({}, at most {ceiling}):\n{}",
        faults.len(),
        faults.join("\n")
    );
}

/// The rooms named in `crate::…` paths.
fn rooms_seen(code: &str) -> BTreeSet<&str> {
    let paths = code
        .match_indices("crate::")
        .map(|(at, path)| &code[at + path.len()..]);
    let words = paths.flat_map(|rest| match rest.strip_prefix('{') {
        Some(group) => top_level(group),
        None => vec![first_word(rest)],
    });
    words
        .filter(|word| word.starts_with(char::is_lowercase))
        .collect()
}

/// The first words of the items of a list that ends with the brace it was opened with.
fn top_level(group: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut words = vec![first_word(group)];
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => words.push(first_word(&group[at + 1..])),
            _ => {}
        }
    }
    words
}
