//! Rotors, boats, ballast and fillings, judged as the sound kit is.

use super::*;

/// Returns the sound box as a rotor about a point; its own middle is at z = 16.
fn rotor(origin_mm: [f64; 3], speed_rpm: f64) -> Evidence {
    let mut evidence = sound_kit();
    let rotor = Some(RotorOrder {
        speed_rpm,
        grade_mm_s: 2.5,
    });
    evidence.promise.goal = Aim {
        rotor,
        ..Aim::new(GoalKind::Balance, origin_mm, [0.0, 0.0, 1.0])
    };
    evidence
}

#[test]
fn a_rotor_ten_micrometres_aside_keeps_its_grade_slowly_and_breaks_it_fast() {
    // G = e ω: 0.01 mm at 2000 rpm is 2.09 mm/s, at 3000 rpm 3.14.
    assert_eq!(
        failures(&rotor([0.01, 0.0, 16.0], 2000.0)),
        Vec::<String>::new()
    );
    assert_eq!(
        failures(&rotor([0.01, 0.0, 16.0], 3000.0)),
        ["balance quality"]
    );
    let unbalance = judge(&rotor([0.01, 0.0, 16.0], 3000.0))
        .assembly
        .unbalance
        .unwrap();
    let mass_g = judge(&sound_kit()).assembly.mass_g;
    assert!((unbalance.static_g_mm - 0.01 * mass_g).abs() < 1e-9 && unbalance.couple_g_mm2 < 1e-9);
}

/// Returns the sound box with this promised waterline, in a liquid in which it lies 6 mm deep.
fn boat(waterline_mm: f64) -> Evidence {
    let mut evidence = sound_kit();
    // Density of the liquid: mass over displaced volume, 1.2 · (28 800 − 11 016)/(2400 · T) at a
    // draught of T mm. That is 1.482 at 6 mm.
    let liquid_g_cm3 = 1.2 * (28_800.0 - 11_016.0) / (2400.0 * 6.0);
    let water = Some(WaterOrder {
        liquid_g_cm3,
        waterline_mm,
    });
    evidence.promise.goal = Aim {
        water,
        ..Aim::new(GoalKind::Float, [0.0, 0.0, 10.0], [0.0, 0.0, 1.0])
    };
    evidence
}

#[test]
fn a_box_that_floats_as_promised_passes_and_one_promised_higher_fails() {
    assert_eq!(failures(&boat(6.0)), Vec::<String>::new());
    assert_eq!(failures(&boat(5.9)), ["waterline"]);
    let afloat = judge(&boat(6.0)).assembly.afloat.unwrap();
    // KB = 3, BM = B²/(12 T) = 1600/72, KG = 6.
    assert!((afloat.metacentric_height_mm - (3.0 + 1600.0 / 72.0 - 6.0)).abs() < 1e-4);
}

#[test]
fn a_box_heavier_than_its_water_sinks_and_fails_every_promise_of_floating() {
    let mut evidence = boat(6.0);
    evidence.promise.goal.water = Some(WaterOrder {
        liquid_g_cm3: 0.7,
        waterline_mm: 6.0,
    });
    assert_eq!(
        failures(&evidence),
        ["waterline", "upright", "stability", "righting"]
    );
}

#[test]
fn a_box_with_a_heavy_side_does_not_float_upright() {
    let mut evidence = boat(6.0);
    evidence.parts[0].pose.rows[0][3] -= 0.5;
    assert!(failures(&evidence).contains(&"upright".to_owned()));
}

/// Returns the sound kit with a ball of steel on the axis in the middle of its void.
fn kit_with_ballast() -> Evidence {
    let mut evidence = sound_kit();
    let shape = LumpShape::Ball { diameter_mm: 4.0 };
    let lump = Lump {
        shape,
        mass_g: 0.2624,
        center_mm: [0.0, 0.0, 16.0],
        axis: [0.0, 0.0, 1.0],
    };
    evidence.promise.ballast = vec![BallastOrder {
        id: "B1".into(),
        lump,
    }];
    evidence
}

#[test]
fn ballast_counts_by_its_declared_mass_at_its_declared_place() {
    let [bare, loaded] = [sound_kit(), kit_with_ballast()].map(|evidence| judge(&evidence));
    assert!(loaded.passes());
    assert!((loaded.assembly.mass_g - bare.assembly.mass_g - 0.2624).abs() < 1e-12);
    assert_eq!(
        (loaded.assembly.volume_mm3, &loaded.solid),
        (bare.assembly.volume_mm3, &bare.solid)
    );
    // A ball of 4 mm in the middle of a void 6 mm high.
    assert!((loaded.ballast_room_mm.unwrap() - 1.0).abs() < 1e-9);
    let added = |i: usize| loaded.assembly.inertia_g_mm2[i][i] - bare.assembly.inertia_g_mm2[i][i];
    // About its own middle, which is the box's: 2/5 m r².
    assert!((added(2) - 0.4 * 0.2624 * 4.0).abs() < 1e-9);
}

#[test]
fn a_wrong_mass_of_ballast_is_found() {
    let mut evidence = kit_with_ballast();
    let sheet = sheet::restate(
        &serde_json::Value::Null,
        &sheet::Findings::new(&evidence, &judge(&evidence)),
    );
    let before = find_misstatements(&sheet, &evidence, &judge(&evidence));
    assert!(
        before.iter().all(|words| words.starts_with("model.")),
        "{before:?}"
    );
    evidence.promise.ballast[0].lump.mass_g *= 1.01;
    let after = find_misstatements(&sheet, &evidence, &judge(&evidence));
    assert!(
        after
            .iter()
            .any(|words| words.starts_with("assembly.mass_g states")),
        "{after:?}"
    );
}

#[test]
fn ballast_beside_its_place_spoils_the_balance_or_has_no_room() {
    let mut evidence = kit_with_ballast();
    evidence.promise.ballast[0].lump.center_mm[0] = 20.0;
    assert!(failures(&evidence).contains(&"axis offset".to_owned()));
    for place in [[0.0, 0.0, 17.5], [0.0, 0.0, 21.0], [0.0, 0.0, 40.0]] {
        evidence.promise.ballast[0].lump.center_mm = place;
        assert!(
            failures(&evidence).contains(&"ballast room".to_owned()),
            "{place:?}"
        );
    }
}

#[test]
fn a_filling_counts_by_the_volume_of_the_voids() {
    let mut evidence = sound_kit();
    let bare = judge(&evidence);
    evidence.promise.fill = Some(FillOrder { density_g_cm3: 2.4 });
    let filled = judge(&evidence);
    let void_cm3 = 54.0 * 34.0 * 6.0 / 1000.0;
    assert!((filled.assembly.mass_g - bare.assembly.mass_g - 2.4 * void_cm3).abs() < 1e-9);
    assert_eq!(filled.assembly.volume_mm3, bare.assembly.volume_mm3);
    // The filling is twice as dense as the print; the box is still a top, about the same centre.
    assert!(filled.passes() && (filled.assembly.center_mm[2] - 16.0).abs() < 1e-12);
}
