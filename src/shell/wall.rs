//! The wall and the keep-solid regions of a solid, in a goal frame.

use rayon::prelude::*;

use super::bins::Bins;
use super::keep::Keep;
use super::overlap::{overlaps_itself, triangle_y_ranges};
use super::piece::Piece;
use super::pieces::{Builder, pieces_of_keep};
use super::ruler::Ruler;
use crate::geom::{Aabb, Frame, Matrix};
use crate::mesh::{Solid, TriMesh};

/// Largest deviation of a frame's axes from orthonormal. With more, lengths in the goal frame would
/// be off by more than rounding; with less, frames made by a few multiplications would be refused.
const FRAME_TOLERANCE: f64 = 1e-9;

/// The wall and the keep-solid regions of a solid in a goal frame.
///
/// The region that may be emptied lies inside the solid, no nearer to the surface than the wall and
/// outside every keep-solid region. The rest is held as convex pieces: prisms behind faces, parts
/// of cylinders about edges and parts of balls about vertices. A vertical line meets each piece in
/// one stretch, in closed form.
#[derive(Debug, Clone, PartialEq)]
pub struct Shell {
    surface: TriMesh,
    pieces: Vec<Piece>,
    wall_mm: f64,
    overlaps_itself: bool,
}

/// An error in the arguments of a [`Shell`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShellError {
    /// The wall is zero, negative or not a number.
    #[error("the wall is {wall_mm} mm thick; it must be positive and finite")]
    Wall {
        /// The wall asked for, mm.
        wall_mm: f64,
    },
    /// A keep-solid region has an end that is not finite, or a radius that is not positive and
    /// finite.
    #[error(
        "keep-solid region {index} is not a ball or capsule: \
         its ends must be finite and its radius positive"
    )]
    Keep {
        /// Index of the region, from 0.
        index: usize,
    },
    /// The frame's axes are not orthonormal.
    #[error("the goal frame's axes are not perpendicular unit vectors; lengths would not be kept")]
    Frame,
}

impl Shell {
    /// Builds the shell of `solid` with a wall of `wall_mm` and the regions `keeps` (model
    /// coordinates), in `frame`.
    ///
    /// Costs some microseconds per triangle. If the solid overlaps itself, every triangle gets a
    /// wall on both sides, also those buried in the solid. Overlaps are searched on a lattice of
    /// columns.
    ///
    /// # Errors [`ShellError`] if the wall or a region is not positive and finite, or if the frame
    /// is not orthonormal.
    pub fn new(
        solid: &Solid,
        frame: &Frame,
        wall_mm: f64,
        keeps: &[Keep],
    ) -> Result<Self, ShellError> {
        check_arguments(frame, wall_mm, keeps)?;
        let surface = solid.mesh().in_frame(frame);
        let overlaps_itself = overlaps_itself(&surface);
        let mut pieces = Builder::new(&surface, wall_mm, !overlaps_itself).pieces(solid);
        pieces.extend(keeps.iter().flat_map(|keep| pieces_of_keep(keep, frame)));
        Ok(Self {
            surface,
            pieces: sort_by_height(&pieces),
            wall_mm,
            overlaps_itself,
        })
    }

    /// Returns the surface of the solid in the goal frame.
    pub fn surface(&self) -> &TriMesh {
        &self.surface
    }

    /// Returns the pieces that must stay, in ascending order of their lowest points.
    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Returns the thickness of the wall, mm.
    pub fn wall_mm(&self) -> f64 {
        self.wall_mm
    }

    /// Returns whether the solid was found to overlap itself, so that both sides of every triangle
    /// have a wall.
    pub fn overlaps_itself(&self) -> bool {
        self.overlaps_itself
    }

    /// Returns the box, in the goal frame, outside which nothing may be emptied: the bounds less
    /// the wall. It may be empty.
    pub fn interior_bounds(&self) -> Aabb {
        self.surface.aabb().inflated(-self.wall_mm)
    }

    /// Returns the pitch in x and y, mm, for about `columns_a_side` columns along the longer side
    /// of the solid, seen from above.
    pub fn coarse_pitch(&self, columns_a_side: usize) -> [f64; 2] {
        let pitch_mm = self.surface.aabb().size().xy().max() / columns_a_side.max(1) as f64;
        [pitch_mm; 2]
    }

    /// Returns the triangles of the surface that reach into each block of rows.
    pub(crate) fn bin_triangles(&self, rows: &Ruler, rows_per_block: usize) -> Bins {
        Bins::of_ranges(triangle_y_ranges(&self.surface), rows, rows_per_block)
    }

    /// Returns the pieces that reach into each block of rows.
    pub(crate) fn bin_pieces(&self, rows: &Ruler, rows_per_block: usize) -> Bins {
        Bins::of_ranges(
            self.pieces.iter().map(Piece::y_range_mm),
            rows,
            rows_per_block,
        )
    }
}

/// Returns the pieces in ascending order of their lowest points. This keeps a column's intervals
/// few while they are carved.
fn sort_by_height(pieces: &[Piece]) -> Vec<Piece> {
    let mut order: Vec<(f64, usize)> = pieces
        .par_iter()
        .enumerate()
        .map(|(index, piece)| (piece.z_min_mm(), index))
        .collect();
    order.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    order.par_iter().map(|&(_, index)| pieces[index]).collect()
}

/// Checks that the frame, the wall and the regions make sense.
fn check_arguments(frame: &Frame, wall_mm: f64, keeps: &[Keep]) -> Result<(), ShellError> {
    if !(wall_mm > 0.0 && wall_mm.is_finite()) {
        return Err(ShellError::Wall { wall_mm });
    }
    let gram = frame.axes.tr_mul(&frame.axes) - Matrix::identity();
    if !(gram.amax() <= FRAME_TOLERANCE && frame.origin.coords.iter().all(|c| c.is_finite())) {
        return Err(ShellError::Frame);
    }
    let is_sound = |keep: &Keep| {
        let ends = keep.from.iter().chain(keep.to.iter());
        ends.into_iter().all(|c| c.is_finite())
            && keep.radius_mm > 0.0
            && keep.radius_mm.is_finite()
    };
    keeps
        .iter()
        .position(|keep| !is_sound(keep))
        .map_or(Ok(()), |index| Err(ShellError::Keep { index }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::shell::fixtures;

    #[test]
    fn an_impossible_wall_region_or_frame_is_named_in_the_error() {
        let solid = fixtures::cells(&[[0, 0, 0]], 10.0);
        let identity = Frame::identity();
        for wall_mm in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(
                Shell::new(&solid, &identity, wall_mm, &[]),
                Err(ShellError::Wall { wall_mm })
            );
        }
        assert!(matches!(
            Shell::new(&solid, &identity, f64::NAN, &[]),
            Err(ShellError::Wall { .. })
        ));
        let keeps = [
            Keep::ball(Point::origin(), 1.0),
            Keep::ball(Point::origin(), 0.0),
        ];
        assert_eq!(
            Shell::new(&solid, &identity, 1.0, &keeps),
            Err(ShellError::Keep { index: 1 })
        );
        let stretched = Frame {
            axes: Matrix::from_diagonal(&Vector::new(1.0, 1.0, 1.1)),
            ..identity
        };
        assert_eq!(
            Shell::new(&solid, &stretched, 1.0, &[]),
            Err(ShellError::Frame)
        );
    }

    #[test]
    fn a_cube_has_a_slab_for_each_face_and_next_to_nothing_else() {
        let shell = Shell::new(
            &fixtures::cells(&[[0, 0, 0]], 10.0),
            &Frame::identity(),
            1.0,
            &[],
        )
        .unwrap();
        // Twelve triangles, and the six flat diagonals.
        assert_eq!(shell.pieces().len(), 12 + 6);
        assert!(
            shell
                .pieces()
                .is_sorted_by(|a, b| a.z_min_mm() <= b.z_min_mm())
        );
        assert_eq!(shell.coarse_pitch(20), [0.5, 0.5]);
    }
}
