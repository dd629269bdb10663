//! The picture of a skeleton in its model, from two sides.

use crate::draw::{
    BODY, Camera, Drawing, INK, InnerBall, InnerLine, Item, PictureError, Scene, draw_inside,
    part_color, view_direction,
};
use crate::geom::{Vector, orthonormal_basis};
use crate::mesh::Solid;
use crate::skeleton::{Branch, Skeleton};

/// Angles of the viewer to the right of each side and above the ground, radians: enough to show
/// depth.
const TURNS: [f64; 2] = [0.25, 0.25 + std::f64::consts::FRAC_PI_2];
const LIFT: f64 = 0.2;
/// The colours of parts that stand out on glass, in turn: no yellow and no pale ones.
const STRONG_COLORS: [usize; 6] = [1, 3, 5, 4, 7, 11];

/// Draws the skeleton in its model, with `up` upright.
///
/// Free branches have colours and solid ones are dashed. Balls of tips and junctures bear the
/// numbers of their nodes.
pub(super) fn picture(
    solid: &Solid,
    skeleton: &Skeleton,
    up: Option<Vector>,
) -> Result<Drawing, PictureError> {
    let scene = Scene {
        items: vec![Item::new(solid.mesh(), BODY)],
        cut: None,
    };
    let up = up.unwrap_or_else(Vector::z);
    let front = widest_front(solid, &up);
    let lines: Vec<InnerLine> = skeleton
        .branches
        .iter()
        .zip(STRONG_COLORS.into_iter().cycle())
        .map(|(branch, color)| line(skeleton, branch, color))
        .collect();
    let balls = balls(skeleton);
    let sides = TURNS.map(|turn| {
        let camera = Camera::new(view_direction(&front, &up, [turn, LIFT]), up);
        draw_inside(&scene, &camera.with_label_margins(), &lines, &balls)
    });
    let sides: Vec<Drawing> = sides.into_iter().collect::<Result<_, _>>()?;
    Ok(Drawing::row(&sides))
}

/// Returns the level direction from which the model is widest, of two across each other.
fn widest_front(solid: &Solid, up: &Vector) -> Vector {
    let (u, v) = orthonormal_basis(up);
    let extent = |axis: &Vector| {
        let along = solid.mesh().vertices().iter().map(|p| axis.dot(&p.coords));
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        high - low
    };
    if extent(&u) > extent(&v) { v } else { u }
}

fn line(skeleton: &Skeleton, branch: &Branch, color: usize) -> InnerLine {
    let is_solid = branch.solid.is_some();
    let nodes = branch.nodes.iter();
    InnerLine {
        points: nodes.map(|node| skeleton.nodes[*node].at).collect(),
        color: if is_solid { INK } else { part_color(color) },
        is_dashed: is_solid,
    }
}

/// Returns the balls of the root, the tips and the junctures; of a ring without any, the root's.
fn balls(skeleton: &Skeleton) -> Vec<InnerBall> {
    let degrees = skeleton.degrees();
    let is_shown = |node: usize| degrees[node] != 2 || node == skeleton.root;
    let shown = (0..degrees.len()).filter(|node| is_shown(*node));
    shown
        .map(|index| {
            let node = &skeleton.nodes[index];
            let is_root = index == skeleton.root;
            let root = if is_root { " (root)" } else { "" };
            InnerBall {
                at: node.at,
                radius_mm: node.radius_mm,
                name: Some(format!("{}{root}", node.id)),
            }
        })
        .collect()
}
