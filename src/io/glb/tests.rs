//! Tests of glTF: what is written reads back, and what is broken is refused.

use super::*;
use crate::geom::{Frame, Point, Vector};
use crate::mesh::primitives::cuboid;
use nalgebra::Rotation3;

fn turned(angle: f64, to: [f64; 3]) -> Frame {
    Frame {
        origin: Point::from(to),
        axes: Rotation3::from_scaled_axis(Vector::new(0.0, 0.0, angle)).into_inner(),
    }
}

fn encoded() -> Vec<u8> {
    let mesh = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
    let body = |color| Some(Painted { mesh: &mesh, color });
    let scene = MovingScene {
        name: "two boxes".to_owned(),
        up: Vector::z(),
        nodes: vec![
            SceneNode {
                name: "a".to_owned(),
                parent: None,
                place: turned(0.5, [10.0, 0.0, 0.0]),
                body: body([255, 0, 0]),
            },
            SceneNode {
                name: "b".to_owned(),
                parent: Some(0),
                place: turned(0.0, [0.0, 5.0, 0.0]),
                body: body([255, 0, 0]),
            },
        ],
        animations: vec![Animation {
            name: "open".to_owned(),
            tracks: vec![Track {
                node: 1,
                times_s: vec![0.0, 1.0, 3.0],
                places: vec![
                    turned(0.0, [0.0, 5.0, 0.0]),
                    turned(1.0, [0.0, 9.0, 0.0]),
                    turned(3.0, [0.0, 9.0, 0.0]),
                ],
            }],
        }],
    };
    scene.encode().unwrap()
}

#[test]
fn a_scene_reads_back_with_its_bodies_and_its_motion() {
    let bytes = encoded();
    assert_eq!(bytes, encoded());
    let scene = decode_glb(&bytes).unwrap();
    assert!((scene.scale - 0.001).abs() < 1e-15);
    assert_eq!(scene.nodes[1].parent, Some(0));
    let volume = |node: &ReadNode| node.mesh.as_ref().unwrap().signed_volume_mm3();
    assert!(
        scene
            .nodes
            .iter()
            .all(|node| (volume(node) - 6.0).abs() < 1e-6)
    );
    // Half of the first move, all of the turn of the second but a quarter.
    for (time_s, angle, along) in [(0.5, 0.5, 7.0), (2.5, 2.5, 9.0), (9.0, 3.0, 9.0)] {
        let places = scene.places(&scene.animations[0], time_s);
        let wanted =
            turned(0.5, [10.0, 0.0, 0.0]).frame_to_model(&turned(angle, [0.0, along, 0.0]));
        assert!((places[1].origin - wanted.origin).norm() < 1e-5, "{time_s}");
        assert!((places[1].axes - wanted.axes).amax() < 1e-6, "{time_s}");
    }
}

#[test]
fn a_file_that_is_cut_or_changed_is_refused_and_never_a_panic() {
    let bytes = encoded();
    for length in 0..bytes.len() {
        assert!(decode_glb(&bytes[..length]).is_err(), "{length}");
    }
    for at in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 0x41;
        // Many a change is harmless: a name, a colour, a digit of a place.
        let _ = decode_glb(&changed);
    }
    let text = String::from_utf8_lossy(&bytes).into_owned();
    assert!(text.contains("\"version\":\"2.0\""));
}
