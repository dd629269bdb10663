//! Pins between parts, and the path of every part to the base: from the written surfaces and the
//! lists alone.

use std::f64::consts::{PI, TAU};

use super::bench::bench_joints;
use super::evidence::CoreEvidence;
use super::promise::{FastenerKind, PegPromise};
use crate::geom::{Bvh, Point, Vector, orthonormal_basis};

/// Number of directions about an axis in which a pin and its socket are looked at.
const AROUND: usize = 24;
/// Shares of a pin's length, up to its chamfer, at which it is looked at.
const HEIGHTS: [f64; 3] = [0.1, 0.5, 0.95];
/// Distance from a surface within which a point counts as on it, mm.
const NEAR_MM: f64 = 0.05;
/// Way from a socket's side into its wall, mm: a polygon's corners lie outside of its circle.
const IN_MM: f64 = 0.03;
/// By how much the room about a pin may be less than listed, mm.
const ROOM_SLACK_MM: f64 = 0.01;
/// By how much a direction may be off.
const AXIS_SLACK: f64 = 1e-9;
/// By how much a listed volume may be off that of round bodies, as a share: polygons in place of
/// circles.
const ROUND_RATIO: f64 = 0.02;
/// Distance up to which two surfaces touch, mm.
const TOUCH_MM: f64 = 5e-3;

/// The facts about pins.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PinFacts {
    /// The faults of pins and sockets, in words.
    pub faults: Vec<String>,
    /// The least material about a socket that is found, mm; no more than was looked for.
    pub wall_mm: f64,
    /// Parts without a path to the base: a panel, or a part that has one.
    pub unheld: Vec<String>,
}

impl PegPromise {
    /// Returns the places of a point along the axis and beside it, mm.
    fn place(&self, at: &Point) -> [f64; 2] {
        let arm = at - Point::from(self.center_mm);
        let along = arm.dot(&Vector::from(self.direction));
        [along, (arm - Vector::from(self.direction) * along).norm()]
    }

    /// Returns true if a point lies in or on the pin.
    pub(super) fn holds(&self, at: &Point) -> bool {
        let [along, aside] = self.place(at);
        let reach = -NEAR_MM..=self.length_mm + NEAR_MM;
        reach.contains(&along) && aside <= 0.5 * self.diameter_mm + NEAR_MM
    }

    /// Returns true if a point lies in or on the socket.
    pub(super) fn is_socket_at(&self, at: &Point) -> bool {
        let [along, aside] = self.place(at);
        let reach = -NEAR_MM..=self.socket_depth_mm + NEAR_MM;
        let wider_mm = (self.chamfers_mm[1] - along).max(0.0);
        reach.contains(&along) && aside <= 0.5 * self.socket_diameter_mm + wider_mm + NEAR_MM
    }

    /// Returns points about the axis at a height and a distance, with their directions from it.
    fn ring(&self, height_mm: f64, radius_mm: f64) -> Vec<(Point, Vector)> {
        let axis = Vector::from(self.direction);
        let (u, w) = orthonormal_basis(&axis);
        let middle = Point::from(self.center_mm) + axis * height_mm;
        let at = |step: usize| {
            let (sine, cosine) = (TAU * step as f64 / AROUND as f64).sin_cos();
            let out = u * cosine + w * sine;
            (middle + out * radius_mm, out)
        };
        (0..AROUND).map(at).collect()
    }

    /// Returns the volumes of the pin and of its socket if both were round, mm³.
    fn round_mm3(&self) -> [f64; 2] {
        let cone = |a: f64, b: f64, height: f64| PI * height / 3.0 * (a * a + a * b + b * b);
        let [tip, mouth] = self.chamfers_mm;
        let [pin, socket] = [0.5 * self.diameter_mm, 0.5 * self.socket_diameter_mm];
        [
            PI * pin * pin * (self.length_mm - tip) + cone(pin, pin - tip, tip),
            PI * socket * socket * (self.socket_depth_mm - mouth)
                + cone(socket, socket + mouth, mouth),
        ]
    }

    /// Returns the reason why the listed sizes are none of a pin; `None` if they are.
    fn missized(&self) -> Option<&'static str> {
        let numbers = [
            self.diameter_mm,
            self.length_mm,
            self.socket_diameter_mm - self.diameter_mm,
            self.socket_depth_mm - self.length_mm,
            0.5 * self.diameter_mm - self.chamfers_mm[0],
        ];
        let is_unit = (Vector::from(self.direction).norm() - 1.0).abs() <= AXIS_SLACK;
        if !numbers.iter().all(|number| *number > 0.0) {
            Some("is listed with sizes that no pin has")
        } else if !is_unit {
            Some("has a direction without the length 1")
        } else {
            None
        }
    }
}

/// Measures the pins, and finds the path of every part to the base.
pub fn measure_pins(evidence: &CoreEvidence) -> PinFacts {
    let bodies = evidence.parts.iter();
    let judge = PinJudge {
        evidence,
        bodies: bodies.map(|mesh| Bvh::new(mesh.iter_corners())).collect(),
    };
    let mut facts = PinFacts {
        wall_mm: f64::INFINITY,
        unheld: judge.unheld(),
        ..PinFacts::default()
    };
    for peg in &evidence.promise.pins {
        match judge.judge(peg) {
            Ok(wall_mm) => facts.wall_mm = facts.wall_mm.min(wall_mm),
            Err(why) => facts
                .faults
                .push(format!("a pin of {} into {} {why}", peg.on, peg.into)),
        }
    }
    facts.faults.extend(judge.misweighed());
    facts.faults.extend(judge.unjoinable());
    facts
}

/// The judge of pins.
struct PinJudge<'a> {
    evidence: &'a CoreEvidence,
    /// The surfaces of all parts.
    bodies: Vec<Bvh>,
}

impl PinJudge<'_> {
    /// Returns the least material about a pin's socket, mm, or what is wrong with the pin.
    fn judge(&self, peg: &PegPromise) -> Result<f64, String> {
        let parts = [&peg.on, &peg.into].map(|id| self.evidence.part(id));
        let [Some(on), Some(into)] = parts else {
            return Err("names a part that is not there".to_owned());
        };
        if on == into {
            return Err("stands in its own part".to_owned());
        }
        if let Some(why) = peg.missized().or_else(|| self.moves_across(peg)) {
            return Err(why.to_owned());
        }
        let [on, into] = [on, into].map(|part| &self.bodies[part]);
        let straight_mm = peg.length_mm - peg.chamfers_mm[0];
        let gap_mm = 0.5 * (peg.socket_diameter_mm - peg.diameter_mm);
        let axis = Vector::from(peg.direction);
        let on_axis = |along_mm: f64| Point::from(peg.center_mm) + axis * along_mm;
        for share in HEIGHTS {
            let height_mm = share * straight_mm;
            let inside = peg.ring(height_mm, 0.5 * peg.diameter_mm - NEAR_MM);
            let is_there = inside.iter().all(|(at, _)| on.winding(at) > 0);
            if !is_there || on.winding(&on_axis(height_mm)) <= 0 {
                return Err("is not there".to_owned());
            }
            let beside = peg.ring(height_mm, 0.5 * (peg.diameter_mm + gap_mm));
            if beside.iter().any(|(at, _)| on.winding(at) > 0) {
                return Err("is thicker than listed".to_owned());
            }
            let side = peg.ring(height_mm, 0.5 * peg.diameter_mm);
            let rooms = side.iter().map(|(at, _)| room_mm(into, at));
            let room_mm = rooms.fold(f64::INFINITY, f64::min);
            if room_mm < gap_mm - ROOM_SLACK_MM {
                return Err(format!("has {room_mm:.3} mm of room, not {gap_mm:.3} mm"));
            }
            if into.winding(&on_axis(share * peg.socket_depth_mm)) > 0 {
                return Err("has no socket as deep as listed".to_owned());
            }
        }
        if into.winding(&on_axis(peg.socket_depth_mm - NEAR_MM)) > 0 {
            return Err("has no socket as deep as listed".to_owned());
        }
        Ok(self.wall_mm(peg, into))
    }

    /// Returns the least material about a socket, by rays out of it; no more than is looked for.
    fn wall_mm(&self, peg: &PegPromise, into: &Bvh) -> f64 {
        let look_mm = 2.0 * self.evidence.promise.printer.minimum_wall_mm;
        let radius_mm = 0.5 * peg.socket_diameter_mm + IN_MM;
        let [low, high] = [peg.chamfers_mm[1] + NEAR_MM, peg.socket_depth_mm - NEAR_MM];
        let sides = [low, f64::midpoint(low, high), high].map(|height| peg.ring(height, radius_mm));
        let axis = Vector::from(peg.direction);
        let ends = [0.0, 0.5 * peg.socket_diameter_mm - NEAR_MM].map(|radius| {
            let ring = peg.ring(peg.socket_depth_mm + IN_MM, radius).into_iter();
            ring.map(|(at, _)| (at, axis)).collect::<Vec<_>>()
        });
        let rays = sides.into_iter().chain(ends).flatten();
        let walls = rays.map(|(from, way)| {
            if into.winding(&from) <= 0 {
                return 0.0;
            }
            let share = into.first_crossing(&from, &(from + way * look_mm));
            IN_MM + share.unwrap_or(1.0) * look_mm
        });
        walls.fold(f64::INFINITY, f64::min)
    }

    /// Returns the fault of a pin whose parts do not come together along it; `None` if they do, or
    /// are put together before their unit moves.
    fn moves_across(&self, peg: &PegPromise) -> Option<&'static str> {
        let units = &self.evidence.promise.units;
        let unit_of = |id: &String| units.iter().position(|unit| unit.parts.contains(id));
        let (Some(on), Some(into)) = (unit_of(&peg.on), unit_of(&peg.into)) else {
            return Some("joins a part of no unit");
        };
        if on == into {
            return None;
        }
        // The unit that is joined last leaves first. If it has the socket, it leaves along the pin.
        let sign = if into > on { 1.0 } else { -1.0 };
        let way = Vector::from(units[on.max(into)].way);
        let is_along = (way.dot(&Vector::from(peg.direction)) - sign).abs() <= AXIS_SLACK;
        (!is_along).then_some("does not stand along the way of its unit")
    }

    /// Returns the joints within a unit that cannot be closed in their listed order. Two groups of
    /// parts come together along a line, so that all pins between them must stand along it.
    fn unjoinable(&self) -> Vec<String> {
        let joints = bench_joints(&self.evidence.promise).into_iter();
        let crossed = joints.filter(|joint| !joint.is_along);
        let words = crossed.map(|joint| {
            let PegPromise { on, into, .. } = joint.peg;
            format!("{into} cannot be joined to {on} in turn")
        });
        words.collect()
    }

    /// Returns the parts whose listed volumes are not those of their pins and sockets.
    fn misweighed(&self) -> Vec<String> {
        let promise = &self.evidence.promise;
        let wrong = promise.parts.iter().filter(|part| {
            let sum = |of: fn(&PegPromise) -> &String, side: usize| {
                let own = promise.pins.iter().filter(|peg| *of(peg) == part.id);
                own.map(|peg| peg.round_mm3()[side]).sum::<f64>()
            };
            let expected = [sum(|peg| &peg.on, 0), sum(|peg| &peg.into, 1)];
            let mut pairs = expected.into_iter().zip(part.pins_mm3);
            !pairs.all(|(round, told)| (told - round).abs() <= ROUND_RATIO * round)
        });
        wrong
            .map(|part| format!("the volumes of the pins of {} are others", part.id))
            .collect()
    }

    /// Returns the parts of the shell without a path to the base.
    fn unheld(&self) -> Vec<String> {
        let promise = &self.evidence.promise;
        let shell: Vec<usize> = self.evidence.shell().map(|(part, _)| part).collect();
        let mut held: Vec<usize> = shell
            .iter()
            .copied()
            .filter(|&part| self.is_on_panel(part))
            .collect();
        let pinned = promise.pins.iter().map(|peg| [&peg.on, &peg.into]);
        let glued = promise
            .glue
            .iter()
            .filter_map(|film| match film.parts.as_slice() {
                [a, b] => Some([a, b]),
                _ => None,
            });
        let pairs = pinned.chain(glued).filter_map(|pair| {
            let [a, b] = pair.map(|id| self.evidence.part(id));
            let pair = [a?, b?];
            self.touch(pair).then_some(pair)
        });
        let pairs: Vec<[usize; 2]> = pairs.collect();
        // Each pass reaches one more part, or none is left.
        for _ in &pairs {
            for [a, b] in &pairs {
                match [held.contains(a), held.contains(b)] {
                    [true, false] => held.push(*b),
                    [false, true] => held.push(*a),
                    _ => {}
                }
            }
        }
        let loose = shell.iter().filter(|part| !held.contains(part));
        loose.map(|&part| promise.parts[part].id.clone()).collect()
    }

    /// Returns true if a part lies over its panel at the gap, and a screw or a film of glue holds
    /// it there.
    fn is_on_panel(&self, part: usize) -> bool {
        let promise = &self.evidence.promise;
        let (id, panel) = (&promise.parts[part].id, promise.parts[part].panel);
        let is_screwed = promise
            .fasteners
            .iter()
            .any(|one| one.kind == FastenerKind::Screw && one.part == *id && one.panel == panel);
        let is_glued = || promise.glue.iter().any(|film| film.parts == [id.clone()]);
        let index = panel.wrapping_sub(1);
        if !(is_screwed || is_glued()) || index >= self.evidence.panels.panels.len() {
            return false;
        }
        let frame = self.evidence.frame(index);
        let on_floor = |p: &&Point| (frame.to_local(p).z - promise.gap_mm).abs() <= TOUCH_MM;
        let corners = self.evidence.parts[part].vertices().iter();
        corners.filter(on_floor).count() >= 3
    }

    /// Returns true if the surfaces of two parts touch.
    fn touch(&self, [a, b]: [usize; 2]) -> bool {
        let near = |from: usize, to: usize| {
            let mut corners = self.evidence.parts[from].vertices().iter();
            corners.any(|p| self.bodies[to].closest(p, TOUCH_MM, &[]).is_some())
        };
        near(a, b) || near(b, a)
    }
}

/// Returns the distance of a point from a surface, mm.
fn room_mm(surface: &Bvh, at: &Point) -> f64 {
    let nearest = surface.closest(at, f64::INFINITY, &[]);
    nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared.sqrt())
}
