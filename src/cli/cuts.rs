//! `equipoise cuts`: plans of cuts side by side, for a shop to choose from.

use std::io::Write;

use super::args::{Request, again, quoted};
use super::bars::Bars;
use super::exit::Exit;
use super::flags::{command_for_plan, flag};
use super::prepare::{PrepareError, print_impossible};
use super::signals::Stop;
use super::voice::Voice;
use crate::base::setting::{Key, Setting};
use crate::base::units::format_count;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::kit::{Existing, PLANS_FILE};
use crate::prepare::Impossible;
use crate::prepare::plans::{
    PlanChoice, Plans, SeamRow, figure_words, part_words, plans, seam_words,
};

/// Share of the figure by which the first plan may be worse than the best and is still proposed.
/// Its seams are hidden, which costs some of the figure.
const FAR_RATIO: f64 = 0.15;

/// Finds plans and writes them, unless `stop` is pressed before; prints what each reaches.
pub fn cuts(
    request: &Request,
    count: usize,
    voice: Voice,
    stop: &Stop,
) -> Result<Exit, PrepareError> {
    let out = &mut std::io::stdout();
    let bars = Bars::new(voice);
    let watch = Watch::observed_until(bars.observer(), stop.flag());
    let found = run(request, count, &watch);
    bars.finish();
    if !matches!(found, Ok(Verdict::Found(_)))
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    match found? {
        Verdict::Found(plans) => {
            print(&plans, request, voice, out)?;
            Ok(Exit::Kept)
        }
        Verdict::No(impossible) => {
            print_impossible(&impossible, voice, out)?;
            Ok(Exit::NotKept)
        }
    }
}

/// Runs the job as far as its plans, and writes them.
fn run(
    request: &Request,
    count: usize,
    watch: &Watch,
) -> Result<Verdict<Plans, Impossible>, Error> {
    let existing = if request.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    existing.allows(&request.out)?;
    let how = command_for_plan(&request.job);
    let found = plans(&request.job, count, &how, watch)?;
    if let Verdict::Found(plans) = &found {
        plans.kit.write_watched(&request.out, existing, watch)?;
    }
    Ok(found)
}

fn print(
    plans: &Plans,
    request: &Request,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), PrepareError> {
    if voice.json {
        let text = serde_json::to_string_pretty(&plans.plans)?;
        return Ok(writeln!(out, "{text}")?);
    }
    if voice.manner.quiet {
        return Ok(());
    }
    for plan in &plans.plans {
        write!(out, "{}", words(plan))?;
    }
    let page = request.out.join(PLANS_FILE);
    writeln!(out, "pictures      {}", page.display())?;
    writeln!(out, "to choose     {}", to_choose(plans, request))?;
    Ok(())
}

/// Returns the first plan, or the best if the first is far from it.
fn proposed(choices: &[PlanChoice]) -> Option<&PlanChoice> {
    let first = choices.first().filter(|plan| plan.loss_ratio <= FAR_RATIO);
    let best = || {
        let choices = choices.iter();
        choices.min_by(|a, b| a.loss_ratio.total_cmp(&b.loss_ratio))
    };
    first.or_else(best)
}

/// Returns the command that makes a kit by the plan that is proposed.
fn to_choose(plans: &Plans, request: &Request) -> String {
    let Some(chosen) = proposed(&plans.plans) else {
        return command_for_plan(&request.job);
    };
    let plan = request.out.join(&chosen.file);
    let plan = flag(&Setting::new(Key::Plan, quoted(&plan.to_string_lossy())));
    again(&request.typed, "prepare", &plan).unwrap_or_else(|| command_for_plan(&request.job))
}

/// Returns the lines on a plan.
fn words(plan: &PlanChoice) -> String {
    let head = format!(
        "{}    {}; {}, {}; {}\n",
        plan.file,
        plan.tendency,
        part_words(plan),
        format_count(plan.pins, "pin"),
        figure_words(plan)
    );
    let seam = |row: &SeamRow| format!("              seam {}: {}\n", row.cut, seam_words(row));
    head + &plan.seams.iter().map(seam).collect::<String>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::Figure;

    #[test]
    fn the_usual_plan_is_proposed_unless_it_is_far_from_the_best() {
        let choice = |file: &str, loss_ratio: f64| PlanChoice {
            file: file.to_owned(),
            tendency: "the usual plan".to_owned(),
            figure: Figure::TopplingAngleRad,
            value: 0.1,
            loss_ratio,
            parts: 2,
            is_solid: false,
            pins: 2,
            joints_without_pins: 0,
            seams: Vec::new(),
            offers: Vec::new(),
        };
        let file_of = |losses: [f64; 2]| {
            let choices = [
                choice("plan1.toml", losses[0]),
                choice("plan2.toml", losses[1]),
            ];
            proposed(&choices).map(|plan| plan.file.clone())
        };
        assert_eq!(file_of([0.1, 0.0]).as_deref(), Some("plan1.toml"));
        assert_eq!(file_of([0.84, 0.0]).as_deref(), Some("plan2.toml"));
        assert!(proposed(&[]).is_none());
    }
}
