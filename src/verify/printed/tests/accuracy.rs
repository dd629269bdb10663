//! Right prints pass although slicers word and lay them in many ways, and no fault hides another.

use super::*;
use crate::goal::GoalKind;
use crate::verify::{Aim, FigureName, PromisedFigure, RotorOrder};

/// Judges both trays, the second with other boxes.
fn judged_with(second: &[Block]) -> PrintedJudgement {
    let text = RIGHT.gcode(&[
        (LABELS[0], LOWS_MM[0], &TRAY),
        (LABELS[1], LOWS_MM[1], second),
    ]);
    judged(&kit(), text)
}

/// Returns the print of both trays after these lines, with lines between the parts: the second part
/// follows on `between`.
fn with_tools(stated: &str, first: &str, second: &str) -> PrintedJudgement {
    let unstated = Print {
        density_g_cm3: None,
        ..RIGHT
    };
    let text = unstated.trays(LABELS);
    let [one, two] = LABELS.map(|label| format!("; printing object {}\n", label.unwrap()));
    let text = text.replace(&one, &format!("{first}\n{one}"));
    let text = text.replace(&two, &format!("{second}\n{two}"));
    judged(&kit(), format!("; filament_density = {stated}\n{text}"))
}

#[test]
fn lines_in_the_air_do_not_lower_the_foot_of_a_part() {
    // A bridge by a nozzle of 0.6 mm in the second layer seems to begin below the plate.
    let fine = Print {
        layer_mm: 0.1,
        ..RIGHT
    };
    let bridge = "; printing object P01.stl id:0 copy 0\n;TYPE:Bridge infill\n;HEIGHT:0.6\n\
        G1 X30 Y30 Z0.2\nG1 X32 Y30 E0.5\n; stop printing object P01.stl id:0 copy 0\n";
    let text = fine.trays(LABELS);
    let third = text.match_indices(";LAYER_CHANGE").nth(2).unwrap().0;
    let (below, above) = text.split_at(third);
    let mut evidence = kit();
    evidence.promise.printer.layer_mm = Some(0.1);
    let found = judged(&evidence, format!("{below}{bridge}{above}"));
    assert!(found.parts[0].center_off_mm < 0.01, "{:?}", found.parts[0]);
    assert_eq!(broken(&found), Vec::<String>::new());
}

#[test]
fn each_tool_has_its_own_density() {
    // The second filament prints nothing.
    let found = with_tools("1.2,1.5", "", "");
    assert_right(&found);
    // The second part is of it.
    let found = with_tools("1.2,1.5", "T0", "T1");
    assert_eq!(kinds(&found), [CauseKind::Density]);
    let off = found.parts.iter().map(PrintedPart::mass_off_ratio);
    for (off, wanted) in off.zip([0.0, 0.25]) {
        assert!((off - wanted).abs() < 1e-9, "{off}");
    }
    // A value that no filament can have leaves the others at their tools.
    let found = with_tools("9000,1.2", "T1", "T1");
    assert_right(&found);
    assert_eq!(found.notes, Vec::<String>::new());
}

#[test]
fn a_density_within_its_tolerance_passes_and_another_is_no_fault_of_the_flow() {
    let print = |density: f64| {
        let other = Print {
            density_g_cm3: Some(density),
            ..RIGHT
        };
        judged(&kit(), other.trays(LABELS))
    };
    let near = print(1.2 * 1.019);
    assert!(near.passes(), "{:?}", broken(&near));
    assert_eq!(kinds(&near), []);
    let far = print(1.5);
    assert!(!far.passes() && !broken(&far).contains(&"printed mass".to_owned()));
}

#[test]
fn a_low_flow_is_not_taken_for_the_infill_that_a_file_states() {
    let thin = Print {
        stated_fill_ratio: Some(0.15),
        flow_ratio: 0.9,
        ..RIGHT
    };
    let found = judged(&kit(), thin.trays(LABELS));
    assert_eq!(kinds(&found), [CauseKind::Flow], "{:?}", found.causes);
    assert!(found.causes[0].finding.contains("90.0 %"));
}

#[test]
fn layers_that_the_printer_lays_as_well_are_told_and_pass() {
    for layer_mm in [0.15, 0.25] {
        let other = Print { layer_mm, ..RIGHT };
        let found = judged(&kit(), other.trays(LABELS));
        assert_eq!(kinds(&found), [CauseKind::LayerHeight], "{layer_mm}");
        assert!(!found.causes[0].is_wrong && found.passes(), "{layer_mm}");
    }
}

#[test]
fn a_long_thin_end_that_is_left_out_is_no_scale() {
    // The last quarter of a millimetre of a leg is missing, and with it spread along the leg.
    let mut short = TRIPOD;
    short[0].1[0] -= 0.25;
    let text = RIGHT.gcode(&[(LABELS[0], LOWS_MM[0], &short)]);
    let found = judged(&tripod_kit(), text);
    let [x, y, z] = found.parts[0].size_ratio;
    assert!(
        x < 0.994 && y > 0.999 && z > 0.999,
        "{:?}",
        found.parts[0].size_ratio
    );
    assert_eq!(kinds(&found), [], "{:?}", found.causes);
    // An edge that is 3 % shorter is told.
    short[0].1[0] -= 1.0;
    let text = RIGHT.gcode(&[(LABELS[0], LOWS_MM[0], &short)]);
    let found = judged(&tripod_kit(), text);
    assert_eq!(kinds(&found), [CauseKind::Scale], "{:?}", found.parts[0]);
}

#[test]
fn a_set_flow_that_calibrates_passes_and_another_is_wrong() {
    let print = |percent: u32| {
        let text = RIGHT.trays(LABELS);
        judged(&kit(), format!("M221 S{percent}\n{text}"))
    };
    let calibrated = print(95);
    assert!(calibrated.passes() && kinds(&calibrated).is_empty());
    assert!(calibrated.notes[0].contains("95.0 % (M221)"));
    let wrong = print(40);
    assert!(!wrong.passes());
    assert_eq!(kinds(&wrong), [CauseKind::Flow]);
    assert!(wrong.causes[0].finding.contains("40 % (M221)"));
}

#[test]
fn the_calibration_of_a_filament_is_taken_off_and_a_wrong_flow_is_not() {
    let print = |percent: u32| {
        let ratio = f64::from(percent) / 100.0;
        let other = Print {
            flow_ratio: ratio,
            ..RIGHT
        };
        let text = other.trays(LABELS);
        judged(&kit(), format!("{text}; extrusion_multiplier = {ratio}\n"))
    };
    for percent in [95, 104] {
        let found = print(percent);
        assert_right(&found);
        assert!(found.notes[0].contains(&format!("{percent}.0 % for its filament")));
    }
    let found = print(85);
    assert_eq!(kinds(&found), [CauseKind::Flow]);
    assert!(!found.passes());
}

#[test]
fn a_failed_check_without_a_wrong_setting_says_so() {
    // One wall is thinner and the one opposite thicker, as whole lines make them.
    let mut uneven = TRAY;
    uneven[3].1[0] = 2.4;
    uneven[4] = ([56.4, 3.0, 3.0], [3.6, 34.0, 3.0]);
    let found = judged_with(&uneven);
    assert_eq!(kinds(&found), [], "{:?}", found.causes);
    assert!(!found.passes());
    let note = found.notes.last().unwrap();
    assert!(note.starts_with("no wrong setting was found"), "{note}");
    assert!(judged_with(&TRAY).notes.is_empty());
}

#[test]
fn a_rotor_may_be_as_coarse_as_its_grade_and_no_coarser() {
    // The axis lies 0.005 mm beside the middle of the trays: at 3000 rpm at least 1.57 mm/s.
    let of_grade = |grade_mm_s: f64| {
        let mut evidence = kit();
        evidence.promise.goal = Aim {
            rotor: Some(RotorOrder {
                speed_rpm: 3000.0,
                grade_mm_s,
            }),
            ..Aim::new(GoalKind::Balance, [30.005, 20.0, 0.0], [0.0, 0.0, 1.0])
        };
        // Written parts have a finer one.
        evidence.promise.promise = Some(PromisedFigure {
            figure: FigureName::BalanceGradeMmS,
            value: 0.01,
        });
        judged(&evidence, RIGHT.trays(LABELS))
    };
    let value_mm_s = |found: &PrintedJudgement| {
        let check = found.checks.last().unwrap();
        assert_eq!(check.kind.to_string(), "balance grade");
        check.value.unwrap()
    };
    let reached_mm_s = value_mm_s(&of_grade(1000.0));
    assert!(reached_mm_s > 1.5, "{reached_mm_s}");
    let fine = of_grade(1.01 * reached_mm_s);
    assert_eq!(broken(&fine), Vec::<String>::new());
    let coarse = of_grade(0.99 * reached_mm_s);
    assert_eq!(broken(&coarse), ["balance quality", "balance grade"]);
}

#[test]
fn spreads_that_miss_along_other_edges_tell_of_no_scale() {
    let evidence = kit();
    let part = judged(&evidence, RIGHT.trays(LABELS)).parts[0].clone();
    let is_scaled = |size_ratio: [f64; 3], spread_ratio: [f64; 3]| {
        let part = PrintedPart {
            size_ratio,
            spread_ratio,
            ..part.clone()
        };
        causes::is_scaled(&part, &evidence.promise)
    };
    let shrunk = [0.985, 1.0, 1.0];
    assert!(is_scaled(shrunk, [0.985, 1.0, 1.0]));
    // What slicers lay wrong of a sound part.
    assert!(is_scaled(shrunk, [0.985, 1.004, 0.992]));
    // A thin lid that lost its tips: its spreads miss by more than its edge.
    assert!(!is_scaled(shrunk, [0.985, 1.021, 1.0]));
    assert!(!is_scaled([0.987, 1.001, 0.992], [0.983, 1.021, 1.016]));
    assert!(is_scaled([0.985; 3], [0.985; 3]));
}
