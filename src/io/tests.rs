//! Hostile files: each gives a precise error or the right mesh, none a panic.

use std::fs;
use std::path::Path;

use super::read::{ContentError, decode_model};
use super::{ReadError, read_model, stl};
use crate::geom::Point;
use crate::mesh::primitives::{ball, cuboid};
use crate::mesh::{Solid, TriMesh};
use crate::repair::{repair, weld};

fn cube() -> TriMesh {
    cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0))
}

fn binary() -> Vec<u8> {
    stl::encode(&cube(), "cube")
}

/// A binary STL with the number at `offset` replaced.
fn patched(offset: usize, number: f32) -> Vec<u8> {
    let mut bytes = binary();
    bytes[offset..offset + 4].copy_from_slice(&number.to_le_bytes());
    bytes
}

/// One solid of an ASCII STL file.
fn ascii(name: &str, mesh: &TriMesh) -> String {
    let facet = |[a, b, c]: [Point; 3]| {
        let vertex = |p: Point| format!("vertex {:e} {:e} {:e}\n", p.x, p.y, p.z);
        let corners = vertex(a) + &vertex(b) + &vertex(c);
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    format!(
        "solid {name}\n{}endsolid {name}\n",
        mesh.iter_corners().map(facet).collect::<String>()
    )
}

/// The cube as OBJ with quads.
const OBJ: &str = "o cube\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn message(bytes: &[u8]) -> String {
    decode_model(bytes)
        .expect_err("a bad file is refused")
        .to_string()
}

fn volume(bytes: &[u8]) -> f64 {
    Solid::new(weld(&decode_model(bytes).unwrap()))
        .unwrap()
        .mesh()
        .signed_volume_mm3()
}

#[test]
fn every_bad_file_is_refused_in_words_that_name_the_place_and_the_remedy() {
    let obj = |line: &str| format!("{OBJ}{line}\n").into_bytes();
    let facet = "solid x\nfacet normal 0 0 1\nouter loop\n";
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (b"".to_vec(), "empty (0 bytes)"),
        (
            b"Dear friend,\nhere is my model.\n".to_vec(),
            "a text file, not STL, OBJ, PLY or 3MF",
        ),
        (b"PK\x03\x04abc".to_vec(), "3MF: the archive: "),
        (
            b"ply\nformat ascii 1.0\n".to_vec(),
            "PLY: line 2 of the header: expected end_header",
        ),
        (b"<html></html>".to_vec(), "a web page"),
        (vec![0; 50], "ends after 50 bytes, within the header of 84"),
        (
            binary()[..84].to_vec(),
            "promises 12 triangles, but there are bytes for 0;",
        ),
        (
            binary()[..84 + 50 * 5 + 7].to_vec(),
            "promises 12 triangles, but there are bytes for 5 and 7 bytes more",
        ),
        (
            [binary(), vec![0; 60]].concat(),
            "promises 12 triangles, but there are bytes for 13 and 10 bytes more",
        ),
        (
            [&[0; 80][..], &[0xff; 4]].concat(),
            "promises 4294967295 triangles",
        ),
        ([[0; 80].as_slice(), &[0; 4]].concat(), "no triangles"),
        (
            patched(84 + 12, f32::NAN),
            "facet 1: a coordinate is not a finite number",
        ),
        (
            patched(84 + 50 * 7 + 20, f32::INFINITY),
            "facet 8: a coordinate is not a finite number",
        ),
        (
            [b"solid and cut".as_slice(), &binary()[13..300]].concat(),
            "promises 12 triangles",
        ),
        (
            b"solid".to_vec(),
            "line 1, in or after facet 0, without endsolid",
        ),
        (b"solid x\nendsolid x\n".to_vec(), "no triangles"),
        (
            format!("{facet}vertex 0 0 nan").into_bytes(),
            "line 4, in or after facet 1, without vertex",
        ),
        (
            ascii("x", &cube()).replacen("e0", "z", 1).into_bytes(),
            "line 4, facet 1: expected a coordinate, found \"0z\"",
        ),
        (
            ascii("x", &cube()).replacen("3e0", "nan", 1).into_bytes(),
            "facet 1: a coordinate is not a finite",
        ),
        (
            ascii("x", &cube()).replacen("3e0", "1e999", 1).into_bytes(),
            "facet 1: a coordinate is not a finite",
        ),
        (
            ascii("x", &cube()).replacen("endloop", "", 1).into_bytes(),
            "expected endloop, found \"endfacet\"",
        ),
        (
            ascii("x", &cube())
                .replacen("vertex", "vertx", 1)
                .into_bytes(),
            "line 4, facet 1: expected vertex",
        ),
        (
            ascii("x", &cube())
                .replacen("endloop", "vertex 1 1 1\nendloop", 1)
                .into_bytes(),
            "expected endloop, found \"vertex\"",
        ),
        (
            ascii("x", &cube()).replace("endsolid x", "").into_bytes(),
            "without endsolid",
        ),
        (
            (ascii("x", &cube()) + "junk").into_bytes(),
            "expected solid, found \"junk\"",
        ),
        (
            b"v 0 0 0\nv 1 0 0\n".to_vec(),
            "no faces in it (2 vertices)",
        ),
        (b"# only words\nf".to_vec(), "a text file"),
        (obj("f 1 2"), "line 16: a face needs three or more corners"),
        (
            obj("f 1 2 9"),
            "line 16: the face names vertex 9, but the file has 8 vertices",
        ),
        (obj("f 1 2 0"), "line 16: the face names vertex 0"),
        (
            obj("f 1 2 -9"),
            "line 16: the face names vertex -9, but the file has 8 vertices",
        ),
        (obj("f 1 2 99999999999999999999"), "line 16: a face needs"),
        (obj("f 1/1/1/1 2 3"), "found \"1/1/1/1\""),
        (obj("f a b c"), "found \"a\""),
        (obj("f 1,2,3 4 5"), "found \"1,2,3\""),
        (
            obj("v 1 2"),
            "line 16: a vertex needs three numbers, found \"v 1 2\"",
        ),
        (obj("v 1,5 2 3"), "line 16: a vertex needs three numbers"),
        (
            obj("v 1 2 nan"),
            "line 16: a coordinate is not a finite number",
        ),
        (
            obj("v 1 2 inf"),
            "line 16: a coordinate is not a finite number",
        ),
        (
            obj("v 1 2 3 0"),
            "line 16: a coordinate is not a finite number",
        ),
        (
            obj("f 1 2 \\\n\\\n 12"),
            "line 16: the face names vertex 12",
        ),
    ];
    for (bytes, expected) in cases {
        let message = message(&bytes);
        assert!(
            message.contains(expected),
            "{message:?} does not say {expected:?}"
        );
        assert!(message.contains("export"), "{message:?} names no remedy");
    }
}

#[test]
fn files_that_cannot_be_opened_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = read_model(&folder.path().join("nothing.stl")).unwrap_err();
    assert!(
        matches!(missing, ReadError::Missing { .. }) && missing.to_string().contains("nothing.stl")
    );
    let directory = read_model(folder.path()).unwrap_err();
    assert!(
        matches!(directory, ReadError::Directory { .. }),
        "{directory}"
    );
    let text = folder.path().join("letter.stl");
    fs::write(&text, "Dear friend").unwrap();
    let foreign = read_model(&text).unwrap_err();
    assert!(
        matches!(
            &foreign,
            ReadError::Content {
                source: ContentError::Foreign { .. },
                ..
            }
        ),
        "{foreign}"
    );
    let error = stl::write(Path::new("/no/such/folder/x.stl"), &cube(), "x").unwrap_err();
    assert!(error.to_string().contains("/no/such/folder/x.stl"));
}

#[test]
fn the_name_of_a_file_does_not_matter() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in [
        ("a.obj", binary()),
        ("b.stl", OBJ.into()),
        ("c", ascii("c", &cube()).into_bytes()),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        assert_eq!(read_model(&path).unwrap().triangles().len(), 12);
    }
}

#[test]
fn ascii_stl_is_read_in_every_spelling() {
    let plain = ascii("a name with facet and vertex in it", &cube());
    let latin1: Vec<u8> = [
        b"solid Kr\xfcmel\n".as_slice(),
        plain.split_once('\n').unwrap().1.as_bytes(),
    ]
    .concat();
    let spellings: Vec<Vec<u8>> = vec![
        plain.clone().into_bytes(),
        plain.to_uppercase().into_bytes(),
        ascii("", &cube()).replace("solid ", "solid").into_bytes(),
        format!("\n \t {plain}").into_bytes(),
        format!("\u{feff}{plain}").into_bytes(),
        plain.replace('\n', "\r\n").into_bytes(),
        plain.replace('\n', "\r").into_bytes(),
        plain.replace("\nvertex", " vertex").into_bytes(),
        latin1,
    ];
    for bytes in spellings {
        assert_eq!(
            volume(&bytes),
            volume(&binary()),
            "{:?}",
            String::from_utf8_lossy(&bytes[..40])
        );
    }
}

#[test]
fn every_solid_of_an_ascii_file_is_read() {
    let other = ball(&Point::new(9.0, 0.0, 0.0), 1.0, 1);
    let both = ascii("one", &cube()) + &ascii("two", &other);
    assert_eq!(
        decode_model(both.as_bytes()).unwrap().triangles().len(),
        12 + 80
    );
}

#[test]
fn a_binary_file_whose_header_says_solid_is_binary() {
    let mut bytes = binary();
    bytes[..8].copy_from_slice(b"solid x\n");
    assert_eq!(volume(&bytes), 6.0);
}

#[test]
fn zeros_of_both_signs_weld() {
    let turn = |(i, line): (usize, &str)| {
        if i % 2 == 0 {
            line.replace(" 0e0", " -0e0")
        } else {
            line.to_owned()
        }
    };
    let text: Vec<String> = ascii("x", &cube()).lines().enumerate().map(turn).collect();
    assert!(text.iter().filter(|line| line.contains("-0e0")).count() > 5);
    assert_eq!(volume(text.join("\n").as_bytes()), 6.0);
}

#[test]
fn obj_faces_are_read_in_every_form() {
    let numbered = |form: fn(&str) -> String| {
        let line = |line: &str| match line.strip_prefix("f ") {
            Some(corners) => format!(
                "f {}\n",
                corners.split(' ').map(form).collect::<Vec<_>>().join(" ")
            ),
            None => format!("{line}\n"),
        };
        OBJ.lines().map(line).collect::<String>()
    };
    let forms = [
        numbered(|v| format!("{v}/7")),
        numbered(|v| format!("{v}//99")),
        numbered(|v| format!("{v}/1/2")),
        numbered(|v| format!("{v}/")),
        numbered(|v| (v.parse::<i32>().unwrap() - 9).to_string()),
        numbered(|v| format!("{v} \\\n  ")),
        OBJ.replace('\n', "\r\n"),
        OBJ.replace('\n', "\r"),
        OBJ.replace("\nf", " # a remark\nf"),
        OBJ.replace("\nv 0 0 0\n", "\n\tv  0\t0 0 1 0.5 0.5 0.5\n"),
        OBJ.replace("\nv 1 2 3\n", "\nv 2 4 6 2\n"),
        OBJ.replace(
            "o cube",
            "mtllib missing.mtl\nusemtl gold\ns off\ng a b\nvn 0 0 1\nvt 0 0",
        ),
        OBJ.replace("f 5 6 7 8", "g lid\nusemtl x\nf 5 6 7 8\no rest"),
        format!("{OBJ}f 1 2 3")
            .replace("\nf 1 2 3\n", "\n")
            .replace("\nf 1 2 3", "\n"),
    ];
    for text in forms {
        assert!((volume(text.as_bytes()) - 6.0).abs() < 1e-12, "{text}");
    }
}

#[test]
fn names_of_objects_may_be_in_any_encoding() {
    let bytes = [b"o Kr\xfcmel\n".as_slice(), OBJ.as_bytes()].concat();
    assert!((volume(&bytes) - 6.0).abs() < 1e-12);
}

#[test]
fn concave_polygons_of_an_obj_make_a_solid_of_the_right_volume() {
    // An L-shaped prism: area 3, height 2; the corner (1, 1) is the concave one.
    let outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    let rim = |z: i32| outline.map(|(x, y)| format!("v {x} {y} {z}\n")).concat();
    let walls = (1..=6)
        .map(|i| format!("f {i} {} {} {}\n", i % 6 + 1, i % 6 + 7, i + 6))
        .collect::<String>();
    let text = format!(
        "{}{}{walls}f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n",
        rim(0),
        rim(2)
    );
    assert!((volume(text.as_bytes()) - 6.0).abs() < 1e-12);
}

#[test]
fn written_files_come_back_bit_by_bit() {
    let mesh = ball(&Point::new(0.1, 0.2, 0.3), 7.0, 2);
    let bytes = stl::encode(
        &mesh,
        "solid ball with a name that is much longer than the room there is for it in a header",
    );
    assert_eq!(bytes.len(), 84 + 50 * 320);
    assert!(!bytes.starts_with(b"solid"));
    let back = weld(&stl::decode(&bytes).unwrap());
    assert_eq!(stl::encode(&back, "x")[84..], bytes[84..]);
    // Rounding to single precision moves a vertex by half a unit in the last place of a number
    // below 8.
    let moved = back
        .iter_corners()
        .flatten()
        .zip(mesh.iter_corners().flatten())
        .map(|(a, b)| (a - b).amax())
        .fold(0.0, f64::max);
    assert!(0.0 < moved && moved <= 2f64.powi(-22), "{moved}");
}

#[test]
fn normals_are_written_and_zero_where_there_is_none() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [3.0, 0.0, 0.0],
    ]
    .map(Point::from);
    let mesh = TriMesh::new(points.to_vec(), vec![[0, 1, 2], [0, 1, 3]]).unwrap();
    let bytes = stl::encode(&mesh, "");
    let number = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!([84, 88, 92].map(number), [0.0, 0.0, 1.0]);
    assert_eq!([134, 138, 142].map(number), [0.0, 0.0, 0.0]);
}

#[test]
fn a_triangle_whose_corners_fall_together_in_the_file_is_left_out() {
    let points = [[100.0, 0.0, 0.0], [100.0 + 1e-7, 0.0, 0.0], [0.0, 2.0, 0.0]].map(Point::from);
    let mesh = TriMesh::new(points.to_vec(), vec![[0, 1, 2]]).unwrap();
    assert_eq!(stl::encode(&mesh, "").len(), 84);
}

#[test]
fn a_file_cut_off_anywhere_is_refused_or_says_no_less_than_it_did() {
    let texts = [
        ascii("x", &cube()).into_bytes(),
        OBJ.as_bytes().to_vec(),
        binary(),
    ];
    for whole in texts {
        for end in 0..whole.len() {
            if let Ok(mesh) = decode_model(&whole[..end]) {
                // Only the name of the solid, or whole faces of an OBJ file (which says nowhere how
                // many there are), may be missing: then the surface is open and no solid.
                let is_whole = mesh.triangles().len() == 12;
                assert!(is_whole || Solid::new(weld(&mesh)).is_err(), "cut at {end}");
            }
        }
    }
}

/// The next of a fixed sequence of numbers (Marsaglia, "Xorshift RNGs", J. Stat. Softw. 8, 2003).
fn xorshift(state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state as usize
}

#[test]
fn files_with_random_bytes_changed_never_panic_and_never_give_what_is_not_finite() {
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let texts = [
        ascii("x", &cube()).into_bytes(),
        OBJ.as_bytes().to_vec(),
        binary(),
    ];
    for round in 0..3000 {
        let mut bytes = texts[round % 3].clone();
        for _ in 0..1 + round % 5 {
            let at = xorshift(&mut state) % bytes.len();
            match xorshift(&mut state) % 3 {
                0 => bytes[at] = xorshift(&mut state) as u8,
                1 => drop(bytes.remove(at)),
                _ => bytes.insert(at, b" /-\\0f\nv9"[xorshift(&mut state) % 9]),
            }
        }
        if let Ok(mesh) = decode_model(&bytes) {
            assert!(
                mesh.vertices()
                    .iter()
                    .all(|p| p.coords.iter().all(|x| x.is_finite()))
            );
            assert!(!mesh.triangles().is_empty());
            let _ = Solid::new(repair(mesh).0);
        }
    }
}
