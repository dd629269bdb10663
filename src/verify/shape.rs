//! Facts about the surfaces of the parts: every triangle held against what it should be.
//!
//! A part consists of surfaces of the uncut body with its drain holes, of cut faces, and of its
//! pins, sockets and ids. A cut face must have its counterpart on another part.

use rayon::prelude::*;

use super::cover::{Lie, ON_SHEET_MM, Sheet, Sheets, Whose, normal_of};
use super::drains::Bored;
use super::files::HOLLOWED_FILE;
use super::peg_shape::Relief;
use super::plugs::MeantPlug;
use super::{Evidence, Shells};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Plane, Point, Vector};
use crate::mesh::{MeshDistance, TriMesh};

/// A triangle that lies on nothing is compared with surfaces that face as it does to 60°: a face of
/// a cut is no wall.
const ALIKE_COSINE: f64 = 0.5;

/// Triangles that are not where they should be.
#[derive(Debug, Clone, PartialEq)]
pub struct Stray {
    /// The part that has too much, or lacks a pin, socket or id; `hollowed.stl` for a surface of
    /// the uncut body that no part has.
    pub of: String,
    /// True if they are missing, false if they are too much.
    pub is_missing: bool,
    /// Their number.
    pub triangles: usize,
    /// A point of the one that is farthest off, model frame, mm.
    pub at: Point,
    /// Its distance from where it should be, mm.
    pub off_mm: f64,
}

/// The surfaces of the parts, compared with what they should be.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ShapeFacts {
    /// The surfaces that are too much or missing; empty for parts as they should be.
    pub strays: Vec<Stray>,
    /// The smallest wall in the parts, mm, if they are not as they should be. Otherwise it is that
    /// of the uncut body. `None` without voids.
    pub wall_mm: Option<f64>,
}

/// A triangle, model frame, mm.
type Corners = [Point; 3];

/// The surfaces of the uncut body.
struct Uncut {
    outer: Vec<Corners>,
    inner: Vec<Corners>,
    /// The walls of its drain holes.
    bores: Vec<Corners>,
    /// The plugs of these holes.
    plugs: Vec<MeantPlug>,
}

impl Uncut {
    /// Returns the surfaces of a body, with its holes if it has any.
    fn of(shells: &Shells, bored: Option<&Bored>) -> Self {
        match bored {
            Some(bored) => Self {
                outer: bored.outer.clone(),
                inner: bored.inner.clone(),
                bores: bored.walls.clone(),
                plugs: bored.plugs.clone(),
            },
            None => Self {
                outer: shells.outer_mesh().iter_corners().collect(),
                inner: shells.inner_mesh().iter_corners().collect(),
                bores: Vec::new(),
                plugs: Vec::new(),
            },
        }
    }
}

/// The surfaces that the parts should have.
struct Plan {
    sheets: Sheets,
    /// Number of sheets of the outer surface. Those of the voids follow, up to `of_body`.
    of_outer: usize,
    /// Number of sheets of the uncut body.
    of_body: usize,
    /// Every sheet that some part must have, and the part, if it is known.
    wanted: Vec<(Corners, Option<usize>)>,
}

/// Compares the parts with the uncut body, the cuts, and the stated pins, sockets and ids. The
/// answer is the same on any number of threads.
pub(super) fn measure_shapes(
    evidence: &Evidence,
    shells: &Shells,
    bored: Option<&Bored>,
    watch: &Watch,
) -> Result<ShapeFacts, Cancelled> {
    let parts: Vec<Vec<Corners>> = evidence
        .parts
        .iter()
        .map(|part| {
            let corners = part.mesh.iter_corners();
            corners.map(|c| c.map(|p| part.pose.to_model(&p))).collect()
        })
        .collect();
    watch.check()?;
    let plan = Plan::new(evidence, Uncut::of(shells, bored), &parts);
    watch.check()?;
    let mut strays = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let triangles = part.par_iter().map(|c| (*c, Some(index)));
        let off = find_off(&plan.sheets, triangles, watch)?;
        strays.extend(plan.sheets.stray(&evidence.parts[index].id, false, &off));
    }
    watch.check()?;
    let owned = |(owner, part): (usize, &Vec<Corners>)| {
        let whose = Whose::Only(owner);
        let sheets = part.iter().map(move |&corners| Sheet { corners, whose });
        sheets.collect::<Vec<Sheet>>()
    };
    let found = Sheets::new(parts.iter().enumerate().flat_map(owned).collect());
    let lacking = find_off(&found, plan.wanted.par_iter().copied(), watch)?;
    let owners = std::iter::once(None).chain((0..parts.len()).map(Some));
    for owner in owners {
        let of_owner = lacking.iter().filter(|off| off.part == owner).copied();
        let id = owner.map_or(HOLLOWED_FILE, |part| &evidence.parts[part].id);
        strays.extend(found.stray(id, true, &of_owner.collect::<Vec<Off>>()));
    }
    let wall_mm = (!strays.is_empty()).then(|| plan.wall_mm(&parts)).flatten();
    Ok(ShapeFacts { strays, wall_mm })
}

/// A triangle that lies off its sheets.
#[derive(Clone, Copy)]
struct Off {
    part: Option<usize>,
    at: Point,
}

/// Returns the triangles that lie off the sheets, in their order.
fn find_off(
    sheets: &Sheets,
    triangles: impl IndexedParallelIterator<Item = (Corners, Option<usize>)>,
    watch: &Watch,
) -> Result<Vec<Off>, Cancelled> {
    let off = triangles.map(|(corners, part)| {
        watch.check()?;
        Ok(match sheets.lie(&corners, part) {
            Lie::On(_) => None,
            Lie::Off(at) => Some(Off { part, at }),
        })
    });
    let off = off.collect::<Result<Vec<_>, Cancelled>>()?;
    Ok(off.into_iter().flatten().collect())
}

impl Sheets {
    /// Sums up triangles that lie off the sheets; `None` if there are none.
    fn stray(&self, of: &str, is_missing: bool, off: &[Off]) -> Option<Stray> {
        // A point on a sheet that faces away or belongs to another part counts as just off.
        let distance = |off: &Off| {
            let nearest = self.nearest(&off.at);
            (
                nearest.map_or(f64::INFINITY, |(_, mm)| mm).max(ON_SHEET_MM),
                off.at,
            )
        };
        let distances: Vec<(f64, Point)> = off.par_iter().map(distance).collect();
        let worst = distances.iter().copied();
        let (off_mm, at) = worst.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Stray {
            of: of.to_owned(),
            is_missing,
            triangles: off.len(),
            at,
            off_mm,
        })
    }
}

impl Plan {
    fn new(evidence: &Evidence, uncut: Uncut, parts: &[Vec<Corners>]) -> Self {
        let plugs = uncut.plugs;
        let (of_outer, of_body) = (uncut.outer.len(), uncut.outer.len() + uncut.inner.len());
        let body = uncut.outer.into_iter().chain(uncut.inner);
        let body: Vec<Corners> = body.chain(uncut.bores).collect();
        let mut wanted: Vec<(Corners, Option<usize>)> = body.iter().map(|&c| (c, None)).collect();
        let sheet = |corners: Corners, whose: Whose| Sheet { corners, whose };
        let mut sheets: Vec<Sheet> = body.into_iter().map(|c| sheet(c, Whose::Any)).collect();
        for (index, Relief { own, mouth, .. }) in reliefs(evidence) {
            wanted.extend(own.iter().map(|&corners| (corners, Some(index))));
            sheets.extend(own.into_iter().map(|c| sheet(c, Whose::Only(index))));
            sheets.extend(mouth.into_iter().map(|c| sheet(c, Whose::AllBut(index))));
        }
        for plug in plugs {
            let mut own = evidence.parts.iter();
            let Some(index) = own.position(|part| part.id == plug.part) else {
                continue;
            };
            let plug: Vec<Corners> = plug.mesh.iter_corners().collect();
            wanted.extend(plug.iter().map(|&corners| (corners, Some(index))));
            sheets.extend(plug.into_iter().map(|c| sheet(c, Whose::Only(index))));
        }
        let planes: Vec<Plane> = evidence
            .promise
            .cuts
            .iter()
            .map(|cut| Plane::through(&Point::from(cut.point_mm), &Vector::from(cut.normal)))
            .collect();
        let in_plane = |corners: &&Corners| {
            let lies_in = |plane: &Plane| {
                let mut corners = corners.iter();
                corners.all(|p| plane.distance(p).abs() <= ON_SHEET_MM)
            };
            planes.iter().any(lies_in)
        };
        for (index, part) in parts.iter().enumerate() {
            let faces = part.iter().filter(in_plane);
            let turned = faces.map(|&[a, b, c]| sheet([a, c, b], Whose::AllBut(index)));
            sheets.extend(turned);
        }
        Self {
            sheets: Sheets::new(sheets),
            of_outer,
            of_body,
            wanted,
        }
    }

    /// Returns the smallest distance between the voids' and the outer triangles of the parts, mm.
    /// Triangles that lie on nothing count as what is nearest to them, if that faces about as they
    /// do. Those nearest to a joint do not count.
    fn wall_mm(&self, parts: &[Vec<Corners>]) -> Option<f64> {
        let body = &self.wanted[..self.of_body];
        let [outside, inside] = [&body[..self.of_outer], &body[self.of_outer..]]
            .map(|side| Bvh::new(side.iter().map(|(corners, _)| *corners)));
        let is_inner = |index: usize, corners: &Corners| match self.sheets.lie(corners, Some(index))
        {
            Lie::On(sheet) if sheet as usize >= self.of_body => None,
            Lie::On(sheet) => Some(sheet as usize >= self.of_outer),
            Lie::Off(at) => {
                let normal = normal_of(corners)?;
                let (nearest, _) = self.sheets.nearest(&at)?;
                if nearest as usize >= self.of_body {
                    return None;
                }
                let distance = |tree: &Bvh, first: usize| {
                    let nearest = tree.closest(&at, f64::INFINITY, &[])?;
                    let (sheet, _) = body[first + nearest.triangle as usize];
                    let is_alike = normal.dot(&normal_of(&sheet)?) >= ALIKE_COSINE;
                    is_alike.then_some(nearest.distance_squared)
                };
                let outer = distance(&outside, 0).unwrap_or(f64::INFINITY);
                let inner = distance(&inside, self.of_outer).unwrap_or(f64::INFINITY);
                (outer.min(inner) < f64::INFINITY).then_some(inner < outer)
            }
        };
        let parts = parts.par_iter().enumerate();
        let places: Vec<(Corners, Option<bool>)> = parts
            .flat_map_iter(|(index, part)| part.iter().map(move |c| (*c, is_inner(index, c))))
            .collect();
        let [outer, inner] = [false, true].map(|side| {
            let chosen = places.iter().filter(|(_, place)| *place == Some(side));
            mesh_of(chosen.map(|(corners, _)| corners))
        });
        let is_there = !outer.triangles().is_empty() && !inner.triangles().is_empty();
        is_there.then(|| MeshDistance::new(&outer).min_distance_to(&inner))
    }
}

/// Returns the surfaces of all pins, sockets and ids, with the index of the part that has each.
fn reliefs(evidence: &Evidence) -> Vec<(usize, Relief)> {
    let parts = evidence.promise.parts.iter().enumerate();
    let of_part = parts.flat_map(|(index, part)| {
        let pins = part.pins.iter().map(|pin| pin.pin_relief());
        let sockets = part.sockets.iter().map(|socket| socket.socket_relief());
        let marks = part.marks.iter().map(|mark| mark.relief());
        let all = pins.chain(sockets).chain(marks);
        all.map(move |relief| (index, relief))
    });
    of_part.collect()
}

/// Returns triangles as a mesh; corners at one place stay apart.
fn mesh_of<'a>(triangles: impl Iterator<Item = &'a Corners>) -> TriMesh {
    let vertices: Vec<Point> = triangles.flatten().copied().collect();
    let faces = (0..vertices.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let faces = faces.collect();
    TriMesh::new(vertices, faces).unwrap_or_default()
}
