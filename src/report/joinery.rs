//! What is told of how parts are joined: bosses around pins, dowels, and films of glue.

use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::Checklist;
use super::words::{coordinates, quantity};
use crate::verify::GlueFilm;

/// A round in which material was kept solid around pins, and everything solved again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RoundRow {
    /// Which round, from 1.
    pub round: usize,
    /// What was kept solid in it.
    pub bosses: Vec<BossRow>,
    /// The volume of what could have been emptied in all bosses up to this round, mm³.
    pub kept_solid_mm3: f64,
    /// The certificate's figure before the round, in its unit.
    pub before: f64,
    /// The same with the bosses kept solid.
    pub after: f64,
    /// How far `after` is from its proof, as a share.
    pub gap_ratio: f64,
}

/// A boss: material that is kept solid around a pin and its socket.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BossRow {
    /// The pin it is for.
    pub pin: String,
    /// The two parts it joins.
    pub parts: [String; 2],
    /// The middle of the pin's base on the cut, model frame, mm.
    pub center_mm: [f64; 3],
    /// The volume of the boss with what was solid anyway, mm³.
    pub volume_mm3: f64,
}

/// Dowels to be cut, all alike.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutListRow {
    /// How many.
    pub count: usize,
    /// The rod they are cut from, such as `beech-4`.
    pub rod: String,
    /// What it is called in a shop.
    pub name: String,
    /// mm.
    pub diameter_mm: f64,
    /// How long they are cut, mm.
    pub length_mm: f64,
    /// What one of them weighs, g.
    pub mass_g: f64,
    /// What the diameter and the density rest on.
    pub sources: Vec<String>,
}

/// The dowels to cut; nothing where pins are printed.
pub(super) fn cut_list(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.cut_list.is_empty() {
            p { "Cut the dowels, ends square and free of burr; each goes half into either part." }
            ul class="ticks" {
                @for row in &sheet.cut_list {
                    li {
                        strong { (row.count) " × " (row.name) } " (" code { (row.rod) } "), " (quantity(row.length_mm, "mm")) " long, "
                        (quantity(row.mass_g, "g")) " each" br; span class="small" { (row.sources.join("; ")) }
                    }
                }
            }
        }
    }
}

/// What the films of glue weigh, and how thick they are counted; nothing where that is not known.
pub(super) fn films(sheet: &Checklist) -> Markup {
    let films: Vec<GlueFilm> = sheet.joints.iter().filter_map(|joint| joint.glue).collect();
    let mass_g: f64 = films.iter().map(|film| film.mass_g).sum();
    html! {
        @if let Some(film) = films.first() {
            p {
                "The figures count films of glue of " (quantity(film.thickness_mm, "mm")) " and " (quantity(film.density_g_cm3, "g/cm³"))
                ", " (quantity(mass_g, "g")) " in all; what is pressed out is wiped off."
            }
        }
    }
}

/// What the rounds kept solid, and what that cost.
pub(super) fn rounds(sheet: &Checklist) -> Markup {
    let figure = sheet.certificate.figure;
    html! {
        @for row in &sheet.rounds {
            p {
                "Boss round " (row.round) ": the walls alone left no room for pins, so material was kept solid around "
                (listed(&row.bosses)) ". The " (figure.name()) " went from " (quantity(row.before, figure.unit())) " to "
                (quantity(row.after, figure.unit())) "; " (quantity(row.kept_solid_mm3, "mm³"))
                " that could have been emptied stay solid."
            }
        }
    }
}

fn listed(bosses: &[BossRow]) -> String {
    let named = bosses.iter().map(|boss| {
        format!(
            "{} at {} between {}",
            boss.pin,
            coordinates(&boss.center_mm),
            boss.parts.join(" and ")
        )
    });
    named.collect::<Vec<_>>().join(", ")
}
