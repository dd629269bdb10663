//! `equipoise core`: objects on a laser-cut base.

use std::path::Path;

use super::wing::Wing;
use crate::base::numbers::{measured, measured_extent};
use crate::base::units::format_count;
use crate::base::watch::Watch;
use crate::core_kit::{CoreRunError, prepare};
use crate::job::core_kit::CoreJob;
use crate::sheet::core_kit::{CorePartRow, CoreSheet};
use crate::verify::{JOB_FILE, find_model};
use crate::wing::{NoMore, Outcome};

/// Objects on a base.
pub struct CoreWing;

impl Wing for CoreWing {
    type Job = CoreJob;
    type Sheet = CoreSheet;
    type More = NoMore;
    type Error = CoreRunError;

    fn prepare(job: &CoreJob, watch: &Watch) -> Result<Outcome<CoreSheet>, CoreRunError> {
        prepare(job, watch)
    }

    fn job_in(folder: &Path) -> Result<CoreJob, CoreRunError> {
        Ok(CoreJob {
            model_copy: find_model(folder),
            ..CoreJob::read(&folder.join(JOB_FILE))?
        })
    }

    fn lines(sheet: &CoreSheet) -> String {
        let masses = &sheet.masses;
        let stands = sheet.toppling_deg.map_or_else(String::new, |toppling| {
            format!("stands     until leaned by {}\n", measured(toppling, "°"))
        });
        let polyhedra = sheet.base.polyhedra.len();
        let several = match polyhedra {
            0 => String::new(),
            count => format!(" of {count} polyhedra with"),
        };
        let brackets =
            sheet.parts.len() - sheet.part_rows.iter().filter(|row| is_shell(row)).count();
        format!(
            "size       {}, {}\n\
             base      {several} {}, {} of the model, for {}\n\
             parts      {} and {} in {}, for {}\n\
             mass       printed {}, panels {}; solid it would be {}\n{stands}",
            measured_extent(&sheet.model.size_mm),
            measured(sheet.mass_g, "g"),
            format_count(sheet.base.panels, "panel"),
            measured(100.0 * sheet.base.volume_ratio, "%"),
            format_count(sheet.cut_sheets.len(), "sheet"),
            format_count(sheet.parts.len() - brackets, "part"),
            format_count(brackets, "bracket"),
            format_count(sheet.units.len(), "unit"),
            sheet.printer.name,
            measured(masses.shell_g, "g"),
            measured(masses.panels_g, "g"),
            measured(masses.if_solid_g, "g"),
        )
    }
}

fn is_shell(row: &CorePartRow) -> bool {
    row.id.starts_with(|c: char| c.is_ascii_digit())
}
