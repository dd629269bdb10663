//! A profile of any kind: a cutter, a sheet or a file of fasteners, told apart by its keys.

use std::path::Path;

use serde::Serialize;

use super::error::{ProfileError, suggest};
use super::fastener::Fastener;
use super::library::{CUTTERS, FASTENERS, SHEETS, by_id, ids, is_path, read_text};
use super::machine::Cutter;
use super::stock::StockSheet;

/// A profile of any kind.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum AnyProfile {
    /// A cutter.
    Cutter(Box<Cutter>),
    /// A sheet.
    Sheet(Box<StockSheet>),
    /// Fasteners.
    Fasteners(Vec<Fastener>),
}

/// The kinds of profiles.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Cutter,
    Sheet,
    Fasteners,
}

/// The keys that only sheets have.
const SHEET_KEYS: [&str; 6] = [
    "material",
    "thickness_mm",
    "thickness_range_mm",
    "density_g_cm3",
    "grain",
    "size",
];
/// The keys that only fasteners have.
const FASTENER_KEYS: [&str; 2] = ["part", "mass"];

impl AnyProfile {
    /// Finds the built-in cutter, sheet, fastener or family of fasteners of that id, or reads the
    /// profile in a file.
    pub fn find(id_or_path: &str) -> Result<Self, ProfileError> {
        let id = id_or_path;
        if by_id(CUTTERS.profiles, id).is_some() {
            return Ok(Self::Cutter(Box::new(Cutter::find(id)?)));
        }
        if by_id(SHEETS.profiles, id).is_some() {
            return Ok(Self::Sheet(Box::new(StockSheet::find(id)?)));
        }
        let path = Path::new(id);
        if is_path(id) || path.is_file() {
            return Self::read(path);
        }
        let fasteners = Fastener::all()?;
        let found = fasteners.iter().filter(|fastener| fastener.id == id);
        let found: Vec<Fastener> = found.cloned().collect();
        if found.is_empty() {
            return Err(unknown(id, &fasteners));
        }
        Ok(Self::Fasteners(found))
    }

    /// Reads the profile in a file; its keys tell the kind.
    pub fn read(path: &Path) -> Result<Self, ProfileError> {
        Ok(match kind_of(&read_text(path)?) {
            Kind::Cutter => Self::Cutter(Box::new(Cutter::read(path)?)),
            Kind::Sheet => Self::Sheet(Box::new(StockSheet::read(path)?)),
            Kind::Fasteners => Self::Fasteners(Fastener::read(path)?),
        })
    }
}

fn unknown(id: &str, fasteners: &[Fastener]) -> ProfileError {
    let fasteners = fasteners.iter().map(|fastener| fastener.id.as_str());
    let known = CUTTERS.ids().into_iter().chain(SHEETS.ids());
    let known: Vec<&str> = known.chain(fasteners).collect();
    ProfileError::Unknown {
        kind: "cutter, sheet or fastener",
        id: id.to_owned(),
        remedy: suggest(id, &known),
    }
}

/// Returns the kind of a profile by its keys, or by its parent; a cutter if neither tells.
fn kind_of(text: &str) -> Kind {
    let Ok(table) = text.parse::<toml::Table>() else {
        return Kind::Cutter;
    };
    let has = |keys: &[&str]| keys.iter().any(|key| table.contains_key(*key));
    let parent = table.get("inherits").and_then(|parent| parent.as_str());
    let inherits = |ids: &[&str]| parent.is_some_and(|parent| ids.contains(&parent));
    if has(&FASTENER_KEYS) || inherits(&ids(FASTENERS)) {
        Kind::Fasteners
    } else if has(&SHEET_KEYS) || inherits(&SHEETS.parent_ids()) {
        Kind::Sheet
    } else {
        Kind::Cutter
    }
}
