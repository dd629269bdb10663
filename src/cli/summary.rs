//! The result of `prepare` for a person: ten lines, or with `-v` every check and the solver's
//! steps.

use super::args::{Request, again};
use super::bars::words as stage_name;
use super::bound::bound_words;
use super::flags::{OTHER_PLANS, with_flags};
use super::if_solid::solid_words;
use super::print_time::{PRINT_TIME, print_time_words};
use super::show::{GREEN, RED, paint, table, verdict};
use super::voice::Manner;
use crate::base::numbers::{measured, measured_extent, quantity as figure, rough};
use crate::base::units::format_count;
use crate::base::watch::Phase;
use crate::page::{bought, pieces, promise, properties, shortfall, spins_on, wanted_figures};
use crate::sheet::{Checklist, Course, LogRow, PassRow, Taker};
use crate::verify::{Check, SHEET_FILE};

/// Least length in mm or angle in degrees that is shown. Nobody prints or balances so exactly.
const MIN_SHOWN_OFFSET: f64 = 0.001;
/// The order in which a person reads the solver's numbers.
const STEP_NUMBERS: [&str; 4] = ["passes", "value", "bound", "residual"];

/// Returns the kit in ten lines, and below them the broken promises in full.
pub fn ten_lines(checklist: &Checklist, request: &Request, manner: Manner) -> String {
    let lines = [
        Some(("what it does", deed(checklist))),
        wanted_figures(checklist).map(|wanted| ("wanted", properties(&wanted))),
        reached(checklist).map(|words| ("reached", words)),
        Some(("if solid", solid_words(checklist))),
        Some(("how good", bound_words(checklist))),
        shortfall_words(checklist, &request.typed).map(|words| ("short of best", words)),
        balance(checklist).map(|words| ("balance", words)),
        Some((
            "mass, size",
            format!("{}; {}", masses(checklist), size(checklist)),
        )),
        checklist
            .print_time
            .as_ref()
            .map(|row| (PRINT_TIME, print_time_words(row))),
        wall(checklist).map(|words| ("wall", words)),
        Some(("parts", parts(checklist))),
        offer(checklist, &request.typed).map(|words| ("other plan", words)),
        Some(("verdict", summary(&checklist.checks, manner))),
        checklist
            .timing_s
            .as_ref()
            .map(|timing| ("time", times(timing.total_s(), &timing.0))),
        Some((
            "job sheet",
            request.out.join(SHEET_FILE).display().to_string(),
        )),
    ];
    let rows: Vec<[String; 2]> = lines
        .into_iter()
        .flatten()
        .map(|(name, words)| [name.to_owned(), words])
        .collect();
    // Non-breaking blanks are for pages; on a terminal they get in the way of a search.
    table(&rows).replace('\u{a0}', " ") + &broken(&checklist.checks, manner)
}

/// Returns the offers of other plans and how to choose one; `None` if there is none.
fn offer(checklist: &Checklist, typed: &[String]) -> Option<String> {
    let offers = checklist.offers.iter().map(|offer| with_flags(offer));
    let offers: Vec<String> = offers.collect();
    (!offers.is_empty()).then(|| format!("{}. {}", offers.join("; "), to_other_plans(typed)))
}

/// Returns what the object does, and for a top on what it spins.
fn deed(checklist: &Checklist) -> String {
    let on = spins_on(checklist).map_or(String::new(), |on| format!(" It spins on {on}."));
    promise(checklist) + &on
}

/// Returns what took a tenth or more of the best figure, and what to try; `None` if the kit is
/// nearer to it.
fn shortfall_words(checklist: &Checklist, typed: &[String]) -> Option<String> {
    let words = shortfall(checklist)?;
    let has = |taker: Taker| {
        let taken = checklist
            .shortfall()
            .map_or(Vec::new(), |short| short.taken);
        taken.iter().any(|taken| taken.by == taker)
    };
    // The line on other plans names the command, too, and what is made of cells has no cuts.
    let is_told = !has(Taker::Cleaning) || !checklist.offers.is_empty();
    let is_told = is_told || checklist.cells.is_some();
    let plans = (!is_told).then(|| format!(" {}", to_other_plans(typed)));
    Some(words + &plans.unwrap_or_default())
}

/// Returns the command that draws other plans with their figures, in words.
fn to_other_plans(typed: &[String]) -> String {
    let command = again(typed, "cuts", "").unwrap_or_else(|| OTHER_PLANS.to_owned());
    format!("To see other plans and choose one: {command}")
}

/// Returns the mass properties that a match reaches; `None` for other goals.
fn reached(checklist: &Checklist) -> Option<String> {
    let is_match = checklist.goal.aim.wanted.is_some();
    is_match.then(|| properties(&checklist.assembly))
}

fn balance(checklist: &Checklist) -> Option<String> {
    let offset_mm = checklist.assembly.axis_offset_mm?;
    let tilt = checklist
        .assembly
        .axis_tilt_deg
        .map_or(String::new(), |tilt| {
            format!(", its principal axis {} off", small(tilt, "°"))
        });
    Some(format!(
        "centre of mass {} from the axis{tilt}",
        small(offset_mm, "mm")
    ))
}

/// Returns a value that should be zero, no more exactly than it can be made.
fn small(value: f64, unit: &str) -> String {
    if value < MIN_SHOWN_OFFSET {
        format!("less than {}", figure(MIN_SHOWN_OFFSET, unit))
    } else {
        rough(value, unit)
    }
}

/// Returns the size of the finished object along the model's axes.
fn size(checklist: &Checklist) -> String {
    measured_extent(
        &checklist
            .finished_size_mm
            .unwrap_or(checklist.model.size_mm),
    )
}

fn masses(checklist: &Checklist) -> String {
    let printed_g: f64 = checklist.parts.iter().map(|part| part.mass_g).sum();
    let whole_g = checklist.assembly.mass_g;
    let is_all = measured(whole_g, "g") == measured(printed_g, "g");
    let besides = if is_all {
        String::new()
    } else {
        format!("; {} with all that is added", measured(whole_g, "g"))
    };
    format!(
        "{} of {}{besides}",
        measured(printed_g, "g"),
        checklist.material.name
    )
}

fn wall(checklist: &Checklist) -> Option<String> {
    let thinnest_mm = checklist.wall.measured_min_mm?;
    let made = figure(checklist.wall.required_mm, "mm");
    let made = if checklist.wall.asked_mm.is_some() {
        format!("{made} ordered")
    } else {
        format!("planned {made}")
    };
    Some(format!("{thinnest_mm:.2}\u{a0}mm at its thinnest ({made})"))
}

fn parts(checklist: &Checklist) -> String {
    let bought = bought(checklist).map_or(String::new(), |words| format!("; {words}"));
    let plates = checklist.plate_files().count();
    let plates = if plates > 0 {
        format!(" on {}", format_count(plates, "plate"))
    } else {
        String::new()
    };
    format!(
        "{}{plates} for {}{bought}",
        pieces(checklist),
        checklist.printer.name
    )
}

/// Returns the time of a run, and of the two phases that took most of it.
fn times(total_s: f64, stages: &[(String, f64)]) -> String {
    let mut longest: Vec<&(String, f64)> = stages.iter().collect();
    longest.sort_by(|a, b| b.1.total_cmp(&a.1));
    let most: Vec<String> = longest
        .iter()
        .take(2)
        .map(|(stage, seconds)| format!("{} {seconds:.1} s", stage_words(stage)))
        .collect();
    format!("{total_s:.1} s, most of it {}", most.join(" and "))
}

/// Returns the plain words for the key of a phase.
fn stage_words(key: &str) -> String {
    let phase = Phase::ALL.into_iter().find(|phase| phase.key() == key);
    phase.map_or(key, |phase| stage_name(phase)).to_owned()
}

/// Returns the number of promises kept and broken, in words.
pub fn summary(checks: &[Check], manner: Manner) -> String {
    let broken = checks.iter().filter(|check| !check.pass).count();
    let kept = format!(
        "{} of {} promises kept",
        checks.len() - broken,
        checks.len()
    );
    let words = if broken == 0 {
        kept
    } else {
        format!("{kept}, {broken} BROKEN")
    };
    paint(
        &words,
        if broken == 0 { GREEN } else { RED },
        manner.is_output_coloured,
    )
}

/// Returns a table of the broken promises; empty if all are kept.
pub fn broken(checks: &[Check], manner: Manner) -> String {
    let failed: Vec<Check> = checks.iter().filter(|check| !check.pass).cloned().collect();
    if failed.is_empty() {
        String::new()
    } else {
        checks_table(&failed, manner)
    }
}

/// Returns a table of the checks: promise, measured value, limit, verdict.
pub fn checks_table(checks: &[Check], manner: Manner) -> String {
    let head = ["promise", "measured", "limit", "verdict"].map(str::to_owned);
    let row = |check: &Check| {
        let measured = check
            .value
            .map_or("none".to_owned(), |value| quantity(value, &check.unit));
        let detail = check.detail.as_ref().filter(|_| !check.pass);
        [
            check.promise.clone(),
            measured,
            format!(
                "{} {}",
                check.comparison.sign(),
                quantity(check.limit, &check.unit)
            ),
            verdict(check.pass, manner.is_output_coloured)
                + &detail.map_or(String::new(), |at| format!(" ({at})")),
        ]
    };
    let rows: Vec<[String; 4]> = std::iter::once(head)
        .chain(checks.iter().map(row))
        .collect();
    table(&rows)
}

/// Returns four significant digits, or all digits of an integer.
fn quantity(value: f64, unit: &str) -> String {
    let number = match value.abs() {
        magnitude if magnitude == 0.0 || (value.fract() == 0.0 && magnitude < 1e6) => {
            format!("{value}")
        }
        magnitude if magnitude >= 100.0 => format!("{value:.1}"),
        magnitude if magnitude >= 0.01 => figure(value, ""),
        _ => format!("{value:.2e}"),
    };
    match unit {
        "" | "°" => number + unit,
        _ => format!("{number} {unit}"),
    }
}

/// Returns every check, the certificate, the time of each phase, and the solver's steps.
pub fn details(checklist: &Checklist, manner: Manner) -> String {
    let certificate = &checklist.certificate;
    let mut text = checks_table(&checklist.checks, manner);
    text += &format!(
        "certificate: value {:.6}, bound {:.6}, gap {:.1e}\n",
        certificate.value, certificate.bound, certificate.gap_ratio
    );
    let stages = checklist.timing_s.iter().flat_map(|timing| &timing.0);
    let stages: Vec<[String; 2]> = stages
        .map(|(stage, seconds)| [stage.clone(), format!("{seconds:.3} s")])
        .collect();
    text += &table(&stages);
    for note in &checklist.notes {
        text += &format!("note: {note}\n");
    }
    text + &steps(&checklist.log)
        + &certificate
            .course
            .as_ref()
            .map_or(String::new(), iterations)
}

/// Returns the solver's steps, a row each, with a column for every number that any of them has.
fn steps(log: &[LogRow]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for name in log.iter().flat_map(|row| row.figures.keys()) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names.sort_by_key(|name| {
        STEP_NUMBERS
            .iter()
            .position(|known| known == name)
            .unwrap_or(STEP_NUMBERS.len())
    });
    let head = std::iter::once("step")
        .chain(names.iter().copied())
        .map(str::to_owned)
        .collect();
    let row = |row: &LogRow| -> Vec<String> {
        let cells = names.iter().map(|name| {
            row.figures
                .get(*name)
                .map_or(String::new(), |value| step_number(*value))
        });
        std::iter::once(row.phase.clone()).chain(cells).collect()
    };
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(log.iter().map(row)).collect();
    if log.is_empty() {
        String::new()
    } else {
        table(&rows)
    }
}

/// Returns value and bound of the solver's last ascent on coarse columns, pass by pass.
fn iterations(course: &Course) -> String {
    let head = ["pass on coarse columns", "value", "bound"].map(str::to_owned);
    let row = |(index, pass): (usize, &PassRow)| {
        [
            index.to_string(),
            step_number(pass.value),
            step_number(pass.bound),
        ]
    };
    let rows: Vec<[String; 3]> = std::iter::once(head)
        .chain(course.passes.iter().enumerate().map(row))
        .collect();
    if course.passes.is_empty() {
        String::new()
    } else {
        table(&rows)
    }
}

/// Returns a count as it is, any other number to seven digits.
fn step_number(value: f64) -> String {
    let is_count = value.fract() == 0.0 && value.abs() < 1e6;
    if is_count {
        format!("{value}")
    } else {
        format!("{value:.6e}")
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::testing::{sample, steel_tip};
    use crate::verify::{CheckKind, Limit};

    const PLAIN: Manner = Manner {
        quiet: false,
        verbose: 0,
        is_terminal: false,
        may_ask: false,
        is_coloured: false,
        is_output_coloured: false,
        output_columns: None,
    };

    fn row(phase: &str, figures: &[(&str, f64)]) -> LogRow {
        let figures: BTreeMap<String, f64> = figures
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect();
        LogRow {
            phase: phase.to_owned(),
            figures,
        }
    }

    #[test]
    fn value_and_bound_are_shown_pass_by_pass_if_they_were_recorded() {
        let pass = |value, bound| PassRow { value, bound };
        let course = Course {
            passes: vec![pass(2.5, 0.5), pass(1.5, 1.5)],
            speeds: vec![],
            trade: None,
        };
        assert_eq!(
            iterations(&course),
            "pass on coarse columns  value       bound\n0                       2.500000e0  5.000000e-1\n1                       1.500000e0  1.500000e0\n"
        );
        assert_eq!(iterations(&Course::default()), "");
    }

    #[test]
    fn the_table_of_steps_has_a_column_for_every_number_and_gaps() {
        let text = steps(&[
            row("first", &[("passes", 3.0)]),
            row("second", &[("bound", 0.5), ("passes", 12.0)]),
        ]);
        assert_eq!(
            text,
            "step    passes  bound\nfirst   3\nsecond  12      5.000000e-1\n"
        );
        assert_eq!(steps(&[]), "");
    }

    #[test]
    fn an_offer_of_another_plan_ends_with_the_command_that_draws_it() {
        let mut sheet = sample().0;
        sheet.offers = vec!["with 2 parts in place of 4 it stands".to_owned()];
        let typed = ["equipoise", "prepare", "a.stl", "--goal=stand"].map(str::to_owned);
        assert_eq!(
            offer(&sheet, &typed).unwrap(),
            "with 2 parts in place of 4 it stands. \
             To see other plans and choose one: equipoise cuts a.stl --goal=stand"
        );
        let short = shortfall_words(&sheet, &typed).unwrap_or_default();
        assert!(!short.contains("equipoise"), "said once: {short}");
    }

    #[test]
    fn what_is_not_printed_lies_on_no_plate() {
        let mut sheet = sample().0;
        sheet.files.insert("plate.3mf".to_owned(), String::new());
        sheet.hardware.push(steel_tip());
        let said = parts(&sheet);
        assert!(said.contains("1 glue joint"), "{said}");
        assert!(said.contains("; to buy: tip (steel rod, "), "{said}");
    }

    #[test]
    fn failed_checks_are_shown_in_full_and_passed_ones_are_counted() {
        let check = |promise: &str, value| {
            Check::new(
                CheckKind::Wall,
                promise,
                Some(value),
                Limit::at_most(1.0, "mm"),
            )
        };
        let checks = [
            check("one", 0.5),
            check("two", 2.0).at(Some("at P01".into())),
        ];
        assert_eq!(summary(&checks, PLAIN), "1 of 2 promises kept, 1 BROKEN");
        let table = broken(&checks, PLAIN);
        assert!(
            table.contains("two") && table.contains("FAIL (at P01)") && !table.contains("one"),
            "{table}"
        );
        assert_eq!(broken(&checks[..1], PLAIN), "");
        assert_eq!(summary(&checks[..1], PLAIN), "1 of 1 promises kept");
    }
}
