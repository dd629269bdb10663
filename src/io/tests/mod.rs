//! Reading and writing of every format except 3MF and PLY, which have tests of their own.

mod hostile;

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

fn volume(bytes: &[u8]) -> f64 {
    Solid::new(weld(&decode_model(bytes).unwrap()))
        .unwrap()
        .mesh()
        .signed_volume_mm3()
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
