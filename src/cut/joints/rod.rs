//! Dowels: loose pins cut from stock rods, with a socket on either side of the joint.

use serde::{Deserialize, Serialize};

use crate::{base::toml_text, cut::error::CutError, printer::Sure};

/// A dowel of a plan: its rod and its length.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dowel {
    /// The id of the rod it is cut from, such as `beech-4`.
    pub rod: String,
    /// Length it is cut to, mm; its centre lies in the cut.
    pub length_mm: f64,
    /// Density, g/cm³.
    pub density_g_cm3: f64,
}

/// Source of a number.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RodSource {
    /// The source, in words.
    pub source: String,
    /// Confidence in the number.
    pub sure: Sure,
}

/// A rod that dowels are cut from.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    /// Id to order it by, such as `beech-4`.
    pub id: String,
    /// Trade name.
    pub name: String,
    /// Diameter, mm.
    pub diameter_mm: f64,
    /// Density, g/cm³.
    pub density_g_cm3: f64,
    /// Source of the diameter.
    pub size_source: RodSource,
    /// Source of the density.
    pub density_source: RodSource,
}

/// File of the catalogue.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Catalogue {
    #[serde(rename = "id")]
    _id: String,
    rod: Vec<Rod>,
}

/// Returns the rods that come with the program, from thin to thick.
pub fn rods() -> Result<Vec<Rod>, CutError> {
    let text = include_str!("../../../profiles/dowels/rods.toml");
    Ok(toml_text::read::<Catalogue>("profiles/dowels/rods.toml", text)?.rod)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rod_has_sources_and_rods_are_sorted_by_diameter() {
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
