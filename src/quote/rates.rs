//! The rates of a shop, and the file that states them.

use std::path::PathBuf;

use super::error::QuoteError;
use crate::printer::{Rates, ShopDefaults};

/// The rates of a shop, and the file that states them.
#[derive(Debug, Clone, PartialEq)]
pub struct ShopRates {
    /// The file.
    pub file: PathBuf,
    /// The rates.
    pub rates: Rates,
}

impl ShopRates {
    /// Reads the rates from the first of these folders that has a shop's defaults. `printer` is the
    /// kit's, for a remedy.
    ///
    /// # Errors
    /// There is no such file, it cannot be read, or it says nothing of rates.
    pub fn find_in(folders: &[PathBuf], printer: &str) -> Result<Self, QuoteError> {
        let shop = ShopDefaults::find_in(folders)?;
        let shop = shop.ok_or_else(|| QuoteError::NoShop {
            printer: printer.to_owned(),
        })?;
        match shop.rates {
            Some(rates) => Ok(Self {
                file: shop.file,
                rates,
            }),
            None => Err(QuoteError::NoRates { file: shop.file }),
        }
    }

    /// Returns the price of a kilogram of a material.
    ///
    /// # Errors
    /// The rates do not name the material.
    pub fn per_kg(&self, material: &str) -> Result<f64, QuoteError> {
        let price = self.rates.material_per_kg.get(material);
        price.copied().ok_or_else(|| QuoteError::NoPrice {
            file: self.file.clone(),
            material: material.to_owned(),
        })
    }
}
