//! A plate in the words of the slicer that is to slice it.

use super::error::SlicerError;
use super::run::Work;
use crate::base::dialect::Dialect;
use crate::base::walls::Walls;
use crate::io::threemf::{
    Build, Object, Package, PrintSettings, Transform, decode_orders, decode_plate,
};

/// The colour of parts that nobody sees.
const GREY: [u8; 3] = [150; 3];

/// Returns a plate in the words of a dialect if it has those of others alone: its regions would be
/// solid parts there. `None` if it has them.
///
/// # Errors
/// The plate cannot be read.
pub(super) fn reword(work: &Work, dialect: Dialect) -> Result<Option<Vec<u8>>, SlicerError> {
    let fault = |source| SlicerError::Plate {
        plate: work.plate.name.to_owned(),
        source: Box::new(source),
    };
    let orders = decode_orders(work.plate.bytes).map_err(fault)?;
    if orders.is_empty() || orders.iter().any(|it| it.dialect == dialect) {
        return Ok(None);
    }
    let plate = decode_plate(work.plate.bytes).map_err(fault)?;
    let settings = plate.first().map(|first| PrintSettings {
        dialect,
        layer_mm: work.settings.layer_mm(),
        line_mm: work.settings.line_mm(),
        walls: Walls {
            perimeters: first.perimeters,
            ..work.settings.walls()
        },
        overhang_deg: first.overhang_deg,
    });
    let objects = plate
        .iter()
        .map(|it| Object::with_regions(&it.name, GREY, &it.outside, &it.regions));
    let objects: Vec<Object> = objects.collect();
    let places = (0..objects.len()).map(|index| (index, Transform::default()));
    let package = Package {
        title: work.plate.name.to_owned(),
        description: String::new(),
        job: String::new(),
        objects: &objects,
        build: Build::Items(places.collect()),
        settings,
    };
    let bytes = package.encode().map_err(|source| SlicerError::Reworded {
        plate: work.plate.name.to_owned(),
        source: Box::new(source),
    })?;
    Ok(Some(bytes))
}
