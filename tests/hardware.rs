//! Yo-yos on an axle and tops on a tip, as a user makes them; and the claim that a quadric for each
//! half is optimal.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

use common::{ELLIPSOID, equipoise, glue_g, number, prepared};
use equipoise::geom::{Quadric, Vector};
use equipoise::interior::{Columns, moments_where_positive};

/// The wall of these kits.
const WALL: &str = "1mm";

const YOYO: [&str; 8] = [
    "--goal",
    "yoyo",
    "--up",
    "y",
    "--string-gap",
    "3mm",
    "--axle",
    "4mmx15mm",
];

#[test]
fn a_yoyo_on_its_axle_keeps_its_promises_and_its_job_makes_the_same_kit_again() {
    let folder = tempfile::tempdir().unwrap();
    let [kit, again] = ["yoyo", "again"].map(|name| folder.path().join(name));
    let (code, sheet) = prepared(&kit, WALL, &YOYO);
    assert_eq!(code, Some(0), "{:#}", sheet["checks"]);
    // A steel cylinder of 4 × 15 mm.
    let mass = 7.85e-3 * std::f64::consts::PI * 4.0 * 15.0;
    assert!((number(&sheet, "/hardware/0/mass_g") / mass - 1.0).abs() < 1e-12);
    let parts = sheet["parts"].as_array().unwrap();
    let printed: f64 = parts
        .iter()
        .map(|part| part["mass_g"].as_f64().unwrap())
        .sum();
    assert!(
        (number(&sheet, "/assembly/mass_g") / (printed + mass + glue_g(&sheet)) - 1.0).abs() < 1e-9
    );
    assert_eq!(number(&sheet, "/string_gap_mm"), 3.0);
    assert!(
        ["A", "B"]
            .iter()
            .all(|half| parts.iter().any(|part| part["half"] == *half))
    );
    assert_eq!(
        equipoise(&["verify", kit.to_str().unwrap()]).status.code(),
        Some(0)
    );
    let job = kit.join("job.toml");
    let replay = [
        "-q",
        "prepare",
        "--job",
        job.to_str().unwrap(),
        "--out",
        again.to_str().unwrap(),
    ];
    assert_eq!(equipoise(&replay).status.code(), Some(0));
    for file in ["checklist.json", "hollowed.stl", "pictures/cut-away.svg"] {
        assert!(
            std::fs::read(kit.join(file)).unwrap() == std::fs::read(again.join(file)).unwrap(),
            "{file}"
        );
    }
}

#[test]
fn a_checklist_that_lies_about_its_hardware_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("yoyo");
    let (code, _) = prepared(&kit, WALL, &YOYO);
    assert_eq!(code, Some(0));
    let sheet = kit.join("checklist.json");
    let text = std::fs::read_to_string(&sheet).unwrap();
    let verdict = |text: &str| {
        std::fs::write(&sheet, text).unwrap();
        equipoise(&["verify", kit.to_str().unwrap()]).status.code()
    };
    assert_eq!(verdict(&text), Some(0));
    for (told, lie) in [
        ("\"density_g_cm3\": 7.85", "\"density_g_cm3\": 7.8"),
        ("\"string_gap_mm\": 3.0", "\"string_gap_mm\": 3.01"),
        ("\"diameter_mm\": 4.0", "\"diameter_mm\": 4.5"),
    ] {
        assert!(text.contains(told), "{told}");
        assert_eq!(verdict(&text.replacen(told, lie, 1)), Some(1), "{lie}");
    }
}

#[test]
fn a_top_with_a_tip_and_a_stem_keeps_its_promises_and_a_denser_tip_costs_speed() {
    // Mass on the axis adds to g s_z and to the moments across it, and nothing to the one about it:
    // for every hollowing ω² = g s_z/(I_c − I_b) grows, and so does the least of all.
    let folder = tempfile::tempdir().unwrap();
    let speed = |name: &str, tip: &str| {
        let goal = [
            "--goal",
            "top",
            "--up",
            "y",
            "--contact",
            "center",
            "--stem",
            "4mmx15mmx6mm",
            "--tip",
            tip,
        ];
        let (code, sheet) = prepared(&folder.path().join(name), WALL, &goal);
        assert_eq!(code, Some(0), "{:#}", sheet["checks"]);
        assert_eq!(sheet["hardware"].as_array().unwrap().len(), 2);
        assert_eq!(number(&sheet, "/goal/contact_gap_mm"), 0.0);
        number(&sheet, "/certificate/bound")
    };
    let [plastic, steel] = [
        speed("plastic", "4mmx12mmx8mm:1.18"),
        speed("steel", "4mmx12mmx8mm"),
    ];
    assert!(steel > plastic, "{steel} {plastic}");
}

#[test]
fn hardware_that_cannot_be_is_refused_with_a_remedy() {
    let cases: [(&[&str], &str); 5] = [
        (&["--goal", "top", "--axle", "6mm"], "go with the goal yoyo"),
        (
            &["--goal", "yoyo", "--tip", "4mmx12mm"],
            "go with the goal top",
        ),
        (&["--goal", "yoyo", "--axle", "6mm"], "give both"),
        (&["--goal", "yoyo", "--axle", "6mmx"], "is not a rod"),
        (
            &["--goal", "yoyo", "--string-gap", "3mm", "--axle", "70mm"],
            "has no wall",
        ),
    ];
    for (goal, says) in cases {
        let usual = [
            "prepare",
            ELLIPSOID,
            "--printer",
            "objet-connex350",
            "--size",
            "60mm",
        ];
        let output = equipoise(&[&usual[..], goal].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(2) && said.contains(says),
            "{goal:?}: {said}"
        );
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
fn one_quadric_where_the_halves_are_is_one_shifted_quadric_for_each_half_of_the_model() {
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
        // q(x, y, z + d): the coefficients of 1, x, y and z change by what z² , xz and yz bring.
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
