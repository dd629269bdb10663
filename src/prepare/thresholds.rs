//! Thresholds: the densities of infill that would meet a goal that those ordered do not.

use super::densities::nested;
use super::fields::with_field;
use super::levels::{COARSE_COLUMNS, with_load};
use super::mean::with_levels;
use crate::ballast::Load;
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::hollow::{Graded, Row, greatest_low, least_high, rows};
use crate::interior::Columns;
use crate::job::{DensityOrder, InfillDensity, Job};
use crate::run::{Extent, Nested, Placed};
use crate::shell::Shell;

/// Whole per cents that are tried from a threshold on: it is found on coarse columns.
const TRIALS: usize = 2;
/// Whole per cents of infill.
const PERCENTS: u32 = 100;

/// Returns hints of densities that meet the goal of a graded job, each confirmed by a solve.
///
/// # Errors
/// As a solve.
pub fn density_hints(placed: &Placed, watch: &Watch) -> Result<Vec<String>, Error> {
    let Some(sparse) = &placed.sparse else {
        return Ok(Vec::new());
    };
    let search = Search { placed, sparse };
    let mut hints = Vec::new();
    for orders in search.orders(watch)? {
        for order in orders {
            if search.works(order, watch)? {
                let setting = Setting::new(Key::Density, order);
                hints.push(format!("order other densities of infill (`{setting}`)"));
                break;
            }
        }
    }
    Ok(hints)
}

/// A search for densities.
struct Search<'a> {
    placed: &'a Placed,
    sparse: &'a Nested,
}

impl Search<'_> {
    /// Returns the densities that may do: with a lesser least one, and with a greater greatest one.
    fn orders(&self, watch: &Watch) -> Result<[Vec<DensityOrder>; 2], Error> {
        let rows = self.rows();
        let Some((low, high)) = self.ends().filter(|_| !rows.is_empty()) else {
            return Ok([Vec::new(), Vec::new()]);
        };
        let goal = self.placed.goal();
        let (wall_mm, keeps) = (self.placed.shop.wall.wall_mm, &self.placed.placement.keeps);
        let shell = Shell::new(self.placed.solid(), &goal.frame, wall_mm, keeps)?;
        let columns = Columns::of_shell(&shell, shell.coarse_pitch(COARSE_COLUMNS), watch)?;
        let beside = self.placed.laid_beyond().in_frame(&goal.frame);
        let graded = Graded {
            shell: goal.solid + beside - columns.moments(),
            columns: &columns,
            rows: &rows,
        };
        let sparser = greatest_low(&graded, self.laid_ratio(high)).density;
        let denser = least_high(&graded, self.laid_ratio(low)).density;
        let percent = |percent: u32| InfillDensity::of_ratio(f64::from(percent) / 100.0);
        let percents = (0..=PERCENTS).filter_map(percent);
        let sparser = percents
            .clone()
            .rev()
            .filter(|it| *it < low && self.laid_ratio(*it) <= sparser)
            .filter_map(|it| DensityOrder::new(it, high).ok());
        let denser = percents
            .filter(|it| *it > high && self.laid_ratio(*it) >= denser)
            .filter_map(|it| DensityOrder::new(low, it).ok());
        Ok([
            sparser.take(TRIALS).collect(),
            denser.take(TRIALS).collect(),
        ])
    }

    fn rows(&self) -> Vec<Row> {
        let least_deg = self.placed.request.promised_angle_deg().unwrap_or(0.0);
        rows(self.placed.goal(), least_deg.to_radians())
    }

    /// Returns the least and the greatest density that were ordered.
    fn ends(&self) -> Option<(InfillDensity, InfillDensity)> {
        let levels = &self.sparse.levels;
        let low = InfillDensity::of_ratio(levels.last()?.nominal_ratio)?;
        let outermost = levels.first()?;
        match outermost.extent {
            Extent::Interior => Some((low, InfillDensity::of_ratio(outermost.nominal_ratio)?)),
            Extent::Above(_) | Extent::Body(_) => Some((low, InfillDensity::SOLID)),
        }
    }

    fn laid_ratio(&self, density: InfillDensity) -> f64 {
        let infill = self.placed.shop.printer.infill.as_ref();
        infill.map_or(1.0, |infill| infill.laid_ratio(density.ratio()))
    }

    /// Returns whether a solve with these densities meets the goal.
    fn works(&self, order: DensityOrder, watch: &Watch) -> Result<bool, Error> {
        let job = Job {
            density: Some(order),
            ..self.placed.job.clone()
        };
        // What does not print is no remedy.
        let Ok(sparse) = nested(&job, &self.placed.shop.printer) else {
            return Ok(false);
        };
        let Some(fill) = super::densities::fill(&sparse) else {
            return Ok(false);
        };
        let other = Placed {
            job,
            fill,
            sparse: Some(sparse),
            ..self.placed.clone()
        };
        let other = with_field(with_levels(other, watch)?, watch)?;
        let found = with_load(&other, Load::default(), watch)?;
        Ok(matches!(found, Verdict::Found(_)))
    }
}
