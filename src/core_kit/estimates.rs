//! Estimates of times and prices, from what the profiles of machines and sheets say.

use super::asked::Asked;
use super::made::Made;
use super::rows::sheet_rows;
use crate::cutter::StockSheet;
use crate::cutting::CutSheet;
use crate::job::core_kit::CoreShell;
use crate::printer::Quantity;
use crate::sheet::core_kit::{EstimateRow, MassRow};

/// Returns the estimates for an object. Profiles that have no figures lead to none.
pub fn estimates(asked: &Asked, made: &Made, masses: &MassRow) -> EstimateRow {
    let flow = |quantity: Quantity| {
        let number = asked.shop.printer.number(quantity);
        number.map(|number| number.value)
    };
    let (walls, blocks) = (flow(Quantity::WallFlowMm3S), flow(Quantity::SolidFlowMm3S));
    let shell = match asked.job.shell {
        CoreShell::Cups => walls,
        CoreShell::Solid => blocks,
    };
    let time_s = |mass_g: f64, flow: Option<f64>| {
        let volume_mm3 = mass_g / asked.print_g_mm3();
        flow.map(|flow| volume_mm3 / flow)
    };
    EstimateRow {
        print_s: time_s(masses.shell_g + masses.brackets_g, shell),
        if_solid_s: time_s(masses.if_solid_g, blocks),
        if_skin_s: time_s(masses.if_skin_g, walls),
        cut_s: sheet_rows(asked, made).iter().map(|row| row.cut_s).sum(),
        sheets_price: sheets_price(asked, &made.built.sheets),
    }
}

/// Returns the price of sheets by their profile, but for offcuts; `None` if it has none for one.
fn sheets_price(asked: &Asked, sheets: &[CutSheet]) -> Option<f64> {
    let whole = sheets.iter().filter(|sheet| !sheet.nested.is_offcut);
    let prices: Option<Vec<f64>> = whole.map(|sheet| price(asked, sheet)).collect();
    let prices = prices.filter(|prices| !prices.is_empty())?;
    Some(prices.iter().sum())
}

/// Returns the price of a sheet of this size by its profile.
fn price(asked: &Asked, cut: &CutSheet) -> Option<f64> {
    let sheet: &StockSheet = &asked.shop.sheet;
    let on_bed = |size_mm| asked.shop.cutter.on_bed(size_mm).size_mm;
    let mut sizes = sheet.sizes.iter();
    let own = sizes.find(|size| on_bed(size.size_mm.value) == cut.nested.size_mm)?;
    own.price
}
