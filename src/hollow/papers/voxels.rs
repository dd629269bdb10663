//! The voxel method that Wu, Kramer and Westermann compare with: a share of every voxel.

use super::lagrangian::{Accuracy, Effort, Start, minimise};
use super::measure::measure;
use super::method::{Found, Method, MethodError};
use super::target::Target;
use crate::base::watch::Watch;
use crate::hollow::Problem;
use crate::interior::{Choice, Voxels};

/// One number between 0 and 1 per voxel ([`Voxels`]), which is as high as a column is wide.
///
/// Nothing is rounded: voxels cut by the void's surface keep their shares.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByVoxels {
    /// Accuracy and cost limits.
    pub accuracy: Accuracy,
}

impl Method for ByVoxels {
    fn name(&self) -> &'static str {
        "voxels"
    }

    fn find(&self, problem: &Problem, watch: &Watch) -> Result<Found, MethodError> {
        let height_mm = problem.columns.pitch_mm[0].max(problem.columns.pitch_mm[1]);
        let effort = Effort {
            accuracy: &self.accuracy,
            watch,
        };
        let (target, voxels) = (
            Target::new(self.name(), problem)?,
            Voxels::of(problem.columns, height_mm),
        );
        let start = Start::from(voxels.nothing());
        let optimum = minimise(&target, &voxels, start, effort);
        Ok(measure(problem, &target, &voxels, &optimum))
    }
}
