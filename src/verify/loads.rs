//! The weights besides the printed material: ballast, fillings, glue and dowels.

use super::ballast::{ballast_moments, fill_moments};
use super::hardware::mass_moments;
use super::joints::film_moments;
use super::sparse::sparse_moments;
use super::{Body, Evidence, Setting};
use crate::mass::Moments;

/// Moments of what a kit promises besides its printed parts, as moments of the print's density in
/// the model frame. Hardware is not among them: [`Setting`] has it.
pub(super) struct Loads {
    /// Ballast and fillings in the voids.
    pub(super) inside: Moments,
    /// Glue and dowels in the joints.
    pub(super) joined: Moments,
    /// Sparse infill. It is printed, though its regions are cavities of the written surfaces.
    pub(super) sparse: Moments,
    /// What a slicer lays beyond surfaces and regions.
    pub(super) beyond: Moments,
}

impl Loads {
    /// Returns the weights that the promise of a kit orders for its body.
    pub(super) fn of(evidence: &Evidence, body: &Body, setting: &Setting) -> Self {
        let promise = &evidence.promise;
        let density_g_mm3 = setting.density_g_mm3();
        let voids = body.shells.inner_mesh();
        let infill = promise.infill.as_ref();
        let joined_g = film_moments(promise) + mass_moments(&promise.dowels);
        Self {
            inside: ballast_moments(&promise.ballast, density_g_mm3)
                + fill_moments(promise.fill, &voids, setting.density_g_cm3),
            sparse: infill.map_or(Moments::default(), |infill| {
                sparse_moments(infill, &voids, &evidence.inner_in_model())
            }),
            beyond: promise.laid_beyond().unwrap_or_default(),
            joined: joined_g * density_g_mm3.recip(),
        }
    }
}
