//! Whether a model has a size that this printer can make a hollow kit of.

use super::Printer;
use crate::base::units::show_mm;

/// How many times as long as its longest side a build volume may be exceeded by a model. Cuts open
/// voids, and halve a model once or twice on the way: below 2 kits that fit would be refused, above
/// 8 runs take hours to end in parts that do not.
const MAX_BUILD_LENGTHS: f64 = 4.0;

/// The longest model where the build volume is not known, mm: twice the longest side of the largest
/// machines of this kind. Longer ones take minutes and gigabytes for parts that most likely fit
/// nothing; a profile may state its volume.
const MAX_SIZE_MM: f64 = 2000.0;

/// From here on a length is told as a power of ten, mm: a thousand kilometres have too many digits
/// to read.
const LONG_MM: f64 = 1e9;

/// Why no kit can be made of a model of this size.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SizeError {
    /// The walls fill all of it.
    #[error(
        "the model is {} long, and walls of {} leave nothing inside it to be emptied; remedy: give its size with --size, \
         its unit with --unit, or a thinner --wall",
        shown(*size_mm), shown(*wall_mm)
    )]
    AllWall {
        /// The model's longest side, mm.
        size_mm: f64,
        /// The wall, mm.
        wall_mm: f64,
    },
    /// Its parts would not fit the printer by far.
    #[error(
        "the model is {} long, and a kit for {printer} may be {} long at most; remedy: give its size with --size or its \
         unit with --unit, or state a larger build volume in the profile",
        shown(*size_mm), shown(*most_mm)
    )]
    TooLong {
        /// The model's longest side, mm.
        size_mm: f64,
        /// The longest that is tried, mm.
        most_mm: f64,
        /// The printer's id.
        printer: String,
    },
}

/// A length for people, however small or large.
fn shown(mm: f64) -> String {
    let is_plain = (1e-3..LONG_MM).contains(&mm);
    if is_plain {
        show_mm(mm)
    } else {
        format!("{mm:.1e} mm")
    }
}

impl Printer {
    /// The longest model that is tried, mm: some build lengths, or a fixed length where the build
    /// volume is not known.
    pub fn greatest_length_mm(&self) -> f64 {
        let longest = |volume: [f64; 3]| MAX_BUILD_LENGTHS * volume.into_iter().fold(0.0, f64::max);
        self.build_volume_mm
            .as_ref()
            .map_or(MAX_SIZE_MM, |volume| longest(volume.value))
    }

    /// Refuses a model whose longest side is beyond what could be cut into parts for this printer.
    pub fn allows_length(&self, size_mm: f64) -> Result<(), SizeError> {
        let most_mm = self.greatest_length_mm();
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

/// Refuses a model whose longest side two walls fill.
pub fn leaves_room(size_mm: f64, wall_mm: f64) -> Result<(), SizeError> {
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
    fn a_model_of_four_build_lengths_is_tried_and_a_longer_one_is_not() {
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
            assert_eq!(printer.allows_length(most_mm), Ok(()));
            for size_mm in [most_mm * 1.001, 1e300, f64::INFINITY, f64::NAN] {
                let error = printer.allows_length(size_mm).unwrap_err().to_string();
                assert!(error.contains(id) && error.contains("--unit"), "{error}");
                assert!(error.len() < 250, "{error}");
            }
        }
    }

    #[test]
    fn two_walls_leave_no_room() {
        assert_eq!(leaves_room(2.1, 1.0), Ok(()));
        assert!(
            leaves_room(2.0, 1.0)
                .unwrap_err()
                .to_string()
                .contains("nothing inside")
        );
        assert!(
            leaves_room(1e-300, 1.0)
                .unwrap_err()
                .to_string()
                .contains("1.0e-300 mm")
        );
    }
}
