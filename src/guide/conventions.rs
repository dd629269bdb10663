//! Units, frames, orientation and determinism, as every room keeps them.
//!
//! # Units
//! Inside: `f64`, millimetres, grams, radians, so volumes are mm³, inertia g·mm², densities g/mm³.
//! At every border the unit is part of the name: `wall_mm`, `tilt_deg`, `density_g_cm3`. A name
//! that ends in `_ratio` has no unit.
//!
//! # Frames
//! * The **model frame** has the axes of the input file, scaled to millimetres. `hollowed.stl` and
//!   everything in `checklist.json` that is not said to be elsewhere is in this frame. The halves
//!   of a yo-yo on an axle are moved by half the string gap each, up or down its axis, and are
//!   there in all files of the kit. `assembly.3mf` puts the printed parts back into it. A 3MF file
//!   that is read says its unit, and is in mm from then on.
//! * The **goal frame** ([`crate::geom::Frame`]) has its origin at the contact point of a top, at
//!   the spin point of a yo-yo or on the axis of a rotor, in the middle of the support polygon of a
//!   standing object, or as low as the lowest point of one that floats, and its z axis along the
//!   spin axis or up.
//! * The **print pose** of a part is the model frame after `print_from_model`, a rigid 4×4 matrix
//!   of rows; the part then rests on z = 0.
//!
//! # Orientation
//! Triangles are counter-clockwise seen from outside the material. A void on its own is a solid of
//! air, oriented outward; inside a [`crate::cut::Hollowed`] written as one mesh it is turned
//! inside out, so the divergence theorem subtracts it.
//!
//! # Ten moments
//! [`crate::mass::Moments`] are the integrals of (1, x, y, z, xy, yz, xz, x², y², z²), always in
//! this order. They add over disjoint regions and are exact for a closed triangle mesh.
//!
//! # Determinism
//! The same input gives the same bytes, whatever the thread count: parallel work is collected by
//! index and summed in a fixed order. Wall-clock times are printed, never written into a kit.
