//! How a finished plan opens each void.

use serde::{Deserialize, Serialize};

use super::{
    error::CutError,
    opening::is_dimple,
    plan::cut_id,
    sight::{Seen, Walls},
    split::{Piece, split},
};
use crate::{geom::Plane, mesh::Solid};

/// How a void is opened.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VoidAccess {
    /// The void's index in the hollowed body.
    pub void: usize,
    /// The void's volume, mm³.
    pub volume_mm3: f64,
    /// The ids of the cuts that pass through it.
    pub opened_by: Vec<String>,
    /// The diameter of the largest disc that passes the widest mouth of its pieces; of the piece where that
    /// is least, mm. Dimples in plain sight are not asked. 0 when the void stays closed.
    pub opening_mm: f64,
    /// The greatest distance of a point of its surface from the mouth of its piece, mm.
    pub depth_mm: f64,
    /// The share of its wall that is in sight from the middle of the widest mouth of each piece; of a sample of triangles.
    pub sight_ratio: f64,
}

impl VoidAccess {
    /// A void that no cut opens.
    pub(crate) fn closed(void: usize, solid: &Solid) -> Self {
        let volume_mm3 = solid.mesh().signed_volume_mm3();
        Self { void, volume_mm3, opened_by: Vec::new(), opening_mm: 0.0, depth_mm: 0.0, sight_ratio: 0.0 }
    }
}

/// How the planes open a void: it is cut into its pieces, and each piece's mouths are measured.
pub(crate) fn access(void: usize, solid: &Solid, planes: &[Plane]) -> Result<VoidAccess, CutError> {
    let pieces = split(solid.mesh(), planes)?;
    let met = |cut: &usize| pieces.iter().any(|piece| piece.caps.iter().any(|cap| cap.cut == *cut));
    let mouths: Vec<Mouth> = pieces.iter().map(|piece| widest_mouth(piece, planes)).collect();
    let walls = Walls::of(solid);
    let widest_mm = mouths.iter().map(|mouth| mouth.diameter_mm).fold(0.0, f64::max);
    let hidden = mouths.iter().filter(|mouth| !is_dimple(mouth.depth_mm, mouth.diameter_mm));
    Ok(VoidAccess {
        void,
        volume_mm3: solid.mesh().signed_volume_mm3(),
        opened_by: (0..planes.len()).filter(met).map(cut_id).collect(),
        opening_mm: hidden.map(|mouth| mouth.diameter_mm).fold(widest_mm, f64::min),
        depth_mm: mouths.iter().map(|mouth| mouth.depth_mm).fold(0.0, f64::max),
        sight_ratio: pieces
            .iter()
            .map(|piece| walls.seen(piece, planes))
            .fold(Seen::default(), Seen::and)
            .ratio(),
    })
}

/// The widest mouth of a piece of a void.
struct Mouth {
    diameter_mm: f64,
    /// The greatest distance of the piece's surface from the mouth's plane, mm.
    depth_mm: f64,
}

fn widest_mouth(piece: &Piece, planes: &[Plane]) -> Mouth {
    let disc_mm =
        |cap: &super::split::Cap| cap.outline.largest_disc(0.0).map_or(0.0, |disc| 2.0 * disc.radius_mm);
    let widest = piece.caps.iter().map(|cap| (cap.cut, disc_mm(cap))).max_by(|a, b| a.1.total_cmp(&b.1));
    let Some((cut, diameter_mm)) = widest else {
        return Mouth { diameter_mm: 0.0, depth_mm: piece.mesh.aabb().size().norm() };
    };
    let heights = piece.mesh.vertices().iter().map(|p| planes[cut].distance(p).abs());
    Mouth { diameter_mm, depth_mm: heights.fold(0.0, f64::max) }
}
