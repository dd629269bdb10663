//! Load: the printer, and the curve in mm.

use std::path::PathBuf;

use super::error::TelescopeRunError;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::curve::{Curve, NamedCurve};
use crate::error::Error;
use crate::geom::{Aabb, Point};
use crate::io::{decode_curve, read_bytes};
use crate::job::JobError;
use crate::job::telescope::TelescopeJob;
use crate::printer::{Material, Printer};

/// The printer and the material of a job.
pub struct Shop {
    pub printer: Printer,
    pub material: Material,
}

/// The curve that is asked for, in mm.
pub struct Loaded {
    pub curve: Curve,
    /// Its file; `None` for measures.
    pub file: Option<CurveFile>,
}

/// The file of a curve.
#[derive(Debug, Clone)]
pub struct CurveFile {
    pub bytes: Vec<u8>,
    /// The SHA-256 of these bytes.
    pub sha256: String,
}

/// Most points through which a spline is laid. More lie so near that lines between them do.
const MOST_SPLINE_POINTS: usize = 500;

/// Edges on which corners are looked for.
const CORNER_EDGES: usize = 240;

/// Finds the job's printer and material.
pub fn shop(job: &TelescopeJob, watch: &Watch) -> Result<Shop, TelescopeRunError> {
    watch.enter(Phase::Load);
    let printer = Printer::find(&job.printer.id)?;
    let material = printer.material(job.printer.material.as_deref())?.clone();
    Ok(Shop { printer, material })
}

/// Reads the job's curve, and refuses corners.
///
/// A file's points are the corners of a polyline. Few of them stand for a smooth curve, so a spline
/// is laid through them.
pub fn curve(job: &TelescopeJob, shop: &Shop) -> Result<Loaded, TelescopeRunError> {
    let source = &job.curve.source;
    let fault = |fault| TelescopeRunError::Curve {
        name: source.clone(),
        fault,
    };
    let (points, file) = points(job)?;
    let is_dense = points.len() > MOST_SPLINE_POINTS;
    let raw = if is_dense {
        Curve::of_polyline(points)
    } else {
        Curve::through(&points)
    };
    let raw = raw.map_err(fault)?;
    let longest = Aabb::of_points(raw.points()).size().max();
    let factor = job.curve.scaling.factor(longest);
    let curve = raw.scaled_to(factor * raw.length_mm());
    curve.refuse_corners(CORNER_EDGES).map_err(fault)?;
    let longest_mm = factor * longest;
    let checked = shop.printer.check_length(longest_mm);
    checked.map_err(Error::from)?;
    Ok(Loaded { curve, file })
}

/// Returns the points of the curve as they are given, and their file.
fn points(job: &TelescopeJob) -> Result<(Vec<Point>, Option<CurveFile>), TelescopeRunError> {
    let source = &job.curve.source;
    let Some(path) = job.curve_file() else {
        let named: NamedCurve = source.parse()?;
        return Ok((named.points(), None));
    };
    let bytes = read_bytes(path)?;
    let found = sha256_hex(&[&bytes]);
    if let Some(expected) = job.curve.sha256.as_ref().filter(|sha256| **sha256 != found) {
        return Err(TelescopeRunError::Job(JobError::ModelChanged {
            path: PathBuf::from(source),
            found,
            expected: expected.clone(),
        }));
    }
    let points = decode_curve(&bytes).map_err(|fault| TelescopeRunError::Lines {
        path: path.to_owned(),
        fault,
    })?;
    let sha256 = found;
    Ok((points, Some(CurveFile { bytes, sha256 })))
}
