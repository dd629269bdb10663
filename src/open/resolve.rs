//! Solving again: voids are drawn, measured, and solved for again until they meet the goal
//! ([`crate::guide::theory`]).

use std::sync::Arc;

use super::budget::{Budget, Work};
use super::defect::shortfall_ratio;
use super::draw::{
    CELL_ROUNDS, FREE_ROUNDS, draw_inner, draw_outermost, in_cells, pockets, too_solid,
};
use super::plan::Planner;
use crate::base::watch::Watch;
use crate::cut::{CutOrder, Hollowed, SolidEnd};
use crate::error::Error;
use crate::geom::{Aabb, Point};
use crate::hollow::{Solution, TopCourse};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Csg, TriMesh};
use crate::run::{HeightProof, LaidField, Placed, Solved, Voids};
use crate::voids::{Cavity, CavitySpec, VoidError, grow_bodies};

/// Draws voids, measures them and solves again. What it keeps solid stays so.
#[derive(Clone)]
pub struct Resolver<'a> {
    pub(super) placed: &'a Placed,
    /// The columns of what may still be emptied, and the last solution on them.
    solved: Solved,
    /// The figure of the certificate before anything was kept solid.
    first_value: f64,
    /// The surface of the same region.
    cavity: Cavity,
    /// The outside of the model, and the cavities that it came with.
    given: Hollowed,
    /// Volume of voids that were refused, mm³.
    refused_mm3: f64,
    /// Volume of bosses that could have been emptied, mm³.
    bosses_mm3: f64,
    /// The bodies that were taken out of what may be emptied, margins included.
    kept: Vec<Arc<TriMesh>>,
    /// What decides on the cuts.
    planner: Planner,
    budget: Budget,
    watch: Watch,
}

/// What a search has kept solid, to be kept solid in another copy of the body.
#[derive(Debug, Clone)]
pub struct Kept {
    /// The bodies, margins included. They may touch.
    bodies: Vec<Arc<TriMesh>>,
    /// The solution for the rest.
    solution: Solution,
    refused_mm3: f64,
    bosses_mm3: f64,
}

/// Closed bodies that are to be kept solid.
pub struct Refused<'b> {
    /// The bodies.
    pub bodies: &'b [TriMesh],
    /// Margin around them, in minimum openings.
    pub margin_openings: f64,
    /// Tells from voids without them if too much is lost. It may be asked before these are
    /// corrected.
    pub is_lost: &'b dyn Fn(&Voids) -> bool,
}

impl<'a> Resolver<'a> {
    /// Draws the region that may be emptied.
    pub fn new(placed: &'a Placed, solved: Solved, watch: &Watch) -> Result<Self, Error> {
        let printer = &placed.shop.printer;
        let keeps = &placed.placement.keeps;
        let usual = CavitySpec::for_printer(printer, placed.shop.wall.wall_mm, keeps);
        // Nothing is cleaned out of the regions of a match or a field.
        let least_mm = match placed.keeps_small_regions() {
            true => 0.0,
            false => usual.min_void_mm,
        };
        let spec = CavitySpec {
            min_void_mm: least_mm,
            ..usual
        };
        let whole = Cavity::extract(placed.solid(), &spec, watch)?;
        let cavity = {
            let mut jackets = solved.load.jackets();
            jackets.try_fold(whole, |rest, jacket| rest.without(&jacket.mesh()))?
        };
        Self::of_cavity(placed, solved, cavity, watch)
    }

    /// Takes a cavity as the region that may be emptied.
    pub fn of_cavity(
        placed: &'a Placed,
        solved: Solved,
        cavity: Cavity,
        watch: &Watch,
    ) -> Result<Self, Error> {
        Ok(Self {
            placed,
            first_value: solved.solution.certificate.value,
            solved,
            cavity,
            given: Hollowed::of_solid(placed.solid()).map_err(VoidError::from)?,
            refused_mm3: 0.0,
            bosses_mm3: 0.0,
            kept: Vec::new(),
            planner: Planner::of(placed),
            budget: Budget::of(placed.job.effort),
            watch: watch.clone(),
        })
    }

    /// Returns a coarse surface of the region that may be emptied, which strays by at most
    /// `stray_mm` more.
    pub fn coarse_cavity(&self, stray_mm: f64) -> Result<Cavity, Error> {
        Ok(self.cavity.coarsened(stray_mm, &self.watch)?)
    }

    /// Returns what was kept solid, and the solution for the rest.
    pub fn kept(&self) -> Kept {
        Kept {
            bodies: self.kept.clone(),
            solution: self.solved.solution.clone(),
            refused_mm3: self.refused_mm3,
            bosses_mm3: self.bosses_mm3,
        }
    }

    /// Keeps solid what was kept solid in another copy of the body, solves and draws once.
    pub fn keep(&mut self, kept: &Kept) -> Result<Voids, Error> {
        let bodies = kept.bodies.iter().map(|body| Csg::of_mesh(body));
        let mut bodies = bodies.collect::<Result<Vec<_>, _>>()?.into_iter();
        if let Some(first) = bodies.next() {
            let all = bodies.try_fold(first, |all, body| all.union(&body))?;
            self.exclude(&all.to_mesh()?)?;
        }
        (self.refused_mm3, self.bosses_mm3) = (kept.refused_mm3, kept.bosses_mm3);
        let fixed = self.solved.fixed;
        let known = Some(&kept.solution);
        let columns = &self.solved.columns;
        let solution = self.placed.solve(columns, fixed, known, &self.watch);
        self.solved.solution = solution.clone();
        self.voids(solution, fixed, 0)
    }

    /// Returns a resolver in which these cuts are ordered.
    pub fn by_order(&self, order: CutOrder) -> Self {
        Self {
            planner: Planner::Ordered(Arc::new(order)),
            ..self.clone()
        }
    }

    /// Returns the outside of the model, and the cavities that it came with.
    pub fn given(&self) -> &Hollowed {
        &self.given
    }

    /// Returns what is left of the search's work.
    pub fn budget(&self) -> &Budget {
        &self.budget
    }

    /// Returns what decides on the cuts.
    pub fn planner(&self) -> &Planner {
        &self.planner
    }

    /// Returns the goal in its model.
    pub fn placed(&self) -> &'a Placed {
        self.placed
    }

    /// Returns the watch over the run.
    pub fn watch(&self) -> &Watch {
        &self.watch
    }

    /// Returns the solution as it was last found, with its ballast.
    pub fn solved(&self) -> &Solved {
        &self.solved
    }

    /// Returns the figure of the certificate before anything was kept solid.
    pub fn first_value(&self) -> f64 {
        self.first_value
    }

    /// Returns the course of the first answer.
    pub fn course(&self) -> &TopCourse {
        &self.solved.course
    }

    /// Returns the proof for other heights of a top's centre.
    pub fn height_proof(&self) -> Option<HeightProof> {
        self.solved.height_proof
    }

    /// Draws the voids whose uncut mesh meets the goal's constraints, before cuts and pins.
    pub fn draw(&mut self) -> Result<Voids, Error> {
        let fixed = self.solved.fixed;
        if let Some(inside) = &self.placed.cells {
            self.exclude(&inside.solid)?;
            self.solved.solution = self.solved.solve_again(self.placed, fixed, &self.watch);
            if !self.solved.solution.is_usable() {
                return Err(too_solid(inside));
            }
        }
        let voids = self.voids(self.solved.solution.clone(), fixed, 0)?;
        self.correct(voids, Moments::default())
    }

    /// Solves again until the uncut mesh and `more` (model frame) together meet the goal's
    /// constraints; the nearest round if none does.
    ///
    /// Each surface is drawn anew, with an error that no other foretells. If a body's moments are
    /// nearly equal, its principal axis wanders between rounds by more than the tolerance. A goal
    /// that cannot be met any more is not solved for again.
    pub fn correct(&mut self, mut voids: Voids, more: Moments) -> Result<Voids, Error> {
        let placed = self.placed;
        let mut measured = self.measure(&voids, more);
        let mut least = shortfall_ratio(placed, &voids.solution.moments, &measured);
        let mut best = voids.clone();
        // A given field stays as it is.
        let nested = placed.sparse.as_ref();
        let field = nested.and_then(|nested| nested.field.as_ref());
        let rounds = match field.is_some_and(LaidField::is_given) {
            true => 0,
            false => {
                placed.policy.correction_rounds * placed.cells.as_ref().map_or(1, |_| CELL_ROUNDS)
            }
        };
        for _ in 0..rounds {
            if least <= 1.0 || !voids.solution.is_usable() {
                break;
            }
            voids = self.solve_again(&voids, measured)?;
            measured = self.measure(&voids, more);
            let defect = shortfall_ratio(placed, &voids.solution.moments, &measured);
            if defect < least {
                (least, best) = (defect, voids.clone());
            }
        }
        Ok(best)
    }

    /// Returns the moments (goal frame) of the uncut mesh with its contents, and of `more` (model
    /// frame).
    fn measure(&self, voids: &Voids, more: Moments) -> Moments {
        let printed = moments_of_mesh(&voids.hollowed.to_mesh()) + more;
        let load = &self.solved.load;
        let inside = (self.placed).moments_inside(load, &voids.hollowed, &voids.inner);
        (printed + inside).in_frame(&self.placed.goal().frame)
    }

    /// Keeps bodies solid, solves again and draws once. A search that keeps more and more solid
    /// needs to [`correct`](Self::correct) the last voids only.
    ///
    /// The figure is known before the voids are drawn. Those that are lost by it keep their old
    /// surfaces, which saves most of the time. So do those that do not meet the goal any more.
    pub fn without(&mut self, voids: &Voids, refused: &Refused) -> Result<Voids, Error> {
        self.refuse(refused.bodies, refused.margin_openings)?;
        let less = self.solve_undrawn(voids, voids.fixed)?;
        if !less.solution.is_usable() || (refused.is_lost)(&less) {
            return Ok(less);
        }
        self.draw_solved(less)
    }

    /// Draws voids that were solved for, once. [`Self::correct`] makes up for the drawing's error.
    pub fn draw_solved(&mut self, voids: Voids) -> Result<Voids, Error> {
        self.voids(voids.solution, voids.fixed, voids.rounds)
    }

    /// Returns what may be emptied in these parts of the interior, as one mesh or none.
    pub fn parts_about(&self, ends: &[SolidEnd]) -> Result<Vec<TriMesh>, Error> {
        let place = |end: &SolidEnd| -> (Point, Aabb) { (end.at_mm.into(), end.aabb()) };
        let places: Vec<(Point, Aabb)> = ends.iter().map(place).collect();
        let parts = self.cavity.parts_near(&places)?;
        let is_empty = parts.triangles().is_empty();
        Ok(if is_empty { Vec::new() } else { vec![parts] })
    }

    /// Keeps the bodies of bosses solid, solves again and draws once, as [`Self::without`] does.
    pub fn with_bosses(&mut self, voids: &Voids, bodies: &[TriMesh]) -> Result<Voids, Error> {
        let less = self.solve_with_bosses(voids, bodies)?;
        self.draw_solved(less)
    }

    /// Keeps the bodies of bosses solid and solves again. The voids have their old surfaces until
    /// [`Self::draw_solved`] draws them: if the figure is too low, nobody needs to.
    pub fn solve_with_bosses(&mut self, voids: &Voids, bodies: &[TriMesh]) -> Result<Voids, Error> {
        let before_mm3 = self.cavity.mesh().signed_volume_mm3();
        for body in bodies {
            self.exclude(body)?;
        }
        self.bosses_mm3 += before_mm3 - self.cavity.mesh().signed_volume_mm3();
        self.solve_undrawn(voids, voids.fixed)
    }

    /// Returns the volume of all bosses that could have been emptied, mm³.
    pub fn bosses_mm3(&self) -> f64 {
        self.bosses_mm3
    }

    /// Solves once more, with the difference between the measured moments (goal frame) and those
    /// solved for added to what stays.
    fn solve_again(&mut self, voids: &Voids, measured: Moments) -> Result<Voids, Error> {
        self.watch.check()?;
        // The columns know by now what was refused since the voids were solved for.
        let columns = &self.solved.columns;
        let planned = self.placed.filled(voids.fixed, columns, &voids.solution);
        let fixed = voids.fixed + (measured - planned);
        let again = self.solve_undrawn(voids, fixed)?;
        self.voids(again.solution, fixed, again.rounds)
    }

    /// Solves once more, with these moments of the solid without any void. The voids keep their old
    /// surfaces.
    fn solve_undrawn(&mut self, voids: &Voids, fixed: Moments) -> Result<Voids, Error> {
        self.watch.check()?;
        self.budget.spend(Work::Solve(self.solved.columns.len()));
        self.solved.solution = self.solved.solve_again(self.placed, fixed, &self.watch);
        Ok(Voids {
            solution: self.solved.solution.clone(),
            fixed,
            hollowed: voids.hollowed.clone(),
            inner: voids.inner.clone(),
            cells: voids.cells.clone(),
            refused_mm3: self.refused_mm3,
            rounds: voids.rounds + 1,
        })
    }

    /// Draws the voids of a solution. Voids that are too small stay solid for good, or they would
    /// come and go from round to round.
    fn voids(&mut self, solution: Solution, fixed: Moments, rounds: usize) -> Result<Voids, Error> {
        self.watch.check()?;
        let triangles = self.cavity.mesh().triangles().len();
        self.budget.spend(Work::Draw(triangles));
        let goal = self.placed.goal();
        let bodies = draw_outermost(&self.cavity, self.placed, &solution, &self.watch)?;
        let refused_mm3 = self.refused_mm3 + bodies.too_small_mm3();
        let policy = &self.placed.policy;
        let least_mm3 = policy.significant_void_ratio * goal.solid.volume();
        let is_significant = |body: &TriMesh| body.signed_volume_mm3() > least_mm3;
        let refused = bodies.too_small.into_iter().filter(is_significant);
        let refused: Vec<TriMesh> = refused.collect();
        self.refuse(&refused, policy.refused_margin_openings)?;
        let drawn = in_cells(self.placed, bodies.bodies, &self.watch)?;
        if rounds >= FREE_ROUNDS {
            self.exclude(&drawn.solid)?;
        }
        let mut hollowed = Hollowed::new(self.given.outer.clone(), drawn.air);
        hollowed.voids.extend(self.given.voids.iter().cloned());
        hollowed.voids.extend(pockets(&self.solved.load)?);
        let inner = draw_inner(&self.cavity, self.placed, &solution, &self.watch)?;
        Ok(Voids {
            solution,
            fixed,
            hollowed,
            inner,
            cells: drawn.cells,
            refused_mm3,
            rounds,
        })
    }

    /// Keeps bodies solid from now on, with a margin in minimum openings around them.
    fn refuse(&mut self, bodies: &[TriMesh], margin_openings: f64) -> Result<(), Error> {
        if bodies.is_empty() {
            return Ok(());
        }
        let join = |all: TriMesh, body: &TriMesh| all.joined(body);
        let all = bodies.iter().fold(TriMesh::default(), join);
        let margin_mm = margin_openings * self.placed.shop.printer.min_opening_mm.value;
        let solid = grow_bodies(&all, margin_mm, &self.watch)?;
        self.refused_mm3 += all.signed_volume_mm3();
        self.exclude(&solid)
    }

    /// Takes a body, or several that do not touch, out of what may be emptied.
    fn exclude(&mut self, solid: &TriMesh) -> Result<(), Error> {
        self.watch.check()?;
        if solid.is_empty() {
            return Ok(());
        }
        let frame = &self.placed.goal().frame;
        let local = || solid.map_vertices(|p| frame.to_local(p));
        let (cavity, columns) = rayon::join(
            || self.cavity.without(solid),
            || self.solved.columns.without_watched(&local(), &self.watch),
        );
        self.cavity = cavity?;
        self.solved.columns = columns?;
        self.kept.push(Arc::new(solid.clone()));
        Ok(())
    }
}

#[cfg(test)]
mod tests;
