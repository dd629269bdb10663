//! From coarse columns to the printer's own: the optimal quadric, or the proof that there is none.

use super::{Error, Impossible, Setup, phase, stopwatch::Stopwatch};
use crate::base::watch::Watch;
use crate::goal::Objective;
use crate::hollow::{
    Certificate, Fill, Pass, Problem, Settings, Solution, TopCourse, bound_over_heights, top_course,
};
use crate::interior::Columns;
use crate::mass::Moments;
use crate::sheet::HeightProof;
use crate::shell::Shell;

/// Columns a side of the first, cold solve. Fewer than 50 lose thin limbs; more only make the
/// search over heights dearer.
pub(super) const COARSE_COLUMNS: usize = 100;
/// Columns a side of the middle level, on which an impossible goal is proved.
const MIDDLE_COLUMNS: usize = 400;

/// The optimal void on the finest columns.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The finest columns.
    pub columns: Columns,
    /// The solution on them.
    pub solution: Solution,
    /// Tops: the proof for other heights of the centre, on the finest columns it was made on.
    pub height_proof: Option<HeightProof>,
    /// How the answer came about on the coarsest columns: the ascent from nothing, and for tops the
    /// speed by height.
    pub course: TopCourse,
}

impl Solved {
    /// Solves coarse to fine; each level starts from the quadric of the one before.
    pub fn of(
        setup: &Setup,
        progress: &Watch,
        watch: &mut Stopwatch,
    ) -> Result<Result<Self, Impossible>, Error> {
        progress.report(phase::SOLVE, 0.0);
        let goal = &setup.placement.goal;
        let shell = Shell::new(
            &setup.model.solid,
            &goal.frame,
            setup.wall.wall_mm,
            &setup.placement.keeps,
        )?;
        let mut level: Option<Self> = None;
        let pitches = pitches(setup, &shell);
        // The first of several levels may lack what a finer one has; the last one has the last
        // word.
        let first_to_tell = pitches.len().min(2) - 1;
        for (done, pitch_mm) in pitches.into_iter().enumerate() {
            progress.report(phase::SOLVE, (1.0 + done as f64) / 4.0);
            let columns = Columns::of_shell(&shell, pitch_mm, &Watch::silent())?;
            let columns = setup.load.carved(columns, &goal.frame);
            watch.lap("columns");
            let solution = solution_on(setup, &columns, level.as_ref(), setup.fixed());
            watch.lap("solve");
            if progress.is_cancelled() {
                return Err(Error::Cancelled);
            }
            if done >= first_to_tell && !solution.is_usable() {
                return Ok(Err(impossible(setup, &solution)));
            }
            let height_proof = height_proof(&columns, &solution)
                .or(level.as_ref().and_then(|level| level.height_proof));
            let course =
                level.map_or_else(|| course(setup, &columns, &solution), |level| level.course);
            level = Some(Self {
                columns,
                solution,
                height_proof,
                course,
            });
        }
        let solved = level.ok_or(Error::Cancelled)?.proved_over_heights(setup);
        watch.lap("solve");
        Ok(Ok(solved))
    }

    /// The same with the proof for other heights made on its own columns, where that takes a dozen
    /// passes only: not where Spin-It's functional weighs the lever, and there are as many levers
    /// as heights.
    fn proved_over_heights(self, setup: &Setup) -> Self {
        let weighs_lever =
            matches!(self.solution.objective, Objective::SpinIt { gamma_c, .. } if gamma_c > 0.0);
        if weighs_lever || setup.fill != Fill::AIR {
            return self;
        }
        let problem = Problem {
            goal: &setup.placement.goal,
            fixed: setup.fixed(),
            columns: &self.columns,
        };
        let proved = bound_over_heights(
            &problem,
            &Settings::default(),
            &self.solution,
            &Watch::silent(),
        );
        let proof = proved.map(|bound| HeightProof {
            pitch_mm: self.columns.pitch_mm[0],
            value: self.solution.certificate.value,
            bound,
        });
        Self {
            height_proof: proof.or(self.height_proof),
            ..self
        }
    }

    /// The solution once more, with `fixed` as the moments of nothing emptied.
    pub fn corrected(&self, setup: &Setup, fixed: Moments) -> Solution {
        solution_on(setup, &self.columns, Some(self), fixed)
    }
}

/// What a solution proves of tops with their centre of mass at any other height.
fn height_proof(columns: &Columns, solution: &Solution) -> Option<HeightProof> {
    let Certificate {
        value,
        bound_over_heights,
        ..
    } = solution.certificate;
    bound_over_heights.map(|bound| HeightProof {
        pitch_mm: columns.pitch_mm[0],
        value,
        bound,
    })
}

/// How the first answer came about.
fn course(setup: &Setup, columns: &Columns, solution: &Solution) -> TopCourse {
    let problem = Problem {
        goal: &setup.placement.goal,
        fixed: setup.fixed(),
        columns,
    };
    let is_plain = setup.fill == Fill::AIR && solution.is_usable();
    let of_top = if is_plain {
        top_course(&problem, &Settings::default(), solution)
    } else {
        TopCourse::default()
    };
    let passes: Vec<Pass> = if of_top.passes.is_empty() {
        solution.course.clone()
    } else {
        of_top.passes
    };
    TopCourse { passes, ..of_top }
}

/// The pitches from coarse to fine; the last is the printer's own.
fn pitches(setup: &Setup, shell: &Shell) -> Vec<[f64; 2]> {
    let is_coarser = |pitch: &[f64; 2]| pitch[0] > 1.5 * setup.pitch_mm[0];
    let mut pitches: Vec<[f64; 2]> = [COARSE_COLUMNS, MIDDLE_COLUMNS]
        .map(|n| shell.coarse_pitch(n))
        .into_iter()
        .filter(is_coarser)
        .collect();
    pitches.push(setup.pitch_mm);
    pitches
}

fn solution_on(
    setup: &Setup,
    columns: &Columns,
    from: Option<&Solved>,
    fixed: Moments,
) -> Solution {
    let problem = Problem {
        goal: &setup.placement.goal,
        fixed,
        columns,
    };
    setup.fill.solve(
        &problem,
        from.map(|level| &level.solution),
        &Watch::silent(),
    )
}

/// The answer for a goal that no hollowing meets.
fn impossible(setup: &Setup, solution: &Solution) -> Impossible {
    let goal = &setup.placement.goal;
    Impossible {
        verdict: "impossible",
        reason: solution.status.explain(goal),
        remedies: Vec::new(),
        hints: solution
            .status
            .remedies(goal)
            .iter()
            .map(ToString::to_string)
            .collect(),
        choice: setup.choice.clone(),
        proof_quadric: solution.status.separator().unwrap_or(solution.quadric).0,
        origin_mm: goal.frame.origin.into(),
        axis: goal.frame.axis().into(),
        warnings: setup
            .placement
            .warnings
            .iter()
            .map(ToString::to_string)
            .collect(),
    }
}
