//! Bolts through two panels that bear on each other: which ones, and where.

use super::error::CladdingError;
use super::overlap::{convex_mm2, left_of};
use super::screws::{AREA_MM2, HEAD_ROOM_MM, LEAST_SCREWS};
use super::spread::{
    Head, Seen, Spacing, beside_mm, clear_to, lean_mm, middle_of, places_in, spread,
};
use crate::cutter::{Fastener, FastenerShape};
use crate::geom::{Point, hull};
use crate::panels::{EdgeJoint, Hole, Panel, PanelEdge, PanelRequest, PanelSet};
use crate::polyhedra::{BasePlan, Connection, Joint};

/// The least number of bolts of a connection: one alone would be an axle.
const LEAST_BOLTS: usize = 2;

/// Least distance between two bolts, in diameters of the washer: a socket goes round each nut.
const APART_WASHERS: f64 = 2.0;

/// A bolt with its nut, and the washer that lies under each end.
#[derive(Debug, Clone, PartialEq)]
pub struct BoltKit {
    /// The screw.
    pub screw: Fastener,
    /// The nut.
    pub nut: Fastener,
    /// The washer.
    pub washer: Fastener,
    hole_mm: f64,
    /// The length of everything that the screw passes and the nut, mm.
    grip_mm: f64,
    head: Head,
}

impl BoltKit {
    /// Returns the thinnest bolt of at least a thread, and of these the shortest, that holds panels
    /// and gaps of a thickness, mm. `None` if no stock screw is long enough.
    pub fn choose(stock: &[Fastener], thread_mm: f64, stack_mm: f64) -> Option<Self> {
        let kits = stock.iter().filter_map(|screw| {
            let FastenerShape::Screw {
                thread_mm: own_mm,
                length_mm,
                head_diameter_mm,
                head_height_mm,
                hole_mm,
            } = screw.shape
            else {
                return None;
            };
            let (nut, nut_mm) = of_thread(stock, own_mm, |shape| match *shape {
                FastenerShape::Nut { thickness_mm, .. } => Some(thickness_mm),
                _ => None,
            })?;
            let (washer, washer_mm) = of_thread(stock, own_mm, |shape| match *shape {
                FastenerShape::Washer { thickness_mm, .. } => Some(thickness_mm),
                _ => None,
            })?;
            let grip_mm = stack_mm + 2.0 * washer_mm + nut_mm;
            let widest_mm = washer.shape.diameter_mm().max(head_diameter_mm);
            let kit = Self {
                screw: screw.clone(),
                nut: nut.clone(),
                washer: washer.clone(),
                hole_mm,
                grip_mm,
                head: Head {
                    diameter_mm: widest_mm,
                    height_mm: washer_mm + head_height_mm.max(length_mm - grip_mm + nut_mm),
                    radius_mm: 0.5 * widest_mm + HEAD_ROOM_MM,
                },
            };
            let fits = own_mm >= thread_mm && length_mm >= grip_mm;
            fits.then_some(([own_mm, length_mm], kit))
        });
        let best = kits.reduce(|a, b| if b.0 < a.0 { b } else { a });
        best.map(|(_, kit)| kit)
    }

    /// Returns the length of everything that the screw passes, with the nut, mm.
    pub fn grip_mm(&self) -> f64 {
        self.grip_mm
    }

    /// Returns the radius of a disc in two panels that has room for two bolts beside fingers along
    /// its edge, mm.
    pub fn disc_mm(&self, sheet_mm: f64) -> f64 {
        beside_mm(&self.head, sheet_mm) + 0.5 * self.apart_mm()
    }

    fn apart_mm(&self) -> f64 {
        APART_WASHERS * self.head.diameter_mm
    }

    /// Returns the thickness of its washer, mm.
    pub fn washer_mm(&self) -> f64 {
        match self.washer.shape {
            FastenerShape::Washer { thickness_mm, .. } => thickness_mm,
            _ => 0.0,
        }
    }
}

/// Returns the first fastener of a thread that `size` knows, with that size.
fn of_thread(
    stock: &[Fastener],
    thread_mm: f64,
    size: impl Fn(&FastenerShape) -> Option<f64>,
) -> Option<(&Fastener, f64)> {
    let own = stock
        .iter()
        .filter(|one| one.shape.thread_mm() == thread_mm);
    let mut sized = own.filter_map(|one| Some((one, size(&one.shape)?)));
    sized.next()
}

/// A bolt in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bolt {
    /// The index of its connection.
    pub connection: usize,
    /// The indices of its panels: the one with the screw's head inside, and the one with the nut.
    pub panels: [usize; 2],
    /// Its place in the frame of each, mm.
    pub at_mm: [[f64; 2]; 2],
}

impl Bolt {
    /// Returns the holes that it passes, with their panels.
    pub fn holes(&self, kit: &BoltKit) -> [(usize, Hole); 2] {
        [0, 1].map(|side| {
            let hole = Hole {
                at_mm: self.at_mm[side],
                diameter_mm: kit.hole_mm,
            };
            (self.panels[side], hole)
        })
    }
}

/// Returns the bolts of all connections between panels that bear on each other.
///
/// They stand far apart where both panels have room, three or more a connection if they find
/// places. Heads and nuts keep clear of the joints along the panels' edges, and of the flanges of
/// brackets. `request` is that of the panels.
///
/// # Errors
/// Two panels have room for fewer than two bolts.
pub fn bolts(
    plan: &BasePlan,
    set: &PanelSet,
    request: &PanelRequest,
    kit: &BoltKit,
) -> Result<Vec<Bolt>, CladdingError> {
    let mut all = Vec::new();
    let bolted = plan.connections.iter().enumerate();
    for (index, connection) in bolted.filter(|(_, of)| of.joint == Joint::Bolted) {
        let pair = Pair::find(plan, set, connection, request);
        let places = pair.map_or_else(Vec::new, |pair| pair.places(kit));
        if places.len() < LEAST_BOLTS {
            return Err(CladdingError::NoBolts {
                polyhedra: connection.polyhedra,
                found: places.len(),
            });
        }
        all.extend(places.into_iter().map(|(panels, at_mm)| Bolt {
            connection: index,
            panels,
            at_mm,
        }));
    }
    Ok(all)
}

/// Two panels that bear on each other, or face each other over a gap, with the outlines of their
/// faces.
pub(super) struct Pair<'a> {
    set: &'a PanelSet,
    request: &'a PanelRequest,
    pub panels: [usize; 2],
    outlines: [Vec<Point>; 2],
}

impl<'a> Pair<'a> {
    pub fn find(
        plan: &BasePlan,
        set: &'a PanelSet,
        of: &Connection,
        request: &'a PanelRequest,
    ) -> Option<Self> {
        let panel = |side: usize| {
            let face = plan.faces_before(of.polyhedra[side]) + of.faces[side];
            set.panels.iter().position(|panel| panel.face == face)
        };
        let outline = |side: usize| plan.polyhedra[of.polyhedra[side]].outline(of.faces[side]);
        Some(Self {
            set,
            request,
            panels: [panel(0)?, panel(1)?],
            outlines: [0, 1].map(outline),
        })
    }

    pub fn panel(&self, side: usize) -> &Panel {
        &self.set.panels[self.panels[side]]
    }

    /// Returns a point of space in the frame of a panel.
    pub fn flat(&self, side: usize, p: &Point) -> [f64; 2] {
        let local = self.panel(side).frame.to_local(p);
        [local.x, local.y]
    }

    /// Returns the places of the bolts in both frames.
    fn places(&self, kit: &BoltKit) -> Vec<([usize; 2], [[f64; 2]; 2])> {
        let ring = self.ring(&kit.head);
        let apart = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let middle = middle_of(&ring);
        let wanted = (convex_mm2(&ring) / AREA_MM2).ceil() as usize;
        let spacing = Spacing {
            wanted: wanted.max(LEAST_SCREWS),
            least_mm: kit.apart_mm(),
        };
        let from_middle = |at: &[f64; 2]| apart(at, &middle);
        let mut places = places_in(&ring);
        places.retain(|at| self.is_clear(*at, kit.head.radius_mm));
        let chosen = spread(&places, &spacing, from_middle, apart);
        let both = chosen.into_iter().map(|[x, y]| {
            let at = self.panel(0).frame.to_model(&Point::new(x, y, 0.0));
            (self.panels, [[x, y], self.flat(1, &at)])
        });
        both.collect()
    }

    /// Returns the ring, in the frame of the first panel, in which heads keep clear of all joints
    /// on both.
    pub fn ring(&self, head: &Head) -> Vec<[f64; 2]> {
        let [first, second] = [0, 1].map(|side| {
            let flat = self.outlines[side].iter().map(|p| self.flat(0, p));
            hull::convex_hull(flat.collect())
        });
        let shared = (0..second.len()).fold(first, |ring, k| {
            left_of(&ring, [second[k], second[(k + 1) % second.len()]])
        });
        let frame = &self.panel(0).frame;
        (0..2).fold(shared, |ring, side| {
            let seen = Seen {
                frame,
                inside_mm: self.flat(0, &self.panel(side).frame.origin),
            };
            let edges = self.set.edges.iter();
            let own = edges.filter(|edge| edge.panels.contains(&self.panels[side]));
            own.fold(ring, |ring, edge| {
                let depth_mm = self.depth_mm(edge) + head.radius_mm;
                let depth_mm = depth_mm + lean_mm(head, edge.angle_rad);
                clear_to(&ring, edge, &seen, depth_mm)
            })
        })
    }

    /// Returns how far a joint reaches into a panel all along its edge, mm.
    fn depth_mm(&self, edge: &PanelEdge) -> f64 {
        match edge.joint {
            EdgeJoint::Fingers(_) => edge.depth_mm,
            EdgeJoint::Brackets(_) => self.setback_mm(edge),
        }
    }

    fn setback_mm(&self, edge: &PanelEdge) -> f64 {
        self.request.sheet_mm / (0.5 * edge.angle_rad).tan()
    }

    /// Returns true if a head at a place in the first panel's frame meets no flange of a bracket.
    pub fn is_clear(&self, at: [f64; 2], radius_mm: f64) -> bool {
        let own = |edge: &&PanelEdge| edge.panels.iter().any(|panel| self.panels.contains(panel));
        let mut edges = self.set.edges.iter().filter(own);
        edges.all(|edge| {
            let EdgeJoint::Brackets(places) = &edge.joint else {
                return true;
            };
            let [from, to] = edge.ends.map(|end| self.flat(0, &end));
            let way = [to[0] - from[0], to[1] - from[1]];
            let length = way[0].hypot(way[1]);
            let arm = [at[0] - from[0], at[1] - from[1]];
            let along_mm = (arm[0] * way[0] + arm[1] * way[1]) / length;
            let across_mm = (arm[0] * way[1] - arm[1] * way[0]).abs() / length;
            let reach_mm = self.setback_mm(edge) + self.request.flange_mm() + radius_mm;
            let aside_mm = 0.5 * self.request.brackets.width_mm() + radius_mm;
            let meets = |place: &f64| (along_mm - place).abs() < aside_mm;
            across_mm >= reach_mm || !places.iter().any(meets)
        })
    }
}
