//! The surfaces of parts, and how they lie on the plate.

use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{Crossings, Defects, TriMesh, bodies};
use crate::repair::weld;

/// A part in print pose, as its file holds it. Turned into another frame, slivers may flip.
pub(super) struct LyingPart<'a> {
    pub id: &'a str,
    pub mesh: &'a TriMesh,
}

/// The facts about the surfaces of the parts, and how they lie.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Surfaces {
    pub broken: Vec<String>,
    pub crossings: usize,
    pub in_pieces: Vec<String>,
    pub above_plate_mm: f64,
    pub too_large: Vec<String>,
}

impl Surfaces {
    /// Measures parts; `room` is that of the printer, mm.
    pub fn of<'a>(
        parts: impl Iterator<Item = LyingPart<'a>>,
        room: Option<[f64; 3]>,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let mut found = Self::default();
        for part in parts {
            watch.check()?;
            let welded = weld(part.mesh);
            let defects = Defects::of(&welded);
            let broken = defects.map(|defects| format!("{}: {defects}", part.id));
            found.broken.extend(broken);
            found.crossings += Crossings::of_watched(&welded, watch)?.pairs;
            let is_one = bodies(&welded).len() == 1;
            found
                .in_pieces
                .extend((!is_one).then(|| part.id.to_owned()));
            let printed = part.mesh.aabb();
            found.above_plate_mm = found.above_plate_mm.max(printed.min.z.abs());
            let size = printed.size();
            let fits = room.is_none_or(|[x, y, z]| {
                let lies = |a: f64, b: f64| a <= x && b <= y;
                size.z <= z && (lies(size.x, size.y) || lies(size.y, size.x))
            });
            found.too_large.extend((!fits).then(|| part.id.to_owned()));
        }
        Ok(found)
    }
}
