//! Hostile files: each gives a precise error or the right mesh, none a panic.

use super::*;
use crate::base::watch::Watch;

/// A binary STL with the number at `offset` replaced.
fn binary_with(offset: usize, number: f32) -> Vec<u8> {
    let mut bytes = binary();
    bytes[offset..offset + 4].copy_from_slice(&number.to_le_bytes());
    bytes
}

fn message(bytes: &[u8]) -> String {
    decode_model(bytes)
        .expect_err("a bad file is refused")
        .to_string()
}

/// Files of other formats, with words of the error for each.
fn foreign_files() -> Vec<(Vec<u8>, &'static str)> {
    vec![
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
    ]
}

/// Bad binary STL files, with words of the error for each.
fn bad_binary_stl_files() -> Vec<(Vec<u8>, &'static str)> {
    vec![
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
            binary_with(84 + 12, f32::NAN),
            "facet 1: a coordinate is not a finite number",
        ),
        (
            binary_with(84 + 50 * 7 + 20, f32::INFINITY),
            "facet 8: a coordinate is not a finite number",
        ),
        (
            [b"solid and cut".as_slice(), &binary()[13..300]].concat(),
            "promises 12 triangles",
        ),
    ]
}

/// Bad ASCII STL files, with words of the error for each.
fn bad_ascii_stl_files() -> Vec<(Vec<u8>, &'static str)> {
    let facet = "solid x\nfacet normal 0 0 1\nouter loop\n";
    vec![
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
    ]
}

/// Bad OBJ files, with words of the error for each.
fn bad_obj_files() -> Vec<(Vec<u8>, &'static str)> {
    let obj = |line: &str| format!("{OBJ}{line}\n").into_bytes();
    vec![
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
    ]
}

#[test]
fn every_bad_file_is_refused_in_words_that_name_the_place_and_the_remedy() {
    let cases = [
        foreign_files(),
        bad_binary_stl_files(),
        bad_ascii_stl_files(),
        bad_obj_files(),
    ];
    for (bytes, expected) in cases.concat() {
        let message = message(&bytes);
        assert!(
            message.contains(expected),
            "{message:?} does not say {expected:?}"
        );
        assert!(message.contains("export"), "{message:?} names no remedy");
    }
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
                // Only the name of the solid may be missing, or whole faces of an OBJ file, which
                // does not say how many there are. Then the surface is open and no solid.
                let is_whole = mesh.triangles().len() == 12;
                assert!(is_whole || Solid::new(weld(&mesh)).is_err(), "cut at {end}");
            }
        }
    }
}

/// Returns the next number of a fixed sequence (Marsaglia, "Xorshift RNGs", J. Stat. Softw. 8,
/// 2003).
fn xorshift(state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state as usize
}

#[test]
fn changed_files_never_panic_or_give_infinite_places() {
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
            let _ = Solid::new(repair(mesh, &Watch::silent()).unwrap().0);
        }
    }
}
