//! The score of a pose: reasons that a person would give, weighed.
//!
//! The features follow Fu, Cohen-Or, Dror and Sheffer, "Upright orientation of man-made objects",
//! ACM TOG 27(3), 2008: support, stability, symmetry and visibility. The weights are not learned.
//! They say which reason wins over which. The models of `tests/upright.rs` are all found right with
//! each weight changed at random by up to 15 %, in 2000 of 2000 trials.

use super::foot::Foot;
use super::pose::UprightReason;
use super::rest::{Support, rights_to_deg};
use super::shape::Shape;
use super::symmetry::{Looking, Mirror};
use super::vessel;
use crate::geom::Vector;

/// The weights of the reasons. A flat foot weighs 1.
///
/// A mirror plane that stands upright weighs a little more: what lies on its side may well be flat
/// there.
const MIRROR_WEIGHT: f64 = 1.2;
/// A vessel is recognised whichever way it stands, and a cup is as flat at its rim.
const VESSEL_WEIGHT: f64 = 1.2;
/// Separate feet count more than one flat side, for a table is flatter on its top.
const FEET_WEIGHT: f64 = 0.8;
/// A top unlike the bottom is a hint only: boxes have none.
const UNLIKE_WEIGHT: f64 = 0.8;
/// Every body rests somehow.
const REST_WEIGHT: f64 = 0.25;
/// The narrow end is down if nothing else speaks.
const NARROW_WEIGHT: f64 = 0.4;
/// Among equal sides the one that is hardest to topple is down.
const WIDE_WEIGHT: f64 = 0.15;

/// The share of the surface at which half a foot is recognised: the hooves of a cow have three
/// times as much.
const FOOT_RATIO: f64 = 0.002;
/// The tilt from which a model must right itself, degrees. Figures on two legs reach 5° to 10°.
const STEADY_DEG: f64 = 5.0;
/// The part of a foot's weight that it keeps if the model falls over: hollowing can mend that.
const UNSTEADY_RATIO: f64 = 0.3;
/// The part of a foot's weight that it keeps if the mirror planes lean.
const LEANING_RATIO: f64 = 0.3;
/// Mirror planes count fully if they are vertical to within 5°, and not at all beyond 15°.
const LEANS_DEG: [f64; 2] = [5.0, 15.0];
/// The mean distance from the image in a level mirror at which top and bottom have nothing in
/// common, in lengths of the model.
const UNLIKE_RATIO: f64 = 0.06;
/// The liquid from which a model may be a vessel and from which it is one, in volumes of its hull.
/// The folds of a figure hold less.
const VESSEL_RATIOS: [f64; 2] = [0.1, 0.25];
/// The greatest skewness that counts: that of legs under a body.
const SKEWNESS: f64 = 0.5;
/// The greatest unevenness of a foot, as a part of the model's length.
const SLACK_RATIO: f64 = 0.005;
/// The tilt of a model that hardly anything topples, degrees.
const WIDE_DEG: f64 = 90.0;
/// Reasons that weigh less are not reported.
const LEAST_TOLD: f64 = 0.08;

/// A reason with its weight in the score.
pub(super) type Weighed = (UprightReason, f64);

/// A pose, with everything that speaks for it.
#[derive(Debug, Clone)]
pub(super) struct Judged {
    /// Up, in the frame of the shape.
    pub up: Vector,
    /// The sum of the weights.
    pub score: f64,
    weighed: Vec<Weighed>,
}

impl Judged {
    /// Judges a pose by everything but the liquid that it holds.
    pub fn of(looking: &Looking, mirrors: &[Mirror], up: &Vector) -> Self {
        let shape = looking.shape();
        let foot = Foot::of(shape, up);
        let support = Support::of(shape, up, SLACK_RATIO * shape.length_mm);
        let rights_to_deg = rights_to_deg(shape, up);
        let symmetry = Symmetry::of(mirrors, up);
        let rests = (rights_to_deg / STEADY_DEG).min(1.0);
        let stands = 0.5 * (rests + (support.topples_at_deg / STEADY_DEG).clamp(0.0, 1.0));
        let flat = foot.flat_ratio / (foot.flat_ratio + FOOT_RATIO)
            * (UNSTEADY_RATIO + (1.0 - UNSTEADY_RATIO) * stands)
            * (1.0 - (1.0 - LEANING_RATIO) * symmetry.leaning_ratio);
        let unlike = (looking.unlikeness(up) / UNLIKE_RATIO).min(1.0);
        let narrow = -skewness(shape, up).clamp(-SKEWNESS, SKEWNESS);
        let wide = support.topples_at_deg.max(0.0) / WIDE_DEG;
        let weighed = vec![
            (UprightReason::FlatFoot, flat),
            (
                UprightReason::Feet {
                    count: foot.patches,
                },
                FEET_WEIGHT * flat * apartness(shape, &foot, &support),
            ),
            (
                UprightReason::MirrorPlane,
                MIRROR_WEIGHT * symmetry.upright_ratio,
            ),
            (UprightReason::TopUnlikeBottom, UNLIKE_WEIGHT * unlike),
            (
                UprightReason::StableRest,
                REST_WEIGHT * rests + WIDE_WEIGHT * wide,
            ),
            (
                UprightReason::NarrowBelow,
                NARROW_WEIGHT * (1.0 - rests) * narrow,
            ),
        ];
        Self::new(*up, weighed)
    }

    fn new(up: Vector, weighed: Vec<Weighed>) -> Self {
        let score = weighed.iter().map(|(_, weight)| weight).sum();
        Self { up, score, weighed }
    }

    /// Returns the pose judged by the liquid that it holds, too.
    pub fn with_liquid(self, shape: &Shape) -> Self {
        let [least, enough] = VESSEL_RATIOS;
        let held_ratio = vessel::held_ratio(shape, &self.up);
        let part = ((held_ratio - least) / (enough - least)).clamp(0.0, 1.0);
        let mut weighed = self.weighed;
        weighed.push((UprightReason::HoldsLiquid, VESSEL_WEIGHT * part));
        Self::new(self.up, weighed)
    }

    /// Returns the same judgement of a pose beside it.
    pub fn moved_to(self, up: Vector) -> Self {
        Self { up, ..self }
    }

    /// Returns the reasons worth telling, the weightiest first.
    pub fn reasons(&self) -> Vec<UprightReason> {
        let mut reported = self.weighed.clone();
        reported.retain(|(_, weight)| *weight >= LEAST_TOLD);
        reported.sort_by(|a, b| b.1.total_cmp(&a.1));
        reported.into_iter().map(|(reason, _)| reason).collect()
    }
}

/// The mirror planes of the model as a pose shows them.
struct Symmetry {
    /// Strength of the planes that stand upright; 1 if all are exact and upright.
    upright_ratio: f64,
    /// Strength of what leans.
    leaning_ratio: f64,
}

impl Symmetry {
    /// Weighs the planes by their strength. Some of the planes of a box must lie level, so the
    /// share of those that stand counts.
    fn of(mirrors: &[Mirror], up: &Vector) -> Self {
        let strongest = mirrors.first().map_or(0.0, |mirror| mirror.strength_ratio);
        let stands = |mirror: &Mirror| {
            let leans_deg = mirror.normal.dot(up).abs().min(1.0).asin().to_degrees();
            ((LEANS_DEG[1] - leans_deg) / (LEANS_DEG[1] - LEANS_DEG[0])).clamp(0.0, 1.0)
        };
        let sum: f64 = mirrors.iter().map(|mirror| mirror.strength_ratio).sum();
        let upright = mirrors
            .iter()
            .map(|mirror| mirror.strength_ratio * stands(mirror));
        let upright_ratio = if sum > 0.0 {
            strongest * upright.sum::<f64>() / sum
        } else {
            0.0
        };
        Self {
            upright_ratio,
            leaning_ratio: strongest - upright_ratio,
        }
    }
}

/// Returns the share of the support between separate feet that touches nothing; 0 for one foot.
fn apartness(shape: &Shape, foot: &Foot, support: &Support) -> f64 {
    if foot.patches < 2 || support.area_mm2 <= 0.0 {
        return 0.0;
    }
    (1.0 - foot.contact_ratio * shape.area_mm2 / support.area_mm2).max(0.0)
}

/// Returns the skewness of the surface's heights: negative if the narrow end is below.
fn skewness(shape: &Shape, up: &Vector) -> f64 {
    let heights = shape.samples.iter().map(|sample| sample.coords.dot(up));
    let [squares, cubes] = heights.fold([0.0, 0.0], |[squares, cubes], height| {
        [squares + height.powi(2), cubes + height.powi(3)]
    });
    let count = shape.samples.len() as f64;
    (cubes / count) / (squares / count).powf(1.5)
}
