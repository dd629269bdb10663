//! The reasons why an uncut piece gets no drain holes.

use crate::base::setting::{Key, Setting};
use crate::job::{CutMode, DrainOrder, Interior};
use crate::printer::Undrainable;

/// A reason why an uncut piece gets no drain holes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrainError {
    /// Support and loose strands of filament do not come out of a hole.
    #[error(
        "in one piece the voids of {printer} stay closed: support and loose strands do not come \
         out of a drain hole; remedy: print sparse infill in one piece (`{}`), or cut it open \
         (`{}`)",
        Setting::new(Key::Interior, Interior::Graded),
        cut_open()
    )]
    Filament {
        /// The printer's name.
        printer: String,
    },
    /// Gel does not come out of a hole.
    #[error(
        "in one piece the voids of {printer} stay full of support, which is dug out and does not \
         come out of a drain hole; remedy: cut it open (`{}`)",
        cut_open()
    )]
    Gel {
        /// The printer's name.
        printer: String,
    },
    /// The holes are too narrow.
    #[error(
        "drain holes of {asked_mm} mm do not empty a void of {printer}, which needs {least_mm} mm; \
         remedy: `{}`",
        Setting::new(Key::Drain, format!("{least_mm}mm"))
    )]
    Narrow {
        /// The printer's name.
        printer: String,
        /// The diameter asked for, mm.
        asked_mm: f64,
        /// The least diameter, mm.
        least_mm: f64,
    },
    /// Water would run in.
    #[error(
        "what floats would take in water through drain holes; remedy: close each with a plug \
         (`{}`), or cut it open and glue it (`{}`)",
        Setting::new(Key::Plugs, true),
        cut_open()
    )]
    Floats,
    /// The filling would run out.
    #[error(
        "in one piece no void can be filled, and a filling would run out of drain holes; remedy: \
         leave out `{}`, or cut it open (`{}`)",
        Setting::open(Key::Fill),
        cut_open()
    )]
    Filling,
    /// Ballast does not go in.
    #[error(
        "in one piece nothing is laid into a void; remedy: leave out `{}`, or cut it open (`{}`)",
        Setting::open(Key::Ballast),
        cut_open()
    )]
    Ballast,
    /// Holes were ordered for what is cut, or has no voids.
    #[error(
        "`{}` is for a hollow print in one uncut piece; remedy: order one (`{}`), or leave it out",
        Setting::new(Key::Drain, order),
        Setting::new(Key::Cut, CutMode::Never)
    )]
    NotWhole {
        /// The order.
        order: DrainOrder,
    },
    /// Plugs were ordered for what has no drain holes.
    #[error(
        "`{}` closes the drain holes of a hollow print in one uncut piece; remedy: order one \
         (`{}`), or leave it out",
        Setting::new(Key::Plugs, true),
        Setting::new(Key::Cut, CutMode::Never)
    )]
    PlugsOnly,
    /// No holes were wanted for voids that are full of something.
    #[error(
        "with `{}` the {voids} in the uncut piece would stay full of powder, resin or support; \
         remedy: leave it out, or cut it open (`{}`)",
        Setting::new(Key::Drain, DrainOrder::Never),
        cut_open()
    )]
    Closed {
        /// The number of voids, in words.
        voids: String,
    },
    /// A void has no place for its holes, and the goal needs it.
    #[error(
        "{voids} has no place for drain holes of {diameter_mm} mm where the wall is thin and about \
         flat, and the goal needs it; remedy: {}a larger model (`{}`), or cut it open (`{}`)",
        least_holes(*is_asked),
        Setting::open(Key::Size),
        cut_open()
    )]
    NoPlace {
        /// The voids, such as `V1, V2`.
        voids: String,
        /// The diameter of the holes, mm.
        diameter_mm: f64,
        /// True if that width was asked for, and narrower ones would do.
        is_asked: bool,
    },
}

impl DrainError {
    /// Returns the reason why a printer's voids cannot be drained by holes of this diameter.
    pub fn of_printer(why: Undrainable, printer: &str, order: DrainOrder) -> Self {
        let printer = printer.to_owned();
        match why {
            Undrainable::Filament => Self::Filament { printer },
            Undrainable::Gel => Self::Gel { printer },
            Undrainable::Narrow { least_mm } => Self::Narrow {
                printer,
                asked_mm: order.asked_mm().unwrap_or(0.0),
                least_mm,
            },
        }
    }
}

/// Words the remedy of narrower holes, if there are any.
fn least_holes(is_asked: bool) -> String {
    match is_asked {
        true => {
            let least = Setting::new(Key::Drain, DrainOrder::Auto);
            format!("the least holes that do (`{least}`), ")
        }
        false => String::new(),
    }
}

/// Returns the setting that lets the planner cut.
fn cut_open() -> Setting {
    Setting::new(Key::Cut, CutMode::Auto)
}
