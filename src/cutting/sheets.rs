//! Sheets with panels: how they lie, what is drawn for the cutter, and how much is cut.

use crate::cutter::{CannotCut, Cutter, CutterNumber, Dialect, StockSheet};
use crate::io::{CutDrawing, CutLayer, DrawnLine, DrawnShape};
use crate::panels::{
    BeamError, Hole, LineOrder, NestError, NestRequest, NestedSheet, Outline, Panel, PanelSet,
    SheetLines, Stock, nest,
};

/// Height of a panel's number, mm: it is read at arm's length.
const TEXT_MM: f64 = 12.0;

/// The order for the sheets of a base.
#[derive(Debug, Clone, Copy)]
pub struct SheetOrder<'a> {
    /// The cutter.
    pub cutter: &'a Cutter,
    /// The sheet.
    pub sheet: &'a StockSheet,
    /// The sheets at hand, as they lie on the bed; empty for any number of each size of the sheet's
    /// profile. Those with a number are offcuts, which are used first.
    pub stock: &'a [Stock],
    /// True if panels may only be turned by half a turn against the grain of their sheet.
    pub keeps_grain: bool,
}

/// The reason that panels cannot be cut out of sheets.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SheetError {
    /// The cutter does not cut the sheet.
    #[error(transparent)]
    CannotCut(#[from] CannotCut),
    /// No size of the sheet is known.
    #[error(
        "sheet `{0}` has no size; remedy: add `sizes` to its profile, or name the sheets at \
         hand"
    )]
    NoSize(String),
    /// The panels find no place.
    #[error("{0}; remedy: use a larger sheet or cutter, or ask for more faces")]
    Nest(#[from] NestError),
    /// A gap is narrower than the cut.
    #[error("the panels cannot be cut: {0}; remedy: check the kerf in the cutter's profile")]
    Beam(#[from] BeamError),
}

/// A sheet with panels, ready for the cutter.
#[derive(Debug, Clone, PartialEq)]
pub struct CutSheet {
    /// The places of the panels.
    pub nested: NestedSheet,
    /// The paths of the beam, and what is engraved.
    pub lines: SheetLines,
    /// The area of its panels with their holes, mm².
    pub panels_mm2: f64,
}

/// The figures of a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetFigures {
    /// The share of the whole sheet that is panels.
    pub sheet_ratio: f64,
    /// The share of its used length that is panels.
    pub used_ratio: f64,
    /// The length of all cuts, mm.
    pub cut_mm: f64,
    /// The number of times that the beam pierces the sheet.
    pub pierces: usize,
    /// The length of all engraved strokes, mm.
    pub engraved_mm: f64,
}

/// Lays the panels of a base on sheets, their inner faces up, and finds the paths of the beam.
///
/// Panels lie as far apart as the cutter asks, and as far from the edge as its margin. Offcuts are
/// used first.
///
/// # Errors
/// The cutter does not cut the sheet, no sheet has room for a panel, or a gap is too narrow.
pub fn cut_sheets(set: &PanelSet, order: &SheetOrder) -> Result<Vec<CutSheet>, SheetError> {
    let kerf = order.cutter.check_sheet(order.sheet)?;
    let kerf_mm = kerf.kerf_mm;
    let request = nest_request(order, kerf_mm)?;
    let outlines = set.panels.iter().map(Panel::inner_outline);
    let rings: Vec<Vec<[f64; 2]>> = outlines.map(|ring| ring.corners().to_vec()).collect();
    let lines = LineOrder {
        kerf_mm: order.cutter.offset_mm(kerf_mm),
        text_mm: TEXT_MM,
    };
    let sheets = nest(&rings, &request)?.into_iter();
    let cut = sheets.map(|nested| {
        let panels = nested.placements.iter().map(|at| &set.panels[at.panel]);
        let panels_mm2 = panels
            .map(|panel| panel.volume_mm3() / panel.sheet_mm)
            .sum();
        Ok(CutSheet {
            lines: SheetLines::of(set, &nested, &lines)?,
            nested,
            panels_mm2,
        })
    });
    cut.collect()
}

/// Returns the sizes of a sheet's profile as they lie on the bed, each once.
pub fn whole_sheets(cutter: &Cutter, sheet: &StockSheet) -> Vec<Stock> {
    let sizes = sheet.sizes.iter();
    let sizes = sizes.map(|size| cutter.on_bed(size.size_mm.value));
    let mut stock: Vec<Stock> = Vec::new();
    for on_bed in sizes {
        let fresh = Stock {
            size_mm: on_bed.size_mm,
            count: None,
            is_turned: on_bed.is_turned,
        };
        if !stock.contains(&fresh) {
            stock.push(fresh);
        }
    }
    stock
}

/// Returns the order for the nest: sizes as they lie on the bed, with the cutter's margin.
fn nest_request(order: &SheetOrder, kerf_mm: f64) -> Result<NestRequest, SheetError> {
    let SheetOrder { cutter, sheet, .. } = order;
    let spacing_mm = cutter.spacing_mm(kerf_mm);
    let margin = cutter.numbers.get(&CutterNumber::MarginMm);
    let margin_mm = margin.map_or(spacing_mm, |margin| margin.value.max(spacing_mm));
    let mut stock = order.stock.to_vec();
    if stock.is_empty() {
        stock = whole_sheets(cutter, sheet);
    }
    // The least offcuts come first.
    let area_mm2 = |stock: &Stock| stock.size_mm[0] * stock.size_mm[1];
    stock.sort_by(|a, b| {
        let is_whole = |stock: &Stock| stock.count.is_none();
        let by_kind = is_whole(a).cmp(&is_whole(b));
        by_kind.then_with(|| match is_whole(a) {
            true => std::cmp::Ordering::Equal,
            false => area_mm2(a).total_cmp(&area_mm2(b)),
        })
    });
    if stock.is_empty() {
        return Err(SheetError::NoSize(sheet.id.clone()));
    }
    Ok(NestRequest {
        stock,
        margin_mm,
        spacing_mm,
        keeps_grain: order.keeps_grain,
    })
}

impl CutSheet {
    /// Returns the drawing of the sheet, in the colours of a cutter's software.
    pub fn drawing(&self, dialect: Dialect) -> CutDrawing {
        let SheetLines {
            size_mm: [length, width],
            outlines,
            holes,
            strokes,
        } = &self.lines;
        let edge = Outline::rectangle([0.0; 2], [*length, *width]);
        let on = |layer: CutLayer| move |shape: DrawnShape| DrawnLine { layer, shape };
        let closed = |outline: &Outline| DrawnShape::Closed(outline.corners().to_vec());
        let circle = |hole: &Hole| DrawnShape::Circle {
            center_mm: hole.at_mm,
            radius_mm: 0.5 * hole.diameter_mm,
        };
        let engraved = strokes.iter().cloned().map(DrawnShape::Open);
        let lines = engraved
            .map(on(CutLayer::Engrave))
            .chain(holes.iter().map(circle).map(on(CutLayer::Inner)))
            .chain(outlines.iter().map(closed).map(on(CutLayer::Outer)))
            .chain([on(CutLayer::Sheet)(closed(&edge))]);
        CutDrawing {
            size_mm: self.lines.size_mm,
            lines: lines.collect(),
            colors: dialect.colors(),
        }
    }

    /// Returns how much of the sheet is used, and how much is cut.
    pub fn figures(&self) -> SheetFigures {
        let [length_mm, width_mm] = self.nested.size_mm;
        SheetFigures {
            sheet_ratio: self.panels_mm2 / (length_mm * width_mm),
            used_ratio: self.panels_mm2 / (self.nested.used_mm * width_mm),
            cut_mm: self.lines.cut_mm(),
            pierces: self.lines.outlines.len() + self.lines.holes.len(),
            engraved_mm: self.lines.engraved_mm(),
        }
    }
}
