//! The method of the paper, as a cross-check: the vertices of a fixed polyhedron move.
//!
//! Song, Deng, Wang, Dong, Li, Fu and Liu, "CofiFab: coarse-to-fine fabrication of large 3D
//! objects", ACM Transactions on Graphics 35(4), 2016, and its supplement. The volume is maximised
//! under penalties. They are for samples that are too near to the model's surface, for bent faces,
//! for reflex edges and for faces larger than the sheet. They rise until little is broken. Then the
//! polyhedron shrinks about the mean of its corners until every sample keeps the distance and every
//! face fits.
//!
//! [`grow_pair_by_vertices`] moves two polyhedra together, so that a face of each meets one of the
//! other as section 4 of the supplement asks.
//!
//! Between samples nothing is promised. [`VertexPolyhedron::certified_mm`] says what the planes of
//! the faces do promise. Less than the distance does not mean that it is broken: a triangle beside
//! an edge may be parted by no single face. [`prove_vertices`] moves the faces inward until they
//! promise all of it: only such a polyhedron can be a base.
//!
//! The descent often stalls where a vertex meets the surface. How much it fills and proves, beside
//! planes, is told in [`crate::guide::large_objects`].

mod descent;
mod energy;
mod link;
mod pair;
mod proof;
mod sheet;
mod start;

pub use pair::{PairRequest, VertexPair, grow_pair_by_vertices, prove_pair};
pub use proof::{ProvedVertices, prove_vertices};
pub use start::StartSolid;

use super::ground::Ground;
use super::inscribe::NoRoom;
use super::separation::ROUNDING_MM;
use super::starts::deep_points;
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Plane, Point, Vector};
use descent::descend;
use energy::{Field, Structure, Weights};
use sheet::Sheet;

/// The share of the deepest point's room at which the corners start.
const START_RATIO: f64 = 0.8;
/// The penalties of the first round.
const FIRST: Weights = Weights {
    near: 200.0,
    bent: 20.0,
    reflex: 20.0,
};
/// Rounds, each with penalties that are this many times higher.
const ROUNDS: usize = 6;
const RISE: f64 = 5.0;
/// Steps of descent in a round.
const STEPS: usize = 80;
/// The first step over the depth of the deepest point.
const FIRST_STEP_RATIO: f64 = 0.02;
/// Halvings of the interval in which the last scale is looked for.
const HALVINGS: usize = 40;

/// The order to the vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VertexRequest {
    /// The distance from the surface that samples keep, mm.
    pub distance_mm: f64,
    /// The polyhedron from which they start.
    pub start: StartSolid,
    /// Samples inside each edge.
    pub samples_per_edge: usize,
    /// The rectangle of a sheet into which every face must go, mm; `None` for any size.
    pub room_mm: Option<[f64; 2]>,
}

/// A polyhedron by its vertices. Its faces may be bent by [`Self::bent_mm`].
#[derive(Debug, Clone, PartialEq)]
pub struct VertexPolyhedron {
    /// The corners.
    pub corners: Vec<Point>,
    /// The loops of the faces, counterclockwise from outside.
    pub faces: Vec<Vec<u32>>,
    /// The planes of the faces, each as far out as every corner lies below it.
    pub planes: Vec<Plane>,
    /// The volume, mm³.
    pub volume_mm3: f64,
    /// The least distance of a sample from the surface, mm.
    pub sampled_mm: f64,
    /// The distance from the surface that the planes of the faces part, mm; it may be negative.
    pub certified_mm: f64,
    /// The greatest distance of a corner from the plane of its face, mm.
    pub bent_mm: f64,
}

/// Moves the vertices of a start polyhedron until its volume is large, or says why there is no
/// room.
///
/// A local optimum. Models of 600 mm took 0.6 to 4.1 s of processor time. The same bytes on any
/// number of threads.
pub fn grow_by_vertices(
    ground: &Ground,
    request: &VertexRequest,
    watch: &Watch,
) -> Result<Verdict<VertexPolyhedron, NoRoom>, Cancelled> {
    let distance = ground.distance();
    let deep = deep_points(&ground.obstacles().aabb(), |p| distance.signed(p));
    let deepest_mm = deep.first().map_or(0.0, |deep| deep.depth_mm);
    let room_mm = deepest_mm - request.distance_mm;
    let start = deep.first().filter(|_| room_mm > 0.0);
    let shape = start.and_then(|deep| request.start.shape(&deep.at, START_RATIO * room_mm));
    let Some(shape) = shape else {
        return Ok(Verdict::No(no_room(deepest_mm, request)));
    };
    let structure = Structure::new(&shape, request.samples_per_edge);
    let field = Field {
        distance,
        distance_mm: request.distance_mm,
        scale_mm: deepest_mm,
        sheet: request.room_mm.map(|room_mm| Sheet { room_mm }),
    };
    let mut weights = FIRST;
    let mut corners = shape.corners.clone();
    for _ in 0..ROUNDS {
        watch.check()?;
        let step_mm = FIRST_STEP_RATIO * deepest_mm;
        corners = descend(corners, STEPS, step_mm, |corners| {
            structure.energy(corners, &field, &weights)
        });
        weights = Weights {
            near: RISE * weights.near,
            bent: RISE * weights.bent,
            reflex: RISE * weights.reflex,
        };
    }
    let corners = shrunk(&structure, corners, &field);
    let found = measured(ground, &structure, corners, shape.faces);
    // Bent around a hole, even its middle may be too near to the surface.
    Ok(if found.sampled_mm < request.distance_mm - ROUNDING_MM {
        Verdict::No(no_room(deepest_mm, request))
    } else {
        Verdict::Found(found)
    })
}

fn no_room(deepest_mm: f64, request: &VertexRequest) -> NoRoom {
    NoRoom {
        deepest_mm,
        distance_mm: request.distance_mm,
        least_factor: None,
    }
}

/// Shrinks the polyhedron about the mean of its corners until every sample keeps the distance.
fn shrunk(structure: &Structure, corners: Vec<Point>, field: &Field) -> Vec<Point> {
    let sum: Vector = corners.iter().map(|p| p.coords).sum();
    let middle = Point::from(sum / corners.len() as f64);
    let scaled = |factor: f64| -> Vec<Point> {
        let scaled = corners.iter().map(|p| middle + (p - middle) * factor);
        scaled.collect()
    };
    let keeps = |factor: f64| structure.keeps(&scaled(factor), field);
    if keeps(1.0) {
        return corners;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = (low + high) / 2.0;
        *(if keeps(middle) { &mut low } else { &mut high }) = middle;
    }
    scaled(low)
}

fn measured(
    ground: &Ground,
    structure: &Structure,
    corners: Vec<Point>,
    faces: Vec<Vec<u32>>,
) -> VertexPolyhedron {
    let planes = structure.planes(&corners);
    let off = |face: usize, corner: u32| {
        let (normal, mean) = planes[face];
        normal.dot(&(corners[corner as usize] - mean))
    };
    let bent = (0..faces.len()).flat_map(|face| {
        let corners = faces[face].iter();
        corners.map(move |&corner| off(face, corner).abs())
    });
    let bent_mm = bent.fold(0.0, f64::max);
    // A plane counts only as far out as every corner lies below it. A face without area has none.
    let bounding: Vec<Plane> = planes
        .iter()
        .filter(|(normal, _)| *normal != Vector::zeros())
        .map(|(normal, _)| Plane {
            normal: *normal,
            offset_mm: corners
                .iter()
                .map(|p| normal.dot(&p.coords))
                .fold(f64::NEG_INFINITY, f64::max),
        })
        .collect();
    VertexPolyhedron {
        volume_mm3: structure.volume_mm3(&corners),
        sampled_mm: structure.least_mm(&corners, ground.distance()),
        certified_mm: ground.obstacles().least_parted_mm(&bounding),
        planes: bounding,
        bent_mm,
        corners,
        faces,
    }
}
