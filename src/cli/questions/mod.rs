//! The questions on a terminal: what is missing for `prepare`, one after the other.
//!
//! `prompt` holds the prompts, and is the only file that knows their library. `choices` holds the
//! answers that are offered.

mod choices;
mod prompt;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::args::{PrepareArgs, quoted};
use super::flags::{command_for_new_profile, flag};
use super::show::say;
use crate::advice::{Case, name_direction};
use crate::base::setting::{Key, Setting};
use crate::base::units::Length;
use crate::base::watch::{Cancelled, Watch};
use crate::error::Error;
use crate::goal::{GoalKind, Request, find_upright};
use crate::io::{file_near, read_model};
use crate::mend::mend;
use crate::mesh::{Defects, Solid, scaled};
use crate::printer::{Printer, ProfileError};
use choices::{GoalChoice, PrinterChoice, UpChoice};
pub use prompt::Unanswered;
use prompt::{choose, enter};

/// The line of a list of which nothing has the letters that were typed.
const NOTHING_FITS: &str = "nothing fits these letters: press Enter and choose again";
/// The printer whose profile a new one is made from in the example.
const EXAMPLE_PRINTER: &str = "prusa-mk4";
/// The sizes, mm, that are offered as they are in the file. Others are hardly mm.
const PLAUSIBLE_MM: std::ops::RangeInclusive<f64> = 20.0..=300.0;
/// The size that is offered if the file's is not plausible, mm.
const USUAL_SIZE_MM: f64 = 100.0;
/// The number of likely poses that are offered with their reasons.
const MOST_POSES: usize = 3;
/// Folders that are tried for a kit whose own is taken.
const MOST_FOLDERS: usize = 99;

/// A reason why the questions did not make an order.
#[derive(Debug, thiserror::Error)]
pub enum AskError {
    /// A question has no answer.
    #[error(transparent)]
    Unanswered(#[from] Unanswered),
    /// The model cannot be used.
    #[error(transparent)]
    Model(Box<Error>),
    /// A printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
}

impl From<Error> for AskError {
    fn from(error: Error) -> Self {
        Self::Model(Box::new(error))
    }
}

impl From<Cancelled> for AskError {
    fn from(_: Cancelled) -> Self {
        Self::Unanswered(Unanswered::Stopped)
    }
}

/// Asks for everything that is missing, and prints the command that does without the questions.
///
/// `printer` is the shop's own, `None` if it has none.
///
/// # Errors
/// A question was not answered, or the model cannot be used.
pub fn ask(mut args: PrepareArgs, printer: Option<String>) -> Result<PrepareArgs, AskError> {
    let mut typed: Vec<String> = Vec::new();
    let path = match args.model.clone() {
        Some(path) => path,
        None => ask_model()?,
    };
    if args.model.is_none() {
        typed.push(path.to_string_lossy().into_owned());
        args.model = Some(path.clone());
    }
    let solid = load(&path, &args)?;
    let kind = match args.goal {
        Some(kind) => kind,
        None => choose("What should it do?", &GoalChoice::all(), NOTHING_FITS)?.0,
    };
    if args.goal.is_none() {
        typed.push(flag(&Setting::new(Key::Goal, kind)));
        args.goal = Some(kind);
    }
    let id = match args.printer.clone().or(printer) {
        Some(id) => id,
        None => {
            let id = ask_printer()?;
            typed.push(flag(&Setting::new(Key::Printer, &id)));
            args.printer = Some(id.clone());
            id
        }
    };
    if args.scaling.is_open() {
        let size = ask_size(&solid, &Printer::find(&id)?)?;
        typed.push(flag(&Setting::new(Key::Size, size)));
        args.scaling.size = Some(size);
    }
    if args.up.is_none() {
        let choice = ask_up(&solid, kind)?;
        typed.extend(choice.typed());
        args.up = choice.up;
    }
    typed.extend(free_folder(&mut args, kind));
    say(&format!(
        "\nThe same without questions:\n  {}\n",
        command(std::env::args_os().skip(1).collect(), &typed)
    ));
    args.answered = typed;
    Ok(args)
}

fn ask_model() -> Result<PathBuf, Unanswered> {
    let read = |line: &str| {
        let path = PathBuf::from(line.trim());
        let is_there = path.is_file();
        let there = is_there.then_some(path);
        there.ok_or_else(|| no_file(line.trim().as_ref()))
    };
    enter("Which model?", "", "an STL, OBJ, PLY or 3MF file", read)
}

/// Returns that a file is not there, and which one may be meant.
fn no_file(path: &Path) -> String {
    let meant = file_near(path).map(|file| format!("; did you mean {}?", file.display()));
    format!("there is no such file{}", meant.unwrap_or_default())
}

fn ask_printer() -> Result<String, AskError> {
    let printers = Printer::all()?;
    let choices: Vec<PrinterChoice> = printers.iter().map(PrinterChoice::from).collect();
    let other = format!("another: {}", command_for_new_profile(EXAMPLE_PRINTER));
    Ok(choose("Which printer?", &choices, &other)?.id)
}

/// Asks for the longest side; the default is that of the file if its numbers are plausibly mm.
fn ask_size(solid: &Solid, printer: &Printer) -> Result<Length, Unanswered> {
    let sides = solid.mesh().aabb().size();
    let longest_mm = sides.max();
    let is_plausible = PLAUSIBLE_MM.contains(&longest_mm);
    let default_mm = if is_plausible {
        longest_mm.round()
    } else {
        USUAL_SIZE_MM
    };
    let most_mm = printer.max_model_length_mm();
    let read = move |line: &str| {
        let size = line.parse::<Length>();
        let size = size.map_err(|error| error.to_string().replace("; remedy: ", "; "))?;
        let fitting = Some(size).filter(|size| size.mm() <= most_mm);
        fitting.ok_or_else(|| format!("at most {most_mm:.0}mm with this printer"))
    };
    let [x, y, z] = [sides.x, sides.y, sides.z].map(|side| side / longest_mm * default_mm);
    let help = format!("its longest side, such as 80mm or 4in ({x:.0} × {y:.0} × {z:.0} mm)");
    enter("How large?", &format!("{default_mm}mm"), &help, read)
}

/// Asks which side is down, or where a rotor's shaft runs.
fn ask_up(solid: &Solid, kind: GoalKind) -> Result<UpChoice, AskError> {
    if kind == GoalKind::Balance {
        let question = "Along which axis of the file is its shaft?";
        return Ok(choose(question, &UpChoice::shafts(), NOTHING_FITS)?);
    }
    let case = Case {
        solid,
        request: Request::new(kind),
        wall_mm: 1.0,
        least_wall_mm: 1.0,
        wall_step_mm: 1.0,
        density_g_cm3: 1.0,
        greatest_size_mm: f64::INFINITY,
        fill: None,
    };
    let mut poses = find_upright(solid, &Watch::silent())?;
    poses.truncate(MOST_POSES);
    let choices = UpChoice::poses(&poses, kind, |pose| name_direction(&case, &pose.up));
    Ok(choose("Which side is down?", &choices, NOTHING_FITS)?)
}

/// Reads the model in the numbers of its file, and mends it as ordered.
fn load(path: &Path, args: &PrepareArgs) -> Result<Solid, Error> {
    let order = args.repair.unwrap_or_default();
    let factor = |longest| args.scaling.scaling().factor(longest);
    let mended = mend(read_model(path)?, order, factor, &Watch::silent());
    let mesh = mended
        .map_err(|source| Error::Mend {
            path: path.to_owned(),
            source: Box::new(source),
        })?
        .mesh;
    Solid::new(scaled(&mesh, 1.0)).map_err(|defects| Error::NotSolid {
        path: path.to_owned(),
        source: Box::new(Defects::of(&mesh).unwrap_or(defects)),
    })
}

/// Chooses a folder for the kit if its own is taken; returns what to type for it.
fn free_folder(args: &mut PrepareArgs, kind: GoalKind) -> Option<String> {
    let is_open = args.out.is_none() && !args.force;
    let model = args.model.as_ref().filter(|_| is_open)?;
    let stem = model.file_stem()?.to_string_lossy().into_owned();
    let own = format!("{stem}-{kind}");
    if !Path::new(&own).exists() {
        return None;
    }
    let mut others = (2..=MOST_FOLDERS).map(|number| format!("{own}-{number}"));
    let free = others.find(|name| !Path::new(name).exists())?;
    args.out = Some(PathBuf::from(&free));
    Some(flag(&Setting::new(Key::Out, free)))
}

/// Returns the command that was typed, with the answers.
fn command(words: Vec<OsString>, answers: &[String]) -> String {
    let words = words.iter().map(|word| word.to_string_lossy().into_owned());
    let mut words: Vec<String> = words.collect();
    if !words.iter().any(|word| word == "prepare") {
        words.insert(0, "prepare".to_owned());
    }
    words.extend(answers.iter().cloned());
    let quoted: Vec<String> = words.iter().map(|word| quoted(word)).collect();
    format!("equipoise {}", quoted.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_holds_what_was_typed_and_what_was_answered() {
        let typed = |line: &str| line.split_whitespace().map(OsString::from).collect();
        let answers = ["--goal=stand".to_owned(), "--size=100mm".to_owned()];
        for (line, whole) in [
            ("a.stl", "equipoise prepare a.stl --goal=stand --size=100mm"),
            (
                "prepare a.stl -v",
                "equipoise prepare a.stl -v --goal=stand --size=100mm",
            ),
        ] {
            assert_eq!(command(typed(line), &answers), whole);
        }
    }
}
