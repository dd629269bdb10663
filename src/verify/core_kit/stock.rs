//! The sheets that are cut against those at hand, and panels against the grain.

use super::promise::CorePromise;

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
    let turns = promise.cut_sheets.iter().flat_map(|sheet| &sheet.panels);
    let sines = turns.map(|placed| placed.turn_rad.sin().abs());
    let turn_sine = promise.sheet.keeps_grain.then(|| sines.fold(0.0, f64::max));
    StockFacts {
        faults: [too_large(promise), missing(promise)].concat(),
        turn_sine,
    }
}

/// Returns the sheets that the bed does not hold.
fn too_large(promise: &CorePromise) -> Vec<String> {
    let Some([bed_length, bed_width]) = promise.cutter.bed_mm else {
        return Vec::new();
    };
    let lies = |[length, width]: [f64; 2]| {
        length <= bed_length + SIDE_SLACK_MM && width <= bed_width + SIDE_SLACK_MM
    };
    let wrong = promise.cut_sheets.iter().filter(|sheet| {
        let [length, width] = sheet.size_mm;
        !(lies([length, width]) || lies([width, length]))
    });
    wrong
        .map(|sheet| format!("{} does not lie on the bed", sheet.dxf))
        .collect()
}

/// Returns the sheets of which there are none, or not as many.
fn missing(promise: &CorePromise) -> Vec<String> {
    // Lists without stock are those of older kits.
    if promise.stock.is_empty() {
        return Vec::new();
    }
    let is_of = |a: [f64; 2], b: [f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() <= SIDE_SLACK_MM);
    let at_hand = |size: [f64; 2]| {
        let own = promise
            .stock
            .iter()
            .filter(|stock| is_of(stock.size_mm, size));
        own.map(|stock| stock.count.unwrap_or(usize::MAX))
            .fold(0, usize::saturating_add)
    };
    let sheets = promise.cut_sheets.iter().enumerate();
    let wrong = sheets.filter(|(index, sheet)| {
        let earlier = promise.cut_sheets[..*index].iter();
        let used = earlier.filter(|other| is_of(other.size_mm, sheet.size_mm));
        used.count() >= at_hand(sheet.size_mm)
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
