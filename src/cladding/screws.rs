//! Screws through the panels into the parts: which ones, where, and the bosses that hold them.

use super::divide::Scene;
use super::overlap::{convex_mm2, left_of};
use super::part::Part;
use crate::cutter::{Fastener, FastenerShape};
use crate::geom::{Frame, Plane, Point, hull};
use crate::mesh::{TriMesh, primitives};
use crate::panels::{EdgeJoint, Hole, Panel, PanelEdge, PanelSet};
use crate::shell::Keep;

/// The least number of screws that hold a part, where its face has room.
const LEAST_SCREWS: usize = 3;
/// The area of a part's face that one screw holds, mm².
const AREA_MM2: f64 = 15_000.0;
/// Distance between places that are tried, mm.
const STEP_MM: f64 = 6.0;
/// Most places that are tried along either side of a face.
const MOST_STEPS: f64 = 40.0;
/// Room about a screw's head, mm: a washer, and the play of the hole.
const HEAD_ROOM_MM: f64 = 1.5;
/// Material of a boss about its insert, mm.
const BOSS_MM: f64 = 2.0;
/// Room beyond the end of an insert or a screw, mm.
const END_MM: f64 = 1.0;
/// Least distance between two screws, in diameters of the head.
const APART_HEADS: f64 = 3.0;
/// Number of sides of a bore.
const BORE_SIDES: u32 = 32;
/// Distance by which a bore begins below the floor, mm: its end then lies in no face.
const START_MM: f64 = 0.5;

/// A screw and the insert that it holds in.
#[derive(Debug, Clone, PartialEq)]
pub struct ScrewKit {
    /// The screw.
    pub screw: Fastener,
    /// The insert.
    pub insert: Fastener,
    sizes: Sizes,
}

/// The sizes that places depend on, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sizes {
    hole_mm: f64,
    head_mm: f64,
    head_height_mm: f64,
    bore_mm: f64,
    insert_mm: f64,
    depth_mm: f64,
}

impl ScrewKit {
    /// Returns the insert of a thread and the shortest screw that reaches through it, from behind a
    /// panel and its gap of this thickness, mm. Without such a screw it is the longest that reaches
    /// in at all; `None` if none does.
    pub fn choose(stock: &[Fastener], thread_mm: f64, stack_mm: f64) -> Option<Self> {
        let of_thread = |fastener: &&Fastener| fastener.shape.thread_mm() == thread_mm;
        let insert = stock
            .iter()
            .filter(of_thread)
            .find_map(|fastener| match fastener.shape {
                FastenerShape::Insert {
                    length_mm,
                    diameter_mm,
                    hole_mm,
                    ..
                } => Some((fastener, [length_mm, diameter_mm, hole_mm])),
                _ => None,
            });
        let (insert, [length_mm, insert_mm, bore_mm]) = insert?;
        let screws = stock
            .iter()
            .filter(of_thread)
            .filter_map(|fastener| match fastener.shape {
                FastenerShape::Screw { length_mm, .. } => Some((fastener, length_mm - stack_mm)),
                _ => None,
            });
        let best = screws
            .filter(|(_, reach_mm)| *reach_mm > 0.0)
            .reduce(|a, b| {
                let [short, long] = if a.1 <= b.1 { [a, b] } else { [b, a] };
                if short.1 >= length_mm { short } else { long }
            });
        let (screw, reach_mm) = best?;
        let FastenerShape::Screw {
            head_diameter_mm,
            head_height_mm,
            hole_mm,
            ..
        } = screw.shape
        else {
            return None;
        };
        Some(Self {
            screw: screw.clone(),
            insert: insert.clone(),
            sizes: Sizes {
                hole_mm,
                head_mm: head_diameter_mm,
                head_height_mm,
                bore_mm,
                insert_mm,
                depth_mm: reach_mm.max(length_mm) + END_MM,
            },
        })
    }

    /// Returns the depth of the bore in a part, mm.
    pub fn depth_mm(&self) -> f64 {
        self.sizes.depth_mm
    }

    /// Returns the diameter of the bore in a part, mm.
    pub fn bore_mm(&self) -> f64 {
        self.sizes.bore_mm
    }

    /// Returns the radius of a boss, mm.
    pub fn boss_radius_mm(&self) -> f64 {
        0.5 * self.sizes.insert_mm + BOSS_MM
    }

    /// Returns the radius that a head takes up on a panel, mm.
    fn head_radius_mm(&self) -> f64 {
        0.5 * self.sizes.head_mm + HEAD_ROOM_MM
    }
}

/// A screw in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Screw {
    /// Its place in the panel's frame, mm.
    pub at_mm: [f64; 2],
    /// The point at which it enters the part.
    pub foot: Point,
    /// The point of the outside above it.
    pub roof: Point,
}

/// The screws of a part.
#[derive(Debug, Clone, PartialEq)]
pub struct PartScrews {
    /// The index of the part.
    pub part: usize,
    /// The index of its panel.
    pub panel: usize,
    /// The screws; fewer than three if the face has no room for more.
    pub screws: Vec<Screw>,
}

impl PartScrews {
    /// Returns the bosses, which stand from below the floor to the outside: material that stays.
    pub fn keeps(&self, kit: &ScrewKit, below_mm: f64) -> Vec<Keep> {
        let keep = |screw: &Screw| {
            let up = (screw.roof - screw.foot).normalize();
            Keep {
                from: screw.foot - up * below_mm,
                to: screw.roof,
                radius_mm: kit.boss_radius_mm(),
            }
        };
        self.screws.iter().map(keep).collect()
    }

    /// Returns the bores for inserts, as bodies to take away from the part.
    pub fn bores(&self, kit: &ScrewKit) -> Vec<TriMesh> {
        let bore = |screw: &Screw| {
            let up = (screw.roof - screw.foot).normalize();
            let frame = Frame::with_axis(screw.foot - up * START_MM, &up);
            let length_mm = kit.depth_mm() + START_MM;
            primitives::cylinder(0.5 * kit.bore_mm(), length_mm, BORE_SIDES)
                .map_vertices(|p| frame.to_model(p))
        };
        self.screws.iter().map(bore).collect()
    }

    /// Returns the holes in the panel.
    pub fn holes(&self, kit: &ScrewKit) -> Vec<Hole> {
        let hole = |screw: &Screw| Hole {
            at_mm: screw.at_mm,
            diameter_mm: kit.sizes.hole_mm,
        };
        self.screws.iter().map(hole).collect()
    }
}

/// The order for screws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScrewRequest<'a> {
    /// The panels of the base.
    pub panels: &'a PanelSet,
    /// The screws and inserts.
    pub kit: &'a ScrewKit,
    /// The wall of the parts, mm.
    pub wall_mm: f64,
}

impl Scene<'_> {
    /// Returns the screws of all parts that bear on a panel.
    ///
    /// They stand far apart, three or more a part. Their heads keep clear of the panel's edges with
    /// their fingers and brackets, and of its holes. Their bores keep a wall to the outside and to
    /// the seams.
    pub fn screws(&self, parts: &[Part], request: &ScrewRequest) -> Vec<PartScrews> {
        let mut found: Vec<PartScrews> = Vec::new();
        for (index, part) in parts
            .iter()
            .enumerate()
            .filter(|(_, part)| part.is_on_panel())
        {
            let panels = &request.panels.panels;
            let Some(panel) = panels.iter().position(|panel| panel.face == part.face) else {
                continue;
            };
            let face = Face {
                scene: self,
                part,
                panel: &panels[panel],
                request,
            };
            let ring = face.ring();
            let edges = request.panels.edges.iter();
            let edges = edges.filter(|edge| edge.panels.contains(&panel));
            let inner = edges.fold(ring, |ring, edge| face.clear_of(&ring, edge));
            found.push(PartScrews {
                part: index,
                panel,
                screws: face.spread(&inner),
            });
        }
        found
    }
}

/// The face of a part on its panel.
struct Face<'a> {
    scene: &'a Scene<'a>,
    part: &'a Part,
    panel: &'a Panel,
    request: &'a ScrewRequest<'a>,
}

impl Face<'_> {
    /// Returns the face's outline in the panel's frame, counterclockwise from outside.
    fn ring(&self) -> Vec<[f64; 2]> {
        let outline = self.part.region.outline(0, &self.scene.within);
        let flat = outline.iter().map(|p| self.flat(p)).collect();
        hull::convex_hull(flat)
    }

    fn flat(&self, p: &Point) -> [f64; 2] {
        let local = self.panel.frame.to_local(p);
        [local.x, local.y]
    }

    /// Returns the part of a ring in which heads keep clear of the joint along an edge.
    fn clear_of(&self, ring: &[[f64; 2]], edge: &PanelEdge) -> Vec<[f64; 2]> {
        let kit = self.request.kit;
        let mut depth_mm = edge.depth_mm + kit.head_radius_mm();
        if matches!(edge.joint, EdgeJoint::Brackets(_)) {
            depth_mm += 0.5 * kit.sizes.head_mm;
        }
        // Where the other panel leans over this one, a head would meet it farther in.
        depth_mm += kit.sizes.head_height_mm * edge.angle_rad.cos().max(0.0) / edge.angle_rad.sin();
        let [mut from, mut to] = edge.ends.map(|end| self.flat(&end));
        if hull::turn(from, to, [0.0; 2]) < 0.0 {
            [from, to] = [to, from];
        }
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let inward = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
        let line = [from, to].map(|at| [0, 1].map(|k| at[k] + depth_mm * inward[k]));
        left_of(ring, line)
    }

    /// Returns screws spread over a ring: the two farthest apart, then each as far from the others
    /// as can be.
    fn spread(&self, ring: &[[f64; 2]]) -> Vec<Screw> {
        let places: Vec<Screw> = self.places(ring);
        let kit = self.request.kit;
        let least_mm = APART_HEADS * kit.sizes.head_mm;
        let wanted = (convex_mm2(ring) / AREA_MM2).ceil() as usize;
        let apart_mm = |a: &Screw, b: &Screw| (a.foot - b.foot).norm();
        let middle =
            [0, 1].map(|k| ring.iter().map(|at| at[k]).sum::<f64>() / ring.len().max(1) as f64);
        let from_middle =
            |screw: &Screw| (screw.at_mm[0] - middle[0]).hypot(screw.at_mm[1] - middle[1]);
        let mut screws: Vec<Screw> = Vec::new();
        while screws.len() < wanted.max(LEAST_SCREWS) {
            let room = |place: &Screw| {
                let gaps = screws.iter().map(|screw| apart_mm(screw, place));
                gaps.reduce(f64::min)
                    .unwrap_or_else(|| least_mm + from_middle(place))
            };
            let next = places.iter().map(|place| (room(place), place));
            let next = next.reduce(|a, b| if b.0 > a.0 { b } else { a });
            match next.filter(|(room_mm, _)| *room_mm >= least_mm) {
                Some((_, place)) => screws.push(*place),
                None => break,
            }
        }
        screws
    }

    /// Returns the places in a ring at which a screw can stand: corners and sides of the ring, then
    /// a grid inside.
    fn places(&self, ring: &[[f64; 2]]) -> Vec<Screw> {
        let mut places = Vec::new();
        for (k, from) in ring.iter().enumerate() {
            let to = ring[(k + 1) % ring.len()];
            let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP_MM).clamp(1.0, MOST_STEPS);
            let count = steps.ceil() as usize;
            let along = |step: usize| {
                let share = step as f64 / count as f64;
                [0, 1].map(|k| from[k] + share * (to[k] - from[k]))
            };
            places.extend((0..count).map(along));
        }
        let bound = |pick: fn(f64, f64) -> f64, start| {
            [0, 1].map(|k| ring.iter().map(|at| at[k]).fold(start, pick))
        };
        let (low, high) = (
            bound(f64::min, f64::INFINITY),
            bound(f64::max, f64::NEG_INFINITY),
        );
        let counts = [0, 1].map(|k| ((high[k] - low[k]) / STEP_MM).clamp(0.0, MOST_STEPS) as usize);
        let grid = (0..counts[0] * counts[1]).map(|cell| {
            let cell = [cell % counts[0], cell / counts[0]];
            [0, 1].map(|k| low[k] + (high[k] - low[k]) * (cell[k] as f64 + 0.5) / counts[k] as f64)
        });
        let is_inside = |at: &[f64; 2]| {
            (0..ring.len()).all(|k| hull::turn(ring[k], ring[(k + 1) % ring.len()], *at) >= 0.0)
        };
        places.extend(grid.filter(is_inside));
        places
            .into_iter()
            .filter_map(|at| self.screw_at(at))
            .collect()
    }

    /// Returns the screw at a place; `None` if its head meets a hole, or its bore the outside.
    fn screw_at(&self, at_mm: [f64; 2]) -> Option<Screw> {
        let kit = self.request.kit;
        let is_clear = |hole: &Hole| {
            let apart_mm = (hole.at_mm[0] - at_mm[0]).hypot(hole.at_mm[1] - at_mm[1]);
            // Screws of brackets have heads of their own.
            apart_mm >= 0.5 * hole.diameter_mm + 2.0 * kit.head_radius_mm()
        };
        if !self.panel.holes.iter().all(is_clear) {
            return None;
        }
        let up = self.panel.frame.axis();
        let [x, y] = at_mm;
        let foot = self
            .panel
            .frame
            .to_model(&Point::new(x, y, self.scene.gap_mm));
        let end = foot + up * kit.depth_mm();
        let least_mm = 0.5 * kit.bore_mm() + self.request.wall_mm;
        let seams = self.part.region.bounds().iter().skip(1);
        let mut sides = seams.map(|bound| &bound.plane);
        let is_inside = |plane: &Plane| [foot, end].iter().all(|p| plane.distance(p) <= -least_mm);
        if !sides.all(is_inside) {
            return None;
        }
        let bvh = self.scene.solid.bvh();
        if bvh.segment_distance(&foot, &end, f64::INFINITY) < least_mm {
            return None;
        }
        let reach = up * (2.0 * self.scene.within.size().norm());
        let share = bvh.first_crossing(&foot, &(foot + reach))?;
        Some(Screw {
            at_mm,
            foot,
            roof: foot + reach * share,
        })
    }
}
