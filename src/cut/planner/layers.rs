//! Cut planes moved by less than a layer, so that the cut faces that look up in the printer end at
//! whole layers.

use crate::{
    cut::{
        access::void_access::{VoidAccess, accesses},
        error::CutError,
        geometry::chart::Chart,
        ids::{CutId, PartId},
        joints::{pin_shape::PinSite, pins::Pins},
        pieces::{
            part::{bits, voids_by_vertex},
            pose::{Posed, apply},
            rejoin::rejoin,
            split::check_no_cavity,
        },
        plan::{CutMove, CutPlan},
        planner::{layout::Layout, score::Scene, to_plan::to_plan},
        remark::Remark,
    },
    geom::{Plane, Vector},
    mesh::move_off_vertices,
};

/// Least cosine between the vertical and the normal of a level face. Over 100 mm, such a face rises
/// by less than 0.005 mm.
const LEVEL_COSINE: f64 = 1.0 - 1e-9;

/// Height below which a face lies on the plate, mm.
const ON_PLATE_MM: f64 = 1e-6;

/// Number of sweeps over all cuts. The height of a part that rests on one cut and ends at another
/// depends on both.
const SWEEPS: usize = 4;

/// A cut face that is level in the printer.
#[derive(Clone)]
struct Level {
    cut: usize,
    part: usize,
    area_mm2: f64,
    /// Height above the plate before any cut is moved, mm.
    height_mm: f64,
    /// Direction of the cut's normal along the printer's z: +1 or −1.
    up: f64,
    /// The cut on which the part rests, with the direction of its normal along z.
    rest: Option<(usize, f64)>,
}

/// Moves the cuts to whole layers, by half a layer at most, and places the pins again. Returns the
/// plan unchanged if the number of pieces would change, a cavity would form, or an opening would
/// fall below the least.
pub(crate) fn snap_to_layers(
    scene: &Scene,
    layout: &Layout,
    plan: CutPlan,
    notes: Vec<Remark>,
) -> Result<CutPlan, CutError> {
    let moves = moves(scene, layout, &plan)?;
    if moves.is_empty() {
        return Ok(plan);
    }
    let mut planes = layout.tree.planes.clone();
    for (cut, _, moved_mm) in &moves {
        let plane = planes[*cut];
        planes[*cut] = move_off_vertices(
            &scene.material,
            &Plane {
                offset_mm: plane.offset_mm + moved_mm,
                ..plane
            },
        );
    }
    let moved = moves.into_iter().map(|(cut, part, _)| CutMove {
        cut: CutId::of(cut),
        part: PartId::of(part),
        moved_mm: planes[cut].offset_mm - layout.tree.planes[cut].offset_mm,
    });
    let moved = moved.collect();
    let Some(layout) = move_planes(scene, layout, planes)? else {
        return Ok(plan);
    };
    Ok(CutPlan {
        moves: moved,
        ..to_plan(scene, &layout, Pins::Placed, notes)?
    })
}

/// Returns each moved cut, the part for which it moves, and the distance along its normal, mm.
fn moves(
    scene: &Scene,
    layout: &Layout,
    plan: &CutPlan,
) -> Result<Vec<(usize, usize, f64)>, CutError> {
    let layer_mm = scene.request.layer_mm;
    if layer_mm <= 0.0 {
        return Ok(Vec::new());
    }
    let mut levels: Vec<Level> = all_levels(scene, layout, plan)?;
    levels.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    let deciding_level = |cut: usize| {
        levels
            .iter()
            .find(|level| level.cut == cut && level.height_mm > ON_PLATE_MM)
    };
    let mut moved_mm = vec![0.0; layout.tree.planes.len()];
    for _ in 0..SWEEPS {
        for cut in 0..moved_mm.len() {
            if let Some(level) = deciding_level(cut) {
                moved_mm[cut] = to_layer_mm(level, &moved_mm, layer_mm);
            }
        }
    }
    let moves = moved_mm
        .iter()
        .enumerate()
        .filter(|(_, moved)| **moved != 0.0);
    Ok(moves
        .filter_map(|(cut, &moved)| Some((cut, deciding_level(cut)?.part, moved)))
        .collect())
}

/// Returns the level cut faces of all pieces in their poses in the printer.
fn all_levels(scene: &Scene, layout: &Layout, plan: &CutPlan) -> Result<Vec<Level>, CutError> {
    let void_of = voids_by_vertex(scene.hollowed);
    let levels = |part: usize| {
        let piece = &layout.pieces[part];
        let pins = pins_on(layout, plan, part);
        let cut_of = |pin: &PinSite| plan.cuts.iter().position(|cut| cut.id == pin.cut);
        let mut pin_cuts: Vec<usize> = pins.iter().filter_map(cut_of).collect();
        pin_cuts.dedup();
        let posed = Posed {
            mesh: &piece.mesh,
            piece,
            planes: &layout.tree.planes,
            pins: &pins,
            pin_cuts: &pin_cuts,
        };
        let pose = posed.pose(scene.request, |p| void_of.contains_key(&bits(p)))?;
        Ok(levels(layout, part, &pose.print_from_model))
    };
    let levels = (0..layout.pieces.len()).map(levels);
    Ok(levels.collect::<Result<Vec<_>, CutError>>()?.concat())
}

/// Returns the distance along its normal, mm, that brings the face to the nearest whole layer.
fn to_layer_mm(level: &Level, moved_mm: &[f64], layer_mm: f64) -> f64 {
    let sunk_mm = level.rest.map_or(0.0, |(cut, up)| moved_mm[cut] * up);
    let height_mm = level.height_mm - sunk_mm;
    let layers = (height_mm / layer_mm).round().max(1.0);
    (layers * layer_mm - height_mm) * level.up
}

/// Returns the level cut faces of a piece that the motion brings into the printer.
fn levels(layout: &Layout, part: usize, motion: &[[f64; 4]; 4]) -> Vec<Level> {
    let piece = &layout.pieces[part];
    let mut levels: Vec<Level> = Vec::new();
    for cap in &piece.caps {
        let plane = &layout.tree.planes[cap.cut];
        let up: f64 = (0..3).map(|i| motion[2][i] * plane.normal[i]).sum();
        if up.abs() >= LEVEL_COSINE {
            let at = Chart::of_plane(plane).lift(plane, &cap.inner_point());
            let height_mm = apply(motion, &at).z;
            let (cut, area_mm2) = (cap.cut, cap.area_mm2);
            levels.push(Level {
                cut,
                part,
                area_mm2,
                height_mm,
                up: up.signum(),
                rest: None,
            });
        }
    }
    let rest = levels
        .iter()
        .find(|level| level.height_mm <= ON_PLATE_MM)
        .map(|level| (level.cut, level.up));
    for level in &mut levels {
        level.rest = rest;
    }
    levels
}

/// Returns the printed pins that stand out of the part.
fn pins_on(layout: &Layout, plan: &CutPlan, part: usize) -> Vec<PinSite> {
    let id = PartId::of(part);
    let joint_of = |pin: &PinSite| {
        plan.joints
            .iter()
            .find(|joint| joint.pins.contains(&pin.id))
    };
    let is_carried = |pin: &&PinSite| {
        let cut = plan.cuts.iter().position(|cut| cut.id == pin.cut);
        cut.zip(joint_of(pin)).is_some_and(|(cut, joint)| {
            let normal = layout.tree.planes[cut].normal;
            let is_upward = normal.dot(&Vector::from(pin.direction)) > 0.0;
            joint.parts[usize::from(!is_upward)] == id
        })
    };
    let printed = plan.pins.iter().filter(|pin| pin.dowel.is_none());
    printed.filter(is_carried).cloned().collect()
}

/// Returns the layout with the moved planes, or `None` if it has other pieces or a worse opening.
fn move_planes(
    scene: &Scene,
    layout: &Layout,
    planes: Vec<Plane>,
) -> Result<Option<Layout>, CutError> {
    let tree = layout.tree.with_planes(planes);
    let watch = &scene.request.watch;
    let pieces = match rejoin(scene.split(&tree)?, &tree, &layout.bridges, watch) {
        Ok(pieces) => pieces,
        Err(CutError::Cancelled(cancelled)) => return Err(cancelled.into()),
        Err(_) => return Ok(None),
    };
    if pieces.len() != layout.pieces.len() || check_no_cavity(&pieces).is_err() {
        return Ok(None);
    }
    let voids = accesses(&scene.chambers, &tree, scene.request)?;
    let least_mm = scene.request.min_opening_mm;
    let is_worse = |(now, before): (&VoidAccess, &VoidAccess)| {
        let is_narrower = now.opening_mm < least_mm && now.opening_mm < before.opening_mm;
        is_narrower || (before.is_clean && !now.is_clean)
    };
    let is_open = !voids.iter().zip(&layout.voids).any(is_worse);
    Ok(is_open.then(|| Layout {
        tree,
        voids,
        pieces,
        bridges: layout.bridges.clone(),
    }))
}

#[cfg(test)]
mod tests {
    use crate::{
        cut::{
            PlanRequest, PosePreference, apply,
            scenes::{cuboid, parts, plan, request, with_balls},
        },
        geom::{Point, Vector},
    };

    /// Returns the distances of a body's upward cut faces from whole layers, in layers.
    fn off_layers(request: &PlanRequest) -> Vec<f64> {
        let outer = cuboid([0.0; 3], [50.0, 47.0, 41.3]);
        let hollowed = with_balls(outer, &[[14.0, 20.0, 20.0, 8.0], [36.0, 26.0, 21.0, 8.0]]);
        let plan = plan(&hollowed, request).unwrap();
        let mut off = Vec::new();
        for part in parts(&hollowed, &plan, request).unwrap() {
            for cut in &plan.cuts {
                let motion = &part.pose.print_from_model;
                let height = apply(motion, &Point::from(cut.point_mm)).z;
                let normal = Vector::from(cut.normal);
                let up: f64 = (0..3).map(|i| motion[2][i] * normal[i]).sum();
                if up.abs() > 0.999_999 && height > 1e-3 {
                    let layers = height / request.layer_mm;
                    off.push((layers - layers.round()).abs());
                }
            }
        }
        off
    }

    #[test]
    fn a_face_that_looks_up_ends_at_a_whole_layer() {
        for layer_mm in [0.2, 0.03] {
            let off = off_layers(&PlanRequest {
                layer_mm,
                ..request()
            });
            assert!(!off.is_empty());
            // Planes stay 1e-6 mm off vertices, in steps of 2e-6 mm: about 1e-4 of the thinnest
            // layer.
            assert!(off.iter().all(|off| *off < 1e-3), "{layer_mm}: {off:?}");
        }
    }

    #[test]
    fn if_both_faces_of_a_cut_look_up_one_of_them_ends_at_a_whole_layer() {
        let both = PlanRequest {
            pose: PosePreference::OpenHollowUp,
            layer_mm: 0.2,
            ..request()
        };
        let off = off_layers(&both);
        assert_eq!(off.len(), 2);
        assert!(off.iter().any(|off| *off < 1e-3), "{off:?}");
    }

    #[test]
    fn without_layers_no_cut_moves() {
        let outer = cuboid([0.0; 3], [30.0; 3]);
        let hollowed = with_balls(outer, &[[15.0, 15.0, 15.0, 8.0]]);
        let still = plan(
            &hollowed,
            &PlanRequest {
                layer_mm: 0.0,
                ..request()
            },
        )
        .unwrap();
        assert!(still.moves.is_empty());
    }
}
