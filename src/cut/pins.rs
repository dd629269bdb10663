//! Where alignment pins go: inside the material with the wall around them, spread wide, and one way only.

use super::{
    error::CutError,
    pattern::{FORCE_TOLERANCE_MM, Peg, fits},
    pin_shape::PinSite,
    plan::cut_id,
    request::PlanRequest,
    section::{Chart, Point2},
    split::{Joint, Piece},
};
use crate::geom::{Bvh, Plane, Point, Vector, triangle::segment_segment_distance_squared};

/// Pin diameters that are tried, over the thinnest allowed, the stoutest first: a stout pin aligns better, a thin
/// one finds room in more places.
const DIAMETER_RATIOS: [f64; 4] = [3.0, 2.0, 1.5, 1.0];

/// About how many places are looked at in each joint: more find room in narrower joints, at a cost in
/// proportion.
const PLACES_PER_JOINT: f64 = 400.0;

/// Places nearer together than this tell nothing new, mm.
const MIN_PITCH_MM: f64 = 0.2;

/// How many pairs of places are tried for a pattern that fits one way only.
const TRIED_PAIRS: usize = 200;

/// Most pins in one joint: three settle a plane; more only add friction.
const MAX_PINS: usize = 3;

/// How far from its cut an ordered pin's middle may lie, mm: numbers typed with three decimals.
const ON_CUT_MM: f64 = 1e-3;

/// What a joint is asked to be fitted into.
pub(crate) struct PinScene<'a> {
    pub(crate) request: &'a PlanRequest,
    pub(crate) planes: &'a [Plane],
    pub(crate) pieces: &'a [Piece],
    /// The surface of the material before it is cut.
    pub(crate) material: &'a crate::mesh::TriMesh,
}

/// The pins of one joint.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placement {
    pub(crate) sites: Vec<PinSite>,
    pub(crate) pegs: Vec<Peg>,
    /// Whether only one way of putting the parts together fits.
    pub(crate) is_one_way: bool,
    /// The diameter of the largest disc of material in the joint, mm.
    pub(crate) widest_mm: f64,
}

/// A pin of some diameter with its socket, by the request's rules, mm.
#[derive(Debug, Clone, Copy)]
struct Size {
    diameter: f64,
    length: f64,
    chamfer: f64,
    socket_diameter: f64,
    depth: f64,
}

impl Size {
    fn new(request: &PlanRequest, diameter: f64) -> Self {
        let pins = &request.pins;
        let length = round_up(diameter * pins.length_ratio, request.layer_mm);
        // A chamfer of more than a quarter of the diameter would leave a point instead of a tip.
        let chamfer = pins.chamfer_mm.min(diameter / 4.0);
        let socket_diameter = round_up(diameter + 2.0 * pins.clearance_mm, request.hole_step_mm);
        let depth = round_up(length + pins.bottom_relief_mm, request.layer_mm);
        Self { diameter, length, chamfer, socket_diameter, depth }
    }

    fn corner(&self) -> f64 {
        PinSite::socket_corner_mm(self.socket_diameter)
    }
}

/// The diameter of the disc of material that the thinnest pin's socket needs, mm.
pub(crate) fn needed_room_mm(request: &PlanRequest) -> f64 {
    room_mm(request, &Size::new(request, round_up(request.pins.min_diameter_mm, request.pixel_mm)))
}

fn room_mm(request: &PlanRequest, size: &Size) -> f64 {
    2.0 * (size.corner() + size.chamfer + request.wall_mm)
}

/// The smallest multiple of `step` that is not below `value`; `value` itself when there is no step.
fn round_up(value: f64, step: f64) -> f64 {
    // A value that is a multiple already must not climb a step because of rounding.
    const SLACK: f64 = 1e-9;
    if step > 0.0 { (value / step - SLACK).ceil() * step } else { value }
}

/// The pins of a joint; `placed` are those of the joints before it, whose pins its own must keep off, and with whose patterns its
/// own must not be confused.
///
/// Both directions are tried, the normal's first; the one that aligns better wins.
pub(crate) fn place(scene: &PinScene, joint: &Joint, placed: &[Placement]) -> Placement {
    let upward = place_along(scene, joint, (placed, true));
    if upward.sites.len() >= 2 && upward.is_one_way {
        return upward;
    }
    let downward = place_along(scene, joint, (placed, false));
    let worth = |p: &Placement| (p.sites.len() >= 2 && p.is_one_way, p.sites.len());
    if worth(&downward) > worth(&upward) { downward } else { upward }
}

/// The ordered pins joint by joint, with whether they let the parts together one way only. A pin between no two cut faces is
/// refused.
pub(crate) fn seated(
    scene: &PinScene,
    joints: &[Joint],
    pins: &[PinSite],
) -> Result<Vec<Placement>, CutError> {
    let mut of_joint: Vec<Vec<&PinSite>> = joints.iter().map(|_| Vec::new()).collect();
    for pin in pins {
        let lost = || CutError::PinOffFace { pin: pin.id.clone() };
        let is_under = |joint: &Joint| {
            let plane = &scene.planes[joint.cut];
            let center = Point::from(pin.center_mm);
            let at = Chart::of_plane(plane).flat(&center);
            let caps = || joint.caps.iter().map(|&cap| &scene.pieces[joint.below].caps[cap]);
            pin.cut == cut_id(joint.cut)
                && plane.distance(&center).abs() <= ON_CUT_MM
                && caps().any(|cap| cap.holds(&at))
        };
        let joint = joints.iter().position(is_under).ok_or_else(lost)?;
        of_joint[joint].push(pin);
    }
    let mut placed: Vec<Placement> = Vec::new();
    for (joint, pins) in joints.iter().zip(of_joint) {
        let pegs: Vec<Peg> = pins.iter().map(|pin| peg(&scene.planes[joint.cut], pin)).collect();
        let is_one_way = pegs.len() >= 2 && !is_confused(&pegs, &placed);
        let widest_mm = face_points(scene, joint).1;
        placed.push(Placement { sites: pins.into_iter().cloned().collect(), pegs, is_one_way, widest_mm });
    }
    Ok(placed)
}

/// A pin's end view, looking along it: from below the plane left and right are swapped.
fn peg(plane: &Plane, pin: &PinSite) -> Peg {
    let sign = plane.normal.dot(&Vector::from(pin.direction)).signum();
    let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
    let at = Point2::new(at.x, at.y * sign);
    Peg { at, pin_mm: pin.diameter_mm, socket_mm: pin.socket_diameter_mm }
}

/// The pins of a joint that stand out upward, or downward.
fn place_along(scene: &PinScene, joint: &Joint, (placed, is_upward): (&[Placement], bool)) -> Placement {
    let face = Face::new(scene, joint, (placed, is_upward));
    let mut fallback = Placement { widest_mm: face.widest_mm, ..Placement::default() };
    for diameters in diameter_pairs(scene.request) {
        let sizes = diameters.map(|d| Size::new(scene.request, d));
        let places = face.places(&sizes[0]);
        if places.is_empty() {
            continue;
        }
        let pattern = face.pattern(&places, &sizes, placed);
        let is_one_way = pattern.len() >= 2 && !is_confused(&pegs(&pattern), placed);
        if is_one_way || pattern.len() > fallback.pegs.len() {
            fallback = face.placement(&pattern, is_one_way);
        }
        if is_one_way {
            break;
        }
    }
    fallback
}

/// Diameters of a joint's first pin and of the others, mm: different enough that a pin does not enter the
/// other's socket; last of all equal ones, for joints with room for nothing else.
fn diameter_pairs(request: &PlanRequest) -> Vec<[f64; 2]> {
    let pixel = request.pixel_mm;
    let least = round_up(request.pins.min_diameter_mm, pixel);
    let gaps = round_up(2.0 * request.pins.clearance_mm, request.hole_step_mm);
    let step = round_up(gaps + 2.0 * FORCE_TOLERANCE_MM, pixel);
    let mut stout: Vec<f64> = DIAMETER_RATIOS.iter().map(|ratio| round_up(ratio * least, pixel)).collect();
    stout.push(least + step);
    stout.retain(|&diameter| diameter >= least + step);
    stout.sort_by(|a, b| b.total_cmp(a));
    let mut pairs: Vec<[f64; 2]> = stout.into_iter().map(|diameter| [diameter, diameter - step]).collect();
    pairs.push([least, least]);
    pairs
}

fn pegs(pattern: &[(Point2, Size)]) -> Vec<Peg> {
    let peg =
        |&(at, size): &(Point2, Size)| Peg { at, pin_mm: size.diameter, socket_mm: size.socket_diameter };
    pattern.iter().map(peg).collect()
}

/// Whether the pattern fits itself in a second way, or another joint, or another joint fits it.
fn is_confused(pattern: &[Peg], placed: &[Placement]) -> bool {
    let apart = placed.iter().map(|placement| &placement.pegs).filter(|other| other.len() >= 2);
    fits(pattern, pattern) || apart.into_iter().any(|other| fits(pattern, other) || fits(other, pattern))
}

/// What a pin and its socket take up: all within a distance of a segment.
struct Taken {
    ends: [Point; 2],
    radius_mm: f64,
}

impl Taken {
    fn of(site: &PinSite) -> Self {
        let (center, along) = (Point::from(site.center_mm), Vector::from(site.direction));
        let root = center - along * PinSite::root_mm(site.diameter_mm);
        let radius_mm = PinSite::socket_corner_mm(site.socket_diameter_mm);
        Self { ends: [root, center + along * site.socket_depth_mm], radius_mm }
    }

    /// Whether a segment keeps `distance_mm` from it.
    fn is_clear_of(&self, segment: [&Point; 2], distance_mm: f64) -> bool {
        let apart_mm = segment_segment_distance_squared(self.ends.each_ref(), segment).sqrt();
        apart_mm >= self.radius_mm + distance_mm
    }
}

/// The meeting faces of a joint, seen along the pins.
struct Face<'a> {
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
    widest_mm: f64,
}

impl<'a> Face<'a> {
    fn new(scene: &'a PinScene<'a>, joint: &'a Joint, (placed, is_upward): (&[Placement], bool)) -> Self {
        let plane = scene.planes[joint.cut];
        let stoutest =
            DIAMETER_RATIOS[0] * round_up(scene.request.pins.min_diameter_mm, scene.request.pixel_mm);
        let size = Size::new(scene.request, stoutest);
        let reach = size.depth + size.corner() + scene.request.wall_mm;
        let near = |corners: &[Point; 3]| {
            let heights = corners.map(|p| plane.distance(&p));
            !(heights.iter().all(|&h| h > reach) || heights.iter().all(|&h| h < -reach))
        };
        let surface = Bvh::new(scene.material.iter_corners().filter(near));
        let (points, widest_mm) = face_points(scene, joint);
        let sign = if is_upward { 1.0 } else { -1.0 };
        let taken = placed.iter().flat_map(|placement| &placement.sites).map(Taken::of).collect();
        Self { scene, joint, plane, sign, surface, taken, points, widest_mm }
    }

    /// The points where a pin and socket of this size keep the wall.
    fn places(&self, size: &Size) -> Vec<Point2> {
        let room = room_mm(self.scene.request, size) / 2.0;
        let wide = self.points.iter().filter(|(_, distance)| *distance >= room);
        wide.map(|(p, _)| *p).filter(|p| self.has_meat(p, size)).collect()
    }

    /// Whether the socket at a point, with the wall around it, lies inside the material and clear of other cuts.
    fn has_meat(&self, p: &Point2, size: &Size) -> bool {
        let mouth = Chart::of_plane(&self.plane).lift(&self.plane, p);
        let along = self.plane.normal * self.sign;
        let bottom = mouth + along * size.depth;
        let root = mouth - along * PinSite::root_mm(size.diameter);
        let radius = size.corner() + self.scene.request.wall_mm;
        let others = (0..self.scene.planes.len()).filter(|&cut| cut != self.joint.cut);
        let is_clear = |cut: usize| {
            let [near, far] = [mouth, bottom].map(|end| self.scene.planes[cut].distance(&end));
            near.abs().min(far.abs()) >= radius && near * far > 0.0
        };
        others.into_iter().all(is_clear)
            && self.taken.iter().all(|taken| taken.is_clear_of([&root, &bottom], radius))
            && self.keeps_off([&mouth, &bottom], radius)
            && self.keeps_off([&mouth, &mouth], radius + size.chamfer)
    }

    /// Whether the whole surface of the material is at least `distance_mm` from the segment.
    fn keeps_off(&self, [from, to]: [&Point; 2], distance_mm: f64) -> bool {
        self.surface.segment_distance(from, to, distance_mm) >= distance_mm
    }

    /// Up to three places, the first with the first size: the farthest apart that fit one way only; else the
    /// farthest apart.
    fn pattern(&self, places: &[Point2], sizes: &[Size; 2], placed: &[Placement]) -> Vec<(Point2, Size)> {
        let gap = room_mm(self.scene.request, &sizes[0]) - self.scene.request.wall_mm;
        let pairs = farthest_pairs(places, gap);
        let two = |&(i, j): &(usize, usize)| vec![(places[i], sizes[0]), (places[j], sizes[1])];
        for pair in &pairs {
            let pattern = two(pair);
            let with_third =
                self.third(&pattern, places, gap).map(|p| [&pattern[..], &[(p, sizes[1])]].concat());
            for pattern in with_third.into_iter().chain([pattern]) {
                if !is_confused(&pegs(&pattern), placed) {
                    return pattern;
                }
            }
        }
        let alone = || places.first().map(|&p| vec![(p, sizes[0])]).unwrap_or_default();
        pairs.first().map_or_else(alone, two)
    }

    /// The place farthest from the nearer of two pins, if it keeps the gap from both.
    fn third(&self, pattern: &[(Point2, Size)], places: &[Point2], gap: f64) -> Option<Point2> {
        let off = |p: &Point2| pattern.iter().map(|(q, _)| (p - q).norm()).fold(f64::INFINITY, f64::min);
        let best = places.iter().copied().max_by(|p, q| off(p).total_cmp(&off(q)))?;
        (pattern.len() < MAX_PINS && off(&best) >= gap).then_some(best)
    }

    fn placement(&self, pattern: &[(Point2, Size)], is_one_way: bool) -> Placement {
        Placement {
            sites: pattern.iter().map(|(p, size)| self.site(p, size)).collect(),
            pegs: pegs(&pattern.iter().map(|&(p, size)| (self.seen_along(&p), size)).collect::<Vec<_>>()),
            is_one_way,
            widest_mm: self.widest_mm,
        }
    }

    /// The point as seen along the pins: looking the other way swaps left and right.
    fn seen_along(&self, p: &Point2) -> Point2 {
        Point2::new(p.x, p.y * self.sign)
    }

    fn site(&self, p: &Point2, size: &Size) -> PinSite {
        PinSite {
            id: String::new(),
            cut: String::new(),
            center_mm: Chart::of_plane(&self.plane).lift(&self.plane, p).into(),
            direction: (self.plane.normal * self.sign).into(),
            diameter_mm: size.diameter,
            length_mm: size.length,
            chamfer_mm: size.chamfer,
            socket_diameter_mm: size.socket_diameter,
            socket_depth_mm: size.depth,
            socket_chamfer_mm: size.chamfer,
        }
    }
}

/// Points spread over the joint's faces with their distances from the edge, and the faces' widest disc.
fn face_points(scene: &PinScene, joint: &Joint) -> (Vec<(Point2, f64)>, f64) {
    let (mut points, mut widest_mm) = (Vec::new(), 0.0f64);
    for cap in joint.caps.iter().map(|&cap| &scene.pieces[joint.below].caps[cap]) {
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
fn grid(cap: &super::split::Cap, pitch: f64) -> impl Iterator<Item = (Point2, f64)> + '_ {
    let (min, max) = cap.outline.bounds().unwrap_or_default();
    let count = |extent: f64| (extent / pitch).floor() as usize;
    let (columns, rows) = (count(max.x - min.x), count(max.y - min.y));
    let at = move |i: usize, j: usize| min + nalgebra::Vector2::new(i as f64 + 0.5, j as f64 + 0.5) * pitch;
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
