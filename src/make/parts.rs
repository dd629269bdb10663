//! The parts of an opened body, corrected until what is written meets the goal.

use rayon::prelude::*;

use super::sparse::with_sparse;
use super::write::{write, write_jig};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::cut::{
    self, Boss, CutError, CutPlan, Obstacle, PlanRequest, find_thin_sockets, jigs, parts_and_faces,
};
use crate::error::Error;
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::TriMesh;
use crate::open::{Candidate, Planner, Resolver, drain_again, finish, shortfall_ratio};
use crate::run::{BossRound, KeptBoss, Made, Placed, Voids, WrittenPart};
use crate::verify::{PartEvidence, assembly_moments};

/// Makes the parts of a plan, measures them as they are written, and solves again with the
/// difference until they meet the goal.
///
/// Pins, sockets and glue weigh too, and files round: see [`crate::guide::theory`]. Of all attempts
/// the one that comes nearest to the goal is returned.
pub fn make<'a>(
    placed: &'a Placed,
    candidate: Candidate<'a>,
    watch: &Watch,
) -> Result<Made, Error> {
    watch.enter(Phase::Parts);
    let Candidate {
        opened,
        mut resolver,
    } = candidate.weighing(placed);
    let value_before_cleaning = resolver.first_value();
    let pegs = moments_of_mesh(&opened.plan.pegs()) + placed.joining_moments(&opened.plan);
    let more = pegs - opened.plan.drained(&opened.voids.hollowed)?;
    let mut corrector = Corrector {
        placed,
        resolver: &mut resolver,
        request: &opened.request,
        bosses: opened.bosses,
        watch,
    };
    let best = corrector.best(opened.voids, opened.plan, more)?;
    let printed = placed.printed(&best.voids.hollowed);
    let plan = cut::measure_voids_again(&printed, best.plan, &opened.request)?;
    let jigs = jigs(&printed, &plan, &opened.request)?;
    let jigs = jigs.into_iter().map(|jig| write_jig(placed, jig, watch));
    let jigs = jigs.collect::<Result<_, Error>>()?;
    let Voids {
        solution,
        hollowed,
        inner,
        cells,
        refused_mm3,
        rounds,
        ..
    } = best.voids;
    Ok(Made {
        load: resolver.solved().load.clone(),
        height_proof: resolver.height_proof(),
        proof: resolver.solved().proof.clone(),
        course: resolver.course().clone(),
        smooth: resolver.solved().smooth(placed),
        solution,
        hollowed,
        inner,
        cells,
        refused_mm3,
        plan,
        remarks: opened.remarks,
        jigs,
        parts: best.parts,
        rounds,
        value_before_cleaning,
        cleaning: opened.cleaning,
        bosses: best.bosses,
    })
}

/// Corrects the parts of one plan.
struct Corrector<'r, 'a> {
    placed: &'r Placed,
    resolver: &'r mut Resolver<'a>,
    request: &'r PlanRequest,
    /// Rounds in which bosses were kept solid so far.
    bosses: Vec<BossRound>,
    watch: &'r Watch,
}

/// Written parts, and their distance from the goal.
struct Attempt {
    voids: Voids,
    plan: CutPlan,
    /// Rounds in which bosses were kept solid in these voids.
    bosses: Vec<BossRound>,
    parts: Vec<WrittenPart>,
    /// Moments of the parts beyond those of the uncut body, model frame: pins, sockets, glue, and
    /// the rounding of files.
    more: Moments,
    /// Distance from the goal's constraints, in tolerances.
    defect_ratio: f64,
}

impl Corrector<'_, '_> {
    /// Makes parts until they meet the goal; returns the attempt nearest to it.
    fn best(&mut self, voids: Voids, plan: CutPlan, more: Moments) -> Result<Attempt, Error> {
        let mut best = self.attempt(voids, plan, more)?;
        // The attempt before, if it is not the best.
        let mut last: Option<Attempt> = None;
        for _ in 1..self.placed.policy.max_assemblies {
            if best.defect_ratio <= 1.0 {
                break;
            }
            let (voids, plan, more) = match last.take() {
                Some(last) => (last.voids, last.plan, last.more),
                None => (best.voids.clone(), best.plan.clone(), best.more),
            };
            let next = self.attempt(voids, plan, more)?;
            if next.defect_ratio < best.defect_ratio {
                best = next;
            } else {
                last = Some(next);
            }
        }
        Ok(best)
    }

    /// Makes parts of voids that are solved for again with what the parts weighed before.
    fn attempt(&mut self, voids: Voids, plan: CutPlan, more: Moments) -> Result<Attempt, Error> {
        self.watch.check()?;
        let goal = self.placed.goal();
        let voids = self.correct(voids, &plan, more)?;
        let voids = finish(voids, self.watch)?;
        let (parts, plan) = self.write_parts(&voids, plan)?;
        let evidence: Vec<PartEvidence> = parts.iter().map(WrittenPart::evidence).collect();
        let whole = assembly_moments(&evidence) + self.placed.joining_moments(&plan);
        let load = &self.resolver.solved().load;
        let inside = (self.placed).moments_inside(load, &voids.hollowed, &voids.inner);
        let reached = (whole + inside).in_frame(&goal.frame);
        Ok(Attempt {
            defect_ratio: shortfall_ratio(self.placed, &voids.solution.moments, &reached),
            more: whole - moments_of_mesh(&voids.hollowed.to_mesh()),
            voids,
            plan,
            bosses: self.bosses.clone(),
            parts,
        })
    }

    /// Solves again until the voids meet the goal with what is not part of the uncut body.
    ///
    /// Voids move meanwhile. Where one comes too near to a socket, the room of that socket is kept
    /// solid, and the rest is solved again. Ordered pins stay whatever they break.
    fn correct(&mut self, voids: Voids, plan: &CutPlan, more: Moments) -> Result<Voids, Error> {
        let voids = self.resolver.correct(voids, more)?;
        let thin = find_thin_sockets(&voids.hollowed, plan, self.request)?;
        if thin.is_empty() || self.placed.has_ordered_pins() {
            return Ok(voids);
        }
        let mut trial = self.resolver.clone();
        let bodies: Vec<TriMesh> = thin.iter().map(|boss| boss.body.clone()).collect();
        let kept = trial.with_bosses(&voids, &bodies)?;
        let kept = trial.correct(kept, more)?;
        if !kept.solution.is_usable() {
            return Ok(voids);
        }
        self.bosses.push(BossRound {
            bosses: thin.into_iter().map(keep).collect(),
            kept_mm3: trial.bosses_mm3(),
            before: voids.solution.certificate,
            after: kept.solution.certificate,
        });
        *self.resolver = trial;
        Ok(kept)
    }

    /// Plans the voids as they are now.
    fn plan_anew(&self, voids: &Voids) -> Result<CutPlan, Error> {
        if self.placed.is_drained() {
            return drain_again(self.placed, voids, self.request);
        }
        let anew = Planner::of(self.placed).plan(voids, self.request)?;
        Ok(anew.or_error::<CutError>()?)
    }

    /// Cuts the body by the plan and writes its parts, in memory.
    ///
    /// If the voids have changed so that the plan leaves one closed, it is planned anew.
    fn write_parts(
        &self,
        voids: &Voids,
        mut plan: CutPlan,
    ) -> Result<(Vec<WrittenPart>, CutPlan), Error> {
        let body = self.placed.printed(&voids.hollowed);
        let (parts, plan) = match parts_and_faces(&body, &plan, self.request)? {
            Verdict::No(Obstacle::ClosedCavity { .. }) => {
                let solid = std::mem::take(&mut plan.solid);
                let anew = self.plan_anew(voids)?;
                let anew = CutPlan { solid, ..anew };
                parts_and_faces(&body, &anew, self.request)?
            }
            parts => parts,
        }
        .or_error::<CutError>()?;
        self.watch.check()?;
        let job = self.placed.name();
        let scale_ratio = self.placed.shop.printer.print_scale_ratio();
        let count = parts.len();
        let parts = parts.into_par_iter().map(|part| {
            let name = format!("{job}_{}of{count:02}", part.id);
            let part = write(part, &name, scale_ratio, self.watch)?;
            with_sparse(self.placed, voids, part, self.watch)
        });
        Ok((parts.collect::<Result<_, Error>>()?, plan))
    }
}

/// Records a boss.
fn keep(boss: Boss) -> KeptBoss {
    KeptBoss {
        volume_mm3: boss.body.signed_volume_mm3(),
        pin: boss.pin,
        parts: boss.parts,
    }
}
