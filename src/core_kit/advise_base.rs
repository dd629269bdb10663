//! The answers where there is no base, with what helps.

use super::asked::Asked;
use super::base::{ByVertices, NoBase};
use crate::base::numbers::measured;
use crate::base::setting::{Key, Setting};
use crate::geom::Plane;
use crate::job::base_method::BaseMethod;
use crate::polyhedra::{NoRoom, Unjoined};
use crate::wing::{Impossible, Remedy};

/// Tells why there is no base, and what helps.
pub fn no_base(asked: &Asked, why: &NoBase) -> Impossible {
    match why {
        NoBase::NoRoom(why) => no_room(asked, why),
        NoBase::Apart { apart, joined } => match joined {
            Some(joined) => stay_apart(asked, apart, *joined),
            None => given_apart(asked, apart),
        },
        NoBase::Unproved(found) => unproved(asked, found),
    }
}

fn no_room(asked: &Asked, why: &NoRoom) -> Impossible {
    let mut answer = Impossible::new(why.to_string());
    answer.is_proved = why.deepest_mm < why.distance_mm;
    let size_mm = asked.ground.solid().mesh().longest_side_mm();
    if let Some(factor) = why.least_factor {
        let larger_mm = (factor * size_mm).ceil();
        answer.remedies.push(Remedy {
            settings: vec![Setting::new(Key::Size, format!("{larger_mm}mm"))],
            words: "the least size at which a base has room".to_owned(),
        });
    }
    if !asked.job.method.is_planes() && !answer.is_proved {
        answer.hints.push(planes_instead());
    }
    answer
}

/// Tells that what moved vertices yield is not proved.
fn unproved(asked: &Asked, found: &ByVertices) -> Impossible {
    let mut answer = Impossible::new(format!(
        "the base that vertices of the {} yield is not proved: its samples keep {} from the \
         surface, but its faces prove {} of {}; moved inward by the rest, nothing of it is left",
        found.start,
        measured(found.sampled_mm, "mm"),
        measured(found.certified_mm, "mm"),
        measured(asked.base.distance_mm, "mm"),
    ));
    answer.hints.push(planes_instead());
    answer
}

fn planes_instead() -> String {
    format!(
        "planes keep the proof at every step: give `{}`",
        Setting::new(Key::Method, BaseMethod::Planes)
    )
}

/// Tells that the polyhedra of a given base are not joined, and what helps.
fn given_apart(asked: &Asked, apart: &Unjoined) -> Impossible {
    let radius_mm = asked.connector.radius_mm;
    let [a, b] = apart.polyhedra.map(|at| at + 1);
    let mut answer = Impossible::new(format!(
        "the polyhedra {a} and {b} of the base are not joined: {}, and a disc of {} radius is \
         asked for",
        shared(apart),
        measured(radius_mm, "mm")
    ));
    let halved = format!("{}mm", (0.5 * radius_mm).max(1.0));
    answer.hints.push(format!(
        "ask for a smaller disc, such as `{}`, or lock larger faces on the planes",
        Setting::new(Key::Connector, halved)
    ));
    answer.hints.extend(tube(asked, apart));
    answer
}

/// Tells that a polyhedron for which there is room stays apart from the others, and what helps.
fn stay_apart(asked: &Asked, apart: &Unjoined, joined: usize) -> Impossible {
    let [a, b] = apart.polyhedra.map(|at| at + 1);
    let mut answer = Impossible::new(format!(
        "{} polyhedra have room, but {a} and {b} cannot be joined: {}, and a disc of {} radius is \
         asked for",
        joined + 1,
        shared(apart),
        measured(asked.connector.radius_mm, "mm")
    ));
    let bolts_mm = asked
        .bolt
        .as_ref()
        .map(|bolt| bolt.disc_mm(asked.panels.sheet_mm));
    let smaller_mm = apart.disc_mm.floor();
    if bolts_mm.is_some_and(|least_mm| smaller_mm >= least_mm) {
        answer.hints.push(format!(
            "two bolts have room in that disc: ask for it by `{}`",
            Setting::new(Key::Connector, format!("{smaller_mm}mm"))
        ));
    }
    answer.hints.extend(tube(asked, apart));
    let fewer = Setting::new(Key::Polyhedra, joined);
    answer.hints.push(match joined {
        1 => format!("one polyhedron needs no joint: ask for `{fewer}`"),
        _ => format!("so many are joined: ask for `{fewer}`"),
    });
    answer
}

/// Words the disc that two polyhedra share.
fn shared(apart: &Unjoined) -> String {
    let plane = plane_words(&apart.plane);
    if apart.disc_mm > 0.0 {
        let disc = measured(apart.disc_mm, "mm");
        format!("across the plane {plane} their panels share a disc of {disc} radius")
    } else {
        format!("across the plane {plane} their panels share no disc")
    }
}

/// Words a plane; one that is square to an axis by its place along it.
fn plane_words(plane: &Plane) -> String {
    let axes = ["x", "y", "z"].iter().zip(plane.normal.iter());
    let mut along = axes.filter(|(_, part)| part.abs() > 1.0 - 1e-9);
    match along.next() {
        Some((axis, part)) => format!("{axis} = {}", measured(part * plane.offset_mm, "mm")),
        None => {
            let [x, y, z] = <[f64; 3]>::from(plane.normal);
            let offset = measured(plane.offset_mm, "mm");
            format!("{x:.3} x + {y:.3} y + {z:.3} z = {offset}")
        }
    }
}

/// Tells of a tube that would join two polyhedra. None is made yet.
fn tube(asked: &Asked, apart: &Unjoined) -> Option<String> {
    let length_mm = apart.tube_mm?;
    Some(format!(
        "a tube of {} radius has room between them, over a gap of {}; this program makes none yet",
        measured(asked.connector.radius_mm, "mm"),
        measured(length_mm, "mm")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    #[test]
    fn planes_are_told_by_their_place_along_an_axis() {
        let plane = |normal: Vector, offset_mm: f64| plane_words(&Plane { normal, offset_mm });
        assert_eq!(plane(Vector::y(), 12.5), "y = 12.5\u{a0}mm");
        assert_eq!(plane(-Vector::z(), -3.0), "z = 3\u{a0}mm");
        let slanted = plane(Vector::new(0.6, 0.0, 0.8), 3.0);
        assert!(
            slanted.starts_with("0.600 x + 0.000 y + 0.800 z = 3"),
            "{slanted}"
        );
    }
}
