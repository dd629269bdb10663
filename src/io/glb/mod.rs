//! glTF 2.0 in one binary file (GLB): a tree of nodes with bodies, and animations of the nodes.
//!
//! [`MovingScene::encode`] writes such a file, [`decode_glb`] reads what is in it back. Of the
//! format (Khronos, glTF 2.0 specification) only that is known which moving rigid bodies need.

mod layout;
mod read;
mod scene;
mod write;

pub use layout::GlbError;
pub use read::decode_glb;
pub use scene::{ReadAnimation, ReadNode, ReadScene, ReadTrack, Values};
pub use write::{Animation, MovingScene, Painted, SceneNode, Track};

#[cfg(test)]
mod tests;
