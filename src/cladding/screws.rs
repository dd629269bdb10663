//! Screws through the panels into the parts: which ones, where, and the bosses that hold them.

use super::divide::Scene;
use super::overlap::convex_mm2;
use super::part::Part;
use super::spread::{Head, Seen, Spacing, clear_of, middle_of, places_in, spread};
use crate::cutter::{Fastener, FastenerShape};
use crate::geom::{Frame, Plane, Point, hull};
use crate::mesh::{TriMesh, primitives};
use crate::panels::{Hole, Panel, PanelSet};
use crate::shell::Keep;

/// The least number of screws that hold a part, where its face has room.
pub(super) const LEAST_SCREWS: usize = 3;
/// The area of a part's face that one screw holds, mm².
pub(super) const AREA_MM2: f64 = 15_000.0;
/// Room about a screw's head, mm: a washer, and the play of the hole.
pub(super) const HEAD_ROOM_MM: f64 = 1.5;
/// Material of a boss about its insert, mm.
const BOSS_MM: f64 = 2.0;
/// Room beyond the end of an insert or a screw, mm.
const END_MM: f64 = 1.0;
/// Least distance between two screws, in diameters of the head.
pub(super) const APART_HEADS: f64 = 3.0;
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

    fn head(&self) -> Head {
        Head {
            diameter_mm: self.sizes.head_mm,
            height_mm: self.sizes.head_height_mm,
            radius_mm: self.head_radius_mm(),
        }
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
            let seen = Seen {
                frame: &panels[panel].frame,
                inside_mm: [0.0; 2],
            };
            let head = request.kit.head();
            let inner = edges.fold(ring, |ring, edge| clear_of(&ring, edge, &seen, &head));
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

    /// Returns screws spread over a ring: the two farthest apart, then each as far from the others
    /// as can be.
    fn spread(&self, ring: &[[f64; 2]]) -> Vec<Screw> {
        let places = places_in(ring).into_iter();
        let places: Vec<Screw> = places.filter_map(|at| self.screw_at(at)).collect();
        let wanted = (convex_mm2(ring) / AREA_MM2).ceil() as usize;
        let spacing = Spacing {
            wanted: wanted.max(LEAST_SCREWS),
            least_mm: APART_HEADS * self.request.kit.sizes.head_mm,
        };
        let middle = middle_of(ring);
        let from_middle =
            |screw: &Screw| (screw.at_mm[0] - middle[0]).hypot(screw.at_mm[1] - middle[1]);
        let apart = |a: &Screw, b: &Screw| (a.foot - b.foot).norm();
        spread(&places, &spacing, from_middle, apart)
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
