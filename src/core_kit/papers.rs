//! The kit in memory: its files, its checklist and its page.

use super::asked::Asked;
use super::error::CoreRunError;
use super::files::packages;
use super::judge::Draft;
use super::scene::{Shown, pictures};
use crate::base::watch::{Phase, Watch};
use crate::job::ModelChoice;
use crate::kit::Kit;
use crate::page::{CorePage, CoreProof, core_certificate, core_job};
use crate::sheet::core_kit::CoreSheet;
use crate::verify::{
    CERTIFICATE_FILE, CORE_CERTIFICATE_FILE, JOB_FILE, MODEL_FILE, MODEL_FOLDER, PANELS_FILE,
    SHEET_FILE,
};
use crate::wing::{Papers, Prepared, read_back};

/// The base in a kit, for a person to edit.
const BASE_FILE: &str = "base.toml";
/// The ending of drawings that the page shows.
const DRAWING: &str = ".svg";

/// Puts a judged kit together, with its page.
pub fn finish(
    asked: &Asked,
    draft: Draft,
    watch: &Watch,
) -> Result<Prepared<CoreSheet>, CoreRunError> {
    watch.enter(Phase::Report);
    let Shown { pictures, stage } = pictures(asked, &draft.made, &draft.sheet.ballast, watch)?;
    let mut kit = Kit::default();
    for part in &draft.made.parts {
        kit.add(&part.file, part.bytes.clone());
    }
    for (file, bytes) in packages(asked, &draft.made)? {
        kit.add(&file, bytes);
    }
    for (file, bytes) in &draft.drawings {
        kit.add(file, bytes.clone());
    }
    let panels = read_back(PANELS_FILE, &draft.panels_json)?;
    let certificate = read_back(CORE_CERTIFICATE_FILE, &draft.certificate_json)?;
    kit.add(MODEL_FILE, draft.model_stl);
    kit.add(PANELS_FILE, draft.panels_json.into_bytes());
    kit.add(CORE_CERTIFICATE_FILE, draft.certificate_json.into_bytes());
    kit.add(BASE_FILE, draft.made.built.plan.to_toml().into_bytes());
    kit.add(JOB_FILE, asked.job.in_kit().to_toml()?.into_bytes());
    let copy = ModelChoice::copy_name(&asked.job.model.path, &asked.job.name());
    kit.add(&format!("{MODEL_FOLDER}{copy}"), asked.model_bytes.to_vec());
    for picture in &pictures {
        kit.add(&picture.file, picture.bytes());
    }
    watch.check()?;
    let papers = Papers::listed(kit, draft.sheet)?;
    let drawn = draft.drawings.iter();
    let drawn = drawn.filter(|(file, _)| file.ends_with(DRAWING));
    let drawings: Vec<String> = drawn
        .map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned())
        .collect();
    let page = CorePage {
        sheet: &papers.sheet,
        sha256: &papers.sha256,
        pictures: &pictures,
        view: Some(&stage),
        drawings: &drawings,
    };
    let proof = CoreProof {
        certificate: &certificate,
        panels: &panels,
    };
    let (job, certificate) = (core_job(&page), core_certificate(&page, &proof));
    Ok(papers.sealed([(SHEET_FILE, job), (CERTIFICATE_FILE, certificate)]))
}
