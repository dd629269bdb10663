//! Cura's definitions: machines (`.def.json`, each of which inherits from another file of its
//! folder), materials (`.xml.fdm_material`) and layers (`.inst.cfg`).

use std::{collections::BTreeMap, path::Path};

use serde_json::Value;

use super::{
    Found, ImportError, Imported, ImportedMaterial, ImportedPrinter, Technology,
    formula::{Setting, evaluate},
    ini::Ini,
    text::{self, first_number},
};
use crate::base::dialect::Dialect;
use crate::base::toml_text::Place;

/// Ending of the file name of a definition.
const ENDING: &str = ".def.json";

/// Settings by name, each with its file.
type Settings = BTreeMap<String, (Setting, String)>;

/// Adds the machine of a definition to `all`.
pub(super) fn read_definition(
    path: &Path,
    text: &str,
    all: &mut Imported,
) -> Result<(), ImportError> {
    let mut settings = Settings::new();
    let name = collect(path, text, &mut settings, &mut Vec::new())?;
    let width = find_number(&settings, "line_width").or_else(|| nozzle(&settings));
    all.printers.push(ImportedPrinter {
        name,
        technology: Technology::Filament,
        pixel_mm: width.map(|width| [width.clone(), width]),
        layer_mm: find_number(&settings, "layer_height"),
        layers_mm: [None, None],
        build_volume_mm: build_volume(&settings),
        elephant_foot_mm: None,
        // Its formulas ask for more of Cura's settings than widths and layers do.
        perimeters: None,
        solid_layers: None,
        overlap_ratio: None,
        dialect: Some(Found {
            value: Dialect::Cura,
            source: format!("{} is a definition of Cura's", name_of(path)),
            is_computed: false,
        }),
        default_material: None,
    });
    Ok(())
}

/// Returns the name of a file.
fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// Returns the number of a setting, read or computed from its formula; `None` if it is missing or
/// not positive.
fn find_number(settings: &Settings, key: &str) -> Option<Found<f64>> {
    let (setting, file) = settings.get(key)?;
    let named = |name: &str| settings.get(name).map(|(setting, _)| setting);
    let (value, how, is_computed) = match setting {
        Setting::Number(number) => (*number, String::new(), false),
        Setting::Formula(formula) => (evaluate(formula, &named)?, format!(" = {formula}"), true),
    };
    let is_positive = value.is_finite() && value > 0.0;
    is_positive.then(|| Found {
        value,
        source: format!("{file}, {key}{how}"),
        is_computed,
    })
}

/// Returns the diameter of the nozzle, which replaces a line width of an unsupported formula.
fn nozzle(settings: &Settings) -> Option<Found<f64>> {
    let nozzle = find_number(settings, "machine_nozzle_size")?;
    let source = format!(
        "{}, as the line width is a formula of another kind",
        nozzle.source
    );
    Some(Found {
        source,
        is_computed: true,
        ..nozzle
    })
}

fn build_volume(settings: &Settings) -> Option<Found<[f64; 3]>> {
    let side = |key: &str| find_number(settings, key);
    let sides = [
        side("machine_width")?,
        side("machine_depth")?,
        side("machine_height")?,
    ];
    let source = format!("{}, machine_depth and machine_height", sides[0].source);
    Some(Found {
        value: sides.map(|side| side.value),
        source,
        is_computed: false,
    })
}

/// Gathers the settings of a definition over the inherited ones; returns its name.
fn collect(
    path: &Path,
    text: &str,
    into: &mut Settings,
    heirs: &mut Vec<String>,
) -> Result<String, ImportError> {
    let file = name_of(path);
    if heirs.contains(&file) {
        let place = Place {
            file: file.clone(),
            line: 1,
            column: 1,
        };
        return Err(ImportError::Cycle {
            place,
            chain: heirs.join(" → ") + " → " + &file,
        });
    }
    heirs.push(file.clone());
    let definition = parse(&file, text)?;
    if let Some(parent) = definition["inherits"].as_str() {
        let above = path.with_file_name(format!("{parent}{ENDING}"));
        collect(&above, &text::read(&above)?, into, heirs)?;
    }
    gather(&definition["settings"], &file, into);
    gather(&definition["overrides"], &file, into);
    Ok(definition["name"]
        .as_str()
        .unwrap_or(file.trim_end_matches(ENDING))
        .to_owned())
}

/// Parses a definition.
fn parse(file: &str, text: &str) -> Result<Value, ImportError> {
    let fault = |line: usize, column: usize, message: String| ImportError::Json {
        file: file.to_owned(),
        line,
        column,
        message,
    };
    let value: Value = serde_json::from_str(text)
        .map_err(|error| fault(error.line(), error.column(), error.to_string()))?;
    let is_definition = value["inherits"].is_string()
        || value["settings"].is_object()
        || value["overrides"].is_object();
    if is_definition {
        Ok(value)
    } else {
        let message = "it neither inherits nor has settings or overrides";
        Err(fault(1, 1, message.to_owned()))
    }
}

/// Gathers the numbers and formulas of settings and of their children. A formula takes precedence
/// over a default value.
fn gather(settings: &Value, file: &str, into: &mut Settings) {
    for (key, setting) in settings.as_object().into_iter().flatten() {
        let formula = setting["value"]
            .as_str()
            .map(|text| Setting::Formula(text.to_owned()));
        let number = setting["value"]
            .as_f64()
            .or_else(|| setting["default_value"].as_f64());
        // As in Cura: a default value does not replace the formula of a parent.
        let keeps_formula =
            setting["value"].is_null() && matches!(into.get(key), Some((Setting::Formula(_), _)));
        if let Some(found) = formula
            .or(number.map(Setting::Number))
            .filter(|_| !keeps_formula)
        {
            into.insert(key.clone(), (found, file.to_owned()));
        }
        gather(&setting["children"], file, into);
    }
}

/// Adds a material to `all`; its name is made of brand and material.
pub(super) fn read_material(file: &str, text: &str, all: &mut Imported) {
    let name = element(text, "name").map_or_else(String::new, str::to_owned);
    let words: Vec<&str> = ["brand", "material"]
        .iter()
        .filter_map(|tag| element(&name, tag))
        .filter(|w| !w.is_empty())
        .collect();
    let density = element(text, "density").and_then(first_number);
    all.materials.push(ImportedMaterial {
        name: if words.is_empty() {
            file.to_owned()
        } else {
            words.join(" ")
        },
        technology: Technology::Filament,
        density_g_cm3: density.map(|value| Found {
            value,
            source: format!("{file}, density"),
            is_computed: false,
        }),
        flow_ratio: None,
    });
}

/// Returns the text of the first element of a tag; `None` if there is none.
fn element<'a>(text: &'a str, tag: &str) -> Option<&'a str> {
    let (_, after) = text.split_once(&format!("<{tag}>"))?;
    let (inside, _) = after.split_once(&format!("</{tag}>"))?;
    Some(inside.trim())
}

/// Sets the layer height and the line width of all printers from a quality file.
pub(super) fn read_layer(file: &str, text: &str, all: &mut Imported) -> Result<(), ImportError> {
    let values = Ini::parse(file, text)?.resolve("values", "")?;
    let find = |key: &str| {
        let value = first_number(values.get(key)?)?;
        Some(Found {
            value,
            source: format!("{file}, {key}"),
            is_computed: false,
        })
    };
    for printer in &mut all.printers {
        printer.layer_mm = find("layer_height").or(printer.layer_mm.take());
        let width = find("line_width").map(|width| [width.clone(), width]);
        printer.pixel_mm = width.or(printer.pixel_mm.take());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder like Cura's, with a machine that inherits from a base machine.
    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let base = r#"{"name": "FDM Printer Base", "settings": {
            "machine_settings": {"type": "category", "children": {
            "machine_width": {"default_value": 100}, "machine_depth": {"default_value": 100},
            "machine_nozzle_size": {"default_value": 0.4}}},
            "resolution": {"children": {"layer_height": {"default_value": 0.1},
            "line_width": {"default_value": 0.4, "value": "machine_nozzle_size"}}}}}"#;
        let five = r#"{"name": "Five", "inherits": "base", "overrides": {
            "machine_width": {"default_value": 330},
            "machine_depth": {"default_value": 240}, "machine_height": {"default_value": 300},
            "line_width": {"value": "round(machine_nozzle_size * 0.875, 3)"}}}"#;
        std::fs::write(folder.path().join("base.def.json"), base).unwrap();
        std::fs::write(folder.path().join("five.def.json"), five).unwrap();
        folder
    }

    const MATERIAL: &str = "<fdmmaterial><metadata><name>\
        <brand>Ultimaker</brand><material>ABS</material><color>Black</color></name></metadata>\
        <properties><density>1.10</density><diameter>2.85</diameter></properties></fdmmaterial>";

    #[test]
    fn a_machine_its_materials_and_its_layers_are_imported_together() {
        let folder = folder();
        std::fs::write(folder.path().join("abs.xml.fdm_material"), MATERIAL).unwrap();
        std::fs::write(
            folder.path().join("fine.inst.cfg"),
            "[general]\nversion = 4\n[values]\nlayer_height = 0.06\nline_width = 0.35\n",
        )
        .unwrap();
        let files = ["five.def.json", "abs.xml.fdm_material", "fine.inst.cfg"]
            .map(|file| folder.path().join(file));
        let all = Imported::read(&files).unwrap();
        let five = all.printer(None).unwrap();
        assert_eq!(five.name, "Five");
        assert_eq!(
            five.build_volume_mm.as_ref().unwrap().value,
            [330.0, 240.0, 300.0]
        );
        assert_eq!(
            five.layer_mm.as_ref().unwrap().source,
            "fine.inst.cfg, layer_height"
        );
        assert_eq!(five.pixel_mm.as_ref().unwrap()[0].value, 0.35);
        assert_eq!(
            (
                all.materials[0].name.as_str(),
                all.materials[0].density_g_cm3.as_ref().unwrap().value
            ),
            ("Ultimaker ABS", 1.1)
        );
    }

    #[test]
    fn a_formula_is_evaluated_and_the_nozzle_replaces_an_unsupported_one() {
        let folder = folder();
        let path = folder.path().join("five.def.json");
        let width = |path: &Path| {
            let all = Imported::read(&[path.to_owned()]).unwrap();
            all.printer(None).unwrap().pixel_mm.clone().unwrap()[0].clone()
        };
        assert!(
            width(&path).value == 0.35 && width(&path).is_computed,
            "{:?}",
            width(&path)
        );
        let odd = std::fs::read_to_string(&path)
            .unwrap()
            .replace("round(", "max(");
        std::fs::write(&path, odd).unwrap();
        assert!(
            width(&path).value == 0.4 && width(&path).source.contains("another kind"),
            "{:?}",
            width(&path)
        );
    }

    #[test]
    fn a_file_that_is_no_definition_is_reported_with_its_place() {
        let folder = tempfile::tempdir().unwrap();
        for (text, words) in [
            ("{\n \"name\": }", "x.def.json:2:"),
            ("{}", "neither inherits nor has settings"),
            (
                r#"{"inherits": "x", "settings": {}}"#,
                "x.def.json → x.def.json",
            ),
        ] {
            let path = folder.path().join("x.def.json");
            std::fs::write(&path, text).unwrap();
            let error = Imported::read(&[path]).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
