//! The end of the job sheet: the sign-off, and a card for the customer to cut out.

use maud::{Markup, html};

use super::fields::blank;
use super::steps::step_names;
use super::words;
use crate::base::numbers::{measured, quantity};
use crate::goal::GoalKind;
use crate::sheet::Checklist;

/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;

/// The columns to fill in of the sign-off.
const HEADS: [&str; 3] = ["Name", "Date", "Remarks"];

/// Returns a table to sign every step off, in the order of the sheet.
pub(super) fn sign_off(sheet: &Checklist) -> Markup {
    let steps = step_names(sheet).into_iter().enumerate();
    let steps = steps.map(|(index, name)| format!("{}. {name}", index + 1));
    html! {
        section class="together" {
            h2 id="sign-off" { "Sign-off" }
            table class="stack" {
                thead {
                    tr { th scope="col" { "Step" } @for head in HEADS { th scope="col" { (head) } } }
                }
                tbody {
                    @for step in steps.chain(["Release".to_owned()]) {
                        tr {
                            th scope="row" { (step) }
                            @for head in HEADS { td data-head=(head) { (blank()) } }
                        }
                    }
                }
            }
        }
    }
}

/// Words what is inside the object.
fn inside(sheet: &Checklist) -> &'static str {
    match sheet.infill {
        Some(_) => "in one piece, denser in some places than in others",
        None => "hollow and glued",
    }
}

/// Returns the card that goes with the object.
pub(super) fn card(sheet: &Checklist) -> Markup {
    html! {
        section class="card together" aria-label="Card for the customer" {
            h2 { (sheet.job) }
            p class="promise" { (customer_promise(sheet)) }
            @for line in use_lines(sheet) { p { (line) } }
            p {
                "Made of " (sheet.material.name) ", " (measured(sheet.assembly.mass_g, "g"))
                ", " (inside(sheet)) ". Keep it out of the sun and away from heat. Wipe it with a damp cloth. "
                "Do not drop it. It is not a toy for children under three: small parts can come off."
            }
        }
    }
}

/// Words what the object does for somebody who knows no figures.
fn customer_promise(sheet: &Checklist) -> String {
    let body = &sheet.assembly;
    match (sheet.goal.aim.kind, body.topples_deg) {
        (GoalKind::Stand, Some(tilt)) if tilt >= 1.0 => {
            format!(
                "Stands, even on a board that leans by {}.",
                measured(tilt.floor(), "°")
            )
        }
        (GoalKind::Yoyo, _) => "Spins steadily as a yo-yo.".to_owned(),
        (GoalKind::Balance, _) => match sheet.goal.aim.rotor {
            Some(order) => format!("Runs true up to {}.", quantity(order.speed_rpm, "rpm")),
            None => "Runs true on its shaft.".to_owned(),
        },
        (GoalKind::Match, _) => "Weighs, hangs and turns as the original does.".to_owned(),
        _ => words::promise(sheet),
    }
}

/// Words how the object is used, a sentence or two.
fn use_lines(sheet: &Checklist) -> Vec<String> {
    let body = &sheet.assembly;
    let line = match sheet.goal.aim.kind {
        GoalKind::Top if sheet.foot.is_some() => {
            "Spin it upright on a hard, smooth table. It slows down and comes to rest standing.".to_owned()
        }
        GoalKind::Top => {
            let turns = body.critical_speed_rpm.map(|rpm| format!("{:.1}", rpm / S_PER_MIN));
            let turns = turns.map_or(String::new(), |turns| format!(", {turns} turns a second"));
            let hold = if sheet.goal.spins_on.is_some_and(|spin| spin.has_tip) {
                "Hold it with its tip straight down"
            } else {
                "Hold it upright"
            };
            format!("{hold} on a hard, smooth table and spin it fast{turns} or more. It stays up until it slows down.")
        }
        GoalKind::Yoyo => "Tie the string around the axle, wind it up and let it fall. It runs down and up without leaning.".to_owned(),
        GoalKind::Stand => "Set it on a table. It stands on its own, with nothing to hold it.".to_owned(),
        GoalKind::Float => "Set it on water, the right way up. It floats upright and comes back when it is pushed over.".to_owned(),
        GoalKind::Balance => {
            "Mount it on its shaft. It is balanced: drill nothing into it and stick nothing to it.".to_owned()
        }
        GoalKind::Match => "Handle it as the original. It weighs as much, hangs the same and turns the same.".to_owned(),
    };
    vec![line]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    #[test]
    fn a_customer_is_told_the_lean_in_whole_degrees_and_no_figure_of_a_yoyo() {
        let mut sheet = sample().0;
        sheet.goal.aim.kind = GoalKind::Stand;
        sheet.assembly.topples_deg = Some(9.58);
        let stands = customer_promise(&sheet);
        assert_eq!(stands, "Stands, even on a board that leans by 9°.");
        sheet.assembly.topples_deg = Some(0.85);
        assert_eq!(customer_promise(&sheet), words::promise(&sheet));
        sheet.goal.aim.kind = GoalKind::Yoyo;
        sheet.assembly.dominance_ratio = Some(0.81);
        assert_eq!(customer_promise(&sheet), "Spins steadily as a yo-yo.");
    }
}
