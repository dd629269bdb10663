//! Tests of the checklist of a sound kit: its keys, and that it reads back as it was written.

use super::*;
use crate::testing::sample;
use crate::verify::Promise;

#[test]
fn a_checklist_reads_back_as_it_was_written() {
    let sheet = sample().0;
    let text = sheet.to_json().unwrap();
    assert_eq!(serde_json::from_str::<Checklist>(&text).unwrap(), sheet);
    assert_eq!(sheet.to_json().unwrap(), text);
}

#[test]
fn the_judge_finds_its_promises_in_the_checklist() {
    let (sheet, evidence) = sample();
    let promise: Promise = serde_json::from_str(&sheet.to_json().unwrap()).unwrap();
    assert_eq!(promise.goal, evidence.promise.goal);
    assert_eq!(
        promise.parts[1].print_from_model,
        evidence.promise.parts[1].print_from_model
    );
    assert_eq!(promise.printer, evidence.promise.printer);
}

#[test]
fn the_keys_of_the_contract_are_there() {
    let value: serde_json::Value = serde_json::from_str(&sample().0.to_json().unwrap()).unwrap();
    let at = |path: &str| {
        value
            .pointer(path)
            .unwrap_or_else(|| panic!("{path} is missing"))
    };
    assert_eq!(at("/schema"), 1);
    for path in [
        "/tool/version",
        "/model/sha256",
        "/model/size_mm/2",
        "/printer/id",
        "/material/density_g_cm3",
        "/goal/kind",
        "/goal/origin_mm/0",
        "/goal/axis/2",
        "/goal/objective",
        "/solid/inertia_g_mm2/2/2",
        "/hollowed/principal_moments_g_mm2/0",
        "/assembly/axis_offset_mm",
        "/assembly/axis_tilt_deg",
        "/assembly/critical_speed_rpm",
        "/certificate/gap_ratio",
        "/wall/measured_min_mm",
        "/voids/0/opened_by/0",
        "/voids/0/opening_mm",
        "/voids/0/sight_ratio",
        "/voids/0/clean",
        "/cuts/0/point_mm/0",
        "/cuts/0/normal/0",
        "/parts/0/print_from_model/3/3",
        "/parts/0/pins",
        "/parts/0/sockets",
        "/checks/0/limit",
        "/verdict",
        "/timing_s/load",
        "/log/0/phase",
    ] {
        at(path);
    }
}

#[test]
fn a_number_that_is_not_finite_is_refused_by_its_key() {
    let refuse = |spoil: fn(&mut Checklist)| {
        let mut sheet = sample().0;
        spoil(&mut sheet);
        sheet.to_json().unwrap_err().to_string()
    };
    assert!(refuse(|sheet| sheet.certificate.bound = f64::NAN).contains("`bound`"));
    assert!(
        refuse(|sheet| sheet.wall.measured_min_mm = Some(f64::INFINITY))
            .contains("`measured_min_mm`")
    );
    assert!(refuse(|sheet| sheet.model.size_mm[1] = f64::NEG_INFINITY).contains("`size_mm`"));
}

#[test]
fn a_kit_keeps_no_times() {
    let sheet = sample().0.without_timing();
    assert!(!sheet.to_json().unwrap().contains("timing_s"));
}
