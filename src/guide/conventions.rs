//! Units, frames, orientation and determinism, as every room of the program keeps them.
//!
//! # Units
//! Inside the program: `f64`, millimetres, grams, radians. So volumes are in mm³, inertia in g·mm²,
//! densities in g/mm³. At every border the unit is part of the name: `wall_mm`, `tilt_deg`,
//! `density_g_cm3`. A name that ends in `_ratio` has no unit.
//!
//! # Frames
//! * The **model frame** has the axes of the input file, scaled to millimetres. `hollowed.stl` is
//!   in this frame, and so is everything in `checklist.json` unless stated otherwise. In all files
//!   of the kit, the halves of a yo-yo on an axle are moved apart along it, by half the string gap
//!   each. `assembly.3mf` places the printed parts in this frame. A 3MF input file states its unit
//!   and is converted to mm.
//! * The **goal frame** ([`crate::geom::Frame`]) has its z axis along the spin axis, or up. Its
//!   origin is the contact point of a top, the spin point of a yo-yo, or a point on the axis of a
//!   rotor. For a standing object it is the middle of the support polygon. For a floating object it
//!   is at the height of the lowest point.
//! * The **print pose** of a part is the model frame after `print_from_model`, a rigid 4×4 matrix
//!   in row order. The part then rests on z = 0.
//!
//! # Orientation
//! Triangles are counter-clockwise seen from outside the material. A void on its own is a solid of
//! air, oriented outward. Inside a [`crate::cut::Hollowed`] written as one mesh it is turned
//! inside out, so that the divergence theorem subtracts it.
//!
//! # Ten moments
//! [`crate::mass::Moments`] are the integrals of (1, x, y, z, xy, yz, xz, x², y², z²), always in
//! this order. They add over disjoint regions and are exact for a closed triangle mesh.
//!
//! # Determinism
//! The same input gives the same bytes at any thread count: parallel work is collected by index and
//! summed in a fixed order. Wall-clock times are printed, never written into a kit.
