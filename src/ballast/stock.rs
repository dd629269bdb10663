//! The catalogue of stock parts that a shop has at hand, each number with its source.

use serde::{Deserialize, Serialize};

use super::error::{BallastError, StockFault};
use crate::base::toml_text::{self, nearest_name};
use crate::base::units::MM3_PER_CM3;
use crate::mass::LumpShape;
use crate::printer::Sure;

/// The source of a part's sizes, or of its mass.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// The source, in words.
    pub source: String,
    /// The confidence in it.
    pub sure: Sure,
}

/// One stock part.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The id by which it is ordered, such as `ball-4`.
    pub id: String,
    /// Its name in a shop.
    pub name: String,
    /// Its sizes.
    pub shape: LumpShape,
    /// Its mass, g.
    pub mass_g: f64,
    /// The spread of the mass between good parts, as a share of it.
    pub mass_spread_ratio: f64,
    /// The source of the sizes.
    pub size: Provenance,
    /// The source of the mass.
    pub mass: Provenance,
}

/// A file of the catalogue: parts of one kind, with the sources of their numbers.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Family {
    #[serde(rename = "id")]
    _id: String,
    size: Provenance,
    mass: MassText,
    part: Vec<PartText>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MassText {
    source: String,
    sure: Sure,
    spread_ratio: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PartText {
    id: String,
    name: String,
    shape: LumpShape,
    mass_g: f64,
}

macro_rules! built_in {
    ($($id:literal)*) => {
        &[$((
            concat!("profiles/ballast/", $id, ".toml"),
            include_str!(concat!("../../profiles/ballast/", $id, ".toml")),
        )),*]
    };
}

/// The built-in families: the file's name and its text.
const BUILT_IN: &[(&str, &str)] = built_in!("balls" "nuts" "coins" "discs");

/// The plausible densities, from wood to gold, g/cm³. Outside them a size or mass is misprinted.
const PLAUSIBLE_G_CM3: [f64; 2] = [0.5, 20.0];

/// Returns all stock parts: balls, then nuts, coins and discs, each from small to large.
pub fn catalogue() -> Result<Vec<Part>, StockFault> {
    let families: Vec<Vec<Part>> = BUILT_IN
        .iter()
        .map(|(file, text)| read(file, text))
        .collect::<Result<_, _>>()?;
    Ok(families.concat())
}

/// Returns the part of this id.
pub fn find(id: &str) -> Result<Part, BallastError> {
    let parts = catalogue()?;
    if let Some(part) = parts.iter().find(|part| part.id == id) {
        return Ok(part.clone());
    }
    let known: Vec<&str> = parts.iter().map(|part| part.id.as_str()).collect();
    let remedy = match nearest_name(id, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("use one of {}", known.join(", ")),
    };
    Err(BallastError::Unknown {
        id: id.to_owned(),
        remedy,
    })
}

/// Reads the parts of one file of the catalogue. Refuses numbers that have no source or are
/// implausible.
fn read(file: &str, text: &str) -> Result<Vec<Part>, StockFault> {
    let Family {
        size, mass, part, ..
    } = toml_text::read(file, text)?;
    for (table, source) in [("size", &size.source), ("mass", &mass.source)] {
        if source.trim().is_empty() {
            return Err(StockFault::Unsourced {
                file: file.to_owned(),
                table,
            });
        }
    }
    let spread_ratio = mass.spread_ratio;
    let mass = Provenance {
        source: mass.source,
        sure: mass.sure,
    };
    let parts: Vec<Part> = part
        .into_iter()
        .map(
            |PartText {
                 id,
                 name,
                 shape,
                 mass_g,
             }| {
                let (size, mass) = (size.clone(), mass.clone());
                Part {
                    id,
                    name,
                    shape,
                    mass_g,
                    mass_spread_ratio: spread_ratio,
                    size,
                    mass,
                }
            },
        )
        .collect();
    for (index, part) in parts.iter().enumerate() {
        check(file, part)?;
        if parts[..index].iter().any(|other| other.id == part.id) {
            return Err(StockFault::Twice {
                file: file.to_owned(),
                part: part.id.clone(),
            });
        }
    }
    Ok(parts)
}

/// Refuses implausible sizes and masses.
fn check(file: &str, part: &Part) -> Result<(), StockFault> {
    let (file, id) = (file.to_owned(), part.id.clone());
    let mut numbers = part.shape.sizes_mm();
    numbers.extend([
        ("mass_g", part.mass_g),
        ("spread_ratio", part.mass_spread_ratio),
    ]);
    if let Some(&(key, _)) = numbers
        .iter()
        .find(|(_, value)| !(*value > 0.0 && value.is_finite()))
    {
        return Err(StockFault::NotPositive {
            file,
            part: id,
            key,
        });
    }
    let density = part.mass_g / part.shape.volume_mm3() * MM3_PER_CM3;
    let [least, most] = PLAUSIBLE_G_CM3;
    if (least..=most).contains(&density) {
        return Ok(());
    }
    Err(StockFault::Implausible {
        file,
        part: id,
        density,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a family of one ball with one of its lines changed.
    fn family(line: &str, instead: &str) -> Result<Vec<Part>, StockFault> {
        let text = "id = \"balls\"\n[size]\nsource = \"a table\"\nsure = \"read\"\n[mass]\nsource = \"a balance\"\n\
                    sure = \"read\"\nspread_ratio = 0.01\n[[part]]\nid = \"ball-4\"\nname = \"ball\"\n\
                    shape = { kind = \"ball\", diameter_mm = 4.0 }\nmass_g = 0.26\n";
        assert!(text.contains(line), "{line}");
        read("balls.toml", &text.replace(line, instead))
    }

    #[test]
    fn the_catalogue_has_balls_nuts_coins_and_discs_and_no_id_twice() {
        let parts = catalogue().unwrap();
        let mut ids: Vec<&str> = parts.iter().map(|part| part.id.as_str()).collect();
        assert!(
            [
                "ball-4",
                "nut-m3",
                "nut-m12",
                "coin-euro-1-cent",
                "disc-50-10"
            ]
            .iter()
            .all(|id| ids.contains(id))
        );
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] != pair[1]));
    }

    #[test]
    fn every_part_weighs_what_its_metal_does() {
        for part in catalogue().unwrap() {
            let density = part.mass_g / part.shape.volume_mm3() * MM3_PER_CM3;
            // Zinc and nickel brass to copper; coins are thinner than their rims, nuts have
            // chamfers and play.
            assert!((5.0..8.95).contains(&density), "{}: {density}", part.id);
        }
    }

    #[test]
    fn a_ball_is_of_bearing_steel_to_the_digits_given() {
        for part in catalogue()
            .unwrap()
            .iter()
            .filter(|part| part.shape.is_ball())
        {
            // Four significant digits.
            assert!(
                (part.mass_g / (7.83e-3 * part.shape.volume_mm3()) - 1.0).abs() < 5e-4,
                "{}",
                part.id
            );
        }
    }

    #[test]
    fn numbers_without_a_source_are_refused() {
        assert!(family("a table", "a table").is_ok());
        for (line, table) in [("a table", "size"), ("a balance", "mass")] {
            let error = family(line, "  ").unwrap_err();
            assert_eq!(
                error,
                StockFault::Unsourced {
                    file: "balls.toml".into(),
                    table
                }
            );
        }
        let error = family("source = \"a table\"\n", "")
            .unwrap_err()
            .to_string();
        assert!(error.contains("missing field `source`"), "{error}");
    }

    #[test]
    fn implausible_sizes_and_masses_are_refused_by_name() {
        let error = family("diameter_mm = 4.0", "diameter_mm = -4.0")
            .unwrap_err()
            .to_string();
        assert!(error.contains("diameter_mm of `ball-4`"), "{error}");
        let error = family("mass_g = 0.26", "mass_g = 260.0").unwrap_err();
        assert!(matches!(error, StockFault::Implausible { .. }), "{error}");
        let error = family("mass_g = 0.26", "mass_kg = 0.26")
            .unwrap_err()
            .to_string();
        assert!(error.contains("did you mean `mass_g`?"), "{error}");
    }

    #[test]
    fn an_unknown_part_is_answered_with_the_nearest() {
        let error = find("bal-4").unwrap_err().to_string();
        assert!(error.contains("did you mean `ball-4`?"), "{error}");
    }
}
