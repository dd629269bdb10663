//! Bodies of bosses and their prices.

use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;

use crate::{
    cut::{
        geometry::{chart::Chart, outline::Outline, section::Section},
        joints::{boss::MaterialPrice, pin_shape::PinSite, pin_size::Size, placement::PinScene},
        pieces::split::Joint,
        request::PlanRequest,
    },
    geom::{Bvh, Point, Vector, orthonormal_basis},
    mesh::{Csg, TriMesh},
};

/// Extra radius and height of a boss, mm: far above the rounding of booleans, below any pixel.
pub(crate) const MARGIN_MM: f64 = 0.01;

/// Sides of a boss's polygon.
const SIDES: usize = 32;

/// Rotation of its corners about its axis, in sides: keeps every side off the planes of the model's
/// axes.
const PHASE: f64 = 0.37;

/// Rings on which the price is sampled: (share of the radius, number of samples).
const SAMPLE_RINGS: [(f64, usize); 3] = [(0.0, 1), (0.5, 6), (0.9, 12)];

/// Heights at which the price is sampled, as shares of the boss's height.
const SAMPLE_HEIGHTS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// Axis of a pin: its point in the cut, and the unit direction in which the pin protrudes.
pub(crate) struct PinAxis {
    pub(crate) middle: Point,
    pub(crate) along: Vector,
}

impl PinAxis {
    pub(crate) fn of(pin: &PinSite) -> Self {
        Self {
            middle: Point::from(pin.center_mm),
            along: Vector::from(pin.direction),
        }
    }
}

/// Makes and prices the bosses of one body.
pub(crate) struct BossMaker<'a> {
    request: &'a PlanRequest,
    /// The body with its voids filled.
    filled: &'a PinScene<'a>,
    /// Surface of the body with its voids.
    hollow_surface: Bvh,
    /// Surface of the filled body.
    filled_surface: Bvh,
    price: &'a MaterialPrice,
    /// The outlines of the filled body in the cuts, once they are asked for.
    outlines: Vec<OnceLock<Outline>>,
}

impl<'a> BossMaker<'a> {
    /// Returns a maker for a body with voids and the same body with its voids filled.
    pub(crate) fn new(
        hollow: &TriMesh,
        filled: &'a PinScene<'a>,
        price: &'a MaterialPrice,
    ) -> Self {
        let [hollow_surface, filled_surface] =
            [hollow, filled.material].map(|mesh| Bvh::new(mesh.iter_corners()));
        Self {
            request: filled.request,
            filled,
            hollow_surface,
            filled_surface,
            price,
            outlines: filled.tree.planes.iter().map(|_| OnceLock::new()).collect(),
        }
    }

    /// Returns the outline of the filled body in a cut.
    pub(crate) fn outline(&self, cut: usize) -> &Outline {
        self.outlines[cut].get_or_init(|| {
            let section = Section::of_mesh(self.filled.material, &self.filled.tree.planes[cut]);
            section.outline(&(0..section.rings.len()).collect::<Vec<_>>())
        })
    }

    /// Returns the price of a pin's boss, to first order and up to a factor: the integral of the
    /// quadric over the void it fills.
    pub(crate) fn price(&self, axis: &PinAxis, size: &Size) -> f64 {
        let PinAxis { middle, along } = axis;
        let MaterialPrice { quadric, frame } = self.price;
        let (u, v) = orthonormal_basis(along);
        let radius = size.room_mm(self.request) / 2.0;
        let [low, high] = self.end_heights_mm(size);
        let value = |height: f64, ring: f64, turn: f64| {
            let radial = (u * turn.cos() + v * turn.sin()) * (ring * radius);
            let p = middle + radial + along * (low + height * (high - low));
            let value = quadric.value(&frame.to_local(&p));
            if value > 0.0 && self.hollow_surface.winding(&p) == 0 {
                value
            } else {
                0.0
            }
        };
        let rings = SAMPLE_RINGS.iter().flat_map(|&(ring, count)| {
            let turn = move |k: usize| TAU * (k as f64 + PHASE) / count as f64;
            (0..count).map(move |k| (ring, turn(k)))
        });
        rings
            .flat_map(|(ring, turn)| SAMPLE_HEIGHTS.map(|height| value(height, ring, turn)))
            .sum()
    }

    /// Returns the two ends of a pin's boss along the pin, mm from the cut.
    fn end_heights_mm(&self, size: &Size) -> [f64; 2] {
        let wall = size.corner() + self.request.wall_mm + MARGIN_MM;
        let back = if size.dowel.is_some() {
            size.depth
        } else {
            size.chamfer
        };
        [-(wall + back), size.depth + wall]
    }

    /// Builds a boss as the convex hull of discs about the pin's axis. Further discs at the wall
    /// close gaps too narrow to clean. `None` if the hull has no volume.
    pub(crate) fn body(&self, joint: &Joint, axis: &PinAxis, size: &Size) -> Option<TriMesh> {
        let PinAxis { middle, along } = axis;
        let radius = size.room_mm(self.request) / 2.0 + MARGIN_MM;
        let ends = self
            .end_heights_mm(size)
            .map(|height| middle + along * height);
        let ribs = ends.iter().filter_map(|end| self.rib(end, along, radius));
        let ribs = ribs.chain([self.foot(joint, middle, radius)]);
        let centers: Vec<Point> = ends.iter().copied().chain(ribs).collect();
        let points: Vec<Point> = centers
            .iter()
            .flat_map(|center| disc(center, along, radius))
            .collect();
        Csg::convex_hull(&points).ok()?.to_mesh().ok()
    }

    /// Moves a disc's centre within the cut until the disc touches the outside.
    fn foot(&self, joint: &Joint, middle: &Point, radius: f64) -> Point {
        let plane = &self.filled.tree.planes[joint.cut];
        let chart = Chart::of_plane(plane);
        let at = chart.flat(middle);
        let outward = self.outline(joint.cut).nearest(&at) - at;
        chart.lift(
            plane,
            &(at + outward.normalize() * (outward.norm() - radius).max(0.0)),
        )
    }

    /// Moves a disc's centre across its axis to the nearest wall. `None` if there is no gap between
    /// them, or a gap wide enough to clean.
    fn rib(&self, end: &Point, along: &Vector, radius: f64) -> Option<Point> {
        let request = self.request;
        let outward = self.filled_surface.closest(end, f64::INFINITY, &[])?.point - end;
        let gap = outward.norm() - radius;
        let across = (outward - along * along.dot(&outward)).try_normalize(0.0)?;
        (gap > 0.0 && gap < request.wall_mm + request.min_opening_mm).then(|| end + across * gap)
    }
}

/// Returns the corners of a polygon around a disc.
pub(crate) fn disc(center: &Point, normal: &Vector, radius_mm: f64) -> Vec<Point> {
    let (u, v) = orthonormal_basis(normal);
    let corner_mm = radius_mm / (PI / SIDES as f64).cos();
    let corner = |side: usize| {
        let (sin, cos) = (TAU * (side as f64 + PHASE) / SIDES as f64).sin_cos();
        center + (u * cos + v * sin) * corner_mm
    };
    (0..SIDES).map(corner).collect()
}
