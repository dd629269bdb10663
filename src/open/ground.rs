//! The voids that a rung of the ladder starts from.

use super::clean::without_ends;
use super::resolve::Resolver;
use crate::cut::{CutPlan, SolidEnd};
use crate::error::Error;
use crate::run::{CleaningRound, KeptCause, Voids};

/// The voids that a rung starts from.
#[derive(Clone)]
pub struct Ground<'a> {
    pub resolver: Resolver<'a>,
    pub voids: Voids,
    /// A draft for the voids, whose cuts are held.
    pub draft: Option<CutPlan>,
    /// The parts of the interior that are kept solid.
    pub solid: Vec<SolidEnd>,
    /// The rounds in which that was done.
    pub rounds: Vec<CleaningRound>,
}

impl Ground<'_> {
    /// Keeps more parts of the interior solid; `None` if nothing lies there or the goal is lost.
    pub fn without(&self, solid: &[SolidEnd], cause: &KeptCause) -> Result<Option<Self>, Error> {
        let mut resolver = self.resolver.clone();
        let less = without_ends(&mut resolver, &self.voids, solid, cause)?;
        Ok(less.map(|(round, voids)| Self {
            resolver,
            voids,
            draft: None,
            solid: [&self.solid, solid].concat(),
            rounds: self.rounds.iter().cloned().chain([round]).collect(),
        }))
    }
}
