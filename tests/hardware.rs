//! Yo-yos on an axle and tops on a tip, as a user makes them; and the proof that a quadric for each
//! half is optimal.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use common::{
    assert_exit, copy, equipoise, files, glue_g, list, make_kit, number, path, prepare_quickly,
    printed, sum, verify,
};
use equipoise::geom::{Quadric, Vector};
use equipoise::interior::{Columns, moments_where_positive};
use serde_json::Value;

/// A yo-yo on an axle of 4 × 15 mm, and its sheet. It is made once and never changed.
fn yoyo() -> &'static (PathBuf, Value) {
    static YOYO: OnceLock<(PathBuf, Value)> = OnceLock::new();
    YOYO.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("yoyo");
        let goal = "--wall 1mm --goal yoyo --up y --string-gap 3mm --axle 4mmx15mm";
        let sheet = make_kit(&kit, goal);
        (kit, sheet)
    })
}

#[test]
fn a_yoyo_on_its_axle_keeps_its_promises() {
    let (kit, sheet) = yoyo();
    // A steel cylinder of 4 × 15 mm.
    let axle_g = 7.85e-3 * PI * 4.0 * 15.0;
    assert!((number(sheet, "/hardware/0/mass_g") / axle_g - 1.0).abs() < 1e-12);
    let parts = list(sheet, "parts");
    let all_g = sum(parts, "/mass_g") + axle_g + glue_g(sheet);
    assert!((number(sheet, "/assembly/mass_g") / all_g - 1.0).abs() < 1e-9);
    assert_eq!(number(sheet, "/string_gap_mm"), 3.0);
    for half in ["A", "B"] {
        assert!(parts.iter().any(|part| part["half"] == half), "{half}");
    }
    assert_eq!(verify(kit).0, Some(0));
}

#[test]
fn the_job_of_a_yoyo_makes_the_same_kit_again() {
    let folder = tempfile::tempdir().unwrap();
    let (kit, _) = yoyo();
    let (job, again) = (kit.join("job.toml"), folder.path().join("again"));
    let replay = ["-q", "prepare", "--job", path(&job), "--out", path(&again)];
    assert_exit(&equipoise(&replay), 0);
    let [kit, again] = [kit, &again].map(|kit| files(kit));
    for file in ["checklist.json", "hollowed.stl", "pictures/cut-away.svg"] {
        assert!(kit[Path::new(file)] == again[Path::new(file)], "{file}");
    }
}

#[test]
#[ignore = "long: 20 s; run with -- --ignored"]
fn a_checklist_with_false_numbers_about_its_hardware_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    copy(&yoyo().0, &kit);
    let sheet = kit.join("checklist.json");
    let text = fs::read_to_string(&sheet).unwrap();
    let verdict = |text: &str| {
        fs::write(&sheet, text).unwrap();
        verify(&kit).0
    };
    assert_eq!(verdict(&text), Some(0));
    for (stated, lie) in [
        ("\"density_g_cm3\": 7.85", "\"density_g_cm3\": 7.8"),
        ("\"string_gap_mm\": 3.0", "\"string_gap_mm\": 3.01"),
        ("\"diameter_mm\": 4.0", "\"diameter_mm\": 4.5"),
    ] {
        assert!(text.contains(stated), "{stated}");
        assert_eq!(verdict(&text.replacen(stated, lie, 1)), Some(1), "{lie}");
    }
}

/// Mass on the axis adds to g s_z and to the moments across it, and nothing to the one about it.
/// So ω² = g s_z/(I_c − I_b) grows for every hollowing, and with it the least of all.
#[test]
fn a_denser_tip_raises_the_critical_speed_of_a_top() {
    let folder = tempfile::tempdir().unwrap();
    let speed = |name: &str, tip: &str| {
        let rods = format!("--stem 4mmx15mmx6mm --tip {tip}");
        let goal = format!("--wall 1mm --goal top --up y --contact center {rods}");
        let sheet = make_kit(&folder.path().join(name), &goal);
        assert_eq!(list(&sheet, "hardware").len(), 2);
        assert_eq!(number(&sheet, "/goal/contact_gap_mm"), 0.0);
        number(&sheet, "/certificate/bound")
    };
    let plastic = speed("plastic", "4mmx12mmx8mm:1.18");
    let steel = speed("steel", "4mmx12mmx8mm");
    assert!(steel > plastic, "{steel} {plastic}");
}

#[test]
fn impossible_hardware_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    for (goal, words) in [
        ("top --axle 6mm", "go with the goal yoyo"),
        ("yoyo --tip 4mmx12mm", "go with the goal top"),
        ("yoyo --axle 6mm", "give both"),
        ("yoyo --axle 6mmx", "is not a rod"),
        ("yoyo --string-gap 3mm --axle 70mm", "would tear out"),
    ] {
        let output = prepare_quickly(
            &folder.path().join("none"),
            &format!("--up z --goal {goal}"),
        );
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(said.contains(words), "{goal}: {said}");
    }
}

/// A 6 × 6 grid of columns over a 12 mm square, from z = −9 to 7.
fn columns(intervals: &[[f64; 2]]) -> Columns {
    let centers: Vec<[f64; 2]> = (0..36)
        .map(|i| [2.0 * f64::from(i % 6) - 5.0, 2.0 * f64::from(i / 6) - 5.0])
        .collect();
    let starts = (0..=36).map(|i| i * intervals.len() as u32).collect();
    Columns {
        pitch_mm: [2.0, 2.0],
        intervals: intervals.repeat(centers.len()),
        centers,
        starts,
    }
}

#[test]
fn one_quadric_over_both_halves_is_a_shifted_quadric_for_each_half() {
    let shift = 1.5;
    let apart = columns(&[[-9.0 - shift, -shift], [shift, 7.0 + shift]]);
    let halves = [
        (columns(&[[-9.0, 0.0]]), -shift),
        (columns(&[[0.0, 7.0]]), shift),
    ];
    for seed in 0..20_u32 {
        let g: [f64; 10] =
            std::array::from_fn(|i| f64::from((seed * 7 + i as u32 * 13) % 29) - 14.0);
        let whole = moments_where_positive(&apart, &Quadric(g));
        // q(x, y, z + d): the terms in z², xz and yz add to the coefficients of 1, x, y and z.
        let seen_by_half = |d: f64| {
            let [one, x, y, z, xy, yz, xz, xx, yy, zz] = g;
            Quadric([
                one + z * d + zz * d * d,
                x + xz * d,
                y + yz * d,
                z + 2.0 * zz * d,
                xy,
                yz,
                xz,
                xx,
                yy,
                zz,
            ])
        };
        let moved = |(half, d): &(Columns, f64)| {
            moments_where_positive(half, &seen_by_half(*d)).translated(&(Vector::z() * *d))
        };
        let both = moved(&halves[0]) + moved(&halves[1]);
        for (one, two) in whole.0.iter().zip(both.0) {
            // Sums of 72 terms of at most 1e5.
            assert!((one - two).abs() < 1e-7, "{seed}: {one} {two}");
        }
    }
}
