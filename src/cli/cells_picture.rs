//! Pictures of cells, apart and cut open, and the plot of their relaxation.

use crate::cells::{Body, Norm, StepFigures};
use crate::draw::{
    CURVES, Camera, Curve, Drawing, Item, PictureError, Plot, Scene, part_color, render,
    view_direction,
};
use crate::geom::{Aabb, Point, Vector, orthonormal_basis};
use crate::mesh::TriMesh;

/// Angles of the viewer to the right of the front and above the ground, radians.
const TURN_LIFT: [f64; 2] = [0.5, 0.45];
/// The distance by which cells are drawn apart, as a part of that from the middle.
const APART_RATIO: f64 = 0.5;

/// The ways in which cells are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Look {
    /// Each away from the middle.
    Apart,
    /// Those beyond the middle, without those before it.
    Open,
}

/// Draws cells as the bytes of a PNG file, with `up` upright.
pub(super) fn pictures(
    bodies: &[Body],
    up: Option<Vector>,
    look: Look,
) -> Result<Vec<u8>, PictureError> {
    let up = up.unwrap_or_else(Vector::z);
    let (front, _) = orthonormal_basis(&up);
    let toward_viewer = view_direction(&front, &up, TURN_LIFT);
    let meshes: Vec<TriMesh> = bodies.iter().map(Body::mesh).collect();
    let middles: Vec<Point> = bodies.iter().map(middle).collect();
    let whole = Aabb::of_points(bodies.iter().flat_map(|body| &body.corners)).center();
    let items = meshes.iter().zip(&middles).enumerate();
    let items =
        items.filter(|(_, (_, middle))| look == Look::Apart || front.dot(&(*middle - whole)) < 0.0);
    let items = items.map(|(index, (mesh, middle))| Item {
        shift: match look {
            Look::Apart => (middle - whole) * APART_RATIO,
            Look::Open => Vector::zeros(),
        },
        ..Item::new(mesh, part_color(index))
    });
    let scene = Scene {
        items: items.collect(),
        cut: None,
    };
    render(&scene, &Camera::new(toward_viewer, up)).to_png()
}

/// Returns the middle of a body's box.
fn middle(body: &Body) -> Point {
    Aabb::of_points(&body.corners).center()
}

/// Draws the energy of every step, as a share of that of cubes, %.
pub(super) fn plot(steps: &[StepFigures], norm: Norm) -> Drawing {
    let points = steps.iter().enumerate();
    let points = points.map(|(step, figures)| [step as f64, 100.0 * figures.energy_ratio]);
    let (name, color) = match norm {
        Norm::Linf => ("relaxed under L∞", CURVES[0]),
        Norm::L2 => ("relaxed under L2", CURVES[1]),
    };
    let curve = Curve {
        name,
        points: points.collect(),
        color,
        is_second: norm == Norm::L2,
    };
    Plot {
        across: "step".to_owned(),
        up: "energy, % of cubes".to_owned(),
        curves: vec![curve],
        mark: None,
    }
    .draw()
}
