//! The mass properties of a solid whose density varies, as `inspect` tells them.

use serde::Serialize;

use super::mass_facts::plain;
use crate::base::units::MM3_PER_CM3;
use crate::field::{Measured, NotADensity, Order, check, measure};
use crate::mass::{Body, Moments, moments_of_mesh};
use crate::mesh::Solid;

/// The mass properties of a solid with a field, model axes, scaled as ordered.
#[derive(Debug, Serialize)]
pub(super) struct FieldFacts {
    /// The field as it was typed.
    field: String,
    /// Density of the solid material.
    material_g_cm3: f64,
    mass_g: f64,
    /// Mean density over that of the solid material.
    mean_density_ratio: f64,
    /// `None` for a field without mass.
    body: Option<BodyFacts>,
    /// Error of the mass, as a share of it; 0 if only rounding is left.
    mass_error_ratio: f64,
}

/// The centre and the inertia.
#[derive(Debug, Serialize)]
pub(super) struct BodyFacts {
    center_mm: [f64; 3],
    center_error_mm: f64,
    /// Principal moments about the centre of mass, ascending.
    principal_moments_g_mm2: [f64; 3],
    /// Their axes.
    principal_axes: [[f64; 3]; 3],
    /// Error of the moments, as a share of the largest.
    inertia_error_ratio: f64,
}

/// Measures a solid with a field; `name` is how it was typed. Returns the facts and the moments,
/// mm³ to mm⁵ of solid material.
///
/// # Errors
/// A place in the solid where the field is no density.
pub(super) fn field_facts(
    name: String,
    order: &Order,
    solid: &Solid,
    material_g_cm3: f64,
) -> Result<(FieldFacts, Moments), NotADensity> {
    let field = order.on(solid);
    check(solid, field.as_ref())?;
    let measured = measure(solid.mesh(), field.as_ref());
    let volume_mm3 = measured.moments.volume();
    let facts = FieldFacts {
        field: name,
        material_g_cm3,
        mass_g: volume_mm3 * material_g_cm3 / MM3_PER_CM3,
        mean_density_ratio: volume_mm3 / moments_of_mesh(solid.mesh()).volume(),
        body: body_facts(&measured, material_g_cm3 / MM3_PER_CM3),
        mass_error_ratio: measured.mass_error_ratio(),
    };
    Ok((facts, measured.moments))
}

pub(super) fn body_facts(measured: &Measured, density_g_mm3: f64) -> Option<BodyFacts> {
    let center = measured.center()?;
    let principal = Body::new(&measured.moments, density_g_mm3).principal();
    let axis = |i| principal.axes.column(i).into_owned().into();
    Some(BodyFacts {
        center_mm: center.coords.into(),
        center_error_mm: measured.center_error_mm()?,
        principal_moments_g_mm2: principal.moments_g_mm2,
        principal_axes: [0, 1, 2].map(axis),
        inertia_error_ratio: measured.inertia_error_ratio()?,
    })
}

/// Returns the properties in words.
pub(super) fn field_text(facts: &FieldFacts) -> String {
    let mut text = format!(
        "with the field {}: {} of {} material, mean density {}\n",
        facts.field,
        plain(facts.mass_g, "g"),
        plain(facts.material_g_cm3, "g/cm³"),
        plain(100.0 * facts.mean_density_ratio, "%"),
    );
    let Some(body) = &facts.body else {
        return text + "the field has no mass, so it has no centre of mass\n";
    };
    text += &body_text(body);
    text + &error_text(facts, body)
}

/// Returns centre, principal moments and axes in words.
pub(super) fn body_text(body: &BodyFacts) -> String {
    let [x, y, z] = body.center_mm;
    let moments = body.principal_moments_g_mm2.map(|moment| plain(moment, ""));
    let mut text = format!("centre of mass ({x:.3}, {y:.3}, {z:.3}) mm\n");
    text += &format!("principal moments {} g·mm² about\n", moments.join(", "));
    for [x, y, z] in body.principal_axes {
        text += &format!("  ({x:.4}, {y:.4}, {z:.4})\n");
    }
    text
}

/// Returns the error that was reached, in words.
fn error_text(facts: &FieldFacts, body: &BodyFacts) -> String {
    if facts.mass_error_ratio == 0.0 {
        return "exact: only rounding is left\n".to_owned();
    }
    format!(
        "error: at most {} of the mass, {} of the centre, {} of the largest moment\n",
        share(facts.mass_error_ratio),
        plain(body.center_error_mm, "mm"),
        share(body.inertia_error_ratio),
    )
}

/// Returns a small share in per cent.
pub(super) fn share(ratio: f64) -> String {
    if ratio == 0.0 {
        return "0 %".to_owned();
    }
    format!("{:.1e} %", 100.0 * ratio)
}
