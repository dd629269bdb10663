//! The bound of a kit: no hollowing within its wall is better. The judge proves it again.
//!
//! The checklist has a point of the dual, which anybody can check. From it and the goal the judge
//! builds a quadric. The body that is emptied where the quadric is positive is the least of all
//! along it. So one integral over the inside decides (see [`crate::guide::theory`]). The judge
//! takes it by its own rule, over the model as it was written, and knows nothing of a solver.

mod core;
mod ground;
mod question;
mod range;
#[cfg(test)]
mod tests;

use self::core::Core;
use self::ground::Ground;
use self::question::{Question, base};
use super::limits::{BOUND_LIMIT_RATIO, BOUND_SCALE_DEG, BOUND_SCALE_MM};
use super::{BoundProof, Check, CheckKind, Evidence, FigureName, Limit, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::mass::moments_of_mesh;
use crate::verify::body::Body;

/// Cells along the longest side: inside, and where the wall begins. Twice as many change the bound
/// by less than a thousandth.
const LEVELS: [u32; 2] = [6, 8];
/// The same for the estimate of the error.
const COARSE_LEVELS: [u32; 2] = [5, 7];

/// The bound as the judge finds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundFacts {
    /// The value that no hollowing can beat, in the figure's unit; `None` if the proof proves none.
    pub value: Option<f64>,
    /// The change of the value with cells of twice the size.
    pub error: f64,
}

/// Proves the bound of a kit again; `None` if it promises none.
pub(super) fn measure_bound(
    evidence: &Evidence,
    body: &Body,
    watch: &Watch,
) -> Result<Option<BoundFacts>, Cancelled> {
    let promise = &evidence.promise;
    let Some((figure, proof)) = claim(evidence) else {
        return Ok(None);
    };
    let setting = Setting::new(promise, &body.outer);
    let frame = setting.aim.frame();
    let solid = moments_of_mesh(&body.outer) + setting.hardware * setting.density_g_mm3().recip();
    let ground = Ground::new(&setting, figure, &solid.in_frame(&frame));
    let mut values = Vec::with_capacity(2);
    for levels in [LEVELS, COARSE_LEVELS] {
        watch.check()?;
        let core = Core::of(&body.outside, proof, &frame, levels);
        let question = Question {
            ground: &ground,
            core: &core,
            proof,
        };
        values.push(bound(&question));
    }
    Ok(Some(BoundFacts {
        value: values[0],
        error: values[0]
            .zip(values[1])
            .map_or(f64::NAN, |(fine, coarse)| (fine - coarse).abs()),
    }))
}

/// Returns the value that no hollowing can beat, in the figure's unit; `None` if the proof proves
/// nothing.
fn bound(question: &Question) -> Option<f64> {
    let (ground, proof) = (question.ground, question.proof);
    let ratio = match proof.points.as_slice() {
        [point] if point.height_mm.is_none() => {
            let form = ground.form(proof, 0.0)?;
            question.ratio(&base(&form, point)?, &form.denominator)?
        }
        _ => range::bound(question)?,
    };
    ground.figure_of(ratio)
}

fn claim(evidence: &Evidence) -> Option<(FigureName, &BoundProof)> {
    let certificate = evidence.promise.certificate.as_ref()?;
    certificate
        .proof
        .as_ref()
        .map(|proof| (certificate.figure, proof))
}

/// Checks that no hollowing can be better than the certificate says.
pub(super) fn bound_check(evidence: &Evidence, found: Option<BoundFacts>) -> Option<Check> {
    let (figure, proof) = claim(evidence)?;
    let scale = match figure {
        FigureName::TopplesDeg => BOUND_SCALE_DEG,
        FigureName::MetacentricHeightMm | FigureName::CenterHeightMm => BOUND_SCALE_MM,
        _ => 0.0,
    };
    let sense = if figure.more_is_better() { 1.0 } else { -1.0 };
    let excess = |value: f64| sense * (value - proof.bound) / proof.bound.abs().max(scale);
    let value = found.and_then(|facts| facts.value);
    let words = "the best of all hollowings with its wall beats the certificate by a share of";
    let limit = Limit::at_most(BOUND_LIMIT_RATIO, "");
    let detail = found.and_then(|facts| {
        let unit = figure.unit();
        facts
            .value
            .map(|value| format!("its own proof: {value:.4} ± {:.1e} {unit}", facts.error))
    });
    let share = value.map(|value| excess(value).max(0.0));
    Some(Check::new(CheckKind::Bound, words, share, limit).at(detail))
}
