//! The `.ini` files of PrusaSlicer and SuperSlicer: vendor bundles with many presets, and exported
//! configurations with one of each kind.

use std::collections::BTreeMap;

use super::{
    Found, ImportError, Imported, ImportedMaterial, ImportedPrinter, Technology,
    ini::{FLAT, Ini},
    text::first_number,
};

/// Default width of a line in these slicers over the diameter of the nozzle.
const AUTO_WIDTH_RATIO: f64 = 1.125;
/// The key of a filament's flow.
const FLOW: &str = "extrusion_multiplier";

/// Keys of a section, and its place for sources.
struct Preset {
    place: String,
    values: BTreeMap<String, String>,
}

impl Preset {
    fn of(ini: &Ini, kind: &str, name: &str) -> Result<Self, ImportError> {
        let line = ini.line(kind, name);
        let section = if kind == FLAT {
            String::new()
        } else {
            format!(" line {line} [{kind}:{name}]")
        };
        Ok(Self {
            place: format!("{}{section}", ini.file),
            values: ini.resolve(kind, name)?,
        })
    }

    fn word(&self, key: &str) -> Option<&str> {
        self.values
            .get(key)
            .map(|value| value.trim_matches('"'))
            .filter(|value| !value.is_empty())
    }

    fn number(&self, key: &str) -> Option<Found<f64>> {
        Some(self.with_source(first_number(self.word(key)?)?, key))
    }

    /// Returns a share that is set in per cent.
    fn percent(&self, key: &str) -> Option<Found<f64>> {
        let percent: f64 = self.word(key)?.strip_suffix('%')?.trim().parse().ok()?;
        Some(self.with_source(percent / 100.0, key))
    }

    fn with_source<T>(&self, value: T, key: &str) -> Found<T> {
        Found {
            value,
            source: format!("{}, {key}", self.place),
            is_computed: false,
        }
    }
}

/// Adds the printers and materials of a file to `all`.
pub(super) fn read(file: &str, text: &str, all: &mut Imported) -> Result<(), ImportError> {
    let ini = Ini::parse(file, text)?;
    for name in ini.names("printer") {
        let printer = Preset::of(&ini, "printer", name)?;
        let print = default_print(&ini, &printer)?;
        all.printers.push(import_printer(name, &printer, &print));
    }
    for (kind, key, technology) in [
        ("filament", "filament_density", Technology::Filament),
        ("sla_material", "material_density", Technology::Resin),
    ] {
        for name in ini.names(kind) {
            let preset = Preset::of(&ini, kind, name)?;
            all.materials.push(ImportedMaterial {
                name: name.to_owned(),
                technology,
                density_g_cm3: preset.number(key),
                flow_ratio: preset.number(FLOW),
            });
        }
    }
    if ini.names("printer").is_empty() && !ini.names(FLAT).is_empty() {
        read_flat(&Preset::of(&ini, FLAT, FLAT)?, all);
    }
    Ok(())
}

/// Returns the default print settings of a printer; empty ones if it names none.
fn default_print(ini: &Ini, printer: &Preset) -> Result<Preset, ImportError> {
    let resin = printer
        .word("default_sla_print_profile")
        .map(|name| ("sla_print", name));
    let filament = printer
        .word("default_print_profile")
        .map(|name| ("print", name));
    let chosen = if technology(printer) == Technology::Resin {
        resin
    } else {
        filament
    };
    let known = chosen.filter(|(kind, name)| ini.names(kind).contains(name));
    match known {
        Some((kind, name)) => Preset::of(ini, kind, name),
        None => Ok(Preset {
            place: printer.place.clone(),
            values: BTreeMap::new(),
        }),
    }
}

fn technology(printer: &Preset) -> Technology {
    match printer.word("printer_technology") {
        Some("SLA") => Technology::Resin,
        _ => Technology::Filament,
    }
}

/// Adds the printer and the material of an exported configuration to `all`.
fn read_flat(config: &Preset, all: &mut Imported) {
    let name = config
        .word("printer_settings_id")
        .or(config.word("printer_model"))
        .unwrap_or("Imported printer");
    let printer = import_printer(name, config, config);
    let [key, id, fallback] = match printer.technology {
        Technology::Filament => ["filament_density", "filament_settings_id", "filament_type"],
        Technology::Resin => [
            "material_density",
            "sla_material_settings_id",
            "material_type",
        ],
    };
    let material = config
        .word(id)
        .or(config.word(fallback))
        .unwrap_or("Imported material");
    all.materials.push(ImportedMaterial {
        name: first_name(material).to_owned(),
        technology: printer.technology,
        density_g_cm3: config.number(key),
        flow_ratio: config.number(FLOW),
    });
    all.printers.push(printer);
}

/// Returns the first of several quoted names, which semicolons separate.
fn first_name(names: &str) -> &str {
    names.split(';').next().unwrap_or(names).trim_matches('"')
}

fn import_printer(name: &str, printer: &Preset, print: &Preset) -> ImportedPrinter {
    let technology = technology(printer);
    let elephant_foot_mm = || print.number("elefant_foot_compensation");
    let default_material = match technology {
        Technology::Filament => printer.word("default_filament_profile"),
        Technology::Resin => printer.word("default_sla_material_profile"),
    };
    ImportedPrinter {
        name: name.to_owned(),
        technology,
        pixel_mm: match technology {
            Technology::Filament => line_width(printer, print).map(|width| [width.clone(), width]),
            Technology::Resin => display(printer),
        },
        layer_mm: print.number("layer_height"),
        layers_mm: [
            printer.number("min_layer_height"),
            printer.number("max_layer_height"),
        ],
        build_volume_mm: build_volume(printer),
        elephant_foot_mm: printer
            .number("elefant_foot_compensation")
            .or_else(elephant_foot_mm),
        perimeters: print.number("perimeters"),
        solid_layers: solid_layers(print),
        overlap_ratio: print.percent("infill_overlap"),
        dialect: None,
        default_material: default_material.map(|name| first_name(name).to_owned()),
    }
}

/// Returns the lesser number of solid layers at the top and at the bottom.
fn solid_layers(print: &Preset) -> Option<Found<f64>> {
    let layers = ["top_solid_layers", "bottom_solid_layers"].map(|key| print.number(key));
    let known = layers.into_iter().flatten();
    known.min_by(|a, b| a.value.total_cmp(&b.value))
}

/// Returns the width of a line: as set, in per cent of the layer, or the slicer's default for the
/// nozzle.
fn line_width(printer: &Preset, print: &Preset) -> Option<Found<f64>> {
    let key = "extrusion_width";
    let nozzle = || {
        let nozzle = printer.number("nozzle_diameter")?;
        let source = format!("{}, × {AUTO_WIDTH_RATIO} as no width is set", nozzle.source);
        Some(Found {
            value: AUTO_WIDTH_RATIO * nozzle.value,
            source,
            is_computed: true,
        })
    };
    let Some(word) = print.word(key) else {
        return nozzle();
    };
    match word.strip_suffix('%') {
        None => print.number(key).or_else(nozzle),
        Some(percent) => {
            let layer = print.number("layer_height")?;
            let source = format!("{}, {word} of the layer", print.with_source((), key).source);
            Some(Found {
                value: first_number(percent)? / 100.0 * layer.value,
                source,
                is_computed: true,
            })
        }
    }
}

/// Returns the sizes of a display's pixels along the plate's x and y. A display on its side has its
/// rows along the plate's x.
fn display(printer: &Preset) -> Option<[Found<f64>; 2]> {
    let pitch = |size: &str, pixels: &str| {
        let (length_mm, count) = (printer.number(size)?.value, printer.number(pixels)?.value);
        let source = format!(
            "{}, {length_mm} mm over {count}",
            printer.with_source((), pixels).source
        );
        Some(Found {
            value: length_mm / count,
            source,
            is_computed: true,
        })
    };
    Some([
        pitch("display_width", "display_pixels_x")?,
        pitch("display_height", "display_pixels_y")?,
    ])
}

/// Returns the box over the plate's outline, up to the greatest height.
fn build_volume(printer: &Preset) -> Option<Found<[f64; 3]>> {
    let corners: Vec<[f64; 2]> = printer
        .word("bed_shape")?
        .split(',')
        .filter_map(|corner| {
            let (x, y) = corner.trim().split_once('x')?;
            Some([x.parse().ok()?, y.parse().ok()?])
        })
        .collect();
    let side = |axis: usize| {
        let along = corners.iter().map(|corner| corner[axis]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    let height_mm = printer.number("max_print_height")?.value;
    let volume = [round(side(0)), round(side(1)), height_mm];
    volume
        .iter()
        .all(|side| *side > 0.0 && side.is_finite())
        .then(|| printer.with_source(volume, "bed_shape and max_print_height"))
}

/// Rounds a difference of decimals to a tenth of a micrometre.
fn round(mm: f64) -> f64 {
    const PER_MM: f64 = 1e4;
    (mm * PER_MM).round() / PER_MM
}

#[cfg(test)]
mod tests {
    use super::*;

    const BUNDLE: &str = "\
[vendor]
name = V
[printer:*base*]
bed_shape = 0x0,250x0,250x210,0x210
max_print_height = 210
nozzle_diameter = 0.4,0.4
min_layer_height = 0.07
max_layer_height = 0.25
default_print_profile = Fine
default_filament_profile = \"PLA\"
[printer:Mine]
inherits = *base*
[printer:Wide]
inherits = *base*
nozzle_diameter = 0.8
default_print_profile = Gone
[printer:Vat]
printer_technology = SLA
display_width = 120.96
display_pixels_x = 2560
display_height = 68.04
display_pixels_y = 1440
bed_shape = 1.48x1.02,119.48x1.02,119.48x67.02,1.48x67.02
max_print_height = 150
[print:Fine]
layer_height = 0.15
extrusion_width = 300%
elefant_foot_compensation = 0.2
[filament:PLA]
filament_density = 1.24
[filament:Odd]
filament_density = 0
";

    fn bundle() -> Imported {
        let mut all = Imported::default();
        read("b.ini", BUNDLE, &mut all).unwrap();
        all
    }

    #[test]
    fn lines_layers_plate_and_foot_are_imported_with_their_keys() {
        let all = bundle();
        let mine = all.printer(Some("Mine")).unwrap();
        let width = &mine.pixel_mm.as_ref().unwrap()[0];
        assert!(
            (width.value - 0.45).abs() < 1e-12 && width.is_computed,
            "{width:?}"
        );
        let source = &mine.layer_mm.as_ref().unwrap().source;
        let line = 1 + BUNDLE
            .lines()
            .position(|line| line == "[print:Fine]")
            .unwrap();
        assert_eq!(
            *source,
            format!("b.ini line {line} [print:Fine], layer_height")
        );
        assert_eq!(
            mine.build_volume_mm.as_ref().unwrap().value,
            [250.0, 210.0, 210.0]
        );
        assert_eq!(mine.elephant_foot_mm.as_ref().unwrap().value, 0.2);
        let wide = all.printer(Some("Wide")).unwrap();
        assert!(
            (wide.pixel_mm.as_ref().unwrap()[1].value - 0.9).abs() < 1e-12
                && wide.layer_mm.is_none()
        );
    }

    #[test]
    fn the_pixels_of_a_display_are_its_size_over_its_count() {
        let all = bundle();
        let vat = all.printer(Some("Vat")).unwrap();
        let [x, y] = vat.pixel_mm.as_ref().unwrap();
        assert!((x.value - 0.04725).abs() < 1e-12 && (y.value - 0.04725).abs() < 1e-12);
        assert_eq!(
            vat.build_volume_mm.as_ref().unwrap().value,
            [118.0, 66.0, 150.0]
        );
        assert_eq!(vat.technology, Technology::Resin);
    }

    #[test]
    fn a_density_of_zero_is_unknown() {
        let densities: Vec<Option<f64>> = bundle()
            .materials
            .iter()
            .map(|m| m.density_g_cm3.as_ref().map(|found| found.value))
            .collect();
        assert_eq!(
            densities,
            [None, Some(1.24)],
            "in the order of their names: Odd, PLA"
        );
    }

    #[test]
    fn an_exported_configuration_is_a_printer_and_its_material() {
        let mut all = Imported::default();
        let text = "# generated\nbed_shape = 0x0,180x0,180x180,0x180\nmax_print_height = 180\n\
                    layer_height = 0.2\nextrusion_width = 0.45\nfilament_density = 1.27;1.24\n\
                    extrusion_multiplier = 0.97,1\n\
                    filament_settings_id = \"My PETG\";\"x\"\n\
                    printer_settings_id = Mini of mine\n";
        read("config.ini", text, &mut all).unwrap();
        let only = all.printer(None).unwrap();
        assert_eq!(
            (only.name.as_str(), only.pixel_mm.as_ref().unwrap()[0].value),
            ("Mini of mine", 0.45)
        );
        assert_eq!(all.materials[0].name, "My PETG");
        assert_eq!(all.materials[0].density_g_cm3.as_ref().unwrap().value, 1.27);
        assert_eq!(all.materials[0].flow_ratio.as_ref().unwrap().value, 0.97);
    }

    #[test]
    fn one_of_several_printers_must_be_chosen_by_name() {
        let all = bundle();
        assert!(
            all.printer(None)
                .unwrap_err()
                .to_string()
                .contains("there are 3 printers")
        );
        assert!(
            all.printer(Some("Mime"))
                .unwrap_err()
                .to_string()
                .contains("did you mean `Mine`?")
        );
    }
}
