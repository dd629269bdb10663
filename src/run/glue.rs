//! Dowels and films of glue: they join the parts and are not printed.

use super::Placed;
use crate::base::units::MM3_PER_CM3;
use crate::cut::{CutPlan, JointNote, PinSite};
use crate::mass::Moments;
use crate::printer::Quantity;
use crate::verify::GlueFilm;

impl Placed {
    /// Returns the moments of dowels and films of glue, in volumes of the printed material, model
    /// frame.
    pub fn joining_moments(&self, plan: &CutPlan) -> Moments {
        let density_g_cm3 = self.density_g_cm3();
        let films = plan.joints.iter().filter_map(|joint| self.glue_film(joint));
        let films = films
            .map(|film| film.face.film(film.thickness_mm) * (film.density_g_cm3 / density_g_cm3));
        let dowel = |pin: &PinSite| {
            let weight = pin.dowel.as_ref()?.density_g_cm3 / density_g_cm3;
            Some(pin.dowel_bar()?.moments() * weight)
        };
        let dowels = plan.pins.iter().filter_map(dowel);
        let all = films.chain(dowels);
        all.fold(Moments::default(), |sum, part| sum + part)
    }

    /// Returns the film of glue in a joint; `None` if the printer's profile does not say how thick
    /// it is.
    pub fn glue_film(&self, joint: &JointNote) -> Option<GlueFilm> {
        let number = |quantity| {
            self.shop
                .printer
                .number(quantity)
                .map(|number| number.value)
        };
        let thickness_mm = number(Quantity::GlueFilmMm)?;
        let density_g_cm3 = number(Quantity::GlueDensityGCm3)?;
        let volume_mm3 = joint.face.area_mm2 * thickness_mm;
        Some(GlueFilm {
            thickness_mm,
            density_g_cm3,
            mass_g: volume_mm3 * density_g_cm3 / MM3_PER_CM3,
            face: joint.face,
        })
    }
}
