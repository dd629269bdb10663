//! Bodies and cases for the tests of this folder.

use super::*;

pub(super) fn solid(mesh: TriMesh) -> Solid {
    Solid::new(mesh).unwrap()
}

/// Returns a tower of 20 × 20 × 60 mm that leans over its foot.
pub(super) fn leaning_tower() -> Solid {
    let tower = cuboid(
        &Point::new(-10.0, -10.0, 0.0),
        &Point::new(10.0, 10.0, 60.0),
    );
    solid(tower.map_vertices(|p| Point::new(p.x + 0.45 * p.z, p.y, p.z)))
}

/// Returns a lens with a bulge on one side, so that its centre of mass is not above its lowest
/// point.
pub(super) fn bulging_lens() -> Solid {
    let lens = ellipsoid(&Point::origin(), &Vector::new(30.0, 26.0, 12.0), 4);
    solid(lens.map_vertices(|p| Point::new(p.x + 0.004 * p.x * p.x, p.y, p.z)))
}

pub(super) fn case(solid: &Solid, request: Request, wall_mm: f64) -> Case<'_> {
    Case {
        solid,
        request,
        wall_mm,
        least_wall_mm: 0.2,
        wall_step_mm: 0.1,
        density_g_cm3: 1.2,
        greatest_size_mm: 1e4,
        fill: None,
    }
}

pub(super) fn remedies(case: &Case) -> Vec<Remedy> {
    crate::advice::remedies(case, &Watch::silent()).unwrap()
}

pub(super) fn best_orientation(case: &Case) -> Option<Orientation> {
    crate::advice::best_orientation(case, &Watch::silent()).unwrap()
}

pub(super) fn is_possible(case: &Case, request: &Request, wall_mm: f64) -> bool {
    SampledModel::new(*case, FEW, &Watch::silent())
        .confirm(request, wall_mm)
        .is_some()
}

pub(super) fn of_kind(remedies: &[Remedy], kind: Kind) -> &Remedy {
    remedies.iter().find(|remedy| remedy.kind == kind).unwrap()
}

/// Returns the value that a remedy gives to its only option.
pub(super) fn value(remedy: &Remedy, key: Key) -> &str {
    let [setting] = &remedy.settings[..] else {
        panic!("{remedy:?}")
    };
    assert_eq!(setting.key, key);
    setting.value.as_deref().unwrap()
}

/// Returns a yo-yo whose axis is tilted against the lens's own.
pub(super) fn askew_yoyo() -> Request {
    let up = Up::Along([0.5, 0.1, 0.8]);
    Request {
        up,
        objective: Objective::Dominance,
        ..Request::new(GoalKind::Yoyo)
    }
}

/// Returns a top on a lens whose contact lies too far aside.
pub(super) fn top_aside(lens: &Solid) -> Request {
    let lowest = place(lens, 1.0, &Request::new(GoalKind::Top).unpromised())
        .unwrap()
        .goal
        .frame
        .origin;
    let aside = [lowest.x - 12.0, lowest.y + 5.0, lowest.z];
    Request {
        contact: Some(Contact::At(aside)),
        ..Request::new(GoalKind::Top).unpromised()
    }
}
