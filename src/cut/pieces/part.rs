//! The parts: the pieces of the cut body with pins and sockets, each a solid and posed for
//! printing.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::{
    base::{verdict::Verdict, watch::Watch},
    cut::{
        drains::hole::{DrainHole, bored},
        error::{CutError, Obstacle, verdict},
        geometry::{chart::Chart, tree::CutTree},
        hollowed::Hollowed,
        ids::{PartId, VoidId},
        joints::{contact::update_faces, label::Label, pin_shape::PinSite},
        pieces::{
            pose::{Pose, Posed, lay_on},
            rejoin::rejoin,
            split::{Piece, check_no_cavity, piece_at, split, split_for_trial},
        },
        plan::{CutPlan, index_of},
        request::PlanRequest,
    },
    geom::{Plane, Point, Vector},
    mesh::{Crossings, Csg, Solid, TriMesh},
};

/// One part of a kit.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The part's name: P01, P02, …
    pub id: PartId,
    /// The part in the model frame, mm.
    pub solid: Solid,
    /// Its pose in the printer.
    pub pose: Pose,
    /// The printed pins that stand out of it.
    pub pins: Vec<PinSite>,
    /// The sockets, as sites seen from the cut into this part: for pins of other parts, and for the
    /// dowels that stand in it.
    pub sockets: Vec<PinSite>,
    /// The ids sunk into its cut faces.
    pub labels: Vec<Label>,
    /// The voids that it holds a piece of, ascending.
    pub voids: Vec<VoidId>,
}

impl Part {
    /// Returns the volume that its pins add to the piece of the hollowed body, less the volume of
    /// its sockets and labels, mm³.
    ///
    /// Summed over the parts and added to the hollowed body's volume, this gives the volume of all
    /// parts to 1e-6 relative.
    pub fn added_volume_mm3(&self) -> f64 {
        let pins: f64 = self.pins.iter().map(PinSite::pin_volume_mm3).sum();
        let sockets: f64 = self.sockets.iter().map(PinSite::socket_volume_mm3).sum();
        let labels: f64 = self.labels.iter().map(Label::volume_mm3).sum();
        pins - sockets - labels
    }
}

/// A pin with the pieces that carry it and receive it.
struct PinPieces<'a> {
    site: &'a PinSite,
    carrier: usize,
    receiver: usize,
    cut: usize,
}

/// Cuts the hollowed body by the plan and returns its parts, with pins, sockets and labels. Every
/// part is closed, oriented and 2-manifold. No part encloses a cavity, unless the plan has neither
/// cuts nor drain holes.
///
/// The body may differ a little from the one that was planned, for example after its voids were
/// solved again. Cuts, pins and parts keep their names.
pub fn parts(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Verdict<Vec<Part>, Obstacle>, CutError> {
    let parts = parts_and_faces(hollowed, plan, request)?;
    Ok(parts.map(|(parts, _)| parts))
}

/// Returns the parts as in [`parts`], and the plan with the faces of its joints measured in this
/// body.
pub fn parts_and_faces(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Verdict<(Vec<Part>, CutPlan), Obstacle>, CutError> {
    verdict(make_parts(hollowed, plan, request))
}

fn make_parts(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<(Vec<Part>, CutPlan), CutError> {
    let tree = plan.tree()?;
    let pieces = pieces(hollowed, plan, &tree, &request.watch)?;
    let maker = PartMaker {
        hollowed,
        plan,
        tree: &tree,
        request,
    };
    let mut parts = maker.make_parts(&pieces)?;
    let first = parts.len();
    parts.extend(maker.make_plugs(first)?);
    Ok((parts, update_faces(&pieces, &tree, plan.clone())))
}

/// Returns the pieces that the plan leaves. If there are cuts or drain holes, a piece with a closed
/// cavity is an error.
pub(crate) fn pieces(
    hollowed: &Hollowed,
    plan: &CutPlan,
    tree: &CutTree,
    watch: &Watch,
) -> Result<Vec<Piece>, CutError> {
    let pieces = split(&bored(hollowed, &plan.drains)?, tree, watch)?;
    rejoin_planned(pieces, plan, tree, watch)
}

/// Returns the pieces as in [`pieces`], only to be looked at.
pub(crate) fn pieces_for_trial(
    hollowed: &Hollowed,
    plan: &CutPlan,
    tree: &CutTree,
    watch: &Watch,
) -> Result<Vec<Piece>, CutError> {
    let pieces = split_for_trial(&bored(hollowed, &plan.drains)?, tree, watch)?;
    rejoin_planned(pieces, plan, tree, watch)
}

/// Returns the pieces, those united that the plan keeps joined. If there are cuts or drain holes, a
/// piece with a closed cavity is an error.
fn rejoin_planned(
    pieces: Vec<Piece>,
    plan: &CutPlan,
    tree: &CutTree,
    watch: &Watch,
) -> Result<Vec<Piece>, CutError> {
    let bridges = plan.bridges(&tree.planes);
    let pieces = rejoin(pieces, tree, &bridges, watch)?;
    if !(tree.planes.is_empty() && plan.drains.is_empty()) {
        check_no_cavity(&pieces)?;
    }
    Ok(pieces)
}

/// A plan and the body that it cuts.
struct PartMaker<'a> {
    hollowed: &'a Hollowed,
    plan: &'a CutPlan,
    tree: &'a CutTree,
    request: &'a PlanRequest,
}

impl PartMaker<'_> {
    fn make_parts(&self, pieces: &[Piece]) -> Result<Vec<Part>, CutError> {
        let Self { plan, request, .. } = *self;
        let planes = &self.tree.planes;
        let pin_pieces = plan
            .pins
            .iter()
            .map(|pin| find_pin_pieces(plan, planes, pieces, pin))
            .collect::<Result<Vec<_>, _>>()?;
        let void_of = voids_by_vertex(self.hollowed);
        let part = |(index, piece): (usize, &Piece)| {
            request.watch.check()?;
            let carried = || pin_pieces.iter().filter(move |pin| pin.carrier == index);
            let received = || pin_pieces.iter().filter(move |pin| pin.receiver == index);
            let printed = carried().filter(|pin| pin.site.dowel.is_none());
            let pin_cuts: Vec<usize> = printed.map(|pin| pin.cut).collect();
            let is_printed = |pin: &&PinPieces| pin.site.dowel.is_none();
            let pins: Vec<PinSite> = carried()
                .filter(is_printed)
                .map(|pin| pin.site.clone())
                .collect();
            let dowel_sockets = carried()
                .filter(|pin| !is_printed(pin))
                .map(|pin| pin.site.mirrored());
            let sockets: Vec<PinSite> = received()
                .map(|pin| pin.site.clone())
                .chain(dowel_sockets)
                .collect();
            let labels: Vec<Label> = plan
                .labels
                .iter()
                .filter(|label| label.part == PartId::of(index))
                .cloned()
                .collect();
            let body = add_pins_and_sockets(piece, (&pins, &sockets), &labels, &request.watch)?;
            let solid = drop_short_edges(&body, &request.watch)?;
            let posed = Posed {
                mesh: solid.mesh(),
                piece,
                planes,
                pins: &pins,
                pin_cuts: &pin_cuts,
            };
            Ok(Part {
                id: PartId::of(index),
                pose: posed.pose(request, |p| void_of.contains_key(&bits(p)))?,
                solid,
                pins,
                sockets,
                labels,
                voids: voids_of(piece, &void_of),
            })
        };
        pieces.par_iter().enumerate().map(part).collect()
    }

    /// Makes the plugs of the drain holes, numbered on from `first`.
    fn make_plugs(&self, first: usize) -> Result<Vec<Part>, CutError> {
        let bodies = self.plan.plug_bodies(&self.hollowed.outer)?;
        let holes: Vec<&DrainHole> = self.plan.plugged().map(|(hole, _)| hole).collect();
        let watch = &self.request.watch;
        let part = |(index, body): (usize, &TriMesh)| {
            let solid = drop_short_edges(&Csg::of_mesh(body)?, watch)?;
            Ok(Part {
                id: PartId::of(first + index),
                pose: lay_on(solid.mesh(), holes[index].axis(), self.request),
                solid,
                pins: Vec::new(),
                sockets: Vec::new(),
                labels: Vec::new(),
                voids: Vec::new(),
            })
        };
        bodies.par_iter().enumerate().map(part).collect()
    }
}

/// Finds the pieces that a pin joins; an error if one side of the pin is on no cut face.
fn find_pin_pieces<'a>(
    plan: &CutPlan,
    planes: &[Plane],
    pieces: &[Piece],
    site: &'a PinSite,
) -> Result<PinPieces<'a>, CutError> {
    let off_face = || Obstacle::PinOffFace {
        pin: site.id.clone(),
    };
    let cut = index_of(&plan.cuts, &site.cut).ok_or_else(off_face)?;
    let at = Chart::of_plane(&planes[cut]).flat(&Point::from(site.center_mm));
    let is_upward = planes[cut].normal.dot(&Vector::from(site.direction)) > 0.0;
    let carrier = piece_at(pieces, cut, !is_upward, &at).ok_or_else(off_face)?;
    let receiver = piece_at(pieces, cut, is_upward, &at).ok_or_else(off_face)?;
    Ok(PinPieces {
        site,
        carrier,
        receiver,
        cut,
    })
}

/// Unites the piece with its pins, and subtracts its sockets and labels.
fn add_pins_and_sockets(
    piece: &Piece,
    (pins, sockets): (&[PinSite], &[PinSite]),
    labels: &[Label],
    watch: &Watch,
) -> Result<Csg, CutError> {
    let mut body = Csg::of_mesh(&piece.mesh)?;
    for pin in pins {
        watch.check()?;
        body = body.union(&Csg::of_mesh(&pin.pin_body())?)?;
    }
    for socket in sockets {
        watch.check()?;
        body = body.subtract(&Csg::of_mesh(&socket.socket_body())?)?;
    }
    for label in labels {
        watch.check()?;
        body = body.subtract(&Csg::of_mesh(&label.cutter())?)?;
    }
    Ok(body)
}

/// Length below which an edge may vanish when a file stores coordinates in 32 bits, mm. Their step
/// is 7.6e-6 mm at 100 mm, and 1.5e-5 mm at 250 mm.
const SHORT_EDGE_MM: f64 = 3e-5;

/// Greatest change of a part's volume by the removal of short edges, relative to it. It is a tenth
/// of the tolerance of the parts' sum.
const VOLUME_CHANGE_RATIO: f64 = 1e-7;

/// Returns the solid without the edges that would vanish in a file. Keeps the solid as it is if
/// their removal would change its volume or fold it into itself.
fn drop_short_edges(body: &Csg, watch: &Watch) -> Result<Solid, CutError> {
    watch.check()?;
    let solid = body.to_solid()?;
    watch.check()?;
    if !has_short_edge(solid.mesh()) {
        return Ok(solid);
    }
    let simple = body.simplify_watched(SHORT_EDGE_MM, watch)?.to_solid()?;
    let (before, after) = (
        solid.mesh().signed_volume_mm3(),
        simple.mesh().signed_volume_mm3(),
    );
    let is_same = (after - before).abs() <= VOLUME_CHANGE_RATIO * before
        && Crossings::of_watched(simple.mesh(), watch)?.pairs == 0;
    Ok(if is_same { simple } else { solid })
}

fn has_short_edge(mesh: &TriMesh) -> bool {
    mesh.iter_corners().any(|[a, b, c]| {
        [b - a, c - b, a - c]
            .iter()
            .any(|edge| edge.norm_squared() < SHORT_EDGE_MM * SHORT_EDGE_MM)
    })
}

/// Returns the void that each vertex of a void belongs to, by the bits of its coordinates.
pub(crate) fn voids_by_vertex(hollowed: &Hollowed) -> HashMap<[u64; 3], VoidId> {
    let voids = hollowed.voids.iter().enumerate();
    voids
        .flat_map(|(i, void)| {
            void.mesh()
                .vertices()
                .iter()
                .map(move |p| (bits(p), VoidId::of(i)))
        })
        .collect()
}

pub(crate) fn bits(p: &Point) -> [u64; 3] {
    [p.x, p.y, p.z].map(f64::to_bits)
}

/// Returns the voids whose vertices the piece has, ascending.
fn voids_of(piece: &Piece, void_of: &HashMap<[u64; 3], VoidId>) -> Vec<VoidId> {
    let mut voids: Vec<VoidId> = piece
        .mesh
        .vertices()
        .iter()
        .filter_map(|p| void_of.get(&bits(p)).copied())
        .collect();
    voids.sort_unstable();
    voids.dedup();
    voids
}
