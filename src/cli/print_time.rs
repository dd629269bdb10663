//! The print time of a kit, as the slicer that is installed states it.

use super::args::Request;
use super::show::{say, table};
use super::signals::Stop;
use super::voice::Voice;
use crate::base::watch::Watch;
use crate::prepare::{Prepared, time_kit};
use crate::sheet::PrintTimeRow;
use crate::verify::SHEET_FILE;

/// The name of the line on the print time.
pub const PRINT_TIME: &str = "print time";

/// Returns a line on the print time for a person at a terminal, where a slicer is installed. `None`
/// elsewhere, and if the kit has it already or breaks a promise.
///
/// The first Ctrl-C stops the slicer only: the kit is written.
pub fn print_time(
    prepared: &Prepared,
    request: &Request,
    voice: Voice,
    stop: &Stop,
) -> Option<String> {
    let is_asked = prepared.checklist.print_time.is_none() && prepared.failure.is_none();
    if !is_asked || !voice.manner.is_terminal {
        return None;
    }
    let sheet = request.out.join(SHEET_FILE);
    let begin = || say(&waiting_words(&sheet.display().to_string()));
    let watch = Watch::silent_until(stop.flag());
    let row = time_kit(&request.job, &prepared.kit, &watch, begin)?;
    let line = [PRINT_TIME.to_owned(), print_time_words(&row)];
    Some(table(&[line]).replace('\u{a0}', " "))
}

/// Returns what a person may do while the slicer runs.
fn waiting_words(sheet: &str) -> String {
    format!(
        "The kit is ready: open {sheet}.\n\
         The slicer works out the print time, for a minute or more; Ctrl-C skips that."
    )
}

/// Words the print time and the filament.
pub fn print_time_words(row: &PrintTimeRow) -> String {
    format!("{}; by {}", row.words(), row.slicer_words())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whoever_waits_for_the_slicer_knows_that_the_kit_is_ready() {
        let said = waiting_words("humpty-stand/job.html");
        assert!(said.starts_with("The kit is ready: open humpty-stand/job.html"));
        assert!(said.contains("Ctrl-C skips"), "{said}");
    }
}
