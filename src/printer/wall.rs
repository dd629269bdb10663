//! From the wall that was asked for to the wall that is printed, and the pitch to solve at.

use serde::Serialize;

use super::{Grid, Printer, Sourced};
use crate::units::show_mm;

/// How far beyond a whole number of steps a wall may lie and still count as that number, in steps.
///
/// Below the rounding of 25.4/600·24 (some 1e-15) an exact multiple is rounded up a whole step; at 1e-3 a wall would be thinner
/// than asked by more than any printer's accuracy.
const WHOLE_STEP_TOLERANCE: f64 = 1e-6;

/// Columns there must be across a wall for its curved and slanted parts to be resolved (the figure).
///
/// Below it the moments of thin shells drift; above it columns are spent where nothing can be emptied.
const COLUMNS_PER_WALL: f64 = 4.0;

/// The thinnest wall of parts up to a size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizedWall {
    /// The longest side of the parts it holds for, mm.
    pub up_to_mm: f64,
    /// The wall, mm.
    pub wall_mm: Sourced<f64>,
}

/// The wall that is printed, and why it is that.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallChoice {
    /// What was asked for, mm; none if the profile's minimum was taken.
    pub asked_mm: Option<f64>,
    /// What is printed, mm: at least what was asked for, and a whole number of steps.
    pub wall_mm: f64,
    /// How many steps of the printer's grid it is.
    pub steps: u32,
    /// The step: the coarsest of pixel x, pixel y and layer, mm.
    pub step_mm: f64,
    /// The reason, a sentence for people.
    pub why: String,
}

/// Why a wall cannot be printed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WallError {
    /// Not positive and finite.
    #[error("a wall of {0} mm is not possible; remedy: give a positive length")]
    NotPositive(f64),
    /// Thinner than the printer can.
    #[error(
        "a wall of {} is below the {} that {printer} can print ({provenance}); remedy: ask for {} or more",
        show_mm(*asked_mm), show_mm(*min_mm), show_mm(*min_mm)
    )]
    TooThin {
        /// What was asked for, mm.
        asked_mm: f64,
        /// The least wall of the profile, mm.
        min_mm: f64,
        /// The printer's id.
        printer: String,
        /// Where the least wall is from.
        provenance: String,
    },
}

impl Printer {
    /// The wall to print for the one asked for, or for the profile's minimum: rounded up to whole steps of the coarsest of pixel
    /// (or line width) and layer, so that no slicing can make it thinner. A whole number of steps stays as it is, to the bit.
    pub fn quantised_wall(&self, asked_mm: Option<f64>) -> Result<WallChoice, WallError> {
        let min_mm = self.min_wall_mm.value;
        let wanted_mm = asked_mm.unwrap_or(min_mm);
        if !(wanted_mm.is_finite() && wanted_mm > 0.0) {
            return Err(WallError::NotPositive(wanted_mm));
        }
        if wanted_mm < min_mm {
            return Err(self.too_thin(wanted_mm));
        }
        let step_mm = self.pixel_x_mm.value.max(self.pixel_y_mm.value).max(self.layer_mm.value);
        let steps = (wanted_mm / step_mm - WHOLE_STEP_TOLERANCE).ceil().max(1.0);
        let rounded_mm = steps * step_mm;
        let is_whole = (rounded_mm - wanted_mm).abs() <= WHOLE_STEP_TOLERANCE * step_mm;
        let wall_mm = if is_whole { wanted_mm } else { rounded_mm };
        let why = self.why(asked_mm, wall_mm, steps);
        Ok(WallChoice { asked_mm, wall_mm, steps: steps as u32, step_mm, why })
    }

    fn too_thin(&self, asked_mm: f64) -> WallError {
        WallError::TooThin {
            asked_mm,
            min_mm: self.min_wall_mm.value,
            printer: self.id.clone(),
            provenance: self.min_wall_mm.provenance(),
        }
    }

    fn why(&self, asked_mm: Option<f64>, wall_mm: f64, steps: f64) -> String {
        let pixel_mm = self.pixel_x_mm.value.max(self.pixel_y_mm.value);
        let step = match self.grid {
            _ if self.layer_mm.value > pixel_mm => "layers",
            Grid::Pixel => "pixels",
            Grid::Line => "line widths",
        };
        let from = match asked_mm {
            Some(asked_mm) => format!("asked for {}", show_mm(asked_mm)),
            None => format!("the least this printer makes is {}", show_mm(self.min_wall_mm.value)),
        };
        let step_mm = self.layer_mm.value.max(pixel_mm);
        format!("{} = {steps} {step} of {step_mm:.4} mm; {from}", show_mm(wall_mm))
    }

    /// The pitch of the solver's columns along x and y, mm: the printer's own pixel, or a quarter of the wall where that is
    /// finer; `asked_mm` (positive) overrides both.
    pub fn solve_pitch_mm(&self, wall_mm: f64, asked_mm: Option<f64>) -> [f64; 2] {
        let own = [self.pixel_x_mm.value, self.pixel_y_mm.value];
        own.map(|pixel_mm| asked_mm.unwrap_or(pixel_mm.min(wall_mm / COLUMNS_PER_WALL)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn printer(id: &str) -> Printer {
        Printer::find(id).unwrap()
    }

    #[test]
    fn a_wall_of_1_mm_is_24_pixels_on_the_objet() {
        let choice = printer("objet-connex350").quantised_wall(Some(1.0)).unwrap();
        assert_eq!(choice.steps, 24);
        assert!((choice.wall_mm - 1.016).abs() < 1e-12);
        assert_eq!(choice.why, "1.016 mm = 24 pixels of 0.0423 mm; asked for 1.000 mm");
    }

    #[test]
    fn filament_walls_are_whole_lines_and_resin_walls_whole_layers() {
        let fdm = printer("prusa-mk4").quantised_wall(None).unwrap();
        assert_eq!((fdm.steps, fdm.wall_mm), (2, 0.9));
        assert_eq!(
            fdm.why,
            "0.900 mm = 2 line widths of 0.4500 mm; the least this printer makes is 0.800 mm"
        );
        let sla = printer("formlabs-form4").quantised_wall(Some(1.04)).unwrap();
        assert_eq!(sla.steps, 11);
        assert!(sla.why.contains("11 layers"), "{}", sla.why);
    }

    #[test]
    fn a_wall_below_the_least_is_refused_with_the_least_and_its_source() {
        let error = printer("objet-connex350").quantised_wall(Some(0.99)).unwrap_err().to_string();
        assert!(
            error.contains("0.990 mm") && error.contains("1.000 mm") && error.contains("Hubs"),
            "{error}"
        );
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = printer("prusa-mk4").quantised_wall(Some(bad)).unwrap_err();
            assert!(matches!(error, WallError::NotPositive(_)), "{bad}");
        }
    }

    #[test]
    fn columns_stand_at_the_pixel_or_at_a_quarter_of_the_wall() {
        assert_eq!(printer("objet-connex350").solve_pitch_mm(1.016, None), [25.4 / 600.0; 2]);
        assert_eq!(printer("prusa-mk4").solve_pitch_mm(0.9, None), [0.225; 2]);
        assert_eq!(printer("prusa-mk4").solve_pitch_mm(0.9, Some(0.5)), [0.5; 2]);
        let mut oblong = printer("formlabs-form4");
        oblong.pixel_y_mm.value = 0.4;
        assert_eq!(oblong.solve_pitch_mm(1.0, None), [0.05, 0.25]);
    }

    proptest! {
        #[test]
        fn a_whole_number_of_steps_is_never_rounded_up(steps in 24_u32..2000) {
            for step_mm in [25.4 / 600.0, 0.45, 0.1, 0.024, 1.0 / 3.0] {
                let mut any = printer("objet-connex350");
                (any.pixel_x_mm.value, any.pixel_y_mm.value) = (step_mm, step_mm);
                any.min_wall_mm.value = step_mm;
                let exact_mm = f64::from(steps) * step_mm;
                let choice = any.quantised_wall(Some(exact_mm)).unwrap();
                prop_assert_eq!(choice.wall_mm, exact_mm);
            }
        }

        #[test]
        fn a_wall_is_never_thinner_than_asked_nor_a_step_thicker_and_rounds_only_once(asked_mm in 1.0..30.0_f64) {
            for id in ["objet-connex350", "formlabs-form4", "prusa-mk4"] {
                let any = printer(id);
                let once = any.quantised_wall(Some(asked_mm)).unwrap();
                prop_assert!(once.wall_mm >= asked_mm && once.wall_mm < asked_mm + once.step_mm * (1.0 + 1e-9));
                prop_assert_eq!(any.quantised_wall(Some(once.wall_mm)).unwrap().wall_mm, once.wall_mm);
            }
        }
    }
}
