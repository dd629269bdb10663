//! The promises of an object on a base: the judge's own narrow view of the kit's JSON files.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::rod_promise::{BuyPromise, RodPromise};
use crate::mass::Lump;
use crate::verify::{Density, Pose, PrinterLimits};

/// The promises of a kit, and the data needed to judge its files by them: `checklist.json`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct CorePromise {
    /// The version of the keys.
    pub schema: u32,
    /// The limits of the printer.
    pub printer: PrinterLimits,
    /// The material of the parts.
    pub material: Density,
    /// The wall that was ordered, mm.
    pub wall_mm: f64,
    /// The distance that the base keeps from the model's surface, mm.
    pub distance_mm: f64,
    /// The gap between panels and parts, mm.
    pub gap_mm: f64,
    /// The sheet and the cut.
    pub sheet: CutPromise,
    /// The cutter.
    pub cutter: CutterPromise,
    /// The sheets at hand, as they lie on the cutter's bed.
    pub stock: Vec<StockPromise>,
    /// The sheets with their panels.
    pub cut_sheets: Vec<CutSheetPromise>,
    /// The printed parts and brackets.
    pub parts: Vec<CorePartPromise>,
    /// The screws and inserts.
    pub fasteners: Vec<FastenerPromise>,
    /// The pins between parts.
    #[serde(default)]
    pub pins: Vec<PegPromise>,
    /// The rods between polyhedra.
    #[serde(default)]
    pub rods: Vec<RodPromise>,
    /// The things to buy.
    #[serde(default)]
    pub buy: Vec<BuyPromise>,
    /// The films of glue.
    pub glue: Vec<GluePromise>,
    /// The ballast.
    #[serde(default)]
    pub ballast: Vec<BallastPromise>,
    /// The units in the order in which they are joined.
    pub units: Vec<UnitPromise>,
    /// The ways in which several polyhedra come together, in their order; empty for one.
    #[serde(default)]
    pub joins: Vec<JoinPromise>,
    /// The direction up in the model, a unit vector.
    pub up: [f64; 3],
    /// The mass of the whole, g.
    pub mass_g: f64,
    /// The centre of mass in the model frame, mm.
    pub centre_mm: [f64; 3],
    /// The lean at which the whole topples, degrees; `None` if it need not stand.
    pub toppling_deg: Option<f64>,
    /// The toppling angle that is promised, degrees; `None` if it need not stand.
    pub least_angle_deg: Option<f64>,
    /// The SHA-256 of every other file of the kit.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
}

/// The sheet that panels are cut from, and the cut.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutPromise {
    /// The thickness, mm.
    pub thickness_mm: f64,
    /// The density, g/cm³.
    pub density_g_cm3: f64,
    /// The part of the cut's width by which drawings are offset, mm.
    pub offset_kerf_mm: f64,
    /// The least distance of two panels on a sheet, mm.
    pub spacing_mm: f64,
    /// The width that stays free along the edges of a sheet, mm.
    pub margin_mm: f64,
    /// True if panels follow the grain of their sheet.
    pub keeps_grain: bool,
}

/// The cutter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutterPromise {
    /// Both sides of its bed, mm.
    pub bed_mm: [f64; 2],
}

/// A size of sheets at hand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StockPromise {
    /// Length and width as it lies on the bed, mm.
    pub size_mm: [f64; 2],
    /// The number of such sheets; `None` for any number.
    pub count: Option<usize>,
    /// True if it lies turned by a quarter, and its grain with it.
    pub is_turned: bool,
}

/// A sheet with its panels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CutSheetPromise {
    /// Its drawing as DXF, relative to the kit.
    pub dxf: String,
    /// The same drawing as SVG.
    pub svg: String,
    /// Length and width, mm.
    pub size_mm: [f64; 2],
    /// True if it lies turned by a quarter, and its grain with it.
    pub is_turned: bool,
    /// The panels on it.
    pub panels: Vec<PlacedPanel>,
}

/// The place of a panel on a sheet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlacedPanel {
    /// The number of the panel, from 1.
    pub panel: usize,
    /// The turn about its origin, counterclockwise, radians. The panel is seen from inside.
    pub turn_rad: f64,
    /// The place of its origin, mm from the sheet's lower left corner.
    pub at_mm: [f64; 2],
}

/// The kind of a printed part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CorePartKind {
    /// A part of the shell.
    Shell,
    /// A bracket between two panels.
    Bracket,
}

/// A printed part as the kit names it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CorePartPromise {
    /// The name on the sheet, such as `3a` or `B02`.
    pub id: String,
    /// Its kind.
    pub kind: CorePartKind,
    /// The number of the panel along whose normal it leaves, or on which a bracket stands, from 1.
    pub panel: usize,
    /// Its file, relative to the kit.
    pub file: String,
    /// The SHA-256 of that file, in hex.
    pub sha256: String,
    /// Model coordinates to print coordinates.
    pub print_from_model: Pose,
    /// The volume of its hollow, mm³.
    pub void_mm3: f64,
    /// The volume of its bores, mm³.
    pub bores_mm3: f64,
    /// The volumes that its pins add and that its sockets take away, mm³.
    #[serde(default, skip_serializing_if = "is_none")]
    pub pins_mm3: [f64; 2],
    /// The planes of cuts for the printer's room along its sides: outward normal, and offset, mm.
    pub cuts: Vec<[f64; 4]>,
    /// Its bores: for inserts, and for the heads of bracket screws.
    pub bosses: Vec<BossPromise>,
}

/// A pin that stands on a part, and its socket in another one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PegPromise {
    /// The part on which it stands.
    pub on: String,
    /// The part with its socket.
    pub into: String,
    /// The point of its axis in the plane in which both parts touch, mm.
    pub center_mm: [f64; 3],
    /// The unit direction in which it stands out.
    pub direction: [f64; 3],
    /// Its diameter, mm.
    pub diameter_mm: f64,
    /// Its length, mm.
    pub length_mm: f64,
    /// The diameter of its socket, mm.
    pub socket_diameter_mm: f64,
    /// The depth of its socket, mm.
    pub socket_depth_mm: f64,
    /// Width and height of the chamfers at its tip and at its socket's mouth, mm.
    pub chamfers_mm: [f64; 2],
}

/// A bore in a part, along the normal of its panel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BossPromise {
    /// The point at which it enters the part, mm.
    pub foot_mm: [f64; 3],
    /// Its depth, mm.
    pub depth_mm: f64,
    /// Its diameter, mm.
    pub bore_mm: f64,
}

/// The kind of a fastener.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FastenerKind {
    /// A screw through a panel.
    Screw,
    /// An insert in a part.
    Insert,
    /// A screw through panels of two polyhedra, with a nut.
    Bolt,
    /// The nut of a bolt.
    Nut,
    /// A washer of a bolt.
    Washer,
}

/// A fastener in its place, taken as a point of its mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FastenerPromise {
    /// The id under which it is ordered.
    pub id: String,
    /// Its kind.
    pub kind: FastenerKind,
    /// The printed part that it holds; the joint of a bolt and its nut, in words.
    pub part: String,
    /// The number of the panel that it passes, or on which its part bears, from 1.
    pub panel: usize,
    /// Its mass, g.
    pub mass_g: f64,
    /// Its centre in the model frame, mm.
    pub center_mm: [f64; 3],
    /// The point under a screw's head, or at the mouth of an insert, mm.
    pub seat_mm: [f64; 3],
    /// The unit direction from there along its shaft.
    pub axis: [f64; 3],
    /// Diameter and height of a screw's head, a nut or a washer, mm; zero for an insert.
    pub head_mm: [f64; 2],
    /// The number of the other panel that a bolt passes, from 1; `None` for all else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub through: Option<usize>,
    /// Thread and length of a bolt, mm; `None` for all else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shaft_mm: Option<[f64; 2]>,
}

/// A piece of ballast on the inner side of a panel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallastPromise {
    /// The id under which it is ordered.
    pub id: String,
    /// The number of the panel, from 1.
    pub panel: usize,
    /// The middle of the side on which it lies, in the frame of the panel, mm.
    pub at_mm: [f64; 2],
    /// The piece in its place: its axis is that of the panel.
    #[serde(flatten)]
    pub lump: Lump,
}

/// A film of glue, taken as a point of its mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GluePromise {
    /// What it joins, in words.
    pub joint: String,
    /// The ids of the printed parts that it joins to one another, or to a panel.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<String>,
    /// Its area, mm².
    pub area_mm2: f64,
    /// Its mass, g.
    pub mass_g: f64,
    /// Its middle in the model frame, mm.
    pub center_mm: [f64; 3],
}

/// A unit, which moves as one piece.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnitPromise {
    /// Its name on the sheet, such as `unit 3`.
    pub id: String,
    /// The number of its panel, from 1; `None` for a part alone.
    pub panel: Option<usize>,
    /// The ids of its parts, with the brackets that are screwed to its panel.
    pub parts: Vec<String>,
    /// The direction in which it leaves, a unit vector.
    pub way: [f64; 3],
    /// The number of its polyhedron, from 1; `None` if the base is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polyhedron: Option<usize>,
    /// True if it comes when all polyhedra are joined.
    #[serde(default, skip_serializing_if = "is_false")]
    pub is_last: bool,
}

/// The joining of polyhedra that are put together, but still open.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JoinPromise {
    /// The numbers of the polyhedra that come, from 1.
    pub moving: Vec<usize>,
    /// The numbers of those to which they come.
    pub standing: Vec<usize>,
    /// The direction in which they would leave again, a unit vector.
    pub way: [f64; 3],
    /// The number of bolts that then hold them.
    pub bolts: usize,
    /// The number of rods on which they come.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rods: usize,
}

impl JoinPromise {
    /// Names what comes.
    pub fn name(&self) -> String {
        words(&self.moving)
    }

    /// Names what it comes to.
    pub fn others(&self) -> String {
        words(&self.standing)
    }
}

/// Names polyhedra by their numbers.
fn words(numbers: &[usize]) -> String {
    let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
    match numbers.as_slice() {
        [one] => format!("polyhedron {one}"),
        several => format!("polyhedra {}", several.join(" and ")),
    }
}

fn is_none(volumes_mm3: &[f64; 2]) -> bool {
    *volumes_mm3 == [0.0; 2]
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference"
)]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference"
)]
fn is_false(flag: &bool) -> bool {
    !flag
}
