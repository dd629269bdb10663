//! The voids of a solution, solved for again until what will be written meets the goal (THEORY §4).

use rayon::prelude::*;

use super::{Error, Setup, Solved, tuning::defect_ratio};
use crate::base::watch::Watch;
use crate::cut::SolidEnd;
use crate::geom::{Aabb, Point};
use crate::hollow::{Solution, TopCourse};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Hollowed, Solid, TriMesh};
use crate::sheet::HeightProof;
use crate::voids::{Cavity, CavitySpec, VoidError, grown, without_slivers};

/// Rounds of measuring and solving again in one go, at most. Each leaves about a hundredth of the
/// defect before it, and each may find another void too small; more than a few mean that voids come
/// and go.
const MAX_ROUNDS: usize = 8;
/// The surface of a void may lie this share of a pixel from the true one.
const SURFACE_TOLERANCE_PIXELS: f64 = 0.5;
/// No finer than this, mm: below, triangles grow without any printer showing it.
const FINEST_SURFACE_TOLERANCE_MM: f64 = 0.02;
/// What is refused is kept solid with so much around it, in minimum openings: what lies nearer
/// would hardly be cleaned either. Less takes more rounds, as slices beside it are refused one
/// after the other; on the armadillo the critical speed reached is the same to 4e-7 from 0.25 to 2,
/// and 2e-5 worse at 3.
pub const REFUSED_MARGIN_RATIO: f64 = 2.0;
/// A refused void below this share of the model's volume may come back in a later round: at 50 mm
/// from the axis it moves the centre of mass by a tenth of a micrometre.
const SIGNIFICANT_RATIO: f64 = 2e-6;

/// The voids of a solution.
#[derive(Debug, Clone)]
pub struct Voids {
    /// The solution they were made from.
    pub solution: Solution,
    /// The moments of nothing emptied that the solution was found with, goal frame.
    pub fixed: Moments,
    /// The body with the voids in it; the ballast's pockets are the last of them.
    pub hollowed: Hollowed,
    /// The volume of voids that were too small to clean and stay solid, mm³.
    pub refused_mm3: f64,
    /// How many times it was solved again.
    pub rounds: usize,
}

impl Voids {
    /// The voids as they can be written: without the slivers that the rounding of a file would
    /// fold.
    pub fn finished(mut self) -> Result<Self, Error> {
        let bodies = std::mem::take(&mut self.hollowed.voids);
        self.hollowed.voids = bodies
            .par_iter()
            .map(without_slivers)
            .collect::<Result<_, _>>()?;
        Ok(self)
    }
}

/// Makes voids, measures them and solves again.
#[derive(Clone)]
pub struct Tuner<'a> {
    setup: &'a Setup,
    /// The columns of what may be emptied, without what was refused, and the last solution on them.
    solved: Solved,
    /// The surface of the same.
    cavity: Cavity,
    refused_mm3: f64,
    kept_mm3: f64,
}

impl<'a> Tuner<'a> {
    /// Draws what may be emptied.
    pub fn new(setup: &'a Setup, solved: Solved, progress: &Watch) -> Result<Self, Error> {
        let whole = Cavity::extract(&setup.model.solid, &cavity_spec(setup), progress)?;
        let cavity = setup
            .load
            .jackets()
            .try_fold(whole, |rest, jacket| rest.without(&jacket.mesh()))?;
        Ok(Self {
            setup,
            solved,
            cavity,
            refused_mm3: 0.0,
            kept_mm3: 0.0,
        })
    }

    /// What the run rests on.
    pub fn setup(&self) -> &'a Setup {
        self.setup
    }

    /// How the first answer came about.
    pub fn course(&self) -> &TopCourse {
        &self.solved.course
    }

    /// The proof for other heights of a top's centre.
    pub fn height_proof(&self) -> Option<HeightProof> {
        self.solved.height_proof
    }

    /// The voids whose uncut mesh meets the goal's constraints before cuts and pins.
    pub fn first(&mut self) -> Result<Voids, Error> {
        let voids = self.voids(self.solved.solution.clone(), self.setup.fixed(), 0)?;
        self.tuned(voids, Moments::default())
    }

    /// The voids solved for again until the uncut mesh and `more` (model frame) together meet the
    /// goal's constraints; of all rounds those that come nearest to them where none does.
    ///
    /// Each surface is drawn anew, with an error that no other foretells: where a body's moments
    /// are nearly alike, its axis goes about from round to round by more than is allowed (heart at
    /// 60 mm by filament: 0.01 to 0.17 degrees).
    pub fn tuned(&mut self, mut voids: Voids, more: Moments) -> Result<Voids, Error> {
        let goal = &self.setup.placement.goal;
        let mut written = self.written(&voids, more);
        let mut least = defect_ratio(goal, &voids.solution.moments, &written);
        let mut best = voids.clone();
        for _ in 0..MAX_ROUNDS {
            if least <= 1.0 {
                break;
            }
            voids = self.again(&voids, written)?;
            written = self.written(&voids, more);
            let defect = defect_ratio(goal, &voids.solution.moments, &written);
            if defect < least {
                (least, best) = (defect, voids.clone());
            }
        }
        Ok(best)
    }

    /// The moments (goal frame) of the uncut mesh and what is in it, and of `more` (model frame).
    fn written(&self, voids: &Voids, more: Moments) -> Moments {
        let printed = moments_of_mesh(&voids.hollowed.to_mesh()) + more;
        (printed + inside(self.setup, &voids.hollowed)).in_frame(&self.setup.placement.goal.frame)
    }

    /// The voids with these bodies and what lies so many minimum openings near them kept solid, and
    /// solved for again.
    pub fn without(
        &mut self,
        voids: &Voids,
        (refused, openings): (&[TriMesh], f64),
    ) -> Result<Voids, Error> {
        self.refuse(refused, openings)?;
        let less = self.voids(voids.solution.clone(), voids.fixed, voids.rounds)?;
        let written = self.written(&less, Moments::default());
        let less = self.again(&less, written)?;
        self.tuned(less, Moments::default())
    }

    /// What of what may be emptied these parts of the interior hold, as one mesh; none where they
    /// hold nothing.
    pub fn parts_about(&self, ends: &[SolidEnd]) -> Result<Vec<TriMesh>, Error> {
        let places: Vec<(Point, Aabb)> = ends
            .iter()
            .map(|end| (end.at_mm.into(), end.aabb()))
            .collect();
        let parts = self.cavity.parts_about(&places)?;
        Ok(if parts.triangles().is_empty() {
            Vec::new()
        } else {
            vec![parts]
        })
    }

    /// The voids solved for anew with these closed bodies kept solid from now on, and the volume
    /// that could have been emptied in all that is kept so, mm³.
    pub fn keeping(&mut self, voids: &Voids, bodies: &[TriMesh]) -> Result<(Voids, f64), Error> {
        let before_mm3 = self.cavity.mesh().signed_volume_mm3();
        for body in bodies {
            self.keep(body)?;
        }
        self.kept_mm3 += before_mm3 - self.cavity.mesh().signed_volume_mm3();
        let less = self.voids(voids.solution.clone(), voids.fixed, voids.rounds)?;
        let goal = &self.setup.placement.goal;
        let written =
            moments_of_mesh(&less.hollowed.to_mesh()) + inside(self.setup, &less.hollowed);
        let best = self.again(&less, written.in_frame(&goal.frame))?;
        Ok((self.tuned(best, Moments::default())?, self.kept_mm3))
    }

    /// The voids solved for once more with the difference between what was measured and what was
    /// solved for (goal frame) added to what stays.
    fn again(&mut self, voids: &Voids, written: Moments) -> Result<Voids, Error> {
        // What was refused since the voids were solved for is known to the columns now.
        let planned =
            self.setup
                .fill
                .filled(voids.fixed, &self.solved.columns, &voids.solution.quadric);
        let fixed = voids.fixed + (written - planned);
        self.solved.solution = self.solved.corrected(self.setup, fixed);
        self.voids(self.solved.solution.clone(), fixed, voids.rounds + 1)
    }

    /// The voids of a solution; what is too small is refused for good, or it would come and go from
    /// round to round.
    fn voids(&mut self, solution: Solution, fixed: Moments, rounds: usize) -> Result<Voids, Error> {
        let frame = &self.setup.placement.goal.frame;
        let bodies = self.cavity.void_bodies(&solution.quadric, frame)?;
        let crumbs_mm3 = bodies.refused_mm3();
        let least_mm3 = SIGNIFICANT_RATIO * self.setup.placement.goal.solid.volume();
        let significant: Vec<TriMesh> = bodies
            .refused
            .into_iter()
            .filter(|body| body.signed_volume_mm3() > least_mm3)
            .collect();
        let refused_mm3 = self.refused_mm3 + crumbs_mm3;
        self.refuse(&significant, REFUSED_MARGIN_RATIO)?;
        let mut hollowed = Hollowed {
            outer: self.setup.model.solid.clone(),
            voids: bodies.bodies,
        };
        for pocket in self.setup.load.pockets() {
            hollowed
                .voids
                .push(Solid::new(pocket.mesh()).map_err(VoidError::from)?);
        }
        Ok(Voids {
            solution,
            fixed,
            hollowed,
            refused_mm3,
            rounds,
        })
    }

    /// Keeps these bodies, and what lies so many minimum openings near them, solid from now on.
    fn refuse(&mut self, bodies: &[TriMesh], openings: f64) -> Result<(), Error> {
        if bodies.is_empty() {
            return Ok(());
        }
        let all = bodies
            .iter()
            .fold(TriMesh::default(), |all, body| all.joined(body));
        let margin_mm = openings * self.setup.printer.min_opening_mm.value;
        let solid = grown(&all, margin_mm)?;
        self.refused_mm3 += all.signed_volume_mm3();
        self.keep(&solid)
    }

    /// Takes a body, or several that bound each other nowhere, out of what may be emptied.
    fn keep(&mut self, solid: &TriMesh) -> Result<(), Error> {
        let frame = &self.setup.placement.goal.frame;
        let (cavity, columns) = rayon::join(
            || self.cavity.without(solid),
            || {
                self.solved
                    .columns
                    .without(&solid.map_vertices(|p| frame.to_local(p)))
            },
        );
        self.cavity = cavity?;
        self.solved.columns = columns;
        Ok(())
    }
}

/// The moments, model frame, of what is put into the print: ballast, hardware, a filling of the
/// voids.
pub fn inside(setup: &Setup, hollowed: &Hollowed) -> Moments {
    let voids = hollowed
        .voids
        .iter()
        .map(|void| moments_of_mesh(void.mesh()));
    let volume = voids.fold(Moments::default(), |sum, void| sum + void);
    setup.load.moments() + setup.hardware_moments() + volume * setup.fill.density_ratio()
}

/// What the surface of the voids is made to.
fn cavity_spec(setup: &Setup) -> CavitySpec<'_> {
    let pixel_mm = setup
        .printer
        .pixel_x_mm
        .value
        .min(setup.printer.pixel_y_mm.value);
    CavitySpec {
        wall_mm: setup.wall.wall_mm,
        tolerance_mm: (SURFACE_TOLERANCE_PIXELS * pixel_mm).max(FINEST_SURFACE_TOLERANCE_MM),
        keeps: &setup.placement.keeps,
        min_void_mm: setup.printer.min_opening_mm.value,
    }
}
