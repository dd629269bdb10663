//! The surfaces of the printed parts, and how they lie.

use rayon::prelude::*;

use super::evidence::CoreEvidence;
use super::promise::CorePartPromise;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{Crossings, Defects, TriMesh, bodies, shells};
use crate::repair::weld;

/// The facts about the surfaces of parts, and how they lie.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceFacts {
    /// Parts that bound no solid, with the first defect.
    pub broken: Vec<String>,
    /// Pairs of triangles of one part that cross.
    pub crossings: usize,
    /// Parts that are more than one body.
    pub in_pieces: Vec<String>,
    /// Parts that enclose a void.
    pub closed: Vec<String>,
    /// The greatest height of a part's lowest point over the plate, mm.
    pub above_plate_mm: f64,
    /// The greatest deviation of a pose from a rigid motion.
    pub pose_error: f64,
    /// Parts that are larger than the printer.
    pub too_large: Vec<String>,
}

impl SurfaceFacts {
    fn and(mut self, other: Self) -> Self {
        self.broken.extend(other.broken);
        self.crossings += other.crossings;
        self.in_pieces.extend(other.in_pieces);
        self.closed.extend(other.closed);
        self.above_plate_mm = self.above_plate_mm.max(other.above_plate_mm);
        self.pose_error = self.pose_error.max(other.pose_error);
        self.too_large.extend(other.too_large);
        self
    }
}

/// Measures the surfaces of all parts.
pub fn measure_surfaces(evidence: &CoreEvidence, watch: &Watch) -> Result<SurfaceFacts, Cancelled> {
    let parts = (0..evidence.parts.len()).into_par_iter();
    let facts = parts.map(|part| {
        watch.check()?;
        let seen = Seen {
            promise: &evidence.promise.parts[part],
            mesh: &evidence.parts[part],
            file: &evidence.files[part],
        };
        seen.measure(evidence.promise.printer.build_volume_mm, watch)
    });
    let facts: Vec<SurfaceFacts> = facts.collect::<Result<_, Cancelled>>()?;
    Ok(facts
        .into_iter()
        .fold(SurfaceFacts::default(), SurfaceFacts::and))
}

/// A part: what is promised of it, its triangles in the model, and those of its file.
struct Seen<'a> {
    promise: &'a CorePartPromise,
    mesh: &'a TriMesh,
    file: &'a TriMesh,
}

impl Seen<'_> {
    /// Measures a part for a printer of a room, mm. Its surface is that of its file.
    fn measure(&self, room_mm: Option<[f64; 3]>, watch: &Watch) -> Result<SurfaceFacts, Cancelled> {
        let promise = self.promise;
        let id = || promise.id.clone();
        let welded = weld(self.file);
        let defects = Defects::of(&welded);
        let printed = self
            .mesh
            .map_vertices(|p| promise.print_from_model.to_print(p))
            .aabb();
        let size = printed.size();
        // A turn on the plate is allowed; rounding in a file is not more than this.
        let slack_mm = 1e-3;
        let fits = room_mm.is_none_or(|[x, y, z]| {
            let lies = |a: f64, b: f64| a <= x + slack_mm && b <= y + slack_mm;
            size.z <= z + slack_mm && (lies(size.x, size.y) || lies(size.y, size.x))
        });
        let inner = shells(&welded)
            .iter()
            .any(|shell| shell.signed_volume_mm3() < 0.0);
        let count = bodies(&welded).len();
        Ok(SurfaceFacts {
            broken: defects
                .map(|defects| format!("{}: {defects}", id()))
                .into_iter()
                .collect(),
            crossings: Crossings::of_watched(&welded, watch)?.pairs,
            in_pieces: (count != 1).then(id).into_iter().collect(),
            closed: inner.then(id).into_iter().collect(),
            above_plate_mm: printed.min.z.abs(),
            pose_error: promise.print_from_model.rigidity_error(),
            too_large: (!fits).then(id).into_iter().collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;
    use crate::geom::{Point, Vector};
    use crate::verify::{CorePartKind, Pose};

    /// Returns a pyramid on a foot of four triangles. One is a sliver without area: its corner `p`
    /// lies on the diagonal of the foot.
    fn pyramid_with_a_sliver() -> TriMesh {
        let corners = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [1.0, -2.0, 0.0],
            [1.3, 2.0, 0.0],
            [1.1, 0.0, 0.0],
            [1.0, 0.1, 2.0],
        ];
        let [a, b, c, d, p, top] = [0, 1, 2, 3, 4, 5];
        let foot = vec![[a, d, b], [a, b, p], [a, p, c], [p, b, c]];
        let sides = vec![[d, a, top], [b, d, top], [c, b, top], [a, c, top]];
        let triangles = [foot, sides].concat();
        TriMesh::new(corners.map(Point::from).to_vec(), triangles).unwrap()
    }

    fn part_in(pose: Pose) -> CorePartPromise {
        CorePartPromise {
            id: "1a".to_owned(),
            kind: CorePartKind::Shell,
            panel: 1,
            file: String::new(),
            sha256: String::new(),
            print_from_model: pose,
            void_mm3: 0.0,
            bores_mm3: 0.0,
            pins_mm3: [0.0; 2],
            cuts: Vec::new(),
            bosses: Vec::new(),
        }
    }

    #[test]
    fn crossings_are_those_of_a_part_s_file_and_not_of_the_part_turned_into_the_model() {
        let whole = pyramid_with_a_sliver();
        let moved = whole.map_vertices(|p| p + Vector::new(0.3, 0.2, 0.5));
        let crossing = whole.clone().joined(&moved);
        let turn = Rotation3::from_scaled_axis(Vector::new(0.17, 0.29, 0.11));
        let pose = Pose::new(turn.matrix(), &Vector::new(100.0, -50.0, 0.0));
        let promise = part_in(pose);
        let found = |file: &TriMesh, in_model: &TriMesh| {
            let mesh = in_model.map_vertices(|p| pose.to_model(p));
            let seen = Seen {
                promise: &promise,
                mesh: &mesh,
                file,
            };
            let facts = seen.measure(None, &Watch::silent()).unwrap();
            facts.crossings
        };
        assert_eq!(found(&whole, &crossing), 0);
        assert!(found(&crossing, &whole) > 0);
    }
}
