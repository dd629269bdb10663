//! Places for things that lie on the inner side of a panel.

use super::spread::{Head, Seen, clear_to, lean_mm, places_in};
use crate::geom::hull;
use crate::panels::{EdgeJoint, PanelEdge, PanelRequest, PanelSet};

/// Distance of a thing from joints and from the heads of screws, mm.
const CLEAR_MM: f64 = 1.0;

/// A round thing that lies on a panel, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatThing {
    /// Its diameter.
    pub diameter_mm: f64,
    /// Its height over the panel.
    pub height_mm: f64,
    /// The diameter of the heads of screws on the panel, from which it keeps clear.
    pub heads_mm: f64,
}

/// Returns places for the middle of a thing on the inner side of a panel, in the panel's frame, mm.
///
/// It keeps clear of the joints along all edges, of panels that lean over this one, and of screws.
/// On its way out along the panel's normal it meets none of them. `request` is that of the panels.
pub fn places_on(
    set: &PanelSet,
    panel: usize,
    request: &PanelRequest,
    thing: &FlatThing,
) -> Vec<[f64; 2]> {
    let of = &set.panels[panel];
    let radius_mm = 0.5 * thing.diameter_mm;
    let head = Head {
        diameter_mm: thing.diameter_mm,
        height_mm: thing.height_mm,
        radius_mm: radius_mm + CLEAR_MM,
    };
    let seen = Seen {
        frame: &of.frame,
        inside_mm: [0.0; 2],
    };
    let edges = set.edges.iter().filter(|edge| edge.panels.contains(&panel));
    let ring = hull::convex_hull(of.outline.corners().to_vec());
    let ring = edges.fold(ring, |ring, edge| {
        let depth_mm = depth_mm(edge, request) + head.radius_mm;
        let depth_mm = depth_mm + lean_mm(&head, edge.angle_rad);
        clear_to(&ring, edge, &seen, depth_mm)
    });
    let mut places = places_in(&ring);
    let free_mm = head.radius_mm + 0.5 * thing.heads_mm;
    places.retain(|at| {
        let mut holes = of.holes.iter();
        holes.all(|hole| (hole.at_mm[0] - at[0]).hypot(hole.at_mm[1] - at[1]) >= free_mm)
    });
    places
}

/// Returns how far a joint and what leans over the panel reach in along an edge, mm.
fn depth_mm(edge: &PanelEdge, request: &PanelRequest) -> f64 {
    let setback_mm = request.sheet_mm / (0.5 * edge.angle_rad).tan();
    match &edge.joint {
        EdgeJoint::Fingers(_) => edge.depth_mm.max(setback_mm),
        EdgeJoint::Brackets(places) if places.is_empty() => setback_mm,
        EdgeJoint::Brackets(_) => setback_mm + request.flange_mm(),
    }
}
