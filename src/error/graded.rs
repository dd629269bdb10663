//! The reasons why a job with sparse infill in one piece is refused.

use crate::ballast::Order;
use crate::base::setting::{Key, Setting};
use crate::field::NotADensity;
use crate::job::{
    DensityOrder, FieldOrder, Filling, InfillDensity, Interior, KeptShare, LevelCount, PartFormat,
};

/// A reason why a print cannot be graded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GradedError {
    /// The printer has no infill.
    #[error(
        "{printer} prints without infill, so that `{}` is not possible; remedy: take a filament \
         printer, or {}",
        graded(),
        hollow()
    )]
    NoInfill {
        /// The printer's name.
        printer: String,
    },
    /// Cuts, or plans of cuts, were ordered for what stays in one piece.
    #[error(
        "`{}` makes one piece, and cuts are ordered; remedy: leave the order of cuts or plans out, \
         or {}",
        graded(),
        hollow()
    )]
    Cuts,
    /// A filling was ordered for voids that are print.
    #[error(
        "`{}` leaves no void for `{}`; remedy: leave the filling out, or {}",
        graded(),
        Setting::new(Key::Fill, fill),
        hollow()
    )]
    Filling {
        /// The filling.
        fill: Filling,
    },
    /// Ballast was ordered for what is closed.
    #[error(
        "`{}` leaves no void for `{}`; remedy: leave the ballast out, or {}",
        graded(),
        Setting::new(Key::Ballast, order),
        hollow()
    )]
    Ballast {
        /// The ballast.
        order: Order,
    },
    /// The object is no single body.
    #[error(
        "a yo-yo on an axle is two halves, and `{}` makes one piece; remedy: leave the axle and \
         the string gap out, or {}",
        graded(),
        hollow()
    )]
    Halves,
    /// A print that floats needs its mass to a fraction of a per cent, which only toolpaths tell.
    #[error(
        "what floats must weigh what it should to a fraction of a per cent, and only toolpaths \
         tell what `{}` weighs; remedy: slice it (`{}`), or {}",
        graded(),
        Setting::open(Key::Slice),
        hollow()
    )]
    FloatUnsliced,
    /// A match was ordered of a hollow print.
    #[error(
        "what handles like another body needs infill of several densities, and a hollow print has \
         none; remedy: print one piece with graded infill (`{}`)",
        graded()
    )]
    HollowMatch,
    /// The mass of a match decides its mean infill.
    #[error(
        "a match has one right mean infill, and `{}` asks for another; remedy: leave it out",
        Setting::new(Key::Infill, wished)
    )]
    WishedMatch {
        /// The wished infill.
        wished: InfillDensity,
    },
    /// Solid print was ordered for the inside of a match.
    #[error(
        "a match may need a dense core in sparse infill, and solid print is no infill; remedy: \
         order less (`{}`)",
        Setting::new(Key::Density, usual)
    )]
    SolidMatch {
        /// The usual densities of a match.
        usual: DensityOrder,
    },
    /// Densities were ordered for a hollow print.
    #[error(
        "a hollow print is solid but for its voids, and `{order}` is ordered; remedy: order one \
         piece (`{}`), or leave it out",
        graded()
    )]
    NotGraded {
        /// The order.
        order: Setting,
    },
    /// A density is less than the printer's infill carries.
    #[error(
        "infill of {density} does not carry what {printer} prints over it; remedy: order no less \
         than {least} (`{}`), or lower least_infill_ratio in a profile of your own, to 0.1 at the least",
        Setting::new(Key::Density, at_least(*least, *high))
    )]
    TooSparse {
        /// The printer's name.
        printer: String,
        /// The least density that was ordered.
        density: InfillDensity,
        /// The greatest.
        high: InfillDensity,
        /// The least that prints.
        least: InfillDensity,
    },
    /// The wished infill is beyond the densities that may be printed.
    #[error(
        "the wished `{}` is not within `{}`; remedy: order densities around it",
        Setting::new(Key::Infill, wished),
        Setting::new(Key::Density, densities)
    )]
    WishedOutside {
        /// The wished infill.
        wished: InfillDensity,
        /// The densities.
        densities: DensityOrder,
    },
    /// Levels were ordered, and no infill that they should be near.
    #[error(
        "`{}` are levels near a wished infill, and none is ordered; remedy: order one (`{}`), or \
         leave the levels out for the two densities at their best",
        Setting::new(Key::Levels, levels),
        Setting::new(Key::Infill, "40%")
    )]
    LevelsAlone {
        /// The levels.
        levels: LevelCount,
    },
    /// Two levels were ordered near a wished infill.
    #[error(
        "two densities are placed by the goal alone, and `{}` asks for more; remedy: order three \
         levels or more (`{}`), or leave the infill out",
        Setting::new(Key::Infill, wished),
        Setting::new(Key::Levels, 3)
    )]
    TwoLevels {
        /// The wished infill.
        wished: InfillDensity,
    },
    /// Two levels were ordered for a match.
    #[error(
        "two densities reach no more than the rim of what a match can have; remedy: order three \
         levels or more (`{}`), or leave the levels out",
        Setting::new(Key::Levels, 3)
    )]
    TwoLevelsOfMatch,
    /// A share of the best figure was ordered where no infill is wished.
    #[error(
        "`{}` is kept near a wished infill, and none is ordered; remedy: order one (`{}`), or \
         leave the share out for the best itself",
        Setting::new(Key::Keep, share),
        Setting::new(Key::Infill, "40%")
    )]
    KeepAlone {
        /// The share.
        share: KeptShare,
    },
    /// A share of the best figure was ordered for a goal that is met or not.
    #[error(
        "a rotor runs true or not, so that there is no share of it to keep; remedy: leave `{}` out",
        Setting::new(Key::Keep, share)
    )]
    KeepBalance {
        /// The share.
        share: KeptShare,
    },
    /// The densities are too near to each other for the levels.
    #[error(
        "{count} levels do not fit between the densities; remedy: order fewer (`{}`), or \
         densities farther apart (`{}`)",
        Setting::open(Key::Levels),
        Setting::open(Key::Density)
    )]
    Levels {
        /// The number of levels.
        count: usize,
    },
    /// A field was ordered for a goal that it has no numbers for.
    #[error(
        "`{}` has four numbers, and what floats or matches needs more; remedy: leave the field \
         out, so that the best densities are found",
        Setting::new(Key::Field, field)
    )]
    FieldOfGoal {
        /// The field.
        field: Box<FieldOrder>,
    },
    /// Densities were ordered of a field that has its own.
    #[error(
        "`{}` has its densities, and `{}` orders others; remedy: leave one of them out",
        Setting::new(Key::Field, field),
        Setting::new(Key::Density, order)
    )]
    FieldDensities {
        /// The field.
        field: Box<FieldOrder>,
        /// The densities.
        order: DensityOrder,
    },
    /// A field has a density that the printer's infill cannot be.
    #[error(
        "`{}` goes beyond what {printer} lays; remedy: give it densities from {least:.3} to \
         {most:.3}, or 1 for solid print around infill",
        Setting::new(Key::Field, field)
    )]
    FieldBeyond {
        /// The field.
        field: Box<FieldOrder>,
        /// The printer's name.
        printer: String,
        /// The least density.
        least: f64,
        /// The greatest.
        most: f64,
    },
    /// A field has a density inside the walls that the printer's infill cannot be.
    #[error(
        "inside the walls `{}` has densities from {:.3} to {:.3}, and {printer} lays from {:.3} to \
         {:.3}; remedy: scale the field, or give it limits",
        Setting::new(Key::Field, field),
        found[0],
        found[1],
        lays[0],
        lays[1]
    )]
    FieldBeyondInside {
        /// The field.
        field: Box<FieldOrder>,
        /// The printer's name.
        printer: String,
        /// Its least and its greatest density.
        found: [f64; 2],
        /// Those that the printer lays.
        lays: [f64; 2],
    },
    /// A field is no density somewhere in the model.
    #[error(transparent)]
    FieldFault(#[from] NotADensity),
    /// A field leaves no infill inside the walls.
    #[error(
        "`{}` leaves nothing but solid print inside the walls; remedy: give it a lesser depth or \
         lesser densities",
        Setting::new(Key::Field, field)
    )]
    FieldSolid {
        /// The field.
        field: Box<FieldOrder>,
    },
    /// A field has more regions than slicers take.
    #[error(
        "`{}` has more than twelve regions of infill in this body; remedy: order a longer wave, or \
         fewer levels (`{}`)",
        Setting::new(Key::Field, field),
        Setting::new(Key::Levels, 3)
    )]
    FieldTooFine {
        /// The field.
        field: Box<FieldOrder>,
    },
    /// A wave needs a density below solid print, as its dense shells lie in sparse ones.
    #[error(
        "a wave has dense shells in sparse infill, and solid print is no infill; remedy: order \
         less (`{}`)",
        Setting::new(Key::Density, usual)
    )]
    SolidSine {
        /// The usual densities of a wave.
        usual: DensityOrder,
    },
    /// Two levels were ordered of a field.
    #[error(
        "a field in two densities is no field; remedy: order three levels or more (`{}`), or leave \
         the field out for the best two",
        Setting::new(Key::Levels, 3)
    )]
    TwoLevelsOfField,
    /// Floating depends on the mass, which a wished infill leaves open.
    #[error(
        "what floats has one right mass, and `{}` asks for another; remedy: leave it out, so that \
         two densities give the right one",
        Setting::new(Key::Infill, wished)
    )]
    WishedAfloat {
        /// The wished infill.
        wished: InfillDensity,
    },
    /// A package read as a part does not tell regions in regions apart.
    #[error(
        "a part's own 3MF file holds one region of infill, and {regions} are ordered; remedy: \
         order both formats (`{}`), or densities up to 100% (`{}`)",
        Setting::new(Key::Format, PartFormat::Both),
        Setting::open(Key::Density)
    )]
    OnlyThreeMf {
        /// The number of regions.
        regions: usize,
    },
    /// The files of the parts alone do not hold the region.
    #[error(
        "STL files do not hold the region of `{}`, and no plate is ordered; remedy: order both \
         formats (`{}`), or {}",
        graded(),
        Setting::new(Key::Format, PartFormat::Both),
        hollow()
    )]
    OnlyStl,
    /// The model has cavities of its own.
    #[error(
        "the model has cavities, and `{}` prints no void; remedy: fill them (`{}`), or {}",
        graded(),
        Setting::new(Key::Repair, "fill"),
        hollow()
    )]
    Cavities,
}

/// Words the densities from the least that prints.
fn at_least(least: InfillDensity, high: InfillDensity) -> String {
    let high = if high > least {
        high
    } else {
        InfillDensity::SOLID
    };
    format!("{least}..{high}")
}

fn graded() -> Setting {
    Setting::new(Key::Interior, Interior::Graded)
}

/// Words the remedy that always works.
fn hollow() -> String {
    format!(
        "hollow the print (`{}`)",
        Setting::new(Key::Interior, Interior::Hollow)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_refusal_names_what_was_ordered_and_a_remedy() {
        let refusals = [
            GradedError::NoInfill {
                printer: "Form 4".to_owned(),
            },
            GradedError::Cuts,
            GradedError::Filling {
                fill: "2.3".parse().unwrap(),
            },
            GradedError::Ballast { order: Order::Auto },
            GradedError::Halves,
            GradedError::Cavities,
            GradedError::FloatUnsliced,
            GradedError::OnlyStl,
        ];
        for refusal in refusals {
            let words = refusal.to_string();
            assert!(words.contains("`interior = \"graded\"`"), "{words}");
            assert!(words.contains("remedy: "), "{words}");
            assert!(
                words.ends_with("hollow the print (`interior = \"hollow\"`)"),
                "{words}"
            );
        }
    }
}
