//! Small worlds for the solver's tests, with closed forms or few enough choices to try them all.

mod choices;

pub(crate) use choices::{each_choice, each_mixture, mirrored_groups, ring_groups, single_blocks};

use crate::geom::{Frame, Point, Quadric};
use crate::goal::{FloatConditions, Goal, GoalKind, Objective, Rotor, Spindle};
use crate::hollow::Problem;
use crate::interior::{Columns, moments_where_positive};
use crate::mass::Moments;

/// A goal, and the interior to solve it on.
pub(crate) struct World {
    pub goal: Goal,
    pub fixed: Moments,
    pub columns: Columns,
}

impl World {
    fn new(objective: Objective, fixed: Moments, columns: Columns) -> Self {
        let kind = GoalKind::ALL
            .iter()
            .copied()
            .find(|kind| objective.suits(*kind));
        let kind = kind.expect("every objective suits some goal");
        let goal = Goal {
            kind,
            frame: Frame::identity(),
            objective,
            support: Vec::new(),
            spindle: None,
            afloat: None,
            wanted: None,
            solid: fixed,
        };
        Self {
            goal,
            fixed,
            columns,
        }
    }

    fn of_kind(mut self, kind: GoalKind) -> Self {
        self.goal.kind = kind;
        self
    }

    /// Makes it a rotor with planes at ± this height.
    pub fn turning(mut self, end_mm: f64) -> Self {
        self.goal.spindle = Some(Spindle {
            rotor: Rotor::default(),
            ends_mm: [-end_mm, end_mm],
        });
        self
    }

    pub fn problem(&self) -> Problem<'_> {
        Problem {
            goal: &self.goal,
            fixed: self.fixed,
            columns: &self.columns,
        }
    }
}

/// Returns the moments of everything the columns hold.
fn whole(columns: &Columns) -> Moments {
    moments_where_positive(columns, &Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]))
}

/// Returns columns over a square grid of this half width, where `intervals` returns any.
fn columns_of(
    pitch: f64,
    half_width: f64,
    intervals: impl Fn(f64, f64) -> Vec<[f64; 2]>,
) -> Columns {
    let count = (2.0 * half_width / pitch).round() as usize;
    let place = |i: usize| (i as f64 + 0.5) * pitch - half_width;
    let mut columns = Columns {
        pitch_mm: [pitch; 2],
        starts: vec![0],
        ..Columns::default()
    };
    for (x, y) in (0..count).flat_map(|j| (0..count).map(move |i| (place(i), place(j)))) {
        let found = intervals(x, y);
        if !found.is_empty() {
            columns.centers.push([x, y]);
            columns.intervals.extend(found);
            columns.starts.push(columns.intervals.len() as u32);
        }
    }
    columns
}

/// Returns the intervals of an ellipsoid with these half axes about `center`, sheared by x +=
/// `lean`·z.
fn ellipsoid(center: [f64; 3], half: [f64; 3], lean: f64) -> impl Fn(f64, f64) -> Vec<[f64; 2]> {
    move |x, y| {
        // ((x − cx − lean·z)/a)² + ((y − cy)/b)² + (z/c)² = 1 with z from the centre.
        let (u, v) = (x - center[0], (y - center[1]) / half[1]);
        let (a2, c2) = (half[0] * half[0], half[2] * half[2]);
        let (p, q, r) = (
            lean * lean / a2 + 1.0 / c2,
            -2.0 * u * lean / a2,
            u * u / a2 + v * v - 1.0,
        );
        let discriminant = q * q - 4.0 * p * r;
        if discriminant <= 0.0 {
            return Vec::new();
        }
        let middle = center[2] - q / (2.0 * p);
        let reach = discriminant.sqrt() / (2.0 * p);
        vec![[middle - reach, middle + reach]]
    }
}

/// Returns an ellipsoid with a wall of one; the fixed moments are those of the whole.
fn egg_shell(
    objective: Objective,
    pitch: f64,
    center: [f64; 3],
    half: [f64; 3],
    lean: f64,
) -> World {
    let outer = columns_of(pitch, 16.0, ellipsoid(center, half, lean));
    let inner = columns_of(pitch, 16.0, ellipsoid(center, half.map(|h| h - 1.0), lean));
    World::new(objective, whole(&outer), inner)
}

/// A leaning egg about its middle; its axis is not a principal one before hollowing.
pub(crate) fn egg(objective: Objective) -> World {
    egg_at(objective, 0.5)
}

/// The leaning egg on columns of another pitch.
pub(crate) fn egg_at(objective: Objective, pitch: f64) -> World {
    egg_shell(objective, pitch, [0.0; 3], [14.0, 12.0, 6.0], 0.1).of_kind(GoalKind::Yoyo)
}

/// The leaning egg on its tip, with its middle above the contact and a little beside it.
pub(crate) fn egg_on_its_side(objective: Objective) -> World {
    egg_on_its_side_at(objective, 0.5)
}

/// The egg on its tip, on columns of another pitch.
pub(crate) fn egg_on_its_side_at(objective: Objective, pitch: f64) -> World {
    egg_shell(objective, pitch, [0.2, 0.1, 6.0], [14.0, 12.0, 6.0], 0.05)
}

/// An egg much longer along its axis than across.
pub(crate) fn long_egg() -> World {
    egg_shell(Objective::Dominance, 0.5, [0.0; 3], [5.0, 5.0, 15.0], 0.0)
}

/// A tall ellipsoid on its tip.
pub(crate) fn tower() -> World {
    egg_shell(
        Objective::CriticalSpeed,
        0.5,
        [0.0, 0.0, 15.0],
        [6.0, 6.0, 15.0],
        0.0,
    )
}

/// A round ellipsoid on its tip, of radius 10 and this half height.
pub(crate) fn stump(half_height: f64) -> World {
    egg_shell(
        Objective::CriticalSpeed,
        0.5,
        [0.0, 0.0, half_height],
        [10.0, 10.0, half_height],
        0.0,
    )
}

/// A box of inner area 16 and height 10 that may be filled, with 40 of other mass centred at height
/// 9.
pub(crate) fn bottle() -> World {
    let columns = columns_of(0.5, 2.0, |_, _| vec![[0.0, 10.0]]);
    let glass = Moments([40.0, 0.0, 0.0, 360.0, 0.0, 0.0, 0.0, 100.0, 100.0, 3300.0]);
    World::new(Objective::LowestCenter, whole(&columns) + glass, columns)
}

/// A rotor of 8 × 4 × 6 about its middle that may be emptied wholly, with this additional s_xz.
pub(crate) fn coupled_rotor(couple: f64) -> World {
    let columns = columns_of(0.125, 4.0, |_, y| {
        if y.abs() < 2.0 {
            vec![[-3.0, 3.0]]
        } else {
            Vec::new()
        }
    });
    let beside = Moments([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, couple, 0.0, 0.0, 0.0]);
    World::new(Objective::LeastRemoved, whole(&columns) + beside, columns).turning(3.0)
}

/// The sixteen blocks as a rotor about the axis between them, with its planes at bottom and top.
pub(crate) fn blocks_on_an_axis() -> World {
    let mut world = blocks_on_a_slope().of_kind(GoalKind::Balance).turning(8.0);
    world.goal.objective = Objective::LeastUnbalance;
    world
}

/// The bottle as a floating tank with this mass in all and its centre of buoyancy at this offset.
pub(crate) fn tank(mass: f64, [x, y]: [f64; 2]) -> World {
    let mut world = bottle().of_kind(GoalKind::Float);
    world.goal.objective = Objective::MetacentricHeight;
    let buoyancy = Point::new(x, y, 3.0);
    world.goal.afloat = Some(FloatConditions {
        waterline_mm: 6.0,
        buoyancy,
        material_mm3: mass,
        metacenter_mm: 7.0,
    });
    world
}

/// Sixteen blocks, four columns of four, with their middle off that of the support.
pub(crate) fn blocks_on_a_slope() -> World {
    let columns = columns_of(2.0, 2.0, |_, _| {
        (0..4)
            .map(|i| [f64::from(i) * 2.0, f64::from(i) * 2.0 + 2.0])
            .collect()
    });
    let rest = Moments(Moments::monomials(0.3, -0.2, 2.0)) * 30.0;
    let mut world = World::new(Objective::TopplingAngle, whole(&columns) + rest, columns);
    world.goal.support = vec![[-0.6, -1.4], [2.4, -1.4], [2.4, 1.6], [-0.6, 1.6]];
    world
}

/// A beam of cross-section 4 from x = −8 to 8 that may be emptied wholly, beside a mass with the
/// first moment `first`.
pub(crate) fn beam(first: f64) -> World {
    let columns = columns_of(0.25, 8.0, |_, y| {
        if y.abs() < 1.0 {
            vec![[4.0, 6.0]]
        } else {
            Vec::new()
        }
    });
    let beside = Moments([90.0, first, 0.0, 400.0, 0.0, 0.0, 0.0, 9e3, 9e2, 2e3]);
    World::new(Objective::LowestCenter, whole(&columns) + beside, columns)
}

/// Eight blocks in two columns, too far from the support for emptying to help enough.
pub(crate) fn blocks_far_aside() -> World {
    let columns = columns_of(2.0, 2.0, |_, y| {
        if y < 0.0 {
            Vec::new()
        } else {
            (0..4)
                .map(|i| [f64::from(i) * 2.0, f64::from(i) * 2.0 + 2.0])
                .collect()
        }
    });
    let rest = Moments(Moments::monomials(3.0, 0.0, 2.0)) * 60.0;
    let mut world = World::new(Objective::TopplingAngle, whole(&columns) + rest, columns);
    world.goal.support = vec![[-1.6, -1.4], [1.4, -1.4], [1.4, 1.6], [-1.6, 1.6]];
    world
}

/// Cells of ¾ mm in a rim that is never emptied: eight octants of 2 × 2 × 3 blocks, mirrored in
/// three planes.
pub(crate) fn mirrored_blocks(objective: Objective) -> World {
    let columns = columns_of(1.5, 3.0, |_, _| {
        (-3..3)
            .map(|i| [f64::from(i), f64::from(i) + 1.0])
            .collect()
    });
    let rim = Moments([60.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 900.0, 700.0, 200.0]);
    World::new(objective, whole(&columns) + rim, columns).of_kind(GoalKind::Yoyo)
}

/// A flat round disc above its contact, in cells of 1 mm and three layers, with a stem that is
/// never emptied.
pub(crate) fn rings(objective: Objective) -> World {
    let layers = || {
        (0..3)
            .map(|i| [2.0 + 2.0 * f64::from(i), 4.0 + 2.0 * f64::from(i)])
            .collect()
    };
    let columns = columns_of(1.0, 6.0, |x, y| {
        if x.hypot(y) < 5.9 {
            layers()
        } else {
            Vec::new()
        }
    });
    let rest = Moments([60.0, 0.0, 0.0, 300.0, 0.0, 0.0, 0.0, 1800.0, 1800.0, 1900.0]);
    World::new(objective, whole(&columns) + rest, columns).of_kind(GoalKind::Top)
}

/// Returns the least integral of `quadric` over any interior: that over all of it, less the
/// positive part where it may be emptied. Uses midpoint sums of `steps` per column, independent of
/// any roots.
pub(crate) fn least_integral(world: &World, quadric: &Quadric, steps: usize) -> f64 {
    let columns = &world.columns;
    let area = columns.pitch_mm[0] * columns.pitch_mm[1];
    let positive = |[x, y]: [f64; 2], [low, high]: [f64; 2]| {
        let step = (high - low) / steps as f64;
        let at = |i: usize| Point::new(x, y, low + (i as f64 + 0.5) * step);
        (0..steps)
            .map(|i| quadric.value(&at(i)).max(0.0))
            .sum::<f64>()
            * step
            * area
    };
    let of_column = |i: usize| {
        let range = columns.starts[i] as usize..columns.starts[i + 1] as usize;
        columns.intervals[range]
            .iter()
            .map(|interval| positive(columns.centers[i], *interval))
            .sum::<f64>()
    };
    let whole: f64 = world
        .fixed
        .0
        .iter()
        .zip(quadric.0)
        .map(|(s, g)| s * g)
        .sum();
    whole - (0..columns.len()).map(of_column).sum::<f64>()
}

/// Returns a quadric with coefficients between −1 and 1 over coordinates in units of `length`,
/// fixed by the seed.
pub(crate) fn some_quadric(seed: u64, length: f64) -> Quadric {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1;
    let mut next = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let degree = |i: usize| [0, 1, 1, 1, 2, 2, 2, 2, 2, 2][i];
    Quadric(std::array::from_fn(|i| next() / length.powi(degree(i))))
}
