//! The family of planes from which a plan is chosen.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        hollowed::{Hollowed, Void},
        planner::{cover::VoidSet, mirror::mirror_planes},
        request::PlanRequest,
        seat::{self, Seat},
    },
    geom::{Plane, Point, Vector},
    mass::{Body, moments_of_mesh},
    mesh::{Solid, TriMesh},
};

/// Number of directions spread over the half sphere, about 10° apart. Fewer miss skew planes
/// through three voids; more cost time in proportion.
const SPREAD_DIRECTIONS: usize = 160;

/// Number of voids, largest first, whose centres define further directions. Ten voids give a
/// thousand, and the number grows with the fourth power.
const PAIRED_VOIDS: usize = 10;

/// Sine of the angle below which two lines between voids count as parallel and define no common
/// normal.
const PARALLEL_SINE: f64 = 1e-6;

/// Number of offsets tried in each interval in which a plane meets the same voids.
const OFFSETS_PER_INTERVAL: usize = 9;

/// Factor on that number for level planes of an object that is looked at: its necks and creases lie
/// level more often than not.
const LEVEL_FACTOR: usize = 4;

/// Least width of an interval, mm. A printer could not tell offsets inside a narrower one from its
/// ends.
const MIN_INTERVAL_MM: f64 = 0.02;

/// A plane that may be cut, and the voids whose extent it meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    pub(crate) plane: Plane,
    /// The voids that the plane meets. It may open fewer of them wide enough.
    pub(crate) met: VoidSet,
    /// Cheap estimate of the narrowest opening, mm, taking the voids as ellipsoids.
    pub(crate) guess_mm: f64,
}

/// The extent of a void along a direction.
#[derive(Debug, Clone, Copy)]
struct Extent<'a> {
    low_mm: f64,
    high_mm: f64,
    /// Diameter of the ball with the void's volume, mm.
    breadth_mm: f64,
    /// Seat of the part that the void holds.
    seat: Option<&'a Seat>,
}

/// Returns all candidates, sorted by direction, then offset; the model's planes of symmetry come
/// last. Along each direction, the ends of the voids' extents divide the offsets into cells. Planes
/// in a cell meet the same voids, and each cell is sampled.
pub(crate) fn candidates(
    hollowed: &Hollowed,
    request: &PlanRequest,
) -> Result<Vec<Candidate>, Cancelled> {
    let breadths: Vec<f64> = hollowed
        .voids
        .iter()
        .map(|void| breadth_mm(void.mesh()))
        .collect();
    let directions = directions(hollowed, request);
    let up = request.seams.up();
    let row = |normal: &Vector| {
        request.watch.check()?;
        let extents = hollowed
            .voids
            .iter()
            .zip(&breadths)
            .map(|(void, &breadth_mm)| extent(void, normal, breadth_mm));
        let offsets = if up.is_some_and(|up| up == *normal) {
            LEVEL_FACTOR * OFFSETS_PER_INTERVAL
        } else {
            OFFSETS_PER_INTERVAL
        };
        Ok(candidates_along(
            normal,
            &extents.collect::<Vec<_>>(),
            offsets,
        ))
    };
    let rows = directions.par_iter().map(row);
    let rows = rows.collect::<Result<Vec<Vec<Candidate>>, Cancelled>>()?;
    let middles = symmetry_planes(&hollowed.outer).into_iter().map(|plane| {
        let extents = hollowed
            .voids
            .iter()
            .zip(&breadths)
            .map(|(void, &breadth_mm)| extent(void, &plane.normal, breadth_mm));
        candidate(plane, &extents.collect::<Vec<_>>())
    });
    let middles = middles.filter(|middle| middle.met != 0);
    Ok(rows.concat().into_iter().chain(middles).collect())
}

/// Returns the planes of symmetry of the model.
fn symmetry_planes(model: &Solid) -> Vec<Plane> {
    let center = Body::new(&moments_of_mesh(model.mesh()), 1.0).center;
    mirror_planes(model, &center, &principal_axes(model.mesh()))
}

/// Returns the directions of the family. The axes of the object that is looked at come first, then
/// those of the model and of the goal. Then follow the
/// principal axes of the solid and of every void. The normals of the seats follow, then a Fibonacci
/// spiral over the half sphere, and the directions in which voids lie flattest. For the spiral see
/// Swinbank and Purser, "Fibonacci grids", Q. J. R. Meteorol. Soc. 132, 2006.
fn directions(hollowed: &Hollowed, request: &PlanRequest) -> Vec<Vector> {
    let mut directions: Vec<Vector> = Vec::new();
    if let Some(up) = request.seams.up() {
        let (side, front) = crate::geom::orthonormal_basis(&up);
        directions.extend([up, side, front]);
    }
    directions.extend([Vector::x(), Vector::y(), Vector::z()]);
    let axis = request.axis.direction.normalize();
    let (u, v) = crate::geom::orthonormal_basis(&axis);
    directions.extend([axis, u, v]);
    let bodies = hollowed.voids.iter().map(|void| &void.body);
    let solids = std::iter::once(&hollowed.outer).chain(bodies);
    directions.extend(solids.flat_map(|solid| principal_axes(solid.mesh())));
    directions.extend(seat::normals(&hollowed.seats().collect::<Vec<_>>()));
    directions.extend((0..SPREAD_DIRECTIONS).map(on_half_sphere));
    directions.extend(flattest_directions(&centers(hollowed)));
    directions.retain(|d| d.iter().all(|c| c.is_finite()));
    directions
}

/// Returns the centres of the largest voids.
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

/// Returns the directions in which points may lie flattest: the common normals of any two lines
/// through two points each. The width of any subset is reached along one of them, where two edges,
/// or a face and a corner, touch the parallel planes. See Houle and Toussaint, "Computing the width
/// of a set", IEEE TPAMI 10, 1988. So if some plane opens several balls of one size, a plane of the
/// family opens them too.
fn flattest_directions(points: &[Point]) -> Vec<Vector> {
    let pairs = |count: usize| (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
    let lines: Vec<Vector> = pairs(points.len())
        .filter_map(|(i, j)| (points[i] - points[j]).try_normalize(f64::MIN_POSITIVE))
        .collect();
    pairs(lines.len())
        .filter_map(|(i, j)| lines[i].cross(&lines[j]).try_normalize(PARALLEL_SINE))
        .collect()
}

/// Returns point `index` of the spiral over the upper half sphere.
fn on_half_sphere(index: usize) -> Vector {
    let z = (index as f64 + 0.5) / SPREAD_DIRECTIONS as f64;
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let (sin, cos) = (golden_angle * index as f64).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    Vector::new(radius * cos, radius * sin, z)
}

/// Returns the principal axes of the region that a mesh bounds.
fn principal_axes(mesh: &TriMesh) -> [Vector; 3] {
    let axes = Body::new(&moments_of_mesh(mesh), 1.0).principal().axes;
    [0, 1, 2].map(|i| axes.column(i).into_owned().normalize())
}

/// Returns the diameter of the ball with the volume of the mesh, mm.
fn breadth_mm(mesh: &TriMesh) -> f64 {
    (moments_of_mesh(mesh).volume().abs() * 6.0 / std::f64::consts::PI).cbrt()
}

/// Returns the extent of a void along `normal`.
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

    /// Estimates the opening at the offset, mm: that of an ellipsoid of this extent and volume.
    fn guess_mm(&self, offset_mm: f64) -> f64 {
        let length = self.high_mm - self.low_mm;
        let across = (self.breadth_mm.powi(3) / length).sqrt();
        let part = (offset_mm - self.low_mm) * (self.high_mm - offset_mm) / (length * length / 4.0);
        across * part.max(0.0).sqrt()
    }
}

/// Returns the candidates normal to one direction: those through the middles of seats, then those
/// of every cell, at so many offsets.
fn candidates_along(normal: &Vector, extents: &[Extent], offsets: usize) -> Vec<Candidate> {
    let mut ends: Vec<f64> = extents.iter().flat_map(|e| [e.low_mm, e.high_mm]).collect();
    ends.sort_by(f64::total_cmp);
    let cells = ends
        .windows(2)
        .filter(|cell| cell[1] - cell[0] >= MIN_INTERVAL_MM);
    let heights = cells.flat_map(|cell| {
        let step = (cell[1] - cell[0]) / offsets as f64;
        (0..offsets).map(move |i| cell[0] + step * (i as f64 + 0.5))
    });
    let seats = extents.iter().filter_map(|extent| extent.seat);
    let middles = seats.map(|seat| seat.height_mm(normal));
    let planes = middles.chain(heights).map(|offset_mm| Plane {
        normal: *normal,
        offset_mm,
    });
    planes
        .map(|plane| candidate(plane, extents))
        .filter(|c| c.met != 0)
        .collect()
}

/// Returns the plane with the voids it meets. A void that holds a part counts only if the part fits
/// through the opening.
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
