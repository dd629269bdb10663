//! The surfaces of parts, and how they lie on the plate.

use crate::base::watch::{Cancelled, Watch};
use crate::geom::Vector;
use crate::mesh::{Crossings, Defects, TriMesh, bodies};
use crate::repair::weld;
use crate::verify::{Pose, PrinterLimits};

/// A part in its own frame, with the pose in which it is printed.
pub(super) struct LyingPart<'a> {
    pub id: &'a str,
    pub pose: &'a Pose,
    pub mesh: &'a TriMesh,
}

/// The facts about the surfaces of the parts, and how they lie.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Surfaces {
    pub broken: Vec<String>,
    pub crossings: usize,
    pub in_pieces: Vec<String>,
    pub above_plate_mm: f64,
    pub too_large: Vec<String>,
}

impl Surfaces {
    /// Measures parts by the room of a machine, and the scale in which it prints.
    pub fn of<'a>(
        parts: impl Iterator<Item = LyingPart<'a>>,
        machine: &PrinterLimits,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let room = machine.build_volume_mm;
        let scale = Vector::from(machine.print_scale_ratio.unwrap_or([1.0; 3]));
        let mut found = Self::default();
        for part in parts {
            watch.check()?;
            let printed = part.mesh.map_vertices(|p| part.pose.to_print(p));
            let welded = weld(&as_written(&printed, scale));
            let defects = Defects::of(&welded);
            let broken = defects.map(|defects| format!("{}: {defects}", part.id));
            found.broken.extend(broken);
            found.crossings += Crossings::of_watched(&welded, watch)?.pairs;
            let is_one = bodies(&welded).len() == 1;
            found
                .in_pieces
                .extend((!is_one).then(|| part.id.to_owned()));
            let printed = printed.aabb();
            found.above_plate_mm = found.above_plate_mm.max(printed.min.z.abs());
            let size = printed.size();
            let fits = room.is_none_or(|[x, y, z]| {
                let lies = |a: f64, b: f64| a <= x && b <= y;
                size.z <= z && (lies(size.x, size.y) || lies(size.y, size.x))
            });
            found.too_large.extend((!fits).then(|| part.id.to_owned()));
        }
        Ok(found)
    }
}

/// Returns a part in print pose as its file holds it, in the size that is printed.
///
/// Turned into a shell's frame and back, a vertex is off by rounding. Triangles without area then
/// flip and seem to cross. A file holds single precision, so the vertex is known exactly.
fn as_written(printed: &TriMesh, scale: Vector) -> TriMesh {
    let single = |value: f64| f64::from(value as f32);
    printed.map_vertices(|p| p.coords.component_mul(&scale).map(single).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Matrix, Point};
    use crate::mesh::primitives::ball;
    use nalgebra::Rotation3;

    #[test]
    fn a_part_turned_into_its_frame_and_back_is_that_of_its_file() {
        let written = ball(&Point::new(7.3, -11.9, 20.1), 9.7, 3);
        let written = as_written(&written, Vector::repeat(1.0));
        let turn: Matrix = Rotation3::from_euler_angles(0.3, -1.1, 2.2).into_inner();
        let pose = Pose::new(&turn, &Vector::new(31.0, -7.7, 4.9));
        let turned = written.map_vertices(|p| pose.to_model(p));
        let back = turned.map_vertices(|p| pose.to_print(p));
        assert_ne!(back.vertices(), written.vertices());
        let again = as_written(&back, Vector::repeat(1.0));
        assert_eq!(again.vertices(), written.vertices());
        // Printed larger, it is the larger file that is looked at.
        let scale = Vector::new(1.02, 1.01, 1.0);
        let larger = as_written(&written, scale);
        let nominal = larger.map_vertices(|p| p.coords.component_div(&scale).into());
        assert_eq!(as_written(&nominal, scale).vertices(), larger.vertices());
    }
}
