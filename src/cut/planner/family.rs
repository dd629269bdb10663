//! The family of planes a plan is chosen from.

use rayon::prelude::*;

use crate::{
    cut::{
        hollowed::{Hollowed, Void},
        planner::{cover::VoidSet, mirror::mirror_planes},
        request::PlanRequest,
        seat::{self, Seat},
    },
    geom::{Plane, Point, Vector},
    mass::{Body, moments_of_mesh},
    mesh::TriMesh,
};

/// How many directions are spread over the half sphere: about 10° apart. Fewer miss skew planes
/// through three voids, more cost time in proportion.
const SPREAD_DIRECTIONS: usize = 160;

/// How many voids, the largest, decide between them on directions of their own: with ten there are
/// a thousand, and their number grows with the fourth power.
const PAIRED_VOIDS: usize = 10;

/// Two lines between voids that lean less than this (sine) against each other have no common normal
/// to speak of.
const PARALLEL_SINE: f64 = 1e-6;

/// How many offsets are tried in each interval in which the same voids are met.
const OFFSETS_PER_INTERVAL: usize = 9;

/// Intervals narrower than this hold no offset that a printer could tell from their ends, mm.
const MIN_INTERVAL_MM: f64 = 0.02;

/// A plane that may be cut, and the voids whose extent it meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) plane: Plane,
    /// The voids the plane meets; it may open fewer wide enough.
    pub(crate) met: VoidSet,
    /// A cheap guess of the narrowest opening, mm: that of ellipsoids of the voids' extents.
    pub(crate) guess_mm: f64,
}

/// The extent of a void along a direction.
#[derive(Debug, Clone, Copy)]
struct Extent<'a> {
    low_mm: f64,
    high_mm: f64,
    /// The diameter of the ball of the void's volume, mm.
    breadth_mm: f64,
    /// The seat of the part that the void holds.
    seat: Option<&'a Seat>,
}

/// All candidates: for each direction the voids' extents are intervals, whose ends part the offsets
/// into cells that meet the same voids; each cell is sampled. Sorted by direction, then offset; the
/// model's planes of symmetry come last.
pub(crate) fn candidates(hollowed: &Hollowed, request: &PlanRequest) -> Vec<Candidate> {
    let breadths: Vec<f64> = hollowed
        .voids
        .iter()
        .map(|void| breadth_mm(void.mesh()))
        .collect();
    let directions = directions(hollowed, request);
    let rows: Vec<Vec<Candidate>> = directions
        .par_iter()
        .map(|normal| {
            let extents = hollowed
                .voids
                .iter()
                .zip(&breadths)
                .map(|(void, &breadth_mm)| extent(void, normal, breadth_mm));
            in_direction(normal, &extents.collect::<Vec<_>>())
        })
        .collect();
    let middles = symmetry(hollowed.outer.mesh()).into_iter().map(|plane| {
        let extents = hollowed
            .voids
            .iter()
            .zip(&breadths)
            .map(|(void, &breadth_mm)| extent(void, &plane.normal, breadth_mm));
        candidate(plane, &extents.collect::<Vec<_>>())
    });
    let middles = middles.filter(|middle| middle.met != 0);
    rows.concat().into_iter().chain(middles).collect()
}

/// The planes of symmetry of the model.
fn symmetry(model: &TriMesh) -> Vec<Plane> {
    let center = Body::new(&moments_of_mesh(model), 1.0).center;
    mirror_planes(model, &center, &principal_axes(model))
}

/// The directions of the family: the model's axes, the principal axes of the solid and of every
/// void, the goal's axis and its perpendiculars, a Fibonacci spiral over the half sphere (Swinbank
/// and Purser, "Fibonacci grids", Q. J. R. Meteorol. Soc. 132, 2006), and the directions in which
/// voids lie flattest.
fn directions(hollowed: &Hollowed, request: &PlanRequest) -> Vec<Vector> {
    let mut directions = vec![Vector::x(), Vector::y(), Vector::z()];
    let axis = request.axis.direction.normalize();
    let (u, v) = crate::geom::orthonormal_basis(&axis);
    directions.extend([axis, u, v]);
    let bodies = hollowed.voids.iter().map(|void| &void.body);
    let solids = std::iter::once(&hollowed.outer).chain(bodies);
    directions.extend(solids.flat_map(|solid| principal_axes(solid.mesh())));
    directions.extend(seat::normals(&hollowed.seats().collect::<Vec<_>>()));
    directions.extend((0..SPREAD_DIRECTIONS).map(on_half_sphere));
    directions.extend(flattest(&centers(hollowed)));
    directions.retain(|d| d.iter().all(|c| c.is_finite()));
    directions
}

/// The centres of the largest voids.
fn centers(hollowed: &Hollowed) -> Vec<Point> {
    let bodies = hollowed
        .voids
        .iter()
        .map(|void| moments_of_mesh(void.mesh()));
    let mut sized: Vec<(f64, Point)> = bodies
        .map(|moments| (moments.volume(), Body::new(&moments, 1.0).center))
        .collect();
    sized.sort_by(|a, b| b.0.total_cmp(&a.0));
    sized
        .into_iter()
        .take(PAIRED_VOIDS)
        .map(|(_, center)| center)
        .collect()
}

/// The directions in which points may lie flattest: the common normals of two lines through two of
/// them each. The least distance of parallel planes about any of the points is found along one of
/// these (two edges, or a side and a corner, touch the planes: Houle and Toussaint, "Computing the
/// width of a set", IEEE TPAMI 10, 1988), so that balls of one size which some plane opens are
/// opened by one of the family.
fn flattest(points: &[Point]) -> Vec<Vector> {
    let pairs = |count: usize| (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
    let lines: Vec<Vector> = pairs(points.len())
        .filter_map(|(i, j)| (points[i] - points[j]).try_normalize(f64::MIN_POSITIVE))
        .collect();
    pairs(lines.len())
        .filter_map(|(i, j)| lines[i].cross(&lines[j]).try_normalize(PARALLEL_SINE))
        .collect()
}

/// Point `index` of the spiral over the upper half sphere.
fn on_half_sphere(index: usize) -> Vector {
    let z = (index as f64 + 0.5) / SPREAD_DIRECTIONS as f64;
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let (sin, cos) = (golden_angle * index as f64).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    Vector::new(radius * cos, radius * sin, z)
}

/// The principal axes of the region a mesh bounds.
fn principal_axes(mesh: &TriMesh) -> [Vector; 3] {
    let axes = Body::new(&moments_of_mesh(mesh), 1.0).principal().axes;
    [0, 1, 2].map(|i| axes.column(i).into_owned().normalize())
}

/// The diameter of the ball that has the volume of the mesh, mm.
fn breadth_mm(mesh: &TriMesh) -> f64 {
    (moments_of_mesh(mesh).volume().abs() * 6.0 / std::f64::consts::PI).cbrt()
}

/// The extent of a void along `normal`.
fn extent<'a>(void: &'a Void, normal: &Vector, breadth_mm: f64) -> Extent<'a> {
    let heights = void
        .mesh()
        .vertices()
        .iter()
        .map(|p: &Point| normal.dot(&p.coords));
    let (low_mm, high_mm) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
        (low.min(h), high.max(h))
    });
    Extent {
        low_mm,
        high_mm,
        breadth_mm,
        seat: void.holds.as_ref(),
    }
}

impl Extent<'_> {
    fn meets(&self, offset_mm: f64) -> bool {
        self.low_mm < offset_mm && offset_mm < self.high_mm
    }

    /// The opening of an ellipsoid of this extent and volume at the offset, mm.
    fn guess_mm(&self, offset_mm: f64) -> f64 {
        let length = self.high_mm - self.low_mm;
        let across = (self.breadth_mm.powi(3) / length).sqrt();
        let part = (offset_mm - self.low_mm) * (self.high_mm - offset_mm) / (length * length / 4.0);
        across * part.max(0.0).sqrt()
    }
}

/// The candidates normal to one direction: those through the middles of seats, then those of every
/// cell.
fn in_direction(normal: &Vector, extents: &[Extent]) -> Vec<Candidate> {
    let mut ends: Vec<f64> = extents.iter().flat_map(|e| [e.low_mm, e.high_mm]).collect();
    ends.sort_by(f64::total_cmp);
    let cells = ends
        .windows(2)
        .filter(|cell| cell[1] - cell[0] >= MIN_INTERVAL_MM);
    let offsets = cells.flat_map(|cell| {
        let step = (cell[1] - cell[0]) / OFFSETS_PER_INTERVAL as f64;
        (0..OFFSETS_PER_INTERVAL).map(move |i| cell[0] + step * (i as f64 + 0.5))
    });
    let seats = extents.iter().filter_map(|extent| extent.seat);
    let middles = seats.map(|seat| seat.height_mm(normal));
    let planes = middles.chain(offsets).map(|offset_mm| Plane {
        normal: *normal,
        offset_mm,
    });
    planes
        .map(|plane| candidate(plane, extents))
        .filter(|c| c.met != 0)
        .collect()
}

/// The plane with the voids it meets; of those that hold a part, the ones that it lets the part
/// into.
fn candidate(plane: Plane, extents: &[Extent]) -> Candidate {
    let offset_mm = plane.offset_mm;
    let is_met = |extent: &Extent| {
        extent.meets(offset_mm) && extent.seat.is_none_or(|seat| seat.is_opened_by(&plane))
    };
    let met = || extents.iter().enumerate().filter(|(_, e)| is_met(e));
    Candidate {
        plane,
        met: met().fold(0, |set, (i, _)| set | 1 << i),
        guess_mm: met()
            .map(|(_, e)| e.guess_mm(offset_mm))
            .fold(f64::INFINITY, f64::min),
    }
}
