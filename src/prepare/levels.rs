//! Levels: from coarse columns to the printer's own, to the optimal quadric or to the proof that
//! there is none.

use super::outcome::Impossible;
use crate::ballast::Load;
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::goal::{Contact, Request, Up, Water, Waterline};
use crate::hollow::{
    Certificate, Fill, Pass, Problem, Settings, Solution, TopCourse, Trade, prove, top_course,
};
use crate::interior::Columns;
use crate::run::{HeightProof, Placed, Solved};
use crate::shell::Shell;

/// Columns a side of the first, cold solve. Fewer than 50 lose thin limbs; more only make the
/// search over heights dearer.
pub const COARSE_COLUMNS: usize = 100;
/// Columns a side of the middle level, on which an impossible goal is proved.
const MIDDLE_COLUMNS: usize = 400;
/// Place of the middle level among three. Plans are compared on it where there is a finer one.
const MIDDLE_LEVEL: usize = 1;

/// The best void, or why no hollowing meets the goal.
pub type Answer = Verdict<Solved, Impossible>;

/// Solves beside some ballast, coarse to fine: each level starts from the quadric of the one
/// before.
pub fn with_load(placed: &Placed, load: Load, watch: &Watch) -> Result<Answer, Error> {
    let goal = placed.goal();
    let keeps = &placed.placement.keeps;
    let shell = Shell::new(placed.solid(), &goal.frame, placed.shop.wall.wall_mm, keeps)?;
    let pitches = pitches(placed, &shell);
    // The first of several levels may lack what a finer one has; the last one has the last word.
    let first_to_refuse = pitches.len().min(2) - 1;
    let beside = load.excess() + placed.laid_beyond();
    let fixed = goal.solid + beside.in_frame(&goal.frame);
    let mut coarser: Option<Solved> = None;
    for (level, pitch_mm) in pitches.into_iter().enumerate() {
        watch.enter(Phase::Columns);
        let columns = Columns::of_shell(&shell, pitch_mm, watch)?;
        let columns = load.carve(columns, &goal.frame);
        watch.enter(Phase::Solve);
        let known = coarser.as_ref().map(|level| &level.solution);
        let solution = placed.solve(&columns, fixed, known, watch);
        watch.check()?;
        let problem = Problem {
            goal,
            fixed,
            columns: &columns,
        };
        if level >= first_to_refuse && !solution.is_usable() {
            return Ok(Verdict::No(impossible(placed, &solution)));
        }
        let load = load.clone();
        let middle = coarser.clone().filter(|_| level > MIDDLE_LEVEL);
        coarser = Some(Solved {
            coarse: middle.map(Box::new),
            height_proof: height_proof(&columns, &solution)
                .or(coarser.as_ref().and_then(|level| level.height_proof)),
            course: coarser.map_or_else(
                || course(placed, &problem, &solution, watch),
                |level| level.course,
            ),
            proof: None,
            load,
            fixed,
            columns,
            solution,
        });
    }
    let solved = coarser.ok_or(Error::Cancelled)?;
    let solved = prove_bound(placed, solved, watch);
    watch.check()?;
    Ok(Verdict::Found(solved))
}

/// Adds the proof of the bound on the finest columns, for tops at all heights of their centre; that
/// takes a dozen passes only.
///
/// If Spin-It's functional weighs the lever there are as many levers as heights: the proof of the
/// coarser columns stays. Filled voids and ballast have no such proof.
fn prove_bound(placed: &Placed, solved: Solved, watch: &Watch) -> Solved {
    if placed.fill != Fill::AIR {
        return solved;
    }
    let problem = Problem {
        goal: placed.goal(),
        fixed: solved.fixed,
        columns: &solved.columns,
    };
    let settings = Settings::default();
    let proof = prove(&problem, &settings, &solved.solution, &watch.muted());
    let over_heights = proof.as_ref().filter(|proof| proof.ends.is_some());
    let over_heights = over_heights.map(|proof| HeightProof {
        pitch_mm: solved.columns.pitch_mm[0],
        value: solved.solution.certificate.value,
        bound: proof.bound,
    });
    Solved {
        height_proof: over_heights.or(solved.height_proof),
        proof: proof.filter(|_| solved.load.is_empty()),
        ..solved
    }
}

/// Returns the proof for other heights that a solution carries, `None` if it carries none.
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

/// Returns the course of the first answer.
fn course(placed: &Placed, problem: &Problem, solution: &Solution, watch: &Watch) -> TopCourse {
    let is_plain = placed.fill == Fill::AIR && solution.is_usable();
    let of_top = if is_plain {
        top_course(problem, &Settings::default(), solution, &watch.muted())
    } else {
        TopCourse::default()
    };
    let passes: Vec<Pass> = if of_top.passes.is_empty() {
        solution.course.clone()
    } else {
        of_top.passes
    };
    // A field is not the least change of anything.
    let nested = placed
        .sparse
        .as_ref()
        .filter(|nested| nested.field.is_none());
    let near = nested.and_then(|nested| nested.near.as_ref());
    let near = near.filter(|_| solution.is_usable());
    TopCourse {
        passes,
        trade: near.map_or_else(Trade::default, |near| near.trade(problem, watch)),
        ..of_top
    }
}

/// Returns the pitches from coarse to fine, mm; the last is the printer's own.
fn pitches(placed: &Placed, shell: &Shell) -> Vec<[f64; 2]> {
    let finest_mm = placed.shop.pitch_mm;
    let is_coarser = |pitch: &[f64; 2]| pitch[0] > 1.5 * finest_mm[0];
    let coarse = [COARSE_COLUMNS, MIDDLE_COLUMNS].map(|n| shell.coarse_pitch(n));
    let coarse = coarse.into_iter().filter(is_coarser);
    coarse.chain([finest_mm]).collect()
}

/// Returns the hints that do not call for what was ordered already.
fn new_hints(request: &Request, hints: &[&str]) -> Vec<String> {
    let is_free = |water: Water| water.waterline == Waterline::Auto;
    let ordered = [
        ("(contact center)", request.contact == Some(Contact::Center)),
        ("(up principal)", request.up == Up::Principal),
        ("(waterline auto)", request.water.is_some_and(is_free)),
    ];
    let is_new = |hint: &&&str| {
        let mut ordered = ordered.iter();
        !ordered.any(|(option, is_ordered)| *is_ordered && hint.contains(option))
    };
    hints
        .iter()
        .filter(is_new)
        .map(ToString::to_string)
        .collect()
}

/// Returns the answer for a goal that no hollowing meets.
fn impossible(placed: &Placed, solution: &Solution) -> Impossible {
    let goal = placed.goal();
    let warnings = placed.placement.warnings.iter();
    let hints = solution.status.remedies(goal);
    Impossible {
        verdict: "impossible",
        reason: solution.status.explain(goal),
        remedies: Vec::new(),
        hints: new_hints(&placed.request, hints),
        choice: placed.choice.as_ref().map(ToString::to_string),
        proof_quadric: solution.status.separator().unwrap_or(solution.quadric).0,
        origin_mm: goal.frame.origin.into(),
        axis: goal.frame.axis().into(),
        warnings: warnings.map(ToString::to_string).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::GoalKind;

    #[test]
    fn a_hint_that_calls_for_what_was_ordered_is_not_given() {
        let hints = [
            "make it larger",
            "move the contact (contact center)",
            "turn it (up principal)",
        ];
        let usual = Request::new(GoalKind::Top);
        assert_eq!(new_hints(&usual, &hints), hints);
        let ordered = Request {
            contact: Some(Contact::Center),
            up: Up::Principal,
            ..usual
        };
        assert_eq!(new_hints(&ordered, &hints), ["make it larger"]);
    }

    #[test]
    fn every_option_in_a_hint_is_one_that_is_known() {
        let known = ["(contact center)", "(up principal)", "(waterline auto)"];
        let text = include_str!("../hollow/status.rs");
        for option in known {
            assert!(text.contains(option), "no hint has {option}");
        }
        let written = text.matches("(contact ").count()
            + text.matches("(up ").count()
            + text.matches("(waterline ").count();
        let found: usize = known
            .iter()
            .map(|option| text.matches(option).count())
            .sum();
        assert_eq!(written, found);
    }
}
