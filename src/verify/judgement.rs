//! The judgement of a kit: the facts found in its files, and the verdict on every promise.

use super::joints::FilmError;
use super::{
    CellFacts, Check, CupFacts, Figures, FileChange, Fit, HoleFacts, JigFacts, JointFacts,
    PartFacts, PegFacts, PlugFacts, RegionFacts, ShapeFacts, SpinFacts, SurfaceFacts, VoidFacts,
};
use crate::thin::ThinFeatures;

/// The judgement of a kit.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The figures of the outer surface filled solid.
    pub solid: Figures,
    /// The figures of the uncut result with its ballast.
    pub hollowed: Figures,
    /// The figures of the parts put together with the ballast.
    pub assembly: Figures,
    /// Facts about the surface of the uncut result.
    pub surface: SurfaceFacts,
    /// Facts about each part.
    pub parts: Vec<PartFacts>,
    /// The smallest wall between a void and the outside, in the uncut result and the parts, mm;
    /// `None` without voids.
    pub wall_min_mm: Option<f64>,
    /// What is laid beyond the written print, over the most that slicers lay; `None` if the kit
    /// says nothing of it.
    pub beyond_ratio: Option<f64>,
    /// Facts about the regions of infill inside of the outermost one, as in the promise.
    pub inner_regions: Vec<RegionFacts>,
    /// The surfaces of the parts against what they should be.
    pub shape: ShapeFacts,
    /// The fit of the hardware in the outer surface; `None` without hardware.
    pub fit: Option<Fit>,
    /// The contact of a top; `None` for other goals.
    pub spin: Option<SpinFacts>,
    /// The least gap around a part of ballast, mm; `None` without ballast.
    pub ballast_room_mm: Option<f64>,
    /// What of the outer surface is thinner than the printer's least wall.
    pub thin: ThinFeatures,
    /// The resin that each part encloses while it is printed; empty for other processes than resin
    /// in a vat.
    pub cups: Vec<CupFacts>,
    /// Every pin and its socket, as found in the files.
    pub pegs: Vec<PegFacts>,
    /// Facts about each jig.
    pub jigs: Vec<JigFacts>,
    /// The play of every joint.
    pub joints: Vec<JointFacts>,
    /// Number of sample points just under the parts' surfaces that lie in another part too.
    pub overlaps: usize,
    /// Facts about every void in the parts; empty if no cleaning was ordered.
    pub voids: Vec<VoidFacts>,
    /// Facts about every drain hole.
    pub holes: Vec<HoleFacts>,
    /// The plugs of the drain holes, in the order of the holes.
    pub plugs: Vec<PlugFacts>,
    /// Facts about the cells of a piece; `None` if none are stated.
    pub cells: Option<CellFacts>,
    /// The volume that the drain holes take from the uncut result, mm³; 0 without any.
    pub drained_mm3: Vec<f64>,
    /// The film of glue that differs most from its faces; `None` without films.
    pub film_error: Option<FilmError>,
    /// Number of strokes of engraved ids that are not in their files as deep as promised; `None`
    /// without ids.
    pub lost_strokes: Option<usize>,
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// The files changed since the kit was made; empty while it is made.
    pub changes: Vec<FileChange>,
    /// Files in the kit's folder that are not on its list and cannot be printed.
    pub unlisted: Vec<String>,
}

impl Judgement {
    /// Returns true if every promise is kept.
    pub fn passes(&self) -> bool {
        self.checks.iter().all(|check| check.pass)
    }
}
