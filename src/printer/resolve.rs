//! A profile, its process and its materials put together into one printer.

use std::collections::{BTreeMap, BTreeSet};

use toml::Spanned;

use super::{
    Faults, Material, Printer, Problem, ProfileError, Quantity, Sourced, Tolerance,
    error::suggestion,
    layer::{Layer, Reference},
    library::{Library, Profile, by_id, ids},
    profile::{MaterialText, ProfileText, Reader},
};
use crate::{digest::sha256_hex, toml_text::TextFault};

/// The printer that `profile` describes, with what it inherits; or everything that is wrong with it. What is missing is told once
/// what is there is right.
pub(super) fn resolve(library: &Library, profile: Profile) -> Result<Printer, ProfileError> {
    let mut reader = Reader::new(profile.file, profile.text);
    let text: ProfileText = reader.parse()?;
    let mut layer = Layer::read(&mut reader, &text);
    let mut process_text = "";
    if let Some(id) = &text.inherits {
        let process = parent(library, &mut reader, id, &text).ok_or_else(|| faults_of(&mut reader))?;
        layer = layer.over(read_process(process, &mut reader)?);
        process_text = process.text;
    }
    let materials = materials(library, &mut reader, &layer)?;
    if !reader.faults.is_empty() {
        return Err(faults_of(&mut reader));
    }
    let printer = complete(&mut reader, layer, materials).ok_or_else(|| faults_of(&mut reader))?;
    Ok(Printer { profile_sha256: sha256_hex(&[profile.text.as_bytes(), process_text.as_bytes()]), ..printer })
}

fn faults_of(reader: &mut Reader) -> ProfileError {
    Faults(std::mem::take(&mut reader.faults)).into()
}

/// The process that the profile inherits from; a wrong parent is noted.
fn parent<'a>(
    library: &Library<'a>,
    reader: &mut Reader,
    id: &Spanned<String>,
    child: &ProfileText,
) -> Option<&'a Profile<'a>> {
    let process = by_id(library.processes, id.get_ref());
    let parent = id.get_ref().clone();
    let known = ids(library.processes);
    let problem = if parent == *child.id.get_ref() {
        Problem::Cycle { id: parent, known: known.join(", ") }
    } else if process.is_some() {
        return process;
    } else if by_id(library.printers, &parent).is_some() {
        Problem::ParentIsPrinter { parent, known: known.join(", ") }
    } else {
        Problem::UnknownParent { remedy: suggestion(&parent, &known), parent }
    };
    reader.note(id.span().start, problem);
    None
}

/// What a process says; its faults join those of the printer.
fn read_process(process: &Profile, child: &mut Reader) -> Result<Layer, TextFault> {
    let mut reader = Reader::new(process.file, process.text);
    let text: ProfileText = reader.parse()?;
    let layer = Layer::read(&mut reader, &text);
    if let Some(parent) = &text.inherits {
        let problem = Problem::ProcessInherits { id: layer.id.clone(), parent: parent.get_ref().clone() };
        reader.note(parent.span().start, problem);
    }
    child.faults.append(&mut reader.faults);
    Ok(layer)
}

/// The materials of the profile, its default first: those it lists or inherits, and its own.
fn materials(library: &Library, reader: &mut Reader, layer: &Layer) -> Result<Vec<Material>, TextFault> {
    let mut found: Vec<Material> = Vec::new();
    note_repeats(reader, layer);
    for (id, at) in layer.materials.iter().flatten() {
        match layer.own_materials.iter().find(|own| own.id == *id) {
            Some(own) => found.push(own.clone()),
            None => found.extend(from_library(library, reader, (id, *at))?),
        }
    }
    let listed = found.len();
    for own in &layer.own_materials {
        if found[..listed].iter().all(|material| material.id != own.id) {
            found.push(own.clone());
        }
    }
    if found.is_empty() && reader.faults.is_empty() {
        reader.note(0, Problem::NoMaterials);
    }
    default_first(reader, &mut found, layer.default_material.as_ref());
    Ok(found)
}

/// Notes materials that are listed or defined twice.
fn note_repeats(reader: &mut Reader, layer: &Layer) {
    let mut seen = BTreeSet::new();
    for (id, at) in layer.materials.iter().flatten() {
        if !seen.insert(id) {
            reader.note(*at, Problem::MaterialTwice { id: id.clone() });
        }
    }
    let mut seen = BTreeSet::new();
    for own in &layer.own_materials {
        if !seen.insert(&own.id) {
            reader.note(0, Problem::MaterialTwice { id: own.id.clone() });
        }
    }
}

fn from_library(
    library: &Library,
    child: &mut Reader,
    (id, at): (&str, usize),
) -> Result<Option<Material>, TextFault> {
    let Some(profile) = by_id(library.materials, id) else {
        let remedy = suggestion(id, &ids(library.materials));
        child.note(at, Problem::UnknownMaterial { id: id.to_owned(), remedy });
        return Ok(None);
    };
    let mut reader = Reader::new(profile.file, profile.text);
    let text: MaterialText = reader.parse()?;
    let material = reader.material(&text);
    child.faults.append(&mut reader.faults);
    Ok(material)
}

/// Moves the default material to the front.
fn default_first(reader: &mut Reader, materials: &mut [Material], default: Option<&Reference>) {
    let Some((id, at)) = default else {
        return;
    };
    match materials.iter().position(|material| material.id == *id) {
        Some(place) => materials[..=place].rotate_right(1),
        None => {
            let known: Vec<&str> = materials.iter().map(|material| material.id.as_str()).collect();
            let known = known.join(", ");
            reader.note(*at, Problem::DefaultNotListed { id: id.clone(), known });
        }
    }
}

/// The printer, unless something that every printer needs is unset; each such key is noted.
fn complete(reader: &mut Reader, layer: Layer, materials: Vec<Material>) -> Option<Printer> {
    let mut needs = Needs { reader, numbers: layer.numbers };
    let [pixel_x_mm, pixel_y_mm, layer_mm] =
        [Quantity::PixelXMm, Quantity::PixelYMm, Quantity::LayerMm].map(|key| needs.number(key));
    let [min_wall_mm, min_feature_mm, min_opening_mm] =
        [Quantity::MinWallMm, Quantity::MinFeatureMm, Quantity::MinOpeningMm].map(|key| needs.number(key));
    let [pin_min_diameter_mm, pin_length_ratio] =
        [Quantity::PinMinDiameterMm, Quantity::PinLengthRatio].map(|key| needs.number(key));
    let [clearance_per_side_mm, socket_extra_depth_mm, chamfer_mm] =
        [Quantity::ClearancePerSideMm, Quantity::SocketExtraDepthMm, Quantity::ChamferMm]
            .map(|key| needs.number(key));
    let least_mm = needs.number(Quantity::ToleranceLeastMm);
    let ratio = needs.numbers.remove(&Quantity::ToleranceRatio);
    let grid = needs.word("grid", layer.grid);
    let support = needs.word("support", layer.support);
    let print_pose = needs.word("print_pose", layer.print_pose);
    let cleaning = needs.word("cleaning", layer.cleaning);
    Some(Printer {
        id: layer.id,
        name: layer.name,
        process: layer.process,
        profile_sha256: String::new(),
        grid: grid?,
        pixel_x_mm: pixel_x_mm?,
        pixel_y_mm: pixel_y_mm?,
        layer_mm: layer_mm?,
        build_volume_mm: layer.build_volume_mm,
        min_wall_mm: min_wall_mm?,
        min_feature_mm: min_feature_mm?,
        min_opening_mm: min_opening_mm?,
        pin_min_diameter_mm: pin_min_diameter_mm?,
        pin_length_ratio: pin_length_ratio?,
        clearance_per_side_mm: clearance_per_side_mm?,
        socket_extra_depth_mm: socket_extra_depth_mm?,
        chamfer_mm: chamfer_mm?,
        tolerance: Tolerance { least_mm: least_mm?, ratio },
        support: support?,
        print_pose: print_pose?,
        cleaning: cleaning?,
        materials,
    })
}

/// Takes what every printer needs, and notes what is not there.
struct Needs<'r, 'a> {
    reader: &'r mut Reader<'a>,
    numbers: BTreeMap<Quantity, Sourced<f64>>,
}

impl Needs<'_, '_> {
    fn number(&mut self, quantity: Quantity) -> Option<Sourced<f64>> {
        let number = self.numbers.remove(&quantity);
        self.word(quantity.key(), number)
    }

    fn word<T>(&mut self, key: &str, value: Option<T>) -> Option<T> {
        if value.is_none() {
            self.reader.note(0, Problem::Missing { key: key.to_owned() });
        }
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::library::BUILT_IN;

    /// A whole printer that inherits from a process, in the shape every broken one below is made from.
    const WHOLE: &str = r#"id = "test"
name = "Test printer"
inherits = "polyjet"
materials = ["vero-white", "pla"]
default_material = "pla"
build_volume_mm = { value = [200, 100, 150], source = "s", sure = "read" }

[numbers]
pixel_x_mm = { dpi = 600, source = "s", sure = "paper" }
pixel_y_mm = { value = 0.05, source = "s", sure = "third-party" }
layer_mm = { value = 0.03, source = "s", sure = "recalled" }

[[material]]
id = "own"
name = "Own resin"
density_g_cm3 = { value = 1.2, source = "weighed coupon", sure = "read" }
density_spread_ratio = { value = 0.01, source = "weighed coupon", sure = "read" }
"#;

    fn load(text: &str) -> Result<Printer, ProfileError> {
        resolve(&BUILT_IN, Profile { id: "t.toml", file: "t.toml", text })
    }

    #[test]
    fn a_whole_profile_takes_its_own_numbers_first_and_the_process_defaults_after() {
        let printer = load(WHOLE).unwrap();
        assert_eq!(printer.pixel_y_mm.provenance(), "third party: s");
        assert!(printer.min_wall_mm.provenance().starts_with("read, default of polyjet: Hubs"));
        assert_eq!(printer.build_volume_mm.unwrap().value, [200.0, 100.0, 150.0]);
        let ids: Vec<&str> = printer.materials.iter().map(|material| material.id.as_str()).collect();
        assert_eq!(ids, ["pla", "vero-white", "own"], "the default comes first, own materials last");
    }

    #[test]
    fn an_own_material_replaces_the_known_one_of_its_id() {
        let printer = load(&WHOLE.replace("\"own\"", "\"pla\"")).unwrap();
        assert_eq!(printer.materials.len(), 2);
        assert_eq!(printer.material(Some("pla")).unwrap().density_g_cm3.value, 1.2);
    }

    #[test]
    fn a_list_of_materials_does_not_take_over_the_default_of_another_list() {
        let text =
            WHOLE.replace("default_material = \"pla\"\n", "").replace("\"vero-white\", \"pla\"", "\"pla\"");
        assert_eq!(load(&text).unwrap().material(None).unwrap().id, "pla");
    }

    #[test]
    fn a_profile_without_a_process_must_say_everything() {
        let error = load(&WHOLE.replace("inherits = \"polyjet\"\n", "")).unwrap_err();
        let ProfileError::Broken(Faults(faults)) = error else { panic!("{error}") };
        let missing = |fault: &&crate::printer::Fault| matches!(fault.problem, Problem::Missing { .. });
        assert_eq!((faults.len(), faults.iter().filter(missing).count()), (13, 13));
        assert!(faults[0].to_string().starts_with("t.toml:1:1: `min_wall_mm` is not set"), "{}", faults[0]);
    }

    /// What to replace in the whole profile, by what, and what the message must then say, the place first.
    const BROKEN: [(&str, &str, &str, &str); 40] = [
        ("id = \"test\"\n", "", ":1:1: ", "missing field `id`"),
        ("name = \"Test printer\"\n", "", ":1:1: ", "missing field `name`"),
        ("\"test\"", "\"My Printer\"", ":1:6: ", "may only have lower-case letters"),
        ("\"test\"", "\"\"", ":1:6: ", "may only have lower-case letters"),
        ("\"Test printer\"", "\"  \"", ":2:8: ", "`name` is empty"),
        ("id = \"test\"", "id = ", ":1:6: ", "string values must be quoted"),
        ("id = \"test\"", "id = \"test\"\nid = \"again\"", ":2:1: ", "duplicate key"),
        ("id = \"test\"", "ID = \"test\"", ":1:1: ", "unknown field `ID`"),
        ("inherits", "inherit", ":3:1: ", "did you mean `inherits`"),
        ("\"polyjet\"", "\"polyjt\"", ":3:12: ", "no process `polyjt`; remedy: did you mean `polyjet`?"),
        ("\"polyjet\"", "\"laser-tag\"", ":3:12: ", "use one of fdm, polyjet, sla"),
        ("\"polyjet\"", "\"test\"", ":3:12: ", "`test` inherits from itself"),
        ("\"polyjet\"", "\"prusa-mk4\"", ":3:12: ", "is a printer, and a profile has one parent"),
        ("\"vero-white\", \"pla\"", "", ":5:20: ", "default material `pla` is not among"),
        ("\"vero-white\", \"pla\"", "\"pla\", \"vero-wite\"", ":4:21: ", "did you mean `vero-white`?"),
        ("\"vero-white\", \"pla\"", "\"pla\", \"pla\"", ":4:21: ", "`pla` appears twice"),
        (
            "default_material = \"pla\"",
            "default_material = \"abs\"",
            ":5:20: ",
            "not among the printer's materials",
        ),
        (
            "default_material",
            "support = \"waterjet\"\ndefault_material",
            ":5:11: ",
            "did you mean `water-jet`",
        ),
        ("default_material", "print_pose = \"up\"\ndefault_material", ":5:14: ", "unknown variant `up`"),
        ("default_material", "grid = 7\ndefault_material", ":5:8: ", "wanted string or table"),
        ("default_material", "cleaning = \"\"\ndefault_material", ":5:12: ", "`cleaning` is empty"),
        ("[200, 100, 150]", "[200, 100]", ":6:29: ", "invalid length 2"),
        ("[200, 100, 150]", "[200, -100, 150]", ":6:19: ", "`build_volume_mm` is -100, but must be positive"),
        ("[200, 100, 150]", "[20, 10, 0.15]", ":6:19: ", "outside 10 to 10000"),
        ("pixel_x_mm", "pixel_x", ":9:1: ", "did you mean `pixel_x_mm`"),
        ("dpi = 600, source = \"s\", ", "dpi = 600, ", ":9:14: ", "`pixel_x_mm` has no source"),
        ("dpi = 600, source = \"s\"", "dpi = 600, source = \" \"", ":9:14: ", "`pixel_x_mm` has no source"),
        ("sure = \"paper\"", "sure = \"certain\"", ":9:48: ", "unknown variant `certain`"),
        (", sure = \"paper\"", "", ":9:14: ", "does not say how sure it is"),
        ("dpi = 600, ", "", ":9:14: ", "`pixel_x_mm` has no value"),
        ("dpi = 600", "dpi = 600, value = 0.04", ":9:14: ", "has both value and dpi"),
        ("dpi = 600", "dpi = 0", ":9:14: ", "is inf, but must be positive and finite"),
        ("dpi = 600", "value = nan", ":9:14: ", "is NaN, but must be positive and finite"),
        ("dpi = 600", "value = \"fine\"", ":9:24: ", "invalid type: string"),
        ("dpi = 600", "value = 42.3", ":9:14: ", "outside 0.001 to 2; remedy: check the unit"),
        ("layer_mm", "min_wall_mm", ":1:1: ", "`layer_mm` is not set"),
        ("layer_mm = { value", "chamfer_mm = { dpi", ":11:14: ", "`chamfer_mm` cannot be given in dpi"),
        (
            "{ value = 0.03, source = \"s\", sure = \"recalled\" }",
            "0.03",
            ":11:12: ",
            "invalid type: floating point",
        ),
        ("value = 1.2,", "value = 1200,", ":16:17: ", "outside 0.05 to 25"),
        ("id = \"own\"\n", "", ":13:1: ", "missing field `id`"),
    ];

    #[test]
    fn every_broken_profile_is_refused_with_its_place_and_its_reason() {
        let mut wrong = Vec::new();
        for (from, to, place, reason) in BROKEN {
            assert!(WHOLE.contains(from), "{from}");
            let error = load(&WHOLE.replacen(from, to, 1)).expect_err(to).to_string();
            if !error.contains(reason) || !error.contains(&format!("t.toml{place}")) {
                wrong.push(format!("{from} → {to} (t.toml{place}{reason}): {error}"));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    #[test]
    fn the_example_in_the_documentation_can_be_used() {
        let page = include_str!("mod.rs").split("//! ```").nth(1).unwrap().trim_start_matches("toml");
        let example: String =
            page.lines().map(|line| line.trim_start_matches("//!").to_owned() + "\n").collect();
        let printer = load(&example).unwrap();
        assert_eq!((printer.id.as_str(), printer.materials[0].id.as_str()), ("shop-jet", "lot-7"));
    }

    #[test]
    fn all_faults_are_told_at_once() {
        let text = WHOLE.replace("dpi = 600", "value = -1").replace("value = 0.05", "value = 0");
        let ProfileError::Broken(Faults(faults)) = load(&text).unwrap_err() else { panic!() };
        assert_eq!(faults.len(), 2);
    }

    #[test]
    fn a_number_without_a_source_is_refused_wherever_it_stands() {
        for (from, to) in [
            ("source = \"weighed coupon\", ", ""),
            ("source = \"s\", ", ""),
            ("150], source = \"s\"", "150]"),
        ] {
            let error = load(&WHOLE.replacen(from, to, 1)).unwrap_err().to_string();
            assert!(error.contains("has no source"), "{error}");
        }
    }

    #[test]
    fn a_process_that_inherits_is_refused_in_its_own_file() {
        let process = "id = \"deep\"\nname = \"Deep\"\ninherits = \"polyjet\"\n";
        let processes = [Profile { id: "deep", file: "deep.toml", text: process }];
        let library = Library { processes: &processes, ..BUILT_IN };
        let text = WHOLE.replace("polyjet", "deep");
        let error = resolve(&library, Profile { id: "t.toml", file: "t.toml", text: &text }).unwrap_err();
        assert!(
            error.to_string().starts_with("deep.toml:3:12: the process `deep` inherits from `polyjet`"),
            "{error}"
        );
    }

    #[test]
    fn the_hash_covers_the_profile_and_its_process() {
        let plain = load(WHOLE).unwrap().profile_sha256;
        assert_eq!(plain.len(), 64);
        assert_ne!(plain, load(&format!("{WHOLE}\n# a remark")).unwrap().profile_sha256);
        assert_ne!(plain, load(&WHOLE.replace("polyjet", "sla")).unwrap().profile_sha256);
    }

    proptest::proptest! {
        #[test]
        fn a_profile_damaged_anywhere_is_read_or_refused_without_a_panic(at in 0..WHOLE.len(), by in "\\PC{0,3}") {
            let damaged = format!("{}{by}{}", &WHOLE[..at], &WHOLE[(at + 1).min(WHOLE.len())..]);
            if let Err(error) = load(&damaged) {
                proptest::prop_assert!(error.to_string().contains("t.toml:"), "{error}");
            }
        }
    }
}
