//! Spin-It's teapot: by how much each objective divides its critical speed, beside what the paper
//! reports.

use anyhow::Result;
use equipoise::base::watch::Watch;
use equipoise::goal::{Figures, GoalKind, Objective, Request, Up, compute_figures};
use equipoise::hollow::{Settings, solve};

use super::scene::Scene;

/// Columns a side.
const COLUMNS: usize = 400;

/// What is minimised, how Spin-It calls it, and by how much its solution divides the critical
/// speed.
const ROWS: [(Objective, &str, &str); 4] = [
    (
        Objective::SpinIt {
            gamma_c: 0.0,
            gamma_i: 1.0,
        },
        "inertia alone",
        "1.56",
    ),
    (
        Objective::SpinIt {
            gamma_c: 0.2,
            gamma_i: 1.0,
        },
        "with the lever, γ_c = 0.2",
        "1.60 (height), 1.68 (lever)",
    ),
    (
        Objective::SPIN_IT,
        "with the lever, γ_c = 1",
        "1.60 (height), 1.68 (lever)",
    ),
    (Objective::CriticalSpeed, "the critical speed itself", ""),
];

/// One line an objective; nothing where the model is not there.
pub fn print_table() -> Result<()> {
    println!();
    println!(
        "| teapot, wall 1 % | critical speed, solid | hollowed | ÷ | Spin-It ÷ | centre, mm | mass left | I_b/I_c |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for (objective, words, published) in ROWS {
        let request = Request {
            up: Up::Y,
            objective,
            ..Request::new(GoalKind::Top)
        };
        let Some(scene) = Scene::of("teapot", Some("teapot.obj"), &request)? else {
            return Ok(());
        };
        let columns = scene.columns(scene.shell.coarse_pitch(COLUMNS))?;
        let solution = solve(
            &scene.problem(&columns),
            &Settings::default(),
            &Watch::silent(),
        );
        let [solid, hollowed] = [&scene.goal.solid, &solution.moments]
            .map(|moments| compute_figures(&scene.goal, moments));
        let speed = |figures: &Figures| figures.critical_speed_rpm.unwrap_or(f64::INFINITY);
        println!(
            "| {words} | {:.1} | {:.1} | {:.3} | {published} | {:.2} | {:.3} | {:.4} |",
            speed(&solid),
            speed(&hollowed),
            speed(&solid) / speed(&hollowed),
            hollowed.center_height_mm,
            solution.moments.volume() / scene.goal.solid.volume(),
            hollowed.dominance_ratio
        );
    }
    Ok(())
}
