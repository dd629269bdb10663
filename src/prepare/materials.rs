//! Materials: those of the printer that would make a match possible.

use super::levels::with_load;
use super::mean::with_levels;
use crate::ballast::Load;
use crate::base::setting::{Key, Setting};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::goal::{GoalKind, PrintStock, place_in_material};
use crate::printer::Material;
use crate::run::{Placed, Shop};

/// Returns hints of other materials that make an impossible match possible, each confirmed by a
/// solve. Other goals do not depend on the density alone.
///
/// # Errors
/// As a solve.
pub fn material_hints(placed: &Placed, watch: &Watch) -> Result<Vec<String>, Error> {
    let mut hints = Vec::new();
    if placed.goal().kind != GoalKind::Match {
        return Ok(hints);
    }
    let is_other = |material: &&Material| material.id != placed.shop.material.id;
    for material in placed.shop.printer.materials.iter().filter(is_other) {
        if works(placed, material, watch)? {
            let setting = Setting::new(Key::Material, &material.id);
            hints.push(format!("print it of {} (`{setting}`)", material.name));
        }
    }
    Ok(hints)
}

/// Returns whether a solve in another material meets the goal.
fn works(placed: &Placed, material: &Material, watch: &Watch) -> Result<bool, Error> {
    let stock = PrintStock {
        wall_mm: placed.shop.wall.wall_mm,
        density_g_cm3: material.density_g_cm3.value,
    };
    let other = Placed {
        placement: place_in_material(&placed.model.solid, &stock, &placed.request)?,
        shop: Shop {
            material: material.clone(),
            ..placed.shop.clone()
        },
        ..placed.clone()
    };
    let other = with_levels(other, watch)?;
    let found = with_load(&other, Load::default(), watch)?;
    Ok(matches!(found, Verdict::Found(_)))
}
