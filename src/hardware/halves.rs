//! The cut of a model across its axis into the two halves that its axle holds.

use super::bore::is_inside;
use super::error::FitError;
use super::workshop::Workshop;
use crate::geom::{Plane, Point, Vector};
use crate::mesh::{Csg, TriMesh, move_off_vertices, surface_mm2};

/// Pieces below this volume are slivers of a cut that runs along a face, mm³.
const SHEET_MM3: f64 = 1e-6;
/// A piece that stays with the other half is enclosed by its hull, grown by this margin, mm. The
/// margin keeps rounding from leaving a skin of it. Other parts within the margin are cut into.
const HULL_MARGIN_MM: f64 = 0.02;
/// The share of a piece's volume that its hull may enclose of other parts.
const FOREIGN_RATIO: f64 = 1e-3;

/// The two halves at their old places in the model.
pub(super) struct Halves {
    pub upper: Csg,
    pub lower: Csg,
}

/// Cuts the model into the halves above and below the spin point. A piece that the cut separates
/// from its half, such as a hand that hangs beside the body, stays with the half it grows from.
pub(super) fn split_halves(workshop: &Workshop, bore_radius_mm: f64) -> Result<Halves, FitError> {
    let (frame, mesh) = (&workshop.goal.frame, workshop.solid.mesh());
    let plane = move_off_vertices(mesh, &Plane::through(&frame.origin, &frame.axis()));
    let body = Csg::of_mesh(mesh)?;
    let (above, below) = body.split_by_plane(&plane)?;
    let hub_mm = bore_radius_mm + 0.5 * workshop.allowances.wall_mm;
    let probe = |side: f64| {
        frame.to_model(&Point::new(
            hub_mm,
            0.0,
            side * hub_mm.min(workshop.allowances.wall_mm),
        ))
    };
    let (above, below) = (
        Side::of(&above, &probe(1.0))?,
        Side::of(&below, &probe(-1.0))?,
    );
    if above.loose.is_empty() && below.loose.is_empty() {
        return Ok(Halves {
            upper: above.hub,
            lower: below.hub,
        });
    }
    cut_around(&body, &plane, [&above, &below])
}

/// The pieces on one side of the cut: the one with the hub, and the others.
struct Side {
    hub: Csg,
    loose: Vec<TriMesh>,
}

impl Side {
    fn of(pieces: &Csg, on_hub: &Point) -> Result<Self, FitError> {
        let mut bodies: Vec<TriMesh> = Vec::new();
        for body in pieces.decompose()? {
            bodies.push(body.to_mesh()?);
        }
        bodies.retain(|body| body.signed_volume_mm3() > SHEET_MM3);
        let count = bodies.len();
        let hub = bodies
            .iter()
            .position(|body| is_inside(body, on_hub))
            .ok_or(FitError::Loose { pieces: count })?;
        Ok(Self {
            hub: Csg::of_mesh(&bodies.remove(hub))?,
            loose: bodies,
        })
    }
}

/// Cuts around the loose pieces, so that each stays with the part it touches on the other side.
fn cut_around(body: &Csg, plane: &Plane, [above, below]: [&Side; 2]) -> Result<Halves, FitError> {
    let mut upper_room = body.half_space(plane)?;
    for piece in &above.loose {
        upper_room = upper_room.subtract(&hull(body, piece)?)?;
    }
    for piece in &below.loose {
        upper_room = upper_room.union(&hull(body, piece)?)?;
    }
    let (upper, lower) = (body.intersect(&upper_room)?, body.subtract(&upper_room)?);
    let pieces = upper.decompose()?.len() + lower.decompose()?.len();
    if pieces == 2 {
        Ok(Halves { upper, lower })
    } else {
        Err(FitError::Loose { pieces })
    }
}

/// Returns a convex region that holds this piece and nothing else of the body.
fn hull(body: &Csg, piece: &TriMesh) -> Result<Csg, FitError> {
    let signs = [-HULL_MARGIN_MM, HULL_MARGIN_MM];
    let corners = signs.iter().flat_map(|x| {
        signs
            .iter()
            .flat_map(move |y| signs.map(|z| Vector::new(*x, *y, z)))
    });
    let corners: Vec<Vector> = corners.collect();
    let points = piece
        .vertices()
        .iter()
        .flat_map(|p| corners.iter().map(move |corner| p + corner));
    let hull = Csg::convex_hull(&points.collect::<Vec<_>>())?;
    let held_mm3 = body.intersect(&hull)?.to_mesh()?.signed_volume_mm3();
    let own_mm3 = piece.signed_volume_mm3();
    // The hull also holds a skin of the part it grows from, as thick as the margin.
    let skin_mm3 = 2.0 * HULL_MARGIN_MM * surface_mm2(piece);
    let is_alone = held_mm3 - own_mm3 <= FOREIGN_RATIO * own_mm3 + skin_mm3;
    if is_alone {
        Ok(hull)
    } else {
        Err(FitError::Loose { pieces: 3 })
    }
}
