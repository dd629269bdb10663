//! Pieces that a cut parts needlessly are joined again: a plane through a body also slices what merely reaches across it.

use rayon::prelude::*;

use super::{
    error::CutError,
    pose::{laid, sides_down},
    request::PlanRequest,
    section::{Chart, Point2, Section},
    split::{Cap, Joint, Piece, joints, piece, split},
};
use crate::{
    geom::{Plane, Point},
    mesh::{Csg, Hollowed, TriMesh},
};

/// Corners of a void's mouth lie this near to the outline of the cut face, mm: they are the same points but for
/// rounding, and a wall lies between different mouths.
const MOUTH_TOLERANCE_MM: f64 = 1e-6;

/// Cells a side of the grid on which the way out of a part is checked. A coarser grid joins fewer pieces.
const SHADOW_CELLS: usize = 96;

/// What is cut, by what, for which printer.
pub(crate) struct Cutting<'a> {
    pub(crate) hollowed: &'a Hollowed,
    pub(crate) material: &'a TriMesh,
    pub(crate) planes: &'a [Plane],
    pub(crate) request: &'a PlanRequest,
}

/// The pieces of the body between the planes, the largest first; where `rejoins`, pieces are joined again that
/// * touch a single other piece, and no void opens in the face between them;
/// * are not in the way of what is taken off on their side of the cut;
/// * still fit the build volume together.
pub(crate) fn pieces(cutting: &Cutting, rejoins: bool) -> Result<Vec<Piece>, CutError> {
    let pieces = split(cutting.material, cutting.planes)?;
    if !rejoins || pieces.len() < 3 {
        return Ok(pieces);
    }
    let group_of = groups(cutting, &pieces);
    let mut names: Vec<usize> = group_of.clone();
    names.sort_unstable();
    names.dedup();
    let united = names.par_iter().map(|&name| {
        let members = (0..pieces.len()).filter(|&i| group_of[i] == name).map(|i| &pieces[i]);
        united(&members.collect::<Vec<_>>(), cutting.planes)
    });
    let mut united = united.collect::<Result<Vec<Piece>, CutError>>()?;
    united.sort_by(|a, b| b.volume_mm3.total_cmp(&a.volume_mm3));
    Ok(united)
}

/// For each piece the piece it stays joined to, or itself.
fn groups(cutting: &Cutting, pieces: &[Piece]) -> Vec<usize> {
    let joints = joints(pieces);
    let mouths = mouths(cutting);
    let is_open: Vec<bool> = joints.iter().map(|joint| has_mouth(joint, pieces, &mouths)).collect();
    let mut group_of: Vec<usize> = (0..pieces.len()).collect();
    // Pieces come the largest first: the smallest is offered first.
    for index in (0..pieces.len()).rev() {
        let touching: Vec<usize> = (0..joints.len()).filter(|&j| joints[j].touches(index)).collect();
        let [joint] = touching[..] else { continue };
        let host = joints[joint].other(index);
        if !is_open[joint]
            && group_of[host] == host
            && !group_of.iter().enumerate().any(|(i, &group)| i != index && group == index)
            && comes_free(cutting, pieces, (&joints[joint], index))
            && fit_together(cutting, &pieces[index], &pieces[host])
        {
            group_of[index] = host;
        }
    }
    group_of
}

/// The corners of every void's section by every plane.
fn mouths(cutting: &Cutting) -> Vec<Vec<Point2>> {
    let corners = |plane: &Plane| {
        let sections = cutting.hollowed.voids.iter().map(|void| Section::of_mesh(void.mesh(), plane));
        sections.flat_map(|section| section.rings).flat_map(|ring| ring.points).collect()
    };
    cutting.planes.par_iter().map(corners).collect()
}

/// Whether a void opens in one of the joint's faces.
fn has_mouth(joint: &Joint, pieces: &[Piece], mouths: &[Vec<Point2>]) -> bool {
    let on_edge = |cap: &Cap| {
        let Some((min, max)) = cap.outline.bounds() else { return false };
        let near =
            mouths[joint.cut].iter().filter(|p| p.x >= min.x && p.y >= min.y && p.x <= max.x && p.y <= max.y);
        near.into_iter().any(|p| cap.outline.signed_distance(p).abs() <= MOUTH_TOLERANCE_MM)
    };
    joint.caps.iter().any(|&cap| on_edge(&pieces[joint.below].caps[cap]))
}

/// Whether what lies on the piece's side of the cut can be taken off along the normal while the piece stays.
fn comes_free(cutting: &Cutting, pieces: &[Piece], (joint, index): (&Joint, usize)) -> bool {
    let plane = &cutting.planes[joint.cut];
    let is_above = joint.above == index;
    let sign = if is_above { 1.0 } else { -1.0 };
    let shadow = Shadow::new(&pieces[index].mesh, plane, sign);
    let moves = |i: &usize| *i != index && pieces[*i].is_above(plane) == is_above;
    (0..pieces.len()).filter(moves).all(|i| !shadow.holds_back(&pieces[i].mesh))
}

fn fit_together(cutting: &Cutting, a: &Piece, b: &Piece) -> bool {
    let both = a.mesh.clone().joined(&b.mesh);
    laid(&both, &sides_down(b, cutting.planes, &[], cutting.request), cutting.request).fits
}

/// One piece of several that touch.
fn united(members: &[&Piece], planes: &[Plane]) -> Result<Piece, CutError> {
    let mut bodies = members.iter().rev().map(|member| Csg::of_mesh(&member.mesh));
    let first = bodies.next().unwrap_or_else(|| Csg::of_mesh(&TriMesh::default()))?;
    let body = bodies.try_fold(first, |sum, body| sum.union(&body?))?;
    Ok(piece(body.to_mesh()?, planes))
}

/// The height of a piece over a grid on the plane, to tell whether another can be drawn out past it.
struct Shadow {
    chart: Chart,
    plane: Plane,
    sign: f64,
    min: Point2,
    cell: nalgebra::Vector2<f64>,
    /// The greatest height in each cell, mm.
    top: Vec<f64>,
}

impl Shadow {
    fn new(mesh: &TriMesh, plane: &Plane, sign: f64) -> Self {
        let chart = Chart::of_plane(plane);
        let flat = mesh.vertices().iter().map(|p| chart.flat(p));
        let all = Point2::new(f64::INFINITY, f64::INFINITY);
        let (min, max) = flat.fold((all, -all), |(min, max), p| (min.inf(&p), max.sup(&p)));
        let cell = (max - min) / SHADOW_CELLS as f64;
        let top = vec![f64::NEG_INFINITY; SHADOW_CELLS * SHADOW_CELLS];
        let mut shadow = Self { chart, plane: *plane, sign, min, cell, top };
        for corners in mesh.iter_corners() {
            let (_, high, cells) = shadow.span(&corners);
            for cell in cells {
                shadow.top[cell] = shadow.top[cell].max(high);
            }
        }
        shadow
    }

    /// Whether a triangle of the mesh lies under the shadow's body.
    fn holds_back(&self, mesh: &TriMesh) -> bool {
        mesh.iter_corners().any(|corners| {
            let (low, _, mut cells) = self.span(&corners);
            cells.any(|cell| low < self.top[cell])
        })
    }

    /// The least and greatest height of a triangle, and the cells its bounding box meets.
    fn span(&self, corners: &[Point; 3]) -> (f64, f64, impl Iterator<Item = usize> + use<>) {
        let heights = corners.map(|p| self.sign * self.plane.distance(&p));
        let flat = corners.map(|p| self.chart.flat(&p) - self.min);
        let range = |axis: usize| {
            let places = flat.map(|p| p[axis] / self.cell[axis]);
            let (from, to) = (
                places.iter().copied().fold(f64::INFINITY, f64::min),
                places.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            );
            // Casts saturate: a triangle beside the grid has an empty range.
            let first = if to < 0.0 { SHADOW_CELLS } else { from.max(0.0) as usize };
            first..((to.max(0.0) as usize).saturating_add(1)).min(SHADOW_CELLS)
        };
        let (columns, rows) = (range(0), range(1));
        let cells = columns.flat_map(move |i| rows.clone().map(move |j| i * SHADOW_CELLS + j));
        let low = heights.into_iter().fold(f64::INFINITY, f64::min);
        (low, heights.into_iter().fold(f64::NEG_INFINITY, f64::max), cells)
    }
}
