//! The search for the outlines of a jig: which way out, which ribs and how high its cheeks.

use rayon::prelude::*;

use super::body_points::points_in_sections;
use super::cradle::{SPARE_MM, Slab, View};
use super::sketch::{Held, Sketch, range};
use super::stand::{REACH_MM, Stand, heights_of};
use super::stops::{Sides, all_stops_at};
use crate::{
    base::watch::Cancelled,
    cut::{
        geometry::chart::{Chart, Point2},
        pieces::split::Joint,
        request::PlanRequest,
    },
    geom::{
        Plane, Point,
        play::{Spot, Stop, Way, corners_of},
    },
    mesh::{TriMesh, nearest_shell},
};

/// Room on either side of a seam, for a finger with a cloth to wipe off glue, mm.
pub const WIPING_ROOM_MM: f64 = 4.0;

/// Distances of the ribs' faces from the joint, mm: the ribs do not bend.
const RIBS_MM: [f64; 2] = [WIPING_ROOM_MM, WIPING_ROOM_MM + 4.0];

/// More ribs, for joints that the usual ones do not hold: thicker ones, and ones farther away. Long
/// ones stop the turn of a round arm that leaves its joint at a slant.
const EXTRA_RIBS_MM: [[f64; 2]; 4] = [
    RIBS_MM,
    [WIPING_ROOM_MM, WIPING_ROOM_MM + 6.0],
    [2.0 * WIPING_ROOM_MM, 2.0 * WIPING_ROOM_MM + 6.0],
    [WIPING_ROOM_MM, WIPING_ROOM_MM + 12.0],
];

/// Width of a rib beside the body, mm.
const CHEEK_MM: f64 = 4.0;

/// Thickness of the plate that joins the ribs, mm.
const PLATE_MM: f64 = 3.0;

/// Depth to which a part is pressed into its cradle, but for this, mm: what dust and friction keep.
pub const PRESSED_MM: f64 = 0.03;

/// Directions in a joint's plane that are tried as the way out.
const WAYS_OUT: usize = 36;

/// Heights of the cradle's cheeks, as shares of the joint's height along the way out.
const CHEEKS: &[f64] = &[0.5, 0.75];

/// More heights, for joints that the usual ones do not hold.
const EXTRA_CHEEKS: &[f64] = &[0.3, 0.45, 0.6, 0.75, 0.9];

/// Number of the best ways out about which jigs for such joints are sought.
const BEST_WAYS: usize = 4;

/// Ways out between two others, about the best ones.
const WAYS_BETWEEN: [f64; 3] = [-0.5, 0.0, 0.5];

/// Step of the best usual jig, as a ratio to the accepted one, beyond which there is no hope.
const HOPE_RATIO: f64 = 2.5;

/// Slopes of a cradle below which its floor is lowered, so that the body stands on its cheeks.
const RELIEFS: [f64; 4] = [0.0, 0.35, 0.7, 1.2];

/// Share of the accepted step that is kept in reserve: a judge measures the cradle by other points.
/// On the arms of humpty, at 100 mm on Objet, the two differ by less than 0.1 %.
const RESERVE_RATIO: f64 = 0.05;

/// Share of the accepted step below which a smaller jig is better than a tighter one.
const TIGHT_RATIO: f64 = 0.6;

/// Sketches whose play is measured at once: a fixed number, as the answer must not depend on the
/// threads. Fewer leave threads idle, more are measured in vain.
const BATCH: usize = 16;

/// A joint for which jigs are tried.
pub(super) struct Bench<'a> {
    /// The triangles of the outside that the ribs may touch.
    outside: Vec<[Point; 3]>,
    pub(super) plane: &'a Plane,
    /// The corners of the joint's rim.
    rim: Vec<Point>,
    pub(super) request: &'a PlanRequest,
}

/// A sketch before its play is measured.
struct Trial {
    /// The index of its stand.
    stand: usize,
    sketch: Sketch,
    volume_mm3: f64,
}

impl<'a> Bench<'a> {
    /// Sets up a joint of one of some separate bodies. The others, such as the other half of a
    /// yo-yo, are not there while its glue sets.
    pub(super) fn new(
        bodies: &[TriMesh],
        plane: &'a Plane,
        joint: &Joint,
        request: &'a PlanRequest,
    ) -> Self {
        let chart = Chart::of_plane(plane);
        let rim: Vec<Point2> =
            corners_of(joint.faces.iter().flat_map(|face| face.outline.corners()));
        let rim: Vec<Point> = rim.iter().map(|corner| chart.lift(plane, corner)).collect();
        let [.., [_, farthest_mm]] = EXTRA_RIBS_MM;
        let reach_mm = farthest_mm + request.pins.snug_gap_mm;
        let is_near = |corners: &[Point; 3]| {
            let heights = corners.each_ref().map(|p| plane.distance(p));
            let [low, high] = range(heights.into_iter());
            low <= reach_mm && high >= -reach_mm
        };
        Self {
            outside: nearest_shell(bodies, &rim)
                .into_iter()
                .flat_map(TriMesh::iter_corners)
                .filter(is_near)
                .collect(),
            plane,
            rim,
            request,
        }
    }

    /// Returns the numbers that its jigs depend on.
    fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        let corners = self.outside.iter().flatten().chain(&self.rim);
        let corners = corners.flat_map(|p| p.coords.iter().copied().collect::<Vec<f64>>());
        let Plane { normal, offset_mm } = self.plane;
        let plane = [normal.x, normal.y, normal.z, *offset_mm];
        let room = self.request.build_volume_mm;
        let room = room.unwrap_or([f64::INFINITY; 3]);
        let rules = [self.request.pins.snug_gap_mm, self.max_step_mm()];
        plane.into_iter().chain(room).chain(rules).chain(corners)
    }

    /// Returns the smallest jig that holds the parts tightly, else the tightest that holds them as
    /// well as is asked for; `None` if none does.
    pub(super) fn best(&self) -> Result<Option<Held>, Cancelled> {
        self.request.jigs.keep(self.numbers(), || self.find_best())
    }

    fn find_best(&self) -> Result<Option<Held>, Cancelled> {
        let ways: Vec<f64> = (0..WAYS_OUT).map(|way| way as f64).collect();
        let usual = self.try_along(&ways, &[RIBS_MM], CHEEKS)?;
        let mut tightest: Vec<(f64, f64)> = (ways.iter().zip(&usual))
            .filter_map(|(way, found)| Some((least_step_mm(found)?, *way)))
            .filter(|(step_mm, _)| *step_mm <= HOPE_RATIO * self.max_step_mm())
            .collect();
        let usual = self.choose(usual)?;
        if usual.is_some() {
            return Ok(usual);
        }
        tightest.sort_by(|a, b| a.0.total_cmp(&b.0));
        let best: Vec<f64> = tightest
            .iter()
            .take(BEST_WAYS)
            .map(|(_, way)| *way)
            .collect();
        let extra = self.try_along(&best, &EXTRA_RIBS_MM, CHEEKS)?;
        let extra = self.choose(extra)?;
        if extra.is_some() {
            return Ok(extra);
        }
        let between = best
            .iter()
            .flat_map(|way| WAYS_BETWEEN.map(|between| way + between));
        let between: Vec<f64> = between.collect();
        let last = self.try_along(&between, &EXTRA_RIBS_MM, EXTRA_CHEEKS)?;
        self.choose(last)
    }

    /// Returns the step that a jig may leave, mm.
    fn max_step_mm(&self) -> f64 {
        self.request.pins.max_step_mm.unwrap_or(f64::INFINITY) * (1.0 - RESERVE_RATIO)
    }

    /// Returns the step below which a smaller jig is better than a tighter one, mm.
    fn tight_mm(&self) -> f64 {
        TIGHT_RATIO * self.max_step_mm()
    }

    /// Returns the jigs along each of some ways out that hold both parts.
    ///
    /// Their play is measured from the smallest on, and no more after one that holds tightly: all
    /// that follow are larger.
    fn try_along(
        &self,
        ways: &[f64],
        ribs: &[[f64; 2]],
        cheeks: &[f64],
    ) -> Result<Vec<Vec<Held>>, Cancelled> {
        let stands = self.stands(ways, ribs)?;
        let sketched = stands.par_iter().enumerate().map(|(index, stand)| {
            self.request.watch.check()?;
            Ok(self.sketch(index, stand, cheeks))
        });
        let trials = sketched.collect::<Result<Vec<Vec<Trial>>, Cancelled>>()?;
        let mut trials: Vec<Trial> = trials.into_iter().flatten().collect();
        // The order of equal ones is kept.
        trials.sort_by(|a, b| a.volume_mm3.total_cmp(&b.volume_mm3));
        let mut found: Vec<Vec<Held>> = ways.iter().map(|_| Vec::new()).collect();
        for batch in trials.chunks(BATCH) {
            self.request.watch.check()?;
            let held = batch.par_iter().map(|trial| {
                let held = stands[trial.stand].hold_roughly(&trial.sketch);
                (trial.stand / ribs.len(), held)
            });
            let held: Vec<(usize, Option<Held>)> = held.collect();
            let is_tight = |held: &Held| held.play.step_mm <= self.tight_mm();
            let ends = held
                .iter()
                .any(|(_, held)| held.as_ref().is_some_and(is_tight));
            held.into_iter()
                .for_each(|(way, held)| found[way].extend(held));
            if ends {
                break;
            }
        }
        Ok(found)
    }

    /// Returns the body over each of some ribs along each of some ways out, in this order.
    fn stands(&self, ways: &[f64], ribs: &[[f64; 2]]) -> Result<Vec<Stand>, Cancelled> {
        let (u, v) = self.plane.basis();
        let along = |way: &f64| {
            let (sin, cos) = (std::f64::consts::TAU * way / WAYS_OUT as f64).sin_cos();
            let view = View::new(self.plane, u * cos + v * sin);
            let mut stands = Vec::new();
            for ribs_mm in ribs {
                self.request.watch.check()?;
                stands.push(self.stand(view, *ribs_mm));
            }
            Ok(stands)
        };
        let stands = ways.par_iter().map(along);
        let stands = stands.collect::<Result<Vec<Vec<Stand>>, Cancelled>>()?;
        Ok(stands.into_iter().flatten().collect())
    }

    fn stand(&self, view: View, [near, far]: [f64; 2]) -> Stand {
        let gap_mm = self.request.pins.snug_gap_mm;
        let rim: Vec<Spot> = self.rim.iter().map(|p| flat(&view.local(p))).collect();
        let [left, right] = range(rim.iter().map(|spot| spot.x));
        let [low, high] = range(rim.iter().map(|spot| spot.y));
        let beside_mm = gap_mm + CHEEK_MM;
        let window = [left - beside_mm, right + beside_mm];
        let surface = self.surface(&view);
        // What is beyond a rib's face is no nearer to it than the gap.
        let cradles = [
            [-far - gap_mm, gap_mm - near],
            [near - gap_mm, far + gap_mm],
        ]
        .map(|heights| Slab::of(&surface, heights).cradle(window, gap_mm));
        let points = |side: usize| {
            let heights = heights_of([near, far])[side];
            // No outline is higher than this one.
            let highest = cradles[side].outline(high, 0.0);
            let highest = Sides::of(&highest, REACH_MM + SPARE_MM);
            let points = Slab::of(&surface, heights);
            points.points().filter(|at| highest.is_near(at)).collect()
        };
        let press = Stop {
            at: Spot::new(0.5 * (left + right), high),
            normal: Way::new(0.0, -1.0),
            room_mm: PRESSED_MM,
        };
        Stand {
            view,
            ribs_mm: [near, far],
            rim,
            heights: [low, high],
            points: [0, 1].map(points),
            cradles,
            under_seam_mm: Slab::of(&surface, [-near, near]).lowest_mm(window),
            middle: Spot::new(press.at.x, 0.5 * (low + high)),
            press,
        }
    }

    /// Returns sketches of jigs with cheeks of some heights that fit the printer.
    fn sketch(&self, index: usize, stand: &Stand, cheeks: &[f64]) -> Vec<Trial> {
        let [low, high] = stand.heights;
        let sketch = |(share, slope): (f64, f64)| {
            let top_mm = low + share * (high - low);
            let cradles = stand.cradles.each_ref();
            let ribs = cradles.map(|cradle| cradle.outline(top_mm, slope));
            let deepest = ribs.iter().flatten().map(|corner| corner.y);
            let top = deepest.fold(stand.under_seam_mm - WIPING_ROOM_MM, f64::min);
            let sketch = Sketch {
                view: stand.view,
                ribs_mm: stand.ribs_mm,
                plate: [top - PLATE_MM, top],
                ribs,
            };
            self.fits(&sketch).then(|| Trial {
                stand: index,
                volume_mm3: sketch.volume_mm3(),
                sketch,
            })
        };
        let kinds = cheeks
            .iter()
            .flat_map(|share| RELIEFS.map(|slope| (*share, slope)));
        kinds.filter_map(sketch).collect()
    }

    /// Returns the best of some jigs that hold the parts as well as is asked for.
    ///
    /// Their play is measured again, as closely as a judge looks at the body.
    fn choose(&self, held: Vec<Vec<Held>>) -> Result<Option<Held>, Cancelled> {
        let is_enough = |held: &Held| held.play.step_mm <= self.max_step_mm();
        let mut held: Vec<Held> = held.into_iter().flatten().filter(is_enough).collect();
        held.sort_by(|a, b| a.compare(b, self.tight_mm()));
        for held in held {
            self.request.watch.check()?;
            let closely = self.hold_closely(&held.sketch).filter(is_enough);
            if closely.is_some() {
                return Ok(closely);
            }
        }
        Ok(None)
    }

    /// Measures the play of the parts in a jig by more points of the body, and by all their stops.
    fn hold_closely(&self, sketch: &Sketch) -> Option<Held> {
        let stand = self.stand(sketch.view, sketch.ribs_mm);
        let surface = self.surface(&sketch.view);
        let heights = heights_of(sketch.ribs_mm);
        stand.hold(sketch, |side| {
            let mut points = points_in_sections(&surface, heights[side]);
            points.extend(&stand.points[side]);
            all_stops_at(&points, &sketch.ribs[side], REACH_MM)
        })
    }

    /// Returns the outside near the joint in a view.
    fn surface(&self, view: &View) -> Vec<[Point; 3]> {
        let local = |corners: &[Point; 3]| corners.each_ref().map(|p| view.local(p));
        self.outside.iter().map(local).collect()
    }

    /// Returns true if a jig fits the printer, lying or turned by a right angle.
    fn fits(&self, sketch: &Sketch) -> bool {
        let corners = || sketch.ribs.iter().flatten();
        let [low, high] = range(corners().map(|corner| corner.x));
        let [_, top] = range(corners().map(|corner| corner.y));
        let size = [high - low, 2.0 * sketch.ribs_mm[1], top - sketch.plate[0]];
        let Some(room) = self.request.build_volume_mm else {
            return true;
        };
        let holds = |x: f64, y: f64| size[0] <= x && size[1] <= y;
        size[2] <= room[2] && (holds(room[0], room[1]) || holds(room[1], room[0]))
    }
}

/// Returns the least step of some jigs, mm.
fn least_step_mm(held: &[Held]) -> Option<f64> {
    let steps = held.iter().map(|held| held.play.step_mm);
    steps.min_by(f64::total_cmp)
}

fn flat(p: &Point) -> Spot {
    Spot::new(p.x, p.z)
}
