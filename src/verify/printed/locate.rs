//! Where toolpaths lay the parts of a kit: from the plate to the model.

use std::path::Path;

use super::error::PrintedError;
use super::judge::catalogue;
use super::source::read_sources;
use crate::base::watch::Watch;
use crate::geom::{Aabb, Matrix, Point, Vector};
use crate::mesh::{MeshDistance, TriMesh};
use crate::verify::{Body, Evidence, InfillOrder, read_kit};

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

/// A region of infill in the model, less the regions in it.
#[derive(Debug, Clone)]
struct LaidRegion {
    surface: MeshDistance,
    /// The density that is laid, over that of solid print.
    laid_ratio: f64,
}

/// A plate of toolpaths, with the parts of a kit on it.
#[derive(Debug, Clone)]
pub struct LocatedPlate {
    /// The parts, in the order of the checklist.
    pub parts: Vec<LocatedPart>,
    /// The outside of the model, model frame, mm.
    pub outside: TriMesh,
    /// The regions of sparse infill that the kit orders, the outermost first.
    regions: Vec<LaidRegion>,
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

/// Distance from a region at which a line still covers its border, mm: usual layers and half lines.
const BESIDE_MM: f64 = 0.3;
/// Distance below which two borders of regions lie in one place, mm: they are drawn about as well.
const ONE_PLACE_MM: f64 = 0.02;
/// Diameter of the filament if a file tells none, mm.
const USUAL_FILAMENT_MM: f64 = 1.75;

impl LocatedPart {
    /// Returns a point of the plate in the model frame, mm.
    pub fn to_model(&self, plate: &Point) -> Point {
        Point::from(self.turn * plate.coords + self.shift)
    }

    /// Returns whether a place on the plate lies in the part's box, seen from above.
    pub fn holds(&self, plate: &Point) -> bool {
        let within =
            |axis: usize| (self.plate.min[axis]..=self.plate.max[axis]).contains(&plate[axis]);
        within(0) && within(1)
    }
}

impl LocatedPlate {
    /// Returns the density that the kit lays at a place of the model where a bead is sparse infill,
    /// over that of solid print. `None` in kits that have none.
    pub fn laid_ratio(&self, at: &Point) -> Option<f64> {
        self.region(at).map(|region| region.laid_ratio)
    }

    /// Returns whether the kit orders sparse infill at a place of the model, or right beside it.
    pub fn is_sparse(&self, at: &Point) -> bool {
        let outermost = self.regions.first();
        outermost.is_some_and(|region| region.surface.signed(at) > -BESIDE_MM)
    }

    /// Returns the innermost region that holds a place of the model, or the nearest one.
    ///
    /// Lines reach a little out of their region, to be anchored.
    fn region(&self, at: &Point) -> Option<&LaidRegion> {
        let depth_mm = |region: &LaidRegion| region.surface.signed(at);
        let deepest_mm = self
            .regions
            .iter()
            .map(depth_mm)
            .fold(f64::NEG_INFINITY, f64::max);
        // Under a wall the borders of all regions lie in one place.
        let least_mm = deepest_mm.min(0.0) - ONE_PLACE_MM;
        let mut inner = self.regions.iter().rev();
        inner.find(|region| depth_mm(region) >= least_mm)
    }

    /// Returns whether the kit orders sparse infill.
    pub fn has_infill(&self) -> bool {
        !self.regions.is_empty()
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
    let body = Body::of(&evidence.hollowed);
    let infill = evidence.promise.infill.as_ref();
    Ok(LocatedPlate {
        parts,
        regions: infill.map_or_else(Vec::new, |infill| laid_regions(infill, &body, &evidence)),
        field: infill.and_then(|infill| infill.field.clone().or(infill.smooth.clone())),
        wall_mm: evidence.promise.wall.required_mm,
        outside: body.outer,
        stated_ratio: toolpaths.and_then(|toolpath| toolpath.facts.infill_ratio),
        filament_mm: diameters.copied().unwrap_or(USUAL_FILAMENT_MM),
    })
}

/// Returns the regions of infill that a kit orders, the outermost first.
fn laid_regions(infill: &InfillOrder, body: &Body, evidence: &Evidence) -> Vec<LaidRegion> {
    let outermost = body.shells.inner_mesh().reversed();
    let meshes = std::iter::once(outermost).chain(evidence.inner_in_model());
    let levels = infill.levels().into_iter();
    let regions = levels.zip(meshes).map(|(level, mesh)| LaidRegion {
        surface: MeshDistance::new(&mesh),
        laid_ratio: level.laid_ratio,
    });
    regions.collect()
}
