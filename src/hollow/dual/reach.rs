//! The reachable set K of moments: its extreme point along any direction, and the derivative.

use std::borrow::Cow;
use std::cell::Cell;

use rayon::prelude::*;

use super::mend::Mend;
use super::units::{Extreme, Scale, Vector10, index};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Frame, Quadric};
use crate::interior::{Columns, Matrix10, moments_and_derivative, moments_where_positive};
use crate::mass::Moments;

/// A denser material that may replace the printed one, at a price.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Heavy {
    /// Density over that of the printed material; above 1.
    pub density_ratio: f64,
    /// Price of the solid's volume of it, in the units of the programme's value.
    pub price: f64,
}

/// The set K = { s_fixed − ∫β m : 0 ≤ β ≤ 1 } over the columns, and a count of the passes made over
/// it.
///
/// With a heavy material, β may be negative, as far as its density allows. See [theory
/// §1](crate::guide::theory#1-the-reachable-set).
pub(crate) struct Reach<'a> {
    columns: Cow<'a, Columns>,
    /// Map of moments from the columns' coordinates to the goal's; `None` if they are the same.
    transform: Option<Matrix10>,
    heavy: Option<Heavy>,
    mend: Option<Mend>,
    pub scale: Scale,
    /// Moments with nothing emptied.
    pub solid: Vector10,
    /// Moments with everything emptied: the least volume and second moments.
    pub shell: Vector10,
    /// Moments with everything as heavy as possible: the greatest volume and second moments.
    pub fullest: Vector10,
    passes: Cell<usize>,
}

impl<'a> Reach<'a> {
    pub fn new(columns: &'a Columns, fixed: &Moments, scale: Scale) -> Self {
        let solid = scale.moments_to_units(fixed);
        let (transform, heavy, mend, passes) = (None, None, None, Cell::new(0));
        let columns = Cow::Borrowed(columns);
        Self {
            columns,
            transform,
            heavy,
            mend,
            scale,
            solid,
            shell: solid,
            fullest: solid,
            passes,
        }
        .with_outermost()
    }

    /// Returns true if there is a heavy material.
    pub fn has_heavy(&self) -> bool {
        self.heavy.is_some()
    }

    /// Returns the number of columns in a pass.
    pub fn columns(&self) -> usize {
        self.columns.len()
    }

    /// Returns the set over every `step`-th column of every `step`-th row. Keeps the outermost
    /// moments of all columns.
    pub fn thin(&self, step: usize) -> Self {
        let columns = Cow::Owned(self.columns.thinned(step));
        Self {
            columns,
            mend: None,
            passes: Cell::new(0),
            ..*self
        }
    }

    /// Maps the set so that its extreme point and derivative along g are those of all columns.
    pub fn mend_at(self, g: &Vector10, all: &Extreme) -> Self {
        let mend = Mend::new(g, all, |g| self.plain_extreme(g));
        Self {
            mend: Some(mend),
            ..self
        }
    }

    /// Takes the columns as given in model coordinates; all else stays in the coordinates of
    /// `frame`.
    ///
    /// Moments transform linearly with the frame, s = T s_columns. So the quadric transforms with
    /// Tᵀ, and its derivative with both.
    pub fn of_model_columns(self, frame: &Frame) -> Self {
        let transformed =
            |i: usize| Vector10::from(Moments(Vector10::ith(i, 1.0).into()).in_frame(frame).0);
        let transform = Matrix10::from_columns(&std::array::from_fn::<_, 10, _>(transformed));
        Self {
            transform: Some(transform),
            ..self
        }
        .with_outermost()
    }

    /// Adds a heavy material.
    pub fn with_heavy(self, heavy: Heavy) -> Self {
        Self {
            heavy: Some(heavy),
            ..self
        }
        .with_outermost()
    }

    /// Computes the outermost moments of the set.
    fn with_outermost(mut self) -> Self {
        let interior = self.moments_of(&self.scale.quadric_to_mm(&Vector10::ith(index::ONE, 1.0)));
        self.shell = self.solid - interior;
        self.fullest =
            self.solid + interior * self.heavy.map_or(0.0, |heavy| heavy.density_ratio - 1.0);
        self
    }

    /// Returns the extreme point along g and its derivative; one pass, two with a heavy material.
    pub fn extreme(&self, g: &Vector10) -> Extreme {
        let Some(mend) = self.mend else {
            return self.plain_extreme(g);
        };
        mend.extreme(&self.plain_extreme(&mend.direction(g)))
    }

    fn plain_extreme(&self, g: &Vector10) -> Extreme {
        let quadric = self.scale.quadric_to_mm(g);
        let (emptied, w) = self.region(&quadric);
        let lightest = Extreme {
            s: self.solid - emptied,
            w,
            cost: 0.0,
        };
        let Some(heavy) = self.heavy else {
            return lightest;
        };
        let (filled, derivative) = self.region(&self.heavy_region(&quadric, heavy));
        let excess = heavy.density_ratio - 1.0;
        Extreme {
            s: lightest.s + filled * excess,
            w: lightest.w + derivative * excess,
            cost: heavy.price * filled[index::ONE],
        }
    }

    /// Returns the extreme point along g alone; the passes are cheaper.
    pub fn least(&self, g: &Vector10) -> Vector10 {
        let Some(mend) = self.mend else {
            return self.plain_least(g);
        };
        mend.point(&self.plain_least(&mend.direction(g)))
    }

    fn plain_least(&self, g: &Vector10) -> Vector10 {
        let quadric = self.scale.quadric_to_mm(g);
        let emptied = self.solid - self.moments_of(&quadric);
        let filled = |heavy: Heavy| {
            self.moments_of(&self.heavy_region(&quadric, heavy)) * (heavy.density_ratio - 1.0)
        };
        self.heavy.map_or(emptied, |heavy| emptied + filled(heavy))
    }

    /// Returns the extreme points along many directions, in parallel; one cheaper pass each.
    /// Ignores the heavy material.
    pub fn least_of_each(
        &self,
        directions: &[Vector10],
        watch: &Watch,
    ) -> Result<Vec<Vector10>, Cancelled> {
        self.passes.set(self.passes.get() + directions.len());
        let (columns, transform, scale, solid) =
            (&self.columns, self.transform, self.scale, self.solid);
        let over_columns = |g: &Vector10| over_columns(transform.as_ref(), &scale.quadric_to_mm(g));
        let emptied = |g: &Vector10| {
            watch.check()?;
            Ok(moments_where_positive(columns, &over_columns(g)))
        };
        let emptied = directions.par_iter().map(emptied);
        let emptied = emptied.collect::<Result<Vec<Moments>, Cancelled>>()?;
        let least = |moments: &Moments| solid - self.to_units(*moments);
        Ok(emptied.iter().map(least).collect())
    }

    /// Returns the quadric that is positive where the heavy material is worth its price.
    ///
    /// There the quadric of g is so far below zero that the gain over the printed material exceeds
    /// the price.
    fn heavy_region(&self, quadric: &Quadric, heavy: Heavy) -> Quadric {
        let mut filled = quadric.0.map(|coefficient| -coefficient);
        filled[index::ONE] -= heavy.price / (self.scale.volume_mm3 * (heavy.density_ratio - 1.0));
        Quadric(filled)
    }

    /// Returns the quadric, mm, that is positive where the extreme interior of g has the heavy
    /// material; `None` if there is no heavy material.
    pub fn heavy_quadric(&self, g: &Vector10) -> Option<Quadric> {
        self.heavy
            .map(|heavy| self.heavy_region(&self.scale.quadric_to_mm(g), heavy))
    }

    /// Returns true if no material has a price. Only then does a dual value that grows without
    /// bound prove anything.
    pub fn is_free(&self) -> bool {
        self.heavy.is_none_or(|heavy| heavy.price == 0.0)
    }

    /// Returns the moments where a quadric in the goal's coordinates is positive, and their
    /// derivative by it; one pass.
    fn region(&self, quadric: &Quadric) -> (Vector10, Matrix10) {
        self.passes.set(self.passes.get() + 1);
        let (moments, derivative) = moments_and_derivative(
            &self.columns,
            &over_columns(self.transform.as_ref(), quadric),
        );
        let derivative = self.transform.map_or(derivative, |transform| {
            transform * derivative * transform.transpose()
        });
        let unit = self.scale.units().map(f64::recip);
        let w = derivative.zip_map(&(unit * unit.transpose()), |entry, factor| entry * factor);
        (self.to_units(moments), w)
    }

    /// Returns these moments alone; one cheaper pass.
    fn moments_of(&self, quadric: &Quadric) -> Vector10 {
        self.passes.set(self.passes.get() + 1);
        self.to_units(moments_where_positive(
            &self.columns,
            &over_columns(self.transform.as_ref(), quadric),
        ))
    }

    /// Converts moments from the columns' coordinates to the solver's.
    fn to_units(&self, moments: Moments) -> Vector10 {
        let transformed = self.transform.map_or(moments, |transform| {
            Moments((transform * Vector10::from(moments.0)).into())
        });
        self.scale.moments_to_units(&transformed)
    }

    /// Returns the number of passes made over the columns.
    pub fn passes(&self) -> usize {
        self.passes.get()
    }
}

/// Converts a quadric from the goal's coordinates to the columns' own.
fn over_columns(transform: Option<&Matrix10>, quadric: &Quadric) -> Quadric {
    transform.map_or(*quadric, |transform| {
        Quadric(transform.tr_mul(&Vector10::from(quadric.0)).into())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::Objective;
    use crate::hollow::worlds;

    #[test]
    fn no_other_quadric_empties_to_a_lower_point() {
        let world = worlds::egg(Objective::Dominance);
        let scale = Scale::of(&world.fixed);
        let reach = Reach::new(&world.columns, &world.fixed, scale);
        let along = |seed| Vector10::from(worlds::some_quadric(seed, 1.0).0);
        for seed in 0..20 {
            let g = along(seed);
            let least = g.dot(&reach.extreme(&g).s);
            assert!(
                (20..80).all(|other| g.dot(&reach.least(&along(other))) >= least - 1e-12),
                "{seed}"
            );
        }
    }

    #[test]
    fn moments_and_quadrics_keep_their_product_from_unit_to_unit() {
        let world = worlds::egg(Objective::Dominance);
        let scale = Scale::of(&world.fixed);
        let g = Vector10::from(worlds::some_quadric(3, 1.0).0);
        let s = scale.moments_to_units(&world.fixed);
        let in_mm: f64 = scale
            .quadric_to_mm(&g)
            .0
            .iter()
            .zip(world.fixed.0)
            .map(|(g, s)| g * s)
            .sum();
        assert!((in_mm - g.dot(&s)).abs() < 1e-12);
        assert!((scale.moments_to_mm(&s).0[9] / world.fixed.0[9] - 1.0).abs() < 1e-14);
        assert!((s[0] - 1.0).abs() < 1e-14 && (s[7] + s[8] + s[9] - 1.0).abs() < 1e-14);
    }
}
