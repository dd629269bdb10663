//! Reads what a package orders of PrusaSlicer: the settings of its objects, and their volumes.

use std::collections::BTreeMap;
use std::ops::Range;

use super::archive::Archive;
use super::error::ThreeMfError;
use super::settings::PRUSA_PART;
use super::write::PRUSA_VERSION;
use super::xml::{Requirement, Scanner, Tag};
use crate::base::dialect::Dialect;

/// Settings by their names, as text. Of a name that is there twice, the last counts, as for the
/// slicer.
pub type Orders = BTreeMap<String, String>;

/// What a package orders of PrusaSlicer.
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

/// Reads what a package orders of PrusaSlicer; `None` if it orders nothing.
///
/// # Errors
/// The bytes are no package, or its orders cannot be read.
pub fn decode_orders(bytes: &[u8]) -> Result<Option<SlicerOrders>, ThreeMfError> {
    let mut archive = Archive::open(bytes)?;
    let text = match archive.text(PRUSA_PART) {
        Err(ThreeMfError::NoModel { .. }) => return Ok(None),
        text => text?,
    };
    let objects = read_objects(&text)?;
    let root = archive.root_part()?;
    let moves_volumes = has_version(&root, &archive.text(&root)?)?;
    Ok(Some(SlicerOrders {
        dialect: Dialect::Prusa,
        moves_volumes,
        objects,
    }))
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

fn read_objects(text: &str) -> Result<BTreeMap<u32, ObjectOrders>, ThreeMfError> {
    let mut scanner = Scanner::new(PRUSA_PART, text);
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
                object.volumes.push(read_volume(scanner, &tag)?);
                Ok(())
            }
            _ => scanner.skip(&tag),
        })?;
        if objects.insert(id, object).is_some() {
            let part = PRUSA_PART.to_owned();
            return Err(ThreeMfError::Twice { part, object: id });
        }
    }
    Ok(objects)
}

fn read_volume(scanner: &mut Scanner, tag: &Tag) -> Result<VolumeOrders, ThreeMfError> {
    let [first, last] = &TRIANGLES;
    let (first, last): (u32, u32) = (tag.number(first)?, tag.number(last)?);
    let mut settings = Orders::new();
    scanner.children(tag, |scanner, tag| {
        if tag.name() == "metadata" {
            add(&mut settings, &tag)?;
        }
        scanner.skip(&tag)
    })?;
    Ok(VolumeOrders {
        triangles: first as usize..last as usize + 1,
        settings,
    })
}

/// Adds a setting; passes over one without a name.
fn add(settings: &mut Orders, tag: &Tag) -> Result<(), ThreeMfError> {
    if let Some(key) = tag.get("key")? {
        let value = tag.get("value")?.unwrap_or_default();
        settings.insert(key.into_owned(), value.into_owned());
    }
    Ok(())
}
