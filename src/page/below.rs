//! A part seen from below, with the surfaces that touch support in red.

use rayon::prelude::*;

use super::figure::{Draft, Picture, Role};
use super::subject::Subject;
use crate::base::watch::Watch;
use crate::draw::{
    Camera, Item, PIN, PictureError, Scene, Shot, TEXT_PX, part_color, view_direction,
};
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;
use crate::poses::{SupportRule, find_overhangs};
use crate::sheet::{Checklist, PartRow};
use crate::verify::{PartEvidence, Peg};

/// Width and height of a picture, pixels.
const SIZE_PX: [usize; 2] = [560, 380];

/// Angles of the viewer to the right and below the plate, radians: low enough to see the underside
/// and the sides.
const TURN_AND_LIFT: [f64; 2] = [0.45, -0.75];

/// The caption: the red is explained nowhere else.
pub(super) const CAPTION: &str = "Picture from below. Red: where support touches.";

/// Margin around a socket, whose roof is bridged, mm.
const SOCKET_ROOM_MM: f64 = 0.01;

/// Draws every part that needs support from below; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub(super) fn pictures(
    sheet: &Checklist,
    subject: &Subject,
    watch: &Watch,
) -> Result<Vec<Picture>, PictureError> {
    let Some(overhang_deg) = sheet.printer.cleaning.overhang_deg else {
        return Ok(Vec::new());
    };
    let rule = SupportRule {
        overhang_deg,
        layer_mm: sheet.printer.layer_mm,
    };
    let parts = sheet.parts.par_iter().zip(subject.parts).enumerate();
    let hung = parts.filter(|(_, (row, _))| row.support.is_some_and(|support| support.places > 0));
    let draw = |(index, (row, part)): (usize, (&PartRow, &PartEvidence))| {
        watch.check()?;
        let [bare, held] = divide(part, &row.sockets, &rule);
        draft(
            &row.id,
            [Item::new(&bare, part_color(index)), Item::new(&held, PIN)],
        )
        .draw()
    };
    hung.map(draw).collect()
}

/// Returns the path of the picture of a part from below in the kit.
pub(super) fn picture_file(id: &str) -> String {
    format!("pictures/{id}-below.png")
}

/// Divides the surface of a part into what touches no support and what does.
fn divide(part: &PartEvidence, sockets: &[Peg], rule: &SupportRule) -> [TriMesh; 2] {
    let is_held = find_overhangs(&part.mesh, rule);
    let in_socket = |index: usize| {
        let [a, b, c] = part.mesh.corners(index);
        let middle = part
            .pose
            .to_model(&Point::from((a.coords + b.coords + c.coords) / 3.0));
        sockets.iter().any(|socket| is_in(socket, &middle))
    };
    let kept = |wanted: bool| {
        let is_wanted = |index: &usize| (is_held[*index] && !in_socket(*index)) == wanted;
        let indices = (0..is_held.len()).filter(is_wanted);
        let triangles = indices.map(|index| part.mesh.triangles()[index]).collect();
        TriMesh::new(part.mesh.vertices().to_vec(), triangles).unwrap_or_default()
    };
    [kept(false), kept(true)]
}

/// Returns whether a point of the surface is in a socket.
fn is_in(socket: &Peg, at: &Point) -> bool {
    let from_base = at - Point::from(socket.center_mm);
    let axis = Vector::from(socket.axis);
    let along_mm = from_base.dot(&axis);
    let aside_mm = (from_base - axis * along_mm).norm();
    along_mm > -SOCKET_ROOM_MM
        && along_mm < socket.length_mm + SOCKET_ROOM_MM
        && aside_mm < 0.5 * socket.diameter_mm + SOCKET_ROOM_MM
}

fn draft<'a>(id: &str, items: [Item<'a>; 2]) -> Draft<'a> {
    Draft {
        file: picture_file(id),
        role: Role::Below,
        alt: format!("Part {id} in its print pose, seen from below. What touches support is red."),
        caption: CAPTION.to_owned(),
        shot: Shot {
            scene: Scene {
                items: items.to_vec(),
                cut: None,
            },
            camera: Camera {
                size_px: SIZE_PX,
                ..Camera::new(
                    view_direction(&-Vector::y(), &Vector::z(), TURN_AND_LIFT),
                    Vector::z(),
                )
            },
            text_px: TEXT_PX,
            labels: Vec::new(),
            keys: Vec::new(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;
    use crate::verify::Pose;

    #[test]
    fn the_underside_of_a_lifted_block_is_red_but_not_in_a_socket() {
        let floor = primitives::cuboid(&Point::new(0.0, 0.0, 0.0), &Point::new(1.0, 1.0, 1.0));
        let lifted = primitives::cuboid(&Point::new(5.0, 0.0, 4.0), &Point::new(9.0, 4.0, 9.0));
        let part = PartEvidence {
            id: "P01".to_owned(),
            mesh: floor.joined(&lifted),
            inner: Vec::new(),
            pose: Pose::identity(),
        };
        let rule = SupportRule {
            overhang_deg: 45.0,
            layer_mm: 0.2,
        };
        let red = |sockets: &[Peg]| divide(&part, sockets, &rule)[1].triangles().len();
        assert_eq!(red(&[]), 2);
        let socket = Peg {
            id: "N1".to_owned(),
            joint: "J1".to_owned(),
            center_mm: [7.0, 2.0, 3.0],
            axis: [0.0, 0.0, 1.0],
            diameter_mm: 4.0,
            length_mm: 2.0,
            volume_mm3: 0.0,
        };
        assert_eq!(red(&[socket]), 0);
    }
}
