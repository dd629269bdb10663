//! The promises of an object on a base: the judge's own narrow view of the kit's JSON files.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

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
    /// The sheets with their panels.
    pub cut_sheets: Vec<CutSheetPromise>,
    /// The printed parts and brackets.
    pub parts: Vec<CorePartPromise>,
    /// The screws and inserts.
    pub fasteners: Vec<FastenerPromise>,
    /// The films of glue.
    pub glue: Vec<GluePromise>,
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
    /// The panels on it.
    pub panels: Vec<PlacedPanel>,
}

/// The place of a panel on a sheet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlacedPanel {
    /// The number of the panel, from 1.
    pub panel: usize,
    /// The turn about its origin, counterclockwise, radians.
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
    /// The number of the panel along whose normal it leaves, from 1.
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
    /// The planes of cuts for the printer's room along its sides: outward normal, and offset, mm.
    pub cuts: Vec<[f64; 4]>,
    /// Its bores: for inserts, and for the heads of bracket screws.
    pub bosses: Vec<BossPromise>,
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

/// A film of glue, taken as a point of its mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GluePromise {
    /// What it joins, in words.
    pub joint: String,
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

/// The panels: `panels.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PanelsFile {
    /// The version of the keys.
    pub schema: u32,
    /// The panels in the order of their numbers.
    pub panels: Vec<PanelPromise>,
}

/// A panel: a plane piece of sheet with its place in the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PanelPromise {
    /// Its number, from 1; it is engraved.
    pub panel: usize,
    /// The number of its polyhedron, from 1.
    #[serde(default = "first", skip_serializing_if = "is_first")]
    pub polyhedron: usize,
    /// The index of its plane in the certificate of that polyhedron.
    pub plane: usize,
    /// The origin of its frame in the model, mm.
    pub origin_mm: [f64; 3],
    /// The axes of its frame in the model; the third points out of the base.
    pub axes: [[f64; 3]; 3],
    /// The outline as it comes out, counterclockwise seen from outside, mm in its frame.
    pub outline_mm: Vec<[f64; 2]>,
    /// The holes.
    pub holes: Vec<HolePromise>,
    /// The joints along its edges.
    pub edges: Vec<EdgePromise>,
}

/// A round hole.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HolePromise {
    /// Its middle in the panel's frame, mm.
    pub at_mm: [f64; 2],
    /// Its diameter, mm.
    pub diameter_mm: f64,
}

/// The joint along an edge of a panel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EdgePromise {
    /// The number of the panel beyond it, from 1.
    pub to: usize,
    /// The inner angle, degrees.
    pub angle_deg: f64,
    /// The length of the stretch that both share, mm.
    pub length_mm: f64,
    /// The joint, in words: `fingers`, `brackets`, or `glue` where neither fits.
    pub joint: String,
}

/// The certificate: `certificate.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoreCertificate {
    /// The version of the keys.
    pub schema: u32,
    /// The model in single precision, relative to the kit.
    pub model: String,
    /// The distance that the base keeps from its surface, mm.
    pub distance_mm: f64,
    /// The longest edge of a piece of the surface, mm: longer triangles are halved.
    pub longest_edge_mm: f64,
    /// The base, or the first polyhedron of it.
    #[serde(flatten)]
    pub base: BaseCertificate,
    /// Its other polyhedra.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub others: Vec<BaseCertificate>,
}

impl CoreCertificate {
    /// Returns all polyhedra of the base in their order.
    pub fn bases(&self) -> impl Iterator<Item = &BaseCertificate> {
        std::iter::once(&self.base).chain(&self.others)
    }
}

/// The certificate of a polyhedron.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BaseCertificate {
    /// The planes of the polyhedron: outward unit normal, and offset, mm.
    pub planes: Vec<[f64; 4]>,
    /// For each piece of the surface, the index of a plane that parts it.
    pub faces: Vec<u32>,
    /// The planes between it and other polyhedra, which bound its part of the model. Their normals
    /// point out of it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sides: Vec<[f64; 4]>,
}

fn first() -> usize {
    1
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference"
)]
fn is_first(number: &usize) -> bool {
    *number == first()
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference"
)]
fn is_false(flag: &bool) -> bool {
    !flag
}
