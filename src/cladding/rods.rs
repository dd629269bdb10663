//! Rods between two panels that face each other over a gap: which ones, where, and their bores.
//!
//! A connection has two rods: about a single one a limb would turn. They stand square to both
//! panels, so that a polyhedron slides on them as it comes. Above its face each stays in the face's
//! cell, so it passes no parts but those of its two panels.

use super::bolts::Pair;
use super::error::{CladdingError, RodLack};
use super::rod_bore::RodBore;
use super::spread::{Head, Spacing, beside_mm, is_in, spread};
use crate::cutter::{Fastener, FastenerShape};
use crate::geom::{Frame, Plane, Point};
use crate::mesh::{TriMesh, primitives};
use crate::panels::{Hole, PanelRequest, PanelSet};
use crate::polyhedra::{BasePlan, Connection, Ground, Joint, RodRoom};

/// The number of rods of a connection.
const RODS: usize = 2;
/// The least distance of the axes of two rods, in diameters of their holes: a web of one is left.
const APART_HOLES: f64 = 2.0;
/// Room for them beyond what they need, mm: places are rounded.
const SPARE_MM: f64 = 1e-6;
/// Directions about the middle of a way in which two rods are tried as near as they may stand.
const TURNS: usize = 24;
/// Web between a hole and the joints along its panel's edges, mm.
const WEB_MM: f64 = 3.0;
/// The length by which a rod stands out of a panel's inner side, mm: a fillet of glue goes round.
pub const STAND_MM: f64 = 3.0;
/// Places along each side of a square about the way in which rods are tried.
const PLACES: usize = 24;
/// Half the side of that square, in radii of the way: a neck may be wider one way than the other.
const REACH_WAYS: f64 = 2.0;
/// Number of sides of a rod's body.
const SIDES: u32 = 48;

/// A rod that is sold by length, with its holes.
#[derive(Debug, Clone, PartialEq)]
pub struct RodKit {
    /// The rod.
    pub rod: Fastener,
    /// Its diameter, mm.
    pub diameter_mm: f64,
    /// The length in which it is sold, mm.
    pub stock_mm: f64,
    /// The diameter of its hole in a panel, mm.
    pub hole_mm: f64,
    /// The diameter of its bore in printed parts, mm.
    pub bore_mm: f64,
}

impl RodKit {
    /// Returns the rods of a stock, the thickest first. Their bores in printed parts are wider than
    /// their holes by the play on either side, mm.
    pub fn all(stock: &[Fastener], play_mm: f64) -> Vec<Self> {
        let rods = stock.iter().filter_map(|rod| match rod.shape {
            FastenerShape::Dowel {
                diameter_mm,
                length_mm,
                hole_mm,
            } => Some(Self {
                rod: rod.clone(),
                diameter_mm,
                stock_mm: length_mm,
                hole_mm,
                bore_mm: hole_mm + 2.0 * play_mm,
            }),
            _ => None,
        });
        let mut rods: Vec<Self> = rods.collect();
        rods.sort_by(|a, b| b.diameter_mm.total_cmp(&a.diameter_mm));
        rods
    }

    /// Returns the room that two of these rods need in panels of a sheet and in the model, with a
    /// wall about their bores, mm.
    pub fn room(&self, sheet_mm: f64, wall_mm: f64) -> RodRoom {
        let half_mm = 0.5 * self.apart_mm() + SPARE_MM;
        RodRoom {
            face_mm: beside_mm(&self.head(), sheet_mm) + half_mm,
            way_mm: half_mm + 0.5 * self.bore_mm + wall_mm,
            least_mm: 2.0 * wall_mm,
        }
    }

    fn apart_mm(&self) -> f64 {
        APART_HOLES * self.hole_mm
    }

    fn head(&self) -> Head {
        Head {
            diameter_mm: self.hole_mm,
            height_mm: STAND_MM,
            radius_mm: 0.5 * self.hole_mm + WEB_MM,
        }
    }
}

/// A rod in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Rod {
    /// The index of its connection.
    pub connection: usize,
    /// The rod that it is cut from.
    pub kit: RodKit,
    /// The indices of its panels.
    pub panels: [usize; 2],
    /// Its place in the frame of each, mm.
    pub at_mm: [[f64; 2]; 2],
    /// Both ends of its axis, inside of the polyhedra.
    pub ends: [Point; 2],
}

impl Rod {
    /// Returns its length, mm.
    pub fn length_mm(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    /// Returns the holes into which it is glued, with their panels.
    pub fn holes(&self) -> [(usize, Hole); 2] {
        [0, 1].map(|side| {
            let hole = Hole {
                at_mm: self.at_mm[side],
                diameter_mm: self.kit.hole_mm,
            };
            (self.panels[side], hole)
        })
    }

    /// Returns its body.
    pub fn body(&self) -> TriMesh {
        let way = (self.ends[1] - self.ends[0]).normalize();
        let frame = Frame::with_axis(self.ends[0], &way);
        primitives::cylinder(0.5 * self.kit.diameter_mm, self.length_mm(), SIDES)
            .map_vertices(|p| frame.to_model(p))
    }
}

/// The order for rods.
#[derive(Debug, Clone, Copy)]
pub struct RodRequest<'a> {
    /// The model.
    pub ground: &'a Ground,
    /// The order of the panels.
    pub panels: &'a PanelRequest,
    /// The rods to choose from, the best first.
    pub kits: &'a [RodKit],
    /// The wall about their bores, mm.
    pub wall_mm: f64,
}

/// Returns the rods of all connections that need them, two each.
///
/// They are of the first kind that has room, and stand far apart. Their holes keep clear of the
/// joints along the panels' edges and of brackets, and their bores keep the wall to the surface.
///
/// # Errors
/// Two panels have room for fewer than two rods.
pub fn rods(
    plan: &BasePlan,
    set: &PanelSet,
    request: &RodRequest,
) -> Result<Vec<Rod>, CladdingError> {
    let mut all = Vec::new();
    let spanned = plan.connections.iter().enumerate();
    for (index, of) in spanned.filter(|(_, of)| of.joint == Joint::Rods) {
        let pair = Pair::find(plan, set, of, request.panels);
        let place = |kit| {
            let seat = Seat {
                pair: pair.as_ref().ok_or(RodLack::Panels)?,
                of,
                kit,
                request,
            };
            seat.rods(index)
        };
        all.extend(first_that_fits(request.kits, of, place)?);
    }
    Ok(all)
}

/// Returns the rods of the first kind that finds places; the error is that of the last.
fn first_that_fits<'a>(
    kits: &'a [RodKit],
    of: &Connection,
    place: impl Fn(&'a RodKit) -> Result<Vec<Rod>, RodLack>,
) -> Result<Vec<Rod>, CladdingError> {
    let mut refused = (String::new(), RodLack::Joints);
    for kit in kits {
        match place(kit) {
            Ok(found) => return Ok(found),
            Err(lack) => refused = (kit.rod.id.clone(), lack),
        }
    }
    let (rod, lack) = refused;
    Err(CladdingError::NoRods {
        polyhedra: of.polyhedra,
        rod,
        lack,
    })
}

/// Two panels and a kind of rod between them.
struct Seat<'a> {
    pair: &'a Pair<'a>,
    of: &'a Connection,
    kit: &'a RodKit,
    request: &'a RodRequest<'a>,
}

impl Seat<'_> {
    /// Returns the rods of a connection, or what they lack.
    fn rods(&self, connection: usize) -> Result<Vec<Rod>, RodLack> {
        let rods = self.chosen()?.map(|place| {
            let [low, high] = self.outer(place);
            let way = (high - low).normalize();
            let deep_mm = self.request.panels.sheet_mm + STAND_MM;
            Rod {
                connection,
                kit: self.kit.clone(),
                panels: self.pair.panels,
                at_mm: [place, self.pair.flat(1, &high)],
                ends: [low - way * deep_mm, high + way * deep_mm],
            }
        });
        let needed_mm = rods.iter().map(Rod::length_mm).fold(0.0, f64::max);
        let sold_mm = self.kit.stock_mm;
        if needed_mm > sold_mm {
            return Err(RodLack::Length { needed_mm, sold_mm });
        }
        Ok(rods.into())
    }

    /// Returns the places of two rods in the frame of the first panel: far apart on a grid. If that
    /// has none, they stand as near to each other as they may, about the middle of the way.
    fn chosen(&self) -> Result<[[f64; 2]; RODS], RodLack> {
        let head = self.kit.head();
        let ring = self.pair.ring(&head);
        let is_clear =
            |place: &[f64; 2]| is_in(&ring, place) && self.pair.is_clear(*place, head.radius_mm);
        let clear: Vec<[f64; 2]> = self.grid().into_iter().filter(is_clear).collect();
        let spacing = Spacing {
            wanted: RODS,
            least_mm: self.kit.apart_mm(),
        };
        let middle = self.middle();
        let apart = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        let far = |places: &[[f64; 2]]| {
            let chosen = spread(places, &spacing, |place| apart(place, &middle), apart);
            <[[f64; 2]; RODS]>::try_from(chosen).ok()
        };
        let inside = clear.iter().copied().filter(|place| self.is_inside(*place));
        let inside: Vec<[f64; 2]> = inside.collect();
        if let Some(chosen) = far(&inside) {
            return Ok(chosen);
        }
        let near = self.near_middle();
        let mut on_panels = near.iter().filter(|pair| pair.iter().all(is_clear));
        let has_panels = far(&clear).is_some() || on_panels.clone().next().is_some();
        let fits = on_panels.find(|pair| pair.iter().all(|place| self.is_inside(*place)));
        fits.copied().ok_or(match has_panels {
            true => RodLack::Wall,
            false => RodLack::Joints,
        })
    }

    /// Returns the middle of the way in the frame of the first panel.
    fn middle(&self) -> [f64; 2] {
        self.pair.flat(0, &self.of.ends[0])
    }

    /// Returns the places of a grid about the middle of the way.
    fn grid(&self) -> Vec<[f64; 2]> {
        let middle = self.middle();
        let reach_mm = REACH_WAYS * self.of.radius_mm;
        let at = |cell: usize, middle: f64| {
            let share = (cell as f64 + 0.5) / PLACES as f64;
            middle + reach_mm * (2.0 * share - 1.0)
        };
        (0..PLACES * PLACES)
            .map(|cell| [at(cell % PLACES, middle[0]), at(cell / PLACES, middle[1])])
            .collect()
    }

    /// Returns pairs of places on both sides of the middle of the way, as near to each other as two
    /// rods may stand.
    fn near_middle(&self) -> [[[f64; 2]; RODS]; TURNS] {
        let [x, y] = self.middle();
        let half_mm = 0.5 * self.kit.apart_mm() + 0.5 * SPARE_MM;
        std::array::from_fn(|turn| {
            let angle = std::f64::consts::PI * turn as f64 / TURNS as f64;
            let (sine, cosine) = angle.sin_cos();
            [-half_mm, half_mm].map(|off_mm| [x + off_mm * cosine, y + off_mm * sine])
        })
    }

    /// Returns the points at which a rod enters the outer sides of both panels.
    fn outer(&self, place: [f64; 2]) -> [Point; 2] {
        let low = self.pair.panel(0).at(place, 0.0);
        let [x, y] = self.pair.flat(1, &low);
        [low, self.pair.panel(1).at([x, y], 0.0)]
    }

    /// Returns true if a bore at a place keeps the wall to the surface of the model.
    fn is_inside(&self, place: [f64; 2]) -> bool {
        let [low, high] = self.outer(place);
        let bvh = self.request.ground.distance().bvh();
        let least_mm = 0.5 * self.kit.bore_mm + self.request.wall_mm;
        bvh.segment_distance(&low, &high, f64::INFINITY) >= least_mm
    }
}

/// Returns the bores of rods in the parts of a polyhedron, with its own faces. Those of either side
/// end at the plane between.
pub(super) fn bores_of(
    plan: &BasePlan,
    rods: &[Rod],
    polyhedron: usize,
    gap_mm: f64,
) -> Vec<RodBore> {
    let bores = rods.iter().filter_map(|rod| {
        let of = &plan.connections[rod.connection];
        let side = of.polyhedra.iter().position(|at| *at == polyhedron)?;
        let face = plan.polyhedra[polyhedron].faces().get(of.faces[side])?;
        let [near, far] = [rod.ends[side], rod.ends[1 - side]];
        let way = (far - near).normalize();
        let along_mm = |plane: &Plane| -plane.distance(&near) / plane.normal.dot(&way);
        let crossed = plan.sides(polyhedron).into_iter().find(|plane| {
            let (from, to) = (plane.distance(&near), plane.distance(&far));
            from < 0.0 && to > 0.0
        })?;
        Some(RodBore {
            face: of.faces[side],
            ends: [
                near + way * (along_mm(&face.plane) + gap_mm),
                near + way * along_mm(&crossed),
            ],
            diameter_mm: rod.kit.bore_mm,
        })
    });
    bores.collect()
}
