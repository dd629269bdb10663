//! The test of a place for a hole: it must go straight through one wall into one void, and both
//! its ends must be free.

use std::f64::consts::TAU;

use crate::{
    cut::{
        drains::hole::DrainHole, hollowed::Hollowed, request::PlanRequest, seam::clear::KeepClear,
    },
    geom::{Bvh, Point, Vector, hull::convex_hull, orthonormal_basis},
    mesh::TriMesh,
};

/// Lines around a hole along which the wall is felt, on its own rim and outside of it.
const AROUND: usize = 12;
/// Distance of the outer ring of lines from the rim, in walls. The wall beside the hole must be a
/// wall, too: nearer to an edge of the body a hole leaves a sliver.
const RIM_WALLS: f64 = 1.0;
/// Length by which a bore goes beyond the body at either end, mm. Voids that are solved for again
/// move by micrometres; coinciding faces would fail.
pub(super) const OVER_MM: f64 = 0.3;
/// Room before a hole, in diameters: a nozzle or a wire gets in straight.
const ROOM_DIAMETERS: f64 = 2.0;
/// Depth of the void behind a hole, in diameters: with less, the far wall is a lid on it.
const DEPTH_DIAMETERS: f64 = 0.75;
/// Greatest difference of the outside's height about a hole, in its radii: 0.6 is a ball of 1.7
/// times the hole's diameter. On sharper curves the mouth is an oval.
const STEP_RADII: f64 = 0.6;
/// Radius about the contact of a top or yo-yo that stays whole, in hole diameters.
const CONTACT_DIAMETERS: f64 = 2.0;
/// Length of a foot that stands on its edge, over that radius: its middle may have a hole.
const WIDE_FOOT: f64 = 2.0;
/// Height over the lowest point, in heights of the body, up to which it may touch the floor.
const FLOOR_RATIO: f64 = 0.002;

/// A place at which a hole can be bored.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site {
    /// The middle of its mouth in the outside.
    pub(super) at: Point,
    /// The unit direction into the body.
    pub(super) axis: Vector,
    /// The outer and inner end of the bore.
    pub(super) ends: [Point; 2],
    /// The thickest place of the wall along it, mm.
    pub(super) wall_mm: f64,
    /// The difference of the outside's height about it, over its radius.
    pub(super) step_ratio: f64,
}

/// The surfaces of a body, ready to be felt.
pub(super) struct Surfaces<'a> {
    outside: Bvh,
    voids: Vec<&'a Bvh>,
    floor: Floor,
    keep_clear: &'a [KeepClear],
    contact: Point,
    wall_mm: f64,
    diameter_mm: f64,
}

/// The surfaces that a line through a wall meets, mm from the foot of the line.
#[derive(Clone, Copy)]
struct Felt {
    outside_mm: f64,
    void_mm: f64,
}

impl<'a> Surfaces<'a> {
    /// Gets the surfaces of a body ready for holes of this diameter in the outside, mm.
    pub(super) fn new(hollowed: &'a Hollowed, request: &'a PlanRequest, diameter_mm: f64) -> Self {
        let outer = hollowed.outer.mesh();
        Self {
            outside: Bvh::new(outer.iter_corners()),
            voids: hollowed.voids.iter().map(|void| void.body.bvh()).collect(),
            floor: Floor::under(outer, &request.axis.direction.normalize()),
            keep_clear: &request.seams.keep_clear,
            contact: request.axis.point,
            wall_mm: request.wall_mm,
            diameter_mm,
        }
    }

    /// Returns the hole from the outside to a point on the wall of a void, through at most so many
    /// walls; `None` if none can be bored.
    pub(super) fn site(&self, void: usize, inside: &Point, most_walls: f64) -> Option<Site> {
        let most_mm = most_walls * self.wall_mm;
        let nearest = self.outside.closest(inside, most_mm, &[])?;
        let axis = (inside - nearest.point).try_normalize(f64::EPSILON)?;
        let at = nearest.point;
        let radius_mm = DrainHole::corner_mm(self.diameter_mm);
        let rim_mm = radius_mm + RIM_WALLS * self.wall_mm;
        if !self.is_allowed(&at, rim_mm) {
            return None;
        }
        let lines = self.lines(&at, &axis, [radius_mm, rim_mm]);
        let felt = lines.map(|foot| self.feel(void, &foot, &axis, most_mm));
        let felt: Vec<Felt> = felt.collect::<Option<_>>()?;
        let least = |of: fn(&Felt) -> f64| felt.iter().map(of).fold(f64::INFINITY, f64::min);
        let most = |of: fn(&Felt) -> f64| felt.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let (near_mm, far_mm) = (least(|line| line.outside_mm), most(|line| line.void_mm));
        let step_ratio = (most(|line| line.outside_mm) - near_mm) / rim_mm;
        let wall_mm = most(|line| line.void_mm - line.outside_mm);
        let end_mm = far_mm + OVER_MM;
        let deep_mm = DEPTH_DIAMETERS * self.diameter_mm;
        let mut lines = self.lines(&at, &axis, [radius_mm, rim_mm]);
        let is_free = lines.all(|foot| {
            let [end, deep] = [end_mm, far_mm + deep_mm].map(|mm| foot + axis * mm);
            let ends_in_void = self.voids[void].winding(&end) != 0;
            ends_in_void && !self.voids[void].crosses_segment(&end, &deep)
        });
        let is_sound = step_ratio <= STEP_RADII && wall_mm <= most_mm && is_free;
        is_sound.then(|| Site {
            ends: [near_mm - OVER_MM, end_mm].map(|mm| at + axis * mm),
            at,
            axis,
            wall_mm,
            step_ratio,
        })
    }

    /// Returns the feet of lines along the axis of a hole: its middle, and rings around it.
    fn lines(
        &self,
        at: &Point,
        axis: &Vector,
        radii_mm: [f64; 2],
    ) -> impl Iterator<Item = Point> + use<> {
        let (u, v) = orthonormal_basis(axis);
        let at = *at;
        let around = radii_mm.into_iter().flat_map(move |radius_mm| {
            (0..AROUND).map(move |k| {
                let (sin, cos) = (TAU * k as f64 / AROUND as f64).sin_cos();
                at + (u * cos + v * sin) * radius_mm
            })
        });
        std::iter::once(at).chain(around)
    }

    /// Feels along a line into the body: it must come in from the open, and meet nothing but one
    /// wall and the void behind it.
    fn feel(&self, void: usize, foot: &Point, axis: &Vector, most_mm: f64) -> Option<Felt> {
        let lead_mm = STEP_RADII * (self.diameter_mm + self.wall_mm) + OVER_MM;
        let open_mm = lead_mm + ROOM_DIAMETERS * self.diameter_mm;
        let reach_mm = lead_mm + most_mm;
        let [open, start, end] = [-open_mm, -lead_mm, reach_mm].map(|mm| foot + axis * mm);
        let is_covered = self.outside.crosses_segment(&open, &start);
        if is_covered || self.outside.winding(&start) != 0 {
            return None;
        }
        let length_mm = lead_mm + reach_mm;
        let place = |share: f64| share * length_mm - lead_mm;
        let outside_mm = place(self.outside.first_crossing(&start, &end)?);
        let void_mm = place(self.voids[void].first_crossing(&start, &end)?);
        let behind = foot + axis * (outside_mm + f64::EPSILON.sqrt());
        let last = foot + axis * (void_mm + OVER_MM);
        let mut others = (0..self.voids.len()).filter(|other| *other != void);
        let is_one_wall = outside_mm < void_mm
            && !self.outside.crosses_segment(&behind, &last)
            && !others.any(|other| self.voids[other].crosses_segment(&start, &last));
        is_one_wall.then_some(Felt {
            outside_mm,
            void_mm,
        })
    }

    /// Returns whether a mouth of this radius may lie at a point of the outside.
    fn is_allowed(&self, at: &Point, radius_mm: f64) -> bool {
        let is_clear = |ball: &KeepClear| {
            (at - Point::from(ball.center_mm)).norm() > ball.radius_mm + radius_mm
        };
        let contact_mm = CONTACT_DIAMETERS * self.diameter_mm + radius_mm;
        let is_off_contact = (at - self.contact).norm() > contact_mm;
        let may_lie = is_off_contact || self.floor.reach_mm > WIDE_FOOT * contact_mm;
        may_lie && self.floor.spares(at, radius_mm) && self.keep_clear.iter().all(is_clear)
    }
}

/// The floor under the body, and the foot on it.
struct Floor {
    up: Vector,
    sides: [Vector; 2],
    highest_touch_mm: f64,
    /// The hull of what touches the floor.
    foot: Vec<[f64; 2]>,
    /// The longest way across it, mm.
    reach_mm: f64,
}

impl Floor {
    fn under(outer: &TriMesh, up: &Vector) -> Self {
        let (u, v) = orthonormal_basis(up);
        let heights = || outer.vertices().iter().map(|p| up.dot(&p.coords));
        let low_mm = heights().fold(f64::INFINITY, f64::min);
        let high_mm = heights().fold(f64::NEG_INFINITY, f64::max);
        let highest_touch_mm = low_mm + FLOOR_RATIO * (high_mm - low_mm);
        let touching = outer.vertices().iter();
        let touching = touching.filter(|p| up.dot(&p.coords) <= highest_touch_mm);
        let flat = touching.map(|p| [u.dot(&p.coords), v.dot(&p.coords)]);
        let foot = convex_hull(flat.collect());
        let ways = foot.iter().flat_map(|a| foot.iter().map(move |b| (a, b)));
        let lengths = ways.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]));
        Self {
            up: *up,
            sides: [u, v],
            highest_touch_mm,
            reach_mm: lengths.fold(0.0, f64::max),
            foot,
        }
    }

    /// Returns whether a disc of the outside keeps off the edge of the foot. Within it a hole takes
    /// nothing of what the body stands on.
    fn spares(&self, at: &Point, radius_mm: f64) -> bool {
        if self.up.dot(&at.coords) > self.highest_touch_mm + radius_mm {
            return true;
        }
        let p = self.sides.map(|side| side.dot(&at.coords));
        let next = self.foot.iter().cycle().skip(1);
        let mut edges = self.foot.iter().zip(next);
        edges.all(|(a, b)| distance_mm(p, *a, *b) > radius_mm)
    }
}

/// Returns the distance of a point from a segment in a plane, mm.
fn distance_mm(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let ([dx, dy], [px, py]) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let share = (px * dx + py * dy) / (dx * dx + dy * dy).max(f64::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    (px - share * dx).hypot(py - share * dy)
}
