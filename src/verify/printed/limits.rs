//! The limits of the checks of toolpaths, with their reasons.
//!
//! PrusaSlicer was measured on twelve solid models at 0.2 mm layers. Mass was +0.2 to +1.5 % off,
//! the centre up to 0.112 mm, the principal axis up to 0.15°. Moments of inertia at equal mass were
//! up to 1.0 % off.

/// The mass of all parts may differ by this share. Slicers lay up to 1.5 % more than bulky solids
/// have; for thin ones see [`PRINTED_SKIN_MM`].
pub const PRINTED_MASS_LIMIT_RATIO: f64 = 0.02;
/// The mass of thin parts may differ as if their surface were this much farther out, mm. It is so
/// for a cube of 30 mm, which gets 0.84 % more.
pub const PRINTED_SKIN_MM: f64 = 0.042;
/// The centre of all parts may be this far from its promised place, mm; slicers reach 0.112 mm.
pub const PRINTED_CENTER_LIMIT_MM: f64 = 0.15;
/// The centre may be off by this much more for each mm by which the longest edge exceeds
/// [`CENTER_FROM_MM`]. What is laid too much lies farther away there. It rests on one solid bunny:
/// with an edge of 215 mm its centre was 0.52 mm off.
pub(super) const CENTER_RATIO: f64 = 0.0033;
/// Longest edge up to which the limit of the centre holds as it was measured, mm.
pub(super) const CENTER_FROM_MM: f64 = 100.0;
/// The principal axis may lean this far from the spin axis, degrees, as that of right prints does.
pub const PRINTED_TILT_LIMIT_DEG: f64 = 0.15;
/// Error of a principal moment at equal mass, as a share of it.
pub(super) const INERTIA_RATIO: f64 = 0.01;
/// Error of an entry of a match's inertia tensor as a share of the trace, with that of the mass.
pub(super) const PRINTED_MATCH_RATIO: f64 = PRINTED_MASS_LIMIT_RATIO + INERTIA_RATIO;
/// The mean height of beads may differ from that of a layer by this share: the first layer is often
/// higher. The next usual height differs by a quarter and more.
pub(super) const LAYER_RATIO: f64 = 0.1;
/// Other layers are told. They are wrong only if their height differs by more than this share: what
/// the printer can lay as well balances as well.
pub(super) const WRONG_LAYER_RATIO: f64 = 0.3;
/// The width of lines may differ by this share. Outer lines of 0.42 mm where 0.45 mm are usual, and
/// a flow of 0.95, are both within it.
pub(super) const LINE_RATIO: f64 = 0.15;
/// The density may differ by this share: the spread of a filament's density.
pub(super) const DENSITY_RATIO: f64 = 0.02;
/// Densities outside of these are no filament's, g/cm³: from foamed PLA to steel-filled.
pub(super) const DENSITIES_G_CM3: [f64; 2] = [0.3, 9.0];
/// An edge of a part's box may differ by this much across the layers, mm. It is a third of a line,
/// as slicers round the outer path.
pub(super) const EDGE_MM: f64 = 0.15;
/// An edge may differ by this share besides.
pub(super) const EDGE_RATIO: f64 = 0.002;
/// Less support in the voids of a part than this share of its volume is not told.
pub(super) const SUPPORT_RATIO: f64 = 3e-3;
/// A flow that the file sets, for a filament or with `M221`, may differ by this share. With it the
/// lines are as they are meant. Filaments have 0.92 to 1.04; more calibrates nothing.
pub(super) const FLOW_LIMIT_RATIO: f64 = 0.09;
/// Difference of a flow from 1 that is told.
pub(super) const FLOW_RATIO: f64 = 1e-3;
/// A part with a shorter edge is scaled only if the spread of its material along that edge is less
/// by this share of it. A part with a thin tip has 0.4.
pub(super) const SPREAD_SHARE: f64 = 0.8;
/// One edge alone is scaled only if it is shorter by more than this share. An ear of 180 mm lost 1
/// mm of its tip, and the spread along it 0.7 %.
pub(super) const LONE_EDGE_LOSS: f64 = 0.01;
/// If two edges and more are shorter, this share of the mean loss of all edges is enough. Parts
/// scaled to 99 % have 0.66 and more, right parts with thin rims up to 0.25.
pub(super) const WHOLE_SPREAD_SHARE: f64 = 0.5;
/// A part by itself may get too much as if its surface were this much farther out, mm. A part of
/// 3 g got 0.053 mm.
pub(super) const EXTRA_SKIN_MM: f64 = 0.06;
/// A part by itself may get too little as if its surface were this much farther in, mm. A part of
/// 2 g with thin tips got 0.007 mm.
pub(super) const LACKING_SKIN_MM: f64 = 0.02;
/// A box within this distance of its promised place lies there, mm. Its own accuracy is no better.
pub(super) const PLACE_MM: f64 = 0.1;
/// Another pose, or a mirror image, is taken only if it fits by this factor better than the usual.
pub(super) const CLEARLY_RATIO: f64 = 0.5;
/// Any angle about the vertical is tried only if right angles miss by more than this, mm: a turn of
/// a degree does.
pub(super) const FREE_TURN_MM: f64 = 1.0;
/// Misfits below this tell no poses apart, mm: the accuracy of a centre.
pub(super) const MISFIT_MM: f64 = 0.15;
/// Poses whose misfits differ by less are alike, mm: those of a symmetric part.
pub(super) const ALIKE_MM: f64 = 0.01;
