//! Rounds: a kit is sliced, its toolpaths are weighed, and what they lay beyond the written parts
//! is made up for.

use std::path::{Path, PathBuf};

use super::drafts::{Aims, Drafts, draft};
use super::judge::Draft;
use super::kept::{Kept, Rounds, SlicedOutcome};
use super::load::infill_ratio;
use super::outcome::{Impossible, Outcome};
use super::weighed::weigh;
use super::{advise, failure, papers, placed, slice, solve};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::job::{Job, SlicedKit, SlicedRound};
use crate::run::Placed;
use crate::slice::SliceOrder;

/// The most rounds after the first kit.
const MOST_ROUNDS: usize = 4;

/// Prepares a job, slices its kit, and makes it again with what the toolpaths lay, until they keep
/// the promise.
///
/// Cuts and pins of a hollow kit stay as they were planned; its voids are solved for again. One
/// piece is solved anew. `profile` is a profile of the slicer, whose settings hold where those of
/// the printer say nothing. The kit's job holds the rounds and the figures of its own toolpaths.
/// So it is made again without a slicer.
///
/// # Errors
/// As [`super::prepare`], or there is no slicer, or none for this printer, or its profile cannot be
/// used.
pub fn prepare_sliced(
    job: &Job,
    profile: Option<&Path>,
    watch: &Watch,
) -> Result<SlicedOutcome, Error> {
    watch.begin_round();
    let order = SliceOrder {
        kit: PathBuf::new(),
        slicer: Some(slice::find_for_rounds(job, watch)?),
        profile: profile.map(Path::to_owned),
    };
    order.check_profile()?;
    let job = Job {
        sliced: Vec::new(),
        toolpaths: None,
        slicer: None,
        ..job.clone()
    };
    let first = placed(&job, watch)?;
    let mut plans = Plans::of(&first, watch)?;
    let mut rounds = Rounds::default();
    let mut goals = Goals {
        job: &job,
        first: &first,
        own: None,
    };
    for number in 0..=MOST_ROUNDS {
        if number > 0 {
            watch.begin_round();
        }
        let round = goals.of_round(&rounds.sliced, watch)?;
        let draft = match plans.draft(&round, watch) {
            Ok(Verdict::Found(draft)) => draft,
            Ok(Verdict::No(impossible)) if rounds.best.is_none() => {
                let impossible = advise::remedies(&first, impossible, watch)?;
                return Ok(rounds.end(Outcome::Impossible(Box::new(impossible))));
            }
            Err(error) if rounds.best.is_none() || matches!(error, Error::Cancelled) => {
                return Err(error);
            }
            // A later round may go too far; the best kit of those before is kept.
            Ok(Verdict::No(_)) | Err(_) => break,
        };
        let prepared = papers::finish(&round, &draft, None, watch)?;
        let weighed = weigh(&order, &prepared, watch)?;
        if rounds.add(round, draft, weighed) {
            break;
        }
    }
    let best = rounds.best.take().ok_or(Error::Cancelled)?;
    let Kept {
        round,
        draft,
        weighed,
    } = *best;
    let last = with_rounds(&round, round.job.sliced.clone(), Some(weighed.record));
    let prepared = papers::finish(&last, &draft, None, watch)?;
    let prepared = failure::on_failure(&last, prepared, watch)?;
    rounds.broken = weighed.broken;
    Ok(rounds.end(Outcome::Prepared(Box::new(prepared))))
}

/// The goal of the rounds, placed.
struct Goals<'a> {
    job: &'a Job,
    /// With the infill that the printer's profile says.
    first: &'a Placed,
    /// With the infill that the slicer lays; `None` until that is known.
    own: Option<Placed>,
}

impl Goals<'_> {
    /// Returns the goal of the round after others.
    fn of_round(&mut self, sliced: &[SlicedRound], watch: &Watch) -> Result<Placed, Error> {
        let sliced = sliced.to_vec();
        if self.own.is_none() && infill_ratio(&sliced).is_some() {
            let job = Job {
                sliced: sliced.clone(),
                ..self.job.clone()
            };
            self.own = Some(placed(&job, watch)?);
        }
        let goal = self.own.as_ref().unwrap_or(self.first);
        Ok(with_rounds(goal, sliced, None))
    }
}

/// Returns a placed goal with the rounds, and the toolpaths, of its job.
fn with_rounds(placed: &Placed, sliced: Vec<SlicedRound>, own: Option<SlicedKit>) -> Placed {
    let job = Job {
        sliced,
        toolpaths: own,
        ..placed.job.clone()
    };
    Placed {
        job,
        ..placed.clone()
    }
}

/// The plans that every round drafts again.
enum Plans<'a> {
    /// Those of a hollow kit: they stay.
    Kept(Box<Drafts<'a>>),
    /// One piece has no cuts: it is solved anew.
    Anew,
    /// The goal cannot be met.
    None(Box<Impossible>),
}

impl<'a> Plans<'a> {
    /// Solves a goal, and plans its cuts.
    fn of(placed: &'a Placed, watch: &Watch) -> Result<Self, Error> {
        if placed.sparse.is_some() {
            return Ok(Self::Anew);
        }
        Ok(match solve::best(placed, watch)? {
            Verdict::Found(solved) => Self::Kept(Box::new(Drafts::new(placed, solved, watch)?)),
            Verdict::No(impossible) => Self::None(Box::new(impossible)),
        })
    }

    /// Drafts the kit of a round.
    fn draft(
        &mut self,
        round: &Placed,
        watch: &Watch,
    ) -> Result<Verdict<Draft, Impossible>, Error> {
        match self {
            Self::Kept(drafts) => Ok(Verdict::Found(drafts.draft(round, watch)?)),
            Self::None(impossible) => Ok(Verdict::No(impossible.as_ref().clone())),
            Self::Anew => match solve::best(round, watch)? {
                Verdict::No(impossible) => Ok(Verdict::No(impossible)),
                Verdict::Found(solved) => {
                    let aims = Aims {
                        planned: round,
                        weighed: round,
                    };
                    Ok(Verdict::Found(draft(aims, solved, watch)?))
                }
            },
        }
    }
}
