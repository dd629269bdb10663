//! How a finished plan opens each void.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::{
    cut::{
        access::{
            chamber::Chamber,
            sight::{Look, Seen},
        },
        error::CutError,
        geometry::{opening::is_dimple, tree::CutTree},
        hollowed::{Hollowed, Void},
        ids::{CutId, VoidId},
        pieces::split::{Cap, Piece},
        request::PlanRequest,
    },
    geom::{Plane, Point},
};

/// More of the wall than asked must be in sight by this share, so that a judge who looks at other
/// points, and voids solved for once more, still find enough. Less, and kits at the limit fail now
/// and then; more costs cuts that nobody needs.
const SIGHT_MARGIN_RATIO: f64 = 0.005;

/// What of that margin must be left in the end: a judge who looks at other points and from more
/// places finds up to 0.0045 less, and more than 0.0012 less in 2 of 104 voids (the acceptance
/// table on four printers).
const LAST_MARGIN_RATIO: f64 = 0.002;

/// How a void is opened.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct VoidAccess {
    /// The void's index in the hollowed body.
    pub void: VoidId,
    /// The diameter of the part that it holds, which must pass through its opening, mm; `None` if
    /// it holds none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part_opening_mm: Option<f64>,
    /// The void's volume, mm³.
    pub volume_mm3: f64,
    /// The ids of the cuts that pass through it.
    pub opened_by: Vec<CutId>,
    /// The diameter of the largest disc that passes the widest mouth of its pieces; of the piece
    /// where that is least, mm. Dimples in plain sight are not asked. 0 when the void stays closed.
    pub opening_mm: f64,
    /// The greatest distance of a point of its surface from the mouth of its piece, mm.
    pub depth_mm: f64,
    /// The share of its wall that is in sight of the mouths of its own piece and within the tool's
    /// reach; of a sample of points.
    pub sight_ratio: f64,
    /// Whether every piece of it can be cleaned by the printer's rule. Of filament, too, the
    /// planner asks for sight: how parts will lie, and so what needs no support, is settled after
    /// the cuts.
    pub is_clean: bool,
}

impl VoidAccess {
    /// A void that no cut opens.
    pub(crate) fn closed(id: VoidId, void: &Void) -> Self {
        Self {
            void: id,
            part_opening_mm: void.holds.as_ref().map(|seat| seat.opening_mm),
            volume_mm3: void.mesh().signed_volume_mm3(),
            opened_by: Vec::new(),
            opening_mm: 0.0,
            depth_mm: 0.0,
            sight_ratio: 0.0,
            is_clean: false,
        }
    }

    /// How far the void is from clean, mm²: 0 where it is; else the area that is missing in sight,
    /// and all of it where something cannot get out. Areas are those of a ball of its volume.
    pub(crate) fn lack_mm2(&self, request: &PlanRequest) -> f64 {
        let asked = asked_ratio(request);
        let closed = if self.is_clean {
            0.0
        } else {
            f64::from(u8::from(self.sight_ratio >= asked))
        };
        self.area_mm2() * ((asked - self.sight_ratio).max(0.0) + closed)
    }

    /// Whether it can be cleaned by the rule, with hardly any of the planner's margin left: for
    /// what is not solved for once more but to make up for pins.
    pub fn is_clean_without_margin(&self, request: &PlanRequest) -> bool {
        let least = request.cleaning.sight_ratio + LAST_MARGIN_RATIO;
        let is_seen = (least..asked_ratio(request)).contains(&self.sight_ratio);
        self.is_clean || (is_seen && self.opening_mm >= self.least_opening_mm(request))
    }

    /// Diameter of the disc that must pass through its opening, mm: that of the part that it holds,
    /// or the least one that lets a void be cleaned.
    pub fn least_opening_mm(&self, request: &PlanRequest) -> f64 {
        self.part_opening_mm.unwrap_or(request.min_opening_mm)
    }

    /// The area of a ball of its volume but for a factor, mm²: a measure of its wall.
    pub(crate) fn area_mm2(&self) -> f64 {
        self.volume_mm3.abs().powf(2.0 / 3.0)
    }
}

/// The share of a wall that the planner wants in sight.
pub(crate) fn asked_ratio(request: &PlanRequest) -> f64 {
    let least = request.cleaning.sight_ratio;
    if least > 0.0 {
        (least + SIGHT_MARGIN_RATIO).min(1.0)
    } else {
        0.0
    }
}

/// A void and what is asked of its openings.
pub(crate) struct Opened<'a> {
    pub(crate) void: VoidId,
    pub(crate) chamber: &'a Chamber<'a>,
    pub(crate) tree: &'a CutTree,
    pub(crate) request: &'a PlanRequest,
    /// The least opening, mm.
    pub(crate) needed_mm: f64,
    /// Whether the share in sight is to be told, not only held against what is asked.
    pub(crate) is_told: bool,
}

/// How the cuts open each void.
pub(crate) fn accesses(
    chambers: &[Chamber],
    tree: &CutTree,
    request: &PlanRequest,
) -> Result<Vec<VoidAccess>, CutError> {
    (0..chambers.len())
        .into_par_iter()
        .map(|void| access(chambers, VoidId::of(void), tree, request))
        .collect()
}

/// How the cuts open each void, the shares in sight as they are told of a finished plan.
pub(crate) fn report(
    hollowed: &Hollowed,
    tree: &CutTree,
    request: &PlanRequest,
) -> Result<Vec<VoidAccess>, CutError> {
    let chambers = Chamber::all(hollowed)?;
    let of = |void| {
        Opened {
            is_told: true,
            ..Opened::new(&chambers, VoidId::of(void), tree, request)
        }
        .access()
    };
    (0..hollowed.voids.len()).into_par_iter().map(of).collect()
}

/// How the cuts open one void.
pub(crate) fn access(
    chambers: &[Chamber],
    void: VoidId,
    tree: &CutTree,
    request: &PlanRequest,
) -> Result<VoidAccess, CutError> {
    Opened::new(chambers, void, tree, request).access()
}

impl<'a> Opened<'a> {
    /// A void of a body under these cuts.
    pub(crate) fn new(
        chambers: &'a [Chamber],
        void: VoidId,
        tree: &'a CutTree,
        request: &'a PlanRequest,
    ) -> Self {
        let chamber = &chambers[void.index()];
        Self {
            void,
            chamber,
            tree,
            request,
            needed_mm: chamber.void.least_opening_mm(request),
            is_told: false,
        }
    }

    /// The void is cut into its pieces, each piece's mouths are measured, and its wall is looked at
    /// through them.
    fn access(&self) -> Result<VoidAccess, CutError> {
        let pieces = self.chamber.split(self.tree)?;
        let met = |cut: &usize| {
            pieces
                .iter()
                .any(|piece| piece.caps.iter().any(|cap| cap.cut == *cut))
        };
        let mouths: Vec<Mouths> = pieces
            .iter()
            .map(|piece| Mouths::of(piece, &self.tree.planes))
            .collect();
        let widest_mm = mouths.iter().map(Mouths::widest_mm).fold(0.0, f64::max);
        let deep = mouths.iter().filter(|mouths| !mouths.is_dimple());
        let lets_out = mouths.iter().all(|mouths| self.lets_out(mouths))
            && mouths.iter().any(|mouths| self.is_wide(mouths));
        let sight_ratio = self.seen(&pieces).ratio();
        Ok(VoidAccess {
            opened_by: (0..self.tree.planes.len())
                .filter(met)
                .map(CutId::of)
                .collect(),
            opening_mm: deep.map(Mouths::widest_mm).fold(widest_mm, f64::min),
            depth_mm: mouths
                .iter()
                .map(|mouths| mouths.depth_mm)
                .fold(0.0, f64::max),
            sight_ratio,
            is_clean: lets_out && sight_ratio >= asked_ratio(self.request),
            ..VoidAccess::closed(self.void, self.chamber.void)
        })
    }

    /// Whether what is in a piece gets out of its mouths, or lies open in a dimple.
    pub(crate) fn lets_out(&self, mouths: &Mouths) -> bool {
        mouths.is_dimple() || self.is_wide(mouths)
    }

    fn is_wide(&self, mouths: &Mouths) -> bool {
        self.request
            .cleaning
            .lets_out(&mouths.diameters_mm, self.needed_mm)
    }

    /// What is seen of all pieces together.
    fn seen(&self, pieces: &[Piece]) -> Seen {
        self.seen_each(pieces)
            .into_iter()
            .fold(Seen::default(), Seen::and)
    }

    /// What is seen of each piece.
    pub(crate) fn seen_each(&self, pieces: &[Piece]) -> Vec<Seen> {
        let look = Look::new(self.tree, self.request);
        let look = if self.is_told { look.thorough() } else { look };
        pieces
            .iter()
            .map(|piece| self.chamber.walls.seen(piece, &look))
            .collect()
    }

    /// The points of the wall that are out of sight or reach.
    pub(crate) fn hidden(&self) -> Result<Vec<Point>, CutError> {
        Ok(self.seen(&self.chamber.split(self.tree)?).hidden)
    }
}

/// The mouths of a piece of a void.
pub(crate) struct Mouths {
    /// The diameters of the largest discs through them, the widest first, mm.
    diameters_mm: Vec<f64>,
    /// The greatest distance of the piece's surface from the widest mouth's plane, mm.
    depth_mm: f64,
}

impl Mouths {
    pub(crate) fn of(piece: &Piece, planes: &[Plane]) -> Self {
        let disc_mm = |cap: &Cap| {
            cap.outline
                .largest_disc(0.0)
                .map_or(0.0, |disc| 2.0 * disc.radius_mm)
        };
        let mut mouths: Vec<(usize, f64)> = piece
            .caps
            .iter()
            .map(|cap| (cap.cut, disc_mm(cap)))
            .collect();
        mouths.sort_by(|a, b| b.1.total_cmp(&a.1));
        let Some(&(cut, _)) = mouths.first() else {
            return Self {
                diameters_mm: Vec::new(),
                depth_mm: piece.mesh.aabb().size().norm(),
            };
        };
        let heights = piece
            .mesh
            .vertices()
            .iter()
            .map(|p| planes[cut].distance(p).abs());
        let diameters_mm = mouths.into_iter().map(|(_, mm)| mm).collect();
        Self {
            diameters_mm,
            depth_mm: heights.fold(0.0, f64::max),
        }
    }

    fn is_dimple(&self) -> bool {
        is_dimple(self.depth_mm, self.widest_mm())
    }

    fn widest_mm(&self) -> f64 {
        self.diameters_mm.first().copied().unwrap_or(0.0)
    }
}
