//! `equipoise slice MODEL` with a field: a model in two materials, as two stacks of images.

use std::path::Path;

use serde::Serialize;

use super::args::{FieldChoice, SliceArgs};
use super::exit::Exit;
use super::show::{say, table};
use super::wing::Ends;
use crate::base::numbers::quantity;
use crate::base::units::show_mm3;
use crate::base::watch::Watch;
use crate::field::FileError;
use crate::io::{ReadError, read_model};
use crate::kit::{KitError, KitWriter};
use crate::mend::{MendError, mend};
use crate::mesh::{Defects, Solid, scaled};
use crate::printer::{Printer, ProfileError};
use crate::slice::{BodyRow, DitherOrder, DitherRow, Off, SliceError, dither_model, weigh_stacks};

/// A reason why a model was not written in two materials.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DitheredError {
    /// The model cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The model cannot be mended.
    #[error("the model cannot be repaired")]
    Mend(#[from] Box<MendError>),
    /// The model is no solid.
    #[error("the model is no solid: {0}; remedy: see what can be done (`equipoise inspect`)")]
    NoSolid(Box<Defects>),
    /// The field's file cannot be used.
    #[error(transparent)]
    Field(#[from] FileError),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The model cannot be sliced.
    #[error(transparent)]
    Slice(#[from] SliceError),
    /// The folder cannot be written.
    #[error(transparent)]
    Kit(#[from] KitError),
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
    folder: &'a Path,
    dithered: &'a DitherRow,
    /// The figures of the images, as they were read again.
    weighed: &'a BodyRow,
    /// Their difference from the model with its field.
    off: Off,
    is_kept: bool,
}

/// Writes a model in two materials into a folder, reads the images again and weighs them.
///
/// # Errors
/// The model, its field or its printer cannot be used, or the folder cannot be written.
pub fn slice_dithered(args: &SliceArgs, target: &Path, ends: Ends) -> Result<Exit, DitheredError> {
    let Ends { voice, stop, out } = ends;
    args.existing().allows(target)?;
    let watch = Watch::silent_until(stop.flag());
    let written = write(args, target, &watch);
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let row = written?;
    let weighed = weigh_stacks(target, &row, &watch)?;
    let found = Found {
        folder: target,
        dithered: &row,
        off: row.wanted.off(&weighed),
        is_kept: row.wanted.off(&weighed).is_kept(),
        weighed: &weighed,
    };
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&found)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&found))?;
    } else if !found.is_kept {
        say(text(&found).trim_end());
    }
    Ok(if found.is_kept {
        Exit::Kept
    } else {
        Exit::NotKept
    })
}

/// Writes the images; nothing is left if that fails.
fn write(args: &SliceArgs, target: &Path, watch: &Watch) -> Result<DitherRow, DitheredError> {
    let dither = &args.dither;
    let printer = Printer::find(dither.printer.as_deref().unwrap_or_default())?;
    let field = dither.field.as_ref().map(FieldChoice::order).transpose()?;
    let (Some(field), Some(materials)) = (field, &dither.materials) else {
        // The reader of the command line asks for both.
        return Err(SliceError::NoKit {
            path: args.kit.clone(),
        }
        .into());
    };
    let factor = |longest| dither.scaling.scaling().factor(longest);
    let mended = mend(read_model(&args.kit)?, Default::default(), factor, watch);
    let mended = mended.map_err(Box::new)?;
    let solid = Solid::new(scaled(&mended.mesh, mended.scale_ratio));
    let solid = solid.map_err(|defects| DitheredError::NoSolid(Box::new(defects)))?;
    let name = args.kit.file_name().unwrap_or_default().to_string_lossy();
    let words = dither.field.as_ref().map(ToString::to_string);
    let order = DitherOrder {
        model: &name,
        solid: &solid,
        field: &field,
        field_words: words.as_deref().unwrap_or_default(),
        printer: &printer,
        materials: materials.each_ref().map(String::as_str),
    };
    let writer = KitWriter::begin(target, args.existing(), watch)?;
    let row = dither_model(&order, &writer, watch)?;
    writer.finish()?;
    Ok(row)
}

/// Words the materials, what the images weigh and how far that is off.
fn text(found: &Found) -> String {
    let row = found.dithered;
    let head = ["material", "density", "volume", "images"].map(str::to_owned);
    let rows = row.materials.iter().map(|material| {
        let folder = found.folder.join(&material.folder);
        [
            material.id.clone(),
            quantity(material.density_g_cm3, "g/cm³"),
            show_mm3(material.volume_mm3),
            folder.display().to_string(),
        ]
    });
    let rows: Vec<[String; 4]> = std::iter::once(head).chain(rows).collect();
    let Off {
        mass_ratio,
        center_mm,
        inertia_ratio,
    } = found.off;
    let [x, y, z] = found.weighed.center_mm;
    let kept = if found.is_kept { "kept" } else { "BROKEN" };
    format!(
        "{}the images weigh {}, centre ({x:.4}, {y:.4}, {z:.4}) mm on the plate\n\
         off: mass {:.5} %, centre {:.3} µm, inertia {:.5} % of its trace\n{kept}; {}\n",
        table(&rows),
        quantity(found.weighed.mass_g, "g"),
        100.0 * mass_ratio,
        1000.0 * center_mm,
        100.0 * inertia_ratio,
        Off::promise(),
    )
    .replace('\u{a0}', " ")
}
