//! The pixels of a model, and the share of the heavy material that each should have.

use rayon::prelude::*;

use super::correct::Nudge;
use super::order::DitherError;
use crate::field::{Density, Form, check, measure};
use crate::geom::{Aabb, Point, Vector};
use crate::mass::Moments;
use crate::mesh::Solid;
use crate::printer::Printer;
use crate::raster::{Grid, Layers, Pixels, Stack, mark_body};

/// The pixels of a model on the plate, its lowest corner at the origin.
pub(super) struct Voxels<'a> {
    pub(super) grid: Grid,
    /// From the model to the plate, mm.
    pub(super) shift: Vector,
    /// The density of the lighter material over that of the heavier one.
    pub(super) least: f64,
    /// The moments of the model with its field, on the plate, mm³ to mm⁵ of the heavier material.
    pub(super) wanted: Moments,
    stack: Stack,
    field: &'a dyn Density,
}

/// The share of the heavier material that a density asks for.
#[derive(Debug)]
struct Share<'a> {
    field: &'a dyn Density,
    least: f64,
}

impl Share<'_> {
    fn of(&self, density: f64) -> f64 {
        (density - self.least) / (1.0 - self.least)
    }
}

impl Density for Share<'_> {
    fn at(&self, point: &Point) -> f64 {
        self.of(self.field.at(point))
    }

    fn bounds(&self, region: &Aabb) -> [f64; 2] {
        self.field.bounds(region).map(|density| self.of(density))
    }

    fn form(&self) -> Form<'_> {
        Form::Any { kinks: Vec::new() }
    }
}

impl<'a> Voxels<'a> {
    /// Lays a model with a field on the pixels of a printer.
    ///
    /// # Errors
    /// The field is below the lighter material's density, or above 1, somewhere in the model.
    pub(super) fn of(
        solid: &Solid,
        field: &'a dyn Density,
        printer: &Printer,
        least: f64,
    ) -> Result<Self, DitherError> {
        let share = Share { field, least };
        check(solid, &share).map_err(|fault| DitherError::Beyond {
            at: fault.at,
            value: least + fault.value * (1.0 - least),
            least,
        })?;
        let shift = -solid.mesh().aabb().min.coords;
        let placed = solid.mesh().map_vertices(|point| point + shift);
        let aabb = placed.aabb();
        let pitch_mm = [printer.pixel_x_mm.value, printer.pixel_y_mm.value];
        let grid = Grid {
            pixels: Pixels::over(&aabb, pitch_mm),
            layers: Layers::up_to(&aabb, printer.layer_mm.value),
        };
        Ok(Self {
            grid,
            shift,
            least,
            wanted: measure(solid.mesh(), field).moments.translated(&shift),
            stack: Stack::of(&placed, grid.pixels, grid.layers),
            field,
        })
    }

    /// Returns the share of the heavier material in each pixel of a layer.
    pub(super) fn shares(&self, layer: u32, nudge: Option<&Nudge>) -> Vec<f32> {
        let mut shares = mark_body(&self.stack.image(layer), &self.grid.pixels);
        let columns = self.grid.pixels.count[0] as usize;
        let share = Share {
            field: self.field,
            least: self.least,
        };
        let rows = shares.par_chunks_mut(columns).enumerate();
        rows.for_each(|(row, shares)| {
            for (column, wished) in shares.iter_mut().enumerate() {
                if *wished < 0.0 {
                    continue;
                }
                let at = self.grid.middle_mm(row * columns + column, layer);
                // A check of the field allows for rounding.
                let exact = share.at(&(Point::from(at) - self.shift)).clamp(0.0, 1.0);
                let nudged = nudge.map_or(exact, |nudge| nudge.of(exact, at));
                *wished = nudged as f32;
            }
        });
        shares
    }
}
