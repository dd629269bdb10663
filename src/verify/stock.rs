//! The catalogue of ballast as the judge reads it: parts that lie flat.

use serde::Deserialize;

use crate::base::toml_text::{self, TextFault};
use crate::mass::{Lump, LumpShape};

/// The catalogue of ballast: of its files, those with parts that lie flat.
const STOCK: [(&str, &str); 2] = [
    (
        "profiles/ballast/discs.toml",
        include_str!("../../profiles/ballast/discs.toml"),
    ),
    (
        "profiles/ballast/coins.toml",
        include_str!("../../profiles/ballast/coins.toml"),
    ),
];

/// A file of the catalogue, as far as it is looked at.
#[derive(Deserialize)]
struct StockFile {
    part: Vec<StockPart>,
}

/// A part of the catalogue.
#[derive(Deserialize)]
struct StockPart {
    id: String,
    shape: LumpShape,
    mass_g: f64,
}

/// Returns the parts of the catalogue.
fn stock_parts() -> Result<Vec<StockPart>, TextFault> {
    let files = STOCK.iter();
    let files = files.map(|(file, text)| toml_text::read::<StockFile>(file, text));
    let files: Vec<StockFile> = files.collect::<Result<_, _>>()?;
    Ok(files.into_iter().flat_map(|file| file.part).collect())
}

/// Returns true if a lump is the part of this id. Without the catalogue none is.
pub fn is_of_stock(id: &str, lump: &Lump) -> bool {
    let parts = stock_parts().unwrap_or_default();
    let mut own = parts.iter().filter(|part| part.id == id);
    own.any(|part| part.shape == lump.shape && part.mass_g == lump.mass_g)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_has_the_shape_and_the_mass_of_its_name() {
        let disc = |diameter_mm: f64, mass_g: f64| Lump {
            shape: LumpShape::Disc {
                diameter_mm,
                thickness_mm: 10.0,
            },
            mass_g,
            center_mm: [0.0; 3],
            axis: [0.0, 0.0, 1.0],
        };
        assert!(is_of_stock("disc-50-10", &disc(50.0, 154.1)));
        // Heavier by a little, larger, or by another name.
        assert!(!is_of_stock("disc-50-10", &disc(50.0, 155.0)));
        assert!(!is_of_stock("disc-50-10", &disc(51.0, 154.1)));
        assert!(!is_of_stock("disc-50-20", &disc(50.0, 154.1)));
        assert!(!is_of_stock("disc-60-10", &disc(50.0, 154.1)));
    }
}
