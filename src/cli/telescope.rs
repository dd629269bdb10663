//! `equipoise telescope`: chains of shells that slide open.

use std::path::Path;

use super::wing::Wing;
use crate::base::numbers::{measured, measured_extent};
use crate::base::units::format_count;
use crate::base::watch::Watch;
use crate::job::telescope::TelescopeJob;
use crate::sheet::network::{AnyTelescopeSheet, NetworkSheet};
use crate::sheet::pose::PoseRow;
use crate::sheet::telescope::TelescopeSheet;
use crate::telescope::{TelescopeRunError, Tried, prepare};
use crate::verify::{JOB_FILE, find_model};
use crate::wing::Outcome;

/// Telescopes.
pub struct TelescopeWing;

impl Wing for TelescopeWing {
    type Job = TelescopeJob;
    type Sheet = AnyTelescopeSheet;
    type More = Tried;
    type Error = TelescopeRunError;

    fn prepare(
        job: &TelescopeJob,
        watch: &Watch,
    ) -> Result<Outcome<AnyTelescopeSheet, Tried>, TelescopeRunError> {
        prepare(job, watch)
    }

    fn job_in(folder: &Path) -> Result<TelescopeJob, TelescopeRunError> {
        Ok(TelescopeJob {
            curve_copy: find_model(folder),
            ..TelescopeJob::read(&folder.join(JOB_FILE))?
        })
    }

    fn lines(sheet: &AnyTelescopeSheet) -> String {
        match sheet {
            AnyTelescopeSheet::Curve(sheet) => lines(sheet),
            AnyTelescopeSheet::Network(sheet) => network_lines(sheet),
        }
    }
}

/// Returns what came of a curve.
fn lines(sheet: &TelescopeSheet) -> String {
    let stands = sheet
        .worst_toppling_deg
        .filter(|_| sheet.least_angle_deg.is_some());
    let stands = stands.map_or_else(String::new, |worst| {
        let foot = sheet.foot.as_ref().map_or(0.0, |foot| foot.radius_mm);
        stands_line(foot, worst)
    });
    let poses = pose_lines(&sheet.poses);
    format!(
        "shells     {}, {} in all, for {}\n\
         all in     {}\n\
         all out    {}, {} along the curve\n\
         deviation  {} at most, {} rms\n\
         opens      {}, proved free of collisions\n{stands}{poses}\
         tip        plays by {}\n",
        sheet.shells.len(),
        measured(sheet.mass_g, "g"),
        sheet.printer.name,
        measured_extent(&sheet.collapsed_mm),
        measured_extent(&sheet.extended_mm),
        measured(sheet.curve.length_mm, "mm"),
        measured(sheet.deviation.max_mm, "mm"),
        measured(sheet.deviation.rms_mm, "mm"),
        sheet.order_words,
        measured(sheet.tip_play_mm, "mm"),
    )
}

fn stands_line(foot_mm: f64, worst_deg: f64) -> String {
    format!(
        "stands     on a foot of {} in radius, until leaned by {}\n",
        measured(foot_mm, "mm"),
        measured(worst_deg, "°")
    )
}

/// Returns what came of a skeleton.
fn network_lines(sheet: &NetworkSheet) -> String {
    let limbs = sheet.limbs.iter().map(|limb| {
        let own = &limb.sheet;
        format!(
            "limb {:<6}{}, from N{:02} to N{:02}, {} long, {} off at most\n",
            limb.id,
            format_count(own.shells.len(), "shell"),
            limb.from,
            limb.to,
            measured(own.curve.length_mm, "mm"),
            measured(own.deviation.max_mm, "mm")
        )
    });
    let stands = sheet.worst_toppling_deg.zip(sheet.foot.as_ref());
    let stands = stands.map_or_else(String::new, |(worst, foot)| {
        stands_line(foot.radius_mm, worst)
    });
    let solid = sheet
        .solid
        .iter()
        .map(|words| format!("solid      {words}\n"));
    format!(
        "limbs      {}, {} in all, for {}\n{}{}\
         all in     {}\n\
         all out    {}\n\
         opens      limb {}\n{stands}{}",
        sheet.limbs.len(),
        measured(sheet.mass_g, "g"),
        sheet.printer.name,
        limbs.collect::<String>(),
        solid.collect::<String>(),
        measured_extent(&sheet.collapsed_mm),
        measured_extent(&sheet.extended_mm),
        sheet.order.join(", then "),
        pose_lines(&sheet.poses),
    )
}

/// Returns the poses, and how near their tips are to the places that were asked for.
fn pose_lines(poses: &[PoseRow]) -> String {
    let line = |pose: &PoseRow| {
        let off = pose.off_mm.map_or_else(String::new, |off_mm| {
            format!(", {off_mm:.3} mm off the places asked for at most")
        });
        format!("pose       {}{off}, in {}\n", pose.name, pose.file)
    };
    poses.iter().map(line).collect()
}
