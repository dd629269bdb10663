//! Default seams on figures: off marked faces, level or upright, and at what price.
//!
//! The faces are marked in `faces.toml` beside the shared models; the program knows none of them.
//! Runs take minutes, so they are ignored by default:
//!
//! ```text
//! EQUIPOISE_SHARED_MODELS=FOLDER cargo test --test kits seams -- --ignored --nocapture
//! ```
//!
//! `EQUIPOISE_SEAM_ROWS=homer,bunny:top` runs some models or goals only.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a long run prints its table")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use equipoise::base::units::Length;
use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::cut::{CutOrder, Section};
use equipoise::geom::{Parting, Point};
use equipoise::goal::Request;
use equipoise::job::{Job, ModelChoice, PrinterChoice, Scaling};
use equipoise::mesh::{TriMesh, scaled};
use equipoise::prepare::plans::{PlanChoice, Plans, plans};
use serde::Deserialize;

/// Longest side of every model, mm.
const SIZE_MM: f64 = 100.0;
/// Pitch of the solver's columns, mm: coarse, so that a row takes a minute.
const PITCH_MM: f64 = 1.0;
/// Greatest loss of the figure for which a face is kept whole.
const MOST_LOSS_RATIO: f64 = 0.1;

/// A model with its marked places, in its own frame: longest sides from its least corner.
#[derive(Deserialize)]
struct Figure {
    file: String,
    min: [f64; 3],
    longest: f64,
    #[serde(default)]
    keep_clear: Vec<Mark>,
}

/// A marked place.
#[derive(Deserialize)]
struct Mark {
    what: String,
    center: [f64; 3],
    radius: f64,
}

/// A row of the table.
struct Row {
    name: String,
    is_face: bool,
    plan: PlanChoice,
    best: PlanChoice,
    is_said: bool,
}

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("EQUIPOISE_SHARED_MODELS").map(PathBuf::from);
    let found = folder.filter(|folder| folder.join("faces.toml").is_file());
    if found.is_none() {
        eprintln!("SKIPPED: no faces.toml in EQUIPOISE_SHARED_MODELS");
    }
    found
}

#[test]
#[ignore = "takes an hour and needs the shared models"]
fn default_seams_keep_off_marked_faces_or_say_what_that_costs() {
    let Some(folder) = folder() else { return };
    let text = std::fs::read_to_string(folder.join("faces.toml")).unwrap();
    let figures: BTreeMap<String, Figure> = toml::from_str(&text).unwrap();
    let wanted = std::env::var("EQUIPOISE_SEAM_ROWS").unwrap_or_default();
    let is_wanted =
        |name: &str| wanted.is_empty() || wanted.split(',').any(|some| name.starts_with(some));
    let mut rows = Vec::new();
    for (name, figure) in &figures {
        for goal in ["stand", "top"] {
            for printer in ["prusa-mk4", "objet-connex350"] {
                let name = format!("{name}:{goal}:{printer}");
                if is_wanted(&name) {
                    rows.extend(row(&folder, name, figure, [goal, printer]));
                }
            }
        }
    }
    let bad = rows.iter().filter(|row| row.is_face && !row.is_said);
    let bad: Vec<&str> = bad.map(|row| row.name.as_str()).collect();
    assert!(
        bad.is_empty(),
        "a face is cut, and nothing is said: {bad:?}"
    );
}

/// Plans one model; prints its row. `None` if the goal is impossible.
fn row(folder: &Path, name: String, figure: &Figure, [goal, printer]: [&str; 2]) -> Option<Row> {
    let path = folder.join(&figure.file);
    let length = |mm: f64| Length::from_mm(mm).unwrap();
    let model = ModelChoice {
        path: path.clone(),
        sha256: None,
        scaling: Scaling::Size(length(SIZE_MM)),
    };
    let printer = PrinterChoice {
        id: printer.to_owned(),
        material: None,
    };
    let job = Job {
        pitch: Some(length(PITCH_MM)),
        ..Job::new(model, printer, Request::new(goal.parse().unwrap()))
    };
    let found = match plans(&job, 4, "", &Watch::silent()) {
        Ok(Verdict::Found(found)) => found,
        Ok(Verdict::No(why)) => {
            eprintln!("{name}: impossible, {}", why.reason);
            return None;
        }
        Err(error) => {
            eprintln!("{name}: {error}");
            return None;
        }
    };
    let outer = equipoise::io::decode_model(&std::fs::read(&path).unwrap()).unwrap();
    let outer = scaled(&outer, SIZE_MM / figure.longest);
    let row = judged(name, figure, &found, &outer);
    print(&row);
    Some(row)
}

fn judged(name: String, figure: &Figure, found: &Plans, outer: &TriMesh) -> Row {
    let usual = found.plans[0].clone();
    let best = found
        .plans
        .iter()
        .min_by(|a, b| a.loss_ratio.total_cmp(&b.loss_ratio));
    let file = found.kit.files().find(|(file, _)| *file == usual.file);
    let order = std::str::from_utf8(file.unwrap().1).unwrap();
    let order = CutOrder::from_toml("plan1.toml", order).unwrap();
    let scale = SIZE_MM / figure.longest;
    let is_entered = |mark: &Mark| {
        let center = [0, 1, 2].map(|i| (figure.min[i] + mark.center[i] * figure.longest) * scale);
        let radius_mm = mark.radius * SIZE_MM;
        let cuts = order.partings().unwrap();
        let mut seams = cuts.iter().flat_map(|cut| seam(outer, cut, &order));
        seams.any(|at| (at - Point::from(center)).norm() < radius_mm)
    };
    let faces = figure.keep_clear.iter().filter(|mark| mark.what == "face");
    let is_face = faces.into_iter().any(is_entered);
    Row {
        name,
        is_face,
        is_said: usual.offers.iter().any(|offer| offer.contains("seam"))
            || usual.loss_ratio > MOST_LOSS_RATIO,
        plan: usual,
        best: best.unwrap().clone(),
    }
}

/// Points along the seam of a cut, without faces that are left whole.
fn seam(outer: &TriMesh, cut: &Parting, order: &CutOrder) -> Vec<Point> {
    let (u, v) = cut.plane.basis();
    let lift = |x: f64, y: f64| cut.plane.foot() + u * x + v * y;
    let is_inside = |ring: &[[f64; 2]], [x, y]: [f64; 2]| {
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        let crossed = pairs.filter(|(a, b)| {
            (a[1] > y) != (b[1] > y) && x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])
        });
        crossed.count() % 2 == 1
    };
    let whole = order.uncut.iter().filter_map(|face| {
        let at = Point::from(face.point_mm);
        let is_here = cut.plane.distance(&at).abs() < 1e-3;
        is_here.then(|| [u.dot(&at.coords), v.dot(&at.coords)])
    });
    let whole: Vec<[f64; 2]> = whole.collect();
    let mut points = Vec::new();
    for ring in Section::of_mesh(outer, &cut.plane).rings {
        let flat: Vec<[f64; 2]> = ring.points.iter().map(|p| [p.x, p.y]).collect();
        if whole.iter().any(|at| is_inside(&flat, *at)) {
            continue;
        }
        for [a, b] in ring.segments() {
            let steps = (b - a).norm().ceil().max(1.0) as usize;
            points.extend((0..steps).map(|i| {
                let at = a + (b - a) * (i as f64 / steps as f64);
                lift(at.x, at.y)
            }));
        }
    }
    let holds = |at: &Point| {
        let mut sides = cut.within.iter();
        sides.all(|(limit, is_above)| (limit.distance(at) >= 0.0) == *is_above)
    };
    points.retain(holds);
    points
}

fn print(row: &Row) {
    let Row { plan, best, .. } = row;
    let seam_mm: f64 = plan.seams.iter().map(|seam| seam.length_mm).sum();
    let slanted = plan.seams.iter().filter(|seam| seam.is_slanted).count();
    eprintln!(
        "| {} | {} parts | seam {seam_mm:.0} mm | face {} | slanted {slanted} | {:.4} | loss {:.1} % | {}",
        row.name,
        plan.parts,
        if row.is_face { "YES" } else { "no" },
        plan.value,
        100.0 * plan.loss_ratio,
        best.tendency,
    );
    for seam in &plan.seams {
        eprintln!(
            "    {} {:.0} mm, {}, seen {:.2}",
            seam.cut, seam.length_mm, seam.place, seam.seen_ratio
        );
    }
    plan.offers
        .iter()
        .for_each(|offer| eprintln!("    {offer}"));
}
