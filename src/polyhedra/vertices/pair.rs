//! Two polyhedra by the method of the paper: their vertices move together, and a face of each is to
//! meet one of the other.

use super::link::{Facing, Link};
use super::proof::{ProvedVertices, prove_vertices};
use super::sheet::Sheet;
use super::start::Shape;
use super::{
    FIRST, FIRST_STEP_RATIO, Field, RISE, ROUNDS, START_RATIO, STEPS, Structure, VertexPolyhedron,
    VertexRequest, Weights, descend, measured, no_room, shrunk,
};
use crate::base::verdict::Verdict;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::polyhedra::ground::Ground;
use crate::polyhedra::inscribe::{NoRoom, Request};
use crate::polyhedra::polyhedron::NotInside;
use crate::polyhedra::separation::ROUNDING_MM;
use crate::polyhedra::starts::{Deep, deep_points};

/// The share of the way between both starts that they may fill.
const FILL_RATIO: f64 = 0.95;
/// The gap that faces keep while they move, over the depth of the deepest point.
const GAP_RATIO: f64 = 0.01;

/// The order to two polyhedra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairRequest {
    /// The order to each of them.
    pub vertices: VertexRequest,
    /// The radius of the disc in which they are joined, mm.
    pub radius_mm: f64,
}

/// Two polyhedra of moved vertices, and how well the faces between them meet.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexPair {
    /// The polyhedra.
    pub polyhedra: [VertexPolyhedron; 2],
    /// The outward normals of the faces that meet.
    pub normals: [Vector; 2],
    /// The angle by which these normals are not opposed, radians.
    pub turn_rad: f64,
    /// The distance of both centres along the first normal, mm.
    pub apart_mm: f64,
    /// The distance of both centres beside it, mm.
    pub beside_mm: f64,
    /// The radius of the disc about the centres that lies in both faces, mm.
    pub disc_mm: f64,
    /// The least distance from the surface of samples of the cylinder between them, mm.
    pub cylinder_mm: f64,
}

impl VertexPair {
    /// Returns the volume of both, mm³.
    pub fn volume_mm3(&self) -> f64 {
        self.polyhedra.iter().map(|body| body.volume_mm3).sum()
    }
}

/// Moves the vertices of two start polyhedra until their volume is large and a face of each meets
/// one of the other. They start about two deep points; without these there is no room.
///
/// A local optimum. The same bytes on any number of threads.
pub fn grow_pair_by_vertices(
    ground: &Ground,
    request: &PairRequest,
    watch: &Watch,
) -> Result<Verdict<VertexPair, NoRoom>, Cancelled> {
    let distance = ground.distance();
    let deep = deep_points(&ground.obstacles().aabb(), |p| distance.signed(p));
    let deepest_mm = deep.first().map_or(0.0, |deep| deep.depth_mm);
    let none = || Verdict::No(no_room(deepest_mm, &request.vertices));
    let Some(start) = Start::of(&deep, request) else {
        return Ok(none());
    };
    let per_edge = request.vertices.samples_per_edge;
    let structures = start.shapes.each_ref();
    let structures = structures.map(|shape| Structure::new(shape, per_edge));
    let field = Field {
        distance,
        distance_mm: request.vertices.distance_mm,
        scale_mm: deepest_mm,
        sheet: request.vertices.room_mm.map(|room_mm| Sheet { room_mm }),
    };
    let link = start.link(request.radius_mm, GAP_RATIO * deepest_mm);
    let first = start.shapes[0].corners.len();
    let mut corners = start
        .shapes
        .each_ref()
        .map(|of| of.corners.clone())
        .concat();
    let mut weights = FIRST;
    for _ in 0..ROUNDS {
        watch.check()?;
        corners = descend(corners, STEPS, FIRST_STEP_RATIO * deepest_mm, |corners| {
            let halves = [&corners[..first], &corners[first..]];
            let own = [0, 1].map(|k| structures[k].energy(halves[k], &field, &weights));
            let [(low, mut gradient), (high, other)] = own;
            gradient.extend(other);
            let linked = [weights.bent, weights.near];
            let joined = link.energy(corners, &field, linked, &mut gradient);
            (low + high + joined, gradient)
        });
        weights = Weights {
            near: RISE * weights.near,
            bent: RISE * weights.bent,
            reflex: RISE * weights.reflex,
        };
    }
    let halves = [corners[..first].to_vec(), corners[first..].to_vec()];
    let [low, high] = halves;
    let [low, high] = [(0, low), (1, high)].map(|(k, of)| shrunk(&structures[k], of, &field));
    let facing = Facing::of(&link, &[low.clone(), high.clone()].concat());
    let [shape, other] = start.shapes;
    let found = [
        measured(ground, &structures[0], low, shape.faces),
        measured(ground, &structures[1], high, other.faces),
    ];
    let least_mm = request.vertices.distance_mm - ROUNDING_MM;
    Ok(match found.iter().all(|body| body.sampled_mm >= least_mm) {
        true => Verdict::Found(pair(found, &facing, request.radius_mm, &field)),
        false => none(),
    })
}

fn pair(
    polyhedra: [VertexPolyhedron; 2],
    facing: &Facing,
    radius_mm: f64,
    field: &Field,
) -> VertexPair {
    let [apart_mm, beside_mm] = facing.ways_mm();
    let samples = facing.samples(radius_mm).into_iter();
    let distances = samples.map(|(_, at)| field.distance.signed(&at));
    VertexPair {
        polyhedra,
        normals: facing.normals,
        turn_rad: facing.turn_rad(),
        apart_mm,
        beside_mm,
        disc_mm: facing.disc_mm(),
        cylinder_mm: distances.fold(f64::INFINITY, f64::min),
    }
}

/// Proves both polyhedra by planes that move inward, with a gap between them. The planes of the
/// faces that meet are made parallel first.
///
/// # Errors
/// Nothing is left of one of them inside the model.
pub fn prove_pair(
    ground: &Ground,
    pair: &VertexPair,
    request: &Request,
    gap_mm: f64,
) -> Result<[ProvedVertices; 2], NotInside> {
    let [first, second] = pair.normals;
    let normal = (first - second).try_normalize(0.0).unwrap_or(first);
    let reach_mm = |body: &VertexPolyhedron, normal: &Vector| {
        let places = body.corners.iter().map(|p| normal.dot(&p.coords));
        places.fold(f64::NEG_INFINITY, f64::max)
    };
    let [low, high] = &pair.polyhedra;
    let reaches_mm = [reach_mm(low, &normal), reach_mm(high, &-normal)];
    let middle_mm = 0.5 * (reaches_mm[0] - reaches_mm[1]);
    let bound = |k: usize, side: f64| Plane {
        normal: normal * side,
        offset_mm: reaches_mm[k].min(side * middle_mm - 0.5 * gap_mm),
    };
    let proved = |body: &VertexPolyhedron, own: &Vector, bound: Plane| {
        let likest = |a: &&Plane, b: &&Plane| {
            let [a, b] = [a, b].map(|plane| plane.normal.dot(own));
            a.total_cmp(&b)
        };
        let meets = body.planes.iter().max_by(likest).copied();
        let others = body.planes.iter().filter(|plane| Some(**plane) != meets);
        let planes = others.copied().chain([bound]).collect();
        prove_vertices(
            ground,
            &VertexPolyhedron {
                planes,
                ..body.clone()
            },
            request,
        )
    };
    Ok([
        proved(low, &first, bound(0, 1.0))?,
        proved(high, &second, bound(1, -1.0))?,
    ])
}

/// Two start polyhedra that turn a face to each other.
struct Start {
    shapes: [Shape; 2],
    /// The indices of these faces.
    faces: [usize; 2],
}

impl Start {
    /// Returns the largest polyhedra about two deep points that keep off each other; `None` if no
    /// two points have room.
    fn of(deep: &[Deep], request: &PairRequest) -> Option<Self> {
        let rooms: Vec<(Point, f64)> = deep
            .iter()
            .map(|deep| (deep.at, deep.depth_mm - request.vertices.distance_mm))
            .filter(|(_, room_mm)| *room_mm > 0.0)
            .collect();
        let pairs = (0..rooms.len()).flat_map(|a| (0..a).map(move |b| [b, a]));
        let sized = pairs.map(|pair| {
            let [a, b] = pair.map(|at| rooms[at]);
            let most_mm = FILL_RATIO * (b.0 - a.0).norm() / (a.1 + b.1);
            let radii_mm = [a.1, b.1].map(|room_mm| room_mm * START_RATIO.min(most_mm));
            (
                radii_mm[0].powi(3) + radii_mm[1].powi(3),
                [a.0, b.0],
                radii_mm,
            )
        });
        let best = sized.reduce(|a, b| if b.0 > a.0 { b } else { a });
        let (_, centers, radii_mm) = best?;
        let way = (centers[1] - centers[0]).try_normalize(0.0)?;
        let shaped = |k: usize, toward: Vector| {
            let shape = request.vertices.start.shape(&centers[k], radii_mm[k])?;
            Some(turned(shape, &centers[k], &toward))
        };
        let ((low, from), (high, to)) = (shaped(0, way)?, shaped(1, -way)?);
        Some(Self {
            shapes: [low, high],
            faces: [from, to],
        })
    }

    fn link(&self, radius_mm: f64, gap_mm: f64) -> Link {
        let first = self.shapes[0].corners.len();
        let of = |side: usize| {
            let corners = self.shapes[side].faces[self.faces[side]].iter();
            corners
                .map(|&corner| corner as usize + side * first)
                .collect()
        };
        Link {
            loops: [of(0), of(1)],
            radius_mm,
            gap_mm,
        }
    }
}

/// Turns a regular polyhedron about its centre until a face looks in a direction. Returns it with
/// the index of that face.
fn turned(shape: Shape, center: &Point, toward: &Vector) -> (Shape, usize) {
    let normal = |face: &Vec<u32>| {
        let corners = face
            .iter()
            .map(|&corner| shape.corners[corner as usize] - center);
        corners.sum::<Vector>().normalize()
    };
    let normals = shape.faces.iter().map(normal).enumerate();
    let nearest = normals.reduce(|a, b| {
        if b.1.dot(toward) > a.1.dot(toward) {
            b
        } else {
            a
        }
    });
    let Some((face, normal)) = nearest else {
        return (shape, 0);
    };
    let [from, to] = [normal, *toward].map(|axis| Frame::with_axis(*center, &axis));
    let corners = shape.corners.iter().map(|p| to.to_model(&from.to_local(p)));
    let corners = corners.collect();
    (Shape { corners, ..shape }, face)
}
