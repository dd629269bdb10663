//! The wall and the keep-solid regions of a solid, in a goal frame.

use rayon::prelude::*;

use super::overlap::{overlaps_itself, triangle_y_ranges};
use super::pieces::{self, Builder};
use super::{Bins, Keep, Piece, Ruler};
use crate::geom::{Aabb, Frame, Matrix};
use crate::mesh::{Solid, TriMesh};

/// How far the axes of a frame may be from orthonormal. Above, lengths in the goal frame would be
/// off by more than rounding; below, frames made by a few multiplications would be refused.
const FRAME_TOLERANCE: f64 = 1e-9;

/// The wall and the keep-solid regions of a solid in a goal frame.
///
/// What may be emptied is { x inside the solid : no nearer to the surface than the wall, and
/// outside every keep-solid region }. What must stay is held as convex pieces (a prism behind each
/// face, parts of a cylinder about each edge and of a ball about each vertex), so that a vertical
/// line meets each in one stretch, in closed form.
#[derive(Debug, Clone, PartialEq)]
pub struct Shell {
    surface: TriMesh,
    pieces: Vec<Piece>,
    wall_mm: f64,
    overlaps_itself: bool,
}

/// Why there is no [`Shell`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
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
        "keep-solid region {index} is not a ball or capsule: its ends must be finite and its radius positive"
    )]
    Keep {
        /// Which region, from 0.
        index: usize,
    },
    /// The frame's axes are not orthonormal.
    #[error("the goal frame's axes are not perpendicular unit vectors; lengths would not be kept")]
    Frame,
}

impl Shell {
    /// The shell of `solid` with a wall of `wall_mm` and the regions `keeps` (model coordinates),
    /// in `frame`.
    ///
    /// Costs some microseconds per triangle. If the solid overlaps itself (looked for on a lattice
    /// of columns), every triangle has a wall on both sides, also those buried in the solid.
    pub fn new(
        solid: &Solid,
        frame: &Frame,
        wall_mm: f64,
        keeps: &[Keep],
    ) -> Result<Self, ShellError> {
        check(frame, wall_mm, keeps)?;
        let surface = solid.mesh().in_frame(frame);
        let overlaps_itself = overlaps_itself(&surface);
        let mut pieces = Builder::new(&surface, wall_mm, !overlaps_itself).pieces(solid);
        pieces.extend(keeps.iter().flat_map(|keep| pieces::of_keep(keep, frame)));
        Ok(Self {
            surface,
            pieces: from_low_to_high(&pieces),
            wall_mm,
            overlaps_itself,
        })
    }

    /// The surface of the solid in the goal frame.
    pub fn surface(&self) -> &TriMesh {
        &self.surface
    }

    /// The pieces that must stay, ascending in their lowest points.
    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The thickness of the wall, mm.
    pub fn wall_mm(&self) -> f64 {
        self.wall_mm
    }

    /// Whether the solid was found to overlap itself, so that both sides of every triangle have a
    /// wall.
    pub fn overlaps_itself(&self) -> bool {
        self.overlaps_itself
    }

    /// A box of the goal frame outside which nothing may be emptied: the bounds less the wall. May
    /// be empty.
    pub fn interior_bounds(&self) -> Aabb {
        self.surface.aabb().inflated(-self.wall_mm)
    }

    /// The pitch in x and y, mm, at which the longer side of the solid, seen from above, has about
    /// `columns_a_side` columns.
    pub fn coarse_pitch(&self, columns_a_side: usize) -> [f64; 2] {
        let pitch_mm = self.surface.aabb().size().xy().max() / columns_a_side.max(1) as f64;
        [pitch_mm; 2]
    }

    /// The triangles of the surface that reach into each block of rows.
    pub(crate) fn bin_triangles(&self, rows: &Ruler, rows_per_block: usize) -> Bins {
        Bins::of_ranges(triangle_y_ranges(&self.surface), rows, rows_per_block)
    }

    /// The pieces that reach into each block of rows.
    pub(crate) fn bin_pieces(&self, rows: &Ruler, rows_per_block: usize) -> Bins {
        Bins::of_ranges(
            self.pieces.iter().map(Piece::y_range_mm),
            rows,
            rows_per_block,
        )
    }
}

/// The pieces ascending in their lowest points, which keeps a column's intervals few while they are
/// carved.
fn from_low_to_high(pieces: &[Piece]) -> Vec<Piece> {
    let mut order: Vec<(f64, usize)> = pieces
        .par_iter()
        .enumerate()
        .map(|(index, piece)| (piece.z_min_mm(), index))
        .collect();
    order.par_sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    order.par_iter().map(|&(_, index)| pieces[index]).collect()
}

/// Whether the arguments of a shell make sense.
fn check(frame: &Frame, wall_mm: f64, keeps: &[Keep]) -> Result<(), ShellError> {
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
    fn a_wall_a_region_or_a_frame_without_meaning_is_refused_by_name() {
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
