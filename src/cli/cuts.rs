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
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::kit::{Existing, PLANS_FILE};
use crate::prepare::Impossible;
use crate::prepare::plans::{PlanChoice, Plans, SeamRow, figure_words, plans};

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
    writeln!(out, "to choose     {}", to_choose(request))?;
    Ok(())
}

/// Returns the command that makes a kit by the first plan.
fn to_choose(request: &Request) -> String {
    let typed: Vec<String> = std::env::args().collect();
    let plan = request.out.join("plan1.toml");
    let plan = flag(&Setting::new(Key::Plan, quoted(&plan.to_string_lossy())));
    again(&typed, "prepare", &plan).unwrap_or_else(|| command_for_plan(&request.job))
}

/// Returns the lines on a plan.
fn words(plan: &PlanChoice) -> String {
    let head = format!(
        "{}    {}; {} parts, {} pins; {}\n",
        plan.file,
        plan.tendency,
        plan.parts,
        plan.pins,
        figure_words(plan)
    );
    let seam = |row: &SeamRow| {
        format!(
            "              seam {}: {:.0} mm, {}; seen {:.2}\n",
            row.cut, row.length_mm, row.place, row.seen_ratio
        )
    };
    head + &plan.seams.iter().map(seam).collect::<String>()
}
