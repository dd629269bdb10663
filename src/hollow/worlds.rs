//! Small worlds with closed forms or few enough choices to try them all, for the solver's tests.

use super::Problem;
use crate::geom::{Frame, Point, Quadric};
use crate::goal::{Afloat, Goal, GoalKind, Objective, Rotor, Spindle};
use crate::interior::{Columns, moments_where_positive};
use crate::mass::Moments;

/// A goal with what it is solved on.
pub(super) struct World {
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

    /// As a rotor with planes at ± this height.
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

/// Everything the columns hold.
fn whole(columns: &Columns) -> Moments {
    moments_where_positive(columns, &Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]))
}

/// Columns over a square grid of this half width, where `intervals` has any.
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

/// A vertical ellipsoid of these half axes about `center`, tilted by the shear x += `lean`·z, seen
/// along z.
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

/// An ellipsoid with a wall of one, as columns of both: what is fixed is all of the outer.
fn shelled(objective: Objective, pitch: f64, center: [f64; 3], half: [f64; 3], lean: f64) -> World {
    let outer = columns_of(pitch, 16.0, ellipsoid(center, half, lean));
    let inner = columns_of(pitch, 16.0, ellipsoid(center, half.map(|h| h - 1.0), lean));
    World::new(objective, whole(&outer), inner)
}

/// A leaning egg about its middle: its axis is not a principal one before hollowing.
pub(super) fn egg(objective: Objective) -> World {
    egg_at(objective, 0.5)
}

/// The same on columns of another pitch.
pub(super) fn egg_at(objective: Objective, pitch: f64) -> World {
    shelled(objective, pitch, [0.0; 3], [14.0, 12.0, 6.0], 0.1).of_kind(GoalKind::Yoyo)
}

/// The same egg standing on its tip, its middle above the contact and a little beside it.
pub(super) fn egg_on_its_side(objective: Objective) -> World {
    egg_on_its_side_at(objective, 0.5)
}

/// The same on columns of another pitch.
pub(super) fn egg_on_its_side_at(objective: Objective, pitch: f64) -> World {
    shelled(objective, pitch, [0.2, 0.1, 6.0], [14.0, 12.0, 6.0], 0.05)
}

/// An egg much longer along its axis than across.
pub(super) fn long_egg() -> World {
    shelled(Objective::Dominance, 0.5, [0.0; 3], [5.0, 5.0, 15.0], 0.0)
}

/// A tall ellipsoid on its tip.
pub(super) fn tower() -> World {
    shelled(
        Objective::CriticalSpeed,
        0.5,
        [0.0, 0.0, 15.0],
        [6.0, 6.0, 15.0],
        0.0,
    )
}

/// A round ellipsoid on its tip, of radius 10 and this half height.
pub(super) fn stump(half_height: f64) -> World {
    shelled(
        Objective::CriticalSpeed,
        0.5,
        [0.0, 0.0, half_height],
        [10.0, 10.0, half_height],
        0.0,
    )
}

/// A box of inner area 16 and height 10 that may be filled, on which 40 of other mass is centred at
/// height 9.
pub(super) fn bottle() -> World {
    let columns = columns_of(0.5, 2.0, |_, _| vec![[0.0, 10.0]]);
    let glass = Moments([40.0, 0.0, 0.0, 360.0, 0.0, 0.0, 0.0, 100.0, 100.0, 3300.0]);
    World::new(Objective::LowestCenter, whole(&columns) + glass, columns)
}

/// A rotor 8 × 4 × 6 about its middle, all of which may be emptied, with this much more of s_xz
/// beside it.
pub(super) fn coupled_rotor(couple: f64) -> World {
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

/// The sixteen blocks as a rotor about the axis they stand around, its planes at bottom and top.
pub(super) fn blocks_on_an_axis() -> World {
    let mut world = blocks_on_a_slope().of_kind(GoalKind::Balance).turning(8.0);
    world.goal.objective = Objective::LeastUnbalance;
    world
}

/// The bottle as a tank to float with this mass in all, its centre of buoyancy this far aside.
pub(super) fn tank(mass: f64, [x, y]: [f64; 2]) -> World {
    let mut world = bottle().of_kind(GoalKind::Float);
    world.goal.objective = Objective::MetacentricHeight;
    let buoyancy = Point::new(x, y, 3.0);
    world.goal.afloat = Some(Afloat {
        waterline_mm: 6.0,
        buoyancy,
        material_mm3: mass,
        metacenter_mm: 7.0,
    });
    world
}

/// Sixteen blocks, four columns of four, over a support that their middle is not over.
pub(super) fn blocks_on_a_slope() -> World {
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

/// A beam of cross-section 4 from x = −8 to 8, all of which may be emptied, beside a mass that is
/// `first` out of balance.
pub(super) fn beam(first: f64) -> World {
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

/// Eight blocks in two columns over a support that lies too far aside for any of them to be emptied
/// to help enough.
pub(super) fn blocks_far_aside() -> World {
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

/// Cells of ¾ mm: eight octants of 2 × 2 × 3 blocks each, mirrored in all three planes, in a rim
/// that is never emptied.
pub(super) fn mirrored_blocks(objective: Objective) -> World {
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
pub(super) fn rings(objective: Objective) -> World {
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

/// The least that the integral of `quadric` over any interior can be: that over all of it, less the
/// positive part where it may be emptied, by midpoint sums of `steps` a column, which know nothing
/// of roots.
pub(super) fn least_integral(world: &World, quadric: &Quadric, steps: usize) -> f64 {
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

/// Groups of intervals that are emptied together: each by itself.
pub(super) fn single_blocks(count: usize) -> Vec<Vec<usize>> {
    (0..count).map(|i| vec![i]).collect()
}

/// The blocks of `mirrored_blocks` in groups that are each other's mirror images.
pub(super) fn mirrored_groups() -> Vec<Vec<usize>> {
    let mut groups = vec![Vec::new(); 12];
    for (column, layer) in (0..16).flat_map(|column| (0..6).map(move |layer| (column, layer))) {
        let fold = |i: usize, count: usize| i.min(count - 1 - i);
        groups[(fold(column % 4, 4) * 2 + fold(column / 4, 4)) * 3 + fold(layer, 6)]
            .push(column * 6 + layer);
    }
    groups
}

/// The cells of `rings` in four rings by three layers.
pub(super) fn ring_groups(world: &World) -> Vec<Vec<usize>> {
    let mut groups = vec![Vec::new(); 12];
    for (column, &[x, y]) in world.columns.centers.iter().enumerate() {
        let ring = (x.hypot(y) / 1.5) as usize;
        (0..3).for_each(|layer| groups[ring * 3 + layer].push(column * 3 + layer));
    }
    groups
}

/// Visits the moments of every choice of groups to empty.
pub(super) fn each_choice(world: &World, groups: &[Vec<usize>], mut visit: impl FnMut(&Moments)) {
    let emptied: Vec<Moments> = groups
        .iter()
        .map(|group| moments_of_intervals(&world.columns, group))
        .collect();
    for choice in 0..1usize << groups.len() {
        let chosen = (0..groups.len()).filter(|group| choice >> group & 1 == 1);
        visit(&chosen.fold(world.fixed, |moments, group| moments - emptied[group]));
    }
}

/// Visits the moments of every way to empty, keep or fill each interval with what is so much
/// denser, and how many are filled.
pub(super) fn each_mixture(
    world: &World,
    density_ratio: f64,
    mut visit: impl FnMut(&Moments, u32),
) {
    let count = world.columns.intervals.len();
    let single: Vec<Moments> = (0..count)
        .map(|i| moments_of_intervals(&world.columns, &[i]))
        .collect();
    for choice in 0..3u32.pow(count as u32) {
        let (mut moments, mut filled, mut rest) = (world.fixed, 0, choice);
        for part in &single {
            match rest % 3 {
                0 => moments -= *part,
                1 => (moments, filled) = (moments + *part * (density_ratio - 1.0), filled + 1),
                _ => {}
            }
            rest /= 3;
        }
        visit(&moments, filled);
    }
}

/// The moments of some intervals, by a column set of their own.
fn moments_of_intervals(columns: &Columns, chosen: &[usize]) -> Moments {
    let mut part = Columns {
        pitch_mm: columns.pitch_mm,
        starts: vec![0],
        ..Columns::default()
    };
    for index in 0..columns.len() {
        let range = columns.starts[index] as usize..columns.starts[index + 1] as usize;
        for interval in range.filter(|interval| chosen.contains(interval)) {
            part.centers.push(columns.centers[index]);
            part.intervals.push(columns.intervals[interval]);
            part.starts.push(part.intervals.len() as u32);
        }
    }
    whole(&part)
}

/// A quadric of coefficients between −1 and 1 over coordinates in units of `length`, the same for
/// the same seed.
pub(super) fn some_quadric(seed: u64, length: f64) -> Quadric {
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
