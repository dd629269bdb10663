//! What is told of how parts are joined: the bosses that were kept solid around pins.

use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::Checklist;
use super::words::{coordinates, quantity};

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
        format!("{} at {} between {}", boss.pin, coordinates(&boss.center_mm), boss.parts.join(" and "))
    });
    named.collect::<Vec<_>>().join(", ")
}
