//! The outline of a cradle: what is left of a slab when a body is lifted out of it.

use crate::{
    geom::{Plane, Point, Vector, play::Spot},
    mesh::{MeshError, TriMesh},
};
use std::ops::Range;

/// Width of a step of the outline, mm: finer than any printer's line or pixel.
const STEP_MM: f64 = 0.02;

/// Depth by which the outline may lie deeper than needed, so that it has fewer corners, mm.
pub(super) const SPARE_MM: f64 = 0.01;

/// Distance of the points of a body that a cradle may stop, mm.
const SPACING_MM: f64 = 0.15;

/// Depth by which a relieved floor is lowered, mm: nothing on it counts as a stop.
const RELIEF_MM: f64 = 1.5;

/// Half the width over which the slope of an outline is measured, mm.
const SLOPE_MM: f64 = 0.25;

/// Least width of a groove, and of a strip between two, mm: any printer prints it.
const STRIP_MM: f64 = 1.0;

/// A view along the normal of a joint: x across, y along the normal, z along the way out.
#[derive(Clone, Copy)]
pub(crate) struct View {
    pub(crate) across: Vector,
    pub(crate) normal: Vector,
    pub(crate) out: Vector,
    offset_mm: f64,
}

impl View {
    /// Returns the view of a joint's plane with a unit direction in it as the way out.
    pub(crate) fn new(plane: &Plane, out: Vector) -> Self {
        Self {
            across: plane.normal.cross(&out),
            normal: plane.normal,
            out,
            offset_mm: plane.offset_mm,
        }
    }

    /// Returns a point's coordinates in the view.
    pub(crate) fn local(&self, p: &Point) -> Point {
        let [x, y, z] = [self.across, self.normal, self.out].map(|axis| axis.dot(&p.coords));
        Point::new(x, y - self.offset_mm, z)
    }

    /// Returns the point with these coordinates.
    pub(crate) fn model(&self, p: &Point) -> Point {
        Point::from(self.across * p.x + self.normal * (p.y + self.offset_mm) + self.out * p.z)
    }
}

/// A slab of a body between two planes along a joint, seen along the joint's normal.
pub(crate) struct Slab {
    /// The outlines of its surface's triangles within the slab.
    pieces: Vec<Vec<Spot>>,
}

impl Slab {
    /// Cuts the triangles of a surface (in a view) between two heights over the joint, mm.
    pub(crate) fn of(surface: &[[Point; 3]], [low, high]: [f64; 2]) -> Self {
        let flat = |corners: &[Point]| corners.iter().map(|p| Spot::new(p.x, p.z)).collect();
        let piece = |corners: &[Point; 3]| {
            if corners.iter().all(|p| p.y > high) || corners.iter().all(|p| p.y < low) {
                return None;
            }
            if corners.iter().all(|p| (low..=high).contains(&p.y)) {
                return Some(flat(corners));
            }
            let above = clip(corners, |p| low - p.y);
            let within = clip(&above, |p| p.y - high);
            (!within.is_empty()).then(|| flat(&within))
        };
        Self {
            pieces: surface.iter().filter_map(piece).collect(),
        }
    }

    /// Returns the least height in each step of a row; infinite where nothing lies over it.
    fn floor(&self, row: &Row) -> Vec<f64> {
        let mut floor = vec![f64::INFINITY; row.count];
        for piece in &self.pieces {
            let next = piece.iter().cycle().skip(1);
            for (a, b) in piece.iter().zip(next) {
                let (a, b) = if a.x <= b.x { (a, b) } else { (b, a) };
                let height = |x: f64| match b.x - a.x {
                    width if width > 0.0 => a.y + (b.y - a.y) * ((x - a.x) / width).clamp(0.0, 1.0),
                    _ => a.y.min(b.y),
                };
                for step in row.steps_between([a.x, b.x]) {
                    let ends = [row.at(step).max(a.x), row.at(step + 1).min(b.x)].map(height);
                    floor[step] = floor[step].min(ends[0]).min(ends[1]);
                }
            }
        }
        floor
    }

    /// Returns the least height of the slab within a window across, mm; infinite if it is empty.
    pub(crate) fn lowest_mm(&self, window: [f64; 2]) -> f64 {
        let floor = self.floor(&Row::over(window));
        floor.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Returns the cradle across a window: everywhere the gap from the slab, however far the slab
    /// is lifted.
    pub(crate) fn cradle(&self, window: [f64; 2], gap_mm: f64) -> Cradle {
        let reach_mm = gap_mm + 2.0 * STEP_MM;
        let wide = Row::over([window[0] - 2.0 * reach_mm, window[1] + 2.0 * reach_mm]);
        let (floor, row) = (self.floor(&wide), Row::over(window));
        let steps = (reach_mm / wide.step_mm).ceil() as usize + 1;
        let height = |x: f64| {
            let here = ((x - wide.low) / wide.step_mm).max(0.0) as usize;
            let near = here.saturating_sub(steps)..(here + steps + 1).min(wide.count);
            let under = near.map(|step| {
                // One step nearer, so that the sides between two corners keep the gap, too.
                let aside = (wide.at(step) - x).max(x - wide.at(step + 1)) - row.step_mm;
                let rest = gap_mm * gap_mm - aside.max(0.0).powi(2);
                if rest > 0.0 {
                    floor[step] - rest.sqrt()
                } else {
                    f64::INFINITY
                }
            });
            under.fold(f64::INFINITY, f64::min)
        };
        Cradle {
            heights: (0..=row.count).map(|step| height(row.at(step))).collect(),
            row,
        }
    }

    /// Returns points along the sides of its pieces, [`SPACING_MM`] apart at most.
    pub(super) fn points(&self) -> impl Iterator<Item = Spot> + '_ {
        let sides = self.pieces.iter().flat_map(|piece| {
            let next = piece.iter().cycle().skip(1);
            piece.iter().zip(next)
        });
        sides.flat_map(|(a, b)| {
            let (from, way) = (*a, b - a);
            let count = (way.norm() / SPACING_MM).ceil().max(1.0);
            (0..count as usize).map(move |step| from + way * (step as f64 / count))
        })
    }
}

/// The heights of a cradle in each step across, mm; infinite where no body lies over it.
pub(crate) struct Cradle {
    row: Row,
    heights: Vec<f64>,
}

impl Cradle {
    /// Returns its outline, no higher than `top_mm`. Floors less steep than `max_slope` are
    /// lowered: a body that stands on two cheeks has no play, one that lies on a floor rolls.
    pub(crate) fn outline(&self, top_mm: f64, max_slope: f64) -> Vec<Spot> {
        let relieved = self.relieved(top_mm, max_slope);
        let corner = |(step, &height): (usize, &f64)| {
            let depth_mm = if relieved[step] { RELIEF_MM } else { 0.0 };
            Spot::new(self.row.at(step), height.min(top_mm) - depth_mm)
        };
        let outline: Vec<Spot> = self.heights.iter().enumerate().map(corner).collect();
        thin(&outline)
    }

    /// Returns for each corner whether the outline is lowered there. Strips and grooves too narrow
    /// to print count as what surrounds them.
    fn relieved(&self, top_mm: f64, max_slope: f64) -> Vec<bool> {
        let (last, half) = (self.row.count, self.row.steps_in(SLOPE_MM));
        let is_flat = |step: usize| {
            let ends = [step.saturating_sub(half), (step + half).min(last)];
            let [from, to] = ends.map(|end| self.heights[end].min(top_mm));
            let width = self.row.at(ends[1]) - self.row.at(ends[0]);
            self.heights[step] < top_mm && (to - from).abs() < max_slope * width
        };
        let mut relieved: Vec<bool> = (0..=last).map(is_flat).collect();
        for kind in [true, false] {
            drop_short_runs(&mut relieved, kind, self.row.steps_in(STRIP_MM));
        }
        relieved
    }
}

/// Turns runs of one kind that are shorter than `least` into the other kind.
fn drop_short_runs(flags: &mut [bool], kind: bool, least: usize) {
    for run in flags.chunk_by_mut(|a, b| a == b) {
        if run[0] == kind && run.len() < least {
            run.fill(!kind);
        }
    }
}

/// A row of equal steps across a view.
struct Row {
    low: f64,
    step_mm: f64,
    count: usize,
}

impl Row {
    fn over([low, high]: [f64; 2]) -> Self {
        let count = ((high - low) / STEP_MM).ceil().max(1.0);
        Self {
            low,
            step_mm: (high - low) / count,
            count: count as usize,
        }
    }

    /// Returns the number of steps in a width.
    fn steps_in(&self, width_mm: f64) -> usize {
        (width_mm / self.step_mm).round() as usize
    }

    /// Returns the place at which a step begins.
    fn at(&self, step: usize) -> f64 {
        self.low + self.step_mm * step as f64
    }

    /// Returns the steps that a stretch touches.
    fn steps_between(&self, stretch: [f64; 2]) -> Range<usize> {
        let [from, to] = stretch.map(|x| (x - self.low) / self.step_mm);
        if to < 0.0 || from > self.count as f64 {
            return 0..0;
        }
        (from.max(0.0) as usize).min(self.count)..(to as usize + 1).min(self.count)
    }
}

/// Returns the part of a convex polygon in space where `excess` is not positive.
fn clip(polygon: &[Point], excess: impl Fn(&Point) -> f64) -> Vec<Point> {
    let next = polygon.iter().cycle().skip(1);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (a, b) in polygon.iter().zip(next) {
        let (over_a, over_b) = (excess(a), excess(b));
        if over_a <= 0.0 {
            kept.push(*a);
        }
        if (over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0) {
            kept.push(a + (b - a) * (over_a / (over_a - over_b)));
        }
    }
    kept
}

/// Lowers an outline a little and takes corners out of it, so that it lies nowhere higher than
/// before, and deeper by [`SPARE_MM`] at most.
fn thin(outline: &[Spot]) -> Vec<Spot> {
    let lower = |corner: &Spot| Spot::new(corner.x, corner.y - 0.5 * SPARE_MM);
    let outline: Vec<Spot> = outline.iter().map(lower).collect();
    let mut kept: Vec<Spot> = outline.first().copied().into_iter().collect();
    let mut from = 0;
    while from + 1 < outline.len() {
        let count = count_straight(&outline[from..]);
        from += count;
        kept.push(outline[from]);
    }
    kept
}

/// Returns the number of steps from the first corner to the last one whose chord hardly leaves the
/// corners between; one at least.
fn count_straight(outline: &[Spot]) -> usize {
    let first = outline[0];
    // The slopes of the chords that pass all corners so far.
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut count = 1;
    for (step, corner) in outline.iter().enumerate().skip(1) {
        let across = corner.x - first.x;
        let slope = (corner.y - first.y) / across;
        if step > 1 && !(least..=most).contains(&slope) {
            break;
        }
        count = step;
        least = least.max(slope - 0.5 * SPARE_MM / across);
        most = most.min(slope + 0.5 * SPARE_MM / across);
    }
    count
}

/// Returns the closed body under an outline down to `low_mm`, between two heights over the joint,
/// in the view.
pub(crate) fn body_under(
    outline: &[Spot],
    low_mm: f64,
    [near, far]: [f64; 2],
) -> Result<TriMesh, MeshError> {
    let corners = outline.iter().flat_map(|corner| {
        let at = |y: f64, z: f64| Point::new(corner.x, y, z);
        [
            at(near, low_mm),
            at(near, corner.y),
            at(far, low_mm),
            at(far, corner.y),
        ]
    });
    let count = outline.len() as u32;
    let quads = (0..count - 1).flat_map(|i| {
        let [a, b] = [4 * i, 4 * i + 4];
        [
            [a, b, b + 1, a + 1],
            [a + 2, a + 3, b + 3, b + 2],
            [a + 1, b + 1, b + 3, a + 3],
            [a, a + 2, b + 2, b],
        ]
    });
    let end = 4 * (count - 1);
    let ends = [[0, 1, 3, 2], [end, end + 2, end + 3, end + 1]];
    let triangles = quads
        .chain(ends)
        .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    TriMesh::new(corners.collect(), triangles.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::joints::stops::stops_at;
    use crate::cut::scenes::ball;
    use crate::geom::Bvh;

    #[test]
    fn a_cradle_keeps_its_gap_from_a_ball_wherever_it_is_lifted() {
        let surface = ball([0.0; 3], 10.0);
        let corners: Vec<[Point; 3]> = surface.mesh().iter_corners().collect();
        let slab = Slab::of(&corners, [1.0, 3.0]);
        let outline = slab.cradle([-12.0, 12.0], 0.2).outline(-2.0, 0.0);
        assert!(outline.windows(2).all(|side| side[0].x < side[1].x));
        let body = body_under(&outline, -14.0, [1.2, 2.8]).unwrap();
        assert!(body.signed_volume_mm3() > 0.0);
        let ball = Bvh::new(surface.mesh().iter_corners());
        let gap = |lift: f64| {
            let corners = body.iter_corners();
            let lowered = corners.map(|corners| corners.map(|p| p - Vector::z() * lift));
            let gaps = lowered.map(|corners| ball.triangle_distance(&corners, 9.0));
            gaps.fold(9.0, f64::min)
        };
        let gaps = [0.0, 0.5, 2.0, 5.0].map(gap);
        assert!(gaps.iter().all(|gap| *gap >= 0.2), "{gaps:?}");
        assert!(gaps[0] < 0.2 + 2.0 * (STEP_MM + SPARE_MM), "{gaps:?}");
    }

    #[test]
    fn a_thinned_outline_is_nowhere_higher_and_hardly_deeper() {
        let wave = |x: f64| (x * 0.7).sin() + 0.1 * (x * 5.0).cos();
        let outline = (0..2000).map(|step| f64::from(step) * 0.01);
        let outline: Vec<Spot> = outline.map(|x| Spot::new(x, wave(x))).collect();
        let few = thin(&outline);
        assert!(few.len() < outline.len() / 10, "{}", few.len());
        for corner in &outline {
            let at = few.partition_point(|kept| kept.x < corner.x).max(1);
            let [a, b] = [few[at - 1], few[at]];
            let height = a.y + (b.y - a.y) * (corner.x - a.x) / (b.x - a.x);
            assert!((-1e-8..SPARE_MM + 1e-8).contains(&(corner.y - height)));
        }
    }

    #[test]
    fn a_relieved_cradle_of_a_ball_touches_it_with_its_cheeks_only() {
        let surface = ball([0.0; 3], 10.0);
        let corners: Vec<[Point; 3]> = surface.mesh().iter_corners().collect();
        let slab = Slab::of(&corners, [-1.0, 1.0]);
        let cradle = slab.cradle([-12.0, 12.0], 0.2);
        let [whole, relieved] = [0.0, 0.7].map(|slope| cradle.outline(-2.0, slope));
        let lowest = |outline: &[Spot]| outline.iter().map(|c| c.y).fold(f64::INFINITY, f64::min);
        let deeper_mm = lowest(&whole) - lowest(&relieved);
        assert!((deeper_mm - RELIEF_MM).abs() < SPARE_MM, "{deeper_mm}");
        // A slope of 0.7 is that of a circle of 10.2 mm at 5.8 mm beside its middle. The ball has
        // facets, and points just before the wall of the groove count as near.
        let points: Vec<Spot> = slab.points().collect();
        let stops = stops_at(&points, &relieved, 1.0);
        // The walls of the groove stop it too, but only after a long way.
        let near = stops.iter().filter(|stop| stop.room_mm < 0.25);
        let inmost = near.map(|stop| stop.at.x.abs());
        let inmost_mm = inmost.fold(f64::INFINITY, f64::min);
        assert!((5.0..6.6).contains(&inmost_mm), "{inmost_mm}");
    }
}
