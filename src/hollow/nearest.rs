//! The density that gives a body wanted moments, or the nearest that a range of densities allows.
//!
//! The moments that densities between two bounds reach are a convex set K. The point of K nearest
//! to wanted moments w is found by its dual, in ten variables:
//!
//! ```text
//! max over u of  min over s ∈ K of u·(s − w) − ½|u|²  =  ½ (distance)²
//! ```
//!
//! Any u gives a bound of the distance. At the best, u is s − w itself, and the density has its
//! lower value where u·m > 0 and its upper value elsewhere.

use nalgebra::{DMatrix, DVector};

use super::change::{Change, least_change};
use super::dual::units::Vector10;
use super::graded::{Graded, InUnits, Row, Sense};
use super::newton::{Limits, Local, minimise};
use crate::base::verdict::Verdict;
use crate::field::DensityRange;
use crate::geom::Quadric;
use crate::interior::Columns;
use crate::mass::Moments;

/// Gradient, in units, at which the nearest point is found.
const ACCURACY: Limits = Limits {
    residual: 1e-11,
    steps: 100,
};
/// Residual of the ten rows, in units, up to which they count as met.
const MET: f64 = 1e-9;

/// The answer to wanted moments.
#[derive(Debug, Clone, PartialEq)]
pub enum Match {
    /// A density has them; this is the one nearest to the middle of the range.
    Exact(Box<Change>),
    /// None has them; this is the nearest.
    Nearest(Box<Nearest>),
}

/// The density with the nearest moments.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// The density is the lower one where this is positive, and the upper one elsewhere. In the
    /// columns' frame.
    pub quadric: Quadric,
    /// The two densities.
    pub range: DensityRange,
    /// The moments of shell and interior.
    pub moments: Moments,
    /// Distance of the moments from those wanted, in units of the solid's volume and radius of
    /// gyration.
    pub distance: f64,
    /// Lower bound of the distance for every density of the range.
    pub bound: f64,
}

/// Finds a density of the range with these ten moments, in the columns' frame, or the nearest one
/// with a bound.
///
/// `shell` are the moments of what is solid in any case. Costs 10 to 30 passes.
pub fn match_moments(
    shell: Moments,
    columns: &Columns,
    range: DensityRange,
    wanted: &Moments,
) -> Match {
    let rows = moment_rows(wanted);
    let graded = Graded {
        shell,
        columns,
        rows: &rows,
    };
    let middle = 0.5 * (range.low() + range.high());
    match least_change(&graded, range, middle) {
        Verdict::Found(change) if change.residual <= MET => Match::Exact(Box::new(change)),
        _ => Match::Nearest(Box::new(nearest(&graded, range))),
    }
}

/// Returns the ten rows that a body has these moments.
pub(super) fn moment_rows(wanted: &Moments) -> Vec<Row> {
    let one = |index: usize| Quadric(std::array::from_fn(|i| f64::from(u8::from(i == index))));
    let row = |index: usize| Row {
        quadric: one(index),
        wanted: wanted.0[index],
        sense: Sense::Equal,
    };
    (0..Moments::COUNT).map(row).collect()
}

/// Returns the density nearest to what the [`moment_rows`] ask for.
pub(super) fn nearest(graded: &Graded, range: DensityRange) -> Nearest {
    let units = InUnits::new(graded);
    let dense = units.shell + units.interior * range.high();
    let point = |u: &DVector<f64>| {
        let found = units.positive(&units.quadric(u));
        let moments: Vector10 = dense - found.moments * range.span();
        let excess = units.excess(&moments);
        let value = u.dot(&excess) - 0.5 * u.norm_squared();
        (moments, excess, value, found.derivative)
    };
    let visit = |u: &DVector<f64>| {
        let (_, excess, value, derivative) = point(u);
        let curvature = units.between_rows(&derivative) * range.span();
        Some(Local {
            value: -value,
            gradient: u - excess,
            hessian: curvature + DMatrix::identity(u.len(), u.len()),
            full_trace: units.full_trace(),
        })
    };
    let start = units.excess(&(dense - units.interior * (0.5 * range.span())));
    let found = minimise(start.clone(), &units.is_bounded, ACCURACY, visit);
    let best = found.map_or(start, |found| found.at);
    let (moments, excess, value, _) = point(&best);
    Nearest {
        quadric: units.quadric(&best),
        range,
        moments: units.to_mm(&moments),
        distance: excess.norm(),
        bound: (2.0 * value.max(0.0)).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::testing::leaning_block;

    fn range() -> DensityRange {
        DensityRange::new(0.2, 0.9).unwrap()
    }

    #[test]
    fn moments_of_some_density_are_met_exactly() {
        let columns = leaning_block(0.5);
        // Half of the block at 0.3, the other at 0.8.
        let upper = Quadric([-0.5, 0.4, 0.1, 1.0, 0., 0., 0., 0., 0., 0.]);
        let above = crate::interior::moments_where_positive(&columns, &upper);
        let wanted = above * 0.3 + (columns.moments() - above) * 0.8;
        let Match::Exact(change) = match_moments(Moments::default(), &columns, range(), &wanted)
        else {
            unreachable!("a density has them")
        };
        for (got, want) in change.moments.0.iter().zip(wanted.0) {
            assert!((got - want).abs() < 1e-7 * wanted.0[7], "{got} {want}");
        }
    }

    #[test]
    fn moments_out_of_reach_have_a_nearest_density_and_a_bound() {
        let columns = leaning_block(0.5);
        let mut wanted = columns.moments() * 0.5;
        // A centre of mass outside of the block.
        wanted.0[1] = 7.0 * wanted.0[0];
        let Match::Nearest(nearest) = match_moments(Moments::default(), &columns, range(), &wanted)
        else {
            unreachable!("no density has them")
        };
        assert!(nearest.distance > 0.1 && nearest.bound > 0.1);
        let gap = nearest.distance - nearest.bound;
        assert!(
            (-1e-9..1e-6).contains(&gap),
            "{} {}",
            nearest.distance,
            nearest.bound
        );
        // Uniform densities are farther.
        let units = InUnits::new(&Graded {
            shell: Moments::default(),
            columns: &columns,
            rows: &[],
        });
        for density in [0.2, 0.5, 0.9] {
            let far = units
                .to_units(&(columns.moments() * density - wanted))
                .norm();
            assert!(far >= nearest.bound, "{density}");
        }
    }
}
