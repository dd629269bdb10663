//! The starts of a fit, and the best of their ends.

use std::cmp::Ordering;
use std::f64::consts::TAU;

use rayon::prelude::*;

use super::descent::descend;
use super::regions::{Region, is_cut, regions};
use super::shape::{Family, Numbers, Shape};
use super::smooth::smooth;
use super::state::{State, stepped};
use super::task::Task;
use crate::base::random::Random;
use crate::geom::{Aabb, Point, Quadric, Vector};
use crate::hollow::change::least_change;
use crate::hollow::dual::units::Vector10;
use crate::hollow::graded::{Graded, InUnits};
use crate::hollow::levels::{PrintLevels, least_level_change};
use crate::interior::Columns;

/// Starts of a fit.
const STARTS: usize = 60;
/// Seed of the starts.
const SEED: u64 = 19;
/// Columns above which a fit begins on a part of them.
const MOST_COLUMNS: usize = 4000;
/// Widths of the first ramps, over the longest side.
const WIDTHS: [f64; 2] = [0.1, 3.0];
/// Lengths of the first waves, over the longest side.
const WAVES: [f64; 2] = [0.4, 3.0];
/// Part of the box by which the centre of a first wave may lie outside.
const BESIDE: f64 = 0.5;
/// Shortest wave, over the longest side: a shorter one has more regions than slicers take.
const SHORTEST_WAVE: f64 = 0.25;
/// Fits of the smooth field of which steps are fitted too.
const MOST_STEPPED: usize = 8;
/// Least volume of a body, over that of the solid.
const LEAST_VOLUME: f64 = 1e-6;
/// Greatest miss of a field that meets its rows, in units of the body.
pub(super) const MET: f64 = 1e-7;

/// The end of a fit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fitted {
    pub shape: Shape,
    pub miss: f64,
    pub cost: f64,
    pub moments: Vector10,
}

/// A field that was fitted in the steps that are printed.
pub(in crate::hollow) struct Stepped {
    pub shape: Shape,
    pub regions: Vec<Region>,
}

impl Task<'_> {
    /// Descends from a start; `state` gives the moments of numbers, `None` if they are no field's.
    fn descend(&self, start: Numbers, state: impl Fn(&Numbers) -> Option<State>) -> Numbers {
        let rows = self.rows();
        descend(start, |numbers| {
            let state = state(numbers)?;
            Some(rows.misses(self.units, &state))
        })
    }

    /// Returns the field of some numbers; `None` for a wave that is too short.
    fn shape(&self, numbers: &Numbers) -> Option<Shape> {
        let shape = Shape::of_numbers(self.family, numbers, self.units.length_mm());
        let is_finite = numbers.iter().all(|number| number.is_finite());
        let is_long = match shape {
            Shape::Ramp { .. } => true,
            Shape::Sine { wave_mm, .. } => {
                wave_mm > SHORTEST_WAVE * longest_side_mm(self.graded.columns)
            }
        };
        (is_finite && is_long).then_some(shape)
    }

    /// Returns a ramp as near to a least change as one can be; `None` for waves.
    pub fn shape_near(&self, change: &Quadric) -> Option<Shape> {
        let mut quadric = *change;
        quadric.0[0] -= self.wished;
        let ramp = Shape::of_quadric(Family::Ramp, &quadric);
        (self.family == Family::Ramp).then_some(ramp)
    }

    /// Returns the field of printed steps near a smooth one, with its miss and its change.
    fn refined_step(&self, smooth: Shape, levels: &PrintLevels) -> ([f64; 2], Stepped) {
        let own = regions(&smooth, levels.densities(), self.graded.columns);
        let shape = self.refine(&smooth, &own);
        // A wave that has moved may need other regions.
        let regions = regions(&shape, levels.densities(), self.graded.columns);
        let shape = self.refine(&shape, &regions);
        let moments = stepped(self.units, &shape, &regions).moments;
        let miss = self.rows().greatest_miss(self.units, &moments);
        // A wave of more steps than are printed is no answer.
        let is_cut = is_cut(&shape, levels.densities(), self.graded.columns);
        let miss = if is_cut { miss.max(1.0) } else { miss };
        (
            [miss, cost(self, &shape, &regions)],
            Stepped { shape, regions },
        )
    }

    /// Returns the nearest field of printed steps to one with these regions.
    pub fn refine(&self, shape: &Shape, regions: &[Region]) -> Shape {
        let start = shape.numbers(self.units.length_mm());
        let found = self.descend(start, |numbers| {
            let shape = self.shape(numbers)?;
            Some(stepped(self.units, &shape, regions))
        });
        self.shape(&found).unwrap_or(*shape)
    }
}

/// Fits the smooth field from all starts, in their order.
pub(super) fn fit_all(task: &Task) -> Vec<Fitted> {
    let starts = starts(task);
    let fit = |start: &Shape| {
        let start = start.numbers(task.units.length_mm());
        let found = task.descend(start, |numbers| {
            let shape = task.shape(numbers)?;
            Some(smooth(task.units, task, &shape).0)
        });
        let shape = Shape::of_numbers(task.family, &found, task.units.length_mm());
        let (state, cost) = smooth(task.units, task, &shape);
        Fitted {
            shape,
            miss: match state.moments[0] > LEAST_VOLUME {
                true => task.rows().greatest_miss(task.units, &state.moments),
                // What weighs nothing is balanced, and is no body.
                false => f64::INFINITY,
            },
            cost,
            moments: state.moments,
        }
    };
    starts.par_iter().map(fit).collect()
}

/// Fits a field in the steps that are printed: of those that meet the rows the one with the least
/// change, or else the nearest.
pub(in crate::hollow) fn fit_steps(task: &Task, levels: &PrintLevels) -> Stepped {
    let thin = thinned(task.graded.columns);
    let graded = Graded {
        shell: task.graded.shell + task.graded.columns.moments() - thin.moments(),
        columns: &thin,
        rows: task.graded.rows,
    };
    let units = InUnits::new(&graded);
    let few = Task {
        graded: &graded,
        units: &units,
        ..*task
    };
    let mut fits = fit_all(&few);
    fits.sort_by(|a, b| compare([a.miss, a.cost], [b.miss, b.cost]));
    fits.truncate(MOST_STEPPED);
    let levelled = least_level_change(task.graded, levels, task.wished).found();
    let levelled = levelled.and_then(|least| task.shape_near(&least.quadric));
    let levelled = levelled.map(|shape| task.refined_step(shape, levels));
    let ends = fits.iter().map(|fit| task.refined_step(fit.shape, levels));
    let ends = levelled.into_iter().chain(ends);
    let first = ends.min_by(|a, b| compare(a.0, b.0)).map(|end| end.1);
    first.unwrap_or_else(|| Stepped {
        shape: Shape::uniform(task.wished),
        regions: Vec::new(),
    })
}

/// Compares two ends by miss and change: what meets the rows comes first, and then the less change.
pub(in crate::hollow) fn compare(a: [f64; 2], b: [f64; 2]) -> Ordering {
    let rank = |[miss, cost]: [f64; 2]| match miss <= MET {
        true => (false, cost),
        false => (true, miss),
    };
    let (a, b) = (rank(a), rank(b));
    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
}

/// Returns the mean of ½(d − wished)² over the interior for a field in regions.
pub(in crate::hollow) fn cost(task: &Task, shape: &Shape, regions: &[Region]) -> f64 {
    let change = |density: f64| 0.5 * (density - task.wished).powi(2);
    let quadric = shape.quadric();
    let (mut around, mut sum) = (0.0, 0.0);
    for region in regions {
        let volume = match region.above {
            None => task.units.interior[0],
            Some(above) => {
                let mut beyond = quadric;
                beyond.0[0] -= above;
                task.units.positive(&beyond).moments[0]
            }
        };
        sum += (change(region.density) - around) * volume;
        around = change(region.density);
    }
    sum / task.units.interior[0].max(f64::MIN_POSITIVE)
}

/// Returns the columns, or a part of them that is enough to begin with.
fn thinned(columns: &Columns) -> Columns {
    let mut step = 1;
    while columns.len() / (step * step) > MOST_COLUMNS {
        step += 1;
    }
    columns.thinned(step)
}

/// Returns the starts: for ramps first that of the least change, which may be the best itself.
fn starts(task: &Task) -> Vec<Shape> {
    let region = bounds(task.graded.columns);
    let longest_mm = region.size().max();
    let mut random = Random::new(SEED);
    let least = least_change(task.graded, task.range, task.wished).found();
    let least = least.and_then(|change| task.shape_near(&change.quadric));
    let mut starts: Vec<Shape> = least.into_iter().collect();
    while starts.len() < STARTS {
        starts.push(match task.family {
            Family::Ramp => some_ramp(task, &region, &mut random),
            Family::Sine => {
                let at = |random: &mut Random| random.between(-BESIDE, 1.0 + BESIDE);
                let share = Vector::from_fn(|_, _| at(&mut random));
                let center = region.min + region.size().component_mul(&share);
                let wave_mm = longest_mm * between_logs(WAVES, &mut random);
                Shape::Sine { center, wave_mm }
            }
        });
    }
    starts
}

fn some_ramp(task: &Task, region: &Aabb, random: &mut Random) -> Shape {
    let (height, turn) = (random.between(-1.0, 1.0), random.between(0.0, TAU));
    let across = (1.0 - height * height).max(0.0).sqrt();
    let direction = Vector::new(across * turn.cos(), across * turn.sin(), height);
    let width_mm = region.size().max() * between_logs(WIDTHS, random);
    let gradient = direction * (task.range.span() / width_mm);
    let share = Vector::from_fn(|_, _| random.between(0.25, 0.75));
    let middle = region.min + region.size().component_mul(&share);
    let middle_density = 0.5 * (task.range.low() + task.range.high());
    Shape::Ramp {
        at_origin: middle_density - gradient.dot(&middle.coords),
        gradient,
    }
}

fn between_logs([low, high]: [f64; 2], random: &mut Random) -> f64 {
    random.between(low.ln(), high.ln()).exp()
}

fn longest_side_mm(columns: &Columns) -> f64 {
    bounds(columns).size().max()
}

/// Returns the box of the columns' middles.
fn bounds(columns: &Columns) -> Aabb {
    let mut region = Aabb {
        min: Point::from(Vector::repeat(f64::INFINITY)),
        max: Point::from(Vector::repeat(f64::NEG_INFINITY)),
    };
    for (index, &[x, y]) in columns.centers.iter().enumerate() {
        for &[bottom, top] in columns.intervals_of(index) {
            region.min = region.min.inf(&Point::new(x, y, bottom));
            region.max = region.max.sup(&Point::new(x, y, top));
        }
    }
    region
}
