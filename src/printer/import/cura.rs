//! Cura's definitions: machines (`.def.json`, each inheriting from another file of its folder), materials
//! (`.xml.fdm_material`) and layers (`.inst.cfg`).

use std::{collections::BTreeMap, path::Path};

use serde_json::Value;

use super::{
    Found, ImportError, Imported, ImportedMaterial, ImportedPrinter, Technology, first_number, ini::Ini,
    read_text,
};
use crate::toml_text::Place;

/// How a definition's file ends.
const ENDING: &str = ".def.json";

/// A setting: its number and the file it is from.
type Settings = BTreeMap<String, (f64, String)>;

/// Adds the machine of a definition to `all`.
pub(super) fn read_definition(path: &Path, text: &str, all: &mut Imported) -> Result<(), ImportError> {
    let mut settings = Settings::new();
    let mut way = Vec::new();
    let name = collect(path, text, &mut settings, &mut way)?;
    let found = |key: &str| {
        let (value, file) = settings.get(key)?;
        Some(Found { value: *value, source: format!("{file}, {key}"), is_computed: false })
    };
    all.printers.push(ImportedPrinter {
        name,
        technology: Technology::Filament,
        pixel_mm: found("line_width").or_else(|| nozzle(&settings)).map(|width| [width.clone(), width]),
        layer_mm: found("layer_height"),
        layers_mm: [None, None],
        build_volume_mm: build_volume(&settings),
        elephant_foot_mm: None,
        default_material: None,
    });
    Ok(())
}

/// The nozzle's diameter, which stands for a line's width where that is a formula.
fn nozzle(settings: &Settings) -> Option<Found<f64>> {
    let (value, file) = settings.get("machine_nozzle_size")?;
    let source = format!("{file}, machine_nozzle_size, as the line width is a formula");
    Some(Found { value: *value, source, is_computed: true })
}

fn build_volume(settings: &Settings) -> Option<Found<[f64; 3]>> {
    let side = |key: &str| settings.get(key);
    let sides = [side("machine_width")?, side("machine_depth")?, side("machine_height")?];
    let source = format!("{}, machine_width, machine_depth and machine_height", sides[0].1);
    Some(Found { value: sides.map(|side| side.0), source, is_computed: false })
}

/// Gathers the settings of a definition over those it inherits; gives its name.
fn collect(
    path: &Path,
    text: &str,
    into: &mut Settings,
    way: &mut Vec<String>,
) -> Result<String, ImportError> {
    let file = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    if way.contains(&file) {
        let place = Place { file: file.clone(), line: 1, column: 1 };
        return Err(ImportError::Cycle { place, way: way.join(" → ") + " → " + &file });
    }
    way.push(file.clone());
    let definition = parsed(&file, text)?;
    if let Some(parent) = definition["inherits"].as_str() {
        let above = path.with_file_name(format!("{parent}{ENDING}"));
        collect(&above, &read_text(&above)?, into, way)?;
    }
    gather(&definition["settings"], &file, into);
    gather(&definition["overrides"], &file, into);
    Ok(definition["name"].as_str().unwrap_or(file.trim_end_matches(ENDING)).to_owned())
}

fn parsed(file: &str, text: &str) -> Result<Value, ImportError> {
    let fault = |line: usize, column: usize, message: String| ImportError::Json {
        file: file.to_owned(),
        line,
        column,
        message,
    };
    let value: Value =
        serde_json::from_str(text).map_err(|error| fault(error.line(), error.column(), error.to_string()))?;
    let is_definition = value["settings"].is_object() || value["overrides"].is_object();
    if is_definition { Ok(value) } else { Err(fault(1, 1, "neither settings nor overrides".to_owned())) }
}

/// The numbers of settings, and of their children. A formula hides the number of a parent: it is not evaluated.
fn gather(settings: &Value, file: &str, into: &mut Settings) {
    for (key, setting) in settings.as_object().into_iter().flatten() {
        let formula = &setting["value"];
        let number = formula.as_f64().or_else(|| formula.as_str().and_then(|text| text.trim().parse().ok()));
        let number = number.or_else(|| setting["default_value"].as_f64().filter(|_| formula.is_null()));
        match number.filter(|number: &f64| number.is_finite() && *number > 0.0) {
            Some(number) => {
                into.insert(key.clone(), (number, file.to_owned()));
            }
            None if !formula.is_null() => {
                into.remove(key);
            }
            None => {}
        }
        gather(&setting["children"], file, into);
    }
}

/// Adds a material to `all`: its name is brand, material and colour.
pub(super) fn read_material(file: &str, text: &str, all: &mut Imported) {
    let name = element(text, "name").map_or_else(String::new, str::to_owned);
    let words: Vec<&str> = ["brand", "material"]
        .iter()
        .filter_map(|tag| element(&name, tag))
        .filter(|w| !w.is_empty())
        .collect();
    let density = element(text, "density").and_then(first_number);
    all.materials.push(ImportedMaterial {
        name: if words.is_empty() { file.to_owned() } else { words.join(" ") },
        technology: Technology::Filament,
        density_g_cm3: density.map(|value| Found {
            value,
            source: format!("{file}, density"),
            is_computed: false,
        }),
    });
}

/// What stands between the first `<tag>` and its end; none where there is no such element.
fn element<'a>(text: &'a str, tag: &str) -> Option<&'a str> {
    let (_, after) = text.split_once(&format!("<{tag}>"))?;
    let (inside, _) = after.split_once(&format!("</{tag}>"))?;
    Some(inside.trim())
}

/// Gives the printers of `all` the layer and line of a quality file.
pub(super) fn read_layer(file: &str, text: &str, all: &mut Imported) -> Result<(), ImportError> {
    let values = Ini::parse(file, text)?.resolved("values", "")?;
    let found = |key: &str| {
        let value = first_number(values.get(key)?)?;
        Some(Found { value, source: format!("{file}, {key}"), is_computed: false })
    };
    for printer in &mut all.printers {
        printer.layer_mm = found("layer_height").or(printer.layer_mm.take());
        let width = found("line_width").map(|width| [width.clone(), width]);
        printer.pixel_mm = width.or(printer.pixel_mm.take());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder like Cura's, with a machine that inherits from the one every machine does.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let base = r#"{"name": "FDM Printer Base", "settings": {"machine_settings": {"type": "category", "children": {
            "machine_width": {"default_value": 100}, "machine_depth": {"default_value": 100},
            "machine_nozzle_size": {"default_value": 0.4}}},
            "resolution": {"children": {"layer_height": {"default_value": 0.1},
            "line_width": {"default_value": 0.4, "value": "machine_nozzle_size"}}}}}"#;
        let five = r#"{"name": "Five", "inherits": "base", "overrides": {"machine_width": {"default_value": 330},
            "machine_depth": {"default_value": 240}, "machine_height": {"default_value": 300},
            "line_width": {"value": "round(machine_nozzle_size * 0.875, 3)"}}}"#;
        std::fs::write(folder.path().join("base.def.json"), base).unwrap();
        std::fs::write(folder.path().join("five.def.json"), five).unwrap();
        folder
    }

    const MATERIAL: &str = "<fdmmaterial><metadata><name><brand>Ultimaker</brand><material>ABS</material>\
        <color>Black</color></name></metadata><properties><density>1.10</density><diameter>2.85</diameter></properties></fdmmaterial>";

    #[test]
    fn a_machine_its_materials_and_its_layers_arrive_together() {
        let folder = folder();
        std::fs::write(folder.path().join("abs.xml.fdm_material"), MATERIAL).unwrap();
        std::fs::write(
            folder.path().join("fine.inst.cfg"),
            "[general]\nversion = 4\n[values]\nlayer_height = 0.06\nline_width = 0.35\n",
        )
        .unwrap();
        let files =
            ["five.def.json", "abs.xml.fdm_material", "fine.inst.cfg"].map(|file| folder.path().join(file));
        let all = Imported::read(&files).unwrap();
        let five = all.printer(None).unwrap();
        assert_eq!(five.name, "Five");
        assert_eq!(five.build_volume_mm.as_ref().unwrap().value, [330.0, 240.0, 300.0]);
        assert_eq!(five.layer_mm.as_ref().unwrap().source, "fine.inst.cfg, layer_height");
        assert_eq!(five.pixel_mm.as_ref().unwrap()[0].value, 0.35);
        assert_eq!(
            (all.materials[0].name.as_str(), all.materials[0].density_g_cm3.as_ref().unwrap().value),
            ("Ultimaker ABS", 1.1)
        );
    }

    #[test]
    fn a_formula_is_not_evaluated_and_the_nozzle_stands_for_it() {
        let folder = folder();
        let all = Imported::read(&[folder.path().join("five.def.json")]).unwrap();
        let width = &all.printer(None).unwrap().pixel_mm.as_ref().unwrap()[0];
        assert!(width.value == 0.4 && width.is_computed && width.source.contains("formula"), "{width:?}");
    }

    #[test]
    fn what_is_no_definition_is_told_with_its_place() {
        let folder = tempfile::tempdir().unwrap();
        for (text, words) in [
            ("{\n \"name\": }", "x.def.json:2:"),
            ("{}", "neither settings nor overrides"),
            (r#"{"inherits": "x", "settings": {}}"#, "x.def.json → x.def.json"),
        ] {
            let path = folder.path().join("x.def.json");
            std::fs::write(&path, text).unwrap();
            let error = Imported::read(&[path]).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
