//! The surfaces of the printed parts, and how they lie.

use rayon::prelude::*;

use super::evidence::CoreEvidence;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{Crossings, Defects, bodies, shells};
use crate::repair::weld;

/// The facts about the surfaces of parts, and how they lie.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceFacts {
    /// Parts that bound no solid, with the first defect.
    pub broken: Vec<String>,
    /// Pairs of triangles of one part that cross.
    pub crossings: usize,
    /// Parts that are more than one body.
    pub in_pieces: Vec<String>,
    /// Parts that enclose a void.
    pub closed: Vec<String>,
    /// The greatest height of a part's lowest point over the plate, mm.
    pub above_plate_mm: f64,
    /// The greatest deviation of a pose from a rigid motion.
    pub pose_error: f64,
    /// Parts that are larger than the printer.
    pub too_large: Vec<String>,
}

impl SurfaceFacts {
    fn and(mut self, other: Self) -> Self {
        self.broken.extend(other.broken);
        self.crossings += other.crossings;
        self.in_pieces.extend(other.in_pieces);
        self.closed.extend(other.closed);
        self.above_plate_mm = self.above_plate_mm.max(other.above_plate_mm);
        self.pose_error = self.pose_error.max(other.pose_error);
        self.too_large.extend(other.too_large);
        self
    }
}

/// Measures the surfaces of all parts.
pub fn measure_surfaces(evidence: &CoreEvidence, watch: &Watch) -> Result<SurfaceFacts, Cancelled> {
    let parts = (0..evidence.parts.len()).into_par_iter();
    let facts = parts.map(|part| {
        watch.check()?;
        measure_part(evidence, part, watch)
    });
    let facts: Vec<SurfaceFacts> = facts.collect::<Result<_, Cancelled>>()?;
    Ok(facts
        .into_iter()
        .fold(SurfaceFacts::default(), SurfaceFacts::and))
}

fn measure_part(
    evidence: &CoreEvidence,
    index: usize,
    watch: &Watch,
) -> Result<SurfaceFacts, Cancelled> {
    let (promise, mesh) = (&evidence.promise.parts[index], &evidence.parts[index]);
    let id = || promise.id.clone();
    let welded = weld(mesh);
    let defects = Defects::of(&welded);
    let printed = mesh
        .map_vertices(|p| promise.print_from_model.to_print(p))
        .aabb();
    let size = printed.size();
    let room = evidence.promise.printer.build_volume_mm;
    // A turn on the plate is allowed; rounding in a file is not more than this.
    let slack_mm = 1e-3;
    let fits = room.is_none_or(|[x, y, z]| {
        let lies = |a: f64, b: f64| a <= x + slack_mm && b <= y + slack_mm;
        size.z <= z + slack_mm && (lies(size.x, size.y) || lies(size.y, size.x))
    });
    let inner = shells(&welded)
        .iter()
        .any(|shell| shell.signed_volume_mm3() < 0.0);
    let count = bodies(&welded).len();
    Ok(SurfaceFacts {
        broken: defects
            .map(|defects| format!("{}: {defects}", id()))
            .into_iter()
            .collect(),
        crossings: Crossings::of_watched(&welded, watch)?.pairs,
        in_pieces: (count != 1).then(id).into_iter().collect(),
        closed: inner.then(id).into_iter().collect(),
        above_plate_mm: printed.min.z.abs(),
        pose_error: promise.print_from_model.rigidity_error(),
        too_large: (!fits).then(id).into_iter().collect(),
    })
}
