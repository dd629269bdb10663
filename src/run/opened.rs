//! Voids with the cuts that open them, and the rounds that led there.

use super::{KeptCause, Remark, Rung};
use crate::cut::{CutPlan, Hollowed, PartId, PinSite, PlanRequest, VoidId};
use crate::geom::Point;
use crate::hollow::{Certificate, Figure, Solution};
use crate::mass::Moments;
use crate::mesh::TriMesh;

/// The voids of a solution.
#[derive(Debug, Clone)]
pub struct Voids {
    /// The solution that they were made from.
    pub solution: Solution,
    /// Moments without any void that the solution was found with, goal frame.
    pub fixed: Moments,
    /// The body with its voids.
    pub hollowed: Hollowed,
    /// The regions of infill inside of the voids of a print in one piece, the outermost first;
    /// model frame. Those of other prints have none.
    pub inner: Vec<TriMesh>,
    /// The cells that the voids are made of; none in other prints.
    pub cells: DrawnCells,
    /// Volume of voids that cannot be cleaned and stay solid, mm³.
    pub refused_mm3: f64,
    /// Number of times that it was solved again.
    pub rounds: usize,
}

/// The cells that voids are made of.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DrawnCells {
    /// A place inside of each cell, model frame, mm.
    pub places: Vec<Point>,
    /// The ends of the axis of each opening between two of them, model frame, mm.
    pub doors: Vec<[Point; 2]>,
}

/// The figure that voids reach, and their volume.
#[derive(Debug, Clone, Copy)]
pub struct Achieved {
    /// The certificate of their solution.
    pub certificate: Certificate,
    /// Volume of all voids, mm³.
    pub voids_mm3: f64,
}

impl Achieved {
    /// Measures voids.
    pub fn of(voids: &Voids) -> Self {
        let bodies = voids.hollowed.voids.iter();
        Self {
            certificate: voids.solution.certificate,
            voids_mm3: bodies.map(|void| void.mesh().signed_volume_mm3()).sum(),
        }
    }

    /// Returns the share of itself by which the goal's figure is worse in `after`; negative if it
    /// is better. A rotor that falls from full balance to its grade loses all of it: 1. The other
    /// way round it gains all of it: −1.
    pub fn loss_ratio(&self, after: &Self) -> f64 {
        let is_graded = |of: &Self| of.certificate.figure == Figure::BalanceGradeMmS;
        match (is_graded(self), is_graded(after)) {
            (false, true) => return 1.0,
            (true, false) => return -1.0,
            _ => {}
        }
        let cost = |of: &Self| of.certificate.figure.cost(of.certificate.value);
        (cost(after) - cost(self)) / cost(self).abs().max(f64::MIN_POSITIVE)
    }

    /// Returns the share of the voids' volume that is solid in `after`.
    pub fn filled_ratio(&self, after: &Self) -> f64 {
        1.0 - after.voids_mm3 / self.voids_mm3.max(f64::MIN_POSITIVE)
    }
}

/// Voids with the plan that opens them.
#[derive(Debug, Clone)]
pub struct Opened {
    /// The voids.
    pub voids: Voids,
    /// The cuts and pins.
    pub plan: CutPlan,
    /// The request that the plan answers.
    pub request: PlanRequest,
    /// The rung of the ladder that gave the plan.
    pub rung: Rung,
    /// Notes for the job sheet.
    pub remarks: Vec<Remark>,
    /// Rounds in which something was kept solid so that voids can be cleaned or joints have pins.
    pub cleaning: Vec<CleaningRound>,
    /// Rounds in which bosses were kept solid around pins.
    pub bosses: Vec<BossRound>,
}

/// A round in which parts of voids were kept solid, and its price.
#[derive(Debug, Clone, PartialEq)]
pub struct CleaningRound {
    /// The voids that it touched, and why.
    pub kept: Vec<KeptSolid>,
    /// Volume that was kept solid, without the margin around it, mm³.
    pub volume_mm3: f64,
    /// Figure of the certificate before the round.
    pub value_before: f64,
    /// Figure after it; `None` if the goal could not be met any more and the round was undone.
    pub value_after: Option<f64>,
    /// True if the plan asks for it, not cleaning.
    pub by_plan: bool,
}

/// A void of which something is kept solid.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptSolid {
    /// The void, as it was counted before the round.
    pub void: VoidId,
    /// The reason.
    pub cause: KeptCause,
}

/// A round in which bosses were kept solid.
#[derive(Debug, Clone, PartialEq)]
pub struct BossRound {
    /// The bosses that were added.
    pub bosses: Vec<KeptBoss>,
    /// Volume of all bosses so far that could have been emptied, mm³.
    pub kept_mm3: f64,
    /// The certificate before they were kept solid.
    pub before: Certificate,
    /// The certificate with them.
    pub after: Certificate,
}

/// A pin that got a boss.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptBoss {
    /// The pin, with the id that it has in the plan.
    pub pin: PinSite,
    /// The parts that it joins.
    pub parts: [PartId; 2],
    /// Volume of the whole boss, with the wall that it stands in, mm³.
    pub volume_mm3: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reached(figure: Figure, value: f64) -> Achieved {
        let certificate = Certificate {
            figure,
            value,
            bound: value,
            gap_ratio: 0.0,
            residual: 0.0,
            bound_over_heights: None,
        };
        Achieved {
            certificate,
            voids_mm3: 1000.0,
        }
    }

    #[test]
    fn a_loss_is_a_share_of_the_figure_whichever_way_is_better() {
        let rpm = |value| reached(Figure::CriticalSpeedRpm, value);
        assert!((rpm(400.0).loss_ratio(&rpm(420.0)) - 0.05).abs() < 1e-12);
        let angle = |value| reached(Figure::TopplingAngleRad, value);
        assert!((angle(0.5).loss_ratio(&angle(0.4)) - 0.2).abs() < 1e-12);
        assert!(angle(0.4).loss_ratio(&angle(0.5)) < 0.0);
    }

    #[test]
    fn a_rotor_that_falls_from_full_balance_to_its_grade_loses_all() {
        let full = reached(Figure::VolumeMm3, 9000.0);
        let graded = reached(Figure::BalanceGradeMmS, 0.4);
        assert_eq!(full.loss_ratio(&graded), 1.0);
        assert_eq!(graded.loss_ratio(&full), -1.0);
    }

    #[test]
    fn what_is_filled_is_a_share_of_the_voids_before() {
        let before = reached(Figure::CriticalSpeedRpm, 400.0);
        let after = Achieved {
            voids_mm3: 250.0,
            ..before
        };
        assert_eq!(before.filled_ratio(&after), 0.75);
    }
}
