//! The greatest wall at this size, and with it the least size at this wall.

use super::case::Case;
use super::confirm::least_excess;
use super::directions::round_to;
use super::remedy::{Change, Kind, Remedy};
use super::sampled_model::{COARSE_SAMPLES, SampledModel, Trial};
use crate::base::setting::{Key, Setting};
use crate::base::units::{Length, show_mm};
use crate::goal::{Contact, Footing, Request, Rotor, SpinPoint, Water, Waterline};
use crate::mesh::{Solid, scaled};

/// The greatest factor by which a thinner wall or a larger model is advised. Nobody prints an
/// object twenty times as large as planned.
const MOST_TIMES: f64 = 20.0;
/// The relative precision of the greatest wall.
const PRECISION_RATIO: f64 = 0.01;
/// Walls are printed to a thousandth of a millimetre, far below any printer's step.
const WALLS_PER_MM: f64 = 1e3;

/// Returns the least size at this wall and the greatest wall at this size.
///
/// The wall is confirmed by a solve. Then the size is rounded up and the wall down to numbers that
/// can be typed and printed, which leaves even more to be emptied. A tip does not grow with its
/// model, so a top on a tip is solved again at its new size.
pub(super) fn remedies(model: &SampledModel) -> Vec<Remedy> {
    let case = &model.case;
    let confirmed = greatest_wall(model).and_then(|thickest_mm| confirm_wall(model, thickest_mm));
    let Some((wall_mm, trial)) = confirmed else {
        let words = format!("other walls, and up to {MOST_TIMES} times the size");
        return vec![Remedy::dead_end(Kind::LeastSize, words)];
    };
    vec![
        larger(model, wall_mm, &trial),
        thinner(case, wall_mm, &trial),
    ]
}

/// Returns the thickest wall, mm, that makes the goal possible at the present size, on samples.
/// `None` if even a wall [`MOST_TIMES`] thinner does not.
///
/// A thinner wall lets more be emptied, and more choice never makes a goal impossible. So one
/// number separates possible from impossible walls, and bisection finds it. Only wall/size counts
/// if the contact scales along, so the same number gives the size of a larger model that helps. The
/// precision is one per cent.
fn greatest_wall(model: &SampledModel) -> Option<f64> {
    let (request, wall_mm) = (&model.case.request, model.case.wall_mm);
    let halves = std::iter::successors(Some(0.5 * wall_mm), |wall| Some(0.5 * wall));
    let tried = halves
        .take_while(|&wall| wall > wall_mm / MOST_TIMES)
        .chain([wall_mm / MOST_TIMES]);
    let mut thickest_mm = tried
        .into_iter()
        .find(|&wall| model.allows(request, wall))?;
    let mut too_thick_mm = (2.0 * thickest_mm).min(wall_mm);
    while too_thick_mm > thickest_mm * (1.0 + PRECISION_RATIO) {
        let middle_mm = (too_thick_mm * thickest_mm).sqrt();
        if model.allows(request, middle_mm) {
            thickest_mm = middle_mm;
        } else {
            too_thick_mm = middle_mm;
        }
    }
    Some(thickest_mm)
}

/// Confirms that wall, or a thinner one.
fn confirm_wall(model: &SampledModel, thickest_mm: f64) -> Option<(f64, Trial)> {
    least_excess(|excess| {
        let wall_mm = thickest_mm / (1.0 + excess);
        Some((wall_mm, model.confirm(&model.case.request, wall_mm)?))
    })
}

fn larger(model: &SampledModel, greatest_mm: f64, trial: &Trial) -> Remedy {
    let case = &model.case;
    let least_mm = size_for(case, greatest_mm, case.wall_mm);
    let has_tip = trial.placement.footing.as_ref().and_then(Footing::tip);
    let carried_out = if has_tip.is_none() || least_mm > case.greatest_size_mm {
        Some((least_mm, trial.clone()))
    } else {
        least_excess(|excess| {
            let size_mm = round_up(least_mm * (1.0 + excess));
            Some((size_mm, solve_at(model, size_mm)?))
        })
    };
    let Some((size_mm, trial)) = carried_out else {
        return Remedy::dead_end(Kind::LeastSize, "larger sizes".to_owned());
    };
    if size_mm > case.greatest_size_mm {
        let words = format!(
            "larger sizes ({} would do, and a kit for this printer may be {} at most)",
            show_mm(size_mm),
            show_mm(case.greatest_size_mm)
        );
        return Remedy::dead_end(Kind::LeastSize, words);
    }
    let words = format!(
        "make it {} or larger with the wall of {}",
        show_mm(size_mm),
        show_mm(case.wall_mm),
    );
    let times = size_mm / case.solid.mesh().longest_side_mm();
    let mut settings = vec![Setting::new(Key::Size, format!("{size_mm}mm"))];
    settings.extend(places(&case.request, &grown(&case.request, times)));
    let change = Change {
        amount: size_mm,
        settings,
        words,
    };
    Remedy::helping(Kind::LeastSize, change, &trial)
}

/// Solves the request on the model at another size; `None` if it is not possible there.
fn solve_at(model: &SampledModel, size_mm: f64) -> Option<Trial> {
    let case = &model.case;
    let mesh = case.solid.mesh();
    let times = size_mm / mesh.longest_side_mm();
    let solid = Solid::new(scaled(mesh, times)).ok()?;
    let case = Case {
        solid: &solid,
        request: grown(&case.request, times),
        ..*case
    };
    let model = SampledModel::new(case, COARSE_SAMPLES, &model.watch);
    model.confirm(&case.request, case.wall_mm)
}

/// Returns the request on a model this many times as large: places given in mm move along.
fn grown(request: &Request, times: f64) -> Request {
    let point = |at: [f64; 3]| round_to(at.map(|coordinate| coordinate * times), 4);
    let length = |length: Length| {
        let mm = round_to([length.mm() * times, 0.0, 0.0], 3)[0];
        Length::from_mm(mm).unwrap_or(length)
    };
    let contact = request.contact.map(|contact| match contact {
        Contact::At(at) => Contact::At(point(at)),
        contact => contact,
    });
    let spin_point = request.spin_point.map(|spin_point| match spin_point {
        SpinPoint::At(at) => SpinPoint::At(point(at)),
        spin_point => spin_point,
    });
    let water = request.water.map(|water| Water {
        waterline: match water.waterline {
            Waterline::At(line) => Waterline::At(length(line)),
            Waterline::Auto => Waterline::Auto,
        },
        ..water
    });
    let rotor = request.rotor.map(|rotor| Rotor {
        bore: rotor.bore.map(length),
        ..rotor
    });
    Request {
        contact,
        spin_point,
        water,
        rotor,
        ..*request
    }
}

/// Returns the options for the places that moved from one request to another.
fn places(from: &Request, to: &Request) -> Vec<Setting> {
    let line = |request: &Request| request.water.map(|water| water.waterline);
    let bore = |request: &Request| request.rotor.and_then(|rotor| rotor.bore);
    let is_other = [
        from.contact != to.contact,
        from.spin_point != to.spin_point,
        line(from) != line(to),
        bore(from) != bore(to),
    ];
    let settings = [
        to.contact
            .map(|contact| Setting::new(Key::Contact, contact)),
        to.spin_point
            .map(|point| Setting::new(Key::SpinPoint, point)),
        line(to).map(|line| Setting::new(Key::Waterline, line)),
        bore(to).map(|bore| Setting::new(Key::Bore, bore)),
    ];
    let moved = settings.into_iter().zip(is_other);
    moved
        .filter_map(|(setting, is_other)| setting.filter(|_| is_other))
        .collect()
}

/// Returns the size, mm, at which a wall is as thick for the model as `greatest_mm` is at the
/// present size.
fn size_for(case: &Case, greatest_mm: f64, wall_mm: f64) -> f64 {
    round_up(case.solid.mesh().longest_side_mm() * wall_mm / greatest_mm)
}

fn thinner(case: &Case, greatest_mm: f64, trial: &Trial) -> Remedy {
    let steps = (greatest_mm / case.wall_step_mm).floor();
    let wall_mm = (steps * case.wall_step_mm * WALLS_PER_MM).floor() / WALLS_PER_MM;
    if wall_mm < case.least_wall_mm {
        let words = format!(
            "thinner walls ({} would do at this size, and this printer makes none below {})",
            show_mm(greatest_mm),
            show_mm(case.least_wall_mm)
        );
        return Remedy::dead_end(Kind::GreatestWall, words);
    }
    let words = format!("make the wall {} or thinner at this size", show_mm(wall_mm));
    let change = Change {
        amount: wall_mm,
        settings: vec![Setting::new(Key::Wall, format!("{wall_mm}mm"))],
        words,
    };
    Remedy::helping(Kind::GreatestWall, change, trial)
}

/// Rounds up to three significant digits.
fn round_up(number: f64) -> f64 {
    let decimals = 2 - number.log10().floor() as i32;
    let unit = 10f64.powi(decimals);
    (number * unit).ceil() / unit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::GoalKind;

    #[test]
    fn places_in_mm_grow_with_the_model() {
        let top = Request {
            contact: Some(Contact::At([1.0, -2.0, 0.5])),
            ..Request::new(GoalKind::Top)
        };
        let moved = |request: &Request| places(request, &grown(request, 1.5));
        let contact = Setting::new(Key::Contact, "1.5,-3,0.75");
        assert_eq!(moved(&top), [contact]);
        assert_eq!(moved(&Request::new(GoalKind::Yoyo)), []);
    }

    #[test]
    fn a_size_is_rounded_up_to_three_digits() {
        for (number, rounded) in [
            (100.0, 100.0),
            (100.2, 101.0),
            (1234.0, 1240.0),
            (9.871, 9.88),
            (0.5, 0.5),
        ] {
            assert_eq!(round_up(number), rounded);
        }
    }
}
