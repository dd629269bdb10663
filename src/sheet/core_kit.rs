//! The checklist of an object on a laser-cut base, for people and for machines.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Verdict;
use super::kind::kind_sheet;
use crate::verify::{
    BallastPromise, Check, CorePartPromise, CutPromise, CutSheetPromise, FastenerPromise,
    GluePromise, JoinPromise, PegPromise, PrinterLimits, RodPromise, StockPromise, UnitPromise,
};

/// The version of the keys.
pub const CORE_SHEET_SCHEMA: u32 = 1;

/// Everything the sheets of an object say: `checklist.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoreSheet {
    /// The version of the keys.
    pub schema: u32,
    /// Always `core`.
    pub kind: &'static str,
    /// The name of the job.
    pub job: String,
    /// The version of the program.
    pub version: &'static str,
    /// The verdict over all checks.
    pub verdict: Verdict,
    /// The model.
    pub model: CoreModelRow,
    /// The printer.
    pub printer: CorePrinterRow,
    /// The material of printed parts.
    pub material: CoreMaterialRow,
    /// The cutter.
    pub cutter: CutterRow,
    /// The sheet.
    pub sheet: SheetRow,
    /// The base.
    pub base: BaseRow,
    /// The wall of the parts, mm.
    pub wall_mm: f64,
    /// True if the parts are solid down to the base.
    pub is_solid: bool,
    /// The distance that the base keeps from the model's surface, mm.
    pub distance_mm: f64,
    /// The gap between panels and parts, mm.
    pub gap_mm: f64,
    /// The sheets at hand, as they lie on the bed.
    pub stock: Vec<StockPromise>,
    /// The sheets with their panels.
    pub cut_sheets: Vec<CutSheetPromise>,
    /// The figures of each sheet, in the same order.
    pub sheet_rows: Vec<CutSheetRow>,
    /// The printed parts and brackets.
    pub parts: Vec<CorePartPromise>,
    /// What the shop needs to know of each part, in the same order.
    pub part_rows: Vec<CorePartRow>,
    /// The screws and inserts.
    pub fasteners: Vec<FastenerPromise>,
    /// The pins between parts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub pins: Vec<PegPromise>,
    /// The films of glue.
    pub glue: Vec<GluePromise>,
    /// The rods between polyhedra.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rods: Vec<RodPromise>,
    /// The ballast on the lowest panel.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ballast: Vec<BallastPromise>,
    /// The outline of that panel, counterclockwise from outside, mm in its frame; empty without
    /// ballast.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ballast_panel_mm: Vec<[f64; 2]>,
    /// The edges of that panel; empty without ballast.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ballast_edges: Vec<BallastEdge>,
    /// The place of each piece of ballast, in the same order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub ballast_rows: Vec<BallastRow>,
    /// The units in the order in which they are joined.
    pub units: Vec<UnitPromise>,
    /// The ways in which several polyhedra come together, in their order; empty for one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joins: Vec<JoinPromise>,
    /// The things to buy.
    pub buy: Vec<BuyRow>,
    /// The direction up in the model, a unit vector.
    pub up: [f64; 3],
    /// The mass of the whole, g.
    pub mass_g: f64,
    /// The mass of its things, g.
    pub masses: MassRow,
    /// Estimates of times and prices.
    pub estimates: EstimateRow,
    /// The centre of mass in the model frame, mm.
    pub centre_mm: [f64; 3],
    /// The lean at which it topples, degrees; `None` if it need not stand.
    pub toppling_deg: Option<f64>,
    /// The toppling angle that is promised, degrees; `None` if it need not stand.
    pub least_angle_deg: Option<f64>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// The SHA-256 of every other file of the kit.
    pub files: BTreeMap<String, String>,
}

kind_sheet!(CoreSheet);

/// The model of an object.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoreModelRow {
    /// Its file.
    pub source: String,
    /// The SHA-256 of that file.
    pub sha256: Option<String>,
    /// Its extent, mm.
    pub size_mm: [f64; 3],
    /// Its volume, mm³.
    pub volume_mm3: f64,
}

/// The printer of an object.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CorePrinterRow {
    /// Its id.
    pub id: String,
    /// Its name.
    pub name: String,
    /// The height of a layer, mm.
    pub layer_mm: f64,
    /// The glue for its materials.
    pub glue: Option<String>,
    /// The dangers of that glue.
    pub glue_safety: Option<String>,
    /// The limits by which its parts are judged.
    #[serde(flatten)]
    pub limits: PrinterLimits,
}

/// The material of printed parts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CoreMaterialRow {
    /// Its id.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its density, g/cm³.
    pub density_g_cm3: f64,
}

/// The cutter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CutterRow {
    /// Its id.
    pub id: String,
    /// Its name.
    pub name: String,
    /// The width of the cut, mm.
    pub kerf_mm: f64,
    /// The source of that width.
    pub kerf_source: String,
    /// True if the shop measured it.
    pub is_kerf_measured: bool,
    /// True if the shop's software offsets the paths.
    pub compensates_kerf: bool,
    /// Both sides of the bed, mm.
    pub bed_mm: [f64; 2],
}

/// The sheet.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SheetRow {
    /// Its id.
    pub id: String,
    /// Its name.
    pub name: String,
    /// What is promised of it and of the cut.
    #[serde(flatten)]
    pub cut: CutPromise,
    /// The source of its thickness.
    pub thickness_source: String,
}

/// The glue of ballast, as a shop names it.
pub const BALLAST_GLUE: &str = "two-part epoxy glue";

/// An edge of the panel with the ballast.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BallastEdge {
    /// The number of the panel that comes there.
    pub to: usize,
    /// The ends of the line along the tips of its fingers, counterclockwise from outside, mm in the
    /// panel's frame.
    pub ends_mm: [[f64; 2]; 2],
}

/// The place of a piece of ballast, as a worker measures it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BallastRow {
    /// The distances of its centre from two edges.
    pub from: Vec<EdgeDistance>,
}

/// A distance from an edge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EdgeDistance {
    /// The number of the panel that comes there.
    pub to: usize,
    /// The distance, square to the line along the tips of its fingers, mm.
    pub distance_mm: f64,
}

/// The base of an object.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BaseRow {
    /// The number of panels.
    pub panels: usize,
    /// The method of the paper, if it made the base.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vertices: Option<VerticesRow>,
    /// The polyhedra, if there are several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub polyhedra: Vec<PolyhedronRow>,
    /// Its volume, mm³.
    pub volume_mm3: f64,
    /// Its volume over that of the model.
    pub volume_ratio: f64,
    /// The area of its panels, mm².
    pub panels_mm2: f64,
    /// The number of edges with fingers.
    pub finger_edges: usize,
    /// The number of edges with brackets.
    pub bracket_edges: usize,
    /// The number of edges that are glued alone.
    pub glued_edges: usize,
}

/// A base of moved vertices, and what its proof cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VerticesRow {
    /// The polyhedron from which its vertices started.
    pub start: &'static str,
    /// Its volume before the proof, mm³.
    pub volume_mm3: f64,
    /// The least distance of its samples from the surface, mm.
    pub sampled_mm: f64,
    /// The distance that its faces proved, mm; negative if they cut the model.
    pub certified_mm: f64,
    /// The greatest way by which a face moved inward for the proof, mm.
    pub moved_mm: f64,
}

/// A polyhedron among several.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PolyhedronRow {
    /// The numbers of its panels.
    pub panels: Vec<usize>,
    /// Its volume, mm³.
    pub volume_mm3: f64,
    /// The number of the panel that closes it, when it is bolted to others; `None` if none does.
    pub closed_by: Option<usize>,
}

/// The figures of a sheet with panels.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CutSheetRow {
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
    /// An estimate of the time that the cuts take, s; `None` if the speed is not known.
    pub cut_s: Option<f64>,
}

/// A printed part as the shop handles it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CorePartRow {
    /// The name on the sheet.
    pub id: String,
    /// How it lies on the plate.
    pub lies: String,
    /// What holds it, in words.
    pub held_by: String,
    /// Extent in print pose, mm.
    pub size_mm: [f64; 3],
    /// Mass, g.
    pub mass_g: f64,
}

/// A thing that is bought.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BuyRow {
    /// The id under which it is ordered.
    pub id: String,
    /// Its name in a shop.
    pub name: String,
    /// The number of pieces.
    pub count: usize,
}

/// The masses of an object's things, g.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MassRow {
    /// The printed parts of the shell.
    pub shell_g: f64,
    /// The panels.
    pub panels_g: f64,
    /// The brackets.
    pub brackets_g: f64,
    /// The screws and inserts.
    pub fasteners_g: f64,
    /// The rods between polyhedra.
    pub rods_g: f64,
    /// The glue.
    pub glue_g: f64,
    /// The ballast.
    pub ballast_g: f64,
    /// The whole by the estimate of the supplement to CofiFab, solid down to the base.
    pub paper_g: f64,
    /// The centre of that estimate in the model frame, mm.
    pub paper_centre_mm: [f64; 3],
    /// The model printed solid, without a base.
    pub if_solid_g: f64,
    /// A skin of the same wall without a base: its area times the wall.
    pub if_skin_g: f64,
}

/// Estimates of times and prices, from the figures of profiles alone; `None` for those that no
/// profile has.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EstimateRow {
    /// The time to print all parts and brackets, without support, s.
    pub print_s: Option<f64>,
    /// The time to print the model solid, without a base, s.
    pub if_solid_s: Option<f64>,
    /// The time to print a skin of the same wall without a base, s.
    pub if_skin_s: Option<f64>,
    /// The time that all cuts take, s.
    pub cut_s: Option<f64>,
    /// The price of the sheets but for offcuts at hand, in the shop's currency.
    pub sheets_price: Option<f64>,
}
