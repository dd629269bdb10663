//! The cut plan as plain data: the planes, the pins and the faces left whole.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        drains::hole::DrainHole,
        error::CutError,
        geometry::{
            chart::{Chart, Point2},
            tree::{CutTree, Limit},
        },
        hollowed::{Hollowed, Void},
        ids::{CutId, PartId, PinId, VoidId},
        joints::{label::Label, pin_shape::PinSite},
        remark::Remark,
        side::{CutSide, Side},
    },
    geom::{Aabb, Parting, Plane, Point, Vector, play::Play},
    mass::FlatFace,
    mesh::TriMesh,
};
use serde::{Deserialize, Serialize};

/// The cuts, pins and joints of a kit: plain data that can be written, edited and read again.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutPlan {
    /// The cuts.
    pub cuts: Vec<Cut>,
    /// The pins that align the parts.
    pub pins: Vec<PinSite>,
    /// The joints between the parts.
    pub joints: Vec<JointNote>,
    /// The ids sunk into its cut faces.
    #[serde(default)]
    pub labels: Vec<Label>,
    /// The access to each void, in the order of the hollowed body's voids.
    pub voids: Vec<VoidAccess>,
    /// Faces at which a cut leaves the body whole.
    #[serde(default)]
    pub uncut: Vec<UncutFace>,
    /// Regions of the interior that stay solid, so that joints have room for their pins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub solid: Vec<SolidEnd>,
    /// The holes through which the voids of an uncut piece drain. They follow from the body, and
    /// are not written to the plan's file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drains: Vec<DrainHole>,
    /// The cuts that were moved to a whole layer of the printer. They record how the plan was found
    /// and are not written to its file.
    #[serde(skip)]
    pub moves: Vec<CutMove>,
    /// Notes for the user, such as the proof that fewer cuts do not suffice, or joints without room
    /// for pins.
    pub notes: Vec<Remark>,
}

/// A plane cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// The cut's name: C1, C2, …
    pub id: CutId,
    /// A point of the plane in the model frame, mm.
    pub point_mm: [f64; 3],
    /// The unit normal.
    pub normal: [f64; 3],
    /// The sides of other cuts to which it is limited; everywhere if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub within: Vec<CutSide>,
}

/// A face that a cut leaves whole: the plane passes through an ear or a finger, but would open
/// nothing there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UncutFace {
    /// The cut's id.
    pub cut: CutId,
    /// A point of the face in the model frame, mm.
    pub point_mm: [f64; 3],
}

/// Two parts that meet at a cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JointNote {
    /// The cut's id.
    pub cut: CutId,
    /// The ids of the parts below and above the cut.
    pub parts: [PartId; 2],
    /// The area to be glued, sockets not subtracted, mm².
    pub area_mm2: f64,
    /// The ids of the pins between them.
    pub pins: Vec<PinId>,
    /// `true` if the pins let the parts together in one way only.
    pub one_way: bool,
    /// The play of its pins; `None` without two pins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub play: Option<Play>,
    /// `true` if the pins are far enough apart and the step that they leave is accepted.
    #[serde(default)]
    pub held: bool,
    /// The face in which the parts touch: the section less the mouths of the sockets.
    pub face: FlatFace,
}

/// A region of the interior that is not emptied: what is connected to a point, within a box of the
/// model frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolidEnd {
    /// A point in it or at its wall, mm.
    pub at_mm: [f64; 3],
    /// The least corner of the box, mm.
    pub low_mm: [f64; 3],
    /// The greatest corner of the box, mm.
    pub high_mm: [f64; 3],
}

/// A cut that was moved so that a part's face ends at a whole layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutMove {
    /// The cut's id.
    pub cut: CutId,
    /// The part whose face decided the move.
    pub part: PartId,
    /// The distance by which the plane was moved along its normal, mm: half a layer at most.
    pub moved_mm: f64,
}

/// A place on a cut at which the body is left whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bridge {
    pub(crate) cut: usize,
    /// A point well inside the uncut face, in the plane's coordinates.
    pub(crate) at: Point2,
}

impl JointNote {
    /// Returns whether at least two pins let the parts together in one way only, and hold them well
    /// enough.
    pub fn is_aligned(&self) -> bool {
        self.pins.len() >= 2 && self.one_way && self.held
    }
}

impl CutPlan {
    /// Returns the plan that cuts nothing and leaves every void closed.
    pub fn uncut(hollowed: &Hollowed) -> Self {
        let closed = |(index, void): (usize, &Void)| VoidAccess::closed(VoidId::of(index), void);
        Self {
            cuts: Vec::new(),
            pins: Vec::new(),
            joints: Vec::new(),
            labels: Vec::new(),
            voids: hollowed.voids.iter().enumerate().map(closed).collect(),
            uncut: Vec::new(),
            solid: Vec::new(),
            drains: Vec::new(),
            moves: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Returns one mesh of the material that pins add and, turned inside out, of what sockets and
    /// labels remove. Its moments are the difference between the assembled parts and the uncut
    /// body.
    pub fn pegs(&self) -> TriMesh {
        let second_socket = |pin: &PinSite| match pin.dowel {
            Some(_) => pin.mirrored().removed_body(),
            None => TriMesh::default(),
        };
        let sockets = |pin: &PinSite| pin.removed_body().joined(&second_socket(pin)).reversed();
        let peg = |pin: &PinSite| pin.protruding_body().joined(&sockets(pin));
        let pegs = self
            .pins
            .iter()
            .fold(TriMesh::default(), |pegs, pin| pegs.joined(&peg(pin)));
        self.labels.iter().fold(pegs, |pegs, label| {
            pegs.joined(&label.taken_away().reversed())
        })
    }

    /// Counts the parts that its joints hold together; 1 without joints.
    pub fn count_parts(&self) -> usize {
        let mut parts: Vec<&PartId> = self.joints.iter().flat_map(|joint| &joint.parts).collect();
        parts.sort_unstable();
        parts.dedup();
        parts.len().max(1)
    }

    /// Returns the cuts at which a part meets others.
    pub fn cuts_of(&self, part: PartId) -> impl Iterator<Item = &Cut> {
        let meets = move |joint: &JointNote| joint.parts.contains(&part);
        let joints = move || self.joints.iter().filter(move |joint| meets(joint));
        self.cuts
            .iter()
            .filter(move |cut| joints().any(|joint| joint.cut == cut.id))
    }

    /// Returns the notes that stay true when its pins are placed again. They say how its cuts were
    /// found, and which parts are small.
    pub fn lasting_notes(&self) -> impl Iterator<Item = &Remark> {
        let is_small = |note: &Remark| matches!(note, Remark::SmallPart { .. });
        let lasts = move |note: &&Remark| note.is_proof() || is_small(note);
        self.notes.iter().filter(lasts)
    }

    /// Returns its cuts with the half-spaces within which they are made, in their order. Errors as
    /// [`Cut::plane`], and if limits are circular.
    pub fn partings(&self) -> Result<Vec<Parting>, CutError> {
        Ok(self.tree()?.partings().collect())
    }

    /// Returns the planes of its cuts and their limits.
    pub(crate) fn tree(&self) -> Result<CutTree, CutError> {
        tree_of(&self.cuts)
    }

    /// Returns the faces left whole, in the coordinates of the cuts' planes.
    pub(crate) fn bridges(&self, planes: &[Plane]) -> Vec<Bridge> {
        bridges_on(planes, &self.cuts, &self.uncut)
    }
}

/// Returns the index of the cut with an id; `None` if there is none.
pub(crate) fn index_of(cuts: &[Cut], id: &CutId) -> Option<usize> {
    cuts.iter().position(|cut| cut.id == *id)
}

/// Returns the planes of cuts and their limits.
pub(crate) fn tree_of(cuts: &[Cut]) -> Result<CutTree, CutError> {
    let planes = cuts.iter().map(Cut::plane).collect::<Result<Vec<_>, _>>()?;
    let limit = |side: &CutSide| {
        let cut = index_of(cuts, &side.cut)?;
        Some(Limit {
            cut,
            is_above: side.side == Side::Above,
        })
    };
    let limits = |cut: &Cut| {
        let known: Option<Vec<Limit>> = cut.within.iter().map(limit).collect();
        known.ok_or(CutError::CircularCuts)
    };
    let limits = cuts.iter().map(limits).collect::<Result<Vec<_>, _>>()?;
    CutTree::new(planes, limits).ok_or(CutError::CircularCuts)
}

/// Returns faces left whole, in the coordinates of the cuts' planes, without those on none of the
/// cuts.
pub(crate) fn bridges_on(planes: &[Plane], cuts: &[Cut], uncut: &[UncutFace]) -> Vec<Bridge> {
    let bridge = |face: &UncutFace| {
        let cut = index_of(cuts, &face.cut)?;
        Some(Bridge {
            cut,
            at: Chart::of_plane(&planes[cut]).flat(&Point::from(face.point_mm)),
        })
    };
    uncut.iter().filter_map(bridge).collect()
}

impl Cut {
    /// Returns the cut's plane; an error if its normal has no length or a number is not finite.
    pub fn plane(&self) -> Result<Plane, CutError> {
        let (point, normal) = (Point::from(self.point_mm), Vector::from(self.normal));
        let plane = Plane::through(&point, &normal);
        let is_plane =
            plane.offset_mm.is_finite() && (plane.normal.norm() - 1.0).abs() < f64::EPSILON.sqrt();
        if is_plane {
            Ok(plane)
        } else {
            Err(CutError::DegenerateCut {
                cut: self.id.clone(),
            })
        }
    }
}

impl SolidEnd {
    pub(crate) fn new(at: &Point, aabb: &Aabb) -> Self {
        Self {
            at_mm: (*at).into(),
            low_mm: aabb.min.into(),
            high_mm: aabb.max.into(),
        }
    }

    /// Returns the box.
    pub fn aabb(&self) -> Aabb {
        Aabb {
            min: self.low_mm.into(),
            max: self.high_mm.into(),
        }
    }

    /// Returns whether the box has a volume and contains the point.
    pub(crate) fn is_sound(&self) -> bool {
        let sides = self.low_mm.iter().zip(self.high_mm).zip(self.at_mm);
        sides.into_iter().all(|((&low, high), at)| {
            [low, high, at].iter().all(|number| number.is_finite())
                && low < high
                && (low..=high).contains(&at)
        })
    }
}
