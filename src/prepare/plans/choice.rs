//! A plan as it is reported: what it reaches, where its seams run, what it is made of.

use crate::advice::Reached;
use crate::base::units::format_count;
use crate::cut::{SeamLie, SeamNote};
use crate::hollow::Figure;
use crate::open::Leaning;
use crate::run::Achieved;

/// A plan to choose.
#[derive(Debug, Clone, serde::Serialize)]
pub struct PlanChoice {
    /// Its file.
    pub file: String,
    /// The tendency by which it was found.
    pub tendency: String,
    /// The figure that it reaches.
    pub figure: Figure,
    /// Its value.
    pub value: f64,
    /// Share by which the figure is worse than in the best of the plans.
    pub loss_ratio: f64,
    /// Number of parts.
    pub parts: usize,
    /// True if it is printed in one piece without voids.
    pub is_solid: bool,
    /// Number of pins.
    pub pins: usize,
    /// Number of joints that lack their two pins.
    pub joints_without_pins: usize,
    /// The seams.
    pub seams: Vec<SeamRow>,
    /// Other plans that a person may prefer, or what hidden seams would cost.
    pub offers: Vec<String>,
}

/// The seam of a cut, as it is reported.
#[derive(Debug, Clone, serde::Serialize)]
pub struct SeamRow {
    /// The cut's id.
    pub cut: String,
    /// Its length on the outside, mm.
    pub length_mm: f64,
    /// What is seen of it: 0.05 in a neck, 0.2 at a waist, more through a face.
    pub seen_ratio: f64,
    /// Its lie and place, in words.
    pub place: String,
    /// True if it is slanted and follows neither a neck, a crease nor the base.
    pub is_slanted: bool,
}

/// Measures a plan against all that were found.
pub(super) fn choice(file: String, leaning: &Leaning, all: &[Leaning]) -> PlanChoice {
    let plan = &leaning.opened.plan;
    let reached = |leaning: &Leaning| Achieved::of(&leaning.opened.voids);
    let certificate = reached(leaning).certificate;
    let losses = all
        .iter()
        .map(|other| reached(other).loss_ratio(&reached(leaning)));
    let unaligned = plan.joints.iter().filter(|joint| !joint.is_aligned());
    PlanChoice {
        file,
        tendency: leaning.tendency.to_string(),
        figure: certificate.figure,
        value: certificate.value,
        loss_ratio: losses.fold(0.0, f64::max),
        parts: plan.count_parts(),
        is_solid: plan.cuts.is_empty() && leaning.opened.voids.hollowed.voids.is_empty(),
        pins: plan.pins.len(),
        joints_without_pins: unaligned.count(),
        seams: leaning.seams.iter().map(seam_row).collect(),
        offers: leaning
            .opened
            .remarks
            .iter()
            .filter(|remark| remark.is_offer())
            .map(ToString::to_string)
            .collect(),
    }
}

fn seam_row(seam: &SeamNote) -> SeamRow {
    let lie = match seam.lie {
        Some(SeamLie::Level) => "level",
        Some(SeamLie::Upright) => "upright",
        Some(SeamLie::AlongNeck) => "along a neck",
        Some(SeamLie::AlongCrease) => "along a crease",
        Some(SeamLie::AlongBase) => "along the base",
        Some(SeamLie::Slanted) | None => "slanted",
    };
    let place = seam.heights.map_or_else(String::new, |[low, high]| {
        // Rounding may leave a zero with a minus sign.
        let [low, high] = [low, high].map(|height| (100.0 * height).round() + 0.0);
        if low == high {
            format!(", at {low} % of the height")
        } else {
            format!(", from {low} to {high} % of the height")
        }
    });
    SeamRow {
        cut: seam.cut.to_string(),
        length_mm: seam.length_mm,
        seen_ratio: seam.seen_ratio.unwrap_or_default(),
        place: format!("{lie}{place}"),
        is_slanted: seam.lie == Some(SeamLie::Slanted),
    }
}

/// Ratio up to which a seam is hardly seen: that of a neck. A waist has twice as much.
const HARDLY_SEEN_RATIO: f64 = 0.1;
/// Ratio up to which a seam is seen a little. A seam through a face has more.
const LITTLE_SEEN_RATIO: f64 = 0.3;

/// Words a seam: its length, its lie and place, and how much of it is seen.
pub fn seam_words(seam: &SeamRow) -> String {
    let seen = if seam.seen_ratio <= HARDLY_SEEN_RATIO {
        "hardly seen"
    } else if seam.seen_ratio <= LITTLE_SEEN_RATIO {
        "seen a little"
    } else {
        "easily seen"
    };
    format!("{:.0} mm, {}; {seen}", seam.length_mm, seam.place)
}

/// Words the number of parts. A body in one piece without voids is solid, and the words say so.
pub fn part_words(choice: &PlanChoice) -> String {
    let parts = format_count(choice.parts, "part");
    if choice.is_solid {
        format!("{parts}, printed solid")
    } else {
        parts
    }
}

/// Returns the figure and its loss against the best of the plans.
pub fn figure_words(choice: &PlanChoice) -> String {
    let reached = Reached {
        figure: choice.figure,
        value: choice.value,
    };
    if choice.loss_ratio < 0.0005 {
        format!("{reached}, the best of these")
    } else {
        format!(
            "{reached}, {:.1} % worse than the best of these",
            100.0 * choice.loss_ratio
        )
    }
}

/// Returns the number of pins, and of joints that lack them.
pub(super) fn pin_words(choice: &PlanChoice) -> String {
    let pins = format_count(choice.pins, "pin");
    match choice.joints_without_pins {
        0 => pins,
        lacking => format!("{pins}; {} without two", format_count(lacking, "joint")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_is_worded_by_how_much_of_it_is_seen() {
        let row = |seen_ratio: f64| SeamRow {
            cut: "C1".to_owned(),
            length_mm: 57.6,
            seen_ratio,
            place: "level, at 44 % of the height".to_owned(),
            is_slanted: false,
        };
        assert_eq!(
            seam_words(&row(0.05)),
            "58 mm, level, at 44 % of the height; hardly seen"
        );
        assert!(seam_words(&row(0.2)).ends_with("seen a little"));
        assert!(seam_words(&row(0.5)).ends_with("easily seen"));
    }
}
