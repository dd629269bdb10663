//! Growth of a polyhedron, face by face, under a certificate that every step keeps.

use super::convex::{Convex, FaceMeasure};
use super::dealing::{deal_to_best, deal_to_idle};
use super::limits::{Breach, Limits};
use super::obstacles::Obstacles;
use super::programme::{Row, maximise};
use super::side::Side;
use crate::base::random::Random;
use crate::geom::{Aabb, Plane, Vector};

/// Factor of the tilt after a round without gain.
const TILT_RATIO: f64 = 0.4;
/// Relative gain of a round below which the tilt shrinks.
const LEAST_GAIN: f64 = 2e-4;
/// Largest shift of a face in one step over the size of the obstacles: an unbounded face has no
/// other cap.
const SHIFT_RATIO: f64 = 0.15;
/// Rounds of random moves between two deals.
const ROUNDS_PER_DEAL: usize = 5;
/// Price of a broken limit, beside that of its severity.
const PER_BREACH: f64 = 0.25;

/// The terms on which a step is better than none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terms<'a> {
    /// The obstacles that the polyhedron keeps away from.
    pub obstacles: &'a Obstacles,
    /// By how much, mm.
    pub distance_mm: f64,
    /// The limits of fabrication.
    pub limits: &'a Limits,
    /// The share of the volume that a wholly broken limit costs.
    pub price: f64,
}

impl Terms<'_> {
    /// Returns true if broken limits have a price.
    fn is_limited(&self) -> bool {
        !self.limits.is_none() && self.price > 0.0
    }
}

/// A face that may move.
#[derive(Debug, Clone, Copy)]
struct Mover<'a> {
    /// The index of its plane.
    face: usize,
    /// The corners that it keeps its distance from.
    corners: &'a [u32],
    /// Its area and centroid.
    measure: FaceMeasure,
}

/// A polyhedron that grows among obstacles.
///
/// Every obstacle is parted from it by one of its planes, before and after every step.
#[derive(Debug, Clone)]
pub(super) struct Growth<'a> {
    pub terms: Terms<'a>,
    pub planes: Vec<Plane>,
    /// True for planes that stay.
    pub is_locked: Vec<bool>,
    pub body: Convex,
    pub volume_mm3: f64,
    /// The volume less the price of broken limits, mm³.
    pub merit_mm3: f64,
    within: Aabb,
    size_mm: f64,
    /// For each plane, by how much it parts each obstacle, mm; empty if it moved since.
    parted: Vec<Vec<f64>>,
}

/// The tilts of a growth: the first, and the one below which it ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tilts {
    pub first: f64,
    pub least: f64,
}

/// The rule by which obstacles are dealt to faces.
#[derive(Debug, Clone, Copy)]
enum Rule {
    Best,
    Idle,
}

impl<'a> Growth<'a> {
    /// Begins with planes that part every obstacle; `None` if they leave no room.
    pub fn new(terms: Terms<'a>, sides: &[Side]) -> Option<Self> {
        let within = terms.obstacles.aabb();
        let planes: Vec<Plane> = sides.iter().map(|side| side.plane).collect();
        let body = Convex::of_planes(&planes, &within)?;
        let volume_mm3 = body.volume_mm3();
        let mut growth = Self {
            terms,
            is_locked: sides.iter().map(|side| side.is_locked).collect(),
            parted: vec![Vec::new(); planes.len()],
            planes,
            body,
            volume_mm3,
            merit_mm3: 0.0,
            within,
            size_mm: within.size().max(),
        };
        growth.merit_mm3 = growth.merit_of(&growth.body, &growth.planes, volume_mm3);
        Some(growth)
    }

    /// Returns the longest side of the box around the obstacles, mm.
    pub fn size_mm(&self) -> f64 {
        self.size_mm
    }

    /// Sets another price of broken limits.
    pub fn set_price(&mut self, price: f64) {
        self.terms.price = price;
        self.merit_mm3 = self.merit_of(&self.body, &self.planes, self.volume_mm3);
    }

    /// Grows until small tilts gain little.
    pub fn grow(&mut self, tilts: Tilts) {
        let mut tilt = tilts.first;
        while tilt >= tilts.least {
            let before = self.merit_mm3;
            self.round(tilt, Rule::Best);
            self.round(tilt, Rule::Idle);
            if self.merit_mm3 - before < LEAST_GAIN * self.volume_mm3 {
                tilt *= TILT_RATIO;
            }
        }
    }

    /// Deals the obstacles to the faces and improves every face once.
    fn round(&mut self, tilt: f64, rule: Rule) {
        let dealt = self.deal(rule);
        for (face, corners) in dealt.iter().enumerate() {
            if !self.is_locked[face] {
                self.improve(face, corners, tilt);
            }
        }
    }

    /// Tries small random moves of single faces, and keeps those that raise the merit.
    ///
    /// They find what a linear programme does not: shifts inward that lengthen a short edge or
    /// take it away.
    pub fn settle(&mut self, rounds: usize, random: &mut Random) {
        const TILTS: [f64; 4] = [0.01, 0.04, 0.12, 0.3];
        const SHIFTS: [f64; 4] = [0.0, 0.0, 0.5, 1.5];
        let mut dealt = Vec::new();
        for round in 0..rounds {
            // A move keeps the face's own corners parted, so that an old deal stays good.
            if round % ROUNDS_PER_DEAL == 0 {
                dealt = self.deal(Rule::Best);
            }
            for (face, corners) in dealt.iter().enumerate() {
                if self.is_locked[face] {
                    continue;
                }
                let tilt = TILTS[(round + face) % TILTS.len()];
                let [a, b] = [random.between(-tilt, tilt), random.between(-tilt, tilt)];
                let shift = SHIFTS[random.below(SHIFTS.len())] * random.between(0.0, 1.0);
                let inward_mm = shift * self.terms.limits.least_edge_mm;
                let measures = self.body.measures(self.planes.len());
                if let Some(measure) = measures[face] {
                    let mover = Mover {
                        face,
                        corners,
                        measure,
                    };
                    let plane = self.tightened(&mover, [a, b]);
                    let offset_mm = plane.offset_mm - inward_mm;
                    self.try_plane(face, Plane { offset_mm, ..plane });
                }
            }
        }
    }

    /// Returns, for each face, the corners of the obstacles that are dealt to it.
    fn deal(&mut self, rule: Rule) -> Vec<Vec<u32>> {
        self.measure_parted();
        let obstacles = self.terms.obstacles;
        let owners = match rule {
            Rule::Best => deal_to_best(&self.parted),
            Rule::Idle => {
                let most_mm = SHIFT_RATIO * self.size_mm;
                deal_to_idle(&self.parted, self.terms.distance_mm, most_mm)
            }
        };
        let mut dealt = vec![Vec::new(); self.planes.len()];
        let mut taken = vec![0_u64; obstacles.points().len()];
        for (index, &face) in owners.iter().enumerate() {
            for &corner in obstacles.corners(index) {
                let taken = &mut taken[corner as usize];
                if *taken & 1 << face == 0 {
                    *taken |= 1 << face;
                    dealt[face].push(corner);
                }
            }
        }
        dealt
    }

    /// Measures anew what the planes that moved part.
    fn measure_parted(&mut self) {
        let obstacles = self.terms.obstacles;
        for (parted, plane) in self.parted.iter_mut().zip(&self.planes) {
            if parted.is_empty() {
                *parted = obstacles.all_parted_mm(plane);
            }
        }
    }

    /// Returns, for each plane, by how much it parts each obstacle, mm.
    pub fn parted(&mut self) -> &[Vec<f64>] {
        self.measure_parted();
        &self.parted
    }

    /// Turns and shifts a face as its linear programme says, if that raises the merit.
    fn improve(&mut self, face: usize, corners: &[u32], tilt: f64) {
        let Some(measure) = self.body.measures(self.planes.len())[face] else {
            return;
        };
        let mover = Mover {
            face,
            corners,
            measure,
        };
        let mut rows = self.parting_rows(&mover, tilt);
        if self.terms.is_limited() {
            rows.extend(self.turn_rows(face));
        }
        shuffle(&mut rows);
        let bounds = [[-tilt, -tilt, -1.0], [tilt, tilt, SHIFT_RATIO]];
        if let Some([a, b, _]) = maximise([0.0, 0.0, 1.0], bounds, &rows) {
            let plane = self.tightened(&mover, [a, b]);
            self.try_plane(face, plane);
        }
    }

    /// Returns the rows that keep the distance from the corners, in tilts and shift over size.
    fn parting_rows(&self, mover: &Mover, tilt: f64) -> Vec<Row> {
        let plane = &self.planes[mover.face];
        let (u, w) = plane.basis();
        let scale = 1.0 / self.size_mm;
        // The tilted normal is longer than one: by at most this factor.
        let needed = self.terms.distance_mm * (1.0 + 2.0 * tilt * tilt).sqrt();
        let points = self.terms.obstacles.points();
        let row = |&corner: &u32| {
            let from = points[corner as usize] - mover.measure.centroid;
            let [a, b, above] = [&u, &w, &plane.normal].map(|axis| axis.dot(&from) * scale);
            let room = above - needed * scale;
            let is_near = room - tilt * (a.abs() + b.abs()) <= SHIFT_RATIO;
            is_near.then_some(Row {
                a: [-a, -b, 1.0],
                b: room,
            })
        };
        mover.corners.iter().filter_map(row).collect()
    }

    /// Returns the rows that keep the turns to the neighbours within the limits, or no worse than
    /// they are.
    fn turn_rows(&self, face: usize) -> Vec<Row> {
        let plane = &self.planes[face];
        let (u, w) = plane.basis();
        let [flattest, sharpest] = self.terms.limits.turn_rad.map(f64::cos);
        let edges = self.body.edges().into_iter();
        let neighbours = edges.filter_map(|edge| match edge.planes {
            [f, g] if f == face => Some(g),
            [f, g] if g == face => Some(f),
            _ => None,
        });
        let rows = neighbours.flat_map(|other| {
            let normal = &self.planes[other].normal;
            let now = plane.normal.dot(normal);
            let [a, b] = [u.dot(normal), w.dot(normal)];
            [
                Row {
                    a: [a, b, 0.0],
                    b: (flattest - now).max(0.0),
                },
                Row {
                    a: [-a, -b, 0.0],
                    b: (now - sharpest).max(0.0),
                },
            ]
        });
        rows.collect()
    }

    /// Returns a face's plane, tilted, as far out as its corners and the cap allow.
    fn tightened(&self, mover: &Mover, [a, b]: [f64; 2]) -> Plane {
        let plane = &self.planes[mover.face];
        let (u, w) = plane.basis();
        let normal: Vector = (plane.normal + u * a + w * b).normalize();
        let points = self.terms.obstacles.points();
        let corners = mover.corners.iter();
        let nearest = corners
            .map(|&corner| normal.dot(&points[corner as usize].coords))
            .fold(f64::INFINITY, f64::min);
        let cap = normal.dot(&mover.measure.centroid.coords) + SHIFT_RATIO * self.size_mm;
        let offset_mm = (nearest - self.terms.distance_mm).min(cap);
        Plane { normal, offset_mm }
    }

    /// Replaces a plane if that raises the merit.
    fn try_plane(&mut self, face: usize, plane: Plane) {
        let old = std::mem::replace(&mut self.planes[face], plane);
        if let Some(body) = Convex::of_planes(&self.planes, &self.within) {
            let volume = body.volume_mm3();
            // Breaches only cost: what has less volume than the merit has less merit.
            if volume > self.merit_mm3 {
                let merit = self.merit_of(&body, &self.planes, volume);
                if merit > self.merit_mm3 {
                    (self.volume_mm3, self.merit_mm3) = (volume, merit);
                    self.body = body;
                    self.parted[face].clear();
                    return;
                }
            }
        }
        self.planes[face] = old;
    }

    /// Returns the volume of a body less the price of the limits it breaks, mm³.
    fn merit_of(&self, body: &Convex, planes: &[Plane], volume_mm3: f64) -> f64 {
        if !self.terms.is_limited() {
            return volume_mm3;
        }
        let breaches = self.terms.limits.breaches(body, planes);
        let broken: f64 = breaches.iter().map(|b| PER_BREACH + b.severity()).sum();
        volume_mm3 * (1.0 - self.terms.price * broken)
    }

    /// Returns the limits that are broken.
    pub fn breaches(&self) -> Vec<Breach> {
        self.terms.limits.breaches(&self.body, &self.planes)
    }

    /// Returns this growth with one more side; `None` if it leaves no room.
    pub fn with_side(&self, side: Side) -> Option<Self> {
        let mut planes = self.planes.clone();
        planes.push(side.plane);
        let kept: Vec<usize> = (0..self.planes.len()).collect();
        let mut growth = self.with_planes(planes, &kept)?;
        growth.is_locked.push(side.is_locked);
        Some(growth)
    }

    /// Returns true if both bodies share room: then both lie in the same body of the model, as
    /// both are parted from its surface.
    pub fn meets(&self, other: &Self) -> bool {
        let planes = [self.planes.as_slice(), &other.planes].concat();
        Convex::of_planes(&planes, &self.within).is_some()
    }

    /// Returns this growth with other planes; `None` if they leave no room.
    pub fn with_planes(&self, planes: Vec<Plane>, kept: &[usize]) -> Option<Self> {
        let body = Convex::of_planes(&planes, &self.within)?;
        let volume_mm3 = body.volume_mm3();
        let merit_mm3 = self.merit_of(&body, &planes, volume_mm3);
        Some(Self {
            is_locked: kept.iter().map(|&face| self.is_locked[face]).collect(),
            parted: vec![Vec::new(); planes.len()],
            planes,
            body,
            volume_mm3,
            merit_mm3,
            ..*self
        })
    }
}

/// Shuffles rows in a fixed order: Seidel's method is linear in expectation only.
fn shuffle(rows: &mut [Row]) {
    let mut random = Random::new(rows.len() as u64);
    for k in (1..rows.len()).rev() {
        rows.swap(k, random.below(k + 1));
    }
}
