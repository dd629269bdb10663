//! The size at which a model has room for a base and its panels.

use super::asked::Asked;
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{Solid, TriMesh};
use crate::panels::PanelSet;
use crate::polyhedra::{Ground, Request, grow_polyhedron};
use crate::wing::Remedy;

/// The first size that is tried where none is known to be too small, over that of the model.
pub const NEXT_RATIO: f64 = 1.2;
/// Sizes that are tried, each larger than the one before by this factor.
const TRIED: i32 = 6;
const STEP_RATIO: f64 = 1.2;

/// Returns a remedy with the least size, of a few that are tried, at which a base has room.
///
/// It has one polyhedron, and all its panels. Sizes are tried from this factor on, in whole mm;
/// `None` if none of them has room.
pub fn large_enough(
    asked: &Asked,
    from_factor: f64,
    watch: &Watch,
) -> Result<Option<Remedy>, Cancelled> {
    let mesh = asked.ground.solid().mesh();
    let size_mm = mesh.longest_side_mm();
    for step in 0..TRIED {
        let larger_mm = (from_factor * STEP_RATIO.powi(step) * size_mm).ceil();
        let factor = larger_mm / size_mm;
        if has_panels(asked, &mesh.map_vertices(|p| p * factor), watch)? {
            return Ok(Some(Remedy {
                settings: vec![Setting::new(Key::Size, format!("{larger_mm}mm"))],
                words: "the least of the sizes tried at which a base and its panels have room"
                    .to_owned(),
            }));
        }
    }
    Ok(None)
}

/// Returns true if a model gets a polyhedron whose faces all become panels.
fn has_panels(asked: &Asked, mesh: &TriMesh, watch: &Watch) -> Result<bool, Cancelled> {
    let Some(ground) = Solid::new(mesh.clone())
        .and_then(|solid| Ground::new(&solid))
        .ok()
    else {
        return Ok(false);
    };
    let request: &Request = &asked.base;
    Ok(match grow_polyhedron(&ground, request, watch)? {
        Verdict::Found(base) => PanelSet::of(&base, &asked.panels).is_ok(),
        Verdict::No(_) => false,
    })
}
