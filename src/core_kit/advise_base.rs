//! The answers where there is no base, with what helps.

use super::advise_size::{NEXT_RATIO, large_enough};
use super::asked::Asked;
use super::base::{FailedStart, NoBase, NotFromStart};
use super::build::is_joined_by;
use super::error::CoreRunError;
use super::method::other_starts;
use crate::base::numbers::measured;
use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::cladding::RodKit;
use crate::geom::Plane;
use crate::job::base_method::BaseMethod;
use crate::polyhedra::{NoRoom, Unjoined};
use crate::wing::Impossible;

/// Kinds of rods that are tried before one is advised.
const MOST_TRIED: usize = 2;

/// Tells why there is no base, and what helps.
///
/// # Errors
/// The watch was stopped while other rods were tried.
pub fn no_base(asked: &Asked, why: &NoBase, watch: &Watch) -> Result<Impossible, CoreRunError> {
    Ok(match why {
        NoBase::NoRoom(why) => no_room(asked, why, watch)?,
        NoBase::Apart { apart, joined } => {
            let rods = rods(asked, apart, watch)?;
            match joined {
                Some(joined) => stay_apart(asked, apart, *joined, rods),
                None => given_apart(asked, apart, rods),
            }
        }
        NoBase::NoStart(failed) => no_start(asked, failed, watch)?,
    })
}

fn no_room(asked: &Asked, why: &NoRoom, watch: &Watch) -> Result<Impossible, Cancelled> {
    let (deepest, distance) = (
        measured(why.deepest_mm, "mm"),
        measured(why.distance_mm, "mm"),
    );
    let is_proved = why.deepest_mm < why.distance_mm;
    let mut answer = Impossible::new(if is_proved {
        format!(
            "the model is too thin: its deepest point lies {deepest} below the surface, and a base \
             stays {distance} away"
        )
    } else {
        format!(
            "the model is too thin: its deepest point lies {deepest} below the surface, a base stays \
             {distance} away, and no polyhedron was found in what is left"
        )
    });
    answer.is_proved = is_proved;
    let from_factor = why.least_factor.unwrap_or(NEXT_RATIO);
    let larger = large_enough(asked, from_factor, watch)?;
    if larger.is_none() {
        answer.hints.push("make the model larger".to_owned());
    }
    answer.remedies.extend(larger);
    answer.hints.push("ask for less wall".to_owned());
    Ok(answer)
}

/// Tells that no start of moved vertices yields a base, and what helps.
fn no_start(asked: &Asked, failed: &[FailedStart], watch: &Watch) -> Result<Impossible, Cancelled> {
    for one in failed {
        if let NotFromStart::NoRoom(why) = &one.why
            && why.deepest_mm < why.distance_mm
        {
            return no_room(asked, why, watch);
        }
    }
    let distance_mm = asked.base.distance_mm;
    let mut whys = failed.iter().map(|one| failure(one, distance_mm));
    let mut answer = if failed.len() == 1 {
        Impossible::new(whys.by_ref().collect())
    } else {
        let starts: Vec<String> = failed.iter().map(|one| one.start.to_string()).collect();
        let starts = starts.join(", ");
        Impossible::new(format!(
            "moved vertices yield no base that is proved, from any start that was tried: {starts}"
        ))
    };
    answer.tried = whys.collect();
    answer.hints = other_methods(asked);
    Ok(answer)
}

/// Words why one start yields no base.
fn failure(failed: &FailedStart, distance_mm: f64) -> String {
    let start = failed.start;
    let distance = measured(distance_mm, "mm");
    match &failed.why {
        NotFromStart::NoRoom(why) => format!(
            "the samples of the {start} keep {distance} from the surface at no size, though the \
             deepest point lies {} below it",
            measured(why.deepest_mm, "mm"),
        ),
        NotFromStart::Unproved { found, why } => format!(
            "the faces of the {start} prove {} of {distance}, though its samples keep {}. Moved \
             inward for the rest: {why}",
            measured(found.certified_mm, "mm"),
            measured(found.sampled_mm, "mm"),
        ),
    }
}

/// Returns what helps a base of moved vertices, whose faces are those of its start: planes, or
/// another start. Empty for other bases.
pub fn other_methods(asked: &Asked) -> Vec<String> {
    if !is_by_vertices(asked) {
        return Vec::new();
    }
    let mut hints = vec![planes_instead()];
    let others = other_starts(asked.job).into_iter();
    let others = others.map(|[method, faces]| format!("`{method}` with `{faces}`"));
    let others: Vec<String> = others.collect();
    if !others.is_empty() {
        hints.push(format!("try another start: {}", others.join(", or ")));
    }
    hints
}

/// Returns true if the base is looked for by moved vertices.
pub fn is_by_vertices(asked: &Asked) -> bool {
    asked.job.base.is_none() && !asked.job.method.is_planes()
}

fn planes_instead() -> String {
    format!(
        "planes keep the proof at every step, and avoid narrow faces: give `{}`",
        Setting::new(Key::Method, BaseMethod::Planes)
    )
}

/// Tells that the polyhedra of a given base are not joined, and what helps.
fn given_apart(asked: &Asked, apart: &Unjoined, rods: Vec<String>) -> Impossible {
    let [a, b] = apart.polyhedra.map(|at| at + 1);
    let mut answer = Impossible::new(format!(
        "the polyhedra {a} and {b} of the base are not joined. {}",
        shared(asked, apart)
    ));
    answer.hints.extend(smaller_disc(asked, apart));
    answer
        .hints
        .push("lock larger faces on the planes of the base".to_owned());
    answer.hints.extend(rods);
    answer
}

/// Tells that a polyhedron for which there is room stays apart from the others, and what helps.
fn stay_apart(asked: &Asked, apart: &Unjoined, joined: usize, rods: Vec<String>) -> Impossible {
    let [a, b] = apart.polyhedra.map(|at| at + 1);
    let mut answer = Impossible::new(format!(
        "{} polyhedra have room, but {a} and {b} were not joined by any plane that was tried. {}",
        joined + 1,
        shared(asked, apart)
    ));
    answer.hints.extend(smaller_disc(asked, apart));
    answer.hints.extend(rods);
    let fewer = Setting::new(Key::Polyhedra, joined);
    answer.hints.push(match joined {
        1 => format!("one polyhedron needs no joint: ask for `{fewer}`"),
        _ => format!("so many are joined: ask for `{fewer}`"),
    });
    answer
}

/// Tells to ask for the disc that two polyhedra share, if two bolts have room in it.
fn smaller_disc(asked: &Asked, apart: &Unjoined) -> Option<String> {
    let least_mm = asked.bolt.as_ref()?.disc_mm(asked.panels.sheet_mm);
    let smaller_mm = disc_for_bolts(apart.disc_mm, least_mm)?;
    Some(format!(
        "two bolts have room in that disc: ask for it by `{}`",
        Setting::new(Key::Connector, format!("{smaller_mm}mm"))
    ))
}

/// Returns a disc in whole mm, if it is at least as large as two bolts need.
fn disc_for_bolts(disc_mm: f64, least_mm: f64) -> Option<f64> {
    let whole_mm = disc_mm.floor();
    (whole_mm >= least_mm).then_some(whole_mm)
}

/// Words the disc that two polyhedra share, and the one asked for.
fn shared(asked: &Asked, apart: &Unjoined) -> String {
    let plane = plane_words(&apart.plane);
    let radius = measured(asked.connector.radius_mm, "mm");
    if apart.disc_mm > 0.0 {
        let disc = measured(apart.disc_mm, "mm");
        format!(
            "Across the plane {plane} their panels share a disc of {disc} radius; {radius} are \
             asked for"
        )
    } else {
        format!(
            "Across the plane {plane} their panels share no disc; one of {radius} radius is asked \
             for"
        )
    }
}

/// Words a plane; one that is square to an axis by its place along it.
pub fn plane_words(plane: &Plane) -> String {
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

/// Tells which rods join two polyhedra when they are tried, and what the way between them lacks for
/// those asked for.
fn rods(asked: &Asked, apart: &Unjoined, watch: &Watch) -> Result<Vec<String>, CoreRunError> {
    let Some(way_mm) = apart.way_mm else {
        return Ok(Vec::new());
    };
    let way = measured(way_mm, "mm");
    let (sheet_mm, wall_mm) = (asked.panels.sheet_mm, asked.wall_mm);
    let needed_mm = |kit: &RodKit| kit.room(sheet_mm, wall_mm).way_mm;
    let mut hints = Vec::new();
    if let Some(thinnest) = asked.rods.last() {
        hints.push(format!(
            "the widest straight way between them has a radius of {way}; two rods {} need {}",
            thinnest.rod.id,
            measured(needed_mm(thinnest), "mm"),
        ));
    }
    let all = RodKit::all(&asked.shop.fasteners, asked.pins.pins.clearance_mm);
    let is_new = |kit: &&RodKit| asked.rods.iter().all(|own| own.rod.id != kit.rod.id);
    let fits = all.iter().filter(|kit| needed_mm(kit) <= way_mm);
    for kit in fits.filter(is_new).take(MOST_TRIED) {
        if is_joined_by(asked, kit, watch)? {
            let id = &kit.rod.id;
            let setting = Setting::new(Key::Dowel, id);
            hints.push(format!(
                "a way of {way} radius is between them, with room for two rods {id}: give \
                 `{setting}`"
            ));
            break;
        }
    }
    Ok(hints)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::core_kit::base::ByVertices;
    use crate::geom::Vector;
    use crate::polyhedra::NotInside;
    use crate::polyhedra::vertices::StartSolid;

    #[test]
    fn a_start_without_a_base_is_told_with_its_figures_and_the_error_of_its_proof() {
        let start = StartSolid::Cube;
        let no_room = FailedStart {
            start,
            why: NotFromStart::NoRoom(NoRoom {
                deepest_mm: 20.0,
                distance_mm: 5.0,
                least_factor: None,
            }),
        };
        assert_eq!(
            failure(&no_room, 5.0),
            "the samples of the cube keep 5\u{a0}mm from the surface at no size, though the \
             deepest point lies 20\u{a0}mm below it"
        );
        let found = ByVertices {
            start,
            volume_mm3: 10.0,
            sampled_mm: 5.0,
            certified_mm: -1.0,
            moved_mm: 0.0,
        };
        let unproved = FailedStart {
            start,
            why: NotFromStart::Unproved {
                found,
                why: NotInside::Unbounded,
            },
        };
        assert_eq!(
            failure(&unproved, 5.0),
            "the faces of the cube prove -1\u{a0}mm of 5\u{a0}mm, though its samples keep \
             5\u{a0}mm. Moved inward for the rest: the planes bound no body"
        );
    }

    #[test]
    fn a_smaller_disc_is_told_only_if_two_bolts_have_room_in_it() {
        assert_eq!(disc_for_bolts(17.9, 17.0), Some(17.0));
        assert_eq!(disc_for_bolts(17.9, 17.5), None);
        assert_eq!(disc_for_bolts(0.0, 17.5), None);
    }

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
