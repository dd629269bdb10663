//! Units that bar each other's ways, and the cut that frees them.
//!
//! A cut is tried before it is told: the piece that it parts leaves first, and then all units must
//! find an order. Each unit leaves as whole as it was when it was found to be barred.

use rayon::prelude::*;

use super::error::{CladdingError, FreeingCut, PartPlace};
use super::overlap::{barred_mm2, face_mm2};
use super::part::{Holding, Part};
use super::rooms::extent;
use super::units::{FREE_MM2, Unit};
use crate::geom::{Plane, Vector, orthonormal_basis};
use crate::mesh::{ClipError, Csg, TriMesh, bodies, move_off_vertices};

/// Directions of cuts along a way, over half a turn.
const DIRECTIONS: usize = 4;
/// Distance of a cut from the body that it passes, mm: the width of a saw.
const BESIDE_MM: f64 = 1.0;
/// Area below which a piece does not touch a plane, mm².
const TOUCH_MM2: f64 = 1e-3;

/// Units of which none can leave first.
pub(super) struct Knot<'a> {
    /// All parts.
    pub parts: &'a [Part],
    /// All units.
    pub units: &'a [Unit],
    /// The bodies of each unit: its parts in their order, then its panel if that is in the way.
    pub bodies: Vec<Vec<&'a TriMesh>>,
    /// The directions in which each unit may leave.
    pub ways: Vec<Vec<Vector>>,
    /// The indices of the units that wait for each other.
    pub waiting: Vec<usize>,
    /// The indices of those that stay where they are.
    pub standing: Vec<usize>,
}

/// A thing that leaves as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mover {
    Unit(usize),
    /// The piece that a cut parts from its unit.
    Piece,
}

/// A cut through a part, by which a piece leaves its unit.
struct Cut {
    unit: usize,
    /// The place of the part among those of its unit.
    place: usize,
    /// The plane; its normal points to the piece.
    plane: Plane,
    piece: TriMesh,
    rest: Vec<TriMesh>,
    area_mm2: f64,
}

/// A part on its way, and one that it meets there: units, and places of parts in them.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Meeting {
    moving: [usize; 2],
    fixed: [usize; 2],
}

impl Knot<'_> {
    /// Returns the answer that names the parts, and a cut that frees them if one was found.
    pub fn error(&self) -> CladdingError {
        let meetings = self.circle();
        let place = |[unit, part]: [usize; 2]| self.place(unit, part);
        let mut parts: Vec<PartPlace> = Vec::new();
        for meeting in &meetings {
            for part in [meeting.moving, meeting.fixed].map(place) {
                if !parts.contains(&part) {
                    parts.push(part);
                }
            }
        }
        let faces = self.waiting.iter().map(|&unit| self.units[unit].face);
        CladdingError::Cycle {
            faces: faces.collect(),
            parts,
            // A cut that the engine cannot make frees nothing.
            cut: self.best_cut(&meetings).ok().flatten().map(Box::new),
        }
    }

    fn place(&self, unit: usize, part: usize) -> PartPlace {
        let part = &self.parts[self.units[unit].parts[part]];
        PartPlace {
            face: part.face,
            middle: part.body.aabb().center(),
        }
    }

    /// Returns a circle of parts, each with the next one in its way. It is followed from the first
    /// unit that waits, and ends at a part that does not move.
    fn circle(&self) -> Vec<Meeting> {
        let mut path: Vec<Meeting> = Vec::new();
        let mut next = self.waiting.first().copied();
        while let Some(unit) = next {
            if let Some(start) = path.iter().position(|of| of.moving[0] == unit) {
                return path.split_off(start);
            }
            let Some(meeting) = self.meeting(unit) else {
                return path;
            };
            path.push(meeting);
            next = Some(meeting.fixed[0]).filter(|fixed| self.waiting.contains(fixed));
        }
        path
    }

    /// Returns the first part that bars a unit on the first of its ways, of those that wait too if
    /// there is one. A unit that only waits for what it carries is barred where that is.
    fn meeting(&self, unit: usize) -> Option<Meeting> {
        let way = self.ways[unit].first()?;
        let others = self.waiting.iter().chain(&self.standing);
        let met = others.filter(|other| **other != unit).find_map(|&other| {
            let moving = 0..self.units[unit].parts.len();
            let mut pairs = moving.flat_map(|a| {
                let fixed = 0..self.units[other].parts.len();
                fixed.map(move |b| [a, b])
            });
            pairs
                .find(|[a, b]| meets(self.bodies[unit][*a], self.bodies[other][*b], way))
                .map(|[a, b]| Meeting {
                    moving: [unit, a],
                    fixed: [other, b],
                })
        });
        met.or_else(|| self.carried(unit))
    }

    /// Returns a part that hangs on a unit and must leave before it.
    fn carried(&self, unit: usize) -> Option<Meeting> {
        let waiting = self.waiting.iter().filter(|other| **other != unit);
        waiting.copied().find_map(|other| {
            let hung = self.units[other].parts.iter().enumerate();
            let mut hung = hung.filter_map(|(place, &part)| {
                let carrier = self.place_of_carrier(unit, part)?;
                Some(Meeting {
                    moving: [unit, carrier],
                    fixed: [other, place],
                })
            });
            hung.next()
        })
    }

    /// Returns the place in a unit of the part that carries another one; `None` if it does not.
    fn place_of_carrier(&self, unit: usize, part: usize) -> Option<usize> {
        let Holding::Pinned { to, .. } = self.parts[part].holding else {
            return None;
        };
        self.units[unit].parts.iter().position(|&own| own == to)
    }

    /// Returns the cut with the least section, of those after which all units come apart.
    fn best_cut(&self, meetings: &[Meeting]) -> Result<Option<FreeingCut>, ClipError> {
        let mut tried: Vec<([usize; 2], Plane)> = Vec::new();
        for meeting in meetings {
            let ends = [meeting.moving, meeting.fixed];
            let planes = self.planes(meeting);
            let movable = ends.iter().filter(|end| self.waiting.contains(&end[0]));
            tried.extend(movable.flat_map(|end| planes.iter().map(|plane| (*end, *plane))));
        }
        let freed = tried.par_iter().map(|(of, plane)| {
            let cuts = self.cuts(*of, plane)?.into_iter();
            let mut cuts: Vec<Cut> = cuts.collect();
            cuts.sort_by(|a, b| a.area_mm2.total_cmp(&b.area_mm2));
            let freed = |cut: Cut| Some((self.comes_apart(&cut)?, cut));
            Ok(cuts.into_iter().find_map(freed))
        });
        let freed: Vec<Option<(Vector, Cut)>> = freed.collect::<Result<_, ClipError>>()?;
        let best = freed.into_iter().flatten();
        let best = best.reduce(|a, b| if b.1.area_mm2 < a.1.area_mm2 { b } else { a });
        Ok(best.map(|(way, cut)| FreeingCut {
            way,
            part: self.place(cut.unit, cut.place),
            plane: cut.plane,
            piece: cut.piece.aabb().center(),
            volume_mm3: cut.piece.signed_volume_mm3(),
            area_mm2: cut.area_mm2,
        }))
    }

    /// Returns the planes beside what two parts share along some directions, and between them.
    fn planes(&self, meeting: &Meeting) -> Vec<Plane> {
        let [moving, fixed] = [meeting.moving, meeting.fixed].map(|[u, p]| self.bodies[u][p]);
        let Some(way) = self.ways[meeting.moving[0]].first() else {
            return Vec::new();
        };
        let (u, w) = orthonormal_basis(way);
        let across = (0..DIRECTIONS).map(|k| {
            let (sine, cosine) = (std::f64::consts::PI * k as f64 / DIRECTIONS as f64).sin_cos();
            u * cosine + w * sine
        });
        let planes = across.chain([*way]).flat_map(|normal| {
            let [a, b] = [moving, fixed].map(|body| extent(body, &normal));
            let (low, high) = (a[0].max(b[0]), a[1].min(b[1]));
            let offsets = [low - BESIDE_MM, 0.5 * (low + high), high + BESIDE_MM];
            offsets.map(|offset_mm| Plane { normal, offset_mm })
        });
        planes.collect()
    }

    /// Returns the cuts of a part by a plane: one for each piece that is parted from its foot.
    fn cuts(&self, [unit, place]: [usize; 2], plane: &Plane) -> Result<Vec<Cut>, ClipError> {
        let part = &self.parts[self.units[unit].parts[place]];
        let plane = move_off_vertices(&part.body, plane);
        let (above, below) = Csg::of_mesh(&part.body)?.split_by_plane(&plane)?;
        let sided = |half: &TriMesh, plane: Plane| {
            let pieces = bodies(half).into_iter();
            pieces.map(move |piece| (piece, plane)).collect::<Vec<_>>()
        };
        let pieces = [
            sided(&above.to_mesh()?, plane),
            sided(&below.to_mesh()?, flip(&plane)),
        ];
        let pieces = pieces.concat();
        let foot = part.foot().map(|foot| foot.plane);
        let is_held = |piece: &TriMesh| foot.is_none_or(|foot| face_mm2(piece, &foot) > TOUCH_MM2);
        let loose = (0..pieces.len()).filter(|&at| pieces.len() > 1 && !is_held(&pieces[at].0));
        let cuts = loose.map(|at| {
            let (piece, plane) = pieces[at].clone();
            let others = pieces.iter().enumerate().filter(|(other, _)| *other != at);
            Cut {
                unit,
                place,
                area_mm2: face_mm2(&piece, &flip(&plane)),
                plane,
                piece,
                rest: others.map(|(_, (body, _))| body.clone()).collect(),
            }
        });
        Ok(cuts.collect())
    }

    /// Returns the way of the piece of a cut, if it leaves first and then all units do.
    fn comes_apart(&self, cut: &Cut) -> Option<Vector> {
        let units = self.waiting.iter().map(|&unit| Mover::Unit(unit));
        let mut staying: Vec<Mover> = units.collect();
        let way = self.free_way(Mover::Piece, &staying, cut)?;
        while !staying.is_empty() {
            let is_free = |own: &Mover| self.free_way(*own, &staying, cut).is_some();
            let free = staying.iter().position(is_free)?;
            staying.remove(free);
        }
        Some(way)
    }

    /// Returns the first way in which something leaves past all that stays.
    fn free_way(&self, own: Mover, staying: &[Mover], cut: &Cut) -> Option<Vector> {
        let standing = self.standing.iter().map(|&unit| Mover::Unit(unit));
        let others = staying.iter().copied().chain(standing);
        let others: Vec<Mover> = others.filter(|other| *other != own).collect();
        if others.iter().any(|other| self.carries(own, *other, cut)) {
            return None;
        }
        let moving = self.bodies_of(own, cut);
        let ways = match own {
            Mover::Unit(unit) => self.ways[unit].clone(),
            Mover::Piece => [self.ways[cut.unit].clone(), vec![cut.plane.normal]].concat(),
        };
        ways.into_iter().find(|way| {
            let bars = |other: &Mover| {
                let fixed = self.bodies_of(*other, cut);
                let met = |a: &&TriMesh| fixed.iter().any(|b| meets(a, b, way));
                moving.iter().any(met)
            };
            !others.iter().any(bars)
        })
    }

    /// Returns true if something hangs on another thing and must leave before it. What hung on the
    /// part that is cut may hang on either piece.
    fn carries(&self, own: Mover, other: Mover, cut: &Cut) -> bool {
        match (own, other) {
            // The piece leaves before all others.
            (_, Mover::Piece) => false,
            (Mover::Unit(unit), Mover::Unit(hung)) => {
                let parts = &self.units[hung].parts;
                unit != hung
                    && parts
                        .iter()
                        .any(|&part| self.place_of_carrier(unit, part).is_some())
            }
            (Mover::Piece, Mover::Unit(hung)) => {
                let parts = &self.units[hung].parts;
                let mut on = parts
                    .iter()
                    .map(|&part| self.place_of_carrier(cut.unit, part));
                hung != cut.unit && on.any(|place| place == Some(cut.place))
            }
        }
    }

    fn bodies_of<'b>(&'b self, own: Mover, cut: &'b Cut) -> Vec<&'b TriMesh> {
        match own {
            Mover::Piece => vec![&cut.piece],
            Mover::Unit(unit) if unit == cut.unit => {
                let whole = self.bodies[unit].iter().copied().enumerate();
                let others = whole.filter(|(place, _)| *place != cut.place);
                others.map(|(_, body)| body).chain(&cut.rest).collect()
            }
            Mover::Unit(unit) => self.bodies[unit].clone(),
        }
    }
}

/// Returns true if a body on its way meets another one.
fn meets(moving: &TriMesh, fixed: &TriMesh, way: &Vector) -> bool {
    barred_mm2(moving, fixed, way) > FREE_MM2
}

fn flip(plane: &Plane) -> Plane {
    Plane {
        normal: -plane.normal,
        offset_mm: -plane.offset_mm,
    }
}
