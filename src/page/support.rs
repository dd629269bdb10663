//! The support of each part and of the whole job.

use crate::base::numbers::measured;
use crate::base::units::{MM2_PER_CM2, MM3_PER_CM3};
use crate::sheet::{Checklist, PartRow, Process, SupportMethod, SupportRow};

/// Area up to which support is not reported, mm²: a point or two.
const LEAST_AREA_MM2: f64 = 0.5;

/// Words the support setting of the slicer for a part, and where support touches it.
fn support_words(support: &SupportRow, has_pins: bool) -> String {
    if support.places == 0 {
        return "off, nothing hangs in the air".to_owned();
    }
    let areas = [
        ("outside", support.outside_mm2),
        ("in the open hollow", support.hollow_mm2),
        (
            if has_pins {
                "on cut faces and pins: cut every rest off flush"
            } else {
                "on cut faces: cut every rest off flush"
            },
            support.cut_face_mm2,
        ),
    ];
    let areas = areas.into_iter().filter(|(_, mm2)| *mm2 > LEAST_AREA_MM2);
    let areas: Vec<String> = areas
        .map(|(place, mm2)| format!("{} {place}", measured(mm2 / MM2_PER_CM2, "cm²")))
        .collect();
    let areas = if areas.is_empty() {
        "a few points".to_owned()
    } else {
        areas.join(", ")
    };
    format!("on: {areas}")
}

/// The first word on how a part lies that neither lies nor stands on a flat face.
const LEANING: &str = "leaning";

/// Least mass of support that is reported, g.
const LEAST_G: f64 = 0.05;

/// Words the support of a part; `None` if the printer does not say which surfaces need it.
pub(super) fn of_part(sheet: &Checklist, part: &PartRow) -> Option<String> {
    let support = part.support?;
    let about_g = mass_g(sheet, &support);
    let mass = if about_g < LEAST_G {
        String::new()
    } else {
        format!("; about {}", measured(about_g, "g"))
    };
    Some(format!(
        "Support {}{mass}.",
        support_words(&support, !part.pins.is_empty())
    ))
}

/// Returns the estimated mass of a part's support, g, in the material of the parts.
fn mass_g(sheet: &Checklist, support: &SupportRow) -> f64 {
    support.material_mm3 / MM3_PER_CM3 * sheet.material.density_g_cm3
}

/// Words the mass of all support, by the program's own estimate; empty if there is next to none.
fn all_words(sheet: &Checklist) -> String {
    let supports = sheet.parts.iter().filter_map(|part| part.support);
    let all_g: f64 = supports.map(|support| mass_g(sheet, &support)).sum();
    if all_g < LEAST_G {
        String::new()
    } else {
        format!(
            " About {} of support in all, by our own estimate.",
            measured(all_g, "g")
        )
    }
}

/// Words the support of the whole job.
pub(super) fn of_all(sheet: &Checklist) -> String {
    method_words(sheet) + &all_words(sheet) + why_they_lean(sheet)
}

/// Returns why parts lean; empty if none does, or if the slicer places the support.
fn why_they_lean(sheet: &Checklist) -> &'static str {
    let leans = |part: &PartRow| part.lies.starts_with(LEANING) && part.support.is_some();
    if sheet.parts.iter().any(leans) {
        " Parts that lean need less support that way."
    } else {
        ""
    }
}

/// Words the settings for support.
fn method_words(sheet: &Checklist) -> String {
    let known: Option<Vec<usize>> = sheet
        .parts
        .iter()
        .map(|part| part.support.map(|support| support.places))
        .collect();
    match known {
        Some(places) if places.iter().all(|&count| count == 0) => {
            "off for every part: nothing hangs in the air as they lie.".to_owned()
        }
        Some(places) if places.contains(&0) => {
            format!(
                "on for the parts marked below, off for the others. {}Support inside a hollow is removed in the next step.",
                of_holes(sheet)
            )
        }
        Some(_) if sheet.infill.is_some() => "on, for the outside.".to_owned(),
        Some(_) => format!(
            "on for every part. {}Support inside a hollow is removed in the next step.",
            of_holes(sheet)
        ),
        None => by_process(sheet).to_owned(),
    }
}

/// Words that pin holes hold no support; empty without pins.
fn of_holes(sheet: &Checklist) -> &'static str {
    if sheet.joints.iter().any(|joint| joint.pins > 0) {
        "None in the pin holes. "
    } else {
        ""
    }
}

/// Words the support by the process alone.
fn by_process(sheet: &Checklist) -> &'static str {
    match (sheet.printer.support, &sheet.printer.process) {
        (SupportMethod::None, _) => "none; the powder holds every part.",
        (SupportMethod::Breakaway, Process::Sla) if !sheet.drains.is_empty() => {
            "the slicer adds the raft and the supports, outside only: none could be taken out of a void. None in the mouth of a drain hole."
        }
        (SupportMethod::Breakaway, Process::Sla) => {
            "the slicer adds the raft and the supports. No support on cut faces, pins or pin holes. Inside an open hollow as few supports as possible."
        }
        (SupportMethod::Breakaway, _) => {
            "on where a part overhangs, none in the pin holes. Support inside a hollow is removed in the next step."
        }
        _ => "as the machine places it. Support in the voids is removed in the next step.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    #[test]
    fn the_sheet_says_why_parts_lean() {
        let mut sheet = sample().0;
        let why = "need less support that way";
        sheet.parts[0].support = Some(SupportRow::default());
        assert!(!of_all(&sheet).contains(why));
        sheet.parts[0].lies = "leaning, as in the picture".to_owned();
        assert!(of_all(&sheet).contains(why));
    }

    #[test]
    fn support_is_worded_by_part_if_known_else_by_process() {
        let mut sheet = sample().0;
        let process = of_all(&sheet);
        assert!(
            process.contains("as the machine places it")
                && of_part(&sheet, &sheet.parts[0]).is_none()
        );
        sheet
            .parts
            .iter_mut()
            .for_each(|part| part.support = Some(SupportRow::default()));
        assert!(of_all(&sheet).starts_with("off for every part"));
        assert_eq!(
            of_part(&sheet, &sheet.parts[0]).unwrap(),
            "Support off, nothing hangs in the air."
        );
        let hangs = SupportRow {
            places: 2,
            hollow_mm2: 150.0,
            material_mm3: 1000.0,
            from_mm: 3.0,
            to_mm: 8.0,
            ..SupportRow::default()
        };
        sheet.parts[0].support = Some(hangs);
        assert!(of_all(&sheet).contains("on for the parts marked below"));
        let words = of_part(&sheet, &sheet.parts[0])
            .unwrap()
            .replace('\u{a0}', " ");
        assert_eq!(
            words,
            "Support on: 1.5 cm² in the open hollow; about 1.20 g."
        );
        sheet
            .parts
            .iter_mut()
            .for_each(|part| part.support = Some(hangs));
        assert!(of_all(&sheet).starts_with("on for every part"));
    }
}
