//! Quotes: what a sliced kit costs by the shop's own rates, as a page and as a line of a table.
//!
//! * `rates` finds the shop's rates.
//! * `costs` adds up material, support, machine, work, margin and tax.
//! * `page` and `csv` show them.

mod costs;
mod csv;
mod error;
mod page;
mod rates;

pub use costs::{Quote, QuoteLine};
pub use error::QuoteError;
pub use rates::ShopRates;

/// Name of the page with a quote, in the folder of toolpaths.
pub const QUOTE_PAGE: &str = "quote.html";
/// Name of the table with a quote, in the folder of toolpaths.
pub const QUOTE_TABLE: &str = "quote.csv";
