//! Facts about the cleaning of voids: the openings, and the share of each wall in sight of them, on
//! the written parts.

use std::collections::BTreeSet;

use rayon::prelude::*;
use serde::Serialize;

use super::mouths::{MouthPoint, sample_mouths};
use super::part_probe::PartProbe;
use super::shells::connected_pieces;
use super::{Promise, PromisedCut};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::triangle::closest_on_segment;
use crate::geom::{Bvh, Plane, Point, Vector};
use crate::mesh::{SurfacePoint, TriMesh, spread_points, surface_mm2};
use crate::repair::weld;

/// Distance within which triangles belong to a void's wall and points lie in a cut, mm. It is a
/// hundred steps of f32 coordinates at 100 mm, and a tenth of the thinnest layer.
const NEAR_MM: f64 = 1e-3;
/// Number of sample points on each void's wall: a share of 5 % is then known to four thousandths.
const SAMPLES: f64 = 3000.0;
/// Greatest number of viewpoints in the mouths of a piece.
const MAX_VIEWPOINTS: usize = 400;
/// Share of a line of sight that must be clear; the rest would meet the wall it ends on.
const CLEAR_RATIO: f64 = 0.999;
/// Pieces of a wall below this share are slivers that rounding leaves along a rim.
const SLIVER_RATIO: f64 = 1e-4;
/// A pocket no deeper than half its mouth lies in plain sight, and its mouth may be of any width.
const DIMPLE_RATIO: f64 = 0.5;

/// Facts about the openings of a void in the written parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VoidFacts {
    /// The name on the sheet.
    pub id: String,
    /// Diameters of the largest discs through the mouths of every piece that is no dimple, the
    /// widest first, mm.
    pub openings_mm: Vec<Vec<f64>>,
    /// Share of its wall in sight of the mouths of the same piece and within the tool's reach.
    pub sight_ratio: f64,
    /// Share of its wall that is in sight, or printed without support since it does not face down
    /// or is steep enough.
    pub clean_ratio: f64,
    /// Indices of the cuts in which the rims of its pieces lie.
    pub cuts: BTreeSet<usize>,
    /// Indices of the parts that hold a piece of it.
    pub holders: BTreeSet<usize>,
}

impl VoidFacts {
    /// Returns the diameter of the widest mouth of the piece whose widest is narrowest, mm; `None`
    /// if all are dimples.
    pub fn opening_mm(&self) -> Option<f64> {
        let widest = self.openings_mm.iter();
        let widest = widest.map(|piece| piece.first().copied().unwrap_or(0.0));
        widest.reduce(f64::min)
    }
}

/// A point in a mouth, with the index of its cut.
type OwnPoint = (usize, MouthPoint);

/// A connected piece of a void's wall on a part.
struct Patch<'a> {
    probe: &'a PartProbe<'a>,
    /// Its triangles, model frame.
    wall: TriMesh,
    /// Its open edges that lie in a cut, with the cut's index.
    rims: Vec<(usize, [Point; 2])>,
}

/// Inspects the voids of the uncut result on the parts; empty if no cleaning was ordered.
pub(super) fn inspect_voids(
    promise: &Promise,
    cavities: &[TriMesh],
    probes: &[PartProbe],
    watch: &Watch,
) -> Result<Vec<VoidFacts>, Cancelled> {
    let Some(cleaning) = promise.printer.cleaning else {
        return Ok(Vec::new());
    };
    let plane =
        |cut: &PromisedCut| Plane::through(&Point::from(cut.point_mm), &Vector::from(cut.normal));
    let planes: Vec<Plane> = promise.cuts.iter().map(plane).collect();
    let parts = probes.par_iter().map(PlacedPart::new).collect::<Vec<_>>();
    let tool_mm = promise.printer.minimum_opening_mm.unwrap_or(0.0);
    let inspector = Inspector {
        planes: &planes,
        tool_mm,
        reach_mm: cleaning.reach_mm.unwrap_or(f64::INFINITY),
        overhang_deg: cleaning.overhang_deg,
        watch,
    };
    let facts = |(index, cavity): (usize, &TriMesh)| {
        let id = promise
            .voids
            .get(index)
            .map_or_else(|| format!("V{}", index + 1), |void| void.id.clone());
        inspector.inspect(id, cavity, &parts)
    };
    cavities.par_iter().enumerate().map(facts).collect()
}

/// A part with its welded surface in its place in the model.
struct PlacedPart<'a> {
    probe: &'a PartProbe<'a>,
    surface: TriMesh,
}

impl<'a> PlacedPart<'a> {
    fn new(probe: &'a PartProbe) -> Self {
        let part = probe.part;
        let surface = weld(&part.mesh).map_vertices(|p| part.pose.to_model(p));
        Self { probe, surface }
    }
}

/// The inspection of voids: the planes of the cuts, the limits of the tool and the process, and the
/// watch.
struct Inspector<'a> {
    planes: &'a [Plane],
    tool_mm: f64,
    reach_mm: f64,
    overhang_deg: Option<f64>,
    watch: &'a Watch,
}

impl Inspector<'_> {
    /// Measures the openings of a void and the shares of its wall on all parts.
    fn inspect(
        &self,
        id: String,
        cavity: &TriMesh,
        parts: &[PlacedPart],
    ) -> Result<VoidFacts, Cancelled> {
        let surface = Bvh::new(cavity.iter_corners());
        let area = surface_mm2(cavity);
        let mouths = |plane: &Plane| {
            self.watch.check()?;
            Ok(sample_mouths(cavity, plane, self.tool_mm / 2.0))
        };
        let mouths = self.planes.iter().map(mouths);
        let mouths = mouths.collect::<Result<Vec<Vec<MouthPoint>>, Cancelled>>()?;
        let (mut openings_mm, mut found, mut seen, mut clean) = (Vec::new(), 0.0, 0.0, 0.0);
        let (mut cuts, mut holders) = (BTreeSet::new(), BTreeSet::new());
        for (index, part) in parts.iter().enumerate() {
            for patch in self.patches(&surface, part) {
                let wall_mm2 = surface_mm2(&patch.wall);
                if wall_mm2 < SLIVER_RATIO * area {
                    continue;
                }
                self.watch.check()?;
                cuts.extend(patch.rims.iter().map(|(cut, _)| *cut));
                holders.insert(index);
                let own = patch.own_points(&mouths);
                openings_mm.extend(self.openings(&patch, &own));
                let [seen_ratio, clean_ratio] =
                    self.shares(&patch, &own, (wall_mm2 / area * SAMPLES) as usize)?;
                found += wall_mm2;
                seen += seen_ratio * wall_mm2;
                clean += clean_ratio * wall_mm2;
            }
        }
        // Any of the wall that is on no part counts as out of sight.
        let whole = f64::max(found, area).max(f64::MIN_POSITIVE);
        Ok(VoidFacts {
            id,
            openings_mm,
            sight_ratio: seen / whole,
            clean_ratio: clean / whole,
            cuts,
            holders,
        })
    }

    /// Returns the connected pieces of a void's wall on a part.
    fn patches<'a>(&self, void: &Bvh, part: &'a PlacedPart) -> Vec<Patch<'a>> {
        let PlacedPart { probe, surface } = part;
        let in_cut = |points: &[Point]| {
            self.planes
                .iter()
                .position(|plane| points.iter().all(|p| plane.distance(p).abs() < NEAR_MM))
        };
        let is_wall = |t: &&[u32; 3]| {
            let corners = t.map(|v| surface.vertices()[v as usize]);
            let middle =
                Point::from((corners[0].coords + corners[1].coords + corners[2].coords) / 3.0);
            void.closest(&middle, NEAR_MM, &[]).is_some() && in_cut(&corners).is_none()
        };
        let triangles: Vec<[u32; 3]> = surface
            .triangles()
            .par_iter()
            .filter(is_wall)
            .copied()
            .collect();
        let all = TriMesh::new(surface.vertices().to_vec(), triangles).unwrap_or_default();
        let patch = |wall: TriMesh| {
            let rims = open_edges(&wall).into_iter();
            Patch {
                probe,
                rims: rims
                    .filter_map(|edge| Some((in_cut(&edge)?, edge)))
                    .collect(),
                wall,
            }
        };
        connected_pieces(&all).into_iter().map(patch).collect()
    }

    /// Returns the widths of the mouths of a piece, the widest first, mm; `None` if it is a dimple.
    fn openings(&self, patch: &Patch, own: &[OwnPoint]) -> Option<Vec<f64>> {
        let mut widest: Vec<((usize, usize), f64)> = Vec::new();
        for (cut, point) in own {
            let (mouth, width_mm) = ((*cut, point.mouth), 2.0 * point.room_mm);
            match widest.iter_mut().find(|(known, _)| *known == mouth) {
                Some((_, most_mm)) => *most_mm = most_mm.max(width_mm),
                None => widest.push((mouth, width_mm)),
            }
        }
        widest.sort_by(|a, b| b.1.total_cmp(&a.1));
        let is_dimple = widest.first().is_some_and(|&((cut, _), width_mm)| {
            let heights = patch
                .wall
                .vertices()
                .iter()
                .map(|p| self.planes[cut].distance(p).abs());
            heights.fold(0.0, f64::max) <= DIMPLE_RATIO * width_mm
        });
        (!is_dimple).then(|| widest.into_iter().map(|(_, width_mm)| width_mm).collect())
    }

    /// Returns the shares of a piece's wall in sight, and in sight or printed without support.
    fn shares(&self, patch: &Patch, own: &[OwnPoint], count: usize) -> Result<[f64; 2], Cancelled> {
        let viewpoints = self.viewpoints(own);
        let corners: Vec<[Point; 3]> = patch.wall.iter_corners().collect();
        let points = spread_points(&corners, count.max(1));
        let is_seen_and_clean = |point: &SurfacePoint| {
            self.watch.check()?;
            let is_seen = viewpoints
                .iter()
                .any(|eye| self.sees(patch.probe, eye, &point.at));
            let is_clean =
                is_seen || self.is_self_supporting(patch.probe, &corners[point.triangle]);
            Ok([is_seen, is_clean])
        };
        let seen_and_clean = points.par_iter().map(is_seen_and_clean);
        let seen_and_clean = seen_and_clean.collect::<Result<Vec<[bool; 2]>, Cancelled>>()?;
        let total = seen_and_clean.len().max(1) as f64;
        Ok([0, 1].map(|i| seen_and_clean.iter().filter(|is| is[i]).count() as f64 / total))
    }

    /// Returns a thinned list of the points that let the tool in, or the widest if none does.
    fn viewpoints(&self, own: &[OwnPoint]) -> Vec<Point> {
        let mut roomy: Vec<&MouthPoint> = own.iter().map(|(_, point)| point).collect();
        roomy.sort_by(|a, b| b.room_mm.total_cmp(&a.room_mm));
        let wide = roomy
            .iter()
            .filter(|point| 2.0 * point.room_mm >= self.tool_mm)
            .count()
            .max(1);
        let stride = wide.div_ceil(MAX_VIEWPOINTS).max(1);
        roomy
            .iter()
            .take(wide)
            .step_by(stride)
            .map(|point| point.at)
            .collect()
    }

    /// Returns true if the wall at a point is within reach of the eye and nothing of the part is
    /// between them.
    fn sees(&self, probe: &PartProbe, eye: &Point, at: &Point) -> bool {
        let line = at - eye;
        line.norm() <= self.reach_mm && probe.is_clear(eye, &(eye + line * CLEAR_RATIO))
    }

    /// Returns true if a triangle of a part's surface prints without support: it faces up or is
    /// steep enough.
    fn is_self_supporting(&self, probe: &PartProbe, [a, b, c]: &[Point; 3]) -> bool {
        let Some(overhang_deg) = self.overhang_deg else {
            return false;
        };
        let normal = probe.part.pose.rotation() * (b - a).cross(&(c - a));
        -normal.z <= overhang_deg.to_radians().cos() * normal.norm()
    }
}

impl Patch<'_> {
    /// Returns the points of the void's mouths whose nearest rim belongs to this piece.
    fn own_points(&self, mouths: &[Vec<MouthPoint>]) -> Vec<OwnPoint> {
        let is_own = |cut: usize, point: &MouthPoint| {
            let edges = self.rims.iter().filter(|(of, _)| *of == cut);
            edges.into_iter().any(|(_, [a, b])| {
                (closest_on_segment(&point.rim, a, b) - point.rim).norm() < 2.0 * NEAR_MM
            })
        };
        let all = mouths
            .iter()
            .enumerate()
            .flat_map(|(cut, points)| points.iter().map(move |point| (cut, *point)));
        all.filter(|(cut, point)| is_own(*cut, point)).collect()
    }
}

/// Returns the edges of a surface with a triangle on one side only.
fn open_edges(mesh: &TriMesh) -> Vec<[Point; 2]> {
    let mut sides: Vec<[u32; 2]> = mesh
        .triangles()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .collect();
    sides.sort_unstable();
    let is_open = |&[a, b]: &[u32; 2]| sides.binary_search(&[b, a]).is_err();
    let open = sides.iter().copied().filter(is_open);
    open.map(|side| side.map(|v| mesh.vertices()[v as usize]))
        .collect()
}
