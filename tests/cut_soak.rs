//! Random cuts of random bodies with random pins give sound parts. Every written part is a solid,
//! every pin is there, and no volume is lost or gained.
//!
//! By default a few cases with bodies of our own are tried. `EQUIPOISE_SOAK_CASES=500` tries more,
//! `EQUIPOISE_SOAK_MODELS=folder` adds the closed meshes of a folder, and `EQUIPOISE_SOAK_FIRST=n`
//! begins with case n.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a long run reports its progress")]

use crate::common;

use std::path::Path;
use std::time::Instant;

use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::cut::{
    Cut, CutId, CutOrder, CutPlan, CutSide, GoalAxis, Hollowed, JigShelf, LabelStyle, LeastPart,
    Obstacle, Part, PinSettings, PinSite, PlanRequest, PosePreference, Seams, Side, parts, plan_by,
    rods,
};
use equipoise::geom::{Bvh, Point, Vector};
use equipoise::io::read_model;
use equipoise::make::write;
use equipoise::mass::moments_of_mesh;
use equipoise::mesh::{Crossings, Csg, MeshDistance, Solid, TriMesh, primitives};
use equipoise::printer::Cleaning;
use equipoise::repair::{one_body, repair, weld};

/// Cases of a usual run.
const CASES: u64 = 24;
/// Relative error of volumes: the rounding of files.
const VOLUME_RATIO: f64 = 1e-6;
/// Distance before and behind the end of a pin or socket at which it is probed, mm.
const PROBE_MM: f64 = 0.02;

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn direction(&mut self) -> Vector {
        loop {
            let v = Vector::from_fn(|_, _| self.between(-1.0, 1.0));
            if (0.01..1.0).contains(&v.norm()) {
                return v.normalize();
            }
        }
    }

    fn point_in(&mut self, mesh: &TriMesh) -> Point {
        let (low, high) = (mesh.aabb().min, mesh.aabb().max);
        Point::from(Vector::from_fn(|i, _| self.between(low[i], high[i])))
    }
}

/// The bodies to cut: our own, and the closed single bodies of the folder.
fn bodies() -> Vec<(String, TriMesh)> {
    let shaft = primitives::cuboid(&Point::new(-2.0, -3.0, -20.0), &Point::new(2.0, 3.0, 20.0));
    let arm = primitives::cuboid(&Point::new(-12.0, -1.0, -4.0), &Point::new(12.0, 1.0, 4.0));
    let cross = Csg::of_mesh(&shaft)
        .unwrap()
        .union(&Csg::of_mesh(&arm).unwrap())
        .unwrap();
    let ours = [
        ("ball", primitives::ball(&Point::origin(), 5.0, 4)),
        ("ring", primitives::torus(10.0, 4.0, 60, 30)),
        ("can", primitives::cylinder(5.0, 12.0, 64)),
        ("cross", cross.to_mesh().unwrap()),
        (
            "ellipsoid",
            read_model(Path::new(common::ELLIPSOID)).unwrap(),
        ),
    ];
    let mut all: Vec<(String, TriMesh)> = ours
        .map(|(name, mesh)| (name.to_owned(), repair(mesh, &Watch::silent()).unwrap().0))
        .to_vec();
    if let Some(folder) = std::env::var_os("EQUIPOISE_SOAK_MODELS") {
        let mut paths: Vec<_> = std::fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .collect();
        paths.sort();
        for path in paths {
            let Ok(mesh) = read_model(&path) else {
                continue;
            };
            let watch = Watch::silent();
            let mesh = repair(mesh, &watch).unwrap().0;
            if Solid::new(mesh.clone()).is_ok_and(|solid| one_body(&solid, &watch) == Ok(Ok(()))) {
                all.push((
                    path.file_name().unwrap().to_string_lossy().into_owned(),
                    mesh,
                ));
            }
        }
    }
    all
}

/// A request for a random printer, from a fine display to a coarse nozzle.
fn request(dice: &mut Dice) -> PlanRequest {
    let pixel_mm = [0.019, 0.042, 0.1, 0.45][dice.below(4)];
    let wall_mm = dice.between(0.4, 2.0);
    PlanRequest {
        wants_wide_joints: false,
        worth_ratio: 0.0,
        part_weight: PlanRequest::PART_WEIGHT,
        cleaning: Cleaning::MELT_OUT,
        min_opening_mm: dice.between(1.0, 5.0),
        build_volume_mm: None,
        wall_mm,
        pins: PinSettings {
            min_diameter_mm: dice.between(0.6, 3.0),
            length_ratio: dice.between(0.8, 1.6),
            clearance_mm: dice.between(0.03, 0.3),
            chamfer_mm: dice.between(0.0, 0.5),
            bottom_relief_mm: dice.between(0.0, 0.6),
            spread_ratio: dice.between(0.0, 0.5),
            snug_gap_mm: dice.between(0.02, 0.2),
            max_step_mm: Some(dice.between(0.1, 0.8)),
        },
        axis: GoalAxis {
            point: Point::origin(),
            direction: dice.direction(),
        },
        pixel_mm,
        hole_step_mm: if pixel_mm < 0.45 { pixel_mm } else { 0.0 },
        layer_mm: [0.016, 0.05, 0.2][dice.below(3)],
        pose: [PosePreference::CutFaceDown, PosePreference::OpenHollowUp][dice.below(2)],
        rods: if dice.below(4) == 0 {
            rods().unwrap()
        } else {
            Vec::new()
        },
        labels: (dice.below(2) == 0).then_some(LabelStyle {
            stroke_mm: 0.5,
            depth_mm: 0.5,
            numbered: 0,
        }),
        seams: Seams::default(),
        least_part: LeastPart::NONE,
        jigs: JigShelf::default(),
        watch: Watch::silent(),
    }
}

/// Up to three balls of air, each a wall from the outside and from each other.
fn voids(dice: &mut Dice, outer: &TriMesh, wall_mm: f64) -> Vec<Solid> {
    let distance = MeshDistance::new(outer);
    let mut balls: Vec<(Point, f64)> = Vec::new();
    for _ in 0..dice.below(4) {
        for _ in 0..40 {
            let center = dice.point_in(outer);
            let near = balls
                .iter()
                .map(|(other, radius)| (other - center).norm() - radius);
            let room_mm = near.fold(distance.signed(&center), f64::min) - wall_mm;
            if room_mm > 1.0 {
                balls.push((center, room_mm * dice.between(0.5, 1.0)));
                break;
            }
        }
    }
    let ball =
        |(center, radius): (Point, f64)| Solid::new(primitives::ball(&center, radius, 3)).unwrap();
    balls.into_iter().map(ball).collect()
}

/// One to three cuts: at random, along an axis, through a void, or through a corner of the mesh.
fn cuts(dice: &mut Dice, body: &Hollowed) -> Vec<Cut> {
    let count = 1 + dice.below(3);
    let cut = |i: usize| {
        let mesh = body.outer.mesh();
        let normal = if dice.below(3) == 0 {
            Vector::ith(dice.below(3), 1.0)
        } else {
            dice.direction()
        };
        let point = match (dice.below(3), body.voids.get(i)) {
            (0, _) => mesh.vertices()[dice.below(mesh.vertices().len())],
            (_, Some(void)) => void.mesh().aabb().center(),
            _ => dice.point_in(mesh),
        };
        let within = (i > 0 && dice.below(2) == 0).then(|| side(dice, i));
        let within = within.into_iter().collect();
        Cut {
            id: CutId::of(i),
            point_mm: point.into(),
            normal: normal.into(),
            within,
        }
    };
    (0..count).map(cut).collect()
}

/// A random side of one of the first cuts.
fn side(dice: &mut Dice, cuts: usize) -> CutSide {
    let side = if dice.below(2) == 0 {
        Side::Above
    } else {
        Side::Below
    };
    CutSide {
        cut: CutId::of(dice.below(cuts)),
        side,
    }
}

/// Makes one case and checks its parts; returns a line about the number of parts and pins.
fn try_case(case: u64, bodies: &[(String, TriMesh)]) -> String {
    let mut dice = Dice(case.wrapping_mul(0x1234_5678_9abc_def1));
    let (name, mesh) = &bodies[dice.below(bodies.len())];
    let size_mm = dice.between(30.0, 200.0);
    let scale = size_mm / mesh.longest_side_mm();
    let mesh = mesh.map_vertices(|p| p * scale);
    let request = request(&mut dice);
    let outer = Solid::new(mesh).unwrap();
    let voids = voids(&mut dice, outer.mesh(), request.wall_mm);
    let body = Hollowed::new(outer, voids);
    let order = CutOrder {
        cuts: cuts(&mut dice, &body),
        ..CutOrder::default()
    };
    let label = format!(
        "case {case}: {name} {size_mm:.0} mm, {} voids, {} cuts",
        body.voids.len(),
        order.cuts.len()
    );
    let plan = plan_by(&body, &request, &order).unwrap_or_else(|error| panic!("{label}: {error}"));
    let plan = match plan {
        Verdict::Found(plan) => plan,
        Verdict::No(Obstacle::ClosedCavity { .. }) => {
            return format!("{label}: a void stays closed");
        }
        Verdict::No(obstacle) => panic!("{label}: {obstacle}"),
    };
    let made = parts(&body, &plan, &request).unwrap_or_else(|error| panic!("{label}: {error}"));
    let made: Vec<Part> = made
        .or_error()
        .unwrap_or_else(|why: Obstacle| panic!("{label}: {why}"));
    assert_nothing_is_lost(&label, &body, &plan, &made);
    assert_written_parts_are_sound(&label, &made);
    format!("{label}: {} parts, {} pins", made.len(), plan.pins.len())
}

fn assert_nothing_is_lost(label: &str, body: &Hollowed, plan: &CutPlan, made: &[Part]) {
    let whole = moments_of_mesh(&body.to_mesh()).volume();
    let sum: f64 = made
        .iter()
        .map(|part| moments_of_mesh(part.solid.mesh()).volume())
        .sum();
    let pegs: f64 = made.iter().map(Part::added_volume_mm3).sum();
    assert!(
        (sum - pegs - whole).abs() <= VOLUME_RATIO * whole,
        "{label}: {sum} - {pegs} against {whole}"
    );
    for pin in &plan.pins {
        if pin.dowel.is_some() {
            assert_both_sockets_are_there(label, pin, made);
        } else {
            assert_pin_and_socket_are_there(label, pin, made);
        }
    }
}

/// The winding numbers of a part a little before and behind a height over a pin's base.
fn probe(part: &Part, pin: &PinSite, height_mm: f64) -> [i32; 2] {
    let surface = Bvh::new(part.solid.mesh().iter_corners());
    [-PROBE_MM, PROBE_MM].map(|off_mm| surface.winding(&beside_axis(pin, height_mm + off_mm)))
}

fn assert_pin_and_socket_are_there(label: &str, pin: &PinSite, made: &[Part]) {
    let only = |parts: Vec<&Part>| match parts[..] {
        [part] => part.clone(),
        _ => panic!("{label}: pin {} is in {} parts", pin.id, parts.len()),
    };
    let carrier = only(made.iter().filter(|part| part.pins.contains(pin)).collect());
    let receiver = only(
        made.iter()
            .filter(|part| part.sockets.contains(pin))
            .collect(),
    );
    let tip = probe(&carrier, pin, pin.length_mm);
    assert_eq!(tip, [1, 0], "{label}: pin {} ends elsewhere", pin.id);
    let bottom = probe(&receiver, pin, pin.socket_depth_mm);
    assert_eq!(bottom, [0, 1], "{label}: socket {} ends elsewhere", pin.id);
}

fn assert_both_sockets_are_there(label: &str, pin: &PinSite, made: &[Part]) {
    let sockets = made
        .iter()
        .flat_map(|part| part.sockets.iter().map(move |socket| (part, socket)));
    let ends: Vec<(&Part, &PinSite)> = sockets.filter(|(_, socket)| socket.id == pin.id).collect();
    assert_eq!(ends.len(), 2, "{label}: dowel {}", pin.id);
    for (part, socket) in ends {
        let bottom = probe(part, socket, socket.socket_depth_mm);
        assert_eq!(
            bottom,
            [0, 1],
            "{label}: a socket of dowel {} ends elsewhere",
            pin.id
        );
    }
}

/// A point beside a pin's axis at a height over its base, off the edges of its end.
fn beside_axis(pin: &PinSite, height_mm: f64) -> Point {
    let axis = Vector::from(pin.direction);
    let aside = axis.cross(&Vector::new(0.36, 0.48, 0.8)) * (pin.diameter_mm / 9.0);
    Point::from(pin.center_mm) + axis * height_mm + aside
}

fn assert_written_parts_are_sound(label: &str, made: &[Part]) {
    let watch = Watch::silent();
    for part in made {
        let written = write(part.clone(), &format!("soak_{}", part.id), [1.0; 3], &watch).unwrap();
        let surface = weld(&written.read_back);
        let crossings = Crossings::of(&surface).pairs;
        let defect = Solid::new(surface).err();
        assert!(
            defect.is_none(),
            "{label}: {}: {}",
            part.id,
            defect.unwrap()
        );
        assert_eq!(crossings, 0, "{label}: {} passes through itself", part.id);
    }
}

fn number(key: &str, default: u64) -> u64 {
    std::env::var(key).map_or(default, |text| text.parse().unwrap())
}

#[test]
fn random_cuts_of_random_bodies_give_sound_parts_with_all_their_pins() {
    let bodies = bodies();
    let (first, count) = (
        number("EQUIPOISE_SOAK_FIRST", 0),
        number("EQUIPOISE_SOAK_CASES", CASES),
    );
    let mut failed = Vec::new();
    for case in first..first + count {
        let start = Instant::now();
        match std::panic::catch_unwind(|| try_case(case, &bodies)) {
            Ok(label) if count > CASES => {
                eprintln!("{label} ({:.1} s)", start.elapsed().as_secs_f64())
            }
            Ok(_) => (),
            Err(_) => failed.push(case),
        }
    }
    assert!(failed.is_empty(), "cases {failed:?} of {count} failed");
}
