//! Drawn: the regions of a given field whose level sets are no quadrics, as bodies.

use std::sync::Arc;

use rayon::prelude::*;

use super::densities::nested_inside;
use super::stock::Stock;
use crate::base::watch::Watch;
use crate::error::{Error, GradedError};
use crate::field::{Density, check};
use crate::geom::{Frame, Point};
use crate::hollow::{DrawnBody, DrawnField, DrawnRegion, NearWished, PrintField};
use crate::interior::Columns;
use crate::job::{FieldOrder, GivenField};
use crate::open::{Drawing, draw_field};
use crate::run::{Extent, LaidField, Level, Nested, Placed};
use crate::verify::FIELD_FILE;
use crate::voids::Drawn;

/// Span of densities below which a field counts as the same everywhere.
const FLAT: f64 = 1e-6;

/// Returns the regions of the field that a placed job orders, as bodies; `None` for a field that is
/// fitted or has planes and balls. `columns` are those of the interior.
///
/// # Errors
/// The field is no density, or not one that the printer lays. A body cannot be drawn, or the watch
/// was stopped.
pub fn drawn(placed: &Placed, columns: &Columns, watch: &Watch) -> Result<Option<Nested>, Error> {
    let (Some(order), Some(sparse)) = (&placed.job.field, &placed.sparse) else {
        return Ok(None);
    };
    if columns.is_empty() {
        return Ok(None);
    }
    match order.given() {
        Some(GivenField::Skin(skin)) => {
            let drawing = Drawing::Skin(skin);
            in_bodies(placed, sparse.clone(), drawing, watch).map(Some)
        }
        Some(GivenField::Drawn(field)) => {
            let density = field.on(&placed.model.solid);
            check(&placed.model.solid, density.as_ref()).map_err(GradedError::from)?;
            let inside = range_inside(density.as_ref(), columns, &placed.goal().frame);
            watch.check()?;
            let sparse = nested_inside(&placed.job, &placed.shop.printer, Some(inside))?;
            let nested = match inside {
                [low, high] if high - low < FLAT => flat(placed, sparse, 0.5 * (low + high)),
                _ => in_bodies(placed, sparse, Drawing::Density(density.as_ref()), watch)?,
            };
            Ok(Some(nested))
        }
        _ => Ok(None),
    }
}

/// Returns the least and the greatest density in the interior, by samples along its columns.
fn range_inside(density: &dyn Density, columns: &Columns, frame: &Frame) -> [f64; 2] {
    let step_mm = columns.pitch_mm[0];
    let of_column = |index: usize| {
        let [x, y] = columns.centers[index];
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for &[bottom, top] in columns.intervals_of(index) {
            let steps = ((top - bottom) / step_mm).ceil().max(1.0);
            for step in 0..=steps as usize {
                let z = bottom + (top - bottom) * step as f64 / steps;
                let value = density.at(&frame.to_model(&Point::new(x, y, z)));
                range = [range[0].min(value), range[1].max(value)];
            }
        }
        range
    };
    let ranges: Vec<[f64; 2]> = (0..columns.len()).into_par_iter().map(of_column).collect();
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    ranges
        .into_iter()
        .fold(start, |all, own| [all[0].min(own[0]), all[1].max(own[1])])
}

/// Returns the one region of a field that is the same everywhere.
fn flat(placed: &Placed, sparse: Nested, density: f64) -> Nested {
    let range = sparse.near.as_ref().map(|near| near.levels.range());
    let field = range.map(|range| LaidField::Shaped(PrintField::uniform(density, range)));
    let stock = Stock {
        printer: &placed.shop.printer,
        sparse: &sparse,
    };
    let level = stock.level_of(density, Extent::Interior);
    Nested {
        levels: level.into_iter().collect(),
        field,
        ..sparse
    }
}

/// Returns the regions of a field as bodies: each where it is below the middle of two densities.
fn in_bodies(
    placed: &Placed,
    sparse: Nested,
    drawing: Drawing,
    watch: &Watch,
) -> Result<Nested, Error> {
    let densities = sparse
        .near
        .as_ref()
        .map(|near: &NearWished| near.levels.densities());
    let densities = densities.unwrap_or_default();
    let pairs: Vec<&[f64]> = densities.windows(2).rev().collect();
    // Several are drawn at once, so that none tells its progress.
    let quiet = watch.muted();
    let draw = |pair: &&[f64]| draw_field(placed, drawing, 0.5 * (pair[0] + pair[1]), &quiet);
    let bodies = pairs
        .par_iter()
        .map(draw)
        .collect::<Result<Vec<Drawn>, Error>>()?;
    let whole = |density: &f64| DrawnRegion {
        density: *density,
        body: None,
    };
    let mut regions: Vec<DrawnRegion> = densities.last().map(whole).into_iter().collect();
    for (pair, body) in pairs.iter().zip(bodies) {
        match body {
            Drawn::Nothing => break,
            // Nothing is left of the regions around it.
            Drawn::Everything => regions = vec![whole(&pair[0])],
            Drawn::Body(mesh) => regions.push(DrawnRegion {
                density: pair[0],
                body: Some(Arc::new(DrawnBody::new(mesh, &placed.goal().frame))),
            }),
        }
    }
    let stock = Stock {
        printer: &placed.shop.printer,
        sparse: &sparse,
    };
    let level = |(index, region): (usize, &DrawnRegion)| {
        let extent = match region.body {
            Some(_) => Extent::Body(index),
            None => Extent::Interior,
        };
        stock.level_of(region.density, extent)
    };
    let levels: Vec<Level> = regions.iter().enumerate().filter_map(level).collect();
    if levels.is_empty() {
        return Err(no_infill(placed).into());
    }
    let words = words(placed);
    Ok(Nested {
        levels,
        field: Some(LaidField::Drawn(DrawnField::new(words, regions))),
        ..sparse
    })
}

/// Returns the words for the field, as they can be typed beside the kit.
fn words(placed: &Placed) -> String {
    match &placed.job.field {
        Some(FieldOrder::File { .. }) => FIELD_FILE.to_owned(),
        Some(words) => words.to_string(),
        None => String::new(),
    }
}

/// Returns the refusal of a field that leaves solid print alone.
fn no_infill(placed: &Placed) -> GradedError {
    let field = placed.job.field.clone().unwrap_or(FieldOrder::FitRamp);
    GradedError::FieldSolid {
        field: Box::new(field),
    }
}
