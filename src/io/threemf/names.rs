//! The names that the format and its packaging prescribe.

/// The namespace of the core specification's elements.
pub const CORE_NAMESPACE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
/// The namespace of the list of content types (Open Packaging Conventions, ECMA-376 part 2).
pub const CONTENT_TYPES: &str = "http://schemas.openxmlformats.org/package/2006/content-types";
/// The namespace of relationships (Open Packaging Conventions).
pub const RELATIONSHIPS: &str = "http://schemas.openxmlformats.org/package/2006/relationships";
/// The type of the relationship that leads to the model.
pub const MODEL_TYPE: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
/// The usual name of the part that holds the model.
pub const MODEL_PART: &str = "3D/3dmodel.model";
/// The metadata by which this program names the job of a package.
pub const OUR_JOB: &str = "equipoise:Job";
