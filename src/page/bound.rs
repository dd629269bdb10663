//! The proof of the bound in numbers, for whoever checks it without the solver.

use maud::{Markup, html};

use crate::base::numbers::{coordinates, number, quantity};
use crate::sheet::Checklist;
use crate::verify::{BoundPoint, BoundProof};

/// Returns the numbers of the proof; nothing for a kit without one.
pub(super) fn numbers(sheet: &Checklist) -> Markup {
    let Some(proof) = &sheet.certificate.proof else {
        return html! {};
    };
    html! {
        section {
            h2 { "The proof in numbers" }
            p class="small" {
                "For engineers. Each row is a point of the dual: it proves that no hollowing with a wall of "
                (quantity(proof.wall_mm, "mm")) " beats "
                (quantity(proof.bound, sheet.certificate.figure.unit()))
                ". The method is in the guide, under the certificate. More digits are in checklist.json."
            }
            (points(&proof.points))
            (further(proof))
        }
    }
}

fn points(points: &[BoundPoint]) -> Markup {
    let is_top = points.iter().any(|point| point.height_mm.is_some());
    html! {
        table class="stack" {
            thead {
                tr {
                    @if is_top { th scope="col" { "Height, mm" } }
                    th scope="col" { "Weights" }
                    th scope="col" { "Multipliers" }
                }
            }
            tbody {
                @for point in points {
                    tr {
                        @if is_top {
                            td data-head="Height, mm" { (point.height_mm.map(number).unwrap_or_default()) }
                        }
                        td data-head="Weights" { (row(&point.weights)) }
                        td data-head="Multipliers" { (row(&point.multipliers)) }
                    }
                }
            }
        }
    }
}

/// Returns what the points go with: the ends of the heights, the edges of the support, and places
/// that stay solid.
fn further(proof: &BoundProof) -> Markup {
    html! {
        @for (name, end) in ["Least height", "Greatest height"].iter().zip(proof.ends.iter().flatten()) {
            p class="small" { (name) ": multipliers " (row(end)) "." }
        }
        @for [x, y, offset] in &proof.edges {
            p class="small" {
                "Edge of the support: inward normal " (row(&[*x, *y])) ", offset " (quantity(*offset, "mm")) "."
            }
        }
        @for keep in &proof.keeps {
            p class="small" {
                "Solid within " (quantity(keep.radius_mm, "mm")) " of the line from "
                (coordinates(&keep.from_mm)) " to " (coordinates(&keep.to_mm)) "."
            }
        }
    }
}

/// Returns numbers in a row; a dash for none.
fn row(numbers: &[f64]) -> String {
    if numbers.is_empty() {
        return "–".to_owned();
    }
    let words: Vec<String> = numbers.iter().map(|&x| number(x)).collect();
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    #[test]
    fn every_number_of_the_proof_stands_on_the_certificate() {
        let (mut sheet, _) = sample();
        assert_eq!(numbers(&sheet).into_string(), "");
        sheet.certificate.proof = Some(BoundProof {
            bound: 321.5,
            wall_mm: 1.02,
            keeps: Vec::new(),
            points: vec![BoundPoint {
                height_mm: Some(17.25),
                weights: vec![0.6, -0.8],
                multipliers: vec![1.5, 2.25],
            }],
            ends: Some([vec![3.5], vec![4.5]]),
            edges: vec![[0.28, 0.96, -7.5]],
        });
        let page = numbers(&sheet).into_string();
        for word in [
            "321.5",
            "1.02",
            "17.25",
            "0.6",
            "1.5, 2.25",
            "3.5",
            "4.5",
            "0.28, 0.96",
            "7.5",
        ] {
            assert!(page.contains(word), "{word}: {page}");
        }
    }
}
