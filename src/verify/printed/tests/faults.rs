//! Each wrong setting is named, with the setting to change.

use super::*;

/// Judges a print of both trays with a fault; returns its only cause.
fn only_cause(print: Print) -> Cause {
    let found = judged(&kit(), print.trays(LABELS));
    assert!(!found.passes());
    assert_eq!(found.causes.len(), 1, "{:?}", found.causes);
    found.causes.into_iter().next().unwrap()
}

#[test]
fn sparse_infill_is_named() {
    let cause = only_cause(Print {
        fill_ratio: 0.15,
        ..RIGHT
    });
    assert_eq!(cause.kind, CauseKind::Infill);
    assert!(
        cause.finding.contains("15 %")
            && cause
                .remedy
                .contains("Fill density (fill_density) to 100 %")
    );
}

#[test]
fn a_scaled_plate_is_named() {
    let cause = only_cause(Print {
        scale_ratio: 1.01,
        ..RIGHT
    });
    assert_eq!(cause.kind, CauseKind::Scale);
    assert!(
        cause.finding.contains("P01 has 101.0 × 101.0"),
        "{}",
        cause.finding
    );
}

#[test]
fn a_thin_tip_that_is_left_out_is_no_scale() {
    // Fins of the width of a line reach 1 mm beyond two walls; slicers leave them out.
    let fins = [
        block(Point::new(60.0, 19.75, 0.0), [1.0, 0.5, 6.0]),
        block(Point::new(29.75, 40.0, 0.0), [0.5, 1.0, 6.0]),
    ];
    let mut evidence = kit();
    let tray = evidence.parts[0].mesh.clone();
    evidence.parts[0].mesh = fins.iter().fold(tray, |mesh, fin| mesh.joined(fin));
    let spot = &mut evidence.promise.plates[0].holds[0];
    spot.size_mm = spot.size_mm.map(|mm| mm + 1.0);
    let found = judged(&evidence, RIGHT.trays(LABELS));
    for (ratio, mm) in found.parts[0].size_ratio.iter().zip([60.0, 40.0]) {
        assert!((ratio - mm / (mm + 1.0)).abs() < 1e-3, "{ratio}");
    }
    assert_eq!(kinds(&found), [], "{:?}", found.causes);
    // A plate of 99 % is shorter too, and its material is as well.
    let small = Print {
        scale_ratio: 0.99,
        ..RIGHT
    };
    assert_eq!(only_cause(small).kind, CauseKind::Scale);
}

#[test]
fn glue_hardware_and_ballast_are_those_of_the_promise() {
    let mut evidence = kit();
    let plain_g = judged(&evidence, RIGHT.trays(LABELS)).written.mass_g;
    evidence.promise.hardware.push(Hardware {
        id: "H1".into(),
        kind: HardwareKind::Tip,
        from_mm: [0.0, 0.0, 8.0],
        to_mm: [0.0, 0.0, 4.0],
        diameter_mm: 4.0,
        hole_mm: 0.0,
        round_end: false,
        density_g_cm3: 7.8,
        mass_g: 0.4,
        depth_mm: 2.0,
        socket_mm: 0.0,
    });
    let found = judged(&evidence, RIGHT.trays(LABELS));
    let toolpaths = found.toolpaths.unwrap();
    assert!(found.written.mass_g > plain_g + 0.3);
    assert!((toolpaths.mass_g - found.written.mass_g).abs() < 1e-9);
    for axis in 0..3 {
        let apart_mm = toolpaths.center_mm[axis] - found.written.center_mm[axis];
        assert!(apart_mm.abs() < 1e-9, "{apart_mm}");
    }
    let printed_g: f64 = found.parts.iter().map(|part| part.mass_g).sum();
    assert!((printed_g - plain_g).abs() < 1e-9);
}

#[test]
fn thick_layers_are_named() {
    let cause = only_cause(Print {
        layer_mm: 0.3,
        ..RIGHT
    });
    assert_eq!(cause.kind, CauseKind::LayerHeight);
    assert!(cause.finding.contains("0.30 mm") && cause.remedy.contains("(layer_height) to 0.2 mm"));
}

#[test]
fn another_density_is_named_and_weighed() {
    let heavy = Print {
        density_g_cm3: Some(1.5),
        ..RIGHT
    };
    assert_eq!(only_cause(heavy).kind, CauseKind::Density);
    let found = judged(&kit(), heavy.trays(LABELS));
    let ratio = found.toolpaths.unwrap().mass_g / found.written.mass_g;
    assert!((ratio - 1.25).abs() < 1e-9, "{ratio}");
    // Without a density, and with one of no filament, the kit's is taken, and that is said.
    for density_g_cm3 in [None, Some(1240.0)] {
        let unknown = Print {
            density_g_cm3,
            ..RIGHT
        };
        let found = judged(&kit(), unknown.trays(LABELS));
        assert_right(&found);
        assert!(found.notes[0].contains("the kit's 1.2 g/cm³ is taken"));
    }
}

#[test]
fn a_mirror_image_is_named() {
    let print = |print: Print| {
        judged(
            &tripod_kit(),
            print.gcode(&[(LABELS[0], LOWS_MM[0], &TRIPOD)]),
        )
    };
    let found = print(RIGHT);
    assert_eq!(kinds(&found), []);
    assert!(found.parts[0].center_off_mm < 1e-9);
    let found = print(Print {
        is_mirrored: true,
        ..RIGHT
    });
    assert_eq!(kinds(&found), [CauseKind::Mirror]);
    assert!(found.parts[0].center_off_mm > 1.0 && !found.passes());
}

#[test]
fn support_in_a_void_is_told_with_its_mass() {
    let mut text = RIGHT.trays(LABELS);
    text += ";LAYER_CHANGE\n;HEIGHT:0.2\n; printing object P01.stl id:0 copy 0\n\
        ;TYPE:Support material\nG1 X20 Y30 Z4.5\nG1 X50 Y30 E100\n\
        G1 X5 Y5 Z4.5\nG1 X5 Y8 E7\n";
    let found = judged(&kit(), text);
    assert_eq!(kinds(&found), [CauseKind::SupportInVoid]);
    assert!(found.passes(), "{:?}", broken(&found));
    assert!((found.parts[0].support_in_voids_mm3 - 100.0).abs() < 1e-6);
    assert!((found.parts[0].support_mm3 - 107.0).abs() < 1e-6);
    assert!(found.causes[0].finding.contains("0.12 g in P01"));
}
