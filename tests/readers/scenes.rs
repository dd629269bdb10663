//! Small scenes of moving bodies, to be damaged.

use equipoise::geom::{Frame, Point, Vector};
use equipoise::io::glb::{Animation, MovingScene, Painted, SceneNode, Track};
use equipoise::mesh::primitives::cuboid;

/// Returns a binary glTF of two bodies, of which one moves.
pub fn glb() -> Vec<u8> {
    let mesh = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
    let node = |name: &str, parent| SceneNode {
        name: name.to_owned(),
        parent,
        place: Frame::identity(),
        body: Some(Painted {
            mesh: &mesh,
            color: [1, 2, 3],
        }),
    };
    let moved = Frame {
        origin: Point::new(4.0, 0.0, 0.0),
        ..Frame::identity()
    };
    let track = Track {
        node: 1,
        times_s: vec![0.0, 1.0],
        places: vec![Frame::identity(), moved],
    };
    let scene = MovingScene {
        name: "a".to_owned(),
        up: Vector::z(),
        nodes: vec![node("a", None), node("b", Some(0))],
        animations: vec![Animation {
            name: "open".to_owned(),
            tracks: vec![track],
        }],
    };
    scene.encode().unwrap()
}
