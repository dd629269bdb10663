//! The materials of a printer: those that its profile lists or inherits, and its own.

use std::collections::BTreeSet;

use super::{
    Material, Problem,
    error::suggest,
    layer::{Layer, Reference},
    library::{Library, by_id, ids},
    profile::MaterialText,
    reader::Reader,
};
use crate::base::toml_text::TextFault;

/// Collects the materials of a profile, the default first: those it lists or inherits, then its
/// own.
pub(super) fn collect_materials(
    library: &Library,
    reader: &mut Reader,
    layer: &Layer,
) -> Result<Vec<Material>, TextFault> {
    let mut found: Vec<Material> = Vec::new();
    note_repeats(reader, layer);
    for listed in layer.materials.iter().flatten() {
        match layer.own_materials.iter().find(|own| own.id == listed.id) {
            Some(own) => found.push(own.clone()),
            None => found.extend(read_built_in(library, reader, listed)?),
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
    move_default_first(reader, &mut found, layer.default_material.as_ref());
    Ok(found)
}

/// Notes materials that are listed or defined twice.
fn note_repeats(reader: &mut Reader, layer: &Layer) {
    let mut seen = BTreeSet::new();
    for Reference { id, at } in layer.materials.iter().flatten() {
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

/// Reads a built-in material; `None` if it is unknown or broken, which `child` notes.
fn read_built_in(
    library: &Library,
    child: &mut Reader,
    Reference { id, at }: &Reference,
) -> Result<Option<Material>, TextFault> {
    let Some(profile) = by_id(library.materials, id) else {
        let problem = Problem::UnknownMaterial {
            id: id.clone(),
            remedy: suggest(id, &ids(library.materials)),
        };
        child.note(*at, problem);
        return Ok(None);
    };
    let mut reader = Reader::new(profile.file, profile.text);
    let text: MaterialText = reader.parse()?;
    let material = reader.material(&text);
    child.faults.append(&mut reader.faults);
    Ok(material)
}

/// Moves the default material to the front; notes a default that is not there.
fn move_default_first(
    reader: &mut Reader,
    materials: &mut [Material],
    default: Option<&Reference>,
) {
    let Some(Reference { id, at }) = default else {
        return;
    };
    match materials.iter().position(|material| material.id == *id) {
        Some(place) => materials[..=place].rotate_right(1),
        None => {
            let known: Vec<&str> = materials
                .iter()
                .map(|material| material.id.as_str())
                .collect();
            let known = known.join(", ");
            reader.note(
                *at,
                Problem::DefaultNotListed {
                    id: id.clone(),
                    known,
                },
            );
        }
    }
}
