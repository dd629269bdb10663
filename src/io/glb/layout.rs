//! The JSON of a glTF file as far as it is used, and the frame of the binary file.
//!
//! Other keys are refused: a viewer would obey a stride or an offset that this reader knows not.

use serde::{Deserialize, Serialize};

/// The first four bytes of a file: `glTF`, little endian.
pub const MAGIC: u32 = 0x4654_6C67;
/// The version of the frame.
pub const VERSION: u32 = 2;
/// The type of a chunk of JSON.
pub const JSON_CHUNK: u32 = 0x4E4F_534A;
/// The type of a chunk of bytes.
pub const BIN_CHUNK: u32 = 0x004E_4942;
/// The component type of 32-bit floats.
pub const FLOAT: u32 = 5126;
/// The component type of 16-bit vertex numbers.
pub const SHORT: u32 = 5123;
/// The component type of 32-bit vertex numbers.
pub const INT: u32 = 5125;
/// The target of a view that holds vertices.
pub const VERTICES: u32 = 34962;
/// The target of a view that holds vertex numbers.
pub const INDICES: u32 = 34963;
/// By how much the norm of a turn may be off 1: single precision, and more than that.
pub const NORM_LIMIT: f64 = 1e-3;
/// A metre in the unit of the nodes, mm.
pub const MM_PER_M: f64 = 1000.0;

/// A file that is no glTF such as is written here.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GlbError {
    /// It is not framed as a binary glTF file.
    #[error("it is no binary glTF 2.0 file: {0}")]
    Frame(&'static str),
    /// Its JSON cannot be read.
    #[error("its JSON cannot be read: {0}")]
    Json(String),
    /// An index, a type or a length in it is wrong.
    #[error("{0} is broken")]
    Broken(String),
}

/// The whole JSON.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gltf {
    pub asset: Asset,
    pub scene: usize,
    pub scenes: Vec<SceneRow>,
    pub nodes: Vec<NodeRow>,
    #[serde(default)]
    pub meshes: Vec<MeshRow>,
    #[serde(default)]
    pub materials: Vec<MaterialRow>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub animations: Vec<AnimationRow>,
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default, rename = "bufferViews")]
    pub views: Vec<BufferView>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asset {
    pub version: String,
    #[serde(default)]
    pub generator: String,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneRow {
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NodeRow {
    #[serde(default)]
    pub name: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub children: Vec<usize>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub translation: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<usize>,
    /// Never written: a place is told by its parts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix: Option<Vec<f64>>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshRow {
    #[serde(default)]
    pub name: String,
    pub primitives: Vec<Primitive>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Primitive {
    pub attributes: Attributes,
    pub indices: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<usize>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Attributes {
    #[serde(rename = "POSITION")]
    pub position: usize,
}

#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialRow {
    #[serde(default)]
    pub name: String,
    #[serde(default, rename = "pbrMetallicRoughness")]
    pub surface: Surface,
}

#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Surface {
    pub base_color_factor: [f64; 4],
    pub metallic_factor: f64,
    pub roughness_factor: f64,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AnimationRow {
    #[serde(default)]
    pub name: String,
    pub channels: Vec<Channel>,
    pub samplers: Vec<Sampler>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    pub sampler: usize,
    pub target: Target,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    pub node: usize,
    pub path: String,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sampler {
    pub input: usize,
    pub output: usize,
    #[serde(default = "linear")]
    pub interpolation: String,
}

/// The name of linear interpolation, which is the one if none is told.
pub fn linear() -> String {
    "LINEAR".to_owned()
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Accessor {
    pub buffer_view: usize,
    pub component_type: u32,
    pub count: usize,
    #[serde(rename = "type")]
    pub shape: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub min: Vec<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub max: Vec<f64>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct BufferView {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: usize,
    pub byte_length: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<u32>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct Buffer {
    pub byte_length: usize,
}
