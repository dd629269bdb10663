//! `equipoise inspect`: a model's facts and defects, and what it could become.

use std::io::Write;
use std::path::PathBuf;

use serde::Serialize;

use super::args::{FieldChoice, InspectArgs};
use super::broken::{BrokenPictureError, check_name, places, redraw_hint, write_picture};
use super::exit::Exit;
use super::field_facts::{FieldFacts, field_facts, field_text};
use super::flags::{flag, flags, with_flags};
use super::inspect_volume::{InspectVolumeError, inspect_volume};
use super::mass_facts::{Mass, mass, mass_text, plain};
use super::show::{say, table};
use super::tets_file::{TetsFileError, WrittenTets, check_sampled, write_sampled, written_text};
use super::usual::{density_g_cm3, size_hint};
use super::voice::Voice;
use crate::advice::{Case, Prospect, name_direction, prospects};
use crate::base::setting::{Key, Setting};
use crate::base::units::{format_count, show_mm};
use crate::base::watch::{Cancelled, Watch};
use crate::field::{FileError, NotADensity, Order};
use crate::geom::Vector;
use crate::goal::{Contact, GoalKind, Request, find_upright};
use crate::io::{ReadError, is_volume_name, read_model};
use crate::mass::Moments;
use crate::mend::{MendError, mend};
use crate::mesh::{Defects, MeshFacts, Solid, scaled};
use crate::printer::{MaterialError, Printer, ProfileError, WallError};
use crate::repair::one_body_with;
use crate::run::NaturalUp;

/// A reason why `inspect` could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InspectError {
    /// The model cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The model cannot be mended as ordered.
    #[error("{} cannot be repaired as ordered", path.display())]
    Mend {
        /// The model's file.
        path: PathBuf,
        /// The reason.
        source: Box<MendError>,
    },
    /// The volume mesh cannot be inspected.
    #[error(transparent)]
    Volume(#[from] InspectVolumeError),
    /// The volume mesh cannot be written.
    #[error(transparent)]
    Tets(#[from] TetsFileError),
    /// The picture cannot be written.
    #[error(transparent)]
    Picture(#[from] BrokenPictureError),
    /// The field's file cannot be used.
    #[error(transparent)]
    FieldFile(#[from] FileError),
    /// The field is no density somewhere in the model.
    #[error(transparent)]
    Field(#[from] NotADensity),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The printer has no material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The wall cannot be printed.
    #[error(transparent)]
    Wall(#[from] WallError),
    /// The command was stopped.
    #[error(transparent)]
    Stopped(#[from] Cancelled),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The facts cannot be put into JSON.
    #[error("the facts cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// The facts and defects of a model.
#[derive(Debug, Serialize)]
struct Findings {
    triangles: usize,
    vertices: usize,
    shells: usize,
    genus: Option<i64>,
    size_mm: [f64; 3],
    /// A remedy for a size that nobody prints; `None` if the size is plausible.
    size_hint: Option<String>,
    area_mm2: f64,
    open_edges: usize,
    crossing_pairs: Option<usize>,
    pinch_vertices: usize,
    degenerate_triangles: usize,
    repairs: String,
    defects: Option<String>,
    /// True if a new surface would have none of the defects.
    can_be_redrawn: bool,
    not_one_body: Option<String>,
    solid: Option<Mass>,
    /// The mass properties with the field ordered; `None` without one, or if it is not a solid.
    field: Option<FieldFacts>,
    /// The volume mesh that was written with it; `None` without an order.
    #[serde(skip_serializing_if = "Option::is_none")]
    tets: Option<WrittenTets>,
    /// The goals it could reach with a wall; `None` if it is not a solid of one body, or if nobody
    /// prints its size.
    could_become: Option<Becoming>,
}

/// The goals that a model could reach.
#[derive(Debug, Serialize)]
struct Becoming {
    wall_mm: f64,
    /// The natural up in words, with its reasons.
    natural_up: String,
    prospects: Vec<Prospect>,
}

/// The bore in what to type for a rotor: that of a common ball bearing, 608.
const EXAMPLE_BORE: &str = "8mm";
/// The wall over the longest side, if neither a wall nor a printer is given.
const PLAIN_WALL_RATIO: f64 = 0.01;

/// Writes the facts and defects of a model to `out`.
///
/// Returns [`Exit::CouldNotRun`], as `prepare` would, if the model is not a solid of one body.
pub fn inspect(
    args: &InspectArgs,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<Exit, InspectError> {
    if is_volume_name(&args.model) {
        return Ok(inspect_volume(args, voice, out)?);
    }
    if let Some(option) = args.only_for_volumes() {
        let path = args.model.clone();
        return Err(InspectVolumeError::ForVolumes { option, path }.into());
    }
    args.picture.as_deref().map_or(Ok(()), check_name)?;
    check_sampled(&args.tets, args.field.is_some())?;
    let field = args.field.as_ref().map(FieldChoice::order).transpose()?;
    let factor = |longest| args.scaling.scaling().factor(longest);
    let order = args.repair.unwrap_or_default();
    let mended = mend(read_model(&args.model)?, order, factor, &Watch::silent());
    let mended = mended.map_err(|source| InspectError::Mend {
        path: args.model.clone(),
        source: Box::new(source),
    })?;
    let mesh = scaled(&mended.mesh, mended.scale_ratio);
    let facts = MeshFacts::of(&mesh);
    // Defects are located in the coordinates of the file, where a person looks for them.
    let solid = Solid::new(mesh).map_err(|defects| Defects::of(&mended.mesh).unwrap_or(defects));
    let refusal = match &solid {
        Ok(solid) => one_body_with(solid, order.inner, &Watch::silent())?.err(),
        Err(_) => None,
    };
    if let Some(path) = &args.picture {
        let places = places(solid.as_ref().err(), refusal.as_ref(), mended.scale_ratio);
        write_picture(path, &mended.mesh, &places)?;
    }
    let mut findings = findings(&facts, mended.repairs.to_string(), &solid);
    findings.not_one_body = refusal.map(|why| why.to_string());
    if let (Ok(solid), Some(order)) = (&solid, &field) {
        let (facts, exact) = with_field(args, order, solid)?;
        findings.field = Some(facts);
        findings.tets = write_sampled(&args.tets, solid, order.on(solid).as_ref(), exact)?;
    }
    // Without its size, walls and speeds would be those of another object.
    let is_sized = findings.size_hint.is_none() || args.wall.is_some();
    if let (Ok(solid), None, true) = (&solid, &findings.not_one_body, is_sized) {
        findings.could_become = Some(becoming(args, solid)?);
    }
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&findings)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&findings))?;
    }
    let is_sound = findings.defects.is_none() && findings.not_one_body.is_none();
    if !is_sound && voice.manner.quiet && !voice.json {
        say(text(&findings).trim_end());
    }
    Ok(if is_sound {
        Exit::Kept
    } else {
        Exit::CouldNotRun
    })
}

fn findings(facts: &MeshFacts, repairs: String, solid: &Result<Solid, Defects>) -> Findings {
    Findings {
        triangles: facts.triangles,
        vertices: facts.vertices,
        shells: facts.shells,
        genus: facts.genus,
        size_mm: facts.size_mm.into(),
        size_hint: size_hint(facts.size_mm.max()),
        area_mm2: facts.area_mm2,
        open_edges: facts.open_edges,
        crossing_pairs: facts.crossings.as_ref().map(|crossings| crossings.pairs),
        pinch_vertices: facts.pinch_vertices.len(),
        degenerate_triangles: facts.degenerate_triangles,
        repairs,
        defects: solid.as_ref().err().map(ToString::to_string),
        can_be_redrawn: solid.as_ref().is_err_and(Defects::can_draw_over),
        not_one_body: None,
        solid: solid.as_ref().ok().map(|solid| mass(solid.mesh())),
        field: None,
        tets: None,
        could_become: None,
    }
}

/// Returns the mass properties of the solid with the field ordered, of the printer's material, and
/// its moments.
fn with_field(
    args: &InspectArgs,
    order: &Order,
    solid: &Solid,
) -> Result<(FieldFacts, Moments), InspectError> {
    let printer = args.printer.as_deref().map(Printer::find).transpose()?;
    let name = args
        .field
        .as_ref()
        .map_or(String::new(), ToString::to_string);
    Ok(field_facts(
        name,
        order,
        solid,
        density_g_cm3(printer.as_ref())?,
    )?)
}

/// Returns the goals the solid could reach with the wall ordered, or the printer's minimum.
fn becoming(args: &InspectArgs, solid: &Solid) -> Result<Becoming, InspectError> {
    let ordered_mm = args.wall.map(|wall| wall.mm());
    let size_mm = solid.mesh().longest_side_mm();
    let printer = args.printer.as_deref().map(Printer::find).transpose()?;
    let wall_mm = match &printer {
        Some(printer) => printer.quantise_wall(ordered_mm, size_mm)?.wall_mm,
        None => ordered_mm.unwrap_or(PLAIN_WALL_RATIO * size_mm),
    };
    let case = Case {
        solid,
        request: Request::new(GoalKind::Stand),
        wall_mm,
        least_wall_mm: wall_mm,
        wall_step_mm: wall_mm,
        density_g_cm3: density_g_cm3(printer.as_ref())?,
        greatest_size_mm: f64::INFINITY,
        fill: None,
    };
    let watch = Watch::silent();
    let poses = find_upright(solid, &watch)?;
    let natural = NaturalUp::of(&poses, |pose| name_direction(&case, &pose.up));
    let up = natural.up.direction().unwrap_or_else(Vector::z);
    Ok(Becoming {
        wall_mm,
        natural_up: natural.to_string(),
        prospects: prospects(&case, &up, &watch)?,
    })
}

fn text(findings: &Findings) -> String {
    let [x, y, z] = findings.size_mm.map(|mm| plain(mm, ""));
    let mut text = format!(
        "{} triangles, {} vertices, {}{}\nsize {x} × {y} × {z} mm, surface {}\nrepaired: {}\n",
        findings.triangles,
        findings.vertices,
        format_count(findings.shells, "shell"),
        findings
            .genus
            .map_or(String::new(), |genus| format!(", genus {genus}")),
        plain(findings.area_mm2, "mm²"),
        findings.repairs,
    );
    text += &findings.size_hint.as_ref().map_or(String::new(), |hint| {
        format!("warning: {}\n", with_flags(hint))
    });
    for (count, what) in [
        (
            findings.crossing_pairs.unwrap_or(0),
            "places where the surface crosses itself (the overlap counts twice)",
        ),
        (
            findings.pinch_vertices,
            "vertices in which surfaces only touch",
        ),
        (findings.degenerate_triangles, "triangles without area"),
    ] {
        if count > 0 {
            text += &format!("{count} {what}\n");
        }
    }
    if let Some(reason) = &findings.not_one_body {
        text += &format!("prepare needs one body: {}\n", with_flags(reason));
    }
    match (&findings.solid, &findings.defects) {
        (Some(mass), _) => text += &mass_text(mass),
        (_, Some(defects)) => {
            text += &format!("{defects}\n{}", redraw_hint(findings.can_be_redrawn))
        }
        _ => {}
    }
    text += &findings.field.as_ref().map_or(String::new(), field_text);
    text += &findings.tets.as_ref().map_or(String::new(), written_text);
    let is_sound = findings.solid.is_some() && findings.not_one_body.is_none();
    text + &match &findings.could_become {
        Some(becoming) => becoming_text(becoming),
        None if is_sound => {
            "what it could become is worked out once its size is known\n".to_owned()
        }
        None => String::new(),
    }
}

/// Returns the natural up, and a line for each goal with what to type, the best first.
fn becoming_text(becoming: &Becoming) -> String {
    let line = |prospect: &Prospect| {
        let result = match prospect.reached {
            Some(reached) => format!("{reached}{}", needs(prospect)),
            None if prospect.needs_bore() => {
                let bore = flag(&Setting::new(Key::Bore, EXAMPLE_BORE));
                format!("needs a bore: {bore}; you must say which axis")
            }
            None => format!("cannot: {}", prospect.reason),
        };
        [prospect.kind.to_string(), result]
    };
    let typed = |prospect: &Prospect| {
        let is_possible = Some(prospect).filter(|prospect| prospect.possible);
        is_possible.map(|prospect| format!("           {}\n", flags(&settings(prospect))))
    };
    let rows: Vec<[String; 2]> = becoming.prospects.iter().map(line).collect();
    let rows = table(&rows).replace('\u{a0}', " ");
    // What to type has a line of its own: both do not fit into 80 columns.
    let rows = rows.lines().zip(&becoming.prospects);
    let rows: String = rows
        .map(|(row, prospect)| format!("{row}\n{}", typed(prospect).unwrap_or_default()))
        .collect();
    format!(
        "{}\nhollowed with a wall of {}, as (best first)\n{rows}",
        with_flags(&becoming.natural_up),
        show_mm(becoming.wall_mm)
    )
}

/// Returns what a goal needs besides the hollowing, in words.
fn needs(prospect: &Prospect) -> String {
    if let Some(turns_on) = prospect.turns_on {
        return match turns_on.axes {
            1 => ", on its bore or shaft".to_owned(),
            axes => format!(", on the best of {axes} axes"),
        };
    }
    let tip = if prospect.tip.is_some() {
        ", on a steel tip"
    } else {
        ""
    };
    let turned = if prospect.is_turned() {
        format!(", turned by {:.0}°", prospect.off_deg)
    } else {
        String::new()
    };
    format!("{tip}{turned}")
}

/// Returns the options that order a goal: its axis, the contact and tip of a top, and the spin
/// point of a rotor. The only bore or shaft of a rotor needs no order.
fn settings(prospect: &Prospect) -> Vec<Setting> {
    let goal = Setting::new(Key::Goal, prospect.kind);
    if prospect.turns_on.is_some_and(|turns_on| turns_on.axes == 1) {
        return vec![goal];
    }
    let up = Setting::new(Key::Up, prospect.up);
    let is_tipped = |_: &Contact| prospect.tip.is_some();
    let contact = prospect.contact.filter(is_tipped);
    let contact = contact.map(|contact| Setting::new(Key::Contact, contact));
    let tip = prospect.tip.map(|tip| Setting::new(Key::Tip, tip));
    let point = prospect.turns_on.and_then(|turns_on| turns_on.spin_point);
    let point = point.map(|point| Setting::new(Key::SpinPoint, point));
    let all = [Some(goal), Some(up), contact, tip, point];
    all.into_iter().flatten().collect()
}
