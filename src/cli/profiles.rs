//! `equipoise printers new`, `import` and `calibrate`: a shop's own profiles.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::args::{CalibrateArgs, ImportArgs, NewArgs};
use super::flags::{MEASUREMENTS, command_for_coupons, command_for_new_profile};
use super::new_files::{self, NewFileError, check_free, draft};
use super::shop::today;
use crate::base::units::{format_count, show_percent};
use crate::coupon::{CouponSet, DensitySet, NoInfill, WeighError};
use crate::printer::import::{ImportError, Imported, slug};
use crate::printer::{
    self, CalibrateError, MaterialError, Measured, MeasuredInfill, Printer, ProfileError, Quantity,
};

/// A reason why no profile was written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProfilesError {
    /// The profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The slicer's files cannot be used.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// No measurement was given.
    #[error("nothing was measured; remedy: give {MEASUREMENTS}")]
    NothingMeasured,
    /// The measurements cannot be used.
    #[error(transparent)]
    Calibrate(CalibrateError),
    /// The printer has no infill that was weighed.
    #[error("{0}; remedy: give the masses of its solid coupons ({MEASUREMENTS})")]
    NoInfill(#[from] NoInfill),
    /// The masses of the blocks of infill cannot be used.
    #[error(transparent)]
    Weigh(#[from] WeighError),
    /// The printer has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] NewFileError),
    /// A shipped printer is not a file.
    #[error(
        "{id} is a shipped printer; remedy: {}, and calibrate that",
        command_for_new_profile(id)
    )]
    ShippedPrinter {
        /// The printer's id.
        id: String,
    },
    /// The standard output is closed.
    #[error("cannot write to the output")]
    Output(#[from] io::Error),
}

impl From<CalibrateError> for ProfilesError {
    fn from(error: CalibrateError) -> Self {
        match error {
            CalibrateError::Nothing => Self::NothingMeasured,
            error => Self::Calibrate(error),
        }
    }
}

/// Writes a shop's own profile: one that inherits, or one from a slicer's files.
pub fn new(args: &NewArgs, out: &mut dyn Write) -> Result<(), ProfilesError> {
    let id = args.id.clone().unwrap_or_else(|| slug(&stem(&args.out)));
    let is_slicers = |path: &PathBuf| {
        let name = path.to_string_lossy();
        [".ini", ".json", ".xml", ".fdm_material", ".cfg"]
            .iter()
            .any(|ending| name.ends_with(ending))
    };
    let text = if args.from.iter().any(is_slicers) {
        let all = Imported::read(&args.from)?;
        all.to_toml(all.printer(args.printer.as_deref())?, &id)
    } else {
        inheriting_profile(&args.from[0].to_string_lossy(), &id, &args.out)?
    };
    write_checked(&args.out, &text, args.force)?;
    Ok(writeln!(
        out,
        "{} is a profile: print coupons ({}) and calibrate it",
        args.out.display(),
        command_for_coupons(&args.out.display().to_string())
    )?)
}

fn stem(path: &Path) -> String {
    path.file_stem()
        .map(|stem| stem.to_string_lossy().into_owned())
        .unwrap_or_default()
}

/// Returns the text of a profile that inherits from a printer, with its numbers as comments.
fn inheriting_profile(from: &str, id: &str, target: &Path) -> Result<String, ProfilesError> {
    let printer = Printer::find(from)?;
    let is_file = Path::new(from).is_file();
    let parent = if is_file {
        relative(Path::new(from), target)
    } else {
        printer.id.clone()
    };
    let name = toml_string(&format!("{}, our own", printer.name));
    let mut text = format!(
        "# A shop's own profile: what it does not say is as in the profile it inherits from.\n\
         # Take the # off a line to state a number of your own; every number needs its source.\n\
         id = \"{id}\"\nname = {name}\ninherits = {}\n",
        toml_string(&parent)
    );
    if let Some(dialect) = &printer.dialect {
        text += &format!(
            "# dialect = {{ value = \"{}\", source = \"…\", sure = \"own-choice\" }}\n",
            dialect.value
        );
    }
    text += "\n[numbers]\n";
    for (quantity, number) in printer.numbers() {
        text += &format!(
            "# {quantity} = {{ value = {}, source = \"…\", sure = \"measured\" }}\n",
            number.value
        );
    }
    Ok(text)
}

/// Returns the path of a parent for a profile at `target`: its name alone if they share a folder.
fn relative(parent: &Path, target: &Path) -> String {
    let same = parent.parent() == target.parent();
    let name = parent.file_name().filter(|_| same).map(PathBuf::from);
    let whole = || fs::canonicalize(parent).unwrap_or_else(|_| parent.to_owned());
    name.unwrap_or_else(whole).to_string_lossy().into_owned()
}

fn toml_string(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Lists the printers of a slicer's files, or writes the profile of one of them.
pub fn import(args: &ImportArgs, out: &mut dyn Write) -> Result<(), ProfilesError> {
    let all = Imported::read(&args.files)?;
    if args.list {
        return list(&all, out);
    }
    let printer = all.printer(args.printer.as_deref())?;
    let id = args.id.clone().unwrap_or_else(|| slug(&printer.name));
    let text = all.to_toml(printer, &id);
    let Some(target) = &args.out else {
        return Ok(out.write_all(text.as_bytes())?);
    };
    let imported = write_checked(target, &text, args.force)?;
    Ok(writeln!(
        out,
        "{}: {} with {}",
        target.display(),
        printer.name,
        format_count(imported.materials.len(), "material")
    )?)
}

fn list(all: &Imported, out: &mut dyn Write) -> Result<(), ProfilesError> {
    for printer in &all.printers {
        writeln!(
            out,
            "printer   {} ({})",
            printer.name,
            printer.technology.process()
        )?;
    }
    for material in &all.materials {
        let density = material.density_g_cm3.as_ref();
        let density = density.map_or_else(
            || "no density".to_owned(),
            |found| format!("{} g/cm³", found.value),
        );
        writeln!(
            out,
            "material  {} ({}), {density}",
            material.name,
            material.technology.process()
        )?;
    }
    Ok(())
}

/// Writes a profile and reads it back; one that does not load is not left behind.
fn write_checked(target: &Path, text: &str, force: bool) -> Result<Printer, ProfilesError> {
    check_free(target, force)?;
    new_files::write_checked([(target, text)], || Ok(Printer::read(&draft(target))?))
}

/// Writes the measurements into a shop's own profile.
pub fn calibrate(args: &CalibrateArgs, out: &mut dyn Write) -> Result<(), ProfilesError> {
    let name = args.file.to_string_lossy();
    if !args.file.is_file() && Printer::find(&name).is_ok() {
        return Err(ProfilesError::ShippedPrinter {
            id: name.into_owned(),
        });
    }
    let printer = Printer::read(&args.file)?;
    let text = fs::read_to_string(&args.file).map_err(|source| ProfileError::Unreadable {
        path: args.file.clone(),
        source,
    })?;
    let measured = measurements(args, &printer)?;
    let after = printer::calibrate(&name, &text, &measured)?;
    write_checked(&args.file, &after, true)?;
    print_changes(&measured, &printer, out)
}

/// Returns the measurements of the arguments.
fn measurements(args: &CalibrateArgs, printer: &Printer) -> Result<Measured, ProfilesError> {
    let material = printer.material(args.material.as_deref())?;
    let set = CouponSet::of(printer, material);
    let lengths = [
        (Quantity::ClearancePerSideMm, args.clearance),
        (Quantity::ClearancePressPerSideMm, args.press),
        (Quantity::ClearanceLoosePerSideMm, args.loose),
        (Quantity::PinMinDiameterMm, args.pin),
        (Quantity::MinWallMm, args.wall),
    ];
    Ok(Measured {
        day: args.date.clone().unwrap_or_else(today),
        lot: args.lot.clone(),
        material: Some(material.clone()),
        slide_mm: args.slide,
        weighed_g: args.weighed.clone(),
        coupon_mm3: args.volume.unwrap_or(set.density_volume_mm3),
        infill: weighed_infill(args, printer)?,
        lengths: lengths
            .into_iter()
            .filter_map(|(quantity, value)| Some((quantity, value?)))
            .collect(),
    })
}

/// Returns the infill whose blocks were weighed; `None` if none were.
fn weighed_infill(
    args: &CalibrateArgs,
    printer: &Printer,
) -> Result<Option<MeasuredInfill>, ProfilesError> {
    if args.infill.is_empty() {
        return Ok(None);
    }
    let material = printer.material(args.material.as_deref())?;
    let set = DensitySet::of(printer, material)?;
    let core_ratio = set.core_ratios(&args.infill)?;
    Ok(Some(MeasuredInfill {
        pattern: set.pattern,
        core_ratio,
    }))
}

/// Prints each new number with the one it replaces.
fn print_changes(
    measured: &Measured,
    printer: &Printer,
    out: &mut dyn Write,
) -> Result<(), ProfilesError> {
    if let (Some(density), Some(material)) = (measured.density_g_cm3(), &measured.material) {
        let id = &material.id;
        let spread = measured.spread_ratio().map_or_else(
            || "no window yet: weigh a second coupon".to_owned(),
            |spread| format!("± {}", show_percent(spread)),
        );
        writeln!(out, "{id}: {density:.4} g/cm³, {spread}")?;
    }
    if let (Some(mm), Some(material)) = (measured.slide_mm, &measured.material) {
        let before = printer.slide_clearance(material);
        let before = before.map_or_else(|| "not known".to_owned(), |it| it.value.to_string());
        let quantity = Quantity::ClearanceSlidePerSideMm;
        writeln!(out, "{}: {quantity}: {mm} (was {before})", material.id)?;
    }
    for (quantity, value) in &measured.lengths {
        let before = printer
            .number(*quantity)
            .map_or_else(|| "not known".to_owned(), |number| number.value.to_string());
        writeln!(out, "{quantity}: {value} (was {before})")?;
    }
    let rows = measured.infill.iter().flat_map(|infill| &infill.core_ratio);
    for [nominal, laid] in rows {
        let before = printer.infill.as_ref().map(|it| it.laid_ratio(*nominal));
        let before = before.map_or_else(|| "not known".to_owned(), |it| format!("{it:.4}"));
        let nominal = show_percent(*nominal);
        writeln!(
            out,
            "infill of {nominal}: {laid:.4} of solid print (was {before})"
        )?;
    }
    Ok(())
}
