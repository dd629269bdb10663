//! Files in and out: models are read whatever their name says, parts are written as binary STL and
//! 3MF.

mod ear_clip;
mod obj;
mod ply;
mod read;
mod sniff;
pub mod stl;
#[cfg(test)]
mod tests;
pub mod threemf;

pub use obj::ObjError;
pub use ply::PlyError;
pub use read::{ContentError, ReadError, decode_model, read_bytes, read_model};
pub use stl::{StlError, WriteError};
