//! The check of a kit's outside against the model that it was made of.

use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use super::cover::{Lie, ON_SHEET_MM, Sheet, Sheets, Whose};
use super::reading::{read_file, read_mesh};
use super::redrawn::{find_missing, find_strays};
use super::rooms::Rooms;
use super::{Check, CheckKind, Evidence, Limit, Shells, VerifyError};
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::mass::moments_of_mesh;
use crate::mesh::{Solid, TriMesh, scaled};
use crate::repair::{InnerSurfaces, RepairOrder, repair_with, weld};
use crate::thin::{ThickenError, thicken};

/// A stated size or volume of the model may differ by this share.
const SIZE_RATIO: f64 = 1e-9;

/// Checks that the outside of the uncut result is that of the model in this file, in the stated
/// size. The sockets of hardware and the gap for a string are left out.
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
    let order = stated["repair"].as_str().and_then(|text| text.parse().ok());
    let order: RepairOrder = order.unwrap_or_default();
    let redrawn_mm = stated["redrawn"]["within_mm"].as_f64();
    let redrawn_mm = redrawn_mm.filter(|_| order.remesh.is_some());
    let within_mm = redrawn_mm.unwrap_or(ON_SHEET_MM);
    let promise =
        format!("the outside is that of the model, within {within_mm} mm, but for triangles");
    let verdict = |count: usize, words: Option<String>| {
        let limit = Limit::at_most(0.0, "");
        Check::new(CheckKind::Model, &promise, Some(count as f64), limit).at(words)
    };
    let sha256 = sha256_hex(&[&read_file(file)?]);
    if stated["sha256"].as_str() != Some(&sha256) {
        let words = "it is another file than the one of the checklist";
        return Ok(verdict(1, Some(words.to_owned())));
    }
    let (mesh, _) = repair_with(read_mesh(file)?, order.inner, watch)?;
    let scale_ratio = stated["scale_ratio"].as_f64().unwrap_or(f64::NAN);
    let mesh = scaled(&mesh, scale_ratio);
    let rooms = Rooms::of(evidence);
    let outer = rooms.close_gap(&outer_of(evidence));
    // Cavities that the model came with are among the voids.
    let all = match order.inner {
        InnerSurfaces::Cavities => &rooms.close_gap(&evidence.hollowed),
        _ => &outer,
    };
    if redrawn_mm.is_some() {
        let limit_mm = within_mm + stated["thickened"]["moved_mm"].as_f64().unwrap_or(0.0);
        let strays = find_strays(&outer, &mesh, limit_mm, watch)?;
        let off = [strays, find_missing(all, &mesh, limit_mm, watch)?].concat();
        let off = rooms.leave_out(off);
        return Ok(verdict(off.len(), name_first(&off)));
    }
    let model = thickened(mesh, stated, watch)?;
    let count = model.triangles().len();
    if stated["triangles"].as_u64() != Some(count as u64) {
        let words = format!("it has {count} triangles, not {}", stated["triangles"]);
        return Ok(verdict(count, Some(words)));
    }
    if let Some(words) = find_false_size(stated, &model) {
        return Ok(verdict(count, Some(words)));
    }
    let off = [find_off(&outer, &model), find_off(&model, all)].concat();
    let off = rooms.leave_out(off);
    Ok(verdict(off.len(), name_first(&off)))
}

/// Returns a sentence about a size or volume that is not the model's; `None` if all are right.
fn find_false_size(stated: &Value, model: &TriMesh) -> Option<String> {
    let shells = Shells::of_mesh(&weld(model)).outward;
    let volume_mm3: f64 = shells
        .iter()
        .map(|shell| moments_of_mesh(shell).volume())
        .sum();
    let size = model.aabb().size();
    let numbers = [
        ("size along x", &stated["size_mm"][0], size.x),
        ("size along y", &stated["size_mm"][1], size.y),
        ("size along z", &stated["size_mm"][2], size.z),
        ("volume", &stated["volume_mm3"], volume_mm3),
    ];
    let is_false = |(_, stated, found): &(&str, &Value, f64)| {
        let is_near = |stated: f64| (stated - found).abs() <= SIZE_RATIO * found.abs();
        !stated.as_f64().is_some_and(is_near)
    };
    let (name, stated, found) = numbers.into_iter().find(is_false)?;
    Some(format!("its {name} is {found}, not {stated}"))
}

/// Returns the outside of the uncut result.
fn outer_of(evidence: &Evidence) -> TriMesh {
    Shells::of_mesh(&weld(&evidence.hollowed)).outer_mesh()
}

/// Names the first of some places.
fn name_first(places: &[Point]) -> Option<String> {
    let at = places.first()?;
    let [x, y, z] = [at.x, at.y, at.z];
    Some(format!("{x:.1},{y:.1},{z:.1} mm"))
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
