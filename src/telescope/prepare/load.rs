//! Load: the printer, and the curve or the skeleton in mm.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::error::TelescopeRunError;
use super::load_skeleton::{self as skeleton, CurveFile, LoadedSkeleton, Shop};
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::curve::{Curve, NamedCurve};
use crate::error::Error;
use crate::geom::{Aabb, Point};
use crate::io::{LinesError, decode_curve, read_bytes};
use crate::job::JobError;
use crate::job::telescope::TelescopeJob;
use crate::printer::Printer;

/// The curve that is asked for, in mm.
#[derive(Clone)]
pub struct Loaded {
    pub curve: Curve,
    /// Its file; `None` for measures.
    pub file: Option<CurveFile>,
}

/// The ending of a skeleton file.
const SKELETON_ENDING: &str = "toml";

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

/// The input: a curve, or a skeleton.
pub enum Input {
    Curve(Loaded),
    Skeleton(Box<LoadedSkeleton>),
}

/// Reads the job's input: what it holds decides what it is.
pub fn input(job: &TelescopeJob, shop: &Shop, watch: &Watch) -> Result<Input, TelescopeRunError> {
    let source = &job.curve.source;
    let Some(path) = job.curve_file() else {
        let named: NamedCurve = source.parse()?;
        return Ok(Input::Curve(curve(job, shop, named.points(), None)?));
    };
    let bytes = read_bytes(path)?;
    let sha256 = sha256_hex(&[&bytes]);
    if let Some(expected) = job.curve.sha256.as_ref().filter(|known| **known != sha256) {
        return Err(TelescopeRunError::Job(JobError::ModelChanged {
            path: PathBuf::from(source),
            found: sha256,
            expected: expected.clone(),
        }));
    }
    let file = CurveFile { bytes, sha256 };
    let is_skeleton = Path::new(source).extension() == Some(OsStr::new(SKELETON_ENDING));
    if is_skeleton {
        return Ok(Input::Skeleton(Box::new(skeleton::of_text(job, file)?)));
    }
    match decode_curve(&file.bytes) {
        Ok(points) => Ok(Input::Curve(curve(job, shop, points, Some(file))?)),
        Err(LinesError::Branch { .. }) => {
            let found = skeleton::of_lines(job, shop, file)?;
            Ok(Input::Skeleton(Box::new(found)))
        }
        Err(fault) if skeleton::is_model(&fault, &file.bytes) => {
            let found = skeleton::of_model(job, file, watch)?;
            Ok(Input::Skeleton(Box::new(found)))
        }
        Err(fault) => Err(TelescopeRunError::Lines {
            path: path.to_owned(),
            fault,
        }),
    }
}

/// Takes the points of a curve, and refuses corners.
///
/// A file's points are the corners of a polyline. Few of them stand for a smooth curve, so a spline
/// is laid through them.
fn curve(
    job: &TelescopeJob,
    shop: &Shop,
    points: Vec<Point>,
    file: Option<CurveFile>,
) -> Result<Loaded, TelescopeRunError> {
    let fault = |fault| TelescopeRunError::Curve {
        name: job.curve.source.clone(),
        fault,
    };
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
