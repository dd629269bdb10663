//! The mass properties of a solid, as `inspect` tells them.

use serde::Serialize;

use super::flags::flag;
use crate::base::numbers::quantity;
use crate::base::setting::{Key, Setting};
use crate::geom::Vector;
use crate::goal::Up;
use crate::mass::{Body, moments_of_mesh};
use crate::mesh::TriMesh;

/// The mass properties of a solid of density 1 g/cm³, model axes.
#[derive(Debug, Serialize)]
pub(super) struct Mass {
    volume_mm3: f64,
    center_mm: [f64; 3],
    principal_moments_ratio: [f64; 3],
    dominant_axis: [f64; 3],
    dominance_ratio_by_axis: [f64; 3],
}

/// Measures a solid.
pub(super) fn mass(mesh: &TriMesh) -> Mass {
    let moments = moments_of_mesh(mesh);
    let body = Body::new(&moments, 1.0);
    let principal = body.principal();
    let largest = principal.moments_g_mm2[2];
    Mass {
        volume_mm3: moments.volume(),
        center_mm: body.center.coords.into(),
        principal_moments_ratio: principal.moments_g_mm2.map(|moment| moment / largest),
        dominant_axis: principal.axes.column(2).into_owned().into(),
        dominance_ratio_by_axis: [0, 1, 2].map(|axis| dominance(&body, axis)),
    }
}

/// Returns the larger moment across a coordinate axis over the one about it.
fn dominance(body: &Body, axis: usize) -> f64 {
    let inertia = body.inertia_g_mm2;
    let about = Vector::ith(axis, 1.0).dot(&(inertia * Vector::ith(axis, 1.0)));
    let across = inertia
        .remove_row(axis)
        .remove_column(axis)
        .symmetric_eigenvalues();
    across.max() / about
}

/// Returns a quantity with plain blanks, which a terminal can search for.
pub(super) fn plain(value: f64, unit: &str) -> String {
    quantity(value, unit).replace('\u{a0}', " ")
}

/// Returns the properties in words.
pub(super) fn mass_text(mass: &Mass) -> String {
    let [cx, cy, cz] = mass.center_mm;
    let [ax, ay, az] = mass.dominant_axis;
    let mut text = format!(
        "a solid of {}, centre of mass ({cx:.3}, {cy:.3}, {cz:.3}) mm\nlargest moment of inertia about ({ax:.4}, {ay:.4}, {az:.4}), which {} takes\n",
        plain(mass.volume_mm3, "mm³"),
        flag(&Setting::new(Key::Up, Up::Principal))
    );
    let axes = ["x", "y", "z"].iter().zip(mass.dominance_ratio_by_axis);
    let (steady, shaky): (Vec<_>, Vec<_>) = axes.partition(|(_, ratio)| *ratio < 1.0);
    for (axes, words) in [
        (steady, "spins steadily"),
        (shaky, "does not spin steadily"),
    ] {
        let names: Vec<&str> = axes.iter().map(|(axis, _)| **axis).collect();
        if !names.is_empty() {
            text += &format!("solid, it {words} about {}\n", names.join(", "));
        }
    }
    text
}
