//! Shells of models at 600 mm, with the figures of a whole object.

use std::time::Instant;

use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::cladding::{
    CladShell, CupRequest, Holding, Part, Room, Scene, ScrewKit, ShellRequest, ShellStyle,
};
use equipoise::cutter::Fastener;
use equipoise::geom::Vector;
use equipoise::io::read_model;
use equipoise::mesh::Solid;
use equipoise::polyhedra::{Ground, Limits, Polyhedron, Request, grow_polyhedron};
use equipoise::repair::repair;

use super::scenes::{MOST_ON_THE_WAY_MM3, SHEET_MM, hold_cup, panels, take_apart, volume_error};
use crate::common;

const GAP_MM: f64 = 0.5;
const WALL_MM: f64 = 3.0;
/// Wall, gap and what screws need.
const DISTANCE_MM: f64 = 8.5;
const ROOM_MM: [f64; 3] = [250.0, 210.0, 210.0];
/// g/cm³.
const PLA: f64 = 1.24;

fn model(name: &str) -> Option<(Ground, Polyhedron)> {
    let path = common::shared_model(name)?;
    let (mesh, _) = repair(read_model(&path).unwrap(), &Watch::silent()).unwrap();
    let factor = 600.0 / mesh.longest_side_mm();
    let solid = Solid::new(mesh.map_vertices(|p| p * factor)).unwrap();
    let ground = Ground::new(&solid).unwrap();
    let limits = Limits::for_sheet(SHEET_MM, 8.0, [890.0, 590.0]);
    let order = Request::new(DISTANCE_MM, limits);
    match grow_polyhedron(&ground, &order, &Watch::silent()).unwrap() {
        Verdict::Found(base) => Some((ground, base)),
        Verdict::No(why) => {
            println!("{name}: {why}");
            None
        }
    }
}

fn report(name: &str, shell: &CladShell, error: f64) {
    let pinned = shell
        .parts
        .iter()
        .filter(|part| matches!(part.holding, Holding::Pinned { .. }));
    let unheld = shell
        .parts
        .iter()
        .filter(|part| part.holding == Holding::Nothing);
    let crumbs: usize = shell.parts.iter().map(|part| part.crumbs.len()).sum();
    let solid_mm3: f64 = shell.parts.iter().map(Part::volume_mm3).sum();
    let printed_mm3: f64 = shell
        .cups
        .iter()
        .map(|cup| cup.body.signed_volume_mm3())
        .sum();
    let unreached_mm3: f64 = shell.cups.iter().map(|cup| cup.unreached_mm3).sum();
    let loose_mm3: f64 = shell.cups.iter().map(|cup| cup.loose_mm3).sum();
    let few = shell.screws.iter().filter(|screws| screws.screws.len() < 3);
    let kg = |mm3: f64| mm3 * PLA * 1e-6;
    println!(
        "{name}: {} parts, {} pinned, {} held by nothing, {crumbs} crumbs; volume error {error:.1e}; \
         solid {:.2} kg, cups {:.2} kg, unreached {:.2} kg, loose {:.4} kg; {} screws, {} parts with \
         fewer than 3; {} units",
        shell.parts.len(),
        pinned.count(),
        unheld.count(),
        kg(solid_mm3),
        kg(printed_mm3),
        kg(unreached_mm3),
        kg(loose_mm3),
        shell
            .screws
            .iter()
            .map(|screws| screws.screws.len())
            .sum::<usize>(),
        few.count(),
        shell.assembly.units.len(),
    );
}

/// Makes the shell of a model and holds its claims: volumes, rooms, walls and ways.
fn hold(name: &str) {
    let Some((ground, base)) = model(name) else {
        return;
    };
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let whole = scene.divide(0.0, &Watch::silent()).unwrap();
    let error = volume_error(&ground, &scene, &whole);
    println!(
        "{name}: {} panels, {} parts before room cuts, volume error {error:.1e}",
        base.panel_count(),
        whole.len()
    );
    assert!(error.abs() < 1e-9, "{name}: {error}");
    let kit = ScrewKit::choose(&Fastener::all().unwrap(), 4.0, SHEET_MM + GAP_MM).unwrap();
    let request = ShellRequest {
        wall_mm: WALL_MM,
        style: ShellStyle::Cups,
        crumb_mm3: 2000.0,
        room_mm: Some(ROOM_MM),
        kit: Some(&kit),
        pins: None,
        up: Vector::z(),
    };
    let start = Instant::now();
    let shell = scene
        .clad(&panels(&base), &request, &Watch::silent())
        .unwrap();
    println!("{name}: shell in {:.1} s", start.elapsed().as_secs_f64());
    let error = volume_error(&ground, &scene, &shell.parts);
    report(name, &shell, error);
    assert!(error.abs() < 1e-9, "{name}: {error}");
    let room = Room {
        size_mm: ROOM_MM,
        wall_mm: WALL_MM,
    };
    let mut thinnest_mm = f64::INFINITY;
    for (index, part) in shell.parts.iter().enumerate() {
        assert!(part.holding != Holding::Nothing, "{name}: part {index}");
        assert!(scene.lie(part, &room).is_some(), "{name}: part {index}");
        // Bores come after the walls.
        let own = shell.screws.iter().find(|screws| screws.part == index);
        let keeps = own.map_or_else(Vec::new, |screws| screws.keeps(&kit, 3.0 * WALL_MM));
        let order = CupRequest {
            wall_mm: WALL_MM,
            keeps: &keeps,
        };
        let cup = scene.cup(part, &order, &Watch::silent()).unwrap();
        let wall_mm = hold_cup(part, &cup, WALL_MM, &format!("{name}, part {index}"));
        thinnest_mm = thinnest_mm.min(wall_mm);
    }
    let worst_mm3 = take_apart(&shell);
    println!("{name}: thinnest wall {thinnest_mm:.4} mm, overlap {worst_mm3:.1e} mm³");
    assert!(worst_mm3 <= MOST_ON_THE_WAY_MM3, "{name}: {worst_mm3}");
}

#[test]
#[ignore = "makes a whole shell: minutes"]
fn the_shell_of_the_bunny_holds() {
    hold("bunny.stl");
}

#[test]
#[ignore = "makes a whole shell: minutes"]
fn the_shell_of_homer_holds() {
    hold("homer.obj");
}

#[test]
#[ignore = "makes a whole shell: minutes"]
fn the_shell_of_humpty_holds() {
    hold("humpty.obj");
}

#[test]
#[ignore = "makes a whole shell: minutes"]
fn the_shell_of_fertility_holds() {
    hold("fertility.stl");
}
