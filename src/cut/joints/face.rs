//! The meeting faces of a joint, seen along its pins: where in them a pin and its socket keep the
//! wall.

use crate::{
    cut::{
        geometry::chart::{Chart, Point2},
        ids::{CutId, PinId},
        joints::{
            pattern::Peg,
            pin_shape::PinSite,
            pin_size::{Size, needed_room_mm, reach_mm},
            placement::{Facing, PinScene, Placement, is_confused},
            rod::{Dowel, Rod},
        },
        pieces::split::{Cap, Joint},
    },
    geom::{Bvh, Plane, Point, Vector, triangle::segment_segment_distance_squared},
};

/// About how many places are looked at in each joint: more find room in narrower joints, at a cost
/// in proportion.
const PLACES_PER_JOINT: f64 = 400.0;

/// Places nearer together than this tell nothing new, mm.
const MIN_PITCH_MM: f64 = 0.2;

/// How many pairs of places are tried for a pattern that fits one way only.
const TRIED_PAIRS: usize = 200;

/// Most pins in one joint: three settle a plane; more only add friction.
const MAX_PINS: usize = 3;

/// What a pin and its socket take up: all within a distance of a segment.
pub(crate) struct Taken {
    ends: [Point; 2],
    radius_mm: f64,
}

impl Taken {
    pub(crate) fn of(site: &PinSite) -> Self {
        let (center, along) = (Point::from(site.center_mm), Vector::from(site.direction));
        let root = center - along * site.back_mm();
        let radius_mm = PinSite::socket_corner_mm(site.socket_diameter_mm);
        Self {
            ends: [root, center + along * site.socket_depth_mm],
            radius_mm,
        }
    }

    /// Whether a segment keeps `distance_mm` from it.
    pub(crate) fn is_clear_of(&self, segment: [&Point; 2], distance_mm: f64) -> bool {
        let apart_mm = segment_segment_distance_squared(self.ends.each_ref(), segment).sqrt();
        apart_mm >= self.radius_mm + distance_mm
    }
}

/// The meeting faces of a joint, seen along the pins.
pub(crate) struct Face<'a> {
    scene: &'a PinScene<'a>,
    joint: &'a Joint,
    plane: Plane,
    /// +1 when pins stand out along the plane's normal, −1 against it.
    sign: f64,
    surface: Bvh,
    /// What the pins of other joints take up.
    taken: Vec<Taken>,
    /// Points of the faces, in the plane's own coordinates, with their distance from the edge.
    points: Vec<(Point2, f64)>,
    pub(crate) widest_mm: f64,
}

impl<'a> Face<'a> {
    /// The faces of a joint, looked at where the pins of others leave room.
    pub(crate) fn new(scene: &'a PinScene<'a>, joint: &'a Joint, facing: Facing) -> Self {
        let (points, widest_mm) = face_points(scene, joint);
        Self {
            points,
            widest_mm,
            ..Self::bare(scene, joint, facing)
        }
    }

    /// The faces without points to look at.
    pub(crate) fn bare(scene: &'a PinScene<'a>, joint: &'a Joint, facing: Facing) -> Self {
        let plane = scene.tree.planes[joint.cut];
        let reach = reach_mm(scene.request);
        let near = |corners: &[Point; 3]| {
            let heights = corners.map(|p| plane.distance(&p));
            !(heights.iter().all(|&h| h > reach) || heights.iter().all(|&h| h < -reach))
        };
        let surface = Bvh::new(scene.material.iter_corners().filter(near));
        let sign = if facing.is_upward { 1.0 } else { -1.0 };
        let taken = facing
            .others
            .iter()
            .flat_map(|placement| &placement.sites)
            .map(Taken::of)
            .collect();
        Self {
            scene,
            joint,
            plane,
            sign,
            surface,
            taken,
            points: Vec::new(),
            widest_mm: 0.0,
        }
    }

    /// The unit direction in which pins stand out.
    pub(crate) fn along(&self) -> Vector {
        self.plane.normal * self.sign
    }

    /// The points where a pin and socket of this size keep the wall.
    pub(crate) fn places(&self, size: &Size) -> Vec<Point2> {
        let room = size.room_mm(self.scene.request) / 2.0;
        let wide = self.points.iter().filter(|(_, distance)| *distance >= room);
        wide.map(|(p, _)| *p)
            .filter(|p| self.has_meat(p, size))
            .collect()
    }

    /// Whether the socket at a point, with the wall around it, lies inside the material and clear
    /// of other cuts.
    pub(crate) fn has_meat(&self, p: &Point2, size: &Size) -> bool {
        let mouth = Chart::of_plane(&self.plane).lift(&self.plane, p);
        let along = self.along();
        let bottom = mouth + along * size.depth;
        let root = mouth - along * size.back_mm();
        let hollow = if size.dowel.is_some() { root } else { mouth };
        let radius = size.corner() + self.scene.request.wall_mm;
        let tree = self.scene.tree;
        let others = (0..tree.planes.len()).filter(|&cut| cut != self.joint.cut);
        // On either side of the joint.
        let is_made = |cut: &usize| [root, bottom].iter().any(|end| tree.acts_at(*cut, end));
        let is_clear = |cut: usize| {
            let [near, far] = [hollow, bottom].map(|end| tree.planes[cut].distance(&end));
            near.abs().min(far.abs()) >= radius && near * far > 0.0
        };
        others.filter(is_made).all(is_clear)
            && self
                .taken
                .iter()
                .all(|taken| taken.is_clear_of([&root, &bottom], radius))
            && self.keeps_off([&hollow, &bottom], radius)
            && self.keeps_off([&mouth, &mouth], radius + size.chamfer)
    }

    /// Whether the whole surface of the material is at least `distance_mm` from the segment.
    fn keeps_off(&self, [from, to]: [&Point; 2], distance_mm: f64) -> bool {
        self.surface.segment_distance(from, to, distance_mm) >= distance_mm
    }

    /// How far apart the axes of pins of this size must be, so that their sockets leave a wall
    /// between them, mm.
    pub(crate) fn gap_mm(&self, size: &Size) -> f64 {
        size.room_mm(self.scene.request) - self.scene.request.wall_mm
    }

    /// Up to three places, the first with the first size: the farthest apart that fit one way only;
    /// else the farthest apart.
    pub(crate) fn pattern(
        &self,
        places: &[Point2],
        sizes: &[Size; 2],
        placed: &[&Placement],
    ) -> Vec<(Point2, Size)> {
        let gap = self.gap_mm(&sizes[0]);
        let pairs = farthest_pairs(places, gap);
        let two = |&(i, j): &(usize, usize)| vec![(places[i], sizes[0]), (places[j], sizes[1])];
        for pair in &pairs {
            let pattern = two(pair);
            let with_third = self
                .third(&pattern, places, gap)
                .map(|p| [&pattern[..], &[(p, sizes[1])]].concat());
            for pattern in with_third.into_iter().chain([pattern]) {
                if !is_confused(&self.end_views(&pattern), placed) {
                    return pattern;
                }
            }
        }
        let alone = || {
            places
                .first()
                .map(|&p| vec![(p, sizes[0])])
                .unwrap_or_default()
        };
        pairs.first().map_or_else(alone, two)
    }

    /// The place farthest from the nearer of two pins, if it keeps the gap from both.
    fn third(&self, pattern: &[(Point2, Size)], places: &[Point2], gap: f64) -> Option<Point2> {
        let off = |p: &Point2| {
            pattern
                .iter()
                .map(|(q, _)| (p - q).norm())
                .fold(f64::INFINITY, f64::min)
        };
        let best = places
            .iter()
            .copied()
            .max_by(|p, q| off(p).total_cmp(&off(q)))?;
        (pattern.len() < MAX_PINS && off(&best) >= gap).then_some(best)
    }

    pub(crate) fn placement(&self, pattern: &[(Point2, Size)], is_one_way: bool) -> Placement {
        Placement {
            sites: pattern.iter().map(|(p, size)| self.site(p, size)).collect(),
            pegs: self.end_views(pattern),
            is_one_way,
            widest_mm: self.widest_mm,
        }
    }

    /// The pattern as seen along the pins: looking the other way swaps left and right.
    pub(crate) fn end_views(&self, pattern: &[(Point2, Size)]) -> Vec<Peg> {
        let view = |&(p, size): &(Point2, Size)| Peg {
            at: Point2::new(p.x, p.y * self.sign),
            pin_mm: size.diameter,
            socket_mm: size.socket_diameter,
        };
        pattern.iter().map(view).collect()
    }

    fn dowel(&self, rod: usize, length_mm: f64) -> Dowel {
        let Rod {
            id, density_g_cm3, ..
        } = &self.scene.request.rods[rod];
        Dowel {
            rod: id.clone(),
            length_mm,
            density_g_cm3: *density_g_cm3,
        }
    }

    fn site(&self, p: &Point2, size: &Size) -> PinSite {
        PinSite {
            id: PinId::default(),
            cut: CutId::default(),
            center_mm: Chart::of_plane(&self.plane).lift(&self.plane, p).into(),
            direction: self.along().into(),
            diameter_mm: size.diameter,
            length_mm: size.length,
            chamfer_mm: if size.dowel.is_some() {
                0.0
            } else {
                size.chamfer
            },
            socket_diameter_mm: size.socket_diameter,
            socket_depth_mm: size.depth,
            socket_chamfer_mm: size.chamfer,
            dowel: size
                .dowel
                .map(|(rod, length_mm)| self.dowel(rod, length_mm)),
        }
    }
}

/// Points spread over the joint's faces with their distances from the edge, and the faces' widest
/// disc.
pub(crate) fn face_points(scene: &PinScene, joint: &Joint) -> (Vec<(Point2, f64)>, f64) {
    let (mut points, mut widest_mm) = (Vec::new(), 0.0f64);
    for cap in &joint.faces {
        if let Some(disc) = cap.outline.largest_disc(0.0) {
            widest_mm = widest_mm.max(2.0 * disc.radius_mm);
            points.push((disc.center, disc.radius_mm));
        }
        let needed = needed_room_mm(scene.request) / 2.0;
        if widest_mm / 2.0 >= needed {
            let pitch = (cap.area_mm2 / PLACES_PER_JOINT).sqrt().max(MIN_PITCH_MM);
            points.extend(grid(cap, pitch).filter(|(_, distance)| *distance >= needed));
        }
    }
    (points, widest_mm)
}

/// A square grid over a face's bounding box, with each point's distance from the edge.
fn grid(cap: &Cap, pitch: f64) -> impl Iterator<Item = (Point2, f64)> + '_ {
    let (min, max) = cap.outline.bounds().unwrap_or_default();
    let count = |extent: f64| (extent / pitch).floor() as usize;
    let (columns, rows) = (count(max.x - min.x), count(max.y - min.y));
    let at = move |i: usize, j: usize| {
        min + nalgebra::Vector2::new(i as f64 + 0.5, j as f64 + 0.5) * pitch
    };
    let points = (0..columns).flat_map(move |i| (0..rows).map(move |j| at(i, j)));
    points.map(|p| (p, cap.outline.signed_distance(&p)))
}

/// Pairs of places at least `gap` apart, the farthest first, [`TRIED_PAIRS`] at most.
fn farthest_pairs(places: &[Point2], gap: f64) -> Vec<(usize, usize)> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for i in 0..places.len() {
        for j in i + 1..places.len() {
            let distance = (places[i] - places[j]).norm();
            if distance >= gap {
                pairs.push((distance, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    pairs.truncate(TRIED_PAIRS);
    pairs.into_iter().map(|(_, i, j)| (i, j)).collect()
}
