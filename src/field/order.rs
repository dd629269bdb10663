//! A density as it is ordered, before the solid is known.

use super::clamped::Clamped;
use super::density::Density;
use super::levels::Levels;
use super::linear::Linear;
use super::polynomial::Polynomial;
use super::product::Product;
use super::ramp::Ramp;
use super::sine::Sine;
use super::skin::{Profile, Skin};
use super::sum::Sum;
use super::uniform::Uniform;
use crate::mesh::Solid;

/// A density as it is ordered: a few words, or a file of sums and products.
#[derive(Debug, Clone, PartialEq)]
pub enum Order {
    /// The same everywhere.
    Uniform(Uniform),
    /// Linear in place.
    Linear(Linear),
    /// A polynomial in place.
    Polynomial(Polynomial),
    /// Linear between two planes.
    Ramp(Ramp),
    /// A wave of the distance to a point.
    Sine(Sine),
    /// A function of the depth below the surface.
    Skin(SkinOrder),
    /// Constant between nested quadrics.
    Levels(Levels),
    /// A quadratic between two densities.
    Clamped(Clamped),
    /// The sum of others.
    Sum(Vec<Order>),
    /// The product of others.
    Product(Vec<Order>),
}

/// A skin before its solid is known: depth, fall, and the densities of core and surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkinOrder {
    /// Depth at which a line ends; σ of a Gaussian, mm.
    pub depth_mm: f64,
    /// Fall of the density.
    pub profile: Profile,
    /// Densities of the core and at the surface.
    pub densities: [f64; 2],
}

impl SkinOrder {
    /// Returns the depth below which the density is less than this one, mm: zero if it is less even
    /// at the surface. `None` if it never is.
    pub fn depth_below_mm(&self, density: f64) -> Option<f64> {
        let [core, surface] = self.densities;
        let share = (density - core) / (surface - core);
        if share.is_nan() || share <= 0.0 {
            return None;
        }
        let depth = match self.profile {
            Profile::Linear => 1.0 - share,
            Profile::Gauss => (-2.0 * share.ln()).max(0.0).sqrt(),
        };
        Some(self.depth_mm * depth.max(0.0))
    }
}

impl Order {
    /// Returns the density on a solid. A skin needs it; the others do not.
    pub fn on(&self, solid: &Solid) -> Box<dyn Density> {
        let all = |parts: &[Self]| parts.iter().map(|part| part.on(solid)).collect();
        match self {
            Self::Uniform(uniform) => Box::new(*uniform),
            Self::Linear(linear) => Box::new(*linear),
            Self::Polynomial(polynomial) => Box::new(polynomial.clone()),
            Self::Ramp(ramp) => Box::new(*ramp),
            Self::Sine(sine) => Box::new(*sine),
            Self::Levels(levels) => Box::new(levels.clone()),
            Self::Clamped(clamped) => Box::new(clamped.clone()),
            Self::Skin(SkinOrder {
                depth_mm,
                profile,
                densities,
            }) => {
                match Skin::new(solid, *depth_mm, *profile, *densities) {
                    Some(skin) => Box::new(skin),
                    // A depth of nothing leaves the core.
                    None => Box::new(Uniform(densities[0])),
                }
            }
            Self::Sum(parts) => Box::new(Sum(all(parts))),
            Self::Product(factors) => Box::new(Product(all(factors))),
        }
    }

    /// Returns whether a part of it jumps between levels.
    pub fn jumps(&self) -> bool {
        match self {
            Self::Levels(_) => true,
            Self::Sum(parts) | Self::Product(parts) => parts.iter().any(Self::jumps),
            _ => false,
        }
    }

    /// Returns the number of parts, the order itself among them.
    pub fn count(&self) -> usize {
        match self {
            Self::Sum(parts) | Self::Product(parts) => {
                1 + parts.iter().map(Self::count).sum::<usize>()
            }
            _ => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::density::OfDepth;
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::cuboid;

    #[test]
    fn a_skin_has_each_density_at_the_depth_that_is_told_for_it() {
        let cube = cuboid(&Point::origin(), &Point::new(1.0, 1.0, 1.0));
        let cube = Solid::new(cube).unwrap();
        for profile in [Profile::Linear, Profile::Gauss] {
            let order = SkinOrder {
                depth_mm: 4.0,
                profile,
                densities: [0.2, 0.9],
            };
            let skin = Skin::new(&cube, 4.0, profile, order.densities).unwrap();
            for density in [0.21, 0.4, 0.65, 0.89] {
                let depth_mm = order.depth_below_mm(density).unwrap();
                assert!((skin.of_depth(depth_mm) - density).abs() < 1e-12);
            }
            let [nowhere, everywhere] = [0.2, 0.95].map(|it| order.depth_below_mm(it));
            assert_eq!((nowhere, everywhere), (None, Some(0.0)));
        }
    }
}
