//! An affine map that makes the reachable set of a few columns osculate that of all columns.

use nalgebra::{Const, SymmetricEigen};

use super::units::{Extreme, Vector10};
use crate::interior::Matrix10;

/// Noise floor of the derivatives, as a part of their mean; below it the map is the identity. A far
/// larger floor leaves directions unmended that hardly turn the extreme point. A far smaller one
/// amplifies noise.
const NOISE_RATIO: f64 = 1e-5;

type Eigen10 = SymmetricEigen<f64, Const<10>>;

/// The map s ↦ Ts + b, with a symmetric positive definite T.
///
/// Take a convex set with the support function h(g) = min g·s. Its image has h(Tg) + b·g, so it is
/// convex as well. Its extreme point along g is T s(Tg) + b, with the derivative T W(Tg) T. For a
/// given g these equal s′ and W′ of another set if T W(g) T = W′, Tg = g and b = s′ − Ts. Exactly
/// one T that meets the first condition is symmetric and positive. It is the map of optimal
/// transport between the Gaussians of covariance W and W′:
///
/// ```text
/// T = W^(−½) (W^½ W′ W^½)^½ W^(−½)
/// ```
///
/// It leaves g unchanged, as both derivatives vanish along g: extreme points do not depend on its
/// length.
///
/// Source: Olkin and Pukelsheim, "The distance between two random vectors with given dispersion
/// matrices", Linear Algebra and its Applications 48, 1982.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mend {
    stretch: Matrix10,
    shift: Vector10,
}

impl Mend {
    /// Returns the map that gives the set of `few` the extreme point and the derivative of `all`
    /// along g.
    pub fn new(g: &Vector10, all: &Extreme, few: impl Fn(&Vector10) -> Extreme) -> Self {
        let stretch = transport(&across(g, &few(g).w), &across(g, &all.w));
        Self {
            stretch,
            shift: all.s - stretch * few(&(stretch * g)).s,
        }
    }

    /// Returns the direction in the original set for a direction in the image.
    pub fn direction(&self, g: &Vector10) -> Vector10 {
        self.stretch * g
    }

    /// Maps a point.
    pub fn point(&self, s: &Vector10) -> Vector10 {
        self.stretch * s + self.shift
    }

    /// Maps an extreme point.
    pub fn extreme(&self, extreme: &Extreme) -> Extreme {
        let w = self.stretch * extreme.w * self.stretch;
        Extreme {
            s: self.point(&extreme.s),
            w,
            cost: extreme.cost,
        }
    }
}

/// Removes the component along g from a derivative. It should be zero, but the averages used for
/// vertical surfaces leave some.
fn across(g: &Vector10, w: &Matrix10) -> Matrix10 {
    let across = Matrix10::identity() - g * g.transpose() / g.norm_squared();
    across * w * across
}

/// Returns the symmetric positive T with T W T = W′, both with the noise floor added.
fn transport(few: &Matrix10, all: &Matrix10) -> Matrix10 {
    let noise = Matrix10::identity() * (NOISE_RATIO * 0.1 * all.trace()).max(f64::MIN_POSITIVE);
    let eigen = (few + noise).symmetric_eigen();
    let (root, inverse) = (
        of_eigen(&eigen, f64::sqrt),
        of_eigen(&eigen, |value| value.sqrt().recip()),
    );
    let middle = of_eigen(&(root * (all + noise) * root).symmetric_eigen(), f64::sqrt);
    inverse * middle * inverse
}

/// Applies a function to a symmetric positive matrix, by its eigenvalues.
fn of_eigen(eigen: &Eigen10, function: impl Fn(f64) -> f64) -> Matrix10 {
    let least = f64::EPSILON * eigen.eigenvalues.max();
    let values = eigen.eigenvalues.map(|value| function(value.max(least)));
    eigen.eigenvectors * Matrix10::from_diagonal(&values) * eigen.eigenvectors.transpose()
}

#[cfg(test)]
mod tests {
    use super::super::reach::Reach;
    use super::super::units::Scale;
    use super::*;
    use crate::goal::Objective;
    use crate::hollow::worlds;

    #[test]
    fn mended_columns_osculate_all_of_them_and_still_make_a_convex_set() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let all = Reach::new(&world.columns, &world.fixed, Scale::of(&world.fixed));
        let along = |seed| Vector10::from(worlds::some_quadric(seed, 1.0).0);
        let cuts = |g: &Vector10| all.extreme(g).w.trace() > 1e-3;
        let directions: Vec<Vector10> = (0..16).map(along).filter(cuts).collect();
        assert!(
            directions.len() >= 4,
            "only these cut the egg: {directions:?}"
        );
        for g in directions {
            let there = all.extreme(&g);
            let (few, mended) = (all.thin(3), all.thin(3).mend_at(&g, &there));
            let [plain, image] = [few.extreme(&g), mended.extreme(&g)];
            assert!((image.s - there.s).amax() < 1e-12);
            // The remaining error is the noise, 1e-5 of the mean, times the distance of T from the
            // identity.
            let error =
                |w: &Matrix10| (across(&g, w) - across(&g, &there.w)).norm() / there.w.norm();
            assert!(
                error(&image.w) < 1e-4 && error(&plain.w) > 1e-2,
                "{} {}",
                error(&image.w),
                error(&plain.w)
            );
            // No extreme point of a convex set is lower along g than the one along g.
            let least = g.dot(&image.s);
            assert!(
                (20..60).all(|other| g.dot(&mended.extreme(&along(other)).s) >= least - 1e-9),
                "{g}"
            );
        }
    }
}
