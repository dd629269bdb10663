//! The cut plan: which planes, and where the pins go.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{
    access::{VoidAccess, access},
    error::CutError,
    pattern::Peg,
    pin_shape::PinSite,
    pins::{PinScene, Placement, needed_room_mm, place},
    pose::{laid, sides_down},
    rejoin::{Bridge, Cutting, bridges, rejoined},
    request::PlanRequest,
    score::Scene,
    search::{Found, smallest_plans},
    section::Chart,
    split::{Joint, Piece, check_no_cavity, joints, split},
};
use crate::{
    geom::{Plane, Point, Vector},
    mesh::{Hollowed, Solid, TriMesh},
    units::counted,
};

/// The cuts, pins and joints of a kit: plain data, to be written, edited and read again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutPlan {
    /// The cuts.
    pub cuts: Vec<Cut>,
    /// The pins that align the parts.
    pub pins: Vec<PinSite>,
    /// Which parts meet where.
    pub joints: Vec<JointNote>,
    /// How each void is opened, in the order of the hollowed body's voids.
    pub voids: Vec<VoidAccess>,
    /// Where a cut leaves the body whole.
    #[serde(default)]
    pub uncut: Vec<UncutFace>,
    /// What a person should know: the proof that fewer cuts do not do, joints without room for pins.
    pub notes: Vec<String>,
}

/// A plane cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cut {
    /// The cut's name: C1, C2, …
    pub id: String,
    /// A point of the plane in the model frame, mm.
    pub point_mm: [f64; 3],
    /// The unit normal.
    pub normal: [f64; 3],
}

/// A face that a cut leaves whole: the plane passes through an ear or a finger there, but nothing would be opened.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UncutFace {
    /// The cut's id.
    pub cut: String,
    /// A point of the face in the model frame, mm.
    pub point_mm: [f64; 3],
}

/// Two parts that meet at a cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointNote {
    /// The cut's id.
    pub cut: String,
    /// The ids of the parts below and above the cut.
    pub parts: [String; 2],
    /// The area to be glued, sockets not taken off, mm².
    pub area_mm2: f64,
    /// The ids of the pins between them.
    pub pins: Vec<String>,
    /// Whether the pins let the parts together one way only.
    pub one_way: bool,
}

impl CutPlan {
    /// The plan that cuts nothing and leaves every void closed.
    pub fn uncut(hollowed: &Hollowed) -> Self {
        let closed = |(void, solid): (usize, &Solid)| VoidAccess::closed(void, solid);
        Self {
            cuts: Vec::new(),
            pins: Vec::new(),
            joints: Vec::new(),
            voids: hollowed.voids.iter().enumerate().map(closed).collect(),
            uncut: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// One mesh of what the pins add and, turned inside out, of what the sockets take away: its moments are what the
    /// assembled parts have more than the uncut body.
    pub fn pegs(&self) -> TriMesh {
        let peg = |pin: &PinSite| pin.standing_out().joined(&pin.taken_away().reversed());
        self.pins.iter().fold(TriMesh::default(), |pegs, pin| pegs.joined(&peg(pin)))
    }

    /// The faces left whole, in the coordinates of the cuts' planes; faces on no cut of the plan are left out.
    pub(crate) fn bridges(&self, planes: &[Plane]) -> Vec<Bridge> {
        let bridge = |face: &UncutFace| {
            let cut = self.cuts.iter().position(|cut| cut.id == face.cut)?;
            Some(Bridge { cut, at: Chart::of_plane(&planes[cut]).flat(&Point::from(face.point_mm)) })
        };
        self.uncut.iter().filter_map(bridge).collect()
    }
}

impl Cut {
    /// The cut's plane, or why it is none.
    pub fn plane(&self) -> Result<Plane, CutError> {
        let (point, normal) = (Point::from(self.point_mm), Vector::from(self.normal));
        let plane = Plane::through(&point, &normal);
        let is_plane = plane.offset_mm.is_finite() && (plane.normal.norm() - 1.0).abs() < f64::EPSILON.sqrt();
        if is_plane { Ok(plane) } else { Err(CutError::DegenerateCut { cut: self.id.clone() }) }
    }
}

/// How near a vertex may lie to a planned cut, mm: nearer, a face along the cut could leave sheets without volume.
const VERTEX_GAP_MM: f64 = 1e-6;
/// How often a cut is moved on by twice the gap to find an offset without vertices.
const NUDGES: usize = 200;
/// How many of the best plans are cut for trial before the best is taken as it is.
const TRIED_PLANS: usize = 3;
/// How many further cuts may be made so that parts fit the build volume.
const MAX_FITTING_CUTS: usize = 8;

/// The fewest cuts that open every void by at least the asked disc, the best of them by named terms (opening, room for
/// pins, smallest part, distance from the contact point, seam), further cuts where a part would not fit
/// the build volume, and pins for every joint.
///
/// "Fewest" is proved by exact set cover over the family of planes tried; the notes say over how many. About a
/// second for 200k triangles and ten voids.
pub fn plan(hollowed: &Hollowed, request: &PlanRequest) -> Result<CutPlan, CutError> {
    check(request)?;
    let scene = Scene::new(hollowed, request);
    let mut notes = Vec::new();
    let mut layout = opening_cuts(&scene, &mut notes)?;
    fit_build_volume(&scene, &mut layout, &mut notes)?;
    described(&scene, layout, notes)
}

/// The plan for cuts given by the user, each through the whole model: pins, joints and openings as in [`plan`].
pub fn plan_for_cuts(hollowed: &Hollowed, request: &PlanRequest, cuts: &[Cut]) -> Result<CutPlan, CutError> {
    check(request)?;
    let scene = Scene::new(hollowed, request);
    let planes = cuts.iter().map(Cut::plane).collect::<Result<Vec<_>, _>>()?;
    let pieces = split(&scene.material, &planes)?;
    let voids = accesses(hollowed, &planes)?;
    described(&scene, Layout { planes, voids, pieces, bridges: Vec::new() }, Vec::new())
}

/// The plan with what it does to the voids of a body that was solved for again: their volumes, openings, depths and
/// sights. Cuts, pins and joints stay.
pub fn plan_of(hollowed: &Hollowed, plan: CutPlan) -> Result<CutPlan, CutError> {
    let planes = plan.cuts.iter().map(Cut::plane).collect::<Result<Vec<_>, _>>()?;
    Ok(CutPlan { voids: accesses(hollowed, &planes)?, ..plan })
}

/// Cuts, how they open the voids, and the pieces they leave.
struct Layout {
    planes: Vec<Plane>,
    voids: Vec<VoidAccess>,
    pieces: Vec<Piece>,
    bridges: Vec<Bridge>,
}

impl Layout {
    /// The pieces between the planes, left joined where a cut would part them needlessly.
    fn new(scene: &Scene, planes: Vec<Plane>, voids: Vec<VoidAccess>) -> Result<Self, CutError> {
        let parted = split(&scene.material, &planes)?;
        let cutting = Cutting { hollowed: scene.hollowed, planes: &planes, request: scene.request };
        let bridges = bridges(&cutting, &parted);
        let pieces = rejoined(parted.clone(), &planes, &bridges)?;
        // What stays joined must not seal what the cut opened.
        let (pieces, bridges) =
            if check_no_cavity(&pieces).is_ok() { (pieces, bridges) } else { (parted, Vec::new()) };
        Ok(Self { planes, voids, pieces, bridges })
    }
}

/// Refuses lengths that cannot be.
fn check(request: &PlanRequest) -> Result<(), CutError> {
    let pins = &request.pins;
    let positive = [
        ("min_opening_mm", request.min_opening_mm),
        ("wall_mm", request.wall_mm),
        ("pins.min_diameter_mm", pins.min_diameter_mm),
        ("pins.length_ratio", pins.length_ratio),
        ("axis.direction", request.axis.direction.norm()),
    ];
    let not_negative = [
        ("pins.clearance_mm", pins.clearance_mm),
        ("pins.chamfer_mm", pins.chamfer_mm),
        ("pins.bottom_relief_mm", pins.bottom_relief_mm),
        ("pixel_mm", request.pixel_mm),
        ("layer_mm", request.layer_mm),
    ];
    let bad = positive.into_iter().find(|(_, value)| !(*value > 0.0 && value.is_finite()));
    let bad = bad.or(not_negative.into_iter().find(|(_, value)| !(*value >= 0.0 && value.is_finite())));
    bad.map_or(Ok(()), |(name, value)| Err(CutError::BadRequest { name, value }))
}

/// The best of the smallest plans, and its pieces.
fn opening_cuts(scene: &Scene, notes: &mut Vec<String>) -> Result<Layout, CutError> {
    if scene.hollowed.voids.is_empty() {
        return Layout::new(scene, Vec::new(), Vec::new());
    }
    let found = smallest_plans(scene)?;
    notes.push(proof_note(&found));
    let mut narrow = None;
    for planes in found.plans.iter().take(TRIED_PLANS) {
        let planes: Vec<Plane> = planes.iter().map(|plane| off_vertices(&scene.material, plane)).collect();
        let voids = accesses(scene.hollowed, &planes)?;
        let needed_mm = |void: &VoidAccess| scene.request.needed_mm(void.void, scene.hollowed.voids.len());
        if voids.iter().all(|void| void.opening_mm >= needed_mm(void)) {
            return Layout::new(scene, planes, voids);
        }
        narrow = narrow.or(Some((planes, voids)));
    }
    let (planes, voids) = narrow.unwrap_or_default();
    Layout::new(scene, planes, voids)
}

fn proof_note(found: &Found) -> String {
    let cuts = counted(found.plans.first().map_or(0, Vec::len), "cut");
    let (family, nodes) = (found.family, found.nodes);
    if found.is_proved {
        format!("{cuts}: fewer do not open every void (exact cover over {family} planes, {nodes} nodes)")
    } else {
        format!("{cuts}: fewer were not found, nor excluded, among {family} planes ({nodes} nodes)")
    }
}

/// The plane, moved along its normal until no vertex is within [`VERTEX_GAP_MM`] of it.
fn off_vertices(mesh: &TriMesh, plane: &Plane) -> Plane {
    let mut heights: Vec<f64> = mesh.vertices().iter().map(|p| plane.normal.dot(&p.coords)).collect();
    heights.sort_by(f64::total_cmp);
    let is_free = |offset_mm: f64| {
        let next = heights.partition_point(|&h| h < offset_mm - VERTEX_GAP_MM);
        heights.get(next).is_none_or(|&h| h > offset_mm + VERTEX_GAP_MM)
    };
    let offsets = (0..NUDGES).map(|i| plane.offset_mm + 2.0 * VERTEX_GAP_MM * i as f64);
    let offset_mm = offsets.into_iter().find(|&o| is_free(o)).unwrap_or(plane.offset_mm);
    Plane { normal: plane.normal, offset_mm }
}

/// Whether the piece fits the build volume in some pose.
fn fits(piece: &Piece, planes: &[Plane], request: &PlanRequest) -> bool {
    laid(&piece.mesh, &sides_down(piece, planes, &[], request), request).fits
}

/// Cuts pieces that do not fit the build volume in two, across their longest extent, until all fit.
fn fit_build_volume(scene: &Scene, layout: &mut Layout, notes: &mut Vec<String>) -> Result<(), CutError> {
    for _ in 0..MAX_FITTING_CUTS {
        let is_large = |piece: &&Piece| !fits(piece, &layout.planes, scene.request);
        let Some(piece) = layout.pieces.iter().find(is_large) else { return Ok(()) };
        let aabb = piece.mesh.aabb();
        let middle = Plane::through(&aabb.center(), &Vector::ith(aabb.size().imax(), 1.0));
        let middle = off_vertices(&scene.material, &middle);
        let planes: Vec<Plane> = layout.planes.iter().copied().chain([middle]).collect();
        let voids = accesses(scene.hollowed, &planes)?;
        *layout = Layout::new(scene, planes, voids)?;
        notes.push(format!("cut {}: a part would not fit the build volume", cut_id(layout.planes.len() - 1)));
    }
    Ok(())
}

/// The plan's data for these cuts and pieces.
fn described(scene: &Scene, layout: Layout, mut notes: Vec<String>) -> Result<CutPlan, CutError> {
    let Layout { planes, voids, pieces, bridges } = layout;
    check_no_cavity(&pieces)?;
    let pin_scene =
        PinScene { request: scene.request, planes: &planes, pieces: &pieces, material: &scene.material };
    let (mut pins, mut joint_notes) = (Vec::new(), Vec::new());
    let mut placed: Vec<Vec<Peg>> = Vec::new();
    for joint in joints(&pieces) {
        let placement = place(&pin_scene, &joint, &placed);
        placed.push(placement.pegs.clone());
        notes.extend(shortage(scene.request, &joint, &placement));
        joint_notes.push(joint_note(&pieces, &joint, &placement, pins.len()));
        pins.extend(placement.sites.into_iter().map(|site| PinSite { cut: cut_id(joint.cut), ..site }));
    }
    for (index, pin) in pins.iter_mut().enumerate() {
        pin.id = pin_id(index);
    }
    let cuts = planes.iter().enumerate().map(|(i, plane)| cut(i, plane)).collect();
    notes.extend(voids.iter().filter_map(|void| narrow(scene, void)));
    let uncut = bridges.iter().map(|bridge| uncut_face(&planes, bridge)).collect();
    Ok(CutPlan { cuts, pins, joints: joint_notes, voids, uncut, notes })
}

fn uncut_face(planes: &[Plane], bridge: &Bridge) -> UncutFace {
    let plane = &planes[bridge.cut];
    let point_mm = Chart::of_plane(plane).lift(plane, &bridge.at).into();
    UncutFace { cut: cut_id(bridge.cut), point_mm }
}

fn joint_note(pieces: &[Piece], joint: &Joint, placement: &Placement, first_pin: usize) -> JointNote {
    JointNote {
        cut: cut_id(joint.cut),
        parts: [part_id(joint.below), part_id(joint.above)],
        area_mm2: joint.caps.iter().map(|&cap| pieces[joint.below].caps[cap].area_mm2).sum(),
        pins: (0..placement.sites.len()).map(|i| pin_id(first_pin + i)).collect(),
        one_way: placement.is_one_way,
    }
}

/// What to say of a void one of whose pieces has a narrow mouth, where two cuts leave a pocket behind one of them.
fn narrow(scene: &Scene, void: &VoidAccess) -> Option<String> {
    let (index, opening) = (void.void, void.opening_mm);
    let asked = scene.request.needed_mm(index, scene.hollowed.voids.len());
    let note =
        || format!("void {index}: a piece of it opens by {opening:.2} mm only, asked are {asked:.2} mm");
    (opening < asked).then(note)
}

/// What to say of a joint that has not at least two pins that fit one way only.
fn shortage(request: &PlanRequest, joint: &Joint, placement: &Placement) -> Option<String> {
    let name = format!("joint {}–{}", part_id(joint.below), part_id(joint.above));
    let (widest, needed) = (placement.widest_mm, needed_room_mm(request));
    match placement.sites.len() {
        0 if widest < needed => {
            Some(format!("{name}: no room for pins: widest section {widest:.1} mm, needs {needed:.1} mm"))
        }
        0 => Some(format!("{name}: no room for pins: the material behind the cut is too thin for a socket")),
        1 => Some(format!("{name}: room for one pin only; mind the turn when gluing")),
        _ if !placement.is_one_way => {
            Some(format!("{name}: the pins fit in more than one way; mind the turn when gluing"))
        }
        _ => None,
    }
}

/// How the cuts open each void.
fn accesses(hollowed: &Hollowed, planes: &[Plane]) -> Result<Vec<VoidAccess>, CutError> {
    hollowed.voids.par_iter().enumerate().map(|(i, void)| access(i, void, planes)).collect()
}

fn cut(index: usize, plane: &Plane) -> Cut {
    Cut { id: cut_id(index), point_mm: plane.foot().into(), normal: plane.normal.into() }
}

/// The name of the cut with this index.
pub(crate) fn cut_id(index: usize) -> String {
    format!("C{}", index + 1)
}

fn pin_id(index: usize) -> String {
    format!("N{}", index + 1)
}

/// The name of the part with this index.
pub(crate) fn part_id(index: usize) -> String {
    format!("P{:02}", index + 1)
}
