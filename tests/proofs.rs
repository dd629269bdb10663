//! Proofs of impossibility, checked against the model itself: its triangles and a grid of points,
//! without columns or roots.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]
#![allow(
    dead_code,
    reason = "the module also serves the program that writes the models"
)]

use crate::common;
#[path = "../examples/make_models/models.rs"]
mod models;

use equipoise::base::units::Length;
use equipoise::base::watch::Watch;
use equipoise::geom::{Point, Quadric};
use equipoise::goal::{
    Contact, GoalKind, Objective, Placement, Request, SpinPoint, Up, Water, Waterline, place,
};
use equipoise::hollow::{Problem, Settings, Solution, Status, solve};
use equipoise::interior::Columns;
use equipoise::io::read_model;
use equipoise::mesh::Solid;
use equipoise::repair::weld;
use equipoise::shell::Shell;

const WALL_MM: f64 = 2.0;
/// A wall that leaves a block almost solid, mm.
const THICK_WALL_MM: f64 = 25.0;
/// The long axis of the cuboid, turned by 3° about x and then 2° about y. Its moment is the least.
const LONG_AXIS: [f64; 3] = [0.999_391, 0.001_826, -0.034_852];
/// Columns along each side.
const COLUMNS: usize = 100;
/// Distance of the grid's points for our own models and for large ones, mm. The surface and the
/// wall cut some 13 000 cells. Each is wrong by a third of its volume with a random sign, which
/// makes 2e-3 of the whole.
const STEP_MM: f64 = 2.5;
/// Distance for a part only some 10 mm thick, mm. A shell of 1 mm is more than half of it.
const FINE_STEP_MM: f64 = 1.0;
/// Error of the grid's integrals of q, as a share of ∫|q|.
const GRID_RATIO: f64 = 4e-3;

/// A placed model with its solution.
struct Case {
    solid: Solid,
    placement: Placement,
    solution: Solution,
    wall_mm: f64,
    step_mm: f64,
}

impl Case {
    fn of(model: &str, request: &Request) -> Self {
        Self::with_wall(model, request, WALL_MM)
    }

    fn with_wall(model: &str, request: &Request, wall_mm: f64) -> Self {
        let (_, make) = models::MODELS
            .into_iter()
            .find(|(name, _)| *name == model)
            .unwrap();
        Self::of_solid(models::solid(make).unwrap(), request, wall_mm)
    }

    fn of_solid(solid: Solid, request: &Request, wall_mm: f64) -> Self {
        let placement = place(&solid, wall_mm, &request.unpromised()).unwrap();
        let shell = Shell::new(&solid, &placement.goal.frame, wall_mm, &placement.keeps).unwrap();
        let columns =
            Columns::of_shell(&shell, shell.coarse_pitch(COLUMNS), &Watch::silent()).unwrap();
        let problem = Problem {
            goal: &placement.goal,
            fixed: placement.goal.solid,
            columns: &columns,
        };
        let solution = solve(&problem, &Settings::default(), &Watch::silent());
        Self {
            solid,
            placement,
            solution,
            wall_mm,
            step_mm: STEP_MM,
        }
    }

    /// The least integral of a quadric q over any interior, and ∫|q| over the solid.
    ///
    /// Every grid point inside counts, unless it may be emptied and q > 0 there. It may if it is a
    /// wall away from every triangle and outside the regions that are kept.
    fn least_integral(&self, quadric: &Quadric) -> [f64; 2] {
        let frame = &self.placement.goal.frame;
        let triangles: Vec<[Point; 3]> = self
            .solid
            .mesh()
            .iter_corners()
            .map(|corners| corners.map(|p| frame.to_local(&p)))
            .collect();
        let box_of = |pick: fn(f64, f64) -> f64, from: f64| {
            [0, 1, 2].map(|axis| triangles.iter().flatten().map(|p| p[axis]).fold(from, pick))
        };
        let (low, high) = (
            box_of(f64::min, f64::INFINITY),
            box_of(f64::max, f64::NEG_INFINITY),
        );
        let count = [0, 1, 2].map(|axis| ((high[axis] - low[axis]) / self.step_mm).ceil() as usize);
        let mut sums = [0.0; 2];
        for (j, k) in (0..count[1]).flat_map(|j| (0..count[2]).map(move |k| (j, k))) {
            // A little off the lattice, so that no ray meets an edge of these models.
            let [y, z] =
                [(j, 1), (k, 2)].map(|(i, axis)| low[axis] + (i as f64 + 0.4987) * self.step_mm);
            let crossings = crossings(&triangles, y, z);
            for x in (0..count[0]).map(|i| low[0] + (i as f64 + 0.5) * self.step_mm) {
                if crossings.iter().filter(|&&crossing| crossing > x).count() % 2 == 1 {
                    let (point, q) = (Point::new(x, y, z), quadric.value(&Point::new(x, y, z)));
                    let counts = q < 0.0 || !self.may_be_emptied(&triangles, &point);
                    sums = [sums[0] + if counts { q } else { 0.0 }, sums[1] + q.abs()];
                }
            }
        }
        sums.map(|sum| sum * self.step_mm.powi(3))
    }

    fn may_be_emptied(&self, triangles: &[[Point; 3]], point: &Point) -> bool {
        let in_model = self.placement.goal.frame.to_model(point);
        triangles
            .iter()
            .all(|triangle| !is_within(triangle, point, self.wall_mm))
            && self
                .placement
                .keeps
                .iter()
                .all(|keep| keep.distance_mm(&in_model) > 0.0)
    }

    /// Asserts that the grid agrees with the proof: no interior's integral is below `level`.
    fn assert_separates(&self, quadric: &Quadric, level: f64) {
        let [least, size] = self.least_integral(quadric);
        assert!(least >= level - GRID_RATIO * size, "{least} {level} {size}");
        // The grid would find a false proof: for the opposite quadric it is far below the level.
        let opposite = Quadric(quadric.0.map(|coefficient| -coefficient));
        assert!(self.least_integral(&opposite)[0] < -0.1 * size);
    }

    /// The solution's quadric plus `by` times the goal's denominator, in the goal's frame, mm.
    fn shifted(&self, by: f64, denominator: [(usize, f64); 2], degree: i32) -> Quadric {
        let solid = &self.placement.goal.solid.0;
        let length_mm = ((solid[7] + solid[8] + solid[9]) / solid[0]).sqrt();
        let mut quadric = self.solution.quadric;
        for (index, factor) in denominator {
            quadric.0[index] += by * factor / length_mm.powi(degree);
        }
        quadric
    }
}

/// The x at which the line through (y, z) along x meets the triangles.
fn crossings(triangles: &[[Point; 3]], y: f64, z: f64) -> Vec<f64> {
    let side = |p: &Point, q: &Point| (q.y - p.y) * (z - p.z) - (q.z - p.z) * (y - p.y);
    let meets = |[a, b, c]: &[Point; 3]| {
        let weights = [side(b, c), side(c, a), side(a, b)];
        let inside = weights.iter().all(|w| *w > 0.0) || weights.iter().all(|w| *w < 0.0);
        inside.then(|| {
            (weights[0] * a.x + weights[1] * b.x + weights[2] * c.x) / weights.iter().sum::<f64>()
        })
    };
    triangles.iter().filter_map(meets).collect()
}

/// Tells if a point is nearer to a triangle than this.
fn is_within(triangle: &[Point; 3], point: &Point, distance_mm: f64) -> bool {
    let is_far = |axis: usize| {
        let [low, high] =
            [f64::min, f64::max].map(|pick| triangle.iter().map(|p| p[axis]).reduce(pick).unwrap());
        point[axis] < low - distance_mm || point[axis] > high + distance_mm
    };
    !(0..3).any(is_far) && distance_to(triangle, point) < distance_mm
}

/// The distance to the plane if the foot of the perpendicular is inside, else to the nearest edge.
fn distance_to(&[a, b, c]: &[Point; 3], point: &Point) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let is_inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(p, q)| normal.cross(&(q - p)).dot(&(point - p)) >= 0.0);
    if is_inside {
        return (point - a).dot(&normal).abs() / normal.norm();
    }
    let to_edge = |p: Point, q: Point| {
        let along = ((point - p).dot(&(q - p)) / (q - p).norm_squared()).clamp(0.0, 1.0);
        (point - (p + (q - p) * along)).norm()
    };
    to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
}

#[test]
fn a_centre_proved_off_the_middle_of_its_foot_is_off_on_a_grid_too() {
    let lowest = Request {
        objective: Objective::LowestCenter,
        ..Request::new(GoalKind::Stand)
    };
    let case = Case::of("balancing-figure", &lowest);
    let Status::ConstraintsInfeasible {
        least_miss,
        separator,
        ..
    } = case.solution.status
    else {
        panic!("{:?}", case.solution.status)
    };
    assert!(least_miss > 0.01);
    // The separator's integrals are in units of the solid's volume and radius of gyration.
    case.assert_separates(&separator, least_miss);
}

#[test]
fn a_grade_proved_out_of_reach_is_so_on_a_grid_too() {
    let aside = Request {
        spin_point: Some(SpinPoint::At([25.0, 0.0, 0.0])),
        ..Request::new(GoalKind::Balance)
    };
    let case = Case::of("tilted-ellipsoid", &aside);
    let Status::CannotBalance { separator, .. } = case.solution.status else {
        panic!("{:?}", case.solution.status)
    };
    case.assert_separates(&separator, 0.0);
}

#[test]
fn a_yoyo_proved_not_dominant_is_not_on_a_grid_either() {
    let across = Request {
        up: Up::Along(LONG_AXIS),
        objective: Objective::Dominance,
        ..Request::new(GoalKind::Yoyo)
    };
    let case = Case::with_wall("yoyo-cuboid", &across, THICK_WALL_MM);
    let Status::NotDominant { least_ratio } = case.solution.status else {
        panic!("{:?}", case.solution.status)
    };
    // For every interior λ_max − 1·I_zz > 0. The quadric is that of λ_max − least_ratio·I_zz.
    let at_one = case.shifted(least_ratio - 1.0, [(7, 1.0), (8, 1.0)], 2);
    case.assert_separates(&at_one, 0.0);
}

/// The folder of real models beside the checkout. The acceptance table expects that hollowing alone
/// is not enough for some of them.
/// Solves for a shared model, 100 mm long, with a wall of 1 mm; `None` if it is not there.
fn solve_shared(name: &str, request: &Request) -> Option<Case> {
    let path = common::shared_model(name)?;
    let mesh = weld(&read_model(&path).unwrap());
    let scale = 100.0 / mesh.longest_side_mm();
    let solid = Solid::new(mesh.map_vertices(|p| p * scale)).unwrap();
    Some(Case::of_solid(solid, request, 1.0))
}

#[test]
#[ignore = "long: 12 s, and the rocker arm is proved too; run with -- --ignored"]
fn an_armadillo_proved_no_top_is_none_on_a_grid_either() {
    let up = Up::Along([0.0, 1.0, 0.0]);
    let top = Request {
        up,
        contact: Some(Contact::Center),
        ..Request::new(GoalKind::Top)
    };
    let Some(case) = solve_shared("armadillo.obj", &top) else {
        return;
    };
    let Status::ConstraintsInfeasible {
        least_miss,
        separator,
        ..
    } = case.solution.status
    else {
        panic!("{:?}", case.solution.status)
    };
    assert!(least_miss > 0.0);
    case.assert_separates(&separator, least_miss);
}

#[test]
fn a_rocker_arm_proved_to_need_ballast_needs_it_on_a_grid_too() {
    let bore = Request {
        up: Up::Along([1.0, 0.0, 0.0]),
        spin_point: Some(SpinPoint::At([0.0, 6.7135, 8.4895])),
        ..Request::new(GoalKind::Balance)
    };
    let Some(case) = solve_shared("rocker-arm.obj", &bore) else {
        return;
    };
    let case = Case {
        step_mm: FINE_STEP_MM,
        ..case
    };
    let Status::CannotBalance { separator, .. } = case.solution.status else {
        panic!("{:?}", case.solution.status)
    };
    case.assert_separates(&separator, 0.0);
}

#[test]
fn a_model_proved_to_sink_sinks_on_a_grid_too() {
    let waterline = Waterline::At(Length::from_mm(5.0).unwrap());
    let request = Request {
        water: Some(Water {
            waterline,
            ..Water::default()
        }),
        ..Request::new(GoalKind::Float)
    };
    let case = Case::of("tilted-ellipsoid", &request);
    let Status::Sinks { least_ratio } = case.solution.status else {
        panic!("{:?}", case.solution.status)
    };
    let [lightest, _] = case.least_integral(&Quadric([1.0, 0., 0., 0., 0., 0., 0., 0., 0., 0.]));
    let displaced_mm3 = case.placement.goal.afloat.unwrap().material_mm3;
    // The shell is 2 mm of some 44. Cells cut at random are wrong by a third each, which makes
    // 1e-2 of the shell.
    assert!(
        (lightest / displaced_mm3 / least_ratio - 1.0).abs() < 3e-2,
        "{lightest} {displaced_mm3} {least_ratio}"
    );
}
