//! The parallel projection of a scene, fitted to a picture.

use super::scene::{Camera, Scene};
use super::svg::Spot;
use crate::geom::{Aabb, Point, Vector};

/// Least share of the picture left free on each side.
const MARGIN_RATIO: f64 = 0.04;

/// A parallel projection of a scene on a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    /// Unit vectors to the right, up and toward the viewer.
    pub axes: [Vector; 3],
    /// Pixels per millimetre.
    pub scale: f64,
    offset: Spot,
}

impl Projection {
    /// Returns the projection that shows all of the scene, with `pixels` times as many pixels on a
    /// side as the camera has.
    pub fn of(scene: &Scene, camera: &Camera, pixels: usize) -> Self {
        let axes = axes(camera);
        let [width, height] = camera.size_px.map(|side| side * pixels);
        let seen = |p: Point| Point::from(Vector::from(axes.map(|axis| axis.dot(&p.coords))));
        let moved = scene
            .items
            .iter()
            .flat_map(|i| i.mesh.vertices().iter().map(move |p| seen(p + i.shift)));
        let bounds = moved.fold(Aabb::EMPTY, |bounds, point| bounds.grown_over(&point));
        let [aside, over] = camera.margin_ratio.map(|ratio| MARGIN_RATIO.max(ratio));
        let fit = |pixels: usize, margin_ratio: f64, mm: f64| {
            pixels as f64 * (1.0 - 2.0 * margin_ratio) / mm
        };
        let scale = fit(width, aside, bounds.size().x).min(fit(height, over, bounds.size().y));
        let offset = [
            0.5 * width as f64 - scale * bounds.center().x,
            0.5 * height as f64 + scale * bounds.center().y,
        ];
        Self {
            axes,
            scale,
            offset,
        }
    }

    /// Returns the place of a point on the picture: pixels to the right, pixels down.
    pub fn at(&self, p: &Point) -> Spot {
        let [right, up, _] = self.axes.map(|axis| axis.dot(&p.coords));
        [
            self.offset[0] + self.scale * right,
            self.offset[1] - self.scale * up,
        ]
    }

    /// Returns the coordinate of a point toward the viewer, mm; larger is nearer.
    pub fn nearness_mm(&self, p: &Point) -> f64 {
        self.axes[2].dot(&p.coords)
    }
}

/// Returns unit vectors to the right, up and toward the viewer.
fn axes(camera: &Camera) -> [Vector; 3] {
    let toward = camera.toward_viewer.normalize();
    let right = camera.up.cross(&toward).normalize();
    [right, toward.cross(&right), toward]
}
