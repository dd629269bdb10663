//! `equipoise scale-extrusion`: toolpaths whose density follows a field.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::{FieldChoice, ScaleArgs};
use super::exit::Exit;
use super::new_files::{NewFileError, check_free, draft};
use super::show::{say, table};
use super::signals::Stop;
use super::voice::Voice;
use crate::base::numbers::quantity;
use crate::base::watch::Watch;
use crate::field::FileError;
use crate::job::InfillDensity;
use crate::slice::{ScaleError, ScaleOrder, Scaled, Tilt, off_mm, scale_toolpaths, trim};
use crate::verify::{Check, Figures, PrintedError, PrintedJudgement, PrintedPart, verify_printed};

/// Most times that toolpaths are trimmed.
const PASSES: usize = 4;
/// A centre this near to its place is there, mm: a tenth of what a round of slicing may miss.
const TRIMMED_MM: f64 = 0.002;

/// A reason why no toolpaths were written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScaleCommandError {
    /// The field cannot be read.
    #[error(transparent)]
    Field(#[from] FileError),
    /// The toolpaths cannot be scaled.
    #[error(transparent)]
    Scale(#[from] ScaleError),
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] NewFileError),
    /// The toolpaths cannot be weighed.
    #[error(transparent)]
    Printed(#[from] PrintedError),
    /// The file to write is the one to read.
    #[error("{} would be overwritten while it is read; remedy: write another file", .0.display())]
    Same(PathBuf),
    /// The result cannot be put into JSON.
    #[error("the result cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
}

/// The findings as they are printed as JSON.
#[derive(Serialize)]
struct Found<'a> {
    file: &'a Path,
    scaled: &'a Scaled,
    /// The parts as the slicer lays them, and as they are laid now.
    parts: Vec<[&'a PrintedPart; 2]>,
    /// All parts together, before and after; `None` if another plate holds some of them.
    together: Option<[&'a Figures; 2]>,
    /// The distance of the centre of toolpaths that follow the kit's own field from that of the
    /// kit's files, mm; `None` beside other parts.
    off_mm: Option<f64>,
    /// The promises of the goal that toolpaths break if they follow the kit's own field.
    broken: Vec<&'a Check>,
}

/// Scales toolpaths, weighs them before and after, and prints what changed to `out`.
///
/// # Errors
/// The field, the kit or the toolpaths cannot be used, or the file cannot be written.
pub fn scale_extrusion(
    args: &ScaleArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, ScaleCommandError> {
    check_free(&args.out, args.force)?;
    let is_same = |path: &Path| path.canonicalize().ok();
    if args.out.exists() && is_same(&args.out) == is_same(&args.toolpaths) {
        return Err(ScaleCommandError::Same(args.out.clone()));
    }
    let watch = Watch::silent_until(stop.flag());
    let order = ScaleOrder {
        toolpaths: args.toolpaths.clone(),
        kit: args.kit.clone(),
        field: args.field.as_ref().map(FieldChoice::order).transpose()?,
        infill_ratio: args.infill.map(InfillDensity::ratio),
        most_flow_mm3_s: args.most_flow,
        tilt: None,
    };
    let written = write(&order, &args.out, &watch);
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let (scaled, [before, after]) = written?;
    let parts = before.parts.iter().filter_map(|part| {
        let now = after.parts.iter().find(|now| now.id == part.id)?;
        Some([part, now])
    });
    let found = Found {
        file: &args.out,
        scaled: &scaled,
        parts: parts.collect(),
        together: before
            .toolpaths
            .as_ref()
            .zip(after.toolpaths.as_ref())
            .map(|(a, b)| [a, b]),
        off_mm: scaled.free.and_then(|_| off_mm(&after)),
        broken: if args.field.is_none() {
            after.broken_goals().collect()
        } else {
            Vec::new()
        },
    };
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&found)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&found))?;
    } else if !found.broken.is_empty() {
        say(broken_text(&found).trim_end());
    }
    Ok(if found.broken.is_empty() {
        Exit::Kept
    } else {
        Exit::NotKept
    })
}

/// Words the promises of the goal that are broken; empty if none is.
fn broken_text(found: &Found) -> String {
    let broken = found.broken.iter().map(|check| {
        let value = check
            .value
            .map_or("none".to_owned(), |value| quantity(value, &check.unit));
        format!("broken: {} {value}\n", check.promise)
    });
    let broken: String = broken.collect();
    if broken.is_empty() {
        return broken;
    }
    format!(
        "{broken}warning: do not print these toolpaths\n  remedy: print the kit's own plate, or \
         prepare the kit with more to spare\n"
    )
}

/// Writes the scaled toolpaths under another name first, so that nothing half-written is left.
/// Returns the weight of the toolpaths before and after, too.
fn write(
    order: &ScaleOrder,
    path: &Path,
    watch: &Watch,
) -> Result<(Scaled, [PrintedJudgement; 2]), ScaleCommandError> {
    let refused = |source| NewFileError::Write {
        path: path.to_owned(),
        source,
    };
    let draft = draft(path);
    let written = trimmed(order, &draft, watch).and_then(|(scaled, after)| {
        let before = weigh(order, &order.toolpaths, watch)?;
        fs::rename(&draft, path).map_err(refused)?;
        Ok((scaled, [before, after]))
    });
    if written.is_err() {
        // The fault that matters is reported, not that of removing the draft.
        let _ = fs::remove_file(&draft);
    }
    written
}

/// Toolpaths as they were scaled, with their weight.
struct Pass {
    scaled: Scaled,
    judged: PrintedJudgement,
    /// The tilt that should bring them nearer.
    next: Option<Tilt>,
}

/// Scales toolpaths into a draft until their centre lies where the kit has it.
///
/// It ends earlier if the centre comes no nearer, or if more of the goal would break.
fn trimmed(
    order: &ScaleOrder,
    draft: &Path,
    watch: &Watch,
) -> Result<(Scaled, PrintedJudgement), ScaleCommandError> {
    let tilted = |tilt| ScaleOrder {
        tilt,
        ..order.clone()
    };
    let mut best = pass(order, draft, watch)?;
    for _ in 0..PASSES {
        let is_near = off_mm(&best.judged).is_none_or(|mm| mm <= TRIMMED_MM);
        let Some(tilt) = best.next.filter(|_| !is_near) else {
            break;
        };
        let next = pass(&tilted(Some(tilt)), draft, watch)?;
        if !is_better(&next.judged, &best.judged) {
            best = pass(&tilted(best.scaled.tilt), draft, watch)?;
            break;
        }
        best = next;
    }
    Ok((best.scaled, best.judged))
}

/// Returns true if the centre came nearer, and no more of the goal breaks.
fn is_better(next: &PrintedJudgement, best: &PrintedJudgement) -> bool {
    let is_nearer = off_mm(next).zip(off_mm(best)).is_some_and(|(a, b)| a < b);
    is_nearer && next.broken_goals().count() <= best.broken_goals().count()
}

/// Scales toolpaths into a draft, and weighs it.
fn pass(order: &ScaleOrder, draft: &Path, watch: &Watch) -> Result<Pass, ScaleCommandError> {
    let refused = |source| NewFileError::Write {
        path: draft.to_owned(),
        source,
    };
    let mut output = BufWriter::new(File::create(draft).map_err(refused)?);
    let scaled = scale_toolpaths(order, &mut output, watch)?;
    output.flush().map_err(refused)?;
    let judged = weigh(order, draft, watch)?;
    let free = scaled.free.as_ref();
    let next = free.and_then(|free| trim(free, &judged, scaled.tilt));
    Ok(Pass {
        scaled,
        judged,
        next,
    })
}

/// Weighs toolpaths against the kit.
fn weigh(order: &ScaleOrder, file: &Path, watch: &Watch) -> Result<PrintedJudgement, PrintedError> {
    verify_printed(&order.kit, &[file.to_owned()], watch)
}

/// Words what was scaled, and what the parts weigh before and after.
fn text(found: &Found) -> String {
    let written = &found.scaled.written;
    let head = ["part", "mass sliced", "scaled", "centre sliced", "scaled"];
    let center = |part: &PrintedPart| part.center_mm.map(|mm| format!("{mm:.3}")).join(", ");
    let rows = found.parts.iter().map(|[before, after]| {
        vec![
            before.id.clone(),
            quantity(before.mass_g, "g"),
            quantity(after.mass_g, "g"),
            format!("{} mm", center(before)),
            format!("{} mm", center(after)),
        ]
    });
    let head = head.map(str::to_owned).to_vec();
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    let [least, most] = written.factors;
    let mut said = format!(
        "{}{} lines of infill in {} pieces, laid {least:.2} to {most:.2} times as thick\n",
        table(&rows),
        written.beads,
        written.pieces,
    );
    if let Some(tilt) = found.scaled.tilt {
        let slope = tilt.slope_per_mm.map(|slope| 1e4 * slope);
        let [x, y, z] = slope.map(|percent| format!("{percent:+.2}"));
        said += &format!(
            "infill was trimmed by {x}, {y}, {z} % per 100 mm along x, y, z of the model: the \
             centre is now {} beside that of the kit\n",
            quantity(found.off_mm.unwrap_or(f64::NAN), "mm")
        );
    }
    if written.slowed > 0 {
        said += &format!(
            "{} pieces are laid more slowly, as the hot end melts no more\n",
            written.slowed
        );
    }
    said += &broken_text(found);
    said += "how a printer follows such lines is not measured: print a small piece and weigh it\n";
    format!("{said}written to {}\n", found.file.display()).replace('\u{a0}', " ")
}
