//! Whether every void can be cleaned: its wall on the written parts, looked at through the mouths
//! that the cuts leave in it.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::mouths::{Place, places};
use super::pegs::Felt;
use super::shells::pieces;
use super::{Check, CheckKind, Limit, Promise};
use crate::geom::triangle::closest_on_segment;
use crate::geom::{Bvh, Plane, Point, Vector};
use crate::mesh::{TriMesh, area_mm2, spread_points};
use crate::printer::CleaningRule;
use crate::repair::weld;

/// What is within this of a void's surface is its wall, and what is within it of a cut lies in it,
/// mm: a hundred steps of f32 coordinates at 100 mm, a tenth of the thinnest layer.
const NEAR_MM: f64 = 1e-3;
/// Points of each void's wall that are looked at: a share of 5 % is then known to four thousandths.
const SAMPLES: f64 = 3000.0;
/// Places of a piece's mouths that are looked from, at most.
const EYES: usize = 400;
/// The part of a line of sight that is looked along: the rest would meet the wall it ends on.
const LOOKED_RATIO: f64 = 0.999;
/// Pieces of a wall below this share of it are what rounding leaves of triangles along a rim.
const CRUMB_RATIO: f64 = 1e-4;
/// A pocket no deeper than half its mouth lies in plain sight, and its mouth may be of any width.
const DIMPLE_RATIO: f64 = 0.5;
/// A measured opening may fall short of the least by this share: where the widest disc lies is
/// searched for by steps.
const OPENING_SLACK_RATIO: f64 = 2e-3;
/// A stated share in sight may differ from the found one by this: four standard deviations of two
/// samples of 2000 and 3000 at a half, where they are widest, are 0.058; where 95 % is asked they
/// are 0.025.
pub const SIGHT_TOLERANCE_RATIO: f64 = 0.06;

/// A cut of the checklist.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PromisedCut {
    /// A point of its plane, model frame, mm.
    pub point_mm: [f64; 3],
    /// The normal of its plane, model frame.
    pub normal: [f64; 3],
}

/// What the checklist says of a void, in the order of the cavities of `hollowed.stl`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PromisedVoid {
    /// The name on the sheet, such as `V1`.
    pub id: String,
    /// The share of its wall in sight of its openings, if it was measured.
    #[serde(default)]
    pub sight_ratio: Option<f64>,
    /// The least opening that was ordered for it, mm; the printer's where none is stated.
    #[serde(default)]
    pub least_opening_mm: Option<f64>,
}

/// How a void lies open in the written parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VoidFacts {
    /// The name on the sheet.
    pub id: String,
    /// For every piece of it that is no dimple, the diameters of the largest discs through its
    /// mouths, the widest first, mm.
    pub openings_mm: Vec<Vec<f64>>,
    /// The share of its wall in sight of the mouths of its own piece, and within the tool's reach.
    pub sight_ratio: f64,
    /// The share that is in sight, or printed without support because it does not look down, or
    /// leans enough.
    pub clean_ratio: f64,
}

/// A connected piece of a void's wall on a part.
struct Patch<'a> {
    felt: &'a Felt<'a>,
    /// Its triangles, model frame.
    wall: TriMesh,
    /// Its edges that lie in a cut, with the cut's index.
    rims: Vec<(usize, [Point; 2])>,
}

/// The voids of the uncut result as the parts have them; none where no cleaning was ordered.
pub(super) fn voids(promise: &Promise, cavities: &[TriMesh], felt: &[Felt]) -> Vec<VoidFacts> {
    let Some(cleaning) = promise.printer.cleaning else {
        return Vec::new();
    };
    let plane =
        |cut: &PromisedCut| Plane::through(&Point::from(cut.point_mm), &Vector::from(cut.normal));
    let planes: Vec<Plane> = promise.cuts.iter().map(plane).collect();
    let parts: Vec<TriMesh> = felt.par_iter().map(in_model).collect();
    let tool_mm = promise.printer.minimum_opening_mm.unwrap_or(0.0);
    let (reach_mm, overhang_deg) = (
        cleaning.reach_mm.unwrap_or(f64::INFINITY),
        cleaning.overhang_deg,
    );
    let seeker = Seeker {
        planes: &planes,
        tool_mm,
        reach_mm,
        overhang_deg,
    };
    let fact = |(index, cavity): (usize, &TriMesh)| {
        let id = promise
            .voids
            .get(index)
            .map_or_else(|| format!("V{}", index + 1), |void| void.id.clone());
        seeker.void(id, cavity, (felt, &parts))
    };
    cavities.par_iter().enumerate().map(fact).collect()
}

/// A part's triangles where they belong in the model.
fn in_model(felt: &Felt) -> TriMesh {
    weld(&felt.part.mesh).map_vertices(|p| felt.part.pose.to_model(p))
}

/// How voids are looked into.
struct Seeker<'a> {
    planes: &'a [Plane],
    tool_mm: f64,
    reach_mm: f64,
    overhang_deg: Option<f64>,
}

impl Seeker<'_> {
    fn void(
        &self,
        id: String,
        cavity: &TriMesh,
        (felt, parts): (&[Felt], &[TriMesh]),
    ) -> VoidFacts {
        let surface = Bvh::new(cavity.iter_corners());
        let area: f64 = cavity
            .iter_corners()
            .map(|corners| area_mm2(&corners))
            .sum();
        let mouths: Vec<Vec<Place>> = self
            .planes
            .iter()
            .map(|plane| places(cavity, plane, self.tool_mm / 2.0))
            .collect();
        let (mut openings_mm, mut found, mut seen, mut clean) = (Vec::new(), 0.0, 0.0, 0.0);
        for (felt, part) in felt.iter().zip(parts) {
            for patch in self.patches(&surface, felt, part) {
                let wall_mm2: f64 = patch
                    .wall
                    .iter_corners()
                    .map(|corners| area_mm2(&corners))
                    .sum();
                if wall_mm2 < CRUMB_RATIO * area {
                    continue;
                }
                let own = patch.places(&mouths);
                openings_mm.extend(self.openings(&patch, &own));
                let [in_sight, cleaned] =
                    self.looked_at(&patch, &own, (wall_mm2 / area * SAMPLES) as usize);
                found += wall_mm2;
                seen += in_sight * wall_mm2;
                clean += cleaned * wall_mm2;
            }
        }
        // What no part has of the wall counts as out of sight.
        let whole = f64::max(found, area).max(f64::MIN_POSITIVE);
        VoidFacts {
            id,
            openings_mm,
            sight_ratio: seen / whole,
            clean_ratio: clean / whole,
        }
    }

    /// The connected pieces of a void's wall on a part.
    fn patches<'a>(&self, surface: &Bvh, felt: &'a Felt<'a>, part: &TriMesh) -> Vec<Patch<'a>> {
        let in_cut = |points: &[Point]| {
            self.planes
                .iter()
                .position(|plane| points.iter().all(|p| plane.distance(p).abs() < NEAR_MM))
        };
        let is_wall = |t: &&[u32; 3]| {
            let corners = t.map(|v| part.vertices()[v as usize]);
            let middle =
                Point::from((corners[0].coords + corners[1].coords + corners[2].coords) / 3.0);
            surface.closest(&middle, NEAR_MM, &[]).is_some() && in_cut(&corners).is_none()
        };
        let triangles: Vec<[u32; 3]> = part.triangles().iter().filter(is_wall).copied().collect();
        let all = TriMesh::new(part.vertices().to_vec(), triangles).unwrap_or_default();
        let patch = |wall: TriMesh| {
            let rims = open_edges(&wall).into_iter();
            Patch {
                felt,
                rims: rims
                    .filter_map(|edge| Some((in_cut(&edge)?, edge)))
                    .collect(),
                wall,
            }
        };
        pieces(&all).into_iter().map(patch).collect()
    }

    /// The openings of a piece that is no dimple.
    fn openings(&self, patch: &Patch, own: &[(usize, Place)]) -> Option<Vec<f64>> {
        let mut widest: Vec<((usize, usize), f64)> = Vec::new();
        for (cut, place) in own {
            let (name, wide_mm) = ((*cut, place.mouth), 2.0 * place.room_mm);
            match widest.iter_mut().find(|(known, _)| *known == name) {
                Some((_, most_mm)) => *most_mm = most_mm.max(wide_mm),
                None => widest.push((name, wide_mm)),
            }
        }
        widest.sort_by(|a, b| b.1.total_cmp(&a.1));
        let is_dimple = widest.first().is_some_and(|&((cut, _), wide_mm)| {
            let heights = patch
                .wall
                .vertices()
                .iter()
                .map(|p| self.planes[cut].distance(p).abs());
            heights.fold(0.0, f64::max) <= DIMPLE_RATIO * wide_mm
        });
        (!is_dimple).then(|| widest.into_iter().map(|(_, wide_mm)| wide_mm).collect())
    }

    /// The shares of a piece's wall in sight, and in sight or printed without support.
    fn looked_at(&self, patch: &Patch, own: &[(usize, Place)], count: usize) -> [f64; 2] {
        let eyes = self.eyes(own);
        let corners: Vec<[Point; 3]> = patch.wall.iter_corners().collect();
        let points = spread_points(&corners, count.max(1));
        let looks: Vec<[bool; 2]> = points
            .par_iter()
            .map(|point| {
                let is_seen = eyes.iter().any(|eye| self.sees(patch.felt, eye, &point.at));
                [
                    is_seen,
                    is_seen || self.needs_nothing(patch.felt, &corners[point.triangle]),
                ]
            })
            .collect();
        [0, 1]
            .map(|i| looks.iter().filter(|look| look[i]).count() as f64 / looks.len().max(1) as f64)
    }

    /// The places that let the tool in, thinned; the widest where none does.
    fn eyes(&self, own: &[(usize, Place)]) -> Vec<Point> {
        let mut roomy: Vec<&Place> = own.iter().map(|(_, place)| place).collect();
        roomy.sort_by(|a, b| b.room_mm.total_cmp(&a.room_mm));
        let wide = roomy
            .iter()
            .filter(|place| 2.0 * place.room_mm >= self.tool_mm)
            .count()
            .max(1);
        let stride = wide.div_ceil(EYES).max(1);
        roomy
            .iter()
            .take(wide)
            .step_by(stride)
            .map(|place| place.at)
            .collect()
    }

    /// Whether nothing of the part is between the eye and a place of its wall within reach.
    fn sees(&self, felt: &Felt, eye: &Point, at: &Point) -> bool {
        let line = at - eye;
        line.norm() <= self.reach_mm && felt.is_clear(eye, &(eye + line * LOOKED_RATIO))
    }

    /// Whether a triangle of a part's surface prints without support: it looks up, or leans enough
    /// from the level.
    fn needs_nothing(&self, felt: &Felt, [a, b, c]: &[Point; 3]) -> bool {
        let Some(overhang_deg) = self.overhang_deg else {
            return false;
        };
        let normal = felt.part.pose.rotation() * (b - a).cross(&(c - a));
        -normal.z <= overhang_deg.to_radians().cos() * normal.norm()
    }
}

impl Patch<'_> {
    /// The places of the void's mouths whose nearest rim is this piece's, with their cuts.
    fn places(&self, mouths: &[Vec<Place>]) -> Vec<(usize, Place)> {
        let is_own = |cut: usize, place: &Place| {
            let edges = self.rims.iter().filter(|(of, _)| *of == cut);
            edges.into_iter().any(|(_, [a, b])| {
                (closest_on_segment(&place.rim, a, b) - place.rim).norm() < 2.0 * NEAR_MM
            })
        };
        let all = mouths
            .iter()
            .enumerate()
            .flat_map(|(cut, places)| places.iter().map(move |place| (cut, *place)));
        all.filter(|(cut, place)| is_own(*cut, place)).collect()
    }
}

/// The edges of a surface that have one side only.
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

/// Whether every void is open and clean by the printer's rule.
pub(super) fn cleaning_checks(promise: &Promise, found: &[VoidFacts]) -> Vec<Check> {
    let Some(cleaning) = promise.printer.cleaning else {
        return Vec::new();
    };
    let mut checks = Vec::new();
    for (index, void) in found.iter().enumerate() {
        let ordered = promise.voids.get(index);
        let least_mm = ordered
            .and_then(|void| void.least_opening_mm)
            .or(promise.printer.minimum_opening_mm);
        checks.push(opening_check(
            void,
            cleaning.pair_opening_mm,
            least_mm.unwrap_or(0.0),
        ));
        let share = match cleaning.rule {
            CleaningRule::InSight => Some(("in sight of its openings", void.sight_ratio)),
            CleaningRule::InSightOrSelfSupporting => Some((
                "in sight of its openings, or printed without support",
                void.clean_ratio,
            )),
            CleaningRule::MeltOut | CleaningRule::PowderEscape => None,
        };
        checks.extend(share.map(|(what, ratio)| {
            let promise = format!("the wall of {} is {what}, to a share of", void.id);
            let kind = CheckKind::VoidClean {
                void: void.id.clone(),
            };
            Check::new(
                kind,
                &promise,
                Some(ratio),
                Limit::at_least(cleaning.sight_ratio, ""),
            )
        }));
    }
    checks.extend(stated_check(promise, found));
    checks
}

/// Whether every piece of a void has an opening wide enough, or two where two smaller ones do.
fn opening_check(void: &VoidFacts, pair_mm: Option<f64>, least_mm: f64) -> Check {
    let by_pair = |openings: &Vec<f64>| {
        let second_mm = openings.get(1).copied().unwrap_or(0.0);
        let one_mm = openings.first().copied().unwrap_or(0.0);
        if pair_mm.is_some_and(|pair_mm| second_mm >= pair_mm) {
            one_mm.max(least_mm)
        } else {
            one_mm
        }
    };
    let narrowest_mm = void.openings_mm.iter().map(by_pair).reduce(f64::min);
    let promise = format!("every piece of {} opens by", void.id);
    let limit = Limit::at_least(least_mm * (1.0 - OPENING_SLACK_RATIO), "mm");
    // A void in which every piece is a dimple lies in plain sight.
    let value = narrowest_mm.or((void.sight_ratio > 0.0).then_some(least_mm));
    let kind = CheckKind::VoidOpen {
        void: void.id.clone(),
    };
    Check::new(kind, &promise, value, limit)
}

/// Whether the sheet tells of every void, and of its sight what is found.
fn stated_check(promise: &Promise, found: &[VoidFacts]) -> Option<Check> {
    if found.is_empty() && promise.voids.is_empty() {
        return None;
    }
    let off = |(void, facts): (&PromisedVoid, &VoidFacts)| {
        Some((void.sight_ratio? - facts.sight_ratio).abs())
    };
    let worst = promise
        .voids
        .iter()
        .zip(found)
        .filter_map(off)
        .fold(0.0, f64::max);
    let is_whole = promise.voids.len() == found.len();
    let promise = "the sheet states the share of every void's wall in sight, within";
    Some(Check::new(
        CheckKind::VoidsAsStated,
        promise,
        is_whole.then_some(worst),
        Limit::at_most(SIGHT_TOLERANCE_RATIO, ""),
    ))
}
