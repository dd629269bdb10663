//! Tests of the judge of `motion.glb`: what is not as it is judged is found.

use super::*;
use crate::io::glb::{Animation, MovingScene, Painted, SceneNode, Track};
use crate::mesh::primitives::cuboid;

fn at(x: f64) -> Frame {
    Frame {
        origin: Point::new(x, 0.0, 0.0),
        ..Frame::identity()
    }
}

/// Two bodies without a symmetry, of which the second slides by 10 mm in two moves.
fn body() -> TriMesh {
    let points = [[0., 0., 0.], [4., 0., 0.], [0., 3., 0.], [0., 0., 2.]];
    let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    TriMesh::new(points.map(Point::from).to_vec(), faces).unwrap()
}

fn script(mesh: &TriMesh) -> Script<'_> {
    let bodies = ["a", "b"].map(|name| Wanted { name, mesh });
    Script {
        bodies: bodies.into(),
        joints: vec![vec!["J01"]],
        keys: [0.0, 4.0, 10.0].map(|x| vec![vec![[x, 0.0]]]).into(),
        up: Vector::z(),
        places: Box::new(|state| vec![at(0.0), at(state[0][0][0])]),
    }
}

fn scene<'a>(bodies: [&'a TriMesh; 2], names: &[&str], slides: [f64; 3]) -> MovingScene<'a> {
    let nodes = ["a", "b"].iter().zip(bodies).map(|(name, mesh)| SceneNode {
        name: (*name).to_owned(),
        parent: None,
        place: at(0.0),
        body: Some(Painted {
            mesh,
            color: [1, 2, 3],
        }),
    });
    // Only the last animation has the slides; all others are right.
    let animation = |(index, name): (usize, &&str)| Animation {
        name: (*name).to_owned(),
        tracks: vec![Track {
            node: 1,
            times_s: vec![0.0, 1.0, 2.0],
            places: if index + 1 == names.len() {
                slides.map(at).into()
            } else {
                [0.0, 4.0, 10.0].map(at).into()
            },
        }],
    };
    MovingScene {
        name: "scene".to_owned(),
        up: Vector::z(),
        nodes: nodes.collect(),
        animations: names.iter().enumerate().map(animation).collect(),
    }
}

const RIGHT: [f64; 3] = [0.0, 4.0, 10.0];

fn faults(scene: &MovingScene) -> String {
    let read = decode_glb(&scene.encode().unwrap());
    script(&body()).faults(read).join("; ")
}

#[test]
fn every_animation_is_played_and_none_is_missing_or_added() {
    let own = body();
    let of = |names: &[&str], slides| faults(&scene([&own, &own], names, slides));
    assert_eq!(of(&["open", "J01"], RIGHT), "");
    let moved = of(&["open", "J01"], [0.0, 4.5, 10.0]);
    assert!(
        moved.contains("b is 0.125 mm off at 0.25 s of `J01`"),
        "{moved}"
    );
    for names in [&["open"][..], &["J01"], &["open", "J01", "J02"]] {
        let said = of(names, RIGHT);
        assert!(said.contains("in place of J01, open"), "{said}");
    }
}

#[test]
fn a_part_that_is_mirrored_in_its_own_box_is_another() {
    let own = body();
    let mirrored = own.map_vertices(|p| Point::new(4.0 - p.x, p.y, p.z));
    let turned = mirrored.triangles().iter().map(|[a, b, c]| [*a, *c, *b]);
    let mirrored = TriMesh::new(mirrored.vertices().to_vec(), turned.collect()).unwrap();
    let found = faults(&scene([&own, &mirrored], &["open", "J01"], RIGHT));
    assert_eq!(found, "b is not in motion.glb as it is");
    // A box has its centre in the middle, whatever is mirrored: only products see a shear.
    let cube = cuboid(&Point::new(-1.0, -1.0, 0.0), &Point::new(1.0, 1.0, 1.0));
    let tilt = |by: f64| cube.map_vertices(move |p| Point::new(p.x + by * (p.z - 0.5), p.y, p.z));
    assert!(is_same(&tilt(0.2), &tilt(0.2)));
    assert!(!is_same(&tilt(0.2), &tilt(-0.2)));
}

#[test]
fn a_scene_that_lies_down_or_stands_elsewhere_is_found() {
    let own = body();
    let mut lying = scene([&own, &own], &["open", "J01"], RIGHT);
    lying.up = Vector::x();
    assert_eq!(faults(&lying), "motion.glb does not stand upright");
    let right = scene([&own, &own], &["open", "J01"], RIGHT);
    let mut read = decode_glb(&right.encode().unwrap()).unwrap();
    read.root.origin.x = 1.0;
    read.scale = f64::NAN;
    let said = script(&own).faults(Ok(read)).join("; ");
    assert!(
        said.contains("metres") && said.contains("where the model does"),
        "{said}"
    );
}

#[test]
fn what_is_no_number_is_not_near() {
    let own = body();
    let right = scene([&own, &own], &["open", "J01"], RIGHT);
    let mut read = decode_glb(&right.encode().unwrap()).unwrap();
    read.nodes[0].place.axes[(0, 0)] = f64::NAN;
    let said = script(&own).faults(Ok(read)).join("; ");
    assert!(said.contains("a is NaN mm off"), "{said}");
}
