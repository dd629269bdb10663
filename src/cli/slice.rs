//! `equipoise slice`: the toolpaths of a kit, and how they will balance.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::SliceArgs;
use super::dithered::{DitheredError, slice_dithered};
use super::exit::Exit;
use super::quoted::{QuotedError, ToQuote, quote_words};
use super::show::{say, table};
use super::signals::Stop;
use super::toolpaths::toolpaths_text;
use super::voice::{Manner, Voice};
use super::wing::Ends;
use crate::base::numbers::quantity;
use crate::base::units::show_mm3;
use crate::base::watch::Watch;
use crate::io::layers::StackRow;
use crate::kit::KitError;
use crate::quote::Quote;
use crate::slice::{
    ImageOrder, Imaged, SliceError, SliceFormat, SliceOrder, Slices, image_kit, slice_kit,
};
use crate::verify::{PrintedError, PrintedJudgement, verify_printed};

/// A reason why no toolpaths were written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SliceCommandError {
    /// The kit cannot be sliced.
    #[error(transparent)]
    Slice(#[from] SliceError),
    /// The folder cannot be written.
    #[error(transparent)]
    Kit(#[from] KitError),
    /// The toolpaths cannot be judged.
    #[error(transparent)]
    Printed(#[from] PrintedError),
    /// The kit cannot be quoted.
    #[error(transparent)]
    Quoted(#[from] QuotedError),
    /// The model cannot be printed in two materials.
    #[error(transparent)]
    Dithered(#[from] DitheredError),
    /// An option says nothing in this format.
    #[error("{0} says nothing in this format; remedy: leave it out")]
    Needless(&'static str),
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
    slices: &'a Slices,
    judgement: &'a PrintedJudgement,
    #[serde(skip_serializing_if = "Option::is_none")]
    quote: Option<&'a Quote>,
}

/// The findings about images as they are printed as JSON.
#[derive(Serialize)]
struct FoundImages<'a> {
    folder: &'a Path,
    layers: &'a StackRow,
    judgement: &'a PrintedJudgement,
}

/// Slices a kit, writes what its machine reads and judges it; prints the findings to `out`.
pub fn slice(
    args: &SliceArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, SliceCommandError> {
    if let Some(option) = args.needless() {
        return Err(SliceCommandError::Needless(option));
    }
    if args.dither.field.is_some() {
        let target = target(args, "layers");
        return Ok(slice_dithered(args, &target, Ends { voice, stop, out })?);
    }
    match args.format {
        None | Some(SliceFormat::Gcode) => slice_toolpaths(args, voice, stop, out),
        Some(_) => slice_images(args, voice, stop, out),
    }
}

/// Slices a kit into toolpaths by a slicer.
fn slice_toolpaths(
    args: &SliceArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, SliceCommandError> {
    let target = target(args, "gcode");
    let existing = args.existing();
    existing.allows(&target)?;
    let to_quote = args.quote.then(|| ToQuote::read(&args.kit)).transpose()?;
    let watch = Watch::silent_until(stop.flag());
    let order = SliceOrder {
        kit: args.kit.clone(),
        slicer: args.slicer.clone(),
        profile: args.profile.clone(),
    };
    let written = slice_kit(&order, &watch)
        .map_err(SliceCommandError::from)
        .and_then(|mut sliced| {
            let quote = to_quote.map(|kit| kit.add(&sliced.slices, &mut sliced.files));
            let quote = quote.transpose()?;
            sliced.files.write_watched(&target, existing, &watch)?;
            Ok((sliced.slices, quote))
        });
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let (slices, quote) = written?;
    let files = slices.plates.iter();
    let files: Vec<PathBuf> = files.map(|plate| target.join(&plate.toolpaths)).collect();
    let judgement = verify_printed(&args.kit, &files, &watch)?;
    if voice.json {
        let found = Found {
            folder: &target,
            slices: &slices,
            judgement: &judgement,
            quote: quote.as_ref(),
        };
        writeln!(out, "{}", serde_json::to_string_pretty(&found)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&slices, &judgement, &target, voice.manner))?;
        if let Some(quote) = &quote {
            write!(out, "{}", quote_words(quote, &target))?;
        }
    } else if !judgement.passes() {
        say(toolpaths_text(&judgement, voice.manner).trim_end());
    }
    Ok(if judgement.passes() {
        Exit::Kept
    } else {
        Exit::NotKept
    })
}

/// Slices a kit into layer images at the pixels of its printer.
fn slice_images(
    args: &SliceArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, SliceCommandError> {
    let target = target(args, "layers");
    let existing = args.existing();
    existing.allows(&target)?;
    let watch = Watch::silent_until(stop.flag());
    let order = ImageOrder {
        kit: args.kit.clone(),
        format: args.format.unwrap_or(SliceFormat::Stack),
        profile: args.profile.clone(),
    };
    let written = image_kit(&order, &watch)
        .map_err(SliceCommandError::from)
        .and_then(|imaged| {
            imaged.files.write_watched(&target, existing, &watch)?;
            Ok(imaged)
        });
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let imaged = written?;
    let files: Vec<PathBuf> = imaged.judged.iter().map(|file| target.join(file)).collect();
    let judgement = verify_printed(&args.kit, &files, &watch)?;
    if voice.json {
        let found = FoundImages {
            folder: &target,
            layers: &imaged.row,
            judgement: &judgement,
        };
        writeln!(out, "{}", serde_json::to_string_pretty(&found)?)?;
    } else if !voice.manner.quiet {
        let said = toolpaths_text(&judgement, voice.manner);
        write!(out, "{}{said}", images_text(&imaged, &target))?;
    } else if !judgement.passes() {
        say(toolpaths_text(&judgement, voice.manner).trim_end());
    }
    Ok(if judgement.passes() {
        Exit::Kept
    } else {
        Exit::NotKept
    })
}

/// Returns the folder to write: the one that was asked for, or one beside the kit.
fn target(args: &SliceArgs, ending: &str) -> PathBuf {
    args.out.clone().unwrap_or_else(|| {
        let name = args.kit.file_name().map(|name| name.to_string_lossy());
        let name = name.map_or_else(|| "kit".to_owned(), |name| name.into_owned());
        args.kit.with_file_name(format!("{name}-{ending}"))
    })
}

/// Words the images of each plate, and where they were written.
fn images_text(imaged: &Imaged, folder: &Path) -> String {
    let head = ["plate", "layers", "layer", "pixels", "pixel", "material"];
    let rows = imaged.row.plates.iter().map(|plate| {
        let pitch = plate.pixel_mm.map(|mm| format!("{mm:.4}"));
        vec![
            plate.plate.clone(),
            plate.layers.to_string(),
            quantity(plate.layer_mm, "mm"),
            format!("{} × {}", plate.pixels[0], plate.pixels[1]),
            format!("{} mm", pitch.join(" × ")),
            show_mm3(plate.volume_mm3),
        ]
    });
    let head = head.map(str::to_owned).to_vec();
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    format!("{}written to {}\n\n", table(&rows), folder.display())
}

fn text(slices: &Slices, judgement: &PrintedJudgement, folder: &Path, manner: Manner) -> String {
    let head = [
        "plate",
        "time",
        "parts",
        "support, brim, skirt",
        "toolpaths",
    ];
    let rows: Vec<[String; 5]> = std::iter::once(head.map(str::to_owned))
        .chain(slices.plates.iter().map(|plate| {
            [
                plate.plate.clone(),
                plate.time(),
                quantity(plate.parts_g, "g"),
                quantity(plate.support_g, "g"),
                folder.join(&plate.toolpaths).display().to_string(),
            ]
        }))
        .collect();
    let sum = format!(
        "all plates: {}, {} of parts, {} of support, brim and skirt; by {}\n",
        slices.time(),
        quantity(slices.parts_g(), "g"),
        quantity(slices.support_g(), "g"),
        slices.slicer
    );
    let untried = match slices.is_untried {
        true => format!("not tried: look at the layers in {} first\n", slices.slicer),
        false => String::new(),
    };
    let sliced = table(&rows) + &sum + &untried;
    sliced.replace('\u{a0}', " ") + "\n" + &toolpaths_text(judgement, manner)
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::args::{Cli, Command};

    #[test]
    fn the_toolpaths_lie_beside_their_kit() {
        let beside = |kit: &str, ending: &str| {
            let line = ["equipoise", "slice", kit];
            let Command::Slice(args) = Cli::try_parse_from(line).unwrap().command else {
                panic!("{kit}")
            };
            target(&args, ending).display().to_string()
        };
        assert_eq!(beside("kits/elephant", "gcode"), "kits/elephant-gcode");
        assert_eq!(beside("elephant/", "layers"), "elephant-layers");
    }
}
