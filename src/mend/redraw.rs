//! A new surface for a model, drawn ever finer until it is as near to the old one as it must be.

mod stray;

use super::error::MendError;
use crate::base::watch::Watch;
use crate::mesh::{TriMesh, area_mm2, scaled, shells};
use crate::repair::{Redrawn, Remesh};
use crate::voids::Soup;
use stray::Old;

/// Tolerance of a new surface if none is given, as a share of the longest side. It is 0.2 mm, about
/// a layer, on a model of 100 mm. A lower one takes longer; a higher one loses detail.
const USUAL_TOLERANCE_RATIO: f64 = 2e-3;

/// Number of times that the surface is drawn, each time with cells of half the size.
const ATTEMPTS: i32 = 2;

/// Largest area of the old surface, in squares of the tolerance. It bounds the memory; how much
/// that is was not measured.
const MOST_SQUARES: f64 = 6e6;

/// Size below which a separate piece is a speck, in tolerances. A body of that size is lost within
/// the tolerance.
const SPECK_RATIO: f64 = 2.0;

/// Draws the boundary of the space around which the triangles wind, within a tolerance. Returns it
/// in the numbers of the file.
///
/// The distance is measured both ways at some ten thousand points each. If it is larger than the
/// tolerance, the surface is drawn again with finer cells.
///
/// # Errors
/// The tolerance is too fine for the size, nothing is enclosed, no surface keeps the tolerance, or
/// the watch was stopped.
pub(super) fn redraw(
    file: &TriMesh,
    how: Remesh,
    factor: &impl Fn(f64) -> f64,
    watch: &Watch,
) -> Result<(TriMesh, Redrawn), MendError> {
    let ratio = factor(file.longest_side_mm());
    let old = scaled(file, ratio);
    let within_mm = match how {
        Remesh::Usual => USUAL_TOLERANCE_RATIO * old.longest_side_mm(),
        Remesh::Within(length) => length.mm(),
    };
    check_fineness(&old, within_mm)?;
    watch.check()?;
    let soup = Soup::of(&old);
    let surface = Old::new(&old, &soup);
    // What is asked for is the size of what comes out, which may be smaller than the triangles.
    let mut growth_ratio = 1.0;
    let mut last = MendError::Nothing;
    for attempt in 0..ATTEMPTS {
        let allowed_mm = within_mm / growth_ratio;
        let cells_mm = allowed_mm * 0.5_f64.powi(attempt);
        let missing = |drawn: &TriMesh| {
            let (kept, _) = drop_specks(drawn, allowed_mm);
            surface.missing(&kept, allowed_mm, watch)
        };
        let drawn = soup.remesh(cells_mm, &missing, watch)?;
        let (new, dropped_specks) = drop_specks(&drawn, allowed_mm);
        if new.is_empty() {
            return Err(MendError::Nothing);
        }
        growth_ratio = factor(new.longest_side_mm() / ratio) / ratio;
        let far = surface.farthest(&new, watch)?;
        let moved_mm = far.distance_mm * growth_ratio;
        if moved_mm <= within_mm {
            let redrawn = Redrawn {
                within_mm,
                moved_mm,
                dropped_specks,
            };
            return Ok((scaled(&new, ratio.recip()), redrawn));
        }
        last = MendError::Strays {
            within_mm,
            strays_mm: moved_mm,
            at: far.at / ratio,
        };
    }
    Err(last)
}

/// Refuses a tolerance that would take more memory than a shop's machine has.
fn check_fineness(old: &TriMesh, within_mm: f64) -> Result<(), MendError> {
    let area: f64 = old.iter_corners().map(|corners| area_mm2(&corners)).sum();
    let least_mm = (area / MOST_SQUARES).sqrt();
    if within_mm < least_mm || !within_mm.is_finite() {
        return Err(MendError::TooFine {
            within_mm,
            least_mm,
        });
    }
    Ok(())
}

/// Drops the pieces that are smaller than the tolerance can tell, and returns their number. The
/// largest piece stays.
fn drop_specks(mesh: &TriMesh, within_mm: f64) -> (TriMesh, usize) {
    let pieces = shells(mesh);
    let sizes: Vec<f64> = pieces.iter().map(TriMesh::longest_side_mm).collect();
    let largest_mm = sizes.iter().copied().fold(0.0, f64::max);
    let least_mm = (SPECK_RATIO * within_mm).min(largest_mm);
    let kept = pieces.iter().zip(&sizes);
    let kept = kept.filter(|(_, size_mm)| **size_mm >= least_mm);
    let kept: Vec<&TriMesh> = kept.map(|(piece, _)| piece).collect();
    let specks = pieces.len() - kept.len();
    if specks == 0 {
        return (mesh.clone(), 0);
    }
    let all = kept.into_iter();
    let all = all.fold(TriMesh::default(), |all, piece| all.joined(piece));
    (all, specks)
}
