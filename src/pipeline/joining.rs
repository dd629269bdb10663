//! What joins the parts and is not printed: dowels, and the films of glue.

use super::Setup;
use crate::base::units::MM3_PER_CM3;
use crate::cut::{CutPlan, JointNote, Label, LabelStyle, PinSite};
use crate::mass::Moments;
use crate::printer::Quantity;
use crate::verify::{GlueFilm, Hardware, Mark};

/// The moments of dowels and films of glue as so much of the print's material, model frame.
pub fn joined(setup: &Setup, plan: &CutPlan) -> Moments {
    let density_g_cm3 = setup.material.density_g_cm3.value;
    let films = plan.joints.iter().filter_map(|joint| film(setup, joint));
    let films =
        films.map(|film| film.face.film(film.thickness_mm) * (film.density_g_cm3 / density_g_cm3));
    let dowels = plan.pins.iter().filter_map(|pin| {
        let weight = pin.dowel.as_ref()?.density_g_cm3 / density_g_cm3;
        Some(pin.dowel_bar()?.moments() * weight)
    });
    films
        .chain(dowels)
        .fold(Moments::default(), |sum, part| sum + part)
}

/// How ids are sunk into cut faces: in strokes as wide as the smallest detail, or two pixels, and
/// as deep; none where the job wants none.
pub fn label_style(setup: &Setup) -> Option<LabelStyle> {
    let printer = &setup.printer;
    let pixel_mm = printer.pixel_x_mm.value.max(printer.pixel_y_mm.value);
    let stroke_mm = printer.min_feature_mm.value.max(2.0 * pixel_mm);
    let layers = (printer.min_feature_mm.value / printer.layer_mm.value).ceil();
    let style = LabelStyle {
        stroke_mm,
        depth_mm: layers * printer.layer_mm.value,
    };
    setup.job.ids.is_engraved().then_some(style)
}

/// The film of glue in a joint; none where the printer's profile does not say how thick it is.
pub fn film(setup: &Setup, joint: &JointNote) -> Option<GlueFilm> {
    let number = |quantity| setup.printer.number(quantity).map(|number| number.value);
    let (thickness_mm, density_g_cm3) = (
        number(Quantity::GlueFilmMm)?,
        number(Quantity::GlueDensityGCm3)?,
    );
    let mass_g = joint.face.area_mm2 * thickness_mm * density_g_cm3 / MM3_PER_CM3;
    Some(GlueFilm {
        thickness_mm,
        density_g_cm3,
        mass_g,
        face: joint.face,
    })
}

/// A label as the judge sees it.
pub fn mark(label: &Label) -> Mark {
    Mark {
        text: label.text.clone(),
        cut: label.cut.clone(),
        axis: label.into,
        depth_mm: label.depth_mm,
        stroke_mm: label.stroke_mm,
        strokes_mm: label.strokes().into_iter().map(Into::into).collect(),
        volume_mm3: label.volume_mm3(),
    }
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
