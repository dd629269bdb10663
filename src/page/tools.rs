//! The things to have at hand for the steps: tools, a scale, glue and those of the test.

use super::fields::spread_ratio;
use super::hardware::rod;
use super::weighing::whole_margin_g;
use crate::goal::GoalKind;
use crate::sheet::{Checklist, Process};
use crate::verify::{Hardware, HardwareKind};

/// Half of a part's window of masses, g, from which a scale that shows 0.1 g tells sound parts from
/// others.
const COARSE_SCALE_G: f64 = 0.2;

/// Mass of hardware, g, below which the sheet gives hundredths of a gram.
const LIGHT_HARDWARE_G: f64 = 10.0;

/// Returns what must be at hand, in the order of the steps.
pub(super) fn you_need(sheet: &Checklist) -> String {
    let glue = sheet.printer.glue.as_ref().map(|glue| glue.name.clone());
    let glue = glue.filter(|_| is_glued(sheet));
    let things = [
        for_cleaning(&sheet.printer.process).map(str::to_owned),
        Some(scale(sheet).to_owned()),
        glue,
        for_hardware(sheet),
        for_test(sheet.goal.aim.kind).map(str::to_owned),
    ];
    let things: Vec<String> = things.into_iter().flatten().collect();
    things.join("; ")
}

/// Returns whether anything is glued: joints, or plugs in drain holes.
fn is_glued(sheet: &Checklist) -> bool {
    !sheet.joints.is_empty() || sheet.plugs().next().is_some()
}

/// Names the tools that clean the parts; `None` for an unknown process.
fn for_cleaning(process: &Process) -> Option<&'static str> {
    match process {
        Process::Fdm => Some("cutters, pliers and a lamp for the support"),
        Process::Sla => Some("a washing bath and a curing lamp"),
        Process::Polyjet => Some("a water jet"),
        Process::Mjp => Some("an oven and an oil bath for the wax"),
        Process::Sls | Process::Mjf => Some("compressed air and brushes"),
        Process::Other(_) => None,
    }
}

/// Names a scale that tells sound parts from others, weighs the hardware, and shows the margin of
/// the whole.
fn scale(sheet: &Checklist) -> &'static str {
    let masses = sheet.parts.iter().map(|part| part.mass_g);
    let least_g = masses.fold(f64::INFINITY, f64::min);
    let is_light = sheet
        .hardware
        .iter()
        .any(|piece| piece.mass_g < LIGHT_HARDWARE_G);
    let is_narrow = whole_margin_g(sheet).is_some_and(|margin_g| margin_g < COARSE_SCALE_G);
    if is_light || is_narrow || spread_ratio(sheet) * least_g < COARSE_SCALE_G {
        "a scale that shows 0.01\u{a0}g"
    } else {
        "a scale that shows 0.1\u{a0}g"
    }
}

/// Names what is put in, and the tools that cut it; `None` if nothing is.
fn for_hardware(sheet: &Checklist) -> Option<String> {
    let bought: Vec<String> = sheet.hardware.iter().map(rod).collect();
    let is_rod = |piece: &Hardware| piece.kind != HardwareKind::Ring;
    let has_rods = sheet.hardware.iter().any(is_rod);
    let tools = if has_rods { "; a saw and a file" } else { "" };
    (!bought.is_empty()).then(|| bought.join("; ") + tools)
}

/// Names the things of the last test; `None` if hands are enough.
fn for_test(kind: GoalKind) -> Option<&'static str> {
    match kind {
        GoalKind::Top => Some("a thread; a hard, smooth table"),
        GoalKind::Yoyo => Some("a thread; a string"),
        GoalKind::Stand => Some("a thread; a rough board of 300\u{a0}mm and a ruler"),
        GoalKind::Float => Some("a basin deeper than the object"),
        GoalKind::Balance => Some("two level knife edges; a balancing machine"),
        GoalKind::Match => Some("two threads"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::FlatFace;
    use crate::testing::{sample, steel_tip};
    use crate::verify::GlueFilm;

    #[test]
    fn the_list_names_the_tools_of_the_process_and_of_the_test() {
        let mut sheet = sample().0;
        sheet.printer.process = Process::Fdm;
        sheet.goal.aim.kind = GoalKind::Stand;
        let said = you_need(&sheet);
        assert!(said.starts_with("cutters, pliers and a lamp"), "{said}");
        assert!(
            said.contains("cyanoacrylate") && said.ends_with("a ruler"),
            "{said}"
        );
        sheet.joints.clear();
        sheet.printer.process = Process::Sls;
        sheet.goal.aim.kind = GoalKind::Float;
        let said = you_need(&sheet);
        assert!(
            said.starts_with("compressed air") && !said.contains("cyanoacrylate"),
            "{said}"
        );
    }

    #[test]
    fn a_rod_is_on_the_list_with_the_tools_that_cut_it() {
        let mut sheet = sample().0;
        assert!(!you_need(&sheet).contains("a saw"));
        sheet.hardware.push(steel_tip());
        let said = you_need(&sheet).replace('\u{a0}', " ");
        let rod = "steel rod, 3 mm, cut to 12 mm, one end rounded; a saw and a file";
        assert!(said.contains(rod), "{said}");
    }

    #[test]
    fn light_parts_need_a_finer_scale() {
        let mut sheet = sample().0;
        sheet.material.density_spread_ratio = Some(0.02);
        let scale_for = |sheet: &mut Checklist, mass_g: f64| {
            sheet.parts.iter_mut().for_each(|part| part.mass_g = mass_g);
            scale(sheet)
        };
        assert!(scale_for(&mut sheet, 1.4).contains("0.01"));
        assert!(scale_for(&mut sheet, 50.0).contains("0.1\u{a0}g"));
        let film = |mass_g| GlueFilm {
            thickness_mm: 0.05,
            density_g_cm3: 1.1,
            mass_g,
            face: FlatFace {
                area_mm2: 100.0,
                center_mm: [0.0; 3],
                squares_mm4: [[0.0; 3]; 3],
            },
        };
        // The whole is rejected beyond the glue and a tenth of a gram.
        sheet.joints[0].glue = Some(film(0.05));
        assert!(scale_for(&mut sheet, 50.0).contains("0.01"));
        sheet.joints[0].glue = Some(film(0.5));
        assert!(scale_for(&mut sheet, 50.0).contains("0.1\u{a0}g"));
    }
}
