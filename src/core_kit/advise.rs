//! The answers where there is no such object, with what helps.

use super::advise_base::{is_by_vertices, no_base, other_methods, plane_words};
use super::advise_size::{NEXT_RATIO, large_enough};
use super::asked::Asked;
use super::ballast::ballasted;
use super::build::Refused;
use super::error::CoreRunError;
use super::made::Made;
use super::mass::{Weighed, point, toppling_deg, weigh};
use crate::ballast::{BallastError, Order};
use crate::base::numbers::measured;
use crate::base::setting::{Key, Setting};
use crate::base::units::MM3_PER_CM3;
use crate::base::watch::{Cancelled, Watch};
use crate::cladding::{CladdingError, FreeingCut};
use crate::cutting::SheetError;
use crate::geom::Point;
use crate::goal::{Goal, Up, support_edges};
use crate::job::GrainChoice;
use crate::job::core_kit::{CoreGoal, CoreJoints, CoreShell};
use crate::mass::moments_of_mesh;
use crate::panels::PanelError;
use crate::wing::{Impossible, Remedy};

/// Tells why there is no such object, and what helps.
///
/// # Errors
/// The watch was stopped while other rods were tried.
pub fn refused(
    asked: &Asked,
    refused: &Refused,
    watch: &Watch,
) -> Result<Impossible, CoreRunError> {
    Ok(match refused {
        Refused::Base(why) => no_base(asked, why, watch)?,
        Refused::Panels(why) => unpanelled(asked, why, watch)?,
        Refused::Shell(why) => unclad(asked, why),
        Refused::Sheets(why) => uncut(asked, why),
    })
}

/// Tells why a base gets no panels, and what helps.
fn unpanelled(asked: &Asked, why: &PanelError, watch: &Watch) -> Result<Impossible, Cancelled> {
    let mut answer = Impossible::new(why.to_string());
    if matches!(why, PanelError::NoFingers { .. }) {
        answer.remedies.push(Remedy {
            settings: vec![Setting::new(Key::Joints, CoreJoints::Auto)],
            words: "brackets hold the edges that have no room for fingers".to_owned(),
        });
        return Ok(answer);
    }
    let thinner = if is_by_vertices(asked) {
        "use a thinner sheet, or make the model larger"
    } else {
        answer
            .remedies
            .extend(large_enough(asked, NEXT_RATIO, watch)?);
        "use a thinner sheet, ask for fewer faces, or make the model larger"
    };
    answer.hints.push(thinner.to_owned());
    answer.hints.extend(other_methods(asked));
    Ok(answer)
}

/// Tells why the panels find no place on sheets, and what helps.
fn uncut(asked: &Asked, why: &SheetError) -> Impossible {
    let mut answer = Impossible::new(why.to_string());
    if asked.keeps_grain {
        answer.hints.push(format!(
            "all panels follow the grain; let them lie any way by `{}`",
            Setting::new(Key::Grain, GrainChoice::Free)
        ));
    }
    answer
}

/// Tells why a base gets no shell, and what helps.
fn unclad(asked: &Asked, why: &CladdingError) -> Impossible {
    let mut answer = Impossible::new(why.to_string());
    if let CladdingError::Cycle { cut, .. } = why {
        answer.hints.push(freeing(cut.as_deref()));
    }
    let hint = match why {
        CladdingError::NoBolts { .. } => {
            let larger = format!("{}mm", (1.5 * asked.connector.radius_mm).ceil());
            format!(
                "ask for a larger disc between polyhedra, such as `{}`",
                Setting::new(Key::Connector, larger)
            )
        }
        CladdingError::NoRods { .. } => format!(
            "ask for `{}`: it needs no rods; or give a base with larger faces at both ends of them",
            Setting::new(Key::Polyhedra, 1)
        ),
        CladdingError::Enclosed { .. } => format!(
            "ask for `{}`: its units pass no others; or give a base whose named faces lean away \
             from the plane",
            Setting::new(Key::Polyhedra, 1)
        ),
        _ if is_by_vertices(asked) => "ask for a printer with more room".to_owned(),
        _ => "ask for another number of faces, or for a printer with more room".to_owned(),
    };
    answer.hints.push(hint);
    answer.hints.extend(other_methods(asked));
    answer
}

/// Tells the cut that frees units which bar each other: it was tried.
fn freeing(cut: Option<&FreeingCut>) -> String {
    let Some(cut) = cut else {
        return "no cut frees them, of those beside and between the parts that were tried"
            .to_owned();
    };
    format!(
        "a cut of {} frees them, as was tried: part the piece about {} mm, {}, from {} along the \
         plane {}. It leaves first, along ({}), and then all others do. Take it off the model, print \
         it for itself, and glue it on last",
        measured(cut.area_mm2, "mm²"),
        cut.piece_words(),
        measured(cut.volume_mm3 / MM3_PER_CM3, "cm³"),
        cut.part,
        plane_words(&cut.plane),
        [cut.way.x, cut.way.y, cut.way.z]
            .map(|part| format!("{:.2}", part + 0.0))
            .join(", ")
    )
}

/// Tells why an object does not stand as asked, and what helps; `None` if it does, or need not.
///
/// Its mass and centre are known exactly, but another base or other cuts may do.
///
/// # Errors
/// The catalogue of ballast is at fault.
pub fn falls(
    asked: &Asked,
    made: &Made,
    weighed: &Weighed,
) -> Result<Option<Impossible>, BallastError> {
    let Some(goal) = asked.goal.as_ref() else {
        return Ok(None);
    };
    let least_deg = asked.job.least_angle_deg;
    let found_deg = toppling_deg(goal, weighed);
    if found_deg >= least_deg {
        return Ok(None);
    }
    let center = goal.frame.to_local(&weighed.center());
    let mut answer = Impossible::new(format!(
        "the object on its base topples at {}, less than the {} asked for: its {} lie {} above the \
         floor",
        measured(found_deg, "°"),
        measured(least_deg, "°"),
        measured(weighed.mass_g(), "g"),
        measured(center.z, "mm"),
    ));
    if found_deg > 0.0 {
        let reached = (found_deg * 10.0).floor() / 10.0;
        answer.remedies.push(Remedy {
            settings: vec![Setting::new(Key::LeastAngle, reached)],
            words: "promises what is reached".to_owned(),
        });
    }
    answer.remedies.extend(solid_shell(asked, made, goal));
    let is_free = asked.job.ballast.is_none();
    let laid = is_free.then(|| laid_in(asked, made, weighed));
    match laid.transpose()?.flatten() {
        Some(remedy) => answer.remedies.push(remedy),
        None => {
            answer.tried.push("ballast on the lowest panel".to_owned());
            answer.hints.extend(ballast(asked, made, goal, weighed));
        }
    }
    answer.remedies.extend(another_way_up(asked, weighed));
    answer.remedies.push(Remedy {
        settings: vec![Setting::new(Key::Goal, CoreGoal::None)],
        words: "promises nothing about standing: fix the object to the floor or to a plate"
            .to_owned(),
    });
    Ok(Some(answer))
}

/// Tells that fewer pieces of ballast find room than are ordered, and what helps; `None` if all do.
///
/// # Errors
/// The catalogue of ballast is at fault.
pub fn too_few(
    asked: &Asked,
    made: &Made,
    weighed: &Weighed,
) -> Result<Option<Impossible>, BallastError> {
    let (Some(goal), Order::Parts { id, count }) = (asked.goal.as_ref(), &asked.job.ballast) else {
        return Ok(None);
    };
    let (laid, lean_deg) = (weighed.ballast.len(), toppling_deg(goal, weighed));
    let stands = lean_deg >= asked.job.least_angle_deg;
    // Of the fewest that suffice there is at least one, or else it falls.
    let ordered = count.map_or(usize::from(stands), |count| count as usize);
    if laid >= ordered {
        return Ok(None);
    }
    let mut answer = Impossible::new(format!(
        "the lowest panel has room for {laid} of {ordered} pieces of {id}, in the places tried"
    ));
    if laid > 0 && stands {
        let order = Order::Parts {
            id: id.clone(),
            count: u32::try_from(laid).ok(),
        };
        answer.remedies.push(Remedy {
            settings: vec![Setting::new(Key::Ballast, order)],
            words: format!("lays them: topples at {}", measured(lean_deg, "°")),
        });
    }
    let bare = weigh(asked, made);
    let bare_deg = toppling_deg(goal, &bare);
    if bare_deg >= asked.job.least_angle_deg {
        answer.remedies.push(Remedy {
            settings: vec![Setting::new(Key::Ballast, Order::None)],
            words: format!("stands without: topples at {}", measured(bare_deg, "°")),
        });
    }
    answer.remedies.extend(laid_in(asked, made, &bare)?);
    let smaller = "order fewer or smaller pieces, or make the model larger";
    answer.hints.push(smaller.to_owned());
    Ok(Some(answer))
}

/// Returns the remedy of ballast that is laid in, if the object then stands as asked.
fn laid_in(asked: &Asked, made: &Made, weighed: &Weighed) -> Result<Option<Remedy>, BallastError> {
    let heavier = ballasted(asked, made, weighed.clone(), &Order::Auto)?;
    let goal = asked.goal.as_ref();
    Ok(goal
        .zip(heavier.ballast.first())
        .map(|(goal, piece)| Remedy {
            settings: vec![Setting::new(Key::Ballast, Order::Auto)],
            words: format!(
                "lays {} of {}, {}, on panel {} inside: topples at {}",
                heavier.ballast.len(),
                piece.id,
                measured(heavier.ballast_g, "g"),
                piece.panel,
                measured(toppling_deg(goal, &heavier), "°")
            ),
        }))
}

/// Returns the remedy of standing on another side, if the object then stands as asked. It is the
/// one of the model's six axes on which it leans the farthest.
fn another_way_up(asked: &Asked, weighed: &Weighed) -> Option<Remedy> {
    let words = ["x", "y", "z", "-x", "-y", "-z"];
    let leans = words.into_iter().filter_map(|word| {
        let up: Up = word.parse().ok()?;
        let goal = asked.standing(up).ok()?;
        Some((toppling_deg(&goal, weighed), word))
    });
    let best = leans.reduce(|a, b| if b.0 > a.0 { b } else { a });
    let (lean_deg, word) = best.filter(|(deg, _)| *deg >= asked.job.least_angle_deg)?;
    Some(Remedy {
        settings: vec![Setting::new(Key::Up, word)],
        words: format!(
            "stands on that side until leaned by {}",
            measured(lean_deg, "°")
        ),
    })
}

/// Returns the remedy of solid parts, if the object then stands as asked.
fn solid_shell(asked: &Asked, made: &Made, goal: &Goal) -> Option<Remedy> {
    if asked.job.shell == CoreShell::Solid {
        return None;
    }
    let hollow = weigh(asked, made);
    let parts = &made.built.shell.parts;
    let written = made
        .parts
        .iter()
        .map(|part| moments_of_mesh(&part.in_model()));
    let written = written.take(parts.len());
    let more = parts.iter().zip(written);
    let more = more.fold(hollow.whole, |whole, (part, written)| {
        whole + (moments_of_mesh(&part.body) - written) * asked.print_g_mm3()
    });
    let solid = Weighed {
        whole: more,
        ..hollow
    };
    let lean_deg = toppling_deg(goal, &solid);
    (lean_deg >= asked.job.least_angle_deg).then(|| Remedy {
        settings: vec![Setting::new(Key::Shell, CoreShell::Solid)],
        words: format!(
            "topples at {} and weighs {}",
            measured(lean_deg, "°"),
            measured(solid.mass_g(), "g")
        ),
    })
}

/// Returns the least ballast on the bottom panel with which the object stands as asked, in words.
fn ballast(asked: &Asked, made: &Made, goal: &Goal, weighed: &Weighed) -> Option<String> {
    let plan = &made.built.plan;
    let bottom = plan.bottom_face(&asked.up)?;
    let face = plan.face(bottom)?;
    let at = face.centroid - face.plane.normal * asked.panels.sheet_mm;
    let mass_g = least_ballast_g(goal, weighed, &at, asked.job.least_angle_deg)?;
    let panels = made.built.shell.panels.panels.iter();
    let number = panels
        .enumerate()
        .find(|(_, panel)| panel.face == bottom)?
        .0
        + 1;
    Some(format!(
        "lay {} of ballast on the middle of panel {number}, inside: with it the object stands as \
         asked",
        measured(mass_g, "g")
    ))
}

/// Returns the least mass in a point with which a body leans as far as asked, g; `None` if none
/// does.
///
/// Take an edge of the support with inward normal n and offset d, and the slope t = tan θ. A mass M
/// at c stands if M (n·c − d − t c_z) ≥ 0. That is linear in the mass, so one more mass adds its
/// own term.
fn least_ballast_g(goal: &Goal, weighed: &Weighed, at: &Point, least_deg: f64) -> Option<f64> {
    let slope = least_deg.to_radians().tan();
    let [center, at] = [weighed.center(), *at].map(|p| goal.frame.to_local(&p));
    let margins = support_edges(&goal.support)
        .into_iter()
        .map(|(n, d)| [center, at].map(|p| n[0] * p.x + n[1] * p.y - d - slope * p.z));
    let needed = margins.map(|[own, more]| match (own >= 0.0, more > 0.0) {
        (true, true) => Some(0.0),
        (false, true) => Some(-own * weighed.mass_g() / more),
        _ => None,
    });
    let needed: Vec<f64> = needed.collect::<Option<_>>()?;
    let mass_g = needed.into_iter().fold(0.0, f64::max);
    let stands = Weighed {
        whole: weighed.whole + point(mass_g * (1.0 + 1e-9), goal.frame.to_model(&at).into()),
        ..weighed.clone()
    };
    (toppling_deg(goal, &stands) >= least_deg - 1e-6).then_some(mass_g)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::goal::testing::block;
    use crate::goal::{GoalKind, Request, place};

    /// Returns a mass of 1 kg in a point.
    fn weight(center: [f64; 3]) -> Weighed {
        Weighed {
            shell_g: 1000.0,
            panels_g: 0.0,
            brackets_g: 0.0,
            fasteners_g: 0.0,
            rods_g: 0.0,
            glue_g: 0.0,
            ballast_g: 0.0,
            whole: point(1000.0, center),
            fasteners: Vec::new(),
            rods: Vec::new(),
            glue: Vec::new(),
            ballast: Vec::new(),
        }
    }

    #[test]
    fn the_least_ballast_makes_a_tower_lean_as_far_as_asked_and_no_farther() {
        let tower = block([-10.0, -10.0, 0.0], [10.0, 10.0, 100.0]);
        let goal = place(&tower, 1.0, &Request::new(GoalKind::Stand))
            .unwrap()
            .goal;
        let tall = weight([0.0, 0.0, 60.0]);
        let lean_deg = (10.0_f64 / 60.0).atan().to_degrees();
        assert!((toppling_deg(&goal, &tall) - lean_deg).abs() < 1e-9);
        let at = Point::new(0.0, 0.0, 5.0);
        let mass_g = least_ballast_g(&goal, &tall, &at, 20.0).unwrap();
        // M (10 − 60 t) + m (10 − 5 t) = 0 at t = tan 20°.
        let slope = 20f64.to_radians().tan();
        let expected_g = 1000.0 * (60.0 * slope - 10.0) / (10.0 - 5.0 * slope);
        assert!((mass_g / expected_g - 1.0).abs() < 1e-9);
        let all = tall.whole + point(mass_g, at.into());
        let heavier = Weighed { whole: all, ..tall };
        assert!((toppling_deg(&goal, &heavier) - 20.0).abs() < 1e-6);
        // No ballast so high helps, and what stands needs none.
        let top = Point::from(Vector::z() * 90.0);
        assert_eq!(
            least_ballast_g(&goal, &weight([0.0, 0.0, 60.0]), &top, 20.0),
            None
        );
        assert_eq!(
            least_ballast_g(&goal, &weight([0.0, 0.0, 9.0]), &at, 20.0),
            Some(0.0)
        );
    }
}
