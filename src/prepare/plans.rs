//! Plans side by side: a job opened in several ways, for a shop to choose from.

mod choice;

pub use choice::{PlanChoice, SeamRow, figure_words, part_words, seam_words};

use super::{advise, outcome::Impossible, placed, solve};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::cut::{CutError, CutOrder, parts};
use crate::error::{CellsError, Error, GradedError};
use crate::job::{Job, JobError};
use crate::kit::{Kit, PLANS_FILE};
use crate::mesh::TriMesh;
use crate::open::{Leaning, climb_by_tendency};
use crate::page::{self, PlanCard, draw_sides};
use crate::run::Placed;
use choice::{choice, pin_words};

/// Plans that open a model, for a shop to choose from.
#[derive(Debug)]
pub struct Plans {
    /// The plans, the usual one first.
    pub plans: Vec<PlanChoice>,
    /// Their files and the page, in memory.
    pub kit: Kit,
}

/// Finds at most `count` plans for a job, and draws them side by side. `how_to_choose` tells the
/// reader of the page how to order one.
///
/// # Errors
/// As [`super::prepare`].
pub fn plans(
    job: &Job,
    count: usize,
    how_to_choose: &str,
    watch: &Watch,
) -> Result<Verdict<Plans, Impossible>, Error> {
    if job.interior.has_cells() {
        return Err(CellsError::Cuts.into());
    }
    if !job.interior.is_hollow() {
        return Err(GradedError::Cuts.into());
    }
    let placed = placed(job, watch)?.as_planned();
    let solved = match solve::best(&placed, watch)? {
        Verdict::Found(solved) => solved,
        Verdict::No(impossible) => {
            return Ok(Verdict::No(advise::remedies(&placed, impossible, watch)?));
        }
    };
    let leanings = climb_by_tendency(&placed, solved, count, watch)?;
    watch.enter(Phase::Report);
    let mut kit = Kit::default();
    let (mut choices, mut cards) = (Vec::new(), Vec::new());
    for leaning in &leanings {
        let file = format!("plan{}.toml", choices.len() + 1);
        let choice = choice(file, leaning, &leanings);
        let order = order(&placed, leaning);
        kit.add(
            &choice.file,
            order.to_toml().map_err(JobError::from)?.into_bytes(),
        );
        cards.push(card(&placed, leaning, &choice, watch)?);
        choices.push(choice);
    }
    let page = page::plans(&placed.name(), &cards, how_to_choose);
    kit.add(PLANS_FILE, page.into_bytes());
    Ok(Verdict::Found(Plans {
        plans: choices,
        kit,
    }))
}

/// Returns the file of a plan: its cuts, and what stays solid. Its pins are placed anew.
fn order(placed: &Placed, leaning: &Leaning) -> CutOrder {
    CutOrder {
        pins: None,
        keep_clear: placed.job.keep_clear.clone(),
        ..CutOrder::of(&leaning.opened.plan)
    }
}

fn card(
    placed: &Placed,
    leaning: &Leaning,
    choice: &PlanChoice,
    watch: &Watch,
) -> Result<PlanCard, Error> {
    let opened = &leaning.opened;
    let made = parts(&opened.voids.hollowed, &opened.plan, &opened.request)?;
    let made = made.or_error::<CutError>()?;
    let meshes: Vec<TriMesh> = made.iter().map(|part| part.solid.mesh().clone()).collect();
    let up = placed.goal().frame.axis();
    let row = |name: &str, value: String| [name.to_owned(), value];
    let mut rows = vec![
        row("Figure", figure_words(choice)),
        row("Parts", part_words(choice)),
        row("Pins", pin_words(choice)),
    ];
    rows.extend(
        choice
            .seams
            .iter()
            .map(|seam| row(&format!("Seam {}", seam.cut), seam_words(seam))),
    );
    rows.push(row("File", choice.file.clone()));
    Ok(PlanCard {
        title: format!(
            "{}: {}",
            choice.file.trim_end_matches(".toml"),
            choice.tendency
        ),
        rows,
        notes: opened.remarks.iter().map(ToString::to_string).collect(),
        pictures: draw_sides(&meshes, &up, watch)?,
    })
}
