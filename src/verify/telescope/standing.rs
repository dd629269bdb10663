//! Mass and centre of a telescope in its states, and the lean at which it topples.

use nalgebra::Vector3;

use super::motion::{TelescopeMotion, frame_of};
use crate::geom::{Frame, Matrix, Point};
use crate::mass::Moments;
use crate::mesh::TriMesh;
use crate::verify::Support;

/// The balance at a key, as the judge finds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stands {
    /// The centre of mass in the model frame, mm.
    pub centre: Point,
    /// The lean at which it topples, degrees.
    pub toppling_deg: f64,
}

/// Returns the balance at a key. `shells` are the moments of every shell with its cap in the
/// shell's frame, `root` is the mesh of the root in its frame.
pub(super) fn stands(
    motion: &TelescopeMotion,
    states: &[[f64; 2]],
    shells: &[Moments],
    root: &TriMesh,
) -> Stands {
    let frames = motion.frames(states);
    let placed = shells.iter().zip(&frames);
    let (mut volume, mut first) = (0.0, Vector3::zeros());
    for (moments, frame) in placed {
        volume += moments.volume();
        first += frame.to_model(&moments.centroid()).coords * moments.volume();
    }
    let centre = Point::from(first / volume);
    let up = upright(motion);
    let in_model = root.map_vertices(|p| frames[0].to_model(p));
    let support = Support::of_mesh(&in_model, &up);
    let lean = support.toppling_angle(&up.to_local(&centre));
    Stands {
        centre,
        toppling_deg: lean.to_degrees(),
    }
}

/// Returns the frame whose z is up: along the root's tangent at its tail.
pub(super) fn upright(motion: &TelescopeMotion) -> Frame {
    let root = &motion.shells[0];
    let tail = frame_of(&motion.root).frame_to_model(&root.along(root.ends_mm[0]));
    let column = |axis: usize| tail.axes.column(axis).into_owned();
    Frame {
        origin: tail.origin,
        axes: Matrix::from_columns(&[column(1), column(2), column(0)]),
    }
}
