//! The top: it spins upright on one contact point.

use super::error::GoalError;
use super::hardware::Rod;
use super::placement::{Placement, Warning};
use super::site::Site;
use super::sites::Contact;
use super::support;
use crate::geom::{Point, Vector};
use crate::shell::Keep;

/// The radius of the solid region at the contact, in walls. With fewer than two the point would be
/// worn or pushed through. With many more the lowest, most useful part of the interior is lost.
const CONTACT_RADIUS_WALLS: f64 = 2.0;

/// Vertices within this part of the height of the lowest belong to the lowest feature. Below 1e-9
/// the rounding of a turned model splits a flat foot; above 1e-4 a blunt tip would count as flat.
const LOWEST_FEATURE_RATIO: f64 = 1e-6;

/// Air below the surface that is no more than this part of the height is rounding, not a missing
/// tip.
const AIR_RATIO: f64 = 1e-6;

/// Air below the surface that is thinner than any printed layer, mm: no tip is missing.
const TOUCHING_MM: f64 = 0.01;

/// Places a top. With a tip it touches the floor as far below the surface as the tip stands out.
/// The tip's socket has a wall of its own, so the contact needs no solid region.
pub(super) fn place(
    site: &Site,
    wall_mm: f64,
    contact: Contact,
    tip: Option<Rod>,
) -> Result<Placement, GoalError> {
    let origin = contact_point(site, contact)?;
    let Some(tip) = tip else {
        return place_at(site, wall_mm, origin);
    };
    let surface_mm = first_surface_above(site, &origin).ok_or(GoalError::NoSeat)?;
    let end = origin + Vector::z() * (surface_mm - tip.out_mm());
    let Placement { goal, warnings, .. } = place_at(site, wall_mm, end)?;
    let is_of_body = |warning: &Warning| !matches!(warning, Warning::ContactInAir { .. });
    Ok(Placement {
        goal,
        keeps: Vec::new(),
        warnings: warnings.into_iter().filter(is_of_body).collect(),
    })
}

/// Places the top that touches at this point of the upright frame.
fn place_at(site: &Site, wall_mm: f64, origin: Point) -> Result<Placement, GoalError> {
    let depth_mm = origin.z - site.upright_center().z;
    if depth_mm >= 0.0 {
        return Err(GoalError::ContactAboveCenter { depth_mm });
    }
    let surface_mm = first_surface_above(site, &origin);
    let goal = site.goal_at(&origin, Vec::new());
    let touched = goal.frame.origin + goal.frame.axis() * surface_mm.unwrap_or(0.0);
    let keeps = vec![Keep::ball(touched, CONTACT_RADIUS_WALLS * wall_mm)];
    Ok(Placement {
        goal,
        keeps,
        warnings: warnings(site, &origin, surface_mm),
    })
}

fn contact_point(site: &Site, contact: Contact) -> Result<Point, GoalError> {
    let [x, y] = match contact {
        Contact::At(point) => return site.locate_point("contact", point),
        Contact::Lowest => lowest_feature_middle(site),
        Contact::Center => [site.upright_center().x, site.upright_center().y],
    };
    Ok(Point::new(x, y, site.lowest_mm))
}

/// Returns the middle of the lowest feature: a vertex, an edge's middle, or a face's centroid.
fn lowest_feature_middle(site: &Site) -> [f64; 2] {
    let tie_mm = LOWEST_FEATURE_RATIO * site.height_mm();
    let lowest = site
        .upright_vertices()
        .filter(|vertex| vertex.z <= site.lowest_mm + tie_mm);
    support::middle(&support::convex_hull(
        lowest.map(|vertex| [vertex.x, vertex.y]).collect(),
    ))
}

fn warnings(site: &Site, contact: &Point, surface_mm: Option<f64>) -> Vec<Warning> {
    let tolerance_mm = AIR_RATIO * site.height_mm();
    let depth_mm = contact.z - site.lowest_mm;
    let air = match surface_mm {
        None => Some(Warning::AxisMissesModel),
        Some(missing_mm) if missing_mm > tolerance_mm.max(TOUCHING_MM) => {
            Some(Warning::ContactInAir { missing_mm })
        }
        Some(_) => None,
    };
    let below = (depth_mm > tolerance_mm).then_some(Warning::BelowContact { depth_mm });
    air.into_iter().chain(below).collect()
}

/// Returns the height above the contact at which the axis first meets the surface, mm. `None` if it
/// meets nothing at or above the contact.
fn first_surface_above(site: &Site, contact: &Point) -> Option<f64> {
    let tolerance_mm = AIR_RATIO * site.height_mm();
    let mesh = site.solid.mesh();
    let heights = mesh.iter_corners().filter_map(|corners| {
        let local = corners.map(|corner| site.upright.to_local(&corner) - contact);
        height_over_origin(local, tolerance_mm)
    });
    heights
        .filter(|&height| height >= -tolerance_mm)
        .min_by(f64::total_cmp)
        .map(|height| height.max(0.0))
}

/// Returns the height at which the z axis meets a triangle, mm; `None` if it misses. A triangle
/// seen edge-on counts by its lowest corner on the axis.
pub(crate) fn height_over_origin([a, b, c]: [Vector; 3], tolerance_mm: f64) -> Option<f64> {
    let cross = |p: &Vector, q: &Vector| p.x * q.y - p.y * q.x;
    let weights = [cross(&b, &c), cross(&c, &a), cross(&a, &b)];
    let area: f64 = weights.iter().sum();
    let least = weights
        .iter()
        .map(|w| w * area.signum())
        .fold(f64::INFINITY, f64::min);
    if area != 0.0 && least >= 0.0 {
        return Some((weights[0] * a.z + weights[1] * b.z + weights[2] * c.z) / area);
    }
    let on_axis = [a, b, c]
        .into_iter()
        .filter(|corner| corner.x.hypot(corner.y) <= tolerance_mm);
    on_axis.map(|corner| corner.z).min_by(f64::total_cmp)
}
