//! 3MF: packages of named objects in real units (3D Manufacturing Format, core specification 1.3).

mod transform;
mod write;

pub use transform::Transform;
pub use write::{Build, Object, Package, PackageError};

/// The namespace of the core specification's elements.
const CORE_NAMESPACE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
/// The namespace of the list of content types (Open Packaging Conventions, ECMA-376 part 2).
const CONTENT_TYPES: &str = "http://schemas.openxmlformats.org/package/2006/content-types";
/// The namespace of relationships (Open Packaging Conventions).
const RELATIONSHIPS: &str = "http://schemas.openxmlformats.org/package/2006/relationships";
/// The type of the relationship that leads to the model.
const MODEL_TYPE: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
/// Where the model usually is.
const MODEL_PART: &str = "3D/3dmodel.model";
