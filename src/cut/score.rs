//! How good a plan is: a few named terms, each 0 (nothing to improve) to 1 (bad), weighed and added.

use super::{
    opening::{Opening, opening},
    pin_size::needed_room_mm,
    request::PlanRequest,
    section::Section,
    sides::Sides,
};
use crate::{
    geom::Plane,
    mass::moments_of_mesh,
    mesh::{Hollowed, TriMesh},
};

/// The body that is to be cut, with what every plane is compared against.
pub(crate) struct Scene<'a> {
    pub(crate) hollowed: &'a Hollowed,
    pub(crate) request: &'a PlanRequest,
    /// The surface of the material: the outside and the voids turned inside out.
    pub(crate) material: TriMesh,
    volume_mm3: f64,
    diagonal_mm: f64,
}

impl<'a> Scene<'a> {
    pub(crate) fn new(hollowed: &'a Hollowed, request: &'a PlanRequest) -> Self {
        let material = hollowed.to_mesh();
        let volume_mm3 = moments_of_mesh(&material).volume();
        let diagonal_mm = hollowed.outer.mesh().aabb().size().norm();
        Self { hollowed, request, material, volume_mm3, diagonal_mm }
    }

    /// How the plane opens each void of `met`; `None` for those it misses.
    pub(crate) fn openings(&self, plane: &Plane, met: super::cover::VoidSet) -> Vec<Option<Opening>> {
        let voids = self.hollowed.voids.iter().enumerate();
        voids.map(|(i, void)| (met >> i & 1 == 1).then(|| opening(void.mesh(), plane)).flatten()).collect()
    }
}

/// Openings wider than this many times the least asked for are no better.
pub(crate) const AMPLE_OPENING_RATIO: f64 = 3.0;
/// Parts larger than this share of the material are not too small.
const AMPLE_PART_RATIO: f64 = 0.02;
/// Cuts farther than this from the contact point do not disturb it, mm.
const AMPLE_CONTACT_MM: f64 = 3.0;

/// Weight of the narrowest opening: washing out is what cuts are for.
const OPENING_WEIGHT: f64 = 1.0;
/// Weight of a joint without room for pins: parts that cannot be aligned spoil the balance.
const ROOM_WEIGHT: f64 = 2.0;
/// Weight of crumbs: they are lost, or glued wrongly.
const SMALL_PART_WEIGHT: f64 = 2.0;
/// Weight of each piece a cut leaves beyond two: every part is one more to print, clean and glue.
const EXTRA_PART_WEIGHT: f64 = 0.2;
/// Weight of a cut through the contact point: the tip wears along a seam.
const CONTACT_WEIGHT: f64 = 1.0;
/// Weight of a seam as long as the circle about the model: looks, and glue.
const SEAM_WEIGHT: f64 = 0.5;

/// What a cut does to the body, apart from the voids it opens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Burden {
    /// The visible length of the seam, mm.
    pub(crate) seam_mm: f64,
    /// The diameter of the largest disc of material in the joint that has the least, mm (at most what pins need; 0 when below half of it).
    pub(crate) room_mm: f64,
    /// How many pieces it leaves beyond two.
    pub(crate) extra_parts: usize,
    /// The volume of the smallest piece over that of the body.
    pub(crate) smallest_ratio: f64,
    /// The distance of the cut from the contact point, mm.
    pub(crate) contact_mm: f64,
}

/// What the plane does to the body, pieces left out that stay joined to another because nothing opens between them.
/// Costs two passes over the triangles.
pub(crate) fn burden(scene: &Scene, plane: &Plane) -> Burden {
    let sides = Sides::new(&scene.material, *plane, Section::of_mesh(&scene.material, plane));
    let joints = joints(&sides, scene.hollowed.outer.mesh().vertices().len());
    let cut: Vec<&Joint> = joints.iter().filter(|joint| !is_needless(joint, &joints)).collect();
    let is_part = |piece: u32| cut.iter().any(|joint| joint.pieces.contains(&piece));
    let volumes = sides.piece_volumes_mm3().into_iter().filter(|&(piece, _)| is_part(piece));
    let volumes: Vec<f64> = volumes.map(|(_, volume)| volume / scene.volume_mm3).collect();
    let groups = || cut.iter().flat_map(|joint| &joint.groups);
    let needed_mm = needed_room_mm(scene.request);
    let room_mm = |joint: &&Joint| {
        let discs = joint.groups.iter().map(|&group| sides.disc_diameter_mm(group, needed_mm / 2.0));
        discs.fold(0.0, f64::max)
    };
    Burden {
        seam_mm: groups().map(|&group| sides.section.rings[sides.polygons[group][0]].length_mm()).sum(),
        extra_parts: volumes.len().saturating_sub(2),
        room_mm: cut.iter().map(room_mm).fold(needed_mm, f64::min),
        smallest_ratio: volumes.into_iter().fold(1.0, f64::min),
        contact_mm: plane.distance(&scene.request.axis.point).abs(),
    }
}

/// Two pieces and the polygons of the section between them.
struct Joint {
    pieces: [u32; 2],
    groups: Vec<usize>,
    /// Whether a void opens in one of the polygons.
    is_open: bool,
}

/// The joints of the section; vertices of the material from `first_void_vertex` on are the voids'.
fn joints(sides: &Sides, first_void_vertex: usize) -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    for (group, rings) in sides.polygons.iter().enumerate() {
        let is_mouth = |&ring: &usize| sides.section.rings[ring].above as usize >= first_void_vertex;
        let (pieces, is_open) = (sides.neighbours(group), rings.iter().any(is_mouth));
        match joints.iter_mut().find(|joint| joint.pieces == pieces) {
            Some(joint) => {
                joint.groups.push(group);
                joint.is_open |= is_open;
            }
            None => joints.push(Joint { pieces, groups: vec![group], is_open }),
        }
    }
    joints
}

/// Whether nothing opens in the joint, and one of its pieces has no other.
fn is_needless(joint: &Joint, joints: &[Joint]) -> bool {
    let count = |piece: &u32| joints.iter().filter(|other| other.pieces.contains(piece)).count();
    !joint.is_open && joint.pieces.iter().any(|piece| count(piece) == 1)
}

impl Burden {
    /// The weighed terms of one cut, 0 at best.
    pub(crate) fn penalty(&self, scene: &Scene) -> f64 {
        let needed_mm = needed_room_mm(scene.request);
        ROOM_WEIGHT * shortfall(self.room_mm, needed_mm)
            + SMALL_PART_WEIGHT * shortfall(self.smallest_ratio, AMPLE_PART_RATIO)
            + EXTRA_PART_WEIGHT * self.extra_parts as f64
            + CONTACT_WEIGHT * shortfall(self.contact_mm, AMPLE_CONTACT_MM)
            + SEAM_WEIGHT * self.seam_mm / (std::f64::consts::PI * scene.diagonal_mm)
    }
}

/// The weighed term of the narrowest of the voids' openings (mm), 0 at best.
pub(crate) fn opening_penalty(scene: &Scene, openings_mm: impl Iterator<Item = f64>) -> f64 {
    let ample_mm = AMPLE_OPENING_RATIO * scene.request.min_opening_mm;
    OPENING_WEIGHT * openings_mm.map(|mm| shortfall(mm, ample_mm)).fold(0.0, f64::max)
}

/// How far `value` falls short of `ample`: 0 when it does not, 1 when it is nothing.
fn shortfall(value: f64, ample: f64) -> f64 {
    (1.0 - value / ample).clamp(0.0, 1.0)
}
