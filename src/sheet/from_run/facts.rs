//! The facts from which a checklist is filled.

use crate::run::{Made, Placed};
use crate::verify::{Judgement, PromisedFigure, PromisedPlate};

/// The facts from which a checklist is filled.
pub struct Facts<'a> {
    /// Goal in its model, on its printer.
    pub placed: &'a Placed,
    /// Parts that were made.
    pub made: &'a Made,
    /// Findings of the judge.
    pub judgement: &'a Judgement,
    /// Figure that the buyer is promised.
    pub promised: Option<PromisedFigure>,
    /// Plates, and what lies where on them.
    pub plates: &'a [PromisedPlate],
}
