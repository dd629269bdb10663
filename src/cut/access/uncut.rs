//! The ends of voids at faces that are ordered to stay whole.

use crate::base::watch::Watch;
use crate::cut::access::chamber::Chamber;
use crate::cut::access::uncleanable::farthest_corner;
use crate::cut::error::CutError;
use crate::cut::hollowed::Hollowed;
use crate::cut::order::CutOrder;
use crate::cut::pieces::split::piece_at;
use crate::cut::plan::{SolidEnd, bridges_on, tree_of};

/// Returns the ends of voids that reach across faces which an order leaves whole. Of the two pieces
/// of a void at such a face it is the smaller one: the box around it, grown by a margin, mm.
///
/// A plan lists a face as whole if nothing opens there. In a body that is not cleaned yet a void
/// may pass through it. Unless its end stays solid, the face would be cut all the same.
///
/// # Errors
/// A cut is degenerate, or the watch was stopped.
pub fn find_ends_at_uncut_faces(
    hollowed: &Hollowed,
    order: &CutOrder,
    margin_mm: f64,
    watch: &Watch,
) -> Result<Vec<SolidEnd>, CutError> {
    if order.uncut.is_empty() {
        return Ok(Vec::new());
    }
    let tree = tree_of(&order.cuts)?;
    let faces = bridges_on(&tree.planes, &order.cuts, &order.uncut);
    let mut ends = Vec::new();
    for chamber in &Chamber::all(hollowed, watch)? {
        if chamber.void.holds.is_some() {
            continue;
        }
        let pieces = chamber.split(&tree)?;
        for face in &faces {
            let beside = |is_above: bool| piece_at(&pieces, face.cut, is_above, &face.at);
            let sides = [false, true].map(beside).into_iter().flatten();
            let smaller = sides
                .map(|side| &pieces[side])
                .min_by(|a, b| a.volume_mm3.total_cmp(&b.volume_mm3));
            ends.extend(smaller.and_then(|piece| {
                let at = farthest_corner(&piece.mesh, &tree)?;
                Some(SolidEnd::new(&at, &piece.mesh.aabb().inflated(margin_mm)))
            }));
        }
    }
    Ok(ends)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::ids::CutId;
    use crate::cut::plan::{Cut, UncutFace};
    use crate::cut::scenes::cuboid;
    use crate::mesh::Csg;

    /// Returns a void of two shafts that meet at the bottom, and a level cut through both.
    fn two_shafts() -> (Hollowed, Cut) {
        let wide = Csg::of_solid(&cuboid([3.0; 3], [15.0, 17.0, 37.0])).unwrap();
        let narrow = Csg::of_solid(&cuboid([14.0, 3.0, 3.0], [27.0, 17.0, 8.0])).unwrap();
        let shaft = Csg::of_solid(&cuboid([22.0, 8.0, 3.0], [27.0, 12.0, 30.0])).unwrap();
        let void = wide.union(&narrow).unwrap().union(&shaft).unwrap();
        let outer = cuboid([0.0; 3], [30.0, 20.0, 40.0]);
        let hollowed = Hollowed::new(outer, vec![void.to_solid().unwrap()]);
        let cut = Cut {
            id: CutId::of(0),
            point_mm: [0.0, 0.0, 20.0],
            normal: [0.0, 0.0, 1.0],
            within: Vec::new(),
        };
        (hollowed, cut)
    }

    fn ends(point_mm: [f64; 3]) -> Vec<SolidEnd> {
        let (hollowed, cut) = two_shafts();
        let order = CutOrder {
            uncut: vec![UncutFace {
                cut: cut.id.clone(),
                point_mm,
            }],
            cuts: vec![cut],
            ..CutOrder::default()
        };
        find_ends_at_uncut_faces(&hollowed, &order, 1.0, &Watch::silent()).unwrap()
    }

    #[test]
    fn a_void_ends_before_a_face_that_is_left_whole() {
        let [end] = &ends([24.0, 10.0, 20.0])[..] else {
            panic!("one end")
        };
        // The upper end of the narrow shaft, and nothing of the wide one.
        let aabb = end.aabb();
        assert!((aabb.min.x - 21.0).abs() < 1e-9 && (aabb.max.x - 28.0).abs() < 1e-9);
        assert!((aabb.min.z - 19.0).abs() < 1e-9 && (aabb.max.z - 31.0).abs() < 1e-9);
    }

    #[test]
    fn a_whole_face_without_a_void_ends_nothing() {
        assert!(ends([18.5, 10.0, 20.0]).is_empty());
    }
}
