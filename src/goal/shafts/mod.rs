//! Bores and shaft ends: the round surfaces that a rotor can turn on.
//!
//! The search follows the usual way from points to primitives (R. Schnabel, R. Wahl, R. Klein,
//! "Efficient RANSAC for point-cloud shape detection", Computer Graphics Forum 26, 2007). Instead
//! of random triples it fits a cylinder to every patch of several sizes, and counts which
//! cylinders many patches agree on.
//!
//! The files, in reading order:
//!
//! * `patches`: points spread over the surface, and patches of them
//!
//! * `cylinder`: a cylinder, its distance from a point, and its fit to many
//!
//! * `vote`: the cylinder that fits a patch, and those on which many patches agree
//!
//! * `round`: the part of a cylinder that the mesh really covers, all around
//!
//! The answer is the same for any number of threads.

mod cylinder;
mod patches;
mod round;
#[cfg(test)]
mod tests;
mod vote;

use std::fmt;

use rayon::prelude::*;

use super::sites::{SpinPoint, Up};
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Point, Vector};
use crate::mesh::Solid;
use cylinder::Cylinder;
use patches::Samples;
use round::{Measured, measure};

pub use round::{RoundKind, RoundSurface};

/// Axes within 1.5° and half a millimetre, or 5 % of the smaller radius, are one.
const SAME_COSINE: f64 = 0.99966;
const SAME_MM: f64 = 0.5;
const SAME_RATIO: f64 = 0.05;

/// The decimals of an axis as it is typed: over a metre the last is a tenth of a millimetre.
/// Those of a point give it to half a micrometre.
const DIRECTION_DECIMALS: i32 = 4;
const POINT_DECIMALS: i32 = 3;

/// Rounds a number, without a negative zero.
fn round(number: f64, decimals: i32) -> f64 {
    let unit = 10f64.powi(decimals);
    (number * unit).round() / unit + 0.0
}

/// An axis on which a rotor can turn.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftAxis {
    /// Its unit direction; its largest coordinate is positive.
    pub direction: Vector,
    /// A point on it: the middle of its largest surface, mm.
    pub point: Point,
    /// The round surfaces about it, the largest first.
    pub surfaces: Vec<RoundSurface>,
}

impl ShaftAxis {
    /// Returns its direction as it is typed.
    pub fn up(&self) -> Up {
        Up::of(&self.direction.map(|part| round(part, DIRECTION_DECIMALS)))
    }

    /// Returns its point as it is typed.
    pub fn spin_point(&self) -> SpinPoint {
        let point = self.point.coords.map(|mm| round(mm, POINT_DECIMALS));
        SpinPoint::At(point.into())
    }

    /// Returns the settings that order it.
    pub fn settings(&self) -> [Setting; 2] {
        [
            Setting::new(Key::Up, self.up()),
            Setting::new(Key::SpinPoint, self.spin_point()),
        ]
    }

    /// Words its round surfaces, the largest first.
    pub fn describe_surfaces(&self) -> String {
        let words: Vec<String> = self.surfaces.iter().map(ToString::to_string).collect();
        words.join(", ")
    }

    /// Returns true if a line runs along this axis, within 1.5°. At the surfaces it passes within
    /// half a millimetre or 5 % of their radius.
    pub fn is_along(&self, point: &Point, direction: &Vector) -> bool {
        let least_mm = self.surfaces.iter().map(|surface| surface.diameter_mm);
        let radius_mm = 0.5 * least_mm.fold(f64::INFINITY, f64::min);
        let off_mm = (self.point - point).cross(direction).norm();
        self.direction.dot(direction).abs() >= SAME_COSINE
            && off_mm <= SAME_MM.max(SAME_RATIO * radius_mm)
    }
}

/// Axes on which a rotor can turn, each as a remedy that is typed.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftList(pub Vec<ShaftAxis>);

impl fmt::Display for ShaftList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|axis| {
            let [up, point] = axis.settings();
            write!(
                f,
                "; remedy: `{up}` `{point}` ({})",
                axis.describe_surfaces()
            )
        })
    }
}

/// Returns the axes on which a model can turn: those of its round bores and shaft ends, the largest
/// first.
///
/// A bore counts if at least a tenth of its diameter is round over three quarters of the turn. A
/// shaft end must be round over half its diameter and stand clear of the rest. Bores smaller than
/// about 2 % of the model may be missed. Takes about 0.3 s, hardly more for large meshes.
///
/// # Errors
/// The watch was stopped.
pub fn find_shafts(solid: &Solid, watch: &Watch) -> Result<Vec<ShaftAxis>, Cancelled> {
    let samples = Samples::of(solid.mesh());
    let votes = vote::count(&samples, watch)?;
    let measured = votes.par_iter().map(|cylinder| {
        watch.check()?;
        let fitted = cylinder.refined(&samples);
        Ok(fitted.map_or_else(Vec::new, |fitted| measure(solid.mesh(), &fitted)))
    });
    let measured: Vec<Vec<Measured>> = measured.collect::<Result<_, Cancelled>>()?;
    let mut measured: Vec<Measured> = measured.into_iter().flatten().collect();
    measured.sort_by(|a, b| b.round_mm2.total_cmp(&a.round_mm2));
    Ok(merge(&measured))
}

/// Joins round surfaces about one axis, and drops what repeats a larger one.
fn merge(measured: &[Measured]) -> Vec<ShaftAxis> {
    let mut axes: Vec<ShaftAxis> = Vec::new();
    for one in measured {
        let Cylinder { axis, point, .. } = one.cylinder;
        let same = axes.iter_mut().find(|known| known.is_along(&point, &axis));
        match same {
            Some(known) if known.surfaces.iter().any(|known| repeats(known, one)) => {}
            Some(known) => known.surfaces.push(one.surface),
            None => axes.push(ShaftAxis {
                direction: one.cylinder.rounded_axis(),
                point: one.surface.middle,
                surfaces: vec![one.surface],
            }),
        }
    }
    axes
}

/// Two fits to one surface differ by no more of its diameter.
const REPEATED_RATIO: f64 = 0.12;

/// Returns true if a surface is the one that is known, or a part of it.
fn repeats(known: &RoundSurface, new: &Measured) -> bool {
    let new = &new.surface;
    let apart_mm = (known.middle - new.middle).norm();
    known.kind == new.kind
        && (known.diameter_mm - new.diameter_mm).abs() <= REPEATED_RATIO * known.diameter_mm
        && apart_mm <= 0.5 * (known.length_mm + new.length_mm)
}
