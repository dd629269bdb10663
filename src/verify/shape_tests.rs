//! The surfaces of parts: as they should be, and with one fault at a time.

use super::judge_tests::{SEAT, failures, judge, sound_kit};
use super::pegs_tests::{PIN, SOCKET, kit_with_pin};
use super::shape::measure_shapes;
use super::test_meshes::ball;
use super::*;
use crate::base::watch::Watch;
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// Returns the sound kit with a change of one part's mesh, print frame.
fn kit_with(part: usize, change: impl Fn(&TriMesh) -> TriMesh) -> Evidence {
    let mut evidence = sound_kit();
    evidence.parts[part].mesh = change(&evidence.parts[part].mesh);
    evidence
}

/// Returns each triangle cut into four.
fn refine(mesh: &TriMesh) -> TriMesh {
    let middle = |p: &Point, q: &Point| nalgebra::center(p, q);
    let quarters = mesh.iter_corners().flat_map(|[a, b, c]| {
        let [ab, bc, ca] = [middle(&a, &b), middle(&b, &c), middle(&c, &a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    });
    let vertices: Vec<Point> = quarters.flatten().collect();
    let faces = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let faces = faces.collect();
    TriMesh::new(vertices, faces).unwrap()
}

/// Returns a mesh with the corner nearest to a place moved by this way.
fn pull(mesh: &TriMesh, place: Point, way: Vector) -> TriMesh {
    let corners = mesh.vertices().iter();
    let nearest = corners.min_by(|a, b| (*a - place).norm().total_cmp(&(*b - place).norm()));
    let nearest = *nearest.unwrap();
    mesh.map_vertices(|p| if *p == nearest { p + way } else { *p })
}

fn strays(evidence: &Evidence) -> Vec<Stray> {
    judge(evidence).shape.strays
}

fn assert_blamed(evidence: &Evidence, what: &str) {
    let failed = failures(evidence);
    assert!(
        failed.contains(&"part surfaces".to_owned()),
        "{what}: {failed:?}"
    );
}

#[test]
fn parts_of_other_triangles_with_the_same_surface_are_as_they_should_be() {
    assert_eq!(strays(&sound_kit()), []);
    let finer = kit_with(0, |mesh| refine(&refine(mesh)));
    assert_eq!(strays(&finer), []);
    let mut coarser = sound_kit();
    coarser.hollowed = refine(&refine(&coarser.hollowed));
    assert_eq!(strays(&coarser), []);
    assert_eq!(strays(&kit_with_pin(PIN, SOCKET, Vector::zeros())), []);
}

/// The part prints upside down with its floor on the plate at z = 0. Its outside reaches from 0 to
/// 60 and 40 mm.
#[test]
fn a_dent_of_five_micrometres_is_named_with_its_part_and_place() {
    for depth_mm in [0.005, -0.005, 0.3] {
        let dented = kit_with(1, |mesh| {
            pull(
                &refine(mesh),
                Point::origin(),
                Vector::new(0.0, 0.0, depth_mm),
            )
        });
        let found = strays(&dented);
        let stray = found.iter().find(|stray| stray.of == "P02").unwrap();
        assert!(!stray.is_missing && stray.off_mm >= 0.002, "{stray:?}");
        let corner = dented.parts[1].pose.to_model(&Point::origin());
        assert!((stray.at - corner).norm() < 30.0, "{stray:?}");
        assert!(
            found
                .iter()
                .any(|stray| stray.of == "hollowed.stl" && stray.is_missing)
        );
    }
}

#[test]
fn a_wall_that_is_thin_in_the_part_alone_is_measured_there() {
    // All corners of the void's floor, 3 mm over the plate, go down to 0.1 mm.
    let thinned = kit_with(0, |mesh| {
        let is_floor = |p: &Point| (p.z - 3.0).abs() < 1e-9 && p.x > 1.0 && p.x < 59.0;
        mesh.map_vertices(|p| {
            if is_floor(p) {
                Point::new(p.x, p.y, 0.1)
            } else {
                *p
            }
        })
    });
    assert_blamed(&thinned, "a thin floor");
    let wall_mm = judge(&thinned).wall_min_mm.unwrap();
    assert!((wall_mm - 0.1).abs() < 1e-9, "{wall_mm}");
}

#[test]
fn loose_bodies_and_hidden_cavities_are_found() {
    let loose = |center: Point| kit_with(0, |mesh| mesh.clone().joined(&ball(center, 0.3, 6)));
    for center in [Point::new(30.0, 20.0, 4.5), Point::new(70.0, 20.0, 1.0)] {
        let found = failures(&loose(center));
        assert!(found.contains(&"one body".to_owned()), "{found:?}");
        assert_blamed(&loose(center), "a loose ball");
    }
    let hidden = kit_with(0, |mesh| {
        mesh.clone()
            .joined(&ball(Point::new(30.0, 20.0, 1.5), 0.3, 6).reversed())
    });
    assert_blamed(&hidden, "a hidden cavity");
}

#[test]
fn shifted_scaled_and_exchanged_parts_are_found() {
    for way in [Vector::x(), Vector::y(), Vector::z()] {
        let shifted = kit_with(1, |mesh| mesh.map_vertices(|p| p + way * 0.02));
        assert_blamed(&shifted, "a shift by 0.02 mm");
    }
    for factor in [1.0 + 1e-4, 1.0 - 1e-4] {
        let scaled = kit_with(0, |mesh| mesh.map_vertices(|p| p * factor));
        assert_blamed(&scaled, "a scale of a ten-thousandth");
    }
    let mut exchanged = kit_with_pin(PIN, SOCKET, Vector::zeros());
    exchanged.parts.swap(0, 1);
    assert_blamed(&exchanged, "exchanged parts");
    let moved = {
        let mut evidence = sound_kit();
        evidence.promise.cuts[0].point_mm[2] += 0.02;
        evidence
    };
    assert_blamed(&moved, "a cut that is elsewhere");
}

#[test]
fn a_pin_or_socket_of_another_size_or_none_is_found() {
    let none = |[diameter, _]: [f64; 2]| [diameter, -0.3];
    let made = [
        ([PIN[0] + 0.02, PIN[1]], SOCKET, Vector::zeros()),
        ([PIN[0], PIN[1] + 0.005], SOCKET, Vector::zeros()),
        (PIN, [SOCKET[0] - 0.02, SOCKET[1]], Vector::zeros()),
        (PIN, [SOCKET[0], SOCKET[1] + 0.005], Vector::zeros()),
        (PIN, SOCKET, Vector::new(0.01, 0.0, 0.0)),
        (none(PIN), SOCKET, Vector::zeros()),
        (PIN, none(SOCKET), Vector::zeros()),
    ];
    for (pin, socket, shift) in made {
        let what = format!("{pin:?} {socket:?} {shift:?}");
        assert_blamed(&kit_with_pin(pin, socket, shift), &what);
    }
    // What stands in the file is not on the list.
    let mut unlisted = kit_with_pin(PIN, SOCKET, Vector::zeros());
    unlisted.promise.parts[0].pins.clear();
    assert_blamed(&unlisted, "a pin that is not on the list");
    let mut turned = kit_with_pin(PIN, SOCKET, Vector::zeros());
    turned.promise.parts[0].pins[0].center_mm = [SEAT[0] - 0.01, SEAT[1], SEAT[2]];
    assert_blamed(&turned, "a pin that is elsewhere");
}

/// Number of kits that are changed at random in a long run; a quarter of them by default.
const CHANGES: usize = 1200;

/// Numbers that look random, the same in every run (Steele, Lea and Flood, 2014).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    fn pick(&mut self, count: usize) -> usize {
        (self.roll() % count as u64) as usize
    }

    fn share(&mut self) -> f64 {
        (self.roll() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn direction(&mut self) -> Vector {
        let [x, y, z] = [(); 3].map(|()| self.share() - 0.5);
        Vector::new(x, y, z).normalize()
    }

    /// Returns a place in the box of a mesh.
    fn place(&mut self, mesh: &TriMesh) -> Point {
        let (aabb, shares) = (mesh.aabb(), [(); 3].map(|()| self.share()));
        aabb.min + aabb.size().component_mul(&Vector::from(shares))
    }
}

/// Returns true for a triangle that is higher than ten times what the judge lets pass.
fn is_broad([a, b, c]: &[Point; 3]) -> bool {
    let sides = [b - a, c - b, a - c].map(|side| side.norm());
    (b - a).cross(&(c - a)).norm() > 0.02 * sides.into_iter().fold(0.0, f64::max)
}

/// Moves the corner of a triangle that is no sliver along the normals about it.
fn dent(mesh: &TriMesh, dice: &mut Dice, way_mm: f64) -> TriMesh {
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let broad: Vec<&[Point; 3]> = corners.iter().filter(|corners| is_broad(corners)).collect();
    let at = broad[dice.pick(broad.len())][dice.pick(3)];
    let about = broad.iter().filter(|corners| corners.contains(&at));
    let normals = about.map(|[a, b, c]| (b - a).cross(&(c - a)).normalize());
    let way: Vector = normals.sum();
    pull(mesh, at, way.normalize() * way_mm)
}

/// Changes a part at random; returns what was done.
fn change(evidence: &mut Evidence, dice: &mut Dice) -> String {
    let part = dice.pick(2);
    let sign = if dice.share() < 0.5 { -1.0 } else { 1.0 };
    let amount_mm = sign * 0.005 * 60f64.powf(dice.share());
    let mesh = evidence.parts[part].mesh.clone();
    let (what, changed) = match dice.pick(8) {
        0..3 => ("dent", dent(&mesh, dice, amount_mm)),
        3 => {
            let loose = ball(dice.place(&mesh), 0.02 + amount_mm.abs(), 6);
            let loose = if sign < 0.0 { loose.reversed() } else { loose };
            ("loose body", mesh.joined(&loose))
        }
        4 => {
            let way = dice.direction() * 0.02;
            ("shift", mesh.map_vertices(|p| p + way))
        }
        5 => ("scale", mesh.map_vertices(|p| p * (1.0 + sign * 1e-4))),
        6 => {
            let mut faces = mesh.triangles().to_vec();
            let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
            let broad: Vec<usize> = (0..faces.len())
                .filter(|&i| is_broad(&corners[i]))
                .collect();
            faces.remove(broad[dice.pick(broad.len())]);
            (
                "hole",
                TriMesh::new(mesh.vertices().to_vec(), faces).unwrap(),
            )
        }
        _ => {
            let way = dice.direction() * 0.02;
            let pose = &mut evidence.parts[part].pose;
            (0..3).for_each(|row| pose.rows[row][3] += way[row]);
            ("pose", mesh)
        }
    };
    evidence.parts[part].mesh = changed;
    format!("{what} of part {part} by {amount_mm}")
}

#[test]
fn every_one_of_some_random_changes_of_a_part_is_named() {
    assert_changes_are_named(CHANGES / 4);
}

#[test]
#[ignore = "long: half a minute; run with -- --ignored"]
fn every_one_of_many_random_changes_of_a_part_is_named() {
    assert_changes_are_named(CHANGES);
}

fn assert_changes_are_named(count: usize) {
    let sound = kit_with_pin(PIN, SOCKET, Vector::zeros());
    let shells = Shells::of_mesh(&crate::repair::weld(&sound.hollowed));
    let strays = |evidence: &Evidence| {
        let found = measure_shapes(evidence, &shells, None, &Watch::silent()).unwrap();
        found.strays
    };
    assert_eq!(strays(&sound), []);
    let mut dice = Dice(1);
    for _ in 0..count {
        let mut changed = sound.clone();
        let what = change(&mut changed, &mut dice);
        // A hole beside a pin, under the mouth of its socket, is an open surface alone.
        let is_open = |part: &PartEvidence| {
            let facts = {
                let tree = crate::geom::Bvh::new(part.mesh.iter_corners());
                PartFacts::of_part(part, &tree, &Watch::silent()).unwrap()
            };
            facts.surface.defect.is_some()
        };
        let is_named = !strays(&changed).is_empty() || changed.parts.iter().any(is_open);
        assert!(is_named, "{what}");
    }
}
