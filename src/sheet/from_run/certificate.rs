//! The certificate of the solution, and the log of the solver.

use super::facts::Facts;
use super::figures::{figure_name, in_sheet_unit};
use super::joints::bosses_mm3;
use super::voids::cleaning_rows;
use crate::goal::{GoalKind, Objective, compute_figures};
use crate::hollow;
use crate::run::{HeightProof, Placed};
use crate::sheet::{Certificate, Course, LogRow, PassRow, SpeedRow, TradeRow};
use crate::verify::{BoundPoint, BoundProof, FigureName, KeptPlace};

/// Returns the certificate in the units of the sheet.
pub fn certificate(facts: &Facts) -> Certificate {
    let certificate = &facts.made.solution.certificate;
    let figure = figure_name(certificate.figure);
    let convert = |value: f64| in_sheet_unit(facts.placed, certificate.figure, value);
    Certificate {
        figure,
        value: convert(certificate.value),
        bound: convert(certificate.bound),
        gap_ratio: certificate.gap_ratio,
        kept_solid_mm3: facts.made.refused_mm3,
        value_before_cleaning: Some(convert(facts.made.value_before_cleaning)),
        cleaning_rounds: cleaning_rows(&facts.made.cleaning, convert),
        bosses_mm3: bosses_mm3(facts),
        over_heights: facts.made.height_proof.map(height_proof),
        written_value: written_value(facts, figure),
        proof: facts
            .made
            .proof
            .as_ref()
            .filter(|proof| is_plain(facts, proof))
            .map(|proof| bound_proof(facts, proof)),
        course: course(facts, convert),
    }
}

/// Returns true if the judge knows the figure of a proof: Spin-It's functional may have other
/// weights.
fn is_plain(facts: &Facts, proof: &hollow::Proof) -> bool {
    match facts.made.solution.objective {
        Objective::SpinIt { gamma_i, .. } if proof.figure == hollow::Figure::SpinIt => {
            gamma_i == 1.0
        }
        _ => proof.figure == facts.made.solution.certificate.figure,
    }
}

/// Returns the proof of the bound in the units of the sheet.
fn bound_proof(facts: &Facts, proof: &hollow::Proof) -> BoundProof {
    let placed = facts.placed;
    let keeps = placed.placement.keeps.iter().map(|keep| KeptPlace {
        from_mm: keep.from.into(),
        to_mm: keep.to.into(),
        radius_mm: keep.radius_mm,
    });
    let point = |point: &hollow::ProofPoint| BoundPoint {
        height_mm: point.height_mm,
        weights: point.weights.clone(),
        multipliers: point.multipliers.clone(),
    };
    BoundProof {
        bound: in_sheet_unit(placed, proof.figure, proof.bound),
        wall_mm: placed.shop.wall.wall_mm,
        keeps: keeps.collect(),
        points: proof.points.iter().map(point).collect(),
        ends: proof.ends.clone(),
        edges: proof.edges.iter().map(|&([x, y], d)| [x, y, d]).collect(),
    }
}

/// Returns the course of the search in the units of the sheet; `None` if it was not recorded.
fn course(facts: &Facts, convert: impl Fn(f64) -> f64) -> Option<Course> {
    let found = &facts.made.course;
    let pass = |pass: &hollow::Pass| PassRow {
        value: convert(pass.value),
        bound: convert(pass.bound),
    };
    let speed = |&[height_mm, critical_speed_rpm]: &[f64; 2]| SpeedRow {
        height_mm,
        critical_speed_rpm,
    };
    let is_finite = |row: &PassRow| row.value.is_finite() && row.bound.is_finite();
    let passes: Vec<PassRow> = found.passes.iter().map(pass).filter(is_finite).collect();
    let speeds = found.speeds.iter().map(speed).collect();
    let trade = trade(facts.placed, &found.trade);
    (!passes.is_empty() || trade.is_some()).then_some(Course {
        passes,
        speeds,
        trade,
    })
}

/// Returns the trade of infill for a figure in the units of the sheet; `None` if there is none.
fn trade(placed: &Placed, found: &hollow::Trade) -> Option<TradeRow> {
    let figure = found.figure.filter(|_| found.points.len() > 1)?;
    let points = found.points.iter();
    let points = points.map(|&[change, value]| [change, in_sheet_unit(placed, figure, value)]);
    Some(TradeRow {
        figure: figure_name(figure),
        points: points.collect(),
        best: in_sheet_unit(placed, figure, found.best),
    })
}

/// Returns the certificate's figure of the written assembly. Spin-It's functional has the weights
/// with which it was optimised.
fn written_value(facts: &Facts, figure: FigureName) -> Option<f64> {
    let (placed, goal) = (facts.placed, &facts.placed.placement.goal);
    if figure != FigureName::SpinItRatio {
        return facts.judgement.assembly.value_of(figure);
    }
    if placed.sparse.is_some() {
        // Its regions weigh too, as the judge knows.
        let is_flatness = goal.kind == GoalKind::Yoyo;
        let judged = facts.judgement.assembly.value_of(figure);
        return judged.filter(|_| is_flatness);
    }
    let joined = placed.joining_moments(&facts.made.plan);
    let beside = joined + placed.hardware_moments() + placed.laid_beyond();
    let whole = facts.made.written_moments() + beside;
    compute_figures(goal, &whole.in_frame(&goal.frame)).spin_it
}

/// Returns a step of the solver with its finite numbers.
pub fn log_row(row: &hollow::LogRow) -> LogRow {
    let figures = [
        ("passes", row.passes as f64),
        ("value", row.value),
        ("bound", row.bound),
        ("residual", row.residual),
    ];
    let finite = figures.into_iter().filter(|(_, value)| value.is_finite());
    LogRow {
        phase: stage_words(row.stage),
        figures: finite
            .map(|(name, value)| (name.to_owned(), value))
            .collect(),
    }
}

fn stage_words(stage: hollow::Stage) -> String {
    use hollow::Stage;
    match stage {
        Stage::Goal => "goal".to_owned(),
        Stage::Dominance => "dominance".to_owned(),
        Stage::HeightRange => "range of heights".to_owned(),
        Stage::AtHeight { height_mm } => format!("centre at {height_mm:.3} mm"),
        Stage::AtLever {
            height_mm,
            lever_mm4,
        } => {
            format!("centre at {height_mm:.3} mm, lever {lever_mm4:.0} mm⁴")
        }
        Stage::Cover { height_mm } => format!("no better height near {height_mm:.3} mm"),
    }
}

fn height_proof(proof: HeightProof) -> crate::sheet::HeightProof {
    let HeightProof {
        pitch_mm,
        value,
        bound,
    } = proof;
    crate::sheet::HeightProof {
        pitch_mm,
        value,
        bound,
    }
}
