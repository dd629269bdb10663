//! The reachable set K of moments: for any direction, the extreme interior and how it turns with the direction.

use std::cell::Cell;

use nalgebra::SVector;

use crate::geom::Quadric;
use crate::interior::{Columns, Matrix10, moments_and_derivative, moments_where_positive};
use crate::mass::Moments;

/// Ten numbers over the monomials of the moments, in the solver's own units.
pub(super) type Vector10 = SVector<f64, 10>;

/// The degree of each of the ten monomials.
const DEGREES: [i32; 10] = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2];

/// The solver's own units: the solid's volume, and its radius of gyration about the goal's origin. In them all ten
/// moments are of the order of one, so one tolerance and one damping serve every row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub volume_mm3: f64,
    pub length_mm: f64,
}

impl Scale {
    pub fn of(solid: &Moments) -> Self {
        let squares = solid.second().trace();
        Self { volume_mm3: solid.volume(), length_mm: (squares / solid.volume()).sqrt() }
    }

    /// What one unit of each moment is in mm.
    fn units(&self) -> Vector10 {
        Vector10::from_fn(|i, _| self.volume_mm3 * self.length_mm.powi(DEGREES[i]))
    }

    pub fn moments_to_units(&self, moments: &Moments) -> Vector10 {
        Vector10::from(moments.0).component_div(&self.units())
    }

    pub fn moments_to_mm(&self, moments: &Vector10) -> Moments {
        Moments(moments.component_mul(&self.units()).into())
    }

    /// The same quadric over mm; its values are left unchanged but for the volume's factor.
    pub fn quadric_to_mm(&self, quadric: &Vector10) -> Quadric {
        Quadric(quadric.component_div(&self.units()).into())
    }
}

/// The set K = { s_fixed − ∫β m : 0 ≤ β ≤ 1 } over the columns (THEORY §2), and a count of the passes made over it.
pub(super) struct Reach<'a> {
    columns: &'a Columns,
    pub scale: Scale,
    /// The moments with nothing emptied: the component-wise greatest of all squares and of the volume.
    pub solid: Vector10,
    /// The moments with everything emptied: the least of them.
    pub shell: Vector10,
    passes: Cell<usize>,
}

/// The point of K least along a direction g: the interior with { g·m > 0 } emptied.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extreme {
    /// Its moments.
    pub s: Vector10,
    /// −∂s/∂g, positive semidefinite.
    pub w: Matrix10,
}

impl<'a> Reach<'a> {
    pub fn new(columns: &'a Columns, fixed: &Moments, scale: Scale) -> Self {
        let solid = scale.moments_to_units(fixed);
        let mut reach = Self { columns, scale, solid, shell: solid, passes: Cell::new(0) };
        reach.shell = reach.least(&Vector10::ith(0, 1.0));
        reach
    }

    /// The extreme point along g and its derivative; one pass.
    pub fn extreme(&self, g: &Vector10) -> Extreme {
        self.passes.set(self.passes.get() + 1);
        let (emptied, derivative) = moments_and_derivative(self.columns, &self.scale.quadric_to_mm(g));
        let unit = self.scale.units().map(f64::recip);
        let w = derivative.zip_map(&(unit * unit.transpose()), |entry, factor| entry * factor);
        Extreme { s: self.solid - self.scale.moments_to_units(&emptied), w }
    }

    /// The extreme point along g alone; one cheaper pass.
    pub fn least(&self, g: &Vector10) -> Vector10 {
        self.passes.set(self.passes.get() + 1);
        let emptied = moments_where_positive(self.columns, &self.scale.quadric_to_mm(g));
        self.solid - self.scale.moments_to_units(&emptied)
    }

    /// How many passes over the columns have been made.
    pub fn passes(&self) -> usize {
        self.passes.get()
    }
}

#[cfg(test)]
mod tests {
    use super::super::worlds;
    use super::*;
    use crate::goal::Objective;

    #[test]
    fn no_other_quadric_empties_to_a_lower_point() {
        let world = worlds::egg(Objective::Dominance);
        let scale = Scale::of(&world.fixed);
        let reach = Reach::new(&world.columns, &world.fixed, scale);
        let along = |seed| Vector10::from(worlds::some_quadric(seed, 1.0).0);
        for seed in 0..20 {
            let g = along(seed);
            let least = g.dot(&reach.extreme(&g).s);
            assert!((20..80).all(|other| g.dot(&reach.least(&along(other))) >= least - 1e-12), "{seed}");
        }
    }

    #[test]
    fn moments_and_quadrics_keep_their_product_from_unit_to_unit() {
        let world = worlds::egg(Objective::Dominance);
        let scale = Scale::of(&world.fixed);
        let g = Vector10::from(worlds::some_quadric(3, 1.0).0);
        let s = scale.moments_to_units(&world.fixed);
        let in_mm: f64 = scale.quadric_to_mm(&g).0.iter().zip(world.fixed.0).map(|(g, s)| g * s).sum();
        assert!((in_mm - g.dot(&s)).abs() < 1e-12);
        assert!((scale.moments_to_mm(&s).0[9] / world.fixed.0[9] - 1.0).abs() < 1e-14);
        assert!((s[0] - 1.0).abs() < 1e-14 && (s[7] + s[8] + s[9] - 1.0).abs() < 1e-14);
    }
}
