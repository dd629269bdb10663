//! Programs written from known beads give the moments of those beads.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use super::*;
use crate::geom::Point;
use crate::mass::{Bead, Turn};

/// Relative error allowed for programs with 17 digits.
const RATIO: f64 = 1e-9;

/// A small generator of numbers, the same in every run.
struct Dice(u64);

impl Dice {
    /// Returns a number between the two.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// Returns beads, straight ones and arcs, some of them rising, each with its volume in mm³.
fn known_beads(dice: &mut Dice, count: usize) -> Vec<(Bead, f64)> {
    let bead = |index: usize| {
        let mut at = |low, high| dice.between(low, high);
        let from = Point::new(at(-100.0, 100.0), at(-100.0, 100.0), at(0.2, 50.0));
        let rise = if index.is_multiple_of(3) {
            at(-0.2, 0.2)
        } else {
            0.0
        };
        let height_mm = at(0.05, 0.4);
        let (to, turn) = if index.is_multiple_of(2) {
            (
                Point::new(at(-100.0, 100.0), at(-100.0, 100.0), from.z + rise),
                None,
            )
        } else {
            let axis_mm = [from.x + at(-9.0, 9.0), from.y + at(1.0, 9.0)];
            let angle_rad = at(0.1, TAU - 0.1) * if index % 4 == 1 { 1.0 } else { -1.0 };
            let (sin, cos) = angle_rad.sin_cos();
            let [dx, dy] = [from.x - axis_mm[0], from.y - axis_mm[1]];
            let to = [
                axis_mm[0] + cos * dx - sin * dy,
                axis_mm[1] + sin * dx + cos * dy,
            ];
            (
                Point::new(to[0], to[1], from.z + rise),
                Some(Turn { axis_mm, angle_rad }),
            )
        };
        let bead = Bead {
            from,
            to,
            turn,
            height_mm,
        };
        (bead, bead.length_mm() * height_mm * at(0.3, 0.6))
    };
    (0..count).map(bead).collect()
}

/// Writes the command that lays a bead from where the nozzle stands.
fn command(bead: &Bead, e: f64) -> String {
    let (from, to) = (bead.from, bead.to);
    let end = format!("X{:.17} Y{:.17} Z{:.17} E{e:.17}", to.x, to.y, to.z);
    match bead.turn {
        None => format!("G1 {end}"),
        Some(turn) => {
            let code = if turn.angle_rad > 0.0 { 3 } else { 2 };
            let [i, j] = [turn.axis_mm[0] - from.x, turn.axis_mm[1] - from.y];
            format!("G{code} {end} I{i:.17} J{j:.17}")
        }
    }
}

/// Writes a program with absolute or relative E, and a retraction after each bead.
fn program(beads: &[(Bead, f64)], is_relative: bool) -> String {
    let area = PI / 4.0 * 1.75 * 1.75;
    let mut text = format!(
        "G21\nG90\n{}\nG92 E0\n;TYPE:Perimeter\n",
        if is_relative { "M83" } else { "M82" }
    );
    let mut e = 0.0;
    for (bead, volume) in beads {
        let fed = volume / area;
        let from = bead.from;
        writeln!(text, ";HEIGHT:{:.17}", bead.height_mm).unwrap();
        writeln!(text, "G0 X{:.17} Y{:.17} Z{:.17}", from.x, from.y, from.z).unwrap();
        let (laid, pulled, back) = if is_relative {
            (fed, -0.8, 0.8)
        } else {
            (e + fed, e + fed - 0.8, e + fed)
        };
        writeln!(
            text,
            "{}\nG1 E{pulled:.17} F1800\nG1 E{back:.17}",
            command(bead, laid)
        )
        .unwrap();
        e += fed;
    }
    text
}

#[test]
fn beads_written_with_17_digits_come_back_with_their_moments() {
    let beads = known_beads(&mut Dice(7), 2000);
    let want = beads
        .iter()
        .fold(Moments::default(), |sum, (bead, volume)| {
            sum + bead.moments(*volume)
        });
    for is_relative in [true, false] {
        let toolpath = read(program(&beads, is_relative)).unwrap();
        assert_close(&toolpath.part_moments(), &want, RATIO);
        let deposits = &toolpath.objects[0].deposits;
        assert_eq!(
            (deposits.retractions, deposits.tallies[0].beads),
            (2000, 2000)
        );
        let length: f64 = beads.iter().map(|(bead, _)| bead.length_mm()).sum();
        assert!((deposits.tallies[0].length_mm / length - 1.0).abs() < RATIO);
        let feed = toolpath.feed;
        assert!((feed.retracted - 1600.0).abs() < 1e-6 && (feed.pushed - 1600.0).abs() < 1e-6);
        assert!((feed.net() - feed.laid).abs() < 1e-6);
    }
}

#[test]
fn a_block_of_beads_weighs_what_a_block_weighs() {
    // 10 × 8 × 4 mm, of beads 0.5 wide and 0.2 high, back and forth.
    let mut text = String::from("M83\n;TYPE:Solid infill\n;HEIGHT:0.2\n");
    let area = PI / 4.0 * 1.75 * 1.75;
    let e = 10.0 * 0.5 * 0.2 / area;
    for layer in 1..=20 {
        writeln!(text, "G0 Z{}", f64::from(layer) * 0.2).unwrap();
        for row in 0..16 {
            let y = 50.25 + 0.5 * f64::from(row);
            writeln!(text, "G0 X20 Y{y}\nG1 X30 E{e:.17}").unwrap();
        }
    }
    let toolpath = read(&text).unwrap();
    let body = crate::mass::Body::new(&toolpath.part_moments(), 1.0);
    assert!((body.mass_g / 320.0 - 1.0).abs() < 1e-12);
    assert!((body.center - Point::new(25.0, 54.0, 2.0)).norm() < 1e-12);
    let sides = [100.0, 64.0, 16.0];
    for (axis, others) in [(0, [1, 2]), (1, [0, 2]), (2, [0, 1])] {
        let want = 320.0 / 12.0 * (sides[others[0]] + sides[others[1]]);
        assert!((body.inertia_g_mm2[(axis, axis)] / want - 1.0).abs() < 1e-11);
    }
    let bounds = toolpath.objects[0].deposits.part_bounds();
    assert!((bounds.min - Point::new(20.0, 50.25, 0.0)).norm() < 1e-12);
    assert!((bounds.max - Point::new(30.0, 57.75, 4.0)).norm() < 1e-12);
    assert_eq!(
        (toolpath.layers, toolpath.objects[0].deposits.layers),
        (20, 20)
    );
}

#[test]
fn the_diameter_may_be_given_stated_last_or_assumed() {
    let program = ";TYPE:Perimeter\n;HEIGHT:0.2\nG0 Z.2\nG1 X10 E1\n";
    let volume = |text: &str, given: Option<f64>| {
        let options = Options {
            filament_diameter_mm: given,
            ..Options::default()
        };
        let toolpath = read_text(text.as_bytes(), &options, &Watch::silent()).unwrap();
        (toolpath.part_moments(), toolpath.diameter_source)
    };
    let stated = format!("{program}; filament_diameter = 2.85\n");
    let bead = Bead {
        from: Point::new(0.0, 0.0, 0.2),
        to: Point::new(10.0, 0.0, 0.2),
        turn: None,
        height_mm: 0.2,
    };
    let of_diameter = |mm: f64| bead.moments(PI / 4.0 * mm * mm);
    let cases = [
        (volume(program, None), 1.75, DiameterSource::Assumed),
        (volume(&stated, None), 2.85, DiameterSource::Stated),
        (volume(&stated, Some(3.0)), 3.0, DiameterSource::Given),
    ];
    for ((moments, source), mm, want) in cases {
        assert_close(&moments, &of_diameter(mm), 1e-12);
        assert_eq!(source, want);
    }
    for text in [
        format!("{program}; use_volumetric_e = 1\n"),
        format!(";FLAVOR:UltiGCode\n{program}"),
        format!("M200 D1.75\n{program}"),
    ] {
        let (moments, source) = volume(&text, None);
        assert_close(&moments, &bead.moments(1.0), 1e-12);
        assert_eq!(source, DiameterSource::Unneeded, "{text}");
    }
}

#[test]
fn every_tool_has_its_own_diameter_and_may_have_its_own_density() {
    let text = "; filament_diameter = 1.75,2.85\nM83\n;TYPE:Perimeter\n;HEIGHT:0.2\nG0 Z.2\nG1 X10 E1\nT1\nG1 X20 E1\n";
    let deposits = &read(text).unwrap().objects[0].deposits;
    let volumes: Vec<f64> = deposits
        .tallies
        .iter()
        .map(|tally| tally.moments.volume())
        .collect();
    let want = [1.75, 2.85].map(|mm: f64| PI / 4.0 * mm * mm);
    assert!(
        volumes
            .iter()
            .zip(want)
            .all(|(got, want)| (got - want).abs() < 1e-12)
    );
    let weighed = deposits.weighed(|tool| [1.0, 2.0][usize::from(tool)]);
    assert!((weighed.volume() - want[0] - 2.0 * want[1]).abs() < 1e-12);
}

#[test]
fn places_of_the_plate_are_counted_apart() {
    let text = "M83\n;TYPE:Perimeter\n;HEIGHT:0.2\nG0 Z.2\nG1 X10 E1\nG0 X50\nG1 X60 E2\nG0 X90\nG1 X99 E4\n";
    let place = |from: f64, to: f64| Place {
        min_mm: [from, -1.0],
        max_mm: [to, 1.0],
    };
    let options = Options {
        places: vec![place(45.0, 65.0), place(200.0, 300.0), place(-5.0, 15.0)],
        ..Options::default()
    };
    let toolpath = read_text(text.as_bytes(), &options, &Watch::silent()).unwrap();
    let unit = PI / 4.0 * 1.75 * 1.75;
    let found: Vec<f64> = toolpath
        .places
        .iter()
        .map(|p| (p.part_moments().volume() / unit).round())
        .collect();
    assert_eq!(found, [2.0, 0.0, 1.0]);
    assert_eq!((toolpath.part_moments().volume() / unit).round(), 7.0);
}

#[test]
fn the_flow_of_the_machine_is_told_apart() {
    let text =
        "M221 S95\nM83\n;TYPE:Custom\nG1 X5 E9\n;TYPE:Perimeter\n;HEIGHT:0.2\nG0 Z.2\nG1 X10 E1\n";
    let toolpath = read(text).unwrap();
    assert!((toolpath.flow_ratio() - 0.95).abs() < 1e-12);
    let unit = PI / 4.0 * 1.75 * 1.75;
    assert!((toolpath.part_moments().volume() - unit).abs() < 1e-12);
}
