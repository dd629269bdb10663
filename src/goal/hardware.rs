//! What is put into the printed object that is not printed: a yo-yo's axle and string gap, a top's
//! tip and stem.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::GoalKind;
use crate::base::units::Length;
use crate::base::words::{ChoiceError, as_text};

/// The density of a rod where none is said, g/cm³: steel.
pub const STEEL_G_CM3: f64 = 7.85;
/// How much of a tip or stem is inside where its depth is not said.
const DEPTH_RATIO: f64 = 0.5;
/// The outer diameter of what sits on a yo-yo's axle besides it, in diameters of the axle: that of
/// a plain washer or a small bearing.
const FITTING_DIAMETERS: f64 = 2.0;

/// A round rod: `DIAMETER`, `DIAMETERxLENGTH` or `DIAMETERxLENGTHxDEPTH`, and behind it `:DENSITY`
/// in g/cm³ where it is not of steel; `4mmx12mm`, `6mm:2.7`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Rod {
    /// Its diameter.
    pub diameter: Length,
    /// From end to end; an axle's follows from the room there is where none is said.
    pub length: Option<Length>,
    /// How much of a tip or stem is inside the object; half of it where nothing is said.
    pub depth: Option<Length>,
    /// g/cm³.
    pub density_g_cm3: f64,
}

impl Rod {
    /// Its radius, mm.
    pub fn radius_mm(&self) -> f64 {
        0.5 * self.diameter.mm()
    }

    /// The length of a tip or stem, mm; zero where none was said, which checking the request
    /// refuses.
    pub fn length_mm(&self) -> f64 {
        self.length.map_or(0.0, Length::mm)
    }

    /// How much of a tip or stem is inside the object, mm.
    pub fn depth_mm(&self) -> f64 {
        self.depth
            .map_or(DEPTH_RATIO * self.length_mm(), Length::mm)
    }

    /// How much of a tip or stem stands out of it, mm.
    pub fn out_mm(&self) -> f64 {
        self.length_mm() - self.depth_mm()
    }

    /// The outer diameter of what sits on this axle besides it, mm.
    pub fn fitting_diameter_mm(&self) -> f64 {
        FITTING_DIAMETERS * self.diameter.mm()
    }
}

impl FromStr for Rod {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let refused = |remedy: String| ChoiceError::Unknown {
            what: "rod",
            text: text.to_owned(),
            remedy,
        };
        let (sizes, density) = text.split_once(':').unwrap_or((text, ""));
        let sizes: Vec<Length> = sizes
            .split(['x', '×'])
            .map(Length::from_str)
            .collect::<Result<_, _>>()
            .map_err(|error| refused(error.to_string()))?;
        let (diameter, length, depth) = match sizes[..] {
            [diameter] => (diameter, None, None),
            [diameter, length] => (diameter, Some(length), None),
            [diameter, length, depth] => (diameter, Some(length), Some(depth)),
            _ => {
                return Err(refused(
                    "write DIAMETERxLENGTHxDEPTH:DENSITY, such as 4mmx12mm:7.85".to_owned(),
                ));
            }
        };
        let density_g_cm3 = if density.is_empty() {
            Ok(STEEL_G_CM3)
        } else {
            density.trim().parse()
        };
        let is_sound = |density: &f64| density.is_finite() && *density > 0.0;
        match density_g_cm3.ok().filter(is_sound) {
            Some(density_g_cm3) => Ok(Self {
                diameter,
                length,
                depth,
                density_g_cm3,
            }),
            None => Err(refused(
                "write its density in g/cm³ behind the colon, above zero".to_owned(),
            )),
        }
    }
}

impl fmt::Display for Rod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.diameter)?;
        for size in self.length.iter().chain(&self.depth) {
            write!(f, "x{size}")?;
        }
        if self.density_g_cm3 == STEEL_G_CM3 {
            Ok(())
        } else {
            write!(f, ":{}", self.density_g_cm3)
        }
    }
}

as_text!(Rod);

/// What is put into the object that is not printed. Its mass counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hardware {
    /// Yo-yo: how far its halves are moved apart along the axle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub string_gap: Option<Length>,
    /// Yo-yo: the rod along the axis that joins the halves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axle: Option<Rod>,
    /// Yo-yo: the mass of nuts, washers or a bearing in the gap, g: a ring about the axle, as wide
    /// as the gap and twice the axle's diameter across.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_g: Option<f64>,
    /// Top: the pin it spins on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<Rod>,
    /// Top: the stem it is spun by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stem: Option<Rod>,
}

/// Hardware that does not go together or with its goal.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HardwareError {
    /// A string gap, an axle or a mass on it for what is no yo-yo.
    #[error(
        "a string gap, an axle and hardware on it go with the goal yoyo, not with {0}; remedy: leave them out"
    )]
    NotAYoyo(GoalKind),
    /// A tip or stem for what is no top.
    #[error("a tip and a stem go with the goal top, not with {0}; remedy: leave them out")]
    NotATop(GoalKind),
    /// A gap and nothing to hold the halves, or the reverse.
    #[error(
        "a string gap and an axle go together; remedy: give both, such as --string-gap 3mm --axle 6mm"
    )]
    GapAndAxle,
    /// An axle with a depth, or no longer than the gap.
    #[error(
        "an axle of {0} does not bridge the string gap: remedy: give DIAMETERxLENGTH with a length well above the gap, and no depth"
    )]
    Axle(Rod),
    /// A mass that is none.
    #[error("hardware of {0} g is none; remedy: give a mass in g, above zero")]
    Mass(f64),
    /// A tip or stem without a length, or with nothing inside or outside.
    #[error(
        "a {what} of {rod} cannot be held: remedy: give DIAMETERxLENGTHxDEPTH with a depth below the length, such as 4mmx12mmx6mm"
    )]
    Depth {
        /// Tip or stem.
        what: &'static str,
        /// What was asked for.
        rod: Rod,
    },
    /// A tip that stands out by less than the radius of its round end.
    #[error(
        "a tip of {0} stands out by less than its radius, so that its end cannot be round; remedy: make it longer or less deep"
    )]
    Blunt(Rod),
}

impl Hardware {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Whether its parts go together, and with the goal.
    pub(super) fn check(&self, kind: GoalKind) -> Result<(), HardwareError> {
        let is_for_yoyo = self.string_gap.is_some() || self.axle.is_some() || self.mass_g.is_some();
        if is_for_yoyo && kind != GoalKind::Yoyo {
            return Err(HardwareError::NotAYoyo(kind));
        }
        if (self.tip.is_some() || self.stem.is_some()) && kind != GoalKind::Top {
            return Err(HardwareError::NotATop(kind));
        }
        if is_for_yoyo {
            self.check_axle()?;
        }
        for (what, rod) in [("tip", self.tip), ("stem", self.stem)] {
            rod.map_or(Ok(()), |rod| check_depth(what, rod))?;
        }
        let blunt = self.tip.filter(|tip| tip.out_mm() < tip.radius_mm());
        blunt.map_or(Ok(()), |tip| Err(HardwareError::Blunt(tip)))
    }

    fn check_axle(&self) -> Result<(), HardwareError> {
        let (Some(gap), Some(axle)) = (self.string_gap, self.axle) else {
            return Err(HardwareError::GapAndAxle);
        };
        let is_short = axle.length.is_some_and(|length| length.mm() <= gap.mm());
        if axle.depth.is_some() || is_short {
            return Err(HardwareError::Axle(axle));
        }
        let is_mass = |mass_g: &f64| mass_g.is_finite() && *mass_g > 0.0;
        self.mass_g
            .filter(|mass_g| !is_mass(mass_g))
            .map_or(Ok(()), |mass_g| Err(HardwareError::Mass(mass_g)))
    }
}

fn check_depth(what: &'static str, rod: Rod) -> Result<(), HardwareError> {
    let is_sound = rod.length.is_some() && rod.depth_mm() < rod.length_mm();
    if is_sound {
        Ok(())
    } else {
        Err(HardwareError::Depth { what, rod })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::{Request, RequestError};

    fn rod(text: &str) -> Rod {
        text.parse().unwrap()
    }

    fn with(kind: GoalKind, hardware: Hardware) -> Result<Request, RequestError> {
        Request {
            hardware: Some(hardware),
            ..Request::new(kind)
        }
        .checked()
    }

    #[test]
    fn a_rod_reads_as_a_shop_writes_it_and_prints_as_it_reads() {
        for text in ["6mm", "6mmx27mm", "4mmx12mmx5mm", "4mmx12mm:8.5"] {
            assert_eq!(rod(text).to_string(), text);
        }
        assert_eq!(rod("4x12"), rod("0.4cm × 12mm"));
        let pin = rod("4x12");
        assert_eq!(
            (pin.depth_mm(), pin.out_mm(), pin.density_g_cm3),
            (6.0, 6.0, STEEL_G_CM3)
        );
    }

    #[test]
    fn what_is_no_rod_is_refused_with_a_remedy() {
        for text in [
            "",
            "x",
            "4mmx",
            "1x2x3x4",
            "-4mm",
            "4mm:0",
            "4mm:heavy",
            "4mm:inf",
        ] {
            let error = text.parse::<Rod>().unwrap_err().to_string();
            assert!(error.contains("is not a rod; remedy: "), "{error}");
        }
    }

    #[test]
    fn hardware_goes_with_its_goal_and_its_parts_with_each_other() {
        let gap = "3mm".parse().ok();
        let axle = Hardware {
            string_gap: gap,
            axle: Some(rod("6mm")),
            ..Hardware::default()
        };
        let tip = Hardware {
            tip: Some(rod("4x12")),
            stem: Some(rod("5x30")),
            ..Hardware::default()
        };
        assert!(with(GoalKind::Yoyo, axle).is_ok() && with(GoalKind::Top, tip).is_ok());
        let refused = |kind, hardware| match with(kind, hardware) {
            Err(RequestError::Hardware(error)) => error,
            other => panic!("{other:?}"),
        };
        assert_eq!(
            refused(GoalKind::Top, axle),
            HardwareError::NotAYoyo(GoalKind::Top)
        );
        assert_eq!(
            refused(GoalKind::Stand, tip),
            HardwareError::NotATop(GoalKind::Stand)
        );
        let alone = Hardware { axle: None, ..axle };
        assert_eq!(refused(GoalKind::Yoyo, alone), HardwareError::GapAndAxle);
        let short = Hardware {
            axle: Some(rod("6x3")),
            ..axle
        };
        assert!(matches!(
            refused(GoalKind::Yoyo, short),
            HardwareError::Axle(_)
        ));
        let weightless = Hardware {
            mass_g: Some(0.0),
            ..axle
        };
        assert_eq!(
            refused(GoalKind::Yoyo, weightless),
            HardwareError::Mass(0.0)
        );
        let endless = Hardware {
            tip: Some(rod("4mm")),
            ..tip
        };
        assert!(matches!(
            refused(GoalKind::Top, endless),
            HardwareError::Depth { what: "tip", .. }
        ));
        let sunk = Hardware {
            stem: Some(rod("4x12x12")),
            ..tip
        };
        assert!(matches!(
            refused(GoalKind::Top, sunk),
            HardwareError::Depth { what: "stem", .. }
        ));
        let blunt = Hardware {
            tip: Some(rod("4x12x11")),
            ..tip
        };
        assert!(matches!(
            refused(GoalKind::Top, blunt),
            HardwareError::Blunt(_)
        ));
    }
}
