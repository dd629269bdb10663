//! The check of a kit's outside against the model that it was made of.

use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use super::cover::{Lie, ON_SHEET_MM, Sheet, Sheets, Whose};
use super::reading::{read_file, read_mesh};
use super::{Check, CheckKind, Evidence, Limit, Shells, VerifyError};
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::mesh::{Solid, TriMesh, scaled};
use crate::repair::{repair, weld};
use crate::thin::{ThickenError, thicken};

/// Checks that the outside of the uncut result is that of the model in this file, in the stated
/// size. Of a kit with hardware only the file is compared: its sockets are in the outside.
///
/// # Errors
/// The file cannot be read, holds no mesh, or the watch was stopped.
pub(super) fn model_check(
    file: &Path,
    sheet: &Value,
    evidence: &Evidence,
    watch: &Watch,
) -> Result<Check, VerifyError> {
    let stated = &sheet["model"];
    let promise =
        format!("the outside is that of the model, within {ON_SHEET_MM} mm, but for triangles");
    let verdict = |count: usize, words: Option<String>| {
        let limit = Limit::at_most(0.0, "");
        Check::new(CheckKind::Model, &promise, Some(count as f64), limit).at(words)
    };
    let sha256 = sha256_hex(&[&read_file(file)?]);
    let (mesh, _) = repair(read_mesh(file)?, watch)?;
    let scale_ratio = stated["scale_ratio"].as_f64().unwrap_or(f64::NAN);
    let model = thickened(scaled(&mesh, scale_ratio), stated, watch)?;
    let count = model.triangles().len();
    if stated["sha256"].as_str() != Some(&sha256) {
        let words = "it is another file than the one of the checklist";
        return Ok(verdict(count, Some(words.to_owned())));
    }
    if stated["triangles"].as_u64() != Some(count as u64) {
        let words = format!("it has {count} triangles, not {}", stated["triangles"]);
        return Ok(verdict(count, Some(words)));
    }
    if !evidence.promise.hardware.is_empty() {
        return Ok(verdict(0, None));
    }
    let outer = Shells::of_mesh(&weld(&evidence.hollowed)).outer_mesh();
    let off = [find_off(&outer, &model), find_off(&model, &outer)].concat();
    let words = off.first().map(|at| {
        let [x, y, z] = [at.x, at.y, at.z];
        format!("{x:.1},{y:.1},{z:.1} mm")
    });
    Ok(verdict(off.len(), words))
}

/// Thickens a model as the checklist says; returns it as it is if that says nothing, or if it
/// cannot be thickened so.
fn thickened(model: TriMesh, stated: &Value, watch: &Watch) -> Result<TriMesh, VerifyError> {
    let Some(wall_mm) = stated["thickened"]["wall_mm"].as_f64() else {
        return Ok(model);
    };
    let Ok(solid) = Solid::new(model.clone()) else {
        return Ok(model);
    };
    match thicken(&solid, wall_mm, watch) {
        Ok(thick) => Ok(thick.solid.into_mesh()),
        Err(ThickenError::Cancelled(stopped)) => Err(stopped.into()),
        Err(_) => Ok(model),
    }
}

/// Returns a point of each triangle that does not lie on a surface.
fn find_off(mesh: &TriMesh, surface: &TriMesh) -> Vec<Point> {
    let whose = Whose::Any;
    let sheets = surface.iter_corners();
    let sheets = Sheets::new(sheets.map(|corners| Sheet { corners, whose }).collect());
    let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
    let lies = corners
        .par_iter()
        .map(|corners| match sheets.lie(corners, None) {
            Lie::On(_) => None,
            Lie::Off(at) => Some(at),
        });
    lies.collect::<Vec<_>>().into_iter().flatten().collect()
}
