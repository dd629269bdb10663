//! Load: the printer, the model as one solid body in mm, and the lengths that the printer makes.

use super::graded::sparse_print;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::cut::rods;
use crate::error::Error;
use crate::io;
use crate::job::{Job, SlicedRound};
use crate::mend::{MendError, mend};
use crate::mesh::{Defects, Solid, scaled};
use crate::printer::{Printer, check_room_for_void};
use crate::repair::one_body_with;
use crate::run::{Model, Shop};
use crate::thin::thicken;

/// Finds the job's printer, with the infill that its slicer was seen to lay. Refuses what it does
/// not print.
pub fn printer(job: &Job, watch: &Watch) -> Result<Printer, Error> {
    watch.enter(Phase::Load);
    let mut printer = Printer::find(&job.printer.id)?;
    if let (Some(infill), Some(ratio)) = (&mut printer.infill, infill_ratio(&job.sliced)) {
        *infill = infill.scaled(ratio);
    }
    printer.material(job.printer.material.as_deref())?;
    sparse_print(job, &printer)?;
    Ok(printer)
}

/// Returns the infill that the slicer of these rounds lays, over what the profile says of it;
/// `None` if they say no other than the profile.
pub fn infill_ratio(sliced: &[SlicedRound]) -> Option<f64> {
    sliced.last().and_then(|round| round.infill_ratio)
}

/// Reads the job's model, repairs it and proves that it bounds one solid body.
///
/// Defects are reported at their places in the file, not in mm.
pub fn model(job: &Job, printer: &Printer, watch: &Watch) -> Result<Model, Error> {
    let path = || job.model.path.clone();
    let bytes = io::read_bytes(job.model_file())?;
    let content = |source| io::ReadError::Content {
        path: path(),
        source,
    };
    let mesh = io::decode_model(&bytes).map_err(content)?;
    job.clone().bind_to(&bytes)?;
    watch.check()?;
    let factor = |longest| job.model.scaling.factor(longest);
    let mended = mend(mesh, job.repair, factor, watch).map_err(|error| match error {
        MendError::Cancelled(cancelled) => cancelled.into(),
        source => Error::Mend {
            path: path(),
            source: Box::new(source),
        },
    })?;
    let (mesh, scale_ratio) = (mended.mesh, mended.scale_ratio);
    printer.check_length(scale_ratio * mesh.longest_side_mm())?;
    watch.check()?;
    let solid = Solid::new(scaled(&mesh, scale_ratio)).map_err(|defects| Error::NotSolid {
        path: path(),
        source: Box::new(Defects::of(&mesh).unwrap_or(defects)),
    })?;
    watch.check()?;
    one_body_with(&solid, job.repair.inner, watch)?.map_err(|source| Error::NotOneBody {
        path: path(),
        source: Box::new(source),
    })?;
    let sha256 = sha256_hex(&[&bytes]);
    let wall = printer.least_wall_mm(solid.mesh().longest_side_mm());
    let thickened = if job.thicken {
        Some(thicken(&solid, wall.value, watch)?).filter(|thick| thick.balls > 0)
    } else {
        None
    };
    Ok(Model {
        solid: thickened
            .as_ref()
            .map_or(solid, |thick| thick.solid.clone()),
        thickened,
        repairs: mended.repairs,
        sha256,
        scale_ratio,
    })
}

/// Chooses wall and pitch on the printer's grid for a model of this size.
pub fn shop(job: &Job, printer: Printer, model: &Model) -> Result<Shop, Error> {
    let material = printer.material(job.printer.material.as_deref())?.clone();
    let size_mm = model.solid.mesh().longest_side_mm();
    let wall = printer.quantise_wall(job.wall.map(|wall| wall.mm()), size_mm)?;
    let asked_pitch_mm = job.pitch.map(|pitch| pitch.mm());
    let pitch_mm = printer.solve_pitch_mm(wall.wall_mm, size_mm, asked_pitch_mm);
    check_room_for_void(size_mm, wall.wall_mm)?;
    let rods = if job.pins.is_printed() {
        Vec::new()
    } else {
        rods()?
    };
    Ok(Shop {
        printer,
        material,
        wall,
        pitch_mm,
        rods,
    })
}
