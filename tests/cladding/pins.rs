//! Pins between parts: in the cuts of one panel, and between limbs and what carries them.

use equipoise::base::watch::Watch;
use equipoise::cladding::{CladShell, PinRequest, Scene, ShellRequest, ShellStyle};
use equipoise::cut::{GoalAxis, PlanRequest};
use equipoise::geom::{Point, Vector};
use equipoise::polyhedra::Ground;
use equipoise::printer::Printer;

use super::scenes::{
    MOST_ON_THE_WAY_MM3, base, cube, dodecahedron, overlap_mm3, panels, take_apart,
};
use super::{GAP_MM, WALL_MM, box_ground, hooked_ball, kit, two_balls};

fn plan() -> PlanRequest {
    let printer = Printer::find("prusa-mk4").unwrap();
    let axis = GoalAxis {
        point: Point::origin(),
        direction: Vector::z(),
    };
    PlanRequest::for_printer(&printer, 200.0, axis)
}

/// Makes the shell of a model with pins, about a base with these faces.
fn pinned(ground: &Ground, faces: &[(Vector, f64)], room_mm: f64, style: ShellStyle) -> CladShell {
    let base = base(ground, 10.0, faces);
    let scene = Scene::new(ground, &base, GAP_MM).unwrap();
    let (kit, plan) = (kit(), plan());
    let request = ShellRequest {
        wall_mm: WALL_MM,
        style,
        crumb_mm3: 100.0,
        room_mm: Some([room_mm; 3]),
        kit: Some(&kit),
        pins: Some(PinRequest {
            plan: &plan,
            floor_mm: 1.65,
        }),
        up: Vector::z(),
    };
    let panels = panels(&base);
    scene.clad(&panels, &request, &Watch::silent()).unwrap()
}

fn unit_of(shell: &CladShell, part: usize) -> usize {
    let mut units = shell.assembly.units.iter();
    units.position(|unit| unit.parts.contains(&part)).unwrap()
}

/// Holds that volumes add up to 1e-9 with pins and sockets counted.
fn hold_volumes(shell: &CladShell) {
    let whole: f64 = shell.parts.iter().map(|part| part.volume_mm3()).sum();
    let cups = shell.cups.iter().map(|cup| {
        let [pegs_mm3, sockets_mm3] = cup.pins_mm3;
        cup.body.signed_volume_mm3() + cup.void_mm3 - pegs_mm3 + sockets_mm3
    });
    let all = cups.sum::<f64>() + shell.bores_mm3;
    assert!((all / whole - 1.0).abs() < 1e-9, "{all} {whole}");
}

#[test]
fn parts_of_one_panel_are_pinned_and_come_together_in_their_order() {
    let shell = pinned(
        &box_ground(),
        &cube([80.0, 70.0, 60.0]),
        130.0,
        ShellStyle::Cups,
    );
    assert!(shell.pins.len() >= 6, "{}", shell.pins.len());
    hold_volumes(&shell);
    let mut group: Vec<usize> = (0..shell.parts.len()).collect();
    for joint in &shell.pins {
        let [on, into] = joint.parts;
        assert_eq!(shell.parts[on].face, shell.parts[into].face);
        assert_eq!(unit_of(&shell, on), unit_of(&shell, into));
        let along = Vector::from(joint.sites[0].direction);
        // The socket leaves along the pins, and nothing of both overlaps on the way.
        for step_mm in [0.0, 0.5, 4.0, 15.0] {
            let moved = shell.cups[into].body.map_vertices(|p| p + along * step_mm);
            let shared_mm3 = overlap_mm3(&moved, &shell.cups[on].body);
            assert!(shared_mm3 < 1e-3, "{joint:?} at {step_mm}: {shared_mm3}");
        }
        // Everything on one side comes to everything on the other along one line.
        let [one, other] = [group[on], group[into]];
        if one == other {
            continue;
        }
        let across = shell.pins.iter().filter(|pins| {
            let ends = pins.parts.map(|part| group[part]);
            ends == [one, other] || ends == [other, one]
        });
        for pins in across {
            let cosine = along.dot(&Vector::from(pins.sites[0].direction));
            assert!(cosine.abs() > 1.0 - 1e-9, "{cosine}");
        }
        group
            .iter_mut()
            .filter(|at| **at == other)
            .for_each(|at| *at = one);
    }
}

#[test]
fn limbs_leave_along_their_pins_and_all_shells_come_apart() {
    for (name, ground, faces) in [
        ("hook", hooked_ball(), cube([80.0, 70.0, 60.0])),
        ("two balls", two_balls(), dodecahedron(90.0)),
    ] {
        let shell = pinned(&ground, &faces, 210.0, ShellStyle::Solid);
        hold_volumes(&shell);
        let mut between = 0;
        for joint in &shell.pins {
            let [on, into] = joint.parts.map(|part| unit_of(&shell, part));
            if on == into {
                continue;
            }
            between += 1;
            // The socket is in the limb, which leaves along the pin.
            let limb = &shell.assembly.units[into];
            assert!(!limb.has_panel, "{name}");
            let along = Vector::from(joint.sites[0].direction);
            assert!((limb.way.dot(&along) - 1.0).abs() < 1e-9, "{name}");
            let place = |unit: usize| shell.assembly.order.iter().position(|at| *at == unit);
            assert!(place(into) > place(on), "{name}");
        }
        let worst_mm3 = take_apart(&shell);
        println!(
            "{name}: {} joints with pins, {between} of them limbs, {worst_mm3:.1e} mm³ on the way",
            shell.pins.len()
        );
        assert!(worst_mm3 <= MOST_ON_THE_WAY_MM3, "{name}: {worst_mm3}");
    }
}
