//! The score of a plan: named terms, each from 0 (nothing to improve) to 1 (bad), weighted and
//! added.
//!
//! | term | measured | bad | weight |
//! |---|---|---|---|
//! | opening | narrowest opening, mm | nothing; good from three times the least | 1, weighed 0.3 |
//! | room for pins | largest disc in the tightest joint, mm | half of what pins need | 2, weighed 0.4 |
//! | smallest part | share of the volume | nothing; good from 2 % | 2 |
//! | parts | pieces beyond two | each | 0.3 |
//! | contact | distance of the cut from the contact point, mm | nothing; good from 3 mm | 1 |
//! | seam, looked at | length on the outside, weighted by what is seen | circle of average weight | 3 |
//! | slant, looked at | angle from level and upright in the object's frame | 15°, unless it follows the body | 0.6 |
//! | seam, else | length on the outside, mm | circle about the model | 0.5 |
//! | detail, else | turning of the seam beyond a convex one, rad | two turns more | 0.1 |
//! | glue | area of the smallest joint, mm² | nothing; good from four pins' discs | 0.3 |
//! | build volume | halves that do not fit it | each | 0.5 |
//! | overhang | share of the surface that overhangs by more than 45° | all | 0.3 |
//!
//! "Weighed" means: where seams are weighed against what stays solid.
//! If wide joints are wanted, voids in a joint count as filled and the disc as a quarter. Bad is
//! no room at all. Overhang is measured with the cut faces down or up, as the request prefers.
//!
//! The number of cuts comes before the score, and so does cleaning. Among the plans with the fewest
//! cuts, the planner takes the best-scored one with which every void is clean. This includes the
//! share of its wall in sight ([`crate::cut::access::void_access`]).

use crate::{
    cut::{
        geometry::{
            chart::Chart,
            section::{Ring, Section},
            sides::Sides,
        },
        joints::pin_size::min_room_mm,
        remark::Term,
        request::PosePreference,
    },
    geom::{Aabb, Plane, Point},
};

pub(crate) use crate::cut::planner::scene::Scene;

/// Openings wider than this many times the required one score no better.
pub(crate) const AMPLE_OPENING_RATIO: f64 = 3.0;
/// Width of a wide joint with its voids filled, as a multiple of the room a pin needs. Such a joint
/// has room for two bosses and an opening between them.
const WIDE_JOINT_RATIO: f64 = 4.0;
/// Share of the material above which a part is not too small.
const AMPLE_PART_RATIO: f64 = 0.02;
/// Distance from the contact point beyond which a cut does not disturb it, mm.
const AMPLE_CONTACT_MM: f64 = 3.0;

/// Weight of the narrowest opening. Washing out is the purpose of the cuts.
const OPENING_WEIGHT: f64 = 1.0;
/// Weight of the narrowest opening where seams are weighed, as what it leaves unclean is anyway.
const WEIGHED_OPENING_WEIGHT: f64 = 0.3;
/// Weight of a joint without room for pins. Parts that cannot be aligned spoil the balance.
const ROOM_WEIGHT: f64 = 2.0;
/// The same where seams are weighed against what stays solid: a boss or a jig aligns the joint.
/// With more, no neck is cut for want of a pin's room.
const WEIGHED_ROOM_WEIGHT: f64 = 0.4;
/// Weight of crumbs. They get lost or are glued wrongly.
const SMALL_PART_WEIGHT: f64 = 2.0;
/// Weight of a cut through the contact point. The tip wears along a seam.
const CONTACT_WEIGHT: f64 = 1.0;
/// Weight of a seam as dear as a circle about the model of average weight. A seam through a face
/// costs about a quarter of that, one in a neck less than a tenth. It outweighs a narrow opening.
const SEEN_SEAM_WEIGHT: f64 = 3.0;
/// Weight of a seam as long as the circle about the model. Seams are visible and cost glue.
const SEAM_WEIGHT: f64 = 0.5;
/// Weight of a seam over features such as ears and folds. Steps show there, and edges chip.
const DETAIL_WEIGHT: f64 = 0.1;
/// Weight of a joint without area to glue.
const GLUE_WEIGHT: f64 = 0.3;
/// Weight of each half that must be cut again to fit the printer.
const BUILD_VOLUME_WEIGHT: f64 = 0.5;
/// Weight of a surface that is all overhang. Support must be printed and removed, and leaves marks.
const OVERHANG_WEIGHT: f64 = 0.3;

/// Excess turning of a seam that runs over features everywhere, rad: two full turns.
const FULL_DETAIL_RAD: f64 = 2.0 * std::f64::consts::TAU;
/// Area of a joint with enough to glue, as a multiple of the disc that a pin needs.
const AMPLE_GLUE_DISCS: f64 = 4.0;
/// Cosine between the normal and the vertical above which a downward surface is overhang: 45°, the
/// usual limit.
const OVERHANG_COSINE: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Estimates the weighted terms of a plane's seam, without cutting anything; 0 if nobody looks at
/// it. Takes some microseconds.
pub(crate) fn estimate_seam_penalty(scene: &Scene, plane: &Plane) -> f64 {
    SEEN_SEAM_WEIGHT * scene.estimate_seam_price(plane)
}

/// The effect of a cut on the body, apart from the voids it opens.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Burden {
    /// Length of the seam on the outside, mm.
    pub(crate) seam_mm: f64,
    /// What is seen of the seam, in circles about the model of average weight; `None` if nobody
    /// looked.
    pub(crate) seen_ratio: Option<f64>,
    /// Price of its slant in the object's frame, in the same unit; 0 if nobody looked.
    pub(crate) slant_price: f64,
    /// Diameter of the largest disc of material in the tightest joint, mm: at most what pins need,
    /// and 0 below half of that. If wide joints are wanted, a quarter of the diameter with the
    /// voids in the joint filled.
    pub(crate) room_mm: f64,
    /// Number of pieces beyond two.
    pub(crate) extra_parts: usize,
    /// Volume of the smallest piece over that of the body.
    pub(crate) smallest_ratio: f64,
    /// Distance of the cut from the contact point, mm.
    pub(crate) contact_mm: f64,
    /// Turning of the seam beyond that of a convex one, rad.
    pub(crate) detail_rad: f64,
    /// Least area of material in a joint, mm².
    pub(crate) glue_mm2: f64,
    /// Number of halves that do not fit the build volume.
    pub(crate) oversize: usize,
    /// Share of the surface that overhangs when both halves lie in the preferred pose.
    pub(crate) overhang_ratio: f64,
}

/// Measures the effect of a plane on the body. Pieces that stay joined to another, because nothing
/// opens between them, do not count. Takes two passes over the triangles.
pub(crate) fn burden(scene: &Scene, plane: &Plane) -> Burden {
    let sides = Sides::new(
        &scene.material,
        *plane,
        Section::of_mesh(&scene.material, plane),
    );
    let first_void_vertex = scene.hollowed.outer.mesh().vertices().len();
    let joints = joints(&sides, first_void_vertex);
    let needed: Vec<&Joint> = joints
        .iter()
        .filter(|joint| !is_needless(joint, &joints))
        .collect();
    let is_part = |piece: u32| needed.iter().any(|joint| joint.pieces.contains(&piece));
    let volumes = sides
        .piece_volumes_mm3()
        .into_iter()
        .filter(|&(piece, _)| is_part(piece));
    let volumes: Vec<f64> = volumes
        .map(|(_, volume)| volume / scene.volume_mm3)
        .collect();
    let groups = || needed.iter().flat_map(|joint| &joint.groups);
    let needed_mm = min_room_mm(scene.request);
    let disc_mm = |&group: &usize| {
        if scene.request.wants_wide_joints {
            let is_outside = |ring: &Ring| (ring.above as usize) < first_void_vertex;
            sides.filled_disc_diameter_mm(group, is_outside) / WIDE_JOINT_RATIO
        } else {
            sides.disc_diameter_mm(group, needed_mm / 2.0)
        }
    };
    let room_mm = |joint: &&Joint| joint.groups.iter().map(disc_mm).fold(0.0, f64::max);
    Burden {
        seam_mm: groups()
            .map(|&group| sides.section.rings[sides.polygons[group][0]].length_mm())
            .sum(),
        seen_ratio: seen_ratio(scene, &sides, groups().copied()),
        slant_price: scene
            .request
            .seams
            .skin
            .as_ref()
            .map_or(0.0, |skin| skin.slant_price(plane)),
        extra_parts: volumes.len().saturating_sub(2),
        room_mm: needed.iter().map(room_mm).fold(needed_mm, f64::min),
        smallest_ratio: volumes.into_iter().fold(1.0, f64::min),
        contact_mm: plane.distance(&scene.request.axis.point).abs(),
        detail_rad: groups()
            .map(|&group| excess_turn_rad(&sides.section.rings[sides.polygons[group][0]]))
            .sum(),
        glue_mm2: needed
            .iter()
            .map(|joint| glue_mm2(&sides, joint))
            .fold(f64::INFINITY, f64::min),
        oversize: scene
            .request
            .build_volume_mm
            .map_or(0, |room_mm| oversize(scene, plane, room_mm)),
        overhang_ratio: overhang_ratio(scene, plane),
    }
}

/// Returns what is seen of the outlines of some polygons of a section; `None` if nobody looked.
fn seen_ratio(scene: &Scene, sides: &Sides, groups: impl Iterator<Item = usize>) -> Option<f64> {
    let skin = scene.request.seams.skin.as_ref()?;
    let (plane, chart) = (sides.plane(), Chart::of_plane(sides.plane()));
    let outlines = groups.map(|group| &sides.section.rings[sides.polygons[group][0]]);
    let segments = outlines.flat_map(Ring::segments);
    let lifted = segments.map(|ends| ends.map(|end| chart.lift(plane, &end)));
    Some(skin.price_ratio(plane, lifted))
}

/// Returns the area of material in a joint, mm².
fn glue_mm2(sides: &Sides, joint: &Joint) -> f64 {
    let rings = joint
        .groups
        .iter()
        .flat_map(|&group| &sides.polygons[group]);
    rings
        .map(|&ring| sides.section.rings[ring].area_mm2())
        .sum()
}

/// Returns the turning of a ring beyond that of a convex one, rad; 0 for a convex ring, however
/// finely it is divided.
fn excess_turn_rad(ring: &Ring) -> f64 {
    let sides: Vec<_> = ring
        .segments()
        .map(|[a, b]| b - a)
        .filter(|side| side.norm() > 0.0)
        .collect();
    let next = sides.iter().cycle().skip(1);
    let turn: f64 = sides
        .iter()
        .zip(next)
        .map(|(a, b)| a.perp(b).atan2(a.dot(b)).abs())
        .sum();
    (turn - std::f64::consts::TAU).max(0.0)
}

/// Counts the halves that are larger than the build volume, comparing sorted side lengths.
fn oversize(scene: &Scene, plane: &Plane, mut room_mm: [f64; 3]) -> usize {
    let mut halves = [Aabb::EMPTY; 2];
    for corners in scene.hollowed.outer.mesh().iter_corners() {
        for i in 0..3 {
            grow_halves(&mut halves, plane, [corners[i], corners[(i + 1) % 3]]);
        }
    }
    room_mm.sort_by(f64::total_cmp);
    let is_over = |half: &Aabb| {
        let mut size: [f64; 3] = if half.is_empty() {
            [0.0; 3]
        } else {
            half.size().into()
        };
        size.sort_by(f64::total_cmp);
        size.iter().zip(room_mm).any(|(size, room)| *size > room)
    };
    halves.iter().filter(|half| is_over(half)).count()
}

/// Grows the boxes of the halves above and below a plane, in the plane's coordinates, to include an
/// edge.
fn grow_halves(halves: &mut [Aabb; 2], plane: &Plane, [from, to]: [Point; 2]) {
    let (u, v) = plane.basis();
    let [low, high] = [plane.distance(&from), plane.distance(&to)];
    let in_plane_frame =
        |p: &Point, height: f64| Point::new(u.dot(&p.coords), v.dot(&p.coords), height);
    let side = usize::from(low < 0.0);
    halves[side] = halves[side].grown_over(&in_plane_frame(&from, low));
    if (low < 0.0) != (high < 0.0) {
        let crossing = in_plane_frame(&(from + (to - from) * (low / (low - high))), 0.0);
        *halves = halves.map(|half| half.grown_over(&crossing));
    }
}

/// Returns the share of the material's surface that overhangs by more than 45°. Both halves lie on
/// their cut faces, or with these up if hollows should open upwards.
fn overhang_ratio(scene: &Scene, plane: &Plane) -> f64 {
    let down = match scene.request.pose {
        PosePreference::OpenHollowUp => 1.0,
        _ => -1.0,
    };
    let (mut over, mut all) = (0.0, 0.0);
    for [a, b, c] in scene.material.iter_corners() {
        let normal = (b - a).cross(&(c - a));
        let is_above = plane.distance(&a) + plane.distance(&b) + plane.distance(&c) >= 0.0;
        let toward_plate = plane.normal.dot(&normal) * if is_above { down } else { -down };
        all += normal.norm();
        over += if toward_plate > OVERHANG_COSINE * normal.norm() {
            normal.norm()
        } else {
            0.0
        };
    }
    if all > 0.0 { over / all } else { 0.0 }
}

/// Two pieces and the polygons of the section between them.
struct Joint {
    pieces: [u32; 2],
    groups: Vec<usize>,
    /// True if a void opens in one of the polygons.
    is_open: bool,
}

/// Returns the joints of the section. Vertices of the material from `first_void_vertex` on belong
/// to voids.
fn joints(sides: &Sides, first_void_vertex: usize) -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    for (group, rings) in sides.polygons.iter().enumerate() {
        let is_mouth =
            |&ring: &usize| sides.section.rings[ring].above as usize >= first_void_vertex;
        let (pieces, is_open) = (sides.neighbours(group), rings.iter().any(is_mouth));
        match joints.iter_mut().find(|joint| joint.pieces == pieces) {
            Some(joint) => {
                joint.groups.push(group);
                joint.is_open |= is_open;
            }
            None => joints.push(Joint {
                pieces,
                groups: vec![group],
                is_open,
            }),
        }
    }
    joints
}

/// Returns true if nothing opens in the joint and it is the only joint of one of its pieces.
fn is_needless(joint: &Joint, joints: &[Joint]) -> bool {
    let count = |piece: &u32| {
        joints
            .iter()
            .filter(|other| other.pieces.contains(piece))
            .count()
    };
    !joint.is_open && joint.pieces.iter().any(|piece| count(piece) == 1)
}

impl Burden {
    /// Returns the sum of the weighted terms of one cut, 0 at best.
    pub(crate) fn penalty(&self, scene: &Scene) -> f64 {
        self.terms(scene).iter().map(|(_, value)| value).sum()
    }

    /// Returns the weighted terms of one cut with their names, each 0 at best.
    pub(crate) fn terms(&self, scene: &Scene) -> [(Term, f64); 10] {
        let needed_mm = min_room_mm(scene.request);
        let ample_glue_mm2 = AMPLE_GLUE_DISCS * std::f64::consts::FRAC_PI_4 * needed_mm * needed_mm;
        let circle_mm = std::f64::consts::PI * scene.diagonal_mm;
        let ample_part_ratio = AMPLE_PART_RATIO.max(scene.request.least_part.mass_ratio());
        let room_weight = if scene.request.seams.are_weighed() {
            WEIGHED_ROOM_WEIGHT
        } else {
            ROOM_WEIGHT
        };
        let (seam, detail) = match self.seen_ratio {
            Some(seen_ratio) => (SEEN_SEAM_WEIGHT * seen_ratio, 0.0),
            None => (
                SEAM_WEIGHT * self.seam_mm / circle_mm,
                DETAIL_WEIGHT * (self.detail_rad / FULL_DETAIL_RAD).min(1.0),
            ),
        };
        [
            (
                Term::RoomForPins,
                room_weight * shortfall(self.room_mm, needed_mm),
            ),
            (
                Term::SmallestPart,
                SMALL_PART_WEIGHT * shortfall(self.smallest_ratio, ample_part_ratio),
            ),
            (
                Term::Parts,
                scene.request.part_weight * self.extra_parts as f64,
            ),
            (
                Term::Contact,
                CONTACT_WEIGHT * shortfall(self.contact_mm, AMPLE_CONTACT_MM),
            ),
            (Term::Seam, seam),
            (Term::Detail, detail),
            (Term::Slant, SEEN_SEAM_WEIGHT * self.slant_price),
            (
                Term::Glue,
                GLUE_WEIGHT * shortfall(self.glue_mm2, ample_glue_mm2),
            ),
            (
                Term::BuildVolume,
                BUILD_VOLUME_WEIGHT * self.oversize as f64,
            ),
            (Term::Overhang, OVERHANG_WEIGHT * self.overhang_ratio),
        ]
    }
}

/// Returns the weighted term of the narrowest of the voids' openings (mm), 0 at best.
pub(crate) fn opening_penalty(scene: &Scene, openings_mm: impl Iterator<Item = f64>) -> f64 {
    let ample_mm = AMPLE_OPENING_RATIO * scene.request.min_opening_mm;
    let weight = if scene.request.seams.are_weighed() {
        WEIGHED_OPENING_WEIGHT
    } else {
        OPENING_WEIGHT
    };
    weight
        * openings_mm
            .map(|mm| shortfall(mm, ample_mm))
            .fold(0.0, f64::max)
}

/// Returns the relative shortfall of `value` against `ample`: 0 for none, 1 if `value` is 0.
pub(crate) fn shortfall(value: f64, ample: f64) -> f64 {
    (1.0 - value / ample).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            Hollowed, PlanRequest,
            scenes::{ball, cuboid, request, with_balls},
        },
        geom::Vector,
    };

    fn level(z: f64) -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: z,
        }
    }

    fn burden_of(hollowed: &Hollowed, request: &PlanRequest, z: f64) -> Burden {
        burden(&Scene::new(hollowed, request).unwrap(), &level(z))
    }

    #[test]
    fn a_convex_seam_has_no_detail_and_one_over_a_notch_has() {
        let plain = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
        assert!(burden_of(&plain, &request(), 0.1).detail_rad < 1e-9);
        let corners = [
            [0.0, 0.0],
            [10.0, 0.0],
            [10.0, 10.0],
            [5.0, 5.0],
            [0.0, 10.0],
        ];
        let points = corners.map(|[x, y]| crate::cut::Point2::new(x, y)).to_vec();
        // The notch turns one corner back by a quarter, and the others turn by as much more.
        let turn = excess_turn_rad(&Ring {
            points,
            above: 0,
            below: 0,
        });
        assert!((turn - std::f64::consts::PI).abs() < 1e-9, "{turn}");
    }

    #[test]
    fn wide_joints_need_a_wide_outline_however_thin_the_wall() {
        let usual = request();
        let wide = PlanRequest {
            wants_wide_joints: true,
            ..request()
        };
        let shell = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 24.0]]);
        let needed_mm = min_room_mm(&usual);
        assert_eq!(burden_of(&shell, &usual, 0.1).room_mm, 0.0);
        assert_eq!(burden_of(&shell, &wide, 0.1).room_mm, needed_mm);
        // The section of a slab is long, but no disc wider than 8 mm fits in it.
        let slab = with_balls(
            cuboid([0.0; 3], [8.0, 40.0, 60.0]),
            &[[4.0, 20.0, 30.0, 2.0]],
        );
        assert_eq!(burden_of(&slab, &usual, 30.1).room_mm, needed_mm);
        assert!((burden_of(&slab, &wide, 30.1).room_mm - 2.0).abs() < 0.05);
    }

    #[test]
    fn the_glue_of_a_box_is_its_section_less_the_void() {
        let body = with_balls(
            cuboid([0.0; 3], [30.0, 20.0, 20.0]),
            &[[15.0, 10.0, 10.0, 4.0]],
        );
        let burden = burden_of(&body, &request(), 10.0);
        let hole = 12.0 * 16.0 * (std::f64::consts::PI / 12.0).sin();
        assert!(
            (burden.glue_mm2 - (600.0 - hole)).abs() < 1e-6,
            "{}",
            burden.glue_mm2
        );
    }

    #[test]
    fn a_half_too_long_for_the_printer_counts() {
        let body = with_balls(
            cuboid([0.0; 3], [30.0, 20.0, 90.0]),
            &[[15.0, 10.0, 45.0, 6.0]],
        );
        let within = |room: f64| PlanRequest {
            build_volume_mm: Some([room; 3]),
            ..request()
        };
        assert_eq!(burden_of(&body, &within(50.0), 45.1).oversize, 0);
        assert_eq!(burden_of(&body, &within(50.0), 20.0).oversize, 1);
        assert_eq!(burden_of(&body, &within(29.0), 45.1).oversize, 2);
    }

    #[test]
    fn half_a_ball_on_its_cut_face_overhangs_only_in_its_void() {
        // The outside looks up everywhere. In the void's half, the ceiling within 45° of its pole
        // overhangs: 1 − cos 45° of a half sphere.
        let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 12.0]]);
        let share = 144.0 / (625.0 + 144.0) * (1.0 - OVERHANG_COSINE);
        let down = burden_of(&body, &request(), 0.1).overhang_ratio;
        // The ball has 12 rows of facets. 45° lies in the middle of the third, so one row more or
        // less may count.
        assert!((down - share).abs() < 0.35 * share, "{down} {share}");
        let up = PlanRequest {
            pose: PosePreference::OpenHollowUp,
            ..request()
        };
        assert!(burden_of(&body, &up, 0.1).overhang_ratio > 3.0 * share);
    }
}
