//! Objects with a region of sparse infill, as PrusaSlicer and other programs read them.

use std::io::Read;

use zip::ZipArchive;

use super::*;
use crate::base::walls::Walls;

/// Packs a box of 30 mm with a region in it, on a plate.
fn packed() -> Vec<u8> {
    let region = SparseRegion {
        mesh: cuboid(&Point::new(15.0, 5.0, 5.0), &Point::new(25.0, 25.0, 25.0)),
        pattern: "gyroid".to_owned(),
        percent: 15.0,
    };
    packed_with(&[region])
}

/// Packs a box of 30 mm with regions in it, on a plate.
fn packed_with(regions: &[SparseRegion]) -> Vec<u8> {
    packed_in(Dialect::Prusa, regions)
}

/// Packs it in the words of a dialect.
fn packed_in(dialect: Dialect, regions: &[SparseRegion]) -> Vec<u8> {
    let body = cuboid(&Point::origin(), &Point::new(30.0, 30.0, 30.0));
    let objects = [Object::with_regions("P01", [1, 2, 3], &body, regions)];
    let shift = Vector::new(110.0, 90.0, 0.0);
    let place = Transform {
        linear: Matrix::identity(),
        shift,
    };
    let package = Package {
        title: "a box".to_owned(),
        description: "A box.".to_owned(),
        job: "box".to_owned(),
        objects: &objects,
        build: Build::Items(vec![(0, place)]),
        settings: Some(PrintSettings {
            dialect,
            layer_mm: 0.2,
            line_mm: 0.45,
            walls: Walls::default(),
            overhang_deg: None,
        }),
    };
    package.encode().unwrap()
}

/// Returns a part of a package; `None` if it has none of this name.
fn part(bytes: &[u8], name: &str) -> Option<String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut text = String::new();
    let mut part = archive.by_name(name).ok()?;
    part.read_to_string(&mut text).unwrap();
    Some(text)
}

#[test]
fn a_region_is_a_volume_of_its_own_and_a_cavity_for_those_who_know_of_none() {
    let bytes = packed();
    let settings = part(&bytes, "Metadata/Slic3r_PE_model.config").unwrap();
    for said in [
        "<volume firstid=\"0\" lastid=\"11\">",
        "<volume firstid=\"12\" lastid=\"23\">",
        "key=\"fill_density\" value=\"15%\"",
    ] {
        assert_eq!(settings.matches(said).count(), 1, "{said}: {settings}");
    }
    let whole = decode_model(&bytes).unwrap();
    assert!((whole.signed_volume_mm3() - (27_000.0 - 4_000.0)).abs() < 1e-6);
    assert!(Solid::new(whole).is_ok());
}

#[test]
fn a_package_with_a_region_has_the_version_that_moves_all_volumes_to_their_place() {
    let bytes = packed();
    let model = part(&bytes, MODEL_PART).unwrap();
    assert!(model.contains("<metadata name=\"slic3rpe:Version3mf\">1</metadata>"));
    // The other dialect would print the cavity.
    assert_eq!(part(&bytes, "Metadata/model_settings.config"), None);
}

#[test]
fn of_regions_in_regions_the_outermost_comes_first_and_none_shares_corners_with_another() {
    let region = |x_mm: f64, percent: f64| SparseRegion {
        mesh: cuboid(&Point::new(5.0, 5.0, 5.0), &Point::new(x_mm, 25.0, 25.0)),
        pattern: "gyroid".to_owned(),
        percent,
    };
    // The regions touch in a face: later ones hold.
    let bytes = packed_with(&[region(25.0, 60.0), region(15.0, 30.0), region(10.0, 15.0)]);
    let settings = part(&bytes, "Metadata/Slic3r_PE_model.config").unwrap();
    let mut last = 0;
    for said in [
        "<volume firstid=\"12\" lastid=\"23\">",
        "key=\"fill_density\" value=\"60%\"",
        "<volume firstid=\"24\" lastid=\"35\">",
        "key=\"fill_density\" value=\"30%\"",
        "<volume firstid=\"36\" lastid=\"47\">",
        "key=\"fill_density\" value=\"15%\"",
    ] {
        let at = settings.find(said).unwrap_or_default();
        assert!(at > last, "{said}: {settings}");
        last = at;
    }
    let model = part(&bytes, MODEL_PART).unwrap();
    assert_eq!(model.matches("<vertex ").count(), 4 * 8);
}

/// Returns two regions, one in the other.
fn two_regions() -> [SparseRegion; 2] {
    let region = |x_mm: f64, percent: f64| SparseRegion {
        mesh: cuboid(&Point::new(5.0, 5.0, 5.0), &Point::new(x_mm, 25.0, 25.0)),
        pattern: "gyroid".to_owned(),
        percent,
    };
    [region(25.0, 30.0), region(15.0, 15.0)]
}

#[test]
fn every_dialect_says_the_same_plate() {
    let plates = Dialect::ALL.iter().map(|dialect| {
        let mut plate = decode_plate(&packed_in(*dialect, &two_regions())).unwrap();
        assert_eq!(plate.len(), 1, "{dialect}");
        plate.remove(0)
    });
    let plates: Vec<PlateObject> = plates.collect();
    for plate in &plates {
        assert_eq!(plate.name, "P01");
        assert_eq!((plate.perimeters, plate.overhang_deg), (2, None));
        assert!((plate.outside.signed_volume_mm3() - 27_000.0).abs() < 1e-6);
        assert_eq!(plate.outside.aabb().min, Point::new(110.0, 90.0, 0.0));
        let found = plate.regions.iter().map(|region| {
            let volume_mm3 = region.mesh.signed_volume_mm3().round();
            (region.pattern.as_str(), region.percent, volume_mm3)
        });
        let found: Vec<(&str, f64, f64)> = found.collect();
        assert_eq!(found, [("gyroid", 30.0, 8000.0), ("gyroid", 15.0, 4000.0)]);
    }
}

#[test]
fn orca_has_regions_as_modifier_parts_that_are_components_of_their_object() {
    let bytes = packed_in(Dialect::Orca, &two_regions());
    let settings = part(&bytes, "Metadata/model_settings.config").unwrap();
    let ids = ["4", "5", "6"];
    let kinds = ["normal_part", "modifier_part", "modifier_part"];
    let mut last = 0;
    for (id, kind) in ids.into_iter().zip(kinds) {
        let said = format!("<part id=\"{id}\" subtype=\"{kind}\">");
        let at = settings.find(&said).unwrap_or_default();
        assert!(at > last, "{said}: {settings}");
        last = at;
    }
    assert!(settings.contains("key=\"sparse_infill_density\" value=\"15%\""));
    let model = part(&bytes, MODEL_PART).unwrap();
    let components = ids
        .map(|id| format!("<component objectid=\"{id}\"/>"))
        .concat();
    assert!(model.contains(&components), "{model}");
    assert!(model.contains("<item objectid=\"2\""));
    // PrusaSlicer would print the regions as parts.
    assert_eq!(part(&bytes, "Metadata/Slic3r_PE_model.config"), None);
}

#[test]
fn cura_has_regions_as_infill_meshes_with_settings_of_their_own() {
    let bytes = packed_in(Dialect::Cura, &two_regions());
    let model = part(&bytes, MODEL_PART).unwrap();
    for (said, count) in [
        ("<metadatagroup>", 3),
        ("name=\"cura:infill_mesh\" preserve=\"1\">true<", 2),
        ("name=\"cura:infill_mesh_order\" preserve=\"1\">2<", 1),
        ("name=\"cura:infill_sparse_density\" preserve=\"1\">100<", 1),
        ("name=\"cura:top_layers\" preserve=\"1\">0<", 3),
        ("name=\"P01 sparse infill 2\"", 1),
    ] {
        assert_eq!(model.matches(said).count(), count, "{said}: {model}");
    }
    assert!(model.contains("xmlns:cura=\"http://software.ultimaker.com/xml/cura/3mf/2015/10\""));
    for other in [
        "Metadata/Slic3r_PE_model.config",
        "Metadata/model_settings.config",
    ] {
        assert_eq!(part(&bytes, other), None);
    }
}

#[test]
fn the_pieces_of_a_strange_package_stay_as_they_are() {
    let bytes = packed_in(Dialect::Cura, &two_regions());
    let model = part(&bytes, MODEL_PART).unwrap();
    let strange = model.replace("equipoise:Job", "other:Job");
    let text = zip(&[(MODEL_PART, &strange)]);
    assert_eq!(decode_objects(&text).unwrap().len(), 3);
}

#[test]
fn triangles_without_support_are_found_again() {
    let body = cuboid(&Point::origin(), &Point::new(30.0, 30.0, 30.0));
    let on_top = |corners: &[Point; 3]| corners.iter().all(|p| p.z == 30.0);
    let objects = [Object::with_blockers("P01", [1, 2, 3], &body, on_top)];
    let package = Package {
        title: "a box".to_owned(),
        description: "A box.".to_owned(),
        job: "box".to_owned(),
        objects: &objects,
        build: Build::Items(vec![(0, Transform::default())]),
        settings: Some(PrintSettings {
            dialect: Dialect::Prusa,
            layer_mm: 0.2,
            line_mm: 0.45,
            walls: Walls::default(),
            overhang_deg: Some(45.0),
        }),
    };
    let plate = decode_plate(&package.encode().unwrap()).unwrap();
    let object = &plate[0];
    assert_eq!(object.overhang_deg, Some(45.0));
    assert_eq!(object.blocked.len(), 2);
    for at in &object.blocked {
        assert!(on_top(&object.outside.corners(*at)));
    }
}
