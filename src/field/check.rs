//! Finds a place in a solid where a density is none: below 0, above 1 or no number.

use super::density::Density;
use crate::geom::{Aabb, Point, Vector};
use crate::mesh::{Solid, WindingNumbers};

/// Excess that is rounding.
const ROUNDING: f64 = 1e-9;
/// Halvings of the box in which the solid is searched: cells are a 64th of its sides.
const HALVINGS: u32 = 6;
/// Winding number above which a point is inside.
const INSIDE: f64 = 0.5;

/// A place where a value is no density.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "the field is {value:.4} at ({:.2}, {:.2}, {:.2}) mm, and a density lies from 0 to 1; \
     remedy: scale the field, or give it limits that hold all over the model",
    at.x, at.y, at.z
)]
pub struct NotADensity {
    /// The place, model coordinates, mm.
    pub at: Point,
    /// The value there.
    pub value: f64,
}

/// Checks that a field is a density all over a solid.
///
/// Bounds over the solid's box decide at once where they can. Elsewhere every vertex is tried, and
/// boxes are halved as long as their bounds allow a fault, down to a 64th of the sides. So a fault
/// that is narrower than that may be missed inside, and the densities found are never clamped.
///
/// # Errors
/// A place where the field is below 0, above 1 or not finite.
pub fn check(solid: &Solid, field: &dyn Density) -> Result<(), NotADensity> {
    let region = solid.mesh().aabb();
    if are_densities(field.bounds(&region)) {
        return Ok(());
    }
    let wrong = |at: &Point| {
        Some(NotADensity {
            at: *at,
            value: field.at(at),
        })
        .filter(is_wrong)
    };
    if let Some(fault) = solid.mesh().vertices().iter().find_map(wrong) {
        return Err(fault);
    }
    let inside = WindingNumbers::new(solid.mesh().iter_corners());
    let is_fault = |at: &Point| wrong(at).filter(|_| inside.at(at) > INSIDE);
    search(field, &region, HALVINGS, &is_fault).map_or(Ok(()), Err)
}

fn is_wrong(found: &NotADensity) -> bool {
    !are_densities([found.value; 2])
}

fn are_densities([low, high]: [f64; 2]) -> bool {
    low >= -ROUNDING && high <= 1.0 + ROUNDING
}

/// Searches a box for a fault, its eighths in order.
fn search(
    field: &dyn Density,
    region: &Aabb,
    halvings: u32,
    is_fault: &impl Fn(&Point) -> Option<NotADensity>,
) -> Option<NotADensity> {
    if are_densities(field.bounds(region)) {
        return None;
    }
    let center = region.center();
    if halvings == 0 {
        return is_fault(&center);
    }
    let half = region.size() * 0.5;
    (0..8).find_map(|eighth: usize| {
        let shift = Vector::from_fn(|axis, _| (eighth >> axis & 1) as f64 * half[axis]);
        let min = region.min + shift;
        search(
            field,
            &Aabb {
                min,
                max: min + half,
            },
            halvings - 1,
            is_fault,
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Linear, Polynomial, Term, Uniform};
    use super::*;
    use crate::mesh::primitives::cuboid;

    fn cube() -> Solid {
        Solid::new(cuboid(
            &Point::new(-1.0, -1.0, -1.0),
            &Point::new(1.0, 1.0, 1.0),
        ))
        .unwrap()
    }

    #[test]
    fn a_field_outside_its_range_is_told_with_the_place() {
        let tilted = |at_origin, slope| Linear {
            at_origin,
            gradient: Vector::x() * slope,
        };
        assert_eq!(check(&cube(), &tilted(0.5, 0.5)), Ok(()));
        let fault = check(&cube(), &tilted(0.5, 0.6)).unwrap_err();
        assert!((fault.at.x.abs(), fault.value) == (1.0, 1.1) || fault.value < -0.09);
        assert!(check(&cube(), &Uniform(1.0 + 1e-6)).is_err());
        assert!(check(&cube(), &Uniform(f64::NAN)).is_err());
    }

    #[test]
    fn a_fault_inside_is_found_where_all_vertices_are_sound() {
        let term = |coefficient, [x, y, z]: [u8; 3]| Term {
            coefficient,
            x,
            y,
            z,
        };
        // 1.2 − x² − y² − z² over 3.2: above 1 only where … nowhere; times 1.2: in the middle.
        let bump = |top: f64| {
            let fall = -top / 3.0;
            let terms = vec![
                term(top, [0, 0, 0]),
                term(fall, [2, 0, 0]),
                term(fall, [0, 2, 0]),
                term(fall, [0, 0, 2]),
            ];
            Polynomial::new(terms).unwrap()
        };
        assert_eq!(check(&cube(), &bump(1.0)), Ok(()));
        let fault = check(&cube(), &bump(1.1)).unwrap_err();
        assert!(fault.value > 1.0 && fault.at.coords.norm() < 0.6);
    }
}
