//! Writing of an imported printer with its materials as a profile.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::{Found, Imported, ImportedMaterial, ImportedPrinter};
use crate::printer::Quantity;
use crate::printer::reader::FLOW_RATIO;

/// The comment at the head of an imported profile.
const HEAD: &str = "\
# Made by `equipoise printers import`. Slicers do not know least walls, clearances and cleaning;\n\
# these are defaults of the process until you state them here. To measure them, print coupons and\n\
# run `equipoise printers calibrate`.\n";

impl Imported {
    /// Writes the profile of one of these printers under an id, with every material of its
    /// technology that has a density.
    ///
    /// Implausible numbers ([`Quantity::plausible`]) are left out, as they are placeholders of the
    /// slicer.
    pub fn to_toml(&self, printer: &ImportedPrinter, id: &str) -> String {
        let materials = self.name_materials(printer);
        let mut text = format!(
            "{HEAD}id = \"{id}\"\nname = {}\ninherits = \"{}\"\n",
            string(&printer.name),
            printer.technology.process()
        );
        if !materials.is_empty() {
            let ids: Vec<String> = materials
                .iter()
                .map(|(id, _)| format!("\"{id}\""))
                .collect();
            let default = printer.default_material.as_ref();
            let default = materials
                .iter()
                .find(|(_, material)| Some(&material.name) == default);
            let default = default
                .or(materials.first())
                .map_or("", |(id, _)| id.as_str());
            text += &format!(
                "materials = [{}]\ndefault_material = \"{default}\"\n",
                ids.join(", ")
            );
        }
        if let Some(volume) = &printer.build_volume_mm {
            text += &line("build_volume_mm", &format!("{:?}", volume.value), volume);
        }
        if let Some(dialect) = &printer.dialect {
            text += &line("dialect", &format!("\"{}\"", dialect.value), dialect);
        }
        text += "\n[numbers]\n";
        text += &numbers(printer);
        for (id, material) in &materials {
            text += &material_table(id, material);
        }
        text
    }

    /// Returns the materials of the printer's technology that have a density, with unique ids.
    fn name_materials(&self, printer: &ImportedPrinter) -> Vec<(String, &ImportedMaterial)> {
        let mut used = BTreeSet::new();
        let of_printer = self
            .materials
            .iter()
            .filter(|material| material.technology == printer.technology);
        let with_density = of_printer.filter(|material| material.density_g_cm3.is_some());
        let mut named = Vec::new();
        for material in with_density {
            let plain = slug(&material.name);
            let numbered = (2..).map(|count| format!("{plain}-{count}"));
            let mut ids = std::iter::once(plain.clone()).chain(numbered);
            if let Some(id) = ids.find(|id| used.insert(id.clone())) {
                named.push((id, material));
            }
        }
        named
    }
}

/// Writes the lines of a printer's `[numbers]`.
fn numbers(printer: &ImportedPrinter) -> String {
    let [x, y] = match &printer.pixel_mm {
        Some([x, y]) => [Some(x), Some(y)],
        None => [None, None],
    };
    // The slicer's bounds are left out if its own layer lies beyond them, as in presets for other
    // nozzles.
    let layer = printer.layer_mm.as_ref().map(|layer| layer.value);
    let least = printer.layers_mm[0]
        .as_ref()
        .filter(|least| layer.is_none_or(|layer| least.value <= layer));
    let most = printer.layers_mm[1]
        .as_ref()
        .filter(|most| layer.is_none_or(|layer| most.value >= layer));
    let found = [
        (Quantity::PixelXMm, x),
        (Quantity::PixelYMm, y),
        (Quantity::LayerMm, printer.layer_mm.as_ref()),
        (Quantity::LayerLeastMm, least),
        (Quantity::LayerMostMm, most),
        (Quantity::ElephantFootMm, printer.elephant_foot_mm.as_ref()),
        (Quantity::Perimeters, printer.perimeters.as_ref()),
        (Quantity::SolidLayers, printer.solid_layers.as_ref()),
        (Quantity::InfillOverlapRatio, printer.overlap_ratio.as_ref()),
    ];
    let plausible = found.into_iter().filter_map(|(quantity, found)| {
        let found = found?;
        quantity
            .plausible()
            .contains(&found.value)
            .then(|| line(quantity.key(), &found.value.to_string(), found))
    });
    plausible.collect()
}

fn material_table(id: &str, material: &ImportedMaterial) -> String {
    let density = material.density_g_cm3.as_ref();
    let density = density.map_or_else(String::new, |found| {
        line("density_g_cm3", &found.value.to_string(), found)
    });
    let flow = material.flow_ratio.as_ref();
    let flow = flow.filter(|found| FLOW_RATIO.contains(&found.value));
    let flow = flow.map_or_else(String::new, |found| {
        line("flow_ratio", &found.value.to_string(), found)
    });
    format!(
        "\n[[material]]\nid = \"{id}\"\nname = {}\n{density}{flow}",
        string(&material.name)
    )
}

fn line<T>(key: &str, value: &str, found: &Found<T>) -> String {
    let sure = if found.is_computed {
        "computed"
    } else {
        "read"
    };
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "{key} = {{ value = {value}, source = {}, sure = \"{sure}\" }}",
        string(&found.source)
    );
    text
}

/// Formats a text as a TOML string.
fn string(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Makes an id of a name: lower-case letters, digits and single hyphens; `material` if nothing is
/// left.
pub fn slug(name: &str) -> String {
    let mut slug = String::new();
    for c in name.chars().map(|c| c.to_ascii_lowercase()) {
        if c.is_ascii_alphanumeric() {
            slug.push(c);
        } else if !slug.is_empty() && !slug.ends_with('-') {
            slug.push('-');
        }
    }
    let slug = slug.trim_end_matches('-');
    if slug.is_empty() {
        "material".to_owned()
    } else {
        slug.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::dialect::Dialect;
    use crate::printer::import::Technology;

    fn found<T>(value: T) -> Option<Found<T>> {
        Some(Found {
            value,
            source: "a \"file\", key".into(),
            is_computed: false,
        })
    }

    fn imported() -> (Imported, ImportedPrinter) {
        let printer = ImportedPrinter {
            name: "My & \"own\" printer".into(),
            technology: Technology::Filament,
            pixel_mm: found(0.45).map(|width| [width.clone(), width]),
            layer_mm: found(0.2),
            layers_mm: [found(0.07), found(0.15)],
            build_volume_mm: found([250.0, 210.0, 210.0]),
            elephant_foot_mm: found(0.2),
            perimeters: found(3.0),
            solid_layers: found(5.0),
            overlap_ratio: found(0.2),
            dialect: found(Dialect::Cura),
            default_material: Some("PLA +".into()),
        };
        let material = |name: &str, density: Option<f64>| ImportedMaterial {
            name: name.into(),
            technology: Technology::Filament,
            density_g_cm3: density.and_then(found),
            flow_ratio: found(0.95),
        };
        let materials = vec![
            material("ABS", Some(1.04)),
            material("PLA", Some(1.24)),
            material("PLA +", Some(1.25)),
            material("?", None),
        ];
        (
            Imported {
                materials,
                ..Imported::default()
            },
            printer,
        )
    }

    #[test]
    fn an_imported_profile_loads_with_all_its_numbers_and_their_sources() {
        let (all, printer) = imported();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.toml");
        std::fs::write(&path, all.to_toml(&printer, "mine")).unwrap();
        let mine = crate::printer::Printer::read(&path).unwrap();
        assert_eq!(
            (mine.name.as_str(), mine.pixel_x_mm.value),
            (printer.name.as_str(), 0.45)
        );
        assert_eq!(mine.pixel_x_mm.source, "a \"file\", key");
        assert_eq!(
            mine.number(Quantity::LayerMostMm),
            None,
            "0.15 mm would contradict the layer"
        );
        assert_eq!(mine.dialect(), Dialect::Cura);
        let walls = mine.walls();
        assert_eq!((walls.perimeters, walls.solid_layers), (3, 5));
        assert_eq!(walls.overlap_ratio, 0.2);
        let flow = mine.material(None).unwrap().flow_ratio.as_ref();
        assert_eq!(flow.map(|flow| flow.value), Some(0.95));
        assert_eq!(mine.min_wall_mm.process_default_of.as_deref(), Some("fdm"));
        let ids: Vec<&str> = mine
            .materials
            .iter()
            .map(|material| material.id.as_str())
            .collect();
        assert_eq!(
            ids,
            ["pla-2", "abs", "pla"],
            "the default first; a material without a density is left out"
        );
    }

    #[test]
    fn names_become_ids() {
        assert_eq!(
            slug("Prusament PLA @0.6 nozzle"),
            "prusament-pla-0-6-nozzle"
        );
        assert_eq!(slug("***"), "material");
    }
}
