//! Play: how far a body moves in a plane between stops, such as pins in their sockets.
//!
//! A small motion is a shift t and a turn θ. It moves the point p by t + θ·Jp, where J turns by a
//! right angle. A stop limits the motion of one point along one direction. All motions between
//! stops form a convex body. A point moves farthest at its border, which is searched turn by turn:
//! for one turn the shifts form a convex polygon.

use serde::{Deserialize, Serialize};

mod slices;

use self::slices::{Slice, slices_between};
use super::hull::convex_hull;

/// A position in the plane, mm.
pub type Spot = nalgebra::Point2<f64>;

/// A direction in the plane, or a displacement, mm.
pub type Way = nalgebra::Vector2<f64>;

/// Sides of the polygon around the circle in which a round pin moves. It lies outside the circle by
/// 0.2 %, so the play is never stated too small.
const SIDES: usize = 48;

/// The largest shift that counts as stopped, mm: far above the play of any pin.
const FARTHEST_MM: f64 = 20.0;

/// The largest turn that counts as stopped, radians: a joint that turns farther is not aligned.
const LARGEST_TURN_RAD: f64 = 0.2;

/// Number of directions in which two bodies move apart: their step is right to 0.1 %.
const WAYS: usize = 72;

/// Number of turns that are looked at in either sense.
const TURNS: usize = 16;

/// Steps of a bisection or a golden section: they leave less than a part in a million.
const STEPS: usize = 30;

/// Steps of the golden section for the deepest motion. They leave a part in a hundred millions:
/// less than 0.1 µm at any rim.
const PEAK_STEPS: usize = 40;

/// A stop: the body's point at `at` moves along `normal` by no more than `room_mm`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// The place of the stop.
    pub at: Spot,
    /// The unit direction in which it stops the body.
    pub normal: Way,
    /// The room before the body touches it, mm.
    pub room_mm: f64,
}

/// The play of a body between stops.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Play {
    /// The largest shift without a turn, mm.
    pub shift_mm: f64,
    /// The largest turn, degrees.
    pub turn_deg: f64,
    /// The largest displacement of any point of the rim, mm.
    pub step_mm: f64,
}

impl Stop {
    /// Returns the stops of a round pin that has room on each side.
    pub fn around(at: Spot, room_mm: f64) -> impl Iterator<Item = Self> {
        (0..SIDES).map(move |side| {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / SIDES as f64).sin_cos();
            Self {
                at,
                normal: Way::new(cos, sin),
                room_mm,
            }
        })
    }
}

impl Play {
    /// Measures the play between stops; `rim` holds the corners whose step is asked for. `None` if
    /// the stops leave a shift or a turn free.
    ///
    /// Some milliseconds for a hundred stops; the step is right to 0.3 %.
    pub fn of(stops: &[Stop], rim: &[Spot]) -> Option<Self> {
        let body = Between::new(stops, rim, middle_of(stops));
        let ends = [body.farthest_turn(-1.0)?, body.farthest_turn(1.0)?];
        let shift_mm = largest(body.shifts(0.0)?.iter().map(|shift| shift.norm()));
        let turn = ends[1].max(-ends[0]);
        let steps = ends.map(|end| body.largest_step(end));
        Some(Self {
            shift_mm,
            turn_deg: turn.to_degrees(),
            step_mm: steps[0]?.max(steps[1]?),
        })
    }
}

/// Returns an upper bound of the step at the rim, mm, for round pins with room on each side; exact
/// for two. Infinite for fewer.
///
/// In closed form. With two pins at ±L/2 on the x-axis, the motion is greatest if both touch and
/// turn the body. A point (x, y) then moves by √λ of the room. Here λ is the larger eigenvalue of
/// the matrix with the rows (1, −2y/L) and (−2y/L, 4(x² + y²)/L²). Of more pins each pair bounds
/// it.
pub fn step_bound_mm(pins: &[Spot], room_mm: f64, rim: &[Spot]) -> f64 {
    let pairs = || (0..pins.len()).flat_map(|i| (0..i).map(move |j| [pins[i], pins[j]]));
    if pairs().next().is_none() {
        return f64::INFINITY;
    }
    let by_pair = |spot: &Spot, [a, b]: [Spot; 2]| {
        let (along, arm) = (b - a, spot - nalgebra::center(&a, &b));
        let squared = along.norm_squared();
        let reach = 4.0 * arm.norm_squared() / squared;
        let aside = 4.0 * (along.perp(&arm) / squared).powi(2);
        0.5 * (1.0 + reach + ((1.0 - reach).powi(2) + 4.0 * aside).sqrt())
    };
    let least = |spot: &Spot| {
        let factors = pairs().map(|pair| by_pair(spot, pair));
        factors.fold(f64::INFINITY, f64::min)
    };
    room_mm * largest(rim.iter().map(least)).max(1.0).sqrt()
}

/// Returns the corners of the convex hull of a rim: no other point of it moves farther.
pub fn corners_of(rim: impl IntoIterator<Item = Spot>) -> Vec<Spot> {
    let points = rim.into_iter().map(|spot| [spot.x, spot.y]).collect();
    convex_hull(points).into_iter().map(Spot::from).collect()
}

/// Returns the largest distance of two corners, mm; zero if there are fewer.
pub fn extent_mm(corners: &[Spot]) -> f64 {
    let from = |a: &Spot| largest(corners.iter().map(|b| (a - b).norm()));
    largest(corners.iter().map(from))
}

/// A body pressed into a cradle: all motions in which it touches the cradle, about a middle.
#[derive(Debug, Clone, PartialEq)]
pub struct Seat {
    slices: Vec<Slice>,
}

impl Seat {
    /// Returns the motions of a body between stops that is pressed at a point along a direction. It
    /// comes within the room of `press` of the end of that way. `None` if the stops leave it free
    /// to slide or turn even so. `middle` is that of all seats that are compared.
    pub fn pressed(stops: &[Stop], press: &Stop, middle: Spot) -> Option<Self> {
        let mut body = Between::new(stops, &[], middle.coords);
        let at = press.at - middle.coords;
        let depth = |turn: f64| {
            let moved = press.normal.dot(&Way::new(-at.y, at.x)) * turn;
            let shifts = body.clipped(turn);
            let depths = shifts.iter().map(|shift| press.normal.dot(shift) + moved);
            depths.fold(f64::NEG_INFINITY, f64::max)
        };
        let ends = [-1.0, 1.0].map(|sense| body.last_turn(sense, 0.0));
        let (rest, deepest) = peak(depth, ends);
        if deepest >= 0.5 * FARTHEST_MM {
            return None;
        }
        body.stops.push(Stop {
            at,
            normal: -press.normal,
            room_mm: press.room_mm - deepest,
        });
        let ends = [-1.0, 1.0].map(|sense| body.last_turn(sense, rest));
        let is_free = |end: &f64| end.abs() >= LARGEST_TURN_RAD * (1.0 - f64::EPSILON.sqrt());
        if ends.iter().any(is_free) {
            return None;
        }
        let slices = body.slices_between(ends)?;
        (!slices.is_empty()).then_some(Self { slices })
    }

    /// Returns the play between two seated bodies about one middle. The step is right to 0.1 % and
    /// a micrometre.
    pub fn play_between(&self, other: &Self, middle: Spot, rim: &[Spot]) -> Play {
        let ways: Vec<Apart> = (0..WAYS)
            .map(|side| Apart::along(side, [self, other]))
            .collect();
        let apart = |spot: &Spot| largest(ways.iter().map(|way| way.at(spot)));
        let turns = |seat: &Self| {
            let turns = seat.slices.iter().map(|slice| slice.turn);
            turns.fold([0.0; 2], |[low, high]: [f64; 2], turn| {
                [low.min(turn), high.max(turn)]
            })
        };
        let ([low, high], [other_low, other_high]) = (turns(self), turns(other));
        let rim = corners_of(rim.iter().map(|spot| spot - middle.coords));
        Play {
            shift_mm: apart(&Spot::origin()),
            turn_deg: (high - other_low).max(other_high - low).to_degrees(),
            step_mm: largest(rim.iter().map(apart)),
        }
    }
}

/// Two seated bodies that move apart along a direction.
struct Apart {
    way: Way,
    /// Turns of each body, with its greatest shift along the direction or against it.
    reaches: [Vec<(f64, f64)>; 2],
}

impl Apart {
    /// Looks along one of [`WAYS`] directions; the second body moves against it.
    fn along(side: usize, seats: [&Seat; 2]) -> Self {
        let (sin, cos) = (std::f64::consts::TAU * side as f64 / WAYS as f64).sin_cos();
        let way = Way::new(cos, sin);
        let reaches = |seat: &Seat, way: Way| {
            let slices = seat.slices.iter();
            slices
                .map(|slice| (slice.turn, slice.reach_mm(&way)))
                .collect()
        };
        let [one, other] = seats;
        Self {
            way,
            reaches: [reaches(one, way), reaches(other, -way)],
        }
    }

    /// Returns how far a point of both moves apart along the direction, mm.
    fn at(&self, spot: &Spot) -> f64 {
        let lever = self.way.dot(&Way::new(-spot.y, spot.x));
        let most = |reaches: &[(f64, f64)], lever: f64| {
            let moved = reaches.iter().map(|(turn, shift)| shift + turn * lever);
            moved.fold(f64::NEG_INFINITY, f64::max)
        };
        most(&self.reaches[0], lever) + most(&self.reaches[1], -lever)
    }
}

/// Returns the place of the peak of a concave function between two ends, and its height.
///
/// A golden section: each step keeps one of its two heights for the next.
fn peak(height: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> (f64, f64) {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let inner = |low: f64, high: f64| [high - share * (high - low), low + share * (high - low)];
    let mut places = inner(low, high);
    let mut heights = places.map(&height);
    for _ in 0..PEAK_STEPS {
        if heights[0] < heights[1] {
            low = places[0];
            let right = inner(low, high)[1];
            (places, heights) = ([places[1], right], [heights[1], height(right)]);
        } else {
            high = places[1];
            let left = inner(low, high)[0];
            (places, heights) = ([left, places[0]], [height(left), heights[0]]);
        }
    }
    let best = usize::from(heights[0] < heights[1]);
    (places[best], heights[best])
}

/// Returns the mean place of stops; the origin without any.
fn middle_of(stops: &[Stop]) -> Way {
    let count = stops.len().max(1) as f64;
    stops.iter().map(|stop| stop.at.coords).sum::<Way>() / count
}

/// Stops and rim about a middle.
struct Between {
    stops: Vec<Stop>,
    rim: Vec<Spot>,
}

impl Between {
    fn new(stops: &[Stop], rim: &[Spot], middle: Way) -> Self {
        let about = |stop: &Stop| Stop {
            at: stop.at - middle,
            ..*stop
        };
        Self {
            stops: stops.iter().map(about).collect(),
            rim: corners_of(rim.iter().map(|spot| spot - middle)),
        }
    }

    /// Returns the corners of the polygon of all shifts with a turn; `None` if no shift goes with
    /// it, or a shift has no end.
    fn shifts(&self, turn: f64) -> Option<Vec<Way>> {
        let shifts = self.clipped(turn);
        (!shifts.is_empty() && shifts.iter().all(has_end)).then_some(shifts)
    }

    /// Returns slices of which every free motion between two turns is a mean, to a micrometre;
    /// `None` if a shift has no end.
    fn slices_between(&self, ends: [f64; 2]) -> Option<Vec<Slice>> {
        let slices = slices_between(ends, TURNS, |turn| self.clipped(turn));
        let has_ends = |slice: &Slice| slice.shifts.iter().all(has_end);
        slices.iter().all(has_ends).then_some(slices)
    }

    fn clipped(&self, turn: f64) -> Vec<Way> {
        let far = FARTHEST_MM;
        let mut shifts: Vec<Way> = [(far, far), (-far, far), (-far, -far), (far, -far)]
            .map(|(x, y)| Way::new(x, y))
            .into();
        for stop in &self.stops {
            let moved = Way::new(-stop.at.y, stop.at.x) * turn;
            let room_mm = stop.room_mm - stop.normal.dot(&moved);
            let excess = |shift: &Way| stop.normal.dot(shift) - room_mm;
            // Most stops are behind others.
            if shifts.iter().any(|shift| excess(shift) > 0.0) {
                shifts = clip(&shifts, excess);
            }
        }
        shifts
    }

    /// Returns the largest turn in one sense, radians; `None` if nothing stops it.
    fn farthest_turn(&self, sense: f64) -> Option<f64> {
        let end = self.last_turn(sense, 0.0);
        (end.abs() < LARGEST_TURN_RAD).then_some(end)
    }

    /// Returns the last turn in one sense, from one that is possible, radians; the largest turn
    /// that is looked at if nothing stops it before.
    fn last_turn(&self, sense: f64, from: f64) -> f64 {
        let (mut low, mut high) = (from, sense * LARGEST_TURN_RAD);
        if !self.clipped(high).is_empty() {
            return high;
        }
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            if self.clipped(middle).is_empty() {
                high = middle;
            } else {
                low = middle;
            }
        }
        low
    }

    /// Returns the largest step of the rim with a turn, mm; `None` if a shift has no end.
    fn step(&self, turn: f64) -> Option<f64> {
        let shifts = self.shifts(turn)?;
        let farthest = |spot: &Spot| {
            let moved = Way::new(-spot.y, spot.x) * turn;
            largest(shifts.iter().map(|shift| (shift + moved).norm()))
        };
        Some(largest(self.rim.iter().map(farthest)))
    }

    /// Returns the largest step of the rim with any turn from none to `end`, mm.
    ///
    /// For one point and one direction the step is concave in the turn, so it rises to one peak. A
    /// golden section about the best of some turns finds it.
    fn largest_step(&self, end: f64) -> Option<f64> {
        let turn = |index: usize| end * index as f64 / TURNS as f64;
        let steps = (0..=TURNS).map(|index| self.step(turn(index)));
        let steps = steps.collect::<Option<Vec<f64>>>()?;
        let best = (0..=TURNS).max_by(|&a, &b| steps[a].total_cmp(&steps[b]))?;
        let [mut low, mut high] = [best.saturating_sub(1), (best + 1).min(TURNS)].map(turn);
        let mut found = steps[best];
        let share = 0.5 * (5f64.sqrt() - 1.0);
        for _ in 0..STEPS / 2 {
            let [left, right] = [high - share * (high - low), low + share * (high - low)];
            let [at_left, at_right] = [self.step(left)?, self.step(right)?];
            found = found.max(at_left).max(at_right);
            if at_left < at_right {
                low = left;
            } else {
                high = right;
            }
        }
        Some(found)
    }
}

/// Returns true if a shift ends before the largest that is looked at.
fn has_end(shift: &Way) -> bool {
    shift.amax() < FARTHEST_MM * (1.0 - f64::EPSILON.sqrt())
}

/// Returns the part of a convex polygon where `excess` is not positive.
fn clip(polygon: &[Way], excess: impl Fn(&Way) -> f64) -> Vec<Way> {
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

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small motion, about the middle.
    struct Motion {
        shift: Way,
        /// In radians.
        turn: f64,
    }

    impl Motion {
        fn of(&self, spot: &Spot) -> Way {
            self.shift + Way::new(-spot.y, spot.x) * self.turn
        }

        fn all_of(slice: &Slice) -> Vec<Self> {
            let turn = slice.turn;
            let shifts = slice.shifts.iter();
            shifts.map(|&shift| Self { shift, turn }).collect()
        }
    }

    /// The greatest share by which the polygon of a pin's stops lies outside the circle.
    const OUTSIDE_RATIO: f64 = 0.003;

    fn rectangle(x: f64, y: f64) -> Vec<Spot> {
        [(x, y), (-x, y), (-x, -y), (x, -y)]
            .map(|(x, y)| Spot::new(x, y))
            .into()
    }

    fn pins(spots: &[(f64, f64)], room_mm: f64) -> Vec<Stop> {
        let around = |&(x, y): &(f64, f64)| Stop::around(Spot::new(x, y), room_mm);
        spots.iter().flat_map(around).collect()
    }

    #[test]
    fn two_pins_turn_by_twice_their_room_over_their_distance() {
        let play = Play::of(
            &pins(&[(-10.0, 0.0), (10.0, 0.0)], 0.2),
            &rectangle(30.0, 5.0),
        );
        let play = play.unwrap();
        assert!(
            (play.shift_mm / 0.2 - 1.0).abs() < OUTSIDE_RATIO,
            "{play:?}"
        );
        let turn = (2.0 * 0.2 / 20.0f64).to_degrees();
        assert!(
            (play.turn_deg / turn - 1.0).abs() < OUTSIDE_RATIO,
            "{play:?}"
        );
    }

    #[test]
    fn the_step_of_two_pins_is_that_of_the_closed_form() {
        for (distance, x, y) in [(20.0, 30.0, 5.0), (20.0, 9.0, 0.5), (6.0, 4.0, 25.0)] {
            let (half, rim) = (distance / 2.0, rectangle(x, y));
            let found = Play::of(&pins(&[(-half, 0.0), (half, 0.0)], 0.2), &rim).unwrap();
            let ends = [Spot::new(-half, 0.0), Spot::new(half, 0.0)];
            let closed = step_bound_mm(&ends, 0.2, &rim);
            let ratio = found.step_mm / closed;
            assert!(
                (1.0 - 1e-4..1.0 + OUTSIDE_RATIO).contains(&ratio),
                "{ratio}"
            );
        }
        // On the line of the pins, a point at a distance R moves by 2R/L of the room.
        let ends = [Spot::new(-5.0, 1.0), Spot::new(5.0, 1.0)];
        let step = step_bound_mm(&ends, 0.3, &[Spot::new(20.0, 1.0)]);
        assert!((step - 0.3 * 4.0).abs() < 1e-12);
    }

    #[test]
    fn no_motion_that_the_pins_allow_moves_the_rim_farther() {
        let spots = [(-8.0, 1.0), (9.0, -3.0), (2.0, 11.0)];
        let (stops, rim) = (pins(&spots, 0.25), rectangle(15.0, 14.0));
        let play = Play::of(&stops, &rim).unwrap();
        let mut most: f64 = 0.0;
        for index in 0..40_000usize {
            // A sequence without regularity fills the space of motions (Roberts' R3).
            let share = |step: f64| (index as f64 * step).fract() * 2.0 - 1.0;
            let shift = Way::new(share(0.819_172_5), share(0.671_043_6)) * 0.5;
            let turn = share(0.549_700_5) * 0.05;
            let moved = |x: f64, y: f64| (shift + Way::new(-y, x) * turn).norm();
            if spots.iter().all(|&(x, y)| moved(x, y) <= 0.25) {
                most = rim.iter().map(|p| moved(p.x, p.y)).fold(most, f64::max);
            }
        }
        assert!(
            most <= play.step_mm && most > 0.85 * play.step_mm,
            "{most} {play:?}"
        );
    }

    #[test]
    fn a_third_pin_never_adds_play() {
        let (two, three) = (
            [(-9.0, 0.0), (9.0, 0.0)],
            [(-9.0, 0.0), (9.0, 0.0), (0.0, 7.0)],
        );
        let rim = rectangle(12.0, 12.0);
        let step = |spots: &[(f64, f64)]| Play::of(&pins(spots, 0.2), &rim).unwrap().step_mm;
        assert!(step(&three) <= step(&two) + 1e-9);
        let spots = three.map(|(x, y)| Spot::new(x, y));
        let bounds = [&spots[..2], &spots].map(|pins| step_bound_mm(pins, 0.2, &rim));
        let most = bounds[1] * (1.0 + OUTSIDE_RATIO);
        assert!(step(&three) <= most && bounds[1] <= bounds[0], "{bounds:?}");
        assert_eq!(step_bound_mm(&spots[..1], 0.2, &rim), f64::INFINITY);
    }

    #[test]
    fn one_pin_or_a_slot_leaves_the_body_free() {
        let rim = rectangle(10.0, 10.0);
        assert_eq!(Play::of(&pins(&[(0.0, 0.0)], 0.2), &rim), None);
        let slot = [(1.0, 5.0), (1.0, -5.0), (-1.0, 5.0), (-1.0, -5.0)];
        let slot = slot.map(|(side, y)| Stop {
            at: Spot::new(side, y),
            normal: Way::new(side, 0.0),
            room_mm: 0.1,
        });
        assert_eq!(Play::of(&slot, &rim), None);
    }

    /// Returns the stops of a groove with sides at 45°, with this room. The body's own sides are as
    /// steep, and touch it at both ends.
    fn groove(room_mm: f64) -> Vec<Stop> {
        let side = |x: f64, y: f64| Stop {
            at: Spot::new(x, y),
            normal: Way::new(x.signum(), -1.0) / 2f64.sqrt(),
            room_mm,
        };
        [(-10.0, 10.0), (-2.0, 2.0), (2.0, 2.0), (10.0, 10.0)]
            .map(|(x, y)| side(x, y))
            .into()
    }

    #[test]
    fn bodies_pressed_into_a_groove_meet_whatever_its_room() {
        let press = |room_mm: f64| Stop {
            at: Spot::new(0.0, 8.0),
            normal: Way::new(0.0, -1.0),
            room_mm,
        };
        let (middle, rim) = (Spot::new(0.0, 5.0), rectangle(12.0, 12.0));
        let step = |slack: f64, rooms: [f64; 2]| {
            let seats = rooms.map(|room| Seat::pressed(&groove(room), &press(slack), middle));
            let [a, b] = seats.map(Option::unwrap);
            a.play_between(&b, middle, &rim).step_mm
        };
        assert!(step(1e-9, [0.2, 0.2]) < 1e-6);
        // The wider groove lets its body down by the difference times √2.
        assert!((step(1e-9, [0.3, 0.2]) / (0.1 * 2f64.sqrt()) - 1.0).abs() < 2e-3);
        assert!(step(0.03, [0.2, 0.2]) > 0.03);
        // A flat floor lets it slide.
        let floor = [-5.0, 5.0].map(|x| Stop {
            at: Spot::new(x, 0.0),
            normal: Way::new(0.0, -1.0),
            room_mm: 0.1,
        });
        assert_eq!(Seat::pressed(&floor, &press(0.03), middle), None);
    }

    #[test]
    fn no_motion_that_a_cradle_allows_reaches_beyond_those_of_its_seat() {
        // Walls at odd slopes, near and far: the free motions have corners between any even turns.
        let stops: Vec<Stop> = (0..23)
            .map(|index| {
                let share = |step: f64| (f64::from(index) * step).fract();
                let turn = std::f64::consts::PI * (1.05 + 0.9 * share(0.754_877_6));
                Stop {
                    at: Spot::new(16.0 * turn.cos(), 9.0 * turn.sin()),
                    normal: Way::new(turn.cos(), turn.sin()),
                    room_mm: 0.1 + 0.2 * share(0.569_840_2),
                }
            })
            .collect();
        let press = Stop {
            at: Spot::new(0.0, 9.0),
            normal: Way::new(0.0, -1.0),
            room_mm: 0.03,
        };
        let middle = Spot::origin();
        let seat = Seat::pressed(&stops, &press, middle).unwrap();
        let free = Between::new(&stops, &[], middle.coords);
        let of_seat: Vec<Motion> = seat.slices.iter().flat_map(Motion::all_of).collect();
        let depth = |motion: &Motion| press.normal.dot(&motion.of(&press.at));
        let deepest = of_seat.iter().map(depth).fold(0.0, f64::max);
        let all = (-20_000..20_000).flat_map(|index| {
            let turn = f64::from(index) * 5e-6;
            let shifts = free.clipped(turn);
            Motion::all_of(&Slice { turn, shifts })
        });
        let all: Vec<Motion> = all
            .filter(|m| depth(m) >= deepest - press.room_mm)
            .collect();
        let mut largest_mm: f64 = 0.0;
        for spot in rectangle(14.0, 8.0) {
            for side in 0..WAYS {
                let (sin, cos) = (std::f64::consts::TAU * side as f64 / WAYS as f64).sin_cos();
                let reach = |motions: &[Motion]| {
                    let moved = motions.iter().map(|m| m.of(&spot).dot(&Way::new(cos, sin)));
                    moved.fold(f64::NEG_INFINITY, f64::max)
                };
                largest_mm = largest_mm.max(reach(&all));
                assert!(
                    reach(&all) <= reach(&of_seat) + 2.0 * slices::STRAIGHT_MM,
                    "{} {}",
                    reach(&all),
                    reach(&of_seat)
                );
            }
        }
        assert!(largest_mm > 0.05, "{largest_mm}");
    }

    #[test]
    fn the_extent_of_a_joint_is_its_longest_diagonal() {
        assert_eq!(extent_mm(&corners_of(rectangle(3.0, 4.0))), 10.0);
    }
}
