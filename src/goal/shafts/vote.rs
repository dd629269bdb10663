//! The cylinders on which many patches agree.

use rayon::prelude::*;

use super::cylinder::Cylinder;
use super::patches::{PATCH_RATIOS, Samples};
use crate::base::watch::{Cancelled, Watch};

/// Two fits agree if their axes are within 6°, and pass within 12 % of the radius of each other,
/// with radii as near.
const SAME_COSINE: f64 = 0.9945;
const SAME_RATIO: f64 = 0.12;
/// Fewer patches agree by chance.
const LEAST_VOTES: usize = 5;
/// The number of cylinders that are looked at more closely.
const MOST: usize = 120;
/// The number of cylinders that are counted for one size of patches. Free forms give many that repeat nowhere;
/// more than this would cost seconds.
const MOST_COUNTED: usize = 4000;

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
        let fitted: Vec<Option<Cylinder>> = fitted.map(|i| cubes.fit_patch(i)).collect();
        counted.extend(count_patches(&fitted, watch)?);
    }
    counted.sort_by_key(|one| std::cmp::Reverse(one.votes));
    counted.truncate(MOST);
    Ok(counted.into_iter().map(|one| one.cylinder).collect())
}
