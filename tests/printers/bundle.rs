//! Debian's bundle of PrusaSlicer profiles, imported and compared with a reader of our own.

use std::collections::BTreeMap;
use std::fs;

use equipoise::printer::Printer;
use equipoise::printer::import::{Imported, ImportedPrinter, Technology};

/// The bundle that Debian's prusa-slicer ships.
const BUNDLE: &str = "/usr/share/PrusaSlicer/profiles/PrusaResearch.ini";

/// The families of printers that become profiles. Writing all of them takes too long.
const FAMILIES: [&str; 3] = ["MK3S", "MK4", "SL1"];

/// The keys and values of every section of an INI file.
type Sections<'a> = BTreeMap<&'a str, Vec<(&'a str, &'a str)>>;

fn read_sections(text: &str) -> Sections<'_> {
    let mut sections = Sections::new();
    let mut current = "";
    for line in text.lines().filter(|line| !line.starts_with(['#', ';'])) {
        let inside = line
            .strip_prefix('[')
            .and_then(|rest| rest.strip_suffix(']'));
        let pair = line.split_once('=').filter(|_| inside.is_none());
        current = inside.unwrap_or(current);
        let section = sections.entry(current).or_default();
        section.extend(pair.map(|(key, value)| (key.trim(), value.trim())));
    }
    sections
}

/// Finds the value of a key in a preset: its own, or that of its parents from the last to the
/// first.
fn find_value<'a>(sections: &Sections<'a>, [kind, name]: [&str; 2], key: &str) -> Option<&'a str> {
    let own = sections[format!("{kind}:{name}").as_str()].iter().rev();
    let find = |key: &str| {
        own.clone()
            .find(|(own, _)| *own == key)
            .map(|(_, value)| *value)
    };
    let parents = find("inherits").unwrap_or_default().split(';').rev();
    let mut parents = parents.map(str::trim).filter(|name| !name.is_empty());
    let above = || parents.find_map(|parent| find_value(sections, [kind, parent], key));
    find(key).or_else(above)
}

/// The value of a key in every preset of a kind, read by code that shares nothing with the
/// program's.
fn values(text: &str, kind: &str, key: &str) -> BTreeMap<String, String> {
    let sections = read_sections(text);
    let prefix = format!("{kind}:");
    let names = sections
        .keys()
        .filter_map(|name| name.strip_prefix(&prefix));
    let value = |name: &str| {
        let value = find_value(&sections, [kind, name], key)?;
        Some((name.to_owned(), value.to_owned()))
    };
    names
        .filter(|name| !name.starts_with('*'))
        .filter_map(value)
        .collect()
}

/// The bundle's text; `None`, with a message, if it is not installed.
fn read_bundle() -> Option<String> {
    let text = fs::read_to_string(BUNDLE).ok();
    if text.is_none() {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no {BUNDLE} here; {install}");
    }
    text
}

#[test]
fn every_filament_of_the_bundle_arrives_with_its_density() {
    let Some(text) = read_bundle() else { return };
    let all = Imported::read(&[BUNDLE.into()]).unwrap();
    let densities = values(&text, "filament", "filament_density");
    let materials = all.materials.iter();
    let filaments: Vec<_> = materials
        .filter(|m| m.technology == Technology::Filament)
        .collect();
    assert_eq!(filaments.len(), densities.len());
    for material in filaments {
        let first = densities[&material.name].split(',').next().unwrap();
        let found = material
            .density_g_cm3
            .as_ref()
            .map_or(0.0, |found| found.value);
        assert_eq!(found, first.parse::<f64>().unwrap(), "{}", material.name);
    }
}

#[test]
fn every_printer_of_the_bundle_becomes_a_profile_of_its_height() {
    let Some(text) = read_bundle() else { return };
    let all = Imported::read(&[BUNDLE.into()]).unwrap();
    let heights = values(&text, "printer", "max_print_height");
    assert_eq!(all.printers.len(), heights.len());
    let densities = values(&text, "filament", "filament_density");
    let is_weighed = |density: &&String| density.parse::<f64>().unwrap() > 0.0;
    let weighed = densities.values().filter(is_weighed).count();
    for family in FAMILIES {
        let is_member = |printer: &&ImportedPrinter| printer.name.contains(family);
        let printers: Vec<&ImportedPrinter> = all.printers.iter().filter(is_member).collect();
        match printers.len() {
            0 => eprintln!("SKIPPED: this bundle has no {family}"),
            count => eprintln!("{count} printers {family}"),
        }
        for printer in printers {
            let profile = import(&all, printer);
            let height = profile.build_volume_mm.as_ref().unwrap().value[2];
            assert_eq!(
                height.to_string(),
                heights[&printer.name],
                "{}",
                printer.name
            );
            if printer.technology == Technology::Filament {
                assert_eq!(profile.materials.len(), weighed, "{}", printer.name);
            }
        }
    }
}

/// Writes a printer as a profile and reads it again. It must have its own pixels and layers.
fn import(all: &Imported, printer: &ImportedPrinter) -> Printer {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("imported.toml");
    fs::write(&path, all.to_toml(printer, "imported")).unwrap();
    let profile = Printer::read(&path).unwrap_or_else(|error| panic!("{}: {error}", printer.name));
    let numbers = profile.numbers();
    for key in ["pixel_x_mm", "pixel_y_mm", "layer_mm"] {
        let is_own = |q: &str, is_default: bool| q == key && !is_default;
        let mut numbers = numbers.iter();
        let has_own = numbers.any(|(q, n)| is_own(q.key(), n.process_default_of.is_some()));
        assert!(has_own, "{}: {key}", printer.name);
    }
    profile
}
