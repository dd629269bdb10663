//! The model in a frame of its own, with what the search for its natural up measures again and
//! again.

use crate::geom::{Frame, Matrix, Point, Vector};
use crate::mass::moments_of_mesh;
use crate::mesh::{Csg, Solid, TriMesh, area_mm2, spread_points};

/// The number of points that stand for the surface. A share or a mean is then right to about 2 %.
const SAMPLES: usize = 2400;

/// A solid seen in the frame of its surface's principal axes.
///
/// Every later step starts from this frame, so the answer turns with the model: the axes of the
/// file decide nothing.
pub(super) struct Shape {
    /// The frame: its origin is the centroid of the surface, its axes are the principal ones, the
    /// longest last.
    pub frame: Frame,
    /// The spreads of the surface along the axes, mm²; ascending.
    pub spreads_mm2: [f64; 3],
    /// The triangles in the frame.
    pub mesh: TriMesh,
    /// The outward unit normals of the triangles; zero without area.
    pub normals: Vec<Vector>,
    /// The areas of the triangles, mm².
    pub areas_mm2: Vec<f64>,
    /// The area of the surface, mm².
    pub area_mm2: f64,
    /// The centre of mass.
    pub center: Point,
    /// The vertices of the convex hull.
    pub hull: Vec<Point>,
    /// The vertices beside each vertex of the hull.
    pub hull_beside: Vec<Vec<u32>>,
    /// The outward normals of the hull's triangles, the largest first; their lengths are twice the
    /// areas, mm².
    pub hull_normals: Vec<Vector>,
    /// The volume of the hull, mm³.
    pub hull_volume_mm3: f64,
    /// The length of the model: its greatest distance between two corners, to a few per cent, mm.
    pub length_mm: f64,
    /// Points spread evenly over the surface.
    pub samples: Vec<Point>,
}

impl Shape {
    /// Measures a solid. `None` if it has no convex hull. Linear in the triangles, but for the
    /// hull.
    pub fn of(solid: &Solid) -> Option<Self> {
        let (frame, spreads_mm2) = own_frame(solid.mesh());
        let mesh = solid.mesh().in_frame(&frame);
        let hull = Csg::convex_hull(mesh.vertices()).and_then(|hull| hull.to_mesh());
        let hull = hull.ok().filter(|hull| !hull.vertices().is_empty())?;
        let doubled = |[a, b, c]: [Point; 3]| (b - a).cross(&(c - a));
        let normals = mesh.iter_corners().map(doubled).map(|normal| {
            let unit = normal.try_normalize(0.0);
            unit.unwrap_or_else(Vector::zeros)
        });
        let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
        let areas_mm2: Vec<f64> = corners.iter().map(area_mm2).collect();
        let samples = spread_points(&corners, SAMPLES);
        Some(Self {
            frame,
            spreads_mm2,
            normals: normals.collect(),
            area_mm2: areas_mm2.iter().sum(),
            areas_mm2,
            center: moments_of_mesh(&mesh).centroid(),
            length_mm: length_mm(hull.vertices()),
            hull_normals: largest_first(hull.iter_corners().map(doubled).collect()),
            hull_beside: beside(&hull),
            hull_volume_mm3: hull.signed_volume_mm3(),
            hull: hull.into_vertices(),
            samples: samples.iter().map(|sample| sample.at).collect(),
            mesh,
        })
    }
}

/// Returns the frame of a surface's principal axes, the longest last, and the spreads along them,
/// mm². Each of the first two axes points to the longer tail of the surface.
fn own_frame(mesh: &TriMesh) -> (Frame, [f64; 3]) {
    let middle = mesh.aabb().center();
    let (mut whole_mm2, mut first, mut second) = (0.0, Vector::zeros(), Matrix::zeros());
    for corners in mesh.iter_corners() {
        let share = area_mm2(&corners) / 12.0;
        let [a, b, c] = corners.map(|corner| corner - middle);
        let sum = a + b + c;
        whole_mm2 += 12.0 * share;
        first += sum * (4.0 * share);
        let squares = [a, b, c, sum].map(|v| v * v.transpose());
        second += squares.into_iter().sum::<Matrix>() * share;
    }
    let mean = first / whole_mm2;
    let eigen = (second / whole_mm2 - mean * mean.transpose()).symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
    let origin = middle + mean;
    let [x, y] = [order[0], order[1]].map(|i| {
        let axis: Vector = eigen.eigenvectors.column(i).into();
        let cubes = mesh
            .vertices()
            .iter()
            .map(|v| (v - origin).dot(&axis).powi(3));
        axis * cubes.sum::<f64>().signum()
    });
    let frame = Frame {
        origin,
        axes: Matrix::from_columns(&[x, y, x.cross(&y)]),
    };
    (frame, order.map(|i| eigen.eigenvalues[i]))
}

/// Returns the greatest distance found in two sweeps, mm: from the corner farthest from the origin
/// to the corner farthest from that.
fn length_mm(corners: &[Point]) -> f64 {
    let farthest = |from: Point| {
        let distance = |to: &Point| (to - from).norm_squared();
        let by_distance = |a: &&Point, b: &&Point| distance(a).total_cmp(&distance(b));
        let far = corners.iter().max_by(by_distance);
        far.copied().unwrap_or(from)
    };
    let end = farthest(Point::origin());
    (farthest(end) - end).norm()
}

fn largest_first(mut normals: Vec<Vector>) -> Vec<Vector> {
    normals.retain(|normal| normal.norm_squared() > 0.0);
    normals.sort_by(|a, b| b.norm_squared().total_cmp(&a.norm_squared()));
    normals
}

/// Returns the vertices at the other ends of the edges of each vertex of a closed mesh.
fn beside(mesh: &TriMesh) -> Vec<Vec<u32>> {
    let mut beside = vec![Vec::new(); mesh.vertices().len()];
    for &[a, b, c] in mesh.triangles() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            beside[from as usize].push(to);
        }
    }
    beside
}
