//! The 3D view of the page: the simplified assembly as data for the script, and the controls.

use maud::{Markup, PreEscaped, html};
use rayon::prelude::*;
use serde::Serialize;

use super::apart::{gap_for_mm, shift_of_lump, shifts};
use super::inserts::{lump_mesh, rod_mesh};
use super::subject::{Subject, parts_in_model};
use crate::base::watch::{Cancelled, Watch};
use crate::draw::{BALLAST, Color, HARDWARE, Hatch, PictureError, base64, hex, part_color};
use crate::geom::{Aabb, Vector};
use crate::mesh::{Csg, TriMesh};
use crate::repair::weld;

/// The script that draws the view.
const SCRIPT: &str = include_str!("view.js");

/// Greatest number of triangles of all parts together. A packed triangle takes about 12 bytes of
/// the page, so these take 0.7 MB; a screen cannot show more detail.
const TRIANGLES: usize = 60_000;

/// First tolerance of the simplification, as a share of the longest side: a quarter of a pixel of
/// the view.
const TOLERANCE_RATIO: f64 = 2.5e-4;

/// Greatest number of times the tolerance is doubled while there are too many triangles. That makes
/// it 1.6 % of the longest side at most.
const DOUBLINGS: usize = 6;

/// Greatest number of a packed coordinate.
const STEPS: f64 = 65_535.0;

/// The 3D view of a kit, packed for the script of the page.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    packed: String,
    items: Vec<(String, Color)>,
}

/// An object of the view before it is packed, in the goal's frame.
struct Item {
    name: String,
    mesh: TriMesh,
    color: Color,
    hatch: Hatch,
    shift: Vector,
}

/// The data that the script reads.
#[derive(Serialize)]
struct Packed {
    #[serde(rename = "box")]
    bounds: [[f64; 3]; 2],
    items: Vec<PackedItem>,
}

/// An object as the script reads it, in base64, little endian. A vertex is three 16-bit shares of
/// the box, a triangle three 16-bit vertex numbers, or 32-bit ones if it is wide.
#[derive(Serialize)]
struct PackedItem {
    color: [f64; 3],
    /// Ground of the cut face.
    cut: [f64; 3],
    /// Stripes of the cut face.
    stripe: [f64; 3],
    /// Direction of the stripes: 0 up, 1 down, 2 both.
    runs: u8,
    shift: [f64; 3],
    wide: bool,
    vertices: String,
    triangles: String,
}

impl View {
    /// Packs the view of a kit; the same bytes on any number of threads. Takes about 10 µs per
    /// triangle of the parts.
    ///
    /// # Errors
    /// [`PictureError::Cancelled`] if the watch was stopped.
    pub fn of(subject: &Subject, watch: &Watch) -> Result<Self, PictureError> {
        let items = items(subject, watch)?;
        let bounds = items
            .iter()
            .map(|item| item.mesh.aabb())
            .fold(Aabb::EMPTY, |all, next| all.union(&next));
        let packed = Packed {
            bounds: [bounds.min, bounds.max].map(|corner| corner.coords.into()),
            items: items.iter().map(|item| pack(item, &bounds)).collect(),
        };
        let packed = serde_json::to_string(&packed)?;
        Ok(Self {
            packed,
            items: items
                .into_iter()
                .map(|item| (item.name, item.color))
                .collect(),
        })
    }
}

/// Returns the simplified parts, the hardware and the ballast in the goal's frame.
fn items(subject: &Subject, watch: &Watch) -> Result<Vec<Item>, Cancelled> {
    let in_place = parts_in_model(subject.parts);
    let shifts = shifts(&in_place, &subject.partings());
    let frame = subject.aim.frame();
    let budget = TRIANGLES / in_place.len().max(1);
    let parts = subject
        .parts
        .par_iter()
        .zip(&in_place)
        .zip(&shifts)
        .enumerate();
    let parts = parts.map(|(index, ((part, mesh), shift))| {
        Ok(Item {
            name: part.id.clone(),
            mesh: simplify(mesh, budget, watch)?.in_frame(&frame),
            color: part_color(index),
            hatch: Hatch::PRINTED,
            shift: frame.direction_to_local(shift),
        })
    });
    let mut items = parts.collect::<Result<Vec<Item>, Cancelled>>()?;
    items.extend(subject.hardware.iter().map(|piece| Item {
        name: piece.id.clone(),
        mesh: rod_mesh(piece).in_frame(&frame),
        color: HARDWARE,
        hatch: Hatch::RODS,
        shift: Vector::zeros(),
    }));
    let apart_mm = gap_for_mm(in_place.iter());
    items.extend(subject.ballast.iter().map(|order| Item {
        name: order.id.clone(),
        mesh: lump_mesh(&order.lump).in_frame(&frame),
        color: BALLAST,
        hatch: Hatch::BALLAST,
        shift: frame.direction_to_local(&shift_of_lump(&order.lump, &subject.partings(), apart_mm)),
    }));
    Ok(items)
}

/// Returns the mesh with at most `budget` triangles, if the greatest tolerance suffices. A mesh
/// that cannot be simplified is returned as it is.
fn simplify(mesh: &TriMesh, budget: usize, watch: &Watch) -> Result<TriMesh, Cancelled> {
    let welded = weld(mesh);
    let tolerance_mm = TOLERANCE_RATIO * welded.longest_side_mm();
    let Ok(mut body) = Csg::of_mesh(&welded) else {
        return Ok(welded);
    };
    for doubled in 0..=DOUBLINGS {
        watch.check()?;
        if body.triangle_count() <= budget {
            break;
        }
        let coarser = body.coarsen(tolerance_mm * f64::powi(2.0, doubled as i32));
        if coarser.is_empty() {
            break;
        }
        body = coarser;
    }
    Ok(body.to_mesh().unwrap_or(welded))
}

fn pack(item: &Item, bounds: &Aabb) -> PackedItem {
    let (size, vertices) = (bounds.size(), item.mesh.vertices());
    let share = |value: f64, low: f64, size: f64| {
        ((value - low) / size.max(f64::MIN_POSITIVE) * STEPS).round() as u16
    };
    let coordinates = vertices
        .iter()
        .flat_map(|p| [0, 1, 2].map(|axis| share(p[axis], bounds.min[axis], size[axis])));
    let wide = vertices.len() > usize::from(u16::MAX);
    let corners = item.mesh.triangles().iter().flatten();
    let triangles: Vec<u8> = if wide {
        corners.flat_map(|corner| corner.to_le_bytes()).collect()
    } else {
        corners
            .flat_map(|corner| (*corner as u16).to_le_bytes())
            .collect()
    };
    PackedItem {
        color: shares(item.color),
        cut: shares(item.hatch.dark),
        stripe: shares(item.hatch.pale),
        runs: item.hatch.stripes as u8,
        shift: item.shift.into(),
        wide,
        vertices: base64(&coordinates.flat_map(u16::to_le_bytes).collect::<Vec<u8>>()),
        triangles: base64(&triangles),
    }
}

/// Returns a colour as shares of white.
fn shares(color: Color) -> [f64; 3] {
    color.map(|channel| f64::from(channel) / 255.0)
}

/// Returns the view with its controls, hidden until the script finds that it can draw.
pub(super) fn viewer(view: &View) -> Markup {
    html! {
        section id="view" class="screen-only" aria-labelledby="view-title" hidden {
            h2 id="view-title" { "3D view" }
            canvas id="view-canvas" tabindex="0" role="application"
                aria-label="The assembly in three dimensions. Drag or press the arrow keys to turn it, plus and minus to zoom, Home to reset. The pictures of this sheet show the same." {}
            div class="controls" {
                label for="view-explode" { "Take apart" }
                input id="view-explode" type="range" min="0" max="100" value="0";
                label for="view-axis" { "Cut open" }
                span {
                    select id="view-axis" {
                        option value="-1" selected { "off" }
                        option value="0" { "side" }
                        option value="1" { "front" }
                        option value="2" { "top" }
                    }
                    " " span id="view-place" {}
                }
                label for="view-section" { "Where" }
                input id="view-section" type="range" min="0" max="100" step="0.5" value="50" disabled;
                fieldset {
                    legend { "Show" }
                    @for (index, (name, color)) in view.items.iter().enumerate() {
                        label class="item" {
                            input type="checkbox" checked data-item=(index);
                            span class="swatch" style=(format!("background:{}", hex(*color))) {} " " (name)
                        }
                    }
                }
                button id="view-reset" type="button" { "Reset view" }
            }
            // The packed text has no `<`, so nothing in it can end the script.
            script id="view-data" type="application/json" { (PreEscaped(&view.packed)) }
            script { (PreEscaped(SCRIPT)) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::verify::test_meshes::ball;

    #[test]
    fn a_fine_ball_is_simplified_to_the_budget_and_stays_a_ball() {
        let fine = ball(Point::origin(), 10.0, 256);
        let simple = simplify(&fine, 5000, &Watch::silent()).unwrap();
        assert!(simple.triangles().len() <= 5000 && fine.triangles().len() > 50_000);
        // The greatest tolerance is 64 · 2.5e-4 of 20 mm; the lost volume is less than a shell of
        // it.
        let lost = 1.0 - simple.signed_volume_mm3() / fine.signed_volume_mm3();
        assert!(lost.abs() < 3.0 * 64.0 * TOLERANCE_RATIO * 2.0, "{lost}");
    }

    #[test]
    fn coordinates_are_packed_in_16_bits() {
        let mesh = ball(Point::new(1.0, 2.0, 3.0), 5.0, 12);
        let item = Item {
            name: "x".into(),
            mesh: mesh.clone(),
            color: [255, 0, 0],
            hatch: Hatch::PRINTED,
            shift: Vector::zeros(),
        };
        let packed = pack(&item, &mesh.aabb());
        assert!(!packed.wide && packed.color == [1.0, 0.0, 0.0]);
        assert_eq!(
            packed.triangles,
            base64(
                &mesh
                    .triangles()
                    .iter()
                    .flatten()
                    .flat_map(|i| (*i as u16).to_le_bytes())
                    .collect::<Vec<_>>()
            )
        );
        // 6 bytes per vertex, four letters for three bytes.
        assert_eq!(
            packed.vertices.len(),
            (6 * mesh.vertices().len()).div_ceil(3) * 4
        );
    }
}
