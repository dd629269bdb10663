//! The infill of a print in one piece: nested regions, the outermost first.

use super::LaidField;
use crate::geom::Quadric;
use crate::hollow::{DrawnBody, NearWished};
use crate::interior::{Columns, moments_where_positive};
use crate::mass::Moments;

/// The infill of a print in one piece.
#[derive(Debug, Clone, PartialEq)]
pub struct Nested {
    /// The pattern of the infill, in the words of slicers.
    pub pattern: String,
    /// The regions, the outermost first. Each lies in the one before.
    pub levels: Vec<Level>,
    /// The infill that is wished everywhere, and changed as little as the goal allows. `None` if
    /// the goal alone decides.
    pub near: Option<NearWished>,
    /// The field that is printed in these regions; `None` if the densities are the best.
    pub field: Option<LaidField>,
}

/// A region of one density of infill, less the regions in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// The density to set in the slicer, over that of solid print.
    pub nominal_ratio: f64,
    /// The density that is laid, over that of solid print.
    pub laid_ratio: f64,
    /// The place of the region.
    pub extent: Extent,
}

/// The place of a region of infill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Extent {
    /// All that lies deeper than the wall.
    Interior,
    /// What of that has a solution's quadric above this value.
    Above(f64),
    /// The part of it in the body of the field's region with this index.
    Body(usize),
}

impl Level {
    /// Returns the density to set in the slicer, per cent of that of solid print.
    pub fn nominal_percent(&self) -> f64 {
        (self.nominal_ratio * 1e8).round() / 1e6
    }

    /// Returns the quadric that is positive in the region, for the quadric of a solution; that of
    /// all the interior for a body.
    pub fn quadric(&self, solution: &Quadric) -> Quadric {
        let mut quadric = *solution;
        match self.extent {
            Extent::Interior | Extent::Body(_) => {
                quadric.0 = std::array::from_fn(|i| f64::from(u8::from(i == 0)))
            }
            Extent::Above(value) => quadric.0[0] -= value,
        }
        quadric
    }
}

impl Nested {
    /// Returns the body that bounds a region; `None` if a quadric does, or the interior.
    pub fn body(&self, level: &Level) -> Option<&DrawnBody> {
        match (level.extent, &self.field) {
            (Extent::Body(index), Some(LaidField::Drawn(field))) => field.body(index),
            _ => None,
        }
    }

    /// Returns the moments of what is laid in regions with these moments, the outermost first.
    pub fn laid(&self, regions: impl IntoIterator<Item = Moments>) -> Moments {
        let mut around = 0.0;
        let levels = self.levels.iter().zip(regions);
        levels.fold(Moments::default(), |sum, (level, region)| {
            let step = level.laid_ratio - around;
            around = level.laid_ratio;
            sum + region * step
        })
    }

    /// Returns the moments of a body with the regions of a solution's quadric; `fixed` are its
    /// moments if all of it is solid.
    pub fn filled(&self, fixed: Moments, columns: &Columns, solution: &Quadric) -> Moments {
        let region = |level: &Level| match self.body(level) {
            Some(body) => body.moments(columns),
            None => moments_where_positive(columns, &level.quadric(solution)),
        };
        let regions: Vec<Moments> = self.levels.iter().map(region).collect();
        let emptied = regions.first().copied().unwrap_or_default();
        fixed - emptied + self.laid(regions)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(laid_ratio: f64, extent: Extent) -> Level {
        Level {
            nominal_ratio: laid_ratio,
            laid_ratio,
            extent,
        }
    }

    #[test]
    fn each_region_weighs_its_density_but_for_the_regions_in_it() {
        let nested = Nested {
            pattern: "gyroid".to_owned(),
            levels: vec![
                level(0.6, Extent::Interior),
                level(0.3, Extent::Above(-0.1)),
                level(0.1, Extent::Above(0.2)),
            ],
            near: None,
            field: None,
        };
        let ball = |mm3: f64| Moments([mm3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
        let laid = nested.laid([1000.0, 400.0, 100.0].map(ball));
        let expected = 600.0 * 0.6 + 300.0 * 0.3 + 100.0 * 0.1;
        assert!((laid.volume() - expected).abs() < 1e-9);
    }

    #[test]
    fn the_interior_is_where_a_quadric_of_one_is_and_the_others_are_cut_at_their_values() {
        let solution = Quadric([0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let whole = level(0.6, Extent::Interior).quadric(&solution);
        assert_eq!(whole.0[0], 1.0);
        assert!(whole.0[1..].iter().all(|coefficient| *coefficient == 0.0));
        let upper = level(0.1, Extent::Above(0.75)).quadric(&solution);
        assert_eq!((upper.0[0], upper.0[3]), (-0.25, 1.0));
    }
}
