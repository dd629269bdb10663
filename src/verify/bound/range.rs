//! The proof for a top: at every height of its centre no hollowing is better.
//!
//! The tensor about the centre is linear in the moments only where the height of the centre is
//! known. It is made linear at a height ℓ. If the centre of a body is at h, its true numerator is
//! smaller by κ s₁ (h − ℓ)². So a point at ℓ with a margin of δ s₁ over a ratio proves the ratio
//! for all h within √(δ/κ) of ℓ. The points of a proof reach from the least height to the greatest.

use rayon::prelude::*;

use super::ground::{height_form, mass};
use super::question::{Base, Question, base, minus};
use crate::verify::{BoundPoint, BoundProof};

/// Height below which a top needs no spin, as a part of the greatest height.
const LEAST_HEIGHT_RATIO: f64 = 1e-4;
/// First step down from the ratio that the points allow, as a part of it, and the growth of steps.
const FIRST_STEP: f64 = 1e-3;
const STEP_GROWTH: f64 = 4.0;
/// Largest step down: a proof that loses half of its ratio proves nothing.
const LARGEST_STEP: f64 = 0.5;
/// Halvings of the last step: what is left of it is a sixteenth.
const HALVINGS: usize = 4;

/// A point of the proof at its height.
struct Post {
    at_mm: f64,
    base: Base,
    denominator: [f64; 10],
    bend: f64,
}

/// Returns the greatest ratio that the points prove at all heights; `None` if there is none.
pub(super) fn bound(question: &Question) -> Option<f64> {
    let proof = question.proof;
    let [low, high] = heights(question, proof)?;
    let posts = proof.points.iter().map(|point| post(question, point));
    let posts: Vec<Post> = posts.collect::<Option<_>>()?;
    let ratios = posts
        .par_iter()
        .map(|post| question.ratio(&post.base, &post.denominator));
    let ratios: Vec<f64> = ratios.collect::<Option<_>>()?;
    let most = ratios.into_iter().fold(f64::INFINITY, f64::min);
    let covers = |ratio: f64| covers(question, &posts, ratio, [low, high]);
    let mut step = FIRST_STEP;
    while !covers(most - step * most.abs()) {
        step *= STEP_GROWTH;
        if step > LARGEST_STEP {
            return None;
        }
    }
    let (mut good, mut bad) = (
        step,
        if step == FIRST_STEP {
            0.0
        } else {
            step / STEP_GROWTH
        },
    );
    for _ in 0..HALVINGS {
        let middle = 0.5 * (good + bad);
        if covers(most - middle * most.abs()) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    Some(most - good * most.abs())
}

/// Returns the least and the greatest height of the centre of any hollowing that spins true, mm.
fn heights(question: &Question, proof: &BoundProof) -> Option<[f64; 2]> {
    let [lowest, highest] = proof.ends.as_ref()?;
    let end = |sense: f64, multipliers: &[f64]| {
        let form = height_form(sense);
        let point = BoundPoint {
            height_mm: None,
            weights: Vec::new(),
            multipliers: multipliers.to_vec(),
        };
        let base = base(&form, &point)?;
        question
            .ratio(&base, &form.denominator)
            .map(|height| sense * height)
    };
    let (low, high) = (end(1.0, lowest)?, end(-1.0, highest)?);
    Some([low.max(LEAST_HEIGHT_RATIO * high), high])
}

fn post(question: &Question, point: &BoundPoint) -> Option<Post> {
    let at_mm = point.height_mm?;
    let form = question.ground.form(question.proof, at_mm)?;
    Some(Post {
        at_mm,
        base: base(&form, point)?,
        denominator: form.denominator,
        bend: question.ground.bend(&point.weights),
    })
}

/// Returns true if the points prove a ratio at all heights between two.
fn covers(question: &Question, posts: &[Post], ratio: f64, [low, high]: [f64; 2]) -> bool {
    let reaches = posts.par_iter().map(|post| {
        let base = Base {
            quadric: minus(&post.base.quadric, &post.denominator, ratio),
            ..post.base
        };
        let margin = question
            .ratio(&base, &mass())
            .filter(|margin| *margin > 0.0)?;
        let reach_mm = if post.bend > 0.0 {
            (margin / post.bend).sqrt()
        } else {
            f64::INFINITY
        };
        Some([post.at_mm - reach_mm, post.at_mm + reach_mm])
    });
    let mut reaches: Vec<[f64; 2]> = reaches.collect::<Vec<_>>().into_iter().flatten().collect();
    reaches.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut proved = low;
    for [from, to] in reaches {
        if from > proved {
            break;
        }
        proved = proved.max(to);
    }
    proved >= high
}
