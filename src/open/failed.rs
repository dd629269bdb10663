//! Bosses that could not be had: what is tried no more, what only costs too much, and why.

use crate::cut::{Boss, JointName};
use crate::run::{Refusal, Remark};

/// The record of refused bosses.
#[derive(Clone, Default)]
pub struct Failed {
    /// The joints of refused patterns, once for each pattern.
    patterns: Vec<JointName>,
    /// The last refusal of each joint that has no bosses.
    reasons: Vec<(JointName, Refusal)>,
    /// Refused bosses that only cost too much, with their loss.
    dear: Vec<(f64, Vec<Boss>)>,
    /// The joints for which no more patterns are tried.
    pub given_up: Vec<JointName>,
    /// The places of refused bosses, mm.
    pub places: Vec<[f64; 3]>,
}

impl Failed {
    /// Records a joint's refused pattern. After `patterns` of them the joint is given up.
    pub fn add(&mut self, bosses: &[Boss], refusal: Refusal, patterns: usize) {
        let name = bosses[0].joint();
        self.patterns.push(name.clone());
        let centers = bosses.iter().map(|boss| boss.pin.center_mm);
        self.places.extend(centers);
        let tried = self.patterns.iter().filter(|joint| **joint == name);
        if tried.count() >= patterns {
            self.given_up.push(name.clone());
        }
        let loss_ratio = refusal.loss_ratio();
        self.dear
            .extend(loss_ratio.map(|loss| (loss, bosses.to_vec())));
        self.explain(name, refusal);
    }

    /// Records why the last pattern of a joint was refused.
    pub fn explain(&mut self, name: JointName, refusal: Refusal) {
        self.reasons.retain(|(other, _)| *other != name);
        self.reasons.push((name, refusal));
    }

    /// Forgets the refusals of a joint that got its bosses after all.
    pub fn forget(&mut self, name: &JointName) {
        self.reasons.retain(|(other, _)| other != name);
        self.dear.retain(|(_, bosses)| bosses[0].joint() != *name);
    }

    /// Returns, for every joint without bosses, those that only cost too much and cost least.
    pub fn dear_ones(&self) -> Vec<Vec<Boss>> {
        let of_joint = |(name, _): &(JointName, Refusal)| {
            let is_own = |(_, bosses): &&(f64, Vec<Boss>)| bosses[0].joint() == *name;
            let own = self.dear.iter().filter(is_own);
            let cheapest = own.min_by(|a, b| a.0.total_cmp(&b.0));
            cheapest.map(|(_, bosses)| bosses.clone())
        };
        self.reasons.iter().filter_map(of_joint).collect()
    }

    /// Returns a remark for every joint that got no bosses.
    pub fn remarks(&self) -> Vec<Remark> {
        let remark = |(name, why): &(JointName, Refusal)| Remark::NoBosses {
            parts: name.parts,
            why: *why,
        };
        self.reasons.iter().map(remark).collect()
    }
}

#[cfg(test)]
mod tests;
