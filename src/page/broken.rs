//! The picture of a model that is refused: what is broken is red, and the places have names.

use crate::draw::{
    BODY, Camera, Drawing, Drawn, Item, Label, PIN, PictureError, Scene, Shot, TEXT_PX,
    view_direction,
};
use crate::geom::{Bvh, Point, Vector, orthonormal_basis};
use crate::mesh::{Broken, TriMesh};

/// Number of directions around the model from which a view is chosen.
const SIDES: usize = 8;
/// Heights of the viewer above and below the ground, radians.
const LIFTS: [f64; 2] = [0.45, -0.45];
/// Width and height of the picture, pixels.
const SIZE_PX: [usize; 2] = [1200, 800];
/// Share of the picture's width left free on either side for names.
const NAMES_RATIO: f64 = 0.24;
/// Half the width of the red bars along broken edges, as a share of the longest side: two pixels.
const BAR_RATIO: f64 = 0.003;
/// Distance of a place from the surface at which it is looked for, as a share of the longest side:
/// places lie on the surface.
const OFF_RATIO: f64 = 1e-3;
/// The words for those who cannot see the picture.
const ALT: &str = "The model; what is broken is red, and the places that are listed have names";

/// A place of a defect, and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// The place, in the coordinates of the mesh.
    pub at: Point,
    /// The name.
    pub words: String,
}

/// Draws the mesh as an SVG file, from the side that shows most of the places. What is broken is
/// red: triangles that cross others, and bars along rims and other broken edges. Places behind the
/// model have a dashed line.
///
/// # Errors
/// The picture cannot be encoded.
pub fn draw_broken(
    mesh: &TriMesh,
    broken: &Broken,
    places: &[Place],
) -> Result<String, PictureError> {
    let up = Vector::z();
    let toward_viewer = best_view(mesh, &up, places);
    let [sound, crossing] = split(mesh, &broken.crossing);
    let bars = bars(&broken.edges, BAR_RATIO * mesh.longest_side_mm());
    let label = |place: &Place| Label::At(place.at, place.words.clone());
    let shot = Shot {
        scene: Scene {
            items: vec![
                Item::new(&sound, BODY),
                Item::new(&crossing, PIN),
                Item::new(&bars, PIN),
            ],
            cut: None,
        },
        camera: Camera {
            size_px: SIZE_PX,
            margin_ratio: [NAMES_RATIO, 0.0],
            ..Camera::new(toward_viewer, up)
        },
        text_px: TEXT_PX,
        labels: places.iter().map(label).collect(),
        keys: Vec::new(),
    };
    let drawing = match shot.draw()? {
        Drawn::Svg(drawing) => drawing,
        Drawn::Png(bytes) => {
            let mut drawing = Drawing::new(SIZE_PX, TEXT_PX);
            drawing.picture(&bytes, SIZE_PX, 1.0);
            drawing
        }
    };
    Ok(drawing.to_file(ALT))
}

/// Returns the triangles that cross no other, and those that do.
fn split(mesh: &TriMesh, crossing: &[bool]) -> [TriMesh; 2] {
    [false, true].map(|wanted| {
        let triangles = mesh.triangles().iter().zip(crossing);
        let triangles = triangles.filter(|(_, crosses)| **crosses == wanted);
        let triangles = triangles.map(|(triangle, _)| *triangle).collect();
        TriMesh::from_parts(mesh.vertices().to_vec(), triangles)
    })
}

/// Returns a three-sided bar along each edge, its corners this far from it, mm.
fn bars(edges: &[[Point; 2]], radius_mm: f64) -> TriMesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for [from, to] in edges {
        let Some(along) = (to - from).try_normalize(0.0) else {
            continue;
        };
        let (u, v) = orthonormal_basis(&along);
        let first = vertices.len() as u32;
        for end in [from, to] {
            let corners = (0..3).map(|i| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / 3.0).sin_cos();
                end + (u * cos + v * sin) * radius_mm
            });
            vertices.extend(corners);
        }
        let at = |corner: u32| first + corner;
        for (i, next) in [(0, 1), (1, 2), (2, 0)] {
            triangles.push([at(i), at(next), at(next + 3)]);
            triangles.push([at(i), at(next + 3), at(i + 3)]);
        }
        triangles.push([at(0), at(2), at(1)]);
        triangles.push([at(3), at(4), at(5)]);
    }
    TriMesh::from_parts(vertices, triangles)
}

/// Returns the direction to the viewer who sees most places.
fn best_view(mesh: &TriMesh, up: &Vector, places: &[Place]) -> Vector {
    let bvh = Bvh::new(mesh.iter_corners());
    let size_mm = mesh.longest_side_mm();
    let (across, front) = orthonormal_basis(up);
    let views = LIFTS.into_iter().flat_map(|lift| {
        (0..SIDES).map(move |side| {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / SIDES as f64).sin_cos();
            view_direction(&(front * cos + across * sin), up, [0.0, lift])
        })
    });
    let count_seen = |view: &Vector| {
        let is_seen = |place: &&Place| {
            let from = place.at + view * (OFF_RATIO * size_mm);
            !bvh.crosses_segment(&from, &(from + view * (2.0 * size_mm)))
        };
        places.iter().filter(is_seen).count()
    };
    let counted = views.map(|view| (count_seen(&view), view));
    let best = counted.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map_or(front, |(_, view)| view)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::mesh::primitives::cuboid;

    #[test]
    fn every_place_is_named_on_the_picture() {
        let cube = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let broken = Broken {
            edges: vec![[Point::origin(), Point::new(10.0, 0.0, 0.0)]],
            crossing: vec![false; cube.triangles().len()],
        };
        let place = |x: f64| Place {
            at: Point::new(x, 0.0, 5.0),
            words: format!("hole at {x}"),
        };
        let svg = draw_broken(&cube, &broken, &[place(2.0), place(7.0)]).unwrap();
        assert!(svg.contains("hole at 2") && svg.contains("hole at 7"));
    }

    #[test]
    fn a_bar_along_an_edge_is_a_closed_body_that_faces_outward() {
        let ends = [Point::new(1.0, 2.0, 3.0), Point::new(4.0, 6.0, 3.0)];
        let bar = bars(&[ends], 0.1);
        // A triangle with a radius of 0.1 mm has 0.75 √3 0.01 mm².
        let volume = 5.0 * 0.75 * 3.0_f64.sqrt() * 0.01;
        assert!((bar.signed_volume_mm3() - volume).abs() < 1e-12);
        assert!(crate::mesh::Solid::new(bar).is_ok());
    }

    #[test]
    fn a_model_without_places_is_drawn_too() {
        let cube = cuboid(&Point::origin(), &Point::new(10.0, 10.0, 10.0));
        let sound = Broken::of(&cube, &Watch::silent()).unwrap();
        let svg = draw_broken(&cube, &sound, &[]).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("data:image/png"));
    }
}
