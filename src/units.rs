//! Lengths, masses and angles: mm, g and radians inside; how a person writes and reads them.

/// Standard gravity, m/s² (CGPM 1901, resolution 2).
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Standard gravity in the library's own units, mm/s².
pub const STANDARD_GRAVITY_MM_S2: f64 = STANDARD_GRAVITY_M_S2 * 1000.0;
