//! `equipoise cutters`: lists cutters, sheets and fasteners, shows one, checks or begins a profile.

use std::io::{self, Write};
use std::path::Path;

use serde::Serialize;

use super::args::{CalibrateCutterArgs, CuttersAction, NewCutterArgs};
use super::flags::command_for_new_cutter;
use super::new_files::{self, NewFileError, check_free, draft};
use super::printers::origin;
use super::shop::today;
use super::show::table;
use super::values::kebab;
use crate::base::sourced::Sourced;
use crate::base::units::format_count;
use crate::coupon::{CutCouponError, CutCouponSet};
use crate::cutter::{
    self, AnyProfile, CutCalibrateError, CutMeasured, Cutter, Fastener, ProfileError, Provenance,
    StockSheet,
};
use crate::printer::import::slug;

/// A reason why `cutters` could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CuttersError {
    /// The profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// Fasteners are no parents of a profile.
    #[error("`{0}` is a fastener; remedy: begin with the id of a cutter or a sheet")]
    Fastener(String),
    /// A profile that comes with the program is no shop's own.
    #[error(
        "`{0}` is no file of yours; remedy: make a profile of your own (`{command}`)",
        command = command_for_new_cutter(.0)
    )]
    Shipped(String),
    /// A cutter whose software offsets the cuts has no kerf to be entered.
    #[error(
        "`{0}` says that its software offsets the cuts by the kerf; remedy: enter what the row \
         misses there, or set compensates_kerf to false"
    )]
    Compensates(String),
    /// The measurements are not possible.
    #[error(transparent)]
    Measured(#[from] CutCalibrateError),
    /// The coupons cannot be computed.
    #[error(transparent)]
    Coupon(#[from] CutCouponError),
    /// The file cannot be written.
    #[error(transparent)]
    File(#[from] NewFileError),
    /// The output is closed.
    #[error("cannot write to the output")]
    Output(#[from] io::Error),
    /// A number cannot be put into JSON; no profile lets one pass.
    #[error("cannot write the profile as JSON")]
    Json(#[from] serde_json::Error),
}

/// All built-in profiles.
#[derive(Serialize)]
struct Everything {
    cutters: Vec<Cutter>,
    sheets: Vec<StockSheet>,
    fasteners: Vec<Fastener>,
}

/// Runs the action, or lists the profiles if it is `None`, and writes to `out`, as text or JSON.
pub fn run(
    action: Option<CuttersAction>,
    json: bool,
    out: &mut dyn Write,
) -> Result<(), CuttersError> {
    match action.unwrap_or(CuttersAction::List) {
        CuttersAction::List => list(json, out),
        CuttersAction::Show { id } => show(&AnyProfile::find(&id)?, json, out),
        CuttersAction::Check { file } => check(&AnyProfile::read(&file)?, json, out),
        CuttersAction::New(args) => new(&args, out),
        CuttersAction::Calibrate(args) => calibrate(&args, out),
    }
}

fn list(json: bool, out: &mut dyn Write) -> Result<(), CuttersError> {
    let everything = Everything {
        cutters: Cutter::all()?,
        sheets: StockSheet::all()?,
        fasteners: Fastener::all()?,
    };
    if json {
        return write_json(&everything, out);
    }
    let mut rows = vec![["cutter", "name", "bed, mm"].map(str::to_owned)];
    rows.extend(everything.cutters.iter().map(|cutter| {
        let bed = show_sides(cutter.bed_mm.value);
        [cutter.id.clone(), cutter.name.clone(), bed]
    }));
    writeln!(out, "{}", table(&rows))?;
    let mut rows = vec![["sheet", "name", "largest, mm"].map(str::to_owned)];
    rows.extend(everything.sheets.iter().map(|sheet| {
        let sizes = sheet.sizes.iter().map(|size| size.size_mm.value);
        let largest = sizes.reduce(|a, b| if b[0] * b[1] > a[0] * a[1] { b } else { a });
        let largest = largest.map_or_else(String::new, show_sides);
        [sheet.id.clone(), sheet.name.clone(), largest]
    }));
    writeln!(out, "{}", table(&rows))?;
    let mut rows = vec![["fastener", "name", "mass, g"].map(str::to_owned)];
    rows.extend(everything.fasteners.iter().map(|fastener| {
        let mass = fastener.mass_g.to_string();
        [fastener.id.clone(), fastener.name.clone(), mass]
    }));
    Ok(out.write_all(table(&rows).as_bytes())?)
}

fn show_sides([x, y]: [f64; 2]) -> String {
    format!("{x} × {y}")
}

fn show(profile: &AnyProfile, json: bool, out: &mut dyn Write) -> Result<(), CuttersError> {
    if json {
        return write_json(profile, out);
    }
    let rows = match profile {
        AnyProfile::Cutter(cutter) => {
            writeln!(out, "{} ({})", cutter.name, cutter.id)?;
            writeln!(out, "drawings: {}", cutter.dialect)?;
            cutter_rows(cutter)
        }
        AnyProfile::Sheet(sheet) => {
            writeln!(out, "{} ({})", sheet.name, sheet.id)?;
            writeln!(out, "material: {}, grain: {}", sheet.material, sheet.grain)?;
            sheet_rows(sheet)
        }
        AnyProfile::Fasteners(fasteners) => fasteners.iter().flat_map(fastener_rows).collect(),
    };
    let head = ["number", "value", "from", "source"].map(str::to_owned);
    let rows: Vec<_> = std::iter::once(head).chain(rows).collect();
    Ok(out.write_all(table(&rows).as_bytes())?)
}

type NumberRow = [String; 4];

fn number_row<T>(key: &str, value: String, number: &Sourced<T>) -> NumberRow {
    let default = number.process_default_of.as_ref();
    let default = default.map_or_else(String::new, |id| format!(" (default of {id})"));
    [
        key.to_owned(),
        value,
        origin(number.sure).to_owned(),
        format!("{}{default}", number.source),
    ]
}

fn cutter_rows(cutter: &Cutter) -> Vec<NumberRow> {
    let bed = &cutter.bed_mm;
    let flag = &cutter.compensates_kerf;
    let mut rows = vec![
        number_row("bed_mm", show_sides(bed.value), bed),
        number_row("compensates_kerf", flag.value.to_string(), flag),
    ];
    rows.extend(cutter.kerfs.iter().map(|kerf| {
        let key = format!("kerf in {} of {} mm", kerf.material, kerf.thickness_mm);
        number_row(&key, kerf.kerf_mm.value.to_string(), &kerf.kerf_mm)
    }));
    rows.extend(cutter.thickest.iter().map(|limit| {
        let key = format!("thickest {}", limit.material);
        let thickness = &limit.thickness_mm;
        number_row(&key, thickness.value.to_string(), thickness)
    }));
    let numbers = cutter.numbers.iter();
    rows.extend(
        numbers.map(|(key, number)| number_row(&kebab(key), number.value.to_string(), number)),
    );
    rows
}

fn sheet_rows(sheet: &StockSheet) -> Vec<NumberRow> {
    let number =
        |key: &str, number: &Sourced<f64>| number_row(key, number.value.to_string(), number);
    let mut rows = vec![
        number("thickness_mm", &sheet.thickness_mm),
        number("density_g_cm3", &sheet.density_g_cm3),
    ];
    if let Some(range) = &sheet.thickness_range_mm {
        let value = format!("{} to {}", range.value[0], range.value[1]);
        rows.push(number_row("thickness_range_mm", value, range));
    }
    let sizes = sheet.sizes.iter();
    rows.extend(
        sizes.map(|size| number_row("size_mm", show_sides(size.size_mm.value), &size.size_mm)),
    );
    rows
}

fn fastener_rows(fastener: &Fastener) -> Vec<NumberRow> {
    let row = |key: &str, value: f64, from: &Provenance| {
        [
            format!("{key} of {}", fastener.id),
            value.to_string(),
            origin(from.sure).to_owned(),
            from.source.clone(),
        ]
    };
    let sizes = fastener.shape.sizes_mm().into_iter();
    let sizes = sizes.map(|(key, value)| row(key, value, &fastener.size));
    let mass = row("mass_g", fastener.mass_g, &fastener.mass);
    sizes.chain([mass]).collect()
}

fn check(profile: &AnyProfile, json: bool, out: &mut dyn Write) -> Result<(), CuttersError> {
    if json {
        return write_json(profile, out);
    }
    let said = match profile {
        AnyProfile::Cutter(cutter) => format!(
            "{}: a cutter that can be used; {}",
            cutter.id,
            format_count(cutter.kerfs.len(), "kerf")
        ),
        AnyProfile::Sheet(sheet) => format!(
            "{}: a sheet that can be used; {}",
            sheet.id,
            format_count(sheet.sizes.len(), "size")
        ),
        AnyProfile::Fasteners(fasteners) => {
            let count = format_count(fasteners.len(), "fastener");
            format!("{count} that can be used")
        }
    };
    Ok(writeln!(out, "{said}")?)
}

/// Writes a profile that inherits from a known one, with its measured numbers as comments.
fn new(args: &NewCutterArgs, out: &mut dyn Write) -> Result<(), CuttersError> {
    let stem = args.out.file_stem().unwrap_or_default().to_string_lossy();
    let id = args.id.clone().unwrap_or_else(|| slug(&stem));
    let text = match AnyProfile::find(&args.from)? {
        AnyProfile::Cutter(cutter) => own_cutter(&cutter, &id),
        AnyProfile::Sheet(sheet) => own_sheet(&sheet, &id),
        AnyProfile::Fasteners(_) => return Err(CuttersError::Fastener(args.from.clone())),
    };
    check_free(&args.out, args.force)?;
    let target: &Path = &args.out;
    new_files::write_checked([(target, &text)], || {
        Ok::<_, CuttersError>(AnyProfile::read(&draft(target))?)
    })?;
    Ok(writeln!(
        out,
        "{} is a profile: measure, and write what you measured into it",
        target.display()
    )?)
}

/// Writes what was measured into the shop's own profiles: both, or none.
fn calibrate(args: &CalibrateCutterArgs, out: &mut dyn Write) -> Result<(), CuttersError> {
    let name = args.file.to_string_lossy();
    if !args.file.is_file() && Cutter::find(&name).is_ok() {
        return Err(CuttersError::Shipped(name.into_owned()));
    }
    let cutter = Cutter::read(&args.file)?;
    if cutter.compensates_kerf.value {
        return Err(CuttersError::Compensates(cutter.id));
    }
    let sheet = StockSheet::find(&args.sheet)?;
    let set = CutCouponSet::of(&cutter, &sheet)?;
    let measured = CutMeasured {
        day: args.date.clone().unwrap_or_else(today),
        lot: args.lot.clone(),
        squares: set.squares,
        side_mm: set.side_mm,
        row_mm: args.row,
        thickness_mm: args.thickness.clone(),
        weighed_g: args.weighed,
    };
    let read = |path: &Path| {
        std::fs::read_to_string(path).map_err(|source| ProfileError::Unreadable {
            path: path.to_owned(),
            source,
        })
    };
    let text = read(&args.file)?;
    let text = cutter::calibrate_cutter(&name, &text, sheet.material, &measured)?;
    let own_sheet = Path::new(&args.sheet);
    let check = |path: &Path| AnyProfile::read(&draft(path)).map(|_| ());
    if own_sheet.is_file() {
        let after = cutter::calibrate_sheet(&args.sheet, &read(own_sheet)?, &measured)?;
        new_files::write_checked([(args.file.as_path(), &text), (own_sheet, &after)], || {
            check(&args.file)?;
            Ok::<_, CuttersError>(check(own_sheet)?)
        })?;
    } else {
        new_files::write_checked([(args.file.as_path(), &text)], || {
            Ok::<_, CuttersError>(check(&args.file)?)
        })?;
    }
    print_measured(&set, &sheet, &measured, out)?;
    if !own_sheet.is_file() {
        writeln!(
            out,
            "note: {} comes with the program and stays as it is; for a profile of your own: {}",
            args.sheet,
            command_for_new_cutter(&args.sheet)
        )?;
    }
    Ok(())
}

/// Prints each new number with the one it replaces.
fn print_measured(
    set: &CutCouponSet,
    sheet: &StockSheet,
    measured: &CutMeasured,
    out: &mut dyn Write,
) -> Result<(), CuttersError> {
    let (kerf_mm, thickness_mm) = (measured.kerf_mm()?, measured.mean_thickness_mm()?);
    writeln!(
        out,
        "kerf in {}: {kerf_mm:.3} mm (was {:.3} mm)",
        set.material, set.kerf_mm
    )?;
    writeln!(
        out,
        "thickness of {}: {thickness_mm:.2} mm (was {} mm)",
        set.sheet, sheet.thickness_mm.value
    )?;
    if let Some(density) = measured.density_g_cm3()? {
        let before = sheet.density_g_cm3.value;
        writeln!(
            out,
            "density of {}: {density:.3} g/cm³ (was {before} g/cm³)",
            set.sheet
        )?;
    }
    if let Some(warning) = cutter::thickness_warning(sheet, thickness_mm) {
        writeln!(out, "note: {warning}")?;
    }
    Ok(())
}

/// The head of a profile that inherits.
fn head(id: &str, name: &str, parent: &str) -> String {
    let name = toml::Value::String(format!("{name}, our own"));
    format!(
        "# A shop's own profile: what it does not say is as in the profile it inherits from.\n\
         # Take the # off to state a number of your own; every number needs its source.\n\
         id = \"{id}\"\nname = {name}\ninherits = \"{parent}\"\n"
    )
}

/// The end of a line that states a measured number.
const MEASURED: &str = "source = \"…\", sure = \"measured\" }";

fn own_cutter(cutter: &Cutter, id: &str) -> String {
    let mut text = head(id, &cutter.name, &cutter.id);
    let [x, y] = cutter.bed_mm.value;
    text += &format!("# bed_mm = {{ value = [{x}, {y}], {MEASURED}\n");
    for kerf in &cutter.kerfs {
        text += &format!(
            "\n# [[kerf]]\n# material = \"{}\"\n# thickness_mm = {}\n\
             # kerf_mm = {{ value = {}, {MEASURED}\n",
            kerf.material, kerf.thickness_mm, kerf.kerf_mm.value
        );
    }
    text
}

fn own_sheet(sheet: &StockSheet, id: &str) -> String {
    let mut text = head(id, &sheet.name, &sheet.id);
    let numbers = [
        ("thickness_mm", sheet.thickness_mm.value),
        ("density_g_cm3", sheet.density_g_cm3.value),
    ];
    for (key, value) in numbers {
        text += &format!("# {key} = {{ value = {value}, {MEASURED}\n");
    }
    text
}

fn write_json(value: &impl Serialize, out: &mut dyn Write) -> Result<(), CuttersError> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    Ok(writeln!(out)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(action: Option<CuttersAction>, json: bool) -> String {
        let mut out = Vec::new();
        run(action, json, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    fn show_action(id: &str) -> Option<CuttersAction> {
        Some(CuttersAction::Show { id: id.to_owned() })
    }

    #[test]
    fn the_list_names_every_cutter_sheet_and_fastener() {
        let list = text(None, false);
        let ids = Cutter::all().unwrap().into_iter().map(|cutter| cutter.id);
        let ids = ids.chain(StockSheet::all().unwrap().into_iter().map(|sheet| sheet.id));
        let ids = ids.chain(Fastener::all().unwrap().into_iter().map(|one| one.id));
        for id in ids {
            assert!(list.lines().any(|line| line.starts_with(&id)), "{id}");
        }
        let json: serde_json::Value = serde_json::from_str(&text(None, true)).unwrap();
        let count = Cutter::all().unwrap().len();
        assert_eq!(json["cutters"].as_array().unwrap().len(), count);
    }

    #[test]
    fn every_number_is_shown_with_its_source() {
        let shown = text(show_action("makerspace-900x600"), false);
        for said in [
            "900 × 600",
            "default of co2-laser",
            "min_gap_mm",
            "thickest mdf",
        ] {
            assert!(shown.contains(said), "{said}: {shown}");
        }
        let shown = text(show_action("birch-6"), false);
        assert!(
            shown.contains("5.6 to 6.4") && shown.contains("1525 × 1525"),
            "{shown}"
        );
        let shown = text(show_action("screw-m4x12"), false);
        assert!(shown.contains("hole_mm of screw-m4x12"), "{shown}");
    }

    #[test]
    fn a_new_profile_can_be_used_at_once_and_is_not_written_over() {
        let folder = tempfile::tempdir().unwrap();
        for from in ["glowforge", "birch-5"] {
            let file = folder.path().join(format!("own-{from}.toml"));
            let action = |force| {
                CuttersAction::New(NewCutterArgs {
                    from: from.to_owned(),
                    id: None,
                    out: file.clone(),
                    force,
                })
            };
            text(Some(action(false)), false);
            let said = text(Some(CuttersAction::Check { file: file.clone() }), false);
            assert!(said.starts_with(&format!("own-{from}: a ")), "{said}");
            let error = run(Some(action(false)), false, &mut Vec::new()).unwrap_err();
            assert!(error.to_string().contains("exists"), "{error}");
            text(Some(action(true)), false);
        }
        let fastener = CuttersAction::New(NewCutterArgs {
            from: "screw-m4x12".to_owned(),
            id: None,
            out: folder.path().join("x.toml"),
            force: false,
        });
        let error = run(Some(fastener), false, &mut Vec::new()).unwrap_err();
        assert!(error.to_string().contains("is a fastener"), "{error}");
    }
}
