//! The weight of a kit's toolpaths, beside its promise.

use std::path::PathBuf;

use super::outcome::Prepared;
use super::steps::{step, to_steps};
use crate::base::digest::sha256_hex;
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::{Phase, Watch};
use crate::error::{Error, SlicedError};
use crate::job::{SlicedKit, SlicedPart, SlicedPlate, SlicedRound};
use crate::kit::{Existing, Kit};
use crate::mass::Moments;
use crate::slice::{PlateSlice, SliceOrder, slice_kit};
use crate::slicer::Scratch;
use crate::verify::{InfillOrder, PrintedJudgement, infill_share, verify_printed};

/// Distance of the centre from the promised one that is near enough, mm.
const NEAR_MM: f64 = 0.01;
/// Tilt of the principal axis beyond the promised one that is near enough, degrees.
const NEAR_DEG: f64 = 0.05;
/// Deviation of the mass from the promised one that is near enough, as a share.
const NEAR_MASS_RATIO: f64 = 2e-3;
/// The share of a print by which toolpaths may be off before the infill is taken as wrong. It is
/// half of what a slicer may lay beyond a kit's parts.
const CALIBRATE_RATIO: f64 = 0.025;
/// Steps to which the infill of a slicer is known.
const INFILL_STEP: f64 = 1e-4;
/// Steps to which a round's centre is known, mm.
const STEP_MM: f64 = 1e-4;
/// Steps to which its volume is known, as a share of it. The centre is as far from the origin as
/// the model is long.
const VOLUME_STEP: f64 = 1e-6;
/// Steps to which a tilt is kept, degrees.
const STEP_DEG: f64 = 1e-3;
/// Steps to which a mass is kept, g.
const STEP_G: f64 = 1e-2;

/// The weight of a kit's toolpaths, beside its promise.
pub struct Weighed {
    /// Whether the kit itself keeps every promise.
    is_sound: bool,
    pub miss_mm: f64,
    /// Tilt of the principal axis beyond that of the written parts, degrees; `None` for goals
    /// without.
    tilt_deg: Option<f64>,
    /// Their mass over the promised one, less 1.
    heavier_ratio: f64,
    /// Moments of all that they lay beyond the written parts, model frame.
    beyond: Moments,
    /// Their volume, mm³.
    volume_mm3: f64,
    /// The sparse infill that the kit counts with, mm³ of solid print; 0 for a hollow kit.
    infill_mm3: f64,
    /// The promises that they break, in words.
    pub broken: Vec<String>,
    /// The figures that the kit keeps of them.
    pub record: SlicedKit,
}

/// Slices a kit in a folder of its own, as it is ordered for another, and weighs the toolpaths.
pub fn weigh(order: &SliceOrder, prepared: &Prepared, watch: &Watch) -> Result<Weighed, Error> {
    watch.enter(Phase::Slice);
    let scratch = Scratch::new().map_err(crate::slicer::SlicerError::Folder)?;
    let [kit, toolpaths] = ["kit", "toolpaths"].map(|name| scratch.path().join(name));
    prepared.kit.write_watched(&kit, Existing::Keep, watch)?;
    let order = SliceOrder {
        kit: kit.clone(),
        ..order.clone()
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
    let plates = sliced.slices.plates.iter();
    let plates = plates.map(|plate| plate_row(plate, &prepared.kit));
    let kit = SlicedKit {
        slicer: sliced.slices.slicer.clone(),
        profile_sha256: sliced.slices.profile_sha256.clone(),
        mass_g: 0.0,
        miss_mm: 0.0,
        tilt_deg: None,
        plates: plates.collect(),
        parts: Vec::new(),
    };
    let not_all = || SlicedError::NotAllLaid {
        parts: judgement.missing.join(", "),
    };
    let weighed = Weighed::of(&judgement, kit).ok_or_else(not_all)?;
    let sheet = &prepared.checklist;
    let infill_g = sheet.infill.as_ref().map_or(0.0, InfillOrder::infill_g);
    Ok(Weighed {
        is_sound: prepared.passes(),
        infill_mm3: infill_g / sheet.material.density_g_cm3 * MM3_PER_CM3,
        ..weighed
    })
}

/// Returns the toolpaths of a plate as a job keeps them.
fn plate_row(plate: &PlateSlice, kit: &Kit) -> SlicedPlate {
    let bytes = kit.files().find(|(file, _)| *file == plate.plate);
    SlicedPlate {
        file: plate.plate.clone(),
        sha256: bytes.map_or_else(String::new, |(_, bytes)| sha256_hex(&[bytes])),
        minutes: plate.minutes,
        parts_g: plate.parts_g,
        support_g: plate.support_g,
        filament_g: plate.filament_g,
    }
}

impl Weighed {
    /// Returns what was weighed, with the plates and the slicer of `kit`; `None` if a part is not
    /// printed.
    fn of(judgement: &PrintedJudgement, kit: SlicedKit) -> Option<Self> {
        let (laid, written) = (judgement.toolpaths.as_ref()?, &judgement.written);
        let off = [0, 1, 2].map(|axis| laid.center_mm[axis] - written.center_mm[axis]);
        let miss_mm = off.iter().map(|mm| mm * mm).sum::<f64>().sqrt();
        let broken = judgement.checks.iter().filter(|check| !check.pass);
        let tilts = laid.axis_tilt_deg.zip(written.axis_tilt_deg);
        let tilt_deg = tilts.map(|(laid, written)| laid - written);
        let parts = judgement.parts.iter().map(|part| SlicedPart {
            id: part.id.clone(),
            mass_g: to_steps(part.mass_g, STEP_G),
        });
        Some(Self {
            is_sound: true,
            miss_mm,
            tilt_deg,
            heavier_ratio: laid.mass_g / written.mass_g - 1.0,
            beyond: judgement.beyond?,
            volume_mm3: laid.volume_mm3,
            infill_mm3: 0.0,
            broken: broken.map(|check| check.kind.to_string()).collect(),
            record: SlicedKit {
                mass_g: to_steps(laid.mass_g, STEP_G),
                miss_mm: to_steps(miss_mm, STEP_MM),
                tilt_deg: tilt_deg.map(|deg| to_steps(deg, STEP_DEG)),
                parts: parts.collect(),
                ..kit
            },
        })
    }

    /// Returns whether the toolpaths keep the promise so well that another round says nothing.
    pub fn is_near(&self) -> bool {
        self.broken.is_empty()
            && self.miss_mm < NEAR_MM
            && self.tilt_deg.unwrap_or(0.0) < NEAR_DEG
            && self.heavier_ratio.abs() < NEAR_MASS_RATIO
    }

    /// Returns whether these toolpaths break fewer promises than others, or as many and are nearer.
    /// A kit that keeps its own promises goes before one that does not.
    pub fn is_better_than(&self, other: &Self) -> bool {
        let rank = |one: &Self| (!one.is_sound, one.broken.len(), one.miss_mm);
        rank(self) < rank(other)
    }

    /// Returns the infill that the slicer lays, over what the kit counts with; `None` if the print
    /// weighs what it should, or if no slicer differs so much from the profile.
    fn infill_ratio(&self) -> Option<f64> {
        let beyond_mm3 = self.beyond.volume();
        if self.infill_mm3 == 0.0 || beyond_mm3.abs() <= CALIBRATE_RATIO * self.volume_mm3 {
            return None;
        }
        let ratio = to_steps(1.0 + beyond_mm3 / self.infill_mm3, INFILL_STEP);
        (infill_share(ratio) <= 1.0).then_some(ratio)
    }

    /// Returns the round, rounded. `known` is the infill of the slicer that the kit counts with;
    /// it is weighed once. Nothing is made up for but that in the round that finds it.
    ///
    /// Toolpaths differ in their last digits from run to run. So another loop may end with other
    /// digits; the job that is kept makes the same kit.
    pub fn round(&self, known: Option<f64>) -> SlicedRound {
        let found = self.infill_ratio().filter(|_| known.is_none());
        if found.is_some() {
            return SlicedRound {
                miss_mm: to_steps(self.miss_mm, STEP_MM),
                infill_ratio: found,
                beyond: [0.0; 10],
            };
        }
        let volume_step = step(self.volume_mm3 * VOLUME_STEP);
        let moment_step = step(self.volume_mm3 * STEP_MM);
        let mut beyond = self.beyond.0.map(|moment| to_steps(moment, moment_step));
        beyond[0] = to_steps(self.beyond.0[0], volume_step);
        SlicedRound {
            miss_mm: to_steps(self.miss_mm, STEP_MM),
            infill_ratio: known,
            beyond,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weighed(miss_mm: f64, tilt_deg: f64) -> Weighed {
        Weighed {
            is_sound: true,
            miss_mm,
            tilt_deg: Some(tilt_deg),
            heavier_ratio: 0.0,
            beyond: Moments([12.345_678_9; 10]),
            volume_mm3: 21_850.0,
            infill_mm3: 0.0,
            broken: Vec::new(),
            record: SlicedKit {
                slicer: String::new(),
                profile_sha256: None,
                mass_g: 0.0,
                miss_mm: 0.0,
                tilt_deg: None,
                plates: Vec::new(),
                parts: Vec::new(),
            },
        }
    }

    #[test]
    fn a_round_is_kept_to_a_tenth_of_a_micrometre_of_the_centre() {
        let round = weighed(0.123_456, 0.0).round(None);
        assert_eq!(round.miss_mm, 0.1235);
        assert_eq!(round.beyond[0], 12.35);
        assert_eq!(round.beyond[1..], [12.0; 9]);
    }

    #[test]
    fn a_slicer_that_lays_more_infill_is_counted_with_once_and_nothing_else_is_made_up_for() {
        let mut beyond = Moments([0.0; 10]);
        beyond.0[..2].copy_from_slice(&[1_500.0, -300.0]);
        let heavy = Weighed {
            infill_mm3: 15_000.0,
            beyond,
            ..weighed(0.05, 0.0)
        };
        let found = heavy.round(None);
        assert_eq!((found.infill_ratio, found.beyond), (Some(1.1), [0.0; 10]));
        let after = heavy.round(found.infill_ratio);
        assert_eq!((after.infill_ratio, after.beyond[0]), (Some(1.1), 1500.0));
        let hollow = Weighed {
            infill_mm3: 0.0,
            ..heavy
        };
        assert_eq!(hollow.round(None).infill_ratio, None);
    }

    #[test]
    fn a_print_far_too_heavy_is_not_said_to_have_more_infill() {
        let double = Weighed {
            infill_mm3: 6_000.0,
            beyond: Moments([1_500.0; 10]),
            ..weighed(0.05, 0.0)
        };
        assert_eq!(double.round(None).infill_ratio, None);
        let right = Weighed {
            infill_mm3: 15_000.0,
            beyond: Moments([500.0; 10]),
            ..weighed(0.05, 0.0)
        };
        assert_eq!(right.round(None).infill_ratio, None);
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

    #[test]
    fn a_kit_that_breaks_its_own_promise_is_never_the_better_one() {
        let unsound = Weighed {
            is_sound: false,
            ..weighed(0.0, 0.0)
        };
        let mut broken = weighed(0.5, 0.0);
        broken.broken.push("waterline".to_owned());
        assert!(broken.is_better_than(&unsound));
        assert!(!unsound.is_better_than(&broken));
    }
}
