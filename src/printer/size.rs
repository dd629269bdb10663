//! The sizes of models for which a printer can make a hollow kit.

use super::Printer;
use crate::base::setting::{Key, Setting};
use crate::base::units::show_mm;

/// Length of the longest model over the longest side of the build volume.
///
/// Cuts open voids, and so halve a model once or twice. Below 2, kits that fit would be refused.
/// Above 8, runs take hours and their parts do not fit.
const MAX_BUILD_LENGTHS: f64 = 4.0;

/// Length of the longest model if the build volume is not known, mm: twice the longest side of the
/// largest machines of this kind.
///
/// Longer models take minutes and gigabytes, and their parts hardly fit any machine. A profile can
/// state its build volume.
const MAX_SIZE_MM: f64 = 2000.0;

/// The least length that is written with a power of ten, mm: a thousand kilometres have too many
/// digits to read.
const LONG_MM: f64 = 1e9;

/// A size of a model that allows no kit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SizeError {
    /// The walls fill the whole model.
    #[error(
        "the model is {} long, and walls of {} leave nothing inside to empty; \
         remedy: give its size (`{}`), its unit (`{}`), or a thinner wall (`{}`)",
        show(*size_mm),
        show(*wall_mm),
        Setting::open(Key::Size),
        Setting::open(Key::Unit),
        Setting::open(Key::Wall)
    )]
    AllWall {
        /// The model's longest side, mm.
        size_mm: f64,
        /// The wall, mm.
        wall_mm: f64,
    },
    /// The model is too long for any cut to make its parts fit.
    #[error(
        "the model is {} long, but a kit for {printer} may be {} long at most; \
         remedy: give its size (`{}`) or its unit (`{}`), \
         or state a larger build volume in the profile",
        show(*size_mm),
        show(*most_mm),
        Setting::open(Key::Size),
        Setting::open(Key::Unit)
    )]
    TooLong {
        /// The model's longest side, mm.
        size_mm: f64,
        /// The longest allowed model, mm.
        most_mm: f64,
        /// The printer's id.
        printer: String,
    },
}

/// Formats a length, however small or large.
fn show(mm: f64) -> String {
    let is_plain = (1e-3..LONG_MM).contains(&mm);
    if is_plain {
        show_mm(mm)
    } else {
        format!("{mm:.1e} mm")
    }
}

impl Printer {
    /// Returns the length of the longest allowed model, mm: some lengths of the build volume, or a
    /// fixed length if that is not known.
    pub fn max_model_length_mm(&self) -> f64 {
        self.build_volume_mm.as_ref().map_or(MAX_SIZE_MM, |volume| {
            MAX_BUILD_LENGTHS * volume.value.into_iter().fold(0.0, f64::max)
        })
    }

    /// Refuses a model whose longest side exceeds [`Self::max_model_length_mm`], or is no number.
    pub fn check_length(&self, size_mm: f64) -> Result<(), SizeError> {
        let most_mm = self.max_model_length_mm();
        if size_mm <= most_mm {
            return Ok(());
        }
        Err(SizeError::TooLong {
            size_mm,
            most_mm,
            printer: self.id.clone(),
        })
    }
}

/// Refuses a model whose longest side is no longer than two walls.
pub fn check_room_for_void(size_mm: f64, wall_mm: f64) -> Result<(), SizeError> {
    if size_mm > 2.0 * wall_mm {
        Ok(())
    } else {
        Err(SizeError::AllWall { size_mm, wall_mm })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_of_four_build_lengths_is_allowed_and_a_longer_one_is_not() {
        let longest = |printer: &Printer| {
            printer
                .build_volume_mm
                .as_ref()
                .map(|volume| volume.value[0])
        };
        for (id, most_mm) in [("prusa-mk4", 1000.0), ("objet-connex350", MAX_SIZE_MM)] {
            let printer = Printer::find(id).unwrap();
            assert_eq!(
                longest(&printer).map_or(MAX_SIZE_MM, |width| 4.0 * width),
                most_mm
            );
            assert_eq!(printer.check_length(most_mm), Ok(()));
            for size_mm in [most_mm * 1.001, 1e300, f64::INFINITY, f64::NAN] {
                let error = printer.check_length(size_mm).unwrap_err().to_string();
                assert!(
                    error.contains(id) && error.contains("`unit = …`"),
                    "{error}"
                );
                assert!(error.len() < 250, "{error}");
            }
        }
    }

    #[test]
    fn two_walls_leave_no_room() {
        assert_eq!(check_room_for_void(2.1, 1.0), Ok(()));
        assert!(
            check_room_for_void(2.0, 1.0)
                .unwrap_err()
                .to_string()
                .contains("nothing inside")
        );
        assert!(
            check_room_for_void(1e-300, 1.0)
                .unwrap_err()
                .to_string()
                .contains("1.0e-300 mm")
        );
    }
}
