//! The judge's view of the files of a base: its panels and its certificate.

use serde::{Deserialize, Serialize};

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
