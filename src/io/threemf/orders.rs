//! Reads what a package orders of slicers: the settings of its objects, and their volumes.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::archive::Archive;
use super::cura::CURA_PREFIX;
use super::error::ThreeMfError;
use super::orca::ORCA_PART;
use super::read::{Content, Model, Object, read_model};
use super::settings::PRUSA_PART;
use super::words::Words;
use super::write::PRUSA_VERSION;
use super::xml::{Requirement, Scanner, Tag};
use crate::base::dialect::Dialect;

/// Settings by their names, as text. Of a name that is there twice, the last counts, as for the
/// slicer.
pub type Orders = BTreeMap<String, String>;

/// What a package orders of the slicers of one family.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SlicerOrders {
    /// The dialect in which it orders.
    pub dialect: Dialect,
    /// True if all volumes of an object go to its place. In files of the first version the slicer
    /// moves the first volume alone.
    pub moves_volumes: bool,
    /// The objects, by their identifiers in the package.
    pub objects: BTreeMap<u32, ObjectOrders>,
}

/// What a package orders for one object.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObjectOrders {
    /// The settings of the whole object.
    pub settings: Orders,
    /// Its volumes. Where they overlap, the slicer takes the later one.
    pub volumes: Vec<VolumeOrders>,
}

/// What a package orders for a volume of an object.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct VolumeOrders {
    /// The object of the package that it is; `None` if it is a run of triangles.
    pub object: Option<u32>,
    /// The triangles that bound it, by their places in the object's mesh.
    pub triangles: Range<usize>,
    /// Its settings.
    pub settings: Orders,
}

const ID: Requirement = Requirement {
    element: "object",
    attribute: "id",
    expected: "a number from 1 on",
};
const PART: Requirement = Requirement {
    element: "part",
    attribute: "id",
    expected: "a number from 1 on",
};
/// The attribute of a part that says what it is.
const ORCA_KIND: &str = "subtype";
const TRIANGLES: [Requirement; 2] = [
    Requirement {
        element: "volume",
        attribute: "firstid",
        expected: "the number of a triangle",
    },
    Requirement {
        element: "volume",
        attribute: "lastid",
        expected: "the number of a triangle",
    },
];

/// Reads what a package orders of slicers, in every dialect that it has.
///
/// # Errors
/// The bytes are no package, or its orders cannot be read.
pub fn decode_orders(bytes: &[u8]) -> Result<Vec<SlicerOrders>, ThreeMfError> {
    let mut archive = Archive::open(bytes)?;
    let root = archive.root_part()?;
    let text = archive.text(&root)?;
    let mut all = Vec::new();
    if let Some(orders) = text_of(&mut archive, PRUSA_PART)? {
        all.push(SlicerOrders {
            dialect: Dialect::Prusa,
            moves_volumes: has_version(&root, &text)?,
            objects: read_objects(PRUSA_PART, &orders)?,
        });
    }
    if let Some(orders) = text_of(&mut archive, ORCA_PART)? {
        let mut objects = read_objects(ORCA_PART, &orders)?;
        // The model of a large part takes its time, and parts without regions need none.
        if objects.values().any(|object| !object.volumes.is_empty()) {
            let model = read_model(&root, &text)?;
            let own = objects.values_mut();
            own.for_each(|object| number_triangles(object, &model));
        }
        all.push(SlicerOrders {
            dialect: Dialect::Orca,
            moves_volumes: true,
            objects,
        });
    }
    if text.contains(CURA_PREFIX) {
        let objects = cura_objects(&read_model(&root, &text)?);
        // A name may have the prefix, too.
        if objects.values().any(|object| !object.settings.is_empty()) {
            all.push(SlicerOrders {
                dialect: Dialect::Cura,
                moves_volumes: true,
                objects,
            });
        }
    }
    Ok(all)
}

/// Returns the objects of a package that are regions of other infill within their object, in the
/// words of OrcaSlicer or of Cura.
pub(super) fn find_regions(
    archive: &mut Archive,
    models: &BTreeMap<String, Model>,
) -> Result<BTreeSet<u32>, ThreeMfError> {
    let [orca, cura] = [Dialect::Orca, Dialect::Cura].map(Words::of);
    let objects = models.values().flat_map(|model| &model.objects);
    let is_region = |object: &Object| {
        object
            .settings
            .get(cura.kind)
            .is_some_and(|it| it == cura.modifier)
    };
    let mut regions: BTreeSet<u32> = objects
        .filter(|(_, object)| is_region(object))
        .map(|(id, _)| *id)
        .collect();
    let Some(text) = text_of(archive, ORCA_PART)? else {
        return Ok(regions);
    };
    let objects = read_objects(ORCA_PART, &text)?;
    let volumes = objects.values().flat_map(|object| &object.volumes);
    let volumes = volumes.filter(|it| stated(&it.settings, orca.kind) == Some(orca.modifier));
    regions.extend(volumes.filter_map(|volume| volume.object));
    Ok(regions)
}

fn stated<'a>(settings: &'a Orders, key: &str) -> Option<&'a str> {
    settings.get(key).map(String::as_str)
}

/// Returns the text of a part; `None` if there is no such part.
fn text_of(archive: &mut Archive, part: &str) -> Result<Option<String>, ThreeMfError> {
    match archive.text(part) {
        Err(ThreeMfError::NoModel { .. }) => Ok(None),
        text => text.map(Some),
    }
}

/// Gives the volumes of an object the triangles of the objects that they are, one after the other.
fn number_triangles(object: &mut ObjectOrders, model: &Model) {
    let mut next = 0;
    for volume in &mut object.volumes {
        let own = volume.object.and_then(|id| model.objects.get(&id));
        let end = next + own.map_or(0, count_triangles);
        volume.triangles = next..end;
        next = end;
    }
}

fn count_triangles(object: &Object) -> usize {
    match &object.content {
        Content::Mesh(mesh) => mesh.triangles().len(),
        Content::Components(_) => 0,
    }
}

/// Returns what a package orders of Cura for the objects of its build. Those of the first piece of
/// an object are those of the object.
fn cura_objects(model: &Model) -> BTreeMap<u32, ObjectOrders> {
    let placed = model.items.iter().map(|item| item.object);
    let placed = placed.filter_map(|id| Some((id, model.objects.get(&id)?)));
    let orders = placed.map(|(id, object)| match &object.content {
        Content::Mesh(_) => {
            let settings = object.settings.clone();
            let volumes = Vec::new();
            (id, ObjectOrders { settings, volumes })
        }
        Content::Components(components) => {
            let pieces = components.iter().map(|component| component.object);
            let volume = |id: u32| VolumeOrders {
                object: Some(id),
                triangles: 0..0,
                settings: model
                    .objects
                    .get(&id)
                    .map_or_else(Orders::new, |it| it.settings.clone()),
            };
            let mut volumes: Vec<VolumeOrders> = pieces.map(volume).collect();
            let body = volumes.first_mut();
            let settings = body.map_or_else(Orders::new, |body| std::mem::take(&mut body.settings));
            let mut orders = ObjectOrders { settings, volumes };
            number_triangles(&mut orders, model);
            (id, orders)
        }
    });
    orders.collect()
}

/// Returns whether a model states the version from which the slicer moves all volumes.
fn has_version(part: &str, text: &str) -> Result<bool, ThreeMfError> {
    let mut scanner = Scanner::new(part, text);
    while let Some(tag) = scanner.next_tag()? {
        match tag.name() {
            // The metadata comes first; meshes are long.
            "resources" => break,
            "metadata" if tag.get("name")?.as_deref() == Some(PRUSA_VERSION[0]) => {
                let version = scanner.text();
                return Ok(version.trim().parse::<u32>().is_ok_and(|it| it > 0));
            }
            _ => {}
        }
    }
    Ok(false)
}

/// Reads the objects in a part of settings, in PrusaSlicer's words or OrcaSlicer's.
fn read_objects(part: &str, text: &str) -> Result<BTreeMap<u32, ObjectOrders>, ThreeMfError> {
    let mut scanner = Scanner::new(part, text);
    let mut objects = BTreeMap::new();
    while let Some(tag) = scanner.next_tag()? {
        if tag.name() != "object" {
            continue;
        }
        let id: u32 = tag.number(&ID)?;
        let mut object = ObjectOrders::default();
        scanner.children(&tag, |scanner, tag| match tag.name() {
            "metadata" => {
                add(&mut object.settings, &tag)?;
                scanner.skip(&tag)
            }
            "volume" => {
                let [first, last] = &TRIANGLES;
                let (first, last): (u32, u32) = (tag.number(first)?, tag.number(last)?);
                object.volumes.push(VolumeOrders {
                    object: None,
                    triangles: first as usize..last as usize + 1,
                    settings: read_settings(scanner, &tag)?,
                });
                Ok(())
            }
            "part" => {
                let kind = tag.get(ORCA_KIND)?.unwrap_or_default().into_owned();
                let own = tag.number(&PART)?;
                let mut settings = read_settings(scanner, &tag)?;
                settings.insert(ORCA_KIND.to_owned(), kind);
                object.volumes.push(VolumeOrders {
                    object: Some(own),
                    triangles: 0..0,
                    settings,
                });
                Ok(())
            }
            _ => scanner.skip(&tag),
        })?;
        if objects.insert(id, object).is_some() {
            let part = part.to_owned();
            return Err(ThreeMfError::Twice { part, object: id });
        }
    }
    Ok(objects)
}

/// Reads the settings within the element that was just opened.
fn read_settings(scanner: &mut Scanner, opened: &Tag) -> Result<Orders, ThreeMfError> {
    let mut settings = Orders::new();
    scanner.children(opened, |scanner, tag| {
        if tag.name() == "metadata" {
            add(&mut settings, &tag)?;
        }
        scanner.skip(&tag)
    })?;
    Ok(settings)
}

/// Adds a setting; passes over one without a name.
fn add(settings: &mut Orders, tag: &Tag) -> Result<(), ThreeMfError> {
    if let Some(key) = tag.get("key")? {
        let value = tag.get("value")?.unwrap_or_default();
        settings.insert(key.into_owned(), value.into_owned());
    }
    Ok(())
}
