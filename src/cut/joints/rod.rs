//! Dowels: loose pins cut from stock rods, with a socket on either side of the joint.

use serde::{Deserialize, Serialize};

use crate::{base::toml_text, cut::error::CutError, printer::Sure};

/// A dowel of a plan: what it is cut from, and how long.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dowel {
    /// The rod it is cut from, such as `beech-4`.
    pub rod: String,
    /// How long it is cut, mm: its middle lies in the cut.
    pub length_mm: f64,
    /// g/cm³.
    pub density_g_cm3: f64,
}

/// Where a number is from.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RodSource {
    /// The source, in words.
    pub source: String,
    /// How sure it is.
    pub sure: Sure,
}

/// A rod that dowels are cut from.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    /// What it is ordered by, such as `beech-4`.
    pub id: String,
    /// What it is called in a shop.
    pub name: String,
    /// mm.
    pub diameter_mm: f64,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// Where the diameter is from.
    pub size_source: RodSource,
    /// Where the density is from.
    pub density_source: RodSource,
}

/// The file of the catalogue.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Catalogue {
    #[serde(rename = "id")]
    _id: String,
    rod: Vec<Rod>,
}

/// The rods that come with the program, from thin to thick.
pub fn rods() -> Result<Vec<Rod>, CutError> {
    let text = include_str!("../../../profiles/dowels/rods.toml");
    Ok(toml_text::read::<Catalogue>("profiles/dowels/rods.toml", text)?.rod)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rod_has_sources_and_they_grow() {
        let rods = rods().unwrap();
        assert!(
            rods.windows(2)
                .all(|pair| pair[0].diameter_mm < pair[1].diameter_mm)
        );
        assert!(
            rods.iter()
                .all(|rod| (0.3..9.0).contains(&rod.density_g_cm3))
        );
        assert!(
            rods.iter()
                .all(|rod| !rod.size_source.source.is_empty()
                    && !rod.density_source.source.is_empty())
        );
    }
}
