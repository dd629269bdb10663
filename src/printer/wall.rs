//! The printed wall for a requested one, and the pitch of the solver's columns.

use serde::Serialize;

use super::{Grid, Printer, Sourced};
use crate::base::units::show_mm;

/// Greatest excess over a whole number of steps that still counts as that number, in steps.
///
/// Below the rounding error of 25.4/600·24 (some 1e-15), an exact multiple is rounded up a whole
/// step. At 1e-3, a wall would be thinner than requested by more than any printer's accuracy.
const WHOLE_STEP_TOLERANCE: f64 = 1e-6;

/// Least number of columns across a wall that resolves its curved and slanted parts.
///
/// With fewer, the moments of thin shells drift. More are wasted, as the wall cannot be emptied.
const COLUMNS_PER_WALL: f64 = 4.0;

/// Greatest number of columns over the square around a model at the pitch of the printer's pixels.
///
/// It is the number for a model of 100 mm at 600 dpi, which the solver must manage. Four times as
/// many take four times the time and memory, for a void that differs by micrometres.
const MOST_COLUMNS: f64 = 6e6;

/// The wall that is printed, and the reason.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallChoice {
    /// The requested wall, mm; `None` if the profile's minimum was taken.
    pub asked_mm: Option<f64>,
    /// The printed wall, mm: a whole number of steps, not thinner than requested.
    pub wall_mm: f64,
    /// The printed wall in steps of the printer's grid.
    pub steps: u32,
    /// The step: the coarser of pixel x and pixel y, or the width of a line, mm.
    pub step_mm: f64,
    /// The reason, a sentence for people.
    pub why: String,
}

/// A wall that cannot be printed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WallError {
    /// Not positive and finite.
    #[error("a wall of {0} mm is not possible; remedy: give a positive length")]
    NotPositive(f64),
    /// Thinner than the printer's minimum.
    #[error(
        "a wall of {} is below the {} that {printer} can print ({provenance}); \
         remedy: ask for {} or more",
        show_mm(*asked_mm),
        show_mm(*min_mm),
        show_mm(*min_mm)
    )]
    TooThin {
        /// The requested wall, mm.
        asked_mm: f64,
        /// The thinnest wall of the profile, mm.
        min_mm: f64,
        /// The printer's id.
        printer: String,
        /// Certainty and source of the thinnest wall.
        provenance: String,
    },
}

impl Printer {
    /// Returns the thinnest wall, mm, that prints and survives cleaning on a part whose longest
    /// side is `size_mm`.
    pub fn least_wall_mm(&self, size_mm: f64) -> &Sourced<f64> {
        let sized = self
            .walls_by_part_size
            .iter()
            .find(|wall| size_mm <= wall.up_to_mm);
        sized.map_or(&self.min_wall_mm, |wall| &wall.wall_mm)
    }

    /// Rounds a wall up to whole steps of the printer's grid: `asked_mm`, or the profile's minimum
    /// at that size for `None`.
    ///
    /// A step is a pixel or a line, the coarser of x and y. On a grid of pixels, steps are
    /// added until neither pixels nor layers can make the wall thinner than requested, wherever it
    /// lies between them. A wall of whole pixels stays as it is, to the bit; the checklist says
    /// what layers make of it.
    ///
    /// Layers do not thicken walls of lines: slicers close a roof with whole layers, and the
    /// checklist says how many.
    pub fn quantise_wall(
        &self,
        asked_mm: Option<f64>,
        size_mm: f64,
    ) -> Result<WallChoice, WallError> {
        let least = self.least_wall_mm(size_mm);
        let wanted_mm = asked_mm.unwrap_or(least.value);
        if !(wanted_mm.is_finite() && wanted_mm > 0.0) {
            return Err(WallError::NotPositive(wanted_mm));
        }
        if wanted_mm < least.value {
            return Err(self.too_thin(wanted_mm, least));
        }
        let step_mm = self.pixel_x_mm.value.max(self.pixel_y_mm.value);
        let mut steps = (wanted_mm / step_mm - WHOLE_STEP_TOLERANCE).ceil().max(1.0);
        let is_whole = (steps * step_mm - wanted_mm).abs() <= WHOLE_STEP_TOLERANCE * step_mm;
        while !is_whole && self.may_print_thinner(steps * step_mm, wanted_mm) {
            steps += 1.0;
        }
        let wall_mm = if is_whole { wanted_mm } else { steps * step_mm };
        let why = self.explain(asked_mm.ok_or(least.value), wall_mm, steps);
        Ok(WallChoice {
            asked_mm,
            wall_mm,
            steps: steps as u32,
            step_mm,
            why,
        })
    }

    /// True if a drawn wall may come out thinner than wanted between pixels or layers. A wall that
    /// is thicker than wanted by the coarsest step never does, so the search for one ends.
    fn may_print_thinner(&self, drawn_mm: f64, wanted_mm: f64) -> bool {
        let steps = [&self.pixel_x_mm, &self.pixel_y_mm, &self.layer_mm].map(|step| step.value);
        let is_thinner = |step_mm: &f64| {
            whole_steps(drawn_mm, *step_mm) * step_mm < wanted_mm - WHOLE_STEP_TOLERANCE * step_mm
        };
        self.grid == Grid::Pixel && steps.iter().any(is_thinner)
    }

    fn too_thin(&self, asked_mm: f64, least: &Sourced<f64>) -> WallError {
        WallError::TooThin {
            asked_mm,
            min_mm: least.value,
            printer: self.id.clone(),
            provenance: least.provenance(),
        }
    }

    /// Explains the printed wall: `Ok` for a requested wall, `Err` for the least one.
    fn explain(&self, asked_mm: Result<f64, f64>, wall_mm: f64, steps: f64) -> String {
        let from = match asked_mm {
            Ok(asked_mm) => format!("asked for {}", show_mm(asked_mm)),
            Err(least_mm) => format!("the least this printer makes is {}", show_mm(least_mm)),
        };
        let step_mm = self.pixel_x_mm.value.max(self.pixel_y_mm.value);
        format!(
            "{} = {steps} {} of {step_mm:.4} mm; {from}",
            show_mm(wall_mm),
            self.grid.steps()
        )
    }

    /// Returns the pitch of the solver's columns along x and y, mm, for a model of length
    /// `size_mm`.
    ///
    /// The pitch is the printer's own pixel, or a quarter of the wall if that is finer. If this
    /// takes more than six million columns, the pitch is several of these steps, at most a quarter
    /// of the wall. A positive `asked_mm` overrides all.
    pub fn solve_pitch_mm(&self, wall_mm: f64, size_mm: f64, asked_mm: Option<f64>) -> [f64; 2] {
        let own = [self.pixel_x_mm.value, self.pixel_y_mm.value];
        let finest = own.map(|pixel_mm| pixel_mm.min(wall_mm / COLUMNS_PER_WALL));
        let columns = finest
            .iter()
            .map(|pitch_mm| size_mm / pitch_mm)
            .product::<f64>();
        let wanted = (columns / MOST_COLUMNS).sqrt().ceil();
        let most = finest.map(|pitch_mm| (wall_mm / COLUMNS_PER_WALL / pitch_mm).floor());
        let pixels = wanted.min(most[0]).min(most[1]).max(1.0);
        finest.map(|pitch_mm| asked_mm.unwrap_or(pixels * pitch_mm))
    }
}

/// Returns the least number of whole steps within a length, wherever it lies between them.
pub fn whole_steps(length_mm: f64, step_mm: f64) -> f64 {
    (length_mm / step_mm + WHOLE_STEP_TOLERANCE).floor()
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
        let choice = printer("objet-connex350")
            .quantise_wall(Some(1.0), 100.0)
            .unwrap();
        assert_eq!(choice.steps, 24);
        assert!((choice.wall_mm - 1.016).abs() < 1e-12);
        assert_eq!(
            choice.why,
            "1.016 mm = 24 pixels of 0.0423 mm; asked for 1.000 mm"
        );
    }

    #[test]
    fn filament_walls_are_whole_lines_and_layers_cannot_thin_resin_walls() {
        let fdm = printer("prusa-mk4").quantise_wall(None, 100.0).unwrap();
        assert_eq!((fdm.steps, fdm.wall_mm), (2, 0.9));
        assert_eq!(
            fdm.why,
            "0.900 mm = 2 line widths of 0.4500 mm; the least this printer makes is 0.800 mm"
        );
        let sla = printer("formlabs-form4")
            .quantise_wall(Some(1.04), 100.0)
            .unwrap();
        // 21 pixels of 0.05 mm are 1.05 mm, but may hold only 10 layers of 0.1 mm.
        assert_eq!(sla.steps, 22);
        assert!(sla.why.contains("22 pixels"), "{}", sla.why);
    }

    #[test]
    fn a_wall_below_the_minimum_is_refused_with_the_minimum_and_its_source() {
        let error = printer("objet-connex350")
            .quantise_wall(Some(0.99), 100.0)
            .unwrap_err()
            .to_string();
        assert!(
            error.contains("0.990 mm") && error.contains("1.000 mm") && error.contains("Hubs"),
            "{error}"
        );
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = printer("prusa-mk4")
                .quantise_wall(Some(bad), 100.0)
                .unwrap_err();
            assert!(matches!(error, WallError::NotPositive(_)), "{bad}");
        }
    }

    #[test]
    fn columns_stand_at_the_pixel_or_at_a_quarter_of_the_wall() {
        assert_eq!(
            printer("objet-connex350").solve_pitch_mm(1.016, 100.0, None),
            [25.4 / 600.0; 2]
        );
        assert_eq!(
            printer("prusa-mk4").solve_pitch_mm(0.9, 100.0, None),
            [0.225; 2]
        );
        assert_eq!(
            printer("prusa-mk4").solve_pitch_mm(0.9, 100.0, Some(0.5)),
            [0.5; 2]
        );
        let mut oblong = printer("formlabs-form4");
        oblong.pixel_y_mm.value = 0.4;
        assert_eq!(oblong.solve_pitch_mm(1.0, 100.0, None), [0.05, 0.25]);
    }

    #[test]
    fn on_oblong_pixels_no_direction_makes_a_wall_thinner_than_asked() {
        let saturn = printer("elegoo-saturn-4-ultra");
        let wall_mm = saturn.quantise_wall(Some(1.0), 100.0).unwrap().wall_mm;
        // 42 pixels of 24 µm; 53 of 19 µm are 1.007 mm, 20 layers of 50 µm are 1 mm.
        assert!((wall_mm - 1.008).abs() < 1e-12, "{wall_mm}");
        for (step_mm, steps) in [(0.019, 53.0), (0.024, 42.0), (0.05, 20.0)] {
            assert_eq!(whole_steps(wall_mm, step_mm), steps);
        }
    }

    #[test]
    fn too_many_columns_are_thinned_to_whole_pixels_up_to_a_quarter_of_the_wall() {
        let saturn = printer("elegoo-saturn-4-ultra");
        // 100 mm: 5263 × 4167 columns are 3.7 times the limit, so every second pixel.
        assert_eq!(
            saturn.solve_pitch_mm(1.008, 100.0, None),
            [2.0 * 0.019, 2.0 * 0.024]
        );
        assert_eq!(saturn.solve_pitch_mm(1.008, 30.0, None), [0.019, 0.024]);
        let [x, y] = saturn.solve_pitch_mm(1.008, 5000.0, None);
        assert!(y <= 0.252 && x / 0.019 == 10.0, "{x} {y}");
    }

    #[test]
    fn the_thinnest_wall_of_sintered_powder_grows_with_the_part() {
        let eos = printer("eos-p396");
        let wall_mm = |size_mm| eos.quantise_wall(None, size_mm).unwrap().wall_mm;
        assert_eq!(
            (wall_mm(100.0), wall_mm(101.0), wall_mm(500.0)),
            (0.75, 1.0, 1.0)
        );
        assert!(
            printer("formlabs-fuse1").walls_by_part_size.is_empty(),
            "the machine's own wall comes first"
        );
    }

    proptest! {
        #[test]
        fn a_whole_number_of_steps_is_never_rounded_up(steps in 24_u32..2000) {
            for step_mm in [25.4 / 600.0, 0.45, 0.1, 0.024, 1.0 / 3.0] {
                let mut any = printer("objet-connex350");
                (any.pixel_x_mm.value, any.pixel_y_mm.value) = (step_mm, step_mm);
                (any.min_wall_mm.value, any.grid) = (step_mm, Grid::Line);
                let exact_mm = f64::from(steps) * step_mm;
                let choice = any.quantise_wall(Some(exact_mm), 100.0).unwrap();
                prop_assert_eq!(choice.wall_mm, exact_mm);
            }
        }

        #[test]
        fn a_wall_is_never_thinner_than_asked_nor_a_step_thicker_and_rounds_only_once(
            asked_mm in 1.0..30.0_f64,
        ) {
            for id in ["objet-connex350", "formlabs-form4", "prusa-mk4", "elegoo-saturn-4-ultra"] {
                let any = printer(id);
                let coarsest_mm = any.layer_mm.value.max(any.pixel_y_mm.value);
                let once = any.quantise_wall(Some(asked_mm), 100.0).unwrap();
                let most_mm = asked_mm + (once.step_mm + coarsest_mm) * (1.0 + 1e-9);
                prop_assert!(once.wall_mm >= asked_mm && once.wall_mm < most_mm);
                let twice = any.quantise_wall(Some(once.wall_mm), 100.0).unwrap();
                prop_assert_eq!(twice.wall_mm, once.wall_mm);
            }
        }
    }
}
