//! The cylinders on which many patches agree.

use rayon::prelude::*;

use super::cylinder::Cylinder;
use super::patches::{Cubes, PATCH_RATIOS, Sample, Samples};
use crate::base::watch::{Cancelled, Watch};

/// Two fits agree if their axes are within 6°, and pass within 12 % of the radius of each other,
/// with radii as near.
const SAME_COSINE: f64 = 0.9945;
const SAME_RATIO: f64 = 0.12;
/// Fewer patches agree by chance.
const LEAST_VOTES: usize = 5;
/// The number of cylinders that are looked at more closely.
const MOST: usize = 120;
/// The number of cylinders that are counted for one size of patches. Free forms give many that
/// repeat nowhere; more than this would cost seconds.
const MOST_COUNTED: usize = 4000;
/// Fewer points, and the fit says nothing.
const LEAST_POINTS: usize = 7;
/// A patch of more points is thinned to about as many.
const MOST_POINTS: usize = 60;
/// The greatest distance of a patch's points from its cylinder, as a share of the radius, root mean
/// square.
const MOST_OFF_RATIO: f64 = 0.05;
/// The largest cylinder that a patch can tell, in radii of the patch: the patch then bends by 14°
/// to each side.
const MOST_RADII: f64 = 4.0;

/// A cylinder and the number of patches that agree on it.
struct Counted {
    cylinder: Cylinder,
    votes: usize,
}

impl Counted {
    fn agrees(&self, other: &Cylinder) -> bool {
        let known = &self.cylinder;
        let most_mm = SAME_RATIO * known.radius_mm;
        known.is_bore == other.is_bore
            && (known.radius_mm - other.radius_mm).abs() <= most_mm
            && known.axis.dot(&other.axis).abs() >= SAME_COSINE
            && known.across(&other.point).norm() <= most_mm
    }
}

/// Returns the cylinder that fits the patch about a point; `None` if none does.
fn fit_patch(cubes: &Cubes, index: usize) -> Option<Cylinder> {
    let mut patch = cubes.patch(index);
    if patch.len() < LEAST_POINTS {
        return None;
    }
    let step = patch.len().div_ceil(MOST_POINTS);
    patch = patch.into_iter().step_by(step).collect();
    let fitted = Cylinder::fit(&patch)?;
    let square = |point: &Sample| (fitted.across(&point.at).norm() - fitted.radius_mm).powi(2);
    let off_mm = (patch.iter().map(square).sum::<f64>() / patch.len() as f64).sqrt();
    let on_it = |point: &&Sample| fitted.holds(&point.at, &point.normal, 1.0);
    let is_turned = patch.iter().filter(on_it).count() * 10 >= patch.len() * 9;
    let is_told = fitted.radius_mm <= MOST_RADII * cubes.size_mm
        && off_mm <= MOST_OFF_RATIO * fitted.radius_mm;
    (is_told && is_turned).then_some(fitted)
}

/// Returns the cylinders on which enough patches of one size agree.
fn count_patches(fitted: &[Option<Cylinder>], watch: &Watch) -> Result<Vec<Counted>, Cancelled> {
    let mut counted: Vec<Counted> = Vec::new();
    for (i, cylinder) in fitted.iter().enumerate() {
        if i % 1024 == 0 {
            watch.check()?;
        }
        let Some(cylinder) = *cylinder else { continue };
        match counted.iter().position(|known| known.agrees(&cylinder)) {
            Some(known) => counted[known].votes += 1,
            None if counted.len() < MOST_COUNTED => counted.push(Counted { cylinder, votes: 1 }),
            None => {}
        }
    }
    counted.retain(|one| one.votes >= LEAST_VOTES);
    Ok(counted)
}

/// Returns the cylinders with the most votes, the first of them first.
pub(super) fn count(samples: &Samples, watch: &Watch) -> Result<Vec<Cylinder>, Cancelled> {
    let mut counted: Vec<Counted> = Vec::new();
    for ratio in PATCH_RATIOS {
        watch.check()?;
        let cubes = samples.cubes(ratio * samples.diagonal_mm);
        let fitted = (0..samples.len()).into_par_iter();
        let fitted: Vec<Option<Cylinder>> = fitted.map(|i| fit_patch(&cubes, i)).collect();
        counted.extend(count_patches(&fitted, watch)?);
    }
    counted.sort_by_key(|one| std::cmp::Reverse(one.votes));
    counted.truncate(MOST);
    Ok(counted.into_iter().map(|one| one.cylinder).collect())
}
