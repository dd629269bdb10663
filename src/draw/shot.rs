//! A scene as a picture with names on it, each with a line to what it names.

use super::hatch::{Key, legend};
use super::projection::Projection;
use super::render::{PictureError, render_seen};
use super::scene::{Camera, Scene};
use super::seen::Seen;
use super::svg::{Drawing, Mark};
use crate::geom::Point;

/// Height of the words on a picture of the whole, pixels: 7 points at half the width of an A4 page.
pub const TEXT_PX: f64 = 22.0;

/// The height of a legend, in heights of its words.
const LEGEND_TEXTS: f64 = 1.8;

/// How far from the left edge a legend begins, pixels.
const LEGEND_PX: f64 = 14.0;

/// What a picture is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawn {
    /// The bytes of a PNG file.
    Png(Vec<u8>),
    /// Lines and words, some with a rendered picture below them.
    Svg(Drawing),
}

/// A scene with names on it, before it is drawn.
pub struct Shot<'a> {
    /// What is drawn.
    pub scene: Scene<'a>,
    /// How it is looked at.
    pub camera: Camera,
    /// The height of words, pixels.
    pub text_px: f64,
    /// The names on the picture.
    pub labels: Vec<Label>,
    /// The entries of the legend below the picture.
    pub keys: Vec<(Key, &'static str)>,
}

/// Words on a picture.
pub enum Label {
    /// At the side, with a line to this point of the scene.
    At(Point, String),
    /// At the side, with a line to where most of this item is seen.
    On(usize, String),
    /// A line between two points of the scene.
    Between([Point; 2]),
    /// A length between two points of the scene, drawn this many pixels aside.
    Length([Point; 2], [f64; 2], String),
}

impl Shot<'_> {
    /// Draws the scene with its names.
    pub fn draw(&self) -> Result<Drawn, PictureError> {
        let (image, seen) = render_seen(&self.scene, &self.camera);
        let png = image.to_png()?;
        let is_bare = self.labels.is_empty() && self.keys.is_empty();
        Ok(if is_bare {
            Drawn::Png(png)
        } else {
            Drawn::Svg(self.labelled(&png, &seen))
        })
    }

    /// The name of an item: at the middle of what is seen of it, or dashed at its own middle where
    /// it is hidden.
    fn named(&self, item: usize, words: &str, (projection, seen): (&Projection, &Seen)) -> Mark {
        let middle = || {
            let of = self
                .scene
                .items
                .get(item)
                .map(|item| item.mesh.aabb().center() + item.shift);
            projection.at(&of.unwrap_or(Point::origin()))
        };
        let spot = seen.middle_of(item);
        Mark {
            is_hidden: spot.is_none(),
            ..Mark::new(spot.unwrap_or_else(middle), words.to_owned())
        }
    }

    fn labelled(&self, png: &[u8], seen: &Seen) -> Drawing {
        let projection = Projection::of(&self.scene, &self.camera, 1);
        let [width, height] = self.camera.size_px;
        let below_px = if self.keys.is_empty() {
            0.0
        } else {
            LEGEND_TEXTS * self.text_px
        };
        let mut drawing = Drawing::new([width, height + below_px as usize], self.text_px);
        drawing.picture(png, self.camera.size_px, 1.0);
        legend(
            &mut drawing,
            [LEGEND_PX, height as f64 + 0.5 * below_px],
            &self.keys,
        );
        let mut marks = Vec::new();
        for label in &self.labels {
            match label {
                Label::At(point, words) => {
                    let at = projection.at(point);
                    let is_hidden = !seen.shows(at, projection.nearness_mm(point));
                    marks.push(Mark {
                        is_hidden,
                        ..Mark::new(at, words.clone())
                    });
                }
                Label::On(item, words) => marks.push(self.named(*item, words, (&projection, seen))),
                Label::Between(ends) => {
                    drawing.dashed(ends.each_ref().map(|end| projection.at(end)))
                }
                Label::Length(ends, aside, words) => {
                    drawing.dimension(ends.each_ref().map(|end| projection.at(end)), *aside, words);
                }
            }
        }
        drawing.callouts(&marks);
        drawing
    }
}
