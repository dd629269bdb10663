//! The step in which the hardware is put in.

use maud::{Markup, html};

use super::fields::{blank, half_name};
use super::figure::{Picture, Role, figures};
use crate::base::numbers::{measured, quantity};
use crate::geom::Point;
use crate::goal::STEEL_G_CM3;
use crate::sheet::{Checklist, Half, TurnRow};
use crate::verify::{Hardware, HardwareKind};

/// Returns the step in which the hardware is put in.
pub(super) fn fit_hardware(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        div class="lead" {
            @for half in [Half::A, Half::B] {
                @if let Some(parts) = parts_of(sheet, half) {
                    p { "Half " strong { (half_name(half)) } " is " (parts) "." }
                }
            }
        }
        (align_halves(sheet))
        (figures(pictures, Role::Halves))
        ul class="ticks" {
            @for piece in &sheet.hardware {
                li {
                    strong { (piece.id) } ", " (description(sheet, piece)) " "
                    span class="field" { "Weighed, g " (blank()) }
                }
            }
        }
        p class="small" { "Weigh each piece before it goes in: a different mass moves the centre of mass, or slows the object down." }
    }
}

/// Names the parts of a half of a yo-yo; `None` if there are no halves.
fn parts_of(sheet: &Checklist, half: Half) -> Option<String> {
    let parts = sheet.parts.iter().filter(|part| part.half == Some(half));
    let parts: Vec<&str> = parts.map(|part| part.id.as_str()).collect();
    let glued = if parts.len() > 1 { ", glued" } else { "" };
    (!parts.is_empty()).then(|| parts.join(" + ") + glued)
}

/// Describes a piece, how deep it goes in and how far it stands out.
fn description(sheet: &Checklist, piece: &Hardware) -> String {
    let length_mm = (Point::from(piece.to_mm) - Point::from(piece.from_mm)).norm();
    let [length, depth, out, socket] = [
        length_mm,
        piece.depth_mm,
        length_mm - piece.depth_mm,
        piece.socket_mm,
    ]
    .map(|mm| measured(mm, "mm"));
    let rod = format!("{}: {}", word(&piece.kind), bar(piece));
    match piece.kind {
        HardwareKind::Axle => format!(
            "{rod}: glued {depth} deep into the {socket} socket of each half, with {} between the halves; a shim of that thickness holds \
             them while the glue sets.",
            quantity(sheet.string_gap_mm.unwrap_or(0.0), "mm")
        ),
        HardwareKind::Ring => format!(
            "nuts, washers or a bearing about the axle in the gap, {} in all, counted as a ring of {} across and {length} wide.",
            quantity(piece.mass_g, "g"),
            quantity(piece.diameter_mm, "mm")
        ),
        HardwareKind::Tip => format!(
            "{rod}. File its lower end to a half ball. Glue it {depth} deep into the {socket} socket at the contact, with glue that fills \
             the gap (gel). Centre it and hold it upright until the glue sets; {out} stand out, and its end is the contact point."
        ),
        HardwareKind::Stem | HardwareKind::Dowel(_) => {
            format!("{rod}: glued {depth} deep into the {socket} socket on top; {out} stand out.")
        }
    }
}

/// The words for what is counted as a ring on an axle.
const RING: &str = "nuts, washers or a bearing for the axle";

/// Describes a piece as it is bought and cut, with its mass.
pub(super) fn bar(piece: &Hardware) -> String {
    format!("{} ({})", rod(piece), measured(piece.mass_g, "g"))
}

/// Describes a piece as it is bought and cut: `steel rod, 6 mm, cut to 85 mm, one end rounded`.
pub(super) fn rod(piece: &Hardware) -> String {
    if piece.kind == HardwareKind::Ring {
        return RING.to_owned();
    }
    let length_mm = (Point::from(piece.to_mm) - Point::from(piece.from_mm)).norm();
    let rounded = if piece.round_end {
        ", one end rounded"
    } else {
        ""
    };
    format!(
        "{}, {}, cut to {}{rounded}",
        stock(piece),
        quantity(piece.diameter_mm, "mm"),
        measured(length_mm, "mm")
    )
}

/// Names what a piece is cut from. Of other materials than steel only the density is known.
fn stock(piece: &Hardware) -> String {
    match &piece.kind {
        HardwareKind::Dowel(stock) => stock.clone(),
        _ if piece.density_g_cm3 == STEEL_G_CM3 => "steel rod".to_owned(),
        _ => format!("rod of {}", quantity(piece.density_g_cm3, "g/cm³")),
    }
}

/// Returns the word for a kind of hardware.
pub(super) fn word(kind: &HardwareKind) -> &str {
    match kind {
        HardwareKind::Axle => "axle",
        HardwareKind::Ring => "ring",
        HardwareKind::Tip => "tip",
        HardwareKind::Stem => "stem",
        HardwareKind::Dowel(stock) => stock,
    }
}

/// Returns how to align the halves of a yo-yo; empty for a single body.
fn align_halves(sheet: &Checklist) -> Markup {
    html! {
        @if let Some(turn) = &sheet.turn {
            p {
                strong { "Turn half A on the axle until its outline meets that of half B all around. " }
                "Look along the axle and along the seam, at ears, corners or any mark that runs over the seam. Do so before the glue sets. "
                @let most_deg = most_turn_deg(turn);
                "Turn it within " (measured(most_deg, "°"))
                " (" (measured(most_deg * rim_mm(sheet), "mm")) " at the rim)."
            }
        }
    }
}

/// Greatest turn of the halves, degrees, which a person sees by eye.
const EYE_DEG: f64 = 1.0;

/// Greatest distance of the centre of mass from the axis due to the turn of the halves, mm.
const MOST_OFFSET_MM: f64 = 0.05;

/// Returns the turn of the halves that moves the centre of mass no farther than allowed, degrees.
fn most_turn_deg(turn: &TurnRow) -> f64 {
    EYE_DEG.min(MOST_OFFSET_MM / turn.offset_mm_per_deg.max(f64::MIN_POSITIVE))
}

/// Returns the length of a degree at half the greatest size, mm.
fn rim_mm(sheet: &Checklist) -> f64 {
    0.5 * sheet.model.size_mm.into_iter().fold(0.0, f64::max) * 1f64.to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::steel_tip;

    #[test]
    fn a_tip_is_told_as_it_is_bought_and_cut() {
        let mut tip = Hardware {
            from_mm: [0.0, 0.0, 85.0],
            diameter_mm: 6.0,
            ..steel_tip()
        };
        let said = |piece: &Hardware| rod(piece).replace('\u{a0}', " ");
        assert_eq!(said(&tip), "steel rod, 6 mm, cut to 85 mm, one end rounded");
        tip.density_g_cm3 = 2.7;
        tip.round_end = false;
        assert_eq!(said(&tip), "rod of 2.7 g/cm³, 6 mm, cut to 85 mm");
    }
}
