//! The rows of the toolpaths that a kit was weighed with.

use crate::run::Placed;
use crate::sheet::{PlateTimeRow, PrintTimeRow, ToolpathPart, ToolpathPlate, ToolpathsRow};

/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;

/// Returns the toolpaths of the kit as its job keeps them; `None` if nobody sliced it.
pub fn toolpaths_row(placed: &Placed) -> Option<ToolpathsRow> {
    let sliced = placed.job.toolpaths.as_ref()?;
    let plates = sliced.plates.iter().map(|plate| ToolpathPlate {
        file: plate.file.clone(),
        minutes: plate.minutes,
        parts_g: plate.parts_g,
        support_g: plate.support_g,
        filament_g: plate.filament_g,
    });
    let parts = sliced.parts.iter().map(|part| ToolpathPart {
        id: part.id.clone(),
        mass_g: part.mass_g,
    });
    Some(ToolpathsRow {
        slicer: sliced.slicer.clone(),
        profile_sha256: sliced.profile_sha256.clone(),
        mass_g: sliced.mass_g,
        miss_mm: sliced.miss_mm,
        tilt_deg: sliced.tilt_deg,
        plates: plates.collect(),
        parts: parts.collect(),
    })
}

/// Returns what the plates take by these toolpaths; `None` if nobody sliced the kit.
pub fn print_time_row(placed: &Placed) -> Option<PrintTimeRow> {
    let sliced = placed.job.toolpaths.as_ref()?;
    let plates = sliced.plates.iter().map(|plate| {
        let seconds = f64::from(plate.minutes) * S_PER_MIN;
        PlateTimeRow::new(&plate.file, seconds, plate.filament_g)
    });
    Some(PrintTimeRow {
        slicer: sliced.slicer.clone(),
        has_profile: sliced.profile_sha256.is_some(),
        plates: plates.collect(),
    })
}
