//! Remedies for a curve that no telescope follows as asked, each confirmed by a design.

use serde::Serialize;

use super::asked::{Asked, measure};
use super::best::{Best, Reason, Refused, design};
use super::error::TelescopeRunError;
use super::footing::choose_order;
use super::load::Loaded;
use crate::ballast::Order;
use crate::base::numbers::measured;
use crate::base::setting::{Key, Setting};
use crate::base::units::Length;
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::job::telescope::{FootSize, Opening, ShellCount, Stance, TelescopeJob};
use crate::sheet::telescope::TradeRow;
use crate::telescope::limits::Limit;
use crate::wing::{Impossible, Remedy};

/// What an answer tells besides its reason.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Tried {
    /// The numbers of shells that were tried.
    pub rows: Vec<TradeRow>,
}

/// Factors by which a curve is made larger, in turn.
const LARGER: [f64; 4] = [1.25, 1.6, 2.0, 3.0];

/// Share by which a deviation or a radius is rounded up, so that it is reached again.
const ROUNDED_UP: f64 = 1.05;

/// Most remedies that are told.
const MOST_REMEDIES: usize = 3;

/// A change of the job.
struct Change {
    job: TelescopeJob,
    /// The factor by which the curve becomes larger.
    factor: f64,
    setting: Setting,
}

/// Tries changes that may help, and tells those that do.
pub fn remedies(
    asked: &Asked,
    refused: Refused,
    watch: &Watch,
) -> Result<Impossible<Tried>, TelescopeRunError> {
    watch.enter(Phase::Advise);
    let (mut remedies, mut tried) = (Vec::new(), Vec::new());
    for group in changes(asked, &refused.reason) {
        if remedies.len() >= MOST_REMEDIES {
            break;
        }
        let words = group
            .first()
            .map(|change| change.setting.key.word().to_owned());
        let mut found = None;
        for change in group {
            watch.check()?;
            if let Some(remedy) = confirm(asked, change, watch)? {
                found = Some(remedy);
                break;
            }
        }
        match found {
            Some(remedy) => remedies.push(remedy),
            None => tried.extend(words.map(|word| format!("another value of `{word} = …`"))),
        }
    }
    let hints = hints(&refused.reason);
    Ok(Impossible {
        hints,
        is_proved: refused.reason.is_proved(),
        remedies,
        tried,
        more: Tried { rows: refused.rows },
        ..Impossible::new(refused.reason.to_string())
    })
}

/// Returns what helps and is no setting.
fn hints(reason: &Reason) -> Vec<String> {
    match reason {
        Reason::Falls {
            foot_mm,
            ballast_g: Some(ballast_g),
            ..
        } => vec![format!(
            "glue {} of ballast, flat and in the middle, under a foot of {} in radius: by \
             calculation it then stands as asked",
            measured(ballast_g.ceil(), "g"),
            measured(*foot_mm, "mm")
        )],
        _ => Vec::new(),
    }
}

/// Returns the changes to try, in groups: of each, the first that helps is told.
fn changes(asked: &Asked, reason: &Reason) -> Vec<Vec<Change>> {
    let shells = |count: usize| {
        change(asked, Key::Shells, count, |job| {
            job.shells = ShellCount::Given(count);
        })
    };
    let auto = || {
        change(asked, Key::Shells, ShellCount::Auto, |job| {
            job.shells = ShellCount::Auto;
        })
    };
    let larger = || {
        LARGER
            .map(|factor| larger(asked, factor))
            .into_iter()
            .collect()
    };
    match reason {
        Reason::TooLong { fewest, .. } => vec![vec![shells(*fewest)]],
        Reason::Limit(Limit::Budget {
            needed_mm, most, ..
        }) => {
            let root = length(*needed_mm * ROUNDED_UP).map(|root| {
                change(asked, Key::RootRadius, root, |job| {
                    job.root_radius = Some(root);
                })
            });
            let fewer = (*most > 0).then(|| shells(*most));
            vec![root.into_iter().collect(), fewer.into_iter().collect()]
        }
        Reason::TooFar { deviation_mm, .. } => {
            let farther = length(deviation_mm * ROUNDED_UP);
            let farther = farther.map(|mm| {
                change(asked, Key::Deviation, mm, |job| {
                    job.deviation = Some(mm);
                })
            });
            vec![farther.into_iter().collect(), vec![auto()], larger()]
        }
        Reason::Falls { .. } | Reason::NoPocket { .. } => standing_changes(asked),
        Reason::UnderGround { .. } => {
            let held = change(asked, Key::Goal, Stance::None, |job| {
                job.goal = Stance::None;
            });
            vec![vec![held]]
        }
        Reason::TooLarge { .. } => Vec::new(),
        Reason::HangsInPlace { .. } => {
            let parts = change(asked, Key::InPlace, false, |job| job.in_place = false);
            vec![vec![auto()], vec![parts]]
        }
        Reason::Fit(_) => vec![vec![auto()]],
        Reason::Limit(_) | Reason::Collision(_) | Reason::Nest(_) => {
            vec![vec![auto()], larger()]
        }
    }
}

/// Returns the changes to try for what falls: a free foot, a free order, ballast.
fn standing_changes(asked: &Asked) -> Vec<Vec<Change>> {
    let foot = matches!(asked.job.foot, FootSize::Given(_)).then(|| {
        change(asked, Key::Foot, FootSize::Auto, |job| {
            job.foot = FootSize::Auto;
        })
    });
    let order = (asked.job.order != Opening::Auto).then(|| {
        change(asked, Key::Order, Opening::Auto, |job| {
            job.order = Opening::Auto;
        })
    });
    let is_capped = !asked.job.in_place && asked.job.ballast.is_none();
    let is_named = matches!(asked.job.ballast, Order::Parts { .. });
    let ballast = (is_capped || is_named).then(|| {
        change(asked, Key::Ballast, Order::Auto, |job| {
            job.ballast = Order::Auto;
        })
    });
    [foot, order, ballast]
        .map(|one| one.into_iter().collect())
        .into()
}

fn length(mm: f64) -> Option<Length> {
    // Rounded up to what a person types.
    Length::from_mm((mm * 10.0).ceil() / 10.0).ok()
}

fn change(
    asked: &Asked,
    key: Key,
    value: impl std::fmt::Display,
    set: impl FnOnce(&mut TelescopeJob),
) -> Change {
    let mut job = asked.job.clone();
    set(&mut job);
    Change {
        job,
        factor: 1.0,
        setting: Setting::new(key, value),
    }
}

/// Returns the change that makes a curve larger, told as the longest side of its box.
fn larger(asked: &Asked, factor: f64) -> Change {
    let size = crate::geom::Aabb::of_points(asked.curve.points())
        .size()
        .max();
    let size_mm = (factor * size).ceil();
    Change {
        job: asked.job.clone(),
        factor: size_mm / size,
        setting: Setting::new(Key::Size, format!("{size_mm}mm")),
    }
}

/// Designs with a change; returns it if it helps.
fn confirm(
    asked: &Asked,
    change: Change,
    watch: &Watch,
) -> Result<Option<Remedy>, TelescopeRunError> {
    let is_no_change = change.factor == 1.0 && change.job == *asked.job;
    if is_no_change {
        return Ok(None);
    }
    let curve = asked
        .curve
        .scaled_to(asked.curve.length_mm() * change.factor);
    let loaded = Loaded {
        curve,
        file: asked.file.clone(),
    };
    let Ok(anew) = measure(&change.job, asked.shop, &loaded) else {
        return Ok(None);
    };
    let Verdict::Found(best) = design(&anew, watch)? else {
        return Ok(None);
    };
    if !stands(&anew, &best)? {
        return Ok(None);
    }
    Ok(Some(Remedy {
        words: words(&best),
        settings: vec![change.setting],
    }))
}

/// Returns true if a design stands as asked, or need not.
fn stands(asked: &Asked, best: &Best) -> Result<bool, TelescopeRunError> {
    if !asked.stands() {
        return Ok(true);
    }
    let design = &best.design;
    let masses = design.telescope.weigh()?;
    let standing = choose_order(asked, &design.telescope, &design.opening, &masses)?;
    Ok(standing.found().is_some())
}

fn words(best: &Best) -> String {
    let design = &best.design;
    format!(
        "gives {} shells with a root of {:.1} mm in radius, {:.2} mm off the curve",
        design.telescope.shells.len(),
        design.telescope.shells[0].body_mm,
        design.fit.deviation.max_mm
    )
}
