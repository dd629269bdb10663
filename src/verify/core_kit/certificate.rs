//! The certificate that a base keeps its distance from the surface, checked anew, and the base
//! itself from its planes.

use super::evidence::{BaseEvidence, CoreEvidence};
use crate::geom::{Plane, Point};
use crate::mesh::{ClipError, Csg, MeshDistance, TriMesh, primitives, spread_points};
use crate::repair::weld;

/// Points on the base at which its distance from the surface is measured.
const SAMPLES: usize = 20_000;
/// The least longest edge of a piece, as a share of the model's size. Shorter ones take for ever.
const LEAST_EDGE_RATIO: f64 = 1e-3;

/// The facts about a base.
#[derive(Debug, Clone, PartialEq)]
pub struct BaseFacts {
    /// The least distance by which a piece of the surface is parted by its plane, mm; `None` if the
    /// certificate is not that of this surface.
    pub parted_mm: Option<f64>,
    /// The least distance of the base's surface from the model's, at sampled points, mm.
    pub sampled_mm: f64,
    /// The volume of the base outside of the model, mm³.
    pub outside_mm3: f64,
    /// The volume of the base grown by the gap, mm³.
    pub grown_mm3: f64,
    /// The least distance of polyhedra from the planes between them, mm; infinite for one. `None`
    /// if there is no such plane between two, or a side is no such plane.
    pub apart_mm: Option<f64>,
}

/// Returns the least distance by which the pieces of a surface are parted from a polyhedron, mm.
/// `None` if their number is another one, or one names no plane.
fn parted_mm(evidence: &CoreEvidence, base: &BaseEvidence) -> Option<f64> {
    let certificate = &evidence.certificate;
    let mut named = base.faces.iter();
    let mut least_mm = f64::INFINITY;
    let limit = certificate.longest_edge_mm;
    let least_edge_mm = LEAST_EDGE_RATIO * evidence.model.longest_side_mm();
    let is_sound = limit >= least_edge_mm;
    for corners in evidence.model.iter_corners().filter(|_| is_sound) {
        // A stack of triangles, the next one last.
        let mut waiting = vec![corners];
        while let Some(corners) = waiting.pop() {
            match halves(&corners, limit) {
                Some([first, second]) => waiting.extend([second, first]),
                None => {
                    let plane = base.planes.get(*named.next()? as usize)?;
                    let heights = corners.iter().map(|p| plane.distance(p));
                    least_mm = heights.fold(least_mm, f64::min);
                }
            }
        }
    }
    (is_sound && named.next().is_none() && least_mm.is_finite()).then_some(least_mm)
}

/// Returns both halves of a triangle with an edge that is longer than a limit, cut at the middle of
/// its longest edge; `None` if all are short.
fn halves(corners: &[Point; 3], limit_mm: f64) -> Option<[[Point; 3]; 2]> {
    let squared = [0, 1, 2].map(|k| (corners[(k + 1) % 3] - corners[k]).norm_squared());
    let longest = (1..3).fold(
        0,
        |best, k| if squared[k] > squared[best] { k } else { best },
    );
    if squared[longest] <= limit_mm * limit_mm {
        return None;
    }
    let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
    let middle = nalgebra::center(&a, &b);
    Some([[a, middle, c], [middle, b, c]])
}

/// Returns the body below some planes, each moved outward by a distance, mm.
pub fn body_below(evidence: &CoreEvidence, planes: &[Plane], by_mm: f64) -> Result<Csg, ClipError> {
    let around = evidence.model.aabb().inflated(1.0);
    let block = Csg::of_mesh(&primitives::cuboid(&around.min, &around.max))?;
    planes.iter().try_fold(block, |body, plane| {
        let moved = Plane {
            offset_mm: plane.offset_mm + by_mm,
            ..*plane
        };
        Ok(body.split_by_plane(&moved)?.1)
    })
}

/// Returns a polyhedron grown by a distance, mm. It keeps another one from the planes to others.
pub fn grown_base(
    evidence: &CoreEvidence,
    base: &BaseEvidence,
    by_mm: f64,
    from_sides_mm: f64,
) -> Result<Csg, ClipError> {
    let grown = body_below(evidence, &base.planes, by_mm)?;
    let clip = |body: Csg, side: &Plane| {
        let side = Plane {
            offset_mm: side.offset_mm - from_sides_mm,
            ..*side
        };
        Ok(body.split_by_plane(&side)?.1)
    };
    base.sides.iter().try_fold(grown, clip)
}

/// Measures the base.
pub fn measure_base(evidence: &CoreEvidence) -> Result<BaseFacts, ClipError> {
    let model = weld(&evidence.model);
    let surface = MeshDistance::new(&model);
    let solid = Csg::of_mesh(&model)?;
    let mut facts = BaseFacts {
        parted_mm: Some(f64::INFINITY),
        sampled_mm: f64::INFINITY,
        outside_mm3: 0.0,
        grown_mm3: 0.0,
        apart_mm: Some(f64::INFINITY),
    };
    let bases = evidence.bases();
    let mut corners: Vec<Vec<Point>> = Vec::new();
    for base in &bases {
        let body = body_below(evidence, &base.planes, 0.0)?;
        let mesh: TriMesh = body.to_mesh()?;
        let triangles: Vec<[Point; 3]> = mesh.iter_corners().collect();
        let points = spread_points(&triangles, SAMPLES).into_iter();
        let points = points
            .map(|point| point.at)
            .chain(mesh.vertices().iter().copied());
        let distances = points.map(|at| surface.signed(&at));
        facts.sampled_mm = distances.fold(facts.sampled_mm, f64::min);
        let outside = body.subtract(&solid)?;
        facts.outside_mm3 += outside.to_mesh()?.signed_volume_mm3().max(0.0);
        let grown = grown_base(evidence, base, evidence.promise.gap_mm, 0.0)?;
        facts.grown_mm3 += grown.to_mesh()?.signed_volume_mm3();
        let parted_mm = parted_mm(evidence, base);
        facts.parted_mm = facts
            .parted_mm
            .zip(parted_mm)
            .map(|(least, own)| least.min(own));
        corners.push(mesh.into_vertices());
    }
    facts.apart_mm = apart_mm(&bases, &corners);
    Ok(facts)
}

/// Returns the least distance of polyhedra from the planes between them, mm. A plane is between
/// two if it bounds one, and seen from its other side bounds the other. `None` if two have no such
/// plane, or one has a side that is not such a plane: parts need not keep clear beyond sides.
fn apart_mm(bases: &[BaseEvidence], corners: &[Vec<Point>]) -> Option<f64> {
    let mut least_mm = f64::INFINITY;
    for (at, (one, own)) in bases.iter().zip(corners).enumerate() {
        let shares = |side: &Plane, other: usize| {
            other != at && bases[other].sides.contains(&side.flipped())
        };
        for side in &one.sides {
            let is_between = (0..bases.len()).any(|other| shares(side, other));
            let below = own.iter().map(|p| -side.distance(p));
            least_mm = is_between.then(|| below.fold(least_mm, f64::min))?;
        }
        let mut others = (0..bases.len()).filter(|&other| other != at);
        if !others.all(|other| one.sides.iter().any(|side| shares(side, other))) {
            return None;
        }
    }
    Some(least_mm)
}
