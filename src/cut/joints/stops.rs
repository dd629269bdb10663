//! The sides of a cradle's outline that stop a point of a body.

use crate::geom::play::{Spot, Stop, Way};
use std::{collections::BTreeMap, ops::Range};

/// Sectors of direction and of place in each of which only the nearest stop counts.
const SECTORS: f64 = 36.0;

/// Least part of the way to the outline that is normal to it, if it is to stop a point. A judge
/// allows 0.99: what stops a point here then does so for the judge, too.
const FACING_RATIO: f64 = 0.999;

/// Steepness up to which a side is a floor; steeper ones are walls.
const FLOOR_SLOPE: f64 = 1.0;

/// Returns all stops of a body in a cradle: its points near the outline, each with the nearest
/// floor, left wall and right wall.
pub(super) fn all_stops_at(points: &[Spot], outline: &[Spot], reach_mm: f64) -> Vec<Stop> {
    let sides = Sides::of(outline, reach_mm);
    points.iter().flat_map(|at| sides.touched_by(at)).collect()
}

/// Returns the nearest of these stops in each sector. Motions that only the others stop stay free:
/// the play of few stops is an estimate.
pub(super) fn stops_at(points: &[Spot], outline: &[Spot], reach_mm: f64) -> Vec<Stop> {
    let mut nearest: BTreeMap<[i64; 2], Stop> = BTreeMap::new();
    let (Some(first), Some(last)) = (outline.first(), outline.last()) else {
        return Vec::new();
    };
    let width = (last.x - first.x).max(f64::MIN_POSITIVE);
    for stop in all_stops_at(points, outline, reach_mm) {
        let turn = stop.normal.y.atan2(stop.normal.x) / std::f64::consts::TAU;
        let place = (stop.at.x - first.x) / width;
        let sector = [turn, place].map(|share| (share * SECTORS).floor() as i64);
        let known = nearest.entry(sector).or_insert(stop);
        if stop.room_mm < known.room_mm {
            *known = stop;
        }
    }
    nearest.into_values().collect()
}

/// The sides of an outline, sorted into columns across, so that a point looks at few of them.
pub(super) struct Sides {
    sides: Vec<Side>,
    columns: Vec<Column>,
    /// The place across at which the first column begins, mm.
    low: f64,
    reach_mm: f64,
}

/// One side of an outline.
struct Side {
    from: Spot,
    along: Way,
    kind: Kind,
    /// The heights of its ends, the lower first, mm.
    heights: [f64; 2],
}

/// The motions that a side stops.
#[derive(Clone, Copy)]
enum Kind {
    Floor,
    LeftWall,
    RightWall,
}

/// The sides that a point within a column can touch.
struct Column {
    sides: Range<usize>,
    /// The greatest height of them, mm.
    top: f64,
}

impl Side {
    fn between(from: Spot, to: Spot) -> Self {
        let along = to - from;
        let kind = match along.y / along.x {
            slope if slope.abs() <= FLOOR_SLOPE => Kind::Floor,
            slope if slope < 0.0 => Kind::LeftWall,
            _ => Kind::RightWall,
        };
        Self {
            from,
            along,
            kind,
            heights: [from.y.min(to.y), from.y.max(to.y)],
        }
    }

    /// Returns the way from a point to the nearest place of the side, mm.
    fn way_from(&self, at: &Spot) -> Way {
        let share = (at - self.from).dot(&self.along) / self.along.norm_squared();
        self.from + self.along * share.clamp(0.0, 1.0) - at
    }
}

impl Sides {
    /// Sorts the sides of an outline that runs from left to right, for points that it may stop
    /// within a distance.
    pub(super) fn of(outline: &[Spot], reach_mm: f64) -> Self {
        let sides = outline.windows(2);
        let sides: Vec<Side> = sides.map(|ends| Side::between(ends[0], ends[1])).collect();
        let ends = [outline.first(), outline.last()];
        let [low, high] = ends.map(|end| end.map_or(0.0, |spot| spot.x));
        let [low, high] = [low - reach_mm, high + reach_mm];
        let count = ((high - low) / reach_mm).ceil().max(1.0) as usize;
        let column = |index: usize| {
            let left = low + reach_mm * index as f64;
            let near = [left - reach_mm, left + 2.0 * reach_mm];
            let first = sides.partition_point(|side| side.from.x + side.along.x < near[0]);
            let end = sides.partition_point(|side| side.from.x <= near[1]);
            let sides = &sides[first..end.max(first)];
            let heights = sides.iter().map(|side| side.heights[1]);
            Column {
                sides: first..end.max(first),
                top: heights.fold(f64::NEG_INFINITY, f64::max),
            }
        };
        Self {
            columns: (0..count).map(column).collect(),
            sides,
            low,
            reach_mm,
        }
    }

    /// Returns the stops of one point of a body: at the nearest floor and walls within reach.
    pub(super) fn touched_by(&self, at: &Spot) -> impl Iterator<Item = Stop> + use<> {
        let mut found: [Option<Stop>; 3] = [None; 3];
        for side in self.near(at) {
            let known = &mut found[side.kind as usize];
            let farthest_mm = known.map_or(self.reach_mm, |stop: Stop| stop.room_mm);
            let way = side.way_from(at);
            let room_mm = way.norm();
            // Beside a corner there is room to pass it.
            let is_ahead =
                || way.perp(&side.along).abs() >= FACING_RATIO * room_mm * side.along.norm();
            if room_mm > 0.0 && room_mm <= farthest_mm && is_ahead() {
                *known = Some(Stop {
                    at: *at,
                    normal: way / room_mm,
                    room_mm,
                });
            }
        }
        found.into_iter().flatten()
    }

    /// Returns the column of a point, unless the point is too high over all its sides.
    fn column(&self, at: &Spot) -> Option<&Column> {
        let place = (at.x - self.low) / self.reach_mm;
        let column = (place >= 0.0).then(|| self.columns.get(place as usize));
        let is_below = |column: &&Column| at.y <= column.top + self.reach_mm;
        column.flatten().filter(is_below)
    }

    /// Returns true if the outline, or a lower one, may be within reach of a point.
    pub(super) fn is_near(&self, at: &Spot) -> bool {
        self.column(at).is_some()
    }

    /// Returns the sides that may be within reach of a point, from left to right.
    fn near(&self, at: &Spot) -> impl Iterator<Item = &Side> {
        let sides = self.column(at);
        let sides = sides.map_or(&[][..], |column| &self.sides[column.sides.clone()]);
        let [low, high] = [at.y - self.reach_mm, at.y + self.reach_mm];
        let is_level = move |side: &&Side| side.heights[0] <= high && side.heights[1] >= low;
        sides.iter().filter(is_level)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touches(at: Spot, outline: &[(f64, f64)]) -> Vec<Stop> {
        let outline: Vec<Spot> = outline.iter().map(|&(x, y)| Spot::new(x, y)).collect();
        Sides::of(&outline, 1.0).touched_by(&at).collect()
    }

    #[test]
    fn a_point_beside_a_corner_is_not_stopped_by_it() {
        let outline = [(-4.0, 0.0), (-1.0, 0.0), (-1.0 + 1e-6, -2.0), (4.0, -2.0)];
        let above = touches(Spot::new(-2.0, 0.1), &outline);
        assert!(matches!(above[..], [stop] if (stop.room_mm - 0.1).abs() < 1e-9));
        // It lies 0.1 mm higher than the corner, and 0.3 mm beside it.
        assert_eq!(touches(Spot::new(-0.7, 0.1), &outline), vec![]);
        // Hardly past the corner, at an angle of 5°.
        assert_eq!(touches(Spot::new(-0.99, 0.115), &outline), vec![]);
    }

    #[test]
    fn no_column_hides_a_side_within_reach() {
        // A valley with walls at all slopes, and points all over it.
        let outline = (0..=60).map(|step| {
            let x = 0.1 * f64::from(step) - 3.0;
            (x, 0.4 * x.powi(4) / 9.0 + 0.3 * (7.0 * x).sin())
        });
        let outline: Vec<(f64, f64)> = outline.collect();
        let whole: Vec<Side> = outline
            .windows(2)
            .map(|ends| {
                let [from, to] = [ends[0], ends[1]].map(|(x, y)| Spot::new(x, y));
                Side::between(from, to)
            })
            .collect();
        let mut count = 0;
        for index in 0..4000 {
            // Roberts' R2 fills the plane without regularity.
            let share = |step: f64| (f64::from(index) * step).fract();
            let at = Spot::new(
                9.0 * share(0.754_877_7) - 4.5,
                6.0 * share(0.569_840_3) - 1.0,
            );
            let faces = |side: &&Side| {
                let way = side.way_from(&at);
                let facing = way.perp(&side.along).abs() / (way.norm() * side.along.norm());
                way.norm() <= 1.0 && facing >= FACING_RATIO
            };
            let nearest = whole
                .iter()
                .filter(faces)
                .map(|side| side.way_from(&at).norm());
            let nearest_mm = nearest.fold(f64::INFINITY, f64::min);
            let found = touches(at, &outline);
            let found_mm = found.iter().map(|stop| stop.room_mm);
            assert_eq!(found_mm.fold(f64::INFINITY, f64::min), nearest_mm, "{at}");
            count += found.len();
        }
        assert!(count > 1000, "{count}");
    }
}
