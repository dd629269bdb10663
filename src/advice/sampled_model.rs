//! A model that is sampled once, so that requests can be tried at any wall, contact and axis.

use std::sync::Arc;

use super::case::Case;
use super::reached::Reached;
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::goal::{
    Footing, Hydrostatics, MeasuredSolid, Placement, PrintStock, Request, Warning, Waterline,
    place_measured, spins_on_lowest,
};
use crate::hollow::{Figure, Fill, Problem, Settings, Solution, solve, solve_on_model_columns};
use crate::interior::{Columns, Depths};
use crate::mass::RoundBar;
use crate::shell::{Keep, Shell};

/// The number of depth samples of a search. With a third of them its answers differ by some per
/// cent from the confirmed ones. Three times as many cost three times as much a trial, and the
/// confirming solve asks for no more.
pub(super) const FINE_SAMPLES: usize = 40_000;
/// The number of depth samples for a first trial of many axes.
pub(super) const COARSE_SAMPLES: usize = 8_000;
/// The columns a side of the confirming solve. A run proves impossibility on four times as many
/// columns. At 100 a side the two may disagree at the border of the possible. At 400 the advice on
/// a large mesh takes three times as long.
pub(super) const CONFIRMING_COLUMNS: usize = 200;

/// The number of waterlines that are tried if the waterline is free.
const WATERLINES: usize = 12;

/// The fastest speed of a top that is offered, rpm. Nobody throws a top faster, in our judgement.
/// Above it the moments are nearly equal, and the rounding of parts makes it wobble.
const MOST_SPEED_RPM: f64 = 6000.0;

/// A model with samples of its depths. Once its watch is stopped, no request can be placed.
pub(super) struct SampledModel<'a> {
    pub case: Case<'a>,
    pub watch: Watch,
    weighed: MeasuredSolid<'a>,
    depths: Arc<Depths>,
}

/// The solver's answer to a request.
#[derive(Debug, Clone)]
pub(super) struct Trial {
    pub placement: Placement,
    pub solution: Solution,
    /// The number of columns it was solved on.
    pub columns: usize,
}

impl Trial {
    /// Returns true if some interior meets the request.
    pub fn is_possible(&self) -> bool {
        self.solution.is_usable()
    }

    /// Returns true unless it is a standing object that topples sooner than is promised.
    pub fn stands_as_promised(&self, request: &Request) -> bool {
        let reached = Reached::of(&self.solution.certificate);
        let is_angle = reached.figure == Figure::TopplingAngleRad;
        let least_rad = request.promised_angle_deg().unwrap_or(0.0).to_radians();
        !is_angle || reached.value >= least_rad
    }

    /// Returns true unless it is a top that was promised to lean and has nothing to spin on.
    fn spins_as_promised(&self, request: &Request) -> bool {
        let is_promised = request.promised_lean_deg().is_some_and(|deg| deg > 0.0);
        let is_unheld =
            |warning: &Warning| matches!(warning, Warning::NoTip | Warning::ContactInAir { .. });
        !(is_promised && self.placement.warnings.iter().any(is_unheld))
    }

    /// Returns true unless it is a top that nobody throws fast enough.
    fn is_within_reach(&self) -> bool {
        let reached = Reached::of(&self.solution.certificate);
        reached.figure != Figure::CriticalSpeedRpm || reached.value <= MOST_SPEED_RPM
    }

    /// Returns true if the spin axis passes through the model above its contact. Advice never moves
    /// the axis off the model.
    pub fn meets_the_model(&self) -> bool {
        !self.placement.warnings.contains(&Warning::AxisMissesModel)
    }
}

impl<'a> SampledModel<'a> {
    pub fn new(case: Case<'a>, samples: usize, watch: &Watch) -> Self {
        Self {
            depths: Arc::new(Depths::of_solid(case.solid, samples)),
            weighed: MeasuredSolid::new(case.solid),
            case,
            watch: watch.muted(),
        }
    }

    /// Returns the same model with another request, without sampling it again.
    pub fn with_request(&self, request: Request) -> Self {
        Self {
            case: Case {
                request,
                ..self.case
            },
            watch: self.watch.clone(),
            weighed: self.weighed.clone(),
            depths: Arc::clone(&self.depths),
        }
    }

    /// Solves a request on the sampled depths, without its promises of lean and angle. Returns
    /// `None` if the request cannot be placed.
    pub fn trial(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        self.trial_as_promised(&request.unpromised(), wall_mm)
    }

    /// Solves a request on the sampled depths, with the tip that its promise needs. Returns `None`
    /// if the request cannot be placed.
    pub fn trial_as_promised(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        let placement = self.place(request, wall_mm)?;
        let columns = self.depths.columns(wall_mm, &placement.keeps);
        self.best_trial(&placement, &columns, Axes::Model)
    }

    /// Returns true if a request is possible on the sampled depths, and stands as is promised.
    pub fn allows(&self, request: &Request, wall_mm: f64) -> bool {
        self.trial(request, wall_mm)
            .is_some_and(|trial| trial.is_possible() && trial.stands_as_promised(request))
    }

    /// Solves a request on exact columns, independently of the samples, with its tip.
    ///
    /// Returns `None` if it is not possible there, or breaks its promise.
    pub fn confirm(&self, request: &Request, wall_mm: f64) -> Option<Trial> {
        let (placement, columns) = self.exact_columns(request, wall_mm, CONFIRMING_COLUMNS)?;
        let trial = self.best_trial(&placement, &columns, Axes::Goal)?;
        let keeps = trial.stands_as_promised(request)
            && trial.spins_as_promised(request)
            && trial.is_within_reach();
        (trial.is_possible() && keeps).then_some(trial)
    }

    /// Places a request and builds the exact columns of the region that may be emptied, this many
    /// along the longer side.
    pub fn exact_columns(
        &self,
        request: &Request,
        wall_mm: f64,
        columns_a_side: usize,
    ) -> Option<(Placement, Columns)> {
        let placement = self.place(request, wall_mm)?;
        let shell = Shell::new(
            self.case.solid,
            &placement.goal.frame,
            wall_mm,
            &placement.keeps,
        )
        .ok()?;
        let pitch_mm = shell.coarse_pitch(columns_a_side);
        let columns = Columns::of_shell(&shell, pitch_mm, &self.watch).ok()?;
        Some((placement, columns))
    }

    /// Places a request. Returns `None` if that fails, or if the run was stopped.
    pub fn place(&self, request: &Request, wall_mm: f64) -> Option<Placement> {
        self.watch.check().ok()?;
        let stock = PrintStock {
            wall_mm,
            density_g_cm3: self.case.density_g_cm3,
        };
        let placement = place_measured(&self.weighed, &stock, request).ok()?;
        Some(with_tip(placement, &stock))
    }

    /// Returns true if a top keeps its promise on the lowest point of the model.
    pub fn spins_on_lowest(&self, request: &Request) -> bool {
        spins_on_lowest(&self.weighed, self.case.wall_mm, request).unwrap_or(false)
    }

    /// Returns the placement itself or, for a free waterline, the placement at several lines over
    /// its height.
    pub fn at_waterlines(&self, placement: &Placement) -> Vec<Placement> {
        let water = self
            .case
            .request
            .water
            .filter(|water| water.waterline == Waterline::Auto);
        let Some(water) = water else {
            return vec![placement.clone()];
        };
        let ratio = water.liquid.density_g_cm3() / self.case.density_g_cm3;
        let hydrostatics = Hydrostatics::new(self.case.solid, &placement.goal.frame, ratio);
        let step_mm = hydrostatics.height_mm() / (WATERLINES + 1) as f64;
        let at = |line: usize| {
            let mut placement = placement.clone();
            placement.goal.afloat = Some(hydrostatics.at(step_mm * line as f64));
            placement
        };
        (1..=WATERLINES).map(at).collect()
    }

    /// Solves for a placed goal, with what the voids hold.
    fn solve(&self, placement: &Placement, columns: &Columns, axes: Axes) -> Solution {
        let all = columns.moments();
        let (ask, all): (Ask, _) = match axes {
            Axes::Model => (solve_on_model_columns, all.in_frame(&placement.goal.frame)),
            Axes::Goal => (solve, all),
        };
        let solver = |problem: &Problem| ask(problem, &Settings::default(), &self.watch);
        let problem = problem(placement, columns);
        let fill = self.case.fill.unwrap_or(Fill::AIR);
        fill.solve_by(&problem, all, solver)
    }

    /// Returns the best answer over the waterlines; the first if none is possible.
    fn best_trial(&self, placement: &Placement, columns: &Columns, axes: Axes) -> Option<Trial> {
        let trials = self.at_waterlines(placement).into_iter().map(|placement| {
            let solution = self.solve(&placement, columns, axes);
            Trial {
                columns: columns.len(),
                placement,
                solution,
            }
        });
        let score = |trial: &Trial| {
            if trial.is_possible() {
                Reached::of(&trial.solution.certificate).score()
            } else {
                f64::INFINITY
            }
        };
        trials.min_by(|a, b| score(a).total_cmp(&score(b)))
    }
}

/// Counts the tip of a placed top: its mass in place of the print, and the wall around its socket.
/// The gap around it is left out, which is some per cent of its mass.
fn with_tip(mut placement: Placement, stock: &PrintStock) -> Placement {
    let Some(rod) = placement.footing.as_ref().and_then(Footing::tip) else {
        return placement;
    };
    let frame = placement.goal.frame;
    let at = |z: f64| frame.to_model(&Point::new(0.0, 0.0, z));
    let [end, mouth, bottom] = [0.0, rod.out_mm(), rod.length_mm()].map(at);
    let pin = RoundBar {
        is_round: true,
        ..RoundBar::plain(bottom, end, rod.radius_mm())
    };
    let socket = RoundBar::plain(mouth, bottom, rod.radius_mm());
    let more = pin.moments() * (rod.density_g_cm3 / stock.density_g_cm3) - socket.moments();
    placement.goal.solid += more.in_frame(&frame);
    placement.keeps.push(Keep {
        from: mouth,
        to: bottom,
        radius_mm: rod.radius_mm() + stock.wall_mm,
    });
    placement
}

/// The frame of some columns.
#[derive(Clone, Copy)]
enum Axes {
    Model,
    Goal,
}

/// A solver for columns in the model's or in the goal's frame.
type Ask = fn(&Problem, &Settings, &Watch) -> Solution;

/// Returns the problem of emptying these columns for the goal.
pub(super) fn problem<'p>(placement: &'p Placement, columns: &'p Columns) -> Problem<'p> {
    Problem {
        goal: &placement.goal,
        fixed: placement.goal.solid,
        columns,
    }
}
