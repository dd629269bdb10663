//! Bodies of a view: simplified to what a screen shows, and packed each in its own box.

use rayon::prelude::*;
use serde::Serialize;

use crate::base::watch::{Cancelled, Watch};
use crate::draw::{Color, Hatch, base64};
use crate::geom::{Aabb, Point};
use crate::mesh::{Csg, TriMesh};
use crate::repair::weld;

/// Greatest number of triangles of all bodies together. A packed triangle takes about 12 bytes of
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

/// A body of the view before it is packed, in its own frame.
#[derive(Debug)]
pub(in crate::page) struct Body {
    pub name: String,
    pub mesh: TriMesh,
    pub color: Color,
    pub hatch: Hatch,
}

/// A body or a line as the scripts read it, in base64, little endian. A vertex is three 16-bit
/// shares of its box, a triangle three 16-bit vertex numbers, or 32-bit ones if it is wide.
#[derive(Debug, Serialize)]
pub(super) struct PackedBody {
    name: String,
    /// The low corner of its box, mm.
    low: [f64; 3],
    /// The sides of its box, mm.
    size: [f64; 3],
    color: [f64; 3],
    /// Ground of the cut face.
    cut: [f64; 3],
    /// Stripes of the cut face.
    stripe: [f64; 3],
    /// Direction of the stripes: 0 up, 1 down, 2 both.
    runs: u8,
    wide: bool,
    vertices: String,
    /// Empty for a line, whose vertices follow each other.
    triangles: String,
}

impl PackedBody {
    pub fn of(body: &Body) -> Self {
        let mesh = &body.mesh;
        let wide = mesh.vertices().len() > usize::from(u16::MAX);
        let corners = mesh.triangles().iter().flatten();
        let triangles: Vec<u8> = if wide {
            corners.flat_map(|corner| corner.to_le_bytes()).collect()
        } else {
            corners
                .flat_map(|corner| (*corner as u16).to_le_bytes())
                .collect()
        };
        Self {
            wide,
            triangles: base64(&triangles),
            cut: shares(body.hatch.dark),
            stripe: shares(body.hatch.pale),
            runs: body.hatch.stripes as u8,
            ..Self::line(&body.name, mesh.vertices(), body.color)
        }
    }

    /// Packs the points of a line.
    pub fn line(name: &str, points: &[Point], color: Color) -> Self {
        let bounds = Aabb::of_points(points);
        let size = bounds.size();
        let share = |value: f64, low: f64, size: f64| {
            ((value - low) / size.max(f64::MIN_POSITIVE) * STEPS).round() as u16
        };
        let coordinates = points
            .iter()
            .flat_map(|p| [0, 1, 2].map(|axis| share(p[axis], bounds.min[axis], size[axis])));
        let bytes: Vec<u8> = coordinates.flat_map(u16::to_le_bytes).collect();
        Self {
            name: name.to_owned(),
            low: bounds.min.coords.into(),
            size: size.into(),
            color: shares(color),
            cut: shares(color),
            stripe: shares(color),
            runs: 0,
            wide: false,
            vertices: base64(&bytes),
            triangles: String::new(),
        }
    }
}

/// Returns a colour as shares of white.
fn shares(color: Color) -> [f64; 3] {
    color.map(|channel| f64::from(channel) / 255.0)
}

/// Returns the meshes with as many triangles together as a page has room for, if the greatest
/// tolerance suffices. The same on any number of threads; takes about 10 µs per triangle.
pub(in crate::page) fn simplify_all(
    meshes: &[&TriMesh],
    watch: &Watch,
) -> Result<Vec<TriMesh>, Cancelled> {
    let counts: Vec<usize> = meshes.iter().map(|mesh| mesh.triangles().len()).collect();
    let budgets = budgets(&counts, TRIANGLES);
    let simple = meshes.par_iter().zip(&budgets);
    simple
        .map(|(mesh, budget)| simplify(mesh, *budget, watch))
        .collect()
}

/// Shares a number among bodies: what one does not need is left to the others.
fn budgets(counts: &[usize], total: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..counts.len()).collect();
    order.sort_by_key(|&body| counts[body]);
    let mut budgets = vec![0; counts.len()];
    let mut left = total;
    for (place, &body) in order.iter().enumerate() {
        let share = left / (counts.len() - place);
        budgets[body] = share.max(1);
        left -= counts[body].min(share);
    }
    budgets
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

#[cfg(test)]
mod tests {
    use super::*;
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
    fn what_a_body_does_not_need_is_left_to_the_others() {
        assert_eq!(budgets(&[10, 1000, 1000], 610), [203, 300, 300]);
        assert_eq!(budgets(&[10, 20], 100), [50, 90]);
        assert_eq!(budgets(&[], 100), Vec::<usize>::new());
        let many = budgets(&[50; 7], 10);
        assert!(many.iter().all(|budget| *budget >= 1));
    }

    #[test]
    fn coordinates_are_packed_in_16_bits_of_their_own_box() {
        let mesh = ball(Point::new(1.0, 2.0, 3.0), 5.0, 12);
        let packed = PackedBody::of(&Body {
            name: "x".into(),
            mesh: mesh.clone(),
            color: [255, 0, 0],
            hatch: Hatch::PRINTED,
        });
        assert!(!packed.wide && packed.color == [1.0, 0.0, 0.0]);
        assert_eq!(packed.low, <[f64; 3]>::from(mesh.aabb().min.coords));
        let corners = mesh.triangles().iter().flatten();
        let corners: Vec<u8> = corners.flat_map(|i| (*i as u16).to_le_bytes()).collect();
        assert_eq!(packed.triangles, base64(&corners));
        // 6 bytes per vertex, four letters for three bytes.
        assert_eq!(
            packed.vertices.len(),
            (6 * mesh.vertices().len()).div_ceil(3) * 4
        );
    }
}
