//! Facts about drain holes: what the body must look like with them, and how free each is in the
//! written part.

use rayon::prelude::*;
use serde::Serialize;

use super::cover::{Lie, Sheet, Sheets, Whose};
use super::part_probe::PartProbe;
use super::plugs::{MeantPlug, meant_plugs};
use super::{Body, Promise, PromisedHole, VoidFacts};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point};
use crate::mesh::{Csg, TriMesh, area_mm2};

/// Number of steps along a bore at which its room is measured: a tenth of a millimetre through
/// common walls.
const STEPS: usize = 64;
/// The longest of these steps, mm, and the most of them: a kit may state a hole of any length.
const STEP_MM: f64 = 0.1;
const MOST_STEPS: f64 = 20_000.0;

/// A drain hole as it was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HoleFacts {
    /// The name on the sheet, such as `D1`.
    pub id: String,
    /// The name of the void that it leads to from the open; `None` if it does not.
    pub void: Option<String>,
    /// The stated free diameter, mm.
    pub diameter_mm: f64,
    /// The diameter of the widest ball that passes along its axis, mm; 0 if it is closed.
    pub free_mm: f64,
    /// True if it has a name of its own, and no hole before it takes the same place.
    pub is_apart: bool,
}

/// The uncut result with its holes.
#[derive(Debug, Clone)]
pub(super) struct Bored {
    /// The triangles of the outside.
    pub(super) outer: Vec<[Point; 3]>,
    /// The triangles of the voids.
    pub(super) inner: Vec<[Point; 3]>,
    /// The walls of the holes.
    pub(super) walls: Vec<[Point; 3]>,
    /// The volume that each hole takes beyond those before it, mm³.
    pub(super) taken_mm3: Vec<f64>,
    /// The stated plugs as they should be, in the order of their holes.
    pub(super) plugs: Vec<MeantPlug>,
}

impl Bored {
    /// Bores the promised holes into an uncut result. `None` without holes, or if the body or a
    /// hole bounds nothing: then every hole in a part is too much.
    pub(super) fn of(promise: &Promise, body: &Body) -> Option<Self> {
        if promise.drains.is_empty() {
            return None;
        }
        let whole = Csg::of_mesh(&body.welded).ok()?;
        let mut bored = Csg::of_mesh(&body.welded).ok()?;
        let mut mesh = body.welded.clone();
        let mut taken_mm3 = Vec::new();
        for hole in &promise.drains {
            bored = bored.subtract(&hole.prism()?).ok()?;
            let before_mm3 = mesh.signed_volume_mm3();
            mesh = bored.to_mesh().ok()?;
            taken_mm3.push(before_mm3 - mesh.signed_volume_mm3());
        }
        let divided = Self::divide(&mesh, body);
        Some(Self {
            taken_mm3,
            plugs: meant_plugs(promise, body, &whole),
            ..divided
        })
    }

    /// Divides the surface of a bored body by what each triangle lies on.
    fn divide(bored: &TriMesh, body: &Body) -> Self {
        let outside = body.outer.iter_corners();
        let of_outer = outside.len() as u32;
        let inner = body.shells.inner_mesh();
        let known = outside.chain(inner.iter_corners());
        let sheet = |corners| Sheet {
            corners,
            whose: Whose::Any,
        };
        let known = Sheets::new(known.map(sheet).collect());
        let corners: Vec<[Point; 3]> = bored.iter_corners().collect();
        let lies: Vec<Lie> = corners.par_iter().map(|c| known.lie(c, None)).collect();
        let mut parts = Self {
            outer: Vec::new(),
            inner: Vec::new(),
            walls: Vec::new(),
            taken_mm3: Vec::new(),
            plugs: Vec::new(),
        };
        for (corners, lie) in corners.into_iter().zip(lies) {
            match lie {
                Lie::On(sheet) if sheet < of_outer => parts.outer.push(corners),
                Lie::On(_) => parts.inner.push(corners),
                Lie::Off(_) => parts.walls.push(corners),
            }
        }
        parts
    }
}

/// Measures the promised holes on the parts without plugs, in their order.
pub(super) fn measure_holes(
    promise: &Promise,
    body: &Body,
    probes: &[PartProbe],
    watch: &Watch,
) -> Result<Vec<HoleFacts>, Cancelled> {
    let measure = |(index, hole): (usize, &PromisedHole)| {
        watch.check()?;
        let before = &promise.drains[..index];
        Ok(HoleFacts {
            is_apart: before.iter().all(|other| lie_apart(hole, other)),
            id: hole.id.clone(),
            void: leads_to(hole, promise, body).then(|| hole.void.clone()),
            diameter_mm: hole.diameter_mm,
            free_mm: free_mm(hole, probes),
        })
    };
    promise.drains.iter().enumerate().map(measure).collect()
}

/// Returns the number of steps along a bore.
fn steps(from: &Point, to: &Point) -> usize {
    let fine = ((to - from).norm() / STEP_MM).ceil().min(MOST_STEPS);
    STEPS.max(fine as usize)
}

/// Returns whether two holes have names of their own, and their bores do not meet.
fn lie_apart(one: &PromisedHole, other: &PromisedHole) -> bool {
    let ends = |hole: &PromisedHole| [hole.from_mm, hole.to_mm].map(Point::from);
    let ([from, to], [start, end]) = (ends(one), ends(other));
    let along = end - start;
    let length2 = along.norm_squared().max(f64::MIN_POSITIVE);
    let steps = steps(&from, &to);
    let off_mm = |step: usize| {
        let at = from + (to - from) * (step as f64 / steps as f64);
        let share = ((at - start).dot(&along) / length2).clamp(0.0, 1.0);
        (at - start - along * share).norm()
    };
    let least_mm = (0..=steps).map(off_mm).fold(f64::INFINITY, f64::min);
    one.id != other.id && least_mm >= 0.5 * (one.widest_mm() + other.widest_mm())
}

/// Returns whether a hole begins in the open and ends in its void.
fn leads_to(hole: &PromisedHole, promise: &Promise, body: &Body) -> bool {
    let mut voids = promise.voids.iter();
    let void = voids.position(|void| void.id == hole.void);
    let Some(shell) = void.and_then(|void| body.shells.inward.get(void)) else {
        return false;
    };
    let is_open = body.outside.winding(&Point::from(hole.from_mm)) == 0;
    let shell = Bvh::new(shell.iter_corners());
    is_open && shell.winding(&Point::from(hole.to_mm)) != 0
}

/// Returns the diameter of the widest ball that passes a hole along its axis, mm.
fn free_mm(hole: &PromisedHole, probes: &[PartProbe]) -> f64 {
    if probes.is_empty() {
        return 0.0;
    }
    let (from, to) = (Point::from(hole.from_mm), Point::from(hole.to_mm));
    let is_clear = probes
        .iter()
        .all(|probe| probe.is_clear(&from, &to) && !probe.contains(&from));
    if !is_clear {
        return 0.0;
    }
    let steps = steps(&from, &to);
    let room_mm = |step: usize| {
        let at = from + (to - from) * (step as f64 / steps as f64);
        let rooms = probes.iter().filter_map(|probe| probe.distance_mm(&at));
        rooms.fold(f64::INFINITY, f64::min)
    };
    2.0 * (0..=steps).map(room_mm).fold(f64::INFINITY, f64::min)
}

/// States the openings of the voids that are drained, and the share of their walls within reach of
/// the holes.
pub(super) fn open_through_holes(
    voids: &mut [VoidFacts],
    promise: &Promise,
    body: &Body,
    holes: &[HoleFacts],
) {
    // Holes say nothing of a wall that must be seen.
    let cleaning = promise.printer.cleaning;
    if cleaning.is_some_and(|cleaning| !promise.can_drain(&cleaning)) {
        return;
    }
    let reach_mm = cleaning.and_then(|cleaning| cleaning.reach_mm);
    for (index, void) in voids.iter_mut().enumerate() {
        let of_void = |hole: &&PromisedHole| hole.void == void.id;
        if !promise.drains.iter().any(|hole| of_void(&hole)) {
            continue;
        }
        let leading = holes.iter().zip(&promise.drains);
        let leading = leading.filter(|(found, _)| found.void.as_deref() == Some(&void.id));
        let open = leading.filter(|(found, _)| found.free_mm > 0.0);
        let (mut widths_mm, mut ends) = (Vec::new(), Vec::new());
        for (found, hole) in open {
            widths_mm.push(found.free_mm);
            ends.push(Point::from(hole.to_mm));
        }
        widths_mm.sort_by(|a, b| b.total_cmp(a));
        void.openings_mm = vec![widths_mm];
        let wall = body.shells.inward.get(index);
        let share = wall.map(|wall| share_within(wall, &ends, reach_mm));
        void.sight_ratio = share.unwrap_or(0.0);
        void.clean_ratio = void.sight_ratio;
    }
}

/// Returns the share of a wall that is no farther from the ends of holes than a tool reaches. It is
/// all of the wall if there is no such limit, and none without a hole.
fn share_within(wall: &TriMesh, ends: &[Point], reach_mm: Option<f64>) -> f64 {
    let reach_mm = reach_mm.unwrap_or(f64::INFINITY);
    let (mut near_mm2, mut all_mm2) = (0.0, 0.0);
    for corners in wall.iter_corners() {
        let area = area_mm2(&corners);
        let is_near = |end: &Point| corners.iter().all(|p| (p - end).norm() <= reach_mm);
        all_mm2 += area;
        near_mm2 += if ends.iter().any(is_near) { area } else { 0.0 };
    }
    near_mm2 / f64::max(all_mm2, f64::MIN_POSITIVE)
}
