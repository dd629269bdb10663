//! Load: the printer, the cutter with its sheet, and the model as one solid body in mm.

use super::error::CoreRunError;
use crate::base::watch::{Phase, Watch};
use crate::cutter::{Cutter, Fastener, KerfAt, StockSheet};
use crate::io;
use crate::job::core_kit::CoreJob;
use crate::mend::{MendError, mend};
use crate::mesh::{Defects, Solid, scaled};
use crate::polyhedra::Ground;
use crate::printer::{Material, Printer};
use crate::repair::{RepairOrder, one_body_with};

/// The machines and the stock of a job.
pub struct Shop {
    pub printer: Printer,
    pub material: Material,
    pub cutter: Cutter,
    pub sheet: StockSheet,
    pub kerf: KerfAt,
    pub fasteners: Vec<Fastener>,
}

/// The model, made ready for a base.
pub struct Loaded {
    pub ground: Ground,
    /// The job, bound to the bytes of the model.
    pub job: CoreJob,
    /// These bytes.
    pub bytes: Vec<u8>,
    pub warnings: Vec<String>,
}

/// Finds the job's machines and stock. A sheet that the cutter does not cut is refused.
pub fn shop(job: &CoreJob, watch: &Watch) -> Result<Shop, CoreRunError> {
    watch.enter(Phase::Load);
    let printer = Printer::find(&job.printer.id)?;
    let material = printer.material(job.printer.material.as_deref())?.clone();
    let cutter = Cutter::find(&job.cutting.cutter)?;
    let sheet = StockSheet::find(&job.cutting.sheet)?;
    let kerf = cutter.check_sheet(&sheet)?;
    Ok(Shop {
        printer,
        material,
        cutter,
        sheet,
        kerf,
        fasteners: Fastener::all()?,
    })
}

/// Reads the job's model, repairs it and proves that it bounds one solid body.
pub fn model(job: &CoreJob, shop: &Shop, watch: &Watch) -> Result<Loaded, CoreRunError> {
    let path = || job.model.path.clone();
    let bytes = io::read_bytes(job.model_file())?;
    let content = |source| io::ReadError::Content {
        path: path(),
        source,
    };
    let mesh = io::decode_model(&bytes).map_err(content)?;
    let bound = job.clone().bind_to(&bytes)?;
    watch.check()?;
    let order = RepairOrder::default();
    let factor = |longest| job.model.scaling.factor(longest);
    let mended = mend(mesh, order, factor, watch).map_err(|error| match error {
        MendError::Cancelled(cancelled) => cancelled.into(),
        source => CoreRunError::Mend {
            path: path(),
            source: Box::new(source),
        },
    })?;
    let not_solid = |source: Defects| CoreRunError::NotSolid {
        path: path(),
        source: Box::new(source),
    };
    let solid = Solid::new(scaled(&mended.mesh, mended.scale_ratio))
        .map_err(|defects| not_solid(Defects::of(&mended.mesh).unwrap_or(defects)))?;
    watch.check()?;
    let is_one = one_body_with(&solid, order.inner, watch)?;
    is_one.map_err(|source| CoreRunError::NotOneBody {
        path: path(),
        source: Box::new(source),
    })?;
    let fits = shop.printer.fits(solid.mesh().aabb().size().into()) == Some(true);
    let warning =
        "the model fits the printer whole; a base makes sense for a larger size".to_owned();
    Ok(Loaded {
        ground: Ground::new(&solid).map_err(not_solid)?,
        job: bound,
        bytes,
        warnings: fits.then_some(warning).into_iter().collect(),
    })
}
