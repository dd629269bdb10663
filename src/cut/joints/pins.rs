//! Places alignment pins: inside the material with the wall around them, far apart, and so that the
//! parts fit one way only.

use crate::{
    base::watch::Cancelled,
    cut::{
        error::{CutError, Obstacle},
        geometry::chart::Chart,
        ids::{CutId, PinId},
        joints::{
            face::{Face, face_points},
            hold::Rim,
            pattern::Peg,
            pin_shape::PinSite,
            pin_size::{short_pairs, size_pairs},
            placement::{Facing, PinScene, Placement, is_confused, peg},
        },
        pieces::split::Joint,
    },
    geom::Point,
};

/// Distance that an ordered pin's centre may lie from its cut, mm: numbers typed with three
/// decimals.
const ON_CUT_MM: f64 = 1e-3;

/// Source of a plan's pins.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Pins<'a> {
    /// The planner places pins in every joint.
    Placed,
    /// Exactly these.
    Ordered(&'a [PinSite]),
    /// These, and the planner's in every joint that has none of them.
    Around(&'a [PinSite]),
}

/// Returns the pins of every joint, in the order of the joints. Fails if an ordered pin lies on no
/// joint.
pub(crate) fn place_pins(
    scene: &PinScene,
    joints: &[Joint],
    pins: Pins,
) -> Result<Vec<Placement>, CutError> {
    let given = match pins {
        Pins::Placed => &[],
        Pins::Around(pins) => pins,
        Pins::Ordered(pins) => return seat_ordered(scene, joints, pins),
    };
    let mut placements = seat_ordered(scene, joints, given)?;
    for index in 0..joints.len() {
        if placements[index].sites.is_empty() {
            let placed: Vec<&Placement> = placements.iter().collect();
            placements[index] = place(scene, &joints[index], &placed)?;
        }
    }
    Ok(number_pins(placements, joints))
}

/// Numbers the pins through all joints and sets their cuts.
fn number_pins(mut placements: Vec<Placement>, joints: &[Joint]) -> Vec<Placement> {
    let pins = placements.iter_mut().zip(joints);
    let pins = pins
        .flat_map(|(placement, joint)| placement.sites.iter_mut().map(move |site| (site, joint)));
    for (count, (site, joint)) in pins.enumerate() {
        (site.id, site.cut) = (PinId::of(count), CutId::of(joint.cut));
    }
    placements
}

/// Places the pins of a joint. They keep off the pins in `placed`, those of the joints before it,
/// and must not be confused with their patterns.
///
/// Tries both directions, the normal's first; the one that aligns better wins.
fn place(scene: &PinScene, joint: &Joint, placed: &[&Placement]) -> Result<Placement, Cancelled> {
    let along = |is_upward: bool| {
        let facing = Facing {
            others: placed,
            is_upward,
        };
        place_along(scene, joint, facing)
    };
    let upward = along(true)?;
    if upward.is_sound() {
        return Ok(upward);
    }
    let downward = along(false)?;
    Ok(if downward.rank() > upward.rank() {
        downward
    } else {
        upward
    })
}

/// Assigns ordered pins to their joints and checks that they let the parts together one way only.
/// Fails if a pin lies on no joint.
pub(crate) fn seat_ordered(
    scene: &PinScene,
    joints: &[Joint],
    pins: &[PinSite],
) -> Result<Vec<Placement>, CutError> {
    let mut by_joint: Vec<Vec<&PinSite>> = joints.iter().map(|_| Vec::new()).collect();
    for pin in pins {
        let off_face = || Obstacle::PinOffFace {
            pin: pin.id.clone(),
        };
        let carries_pin = |joint: &Joint| {
            let plane = &scene.tree.planes[joint.cut];
            let center = Point::from(pin.center_mm);
            let at = Chart::of_plane(plane).flat(&center);
            pin.cut == CutId::of(joint.cut)
                && plane.distance(&center).abs() <= ON_CUT_MM
                && joint.faces.iter().any(|face| face.holds(&at))
        };
        let joint = joints.iter().position(carries_pin).ok_or_else(off_face)?;
        by_joint[joint].push(pin);
    }
    let mut placed: Vec<Placement> = Vec::new();
    for (joint, pins) in joints.iter().zip(by_joint) {
        scene.request.watch.check()?;
        let pegs: Vec<Peg> = pins
            .iter()
            .map(|pin| peg(&scene.tree.planes[joint.cut], pin))
            .collect();
        let is_one_way = pegs.len() >= 2 && !is_confused(&pegs, &placed.iter().collect::<Vec<_>>());
        let widest_mm = face_points(scene, joint).1;
        let sites: Vec<PinSite> = pins.into_iter().cloned().collect();
        placed.push(Placement {
            hold: Rim::of(joint, &scene.request.pins)
                .measure(&scene.tree.planes[joint.cut], &sites),
            sites,
            pegs,
            is_one_way,
            widest_mm,
        });
    }
    Ok(placed)
}

/// Places the pins of a joint in one direction.
pub(crate) fn place_along(
    scene: &PinScene,
    joint: &Joint,
    facing: Facing,
) -> Result<Placement, Cancelled> {
    let placed = facing.others;
    let face = Face::new(scene, joint, facing);
    let mut fallback = Placement {
        widest_mm: face.widest_mm,
        ..Placement::default()
    };
    for sizes in size_pairs(scene.request)
        .into_iter()
        .chain(short_pairs(scene.request))
    {
        scene.request.watch.check()?;
        let places = face.places(&sizes[0]);
        if places.is_empty() {
            continue;
        }
        let pattern = face.pattern(&places, &sizes, placed);
        let is_one_way = pattern.len() >= 2 && !is_confused(&face.end_views(&pattern), placed);
        let placement = face.placement(&pattern, is_one_way);
        if placement.rank() > fallback.rank() {
            fallback = placement;
        }
        if fallback.is_sound() {
            break;
        }
    }
    Ok(fallback)
}
