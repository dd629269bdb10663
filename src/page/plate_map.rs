//! The plates as the printer's operator sees them from above, with the names of what lies there.

use rayon::prelude::*;

use super::figure::{Draft, Picture, Role};
use super::subject::Subject;
use crate::base::numbers::measured;
use crate::base::watch::Watch;
use crate::draw::{
    Camera, Color, HARDWARE, Item, Label, PLATE, PictureError, Scene, Shot, part_color,
};
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;
use crate::sheet::Checklist;
use crate::verify::{PartEvidence, PlateSpot, PromisedPlate};

/// Width and height of a picture, pixels.
const SIZE_PX: [usize; 2] = [720, 560];
/// Height of words, pixels: 10 points at half the width of an A4 page.
const TEXT_PX: f64 = 30.0;
/// Shares of the picture left free for names: at the sides, and above and below.
const MARGIN_RATIO: [f64; 2] = [0.14, 0.13];
/// Distance of the drawn plate below what lies on it, mm.
const BELOW_MM: f64 = 0.05;
/// Distance of the plate's sizes from its edges, pixels.
const ASIDE_PX: f64 = 20.0;

/// Draws every plate from above; the same bytes on any number of threads.
///
/// # Errors
/// A picture cannot be encoded, or the watch was stopped.
pub(super) fn pictures(
    sheet: &Checklist,
    subject: &Subject,
    watch: &Watch,
) -> Result<Vec<Picture>, PictureError> {
    let draw = |plate: &PromisedPlate| {
        watch.check()?;
        draft(plate, &things_on(plate, [subject.parts, subject.jigs])).draw()
    };
    sheet.plates.par_iter().map(draw).collect()
}

/// Returns the parts and jigs on a plate with their colours. The plate itself comes last, so that
/// the names count from the first thing.
fn things_on(plate: &PromisedPlate, made: [&[PartEvidence]; 2]) -> Vec<(Color, TriMesh)> {
    let things = plate.holds.iter();
    let things = things.filter_map(|spot| laid(spot, made));
    let bed = plate.size_mm.map(|size_mm| (PLATE[0], bed(size_mm)));
    things.chain(bed).collect()
}

/// Returns a part or jig as it lies on its plate, with its colour.
fn laid(spot: &PlateSpot, [parts, jigs]: [&[PartEvidence]; 2]) -> Option<(Color, TriMesh)> {
    let parts = parts.iter().enumerate();
    let parts = parts.map(|(index, part)| (part_color(index), part));
    let jigs = jigs.iter().map(|jig| (HARDWARE, jig));
    let (color, thing) = parts.chain(jigs).find(|(_, thing)| thing.id == spot.id)?;
    let turned = thing.mesh.map_vertices(|p| {
        if spot.is_turned {
            Point::new(-p.y, p.x, p.z)
        } else {
            *p
        }
    });
    let aabb = turned.aabb();
    let size = aabb.size();
    // Files may be scaled against shrinkage; the box on the plate is theirs.
    let [across, deep] = [spot.size_mm[0] / size.x, spot.size_mm[1] / size.y];
    let [left, front] = spot.low_mm;
    let mesh = turned.map_vertices(|p| {
        Point::new(
            left + (p.x - aabb.min.x) * across,
            front + (p.y - aabb.min.y) * deep,
            p.z,
        )
    });
    Some((color, mesh))
}

/// Returns the picture of a plate with things on it.
fn draft<'a>(plate: &PromisedPlate, things: &'a [(Color, TriMesh)]) -> Draft<'a> {
    let stem = plate.file.trim_end_matches(".3mf");
    let names = plate.holds.iter().enumerate();
    let names = names.map(|(index, spot)| Label::On(index, spot.id.clone()));
    let sizes = plate.size_mm.map(sizes).into_iter().flatten();
    let ids: Vec<&str> = plate.holds.iter().map(|spot| spot.id.as_str()).collect();
    Draft {
        file: format!("pictures/{stem}.svg"),
        role: Role::Plate,
        caption: format!("{} from above, its front edge below.", plate.file),
        alt: format!("The build plate from above. On it lie {}.", ids.join(", ")),
        shot: Shot {
            scene: Scene {
                items: things
                    .iter()
                    .map(|(color, mesh)| Item::new(mesh, *color))
                    .collect(),
                cut: None,
            },
            camera: Camera {
                toward_viewer: Vector::z(),
                up: Vector::y(),
                size_px: SIZE_PX,
                margin_ratio: MARGIN_RATIO,
            },
            text_px: TEXT_PX,
            labels: names.chain(sizes).collect(),
            keys: Vec::new(),
        },
    }
}

/// Returns the plate as a flat rectangle that faces up.
fn bed([width, depth]: [f64; 2]) -> TriMesh {
    let corners = [[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]];
    let corners = corners.map(|[x, y]| Point::new(x, y, -BELOW_MM));
    TriMesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]]).unwrap_or_default()
}

/// Returns the width and the depth of a plate, beside its front and its right edge.
fn sizes([width, depth]: [f64; 2]) -> [Label; 2] {
    let at = |x: f64, y: f64| Point::new(x, y, -BELOW_MM);
    let front = [at(0.0, 0.0), at(width, 0.0)];
    let right = [at(width, 0.0), at(width, depth)];
    let words = |axis: &str, mm: f64| format!("{axis} {}", measured(mm, "mm"));
    [
        Label::Length(front, [0.0, ASIDE_PX], words("x", width)),
        Label::Length(right, [ASIDE_PX, 0.0], words("y", depth)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    fn spot(id: &str, low_mm: [f64; 2], size_mm: [f64; 2], is_turned: bool) -> PlateSpot {
        PlateSpot {
            id: id.to_owned(),
            low_mm,
            size_mm,
            is_turned,
        }
    }

    #[test]
    fn a_part_lies_on_its_plate_where_the_sheet_says_turned_and_as_large_as_its_file() {
        let (_, evidence) = sample();
        let made = [&evidence.parts[..], &[]];
        let flat = evidence.parts[1].mesh.aabb().size();
        for (is_turned, size) in [(false, [flat.x, flat.y]), (true, [flat.y, flat.x])] {
            let size = size.map(|mm| mm * 1.01);
            let place = spot("P02", [7.0, 9.0], size, is_turned);
            let (color, mesh) = laid(&place, made).unwrap();
            let found = mesh.aabb();
            assert_eq!(color, part_color(1));
            assert!((found.min.x - 7.0).abs() < 1e-9 && (found.min.y - 9.0).abs() < 1e-9);
            assert!((found.size().x - size[0]).abs() < 1e-9, "{is_turned}");
            assert!((found.size().y - size[1]).abs() < 1e-9, "{is_turned}");
        }
        assert!(laid(&spot("P09", [0.0; 2], [1.0; 2], false), made).is_none());
    }

    #[test]
    fn a_map_shows_a_plate_with_its_sizes_and_the_names_on_it() {
        let (_, evidence) = sample();
        let size = |index: usize| {
            let size = evidence.parts[index].mesh.aabb().size();
            [size.x, size.y]
        };
        let plate = PromisedPlate {
            file: "plate.3mf".to_owned(),
            size_mm: Some([250.0, 210.0]),
            holds: vec![
                spot("P01", [0.0, 0.0], size(0), false),
                spot("P02", [90.0, 0.0], size(1), false),
            ],
        };
        let things = things_on(&plate, [&evidence.parts, &[]]);
        let made = draft(&plate, &things).draw().unwrap();
        let drawing = String::from_utf8(made.bytes()).unwrap();
        for words in ["P01", "P02", "x 250", "y 210"] {
            assert!(drawing.contains(words), "{words}");
        }
        assert_eq!(made.file, "pictures/plate.svg");
    }
}
