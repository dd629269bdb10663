//! Every goal: its time, gap and constraints at 100 columns a side from nothing, and from there at
//! the finest printer's pitch.

use anyhow::Result;
use equipoise::base::watch::Watch;
use equipoise::goal::{Contact, GoalKind, Objective, Request, SpinPoint, Up};
use equipoise::hollow::{Problem, Settings, Solution, bound_over_heights, refine, solve};

use super::scene::{Scene, timed};

/// Columns a side from coarse to the finest printer's: its pixels are 42 µm on 100 mm.
const COARSE: usize = 100;
const MIDDLE: usize = 400;
const NATIVE: usize = 2400;

/// Runs of which the shortest counts.
const COARSE_RUNS: usize = 9;

/// The models and what they shall do.
fn rows() -> Vec<(&'static str, &'static str, Request)> {
    let top = |objective| {
        (
            "elephant",
            "elephant.obj",
            Request {
                contact: Some(Contact::Center),
                objective,
                ..Request::new(GoalKind::Top)
            },
        )
    };
    let spin_it = |gamma_c| Objective::SpinIt {
        gamma_c,
        gamma_i: 1.0,
    };
    let yoyo = |objective| {
        (
            "cheburashka",
            "cheburashka.obj",
            Request {
                objective,
                ..Request::new(GoalKind::Yoyo)
            },
        )
    };
    let upright = |kind, objective| {
        (
            "elephant",
            "elephant.obj",
            Request {
                up: Up::Y,
                objective,
                ..Request::new(kind)
            },
        )
    };
    let rotor = |objective| {
        let request = Request {
            up: Up::Z,
            spin_point: Some(SpinPoint::Center),
            objective,
            ..Request::new(GoalKind::Balance)
        };
        ("rocker-arm", "rocker-arm.obj", request)
    };
    vec![
        top(Objective::CriticalSpeed),
        top(spin_it(0.0)),
        top(spin_it(1.0)),
        yoyo(spin_it(0.0)),
        yoyo(Objective::Dominance),
        upright(GoalKind::Stand, Objective::TopplingAngle),
        upright(GoalKind::Stand, Objective::LowestCenter),
        ("elephant", "elephant.obj", Request::new(GoalKind::Float)),
        rotor(Objective::LeastRemoved),
        rotor(Objective::LeastUnbalance),
    ]
}

/// One line a goal.
pub fn print_table() -> Result<()> {
    println!();
    println!(
        "| model | goal | columns | passes | ms | gap | residual | below it at any height | status | native columns | passes \
         | s | gap | residual | below it at any height | s more |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (model, file, request) in rows() {
        if let Some(scene) = Scene::of(model, Some(file), &request)? {
            println!(
                "| {model} | {} {} | {} |",
                request.kind,
                request.objective,
                figures(&scene)?
            );
        }
    }
    Ok(())
}

fn figures(scene: &Scene) -> Result<String> {
    let columns = scene.columns(scene.shell.coarse_pitch(COARSE))?;
    let (coarse, coarse_s) = timed(COARSE_RUNS, || Ok(solved(&scene.problem(&columns))))?;
    let ends = |solution: &Solution| {
        format!(
            "{:.0e} | {:.0e}",
            solution.certificate.gap_ratio.abs(),
            solution.certificate.residual
        )
    };
    let over = coarse.certificate.bound_over_heights;
    let below = |over: Option<f64>, value: f64| {
        over.map_or_else(String::new, |bound| format!("{:.0e}", 1.0 - bound / value))
    };
    let middle = scene.columns(scene.shell.coarse_pitch(MIDDLE))?;
    let finest = scene.columns(scene.shell.coarse_pitch(NATIVE))?;
    let ((passes, native), native_s) = timed(1, || {
        let step = refined(&scene.problem(&middle), &coarse);
        let last = refined(&scene.problem(&finest), &step);
        Ok((last.passes, last))
    })?;
    let (native_over, proof_s) = timed(1, || Ok(over_heights(&scene.problem(&finest), &native)))?;
    let proved = native_over.map_or_else(String::new, |_| format!("{proof_s:.2}"));
    Ok(format!(
        "{} | {} | {:.1} | {} | {} | {} | {} | {passes} | {native_s:.2} | {} | {} | {proved}",
        columns.len(),
        coarse.passes,
        coarse_s * 1e3,
        ends(&coarse),
        below(over, coarse.certificate.value),
        word(&coarse),
        finest.len(),
        ends(&native),
        below(native_over, native.certificate.value)
    ))
}

fn solved(problem: &Problem) -> Solution {
    solve(problem, &Settings::default(), &Watch::silent())
}

fn refined(problem: &Problem, known: &Solution) -> Solution {
    refine(problem, &Settings::default(), known, &Watch::silent())
}

fn over_heights(problem: &Problem, known: &Solution) -> Option<f64> {
    bound_over_heights(problem, &Settings::default(), known, &Watch::silent())
}

/// The status without its proof.
fn word(solution: &Solution) -> String {
    let text = format!("{:?}", solution.status);
    text.split([' ', '{', '('])
        .next()
        .unwrap_or_default()
        .to_owned()
}
