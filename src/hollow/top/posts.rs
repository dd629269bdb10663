//! The posts of a proof over heights, and the passes over all columns that settle them.

use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::units::Vector10;
use crate::hollow::dual::work::Work;

/// A dual point at ℓ that speaks for all heights within its reach.
#[derive(Debug, Clone)]
pub(crate) struct Post {
    pub at: f64,
    /// δ
    pub margin: f64,
    /// How far from it the share of the margin is left.
    pub reach: f64,
    pub point: DualPoint,
    /// What it rests on.
    pub stake: Stake,
}

/// A linear inequality that every interior has to meet: g·s ≥ least. It is settled by one extreme
/// point of K.
#[derive(Debug, Clone)]
pub(crate) struct Stake {
    /// g
    pub direction: Vector10,
    pub least: f64,
}

impl Stake {
    /// That no interior has a ratio below τ, by the dual point with this τ: D ≥ 0.
    pub fn of(programme: &Programme, point: &DualPoint) -> Self {
        Self {
            direction: programme.quadric(point),
            least: programme.rhs.dot(&point.lambda),
        }
    }
}

/// Whether all columns bear the posts that a scout found; one cheaper pass each.
pub(crate) fn hold(work: &Work, posts: &[Post]) -> bool {
    let directions: Vec<_> = posts.iter().map(|post| post.stake.direction).collect();
    let extremes = work.reach.least_of_each(&directions);
    let spare = |(post, s): (&Post, &Vector10)| post.stake.direction.dot(s) - post.stake.least;
    let spares: Vec<f64> = posts.iter().zip(&extremes).map(spare).collect();
    posts
        .iter()
        .zip(&spares)
        .for_each(|(post, spare)| work.note_post(post.at, post.margin, *spare));
    spares.iter().all(|&spare| spare >= 0.0)
}
