//! A rotor's speed, balance grade and bore.

use serde::{Deserialize, Serialize};

use crate::base::units::Length;

/// The default speed, turns a minute.
const DEFAULT_SPEED_RPM: f64 = 3000.0;
/// The default balance quality grade, mm/s: G 2.5, that of machine-tool drives and small electric
/// motors (ISO 21940-11, table 1).
const DEFAULT_GRADE_MM_S: f64 = 2.5;

/// A rotor's speed, its balance quality and its bore.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rotor {
    /// The service speed, turns a minute.
    pub speed_rpm: f64,
    /// The ISO 21940-11 balance quality grade G that must be reached at that speed, mm/s.
    pub grade_mm_s: f64,
    /// The diameter of the bore on the axis, about which a wall stays solid. `None` if the model
    /// brings its own bore, or has none.
    pub bore: Option<Length>,
}

impl Default for Rotor {
    fn default() -> Self {
        Self {
            speed_rpm: DEFAULT_SPEED_RPM,
            grade_mm_s: DEFAULT_GRADE_MM_S,
            bore: None,
        }
    }
}

impl Rotor {
    /// Returns true if speed and grade are positive and finite.
    pub(super) fn is_sound(&self) -> bool {
        [self.speed_rpm, self.grade_mm_s]
            .into_iter()
            .all(|number| number.is_finite() && number > 0.0)
    }

    /// Returns the angular speed, rad/s.
    pub fn omega_rad_s(&self) -> f64 {
        self.speed_rpm * std::f64::consts::TAU / 60.0
    }

    /// Returns the permissible residual specific unbalance e = G/ω, mm (ISO 21940-11).
    pub fn permissible_mm(&self) -> f64 {
        self.grade_mm_s / self.omega_rad_s()
    }
}

/// A rotor in its place on the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spindle {
    /// The rotor.
    pub rotor: Rotor,
    /// The two tolerance planes: the ends of the model along the axis, goal frame, mm.
    pub ends_mm: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_permissible_offset_is_that_of_the_standards_chart() {
        // ISO 21940-11, figure 2: G 2.5 at 3000 rpm is 8 µm (g·mm/kg); exactly 2.5/(100 π) mm.
        let permissible_mm = Rotor::default().permissible_mm();
        assert!((permissible_mm - 2.5 / (100.0 * std::f64::consts::PI)).abs() < 1e-15);
        assert!((permissible_mm - 0.008).abs() < 1e-4);
    }
}
