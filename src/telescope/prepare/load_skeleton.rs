//! Load: skeletons from their files, from lines that branch, and from models.

use std::path::PathBuf;

use super::error::TelescopeRunError;
use crate::base::units::Length;
use crate::base::watch::{Phase, Watch};
use crate::geom::{Aabb, Point, Vector};
use crate::goal::find_upright;
use crate::io::{LinesError, decode_lines, decode_model};
use crate::job::telescope::{Root, TelescopeJob};
use crate::mesh::{Defects, Solid, scaled};
use crate::printer::{Material, Printer};
use crate::repair::{one_body, repair};
use crate::skeleton::{Skeleton, SkeletonError};

/// Shells that lines carry which tell of no thickness.
const SHELLS_OF_LINES: f64 = 4.0;
/// The wall, engagement and clearances of a shell over its printer's least wall, for such lines.
const PITCH_WALLS: f64 = 3.0;

/// The printer and the material of a job.
pub struct Shop {
    pub printer: Printer,
    pub material: Material,
}

/// The file of a curve.
#[derive(Debug, Clone)]
pub struct CurveFile {
    pub bytes: Vec<u8>,
    /// The SHA-256 of these bytes.
    pub sha256: String,
}

/// The skeleton that is asked for, in mm.
pub struct LoadedSkeleton {
    pub skeleton: Skeleton,
    /// The model that it was found in; `None` for skeletons from files.
    pub solid: Option<Solid>,
    /// The direction that points up.
    pub up: Vector,
    /// Its file.
    pub file: CurveFile,
    /// The longest side of what was read, mm.
    pub longest_mm: f64,
}

/// Reads a skeleton file.
pub fn of_text(job: &TelescopeJob, file: CurveFile) -> Result<LoadedSkeleton, TelescopeRunError> {
    let text = String::from_utf8_lossy(&file.bytes);
    let skeleton = Skeleton::from_toml(&job.curve.source, &text)?;
    sized(job, skeleton, file)
}

/// Reads lines that branch. They tell of no thickness: the root's radius is that of all, or one
/// with room for some shells.
pub fn of_lines(
    job: &TelescopeJob,
    shop: &Shop,
    file: CurveFile,
) -> Result<LoadedSkeleton, TelescopeRunError> {
    let fault = |fault| TelescopeRunError::Lines {
        path: PathBuf::from(&job.curve.source),
        fault,
    };
    let (points, links) = decode_lines(&file.bytes).map_err(fault)?;
    let factor = factor(job, &points);
    let usual_mm = SHELLS_OF_LINES * PITCH_WALLS * shop.printer.min_wall_mm.value;
    let radius_mm = job.root_radius.map_or(usual_mm, Length::mm);
    let skeleton = Skeleton::of_lines(&points, &links, radius_mm / factor)?;
    sized(job, skeleton, file)
}

/// Returns true if a file that holds no curve is a model.
pub fn is_model(fault: &LinesError, bytes: &[u8]) -> bool {
    match fault {
        LinesError::Model => true,
        LinesError::NoLines { .. } => decode_model(bytes).is_ok_and(|mesh| !mesh.is_empty()),
        _ => false,
    }
}

/// Finds the skeleton of a model.
pub fn of_model(
    job: &TelescopeJob,
    file: CurveFile,
    watch: &Watch,
) -> Result<LoadedSkeleton, TelescopeRunError> {
    let path = || PathBuf::from(&job.curve.source);
    let mesh = decode_model(&file.bytes).map_err(|fault| TelescopeRunError::Model {
        path: path(),
        fault: Box::new(fault),
    })?;
    let (mesh, _) = repair(mesh, watch)?;
    let longest = mesh.longest_side_mm();
    let factor = job.curve.scaling.factor(longest);
    let solid = Solid::new(scaled(&mesh, factor)).map_err(|defects| {
        let fault = Box::new(Defects::of(&mesh).unwrap_or(defects));
        TelescopeRunError::NotSolid {
            path: path(),
            fault,
        }
    })?;
    one_body(&solid, watch)?.map_err(|fault| TelescopeRunError::NotOneBody {
        path: path(),
        fault: Box::new(fault),
    })?;
    watch.enter(Phase::Solve);
    let mut skeleton = Skeleton::of(&solid, watch)?;
    choose_root(&mut skeleton, job.root)?;
    let up = find_upright(&solid, watch)?.first().map(|pose| pose.up);
    Ok(LoadedSkeleton {
        skeleton,
        up: up.unwrap_or_else(Vector::z),
        longest_mm: factor * longest,
        solid: Some(solid),
        file,
    })
}

fn factor(job: &TelescopeJob, points: &[Point]) -> f64 {
    let longest = Aabb::of_points(points).size().max();
    job.curve.scaling.factor(longest)
}

/// Returns a skeleton in the size that is asked for, grown from the root that is.
fn sized(
    job: &TelescopeJob,
    skeleton: Skeleton,
    file: CurveFile,
) -> Result<LoadedSkeleton, TelescopeRunError> {
    let points: Vec<Point> = skeleton.nodes.iter().map(|node| node.at).collect();
    let factor = factor(job, &points);
    let mut skeleton = skeleton.scaled(factor);
    choose_root(&mut skeleton, job.root)?;
    Ok(LoadedSkeleton {
        skeleton,
        solid: None,
        up: Vector::z(),
        longest_mm: factor * Aabb::of_points(&points).size().max(),
        file,
    })
}

/// Lets a skeleton grow from the node that is asked for, if one is.
///
/// # Errors
/// It has no such node.
pub fn choose_root(skeleton: &mut Skeleton, root: Option<Root>) -> Result<(), SkeletonError> {
    match root {
        None => {}
        Some(Root::Node(id)) => skeleton.root_at(id)?,
        Some(Root::Near(place)) => skeleton.root = skeleton.nearest(&Point::from(place)),
    }
    Ok(())
}
