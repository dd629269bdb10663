//! Sockets that voids came too near to after their pins were placed.

use std::f64::consts::FRAC_PI_2;

use crate::{
    cut::{
        error::CutError,
        hollowed::Hollowed,
        joints::{
            boss::Boss,
            boss_maker::{MARGIN_MM, disc},
            pin_shape::PinSite,
        },
        plan::CutPlan,
        request::PlanRequest,
    },
    geom::{Bvh, Point, Vector},
    mesh::{Csg, TriMesh},
};

/// Lack of wall that is let be, mm: half of what the judge lets be. Below it, rounds are spent on
/// what nobody can print or measure; above it, a kit may break its promise.
const SLACK_MM: f64 = 0.005;

/// Rings of the rounded ends of a socket's room, beside the ring at its widest.
const RINGS: usize = 6;

/// Returns the pins around whose sockets a void leaves less than the wall, each with the room that
/// must stay solid for it. The rooms are outside all voids at the time when pins are placed.
///
/// # Errors
/// A [`CutError`] if a room cannot be built.
pub fn find_thin_sockets(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Vec<Boss>, CutError> {
    let voids = hollowed.voids.iter();
    let surface = Bvh::new(voids.flat_map(|void| void.mesh().iter_corners()));
    let is_thin = |pin: &&PinSite| {
        let [from, to] = ends(pin);
        let needed_mm = radius_mm(pin, request) - SLACK_MM;
        surface.segment_distance(&from, &to, needed_mm) < needed_mm
    };
    let thin = plan.pins.iter().filter(is_thin);
    thin.map(|pin| room_of(pin, plan, request))
        .collect::<Result<Vec<_>, _>>()
        .map(|rooms| rooms.into_iter().flatten().collect())
}

/// Returns whether every socket keeps its wall, up to the outside and to all voids. Pins that were
/// placed on a coarser body may not.
pub fn keeps_socket_walls(hollowed: &Hollowed, plan: &CutPlan, request: &PlanRequest) -> bool {
    let material = hollowed.to_mesh();
    let surface = Bvh::new(material.iter_corners());
    let keeps = |pin: &PinSite| {
        let [from, to] = ends(pin);
        let needed_mm = radius_mm(pin, request) - SLACK_MM;
        surface.segment_distance(&from, &to, needed_mm) >= needed_mm
    };
    plan.pins.iter().all(keeps)
}

/// Returns the room of a pin's socket as a boss; `None` if the plan has no joint of that pin.
fn room_of(pin: &PinSite, plan: &CutPlan, request: &PlanRequest) -> Result<Option<Boss>, CutError> {
    let joint = plan
        .joints
        .iter()
        .find(|joint| joint.pins.contains(&pin.id));
    let Some(joint) = joint else {
        return Ok(None);
    };
    Ok(Some(Boss {
        pin: pin.clone(),
        parts: joint.parts,
        body: room_body(pin, radius_mm(pin, request))?,
        is_new: true,
    }))
}

/// Returns the ends of a pin's sockets on its axis: of a dowel both bottoms, else mouth and bottom.
fn ends(pin: &PinSite) -> [Point; 2] {
    let (mouth, along) = (Point::from(pin.center_mm), Vector::from(pin.direction));
    let bottom = mouth + along * pin.socket_depth_mm;
    if pin.dowel.is_some() {
        [mouth - along * pin.socket_depth_mm, bottom]
    } else {
        [mouth, bottom]
    }
}

/// Returns the radius of the room that a socket needs with the wall around it, mm.
fn radius_mm(pin: &PinSite, request: &PlanRequest) -> f64 {
    PinSite::socket_corner_mm(pin.socket_diameter_mm) + request.wall_mm
}

/// Builds a body that holds all points within a radius of a pin's sockets, and little more.
fn room_body(pin: &PinSite, radius_mm: f64) -> Result<TriMesh, CutError> {
    let along = Vector::from(pin.direction);
    let [from, to] = ends(pin);
    let points = [(from, -along), (to, along)];
    let points = points
        .iter()
        .flat_map(|(end, outward)| rounded_end(end, outward, radius_mm + MARGIN_MM));
    let hull = Csg::convex_hull(&points.collect::<Vec<Point>>())?;
    Ok(hull.to_mesh()?)
}

/// Returns points whose hull holds the half ball about an end.
fn rounded_end(end: &Point, outward: &Vector, radius_mm: f64) -> Vec<Point> {
    let step = FRAC_PI_2 / RINGS as f64;
    // The flats between rings lie outside the ball; those of a ring lie outside its disc.
    let reach_mm = radius_mm / (step / 2.0).cos();
    let ring = |index: usize| {
        let (rise, across) = (index as f64 * step).sin_cos();
        let center = end + outward * (rise * reach_mm);
        disc(&center, outward, across * reach_mm)
    };
    let tip = end + outward * reach_mm;
    (0..RINGS).flat_map(ring).chain([tip]).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::cut::scenes::{cuboid, plan, request, with_balls};
    use crate::geom::orthonormal_basis;

    /// Returns a wide slab with a void in its middle, cut in two with pins beside the void.
    fn slab() -> (Hollowed, CutPlan, PlanRequest) {
        let void = cuboid([-6.0, -6.0, -3.0], [6.0, 6.0, 3.0]);
        let outer = cuboid([-25.0, -25.0, -8.0], [25.0, 25.0, 8.0]);
        let hollowed = Hollowed::new(outer, vec![void]);
        let request = request();
        let plan = plan(&hollowed, &request).unwrap();
        (hollowed, plan, request)
    }

    /// Returns a ball of air under the bottom of a pin's socket, so that this much wall is left.
    fn air_below(pin: &PinSite, wall_mm: f64) -> Hollowed {
        let bore_mm = PinSite::socket_corner_mm(pin.socket_diameter_mm);
        let across = orthonormal_basis(&Vector::from(pin.direction)).0;
        let middle = ends(pin)[1] + across * (bore_mm + wall_mm + 2.0);
        with_balls(slab().0.outer, &[[middle.x, middle.y, middle.z, 2.0]])
    }

    #[test]
    fn pins_as_they_were_placed_keep_their_walls() {
        let (hollowed, plan, request) = slab();
        assert!(plan.pins.len() >= 2);
        assert_eq!(
            find_thin_sockets(&hollowed, &plan, &request),
            Ok(Vec::new())
        );
    }

    #[test]
    fn a_void_that_came_near_names_the_pin_whose_wall_it_takes() {
        let (_, plan, request) = slab();
        let pin = &plan.pins[1];
        let near = air_below(pin, request.wall_mm - 0.1);
        let found = find_thin_sockets(&near, &plan, &request).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].pin.id, pin.id);
        // The ball is a polyhedron: its surface lies up to some hundredths inside.
        let clear = air_below(pin, request.wall_mm + 0.01);
        assert_eq!(find_thin_sockets(&clear, &plan, &request), Ok(Vec::new()));
    }

    #[test]
    fn a_wall_that_is_thin_up_to_the_outside_is_found_as_one_up_to_a_void() {
        let (hollowed, plan, request) = slab();
        let keeps = |hollowed: &Hollowed| keeps_socket_walls(hollowed, &plan, &request);
        assert!(keeps(&hollowed));
        assert!(!keeps(&air_below(&plan.pins[1], request.wall_mm - 0.1)));
        // The same pins in a slab that ends close beside one of them.
        let pin = &plan.pins[0];
        let bore_mm = PinSite::socket_corner_mm(pin.socket_diameter_mm);
        let narrow = |wall_mm: f64| {
            let reach_mm = bore_mm + wall_mm;
            let [x, _, _] = pin.center_mm;
            let [low, high] = if x > 0.0 {
                [-25.0, x + reach_mm]
            } else {
                [x - reach_mm, 25.0]
            };
            Hollowed {
                outer: Hollowed::new(cuboid([low, -25.0, -8.0], [high, 25.0, 8.0]), vec![]).outer,
                ..hollowed.clone()
            }
        };
        assert!(!keeps(&narrow(request.wall_mm - 0.1)));
        assert!(keeps(&narrow(request.wall_mm + 0.01)));
    }

    #[test]
    fn its_room_holds_all_within_the_wall_and_little_more() {
        let (_, plan, request) = slab();
        let pin = &plan.pins[0];
        let radius_mm = radius_mm(pin, &request);
        let body = room_body(pin, radius_mm).unwrap();
        let [from, to] = ends(pin);
        let nearest_mm = Bvh::new(body.iter_corners()).segment_distance(&from, &to, f64::INFINITY);
        assert!(nearest_mm >= radius_mm);
        let ball_mm3 = 4.0 / 3.0 * PI * radius_mm.powi(3);
        let capsule_mm3 = ball_mm3 + PI * radius_mm.powi(2) * (to - from).norm();
        // 0.01 mm of margin and the flats of 32 sides and 6 rings.
        let excess = body.signed_volume_mm3() / capsule_mm3;
        assert!((1.0..1.05).contains(&excess), "{excess}");
    }
}
