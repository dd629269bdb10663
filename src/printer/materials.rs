//! The materials a printer's profile offers: those it lists or inherits, and its own.

use std::collections::BTreeSet;

use super::{
    Material, Problem,
    error::suggestion,
    layer::{Layer, Reference},
    library::{Library, by_id, ids},
    profile::{MaterialText, Reader},
};
use crate::base::toml_text::TextFault;

/// The materials of the profile, its default first: those it lists or inherits, and its own.
pub(super) fn materials(
    library: &Library,
    reader: &mut Reader,
    layer: &Layer,
) -> Result<Vec<Material>, TextFault> {
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
        child.note(
            at,
            Problem::UnknownMaterial {
                id: id.to_owned(),
                remedy,
            },
        );
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
