//! What a printer can make and of what: profiles as TOML data, every number with its source.
//!
//! A printer's profile inherits from a process (`inherits = "polyjet"`), from a shipped machine
//! (`"prusa-mk4"`) or from a file beside it (`"shop.toml"`), which may inherit in turn; a process
//! inherits from nothing. What none of them says is an error for the numbers every print needs, and
//! simply unset for the others, such as the build volume.
//!
//! A shop's own printer is a file such as
//!
//! ```toml
//! id = "shop-jet"
//! name = "The PolyJet machine in room 2"
//! inherits = "polyjet"                       # a process, a shipped printer or a file
//! default_material = "lot-7"
//! build_volume_mm = { value = [300, 300, 180], source = "measured on the tray", sure = "read" }
//!
//! [numbers]
//! pixel_x_mm = { dpi = 600, source = "its manual", sure = "read" }
//! pixel_y_mm = { dpi = 600, source = "its manual", sure = "read" }
//! layer_mm = { value = 0.03, source = "its manual", sure = "read" }
//! min_wall_mm = { value = 1.2, source = "thinner ones broke in the water jet", sure = "own-choice" }
//!
//! [[material]]
//! id = "lot-7"
//! name = "White resin, lot 7"
//! density_g_cm3 = { value = 1.182, source = "a coupon of 20 × 20 × 20 mm weighed", sure = "computed" }
//! density_spread_ratio = { value = 0.01, source = "five coupons", sure = "computed" }
//! ```

mod calibrate;
mod cleaning;
mod complete;
mod error;
pub mod import;
mod layer;
mod library;
mod machine;
mod material;
mod materials;
mod plate;
mod profile;
mod quantity;
mod resolve;
mod room;
mod shop;
mod size;
mod sourced;
mod wall;

pub use calibrate::{CalibrateError, Measured, calibrated};
pub use cleaning::{Cleaning, CleaningRule};
pub use error::{Fault, Faults, Problem, ProfileError};
pub use machine::{Grid, PrintPose, Printer, Support, Tolerance};
pub use material::{Material, MaterialError};
pub use plate::{Plate, Spot};
pub use quantity::Quantity;
pub use room::{Corner, ExcludedCorner};
pub use shop::{CONFIGURATION, SHOP_FILE, Shop, ShopError};
pub use size::{SizeError, leaves_room};
pub use sourced::{Sourced, Sure};
pub use wall::{SizedWall, WallChoice, WallError, whole_steps};
