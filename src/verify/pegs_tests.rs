//! Pins and sockets in files: a sound joint, and the same joint with one fault at a time.

use super::judge_tests::{SEAT, failures, judge, peg, sound_kit};
use super::part_probe::PartProbe;
use super::pegs::count_overlaps;
use super::test_meshes::block;
use super::*;
use crate::base::watch::Watch;
use crate::geom::{Point, Vector};
use crate::mass::FlatFace;
use crate::mesh::{Csg, TriMesh, primitives::cylinder};

const GAP_MM: f64 = 0.1;
pub(super) const PIN: [f64; 2] = [0.6, 1.2];
pub(super) const SOCKET: [f64; 2] = [PIN[0] + 2.0 * GAP_MM, PIN[1] + 0.3];

/// Returns a cylinder of 48 sides about the seat, from `below` under the cut to `above` over it.
fn rod(diameter_mm: f64, [below, above]: [f64; 2]) -> TriMesh {
    let base = Vector::from(SEAT) - Vector::z() * below;
    cylinder(diameter_mm / 2.0, below + above, 48).map_vertices(|p| p + base)
}

/// Returns the body of a socket: its sides touch the circle of its diameter.
fn bore(diameter_mm: f64, reach: [f64; 2]) -> TriMesh {
    rod(diameter_mm / (std::f64::consts::PI / 48.0).cos(), reach)
}

/// Returns the sound kit with a pin and a socket made in these sizes (diameter and length), the
/// socket moved by `shift`. The sizes [`PIN`] and [`SOCKET`] are promised.
pub(super) fn kit_with_pin(pin: [f64; 2], socket: [f64; 2], shift: Vector) -> Evidence {
    let mut evidence = sound_kit();
    let body = |evidence: &Evidence, i: usize| {
        let part = &evidence.parts[i];
        Csg::of_mesh(&part.mesh.map_vertices(|p| part.pose.to_model(p))).unwrap()
    };
    let carrier = body(&evidence, 0)
        .union(&Csg::of_mesh(&rod(pin[0], [0.5, pin[1]])).unwrap())
        .unwrap();
    let hole = bore(socket[0], [0.5, socket[1]]).map_vertices(|p| p + shift);
    let receiver = body(&evidence, 1)
        .subtract(&Csg::of_mesh(&hole).unwrap())
        .unwrap();
    for (part, solid) in evidence.parts.iter_mut().zip([carrier, receiver]) {
        part.mesh = solid
            .to_mesh()
            .unwrap()
            .map_vertices(|p| part.pose.to_print(p));
    }
    let of_pin = rod(PIN[0], [0.0, PIN[1]]).signed_volume_mm3();
    let of_socket = bore(SOCKET[0], [0.0, SOCKET[1]]).signed_volume_mm3();
    evidence.promise.parts[0].pins = vec![peg(PIN[0], PIN[1], of_pin)];
    evidence.promise.parts[1].sockets = vec![peg(SOCKET[0], SOCKET[1], of_socket)];
    let joint = PromisedJoint {
        id: "J1".to_owned(),
        parts: ["P01".to_owned(), "P02".to_owned()],
        held_by: None,
        clearance_mm: GAP_MM - 0.001,
        glue: None,
    };
    evidence.promise.joints = vec![joint];
    evidence.promise.printer.minimum_wall_mm = 1.05;
    evidence.promise.printer.build_volume_mm = None;
    evidence
}

/// Returns the failures except those of any single pin at the side, which moves the centre of mass.
/// The surfaces have tests of their own and are left out.
fn pin_failures(evidence: &Evidence) -> Vec<String> {
    failures(evidence)
        .into_iter()
        .filter(|name| !["axis offset", "volumes", "part surfaces"].contains(&name.as_str()))
        .collect()
}

#[test]
fn a_pin_that_stands_in_its_socket_keeps_every_promise() {
    let evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    assert_eq!(
        pin_failures(&evidence),
        Vec::<String>::new(),
        "{:?}",
        judge(&evidence).pegs
    );
    assert!(!failures(&evidence).contains(&"volumes".to_owned()));
    let found = judge(&evidence).pegs.remove(0);
    // Sides of 48-gons lie at most 2.2e-3 of their radius inside the circle.
    assert!(
        found.deviation_mm < 1e-3 && (found.gap_mm.unwrap() - GAP_MM).abs() < 1e-3,
        "{found:?}"
    );
    // The side is 3 mm thick, the seat in its middle.
    assert!((found.wall_mm - (1.5 - SOCKET[0] / 2.0)).abs() < 1e-9);
}

#[test]
fn a_pin_left_out_of_the_file_is_missed() {
    let mut evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    evidence.parts[0].mesh = sound_kit().parts[0].mesh.clone();
    assert_eq!(pin_failures(&evidence), ["pins", "clearance"]);
}

#[test]
fn a_missing_socket_is_found_and_the_pin_reaches_into_the_material() {
    let mut evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    evidence.parts[1].mesh = sound_kit().parts[1].mesh.clone();
    assert_eq!(pin_failures(&evidence), ["pins", "clearance", "overlap"]);
}

#[test]
fn a_socket_that_no_part_has_on_the_list_is_missed() {
    let mut evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    evidence.promise.parts[1].sockets.clear();
    assert_eq!(
        pin_failures(&evidence),
        ["pins", "clearance", "socket wall"]
    );
}

#[test]
fn a_pin_too_stout_or_too_long_and_a_socket_too_shallow_are_found() {
    let stout = kit_with_pin([PIN[0] + 0.06, PIN[1]], SOCKET, Vector::zeros());
    assert_eq!(pin_failures(&stout), ["pins", "clearance"]);
    let long = kit_with_pin([PIN[0], PIN[1] + 0.05], SOCKET, Vector::zeros());
    assert_eq!(pin_failures(&long), ["pins"]);
    let shallow = kit_with_pin(PIN, [SOCKET[0], SOCKET[1] - 0.05], Vector::zeros());
    assert_eq!(pin_failures(&shallow), ["pins"]);
}

#[test]
fn a_socket_sunk_aside_leaves_too_small_a_gap() {
    // Half the tolerance of sizes, ten times that of gaps.
    let aside = kit_with_pin(PIN, SOCKET, Vector::new(0.0, 0.01, 0.0));
    assert_eq!(pin_failures(&aside), ["clearance"]);
}

/// Returns the sound kit with a dowel in two sockets, the second made in this size.
fn kit_with_dowel(made: [f64; 2]) -> Evidence {
    let mut evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    let below = &mut evidence.parts[0];
    let whole = sound_kit().parts.remove(0);
    let body = Csg::of_mesh(&whole.mesh.map_vertices(|p| whole.pose.to_model(p))).unwrap();
    let hole = bore(made[0], [made[1], 0.5]);
    let body = body.subtract(&Csg::of_mesh(&hole).unwrap()).unwrap();
    below.mesh = body
        .to_mesh()
        .unwrap()
        .map_vertices(|p| below.pose.to_print(p));
    let volume_mm3 = bore(SOCKET[0], [SOCKET[1], 0.0]).signed_volume_mm3();
    let second = Peg {
        axis: [0.0, 0.0, -1.0],
        ..peg(SOCKET[0], SOCKET[1], volume_mm3)
    };
    evidence.promise.parts[0].pins.clear();
    evidence.promise.parts[0].sockets = vec![second];
    let [x, y, z] = SEAT;
    evidence.promise.dowels = vec![Hardware {
        id: "N1".to_owned(),
        kind: HardwareKind::Dowel("beech-4".to_owned()),
        from_mm: [x, y, z - PIN[1]],
        to_mm: [x, y, z + PIN[1]],
        diameter_mm: PIN[0],
        hole_mm: 0.0,
        round_end: false,
        density_g_cm3: 1.0,
        mass_g: 0.0,
        depth_mm: PIN[1],
        socket_mm: SOCKET[0],
    }];
    evidence
}

#[test]
fn a_dowel_lies_in_two_sockets_and_weighs() {
    let evidence = kit_with_dowel(SOCKET);
    assert_eq!(
        pin_failures(&evidence),
        Vec::<String>::new(),
        "{:?}",
        judge(&evidence).pegs
    );
    assert!(!failures(&evidence).contains(&"volumes".to_owned()));
    let bare = Evidence {
        promise: Promise {
            dowels: Vec::new(),
            ..evidence.promise.clone()
        },
        ..evidence.clone()
    };
    let mass_g = judge(&evidence).assembly.mass_g - judge(&bare).assembly.mass_g;
    // π/4 · 0.6² · 2.4 mm³ of 1 g/cm³.
    assert!(
        (mass_g - std::f64::consts::FRAC_PI_4 * 0.36 * 2.4e-3).abs() < 1e-12,
        "{mass_g}"
    );
}

#[test]
fn a_second_socket_too_narrow_too_shallow_or_missing_is_found() {
    assert_eq!(
        pin_failures(&kit_with_dowel([SOCKET[0] - 0.06, SOCKET[1]])),
        ["pins", "clearance"]
    );
    assert_eq!(
        pin_failures(&kit_with_dowel([SOCKET[0], SOCKET[1] - 0.05])),
        ["pins"]
    );
    let mut evidence = kit_with_dowel(SOCKET);
    evidence.promise.parts[0].sockets.clear();
    assert_eq!(
        pin_failures(&evidence),
        ["pins", "clearance", "socket wall"]
    );
}

/// Returns the sound kit with a film of glue of this area in its joint.
fn kit_with_glue(area_mm2: f64) -> Evidence {
    let mut evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    let face = FlatFace {
        area_mm2,
        center_mm: [0.0, 0.0, SEAT[2]],
        squares_mm4: [[1e4, 0.0, 0.0], [0.0, 1e4, 0.0], [0.0; 3]],
    };
    let film = GlueFilm {
        thickness_mm: 0.1,
        density_g_cm3: 1.0,
        mass_g: 1e-4 * area_mm2,
        face,
    };
    evidence.promise.joints[0].glue = Some(film);
    evidence
}

/// Returns the area of the box's rim where its halves meet, mm².
fn rim_mm2(evidence: &Evidence) -> f64 {
    let flat = |[a, b, c]: [Point; 3]| {
        let is_flat = [a, b, c].iter().all(|p| (p.z - SEAT[2]).abs() < 1e-4);
        if is_flat {
            (b - a).cross(&(c - a)).norm() / 2.0
        } else {
            0.0
        }
    };
    let part = &evidence.parts[1];
    part.mesh
        .map_vertices(|p| part.pose.to_model(p))
        .iter_corners()
        .map(flat)
        .sum()
}

#[test]
fn a_film_as_large_as_its_faces_weighs_and_one_too_large_or_small_is_found() {
    let area_mm2 = rim_mm2(&kit_with_glue(1.0));
    let evidence = kit_with_glue(area_mm2);
    assert_eq!(pin_failures(&evidence), Vec::<String>::new());
    let bare = kit_with_pin(PIN, SOCKET, Vector::zeros());
    let mass_g = judge(&evidence).assembly.mass_g - judge(&bare).assembly.mass_g;
    assert!((mass_g - 1e-4 * area_mm2).abs() < 1e-12);
    for factor in [0.8, 1.3] {
        assert_eq!(pin_failures(&kit_with_glue(factor * area_mm2)), ["glue"]);
    }
}

#[test]
fn a_wall_around_the_socket_thinner_than_ordered_is_found() {
    let mut evidence = kit_with_pin(PIN, SOCKET, Vector::zeros());
    evidence.promise.printer.minimum_wall_mm = 1.5 - SOCKET[0] / 2.0 + 0.011;
    assert_eq!(pin_failures(&evidence), ["socket wall"]);
}

/// Returns a slab of 10 mm by 10 mm between two heights as a part in its place.
fn slab(id: &str, [low, high]: [f64; 2]) -> PartEvidence {
    PartEvidence {
        id: id.to_owned(),
        mesh: block(Point::new(0.0, 0.0, low), [10.0, 10.0, high - low]),
        inner: Vec::new(),
        pose: Pose::identity(),
    }
}

#[test]
fn a_sample_within_the_rounding_of_a_mates_cut_face_is_no_overlap() {
    let count = |overlap_mm: f64| {
        // So thin that samples under its sides lie in the mate's first micrometres.
        let parts = [
            slab("P01", [0.0, 2.0 * overlap_mm]),
            slab("P02", [-5.0, overlap_mm]),
        ];
        let probes: Vec<PartProbe> = parts.iter().map(PartProbe::new).collect();
        count_overlaps(&probes, &Watch::silent()).unwrap()
    };
    assert_eq!(count(5e-6), 0);
    assert!(count(2e-3) > 0);
}
