//! What joins the parts: whether the films of glue are as large as the faces in the files, and the
//! ids in them are there.

use serde::{Deserialize, Serialize};

use super::pegs::Felt;
use super::{Check, CheckKind, Limit, Mark, PartEvidence, Promise};
use crate::base::units::MM3_PER_CM3;
use crate::geom::{Matrix, Point, Vector};
use crate::mass::{FlatFace, Moments};

/// Triangles of a file this near to a joint's plane lie in it, mm: far above the rounding of files,
/// far below a layer.
const IN_PLANE_MM: f64 = 1e-3;
/// A stroke may be this much shallower or deeper, as a share of its depth.
const DEPTH_RATIO: f64 = 0.05;
/// A film may differ from the faces in the files by this share: what pins, sockets and engraved
/// marks take off one side.
pub const FILM_LIMIT_RATIO: f64 = 0.1;

/// The film of glue in a joint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct GlueFilm {
    /// mm.
    pub thickness_mm: f64,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// What it weighs, g.
    pub mass_g: f64,
    /// Where it is.
    #[serde(flatten)]
    pub face: FlatFace,
}

impl GlueFilm {
    /// The unit normal of its plane: across it, it has no extent.
    fn normal(&self) -> Vector {
        let eigen = Matrix::from(self.face.squares_mm4).symmetric_eigen();
        eigen.eigenvectors.column(eigen.eigenvalues.imin()).into()
    }
}

/// The moments times the densities of all films, model frame.
pub(super) fn film_moments(promise: &Promise) -> Moments {
    let films = promise.joints.iter().filter_map(|joint| joint.glue);
    let of_film =
        |film: GlueFilm| film.face.film(film.thickness_mm) * (film.density_g_cm3 / MM3_PER_CM3);
    films
        .map(of_film)
        .fold(Moments::default(), |sum, film| sum + film)
}

/// By how much of it a film's area differs from that of the faces in its plane, at worst, and in
/// which joint; none without films.
///
/// All films of a plane are taken together; of the faces that look either way, the mean.
pub(super) fn film_error(promise: &Promise, parts: &[PartEvidence]) -> Option<(f64, String)> {
    let films: Vec<(&String, GlueFilm)> = promise
        .joints
        .iter()
        .filter_map(|joint| Some((&joint.id, joint.glue?)))
        .collect();
    let error = |(id, film): &(&String, GlueFilm)| {
        let (center, normal) = (Point::from(film.face.center_mm), film.normal());
        let is_in_plane = |p: &Point| normal.dot(&(p - center)).abs() <= IN_PLANE_MM;
        let alike = films
            .iter()
            .filter(|(_, other)| is_in_plane(&Point::from(other.face.center_mm)));
        let promised: f64 = alike.map(|(_, other)| other.face.area_mm2).sum();
        let found: f64 = parts
            .iter()
            .map(|part| flat_area_mm2(part, is_in_plane))
            .sum::<f64>()
            / 2.0;
        ((promised - found).abs() / promised, (*id).clone())
    };
    films.iter().map(error).max_by(|a, b| a.0.total_cmp(&b.0))
}

/// How many strokes of engraved ids are missing from their files, or not as deep as promised; none
/// where no part bears an id.
pub(super) fn lost_strokes(promise: &Promise, felt: &[Felt]) -> Option<usize> {
    let parts = promise.parts.iter().zip(felt);
    let marks: Vec<(&Mark, &Felt)> = parts
        .flat_map(|(part, felt)| part.marks.iter().map(move |mark| (mark, felt)))
        .collect();
    let is_lost = |mark: &Mark, felt: &Felt, stroke: &[f64; 3]| {
        let at =
            |depth: f64| Point::from(*stroke) + Vector::from(mark.axis) * (depth * mark.depth_mm);
        felt.holds(&at(1.0 - DEPTH_RATIO)) || !felt.holds(&at(1.0 + DEPTH_RATIO))
    };
    let lost = |&(mark, felt): &(&Mark, &Felt)| {
        mark.strokes_mm
            .iter()
            .filter(|s| is_lost(mark, felt, s))
            .count()
    };
    (!marks.is_empty()).then(|| marks.iter().map(lost).sum())
}

/// Whether all engraved ids are there.
pub(super) fn marks_check(lost: usize) -> Check {
    let promise = "every stroke of every engraved id is as deep as promised, but for";
    Check::new(
        CheckKind::EngravedIds,
        promise,
        Some(lost as f64),
        Limit::at_most(0.0, ""),
    )
}

/// The area of a part's triangles all of whose corners lie in a plane of the model.
fn flat_area_mm2(part: &PartEvidence, is_in_plane: impl Fn(&Point) -> bool) -> f64 {
    let corners = part
        .mesh
        .iter_corners()
        .map(|corners| corners.map(|p| part.pose.to_model(&p)));
    let flat = corners.filter(|corners| corners.iter().all(&is_in_plane));
    flat.map(|[a, b, c]| (b - a).cross(&(c - a)).norm() / 2.0)
        .sum()
}

/// Whether the films are as large as the faces in the files.
pub(super) fn film_check((error, joint): (f64, String)) -> Check {
    let promise = "every film of glue is as large as its faces, but for a share of";
    Check::new(
        CheckKind::Glue,
        promise,
        Some(error),
        Limit::at_most(FILM_LIMIT_RATIO, ""),
    )
    .at(Some(joint))
}
