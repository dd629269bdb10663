//! The pieces between the cuts, and the parts made of them.
//!
//! * `split`: the body cut by all planes, with the cut faces and joints of its pieces.
//! * `rejoin`: pieces that a cut separates needlessly, joined again.
//! * `pose`: the position of a part in the printer.
//! * `part`: the finished parts with pins, sockets and labels.
//! * `cups`: ends of voids that enclose resin in a vat.

pub(crate) mod cups;
pub(crate) mod part;
pub(crate) mod pose;
pub(crate) mod rejoin;
pub(crate) mod split;
