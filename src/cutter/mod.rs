//! Laser cutters, sheets and fasteners: profiles as TOML data, every number with its source.
//!
//! A profile inherits from a family (`inherits = "co2-laser"`), from a built-in profile
//! (`"glowforge"`) or from a file in its folder (`"shop.toml"`). Values that it does not give are
//! its parent's. A missing value is an error if every cut needs it.
//!
//! * **[`Cutter`]:** bed, kerf by material and thickness, the finest cuts, the colours of drawings.
//! * **[`StockSheet`]:** material, thickness, density, grain, and the sizes on sale.
//! * **[`Fastener`]:** screws, nuts, inserts, washers and dowel rods, with their masses.
//!
//! A shop describes its own cutter in a file such as this one:
//!
//! ```toml
//! id = "shop-laser"
//! name = "The laser in room 3"
//! inherits = "makerspace-900x600"
//! dialect = "lightburn"
//!
//! [[kerf]]
//! material = "plywood"
//! thickness_mm = 5.2
//! kerf_mm = { value = 0.21, source = "comb of 26 November", sure = "measured" }
//! ```

mod ancestry;
mod any;
mod calibrate;
mod cutter_layer;
mod error;
mod fastener;
mod fastener_shape;
mod find;
mod library;
mod machine;
mod material;
mod reader;
mod stock;
mod stock_layer;
#[cfg(test)]
mod tests;

pub use any::AnyProfile;
pub use calibrate::{
    CutCalibrateError, CutMeasured, calibrate_cutter, calibrate_sheet, thickness_warning,
};
pub use error::{Fault, Faults, Problem, ProfileError};
pub use fastener::{Fastener, Provenance};
pub use fastener_shape::FastenerShape;
pub use machine::{CannotCut, Cutter, CutterNumber, Dialect, Kerf, KerfAt, OnBed, Thickest};
pub use material::SheetMaterial;
pub use stock::{Grain, StockSheet, StockSize};
