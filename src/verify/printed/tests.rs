//! The judge of toolpaths on G-code written from known boxes, right and with one fault at a time.

mod accuracy;
mod faults;
mod finding;
mod hostile;
mod print;

use super::*;
use crate::geom::Point;
use crate::verify::test_meshes::block;
use crate::verify::{Hardware, HardwareKind};
use print::*;
