//! The table of ordered lengths as the machine makes them, in pixels, lines and layers.

use maud::{Markup, html};

use crate::base::numbers::{number, quantity};
use crate::sheet::{Direction, GridRow};

/// Returns the table of these rows; empty without rows.
pub(super) fn table(rows: &[GridRow]) -> Markup {
    html! {
        @if !rows.is_empty() {
            h2 { "Sizes on this printer" }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "What" }
                        th scope="col" { "Along" }
                        th scope="col" class="n" { "Asked" }
                        th scope="col" class="n" { "Drawn" }
                        th scope="col" { "Printed as" }
                    }
                }
                tbody {
                    @for (row, along) in merge_directions(rows) {
                        tr {
                            th scope="row" { (row.what) } td data-head="Along" { (along) }
                            td class="n" data-head="Asked" { (quantity(row.asked_mm, "mm")) }
                            td class="n" data-head="Drawn" { (quantity(row.drawn_mm, "mm")) }
                            td data-head="Printed as" { (steps_words(row)) }
                        }
                    }
                }
            }
            p class="small" { "A wall may print one step thicker, as it can begin anywhere between the pixels and layers." }
        }
    }
}

/// Merges rows that differ only in their direction, and joins the directions: `x, y`.
fn merge_directions(rows: &[GridRow]) -> Vec<(&GridRow, String)> {
    let mut merged: Vec<(&GridRow, String)> = Vec::new();
    for row in rows {
        let is_same = |other: &GridRow| {
            GridRow {
                along: row.along,
                ..other.clone()
            } == *row
        };
        match merged.last_mut().filter(|(last, _)| is_same(last)) {
            Some((_, along)) => *along += &format!(", {}", word(row.along)),
            None => merged.push((row, word(row.along).to_owned())),
        }
    }
    merged
}

fn word(along: Direction) -> &'static str {
    match along {
        Direction::X => "x",
        Direction::Y => "y",
        Direction::Z => "z",
        Direction::Tilted => "tilted",
    }
}

/// Words the last column: `24 pixels of 42.33 µm = 1.016 mm`.
fn steps_words(row: &GridRow) -> String {
    let least = if row.is_whole { "" } else { "about " };
    let step = number(row.step_mm * 1000.0);
    format!(
        "{least}{} {} of {step}\u{a0}µm = {}",
        row.steps,
        row.steps_of,
        quantity(row.given_mm, "mm")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_lengths_along_two_directions_are_one_line() {
        let row = |along: Direction, steps_of: &str, steps: u32| GridRow {
            what: "wall".to_owned(),
            along,
            asked_mm: 1.0,
            drawn_mm: 1.0,
            steps_of: steps_of.to_owned(),
            step_mm: 1.0 / f64::from(steps),
            steps,
            given_mm: 1.0,
            is_whole: true,
        };
        let rows = [
            row(Direction::X, "pixels", 20),
            row(Direction::Y, "pixels", 20),
            row(Direction::Z, "layers", 10),
        ];
        let lines: Vec<String> = merge_directions(&rows)
            .into_iter()
            .map(|(_, along)| along)
            .collect();
        assert_eq!(lines, ["x, y", "z"]);
        let oblong = [
            row(Direction::X, "pixels", 20),
            row(Direction::Y, "pixels", 25),
        ];
        assert_eq!(merge_directions(&oblong).len(), 2);
    }
}
