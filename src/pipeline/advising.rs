//! What a run asks of the advice: the axis where it was left open, and remedies where its goal is impossible.

use super::{Impossible, Setup, phase, setup::Model};
use crate::advice::{Case, Remedy, best_orientation, remedies};
use crate::goal::{GoalKind, Request, Up};
use crate::printer::{Material, Printer, WallChoice};
use crate::progress::Progress;

/// What to do where hardware is in the way: the remedies are sought on models as they are.
const BARE: &str = "leave the hardware out, to be told by how much the model as it is can or cannot";

/// What a case is made of besides the request.
#[derive(Debug, Clone, Copy)]
pub struct Means<'a> {
    /// The model.
    pub model: &'a Model,
    /// The printer.
    pub printer: &'a Printer,
    /// What it prints.
    pub material: &'a Material,
    /// The wall that is printed.
    pub wall: &'a WallChoice,
}

impl<'a> Means<'a> {
    fn case(self, request: Request) -> Case<'a> {
        Case {
            solid: &self.model.solid,
            request,
            wall_mm: self.wall.wall_mm,
            least_wall_mm: self.printer.min_wall_mm.value,
            wall_step_mm: self.wall.step_mm,
            density_g_cm3: self.material.density_g_cm3.value,
            greatest_size_mm: self.printer.greatest_length_mm(),
        }
    }

    /// A request with its axis settled, and the sentence on how it was, if it had been left open.
    pub fn settled(self, request: &Request) -> (Request, Option<String>) {
        if request.up != Up::Auto {
            return (*request, None);
        }
        if let Some(best) = best_orientation(&self.case(*request)) {
            let choice = format!(
                "--up={} was chosen: of {} axes tried {} allow it; on this one, the best near any of them, it {}",
                best.request.up, best.tried, best.possible, best.reached
            );
            return (best.request, Some(choice));
        }
        let up = if request.kind == GoalKind::Stand { Up::Z } else { Up::Principal };
        let choice = format!("no axis that was tried allows it; this is for --up={up}");
        (Request { up, ..*request }, Some(choice))
    }
}

/// The answer that the goal is impossible, with what would help.
pub fn advised(setup: &Setup, impossible: Impossible, progress: &Progress) -> Impossible {
    if setup.job.fill.is_some() {
        // The searches know of air only.
        return impossible;
    }
    progress.report(phase::ADVISE, 0.0);
    if setup.fitted.is_some() {
        let hints = impossible.hints.into_iter().chain([BARE.to_owned()]).collect();
        return Impossible { hints, ..impossible };
    }
    let Setup { model, printer, material, wall, .. } = setup;
    let remedies = remedies(&Means { model, printer, material, wall }.case(setup.request));
    let hints = if remedies.iter().any(Remedy::helps) { Vec::new() } else { impossible.hints };
    Impossible { remedies, hints, ..impossible }
}
