//! What the pictures of a telescope show: its parts in three states, apart, and one joint cut open.

use super::balance::ground;
use super::error::TelescopeRunError;
use super::made::{Made, PartKind};
use super::posing::Posed;
use crate::base::watch::Watch;
use crate::geom::{Frame, Plane, Vector};
use crate::mesh::{ClipError, Csg, TriMesh};
use crate::page::{CutJoint, Picture, ShownPart, TelescopeView, draw_telescope};
use crate::telescope::motion::between;
use crate::telescope::nest::{JointState, Telescope};

/// Slide of the cut joint before its stop, as a share of the overlap: so that both cones are seen.
const BEFORE_STOP_SHARE: f64 = 0.3;
/// Length on either side of the pivot that the picture of a joint shows, in overlaps.
const SHOWN_OVERLAPS: f64 = 1.6;

/// Draws the pictures of a made telescope.
pub fn pictures(
    made: &Made,
    poses: &[Posed],
    watch: &Watch,
) -> Result<Vec<Picture>, TelescopeRunError> {
    let telescope = &made.best.design.telescope;
    let keys = &made.best.design.opening.keys;
    let (closed, open) = (telescope.closed(), telescope.open());
    let last = keys.last().unwrap_or(&open);
    let half = half_open(keys, &closed, last);
    let shown = |states: &[JointState]| telescope.frames(states);
    let meshes: Vec<TriMesh> = made.parts.iter().map(|part| part.in_shell()).collect();
    let parts: Vec<ShownPart> = made
        .parts
        .iter()
        .zip(&meshes)
        .map(|(part, mesh)| ShownPart {
            id: &part.id,
            shell: part.shell,
            is_tube: part.kind == PartKind::Shell,
            mesh,
        })
        .collect();
    let ground = ground(telescope);
    let view = TelescopeView {
        parts: &parts,
        collapsed: shown(&closed),
        half: shown(&half),
        extended: shown(last),
        poses: poses
            .iter()
            .filter_map(|posed| {
                let state = posed.keys.last()?.first()?;
                Some((posed.name.clone(), shown(state)))
            })
            .collect(),
        up: ground.axes.column(0).into(),
        joint: cut_joint(telescope, &parts)?,
    };
    watch.check()?;
    Ok(draw_telescope(&view)?)
}

/// Returns the state in the middle of the keys.
fn half_open(
    keys: &[Vec<JointState>],
    closed: &[JointState],
    open: &[JointState],
) -> Vec<JointState> {
    match keys.get(keys.len() / 2) {
        Some(key) if keys.len() > 2 => key.clone(),
        _ => between(closed, open, 0.5),
    }
}

/// Returns the first joint, a little before its stop, with what lies near its pivot; `None` for a
/// single shell.
fn cut_joint(telescope: &Telescope, parts: &[ShownPart]) -> Result<Option<CutJoint>, ClipError> {
    let find = |shell: usize, is_tube: bool| {
        let own = |part: &&ShownPart| part.shell == shell && part.is_tube == is_tube;
        parts.iter().find(own).map(|part| part.mesh)
    };
    let tubes = find(0, true).zip(find(1, true));
    let (Some(joint), Some((outer, inner))) = (telescope.joints.first(), tubes) else {
        return Ok(None);
    };
    let sizes = &telescope.sizes;
    let overlap_mm = sizes.overlap_mm();
    let state = JointState {
        slide_mm: telescope.visible_mm - BEFORE_STOP_SHARE * overlap_mm,
        turn_rad: 0.0,
    };
    let placed = telescope.step(0, &state);
    let pivot = telescope.shells[0].helix.frame_at(telescope.visible_mm);
    let along: Vector = pivot.axes.column(0).into();
    let reach_mm = SHOWN_OVERLAPS * overlap_mm;
    let low = Plane::through(&(pivot.origin - along * reach_mm), &-along);
    let high = Plane::through(&(pivot.origin + along * reach_mm), &along);
    let near = |mesh: &TriMesh, frame: &Frame| -> Result<TriMesh, ClipError> {
        let moved = mesh.map_vertices(|p| frame.to_model(p));
        let csg = Csg::of_mesh(&crate::repair::weld(&moved))?;
        let (_, kept) = csg.split_by_plane(&low)?;
        let (_, kept) = kept.split_by_plane(&high)?;
        kept.to_mesh()
    };
    Ok(Some(CutJoint {
        outer: near(outer, &Frame::identity())?,
        inner: near(inner, &placed)?,
        cap: find(1, false).map(|cap| near(cap, &placed)).transpose()?,
        pivot,
        wall_mm: sizes.wall_mm,
        clearance_mm: sizes.slide_mm,
        body_mm: joint.radii.body_mm,
        bore_mm: joint.radii.bore_mm,
        overlap_mm,
        before_stop_mm: BEFORE_STOP_SHARE * overlap_mm,
    }))
}
