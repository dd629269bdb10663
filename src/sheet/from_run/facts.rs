//! The facts that a checklist is filled from.

use crate::run::{Made, Placed};
use crate::verify::{Judgement, PromisedFigure};

/// Everything that a checklist is filled from.
pub struct Facts<'a> {
    /// The goal in its model, on its printer.
    pub placed: &'a Placed,
    /// The parts that were made.
    pub made: &'a Made,
    /// The findings of the judge.
    pub judgement: &'a Judgement,
    /// The figure that the buyer is promised.
    pub promised: Option<PromisedFigure>,
}
