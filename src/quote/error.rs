//! The reasons why a kit has no quote.

use std::path::PathBuf;

use crate::printer::{Rates, SHOP_FILE, ShopError};

/// A reason why a kit has no quote.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QuoteError {
    /// There is no file with a shop's defaults.
    #[error(
        "no {SHOP_FILE} says what the shop charges; remedy: write one here, beside the kit or in \
         the user's configuration folder, with the shop's own numbers in place of these:\n\
         printer = \"{printer}\"\n\n{example}",
        example = Rates::EXAMPLE
    )]
    NoShop {
        /// The id of the kit's printer.
        printer: String,
    },
    /// The file says nothing of prices.
    #[error(
        "{} does not say what the shop charges; remedy: add to it, with the shop's own numbers in \
         place of these:\n{example}",
        file.display(),
        example = Rates::EXAMPLE
    )]
    NoRates {
        /// The file.
        file: PathBuf,
    },
    /// The rates have no price of the kit's material.
    #[error(
        "{} has no price of a kilogram of {material}; remedy: add `{material} = …` to \
         material_per_kg under [rates]",
        file.display()
    )]
    NoPrice {
        /// The file.
        file: PathBuf,
        /// The id of the material.
        material: String,
    },
    /// The file cannot be read.
    #[error(transparent)]
    Shop(#[from] ShopError),
}
