//! Shells around bases: cells, parts, cups, screws and units on bodies whose figures are known.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test whose input cannot be had has failed; figures are shown with --nocapture"
)]

mod knots;
mod models;
mod pins;
mod scenes;
mod several;
mod ways;

use equipoise::base::watch::Watch;
use equipoise::cladding::{
    CladdingError, CupRequest, Holding, Part, Room, Scene, ScrewKit, ScrewRequest, ShellRequest,
    ShellStyle, barred_mm2, cells,
};
use equipoise::cutter::Fastener;
use equipoise::geom::{Point, Vector};
use equipoise::mesh::{Solid, TriMesh, primitives};
use equipoise::polyhedra::Ground;

use scenes::{
    MOST_ON_THE_WAY_MM3, base, block, cube, dodecahedron, ground, grown, hold_cup, octahedron,
    panels, take_apart, united, volume_error,
};

const GAP_MM: f64 = 0.5;
const WALL_MM: f64 = 3.0;

fn box_ground() -> Ground {
    ground(block([-100.0, -90.0, -80.0], [100.0, 90.0, 80.0]))
}

fn ball_ground() -> Ground {
    ground(primitives::ball(&Point::origin(), 150.0, 4))
}

/// A ball with a smaller one beside it, on a neck.
fn two_balls() -> Ground {
    let neck = primitives::cylinder(14.0, 220.0, 48).map_vertices(|p| Point::new(p.z, p.x, p.y));
    let small = primitives::ball(&Point::new(220.0, 8.0, 5.0), 55.0, 4);
    ground(united(&[ball_ground().solid().mesh().clone(), neck, small]))
}

/// A ball with a hook that bends over a neighbouring cell without touching the ball there.
fn hooked_ball() -> Ground {
    let stem = block([130.0, -12.0, -12.0], [220.0, 12.0, 12.0]);
    let arm = block([200.0, -11.0, 0.0], [219.0, 11.0, 300.0]);
    ground(united(&[ball_ground().solid().mesh().clone(), stem, arm]))
}

fn divided(scene: &Scene, crumb_mm3: f64) -> Vec<Part> {
    scene.divide(crumb_mm3, &Watch::silent()).unwrap()
}

fn kit() -> ScrewKit {
    ScrewKit::choose(&Fastener::all().unwrap(), 4.0, scenes::SHEET_MM + GAP_MM).unwrap()
}

#[test]
fn cells_hold_every_point_outside_once_and_stay_within_themselves_along_their_normals() {
    let ground = ball_ground();
    for faces in [
        cube([80.0, 70.0, 60.0]),
        octahedron(60.0),
        dodecahedron(90.0),
    ] {
        let base = base(&ground, 10.0, &faces);
        let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
        let cells = cells(&base, GAP_MM);
        assert_eq!(cells.len(), faces.len());
        let room = primitives::cuboid(
            &Point::new(-300.0, -290.0, -280.0),
            &Point::new(300.0, 290.0, 280.0),
        );
        let whole_mm3 = room.signed_volume_mm3();
        let bodies = cells
            .iter()
            .map(|cell| cell.region.body(&room.aabb()).unwrap());
        let cells_mm3: f64 = bodies.map(|body| body.signed_volume_mm3()).sum();
        let error = (cells_mm3 + grown(&scene).signed_volume_mm3() - whole_mm3) / whole_mm3;
        assert!(error.abs() < 1e-12, "{error}");
        for cell in &cells {
            assert!(Solid::new(cell.region.body(&room.aabb()).unwrap()).is_ok());
            let way = base.faces()[cell.face].plane.normal;
            for corner in cell.region.body(&room.aabb()).unwrap().vertices() {
                assert!(cell.region.height_mm(&(corner + way * 1e3)) < 1e-9);
            }
        }
    }
}

#[test]
fn the_parts_of_a_box_and_a_ball_add_up_and_each_bears_on_its_whole_face() {
    let scenes = [
        (box_ground(), cube([85.0, 75.0, 65.0])),
        (ball_ground(), cube([80.0, 70.0, 60.0])),
        (ball_ground(), octahedron(60.0)),
        (ball_ground(), dodecahedron(90.0)),
    ];
    for (ground, faces) in scenes {
        let base = base(&ground, 10.0, &faces);
        let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
        let parts = divided(&scene, 0.0);
        assert_eq!(parts.len(), faces.len());
        let error = volume_error(&ground, &scene, &parts);
        assert!(error.abs() < 1e-9, "{error}");
        for part in &parts {
            let Holding::Panel { area_mm2 } = part.holding else {
                panic!("{:?}", part.holding)
            };
            // The face of the base grown by the gap is a little larger than that of the base.
            let face_mm2 = base.faces()[part.face].area_mm2;
            assert!(area_mm2 > face_mm2 && area_mm2 < 1.05 * face_mm2);
        }
        hold_free(&scene, &parts);
    }
}

/// No part on its way out meets a part of another cell.
fn hold_free(scene: &Scene, parts: &[Part]) {
    for part in parts {
        let way = scene.normal(part.face);
        for other in parts.iter().filter(|other| other.face != part.face) {
            let barred = barred_mm2(&part.body, &other.body, &way);
            assert!(barred < 1e-6, "{} {}: {barred}", part.face, other.face);
        }
    }
}

#[test]
fn a_hook_that_reaches_no_panel_is_pinned_to_the_part_it_lies_on() {
    let ground = hooked_ball();
    let base = base(&ground, 10.0, &cube([80.0, 70.0, 60.0]));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let parts = divided(&scene, 0.0);
    assert_eq!(parts.len(), 7);
    assert!(volume_error(&ground, &scene, &parts).abs() < 1e-9);
    hold_free(&scene, &parts);
    let hook = parts.iter().find(|part| !part.is_on_panel()).unwrap();
    let Holding::Pinned { to, area_mm2, .. } = hook.holding else {
        panic!("{:?}", hook.holding)
    };
    // The hook leaves upward, face 4; it lies on the part of face 0, across their bisector at 45°.
    assert_eq!((hook.face, parts[to].face), (4, 0));
    assert!(
        (area_mm2 - 22.0 * 19.0 * 2f64.sqrt()).abs() < 1e-6,
        "{area_mm2}"
    );
}

#[test]
fn a_crumb_grows_on_its_neighbour_and_nothing_is_lost() {
    // The hook's end stands into the upper cell by a few millimetres only.
    let stem = block([130.0, -12.0, -12.0], [190.0, 12.0, 12.0]);
    let arm = block([170.0, -11.0, 0.0], [189.0, 11.0, 172.0]);
    let ground = ground(united(&[ball_ground().solid().mesh().clone(), stem, arm]));
    let base = base(&ground, 10.0, &cube([80.0, 70.0, 60.0]));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let loose = divided(&scene, 0.0);
    assert_eq!(loose.len(), 7);
    let parts = divided(&scene, 1e4);
    assert_eq!(parts.len(), 6);
    assert!(volume_error(&ground, &scene, &parts).abs() < 1e-9);
    let grown: Vec<&Part> = parts
        .iter()
        .filter(|part| !part.crumbs.is_empty())
        .collect();
    assert_eq!(
        (grown.len(), grown[0].face, grown[0].crumbs[0].face),
        (1, 0, 4)
    );
}

#[test]
fn large_parts_are_cut_along_their_way_until_they_fit() {
    let ground = ball_ground();
    let base = base(&ground, 10.0, &cube([80.0, 70.0, 60.0]));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let room = Room {
        size_mm: [150.0, 120.0, 110.0],
        wall_mm: WALL_MM,
    };
    let fit = || {
        scene
            .fit(divided(&scene, 0.0), &room, &Watch::silent())
            .unwrap()
    };
    let parts = fit();
    println!("{} parts in rooms of {:?} mm", parts.len(), room.size_mm);
    assert_eq!(parts, fit());
    assert!(parts.len() > 6 && parts.len() <= 30, "{}", parts.len());
    assert!(volume_error(&ground, &scene, &parts).abs() < 1e-9);
    hold_free(&scene, &parts);
    for (index, part) in parts.iter().enumerate() {
        let lie = scene.lie(part, &room).unwrap();
        assert!((0..3).all(|k| lie.size_mm[k] <= room.size_mm[k] + 1e-6));
        let print: TriMesh = part.body.in_frame(&lie.frame);
        assert!(print.aabb().min.coords.norm() < 1e-6);
        let way = scene.normal(part.face);
        let mut siblings = parts
            .iter()
            .enumerate()
            .filter(|(other, _)| *other != index);
        assert!(siblings.all(|(_, other)| barred_mm2(&part.body, &other.body, &way) < 1e-6));
    }
    let tiny = Room {
        size_mm: [150.0, 11.0, 110.0],
        wall_mm: WALL_MM,
    };
    let why = scene
        .fit(divided(&scene, 0.0), &tiny, &Watch::silent())
        .unwrap_err();
    assert!(matches!(why, CladdingError::Room { .. }), "{why}");
}

#[test]
fn cups_keep_their_wall_everywhere_and_are_open_at_the_panel() {
    for (ground, faces) in [
        (box_ground(), cube([80.0, 70.0, 60.0])),
        (two_balls(), dodecahedron(100.0)),
    ] {
        let base = base(&ground, 10.0, &faces);
        let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
        for (index, part) in divided(&scene, 0.0).iter().enumerate() {
            let request = CupRequest {
                wall_mm: WALL_MM,
                keeps: &[],
            };
            let cup = scene.cup(part, &request, &Watch::silent()).unwrap();
            let wall_mm = hold_cup(part, &cup, WALL_MM, &format!("part {index}"));
            println!(
                "part {index}: {:.0} of {:.0} mm³ hollow, {:.0} mm³ unreached, thinnest {wall_mm:.4} mm",
                cup.void_mm3,
                part.volume_mm3(),
                cup.unreached_mm3
            );
            assert!(!part.is_on_panel() || cup.void_mm3 > 0.2 * part.volume_mm3());
            let sum_mm3 = cup.body.signed_volume_mm3() + cup.void_mm3;
            assert!((sum_mm3 - part.volume_mm3()).abs() < 1e-9 * part.volume_mm3());
        }
    }
}

#[test]
fn screws_stand_clear_of_joints_and_seams_with_bosses_around_them() {
    let ground = ball_ground();
    let base = base(&ground, 10.0, &cube([80.0, 70.0, 60.0]));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let parts = divided(&scene, 0.0);
    let (panels, kit) = (panels(&base), kit());
    let request = ScrewRequest {
        panels: &panels,
        kit: &kit,
        wall_mm: WALL_MM,
    };
    let all = scene.screws(&parts, &request);
    assert_eq!(all.len(), 6);
    for screws in &all {
        assert!(screws.screws.len() >= 3, "{screws:?}");
        let panel = &panels.panels[screws.panel];
        for screw in &screws.screws {
            let corners = panel.outline.edges();
            let gap = corners.map(|[a, b]| {
                let along = [b[0] - a[0], b[1] - a[1]];
                let from = [screw.at_mm[0] - a[0], screw.at_mm[1] - a[1]];
                let share = (from[0] * along[0] + from[1] * along[1])
                    / (along[0] * along[0] + along[1] * along[1]);
                let share = share.clamp(0.0, 1.0);
                (from[0] - share * along[0]).hypot(from[1] - share * along[1])
            });
            assert!(gap.fold(f64::INFINITY, f64::min) > 0.5 * 7.6);
        }
        let part = &parts[screws.part];
        let keeps = screws.keeps(&kit, 9.0);
        let order = CupRequest {
            wall_mm: WALL_MM,
            keeps: &keeps,
        };
        let cup = scene.cup(part, &order, &Watch::silent()).unwrap();
        hold_cup(part, &cup, WALL_MM, "with bosses");
        assert!(cup.loose_mm3 < 1e-9, "a boss stands free");
        // All about the insert the boss is solid.
        let body = equipoise::geom::Bvh::new(cup.body.iter_corners());
        for screw in &screws.screws {
            let up = (screw.roof - screw.foot).normalize();
            let side = up.cross(&Vector::new(0.3, 0.5, 0.8)).normalize();
            for turn in 0..24 {
                let angle = f64::from(turn) * std::f64::consts::TAU / 24.0;
                let out = side * angle.cos() + up.cross(&side) * angle.sin();
                let at = screw.foot + out * (kit.boss_radius_mm() - 0.05) + up * 0.05;
                assert!(body.winding(&at) > 0);
                assert!(body.winding(&(at + up * (kit.depth_mm() - 0.1))) > 0);
            }
        }
    }
}

#[test]
fn a_shell_is_taken_apart_in_its_order_without_a_collision() {
    for (name, ground, faces) in [
        ("box", box_ground(), cube([80.0, 70.0, 60.0])),
        ("hook", hooked_ball(), cube([80.0, 70.0, 60.0])),
        ("two balls", two_balls(), dodecahedron(90.0)),
    ] {
        let base = base(&ground, 10.0, &faces);
        let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
        let (panels, kit) = (panels(&base), kit());
        let request = ShellRequest {
            wall_mm: WALL_MM,
            style: ShellStyle::Solid,
            crumb_mm3: 100.0,
            room_mm: Some([250.0, 210.0, 210.0]),
            kit: Some(&kit),
            pins: None,
            up: Vector::z(),
        };
        let shell = scene.clad(&panels, &request, &Watch::silent()).unwrap();
        let closing = &shell.assembly.units[shell.assembly.closing.unwrap()];
        let lowest = scene.bottom_face(&Vector::z()).unwrap();
        assert_eq!((closing.face, closing.has_panel), (lowest, true));
        hold_order_by_height(&scene, &shell.parts, name);
        let worst_mm3 = take_apart(&shell);
        println!(
            "{name}: {} units of {} parts, overlap on the way {worst_mm3:.1e} mm³",
            shell.assembly.units.len(),
            shell.parts.len()
        );
        assert!(worst_mm3 <= MOST_ON_THE_WAY_MM3, "{name}: {worst_mm3}");
        let printed = shell.cups.iter().map(|cup| cup.body.signed_volume_mm3());
        let solid = shell.parts.iter().map(Part::volume_mm3);
        let lost_mm3 = solid.sum::<f64>() - printed.sum::<f64>() - shell.bores_mm3;
        assert!(lost_mm3.abs() < 1e-3, "{lost_mm3}");
    }
}

/// Holds that the unit at the bottom closes an object, whichever way it stands. Where all ways are
/// free, the higher units are joined first.
fn hold_order_by_height(scene: &Scene, parts: &[Part], name: &str) {
    for up in [Vector::z(), -Vector::z(), Vector::x(), -Vector::y()] {
        let assembly = scene.assembly(parts, &up).unwrap();
        let height_mm = |unit: &usize| {
            let face = &scene.base.faces()[assembly.units[*unit].face];
            up.dot(&face.centroid.coords)
        };
        let closing = assembly.closing.unwrap();
        assert_eq!(Some(assembly.units[closing].face), scene.bottom_face(&up));
        if assembly.units.iter().all(|unit| unit.after.is_empty()) {
            let open: Vec<f64> = assembly.order.iter().map(height_mm).collect();
            assert!(open.is_sorted_by(|a, b| a >= b), "{name}, {up}: {open:?}");
            assert_eq!(assembly.order.last(), Some(&closing));
        }
    }
}

#[test]
fn one_thread_and_two_make_the_same_shell() {
    let ground = hooked_ball();
    let base = base(&ground, 10.0, &cube([80.0, 70.0, 60.0]));
    let scene = Scene::new(&ground, &base, GAP_MM).unwrap();
    let (panels, kit) = (panels(&base), kit());
    let request = ShellRequest {
        wall_mm: WALL_MM,
        style: ShellStyle::Solid,
        crumb_mm3: 100.0,
        room_mm: Some([250.0, 210.0, 210.0]),
        kit: Some(&kit),
        pins: None,
        up: Vector::z(),
    };
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        pool.install(|| scene.clad(&panels, &request, &Watch::silent()).unwrap())
    });
    assert_eq!(one, two);
}

#[test]
fn bad_lengths_are_named() {
    let ground = box_ground();
    let base = base(&ground, 10.0, &cube([85.0, 75.0, 65.0]));
    for gap_mm in [-0.1, f64::NAN, f64::INFINITY] {
        let why = Scene::new(&ground, &base, gap_mm).err().unwrap();
        assert!(matches!(why, CladdingError::NotPositive { .. }), "{why}");
    }
    let why = Scene::new(&ground, &base, 10.0).err().unwrap();
    assert!(matches!(why, CladdingError::Gap { .. }), "{why}");
}
