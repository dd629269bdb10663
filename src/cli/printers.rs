//! `equipoise printers`: lists the known printers, shows one with its sources, checks a profile.

use std::io::{self, Write};

use serde::Serialize;

use super::args::PrintersAction;
use super::printers_markdown::markdown;
use super::profiles::{self, ProfilesError};
use super::show::table;
use super::values::{kebab, show_box, show_number};
use crate::base::units::{show_mm, show_percent};
use crate::printer::{InfillPattern, Printer, ProfileError, Quantity, Sourced, Sure, Unknown};

/// A reason why `printers` could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrintersError {
    /// The profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// A profile could not be written.
    #[error(transparent)]
    Profiles(#[from] ProfilesError),
    /// The output is closed.
    #[error("cannot write to the output")]
    Output(#[from] io::Error),
    /// A number cannot be put into JSON; no profile lets one pass.
    #[error("cannot write the printer as JSON")]
    Json(#[from] serde_json::Error),
}

/// Runs the action, or lists the printers if it is `None`, and writes to `out`, as text or JSON.
pub fn run(
    action: Option<PrintersAction>,
    json: bool,
    out: &mut dyn Write,
) -> Result<(), PrintersError> {
    match action.unwrap_or(PrintersAction::List { markdown: false }) {
        PrintersAction::List { markdown: true } => {
            Ok(out.write_all(markdown(&Printer::all()?).as_bytes())?)
        }
        PrintersAction::List { markdown: false } => list(&Printer::all()?, json, out),
        PrintersAction::Show { id } => show(&Printer::find(&id)?, json, out),
        PrintersAction::Check { file } => check(&Printer::read(&file)?, json, out),
        PrintersAction::New(args) => Ok(profiles::new(&args, out)?),
        PrintersAction::Import(args) => Ok(profiles::import(&args, out)?),
        PrintersAction::Calibrate(args) => Ok(profiles::calibrate(&args, out)?),
    }
}

fn list(printers: &[Printer], json: bool, out: &mut dyn Write) -> Result<(), PrintersError> {
    if json {
        return write_json(printers, out);
    }
    let head = ["id", "printer", "process", "volume, mm"];
    let rows: Vec<_> = std::iter::once(head.map(str::to_owned))
        .chain(printers.iter().map(list_row))
        .collect();
    Ok(out.write_all(table(&rows).as_bytes())?)
}

/// Returns the columns that fit on a terminal of 80; `show` has the others.
fn list_row(printer: &Printer) -> [String; 4] {
    let volume = printer.build_volume_mm.as_ref();
    let volume = volume.map_or_else(
        || "not known".to_owned(),
        |volume| {
            volume
                .value
                .map(|side| side.floor().to_string())
                .join(" × ")
        },
    );
    [
        printer.id.clone(),
        short_name(&printer.name),
        printer.process.clone().unwrap_or_default(),
        volume,
    ]
}

/// The most characters of a printer's name in the list.
const NAME_CHARS: usize = 31;

/// Returns a name without its nozzle, cut to the width of its column.
fn short_name(name: &str) -> String {
    let name = name.split(',').next().unwrap_or(name);
    if name.chars().count() <= NAME_CHARS {
        return name.to_owned();
    }
    let cut: String = name.chars().take(NAME_CHARS - 1).collect();
    format!("{}…", cut.trim_end())
}

fn show(printer: &Printer, json: bool, out: &mut dyn Write) -> Result<(), PrintersError> {
    if json {
        return write_json(printer, out);
    }
    writeln!(out, "{} ({})", printer.name, printer.id)?;
    out.write_all(table(&words(printer)).as_bytes())?;
    writeln!(out)?;
    out.write_all(table(&numbers(printer)).as_bytes())?;
    writeln!(out)?;
    out.write_all(table(&materials(printer)).as_bytes())?;
    Ok(writeln!(out, "\n{SURE}")?)
}

/// The meanings of the words for where a number is from.
const SURE: &str = "\
from: measured = by the shop, on its own prints; published = in the source named;
third party = in the source named, which is not the maker's; ours = our own choice, for the reason given";

/// Returns the word for where a number is from.
pub(super) fn origin(sure: Sure) -> &'static str {
    match sure {
        Sure::Measured => "measured",
        Sure::Read | Sure::Computed | Sure::Paper => "published",
        Sure::ThirdParty => "third party",
        Sure::Recalled | Sure::OwnChoice => "ours",
    }
}

fn words(printer: &Printer) -> Vec<[String; 2]> {
    let word = |name: &str, value: String| [name.to_owned(), value];
    vec![
        word(
            "process",
            printer
                .process
                .clone()
                .unwrap_or_else(|| "its own".to_owned()),
        ),
        word("inherits", printer.inherits.join(" → ")),
        word("grid", kebab(&printer.grid)),
        word("support", kebab(&printer.support)),
        word("print pose", kebab(&printer.print_pose)),
        word("cleaning", printer.cleaning.clone()),
        word("SHA-256", printer.profile_sha256.clone()),
    ]
}

fn numbers(printer: &Printer) -> Vec<[String; 4]> {
    let mut rows = vec![["number", "value", "from", "source"].map(str::to_owned)];
    rows.extend(plate(printer));
    for wall in &printer.walls_by_part_size {
        let value = format!(
            "{} for parts up to {}",
            show_mm(wall.wall_mm.value),
            show_mm(wall.up_to_mm)
        );
        rows.push(number_row("walls_by_part_size", value, &wall.wall_mm));
    }
    for (quantity, number) in printer.numbers() {
        let value = show_number(quantity, number.value);
        rows.push(number_row(quantity.key(), value, number));
    }
    let unknown = printer.unknown().into_iter();
    let row = |unknown: Unknown| [unknown.key(), "not known", "", consequence(unknown)];
    rows.extend(unknown.map(|unknown| row(unknown).map(str::to_owned)));
    rows
}

/// Returns the rows for the build plate and volume, and for shrinkage.
fn plate(printer: &Printer) -> Vec<[String; 4]> {
    let boxes = [
        ("build_volume_mm", &printer.build_volume_mm),
        ("largest_part_mm", &printer.largest_part_mm),
    ];
    let boxes = boxes
        .into_iter()
        .filter_map(|(key, volume)| Some((key, volume.as_ref()?)));
    let mut rows: Vec<_> = boxes
        .map(|(key, volume)| number_row(key, show_box(volume.value), volume))
        .collect();
    for corner in &printer.excluded_corners {
        let [x, y] = corner.size_mm.value;
        let value = format!("{} {x} × {y} mm", kebab(&corner.corner));
        rows.push(number_row("excluded_corners", value, &corner.size_mm));
    }
    let flag = printer.compensates_shrinkage.iter();
    rows.extend(flag.map(|flag| number_row("compensates_shrinkage", flag.value.to_string(), flag)));
    let dialect = printer.dialect.iter();
    rows.extend(dialect.map(|it| number_row("dialect", it.value.to_string(), it)));
    rows.extend(printer.infill.as_ref().map(infill_row));
    rows
}

/// Returns the row for what slicers lay of the infill.
fn infill_row(infill: &InfillPattern) -> [String; 4] {
    let rows = infill.core_ratio.value.iter();
    let rows = rows.map(|[nominal, laid]| format!("{nominal}: {laid}"));
    let value = rows.collect::<Vec<String>>().join(", ");
    let value = format!("{} {value}", infill.pattern);
    number_row("infill_core_ratio", value, &infill.core_ratio)
}

/// Returns the consequence of a value that is not known.
fn consequence(unknown: Unknown) -> &'static str {
    match unknown {
        Unknown::BuildVolume => "the fit of parts is not checked",
        Unknown::Shrinkage => "parts are written at nominal size",
        Unknown::Number(_) => "",
    }
}

fn number_row<T>(key: &str, value: String, number: &Sourced<T>) -> [String; 4] {
    let default = number
        .process_default_of
        .as_ref()
        .map(|id| format!(" (default of {id})"));
    let source = format!("{}{}", number.source, default.unwrap_or_default());
    [
        key.to_owned(),
        value,
        origin(number.sure).to_owned(),
        source,
    ]
}

fn materials(printer: &Printer) -> Vec<[String; 7]> {
    let titles = [
        "material",
        "name",
        "density",
        "± mass",
        "slides with",
        "from",
        "source",
    ];
    let mut rows = vec![titles.map(str::to_owned)];
    rows.extend(printer.materials.iter().map(|material| {
        [
            material.id.clone(),
            material.name.clone(),
            format!("{} g/cm³", material.density_g_cm3.value),
            material.density_spread_ratio.as_ref().map_or_else(
                || "not known".to_owned(),
                |spread| show_percent(spread.value),
            ),
            printer
                .slide_clearance(material)
                .map_or_else(|| "not known".to_owned(), |gap| show_mm(gap.value)),
            origin(material.density_g_cm3.sure).to_owned(),
            material.density_g_cm3.source.clone(),
        ]
    }));
    rows
}

fn check(printer: &Printer, json: bool, out: &mut dyn Write) -> Result<(), PrintersError> {
    if json {
        return write_json(printer, out);
    }
    let numbers = printer.numbers();
    let unsure = |quantity: &&(Quantity, &Sourced<f64>)| {
        matches!(quantity.1.sure, Sure::Recalled | Sure::OwnChoice)
    };
    let inherited = numbers
        .iter()
        .filter(|(_, number)| number.process_default_of.is_some())
        .count();
    writeln!(
        out,
        "{}: a profile that can be used; {} numbers, {inherited} of them process defaults, {} our own choices",
        printer.id,
        numbers.len(),
        numbers.iter().filter(unsure).count()
    )?;
    Ok(())
}

fn write_json(value: &(impl Serialize + ?Sized), out: &mut dyn Write) -> Result<(), PrintersError> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    Ok(writeln!(out)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(action: Option<PrintersAction>, json: bool) -> String {
        let mut out = Vec::new();
        run(action, json, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    fn show_action(id: &str) -> Option<PrintersAction> {
        Some(PrintersAction::Show { id: id.to_owned() })
    }

    #[test]
    fn the_list_has_a_line_for_each_printer_and_says_what_is_not_known() {
        let list = text(None, false);
        assert_eq!(list.lines().count(), 1 + Printer::all().unwrap().len());
        let objet = list
            .lines()
            .find(|line| line.starts_with("objet-connex350"))
            .unwrap();
        assert!(
            objet.contains("polyjet") && objet.contains("not known"),
            "{objet}"
        );
        assert!(list.contains("250 × 210 × 220"), "{list}");
        let widest = list.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(80), "{list}");
    }

    #[test]
    fn every_number_is_shown_with_its_source_and_its_certainty() {
        let shown = text(show_action("prusa-mk4"), false);
        let printer = Printer::find("prusa-mk4").unwrap();
        for (quantity, number) in printer.numbers() {
            let line = shown
                .lines()
                .find(|line| line.starts_with(quantity.key()))
                .unwrap();
            assert!(
                line.contains(&number.source) && line.contains(origin(number.sure)),
                "{line}"
            );
        }
        for material in &printer.materials {
            assert!(shown.contains(&material.name), "{}", material.name);
        }
    }

    #[test]
    fn json_has_the_same_numbers() {
        let list: serde_json::Value = serde_json::from_str(&text(None, true)).unwrap();
        assert_eq!(
            list.as_array().unwrap().len(),
            Printer::all().unwrap().len()
        );
        let shown: serde_json::Value =
            serde_json::from_str(&text(show_action("prusa-mk4"), true)).unwrap();
        assert_eq!(shown["pixel_x_mm"]["value"], 0.45);
        assert_eq!(shown["min_wall_mm"]["process_default_of"], "fdm");
        assert_eq!(shown["materials"][0]["id"], "pla");
    }

    #[test]
    fn a_profile_file_is_checked_and_a_known_id_is_no_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("shop.toml");
        let profile =
            include_str!("../../profiles/printers/prusa-mk4.toml").replace("prusa-mk4", "shop-mk4");
        std::fs::write(&file, profile).unwrap();
        let said = text(Some(PrintersAction::Check { file }), false);
        assert_eq!(
            said,
            "shop-mk4: a profile that can be used; 33 numbers, 27 of them process defaults, 13 our own choices\n"
        );
        let mut out = Vec::new();
        let error = run(
            Some(PrintersAction::Check {
                file: "prusa-mk4".into(),
            }),
            false,
            &mut out,
        )
        .unwrap_err();
        assert!(
            error
                .to_string()
                .contains("cannot read the printer profile prusa-mk4"),
            "{error}"
        );
        assert!(out.is_empty());
    }
}
