//! Reading a kit of an object on a base from its folder, and the judgement of it.

use std::path::Path;

use super::base_files::{BaseCertificate, CoreCertificate, PanelsFile};
use super::checks::core_checks;
use super::error::CoreVerifyError;
use super::evidence::CoreEvidence;
use super::facts::judge_core;
use super::packages::packages_check;
use super::promise::{CorePartPromise, CorePromise, CutSheetPromise};
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::io::{DrawnLine, decode_cut_svg, decode_dxf, read_model};
use crate::mesh::TriMesh;
use crate::verify::kit_folder::{KitFolder, all_inside_kit};
use crate::verify::{CERTIFICATE_FILE, CHECKLIST_FILE, KindJudgement, KitFolderError, SHEET_FILE};

/// By how much the squared length of a normal may differ from 1.
const UNIT_SLACK: f64 = 1e-9;
/// The model in a kit, in single precision.
pub const MODEL_FILE: &str = "model.stl";
/// The panels in a kit.
pub const PANELS_FILE: &str = "panels.json";
/// The certificate of the base in a kit.
pub const CORE_CERTIFICATE_FILE: &str = "certificate.json";

/// Reads every file of a kit and judges it.
///
/// # Errors
/// There is no such kit in the folder, a file of it cannot be read, or the watch was stopped.
pub fn verify_core(folder: &Path, watch: &Watch) -> Result<KindJudgement, CoreVerifyError> {
    let folder = KitFolder { path: folder };
    let evidence = read(&folder)?;
    let facts = judge_core(&evidence, watch)?;
    let checks = core_checks(&evidence.promise, &facts);
    let papers = [CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE];
    let mut judgement = folder.judgement(checks, &evidence.promise.files, &papers)?;
    judgement.checks.push(packages_check(&folder, &evidence));
    Ok(judgement)
}

fn read(folder: &KitFolder) -> Result<CoreEvidence, CoreVerifyError> {
    let promise: CorePromise = folder.list(CHECKLIST_FILE)?;
    let panels: PanelsFile = folder.list(PANELS_FILE)?;
    let certificate = folder.list::<CoreCertificate>(CORE_CERTIFICATE_FILE)?;
    let drawn = promise.cut_sheets.iter();
    let drawn = drawn.flat_map(|sheet| [&sheet.dxf, &sheet.svg]);
    let named = promise.parts.iter().map(|part| &part.file);
    all_inside_kit(named.chain(drawn).chain(promise.files.keys()))?;
    if promise.stock.is_empty() {
        let why = "it names no sheets at hand";
        return Err(folder.mismatch(CHECKLIST_FILE, why).into());
    }
    if let Some((file, why)) = mismatch(&panels, &certificate) {
        return Err(folder.mismatch(file, why).into());
    }
    let scale = promise.printer.print_scale_ratio.map(Vector::from);
    let read_mesh = |file: &str| read_model(&folder.path.join(file)).map_err(KitFolderError::from);
    let files = promise.parts.iter().map(|part| read_mesh(&part.file));
    let files: Vec<TriMesh> = files.collect::<Result<_, KitFolderError>>()?;
    let parts = files.iter().zip(&promise.parts);
    let parts = parts.map(|(mesh, part)| in_model(mesh, part, scale));
    let sheets = promise.cut_sheets.iter();
    let drawings: Result<Vec<_>, _> = sheets.map(|sheet| read_sheet(folder, sheet)).collect();
    Ok(CoreEvidence {
        model: read_mesh(MODEL_FILE)?,
        parts: parts.collect(),
        files,
        drawings: drawings?,
        promise,
        certificate,
        panels,
    })
}

/// Reads both drawings of a sheet.
fn read_sheet(
    folder: &KitFolder,
    sheet: &CutSheetPromise,
) -> Result<[Vec<DrawnLine>; 2], CoreVerifyError> {
    let fault = |file: &str, fault| CoreVerifyError::Drawing {
        path: folder.path.join(file),
        fault,
    };
    let dxf = folder.bytes(&sheet.dxf)?;
    let svg = folder.bytes(&sheet.svg)?;
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
    let planes = |of: &BaseCertificate| of.planes.iter().chain(&of.sides).all(is_unit);
    if !certificate.bases().all(planes) {
        let why = "a normal of its planes has not the length 1";
        return Some((CORE_CERTIFICATE_FILE, why));
    }
    let bases: Vec<&BaseCertificate> = certificate.bases().collect();
    let mut all = panels.panels.iter().enumerate();
    let is_wrong = all.any(|(index, panel)| {
        panel.panel != index + 1
            || bases
                .get(panel.polyhedron.wrapping_sub(1))
                .is_none_or(|base| panel.plane >= base.planes.len())
            || panel.outline_mm.len() < 3
    });
    let why = "its panels are not numbered, or lie on no plane of the certificate";
    (is_wrong || panels.panels.is_empty()).then_some((PANELS_FILE, why))
}
