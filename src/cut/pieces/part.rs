//! The parts: the pieces of the cut body with pins and sockets, each a solid, laid for printing.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::{
    base::verdict::Verdict,
    cut::{
        error::{CutError, Obstacle, verdict},
        geometry::{chart::Chart, tree::CutTree},
        hollowed::Hollowed,
        ids::{PartId, VoidId},
        joints::{contact::refaced, label::Label, pin_shape::PinSite},
        pieces::{
            pose::{Pose, laid, sides_down},
            rejoin::rejoined,
            split::{Piece, check_no_cavity, piece_at, split},
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
    /// How it is laid in the printer.
    pub pose: Pose,
    /// The pins that stand out of it.
    pub pins: Vec<PinSite>,
    /// The pins of other parts that its sockets receive, and the dowels that stand in it, seen from
    /// the cut into this part.
    pub sockets: Vec<PinSite>,
    /// The ids sunk into its cut faces.
    pub labels: Vec<Label>,
    /// The voids that it holds a piece of, ascending.
    pub voids: Vec<VoidId>,
}

impl Part {
    /// What its pins add to the piece of the hollowed body, less what its sockets and labels take
    /// away, mm³.
    ///
    /// Summed over the parts and the hollowed body's volume, this is the volume of all parts to
    /// 1e-6 relative.
    pub fn added_volume_mm3(&self) -> f64 {
        let pins: f64 = self.pins.iter().map(PinSite::pin_volume_mm3).sum();
        let sockets: f64 = self.sockets.iter().map(PinSite::socket_volume_mm3).sum();
        let labels: f64 = self.labels.iter().map(Label::volume_mm3).sum();
        pins - sockets - labels
    }
}

/// The pieces that carry a pin and its socket.
struct SeatedPin<'a> {
    site: &'a PinSite,
    carrier: usize,
    receiver: usize,
    cut: usize,
}

/// The parts of the hollowed body cut by the plan: every part is closed, oriented and 2-manifold,
/// and encloses no cavity, unless the plan has no cuts at all.
///
/// The body may differ a little from the one the plan was made for, as when voids were solved for
/// again: cuts, pins and parts keep their names.
pub fn parts(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Verdict<Vec<Part>, Obstacle>, CutError> {
    let parts = parts_and_faces(hollowed, plan, request)?;
    Ok(parts.map(|(parts, _)| parts))
}

/// The parts, and the plan with the faces of its joints as they are in this body.
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
    let pieces = pieces(hollowed, plan, &tree)?;
    let maker = PartMaker {
        hollowed,
        plan,
        tree: &tree,
        request,
    };
    let parts = maker.parts(&pieces)?;
    Ok((parts, refaced(&pieces, &tree, plan.clone())))
}

/// The pieces that the plan leaves, none of which encloses a cavity where there are cuts.
pub(crate) fn pieces(
    hollowed: &Hollowed,
    plan: &CutPlan,
    tree: &CutTree,
) -> Result<Vec<Piece>, CutError> {
    let bridges = plan.bridges(&tree.planes);
    let pieces = rejoined(split(&hollowed.to_mesh(), tree)?, tree, &bridges)?;
    if !tree.planes.is_empty() {
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
    fn parts(&self, pieces: &[Piece]) -> Result<Vec<Part>, CutError> {
        let Self { plan, request, .. } = *self;
        let planes = &self.tree.planes;
        let seats = plan
            .pins
            .iter()
            .map(|pin| seat(plan, planes, pieces, pin))
            .collect::<Result<Vec<_>, _>>()?;
        let void_of = void_vertices(self.hollowed);
        let part = |(index, piece): (usize, &Piece)| {
            let carried = || seats.iter().filter(move |seat| seat.carrier == index);
            let received = || seats.iter().filter(move |seat| seat.receiver == index);
            let standing = carried().filter(|seat| seat.site.dowel.is_none());
            let pin_cuts: Vec<usize> = standing.map(|seat| seat.cut).collect();
            let is_printed = |seat: &&SeatedPin| seat.site.dowel.is_none();
            let pins: Vec<PinSite> = carried()
                .filter(is_printed)
                .map(|seat| seat.site.clone())
                .collect();
            let second = carried()
                .filter(|seat| !is_printed(seat))
                .map(|seat| seat.site.mirrored());
            let sockets: Vec<PinSite> = received()
                .map(|seat| seat.site.clone())
                .chain(second)
                .collect();
            let labels: Vec<Label> = plan
                .labels
                .iter()
                .filter(|label| label.part == PartId::of(index))
                .cloned()
                .collect();
            let solid = fitted(piece, (&pins, &sockets), &labels)?;
            Ok(Part {
                id: PartId::of(index),
                pose: laid(
                    solid.mesh(),
                    &sides_down(piece, planes, &pin_cuts, request),
                    request,
                ),
                solid,
                pins,
                sockets,
                labels,
                voids: voids_of(piece, &void_of),
            })
        };
        pieces.par_iter().enumerate().map(part).collect()
    }
}

/// Which pieces a pin joins.
fn seat<'a>(
    plan: &CutPlan,
    planes: &[Plane],
    pieces: &[Piece],
    site: &'a PinSite,
) -> Result<SeatedPin<'a>, CutError> {
    let lost = || Obstacle::PinOffFace {
        pin: site.id.clone(),
    };
    let cut = index_of(&plan.cuts, &site.cut).ok_or_else(lost)?;
    let at = Chart::of_plane(&planes[cut]).flat(&Point::from(site.center_mm));
    let is_upward = planes[cut].normal.dot(&Vector::from(site.direction)) > 0.0;
    let carrier = piece_at(pieces, cut, !is_upward, &at).ok_or_else(lost)?;
    let receiver = piece_at(pieces, cut, is_upward, &at).ok_or_else(lost)?;
    Ok(SeatedPin {
        site,
        carrier,
        receiver,
        cut,
    })
}

/// The piece with its pins united, and its sockets and labels taken away.
fn fitted(
    piece: &Piece,
    (pins, sockets): (&[PinSite], &[PinSite]),
    labels: &[Label],
) -> Result<Solid, CutError> {
    let mut body = Csg::of_mesh(&piece.mesh)?;
    for pin in pins {
        body = body.union(&Csg::of_mesh(&pin.pin_body())?)?;
    }
    for socket in sockets {
        body = body.subtract(&Csg::of_mesh(&socket.socket_body())?)?;
    }
    for label in labels {
        body = body.subtract(&Csg::of_mesh(&label.cutter())?)?;
    }
    without_short_edges(&body)
}

/// Edges shorter than this may vanish when a file stores coordinates in 32 bits, mm: at 100 mm
/// their step is 7.6e-6 mm, at 250 mm 1.5e-5 mm.
const SHORT_EDGE_MM: f64 = 3e-5;

/// The most that the removal of short edges may change a part's volume, relative to it: a tenth of
/// what the parts' sum is held to.
const VOLUME_CHANGE_RATIO: f64 = 1e-7;

/// The solid, freed of edges that would vanish in a file, if it has any and stays the same solid:
/// of the same volume, and not folded into itself.
fn without_short_edges(body: &Csg) -> Result<Solid, CutError> {
    let solid = body.to_solid()?;
    if !has_short_edge(solid.mesh()) {
        return Ok(solid);
    }
    let simple = body.simplify(SHORT_EDGE_MM).to_solid()?;
    let (before, after) = (
        solid.mesh().signed_volume_mm3(),
        simple.mesh().signed_volume_mm3(),
    );
    let is_same = (after - before).abs() <= VOLUME_CHANGE_RATIO * before
        && Crossings::of(simple.mesh()).pairs == 0;
    Ok(if is_same { simple } else { solid })
}

fn has_short_edge(mesh: &TriMesh) -> bool {
    mesh.iter_corners().any(|[a, b, c]| {
        [b - a, c - b, a - c]
            .iter()
            .any(|edge| edge.norm_squared() < SHORT_EDGE_MM * SHORT_EDGE_MM)
    })
}

/// Which void each vertex of a void belongs to, by the bits of its coordinates.
fn void_vertices(hollowed: &Hollowed) -> HashMap<[u64; 3], VoidId> {
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

fn bits(p: &Point) -> [u64; 3] {
    [p.x, p.y, p.z].map(f64::to_bits)
}

/// The voids whose vertices the piece has, ascending.
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
