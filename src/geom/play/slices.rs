//! The free motions of a body as slices, one for each turn.
//!
//! All free motions form a convex body. Its slices between two turns without a corner are means of
//! the slices at both. So slices are added about the corners only.

/// A displacement, mm.
type Way = nalgebra::Vector2<f64>;

/// Bend of the free motions between two turns below which they count as straight, mm: a hundredth
/// of any room. More would state a step too small, less only costs time.
pub(super) const STRAIGHT_MM: f64 = 5e-4;

/// Halvings of the turns about a bend: they leave a part in four thousand of all turns.
const HALVINGS: usize = 8;

/// Directions in which a bend is looked for.
const BEND_WAYS: usize = 24;

/// The corners of the polygon of all shifts with one turn.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Slice {
    /// The turn, radians.
    pub(super) turn: f64,
    /// The corners, mm.
    pub(super) shifts: Vec<Way>,
}

/// Returns slices of which all slices between two turns are means, but for [`STRAIGHT_MM`], in the
/// order of their turns. None of them is empty.
pub(super) fn slices_between(
    [first, last]: [f64; 2],
    count: usize,
    shifts: impl Fn(f64) -> Vec<Way>,
) -> Vec<Slice> {
    let slice = |turn: f64| Slice {
        turn,
        shifts: shifts(turn),
    };
    let turn = |index: usize| first + (last - first) * index as f64 / count as f64;
    let even = (0..=count).map(|index| slice(turn(index)));
    // Rounding may leave nothing at the very ends.
    let even: Vec<Slice> = even.filter(|slice| !slice.shifts.is_empty()).collect();
    let mut kept: Vec<Slice> = even.first().cloned().into_iter().collect();
    for pair in even.windows(2) {
        add_bends([&pair[0], &pair[1]], HALVINGS, &slice, &mut kept);
        kept.push(pair[1].clone());
    }
    kept
}

/// Adds slices between two others where they are no means of these.
fn add_bends(
    [low, high]: [&Slice; 2],
    halvings: usize,
    slice: &impl Fn(f64) -> Slice,
    kept: &mut Vec<Slice>,
) {
    let middle = slice(0.5 * (low.turn + high.turn));
    if halvings == 0 || !middle.bends_from([low, high]) {
        return;
    }
    add_bends([low, &middle], halvings - 1, slice, kept);
    kept.push(middle.clone());
    add_bends([&middle, high], halvings - 1, slice, kept);
}

impl Slice {
    /// Returns true if it reaches farther somewhere than the mean of the slices on both sides.
    fn bends_from(&self, sides: [&Self; 2]) -> bool {
        (0..BEND_WAYS).any(|side| {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / BEND_WAYS as f64).sin_cos();
            let way = Way::new(cos, sin);
            let mean = 0.5 * (sides[0].reach_mm(&way) + sides[1].reach_mm(&way));
            self.reach_mm(&way) > mean + STRAIGHT_MM
        })
    }

    /// Returns the greatest shift along a direction, mm.
    pub(super) fn reach_mm(&self, way: &Way) -> f64 {
        let reaches = self.shifts.iter().map(|shift| shift.dot(way));
        reaches.fold(f64::NEG_INFINITY, f64::max)
    }
}
