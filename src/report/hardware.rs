//! What is told and shown of hardware that is not printed.

use maud::{Markup, html};

use super::Checklist;
use super::figure::{Picture, Role, figures};
use super::finished::turning;
use super::page::blank;
use super::words::quantity;
use crate::geom::{Frame, Point, Vector};
use crate::mass::Lump;
use crate::mesh::{TriMesh, primitives};
use crate::verify::Hardware;

/// Sides of a rod in a picture: fewer look like a nut.
const SIDES: u32 = 32;
/// How fine the ball of a rounded end is drawn: 320 triangles.
const BALL_LEVEL: u32 = 2;

/// The step in which the hardware is put in.
pub(super) fn fitting(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        div class="lead" {
            @for half in ["A", "B"] {
                @if let Some(parts) = parts_of(sheet, half) { p { "Half " strong { (half) } " is " (parts) "." } }
            }
        }
        (turning(sheet))
        (figures(pictures, Role::Halves))
        ul class="ticks" {
            @for piece in &sheet.hardware { li { strong { (piece.id) } ", " (described(sheet, piece)) " " span class="field" { "Weighed, g " (blank()) } } }
        }
        p class="small" { "Weigh each piece before it goes in: what differs from the mass above moves the centre of mass, or slows it down." }
    }
}

/// The parts of one half of a yo-yo, glued first; none where there are no halves.
fn parts_of(sheet: &Checklist, half: &str) -> Option<String> {
    let parts = sheet
        .parts
        .iter()
        .filter(|part| part.half.as_deref() == Some(half));
    let parts: Vec<&str> = parts.map(|part| part.id.as_str()).collect();
    let glued = if parts.len() > 1 { ", glued" } else { "" };
    (!parts.is_empty()).then(|| parts.join(" + ") + glued)
}

/// What a piece is, how deep it goes and how far it stands out.
fn described(sheet: &Checklist, piece: &Hardware) -> String {
    let length_mm = (Point::from(piece.to_mm) - Point::from(piece.from_mm)).norm();
    let [length, depth, out, socket] = [
        length_mm,
        piece.depth_mm,
        length_mm - piece.depth_mm,
        piece.socket_mm,
    ]
    .map(|mm| quantity(mm, "mm"));
    let rod = format!(
        "{} of {} in diameter, cut {length} long, {} ({})",
        piece.what,
        quantity(piece.diameter_mm, "mm"),
        quantity(piece.mass_g, "g"),
        quantity(piece.density_g_cm3, "g/cm³")
    );
    match piece.what.as_str() {
        "axle" => format!(
            "{rod}: glued {depth} deep into the {socket} socket of each half, with {} between the halves; a shim of that thickness holds \
             them while the glue sets.",
            quantity(sheet.string_gap_mm.unwrap_or(0.0), "mm")
        ),
        "ring" => format!(
            "nuts, washers or a bearing about the axle in the gap, {} in all, counted as a ring of {} across and {length} wide.",
            quantity(piece.mass_g, "g"),
            quantity(piece.diameter_mm, "mm")
        ),
        "tip" => format!(
            "{rod}, its lower end rounded to a half ball: glued {depth} deep into the {socket} socket at the contact; {out} stand out, \
             and its end is the contact point."
        ),
        _ => format!("{rod}: glued {depth} deep into the {socket} socket on top; {out} stand out."),
    }
}

/// A piece of ballast as it is drawn: nuts and coins as discs.
pub(super) fn drawn_lump(lump: &Lump) -> TriMesh {
    let (center, shape) = (Point::from(lump.center_mm), &lump.shape);
    if shape.is_ball() {
        return primitives::ball(&center, shape.radius_mm(), BALL_LEVEL);
    }
    let frame = Frame::with_axis(center, &Vector::from(lump.axis).normalize());
    let low = Point::new(0.0, 0.0, -shape.half_height_mm());
    let disc = primitives::cylinder(shape.radius_mm(), 2.0 * shape.half_height_mm(), SIDES);
    disc.map_vertices(|p| frame.to_model(&(low + p.coords)))
}

/// A piece as it is drawn: rings as if they had no hole.
pub(super) fn drawn(piece: &Hardware) -> TriMesh {
    let (from, to) = (Point::from(piece.from_mm), Point::from(piece.to_mm));
    let (radius_mm, length_mm) = (0.5 * piece.diameter_mm, (to - from).norm());
    let frame = Frame::with_axis(from, &(to - from));
    let straight_mm = if piece.round_end {
        length_mm - radius_mm
    } else {
        length_mm
    };
    let rod = primitives::cylinder(radius_mm, straight_mm, SIDES);
    let end = Point::new(0.0, 0.0, straight_mm);
    let ball = if piece.round_end {
        primitives::ball(&end, radius_mm, BALL_LEVEL)
    } else {
        TriMesh::default()
    };
    rod.joined(&ball).map_vertices(|p| frame.to_model(p))
}
