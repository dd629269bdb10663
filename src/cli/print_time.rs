//! The print time of a kit, as the slicer that is installed states it.

use super::args::Request;
use super::show::{say, table};
use super::voice::Voice;
use crate::base::watch::Watch;
use crate::prepare::{Prepared, time_kit};
use crate::sheet::PrintTimeRow;

/// The name of the line on the print time.
pub const PRINT_TIME: &str = "print time";

/// Returns a line on the print time for a person at a terminal, where a slicer is installed. `None`
/// elsewhere, and if the kit has it already or breaks a promise.
pub fn print_time(prepared: &Prepared, request: &Request, voice: Voice) -> Option<String> {
    let is_asked = prepared.checklist.print_time.is_none() && prepared.failure.is_none();
    if !is_asked || !voice.manner.is_terminal {
        return None;
    }
    say("asking the slicer for the print time, which may take a minute");
    let row = time_kit(&request.job, &prepared.kit, &Watch::silent())?;
    let line = [PRINT_TIME.to_owned(), print_time_words(&row)];
    Some(table(&[line]).replace('\u{a0}', " "))
}

/// Words the print time and the filament.
pub fn print_time_words(row: &PrintTimeRow) -> String {
    format!("{}; by {} with its default speeds", row.words(), row.slicer)
}
