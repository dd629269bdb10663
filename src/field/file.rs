//! Densities from a file: sums, products and polynomials in TOML.
//!
//! ```toml
//! [field]
//! sum = [
//!     "uniform:20%",
//!     { product = ["ramp:0,0,1@0mm..40mm:0..1", "uniform:0.5"] },
//!     { polynomial = [{ coefficient = 0.0001, x = 2 }] },
//!     { linear = { at_origin = 0.1, gradient = [0.0, 0.001, 0.0] } },
//! ]
//! ```

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::levels::Levels;
use super::linear::Linear;
use super::order::Order;
use super::polynomial::{Polynomial, Term};
use crate::base::toml_text::{self, TextFault};
use crate::geom::{Quadric, Vector};

/// The end of the name of a file with a field.
const FILE_END: &str = ".toml";
/// Most parts of a field: each is integrated on its own.
const MAX_PARTS: usize = 64;
/// Largest file, bytes: a field of the most parts and terms is far smaller.
const MAX_BYTES: u64 = 1 << 20;

/// A reason why a file is no field.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file cannot be opened.
    #[error("cannot read the field {}; remedy: check its name", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// The file is far too large.
    #[error("{} is too large for a field; remedy: name the file of the field", .0.display())]
    Size(PathBuf),
    /// The text is not TOML, or no field.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// There are too many parts.
    #[error("{file}: the field has {parts} parts; remedy: use at most {MAX_PARTS}")]
    Parts {
        /// The file's name.
        file: String,
        /// The parts.
        parts: usize,
    },
}

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FieldFile {
    field: Order,
}

/// A part that is written as a table.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Table {
    Sum(Vec<Order>),
    Product(Vec<Order>),
    Polynomial(Vec<Term>),
    Linear(LinearTable),
    Levels(LevelsTable),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LinearTable {
    at_origin: f64,
    gradient: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LevelsTable {
    quadric: [f64; 10],
    cuts: Vec<f64>,
    densities: Vec<f64>,
}

/// Returns true if a field is ordered by the name of its file, and not in words.
pub fn is_file_name(typed: &str) -> bool {
    typed.trim().to_lowercase().ends_with(FILE_END)
}

/// Reads a field from a file.
///
/// # Errors
/// It cannot be opened, or is no field; the message names line and column.
pub fn read_file(path: &Path) -> Result<Order, FileError> {
    read_text(&path.display().to_string(), &text_of(path)?)
}

/// Returns the text of a file that may be a field.
///
/// # Errors
/// It cannot be opened, or is too large.
pub fn text_of(path: &Path) -> Result<String, FileError> {
    let read = |source| FileError::Read {
        path: path.to_owned(),
        source,
    };
    if fs::metadata(path).map_err(read)?.len() > MAX_BYTES {
        return Err(FileError::Size(path.to_owned()));
    }
    fs::read_to_string(path).map_err(read)
}

/// Reads a field from the text of a file with this name.
///
/// # Errors
/// It is no field; the message names line and column.
pub fn read_text(file: &str, text: &str) -> Result<Order, FileError> {
    let FieldFile { field } = toml_text::read(file, text)?;
    let parts = field.count();
    if parts > MAX_PARTS {
        return Err(FileError::Parts {
            file: file.to_owned(),
            parts,
        });
    }
    Ok(field)
}

impl<'de> Deserialize<'de> for Order {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OrderVisitor)
    }
}

struct OrderVisitor;

impl<'de> Visitor<'de> for OrderVisitor {
    type Value = Order;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a field: words such as \"uniform:40%\", or a table such as { sum = [] }")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Order, E> {
        text.parse().map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Order, A::Error> {
        let order = match Table::deserialize(MapAccessDeserializer::new(map))? {
            Table::Sum(parts) => Order::Sum(some(parts)?),
            Table::Product(factors) => Order::Product(some(factors)?),
            Table::Polynomial(terms) => {
                Order::Polynomial(Polynomial::new(terms).map_err(Error::custom)?)
            }
            Table::Linear(LinearTable {
                at_origin,
                gradient,
            }) => {
                let numbers = gradient.iter().chain([&at_origin]);
                if numbers.into_iter().any(|number| !number.is_finite()) {
                    let fault = "a number is not finite; remedy: give plain numbers";
                    return Err(Error::custom(fault));
                }
                Order::Linear(Linear {
                    at_origin,
                    gradient: Vector::from(gradient),
                })
            }
            Table::Levels(LevelsTable {
                quadric,
                cuts,
                densities,
            }) => {
                let levels = Levels::new(Quadric(quadric), cuts, densities);
                Order::Levels(levels.map_err(Error::custom)?)
            }
        };
        Ok(order)
    }
}

/// Returns the parts if there are any.
fn some<E: Error>(parts: Vec<Order>) -> Result<Vec<Order>, E> {
    if parts.is_empty() {
        return Err(E::custom(
            "a sum or product of nothing; remedy: give it parts",
        ));
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::{Solid, primitives::cuboid};

    const SAMPLE: &str = r#"
[field]
sum = [
    "uniform:20%",
    { product = ["ramp:0,0,1@0mm..4mm:0..1", "uniform:0.5"] },
    { polynomial = [{ coefficient = 0.01, x = 2 }, { coefficient = -0.01, y = 1, z = 1 }] },
    { linear = { at_origin = 0.1, gradient = [0.0, 0.001, 0.0] } },
]
"#;

    #[test]
    fn sums_products_and_polynomials_are_read() {
        let field = read_text("field.toml", SAMPLE).unwrap();
        assert_eq!(field.count(), 7);
        let solid = Solid::new(cuboid(&Point::origin(), &Point::new(1.0, 1.0, 4.0))).unwrap();
        let at = Point::new(1.0, 1.0, 2.0);
        let want = 0.2 + 0.5 * 0.5 + 0.01 - 0.02 + 0.101;
        assert!((field.on(&solid).at(&at) - want).abs() < 1e-15);
    }

    #[test]
    fn a_fault_is_told_with_its_place_and_remedy() {
        for (text, part) in [
            ("[field]\nsum = [\"uniform:15\"]", "write 15%"),
            ("[field]\nsun = [\"uniform:15%\"]", "did you mean `sum`?"),
            ("[field]\nsum = []", "give it parts"),
            ("field = \"ramp:0,0,1\"", "write it like ramp:"),
            ("field = 7", "expected a field"),
            (
                "[field]\npolynomial = [{ coefficient = nan, x = 1 }]",
                "finite",
            ),
            (
                "[field]\npolynomial = [{ coefficient = 1.0, x = 200 }]",
                "degree 200",
            ),
            (
                "[field]\nlinear = { at_origin = inf, gradient = [0.0, 0.0, 0.0] }",
                "finite",
            ),
            ("[fields]\nx = 1", "did you mean `field`?"),
        ] {
            let error = read_text("field.toml", text).unwrap_err().to_string();
            assert!(
                error.starts_with("field.toml:") && error.contains(part),
                "{text}: {error}"
            );
        }
        let many = format!("[field]\nsum = [{}]", "\"uniform:0.001\",".repeat(80));
        let error = read_text("field.toml", &many).unwrap_err().to_string();
        assert!(error.contains("81 parts"), "{error}");
    }
}
