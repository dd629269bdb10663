//! The bodies of bosses, and what they cost.

use std::f64::consts::{PI, TAU};

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

/// How much wider than needed a boss is, mm: far above the rounding of booleans, below any pixel.
pub(crate) const MARGIN_MM: f64 = 0.01;

/// Sides of a boss.
const SIDES: usize = 32;

/// The turn of its corners about its axis, in sides, so that none lies in a plane of the model's
/// axes.
const ASKEW: f64 = 0.37;

/// Rings and heights in which a boss's price is sampled.
const PRICED_RINGS: [(f64, usize); 3] = [(0.0, 1), (0.5, 6), (0.9, 12)];

/// See [`PRICED_RINGS`]; as shares of the boss's height.
const PRICED_HEIGHTS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// The axis of a pin: where it passes through the cut, and the unit direction in which the pin
/// stands out.
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

/// The body that bosses are made for, and what its material costs.
pub(crate) struct BossMaker<'a> {
    request: &'a PlanRequest,
    /// The body with its voids filled.
    filled: &'a PinScene<'a>,
    /// The surface of the body as it is.
    air: Bvh,
    /// The surface of the filled body.
    outer: Bvh,
    price: &'a MaterialPrice,
}

impl<'a> BossMaker<'a> {
    /// A maker for a body as it is, and for the same body with its voids filled.
    pub(crate) fn new(
        hollow: &TriMesh,
        filled: &'a PinScene<'a>,
        price: &'a MaterialPrice,
    ) -> Self {
        let [air, outer] = [hollow, filled.material].map(|mesh| Bvh::new(mesh.iter_corners()));
        Self {
            request: filled.request,
            filled,
            air,
            outer,
            price,
        }
    }

    /// The outline of the filled body in a cut.
    pub(crate) fn outline(&self, cut: usize) -> Outline {
        let section = Section::of_mesh(self.filled.material, &self.filled.tree.planes[cut]);
        section.outline(&(0..section.rings.len()).collect::<Vec<_>>())
    }

    /// What the boss of a pin costs, to first order and up to a factor: the integral of the quadric
    /// over what it fills.
    pub(crate) fn price(&self, axis: &PinAxis, size: &Size) -> f64 {
        let PinAxis { middle, along } = axis;
        let MaterialPrice { quadric, frame } = self.price;
        let (u, v) = orthonormal_basis(along);
        let radius = size.room_mm(self.request) / 2.0;
        let [low, high] = self.ends_mm(size);
        let value = |height: f64, ring: f64, turn: f64| {
            let aside = (u * turn.cos() + v * turn.sin()) * (ring * radius);
            let p = middle + aside + along * (low + height * (high - low));
            let value = quadric.value(&frame.to_local(&p));
            if value > 0.0 && self.air.winding(&p) == 0 {
                value
            } else {
                0.0
            }
        };
        let rings = PRICED_RINGS.iter().flat_map(|&(ring, count)| {
            let turn = move |k: usize| TAU * (k as f64 + ASKEW) / count as f64;
            (0..count).map(move |k| (ring, turn(k)))
        });
        rings
            .flat_map(|(ring, turn)| PRICED_HEIGHTS.map(|height| value(height, ring, turn)))
            .sum()
    }

    /// From where to where along the pin its boss reaches, mm from the cut.
    fn ends_mm(&self, size: &Size) -> [f64; 2] {
        let wall = size.corner() + self.request.wall_mm + MARGIN_MM;
        let back = if size.dowel.is_some() {
            size.depth
        } else {
            size.chamfer
        };
        [-(wall + back), size.depth + wall]
    }

    /// The hull of discs about the pin's axis, and of others moved to the wall beside it wherever a
    /// gap too narrow to be cleaned would stay between.
    pub(crate) fn body(&self, joint: &Joint, axis: &PinAxis, size: &Size) -> Option<TriMesh> {
        let PinAxis { middle, along } = axis;
        let radius = size.room_mm(self.request) / 2.0 + MARGIN_MM;
        let ends = self.ends_mm(size).map(|height| middle + along * height);
        let ribs = ends.iter().filter_map(|end| self.rib(end, along, radius));
        let ribs = ribs.chain([self.root(joint, middle, radius)]);
        let centers: Vec<Point> = ends.iter().copied().chain(ribs).collect();
        let points: Vec<Point> = centers
            .iter()
            .flat_map(|center| disc(center, along, radius))
            .collect();
        Csg::convex_hull(&points).ok()?.to_mesh().ok()
    }

    /// A disc's middle moved in the cut until it touches the outside.
    fn root(&self, joint: &Joint, middle: &Point, radius: f64) -> Point {
        let plane = &self.filled.tree.planes[joint.cut];
        let chart = Chart::of_plane(plane);
        let at = chart.flat(middle);
        let outward = self.outline(joint.cut).nearest(&at) - at;
        chart.lift(
            plane,
            &(at + outward.normalize() * (outward.norm() - radius).max(0.0)),
        )
    }

    /// A disc's middle moved to the wall beside it, across its axis; none where the gap between
    /// them can be cleaned, or is none.
    fn rib(&self, end: &Point, along: &Vector, radius: f64) -> Option<Point> {
        let request = self.request;
        let outward = self.outer.closest(end, f64::INFINITY, &[])?.point - end;
        let gap = outward.norm() - radius;
        let across = (outward - along * along.dot(&outward)).try_normalize(0.0)?;
        (gap > 0.0 && gap < request.wall_mm + request.min_opening_mm).then(|| end + across * gap)
    }
}

/// The corners of a polygon about a disc.
fn disc(center: &Point, normal: &Vector, radius_mm: f64) -> Vec<Point> {
    let (u, v) = orthonormal_basis(normal);
    let corner_mm = radius_mm / (PI / SIDES as f64).cos();
    let corner = |side: usize| {
        let (sin, cos) = (TAU * (side as f64 + ASKEW) / SIDES as f64).sin_cos();
        center + (u * cos + v * sin) * corner_mm
    };
    (0..SIDES).map(corner).collect()
}
