//! The reasons why the inside of a print is not made of cells.

use crate::ballast::Order;
use crate::base::setting::{Key, Setting};
use crate::base::units::show_mm;
use crate::comb::CombError;
use crate::job::{CutMode, DrainOrder, Filling, Interior};

/// A reason why the inside of a print is not made of cells.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CellsError {
    /// A size of cells was ordered for what has none.
    #[error(
        "`{}` is the size of an inside of cells; remedy: order one (`{}`), or leave it out",
        Setting::new(Key::CellSize, format!("{size_mm}mm")),
        cells()
    )]
    NoCells {
        /// The size, mm.
        size_mm: f64,
    },
    /// Filament is laid with infill, and nothing drains.
    #[error(
        "{printer} lays filament, and loose strands and support would stay in closed cells; \
         remedy: print sparse infill in one piece (`{}`)",
        Setting::new(Key::Interior, Interior::Graded)
    )]
    Filament {
        /// The printer's name.
        printer: String,
    },
    /// Gel is dug out.
    #[error(
        "{printer} fills cells with support, which is dug out and does not drain; remedy: {}, or \
         take a printer of powder, resin or wax (`{}`)",
        hollow(),
        Setting::open(Key::Printer)
    )]
    Gel {
        /// The printer's name.
        printer: String,
    },
    /// Cuts, or a plan of cuts, were ordered for what stays in one piece.
    #[error(
        "`{}` makes one piece, and cuts are ordered; remedy: leave the order of cuts out, or {}",
        cells(),
        hollow()
    )]
    Cuts,
    /// A filling was ordered for what drains.
    #[error(
        "cells drain, and `{}` would run out; remedy: leave the filling out, or {}",
        Setting::new(Key::Fill, fill),
        hollow()
    )]
    Filling {
        /// The filling.
        fill: Filling,
    },
    /// Ballast was ordered for what is closed.
    #[error(
        "nothing can be laid into cells, and `{}` is ordered; remedy: leave the ballast out, or {}",
        Setting::new(Key::Ballast, order),
        hollow()
    )]
    Ballast {
        /// The ballast.
        order: Order,
    },
    /// Holes were forbidden.
    #[error(
        "with `{}` cells would stay full of powder, resin or wax; remedy: leave it out, or {}",
        Setting::new(Key::Drain, DrainOrder::Never),
        hollow()
    )]
    Closed,
    /// Water would run in.
    #[error(
        "cells drain, and what floats would take in water; remedy: close each drain hole with a \
         plug (`{}`), or {}",
        Setting::new(Key::Plugs, true),
        hollow()
    )]
    Floats,
    /// Cells have no place for drain holes, and the goal needs them.
    #[error(
        "{voids} has no place for drain holes of {diameter_mm} mm where the wall is thin and about \
         flat, and the goal needs it; remedy: order larger cells (`{}`), a larger model (`{}`), or \
         {}",
        Setting::open(Key::CellSize),
        Setting::open(Key::Size),
        hollow()
    )]
    NoPlace {
        /// The voids of connected cells, such as `V1, V2`.
        voids: String,
        /// The diameter of the holes, mm.
        diameter_mm: f64,
    },
    /// So many cells stay solid that the rest does not meet the goal.
    #[error(
        "cells of {} that have no opening of {opening_mm} mm, or would enclose resin below it, stay \
         solid, and the rest does not meet the goal; remedy: order larger cells (`{}`), a larger \
         model (`{}`), or {}",
        show_mm(*size_mm),
        Setting::open(Key::CellSize),
        Setting::open(Key::Size),
        hollow()
    )]
    TooSolid {
        /// The size, mm.
        size_mm: f64,
        /// The free diameter of the openings, mm.
        opening_mm: f64,
    },
    /// A match needs any density between two, and cells have one.
    #[error(
        "a match needs several densities, and cells have one; remedy: take a filament printer and \
         print sparse infill (`{}`)",
        Setting::new(Key::Interior, Interior::Graded)
    )]
    Match,
    /// The object is no single body.
    #[error(
        "a yo-yo on an axle is two halves, and `{}` makes one piece; remedy: leave the axle and \
         the string gap out, or {}",
        cells(),
        hollow()
    )]
    Halves,
    /// The cells are smaller than their walls and openings.
    #[error(
        "cells of {} have no room for walls of {} with openings of {opening_mm} mm, which need \
         {}; remedy: `{}` or more",
        show_mm(*size_mm),
        show_mm(*wall_mm),
        show_mm(*least_mm),
        Setting::new(Key::CellSize, format!("{:.1}mm", up_to_tenths(*least_mm)))
    )]
    NoRoom {
        /// The size, mm.
        size_mm: f64,
        /// The wall, mm.
        wall_mm: f64,
        /// The free diameter of the openings, mm.
        opening_mm: f64,
        /// The least size, mm.
        least_mm: f64,
    },
    /// The cells are larger than the model.
    #[error(
        "cells of {} are larger than the model, whose longest side is {}; remedy: order smaller \
         ones (`{}`), or {}",
        show_mm(*size_mm),
        show_mm(*longest_mm),
        Setting::open(Key::CellSize),
        hollow()
    )]
    Larger {
        /// The size, mm.
        size_mm: f64,
        /// The model's longest side, mm.
        longest_mm: f64,
    },
    /// There would be too many cells.
    #[error(
        "the model holds {count:.0} cells of {}, and at most {most} are made; remedy: `{}` or more",
        show_mm(*size_mm),
        Setting::new(Key::CellSize, format!("{:.1}mm", up_to_tenths(*least_mm)))
    )]
    TooMany {
        /// Their number.
        count: f64,
        /// The size, mm.
        size_mm: f64,
        /// The most cells.
        most: usize,
        /// The least size for so many, mm.
        least_mm: f64,
    },
    /// No cell has an opening.
    #[error(
        "no cells of {} inside this model hold openings of {opening_mm} mm between walls of {}; \
         remedy: order larger cells (`{}`), a larger model (`{}`), or {}",
        show_mm(*size_mm),
        show_mm(*wall_mm),
        Setting::open(Key::CellSize),
        Setting::open(Key::Size),
        hollow()
    )]
    NoneDrains {
        /// The size, mm.
        size_mm: f64,
        /// The wall, mm.
        wall_mm: f64,
        /// The free diameter of the openings, mm.
        opening_mm: f64,
    },
    /// The walls cannot be drawn.
    #[error(transparent)]
    Comb(#[from] CombError),
}

fn cells() -> Setting {
    Setting::new(Key::Interior, Interior::Cells)
}

/// Words the remedy of voids that are cut open.
fn hollow() -> String {
    format!(
        "hollow the print and cut it open (`{}`, `{}`)",
        Setting::new(Key::Interior, Interior::Hollow),
        Setting::new(Key::Cut, CutMode::Auto)
    )
}

/// Rounds a length up to tenths of a millimetre.
fn up_to_tenths(mm: f64) -> f64 {
    (mm * 10.0).ceil() / 10.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_refusal_has_a_remedy_with_what_to_type() {
        let printer = || "Some".to_owned();
        let refusals = [
            CellsError::NoCells { size_mm: 12.0 },
            CellsError::Filament { printer: printer() },
            CellsError::Gel { printer: printer() },
            CellsError::Cuts,
            CellsError::Filling {
                fill: "2.3".parse().unwrap(),
            },
            CellsError::Ballast { order: Order::Auto },
            CellsError::Closed,
            CellsError::Floats,
            CellsError::NoPlace {
                voids: "V1".to_owned(),
                diameter_mm: 5.0,
            },
            CellsError::TooSolid {
                size_mm: 12.0,
                opening_mm: 3.5,
            },
            CellsError::Match,
            CellsError::Halves,
            CellsError::NoRoom {
                size_mm: 2.0,
                wall_mm: 1.0,
                opening_mm: 3.5,
                least_mm: 5.04,
            },
            CellsError::Larger {
                size_mm: 200.0,
                longest_mm: 100.0,
            },
            CellsError::TooMany {
                count: 1e6,
                size_mm: 1.0,
                most: 5000,
                least_mm: 4.0,
            },
            CellsError::NoneDrains {
                size_mm: 6.0,
                wall_mm: 1.0,
                opening_mm: 5.0,
            },
        ];
        for refusal in refusals {
            let text = refusal.to_string();
            let (_, remedy) = text.split_once("; remedy: ").unwrap();
            assert!(remedy.contains('`'), "{text}");
        }
    }

    #[test]
    fn the_least_size_that_is_advised_is_not_below_the_one_that_is_needed() {
        let refusal = CellsError::NoRoom {
            size_mm: 2.0,
            wall_mm: 1.0,
            opening_mm: 3.5,
            least_mm: 5.04,
        };
        let text = refusal.to_string();
        assert!(text.contains("5.1mm"), "{text}");
    }
}
