//! `equipoise verify` with G-code: tells how a print will balance before it is printed.

use super::show::{GREEN, RED, paint, table};
use super::summary::{checks_table, summary};
use super::voice::Manner;
use crate::base::numbers::{coordinates, quantity, quantity_or_dash};
use crate::verify::{Cause, Figures, PrintedJudgement, PrintedPart};

/// A figure of the whole object.
struct Row {
    name: &'static str,
    unit: &'static str,
    of: fn(&Figures) -> Option<f64>,
}

/// The figures of whole objects, for every goal; those that a goal does not have are left out.
const ROWS: [Row; 14] = [
    Row {
        name: "mass",
        unit: "g",
        of: |figures| Some(figures.mass_g),
    },
    Row {
        name: "centre, x",
        unit: "mm",
        of: |figures| Some(figures.center_mm[0]),
    },
    Row {
        name: "centre, y",
        unit: "mm",
        of: |figures| Some(figures.center_mm[1]),
    },
    Row {
        name: "centre, z",
        unit: "mm",
        of: |figures| Some(figures.center_mm[2]),
    },
    Row {
        name: "height of the centre",
        unit: "mm",
        of: |figures| Some(figures.center_height_mm),
    },
    Row {
        name: "centre off the axis",
        unit: "mm",
        of: |figures| figures.axis_offset_mm,
    },
    Row {
        name: "tilt of the axis",
        unit: "°",
        of: |figures| figures.axis_tilt_deg,
    },
    Row {
        name: "I_b/I_c",
        unit: "",
        of: |figures| figures.dominance_ratio,
    },
    Row {
        name: "critical speed",
        unit: "rpm",
        of: |figures| figures.critical_speed_rpm,
    },
    Row {
        name: "toppling angle",
        unit: "°",
        of: |figures| figures.topples_deg,
    },
    Row {
        name: "waterline",
        unit: "mm",
        of: |figures| figures.afloat.map(|afloat| afloat.waterline_mm),
    },
    Row {
        name: "centre off the buoyancy",
        unit: "mm",
        of: |figures| figures.afloat.map(|afloat| afloat.offset_mm),
    },
    Row {
        name: "metacentric height",
        unit: "mm",
        of: |figures| figures.afloat.map(|afloat| afloat.metacentric_height_mm),
    },
    Row {
        name: "balance grade",
        unit: "mm/s",
        of: |figures| figures.unbalance.map(|unbalance| unbalance.grade_mm_s),
    },
];

/// Returns the findings: the parts, the whole, the causes, the notes and the verdict.
pub(super) fn toolpaths_text(found: &PrintedJudgement, manner: Manner) -> String {
    let mut text = parts_table(&found.parts) + "\n" + &whole_table(found) + "\n";
    for cause in &found.causes {
        text += &cause_text(cause, manner);
    }
    for note in &found.notes {
        text += &format!("note: {note}\n");
    }
    if manner.verbose > 0 || !found.passes() {
        text += &checks_table(&found.checks, manner);
    }
    (text + &summary(&found.checks, manner) + "\n").replace('\u{a0}', " ")
}

/// Returns the masses and centres of the parts.
fn parts_table(parts: &[PrintedPart]) -> String {
    let head = [
        "part",
        "mass written",
        "toolpaths",
        "difference",
        "centre written",
        "toolpaths",
        "difference",
    ];
    let row = |part: &PrintedPart| {
        [
            part.id.clone(),
            quantity(part.written_mass_g, "g"),
            quantity(part.mass_g, "g"),
            format!("{:+.2} %", part.mass_off_ratio() * 100.0),
            coordinates(&part.written_center_mm),
            coordinates(&part.center_mm),
            quantity(part.center_off_mm, "mm"),
        ]
    };
    let rows: Vec<[String; 7]> = std::iter::once(head.map(str::to_owned))
        .chain(parts.iter().map(row))
        .collect();
    table(&rows)
}

/// Returns the figures of the whole: promised, of the model, of the written parts, of the
/// toolpaths.
fn whole_table(found: &PrintedJudgement) -> String {
    let Some(toolpaths) = &found.toolpaths else {
        return "The whole cannot be weighed before every part is there.\n".to_owned();
    };
    let head = ["whole", "model", "written parts", "toolpaths", "difference"];
    let row = |row: &Row| {
        let values = [&found.model, &found.written, toolpaths].map(row.of);
        let [_, written, printed] = values;
        let is_there = values.iter().any(Option::is_some);
        let off = written.zip(printed).map(|(a, b)| b - a);
        let [model, written, printed] = values.map(|value| quantity_or_dash(value, row.unit));
        is_there.then(|| {
            [
                row.name.to_owned(),
                model,
                written,
                printed,
                quantity_or_dash(off, row.unit),
            ]
        })
    };
    let rows: Vec<[String; 5]> = std::iter::once(head.map(str::to_owned))
        .chain(ROWS.iter().filter_map(row))
        .collect();
    let promise = found.promise.map(|promised| {
        let value = quantity(promised.value, promised.figure.unit());
        let printed = toolpaths.value_of(promised.figure);
        let printed = quantity_or_dash(printed, promised.figure.unit());
        format!(
            "promise: {} {value}; by the toolpaths {printed}\n",
            promised.figure.promise()
        )
    });
    table(&rows) + &promise.unwrap_or_default()
}

/// Returns a cause and the setting to change.
fn cause_text(cause: &Cause, manner: Manner) -> String {
    let label = if cause.is_wrong {
        paint("FAIL", RED, manner.is_output_coloured)
    } else {
        "heed".to_owned()
    };
    let file = cause.file.as_ref();
    let file = file.map_or(String::new(), |file| format!(" ({file})"));
    format!(
        "{label} {}: {}{file}\n  {}: {}\n",
        cause.kind.name(),
        cause.finding,
        paint("remedy", GREEN, manner.is_output_coloured),
        cause.remedy
    )
}
