//! The posts of a proof over heights, and their check on all columns.

use crate::hollow::dual::programme::{DualPoint, Programme};
use crate::hollow::dual::units::Vector10;
use crate::hollow::dual::work::Work;

/// A dual point at ℓ that proves the claim for all heights within its reach.
#[derive(Debug, Clone)]
pub(crate) struct Post {
    pub at: f64,
    /// Margin δ.
    pub margin: f64,
    /// Distance up to which the required share of the margin is left.
    pub reach: f64,
    pub point: DualPoint,
    /// Inequality it rests on.
    pub stake: Stake,
}

/// A linear inequality for every interior: g·s ≥ least. One extreme point of K decides it.
#[derive(Debug, Clone)]
pub(crate) struct Stake {
    /// Direction g.
    pub direction: Vector10,
    pub least: f64,
}

impl Stake {
    /// Returns the inequality D ≥ 0: no interior has a ratio below the τ of the dual point.
    pub fn of(programme: &Programme, point: &DualPoint) -> Self {
        Self {
            direction: programme.quadric(point),
            least: programme.rhs.dot(&point.lambda),
        }
    }
}

/// Checks a scout's posts on all columns and logs them; one cheaper pass each. Returns true if each
/// of them holds, and false if the run was stopped.
pub(crate) fn check_posts(work: &Work, posts: &[Post]) -> bool {
    let directions: Vec<_> = posts.iter().map(|post| post.stake.direction).collect();
    let Ok(extremes) = work.reach.least_of_each(&directions, work.watch) else {
        return false;
    };
    let spare = |(post, s): (&Post, &Vector10)| post.stake.direction.dot(s) - post.stake.least;
    let spares: Vec<f64> = posts.iter().zip(&extremes).map(spare).collect();
    posts
        .iter()
        .zip(&spares)
        .for_each(|(post, spare)| work.log_post(post.at, post.margin, *spare));
    spares.iter().all(|&spare| spare >= 0.0)
}
