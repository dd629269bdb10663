//! The bodies in which a given field is less dense than a value.

use crate::base::watch::Watch;
use crate::error::Error;
use crate::field::{Density, SkinOrder};
use crate::run::Placed;
use crate::voids::{Cavity, CavitySpec, DensityLevel, Drawn, draw_below};

/// Thickness below which a layer under the wall belongs to what lies in it, mm. Lines are several
/// times as wide, and surfaces so near to each other would touch.
const THINNEST_MM: f64 = 0.1;

/// A field whose level sets are no quadrics.
#[derive(Debug, Clone, Copy)]
pub enum Drawing<'a> {
    /// A function of the depth below the surface: its level sets are offsets of that.
    Skin(&'a SkinOrder),
    /// Any other, model coordinates.
    Density(&'a dyn Density),
}

/// Draws the body in which a field on the model is less dense than a value.
///
/// That of a skin is the surface that a wall as thick as the depth leaves. Of all other fields the
/// level set is marched.
///
/// # Errors
/// The body cannot be drawn, or the watch was stopped.
pub fn draw_field(
    placed: &Placed,
    drawing: Drawing,
    below: f64,
    watch: &Watch,
) -> Result<Drawn, Error> {
    let (solid, shop) = (&placed.model.solid, &placed.shop);
    let spec = |wall_mm: f64| CavitySpec::for_printer(&shop.printer, wall_mm, &[]);
    let wall_mm = shop.wall.wall_mm;
    let skin = match drawing {
        Drawing::Skin(skin) => skin,
        Drawing::Density(density) => {
            let tolerance_mm = spec(wall_mm).quadric_tolerance_mm;
            let level = DensityLevel { density, below };
            return Ok(draw_below(solid, &level, tolerance_mm, watch)?);
        }
    };
    Ok(match skin.depth_below_mm(below) {
        None => Drawn::Nothing,
        Some(depth_mm) if depth_mm < wall_mm + THINNEST_MM => Drawn::Everything,
        Some(depth_mm) => {
            let cavity = Cavity::extract(solid, &spec(depth_mm), watch)?;
            match cavity.mesh().is_empty() {
                true => Drawn::Nothing,
                false => Drawn::Body(cavity.mesh().clone()),
            }
        }
    })
}
