//! Objects with a region of sparse infill, as PrusaSlicer and other programs read them.

use std::io::Read;

use zip::ZipArchive;

use super::*;

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
            layer_mm: 0.2,
            line_mm: 0.45,
            perimeters: 2,
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
