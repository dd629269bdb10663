//! Lines and balls inside a mesh, drawn as if the mesh were of glass.

use super::callouts::Mark;
use super::error::PictureError;
use super::palette::{Color, INK, PAPER};
use super::projection::Projection;
use super::render::render;
use super::scene::{Camera, Scene};
use super::svg::{Drawing, Paint, Stroke};
use crate::geom::Point;

/// Opacity of the glass: with more, lines at its far side vanish in print; with less, its shape.
const GLASS_OPACITY: f64 = 0.45;
/// Width of a line, and of the paper on both sides of it that keeps crossing lines apart, pixels.
const LINE_PX: f64 = 4.0;
const RIM_PX: f64 = 2.0;
/// Width of the circle around a ball, pixels.
const CIRCLE_PX: f64 = 1.0;

/// A line inside a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct InnerLine {
    /// Its points, mm.
    pub points: Vec<Point>,
    /// Its colour.
    pub color: Color,
    /// True if it is dashed.
    pub is_dashed: bool,
}

/// A ball inside a mesh, drawn as a circle.
#[derive(Debug, Clone, PartialEq)]
pub struct InnerBall {
    /// Its middle, mm.
    pub at: Point,
    /// Its radius, mm.
    pub radius_mm: f64,
    /// Its name at the side of the picture; `None` for a circle without a name.
    pub name: Option<String>,
}

/// Draws a scene as if it were of glass, with what is inside it.
pub fn draw_inside(
    scene: &Scene,
    camera: &Camera,
    lines: &[InnerLine],
    balls: &[InnerBall],
) -> Result<Drawing, PictureError> {
    let png = render(scene, camera).to_png()?;
    let projection = Projection::of(scene, camera, 1);
    let mut drawing = Drawing::new(camera.size_px, super::shot::TEXT_PX);
    drawing.picture(&png, camera.size_px, GLASS_OPACITY);
    for ball in balls {
        let stroke = Stroke::solid(INK, CIRCLE_PX);
        let radius_px = ball.radius_mm * projection.scale;
        drawing.circle(projection.at(&ball.at), radius_px, Paint::line(stroke));
    }
    for line in lines {
        draw_line(&mut drawing, &projection, line);
    }
    let named = balls.iter().filter_map(|ball| {
        let words = ball.name.clone()?;
        Some(Mark::new(projection.at(&ball.at), words))
    });
    drawing.callouts(&named.collect::<Vec<_>>());
    Ok(drawing)
}

fn draw_line(drawing: &mut Drawing, projection: &Projection, line: &InnerLine) {
    let spots = line.points.iter().map(|point| projection.at(point));
    let path = [spots.collect()];
    let rim = Stroke::solid(PAPER, LINE_PX + 2.0 * RIM_PX);
    drawing.path(&path, false, Paint::line(rim));
    let stroke = Stroke {
        dashes: if line.is_dashed {
            Stroke::DASHED.dashes
        } else {
            ""
        },
        ..Stroke::solid(line.color, LINE_PX)
    };
    drawing.path(&path, false, Paint::line(stroke));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Item;
    use crate::geom::Vector;
    use crate::mesh::primitives::cylinder;

    #[test]
    fn lines_and_named_balls_are_drawn_over_the_glass() {
        let mesh = cylinder(5.0, 40.0, 24);
        let scene = Scene {
            items: vec![Item::new(&mesh, PAPER)],
            cut: None,
        };
        let camera = Camera::new(Vector::x(), Vector::z()).with_label_margins();
        let line = InnerLine {
            points: vec![Point::new(0.0, 0.0, 5.0), Point::new(0.0, 0.0, 35.0)],
            color: INK,
            is_dashed: true,
        };
        let ball = InnerBall {
            at: Point::new(0.0, 0.0, 5.0),
            radius_mm: 5.0,
            name: Some("node 1".to_owned()),
        };
        let svg = draw_inside(&scene, &camera, &[line], &[ball])
            .unwrap()
            .inline("a rod");
        assert!(svg.contains("node 1") && svg.contains("stroke-dasharray"));
        let order = ["<image", "<circle", "<path", "<text"].map(|tag| svg.find(tag).unwrap());
        assert!(order.is_sorted(), "{order:?}");
    }
}
