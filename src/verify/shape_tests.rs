//! The surfaces of parts: as they should be, and with one fault at a time.

use super::judge_tests::{SEAT, failures, judge, sound_kit};
use super::pegs_tests::{PIN, SOCKET, kit_with_pin};
use super::test_meshes::ball;
use super::*;
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
