//! CuraEngine: it knows no packages and no formulas. So the plate is taken apart into meshes, and
//! every setting that Cura works out from others is worked out here.
//!
//! * `definitions` finds Cura's list of settings, which the engine needs.
//! * `words` words the printer and the orders of a plate as settings.
//! * `meshes` writes bodies, regions and blockers of support as files.
//! * `finish` puts names, time and filament into the toolpaths.

mod definitions;
mod finish;
mod meshes;
mod words;

use std::fs::File;

use super::error::SlicerError;
use super::run::Work;
use crate::base::watch::Watch;
use crate::io::threemf::decode_plate;

/// Slices a plate and returns its toolpaths.
pub(super) fn slice(work: &Work, watch: &Watch) -> Result<File, SlicerError> {
    let definitions = definitions::Definitions::find(work.slicer.command())?;
    let own = match work.settings.profile() {
        Some(text) => definitions.check(text)?,
        None => Vec::new(),
    };
    let plate = || work.plate.name.to_owned();
    let objects = decode_plate(work.plate.bytes).map_err(|source| SlicerError::Plate {
        plate: plate(),
        source: Box::new(source),
    })?;
    let meshes = meshes::write(&objects, work)?;
    let whole = words::of_plate(work.settings, &objects);
    let toolpaths = work.file("engine.gcode");
    let said = work.run(watch, |command| {
        command
            .arg("slice")
            .arg("-v")
            .arg("-j")
            .arg(&definitions.printer);
        for (key, value) in own.iter().chain(&whole) {
            command.arg("-s").arg(format!("{key}={value}"));
        }
        command.arg("-e0");
        // The list of an extruder has its own values for these.
        for (key, value) in words::of_extruder(work.settings) {
            command.arg("-s").arg(format!("{key}={value}"));
        }
        for mesh in &meshes {
            command.arg("-l").arg(&mesh.file);
            for (key, value) in &mesh.settings {
                command.arg("-s").arg(format!("{key}={value}"));
            }
        }
        command.arg("-o").arg(&toolpaths);
        command.env(definitions::SEARCH_PATH, &definitions.folder);
    })?;
    finish::finish(work, &toolpaths, &said, &meshes)
}
