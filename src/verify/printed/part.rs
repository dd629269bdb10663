//! The facts about one part as its toolpaths lay it, beside the part as it was written.

use serde::Serialize;

use super::density::Densities;
use super::matching::{Match, MatchedBy};
use super::shape::Thing;
use super::source::{Source, lines_of};
use crate::base::units::MM3_PER_CM3;
use crate::io::gcode::Feature;
use crate::mass::Moments;
use crate::verify::Promise;

/// A part as its toolpaths lay it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PrintedPart {
    /// The name on the sheet.
    pub id: String,
    /// The file of its toolpaths.
    pub file: String,
    /// The label of the slicer; empty without one.
    pub label: String,
    /// The way by which it was found.
    pub found_by: MatchedBy,
    /// Whether it lies elsewhere on the plate than the kit says. It is then placed by its box.
    pub is_moved: bool,
    /// Whether it is turned otherwise on the plate than the kit says.
    pub is_turned: bool,
    /// Whether it is printed as its mirror image.
    pub is_mirrored: bool,
    /// The edges of its file, mm.
    pub edges_mm: [f64; 3],
    /// Its edges over those of its file.
    pub size_ratio: [f64; 3],
    /// The spread of its material over that of its file: the root of the second moments.
    pub spread_ratio: [f64; 3],
    /// Its volume over that of its file.
    pub volume_ratio: f64,
    /// Its volume, mm³.
    pub volume_mm3: f64,
    /// The area over the volume of its file, 1/mm.
    pub surface_per_mm: f64,
    /// The mass of the part as it was written, with the density of the kit, g.
    pub written_mass_g: f64,
    /// The mass of its toolpaths, without support and the like, g.
    pub mass_g: f64,
    /// The centre of the part as it was written, model frame, mm.
    pub written_center_mm: [f64; 3],
    /// The centre of its toolpaths, model frame, mm.
    pub center_mm: [f64; 3],
    /// The distance of these centres, mm.
    pub center_off_mm: f64,
    /// The mean height of its lines, mm; `None` if it has none.
    pub layer_mm: Option<f64>,
    /// The width of its outermost lines, mm; `None` if it has none.
    pub line_mm: Option<f64>,
    /// The share of sparse infill in its volume.
    pub sparse_ratio: f64,
    /// The volume of its support, which is taken off, mm³.
    pub support_mm3: f64,
    /// The volume of support that lies in its voids, mm³.
    pub support_in_voids_mm3: f64,
    /// The mass of its surfaces and regions of infill, g: without what its slicer is said to lay
    /// beyond them.
    #[serde(skip)]
    pub nominal_mass_g: f64,
    /// The moments of its mass, model frame, g to g·mm².
    #[serde(skip)]
    pub moments_g: Moments,
}

impl PrintedPart {
    /// Measures a part that was found.
    pub(super) fn of(found: &Match, thing: &Thing, source: &Source, promise: &Promise) -> Self {
        let deposits = &found.piece.deposits;
        let densities = Densities::of(source, promise);
        let plate = deposits.weighed(|tool| densities.of_tool(tool) / MM3_PER_CM3);
        let (moments_g, written) = (thing.to_model(&found.fit, &plate), thing.model_moments());
        let lines = lines_of(deposits, promise);
        let volumes = deposits.volumes_mm3();
        let volume = |feature: Feature| volumes.get(&feature).copied().unwrap_or(0.0);
        let volume_mm3 = deposits.part_moments().volume();
        Self {
            id: thing.id.to_owned(),
            file: source.name.clone(),
            label: found.piece.label.clone(),
            found_by: found.by,
            is_moved: found.fit.is_moved,
            is_turned: found.fit.is_turned,
            is_mirrored: found.fit.is_mirrored,
            edges_mm: found.fit.edges_mm,
            size_ratio: found.fit.size_ratio,
            spread_ratio: found.fit.spread_ratio,
            volume_ratio: found.fit.volume_ratio,
            volume_mm3,
            surface_per_mm: thing.area_mm2 / thing.moments.volume(),
            written_mass_g: written.volume() * promise.material.density_g_cm3 / MM3_PER_CM3,
            mass_g: moments_g.volume(),
            written_center_mm: written.centroid().coords.into(),
            center_mm: moments_g.centroid().coords.into(),
            center_off_mm: (moments_g.centroid() - written.centroid()).norm(),
            layer_mm: lines
                .map(|lines| lines.height_mm)
                .or_else(|| source.image_layer_mm()),
            line_mm: lines.map(|lines| lines.width_mm),
            sparse_ratio: volume(Feature::Infill) / volume_mm3,
            support_mm3: volume(Feature::Support) + volume(Feature::SupportInterface),
            support_in_voids_mm3: 0.0,
            nominal_mass_g: thing.nominal_volume_mm3() * promise.material.density_g_cm3
                / MM3_PER_CM3,
            moments_g,
        }
    }

    /// Returns the difference of its mass from that of the written part, as a share.
    pub fn mass_off_ratio(&self) -> f64 {
        self.mass_g / self.written_mass_g - 1.0
    }
}
