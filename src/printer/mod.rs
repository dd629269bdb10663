//! Printers and their materials: profiles as TOML data, every number with its source.
//!
//! A printer's profile inherits from a process (`inherits = "polyjet"`), from a built-in printer
//! (`"prusa-mk4"`) or from a file in its folder (`"shop.toml"`). Printers and files may inherit in
//! turn, processes may not. A missing number is an error if every print needs it. Other values,
//! such as the build volume, stay unknown.
//!
//! A shop describes its own printer in a file such as this one:
//!
//! ```toml
//! id = "shop-jet"
//! name = "The PolyJet machine in room 2"
//! inherits = "polyjet"                       # a process, a built-in printer or a file
//! default_material = "lot-7"
//! build_volume_mm = { value = [300, 300, 180], source = "measured on the tray", sure = "read" }
//!
//! [numbers]
//! pixel_x_mm = { dpi = 600, source = "its manual", sure = "read" }
//! pixel_y_mm = { dpi = 600, source = "its manual", sure = "read" }
//! layer_mm = { value = 0.03, source = "its manual", sure = "read" }
//! min_wall_mm = { value = 1.2, source = "thinner walls broke in the jet", sure = "own-choice" }
//!
//! [[material]]
//! id = "lot-7"
//! name = "White resin, lot 7"
//! density_g_cm3 = { value = 1.182, source = "a weighed coupon of 8 cm³", sure = "computed" }
//! density_spread_ratio = { value = 0.01, source = "five coupons", sure = "computed" }
//! ```

mod calibrate;
mod cleaning;
mod complete;
mod corner;
mod drains;
mod edits;
mod error;
mod find;
pub mod import;
mod infill;
mod layer;
mod layout;
mod library;
mod machine;
mod material;
mod materials;
mod plate;
mod profile;
mod quantity;
mod rates;
mod reader;
mod resolve;
mod room;
mod shop;
mod size;
mod wall;

pub use crate::base::sourced::{Sourced, Sure};
pub use calibrate::{CalibrateError, Measured, MeasuredInfill, calibrate};
pub use cleaning::{Cleaning, CleaningRule};
pub use corner::{Corner, ExcludedCorner};
pub use drains::{DrainNeed, Undrainable};
pub use error::{Fault, Faults, Problem, ProfileError};
pub use infill::InfillPattern;
pub use layout::LaidPlate;
pub use machine::{Grid, PrintPose, Printer, SizedWall, Support, Tolerance, Unknown};
pub use material::{Material, MaterialError};
pub use plate::{Plate, Spot};
pub use quantity::Quantity;
pub use rates::Rates;
pub use shop::{CONFIGURATION, SHOP_FILE, ShopDefaults, ShopError};
pub use size::{SizeError, check_room_for_void};
pub use wall::{WallChoice, WallError, whole_steps};
