//! The greatest wall at this size, and with it the least size at this wall.

use super::case::Case;
use super::confirm::least_excess;
use super::directions::round_to;
use super::remedy::{Change, Kind, Remedy};
use super::sampled_model::{SampledModel, Trial};
use crate::base::setting::{Key, Setting};
use crate::base::units::{Length, show_mm};
use crate::goal::{Contact, Request, SpinPoint, Waterline};

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
/// can be typed and printed, which leaves even more to be emptied.
pub(super) fn remedies(model: &SampledModel) -> Vec<Remedy> {
    let case = &model.case;
    let Some(thickest_mm) = greatest_wall(model) else {
        let words = format!(
            "also tried, without success: other walls, and up to {MOST_TIMES} times the size"
        );
        return vec![Remedy::dead_end(Kind::LeastSize, words)];
    };
    match confirm_wall(model, thickest_mm) {
        Some((wall_mm, trial)) => vec![
            larger(case, wall_mm, &trial),
            thinner(case, wall_mm, &trial),
        ],
        None => {
            let words = "no size was found that helps with certainty: it stays at the border of the possible";
            vec![Remedy::dead_end(Kind::LeastSize, words.to_owned())]
        }
    }
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

fn larger(case: &Case, greatest_mm: f64, trial: &Trial) -> Remedy {
    let size_mm = size_for(case, greatest_mm, case.wall_mm);
    if size_mm > case.greatest_size_mm {
        let words = format!(
            "with the wall of {} only {} or larger would do, and a kit for this printer may be {} \
             at most",
            show_mm(case.wall_mm),
            show_mm(size_mm),
            show_mm(case.greatest_size_mm)
        );
        return Remedy::dead_end(Kind::LeastSize, words);
    }
    let thinner = (case.least_wall_mm < case.wall_mm).then(|| {
        let least_mm = case.least_wall_mm;
        let size_mm = size_for(case, greatest_mm, least_mm);
        format!(
            " ({} with the thinnest wall this printer makes, {})",
            show_mm(size_mm),
            show_mm(least_mm)
        )
    });
    let words = format!(
        "make it {} or larger with the wall of {}{}",
        show_mm(size_mm),
        show_mm(case.wall_mm),
        thinner.unwrap_or_default()
    );
    let times = size_mm / case.solid.mesh().longest_side_mm();
    let mut settings = vec![Setting::new(Key::Size, format!("{size_mm}mm"))];
    settings.extend(scale_places(&case.request, times));
    let change = Change {
        amount: size_mm,
        settings,
        words,
    };
    Remedy::helping(Kind::LeastSize, change, trial)
}

/// Returns the options that keep places given in mm where they are on a model this many times as
/// large.
fn scale_places(request: &Request, times: f64) -> Vec<Setting> {
    let point = |at: [f64; 3]| round_to(at.map(|coordinate| coordinate * times), 4);
    let length = |length: Length| format!("{:.3}mm", length.mm() * times);
    let contact = match request.contact {
        Some(Contact::At(at)) => Some(Setting::new(Key::Contact, Contact::At(point(at)))),
        _ => None,
    };
    let spin_point = match request.spin_point {
        Some(SpinPoint::At(at)) => Some(Setting::new(Key::SpinPoint, SpinPoint::At(point(at)))),
        _ => None,
    };
    let waterline = match request.water.map(|water| water.waterline) {
        Some(Waterline::At(line)) => Some(Setting::new(Key::Waterline, length(line))),
        _ => None,
    };
    let bore = request.rotor.and_then(|rotor| rotor.bore);
    let bore = bore.map(|bore| Setting::new(Key::Bore, length(bore)));
    let places = [contact, spin_point, waterline, bore];
    places.into_iter().flatten().collect()
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
            "at this size only a wall of {} or thinner would do, and this printer makes none \
             below {}",
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
        let contact = Setting::new(Key::Contact, "1.5,-3,0.75");
        assert_eq!(scale_places(&top, 1.5), [contact]);
        assert_eq!(scale_places(&Request::new(GoalKind::Yoyo), 1.5), []);
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
