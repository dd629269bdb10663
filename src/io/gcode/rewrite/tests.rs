//! Programs written again: modes of E, speeds, arcs, and what is refused.

use super::*;
use crate::io::gcode::{Options, read_text};

/// Lays along x as many times as much: from 1 at 0 to 2 at 100 mm, and infill alone.
struct AlongX;

impl Portions for AlongX {
    fn takes(&self, feature: Feature, _: &Point) -> Result<bool, String> {
        Ok(feature == Feature::Infill)
    }

    fn factor(&self, _: Feature, at: &Point) -> f64 {
        1.0 + at.x / 100.0
    }

    fn is_free(&self, at: &Point) -> bool {
        at.x < 8.0
    }
}

fn rewrite(program: &str, flow_mm3_s: f64) -> Result<(String, Rewritten), RewriteError> {
    let rewriting = Rewriting {
        portions: &AlongX,
        piece_mm: 2.0,
        factors: [0.2, 1.9],
        most_flow_mm3_s: flow_mm3_s,
        filament_mm2: 1.0,
    };
    let mut text = Vec::new();
    let watch = Watch::silent();
    let written = rewrite_text(program.as_bytes(), &mut text, &rewriting, &watch)?;
    Ok((String::from_utf8(text).unwrap(), written))
}

/// Returns the net E of a program, and its place of E at the end.
fn net_e(program: &str) -> [f64; 2] {
    let mut follower = Follower::new();
    let mut net = 0.0;
    for line in program.lines() {
        if let Effect::Stroke(stroke) = follower.take(line.as_bytes()).unwrap() {
            net += stroke.feed;
        }
    }
    [net, follower.machine.e()]
}

const HEAD: &str = "G21\nG90\n;TYPE:Internal infill\n;HEIGHT:0.2\nG1 Z0.2 F600\n";

/// Returns the same print with absolute and with relative places of E.
fn twins() -> [String; 2] {
    let absolute = format!(
        "M82\nG92 E0\n{HEAD}G1 X0 Y0 F1200\nG1 X10 E1 ; a line\nG1 E0.2 F2400\nG0 X10 Y5\nG1 E1 F2400\n\
         G1 X0 E2 F1200\nG92 E0\n;TYPE:External perimeter\nG1 X0 Y20 E1.5\n"
    );
    let relative = format!(
        "M83\n{HEAD}G1 X0 Y0 F1200\nG1 X10 E1 ; a line\nG1 E-0.8 F2400\nG0 X10 Y5\nG1 E0.8 F2400\n\
         G1 X0 E1 F1200\n;TYPE:External perimeter\nG1 X0 Y20 E1.5\n"
    );
    [absolute, relative]
}

#[test]
fn both_modes_of_e_lay_the_same_and_all_else_stays() {
    for program in twins() {
        let (text, written) = rewrite(&program, 1e9).unwrap();
        // Two lines from x = 0 to 10 get 1.05 times as much.
        assert!((written.fed[1] - 2.1).abs() < 1e-5, "{written:?}");
        assert_eq!((written.beads, written.pieces, written.slowed), (2, 10, 0));
        let [before, after] = [&program, &text].map(|text| net_e(text)[0]);
        assert!((after - before - 0.1).abs() < 1.5e-5, "{before} {after}");
        assert!(text.contains("X0 Y20 E1.5"), "{text}");
        // A retraction is as long as before.
        let read = |text: &str| {
            let options = Options::default();
            read_text(text.as_bytes(), &options, &Watch::silent())
                .unwrap()
                .feed
        };
        let (own, other) = (read(&program), read(&text));
        assert!((own.retracted - other.retracted).abs() < 1e-9, "{text}");
        assert!((own.pushed - other.pushed).abs() < 1e-9, "{text}");
    }
}

#[test]
fn pieces_lay_what_the_field_says_at_their_place() {
    let [_, program] = twins();
    let (text, _) = rewrite(&program, 1e9).unwrap();
    let first: Vec<&str> = text
        .lines()
        .filter(|line| line.starts_with("G1 X2 Y0"))
        .collect();
    // A fifth of 1 mm, at x = 1.
    assert_eq!(first, ["G1 X2 Y0 E0.20200"]);
}

#[test]
fn rounding_does_not_add_up() {
    let line = |index: u32| format!("G1 X{} E0.03333\n", index % 2 * 10);
    let lines: String = (1..=300).map(line).collect();
    let (text, written) = rewrite(&format!("M83\n{HEAD}G1 X0 Y0\n{lines}"), 1e9).unwrap();
    let wanted = 300.0 * 0.033_33 * 1.05;
    assert!(
        (net_e(&text)[0] - wanted).abs() < 1e-5,
        "{}",
        net_e(&text)[0]
    );
    assert!((written.fed[1] - wanted).abs() < 1e-5);
}

#[test]
fn what_the_hot_end_cannot_melt_is_laid_more_slowly_and_the_speed_comes_back() {
    let program = format!("M83\n{HEAD}G1 X80 Y0 F1200\nG1 X84 E4\nG0 X0 Y50\n");
    // 1 mm³ a mm at 20 mm/s, 1.8 times as thick: 36 mm³/s.
    let (text, written) = rewrite(&program, 18.0).unwrap();
    assert_eq!(written.slowed, 2);
    assert!(
        text.contains("E1.81000 F1193.4") || text.contains("E3.62000 F596.7"),
        "{text}"
    );
    assert!(text.contains("G1 F1200\nG0 X0 Y50\n"), "{text}");
}

#[test]
fn arcs_stay_arcs() {
    let program = format!("M83\n{HEAD}G1 X10 Y0\nG3 X0 Y10 I-10 J0 E2\n");
    let (text, written) = rewrite(&program, 1e9).unwrap();
    assert_eq!(text.matches("G3 X").count(), 8, "{text}");
    // The mean of x along a quarter of a circle is 2 r / π.
    let wanted = 2.0 * (1.0 + 20.0 / std::f64::consts::PI / 100.0);
    assert!((written.fed[1] - wanted).abs() < 2e-5, "{written:?}");
    let read = |text: &str| {
        let options = Options::default();
        let read = read_text(text.as_bytes(), &options, &Watch::silent()).unwrap();
        read.objects[0].deposits.part_bounds()
    };
    let (own, other) = (read(&program), read(&text));
    assert!((own.max - other.max).norm() < 1e-3 && (own.min - other.min).norm() < 1e-3);
}

#[test]
fn programs_that_cannot_be_scaled_are_refused_with_their_line() {
    let [_, program] = twins();
    let (once, _) = rewrite(&program, 1e9).unwrap();
    for (program, said) in [
        (once, "scaled already"),
        (format!("M83\n{HEAD}G91\nG1 X10 E1\n"), "relative moves"),
        (format!("M83\n{HEAD}G20\nG1 X1 E1\n"), "inches"),
        (
            format!("M83\n{HEAD}G1 X95 Y0\nG1 X99 E1\n"),
            "slice with more infill",
        ),
        (format!("M83\n{HEAD}G1 Xa\n"), "line 7"),
        (format!("M83\n;{}\n", "x".repeat(1 << 20)), "line is longer"),
    ] {
        let fault = rewrite(&program, 1e9).unwrap_err().to_string();
        assert!(fault.contains(said), "{said}: {fault}");
    }
}

#[test]
fn a_program_without_features_is_copied() {
    let program = "M83\nG1 X10 E1 ; π\r\nG1 X20 E1";
    let (text, written) = rewrite(program, 1e9).unwrap();
    assert_eq!(text, format!("{MARK}\n{program}\n"));
    assert_eq!(written, Rewritten::default());
}

#[test]
fn what_could_be_more_or_less_is_weighed_where_it_lies() {
    let program = format!("M83\n{HEAD}G1 X0 Y4 F1200\nG1 X10 E1\n");
    let free = rewrite(&program, 1e9).unwrap().1.free;
    // Four of five pieces of 2 mm lie below 8 mm, each with 0.2 mm³ times 1 + x/100.
    let middles = [1.0, 3.0, 5.0, 7.0];
    let expected: f64 = middles.iter().map(|x| 0.2 * (1.0 + x / 100.0)).sum();
    assert!((free.volume() - expected).abs() < 5e-5, "{free:?}");
    let center = free.centroid();
    assert!(
        (center.y - 4.0).abs() < 1e-9 && (center.z - 0.1).abs() < 1e-9,
        "{center}"
    );
    assert!((center.x - 4.0).abs() < 0.1, "{center}");
}
