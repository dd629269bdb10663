//! The proof of a bound as plain numbers, for a judge who has no solver.

use nalgebra::{DMatrix, DVector};

use super::dual::answer::Conversion;
use super::dual::programme::{DualPoint, Programme};
use super::dual::units::{Scale, degree};
use super::dual::work::Work;
use super::goals::balance;
use super::problem::{Problem, Settings};
use super::solution::{Figure, Solution};
use super::top::{self, Proved};
use crate::base::watch::Watch;
use crate::goal::{GoalKind, Objective, support_edges};

/// The proof that no interior is better than a bound, as points of the dual.
///
/// Whoever knows the goal can build a quadric g = n + Jᵀy − τe + Aᵀλ from a point and any τ. If
/// g·s ≥ b·λ for the least s, the one with { g·m > 0 } emptied, then no interior has a ratio below
/// τ. See [`crate::guide::theory`].
///
/// Lengths are in mm and the goal's frame. The rows are those of the table in [`crate::hollow`].
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The figure that is bounded.
    pub figure: Figure,
    /// The value that no interior can beat.
    pub bound: f64,
    /// The points: one, or for a top one for each of several heights.
    pub points: Vec<ProofPoint>,
    /// Tops: the multipliers that prove the least and the greatest height of the centre.
    pub ends: Option<[Vec<f64>; 2]>,
    /// Toppling angle: the edges of the support that the weights are for, each an inward unit
    /// normal and the offset along it, mm.
    pub edges: Vec<([f64; 2], f64)>,
}

/// A point of the dual.
#[derive(Debug, Clone, PartialEq)]
pub struct ProofPoint {
    /// Tops: the height at which the tensor is linear, mm.
    pub height_mm: Option<f64>,
    /// The weights y.
    pub weights: Vec<f64>,
    /// The multipliers λ: the unit of the numerator over that of the row.
    pub multipliers: Vec<f64>,
}

/// Returns the proof that nothing beats a known solution on these columns.
///
/// It costs nothing, but for tops as much as [`super::bound_over_heights`]. `None` if the proof
/// fails, or if the answer is none that can be used. There is none either where Spin-It's
/// functional weighs the lever of a top: it has as many levers as heights.
#[must_use]
pub fn prove(
    problem: &Problem,
    settings: &Settings,
    known: &Solution,
    watch: &Watch,
) -> Option<Proof> {
    if !known.is_usable() {
        return None;
    }
    rayon::scope(|_| {
        let work = Work::new(problem, settings, watch);
        match problem.goal.kind {
            GoalKind::Top => prove_top(&work, known),
            _ => prove_other(&work, known),
        }
    })
}

fn prove_top(work: &Work, known: &Solution) -> Option<Proof> {
    let is_weighed = matches!(known.objective, Objective::SpinIt { gamma_c, .. } if gamma_c > 0.0);
    if is_weighed {
        return None;
    }
    let Proved { bound, posts, ends } = top::prove_bound_near(work, known.objective, &known.warm)?;
    let scale = work.reach.scale;
    let axis = Programme::top_height(&work.reach, 1.0).rows;
    let in_mm = |point: &DualPoint, degree: i32| {
        to_mm(scale, &axis, value_unit(scale, degree), &point.lambda)
    };
    let figure = known.certificate.figure;
    let moments = scale.moments_to_units(&known.moments);
    let conversion = Conversion {
        work,
        objective: known.objective,
        figure,
    };
    let points = posts.iter().map(|post| ProofPoint {
        height_mm: Some(work.to_mm(post.at)),
        weights: post.point.y.iter().copied().collect(),
        multipliers: in_mm(&post.point, 2),
    });
    Some(Proof {
        figure,
        bound: conversion.figure_of(&moments, bound),
        points: points.collect(),
        ends: Some([in_mm(&ends[0], 1), in_mm(&ends[1], 1)]),
        edges: Vec::new(),
    })
}

fn prove_other(work: &Work, known: &Solution) -> Option<Proof> {
    let programme = programme_of(work, known.objective)?;
    let point = &known.warm.point;
    let fits =
        point.y.len() == programme.directions.nrows() && point.lambda.len() == programme.rhs.len();
    if !fits {
        return None;
    }
    let scale = work.reach.scale;
    // The height of what floats is a length: its mass is known.
    let unit = match known.objective {
        Objective::MetacentricHeight => scale.length_mm,
        _ => value_unit(scale, degree_of_value(&programme)),
    };
    let edges: Vec<([f64; 2], f64)> = match known.objective {
        Objective::TopplingAngle => support_edges(&work.goal.support),
        _ => Vec::new(),
    };
    let is_used = |index: &usize| edges.is_empty() || point.y[*index] > 0.0;
    let used: Vec<usize> = (0..point.y.len()).filter(is_used).collect();
    Some(Proof {
        figure: known.certificate.figure,
        bound: known.certificate.bound,
        points: vec![ProofPoint {
            height_mm: None,
            weights: used.iter().map(|&index| point.y[index]).collect(),
            multipliers: to_mm(scale, &programme.rows, unit, &point.lambda),
        }],
        ends: None,
        edges: used
            .iter()
            .filter_map(|&index| edges.get(index).copied())
            .collect(),
    })
}

/// Returns the programme of an objective, but for tops.
fn programme_of(work: &Work, objective: Objective) -> Option<Programme> {
    let reach = &work.reach;
    match objective {
        Objective::SpinIt { .. } => Some(Programme::yoyo_functional(reach)),
        Objective::Dominance => Some(Programme::yoyo_dominance(reach)),
        Objective::TopplingAngle => Some(Programme::stand_toppling(reach, work.goal)),
        Objective::LowestCenter => Some(Programme::stand_lowest_center(reach)),
        Objective::MetacentricHeight => {
            let afloat = work.goal.afloat.as_ref()?;
            Some(Programme::float_lowest_center(reach, afloat))
        }
        Objective::LeastRemoved => Some(Programme::balance_least_removed()),
        Objective::LeastUnbalance => {
            let ends = balance::ends(work, work.goal.spindle.as_ref()?);
            Some(Programme::balance_unbalance(reach, ends))
        }
        Objective::CriticalSpeed | Objective::LeastChange => None,
    }
}

/// Returns one unit of a moment of this degree, in mm.
fn value_unit(scale: Scale, degree: i32) -> f64 {
    scale.volume_mm3 * scale.length_mm.powi(degree)
}

/// Returns the degree of the moments in a programme's numerator.
fn degree_of_value(programme: &Programme) -> i32 {
    let directions = programme.directions.row_iter();
    let degrees = directions.map(|row| degree(row.iter().copied()));
    let numerator = degree(programme.numerator.iter().copied());
    degrees.fold(numerator, i32::max)
}

/// Returns multipliers over mm: each times the unit of the value over that of its row.
fn to_mm(scale: Scale, rows: &DMatrix<f64>, value_unit_mm: f64, lambda: &DVector<f64>) -> Vec<f64> {
    let factor = |row: usize| {
        let degree = degree(rows.row(row).iter().copied());
        value_unit_mm / value_unit(scale, degree)
    };
    (0..lambda.len())
        .map(|row| lambda[row] * factor(row))
        .collect()
}
