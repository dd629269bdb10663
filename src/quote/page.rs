//! A quote as a page for the customer, on one sheet of paper.

use maud::{Markup, html};

use super::costs::Quote;
use crate::base::numbers::measured_extent;
use crate::page::{document, pieces, promise};
use crate::sheet::Checklist;

impl Quote {
    /// Returns the quote as one self-contained page. `sheet` is that of its kit.
    pub fn to_html(&self, sheet: &Checklist) -> String {
        let body = html! {
            h1 { "Quote: " (self.job) }
            p class="promise" { (promise(sheet)) }
            (facts(self, sheet))
            h2 { "Price" }
            (prices(self))
            (notes(self))
        };
        document(&format!("Quote: {}", self.job), &body)
    }
}

/// Returns what is made.
fn facts(quote: &Quote, sheet: &Checklist) -> Markup {
    let size_mm = sheet.finished_size_mm.unwrap_or(sheet.model.size_mm);
    html! {
        table class="facts" {
            tr { th scope="row" { "Size" } td { (measured_extent(&size_mm)) } }
            tr { th scope="row" { "Printer" } td { (quote.printer) } }
            tr { th scope="row" { "Material" } td { (quote.material) } }
            tr { th scope="row" { "Kit" } td { (pieces(sheet)) } }
        }
    }
}

/// Returns the table of prices.
fn prices(quote: &Quote) -> Markup {
    let sums = [
        ("Costs", quote.costs),
        ("Margin", quote.margin),
        ("Net price", quote.net),
        ("Tax", quote.tax),
    ];
    let is_said = |(_, amount): &(&str, f64)| *amount > 0.0;
    html! {
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "What" } th scope="col" class="n" { "Amount" }
                    th scope="col" class="n" { "Rate" } th scope="col" class="n" { "Price" }
                }
            }
            tbody {
                @for line in &quote.lines {
                    tr {
                        th scope="row" { (line.what) }
                        td class="n" data-head="Amount" { (line.amount) }
                        td class="n" data-head="Rate" { (line.rate) }
                        td class="n" data-head="Price" { (quote.price(line.price)) }
                    }
                }
                @for (name, amount) in sums.into_iter().filter(is_said) {
                    tr {
                        th scope="row" { (name) } td {} td {}
                        td class="n" data-head="Price" { (quote.price(amount)) }
                    }
                }
                tr {
                    th scope="row" { "Total" } td {} td {}
                    td class="n" data-head="Price" { strong { (quote.price(quote.total)) } }
                }
            }
        }
    }
}

/// Returns what the price rests on, and what it does not hold.
fn notes(quote: &Quote) -> Markup {
    html! {
        p {
            "Material and time are those of the toolpaths by " (quote.slicer) " in this folder. "
            "Other speeds take another time. Work is by the shop's minutes for an order, a part "
            "and a joint, and by the time that the glue is held."
        }
        @if !quote.excluded.is_empty() {
            p { "Not in the price: " (quote.excluded.join(", ")) "." }
        }
    }
}
