//! The reasons why a kit is not sliced while it is prepared, or its rounds are refused.

use crate::base::setting::{Key, Setting};

/// A reason why a kit is not sliced while it is prepared, or its rounds are refused.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SlicedError {
    /// The printer is not one whose plates a slicer turns into toolpaths.
    #[error(
        "{printer} prints no filament on a plate of known size, so that there are no toolpaths to \
         weigh; remedy: leave out `{}`",
        Setting::open(Key::Slice)
    )]
    NoFilament {
        /// The printer's name.
        printer: String,
    },
    /// The kit has no plates to slice.
    #[error(
        "STL files alone have no plates to slice; remedy: leave out `{}` or `{}`",
        Setting::open(Key::Slice),
        Setting::open(Key::Format)
    )]
    NoPlates,
    /// The rounds in the job are those of another print.
    #[error(
        "the rounds in this job were weighed for another print; remedy: delete all of its \
         [[sliced]] and [toolpaths], and slice it anew (`{}`)",
        Setting::open(Key::Slice)
    )]
    OtherRounds,
    /// The toolpaths in the job are those of other plates.
    #[error(
        "the toolpaths in this job are those of other plates than this kit has; remedy: delete \
         all of its [[sliced]] and [toolpaths], and slice it anew (`{}`)",
        Setting::open(Key::Slice)
    )]
    OtherPlates,
    /// The toolpaths of a kit lack a part.
    #[error(
        "the toolpaths of this kit lack {parts}; remedy: leave out `{}`, and slice the kit by \
         itself to see why",
        Setting::open(Key::Slice)
    )]
    NotAllLaid {
        /// The ids of the parts.
        parts: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_refusal_names_a_remedy() {
        for refusal in [
            SlicedError::NoFilament {
                printer: "Form 4".to_owned(),
            },
            SlicedError::NoPlates,
            SlicedError::OtherRounds,
            SlicedError::OtherPlates,
            SlicedError::NotAllLaid {
                parts: "P02".to_owned(),
            },
        ] {
            let words = refusal.to_string();
            assert!(words.contains("remedy: "), "{words}");
            assert!(words.contains("slice = …"), "{words}");
        }
    }
}
