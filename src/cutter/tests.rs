//! Tests of the built-in profiles, of inheritance, and of faults.

use std::path::Path;

use super::library::{CUTTERS, FASTENERS, Profile, SHEETS, ids};
use super::*;
use crate::base::sourced::Sure;

const SHOP: &str = "id = \"shop\"\nname = \"Shop\"\ninherits = \"makerspace-900x600\"\n\n[[kerf]]\n\
    material = \"plywood\"\nthickness_mm = 3.2\n\
    kerf_mm = { value = 0.21, source = \"comb\", sure = \"measured\" }\n";
const SHEET: &str = "id = \"oak\"\nname = \"Oak board\"\nmaterial = \"wood\"\ngrain = \"along\"\n\
    thickness_mm = { value = 4.1, source = \"calliper\", sure = \"measured\" }\n\
    density_g_cm3 = { value = 0.72, source = \"weighed\", sure = \"measured\" }\n\n[[size]]\n\
    size_mm = { value = [500, 300], source = \"rule\", sure = \"measured\" }\nprice = 9.5\n";
const SCREWS: &str = "id = \"own\"\n[size]\nsource = \"calliper\"\nsure = \"measured\"\n[mass]\n\
    source = \"balance\"\nsure = \"measured\"\nspread_ratio = 0.05\n[[part]]\nid = \"screw-m3x9\"\n\
    name = \"screw\"\nshape = { kind = \"screw\", thread_mm = 3, length_mm = 9, \
    head_diameter_mm = 6, head_height_mm = 2, hole_mm = 3.4 }\nmass_g = 0.7\n";

/// Reads a profile from a file of its own.
fn read<T>(text: &str, read: impl Fn(&Path) -> Result<T, ProfileError>) -> Result<T, ProfileError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shop.toml");
    std::fs::write(&path, text).unwrap();
    read(&path)
}

/// The message for a text with one of its pieces changed.
fn message<T: std::fmt::Debug>(
    text: &str,
    change: [&str; 2],
    reader: impl Fn(&Path) -> Result<T, ProfileError>,
) -> String {
    assert!(text.contains(change[0]), "{}", change[0]);
    let changed = text.replacen(change[0], change[1], 1);
    read(&changed, reader).unwrap_err().to_string()
}

#[test]
fn every_built_in_profile_loads_under_the_id_of_its_file() {
    let cutters: Vec<String> = Cutter::all().unwrap().into_iter().map(|c| c.id).collect();
    assert_eq!(cutters, CUTTERS.ids());
    let sheets: Vec<String> = StockSheet::all()
        .unwrap()
        .into_iter()
        .map(|s| s.id)
        .collect();
    assert_eq!(sheets, SHEETS.ids());
    let fasteners = Fastener::all().unwrap();
    assert!(
        ["screw-m3x10", "insert-m3", "washer-m5"]
            .iter()
            .all(|id| fasteners.iter().any(|fastener| fastener.id == *id))
    );
}

#[test]
fn every_profile_in_the_folders_is_built_in() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("profiles");
    let lists: [(&str, &[Profile]); 5] = [
        ("cutters", CUTTERS.profiles),
        ("cutters/families", CUTTERS.families),
        ("sheets", SHEETS.profiles),
        ("sheets/families", SHEETS.families),
        ("fasteners", FASTENERS),
    ];
    for (folder, list) in lists {
        let entries = std::fs::read_dir(root.join(folder)).unwrap();
        let files = entries.map(|entry| entry.unwrap().path());
        let files = files.filter(|path| path.is_file());
        let mut names: Vec<String> = files
            .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        names.sort();
        assert_eq!(names, ids(list), "{folder}");
    }
}

#[test]
fn the_kerf_between_two_thicknesses_is_in_proportion() {
    let cutter = Cutter::find("makerspace-900x600").unwrap();
    let kerf = |mm| cutter.kerf(SheetMaterial::Plywood, mm).unwrap();
    assert!((kerf(4.8).kerf_mm - 0.225).abs() < 1e-12);
    assert_eq!(
        (kerf(3.2).kerf_mm, kerf(0.8).kerf_mm, kerf(9.0).kerf_mm),
        (0.2, 0.15, 0.25)
    );
    assert!(kerf(4.8).provenance.contains("default of co2-laser"));
    let error = cutter
        .kerf(SheetMaterial::Cardboard, 3.0)
        .unwrap_err()
        .to_string();
    assert!(error.contains("no kerf for cardboard") && error.contains("plywood, mdf, acrylic"));
}

#[test]
fn a_measured_kerf_replaces_that_of_the_family_and_the_rest_stays() {
    let cutter = read(SHOP, Cutter::read).unwrap();
    let kerf = cutter.kerf(SheetMaterial::Plywood, 3.2).unwrap();
    assert_eq!((kerf.kerf_mm, kerf.sure), (0.21, Sure::Measured));
    assert_eq!(
        cutter.kerf(SheetMaterial::Plywood, 6.4).unwrap().kerf_mm,
        0.25
    );
    assert_eq!(cutter.bed_mm.value, [900.0, 600.0]);
    assert_eq!(cutter.bed_mm.process_default_of, None);
    assert_eq!(cutter.dialect, Dialect::Boxes);
}

#[test]
fn a_sheet_that_is_too_thick_is_refused_and_one_that_fits_has_its_room() {
    let cutter = Cutter::find("makerspace-900x600").unwrap();
    let birch = StockSheet::find("birch-5").unwrap();
    assert!((cutter.check_sheet(&birch).unwrap().kerf_mm - 0.228_125).abs() < 1e-12);
    let error = cutter.check_sheet(&birch.clone().measured(9.1, "calliper"));
    assert!(matches!(
        error,
        Err(CannotCut::TooThick { most_mm: 8.0, .. })
    ));
    let rooms = cutter.rooms_mm(&birch);
    assert_eq!(rooms[..3], [[590.0, 390.0], [790.0, 590.0], [890.0, 590.0]]);
    assert!((birch.mass_per_area_g_mm2() - 0.0035).abs() < 1e-12);
}

#[test]
fn a_family_cannot_be_chosen_and_an_unknown_id_is_answered_with_the_nearest() {
    let error = Cutter::find("glowforg").unwrap_err().to_string();
    assert_eq!(
        error,
        "there is no cutter `glowforg`; remedy: did you mean `glowforge`?"
    );
    let error = Cutter::find("co2-laser").unwrap_err().to_string();
    assert!(error.contains("did you mean `any-co2-laser`?"), "{error}");
    let error = Fastener::find("screw-m3x11").unwrap_err().to_string();
    assert!(error.contains("did you mean `screw-m3x1"), "{error}");
    let error = StockSheet::find("no/such.toml").unwrap_err();
    assert!(matches!(error, ProfileError::Unreadable { .. }));
}

#[test]
fn faults_of_cutters_name_their_place_and_what_to_type() {
    let cases = [
        (["\"comb\"", "\" \""], ":8:", "add source = "),
        (["sure = \"measured\"", ""], ":8:", "does not say how sure"),
        (["0.21", "210"], ":8:", "check the unit"),
        (["0.21", "-1"], ":8:", "must be positive"),
        (
            ["0.21", "1.5"],
            ":1:1:",
            "the narrowest strip `min_feature_mm` is 1",
        ),
        (
            ["\"plywood\"", "\"plywod\""],
            ":6:",
            "did you mean `plywood`?",
        ),
        (["\"plywood\"", "\"PVC foam\""], ":6:", "chlorine"),
        (
            ["\"makerspace-900x600\"", "\"makerspace\""],
            ":3:",
            "did you mean `makerspace-900x600`?",
        ),
        (
            ["\"makerspace-900x600\"", "\"shop.toml\""],
            ":3:",
            "inherits from itself",
        ),
        (
            ["\"makerspace-900x600\"", "\"no.toml\""],
            ":3:",
            "cannot read the parent",
        ),
        (
            ["inherits = \"makerspace-900x600\"", ""],
            ":1:1:",
            "`bed_mm` is not set",
        ),
        (["\"shop\"", "\"My Shop\""], ":1:", "lower-case letters"),
        (
            ["thickness_mm", "thicknes_mm"],
            ":7:",
            "did you mean `thickness_mm`?",
        ),
    ];
    for (change, place, said) in cases {
        let error = message(SHOP, change, Cutter::read);
        assert!(
            error.contains(place) && error.contains(said),
            "{change:?}: {error}"
        );
    }
    let twice = format!("{SHOP}{}", &SHOP[SHOP.find("\n[[kerf]]").unwrap()..]);
    let error = read(&twice, Cutter::read).unwrap_err().to_string();
    assert!(
        error.contains("the kerf in plywood of 3.2 mm appears twice"),
        "{error}"
    );
}

#[test]
fn faults_of_sheets_name_their_place_and_what_to_type() {
    assert_eq!(
        read(SHEET, StockSheet::read).unwrap().sizes[0].price,
        Some(9.5)
    );
    let cases = [
        (["\"wood\"", "\"vinyl\""], ":3:", "never be cut by a laser"),
        (["Oak board", "Grey PVC"], ":2:", "never be cut by a laser"),
        (["0.72", "720"], ":6:", "check the unit"),
        (["grain = \"along\"\n", ""], ":1:1:", "`grain` is not set"),
        (["[[size]]", "[[sizes]]"], ":8:", "did you mean `size`?"),
        (["price = 9.5", "price = -9.5"], ":10:", "must be positive"),
        (
            [
                "thickness_mm",
                "thickness_range_mm = { value = [5, 6], source = \"s\", sure = \
              \"read\" }\nthickness_mm",
            ],
            ":1:1:",
            "`thickness_range_mm` is 5 to 6",
        ),
    ];
    for (change, place, said) in cases {
        let error = message(SHEET, change, StockSheet::read);
        assert!(
            error.contains(place) && error.contains(said),
            "{change:?}: {error}"
        );
    }
}

#[test]
fn faults_of_fasteners_name_their_place_and_what_to_type() {
    assert_eq!(read(SCREWS, Fastener::read).unwrap().len(), 1);
    let with_family = SCREWS.replacen("[size]", "inherits = \"screws\"\n[size]", 1);
    let all = read(&with_family, Fastener::read).unwrap();
    assert!(all.len() > 10 && all[0].id == "screw-m3x9");
    let cases = [
        (["\"calliper\"", "\"\""], "`size` has no source"),
        (
            ["mass_g = 0.7", "mass_g = 0.07"],
            "check its sizes and its mass",
        ),
        (
            ["hole_mm = 3.4", "hole_mm = 6.4"],
            "`head_diameter_mm` of `screw-m3x9` is 6",
        ),
        (["length_mm = 9", "length_mm = 900"], "check the unit"),
        (
            ["spread_ratio = 0.05", "spread_ratio = 5"],
            "`spread_ratio` is 5",
        ),
        (
            ["[size]", "inherits = \"screw\"\n[size]"],
            "did you mean `screws`?",
        ),
    ];
    for (change, said) in cases {
        let error = message(SCREWS, change, Fastener::read);
        assert!(error.contains(said), "{change:?}: {error}");
    }
}

#[test]
fn fasteners_weigh_what_their_metal_does_and_rods_what_beech_does() {
    for fastener in Fastener::all().unwrap() {
        let density = fastener.mass_g / fastener.shape.volume_mm3() * 1000.0;
        let usual = match fastener.shape {
            FastenerShape::Dowel { .. } => 0.54..0.91,
            _ => 5.5..8.6,
        };
        assert!(usual.contains(&density), "{}: {density}", fastener.id);
    }
}

#[test]
fn the_kind_of_a_profile_is_told_by_its_keys_or_its_parent() {
    let kind = |text: &str| match read(text, AnyProfile::read).unwrap() {
        AnyProfile::Cutter(_) => "cutter",
        AnyProfile::Sheet(_) => "sheet",
        AnyProfile::Fasteners(_) => "fasteners",
    };
    assert_eq!(
        [SHOP, SHEET, SCREWS].map(kind),
        ["cutter", "sheet", "fasteners"]
    );
    let heir = |parent: &str| {
        kind(&format!(
            "id = \"a\"\nname = \"A\"\ninherits = \"{parent}\"\n"
        ))
    };
    assert_eq!([heir("glowforge"), heir("birch-5")], ["cutter", "sheet"]);
    for id in ["glowforge", "mdf-6", "washer-m4"] {
        AnyProfile::find(id).unwrap();
    }
    let error = AnyProfile::find("mdf-7").unwrap_err().to_string();
    assert!(error.contains("did you mean `mdf-"), "{error}");
}
