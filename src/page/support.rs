//! The support of each part and of the whole job.

use crate::base::numbers::quantity;
use crate::base::units::{MM2_PER_CM2, format_count};
use crate::sheet::{Checklist, PartRow, Process, SupportMethod, SupportRow};

/// Height over the plate up to which overhangs are said to begin on the plate, mm.
const ON_PLATE_MM: f64 = 0.05;

/// Words the support setting of the slicer for a part, and where support touches it.
fn support_words(support: &SupportRow) -> String {
    if support.places == 0 {
        return "off, nothing hangs in the air".to_owned();
    }
    let areas = [
        ("outside", support.outside_mm2),
        ("in the open hollow", support.hollow_mm2),
        (
            "on cut faces and pins, where every remainder must be cut off flush",
            support.cut_face_mm2,
        ),
    ];
    let areas = areas.into_iter().filter(|(_, mm2)| *mm2 > 0.0);
    let areas: Vec<String> = areas
        .map(|(place, mm2)| format!("{} {place}", quantity(mm2 / MM2_PER_CM2, "cm²")))
        .collect();
    let areas = if areas.is_empty() {
        "no more than points".to_owned()
    } else {
        areas.join(", ")
    };
    let lowest = if support.from_mm < ON_PLATE_MM {
        0.0
    } else {
        support.from_mm
    };
    let [from, to] = [lowest, support.to_mm].map(|mm| quantity(mm, "mm"));
    format!(
        "on, under {} from {from} to {to} over the plate: {areas}",
        format_count(support.places, "place")
    )
}

/// Words the support of a part; `None` if the printer does not say which surfaces need it.
pub(super) fn of_part(part: &PartRow) -> Option<String> {
    part.support
        .map(|support| format!("Support {}.", support_words(&support)))
}

/// Words the support of the whole job.
pub(super) fn of_all(sheet: &Checklist) -> String {
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
            "on for some parts and off for others, as listed below; none in sockets. Support in an open hollow is removed in the next step."
                .to_owned()
        }
        Some(_) => "on for every part, as listed below; none in sockets. Support in an open hollow is removed in the next step."
            .to_owned(),
        None => by_process(sheet).to_owned(),
    }
}

/// Words the support by the process alone.
fn by_process(sheet: &Checklist) -> &'static str {
    match (sheet.printer.support, &sheet.printer.process) {
        (SupportMethod::None, _) => "none; the powder holds every part.",
        (SupportMethod::Breakaway, Process::Sla) => {
            "on, outside and under overhangs in an open hollow; none on cut faces, pins and sockets. It is removed in the next step."
        }
        (SupportMethod::Breakaway, _) => {
            "on where a part overhangs; none in sockets. Support in an open hollow is removed in the next step."
        }
        _ => "as the machine places it. Support in the voids is removed in the next step.",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    #[test]
    fn support_is_worded_by_part_if_known_else_by_process() {
        let mut sheet = sample().0;
        let process = of_all(&sheet);
        assert!(process.contains("as the machine places it") && of_part(&sheet.parts[0]).is_none());
        sheet
            .parts
            .iter_mut()
            .for_each(|part| part.support = Some(SupportRow::default()));
        assert!(of_all(&sheet).starts_with("off for every part"));
        assert_eq!(
            of_part(&sheet.parts[0]).unwrap(),
            "Support off, nothing hangs in the air."
        );
        let hangs = SupportRow {
            places: 2,
            hollow_mm2: 150.0,
            from_mm: 3.0,
            to_mm: 8.0,
            ..SupportRow::default()
        };
        sheet.parts[0].support = Some(hangs);
        assert!(of_all(&sheet).contains("on for some parts"));
        let words = of_part(&sheet.parts[0]).unwrap().replace('\u{a0}', " ");
        assert_eq!(
            words,
            "Support on, under 2 places from 3 mm to 8 mm over the plate: 1.5 cm² in the open hollow."
        );
        sheet
            .parts
            .iter_mut()
            .for_each(|part| part.support = Some(hangs));
        assert!(of_all(&sheet).starts_with("on for every part"));
    }
}
