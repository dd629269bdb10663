//! A part on the build plate in print pose: squares of 10 mm under it, and its size along the
//! printer's axes.

use super::figure::{Draft, Role};
use crate::base::numbers::measured;
use crate::draw::{Camera, Color, Item, Label, PLATE, Scene, Shot, view_direction};
use crate::geom::{Aabb, Point, Vector};
use crate::mesh::TriMesh;
use crate::sheet::part_picture_file;
use crate::verify::PartEvidence;

/// Width and height of a picture, pixels: sharp at a third of the width of an A4 page.
const SIZE_PX: [usize; 2] = [560, 460];

/// Height of words, pixels: 10 points at a third of the width of an A4 page.
const TEXT_PX: f64 = 32.0;

/// Shares of the picture left free for dimensions: at the sides, and above and below.
const MARGIN_RATIO: [f64; 2] = [0.24, 0.16];

/// Angles of the viewer to the right and above the plate, radians: high enough to see into a hollow
/// that is open upward.
const TURN_AND_LIFT: [f64; 2] = [0.45, 0.7];

/// Side of the plate's squares, mm.
const SQUARE_MM: f64 = 10.0;

/// Distance of the drawn plate below the part, mm: enough that neither shows through the other.
const BELOW_MM: f64 = 0.05;

/// Distance of dimensions from what they measure, pixels.
const ASIDE_PX: f64 = 22.0;

/// Returns the light and the dark squares of a plate under a part, which reach past it on every
/// side.
pub(super) fn squares_under(part: &Aabb) -> [TriMesh; 2] {
    let first = |low: f64| (low / SQUARE_MM).floor() as i64 - 1;
    let last = |high: f64| (high / SQUARE_MM).ceil() as i64 + 1;
    let (columns, rows) = (
        first(part.min.x)..last(part.max.x),
        first(part.min.y)..last(part.max.y),
    );
    let squares = || {
        columns
            .clone()
            .flat_map(|x| rows.clone().map(move |y| (x, y)))
    };
    [0, 1].map(|parity| {
        let of_color = squares().filter(|(x, y)| (x + y).rem_euclid(2) == parity);
        flat_squares(
            of_color.map(|(x, y)| [x, y].map(|side| side as f64 * SQUARE_MM)),
            part.min.z - BELOW_MM,
        )
    })
}

/// Returns squares that face up, from their lower left corners.
fn flat_squares(corners: impl Iterator<Item = [f64; 2]>, z: f64) -> TriMesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for [x, y] in corners {
        let first = vertices.len() as u32;
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        vertices.extend(square.map(|[u, v]| Point::new(x + u * SQUARE_MM, y + v * SQUARE_MM, z)));
        triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    }
    TriMesh::new(vertices, triangles).unwrap_or_default()
}

/// Returns the picture of a part on its plate.
pub(super) fn draft<'a>(
    part: &'a PartEvidence,
    plate: &'a [TriMesh; 2],
    color: Color,
) -> Draft<'a> {
    let plates = plate
        .iter()
        .zip(PLATE)
        .map(|(squares, shade)| Item::new(squares, shade));
    Draft {
        file: part_picture_file(&part.id),
        role: Role::Part,
        caption: format!("{} as it lies on the plate; squares of 10 mm.", part.id),
        alt: format!(
            "Part {} in its print pose on a plate with squares of 10 mm, with its sizes.",
            part.id
        ),
        shot: Shot {
            scene: Scene {
                items: plates.chain([Item::new(&part.mesh, color)]).collect(),
                cut: None,
            },
            camera: Camera {
                toward_viewer: view_direction(&-Vector::y(), &Vector::z(), TURN_AND_LIFT),
                up: Vector::z(),
                size_px: SIZE_PX,
                margin_ratio: MARGIN_RATIO,
            },
            text_px: TEXT_PX,
            labels: dimensions(&part.mesh.aabb()),
            keys: Vec::new(),
        },
    }
}

/// Returns the sizes of a part along x, y and z.
fn dimensions(part: &Aabb) -> Vec<Label> {
    let (low, high) = (part.min, part.max);
    let size = part.size();
    let words = |axis: &str, mm: f64| format!("{axis} {}", measured(mm, "mm"));
    let right = Point::new(high.x, low.y, low.z);
    vec![
        Label::Length(
            [low, right],
            [-0.3 * ASIDE_PX, ASIDE_PX],
            words("x", size.x),
        ),
        Label::Length(
            [right, Point::new(high.x, high.y, low.z)],
            [ASIDE_PX, 0.6 * ASIDE_PX],
            words("y", size.y),
        ),
        Label::Length(
            [low, Point::new(low.x, low.y, high.z)],
            [-ASIDE_PX, 0.0],
            words("z", size.z),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plate_reaches_past_the_part_on_every_side() {
        let part = Aabb::of_points(&[Point::new(-12.0, 3.0, 0.0), Point::new(25.0, 7.0, 9.0)]);
        let [light, dark] = squares_under(&part);
        let plate = light.aabb().union(&dark.aabb());
        assert_eq!(
            (plate.min, plate.max),
            (
                Point::new(-30.0, -10.0, -BELOW_MM),
                Point::new(40.0, 20.0, -BELOW_MM)
            )
        );
        // Seven by three squares of two triangles; eleven squares have one shade.
        assert_eq!(
            [light.triangles().len(), dark.triangles().len()]
                .iter()
                .sum::<usize>(),
            42
        );
        assert_eq!(light.triangles().len().abs_diff(dark.triangles().len()), 2);
    }
}
