//! What the machine makes of the lengths that were asked for: its pixels, lines and layers.

use maud::{Markup, html};

use crate::base::numbers::{number, quantity};
use crate::sheet::GridRow;

/// The table of these rows; nothing where there are none.
pub(super) fn table(rows: &[GridRow]) -> Markup {
    html! {
        @if !rows.is_empty() {
            h2 { "What the machine makes of it" }
            table {
                thead { tr { th scope="col" { "What" } th scope="col" { "Along" } th scope="col" class="n" { "Asked" } th scope="col" class="n" { "Drawn" } th scope="col" { "The machine gives" } } }
                tbody {
                    @for (row, along) in gathered(rows) {
                        tr {
                            td { (row.what) } td { (along) }
                            td class="n" { (quantity(row.asked_mm, "mm")) } td class="n" { (quantity(row.drawn_mm, "mm")) }
                            td { (given(row)) }
                        }
                    }
                }
            }
            p class="small" { "Walls are counted wherever they lie between the pixels and layers, so that many or one more." }
        }
    }
}

/// The rows with the directions along which the machine makes the same of the same length: `x, y`.
fn gathered(rows: &[GridRow]) -> Vec<(&GridRow, String)> {
    let mut gathered: Vec<(&GridRow, String)> = Vec::new();
    for row in rows {
        let is_same = |other: &GridRow| {
            GridRow {
                along: row.along.clone(),
                ..other.clone()
            } == *row
        };
        match gathered.last_mut().filter(|(last, _)| is_same(last)) {
            Some((_, along)) => *along += &format!(", {}", row.along),
            None => gathered.push((row, row.along.clone())),
        }
    }
    gathered
}

/// The last column: `24 pixels of 42.33 µm = 1.016 mm`.
fn given(row: &GridRow) -> String {
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
    fn what_the_machine_makes_alike_along_two_directions_is_one_line() {
        let row = |along: &str, steps_of: &str, steps: u32| GridRow {
            what: "wall".to_owned(),
            along: along.to_owned(),
            asked_mm: 1.0,
            drawn_mm: 1.0,
            steps_of: steps_of.to_owned(),
            step_mm: 1.0 / f64::from(steps),
            steps,
            given_mm: 1.0,
            is_whole: true,
        };
        let rows = [
            row("x", "pixels", 20),
            row("y", "pixels", 20),
            row("z", "layers", 10),
        ];
        let lines: Vec<String> = gathered(&rows)
            .into_iter()
            .map(|(_, along)| along)
            .collect();
        assert_eq!(lines, ["x, y", "z"]);
        let oblong = [row("x", "pixels", 20), row("y", "pixels", 25)];
        assert_eq!(gathered(&oblong).len(), 2);
    }
}
