//! How parts lie on the plate: shells on their mouths, caps on their tails.

use crate::geom::{Frame, Matrix, Point, Vector};
use crate::mesh::TriMesh;
use crate::telescope::nest::Telescope;
use crate::verify::Pose;

/// The support of a part that needs none, in words.
pub const NO_SUPPORT: &str = "none";

/// How a part lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lies {
    /// On the ring of its mouth.
    OnMouth,
    /// On the face of its tail.
    OnTail,
    /// Leaning by half of its bend, with support outside only.
    Leaning,
    /// On its tail, with all other shells in it or around it.
    InPlace,
    /// On the face of its tail, with a pocket below.
    OverPocket,
    /// On its own surface, round or a model's, with support below.
    Round,
}

impl Lies {
    /// Returns the support of a breakaway printer, in words.
    pub fn support_words(self) -> &'static str {
        match self {
            Self::Leaning => "outside only",
            Self::OverPocket => "in its pocket",
            Self::OnMouth | Self::OnTail | Self::InPlace => NO_SUPPORT,
            Self::Round => "as the slicer finds",
        }
    }

    /// Returns the words on the sheet.
    pub fn words(self) -> &'static str {
        match self {
            Self::OnMouth => "mouth down",
            Self::OnTail => "tail down",
            Self::Leaning => "leaning by half of its bend, support outside only",
            Self::InPlace => "in place, tail down",
            Self::OverPocket => "tail down, over its pocket",
            Self::Round => "on its own surface, support below and in its sockets",
        }
    }
}

/// A part that lies on the plate.
#[derive(Clone, Copy)]
pub struct Laid {
    pub pose: Pose,
    pub lies: Lies,
}

/// Lays a shell down. `steepest_rad` is the lean from the vertical that prints without support.
///
/// On its mouth all rings are round and both lips are cones of 45°. A shell that bends by more than
/// may hang over leans by half of its bend.
pub fn lay_shell(telescope: &Telescope, shell: usize, mesh: &TriMesh, steepest_rad: f64) -> Laid {
    let helix = &telescope.shells[shell].helix;
    let [tail_mm, mouth_mm] = telescope.ends_mm();
    let bend_rad = helix.curvature * (mouth_mm - tail_mm);
    let is_steep = bend_rad > steepest_rad;
    let at_mm = if is_steep {
        0.5 * (tail_mm + mouth_mm)
    } else {
        mouth_mm
    };
    let down: Vector = helix.frame_at(at_mm).axes.column(0).into();
    Laid {
        pose: lay_down(mesh, &down),
        lies: if is_steep {
            Lies::Leaning
        } else {
            Lies::OnMouth
        },
    }
}

/// Lays a cap down, with its spigot up.
pub fn lay_cap(telescope: &Telescope, shell: usize, mesh: &TriMesh) -> Laid {
    let [tail_mm, _] = telescope.ends_mm();
    let tail = telescope.shells[shell].helix.frame_at(tail_mm);
    let ahead: Vector = tail.axes.column(0).into();
    Laid {
        pose: lay_down(mesh, &-ahead),
        lies: Lies::OnTail,
    }
}

/// Lays a juncture down, with this direction down.
pub fn lay_juncture(mesh: &TriMesh, down: &Vector) -> Laid {
    Laid {
        pose: lay_down(mesh, down),
        lies: Lies::Round,
    }
}

/// Returns the pose in which a direction points down and the mesh stands on the plate, its corner
/// at the origin.
pub fn lay_down(mesh: &TriMesh, down: &Vector) -> Pose {
    let frame = Frame::with_axis(Point::origin(), &-down);
    let rotation: Matrix = frame.axes.transpose();
    let turned = mesh.map_vertices(|p| Point::from(rotation * p.coords));
    Pose::new(&rotation, &-turned.aabb().min.coords)
}
