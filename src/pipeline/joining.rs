//! What joins the parts and is not printed: dowels, and the films of glue.

use super::Setup;
use crate::cut::{CutPlan, JointNote, PinSite};
use crate::mass::Moments;
use crate::printer::Quantity;
use crate::units::MM3_PER_CM3;
use crate::verify::{GlueFilm, Hardware};

/// The moments of dowels and films of glue as so much of the print's material, model frame.
pub fn joined(setup: &Setup, plan: &CutPlan) -> Moments {
    let density_g_cm3 = setup.material.density_g_cm3.value;
    let films = plan.joints.iter().filter_map(|joint| film(setup, joint));
    let films = films.map(|film| film.face.film(film.thickness_mm) * (film.density_g_cm3 / density_g_cm3));
    let dowels = plan.pins.iter().filter_map(|pin| {
        let weight = pin.dowel.as_ref()?.density_g_cm3 / density_g_cm3;
        Some(pin.dowel_bar()?.moments() * weight)
    });
    films.chain(dowels).fold(Moments::default(), |sum, part| sum + part)
}

/// The film of glue in a joint; none where the printer's profile does not say how thick it is.
pub fn film(setup: &Setup, joint: &JointNote) -> Option<GlueFilm> {
    let number = |quantity| setup.printer.number(quantity).map(|number| number.value);
    let (thickness_mm, density_g_cm3) = (number(Quantity::GlueFilmMm)?, number(Quantity::GlueDensityGCm3)?);
    let mass_g = joint.face.area_mm2 * thickness_mm * density_g_cm3 / MM3_PER_CM3;
    Some(GlueFilm { thickness_mm, density_g_cm3, mass_g, face: joint.face })
}

/// The dowels as the judge sees them.
pub fn dowels(plan: &CutPlan) -> Vec<Hardware> {
    plan.pins.iter().filter_map(dowel).collect()
}

fn dowel(pin: &PinSite) -> Option<Hardware> {
    let (dowel, bar) = (pin.dowel.as_ref()?, pin.dowel_bar()?);
    Some(Hardware {
        id: pin.id.clone(),
        what: dowel.rod.clone(),
        from_mm: bar.from.into(),
        to_mm: bar.to.into(),
        diameter_mm: pin.diameter_mm,
        hole_mm: 0.0,
        round_end: false,
        density_g_cm3: dowel.density_g_cm3,
        mass_g: bar.moments().volume() * dowel.density_g_cm3 / MM3_PER_CM3,
        depth_mm: dowel.length_mm / 2.0,
        socket_mm: pin.socket_diameter_mm,
    })
}
