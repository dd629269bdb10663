//! The floating object: it lies in a liquid up to a given line, upright, and rights itself.

use super::error::GoalError;
use super::placement::Placement;
use super::site::Site;
use super::water::{Hydrostatics, Water, Waterline};
use crate::geom::Point;

/// The waterline at which a search starts if the line is free, as a share of the height.
const PROVISIONAL_RATIO: f64 = 0.5;

pub(super) fn place(site: &Site, density_g_cm3: f64, water: Water) -> Result<Placement, GoalError> {
    let center = site.upright_center();
    let mut goal = site.goal_at(&Point::new(center.x, center.y, site.lowest_mm), Vec::new());
    let liquid_ratio = water.liquid.density_g_cm3() / density_g_cm3;
    let hydrostatics = Hydrostatics::new(site.solid, &goal.frame, liquid_ratio);
    let height_mm = site.height_mm();
    let waterline_mm = match water.waterline {
        Waterline::Auto => PROVISIONAL_RATIO * height_mm,
        Waterline::At(length) if length.mm() < height_mm => length.mm(),
        Waterline::At(length) => {
            return Err(GoalError::UnderWater {
                waterline_mm: length.mm(),
                height_mm,
            });
        }
    };
    goal.afloat = Some(hydrostatics.at(waterline_mm));
    Ok(Placement {
        goal,
        keeps: Vec::new(),
        warnings: Vec::new(),
        footing: None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::{GoalKind, Liquid, PrintStock, Request, place_in_material, testing::*};
    use super::*;

    fn block_in_water(waterline: &str, density_g_cm3: f64) -> Result<Placement, GoalError> {
        let water = Water {
            liquid: Liquid::Density(1.0),
            waterline: waterline.parse().unwrap(),
        };
        let request = Request {
            water: Some(water),
            ..Request::new(GoalKind::Float)
        };
        place_in_material(
            &block([1., 2., 3.], [7., 12., 8.]),
            &PrintStock {
                wall_mm: 0.5,
                density_g_cm3,
            },
            &request,
        )
    }

    #[test]
    fn a_block_has_the_metacentre_of_the_textbook() {
        // 6 × 10 × 5 under water to 2: V = 120, KB = 1, BM = (10·6³/12)/120 = 1.5.
        let afloat = block_in_water("2mm", 1.25).unwrap().goal.afloat.unwrap();
        assert!((afloat.metacenter_mm - 2.5).abs() < 1e-12);
        assert!((afloat.material_mm3 - 120.0 / 1.25).abs() < 1e-12);
        assert!((afloat.buoyancy - Point::new(0.0, 0.0, 1.0)).norm() < 1e-12);
    }

    #[test]
    fn a_line_above_the_whole_model_is_refused() {
        let refused = block_in_water("5mm", 1.0);
        let Err(GoalError::UnderWater { height_mm, .. }) = refused else {
            panic!("{refused:?}")
        };
        assert!((height_mm - 5.0).abs() < 1e-12);
    }
}
