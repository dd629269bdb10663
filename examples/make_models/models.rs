//! The models of the documentation and the tests, made by code alone.

use std::f64::consts::{PI, TAU};

use equipoise::geom::{Frame, Matrix, Point, Vector};
use equipoise::mesh::{Defects, Solid, TriMesh, primitives, scaled};

/// Longest side of every model, mm.
const SIZE_MM: f64 = 100.0;

/// Level of the balls: 5120 triangles, with edges of 4 mm on a model of 100 mm.
const LEVEL: u32 = 4;

/// Corners of every ring of a stack, 2.3 mm apart on a girth of 100 mm.
const RING_CORNERS: usize = 48;

/// A function that makes a model of any size.
pub type Maker = fn() -> TriMesh;

/// Every model by its name.
///
/// * `tilted-ellipsoid` spins upright on its lowest point (z up) only when it is hollow.
/// * `asymmetric-heart` is a top on its tip, with lobes of different sizes.
/// * `balancing-figure` leans so far over its foot that it stands only when it is hollow.
/// * `yoyo-cuboid` is almost square and askew: its spin axis (z) is not the dominant one.
/// * `three-spheres` is a leaning stack on a small foot. Hollowing alone cannot make it stand.
pub const MODELS: [(&str, Maker); 5] = [
    ("tilted-ellipsoid", tilted_ellipsoid),
    ("asymmetric-heart", asymmetric_heart),
    ("balancing-figure", balancing_figure),
    ("yoyo-cuboid", yoyo_cuboid),
    ("three-spheres", three_spheres),
];

/// Makes a model as a solid whose longest side is 100 mm.
pub fn solid(make: Maker) -> Result<Solid, Defects> {
    let mesh = make();
    Solid::new(scaled(&mesh, SIZE_MM / mesh.longest_side_mm()))
}

/// Makes a tilted ellipsoid with three different axes and a vertex at its lowest point.
fn tilted_ellipsoid() -> TriMesh {
    let axes = Matrix::from_diagonal(&Vector::new(50.0, 40.0, 44.0));
    let tilt = rotation_about(Vector::y(), 20.0) * rotation_about(Vector::x(), 8.0);
    // The map sends this point of the unit ball lowest. The ball has a vertex on its own −z axis.
    let lowest = -(axes * tilt.transpose() * Vector::z());
    let on_lowest = Frame::with_axis(Point::origin(), &-lowest);
    unit_ball().map_vertices(|p| tilt * axes * on_lowest.to_model(p))
}

/// Makes a heart on its tip, with one lobe larger than the other.
///
/// Each upright line through a ball is lifted by its distance from the middle plane, rounded off
/// there. So no two points can meet.
fn asymmetric_heart() -> TriMesh {
    const LIFT: f64 = 0.75;
    const ROUNDING: f64 = 0.15;
    const LARGER_LOBE: f64 = 0.1;
    unit_ball().map_vertices(|p| {
        let lift = LIFT * p.x.hypot(ROUNDING);
        Point::new(p.x * (1.0 + LARGER_LOBE * p.x), 0.75 * p.y, p.z + lift)
    })
}

/// Makes an egg that leans to +x over a flat foot, with a head and two arms.
fn balancing_figure() -> TriMesh {
    const LEAN: Vector = Vector::new(0.34, 0.02, 1.0);
    const HEIGHT: f64 = 0.96;
    let rings = (0..=60).map(|i| {
        let z = HEIGHT * f64::from(i) / 60.0;
        let body = 0.21
            * (PI * (0.12 + 0.88 * z / 0.68).min(1.0))
                .sin()
                .max(0.0)
                .sqrt();
        let head = (0.15_f64.powi(2) - (z - 0.82).powi(2)).max(0.0).sqrt();
        let arms = 0.2 * (-((z - 0.5) / 0.05).powi(2)).exp();
        Ring {
            center: Point::from(LEAN * z),
            radius: body.max(head).max(0.05),
            arms,
        }
    });
    stack(&rings.collect::<Vec<_>>())
}

/// Makes a box with nearly equal sides, turned a little out of its frame.
fn yoyo_cuboid() -> TriMesh {
    let half = Vector::new(50.0, 42.0, 44.0);
    let askew = rotation_about(Vector::x(), 3.0) * rotation_about(Vector::y(), 2.0);
    primitives::cuboid(&Point::from(-half), &Point::from(half)).map_vertices(|p| askew * p)
}

/// Makes three balls one on another, each further out, on a foot cut from the lowest.
fn three_spheres() -> TriMesh {
    /// Centre (x, z) and radius of each ball.
    const BALLS: [(f64, f64, f64); 3] = [(0.0, 0.9, 1.0), (1.1, 2.3, 1.0), (2.4, 3.5, 1.0)];
    /// First and last slice of each ball, as angles from its lowest point. Necks join the balls.
    const SLICES_DEG: (f64, f64) = (18.0, 150.0);
    let ring = |(x, z, radius): (f64, f64, f64), step: i32| {
        let angle =
            (SLICES_DEG.0 + (SLICES_DEG.1 - SLICES_DEG.0) * f64::from(step) / 24.0).to_radians();
        let center = Point::new(x, 0.0, z - radius * angle.cos());
        Ring {
            center,
            radius: radius * angle.sin(),
            arms: 0.0,
        }
    };
    stack(
        &BALLS
            .iter()
            .flat_map(|&ball| (0..=24).map(move |step| ring(ball, step)))
            .collect::<Vec<_>>(),
    )
}

fn unit_ball() -> TriMesh {
    primitives::ball(&Point::origin(), 1.0, LEVEL)
}

/// Returns the rotation about a unit axis (Rodrigues).
fn rotation_about(axis: Vector, angle_deg: f64) -> Matrix {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    Matrix::identity() * cos + axis.cross_matrix() * sin + axis * axis.transpose() * (1.0 - cos)
}

/// A horizontal slice of a body: round, with two arms along ±y.
struct Ring {
    center: Point,
    radius: f64,
    arms: f64,
}

impl Ring {
    fn corner(&self, index: usize) -> Point {
        let (sin, cos) = (TAU * index as f64 / RING_CORNERS as f64).sin_cos();
        let reach = self.radius + self.arms * sin.powi(12);
        self.center + Vector::new(cos, sin, 0.0) * reach
    }
}

/// Joins slices, lowest first, to a body that is flat below and above. Each slice is star-shaped
/// about its centre, so the surface cannot cross itself.
fn stack(rings: &[Ring]) -> TriMesh {
    let n = RING_CORNERS as u32;
    let (bottom, top) = (rings.len() as u32 * n, rings.len() as u32 * n + 1);
    let mut vertices: Vec<Point> = rings
        .iter()
        .flat_map(|ring| (0..RING_CORNERS).map(|i| ring.corner(i)))
        .collect();
    vertices.extend(rings.first().map(|ring| ring.center));
    vertices.extend(rings.last().map(|ring| ring.center));
    let mut triangles = Vec::new();
    for i in 0..n {
        let next = (i + 1) % n;
        for low in (0..bottom - n).step_by(RING_CORNERS) {
            let high = low + n;
            triangles.extend([
                [low + i, low + next, high + next],
                [low + i, high + next, high + i],
            ]);
        }
        triangles.extend([
            [bottom, next, i],
            [top, top - 1 - n + i, top - 1 - n + next],
        ]);
    }
    TriMesh::new(vertices, triangles).unwrap_or_default()
}
