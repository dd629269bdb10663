//! The quote of a sliced kit: its rates, and the files beside the toolpaths.

use std::path::Path;

use super::shop::shop_folders;
use crate::job::Job;
use crate::kit::Kit;
use crate::quote::{QUOTE_PAGE, QUOTE_TABLE, Quote, QuoteError, ShopRates};
use crate::sheet::Checklist;
use crate::slice::{SliceError, Slices};
use crate::verify::{CHECKLIST_FILE, JOB_FILE};

/// A reason why a kit is not quoted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QuotedError {
    /// There are no rates.
    #[error(transparent)]
    Quote(#[from] QuoteError),
    /// The kit cannot be read.
    #[error(transparent)]
    Kit(#[from] SliceError),
    /// The checklist is none.
    #[error("{CHECKLIST_FILE} of this kit is no whole one; remedy: prepare the kit again")]
    Checklist(#[from] serde_json::Error),
}

/// The kit to quote, with the shop's rates.
pub struct ToQuote {
    sheet: Checklist,
    rates: ShopRates,
}

impl ToQuote {
    /// Reads the shop's rates for a kit, and its checklist.
    ///
    /// # Errors
    /// The folder is no kit, or the shop names no rates for its material.
    pub fn read(kit: &Path) -> Result<Self, QuotedError> {
        let job = kit.join(JOB_FILE);
        if !job.is_file() {
            let path = kit.to_owned();
            return Err(SliceError::NoKit { path }.into());
        }
        let job = Job::read(&job).map_err(SliceError::from)?;
        let rates = ShopRates::find_in(&shop_folders(kit), &job.printer.id)?;
        let path = kit.join(CHECKLIST_FILE);
        let bytes = std::fs::read(&path).map_err(|source| SliceError::Read { path, source })?;
        let sheet: Checklist = serde_json::from_slice(&bytes)?;
        rates.per_kg(&sheet.material.id)?;
        Ok(Self { sheet, rates })
    }

    /// Adds the quote's files to those of the toolpaths.
    ///
    /// # Errors
    /// As [`Quote::of`].
    pub fn add(&self, slices: &Slices, files: &mut Kit) -> Result<Quote, QuotedError> {
        let quote = Quote::of(&self.sheet, slices, &self.rates)?;
        files.add(QUOTE_PAGE, quote.to_html(&self.sheet).into_bytes());
        files.add(QUOTE_TABLE, quote.to_csv().into_bytes());
        Ok(quote)
    }
}

/// Words a quote in a line, and where it was written.
pub fn quote_words(quote: &Quote, folder: &Path) -> String {
    let total = quote.price(quote.total).replace('\u{a0}', " ");
    format!("quote: {total}; {}\n", folder.join(QUOTE_PAGE).display())
}
