//! Facts about the joints: the films of glue against the faces in the files, and the engraved ids.

use super::part_probe::PartProbe;
use super::{GlueFilm, Mark, PartEvidence, Promise};
use crate::base::units::MM3_PER_CM3;
use crate::geom::{Matrix, Point, Vector};
use crate::mass::Moments;

/// Triangles within this distance of a joint's plane lie in it, mm: far above the rounding of
/// files, far below a layer.
const IN_PLANE_MM: f64 = 1e-3;
/// Tolerance of a stroke's depth, as a share of it.
const DEPTH_RATIO: f64 = 0.05;

impl GlueFilm {
    /// Returns the unit normal of its plane: the film has no extent along it.
    fn normal(&self) -> Vector {
        let eigen = Matrix::from(self.face.squares_mm4).symmetric_eigen();
        eigen.eigenvectors.column(eigen.eigenvalues.imin()).into()
    }
}

/// A film of glue that differs from its faces.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmError {
    /// Difference of the areas as a share of the film's area.
    pub ratio: f64,
    /// The joint of the film.
    pub joint: String,
}

/// Returns the moments times the densities of all films, model frame.
pub(super) fn film_moments(promise: &Promise) -> Moments {
    let films = promise.joints.iter().filter_map(|joint| joint.glue);
    let of_film =
        |film: GlueFilm| film.face.film(film.thickness_mm) * (film.density_g_cm3 / MM3_PER_CM3);
    films
        .map(of_film)
        .fold(Moments::default(), |sum, film| sum + film)
}

/// Returns the greatest difference between a film's area and that of the faces in its plane; `None`
/// without films.
///
/// All films in a plane are taken together. The area of the faces is the mean of both directions.
pub(super) fn film_error(promise: &Promise, parts: &[PartEvidence]) -> Option<FilmError> {
    let films: Vec<(&String, GlueFilm)> = promise
        .joints
        .iter()
        .filter_map(|joint| Some((&joint.id, joint.glue?)))
        .collect();
    let error = |(id, film): &(&String, GlueFilm)| {
        let (center, normal) = (Point::from(film.face.center_mm), film.normal());
        let is_in_plane = |p: &Point| normal.dot(&(p - center)).abs() <= IN_PLANE_MM;
        let coplanar = films
            .iter()
            .filter(|(_, other)| is_in_plane(&Point::from(other.face.center_mm)));
        let promised: f64 = coplanar.map(|(_, other)| other.face.area_mm2).sum();
        let found: f64 = parts
            .iter()
            .map(|part| flat_area_mm2(part, is_in_plane))
            .sum::<f64>()
            / 2.0;
        FilmError {
            ratio: (promised - found).abs() / promised,
            joint: (*id).clone(),
        }
    };
    films
        .iter()
        .map(error)
        .max_by(|a, b| a.ratio.total_cmp(&b.ratio))
}

/// Counts the strokes of engraved ids that are missing from their files or not as deep as promised;
/// `None` if no part bears an id.
pub(super) fn count_lost_strokes(promise: &Promise, probes: &[PartProbe]) -> Option<usize> {
    let parts = promise.parts.iter().zip(probes);
    let marks: Vec<(&Mark, &PartProbe)> = parts
        .flat_map(|(part, probe)| part.marks.iter().map(move |mark| (mark, probe)))
        .collect();
    let is_lost = |mark: &Mark, probe: &PartProbe, stroke: &[f64; 3]| {
        let at =
            |depth: f64| Point::from(*stroke) + Vector::from(mark.axis) * (depth * mark.depth_mm);
        probe.contains(&at(1.0 - DEPTH_RATIO)) || !probe.contains(&at(1.0 + DEPTH_RATIO))
    };
    let lost = |&(mark, probe): &(&Mark, &PartProbe)| {
        mark.strokes_mm
            .iter()
            .filter(|s| is_lost(mark, probe, s))
            .count()
    };
    (!marks.is_empty()).then(|| marks.iter().map(lost).sum())
}

/// Returns the area of the part's triangles with all corners in a plane of the model, mm².
fn flat_area_mm2(part: &PartEvidence, is_in_plane: impl Fn(&Point) -> bool) -> f64 {
    let corners = part
        .mesh
        .iter_corners()
        .map(|corners| corners.map(|p| part.pose.to_model(&p)));
    let flat = corners.filter(|corners| corners.iter().all(&is_in_plane));
    flat.map(|[a, b, c]| (b - a).cross(&(c - a)).norm() / 2.0)
        .sum()
}
