//! The plots of the search: value and bound by pass, and a top's critical speed by height.

use super::figure::{Picture, Role};
use crate::base::numbers::quantity;
use crate::draw::{CURVES, Curve, Drawn, Plot, Spot};
use crate::sheet::{Checklist, Course, PassRow};

/// Draws the plots of the search; empty if it was not recorded.
pub(super) fn plots(sheet: &Checklist) -> Vec<Picture> {
    let Some(course) = &sheet.certificate.course else {
        return Vec::new();
    };
    certificate(sheet, course)
        .into_iter()
        .chain(speeds(sheet, course))
        .chain(trade(sheet, course))
        .collect()
}

fn certificate(sheet: &Checklist, course: &Course) -> Option<Picture> {
    let figure = sheet.certificate.figure;
    let pick = |value: fn(&PassRow) -> f64| {
        course
            .passes
            .iter()
            .enumerate()
            .map(|(index, row)| [index as f64, value(row)])
            .collect::<Vec<Spot>>()
    };
    let last = course.passes.last().filter(|_| course.passes.len() > 1)?;
    let plot = Plot {
        across: "pass over the columns".to_owned(),
        up: with_unit(figure.name(), figure.unit()),
        curves: vec![
            Curve {
                name: "found",
                points: pick(|row| row.value),
                color: CURVES[0],
                is_second: false,
            },
            Curve {
                name: "proved bound",
                points: pick(|row| row.bound),
                color: CURVES[1],
                is_second: true,
            },
        ],
        mark: None,
    };
    let met = quantity(last.value, figure.unit());
    Some(Picture {
        file: "pictures/certificate.svg".to_owned(),
        role: Role::Proof,
        caption: format!(
            "The search and its proof meet at {met}: what was found, and what nothing can beat, pass by pass on coarse columns. Until it is balanced, what is found may look better than it can be."
        ),
        alt: format!(
            "Plot of the {} found and of its proved bound over {} passes; both end at {met}.",
            figure.name(),
            course.passes.len()
        ),
        drawn: Drawn::Svg(plot.draw()),
    })
}

fn speeds(sheet: &Checklist, course: &Course) -> Option<Picture> {
    let points: Vec<Spot> = course
        .speeds
        .iter()
        .map(|row| [row.height_mm, row.critical_speed_rpm])
        .collect();
    let best = *points
        .iter()
        .min_by(|a, b| a[1].total_cmp(&b[1]))
        .filter(|_| points.len() > 1)?;
    let written = sheet
        .assembly
        .critical_speed_rpm
        .map(|rpm| [sheet.assembly.center_height_mm, rpm]);
    let plot = Plot {
        across: "height ℓ of the centre of mass over the contact, mm".to_owned(),
        up: "least critical speed, rpm".to_owned(),
        curves: vec![Curve {
            name: "best at that height",
            points,
            color: CURVES[0],
            is_second: false,
        }],
        mark: written.map(|at| (at, "this kit".to_owned())),
    };
    let [height, speed] = [quantity(best[0], "mm"), quantity(best[1], "rpm")];
    Some(Picture {
        file: "pictures/speed-by-height.svg".to_owned(),
        role: Role::Proof,
        caption: "The least speed at which a hollowing with its centre of mass at a height could spin, and this kit.".to_owned(),
        alt: format!("Plot of the least critical speed by the height of the centre of mass; least near {height} with {speed}."),
        drawn: Drawn::Svg(plot.draw()),
    })
}

/// Draws how much of a wished infill changes for how much of the figure.
fn trade(sheet: &Checklist, course: &Course) -> Option<Picture> {
    let trade = course.trade.as_ref()?;
    let percent = |&[change, value]: &Spot| [100.0 * change, value];
    let points: Vec<Spot> = trade.points.iter().map(percent).collect();
    if points.is_empty() {
        return None;
    }
    let written = sheet.assembly.value_of(trade.figure);
    let own = 100.0 * sheet.certificate.value;
    let (name, unit) = (trade.figure.name(), trade.figure.unit());
    let plot = Plot {
        across: "change of the infill, % of solid print (root mean square)".to_owned(),
        up: with_unit(name, unit),
        curves: vec![Curve {
            name: "least change",
            points,
            color: CURVES[0],
            is_second: false,
        }],
        mark: written.map(|value| ([own, value], "this kit".to_owned())),
    };
    let best = quantity(trade.best, unit);
    Some(Picture {
        file: "pictures/infill-trade.svg".to_owned(),
        role: Role::Proof,
        caption: format!(
            "What a {name} costs: the least change of the wished infill that reaches it, on coarse columns, and this kit. At any infill about {best} is possible."
        ),
        alt: format!("Plot of the {name} by the change of the infill; about {best} at best."),
        drawn: Drawn::Svg(plot.draw()),
    })
}

fn with_unit(name: &str, unit: &str) -> String {
    if unit.is_empty() {
        name.to_owned()
    } else {
        format!("{name}, {unit}")
    }
}
