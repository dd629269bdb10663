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

/// Returns the file with its JSON changed and its bytes as they are.
fn with_json(change: impl Fn(&mut serde_json::Value)) -> Vec<u8> {
    let bytes = encoded();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let mut json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    change(&mut json);
    let mut json = serde_json::to_vec(&json).unwrap();
    json.resize(json.len().next_multiple_of(4), b' ');
    framed(&json, &bytes[28 + length..])
}

fn framed(json: &[u8], bin: &[u8]) -> Vec<u8> {
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((28 + json.len() as u32 + bin.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", bin)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// Returns why a file with a value at a place of its JSON is refused.
fn refused(pointer: &str, value: serde_json::Value) -> String {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let changed = with_json(|json| json.pointer_mut(parent).unwrap()[key] = value.clone());
    match decode_glb(&changed) {
        Ok(_) => panic!("{pointer} {value} was read"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn turns_that_are_none_are_refused() {
    assert!(decode_glb(&with_json(|_| {})).is_ok());
    for turn in [[0.0; 4], [0.0, 0.0, 0.0, 1.01], [1e200; 4]] {
        for node in 0..3 {
            let said = refused(
                &format!("/nodes/{node}/rotation"),
                turn.into_iter().collect(),
            );
            assert_eq!(said, "the length of a turn is broken", "{turn:?}");
        }
    }
    // The same in the bytes: those of the turns are the last.
    let bytes = encoded();
    for wrong in [0.0, f32::NAN, f32::INFINITY] {
        let mut changed = bytes.clone();
        let end = changed.len();
        changed[end - 16..].copy_from_slice(&[wrong; 4].map(f32::to_le_bytes).concat());
        assert!(decode_glb(&changed).is_err(), "{wrong}");
    }
}

#[test]
fn what_viewers_obey_and_this_reader_does_not_is_refused() {
    let sparse = serde_json::json!({"count": 1});
    for (pointer, value) in [
        ("/accessors/0/byteOffset", 4.into()),
        ("/accessors/0/normalized", true.into()),
        ("/accessors/0/sparse", sparse),
        ("/bufferViews/0/byteStride", 16.into()),
        ("/buffers/0/uri", "other.bin".into()),
        ("/meshes/0/primitives/0/mode", 1.into()),
        ("/nodes/1/skin", 0.into()),
        ("/extensionsRequired", serde_json::json!(["KHR_any"])),
    ] {
        let said = refused(pointer, value);
        assert!(said.contains("unknown field"), "{pointer}: {said}");
    }
    for (pointer, value) in [
        ("/bufferViews/0/buffer", 1.into()),
        ("/bufferViews/1/byteOffset", 1.into()),
        ("/buffers/0/byteLength", 8.into()),
        ("/buffers", serde_json::json!([])),
        ("/nodes/0/matrix", serde_json::json!([1.0])),
        ("/nodes/0/mesh", 0.into()),
        ("/nodes/1/scale", serde_json::json!([1.0, 1.0, -1.0])),
        ("/scene", 1.into()),
    ] {
        let said = refused(pointer, value);
        assert!(said.ends_with("is broken"), "{pointer}: {said}");
    }
    let moved = with_json(|json| json["nodes"][0]["translation"] = vec![0.0, 2.0, 0.0].into());
    assert_eq!(decode_glb(&moved).unwrap().root.origin.y, 2.0);
}

#[test]
fn a_tree_that_is_none_and_bytes_that_are_used_again_are_refused() {
    for (pointer, value) in [
        // Two parents, one parent twice, a ring, a number too great, the root as a child.
        ("/nodes/0/children", serde_json::json!([1, 2])),
        ("/nodes/0/children", serde_json::json!([1, 1])),
        ("/nodes/2/children", serde_json::json!([1])),
        ("/nodes/2/children", serde_json::json!([9])),
        ("/nodes/2/children", serde_json::json!([0])),
    ] {
        let said = refused(pointer, value);
        assert_eq!(said, "the tree of nodes is broken", "{pointer}");
    }
    assert!(refused("/nodes/2/mesh", 0.into()).contains("a mesh's number"));
    let again = refused("/animations/0/channels/1/sampler", 0.into());
    assert!(again.contains("a sampler's number"), "{again}");
    // The same accessors, in ever new animations.
    let many = with_json(|json| {
        let animations = json["animations"].as_array_mut().unwrap();
        *animations = vec![animations[0].clone(); 1000];
    });
    let said = decode_glb(&many).unwrap_err().to_string();
    assert!(said.contains("used again and again"), "{said}");
}

#[test]
fn a_wide_tree_is_read_in_time_that_grows_with_it_alone() {
    let children: Vec<String> = (1..=100_000).map(|node| node.to_string()).collect();
    let nodes = vec!["{}"; children.len()].join(",");
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[{}]}},{nodes}],"buffers":[{{"byteLength":0}}]}}"#,
        children.join(",")
    )
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let start = std::time::Instant::now();
    assert_eq!(
        decode_glb(&framed(&json, &[])).unwrap().nodes.len(),
        100_000
    );
    // To look for each parent in all children took minutes.
    assert!(start.elapsed().as_secs() < 20);
}
