//! The natural up as a request: its words, and the axis nearest to it on which a goal is possible.

use rayon::prelude::*;

use super::case::Case;
use super::directions::{is_new, is_turned, round_direction};
use super::orientation::{Place, by_score, candidates, place_on, place_with};
use super::reached::Reached;
use super::sampled_model::{COARSE_SAMPLES, SampledModel};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Vector;
use crate::goal::{
    Contact, GoalKind, MeasuredSolid, PrintStock, Request, Up, keeps_its_lean, place_in_material,
    spins_on_lowest, support_edges,
};

/// A direction this near to an axis of the file is that axis: cos 2°. The base of a scan is that
/// uneven, and a word is easier to type than a vector.
const SAME_AXIS_COSINE: f64 = 0.9994;
/// An axis of the file may stand less firmly by this angle, degrees.
const LESS_FIRM_DEG: f64 = 1.0;

/// Times the best figure of all axes beyond which the goal does not work on an axis.
const FAR_TIMES: f64 = 2.0;

/// An axis near another one, on which the goal is possible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearbyAxis {
    /// The request with this axis.
    pub request: Request,
    /// The value that the goal reaches on it, on sampled columns.
    pub reached: Reached,
    /// The angle between both, degrees; 0 for the same.
    pub off_deg: f64,
}

impl NearbyAxis {
    /// Returns true if it is another axis, by more than rounding.
    pub fn is_turned(&self) -> bool {
        is_turned(self.off_deg)
    }
}

/// Returns a direction in the words of a request: an axis of the file that is as good, or a vector.
///
/// An axis is as good if it is within 2° and, for a standing object, topples no sooner than 1°
/// before the direction itself does.
pub fn name_direction(case: &Case, direction: &Vector) -> Up {
    let exact = round_direction(direction);
    let axis = Vector::ith(exact.iamax(), exact[exact.iamax()].signum());
    if is_new(&[axis], &exact, SAME_AXIS_COSINE) {
        return Up::of(&exact);
    }
    let topples_at = |up: &Vector| topples_at_deg(case, Up::of(up));
    let is_as_firm = match (topples_at(&axis), topples_at(&exact)) {
        (Some(axis_deg), Some(exact_deg)) => axis_deg >= exact_deg - LESS_FIRM_DEG,
        (axis_deg, _) => axis_deg.is_some(),
    };
    let is_as_good = case.request.kind != GoalKind::Stand || is_as_firm;
    Up::of(if is_as_good { &axis } else { &exact })
}

/// Returns the angle at which the solid topples with this up, degrees; `None` if it has no support.
fn topples_at_deg(case: &Case, up: Up) -> Option<f64> {
    let stock = PrintStock {
        wall_mm: case.wall_mm,
        density_g_cm3: case.density_g_cm3,
    };
    let request = Request { up, ..case.request };
    let goal = place_in_material(case.solid, &stock, &request).ok()?.goal;
    let center = goal.solid.centroid();
    let margins = support_edges(&goal.support).into_iter();
    let margins = margins.map(|([x, y], offset)| x * center.x + y * center.y - offset);
    let least_mm = margins.min_by(f64::total_cmp)?;
    Some(least_mm.atan2(center.z).to_degrees())
}

/// Returns the axis nearest to a direction on which the goal works. `None` if it is possible on
/// none of the axes tried.
///
/// The direction itself is tried first, and taken if the goal is possible on it. Then come those of
/// [`super::best_orientation`], nearest first. At the edge of the possible a top spins only if it is
/// very fast. So an axis counts if its figure is at most twice the best of all of them. What is
/// possible on sampled columns is confirmed by a solve on exact ones. A yo-yo's axis has no sense.
///
/// # Errors
/// The watch was stopped.
pub fn nearest_orientation(
    case: &Case,
    up: &Vector,
    watch: &Watch,
) -> Result<Option<NearbyAxis>, Cancelled> {
    nearest_on(&SampledModel::new(*case, COARSE_SAMPLES, watch), up)
}

/// Returns the axis nearest to a direction on which the goal of a sampled model works, as
/// [`nearest_orientation`] does.
pub(super) fn nearest_on(
    model: &SampledModel,
    up: &Vector,
) -> Result<Option<NearbyAxis>, Cancelled> {
    let (case, watch) = (&model.case, &model.watch);
    let has_sense = case.request.kind != GoalKind::Yoyo;
    let off_deg = |axis: &Vector| {
        let angle_deg = axis.angle(up).to_degrees();
        if has_sense {
            angle_deg
        } else {
            angle_deg.min(180.0 - angle_deg)
        }
    };
    let confirmed = |place: &Place| model.confirm(&place.request, case.wall_mm).is_some();
    let near = |place: Place| NearbyAxis {
        request: Request {
            up: Up::of(&place.axis),
            contact: case.request.contact,
            ..place.request
        },
        reached: place.reached,
        off_deg: off_deg(&place.axis),
    };
    let measured = MeasuredSolid::new(case.solid);
    let try_on = |axis: &Vector| place_by_rule(model, &measured, axis);
    if let Some(place) = try_on(up).filter(confirmed) {
        return Ok(Some(near(place)));
    }
    watch.check()?;
    let axes = candidates(case);
    let mut places: Vec<Place> = axes.par_iter().filter_map(try_on).collect();
    watch.check()?;
    let Some(best) = places.iter().copied().min_by(by_score) else {
        return Ok(None);
    };
    places.retain(|place| place.reached.score() <= FAR_TIMES * best.reached.score());
    places.sort_by(|a, b| off_deg(&a.axis).total_cmp(&off_deg(&b.axis)));
    let found = places.into_iter().find(confirmed);
    watch.check()?;
    Ok(found.map(near))
}

/// Tries a goal on an axis. A free contact is the lowest point if the top keeps its promise there,
/// else the one below the centre of mass.
fn place_by_rule(model: &SampledModel, measured: &MeasuredSolid, axis: &Vector) -> Option<Place> {
    let case = &model.case;
    if case.request.contact != Some(Contact::Auto) {
        return place_on(model, axis);
    }
    let keeps =
        |place: &Place| spins_on_lowest(measured, case.wall_mm, &place.request).unwrap_or(false);
    let leans = |place: &Place| {
        let request = Request {
            tip: case.request.tip,
            least_lean_deg: case.request.least_lean_deg,
            ..place.request
        };
        keeps_its_lean(measured, case.wall_mm, &request).unwrap_or(false)
    };
    let lowest = place_with(model, axis, Some(Contact::Lowest)).filter(keeps);
    lowest.or_else(|| place_with(model, axis, Some(Contact::Center)).filter(leans))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::Solid;
    use crate::mesh::primitives::cuboid;

    fn bar() -> Solid {
        Solid::new(cuboid(&Point::origin(), &Point::new(60.0, 24.0, 8.0))).unwrap()
    }

    fn case(solid: &Solid, kind: GoalKind) -> Case<'_> {
        Case {
            solid,
            request: Request::new(kind),
            wall_mm: 1.0,
            least_wall_mm: 0.2,
            wall_step_mm: 0.1,
            density_g_cm3: 1.2,
            greatest_size_mm: 1e4,
            fill: None,
        }
    }

    #[test]
    fn a_bar_spins_about_its_shortest_axis_and_near_its_longest_only_after_a_tilt() {
        let bar = bar();
        let case = case(&bar, GoalKind::Yoyo);
        let nearest = |up: Vector| {
            let found = nearest_orientation(&case, &up, &Watch::silent());
            found.unwrap().unwrap()
        };
        let short = nearest(Vector::z());
        assert_eq!((short.request.up, short.off_deg), (Up::Z, 0.0));
        // About its longest axis the bar has the least moment, hollow or not.
        let long = nearest(Vector::x());
        assert!(long.off_deg > 20.0, "{long:?}");
        let model = SampledModel::new(case, COARSE_SAMPLES, &Watch::silent());
        assert!(model.allows(&long.request, case.wall_mm));
    }

    #[test]
    fn a_direction_beside_an_axis_is_named_by_the_axis() {
        let bar = bar();
        let case = case(&bar, GoalKind::Float);
        let named = |x: f64| name_direction(&case, &Vector::new(x, 0.0, 1.0).normalize());
        assert_eq!(named(0.02), Up::Z);
        assert!(matches!(named(0.05), Up::Along(_)));
    }

    #[test]
    fn a_wedge_keeps_the_face_it_stands_on_though_an_axis_is_near() {
        // Its lower face falls by 1 mm over 60: 0.95°. On the level only an edge would touch.
        let tilted = |p: &Point| Point::new(p.x, p.y, p.z - p.x / 60.0);
        let wedge = Solid::new(bar().mesh().map_vertices(tilted)).unwrap();
        let case = case(&wedge, GoalKind::Stand);
        let face = Vector::new(1.0 / 60.0, 0.0, 1.0).normalize();
        assert!(matches!(name_direction(&case, &face), Up::Along(_)));
    }
}
