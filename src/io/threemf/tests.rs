//! Packages written and read again, foreign ones, and hostile ones.

use std::io::{Cursor, Write};

use zip::{ZipWriter, write::SimpleFileOptions};

use super::*;
use crate::geom::{Matrix, Point, Vector};
use crate::io::{decode_model, stl};
use crate::mesh::Solid;
use crate::mesh::primitives::{ball, cuboid};
use crate::repair::weld;

/// A block of one by two by three.
const BLOCK: &str = "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"2\" z=\"0\"/>\
    <vertex x=\"0\" y=\"2\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"3\"/><vertex x=\"1\" y=\"0\" z=\"3\"/><vertex x=\"1\" y=\"2\" z=\"3\"/>\
    <vertex x=\"0\" y=\"2\" z=\"3\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/>\
    <triangle v1=\"4\" v2=\"5\" v3=\"6\"/><triangle v1=\"4\" v2=\"6\" v3=\"7\"/><triangle v1=\"0\" v2=\"1\" v3=\"5\"/>\
    <triangle v1=\"0\" v2=\"5\" v3=\"4\"/><triangle v1=\"1\" v2=\"2\" v3=\"6\"/><triangle v1=\"1\" v2=\"6\" v3=\"5\"/>\
    <triangle v1=\"2\" v2=\"3\" v3=\"7\"/><triangle v1=\"2\" v2=\"7\" v3=\"6\"/><triangle v1=\"3\" v2=\"0\" v3=\"4\"/>\
    <triangle v1=\"3\" v2=\"4\" v3=\"7\"/></triangles></mesh>";

/// An archive of these files.
fn zipped(files: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in files {
        archive
            .start_file(*name, SimpleFileOptions::default())
            .unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// A model with these attributes, resources and items.
fn model_xml(attributes: &str, resources: &str, build: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<model {attributes} xmlns=\"{CORE_NAMESPACE}\">\n<resources>{resources}</resources>\n\
         <build>{build}</build>\n</model>"
    )
}

fn package(attributes: &str, resources: &str, build: &str) -> Vec<u8> {
    zipped(&[(MODEL_PART, &model_xml(attributes, resources, build))])
}

fn object(id: u32, content: &str) -> String {
    format!("<object id=\"{id}\" name=\"N{id}\">{content}</object>")
}

fn block(id: u32) -> String {
    object(id, BLOCK)
}

fn components(list: &str) -> String {
    format!("<components>{list}</components>")
}

fn solid(bytes: &[u8]) -> Solid {
    Solid::new(weld(&decode_model(bytes).unwrap())).unwrap()
}

fn message(bytes: &[u8]) -> String {
    decode_model(bytes)
        .expect_err("a bad file is refused")
        .to_string()
}

fn placed_ball(name: &str) -> (TriMesh, Object) {
    let mesh = ball(&Point::new(0.1, 0.2, 0.3), 7.0, 3);
    let object = Object::new(name, [230, 159, 0], &mesh);
    (mesh, object)
}

fn encoded(objects: &[Object], build: Build) -> Vec<u8> {
    let package = Package {
        title: "a <title>".into(),
        description: "&c.".into(),
        job: "j".into(),
        objects,
        build,
    };
    package.encode().unwrap()
}

#[test]
fn a_written_package_holds_the_triangles_of_the_stl_file_of_the_same_mesh_bit_for_bit() {
    let (mesh, object) = placed_ball("P01 \"<&>\"");
    let bytes = encoded(&[object], Build::Apart(vec![(0, Transform::default())]));
    let objects = decode_objects(&bytes).unwrap();
    assert_eq!(objects[0].name, "P01 \"<&>\"");
    let back: Vec<_> = objects[0].mesh.iter_corners().collect();
    let stl: Vec<_> = stl::decode(&stl::encode(&mesh, ""))
        .unwrap()
        .iter_corners()
        .collect();
    assert!(back == stl);
}

#[test]
fn the_same_package_has_the_same_bytes_and_tells_nothing_of_when_it_was_made() {
    let (_, object) = placed_ball("P01");
    let [first, second] = [(); 2].map(|()| {
        encoded(
            std::slice::from_ref(&object),
            Build::Apart(vec![(0, Transform::default())]),
        )
    });
    assert_eq!(first, second);
    // Bytes 10 to 14 of an entry are its time and day: the first that the format knows, 1980-01-01.
    assert_eq!(first[10..14], [0, 0, 0x21, 0]);
}

#[test]
fn objects_lie_where_the_build_puts_them_apart_or_together() {
    let (mesh, object) = placed_ball("P01");
    let turn = Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let map = Transform {
        linear: turn,
        shift: Vector::new(10.0, -20.0, 30.5),
    };
    let places = vec![(0, map), (0, Transform::shift(Vector::new(0.0, 0.0, 99.0)))];
    for build in [
        Build::Apart(places.clone()),
        Build::Together("whole".into(), places.clone()),
    ] {
        let objects = decode_objects(&encoded(std::slice::from_ref(&object), build)).unwrap();
        assert_eq!(objects.len(), 2);
        for (found, (_, map)) in objects.iter().zip(&places) {
            let center = found.mesh.aabb().center();
            // The ball's coordinates are rounded to single precision, half a unit in the last place
            // of 8.
            assert!(
                (center - map.apply(&mesh.aabb().center())).norm() < 1e-6,
                "{center}"
            );
        }
    }
}

#[test]
fn objects_that_are_placed_nowhere_are_left_out() {
    let objects = ["P01", "P02"].map(|name| placed_ball(name).1);
    let one = encoded(&objects, Build::Apart(vec![(1, Transform::default())]));
    let both = encoded(
        &objects,
        Build::Apart(vec![(0, Transform::default()), (1, Transform::default())]),
    );
    assert!(
        5 * one.len() < 3 * both.len(),
        "{} of {} bytes",
        one.len(),
        both.len()
    );
    assert_eq!(decode_objects(&one).unwrap()[0].name, "P02");
}

#[test]
fn every_unit_is_turned_into_millimetres() {
    let build = "<item objectid=\"1\"/>";
    let volume = |unit: &str| {
        let attributes = if unit.is_empty() {
            String::new()
        } else {
            format!("unit=\"{unit}\"")
        };
        solid(&package(&attributes, &block(1), build))
            .mesh()
            .signed_volume_mm3()
    };
    let sides = [
        ("", 1.0),
        ("millimeter", 1.0),
        ("micron", 1e-3),
        ("centimeter", 10.0),
        ("inch", 25.4),
        ("foot", 304.8),
        ("meter", 1e3),
    ];
    for (unit, mm) in sides {
        assert!(
            (volume(unit) / (6.0 * mm * mm * mm) - 1.0).abs() < 1e-12,
            "{unit}"
        );
    }
}

#[test]
fn components_and_items_are_placed_through_all_their_transforms() {
    // A block, shifted by 5 in an assembly that is stretched twofold and shifted by 100, in
    // centimetres.
    let inner = components("<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>");
    let resources = block(1) + &object(2, &inner);
    let build =
        "<item objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 100 0 0\"/><item objectid=\"1\"/>";
    let objects = decode_objects(&package("unit=\"centimeter\"", &resources, build)).unwrap();
    let [far, near] = [0, 1].map(|i: usize| objects[i].mesh.aabb());
    assert!(
        (far.min - Point::new(1100.0, 0.0, 0.0)).norm() < 1e-9
            && (far.max - Point::new(1120.0, 40.0, 60.0)).norm() < 1e-9
    );
    assert!((near.max - Point::new(10.0, 20.0, 30.0)).norm() < 1e-12);
    assert_eq!(objects[0].name, "N1");
}

#[test]
fn a_mirrored_place_is_turned_outward_again() {
    let build = "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>";
    assert!(
        (solid(&package("", &block(1), build))
            .mesh()
            .signed_volume_mm3()
            - 6.0)
            .abs()
            < 1e-12
    );
}

#[test]
fn objects_in_other_models_of_the_package_are_found_in_their_own_unit() {
    let production = "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" requiredextensions=\"p\"";
    let inner = components(
        "<component p:path=\"/3D/parts/a.model\" objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 4 0 0\"/>",
    );
    let root = model_xml(production, &object(1, &inner), "<item objectid=\"1\"/>");
    let other = model_xml("unit=\"centimeter\"", &block(7), "");
    let found = decode_objects(&zipped(&[
        (MODEL_PART, &root),
        ("3D/parts/a.model", &other),
    ]))
    .unwrap();
    assert_eq!(found[0].mesh.aabb().max, Point::new(14.0, 20.0, 30.0));
    assert!(message(&zipped(&[(MODEL_PART, &root)])).contains("looked for 3D/parts/a.model"));
}

#[test]
fn the_model_is_where_the_relationships_lead() {
    let text = model_xml("", &block(1), "<item objectid=\"1\"/>");
    let rels = format!(
        "<Relationships><Relationship Target=\"/a/b.model\" Type=\"{MODEL_TYPE}\"/></Relationships>"
    );
    assert_eq!(
        solid(&zipped(&[("a/b.model", &text), ("_rels/.rels", &rels)]))
            .mesh()
            .triangles()
            .len(),
        12
    );
}

#[test]
fn supports_and_what_a_reader_may_ignore_are_left_out() {
    let support = object(2, BLOCK).replace("<object", "<object type=\"support\"");
    let mesh = BLOCK.replace(
        "</mesh>",
        "<t:trianglesets><t:triangleset name=\"x\"/></t:trianglesets></mesh>",
    );
    let colors = "<m:colorgroup id=\"9\"><m:color color=\"#FF0000\"/></m:colorgroup><!-- remark --><![CDATA[ x ]]>";
    let resources = format!("{colors}{support}{}", object(1, &mesh));
    let build = "<item objectid=\"2\"/><item objectid=\"1\" partnumber=\"7\"/>";
    assert_eq!(
        decode_objects(&package("", &resources, build))
            .unwrap()
            .len(),
        1
    );
    assert!(message(&package("", &support, "<item objectid=\"2\"/>")).contains("no triangles"));
}

/// Objects 1 to `levels`, each twice the one before it.
fn doubled(levels: u32, content: &str) -> String {
    let twice = |id: u32| {
        let inner = format!(
            "<component objectid=\"{0}\"/><component objectid=\"{0}\"/>",
            id - 1
        );
        object(id, &components(&inner))
    };
    object(1, content) + &(2..=levels).map(twice).collect::<String>()
}

#[test]
fn every_bad_package_is_refused_in_words_that_name_the_place_and_the_remedy() {
    let item = "<item objectid=\"1\"/>";
    let one = |change: &dyn Fn(String) -> String| package("", &change(block(1)), item);
    let with =
        |from: &'static str, to: &'static str| one(&move |text: String| text.replacen(from, to, 1));
    let text = model_xml("", &block(1), item);
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (
            zipped(&[("word/document.xml", "<x/>")]),
            "no model in it (looked for 3D/3dmodel.model)",
        ),
        (zipped(&[(MODEL_PART, "")]), "there is no <model> in it"),
        (
            zipped(&[(MODEL_PART, "<html></html>")]),
            "there is no <model> in it",
        ),
        (
            zipped(&[(MODEL_PART, &text[..text.len() - 20])]),
            "3D/3dmodel.model, line",
        ),
        (
            zipped(&[(
                MODEL_PART,
                &text.replace("<resources>", "<resources><a></b>"),
            )]),
            "line 3: ",
        ),
        (
            zipped(&[(
                MODEL_PART,
                &text.replacen("<model", "<!DOCTYPE x [<!ENTITY a \"aaaa\">]><model", 1),
            )]),
            "line 2: it declares a document type",
        ),
        (
            package("unit=\"furlong\"", &block(1), item),
            "<model> needs unit to be micron, millimeter",
        ),
        (
            with("x=\"1\"", "x=\"nan\""),
            "<vertex> needs x to be a finite number, found \"NaN\"",
        ),
        (
            with("x=\"1\"", "x=\"1e999\""),
            "<vertex> needs x to be a finite number",
        ),
        (with("x=\"1\"", "x=\"&a;\""), "line 3: "),
        (
            with("y=\"2\"", "w=\"2\""),
            "<vertex> needs y to be a finite number, found \"\"",
        ),
        (
            with("v1=\"3\"", "v1=\"8\""),
            "object 1: triangle 10 names vertex 8, but there are 8 vertices",
        ),
        (
            with("v1=\"3\"", "v1=\"-1\""),
            "<triangle> needs v1 to be the number of a vertex, found \"-1\"",
        ),
        (
            with("v1=\"3\"", "v1=\"4294967296\""),
            "<triangle> needs v1 to be the number of a vertex",
        ),
        (package("", &(block(1) + &block(1)), item), "two objects 1"),
        (
            package("", &block(1), "<item objectid=\"2\"/>"),
            "no object 2",
        ),
        (package("", &block(1), ""), "no triangles"),
        (package("", &object(1, ""), item), "no triangles"),
        (
            package("", &block(1), "<item objectid=\"1\" transform=\"1 0 0\"/>"),
            "twelve finite numbers",
        ),
        (
            package(
                "",
                &block(1),
                "<item objectid=\"1\" transform=\"0 0 0 0 0 0 0 0 0 0 0 0\"/>",
            ),
            "twelve finite",
        ),
        (
            package(
                "",
                &object(1, &components(item).replace("item", "component")),
                item,
            ),
            "a component of itself",
        ),
        (
            package(
                "",
                &(object(1, &components("<component objectid=\"2\"/>"))
                    + &object(2, &components("<component objectid=\"1\"/>"))),
                item,
            ),
            "a component of itself",
        ),
        (
            package("", &doubled(40, BLOCK), "<item objectid=\"40\"/>"),
            "more than 100000 places",
        ),
        (
            package("", &doubled(40, ""), "<item objectid=\"40\"/>"),
            "more than 100000 places",
        ),
        (
            package("", &doubled(80, ""), "<item objectid=\"80\"/>"),
            "nested more than 64 deep",
        ),
        (
            package(
                "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" requiredextensions=\"b\"",
                &block(1),
                item,
            ),
            "needs the extension http://schemas.microsoft.com/3dmanufacturing/beamlattice",
        ),
        (
            package("requiredextensions=\"zz\"", &block(1), item),
            "needs the extension zz",
        ),
        (
            package(
                "unit=\"meter\"",
                &block(1),
                "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1e308 0 0\"/>",
            ),
            "object 1: a coordinate is not a finite number where it is placed",
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
fn a_bomb_of_blanks_is_refused_before_it_is_unpacked() {
    // Packed to a thousandth, it is beyond what is free and beyond two hundred times its size.
    let text = model_xml("", &block(1), "<item objectid=\"1\"/>")
        .replace("<build>", &format!("{}<build>", " ".repeat(40 << 20)));
    let bytes = zipped(&[(MODEL_PART, &text)]);
    assert!(bytes.len() < 100_000, "{}", bytes.len());
    assert!(message(&bytes).contains("more than 200 times their size"));
}

#[test]
fn a_package_cut_off_anywhere_is_refused() {
    let whole = package("", &block(1), "<item objectid=\"1\"/>");
    for end in 4..whole.len() {
        assert!(decode_model(&whole[..end]).is_err(), "cut at {end}");
    }
}

#[test]
fn a_model_cut_off_anywhere_is_refused() {
    let whole = model_xml("", &block(1), "<item objectid=\"1\"/>");
    for end in (0..whole.len()).filter(|&end| whole.is_char_boundary(end)) {
        let read = decode_model(&zipped(&[(MODEL_PART, &whole[..end])]));
        assert!(read.is_err(), "cut at {end}");
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
fn packages_and_models_with_random_bytes_changed_never_panic_and_never_give_what_is_not_finite() {
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let inner = components(
        "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/><component objectid=\"1\"/>",
    );
    let text = model_xml(
        "unit=\"inch\"",
        &(block(1) + &object(2, &inner)),
        "<item objectid=\"2\"/>",
    );
    let archive = zipped(&[(MODEL_PART, &text)]);
    for round in 0..4000 {
        let mut bytes = if round % 2 == 0 {
            archive.clone()
        } else {
            text.clone().into_bytes()
        };
        for _ in 0..1 + round % 5 {
            let at = xorshift(&mut state) % bytes.len();
            match xorshift(&mut state) % 3 {
                0 => bytes[at] = xorshift(&mut state) as u8,
                1 => drop(bytes.remove(at)),
                _ => bytes.insert(at, b" /-\"0<>9&;="[xorshift(&mut state) % 11]),
            }
        }
        if round % 2 == 1 {
            bytes = zipped(&[(MODEL_PART, &String::from_utf8_lossy(&bytes))]);
        }
        if let Ok(mesh) = decode_model(&bytes) {
            assert!(
                mesh.vertices()
                    .iter()
                    .all(|p| p.coords.iter().all(|x| x.is_finite()))
            );
            assert!(!mesh.triangles().is_empty());
        }
    }
}

#[test]
fn a_block_written_by_us_reads_as_the_solid_it_was() {
    let mesh = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
    let object = Object::new("block", [0, 0, 0], &mesh);
    let bytes = encoded(&[object], Build::Apart(vec![(0, Transform::default())]));
    assert_eq!(solid(&bytes).mesh().signed_volume_mm3(), 6.0);
}
