//! One way to open the voids, gone through to its pins, and its rank among others.

use super::aligned::count_unaligned;
use super::bosses::Bossed;
use super::plan::are_clean;
use super::resolve::Resolver;
use crate::cut::{self, CutError, CutPlan, PlanRequest};
use crate::error::Error;
use crate::hollow::{Certificate, Figure};
use crate::run::{Achieved, CleaningRound, Opened, Placed, Policy, Remark, Rung, Voids};

/// Share by which the toppling angle of a draft must exceed the promised one, by our own judgement.
/// Pins and sockets take some of it, and the coarse copy differs a little from the body.
const ANGLE_MARGIN_RATIO: f64 = 0.02;

/// Returns the toppling angle of a proof, radians; `None` for other figures.
pub fn toppling_rad(proof: &Certificate) -> Option<f64> {
    (proof.figure == Figure::TopplingAngleRad).then_some(proof.value)
}

/// An opened body that is worth making, and the resolver that corrects it.
#[derive(Clone)]
pub struct Candidate<'a> {
    /// The voids, cuts and pins.
    pub opened: Opened,
    /// The resolver as the search left it.
    pub resolver: Resolver<'a>,
}

impl<'a> Candidate<'a> {
    /// Returns the plan for the same goal with other weights: those that a slicer lays. Its cuts
    /// and pins stay.
    #[must_use]
    pub fn weighing(mut self, placed: &'a Placed) -> Self {
        self.resolver.placed = placed;
        self
    }
}

/// The result of a rung.
#[derive(Clone)]
pub struct Way<'a> {
    /// The rung.
    pub rung: Rung,
    /// The resolver as the rung left it.
    pub resolver: Resolver<'a>,
    /// The request that the plan answers.
    pub request: PlanRequest,
    /// Rounds in which something was kept solid.
    pub cleaning: Vec<CleaningRound>,
    /// Voids and plan, with bosses.
    pub bossed: Bossed,
}

impl<'a> Way<'a> {
    /// Counts the joints without at least two pins that fit one way only, and those without any.
    pub fn lacking(&self) -> [usize; 2] {
        let joints = &self.bossed.plan.joints;
        let unaligned = joints.iter().filter(|joint| !joint.is_aligned());
        let without = joints.iter().filter(|joint| joint.pins.is_empty());
        [unaligned.count(), without.count()]
    }

    /// Returns whether every joint has its pins.
    pub fn is_full(&self) -> bool {
        self.lacking() == [0, 0]
    }

    /// Counts the joints that neither pins nor a jig align.
    pub fn count_unaligned(&self) -> Result<usize, CutError> {
        let Bossed { voids, plan, .. } = &self.bossed;
        count_unaligned(voids, plan, &self.request)
    }

    /// Returns the figure that its voids reach, and their volume.
    pub fn achieved(&self) -> Achieved {
        Achieved::of(&self.bossed.voids)
    }

    /// Returns the share of itself by which the goal's figure is worse than in another way.
    pub fn loss_ratio(&self, other: &Self) -> f64 {
        other.achieved().loss_ratio(&self.achieved())
    }

    /// Returns whether it keeps what the usual way keeps, at no more than pins may cost.
    pub fn is_worth(&self, usual: &Self, policy: &Policy) -> bool {
        let is_clean = |way: &Self| are_clean(&way.bossed.plan, &way.request);
        let max_loss_ratio = if self.is_full() {
            policy.dear_loss_ratio
        } else {
            policy.partial_loss_ratio
        };
        let filled_ratio = usual.achieved().filled_ratio(&self.achieved());
        self.bossed.voids.solution.is_usable()
            && self.keeps_angle_of(usual)
            && (is_clean(self) || !is_clean(usual))
            && self.loss_ratio(usual) <= max_loss_ratio
            && filled_ratio <= policy.max_void_loss_ratio
    }

    /// Returns the price of its seams with their slants, in circles about the model; 0 if nobody
    /// looked.
    pub fn seam_price(&self) -> Result<f64, Error> {
        seam_price(&self.bossed.voids, &self.bossed.plan, &self.request)
    }

    /// Returns whether its voids reach the angle that a standing object promises, with a margin.
    /// True for other goals.
    pub fn keeps_angle(&self) -> bool {
        let least_rad = self.promised_angle_rad() * (1.0 + ANGLE_MARGIN_RATIO);
        self.angle_rad().is_none_or(|angle| angle >= least_rad)
    }

    /// Returns whether it keeps the promised angle. True also if another way misses that or reaches
    /// no more.
    pub fn keeps_angle_of(&self, other: &Self) -> bool {
        let (Some(own_rad), Some(other_rad)) = (self.angle_rad(), other.angle_rad()) else {
            return true;
        };
        self.keeps_angle() || own_rad >= other_rad || other_rad < self.promised_angle_rad()
    }

    /// Returns the angle that a standing object promises, radians; 0 without one.
    pub fn promised_angle_rad(&self) -> f64 {
        let promised_deg = self.resolver.placed().request.promised_angle_deg();
        promised_deg.unwrap_or(0.0).to_radians()
    }

    /// Returns the toppling angle that its voids reach, radians; `None` for other goals.
    fn angle_rad(&self) -> Option<f64> {
        toppling_rad(&self.achieved().certificate)
    }

    /// Returns whether its seams are worth what they cost against the usual way: a little of the
    /// figure, and one more part at most.
    pub fn hides_worth(&self, usual: &Self, policy: &Policy) -> bool {
        let is_clean = |way: &Self| are_clean(&way.bossed.plan, &way.request);
        (is_clean(self) || !is_clean(usual)) && self.costs_little(usual, policy)
    }

    /// Returns whether it costs no more against the usual way than hidden seams may. That is a
    /// little of the figure, no promised angle, and one more part at most.
    pub fn costs_little(&self, usual: &Self, policy: &Policy) -> bool {
        let count = |way: &Self| way.bossed.plan.count_parts();
        self.bossed.voids.solution.is_usable()
            && self.keeps_angle_of(usual)
            && self.loss_ratio(usual) <= policy.seam_loss_ratio
            && count(self) <= count(usual) + 1
    }

    /// Returns whether it gives every joint its pins and is worth it.
    pub fn solves(&self, usual: &Self, policy: &Policy) -> bool {
        self.is_full() && self.is_worth(usual, policy)
    }

    /// Returns why this way was taken in place of the usual one, and its price.
    pub fn price(&self, usual: &Self) -> Remark {
        Remark::Pins {
            rung: self.rung,
            lacking: usual.lacking()[0],
            joints: usual.bossed.plan.joints.len(),
            loss_ratio: self.loss_ratio(usual),
        }
    }

    /// Returns the way as a plan to be made, with more remarks after those on its bosses.
    pub fn into_candidate(mut self, more: impl IntoIterator<Item = Remark>) -> Candidate<'a> {
        self.bossed.name_pins();
        let mut remarks = self.bossed.remarks();
        remarks.extend(more);
        let opened = Opened {
            voids: self.bossed.voids,
            plan: self.bossed.plan,
            request: self.request,
            rung: self.rung,
            remarks,
            cleaning: self.cleaning,
            bosses: self.bossed.rounds,
        };
        Candidate {
            opened,
            resolver: self.resolver,
        }
    }
}

/// Returns the price of a plan's seams with their slants, in circles about the model; 0 if nobody
/// looked. A seam across the sole of a foot is dear.
pub fn seam_price(voids: &Voids, plan: &CutPlan, request: &PlanRequest) -> Result<f64, Error> {
    let sparing = PlanRequest {
        seams: request.seams.sparing_feet(),
        ..request.clone()
    };
    bare_seam_price(voids, plan, &sparing)
}

/// Returns the same price with a seam across a sole priced as any other.
pub fn bare_seam_price(voids: &Voids, plan: &CutPlan, request: &PlanRequest) -> Result<f64, Error> {
    let seams = cut::seams(voids.hollowed.outer.mesh(), plan, request)?;
    let prices = seams
        .iter()
        .filter_map(|seam| Some(seam.seen_ratio? + seam.slant_price));
    Ok(prices.sum())
}

#[cfg(test)]
mod tests;
