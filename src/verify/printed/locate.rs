//! Where toolpaths lay the parts of a kit: from the plate to the model.

use std::path::Path;

use super::error::PrintedError;
use super::judge::catalogue;
use super::source::read_sources;
use crate::base::watch::Watch;
use crate::geom::{Aabb, Matrix, Point, Vector};
use crate::mass::Moments;
use crate::mesh::TriMesh;
use crate::verify::{Body, read_kit};

/// A part of a kit, as it lies on a plate of toolpaths.
#[derive(Debug, Clone, PartialEq)]
pub struct LocatedPart {
    /// Its name, such as `P01`.
    pub id: String,
    /// Whether it is printed as its mirror image.
    pub is_mirrored: bool,
    /// The box around its material on the plate, mm.
    plate: Aabb,
    /// From the plate to the model, but for a shift.
    turn: Matrix,
    shift: Vector,
}

/// A plate of toolpaths, with the parts of a kit on it.
#[derive(Debug, Clone, PartialEq)]
pub struct LocatedPlate {
    /// The parts, in the order of the checklist.
    pub parts: Vec<LocatedPart>,
    /// The outside of the model, model frame, mm.
    pub outside: TriMesh,
    /// The density that is laid where the kit orders sparse infill, over that of solid print.
    /// `None` in kits that are solid.
    pub laid_ratio: Option<f64>,
    /// The density that the kit states for its interior, in words of fields; `None` if it states
    /// none.
    pub field: Option<String>,
    /// The wall around the interior, mm: it is solid.
    pub wall_mm: f64,
    /// The density of sparse infill that the file states, over that of solid print.
    pub stated_ratio: Option<f64>,
    /// The diameter of the filament, mm.
    pub filament_mm: f64,
}

/// Diameter of the filament if a file tells none, mm.
const USUAL_FILAMENT_MM: f64 = 1.75;

impl LocatedPart {
    /// Returns a point of the plate in the model frame, mm.
    pub fn to_model(&self, plate: &Point) -> Point {
        Point::from(self.turn * plate.coords + self.shift)
    }

    /// Returns moments of the plate in the model frame.
    pub fn moments_to_model(&self, plate: &Moments) -> Moments {
        plate.rotated(&self.turn).translated(&self.shift)
    }

    /// Returns whether a place on the plate lies in the part's box, seen from above.
    pub fn holds(&self, plate: &Point) -> bool {
        let within =
            |axis: usize| (self.plate.min[axis]..=self.plate.max[axis]).contains(&plate[axis]);
        within(0) && within(1)
    }
}

/// Finds the parts of the kit in `folder` on a plate of toolpaths.
///
/// # Errors
/// As [`verify_printed`](super::verify_printed) for this file.
pub fn locate_parts(
    folder: &Path,
    file: &Path,
    watch: &Watch,
) -> Result<LocatedPlate, PrintedError> {
    let evidence = read_kit(folder)?;
    let sources = read_sources(&[file.to_owned()], watch)?;
    let catalogue = catalogue(&evidence);
    let mut matches = catalogue.match_all(&sources, watch)?;
    matches.found.sort_by_key(|found| found.thing);
    let things = &catalogue.things;
    let own = matches.found.iter();
    let own = own.filter(|found| !things[found.thing].is_jig);
    let parts = own.map(|found| {
        let thing = &things[found.thing];
        let to_model = |x: f64, y: f64, z: f64| {
            thing
                .point_to_model(&found.fit, &Point::new(x, y, z))
                .coords
        };
        let shift = to_model(0.0, 0.0, 0.0);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let axes = axes.map(|[x, y, z]| to_model(x, y, z) - shift);
        LocatedPart {
            id: thing.id.to_owned(),
            is_mirrored: found.fit.is_mirrored,
            plate: found.piece.deposits.part_bounds(),
            turn: Matrix::from_columns(&axes),
            shift,
        }
    });
    let parts = parts.collect();
    let toolpaths = sources.first().map(|source| &source.toolpath);
    let diameters = toolpaths.and_then(|toolpath| toolpath.diameters_mm.first());
    let infill = evidence.promise.infill.as_ref();
    Ok(LocatedPlate {
        parts,
        outside: Body::of(&evidence.hollowed).outer,
        laid_ratio: infill.map(|infill| infill.laid_ratio),
        field: infill.and_then(|infill| infill.field.clone().or(infill.smooth.clone())),
        wall_mm: evidence.promise.wall.required_mm,
        stated_ratio: toolpaths.and_then(|toolpath| toolpath.facts.infill_ratio),
        filament_mm: diameters.copied().unwrap_or(USUAL_FILAMENT_MM),
    })
}
