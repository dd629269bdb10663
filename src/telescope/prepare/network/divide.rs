//! Junctures larger than the printer's room: divided by the planner of cuts, beside their sockets.

use super::super::error::TelescopeRunError;
use super::bodies::{CLEAR_RADII, ring};
use super::ends::{last, on_root};
use super::made::{Form, Workshop};
use super::tree::Tree;
use crate::base::verdict::Verdict;
use crate::cut::{
    CutPlan, GoalAxis, Hollowed, KeepWhole, Obstacle, Part, PlanRequest, PosePreference, SeamStyle,
    Seams, parts_and_faces, plan,
};
use crate::geom::{Frame, Point, Vector};
use crate::mesh::{Solid, TriMesh};
use crate::telescope::mount::ROOTED_RADII;
use crate::telescope::nest::Telescope;

/// Rings along a socket between which no cut goes.
const RINGS: usize = 8;
/// Depth below a root's tail that its socket takes, and length ahead of its mouth for its rim, mm.
const BEYOND_MM: f64 = 1.0;

/// Rooms for which cuts are planned, each less than the one before.
const TRIES: usize = 4;
/// The reason if the parts of no plan fit.
pub const NO_CUT: &str = "no cut beside its sockets makes it fit";

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
    /// parts have ids before. The answer is no if no cut beside its sockets and its peg does it.
    ///
    /// A solid that fits in a pose of the planner stays in one part.
    pub fn divide(
        &self,
        juncture: usize,
        solid: &Solid,
        numbered: usize,
    ) -> Result<Verdict<Divided, String>, TelescopeRunError> {
        let body = Hollowed::of_solid(solid)?;
        let mut request = self.request(juncture, solid.mesh(), numbered)?;
        let room_mm = request.build_volume_mm;
        let mut less_mm = 0.0;
        for _ in 0..TRIES {
            request.build_volume_mm = room_mm.map(|room| room.map(|side| side - less_mm));
            let plan = match planned(&body, &request)? {
                Verdict::Found(plan) => plan,
                Verdict::No(why) => return Ok(Verdict::No(first_clause(&why))),
            };
            request.build_volume_mm = room_mm;
            let is_whole = plan.cuts.is_empty();
            let found = match parts_and_faces(&body, &plan, &request)? {
                Verdict::Found((parts, plan)) => Divided { plan, parts },
                Verdict::No(why) => return Ok(Verdict::No(first_clause(&why))),
            };
            if found.fits() {
                return Ok(Verdict::Found(found));
            }
            // A part fits without its pins, but not with those on both its ends: it is planned for
            // less room, while that changes anything.
            let next_mm = 2.0 * found.longest_pin_mm();
            if is_whole || next_mm <= less_mm {
                break;
            }
            less_mm = next_mm;
        }
        Ok(Verdict::No(NO_CUT.to_owned()))
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
        let clear_radii = match self.workshop.form {
            Form::Balls | Form::Hulls => CLEAR_RADII,
            Form::Model(_) => 0.0,
        };
        let sockets = roots.map(|limb| around_socket(&limb.telescope, margin_mm, clear_radii));
        let carrier = limbs.iter().filter(|limb| limb.to == juncture);
        let pegs = carrier.map(|limb| around_peg(&limb.telescope, margin_mm));
        sockets.chain(pegs).map(KeepWhole::between).collect()
    }
}

impl Divided {
    fn fits(&self) -> bool {
        self.parts.iter().all(|part| part.pose.fits)
    }

    fn longest_pin_mm(&self) -> f64 {
        let lengths = self.plan.pins.iter().map(|pin| pin.length_mm);
        lengths.fold(0.0, f64::max)
    }
}

fn planned(
    body: &Hollowed,
    request: &PlanRequest,
) -> Result<Verdict<CutPlan, Obstacle>, TelescopeRunError> {
    // The way in which parts lie decides nothing about the cuts but their whole layers.
    let planned = PlanRequest {
        pose: PosePreference::CutFaceDown,
        ..request.clone()
    };
    Ok(plan(body, &planned)?)
}

/// Returns an obstacle without its remedy, which is for cuts that people order.
fn first_clause(why: &Obstacle) -> String {
    let why = why.to_string();
    why.split(';').next().unwrap_or(&why).to_owned()
}

/// Returns the lowest point of a mesh.
fn lowest(mesh: &TriMesh, up: &Vector) -> Point {
    let height = |p: &&Point| up.dot(&p.coords);
    let vertices = mesh.vertices().iter();
    let low = vertices.min_by(|a, b| height(a).total_cmp(&height(b)));
    low.copied().unwrap_or_else(Point::origin)
}

fn around_socket(telescope: &Telescope, margin_mm: f64, clear_radii: f64) -> Vec<Point> {
    let sizes = &telescope.sizes;
    let clear_mm = clear_radii * telescope.shells[0].body_mm;
    let radius_mm = telescope.shells[0].body_mm + sizes.glue_mm + sizes.groove_mm() + margin_mm;
    let [tail_mm, mouth_mm] = telescope.ends_mm();
    let from_mm = tail_mm - BEYOND_MM - margin_mm;
    // Balls and hulls are bored ahead of the mouth, for what comes out.
    let clear_mm = BEYOND_MM.max(clear_mm);
    let span_mm = mouth_mm + clear_mm - from_mm;
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
