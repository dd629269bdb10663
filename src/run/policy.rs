//! The policy of the search for cuts and pins: every ratio and limit in one place.
//!
//! `tests/policy` holds the models, by file and SHA-256, that set the ratios, and runs them again.

use std::fmt;

use crate::cut::PlanRequest;
use crate::job::Effort;

/// A rung of the ladder to a plan in which every joint has its pins.
///
/// Each rung gives up more material than the one before, or searches elsewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Rung {
    /// Pins stand where the walls have room for them.
    Walls,
    /// Material is kept solid around pins, where it costs little.
    Bosses,
    /// Cuts run wherever their joints have room for pins, though their seams are seen.
    SeenSeams,
    /// Seams are hidden, and walls are out of sight that may hold no support.
    UnseenWalls,
    /// No cut is made for cleaning alone; hidden ends of voids stay solid.
    FewerCuts,
    /// Cuts pass through the widest places.
    WideJoints,
    /// Bosses may cost most of the goal's figure.
    DearBosses,
    /// Bosses may cost a part of the figure, though some joint stays without.
    SomeBosses,
    /// Voids end before the joints that have no room for pins.
    SolidEnds,
}

impl Rung {
    /// The rungs beyond the usual plan, in the order in which they are tried.
    pub const BEYOND_USUAL: [Self; 5] = [
        Self::FewerCuts,
        Self::WideJoints,
        Self::DearBosses,
        Self::SomeBosses,
        Self::SolidEnds,
    ];
}

impl fmt::Display for Rung {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Walls => "pins in the walls",
            Self::Bosses => "bosses",
            Self::SeenSeams => "cuts where their seams are seen",
            Self::UnseenWalls => "hidden seams, with walls out of sight that hold no support",
            Self::FewerCuts => "fewer cuts for cleaning alone",
            Self::WideJoints => "cuts through wider places",
            Self::DearBosses | Self::SomeBosses => "dear bosses",
            Self::SolidEnds => "voids solid beyond joints without room",
        })
    }
}

/// The ratios and limits of the search.
///
/// A "loss" is the share by which the goal's figure becomes worse, a margin is in minimum openings
/// of the printer.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Policy {
    /// Greatest loss for bosses while other places for them are left to try.
    pub cheap_loss_ratio: f64,
    /// Greatest loss for pins if some joint stays without them.
    pub partial_loss_ratio: f64,
    /// Greatest loss for pins in every joint. Beyond it a jig holds the joint, which costs nothing.
    pub dear_loss_ratio: f64,
    /// Greatest loss for pins that a person ordered. Beyond it the kit has lost what it was made
    /// for.
    pub ordered_loss_ratio: f64,
    /// True if a jig that holds a joint comes before dearer bosses and other cuts. It costs nothing
    /// of the figure, and the search for those takes minutes.
    pub jigs_first: bool,
    /// Least distance of a joint's farthest pins, as a share of the joint's longest diagonal.
    pub pin_spread_ratio: f64,
    /// Greatest share of the voids that may become solid for pins. Some figures hardly tell: a
    /// toppling angle barely changes when all voids are lost.
    pub max_void_loss_ratio: f64,
    /// Loss of the goal's figure up to which a plan is built as if a person had ordered it. The
    /// plan in the kit then makes the same kit again.
    pub replay_loss_ratio: f64,
    /// Margin around void ends that are kept solid beyond joints.
    pub ends_margin_openings: f64,
    /// Times that void ends are given up beyond joints: the cuts that follow may lack pins, too.
    pub max_ends: usize,
    /// Factor on the least opening in plans that are solved again afterwards: solving again for
    /// pins narrows openings.
    pub spare_opening_ratio: f64,
    /// Rounds in which bosses are searched. Solving again moves voids, which may take the room of
    /// other pins.
    pub boss_rounds: usize,
    /// Patterns of bosses that are tried at a joint, each away from those that cost too much.
    pub boss_patterns: usize,
    /// Times that more is kept solid for the sake of the same bosses.
    pub settle_rounds: usize,
    /// Margin around voids' ends that bosses close or hide: next to nothing of a clean void.
    pub settle_margin_openings: f64,
    /// Rounds of cleaning in all; in the last ones whole voids stay solid, so that it ends.
    pub cleaning_rounds: usize,
    /// Rounds of cleaning in which only the hidden ends of voids stay solid.
    pub shrinking_rounds: usize,
    /// Margin around hidden ends of voids. More costs voids that could be cleaned, less takes more
    /// rounds.
    pub cleaning_margin_openings: f64,
    /// Margin around voids that are refused whole: what lies nearer could hardly be cleaned.
    pub refused_margin_openings: f64,
    /// Share of the model's volume below which a refused void may come back. At 50 mm from the axis
    /// it moves the centre of mass by 0.1 µm.
    pub significant_void_ratio: f64,
    /// Share of all walls that a cut for cleaning alone must bring into sight. Below it joints and
    /// crumbs are made for nothing.
    pub cut_worth_ratio: f64,
    /// Price of a plan's seams above which a plan with hidden ones is sought, in circles about the
    /// model of average weight.
    pub dear_seam_ratio: f64,
    /// Weight of walls without sight, against scores of seams, in the first plan with hidden ones.
    pub lack_weight: f64,
    /// Factor on that weight from one such plan to the next.
    pub lack_growth: f64,
    /// Number of plans with hidden seams that are tried.
    pub hidden_rounds: usize,
    /// Number of times that plans are sought which keep clear of the spot that shows most.
    pub clear_rounds: usize,
    /// Price of losing all of the figure, against that of seams, in circles of average weight.
    pub loss_price: f64,
    /// Least gain in the price of seams, in circles of average weight, for a plan with walls out of
    /// sight. It is made first, and kept if these walls hold no support.
    pub unseen_gain: f64,
    /// Greatest loss for a plan whose seams are seen less.
    pub seam_loss_ratio: f64,
    /// Greatest loss for a plan with fewer parts that is taken unasked.
    pub part_loss_ratio: f64,
    /// Greatest loss for a plan with fewer parts that is offered beside another.
    pub offered_loss_ratio: f64,
    /// Greatest loss for a plan with fewer parts, or whose seams are seen, in place of another.
    /// All its joints are aligned, and those of the other are not.
    pub aligned_loss_ratio: f64,
    /// Times that parts are made. The first are right but for the rounding of their files, unless
    /// the plan had to change.
    pub max_assemblies: usize,
    /// Rounds of measuring and solving again in one go. Each leaves about a hundredth of the
    /// defect before it.
    pub correction_rounds: usize,
}

impl Policy {
    /// Returns the policy of a run whose joints may cost this share of the goal's figure; the usual
    /// share if `None`.
    pub fn with_joint_price(ratio: Option<f64>) -> Self {
        let usual = Self::STANDARD;
        let ratio = ratio.unwrap_or(usual.dear_loss_ratio);
        Self {
            cheap_loss_ratio: usual.cheap_loss_ratio.min(ratio),
            partial_loss_ratio: ratio,
            dear_loss_ratio: ratio,
            ..usual
        }
    }

    /// Returns the policy of a search with this effort. A thorough one compares more seams and more
    /// places for bosses.
    pub fn with_effort(self, effort: Effort) -> Self {
        let [hidden_rounds, boss_patterns] = match effort {
            Effort::Quick | Effort::Normal => [self.hidden_rounds, self.boss_patterns],
            Effort::Thorough => [2 * self.hidden_rounds, 3 * self.boss_patterns],
        };
        Self {
            hidden_rounds,
            boss_patterns,
            ..self
        }
    }

    /// Returns the cost of a plan whose seams are seen less: the price of its seams, and of its
    /// loss of the goal's figure. It is worth taking if it is below the price of the usual seams.
    pub fn hidden_cost(&self, seam_price: f64, loss_ratio: f64) -> f64 {
        seam_price + self.loss_price * loss_ratio
    }

    /// The policy of every run.
    pub const STANDARD: Self = Self {
        cheap_loss_ratio: 0.1,
        partial_loss_ratio: 0.15,
        dear_loss_ratio: 0.15,
        ordered_loss_ratio: 0.65,
        jigs_first: true,
        pin_spread_ratio: PlanRequest::SPREAD_RATIO,
        max_void_loss_ratio: 0.5,
        replay_loss_ratio: 0.002,
        ends_margin_openings: 0.25,
        max_ends: 3,
        spare_opening_ratio: 1.03,
        boss_rounds: 1,
        boss_patterns: 1,
        settle_rounds: 4,
        settle_margin_openings: 0.25,
        cleaning_rounds: 8,
        shrinking_rounds: 4,
        cleaning_margin_openings: 0.5,
        refused_margin_openings: 2.0,
        significant_void_ratio: 2e-6,
        cut_worth_ratio: PlanRequest::WORTH_RATIO,
        dear_seam_ratio: 0.12,
        lack_weight: 4.0,
        lack_growth: 2.0,
        hidden_rounds: 5,
        clear_rounds: 1,
        loss_price: 0.5,
        unseen_gain: 0.25,
        seam_loss_ratio: 0.1,
        part_loss_ratio: 0.02,
        offered_loss_ratio: 0.5,
        aligned_loss_ratio: 0.3,
        max_assemblies: 3,
        correction_rounds: 8,
    };
}

impl Default for Policy {
    fn default() -> Self {
        Self::STANDARD
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_through_a_face_gives_way_to_one_at_the_waist_and_a_hidden_one_stays() {
        // A mouth on a figure of 100 mm costs 1.05 circles; a waist costs 0.39, and 7.5 % of the
        // figure.
        let policy = Policy::STANDARD;
        assert!(policy.hidden_cost(0.39, 0.075) < 1.05);
        assert!(policy.hidden_cost(0.39, policy.seam_loss_ratio) < 1.05);
        // A seam in a neck is hardly seen: nothing is lost for a better one.
        assert!(policy.hidden_cost(0.10, policy.seam_loss_ratio) > 0.12);
    }
}
