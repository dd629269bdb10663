//! The kit in memory: its files, its checklist and its pages.

use std::path::Path;

use super::animate::motion_scene;
use super::asked::Asked;
use super::error::TelescopeRunError;
use super::files::{packages, telescope_toml, wanted_points};
use super::judge::Draft;
use super::moving::Moving;
use super::scene::pictures;
use crate::base::watch::{Phase, Watch};
use crate::job::ModelChoice;
use crate::kit::Kit;
use crate::page::{TelescopePage, telescope_certificate, telescope_job};
use crate::sheet::telescope::TelescopeSheet;
use crate::verify::{
    CERTIFICATE_FILE, CURVE_FILE, MODEL_FOLDER, MOTION_FILE, MOTION_SCENE_FILE, SHEET_FILE,
};
use crate::wing::{Papers, Prepared};

/// File of the job in a kit.
const JOB: &str = "job.toml";
/// File of the telescope as plain data in a kit.
const TELESCOPE: &str = "telescope.toml";

/// Puts a judged kit together, with its pages.
pub fn finish(
    asked: &Asked,
    draft: Draft,
    watch: &Watch,
) -> Result<Prepared<TelescopeSheet>, TelescopeRunError> {
    watch.enter(Phase::Report);
    let pictures = pictures(&draft.made, &draft.poses.posed, watch)?;
    let asked_line = wanted_points(asked, &draft.made);
    let moving = Moving::of_chain(&draft.made, &draft.poses.posed, asked_line);
    let stage = moving.stage(watch)?;
    let mut kit = Kit::default();
    for part in &draft.made.parts {
        kit.add(&part.file, part.bytes.clone());
    }
    for (file, bytes) in packages(asked, &draft.made)? {
        kit.add(&file, bytes);
    }
    kit.add(MOTION_FILE, draft.motion_json.into_bytes());
    kit.add(MOTION_SCENE_FILE, motion_scene(&asked.job.name(), &moving)?);
    kit.add(CURVE_FILE, draft.curve_csv.into_bytes());
    for (file, text) in draft.poses.written().files() {
        kit.add(&file, text.into_bytes());
    }
    kit.add(TELESCOPE, telescope_toml(&draft.sheet)?.into_bytes());
    let mut job = asked.job.in_kit();
    if let Some(file) = &asked.file {
        job.curve.sha256 = Some(file.sha256.clone());
        let copy = ModelChoice::copy_name(Path::new(&job.curve.source), &job.name());
        kit.add(&format!("{MODEL_FOLDER}{copy}"), file.bytes.clone());
    }
    kit.add(JOB, job.to_toml()?.into_bytes());
    for picture in &pictures {
        kit.add(&picture.file, picture.bytes());
    }
    watch.check()?;
    let papers = Papers::listed(kit, draft.sheet)?;
    let page = TelescopePage {
        sheet: &papers.sheet,
        sha256: &papers.sha256,
        pictures: &pictures,
        view: Some(&stage),
    };
    let (job, certificate) = (telescope_job(&page), telescope_certificate(&page));
    Ok(papers.sealed([(SHEET_FILE, job), (CERTIFICATE_FILE, certificate)]))
}
