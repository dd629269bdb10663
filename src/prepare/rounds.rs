//! Rounds: a graded kit is sliced, its toolpaths are weighed, and what they lay beyond the written
//! parts is solved for again.

use std::path::PathBuf;

use super::outcome::{Outcome, Prepared};
use super::prepare;
use crate::base::watch::Watch;
use crate::error::{Error, GradedError};
use crate::job::{Job, SlicedRound};
use crate::kit::Existing;
use crate::mass::Moments;
use crate::slice::{SliceOrder, slice_kit};
use crate::slicer::Scratch;
use crate::verify::{PrintedJudgement, verify_printed};

/// The most rounds after the first kit.
const MOST_ROUNDS: usize = 4;
/// Distance of the centre from the promised one that is near enough, mm.
const NEAR_MM: f64 = 0.01;
/// Tilt of the principal axis beyond the promised one that is near enough, degrees.
const NEAR_DEG: f64 = 0.05;
/// Deviation of the mass from the promised one that is near enough, as a share.
const NEAR_MASS_RATIO: f64 = 2e-3;
/// Steps to which a round's centre is known, mm.
const STEP_MM: f64 = 1e-4;
/// Steps to which its volume is known, as a share of it. The centre is as far from the origin as
/// the model is long.
const VOLUME_STEP: f64 = 1e-6;

/// The end of a run whose kits were sliced.
#[derive(Debug)]
pub struct SlicedOutcome {
    /// The kit whose toolpaths came nearest to its promise.
    pub outcome: Outcome,
    /// The distance between the centre of the toolpaths and the promised one in every round, mm.
    pub misses_mm: Vec<f64>,
    /// The promises that the toolpaths of the kit break, in words; empty if they keep all.
    pub broken: Vec<String>,
}

/// Prepares a graded job, slices its kit, and prepares it again with what the toolpaths lay, until
/// they keep the promise. The kit's job holds the rounds, so that it is made again without a
/// slicer.
///
/// # Errors
/// As [`prepare`], or the job is not graded, or there is no slicer.
pub fn prepare_sliced(job: &Job, watch: &Watch) -> Result<SlicedOutcome, Error> {
    if job.interior.is_hollow() {
        return Err(GradedError::Hollow.into());
    }
    let mut job = Job {
        sliced: Vec::new(),
        ..job.clone()
    };
    let mut misses_mm: Vec<f64> = Vec::new();
    let mut best: Option<(Outcome, Weighed)> = None;
    for _ in 0..=MOST_ROUNDS {
        let outcome = prepare(&job, watch)?;
        let Outcome::Prepared(prepared) = &outcome else {
            // A later round may go too far; the best kit of those before is kept.
            let broken = best
                .as_ref()
                .map_or_else(Vec::new, |best| best.1.broken.clone());
            let outcome = best.map_or(outcome, |best| best.0);
            return Ok(SlicedOutcome {
                outcome,
                misses_mm,
                broken,
            });
        };
        let found = weigh(&job, prepared, watch)?;
        misses_mm.push(found.miss_mm);
        job.sliced.push(found.round());
        let is_near = found.is_near();
        if best
            .as_ref()
            .is_none_or(|(_, best)| found.is_better_than(best))
        {
            best = Some((outcome, found));
        }
        if is_near {
            break;
        }
    }
    let (outcome, found) = best.ok_or(Error::Cancelled)?;
    Ok(SlicedOutcome {
        outcome,
        misses_mm,
        broken: found.broken,
    })
}

/// The weight of a kit's toolpaths, beside its promise.
struct Weighed {
    miss_mm: f64,
    /// Tilt of the principal axis against that of the written parts, degrees; 0 for goals without.
    tilt_deg: f64,
    /// Their mass over the promised one, less 1.
    heavier_ratio: f64,
    /// Moments of all that they lay beyond the written parts, model frame.
    beyond: Moments,
    /// Their volume, mm³.
    volume_mm3: f64,
    /// The promises that they break, in words.
    broken: Vec<String>,
}

/// Slices a kit in a folder of its own, and weighs the toolpaths.
fn weigh(job: &Job, prepared: &Prepared, watch: &Watch) -> Result<Weighed, Error> {
    let scratch = Scratch::new().map_err(crate::slicer::SlicerError::Folder)?;
    let [kit, toolpaths] = ["kit", "toolpaths"].map(|name| scratch.path().join(name));
    prepared.kit.write_watched(&kit, Existing::Keep, watch)?;
    let order = SliceOrder {
        kit: kit.clone(),
        slicer: job.slicer.as_ref().map(|slicer| slicer.command.clone()),
        profile: None,
    };
    let sliced = slice_kit(&order, watch)?;
    sliced
        .files
        .write_watched(&toolpaths, Existing::Keep, watch)?;
    let plates = sliced.slices.plates.iter();
    let files: Vec<PathBuf> = plates
        .map(|plate| toolpaths.join(&plate.toolpaths))
        .collect();
    let judgement = verify_printed(&kit, &files, watch)?;
    Weighed::of(&judgement).ok_or_else(|| GradedError::NotAllLaid.into())
}

impl Weighed {
    /// Returns what was weighed; `None` if a part is not printed.
    fn of(judgement: &PrintedJudgement) -> Option<Self> {
        let (laid, written) = (judgement.toolpaths.as_ref()?, &judgement.written);
        let off = [0, 1, 2].map(|axis| laid.center_mm[axis] - written.center_mm[axis]);
        let broken = judgement.checks.iter().filter(|check| !check.pass);
        let tilts = laid.axis_tilt_deg.zip(written.axis_tilt_deg);
        Some(Self {
            miss_mm: off.iter().map(|mm| mm * mm).sum::<f64>().sqrt(),
            tilt_deg: tilts.map_or(0.0, |(laid, written)| laid - written),
            heavier_ratio: laid.mass_g / written.mass_g - 1.0,
            beyond: judgement.beyond?,
            volume_mm3: laid.volume_mm3,
            broken: broken.map(|check| check.kind.to_string()).collect(),
        })
    }

    fn is_near(&self) -> bool {
        self.broken.is_empty()
            && self.miss_mm < NEAR_MM
            && self.tilt_deg < NEAR_DEG
            && self.heavier_ratio.abs() < NEAR_MASS_RATIO
    }

    /// Returns whether these toolpaths break fewer promises than others, or as many and are nearer.
    fn is_better_than(&self, other: &Self) -> bool {
        let [own, its] = [self, other].map(|one| (one.broken.len(), one.miss_mm));
        own < its
    }

    /// Returns the round, rounded. Toolpaths differ in their last digits from run to run. So
    /// another loop may end with other digits; the job that is kept makes the same kit.
    fn round(&self) -> SlicedRound {
        let volume_step = step(self.volume_mm3 * VOLUME_STEP);
        let moment_step = step(self.volume_mm3 * STEP_MM);
        let mut beyond = self.beyond.0.map(|moment| to_steps(moment, moment_step));
        beyond[0] = to_steps(self.beyond.0[0], volume_step);
        SlicedRound {
            miss_mm: to_steps(self.miss_mm, STEP_MM),
            beyond,
        }
    }
}

/// Returns the power of ten at or below a positive number.
fn step(number: f64) -> f64 {
    10.0_f64.powf(number.log10().floor())
}

/// Rounds a number to whole steps.
fn to_steps(number: f64, step: f64) -> f64 {
    let steps = (number / step).round();
    // A division by a whole power of ten rounds to the fewest digits, a product does not.
    if step < 1.0 {
        steps / step.recip().round() + 0.0
    } else {
        steps * step + 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weighed(miss_mm: f64, tilt_deg: f64) -> Weighed {
        Weighed {
            miss_mm,
            tilt_deg,
            heavier_ratio: 0.0,
            beyond: Moments([12.345_678_9; 10]),
            volume_mm3: 21_850.0,
            broken: Vec::new(),
        }
    }

    #[test]
    fn a_round_is_kept_to_a_tenth_of_a_micrometre_of_the_centre() {
        let round = weighed(0.123_456, 0.0).round();
        assert_eq!(round.miss_mm, 0.1235);
        assert_eq!(round.beyond[0], 12.35);
        assert_eq!(round.beyond[1..], [12.0; 9]);
    }

    #[test]
    fn toolpaths_are_near_if_both_centre_and_axis_are() {
        assert!(weighed(0.009, 0.04).is_near());
        assert!(!weighed(0.011, 0.0).is_near());
        assert!(!weighed(0.0, 0.06).is_near());
        assert!(weighed(0.0, -1.0).is_near(), "an axis that became better");
        let mut broken = weighed(0.0, 0.0);
        broken.broken.push("waterline".to_owned());
        assert!(!broken.is_near());
        let heavy = Weighed {
            heavier_ratio: 0.03,
            ..weighed(0.0, 0.0)
        };
        assert!(!heavy.is_near());
        assert!(weighed(0.1, 0.0).is_better_than(&broken));
        assert!(weighed(0.1, 0.0).is_better_than(&weighed(0.2, 0.0)));
    }
}
