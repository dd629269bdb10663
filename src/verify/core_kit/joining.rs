//! How several polyhedra come together, by the judge's own count: nothing that a list says of
//! groups is believed.

use super::evidence::CoreEvidence;
use super::promise::{
    CorePartKind, CorePromise, FastenerKind, FastenerPromise, JoinPromise, UnitPromise,
};
use crate::geom::Vector;

/// By how much the length of a way may differ from 1. Along a way of no length nothing is met.
const WAY_SLACK: f64 = 1e-9;

/// Returns the number of a unit's polyhedron by its panel and its parts, from 1. `None` if they
/// belong to several polyhedra, or to none.
pub fn polyhedron_of(evidence: &CoreEvidence, unit: &UnitPromise) -> Option<usize> {
    if evidence.certificate.others.is_empty() {
        return Some(1);
    }
    let of = |panel: usize| of_panel(evidence, panel);
    let parts = unit.parts.iter().filter_map(|id| evidence.part(id));
    let parts = parts.map(|part| &evidence.promise.parts[part]);
    // A bracket belongs to the panel to which it is screwed, so that its unit tells more.
    let shell = parts.filter(|part| part.kind == CorePartKind::Shell);
    let mut named = unit.panel.into_iter().chain(shell.map(|part| part.panel));
    let first = of(named.next()?)?;
    named.all(|panel| of(panel) == Some(first)).then_some(first)
}

/// Returns the number of a panel's polyhedron, from 1.
pub fn of_panel(evidence: &CoreEvidence, panel: usize) -> Option<usize> {
    let panel = evidence.panels.panels.get(panel.wrapping_sub(1))?;
    Some(panel.polyhedron)
}

/// Returns the faults of units and joins, in words.
pub fn misjoined(evidence: &CoreEvidence) -> Vec<String> {
    [
        misplaced(evidence),
        lengths(evidence),
        joined(evidence),
        bolted(evidence),
        on_rods(evidence),
    ]
    .concat()
}

/// Returns the units that are told to be of another polyhedron, or come out of turn.
fn misplaced(evidence: &CoreEvidence) -> Vec<String> {
    let is_one = evidence.certificate.others.is_empty();
    let units = &evidence.promise.units;
    let faults = units.iter().enumerate().filter_map(|(at, unit)| {
        let own = polyhedron_of(evidence, unit);
        let told = unit.polyhedron.or(is_one.then_some(1));
        let id = &unit.id;
        let follows_last = units[..at].iter().any(|before| before.is_last);
        if own.is_none() || own != told {
            Some(format!("{id} is not of the polyhedron that is told"))
        } else if unit.is_last && is_one {
            Some(format!("{id} comes last, but there are no joins"))
        } else {
            let is_early = follows_last && !unit.is_last;
            is_early.then(|| format!("{id} comes before the joins, but is listed after them"))
        }
    });
    faults.collect()
}

/// Returns the ways that have not the length 1.
fn lengths(evidence: &CoreEvidence) -> Vec<String> {
    let promise = &evidence.promise;
    let units = promise.units.iter().map(|unit| (unit.way, unit.id.clone()));
    let joins = promise.joins.iter().map(|join| (join.way, join.name()));
    let wrong = units.chain(joins).filter(|(way, _)| {
        let off = Vector::from(*way).norm() - 1.0;
        off.is_nan() || off.abs() > WAY_SLACK
    });
    wrong
        .map(|(_, id)| format!("the way of {id} has not the length 1"))
        .collect()
}

/// Joins the polyhedra group by group, and returns what does not fit, and what stays alone.
fn joined(evidence: &CoreEvidence) -> Vec<String> {
    let count = evidence.certificate.bases().count();
    let mut groups: Vec<Vec<usize>> = (1..=count).map(|number| vec![number]).collect();
    let mut faults = Vec::new();
    for join in &evidence.promise.joins {
        let place = |numbers: &[usize]| {
            let mut sorted = numbers.to_vec();
            sorted.sort_unstable();
            groups.iter().position(|group| *group == sorted)
        };
        match (place(&join.moving), place(&join.standing)) {
            (Some(moving), Some(standing)) if moving != standing => {
                let comes = groups[moving].clone();
                groups[standing].extend(comes);
                groups[standing].sort_unstable();
                groups.remove(moving);
            }
            _ => faults.push(format!(
                "the joining of {} to {} joins no two groups that stand by themselves",
                join.name(),
                join.others()
            )),
        }
    }
    let apart = groups.iter().skip(1);
    faults.extend(apart.map(|group| format!("polyhedron {} comes to no other", group[0])));
    faults
}

/// Returns the faults of the bolts between polyhedra: those of joins, and polyhedra that neither
/// bolts nor rods join to another.
fn bolted(evidence: &CoreEvidence) -> Vec<String> {
    let promise = &evidence.promise;
    let bolts = promise.fasteners.iter();
    let bolts: Vec<&FastenerPromise> = bolts.filter(|one| one.kind == FastenerKind::Bolt).collect();
    let held: Vec<[usize; 2]> = bolts
        .iter()
        .filter_map(|bolt| {
            let [a, b] = [Some(bolt.panel), bolt.through].map(|panel| of_panel(evidence, panel?));
            Some([a?, b?])
        })
        .collect();
    let counts = promise.joins.iter().filter_map(|join| {
        let found = held.iter().filter(|pair| is_across(join, **pair)).count();
        let words = || format!("{found} of {} bolts hold {}", join.bolts, join.name());
        (found != join.bolts).then(words)
    });
    let late = bolts.iter().filter_map(|bolt| {
        let passed = [Some(bolt.panel), bolt.through];
        let is_late = passed
            .iter()
            .flatten()
            .any(|panel| comes_last(promise, *panel));
        is_late.then(|| format!("a bolt of {} passes a panel that comes last", bolt.part))
    });
    let on_rods = promise.rods.iter().filter_map(|rod| {
        let [a, b] = rod.panels.map(|panel| of_panel(evidence, panel));
        Some([a?, b?])
    });
    let all: Vec<[usize; 2]> = held.iter().copied().chain(on_rods).collect();
    let reached = reached(&all);
    let alone = (1..=evidence.certificate.bases().count()).filter(|one| !reached.contains(one));
    let alone = alone.map(|number| format!("polyhedron {number} is bolted or doweled to no other"));
    counts.chain(late).chain(alone).collect()
}

/// Returns true if a panel, by its number, comes when all polyhedra are joined.
fn comes_last(promise: &CorePromise, panel: usize) -> bool {
    let mut last = promise.units.iter().filter(|unit| unit.is_last);
    last.any(|unit| unit.panel == Some(panel))
}

/// Returns the faults of rods as polyhedra come together. These come along them, to the side into
/// which the rods are glued first. About a single one they would turn.
fn on_rods(evidence: &CoreEvidence) -> Vec<String> {
    let promise = &evidence.promise;
    let mut faults = Vec::new();
    for rod in &promise.rods {
        let sides = rod.panels.map(|panel| of_panel(evidence, panel));
        let own = promise.joins.iter().find(|join| {
            let stands = sides[0].is_some_and(|first| join.standing.contains(&first));
            stands && sides[1].is_some_and(|second| join.moving.contains(&second))
        });
        let along = own.map(|join| Vector::from(join.way).dot(&rod.way()));
        if !along.is_some_and(|cosine| cosine >= 1.0 - WAY_SLACK) {
            faults.push(format!("nothing comes along {}", rod.name));
        }
        if rod.panels.iter().any(|panel| comes_last(promise, *panel)) {
            faults.push(format!("{} passes a panel that comes last", rod.name));
        }
    }
    for join in &promise.joins {
        let across = promise.rods.iter().filter(|rod| {
            let [a, b] = rod.panels.map(|panel| of_panel(evidence, panel));
            a.zip(b).is_some_and(|(a, b)| is_across(join, [a, b]))
        });
        let found = across.count();
        if found != join.rods || found == 1 {
            faults.push(format!(
                "{found} of {} rods hold {}",
                join.rods,
                join.name()
            ));
        }
    }
    faults
}

/// Returns true if one of two polyhedra comes in a join, and the other one stands.
fn is_across(join: &JoinPromise, [a, b]: [usize; 2]) -> bool {
    let goes = |one, other| join.moving.contains(&one) && join.standing.contains(&other);
    goes(a, b) || goes(b, a)
}

/// Returns all numbers that pairs join to 1.
fn reached(pairs: &[[usize; 2]]) -> Vec<usize> {
    let mut joined = vec![1];
    // Each pass reaches one more pair, or none is left.
    for _ in pairs {
        for pair in pairs {
            if pair.iter().any(|number| joined.contains(number)) {
                joined.extend(pair);
            }
        }
        joined.sort_unstable();
        joined.dedup();
    }
    joined
}
