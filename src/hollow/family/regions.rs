//! The nested regions in which a field is printed: each has the printable density nearest to it.

use std::f64::consts::{PI, TAU};

use super::shape::Shape;
use crate::field::DensityRange;
use crate::geom::Point;
use crate::interior::Columns;

/// Most regions of a field: slicers get slow with more modifiers.
const MAX_REGIONS: usize = 12;

/// A region of one density, less the regions in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// The value above which the field's quadric is in the region; `None` for all of the interior.
    pub above: Option<f64>,
    /// The density.
    pub density: f64,
}

/// Returns the regions of a field with these densities, ascending; the outermost first.
///
/// They are at most twelve. Those of a wave that no column reaches are left out. One with more is
/// not printed as it is: see [`is_cut`].
pub(in crate::hollow) fn regions(
    shape: &Shape,
    densities: &[f64],
    columns: &Columns,
) -> Vec<Region> {
    match *shape {
        Shape::Ramp { .. } => of_ramp(densities),
        Shape::Sine { center, wave_mm } => {
            let reach = reach_mm(columns, &center).map(|mm| mm * TAU / wave_mm);
            of_sine(densities, reach)
        }
    }
}

/// Returns whether a field has more regions than are printed.
pub(in crate::hollow) fn is_cut(shape: &Shape, densities: &[f64], columns: &Columns) -> bool {
    let ends = densities.first().zip(densities.last());
    let range = ends.and_then(|(low, high)| DensityRange::new(*low, *high).ok());
    match (*shape, range) {
        (Shape::Sine { center, wave_mm }, Some(range)) => {
            let reach = reach_mm(columns, &center).map(|mm| mm * TAU / wave_mm);
            phases(densities, range, reach).len() >= MAX_REGIONS
        }
        _ => false,
    }
}

/// Returns the phases at which a wave steps, ascending: all of them, or some more than are printed.
fn phases(densities: &[f64], range: DensityRange, [nearest, farthest]: [f64; 2]) -> Vec<f64> {
    // A wave has two steps at the least. Of a very short one no more are counted.
    let farthest = farthest.min(nearest + TAU * MAX_REGIONS as f64);
    let mut phases: Vec<f64> = Vec::new();
    for pair in densities.windows(2) {
        let middle = 0.5 * (pair[0] + pair[1]);
        let angle = (2.0 * (middle - range.low()) / range.span() - 1.0).asin();
        // Once on the way up and once on the way down in every wave.
        for first in [angle.rem_euclid(TAU), (PI - angle).rem_euclid(TAU)] {
            let before = ((nearest - first) / TAU).floor().max(-1.0);
            let waves = ((farthest - first) / TAU).floor() - before;
            let own = (1..=waves.max(0.0) as i64).map(|wave| first + TAU * (before + wave as f64));
            phases.extend(own);
        }
    }
    phases.retain(|phase| *phase > nearest && *phase < farthest);
    phases.sort_by(f64::total_cmp);
    phases
}

fn of_ramp(densities: &[f64]) -> Vec<Region> {
    let greatest = densities.last().map(|density| Region {
        above: None,
        density: *density,
    });
    let inner = densities.windows(2).rev().map(|pair| Region {
        above: Some(-0.5 * (pair[0] + pair[1])),
        density: pair[0],
    });
    greatest.into_iter().chain(inner).collect()
}

/// Returns the regions of a wave between two phases, those of the nearest and the farthest place.
fn of_sine(densities: &[f64], [nearest, farthest]: [f64; 2]) -> Vec<Region> {
    let ends = densities.first().zip(densities.last());
    let range = ends.and_then(|(low, high)| DensityRange::new(*low, *high).ok());
    let Some(range) = range else {
        return of_ramp(densities);
    };
    let mut phases = phases(densities, range, [nearest, farthest]);
    phases.truncate(MAX_REGIONS - 1);
    let density = |from: f64, to: f64| {
        let value = range.low() + range.span() * 0.5 * (1.0 + (0.5 * (from + to)).sin());
        let off = |density: &&f64| (**density - value).abs();
        let nearest = densities.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.copied().unwrap_or(range.low())
    };
    let ends: Vec<f64> = std::iter::once(nearest)
        .chain(phases.iter().copied())
        .collect();
    let outer = |index: usize| ends.get(index + 1).copied();
    let region = |(index, from): (usize, &f64)| {
        let to = outer(index)
            .unwrap_or_else(|| (from + next_step(densities, range, *from)).min(farthest));
        Region {
            above: outer(index).map(|phase| -phase * phase),
            density: density(*from, to),
        }
    };
    let mut regions: Vec<Region> = ends.iter().enumerate().map(region).collect();
    regions.reverse();
    regions
}

/// Returns the phase from one step of a wave to the next.
fn next_step(densities: &[f64], range: DensityRange, from: f64) -> f64 {
    let steps = densities.windows(2).flat_map(|pair| {
        let middle = 0.5 * (pair[0] + pair[1]);
        let angle = (2.0 * (middle - range.low()) / range.span() - 1.0).asin();
        [angle, PI - angle].map(|at| (at - from - 1e-9).rem_euclid(TAU))
    });
    steps.fold(TAU, f64::min)
}

/// Returns the least and the greatest distance of the columns from a point, mm.
fn reach_mm(columns: &Columns, center: &Point) -> [f64; 2] {
    let mut reach = [f64::INFINITY, 0.0];
    for (index, &[x, y]) in columns.centers.iter().enumerate() {
        let aside = (x - center.x).hypot(y - center.y);
        for &[bottom, top] in columns.intervals_of(index) {
            let near = center.z.clamp(bottom, top) - center.z;
            let far = (bottom - center.z).abs().max((top - center.z).abs());
            reach[0] = reach[0].min(aside.hypot(near));
            reach[1] = reach[1].max(aside.hypot(far));
        }
    }
    [reach[0].min(reach[1]), reach[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::testing::leaning_block;

    #[test]
    fn a_region_has_the_density_nearest_to_the_wave_everywhere() {
        let densities = [0.2, 0.5, 0.8];
        let wave = |phase: f64| 0.2 + 0.6 * 0.5 * (1.0 + phase.sin());
        for (nearest, farthest) in [(0.0, 9.0), (1.7, 8.0), (4.0, 4.5)] {
            let regions = of_sine(&densities, [nearest, farthest]);
            assert!(regions[0].above.is_none() && regions.len() <= MAX_REGIONS);
            for step in 1..400 {
                let phase = nearest + (farthest - nearest) * f64::from(step) / 400.0;
                let inner = regions.iter().rev();
                let mut holding =
                    inner.filter(|it| it.above.is_none_or(|above| -phase * phase > above));
                let printed = holding.next().unwrap().density;
                let off = (printed - wave(phase)).abs();
                assert!(off <= 0.15 + 1e-9, "{phase}: {printed} {}", wave(phase));
            }
        }
    }

    #[test]
    fn a_wave_too_short_for_twelve_regions_is_cut_and_takes_no_memory() {
        let columns = leaning_block(0.5);
        let wave = |wave_mm: f64| Shape::Sine {
            center: Point::new(30.0, 0.0, 0.0),
            wave_mm,
        };
        let [near, far] = reach_mm(&columns, &Point::new(30.0, 0.0, 0.0));
        let span_mm = far - near;
        for (waves, cut) in [(1.0, false), (2.0, false), (4.0, true), (1e12, true)] {
            let found = is_cut(&wave(span_mm / waves), &[0.2, 0.5, 0.8], &columns);
            assert_eq!(found, cut, "{waves} waves");
        }
        let shortest = regions(&wave(1e-9), &[0.2, 0.5, 0.8], &columns);
        assert_eq!(shortest.len(), MAX_REGIONS);
    }

    #[test]
    fn regions_that_no_column_reaches_are_left_out() {
        let columns = leaning_block(0.5);
        let [near, far] = reach_mm(&columns, &Point::new(30.0, 0.0, 0.0));
        assert!(near > 20.0 && far < 40.0 && near < far);
        let shape = Shape::Sine {
            center: Point::new(30.0, 0.0, 0.0),
            wave_mm: 2.0 * (far - near),
        };
        let found = regions(&shape, &[0.2, 0.5, 0.8], &columns);
        // Half a wave has two steps, and where it begins and ends one more.
        assert!((2..=4).contains(&found.len()), "{found:?}");
    }
}
