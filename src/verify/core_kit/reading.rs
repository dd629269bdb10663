//! Reading a kit of an object on a base from its folder, and the judgement of it.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use super::checks::core_checks;
use super::error::{CoreVerifyError, SCHEMA};
use super::evidence::CoreEvidence;
use super::facts::judge_core;
use super::packages::packages_check;
use super::promise::{CoreCertificate, CorePartPromise, CorePromise, CutSheetPromise, PanelsFile};
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::io::{DrawnLine, decode_cut_svg, decode_dxf, read_model};
use crate::mesh::TriMesh;
use crate::verify::files::is_inside_kit;
use crate::verify::strangers::find_strangers;
use crate::verify::{
    CHECKLIST_FILE, Change, Check, FileChange, SHEET_FILE, SUMS_FILE, files_check,
};

/// The word by which a checklist says that it is that of an object on a base.
const KIND: &str = "core";
/// By how much the squared length of a normal may differ from 1.
const UNIT_SLACK: f64 = 1e-9;
/// The model in a kit, in single precision.
pub const MODEL_FILE: &str = "model.stl";
/// The panels in a kit.
pub const PANELS_FILE: &str = "panels.json";
/// The certificate of the base in a kit.
pub const CORE_CERTIFICATE_FILE: &str = "certificate.json";

/// The judgement of a kit.
#[derive(Debug, Clone, PartialEq)]
pub struct CoreJudgement {
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// Files that changed since the kit was made.
    pub changes: Vec<FileChange>,
    /// Files in the kit's folder that are not on its list and cannot be printed.
    pub unlisted: Vec<String>,
}

/// Returns true if the kit in a folder is that of an object on a base.
pub fn is_core(folder: &Path) -> bool {
    let bytes = std::fs::read(folder.join(CHECKLIST_FILE)).unwrap_or_default();
    let sheet: Option<Value> = serde_json::from_slice(&bytes).ok();
    sheet.is_some_and(|sheet| sheet["kind"] == KIND)
}

/// Reads every file of a kit and judges it.
///
/// # Errors
/// There is no such kit in the folder, a file of it cannot be read, or the watch was stopped.
pub fn verify_core(folder: &Path, watch: &Watch) -> Result<CoreJudgement, CoreVerifyError> {
    let evidence = read(folder)?;
    let facts = judge_core(&evidence, watch)?;
    let mut checks = core_checks(&evidence.promise, &facts);
    let mut changes = find_changes(folder, &evidence.promise.files)?;
    let listed = evidence.promise.files.keys().map(String::as_str);
    let strangers = find_strangers(folder, listed)?;
    changes.extend(strangers.changes);
    checks.push(files_check(&changes));
    checks.push(packages_check(folder, &evidence));
    Ok(CoreJudgement {
        checks,
        changes,
        unlisted: strangers.others,
    })
}

fn read(folder: &Path) -> Result<CoreEvidence, CoreVerifyError> {
    let promise: CorePromise = read_json(&folder.join(CHECKLIST_FILE))?;
    let panels: PanelsFile = read_json(&folder.join(PANELS_FILE))?;
    let certificate: CoreCertificate = read_json(&folder.join(CORE_CERTIFICATE_FILE))?;
    for (file, found) in [
        (CHECKLIST_FILE, promise.schema),
        (PANELS_FILE, panels.schema),
        (CORE_CERTIFICATE_FILE, certificate.schema),
    ] {
        let path = folder.join(file);
        if found != SCHEMA {
            return Err(CoreVerifyError::Schema { path, found });
        }
    }
    if let Some(file) = outside(&promise) {
        return Err(CoreVerifyError::Outside { file });
    }
    if let Some((file, why)) = mismatch(&panels, &certificate) {
        let path = folder.join(file);
        return Err(CoreVerifyError::Mismatch { path, why });
    }
    let scale = promise.printer.print_scale_ratio.map(Vector::from);
    let part = |part: &CorePartPromise| {
        let mesh = read_model(&folder.join(&part.file))?;
        Ok(in_model(&mesh, part, scale))
    };
    let parts: Result<Vec<TriMesh>, CoreVerifyError> = promise.parts.iter().map(part).collect();
    let sheets = promise.cut_sheets.iter();
    let drawings: Result<Vec<_>, _> = sheets.map(|sheet| read_sheet(folder, sheet)).collect();
    Ok(CoreEvidence {
        model: read_model(&folder.join(MODEL_FILE))?,
        parts: parts?,
        drawings: drawings?,
        promise,
        certificate,
        panels,
    })
}

/// Returns a file that is named and lies outside of the kit.
fn outside(promise: &CorePromise) -> Option<String> {
    let sheets = promise.cut_sheets.iter();
    let drawn = sheets.flat_map(|sheet| [&sheet.dxf, &sheet.svg]);
    let named = promise.parts.iter().map(|part| &part.file);
    let mut named = named.chain(drawn).chain(promise.files.keys());
    named.find(|file| !is_inside_kit(file)).cloned()
}

/// Reads both drawings of a sheet.
fn read_sheet(
    folder: &Path,
    sheet: &CutSheetPromise,
) -> Result<[Vec<DrawnLine>; 2], CoreVerifyError> {
    let fault = |file: &str, fault| CoreVerifyError::Drawing {
        path: folder.join(file),
        fault,
    };
    let dxf = read_file(&folder.join(&sheet.dxf))?;
    let svg = read_file(&folder.join(&sheet.svg))?;
    let dxf = decode_dxf(&dxf).map_err(|why| fault(&sheet.dxf, why))?;
    let (svg, _) = decode_cut_svg(&svg).map_err(|why| fault(&sheet.svg, why))?;
    Ok([dxf, svg])
}

/// Returns a part as it was read in its place in the model, in its own size.
fn in_model(mesh: &TriMesh, part: &CorePartPromise, scale: Option<Vector>) -> TriMesh {
    let scale = scale.unwrap_or(Vector::repeat(1.0));
    mesh.map_vertices(|p| {
        let nominal = p.coords.component_div(&scale).into();
        part.print_from_model.to_model(&nominal)
    })
}

/// Returns the file of panels and certificate that is not sound, and the reason.
fn mismatch(
    panels: &PanelsFile,
    certificate: &CoreCertificate,
) -> Option<(&'static str, &'static str)> {
    // A longer normal would exaggerate distances.
    let is_unit = |[x, y, z, _]: &[f64; 4]| (x * x + y * y + z * z - 1.0).abs() <= UNIT_SLACK;
    if !certificate.planes.iter().all(is_unit) {
        let why = "a normal of its planes has not the length 1";
        return Some((CORE_CERTIFICATE_FILE, why));
    }
    let mut all = panels.panels.iter().enumerate();
    let is_wrong = all.any(|(index, panel)| {
        panel.panel != index + 1
            || panel.plane >= certificate.planes.len()
            || panel.outline_mm.len() < 3
    });
    let why = "its panels are not numbered, or lie on no plane of the certificate";
    (is_wrong || panels.panels.is_empty()).then_some((PANELS_FILE, why))
}

fn read_file(path: &Path) -> Result<Vec<u8>, CoreVerifyError> {
    std::fs::read(path).map_err(|source| CoreVerifyError::File {
        path: path.to_owned(),
        source,
    })
}

fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, CoreVerifyError> {
    serde_json::from_slice(&read_file(path)?).map_err(|source| CoreVerifyError::Json {
        path: path.to_owned(),
        source,
    })
}

/// Returns the files whose bytes are not those that the checklist lists, and the papers that do not
/// agree with it.
fn find_changes(
    folder: &Path,
    files: &BTreeMap<String, String>,
) -> Result<Vec<FileChange>, CoreVerifyError> {
    let mut changes = Vec::new();
    let changed = |file: &str, change| FileChange {
        file: file.to_owned(),
        change,
    };
    for (file, sha256) in files {
        let path = folder.join(file);
        if !path.is_file() {
            changes.push(changed(file, Change::Missing));
        } else if sha256_hex(&[&read_file(&path)?]) != *sha256 {
            changes.push(changed(file, Change::Altered));
        }
    }
    let list = std::fs::read_to_string(folder.join(SUMS_FILE)).unwrap_or_default();
    for paper in [CHECKLIST_FILE, SHEET_FILE] {
        let path = folder.join(paper);
        if !path.is_file() {
            changes.push(changed(paper, Change::Missing));
            continue;
        }
        let line = format!("{}  {paper}\n", sha256_hex(&[&read_file(&path)?]));
        if !list.contains(&line) {
            changes.push(changed(paper, Change::Altered));
        }
    }
    Ok(changes)
}
