//! The checks of several telescopes on junctures: of every kind the worst of all telescopes.

use super::checks::{
    BOX_LIMIT_MM, CENTRE_LIMIT_MM, MASS_LIMIT_RATIO, PLACEMENT_LIMIT_MM, TOPPLING_LIMIT_DEG,
    WALL_LIMIT_MM, none, pose_checks, surface_checks, telescope_checks,
};
use super::divided::DividedFacts;
use super::facts::GROUND_LIMIT_MM;
use super::network::NetworkPromise;
use super::network_facts::NetworkFacts;
use super::network_model::ModelFacts;
use super::surfaces::Surfaces;
use crate::geom::Point;
use crate::verify::checks::no_faults;
use crate::verify::peg_checks::peg_checks;
use crate::verify::{Check, CheckKind, Limit, VOLUME_SUM_LIMIT_RATIO};

/// The checks that are made of the whole, and not of each telescope.
const OF_THE_WHOLE: [CheckKind; 6] = [
    CheckKind::Mass,
    CheckKind::Centres,
    CheckKind::Toppling,
    CheckKind::Standing,
    CheckKind::Ground,
    CheckKind::Sizes,
];

/// Holds the facts against the promises.
pub fn network_checks(promise: &NetworkPromise, facts: &NetworkFacts) -> Vec<Check> {
    let limbs = promise.limbs.iter().zip(&facts.limbs);
    let limbs = limbs.flat_map(|(limb, facts)| {
        let checks = telescope_checks(&limb.sheet, facts).into_iter();
        let own = checks.filter(|check| !OF_THE_WHOLE.contains(&check.kind));
        own.map(|check| named(check, &limb.id)).collect::<Vec<_>>()
    });
    let junctures = surface_checks(&Surfaces {
        broken: facts.broken.clone(),
        crossings: facts.crossings,
        in_pieces: facts.in_pieces.clone(),
        above_plate_mm: facts.above_plate_mm,
        too_large: facts.too_large.clone(),
    });
    let whole = whole(promise, facts);
    let standing = of_standing(promise, facts);
    let least_mm = promise.printer.minimum_wall_mm;
    let divided = facts.divided.iter();
    let divided = divided.flat_map(|own| of_divided(own, least_mm));
    let model = facts.model.iter().flat_map(|own| of_model(promise, own));
    let poses = pose_checks(&promise.poses, &facts.poses);
    let all = limbs
        .chain(junctures)
        .chain(whole)
        .chain(standing)
        .chain(poses);
    worst(all.chain(divided).chain(model))
}

/// Returns a check of a telescope with its name before the place.
fn named(check: Check, id: &str) -> Check {
    let place = match &check.detail {
        Some(detail) => format!("limb {id}: {detail}"),
        None => format!("limb {id}"),
    };
    check.at(Some(place))
}

/// Returns of every kind the check that is broken, else the one nearest to its limit.
fn worst(checks: impl Iterator<Item = Check>) -> Vec<Check> {
    let mut kept: Vec<Check> = Vec::new();
    for check in checks {
        let known = kept.iter_mut().find(|known| known.kind == check.kind);
        match known {
            None => kept.push(check),
            Some(known) if is_worse(&check, known) => *known = check,
            Some(_) => {}
        }
    }
    kept
}

fn is_worse(check: &Check, known: &Check) -> bool {
    let room = |check: &Check| check.value.map_or(0.0, |value| (check.limit - value).abs());
    match (check.pass, known.pass) {
        (false, true) => true,
        (true, false) => false,
        (false, false) => room(check) > room(known),
        (true, true) => room(check) < room(known),
    }
}

/// Returns the checks of a juncture in several parts; `least_mm` is the least wall.
fn of_divided(facts: &DividedFacts, least_mm: f64) -> Vec<Check> {
    let mut checks = peg_checks(&facts.pegs, least_mm);
    checks.extend([
        no_faults(
            CheckKind::Overlap,
            "no part reaches into another",
            facts.overlaps,
        ),
        none(
            CheckKind::PartSurfaces,
            "the parts of a juncture meet in its cuts, with all pins, sockets and ids",
            &facts.strays,
        ),
        none(
            CheckKind::Glue,
            "no cut goes through a socket or a peg of a limb",
            &facts.cut_through,
        ),
        Check::new(
            CheckKind::Volumes,
            "the parts add up to the uncut juncture, its pins, sockets and engraved ids",
            Some(facts.volume_error_ratio),
            Limit::at_most(VOLUME_SUM_LIMIT_RATIO, ""),
        ),
    ]);
    let named = checks.into_iter().map(|check| {
        let place = match &check.detail {
            Some(detail) => format!("{}: {detail}", facts.id),
            None => facts.id.clone(),
        };
        check.at(Some(place))
    });
    named.collect()
}

/// Returns the checks of junctures that are pieces of a model.
fn of_model(promise: &NetworkPromise, facts: &ModelFacts) -> Vec<Check> {
    let wall = facts.wall.as_ref();
    let walls = promise.limbs.iter().map(|limb| limb.sheet.wall_mm);
    let least_mm = walls.fold(0.0, f64::max);
    let faults = [&facts.off[..], &facts.lost[..]].concat();
    vec![
        none(
            CheckKind::Model,
            "the junctures keep the model's surface but for cuts and bores, and nothing of it is lost",
            &faults,
        ),
        Check::new(
            CheckKind::Wall,
            "the model leaves a wall around every root as thick as ordered",
            wall.map(|(wall_mm, _)| *wall_mm),
            Limit::at_least(least_mm - WALL_LIMIT_MM, "mm"),
        )
        .at(wall.map(|(_, limb)| format!("root of limb {limb}"))),
    ]
}

/// Returns the checks of a figure that is to stand.
fn of_standing(promise: &NetworkPromise, facts: &NetworkFacts) -> Vec<Check> {
    let (Some(least_deg), Some(found)) = (promise.least_angle_deg, &facts.standing) else {
        return Vec::new();
    };
    let pairs = promise.toppling_deg.iter().zip(&found.toppling_deg);
    let off_deg = pairs.map(|(stated, found)| (stated - found).abs());
    let is_whole = promise.toppling_deg.len() == found.toppling_deg.len();
    vec![
        Check::new(
            CheckKind::Toppling,
            "it topples as stated at every key",
            is_whole.then_some(off_deg.fold(0.0, f64::max)),
            Limit::at_most(TOPPLING_LIMIT_DEG, "°"),
        ),
        Check::new(
            CheckKind::Standing,
            "it stands on its foot at every state, until leaned by",
            Some(found.least_deg),
            Limit::at_least(least_deg, "°"),
        ),
        Check::new(
            CheckKind::Ground,
            "nothing reaches below its foot as it opens",
            Some(found.below_mm),
            Limit::at_most(GROUND_LIMIT_MM, "mm"),
        ),
    ]
}

fn whole(promise: &NetworkPromise, facts: &NetworkFacts) -> Vec<Check> {
    let centres = promise.centres_mm.iter().zip(&facts.centres);
    let off = centres.map(|(stated, found)| (Point::from(*stated) - found).norm());
    let off_mm = off.fold(0.0, f64::max);
    let is_whole = promise.centres_mm.len() == facts.centres.len();
    let boxes = [promise.collapsed_mm, promise.extended_mm];
    let sides = boxes.iter().flatten().zip(facts.boxes_mm.iter().flatten());
    let box_mm = sides.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    vec![
        none(
            CheckKind::Motion,
            "no two bodies touch while it opens",
            &facts.too_near,
        ),
        none(
            CheckKind::Glue,
            "every root fits its socket and every peg its mouth, one way only, with room for glue",
            &facts.seat_faults,
        ),
        Check::new(
            CheckKind::Placements,
            "the keys of the motion place every shell where its joints do",
            Some(facts.placement_error_mm),
            Limit::at_most(PLACEMENT_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Mass,
            "it weighs what is stated",
            Some((facts.mass_g / promise.mass_g - 1.0).abs()),
            Limit::at_most(MASS_LIMIT_RATIO, ""),
        ),
        Check::new(
            CheckKind::Centres,
            "its centre of mass is where it is stated at every key",
            is_whole.then_some(off_mm),
            Limit::at_most(CENTRE_LIMIT_MM, "mm"),
        ),
        Check::new(
            CheckKind::Sizes,
            "its boxes, all in and all out, are as stated",
            Some(box_mm),
            Limit::at_most(BOX_LIMIT_MM, "mm"),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_kind_the_broken_check_is_told_else_the_one_nearest_to_its_limit() {
        let check = |value: f64, place: &str| {
            let limit = Limit::at_most(1.0, "mm");
            Check::new(CheckKind::Wall, "thin", Some(value), limit).at(Some(place.to_owned()))
        };
        let of = |checks: Vec<Check>| worst(checks.into_iter()).remove(0).detail.unwrap();
        assert_eq!(
            of(vec![check(0.2, "a"), check(0.9, "b"), check(0.5, "c")]),
            "b"
        );
        assert_eq!(
            of(vec![check(1.2, "a"), check(0.99, "b"), check(1.5, "c")]),
            "c"
        );
    }
}
