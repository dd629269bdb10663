//! The top: it spins upright on one contact point.

use super::error::GoalError;
use super::hardware::Rod;
use super::lean::Lean;
use super::placement::{Footing, Placement, Warning};
use super::request::Request;
use super::site::Site;
use super::sites::Contact;
use super::support;
use super::tip_choice::TipChoice;
use super::tips::TipPlace;
use crate::geom::hull::convex_hull;
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

/// Air below the surface that no tip need bridge, mm. The judge takes as much for touching.
const TOUCHING_MM: f64 = 0.05;

/// The order for a top's contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Order {
    contact: Contact,
    tip: TipChoice,
    least_lean_deg: f64,
}

impl Order {
    /// Returns the order that a request gives.
    pub fn of(request: &Request) -> Self {
        Self {
            contact: request.contact.unwrap_or(Contact::Auto),
            tip: request.ordered_tip(),
            least_lean_deg: request.least_lean_deg,
        }
    }

    fn least_lean_rad(&self) -> f64 {
        self.least_lean_deg.to_radians()
    }

    /// Returns true if nothing is promised of the lean, so that none need be found.
    fn is_unpromised(&self) -> bool {
        self.tip == TipChoice::None && self.least_lean_rad() == 0.0
    }

    /// Returns whether a placement touches the floor at its contact and leans far enough.
    pub fn is_kept_by(&self, placement: &Placement) -> bool {
        let is_off = |warning: &Warning| warning.is_off_contact();
        let lean_rad = placement
            .footing
            .as_ref()
            .map(|footing| footing.lean().lean_rad);
        !placement.warnings.iter().any(is_off)
            && lean_rad.is_none_or(|lean_rad| lean_rad >= self.least_lean_rad())
    }
}

/// Places a top. With a tip it touches the floor as far below the surface as the tip stands out.
pub(super) fn place(site: &Site, wall_mm: f64, order: Order) -> Result<Placement, GoalError> {
    let contact = match order.contact {
        Contact::Auto if spins_on_lowest(site, wall_mm, order)? => Contact::Lowest,
        Contact::Auto => Contact::Center,
        chosen => chosen,
    };
    let order = Order { contact, ..order };
    let placed = place_on(site, wall_mm, order)?;
    refuse_short_tip(site, wall_mm, order, &placed)?;
    refuse_air(order, &placed)?;
    Ok(placed)
}

/// Refuses a top without a tip, as ordered, whose contact hangs in the air: it spins on nothing.
fn refuse_air(order: Order, placed: &Placement) -> Result<(), GoalError> {
    match placed.air_mm() {
        Some(missing_mm) if order.tip == TipChoice::None && !order.is_unpromised() => {
            Err(GoalError::NothingToSpinOn { missing_mm })
        }
        _ => Ok(()),
    }
}

/// Refuses a tip that was ordered if the top leans too little on it: no hollowing changes that.
fn refuse_short_tip(
    site: &Site,
    wall_mm: f64,
    order: Order,
    placed: &Placement,
) -> Result<(), GoalError> {
    let Some(Footing::Tip { lean, .. }) = placed.footing else {
        return Ok(());
    };
    if lean.lean_rad >= order.least_lean_rad() {
        return Ok(());
    }
    let origin = contact_point(site, order.contact)?;
    Err(GoalError::ShortTip {
        lean_deg: lean.lean_rad.to_degrees(),
        least_deg: order.least_lean_deg,
        pin: stock_pins(site, wall_mm, &origin, order.least_lean_rad())
            .into_iter()
            .next(),
    })
}

/// Returns true if a top keeps its promise on the model's lowest point, without a tip but for one
/// that was ordered.
pub(super) fn spins_on_lowest(site: &Site, wall_mm: f64, order: Order) -> Result<bool, GoalError> {
    if order.tip == TipChoice::None {
        return Ok(true);
    }
    let bare = Order {
        contact: Contact::Lowest,
        tip: order.tip.rod().map_or(TipChoice::None, TipChoice::Rod),
        ..order
    };
    Ok(bare.is_kept_by(&place_on(site, wall_mm, bare)?))
}

/// Places a top on a contact that was chosen.
fn place_on(site: &Site, wall_mm: f64, order: Order) -> Result<Placement, GoalError> {
    let origin = contact_point(site, order.contact)?;
    if let TipChoice::Rod(tip) = order.tip {
        return place_tip(site, wall_mm, &origin, &[tip]);
    }
    let bare = place_at(site, wall_mm, origin)?;
    if order.is_unpromised() {
        return Ok(bare);
    }
    let bare = with_foot(site, bare);
    if order.is_kept_by(&bare) {
        return Ok(bare);
    }
    if order.tip == TipChoice::None && bare.warnings.iter().any(Warning::is_off_contact) {
        return Ok(bare);
    }
    if order.tip == TipChoice::None {
        return Ok(with_warning(bare, |lean| Warning::OnFoot {
            lean_deg: lean.lean_rad.to_degrees(),
        }));
    }
    let pins = stock_pins(site, wall_mm, &origin, order.least_lean_rad());
    if pins.is_empty() {
        return Ok(with_warning(bare, |_| Warning::NoTip));
    }
    place_tip(site, wall_mm, &origin, &pins)
}

/// Returns the stock pins for a tip on the axis through this point.
fn stock_pins(site: &Site, wall_mm: f64, origin: &Point, least_lean_rad: f64) -> Vec<Rod> {
    let Some(surface_mm) = first_surface_above(site, origin) else {
        return Vec::new();
    };
    TipPlace {
        site,
        seat: origin + Vector::z() * surface_mm,
        wall_mm,
        least_lean_rad,
    }
    .pins()
}

/// Adds a bare top's foot, and how far it leans on it.
fn with_foot(site: &Site, placement: Placement) -> Placement {
    let lean = Lean::on_foot(
        &hull_in(site, &placement),
        site.solid.mesh().longest_side_mm(),
    );
    Placement {
        footing: Some(Footing::Foot { lean }),
        ..placement
    }
}

fn with_warning(mut placement: Placement, warning: impl Fn(Lean) -> Warning) -> Placement {
    let lean = placement.footing.as_ref().map(Footing::lean);
    placement.warnings.extend(lean.map(warning));
    placement
}

/// Returns the corners of the model's convex hull in the goal frame.
fn hull_in(site: &Site, placement: &Placement) -> Vec<Point> {
    let origin = site.upright.to_local(&placement.goal.frame.origin);
    site.hull_corners()
        .map(|corner| Point::from(corner - origin))
        .collect()
}

/// Places a top on the first of some tips, whose socket has a wall of its own. So the contact needs
/// no solid region.
fn place_tip(
    site: &Site,
    wall_mm: f64,
    origin: &Point,
    tips: &[Rod],
) -> Result<Placement, GoalError> {
    let surface_mm = first_surface_above(site, origin).ok_or(GoalError::NoSeat)?;
    let (rod, spares) = tips.split_first().ok_or(GoalError::NoSeat)?;
    let end = origin + Vector::z() * (surface_mm - rod.out_mm());
    let bare = place_at(site, wall_mm, end)?;
    let is_of_body = |warning: &Warning| !matches!(warning, Warning::ContactInAir { .. });
    let footing = Footing::Tip {
        rod: *rod,
        lean: Lean::on_tip(hull_in(site, &bare), rod.radius_mm()),
        spares: spares.to_vec(),
    };
    let Placement { goal, warnings, .. } = bare;
    Ok(Placement {
        goal,
        keeps: Vec::new(),
        warnings: warnings.into_iter().filter(is_of_body).collect(),
        footing: Some(footing),
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
        footing: None,
    })
}

fn contact_point(site: &Site, contact: Contact) -> Result<Point, GoalError> {
    let [x, y] = match contact {
        Contact::At(point) => return site.locate_point("contact", point),
        Contact::Lowest | Contact::Auto => lowest_feature_middle(site),
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
    support::middle(&convex_hull(
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
