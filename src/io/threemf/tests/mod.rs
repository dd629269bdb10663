//! Packages written and read again, and packages of other programs.

mod hostile;
mod regions;

use std::io::{Cursor, Write};

use zip::{ZipWriter, write::SimpleFileOptions};

use super::names::{CORE_NAMESPACE, MODEL_PART, MODEL_TYPE};
use super::*;
use crate::base::dialect::Dialect;
use crate::base::walls::Walls;
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

/// Packs these files into an archive.
fn zip(files: &[(&str, &str)]) -> Vec<u8> {
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
    zip(&[(MODEL_PART, &model_xml(attributes, resources, build))])
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

fn ball_object(name: &str) -> (TriMesh, Object) {
    let mesh = ball(&Point::new(0.1, 0.2, 0.3), 7.0, 3);
    let object = Object::new(name, [230, 159, 0], &mesh);
    (mesh, object)
}

fn encode(objects: &[Object], build: Build) -> Vec<u8> {
    let package = Package {
        title: "a <title>".into(),
        description: "&c.".into(),
        job: "j".into(),
        objects,
        build,
        settings: None,
    };
    package.encode().unwrap()
}

#[test]
fn a_package_with_settings_holds_the_same_objects_and_both_files_of_settings() {
    let (_, object) = ball_object("P01");
    let places = vec![(0, Transform::default())];
    let plain = encode(std::slice::from_ref(&object), Build::Items(places.clone()));
    let package = Package {
        title: "a".into(),
        description: "b".into(),
        job: "j".into(),
        objects: &[object],
        build: Build::Items(places),
        settings: Some(PrintSettings {
            dialect: Dialect::Prusa,
            layer_mm: 0.2,
            line_mm: 0.45,
            walls: Walls::default(),
            overhang_deg: Some(45.0),
        }),
    };
    let bytes = package.encode().unwrap();
    let [plain, set] = [plain, bytes.clone()].map(|bytes| decode_objects(&bytes).unwrap());
    assert_eq!(plain[0].mesh, set[0].mesh);
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
    let last = format!("lastid=\"{}\"", set[0].mesh.triangles().len() - 1);
    let mut text = String::new();
    let mut part = zip.by_name("Metadata/Slic3r_PE_model.config").unwrap();
    std::io::Read::read_to_string(&mut part, &mut text).unwrap();
    assert!(text.contains(&last), "{text}");
    assert!(
        text.contains("brim_width"),
        "a ball stands on a point: {text}"
    );
    drop(part);
    assert!(zip.by_name("Metadata/model_settings.config").is_ok());
}

#[test]
fn a_written_package_holds_the_same_triangles_as_the_stl_file_bit_for_bit() {
    let (mesh, object) = ball_object("P01 \"<&>\"");
    let bytes = encode(&[object], Build::Items(vec![(0, Transform::default())]));
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
fn the_same_package_has_the_same_bytes_and_does_not_tell_when_it_was_made() {
    let (_, object) = ball_object("P01");
    let [first, second] = [(); 2].map(|()| {
        encode(
            std::slice::from_ref(&object),
            Build::Items(vec![(0, Transform::default())]),
        )
    });
    assert_eq!(first, second);
    // Bytes 10 to 14 of an entry are its time and day: the first that the format knows, 1980-01-01.
    assert_eq!(first[10..14], [0, 0, 0x21, 0]);
}

#[test]
fn objects_lie_where_the_build_puts_them_apart_or_together() {
    let (mesh, object) = ball_object("P01");
    let turn = Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let map = Transform {
        linear: turn,
        shift: Vector::new(10.0, -20.0, 30.5),
    };
    let places = vec![(0, map), (0, Transform::shift(Vector::new(0.0, 0.0, 99.0)))];
    for build in [
        Build::Items(places.clone()),
        Build::Assembly("whole".into(), places.clone()),
    ] {
        let objects = decode_objects(&encode(std::slice::from_ref(&object), build)).unwrap();
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
    let objects = ["P01", "P02"].map(|name| ball_object(name).1);
    let one = encode(&objects, Build::Items(vec![(1, Transform::default())]));
    let both = encode(
        &objects,
        Build::Items(vec![(0, Transform::default()), (1, Transform::default())]),
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
    // In centimetres: a block shifted by 5, in an assembly scaled by two and shifted by 100.
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
    let found = decode_objects(&zip(&[(MODEL_PART, &root), ("3D/parts/a.model", &other)])).unwrap();
    assert_eq!(found[0].mesh.aabb().max, Point::new(14.0, 20.0, 30.0));
    assert!(message(&zip(&[(MODEL_PART, &root)])).contains("looked for 3D/parts/a.model"));
}

#[test]
fn the_model_is_where_the_relationships_lead() {
    let text = model_xml("", &block(1), "<item objectid=\"1\"/>");
    let rels = format!(
        "<Relationships><Relationship Target=\"/a/b.model\" Type=\"{MODEL_TYPE}\"/></Relationships>"
    );
    assert_eq!(
        solid(&zip(&[("a/b.model", &text), ("_rels/.rels", &rels)]))
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

#[test]
fn a_block_written_by_us_reads_as_the_solid_it_was() {
    let mesh = cuboid(&Point::origin(), &Point::new(1.0, 2.0, 3.0));
    let object = Object::new("block", [0, 0, 0], &mesh);
    let bytes = encode(&[object], Build::Items(vec![(0, Transform::default())]));
    assert_eq!(solid(&bytes).mesh().signed_volume_mm3(), 6.0);
}
