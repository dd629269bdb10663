//! What a telescope that is printed in place needs of its job and its printer.

use super::error::TelescopeRunError;
use super::load_skeleton::Shop;
use crate::base::setting::{Key, Setting};
use crate::job::telescope::{Bends, TelescopeJob, Twists};
use crate::printer::{Quantity, Sourced, Support, Sure};
use crate::telescope::sizes::{JointSizes, Tails};

/// Length of the flange beside the cone at its tail, mm: what slides along the bore.
const BAND_MM: f64 = 0.6;

/// Refuses what cannot be printed in place, whatever the curve.
pub fn refuse_unlike(job: &TelescopeJob) -> Result<(), TelescopeRunError> {
    let bends = (job.curvature == Bends::Each)
        .then(|| [Bends::Each, Bends::One].map(|value| Setting::new(Key::Curvature, value)));
    let twists = (job.torsion == Twists::Each)
        .then(|| [Twists::Each, Twists::One].map(|value| Setting::new(Key::Torsion, value)));
    match bends.or(twists).filter(|_| job.in_place) {
        Some([given, remedy]) => Err(TelescopeRunError::UnlikeInPlace { given, remedy }),
        None => Ok(()),
    }
}

/// Refuses to print limbs in place.
pub fn refuse_limbs(job: &TelescopeJob) -> Result<(), TelescopeRunError> {
    match job.in_place {
        true => Err(TelescopeRunError::LimbsInPlace),
        false => Ok(()),
    }
}

/// Returns the clearance of shells that are printed in each other.
///
/// A printer without one leaves resin or support between them, whatever clearance is ordered.
pub fn clearance(job: &TelescopeJob, shop: &Shop) -> Result<Sourced<f64>, TelescopeRunError> {
    let printer = &shop.printer;
    let known = printer.number(Quantity::ClearanceInPlacePerSideMm);
    let known = known.ok_or_else(|| TelescopeRunError::NotInPlace {
        printer: printer.id.clone(),
        quantity: Quantity::ClearanceInPlacePerSideMm,
    })?;
    Ok(match job.clearance {
        Some(ordered) => Sourced {
            value: ordered.mm(),
            source: "ordered".to_owned(),
            sure: Sure::OwnChoice,
            process_default_of: None,
        },
        None => known.clone(),
    })
}

/// Returns the measures with rings in place of caps, and holes where a process leaves powder.
pub fn with_rings(sizes: JointSizes, shop: &Shop) -> JointSizes {
    let printer = &shop.printer;
    let leaves_powder = printer.support == Support::None;
    let flange_mm = sizes.flange_mm.max(sizes.tail_cone_mm(0.0) + BAND_MM);
    JointSizes {
        flange_mm,
        lip_mm: flange_mm,
        tails: Tails::InPlace {
            vent_mm: leaves_powder.then_some(printer.min_opening_mm.value),
        },
        ..sizes
    }
}
