//! The sheets that are cut against those at hand, and panels against the grain.

use std::f64::consts::FRAC_PI_2;

use super::promise::{CorePromise, CutSheetPromise};

/// By how much sides may differ, mm.
const SIDE_SLACK_MM: f64 = 1e-6;

/// The facts about stock and grain.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StockFacts {
    /// Sheets that are not at hand, or larger than the bed, in words.
    pub faults: Vec<String>,
    /// The greatest sine of a panel's turn against its sheet; `None` if the grain does not matter.
    pub turn_sine: Option<f64>,
}

/// Holds the sheets against those at hand.
pub fn measure_stock(promise: &CorePromise) -> StockFacts {
    let sines = promise.cut_sheets.iter().flat_map(|sheet| {
        let grain_rad = if sheet.is_turned { FRAC_PI_2 } else { 0.0 };
        let panels = sheet.panels.iter();
        panels.map(move |placed| (placed.turn_rad - grain_rad).sin().abs())
    });
    let turn_sine = promise.sheet.keeps_grain.then(|| sines.fold(0.0, f64::max));
    StockFacts {
        faults: [too_large(promise), missing(promise)].concat(),
        turn_sine,
    }
}

/// Returns the sheets that the bed does not hold.
fn too_large(promise: &CorePromise) -> Vec<String> {
    let bed_mm = promise.cutter.bed_mm;
    // Sizes are those of sheets as they lie.
    let wrong = promise.cut_sheets.iter().filter(|sheet| {
        let mut sides = sheet.size_mm.iter().zip(bed_mm);
        !sides.all(|(side, room)| *side <= room + SIDE_SLACK_MM)
    });
    wrong
        .map(|sheet| format!("{} does not lie on the bed", sheet.dxf))
        .collect()
}

/// Returns the sheets of which there are none, or not as many.
fn missing(promise: &CorePromise) -> Vec<String> {
    type Lying = ([f64; 2], bool);
    let is_of = |(a, is_a_turned): Lying, (b, is_b_turned): Lying| {
        is_a_turned == is_b_turned && (0..2).all(|k| (a[k] - b[k]).abs() <= SIDE_SLACK_MM)
    };
    let of = |sheet: &CutSheetPromise| (sheet.size_mm, sheet.is_turned);
    let at_hand = |sheet: &CutSheetPromise| {
        let own = promise
            .stock
            .iter()
            .filter(|stock| is_of((stock.size_mm, stock.is_turned), of(sheet)));
        own.map(|stock| stock.count.unwrap_or(usize::MAX))
            .fold(0, usize::saturating_add)
    };
    let sheets = promise.cut_sheets.iter().enumerate();
    let wrong = sheets.filter(|(index, sheet)| {
        let earlier = promise.cut_sheets[..*index].iter();
        let used = earlier.filter(|other| is_of(of(other), of(sheet)));
        used.count() >= at_hand(sheet)
    });
    wrong
        .map(|(_, sheet)| {
            let [length, width] = sheet.size_mm;
            format!(
                "there is no sheet of {length} x {width} mm for {}",
                sheet.dxf
            )
        })
        .collect()
}
