//! The reachable set K of moments: for any direction, the extreme interior and how it turns with
//! the direction.

use std::borrow::Cow;
use std::cell::Cell;

use rayon::prelude::*;

use super::mend::Mend;
use super::units::{Extreme, Scale, Vector10, index};
use crate::geom::{Frame, Quadric};
use crate::interior::{Columns, Matrix10, moments_and_derivative, moments_where_positive};
use crate::mass::Moments;

/// A denser material that may take the place of the printed one, at a price.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Heavy {
    /// Its density over that of the printed material; above 1.
    pub density_ratio: f64,
    /// What as much of it as the solid's volume costs, in the units of the programme's value.
    pub price: f64,
}

/// The set K = { s_fixed − ∫β m : 0 ≤ β ≤ 1 } over the columns (THEORY §2), and a count of the
/// passes made over it; with a heavy material, β may also be as far below zero as its density
/// allows.
pub(crate) struct Reach<'a> {
    columns: Cow<'a, Columns>,
    /// From moments in the columns' coordinates to moments in the goal's; none where they are the
    /// same.
    turn: Option<Matrix10>,
    heavy: Option<Heavy>,
    mend: Option<Mend>,
    pub scale: Scale,
    /// The moments with nothing emptied.
    pub solid: Vector10,
    /// The moments with everything emptied: the least of all squares and of the volume.
    pub shell: Vector10,
    /// The moments with everything as heavy as may be: the greatest of them.
    pub fullest: Vector10,
    passes: Cell<usize>,
}

impl<'a> Reach<'a> {
    pub fn new(columns: &'a Columns, fixed: &Moments, scale: Scale) -> Self {
        let solid = scale.moments_to_units(fixed);
        let (turn, heavy, mend, passes) = (None, None, None, Cell::new(0));
        let columns = Cow::Borrowed(columns);
        Self {
            columns,
            turn,
            heavy,
            mend,
            scale,
            solid,
            shell: solid,
            fullest: solid,
            passes,
        }
        .bounded()
    }

    /// Whether there is a heavy material to be had.
    pub fn has_heavy(&self) -> bool {
        self.heavy.is_some()
    }

    /// How many columns a pass goes over.
    pub fn columns(&self) -> usize {
        self.columns.len()
    }

    /// The set as a `step`² times smaller number of its columns shows it, with the outermost
    /// moments of all of them.
    pub fn thinned(&self, step: usize) -> Self {
        let columns = Cow::Owned(self.columns.thinned(step));
        Self {
            columns,
            mend: None,
            passes: Cell::new(0),
            ..*self
        }
    }

    /// The same set, mapped so that it has the extreme point and the derivative that all columns
    /// have along g.
    pub fn mended(self, g: &Vector10, all: &Extreme) -> Self {
        let mend = Mend::new(g, all, |g| self.plain_extreme(g));
        Self {
            mend: Some(mend),
            ..self
        }
    }

    /// The same for columns given in model coordinates, while everything else is in the coordinates
    /// of `frame`.
    ///
    /// Moments turn linearly with the frame, s = T s_columns, so the quadric turns with Tᵀ and its
    /// derivative with both.
    pub fn of_model_columns(self, frame: &Frame) -> Self {
        let seen =
            |i: usize| Vector10::from(Moments(Vector10::ith(i, 1.0).into()).in_frame(frame).0);
        let turn = Matrix10::from_columns(&std::array::from_fn::<_, 10, _>(seen));
        Self {
            turn: Some(turn),
            ..self
        }
        .bounded()
    }

    /// The same with a heavy material to be had.
    pub fn with(self, heavy: Heavy) -> Self {
        Self {
            heavy: Some(heavy),
            ..self
        }
        .bounded()
    }

    /// The same with its outermost moments.
    fn bounded(mut self) -> Self {
        let interior = self.moments_of(&self.scale.quadric_to_mm(&Vector10::ith(index::ONE, 1.0)));
        self.shell = self.solid - interior;
        self.fullest =
            self.solid + interior * self.heavy.map_or(0.0, |heavy| heavy.density_ratio - 1.0);
        self
    }

    /// The extreme point along g and its derivative; one pass, two where there is a heavy material.
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
        let (filled, turning) = self.region(&self.filled(&quadric, heavy));
        let excess = heavy.density_ratio - 1.0;
        Extreme {
            s: lightest.s + filled * excess,
            w: lightest.w + turning * excess,
            cost: heavy.price * filled[index::ONE],
        }
    }

    /// The extreme point along g alone; cheaper passes.
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
            self.moments_of(&self.filled(&quadric, heavy)) * (heavy.density_ratio - 1.0)
        };
        self.heavy.map_or(emptied, |heavy| emptied + filled(heavy))
    }

    /// The extreme points along many directions, where there is no heavy material; a cheaper pass
    /// each, side by side.
    pub fn least_of_each(&self, directions: &[Vector10]) -> Vec<Vector10> {
        self.passes.set(self.passes.get() + directions.len());
        let (columns, turn, scale, solid) = (&self.columns, self.turn, self.scale, self.solid);
        let over_columns = |g: &Vector10| over_columns(turn.as_ref(), &scale.quadric_to_mm(g));
        let emptied = |g: &Vector10| moments_where_positive(columns, &over_columns(g));
        let emptied: Vec<Moments> = directions.par_iter().map(emptied).collect();
        emptied
            .iter()
            .map(|moments| solid - self.seen(*moments))
            .collect()
    }

    /// Where the heavy material is worth its price: the quadric of g must be so far below zero that
    /// what it gains more than the printed one pays for it.
    fn filled(&self, quadric: &Quadric, heavy: Heavy) -> Quadric {
        let mut filled = quadric.0.map(|coefficient| -coefficient);
        filled[index::ONE] -= heavy.price / (self.scale.volume_mm3 * (heavy.density_ratio - 1.0));
        Quadric(filled)
    }

    /// The quadric, mm, that is positive where the extreme interior of g has the heavy material;
    /// none without one.
    pub fn filled_by(&self, g: &Vector10) -> Option<Quadric> {
        self.heavy
            .map(|heavy| self.filled(&self.scale.quadric_to_mm(g), heavy))
    }

    /// Whether nothing has to be paid for, so that a dual value that grows without bound is a
    /// proof.
    pub fn is_free(&self) -> bool {
        self.heavy.is_none_or(|heavy| heavy.price == 0.0)
    }

    /// The moments of the columns where a quadric of the goal's coordinates is positive, and their
    /// derivative by it; one pass.
    fn region(&self, quadric: &Quadric) -> (Vector10, Matrix10) {
        self.passes.set(self.passes.get() + 1);
        let (moments, derivative) =
            moments_and_derivative(&self.columns, &over_columns(self.turn.as_ref(), quadric));
        let derivative = self
            .turn
            .map_or(derivative, |turn| turn * derivative * turn.transpose());
        let unit = self.scale.units().map(f64::recip);
        let w = derivative.zip_map(&(unit * unit.transpose()), |entry, factor| entry * factor);
        (self.seen(moments), w)
    }

    /// The moments alone; one cheaper pass.
    fn moments_of(&self, quadric: &Quadric) -> Vector10 {
        self.passes.set(self.passes.get() + 1);
        self.seen(moments_where_positive(
            &self.columns,
            &over_columns(self.turn.as_ref(), quadric),
        ))
    }

    /// Moments in the columns' coordinates as the solver's.
    fn seen(&self, moments: Moments) -> Vector10 {
        let turned = self.turn.map_or(moments, |turn| {
            Moments((turn * Vector10::from(moments.0)).into())
        });
        self.scale.moments_to_units(&turned)
    }

    /// How many passes over the columns have been made.
    pub fn passes(&self) -> usize {
        self.passes.get()
    }
}

/// A quadric of the goal's coordinates over the columns' own.
fn over_columns(turn: Option<&Matrix10>, quadric: &Quadric) -> Quadric {
    turn.map_or(*quadric, |turn| {
        Quadric(turn.tr_mul(&Vector10::from(quadric.0)).into())
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
