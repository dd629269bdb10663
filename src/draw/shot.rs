//! A scene as a picture with names on it, each with a line to what it names.

use super::callouts::Mark;
use super::error::PictureError;
use super::legend::{Key, draw_legend};
use super::projection::Projection;
use super::render::render_with_visibility;
use super::scene::{Camera, Scene};
use super::svg::Drawing;
use super::visibility::Visibility;
use crate::geom::Point;

/// Height of the words on a picture of the whole, pixels: 10 points at half the width of an A4
/// page.
pub const TEXT_PX: f64 = 28.0;
/// Height of a legend, in heights of its words.
const LEGEND_TEXTS: f64 = 1.8;
/// Distance of a legend from the left edge, pixels.
const LEGEND_PX: f64 = 14.0;

/// A finished drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawn {
    /// The bytes of a PNG file.
    Png(Vec<u8>),
    /// Lines and words, some with a rendered picture below them.
    Svg(Drawing),
}

/// A scene with names on it, before it is drawn.
pub struct Shot<'a> {
    /// The meshes.
    pub scene: Scene<'a>,
    /// The direction from which they are seen.
    pub camera: Camera,
    /// The height of words, pixels.
    pub text_px: f64,
    /// The names on the picture.
    pub labels: Vec<Label>,
    /// The entries of the legend below the picture; without entries there is no legend.
    pub keys: Vec<(Key, &'static str)>,
}

/// Words on a picture, placed in the scene.
pub enum Label {
    /// A name at the side, with a line to this point.
    At(Point, String),
    /// A name at the side, with a line to the middle of the visible part of this item.
    On(usize, String),
    /// A name as [`Label::On`] has it; none if no part of the item is visible.
    Seen(usize, String),
    /// A dashed line between two points.
    Between([Point; 2]),
    /// A length between two points, drawn this many pixels aside.
    Length([Point; 2], [f64; 2], String),
}

impl Shot<'_> {
    /// Renders the scene; returns a PNG if it has no names and no legend, else an SVG around it.
    pub fn draw(&self) -> Result<Drawn, PictureError> {
        let (image, visibility) = render_with_visibility(&self.scene, &self.camera);
        let png = image.to_png()?;
        let is_bare = self.labels.is_empty() && self.keys.is_empty();
        Ok(if is_bare {
            Drawn::Png(png)
        } else {
            Drawn::Svg(self.draw_names(&png, &visibility))
        })
    }

    fn draw_names(&self, png: &[u8], visibility: &Visibility) -> Drawing {
        let projection = Projection::of(&self.scene, &self.camera, 1);
        let [width, height] = self.camera.size_px;
        let below_px = if self.keys.is_empty() {
            0.0
        } else {
            LEGEND_TEXTS * self.text_px
        };
        let mut drawing = Drawing::new([width, height + below_px as usize], self.text_px);
        drawing.picture(png, self.camera.size_px, 1.0);
        let legend_at = [LEGEND_PX, height as f64 + 0.5 * below_px];
        draw_legend(&mut drawing, legend_at, &self.keys);
        let mut marks = Vec::new();
        for label in &self.labels {
            match label {
                Label::At(point, words) => {
                    let at = projection.at(point);
                    let is_hidden = !visibility.shows(at, projection.nearness_mm(point));
                    marks.push(Mark {
                        is_hidden,
                        ..Mark::new(at, words.clone())
                    });
                }
                Label::On(item, words) => {
                    marks.push(self.mark_item(*item, words, &projection, visibility));
                }
                Label::Seen(item, words) => {
                    let spot = visibility.middle_of(*item);
                    marks.extend(spot.map(|spot| Mark::new(spot, words.clone())));
                }
                Label::Between(ends) => {
                    drawing.dashed_line(ends.each_ref().map(|end| projection.at(end)));
                }
                Label::Length(ends, aside, words) => {
                    drawing.dimension(ends.each_ref().map(|end| projection.at(end)), *aside, words);
                }
            }
        }
        drawing.callouts(&marks);
        drawing
    }

    /// Returns the name of an item at the middle of its visible part, or as hidden at its centre.
    fn mark_item(
        &self,
        item: usize,
        words: &str,
        projection: &Projection,
        visibility: &Visibility,
    ) -> Mark {
        let center = || {
            let item = self.scene.items.get(item);
            let center = item.map(|item| item.mesh.aabb().center() + item.shift);
            projection.at(&center.unwrap_or(Point::origin()))
        };
        let spot = visibility.middle_of(item);
        Mark {
            is_hidden: spot.is_none(),
            ..Mark::new(spot.unwrap_or_else(center), words.to_owned())
        }
    }
}
