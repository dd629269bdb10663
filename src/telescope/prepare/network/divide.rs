//! Junctures larger than the printer's room: divided by the planner of cuts, beside their sockets.

use super::super::error::TelescopeRunError;
use super::bodies::ring;
use super::ends::{last, on_root};
use super::made::Workshop;
use super::tree::Tree;
use crate::base::verdict::Verdict;
use crate::cut::{
    CutPlan, GoalAxis, Hollowed, KeepWhole, Part, PlanRequest, PosePreference, SeamStyle, Seams,
    parts_and_faces, plan,
};
use crate::geom::{Frame, Point, Vector};
use crate::mesh::{Solid, TriMesh};
use crate::telescope::mount::ROOTED_RADII;
use crate::telescope::nest::Telescope;

/// Rings along a socket between which no cut goes.
const RINGS: usize = 8;
/// Depth below a root's tail that its socket takes, and length ahead of its mouth for its rim, mm.
const BEYOND_MM: f64 = 1.0;

/// A juncture in several parts.
pub struct Divided {
    pub plan: CutPlan,
    pub parts: Vec<Part>,
}

/// The divider of junctures.
pub struct Divider<'a> {
    pub workshop: &'a Workshop<'a>,
    pub tree: &'a Tree<'a>,
}

impl Divider<'_> {
    /// Divides the solid of a juncture, counted from 0, into parts that fit the printer. `numbered`
    /// parts have ids before. `None` if no cut beside its sockets and its peg does it.
    ///
    /// A solid that fits in a pose of the planner stays in one part.
    pub fn divide(
        &self,
        juncture: usize,
        solid: &Solid,
        numbered: usize,
    ) -> Result<Option<Divided>, TelescopeRunError> {
        let body = Hollowed::of_solid(solid)?;
        let mut request = self.request(juncture, solid.mesh(), numbered)?;
        let Some(first) = divided(&body, &request)? else {
            return Ok(None);
        };
        if first.fits() {
            return Ok(Some(first));
        }
        // A part fits without its pins, but not with them: it is planned for less room.
        let lengths = first.plan.pins.iter().map(|pin| pin.length_mm);
        let longest_mm = lengths.fold(0.0, f64::max);
        request.build_volume_mm = request
            .build_volume_mm
            .map(|room| room.map(|side| side - longest_mm));
        let second = divided(&body, &request)?;
        request.build_volume_mm = self.workshop.shop.printer.usable_volume_mm();
        let Some(Divided { plan, .. }) = second else {
            return Ok(None);
        };
        let again = made(&body, plan, &request)?;
        Ok(again.filter(Divided::fits))
    }

    fn request(
        &self,
        juncture: usize,
        mesh: &TriMesh,
        numbered: usize,
    ) -> Result<PlanRequest, TelescopeRunError> {
        let Workshop {
            shop,
            loaded,
            watch,
            ..
        } = self.workshop;
        let up = loaded.up;
        let axis = GoalAxis {
            point: lowest(mesh, &up),
            direction: up,
        };
        let mut request = PlanRequest::for_printer(&shop.printer, loaded.longest_mm, axis);
        request.seams = Seams {
            keep_whole: self.regions(juncture, request.wall_mm + request.layer_mm),
            ..Seams::look(SeamStyle::Hidden, mesh, &up, watch)?
        };
        if let Some(labels) = &mut request.labels {
            labels.numbered = numbered;
        }
        request.watch = (*watch).clone();
        Ok(request)
    }

    /// Returns the regions that no cut enters, with a margin: the sockets of roots with their rims,
    /// and the peg with its seat.
    fn regions(&self, juncture: usize, margin_mm: f64) -> Vec<KeepWhole> {
        let limbs = &self.tree.network.limbs;
        let roots = limbs.iter().filter(|limb| limb.from == juncture);
        let sockets = roots.map(|limb| around_socket(&limb.telescope, margin_mm));
        let carrier = limbs.iter().filter(|limb| limb.to == juncture);
        let pegs = carrier.map(|limb| around_peg(&limb.telescope, margin_mm));
        sockets.chain(pegs).map(KeepWhole::between).collect()
    }
}

impl Divided {
    fn fits(&self) -> bool {
        self.parts.iter().all(|part| part.pose.fits)
    }
}

/// Plans the cuts of a body and makes its parts; `None` if the planner finds no way.
fn divided(body: &Hollowed, request: &PlanRequest) -> Result<Option<Divided>, TelescopeRunError> {
    // The way in which parts lie decides nothing about the cuts but their whole layers.
    let planned = PlanRequest {
        pose: PosePreference::CutFaceDown,
        ..request.clone()
    };
    match plan(body, &planned)? {
        Verdict::Found(plan) => made(body, plan, request),
        Verdict::No(_) => Ok(None),
    }
}

fn made(
    body: &Hollowed,
    plan: CutPlan,
    request: &PlanRequest,
) -> Result<Option<Divided>, TelescopeRunError> {
    match parts_and_faces(body, &plan, request)? {
        Verdict::Found((parts, plan)) => Ok(Some(Divided { plan, parts })),
        Verdict::No(_) => Ok(None),
    }
}

/// Returns the lowest point of a mesh.
fn lowest(mesh: &TriMesh, up: &Vector) -> Point {
    let height = |p: &&Point| up.dot(&p.coords);
    let vertices = mesh.vertices().iter();
    let low = vertices.min_by(|a, b| height(a).total_cmp(&height(b)));
    low.copied().unwrap_or_else(Point::origin)
}

fn around_socket(telescope: &Telescope, margin_mm: f64) -> Vec<Point> {
    let sizes = &telescope.sizes;
    let radius_mm = telescope.shells[0].body_mm + sizes.glue_mm + sizes.groove_mm() + margin_mm;
    let [tail_mm, mouth_mm] = telescope.ends_mm();
    let from_mm = tail_mm - BEYOND_MM - margin_mm;
    let span_mm = mouth_mm + BEYOND_MM - from_mm;
    let rings = (0..=RINGS).flat_map(|i| {
        let arc_mm = from_mm + span_mm * i as f64 / RINGS as f64;
        ring(&on_root(telescope, arc_mm), radius_mm)
    });
    rings.collect()
}

fn around_peg(telescope: &Telescope, margin_mm: f64) -> Vec<Point> {
    let (_, mouth) = last(telescope);
    let radius_mm = telescope.shells[telescope.shells.len() - 1].body_mm;
    let along: Vector = mouth.axes.column(0).into();
    let behind_mm = -(telescope.sizes.spigot_mm + margin_mm);
    let ends_mm = [behind_mm, ROOTED_RADII * radius_mm + margin_mm];
    let rings = ends_mm.into_iter().flat_map(|way_mm| {
        let frame = Frame {
            origin: mouth.origin + along * way_mm,
            ..mouth
        };
        ring(&frame, radius_mm + margin_mm)
    });
    rings.collect()
}
