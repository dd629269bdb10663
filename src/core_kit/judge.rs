//! The judge of the line: it sees what is written, and nothing of how it was made.

use super::asked::Asked;
use super::error::CoreRunError;
use super::files::{certificate, cut_sheets, drawings, model_stl, panels};
use super::made::Made;
use super::mass::Weighed;
use super::sheet::checklist;
use crate::base::watch::{Phase, Watch};
use crate::io::{DrawingError, DrawnLine, StlError, decode_cut_svg, decode_dxf, stl};
use crate::make::File;
use crate::sheet::Verdict;
use crate::sheet::core_kit::CoreSheet;
use crate::verify::{
    CHECKLIST_FILE, CORE_CERTIFICATE_FILE, CoreEvidence, CorePromise, PANELS_FILE, core_checks,
    judge_core,
};
use crate::wing::{Unwritable, json, read_back};

/// An object that was judged.
pub struct Draft {
    pub made: Made,
    pub sheet: CoreSheet,
    /// The model, the panels and the certificate as files.
    pub model_stl: Vec<u8>,
    pub panels_json: String,
    pub certificate_json: String,
    /// The drawings, two files a sheet.
    pub drawings: Vec<File>,
}

/// Judges what is written, from the texts of its files.
pub fn draft(
    asked: &Asked,
    made: Made,
    weighed: &Weighed,
    watch: &Watch,
) -> Result<Draft, CoreRunError> {
    watch.enter(Phase::Verify);
    let mut sheet = checklist(asked, &made, weighed);
    let model_stl = model_stl(asked);
    let panels_json = json(PANELS_FILE, &panels(&made))?;
    let certificate = certificate(asked, &made, &model_stl)?;
    let certificate_json = json(CORE_CERTIFICATE_FILE, &certificate)?;
    let drawings = drawings(asked, &made);
    let promise: CorePromise = read_back(CHECKLIST_FILE, &json(CHECKLIST_FILE, &sheet)?)?;
    let files = made.parts.iter().map(|part| stl::decode(&part.bytes));
    let evidence = CoreEvidence {
        model: stl::decode(&model_stl)?,
        panels: read_back(PANELS_FILE, &panels_json)?,
        certificate: read_back(CORE_CERTIFICATE_FILE, &certificate_json)?,
        parts: made.parts.iter().map(|part| part.in_model()).collect(),
        files: files.collect::<Result<_, StlError>>()?,
        drawings: lines(&drawings, cut_sheets(&made).len())?,
        promise,
    };
    let facts = judge_core(&evidence, watch)?;
    sheet.checks = core_checks(&evidence.promise, &facts);
    sheet.verdict = Verdict::of(&sheet.checks);
    Ok(Draft {
        made,
        sheet,
        model_stl,
        panels_json,
        certificate_json,
        drawings,
    })
}

/// Returns the lines of all drawings, as their files hold them.
fn lines(drawings: &[File], sheets: usize) -> Result<Vec<[Vec<DrawnLine>; 2]>, Unwritable> {
    let unreadable = |error: DrawingError| Unwritable::new("sheets", &error);
    let both = drawings.chunks_exact(2).take(sheets).map(|files| {
        let dxf = decode_dxf(&files[0].1).map_err(unreadable)?;
        let (svg, _) = decode_cut_svg(&files[1].1).map_err(unreadable)?;
        Ok([dxf, svg])
    });
    both.collect()
}
