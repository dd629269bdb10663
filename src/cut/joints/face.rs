//! The contact faces of a joint, seen along its pins: finds places for pins and sockets that keep
//! the wall.

use crate::{
    cut::{
        geometry::chart::{Chart, Point2},
        ids::{CutId, PinId},
        joints::{
            hold::Rim,
            pattern::Peg,
            pin_shape::PinSite,
            pin_size::{Size, min_room_mm, reach_mm},
            placement::{Facing, PinScene, Placement, is_confused},
            rod::{Dowel, Rod},
        },
        pieces::split::{Cap, Joint},
    },
    geom::{Bvh, Plane, Point, Vector, triangle::segment_segment_distance_squared},
};

/// Approximate number of places examined per joint. More find room in narrower joints, at
/// proportional cost.
const PLACES_PER_JOINT: f64 = 400.0;

/// Smallest distance of two places, mm; closer ones add no information.
const MIN_PITCH_MM: f64 = 0.2;

/// Largest number of pairs tried for a pattern that fits one way only.
const MAX_PAIRS: usize = 200;

/// Largest number of pins per joint: three fix a plane, more only add friction.
const MAX_PINS: usize = 3;

/// Space occupied by a pin and its socket: all points within a distance of a segment.
pub(crate) struct OccupiedSpace {
    ends: [Point; 2],
    radius_mm: f64,
}

impl OccupiedSpace {
    pub(crate) fn of(site: &PinSite) -> Self {
        let (center, along) = (Point::from(site.center_mm), Vector::from(site.direction));
        let root = center - along * site.back_mm();
        let radius_mm = PinSite::socket_corner_mm(site.socket_diameter_mm);
        Self {
            ends: [root, center + along * site.socket_depth_mm],
            radius_mm,
        }
    }

    /// Returns true if a segment keeps `distance_mm` from it.
    pub(crate) fn is_clear_of(&self, segment: [&Point; 2], distance_mm: f64) -> bool {
        let axis_distance_mm =
            segment_segment_distance_squared(self.ends.each_ref(), segment).sqrt();
        axis_distance_mm >= self.radius_mm + distance_mm
    }
}

/// The contact faces of a joint, seen along the pins.
pub(crate) struct Face<'a> {
    scene: &'a PinScene<'a>,
    joint: &'a Joint,
    plane: Plane,
    /// +1 if pins protrude along the plane's normal, −1 if against it.
    sign: f64,
    surface: Bvh,
    /// Space occupied by the pins of other joints.
    occupied: Vec<OccupiedSpace>,
    /// The rim that the pins must hold.
    rim: Rim,
    /// Points of the faces, in the plane's own coordinates, with their distance from the edge, mm.
    points: Vec<(Point2, f64)>,
    pub(crate) widest_mm: f64,
}

impl<'a> Face<'a> {
    /// Returns the faces of a joint with candidate points for pins.
    pub(crate) fn new(scene: &'a PinScene<'a>, joint: &'a Joint, facing: Facing) -> Self {
        let (points, widest_mm) = face_points(scene, joint);
        Self {
            points,
            widest_mm,
            ..Self::without_points(scene, joint, facing)
        }
    }

    /// Returns the faces of a joint without candidate points.
    pub(crate) fn without_points(
        scene: &'a PinScene<'a>,
        joint: &'a Joint,
        facing: Facing,
    ) -> Self {
        let plane = scene.tree.planes[joint.cut];
        let reach = reach_mm(scene.request);
        let near = |corners: &[Point; 3]| {
            let heights = corners.map(|p| plane.distance(&p));
            !(heights.iter().all(|&h| h > reach) || heights.iter().all(|&h| h < -reach))
        };
        let surface = Bvh::new(scene.material.iter_corners().filter(near));
        let sign = if facing.is_upward { 1.0 } else { -1.0 };
        let occupied = facing
            .others
            .iter()
            .flat_map(|placement| &placement.sites)
            .map(OccupiedSpace::of)
            .collect();
        Self {
            scene,
            joint,
            plane,
            sign,
            surface,
            occupied,
            rim: Rim::of(joint, &scene.request.pins),
            points: Vec::new(),
            widest_mm: 0.0,
        }
    }

    /// Returns the unit direction in which pins protrude.
    pub(crate) fn along(&self) -> Vector {
        self.plane.normal * self.sign
    }

    /// Returns the points where a pin and socket of this size keep the wall.
    pub(crate) fn places(&self, size: &Size) -> Vec<Point2> {
        let room = size.room_mm(self.scene.request) / 2.0;
        let roomy = self.points.iter().filter(|(_, distance)| *distance >= room);
        roomy
            .map(|(p, _)| *p)
            .filter(|p| self.has_material(p, size))
            .collect()
    }

    /// Returns true if the socket at a point, with the wall around it, lies inside the material. It
    /// must also keep off other cuts and other pins.
    pub(crate) fn has_material(&self, p: &Point2, size: &Size) -> bool {
        let mouth = Chart::of_plane(&self.plane).lift(&self.plane, p);
        let along = self.along();
        let bottom = mouth + along * size.depth;
        let root = mouth - along * size.back_mm();
        let socket_start = if size.dowel.is_some() { root } else { mouth };
        let radius = size.corner() + self.scene.request.wall_mm;
        let tree = self.scene.tree;
        let others = (0..tree.planes.len()).filter(|&cut| cut != self.joint.cut);
        // Other cuts that act at either end, on either side of the joint.
        let acts_there = |cut: &usize| [root, bottom].iter().any(|end| tree.acts_at(*cut, end));
        let keeps_wall = |cut: usize| {
            let [near, far] = [socket_start, bottom].map(|end| tree.planes[cut].distance(&end));
            near.abs().min(far.abs()) >= radius && near * far > 0.0
        };
        others.filter(acts_there).all(keeps_wall)
            && self
                .occupied
                .iter()
                .all(|space| space.is_clear_of([&root, &bottom], radius))
            && self.surface_clears([&socket_start, &bottom], radius)
            && self.surface_clears([&mouth, &mouth], radius + size.chamfer)
    }

    /// Returns true if the whole surface of the material is at least `distance_mm` from the
    /// segment.
    fn surface_clears(&self, [from, to]: [&Point; 2], distance_mm: f64) -> bool {
        self.surface.segment_distance(from, to, distance_mm) >= distance_mm
    }

    /// Returns the least distance between the axes of two pins of this size, mm: their sockets
    /// leave a wall between them.
    pub(crate) fn gap_mm(&self, size: &Size) -> f64 {
        size.room_mm(self.scene.request) - self.scene.request.wall_mm
    }

    /// Returns true if a pattern holds the joint well enough.
    pub(crate) fn is_held_by(&self, pattern: &[(Point2, Size)]) -> bool {
        self.rim.is_held_by(pattern)
    }

    /// Chooses up to three places, the first with the first size. Takes the widest pattern that
    /// fits one way only and holds the joint. Else any that fits one way only, else the widest
    /// pair.
    pub(crate) fn pattern(
        &self,
        places: &[Point2],
        sizes: &[Size; 2],
        placed: &[&Placement],
    ) -> Vec<(Point2, Size)> {
        let gap = self.gap_mm(&sizes[0]);
        let pairs = farthest_pairs(places, gap);
        let two = |&(i, j): &(usize, usize)| vec![(places[i], sizes[0]), (places[j], sizes[1])];
        let mut loose = None;
        for pair in &pairs {
            let pattern = two(pair);
            let with_third = self
                .third(&pattern, places, gap)
                .map(|p| [&pattern[..], &[(p, sizes[1])]].concat());
            for pattern in with_third.into_iter().chain([pattern]) {
                let is_held = self.is_held_by(&pattern);
                let is_wanted = is_held || loose.is_none();
                if is_wanted && !is_confused(&self.end_views(&pattern), placed) {
                    if is_held {
                        return pattern;
                    }
                    loose = Some(pattern);
                }
            }
        }
        if let Some(pattern) = loose {
            return pattern;
        }
        let single = || {
            places
                .first()
                .map(|&p| vec![(p, sizes[0])])
                .unwrap_or_default()
        };
        pairs.first().map_or_else(single, two)
    }

    /// Returns the place farthest from the nearer of two pins. `None` if it is closer than the gap
    /// to one of them.
    fn third(&self, pattern: &[(Point2, Size)], places: &[Point2], gap: f64) -> Option<Point2> {
        let nearest_mm = |p: &Point2| {
            pattern
                .iter()
                .map(|(q, _)| (p - q).norm())
                .fold(f64::INFINITY, f64::min)
        };
        let best = places
            .iter()
            .copied()
            .max_by(|p, q| nearest_mm(p).total_cmp(&nearest_mm(q)))?;
        (pattern.len() < MAX_PINS && nearest_mm(&best) >= gap).then_some(best)
    }

    pub(crate) fn placement(&self, pattern: &[(Point2, Size)], is_one_way: bool) -> Placement {
        let sites: Vec<PinSite> = pattern.iter().map(|(p, size)| self.site(p, size)).collect();
        Placement {
            hold: self.rim.measure(&self.plane, &sites),
            sites,
            pegs: self.end_views(pattern),
            is_one_way,
            widest_mm: self.widest_mm,
        }
    }

    /// Returns the pattern as seen along the pins; looking the other way swaps left and right.
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

/// Returns points spread over the joint's faces with their distances from the edge, mm. The second
/// value is the diameter of the faces' largest disc, mm.
pub(crate) fn face_points(scene: &PinScene, joint: &Joint) -> (Vec<(Point2, f64)>, f64) {
    let (mut points, mut widest_mm) = (Vec::new(), 0.0f64);
    for cap in &joint.faces {
        if let Some(disc) = cap.outline.largest_disc(0.0) {
            widest_mm = widest_mm.max(2.0 * disc.radius_mm);
            points.push((disc.center, disc.radius_mm));
        }
        let needed = min_room_mm(scene.request) / 2.0;
        if widest_mm / 2.0 >= needed {
            let pitch = (cap.area_mm2 / PLACES_PER_JOINT).sqrt().max(MIN_PITCH_MM);
            points.extend(grid(cap, pitch).filter(|(_, distance)| *distance >= needed));
        }
    }
    (points, widest_mm)
}

/// Returns a square grid over a face's bounding box, with each point's distance from the edge.
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

/// Returns pairs of places at least `gap` apart, the farthest first, [`MAX_PAIRS`] at most.
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
    pairs.truncate(MAX_PAIRS);
    pairs.into_iter().map(|(_, i, j)| (i, j)).collect()
}
