//! A cylinder: its distance from a point, and its fit to many.

use nalgebra::SymmetricEigen;

use super::patches::{Sample, Samples};
use crate::geom::{Matrix, Point, Vector};

/// Surface points within this share of the radius, with normals within 18° of radial, are on it.
const NEAR_RATIO: f64 = 0.06;
pub(super) const RADIAL_COSINE: f64 = 0.95;
/// The number of times that the points on it are found again and fitted.
const ROUNDS: usize = 6;
/// Fewer points fit a cylinder by chance.
const LEAST_POINTS: usize = 12;
/// Coordinates of an axis that are this near to 0 or 1 are so: fits to flat facets err by less.
const ROUNDED: f64 = 2e-4;

/// A cylinder of any length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cylinder {
    /// The unit direction of its axis.
    pub axis: Vector,
    /// A point on its axis, mm.
    pub point: Point,
    /// The radius, mm.
    pub radius_mm: f64,
    /// True if the surface looks inward: a bore.
    pub is_bore: bool,
}

impl Cylinder {
    /// Fits a cylinder to surface points by their normals, then their distances.
    ///
    /// The axis is the direction in which the normals vary least. Across it every point stands a
    /// signed radius along its normal from the centre: a linear fit in closed form. `None` if the
    /// normals do not turn.
    pub fn fit(points: &[Sample]) -> Option<Self> {
        let normals = points.iter().map(|point| point.normal);
        let spread: Matrix = normals.map(|n| n * n.transpose()).sum();
        let eigen = SymmetricEigen::new(spread);
        let axis: Vector = eigen.eigenvectors.column(eigen.eigenvalues.imin()).into();
        Self::fit_about(points, &axis)
    }

    /// Fits the place and the radius of a cylinder whose axis is known.
    fn fit_about(points: &[Sample], axis: &Vector) -> Option<Self> {
        let across = |v: &Vector| v - axis * v.dot(axis);
        let radial = |point: &Sample| across(&point.normal).try_normalize(1e-6);
        let pairs: Vec<(Vector, Vector)> = points
            .iter()
            .filter_map(|point| Some((across(&point.at.coords), radial(point)?)))
            .collect();
        let share = 1.0 / pairs.len().max(1) as f64;
        let at = pairs.iter().map(|(at, _)| at).sum::<Vector>() * share;
        let turn = pairs.iter().map(|(_, normal)| normal).sum::<Vector>() * share;
        let product = |(p, n): &(Vector, Vector)| (p - at).dot(&(n - turn));
        let square = |(_, n): &(Vector, Vector)| (n - turn).norm_squared();
        let squares: f64 = pairs.iter().map(square).sum();
        if squares * share < 1e-4 {
            return None;
        }
        let signed_mm = pairs.iter().map(product).sum::<f64>() / squares;
        let along = points.iter().map(|p| p.at.coords.dot(axis)).sum::<f64>() * share;
        Some(Self {
            axis: *axis,
            point: Point::from(at - turn * signed_mm + axis * along),
            radius_mm: signed_mm.abs(),
            is_bore: signed_mm < 0.0,
        })
    }

    /// Returns the part of a point's place across the axis, mm.
    pub fn across(&self, at: &Point) -> Vector {
        let from = at - self.point;
        from - self.axis * from.dot(&self.axis)
    }

    /// Returns the height of a point along the axis, mm.
    pub fn height_mm(&self, at: &Point) -> f64 {
        (at - self.point).dot(&self.axis)
    }

    /// Returns true if a surface point with this normal lies on it, within a share of the radius.
    pub fn holds(&self, at: &Point, normal: &Vector, near_ratio: f64) -> bool {
        let across = self.across(at);
        let distance_mm = across.norm();
        let outward = across.dot(normal) / distance_mm.max(f64::MIN_POSITIVE);
        let looks = if self.is_bore { -outward } else { outward };
        (distance_mm - self.radius_mm).abs() <= near_ratio * self.radius_mm
            && looks >= RADIAL_COSINE
    }

    /// Fits it again and again to the points on it; `None` if too few are, or they spread.
    pub fn refined(&self, samples: &Samples) -> Option<Self> {
        let mut fitted = *self;
        for _ in 0..ROUNDS {
            let on_it: Vec<Sample> = samples
                .all()
                .filter(|point| fitted.holds(&point.at, &point.normal, NEAR_RATIO))
                .collect();
            if on_it.len() < LEAST_POINTS {
                return None;
            }
            let next = Self::fit(&on_it)?;
            if next.is_bore != self.is_bore {
                return None;
            }
            fitted = next;
        }
        Some(fitted)
    }

    /// Returns the axis with its largest coordinate positive, without rounding noise.
    pub fn rounded_axis(&self) -> Vector {
        let axis = self.axis * self.axis[self.axis.iamax()].signum();
        let rounded = axis.map(|part| if part.abs() < ROUNDED { 0.0 } else { part });
        rounded.normalize()
    }
}
