//! From the masses of the blocks to the densities of their cores.

use super::set::{DensitySet, SOLID_PERCENT, area_mm2, circle_ratio};
use crate::base::units::MM3_PER_CM3;

/// Infills nearer than this are one, per cent.
const SAME_PERCENT: f64 = 1e-6;

/// The masses of the blocks of one infill.
#[derive(Debug, Clone, PartialEq)]
pub struct WeighedInfill {
    /// The infill, per cent of solid print.
    pub percent: f64,
    /// The masses, g: of the large block and of the small one, or of the solid one alone.
    pub masses_g: Vec<f64>,
}

/// Masses of blocks that give no densities.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WeighError {
    /// No block has this infill.
    #[error("no block has an infill of {percent} %; remedy: give one of {known} %")]
    Unknown {
        /// The infill, per cent.
        percent: f64,
        /// Those of the coupon, in words.
        known: String,
    },
    /// An infill is given twice.
    #[error("the blocks of {0} % are there twice; remedy: give the masses of each infill once")]
    Twice(f64),
    /// Blocks were not weighed.
    #[error("the blocks of {0} % are missing; remedy: weigh all blocks of the coupon")]
    Missing(String),
    /// Another number of masses than blocks.
    #[error(
        "{percent} % has {}; remedy: give {}, such as {percent}%={}",
        if *is_solid { "one block, which is small" } else { "two blocks" },
        if *is_solid { "its mass" } else { "the mass of the large one, then of the small one" },
        if *is_solid { "7.84g" } else { "6.52g,2.12g" }
    )]
    Count {
        /// The infill, per cent.
        percent: f64,
        /// True if it is solid print.
        is_solid: bool,
    },
    /// A mass that is not positive and finite.
    #[error("a block of {0} g is not possible; remedy: give its mass in grams")]
    Mass(f64),
    /// The large block is no heavier than the small one.
    #[error(
        "the large block of {0} % is not heavier than the small one; \
         remedy: give the mass of the large one first"
    )]
    LargeFirst(f64),
    /// An infill is no denser than a lower one.
    #[error(
        "by these masses {percent} % has {density:.4} of solid print, and {before} % has {less:.4}; \
         remedy: sort the blocks by mass and weigh both infills again"
    )]
    Order {
        /// The infill, per cent.
        percent: f64,
        /// Its density over that of solid print.
        density: f64,
        /// The infill below it, per cent.
        before: f64,
        /// The density of that one.
        less: f64,
    },
    /// An infill is as dense as solid print.
    #[error(
        "by these masses {percent} % has {density:.4} of solid print; \
         remedy: weigh its blocks and the solid one again"
    )]
    Solid {
        /// The infill, per cent.
        percent: f64,
        /// Its density over that of solid print.
        density: f64,
    },
    /// An infill weighs nothing beside its walls.
    #[error(
        "by these masses the core of {0} % weighs nothing; \
         remedy: weigh both its blocks again, the large one first"
    )]
    Nothing(f64),
}

impl DensitySet {
    /// Returns the density of every infill's core over that of solid print: pairs of the nominal
    /// ratio and the measured one, ascending.
    ///
    /// Over the height and the solid density, a block weighs u = w + b·a + c·r·a². Its core is a
    /// wide; w is the corner of the wall, b the wall and the ends of lines, and c·a² the area. Two
    /// widths give r, whatever b is.
    ///
    /// # Errors
    /// A block is missing or not known, or the masses cannot be those of the coupon.
    pub fn core_ratios(&self, weighed: &[WeighedInfill]) -> Result<Vec<[f64; 2]>, WeighError> {
        self.check(weighed)?;
        let masses = |percent: f64| weighed.iter().find(|it| is_same(it.percent, percent));
        let [small_mm, large_mm] = self.diameters_mm;
        let solid_g = masses(SOLID_PERCENT).map_or(0.0, |it| it.masses_g[0]);
        let solid_g_cm3 = solid_g / (area_mm2(small_mm) * self.height_mm) * MM3_PER_CM3;
        let mut rows: Vec<[f64; 2]> = Vec::new();
        let mut before = None;
        for percent in self.percents() {
            let Some([large_g, small_g]) = masses(percent).map(|it| it.masses_g.as_slice()) else {
                continue;
            };
            let slopes = [(*small_g, small_mm), (*large_g, large_mm)].map(|(mass_g, wide_mm)| {
                let section_mm2 = mass_g / solid_g_cm3 * MM3_PER_CM3 / self.height_mm;
                let corner_mm2 = 4.0 * circle_ratio() * self.wall_mm * self.wall_mm;
                (section_mm2 - corner_mm2) / self.core_mm(wide_mm)
            });
            let density = (slopes[1] - slopes[0]) / (large_mm - small_mm) / circle_ratio();
            if density <= 0.0 {
                return Err(WeighError::Nothing(percent));
            }
            if density >= 1.0 {
                return Err(WeighError::Solid { percent, density });
            }
            if let Some((before, less)) = before.filter(|(_, less)| density <= *less) {
                return Err(WeighError::Order {
                    percent,
                    density,
                    before,
                    less,
                });
            }
            before = Some((percent, density));
            rows.push([percent / SOLID_PERCENT, density]);
        }
        Ok(rows)
    }

    /// Checks that every block was weighed once, and nothing else.
    fn check(&self, weighed: &[WeighedInfill]) -> Result<(), WeighError> {
        let known = self.percents();
        for (at, WeighedInfill { percent, masses_g }) in weighed.iter().enumerate() {
            if !known.iter().any(|it| is_same(*it, *percent)) {
                return Err(WeighError::Unknown {
                    percent: *percent,
                    known: in_words(&known),
                });
            }
            if weighed[..at].iter().any(|it| is_same(it.percent, *percent)) {
                return Err(WeighError::Twice(*percent));
            }
            let is_solid = is_same(*percent, SOLID_PERCENT);
            if masses_g.len() != if is_solid { 1 } else { 2 } {
                return Err(WeighError::Count {
                    percent: *percent,
                    is_solid,
                });
            }
            let bad = masses_g.iter().find(|it| !(it.is_finite() && **it > 0.0));
            if let Some(bad) = bad {
                return Err(WeighError::Mass(*bad));
            }
            if !is_solid && masses_g[0] <= masses_g[1] {
                return Err(WeighError::LargeFirst(*percent));
            }
        }
        let is_weighed = |percent: &f64| weighed.iter().any(|it| is_same(it.percent, *percent));
        let missing: Vec<f64> = known.into_iter().filter(|it| !is_weighed(it)).collect();
        if missing.is_empty() {
            Ok(())
        } else {
            Err(WeighError::Missing(in_words(&missing)))
        }
    }
}

fn is_same(percent: f64, other: f64) -> bool {
    (percent - other).abs() < SAME_PERCENT
}

fn in_words(percents: &[f64]) -> String {
    let words: Vec<String> = percents.iter().map(f64::to_string).collect();
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::Printer;

    fn set() -> DensitySet {
        let printer = Printer::find("prusa-mk4").unwrap();
        DensitySet::of(&printer, printer.material(None).unwrap()).unwrap()
    }

    /// Returns what the blocks weigh if cores have a density, walls are heavier than drawn, and
    /// solid print is lighter than the profile says.
    fn weigh(set: &DensitySet, density_of: impl Fn(f64) -> f64) -> Vec<WeighedInfill> {
        let mass_g = |percent: f64, wide_mm: f64| {
            let core_mm = set.core_mm(wide_mm);
            let wall_mm2 = area_mm2(wide_mm) - area_mm2(core_mm);
            let ends_mm2 = 0.3 * core_mm;
            let ratio = density_of(percent);
            1.19e-3 * set.height_mm * (wall_mm2 + ends_mm2 + ratio * area_mm2(core_mm))
        };
        let [small_mm, large_mm] = set.diameters_mm;
        let of = |percent: f64| WeighedInfill {
            percent,
            masses_g: match percent < SOLID_PERCENT {
                true => vec![mass_g(percent, large_mm), mass_g(percent, small_mm)],
                false => vec![1.19e-3 * set.height_mm * area_mm2(small_mm)],
            },
        };
        set.percents().into_iter().map(of).collect()
    }

    fn usual(percent: f64) -> f64 {
        0.0094 * percent
    }

    #[test]
    fn two_widths_give_the_density_of_the_core_whatever_walls_and_ends_of_lines_weigh() {
        let set = set();
        let rows = set.core_ratios(&weigh(&set, usual)).unwrap();
        assert_eq!(rows.len(), 6);
        for [nominal, measured] in rows {
            assert!(
                (measured - 0.94 * nominal).abs() < 1e-12,
                "{nominal} {measured}"
            );
        }
    }

    #[test]
    fn masses_that_are_not_those_of_the_coupon_are_refused_with_what_to_do() {
        let set = set();
        let right = weigh(&set, usual);
        let changed = |change: &dyn Fn(&mut Vec<WeighedInfill>)| {
            let mut wrong = right.clone();
            change(&mut wrong);
            let error = set.core_ratios(&wrong).unwrap_err().to_string();
            assert!(error.contains("; remedy: "), "{error}");
            error
        };
        for (said, error) in [
            (
                "no block has an infill of 25 %",
                changed(&|all| all[0].percent = 25.0),
            ),
            (
                "15 % are there twice",
                changed(&|all| all[1].percent = 15.0),
            ),
            (
                "of 20, 50 % are missing",
                changed(&|all| {
                    all.remove(3);
                    all.remove(1);
                }),
            ),
            ("of 100 % are missing", changed(&|all| drop(all.pop()))),
            (
                "has two blocks",
                changed(&|all| all[0].masses_g.truncate(1)),
            ),
            (
                "100 % has one block",
                changed(&|all| all[6].masses_g.push(1.0)),
            ),
            (
                "a block of NaN g",
                changed(&|all| all[0].masses_g[0] = f64::NAN),
            ),
            ("a block of -1 g", changed(&|all| all[0].masses_g[1] = -1.0)),
            ("not heavier", changed(&|all| all[2].masses_g.reverse())),
            (
                "and 15 % has",
                changed(&|all| {
                    let swapped = all[0].masses_g.clone();
                    all[0].masses_g = std::mem::replace(&mut all[1].masses_g, swapped);
                }),
            ),
            ("90 % has 1.", changed(&|all| all[6].masses_g[0] *= 0.8)),
            (
                "weighs nothing",
                changed(&|all| all[0].masses_g[0] = 1.01 * all[0].masses_g[1]),
            ),
        ] {
            assert!(error.contains(said), "{said}: {error}");
        }
    }
}
