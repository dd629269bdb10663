//! Hardware that is put into the printed object: a yo-yo's axle and string gap, a top's tip and
//! stem.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::kind::GoalKind;
use crate::base::setting::{Key, Setting};
use crate::base::units::Length;
use crate::base::words::{ChoiceError, as_text};

/// The default density of a rod, g/cm³: steel.
pub const STEEL_G_CM3: f64 = 7.85;
/// The default depth of a tip or stem in the object, as a share of its length.
const DEPTH_RATIO: f64 = 0.5;
/// The outer diameter of the fittings on a yo-yo's axle, in diameters of the axle: that of a plain
/// washer or a small bearing.
const FITTING_DIAMETERS: f64 = 2.0;

/// A round rod: `DIAMETER`, `DIAMETERxLENGTH` or `DIAMETERxLENGTHxDEPTH`. `:DENSITY` in g/cm³
/// follows if it is not of steel. Examples: `4mmx12mm`, `6mm:2.7`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Rod {
    /// The diameter.
    pub diameter: Length,
    /// The length from end to end. An axle without one is as long as the model has room for.
    pub length: Option<Length>,
    /// The length of a tip or stem inside the object; half of it if `None`.
    pub depth: Option<Length>,
    /// The density, g/cm³.
    pub density_g_cm3: f64,
}

impl Rod {
    /// Returns the radius, mm.
    pub fn radius_mm(&self) -> f64 {
        0.5 * self.diameter.mm()
    }

    /// Returns the length of a tip or stem, mm; zero if none was given, which checking the request
    /// refuses.
    pub fn length_mm(&self) -> f64 {
        self.length.map_or(0.0, Length::mm)
    }

    /// Returns the length of a tip or stem inside the object, mm.
    pub fn depth_mm(&self) -> f64 {
        self.depth
            .map_or(DEPTH_RATIO * self.length_mm(), Length::mm)
    }

    /// Returns the length of a tip or stem outside the object, mm.
    pub fn out_mm(&self) -> f64 {
        self.length_mm() - self.depth_mm()
    }

    /// Returns the same rod of another diameter, mm, which must be positive.
    pub fn of_diameter(&self, diameter_mm: f64) -> Self {
        let diameter = Length::from_mm(diameter_mm).unwrap_or(self.diameter);
        Self { diameter, ..*self }
    }

    /// Returns the outer diameter of the fittings on this axle, mm.
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

/// The parts put into the object that are not printed. Their mass counts.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hardware {
    /// Yo-yo: the distance by which its halves are moved apart along the axle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub string_gap: Option<Length>,
    /// Yo-yo: the rod along the axis that joins the halves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axle: Option<Rod>,
    /// Yo-yo: the mass of nuts, washers or a bearing in the gap, g. It counts as a ring about the
    /// axle, as wide as the gap and two diameters of the axle across.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_g: Option<f64>,
    /// Top: the pin it spins on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<Rod>,
    /// Top: the stem it is spun by.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stem: Option<Rod>,
}

/// Lengths of a tip or stem that are proposed, in its diameters.
const PROPOSED_DIAMETERS: f64 = 5.0;

/// Returns a rod with a usual length, for one that has none.
fn with_length(rod: &Rod) -> Rod {
    let length = Length::from_mm(PROPOSED_DIAMETERS * rod.diameter.mm());
    Rod {
        length: length.ok(),
        ..*rod
    }
}

/// The remedy for a rod that cannot be held.
const DEPTH_REMEDY: &str = "remedy: give DIAMETERxLENGTHxDEPTH with a depth below the length, such \
                            as 4mmx12mmx6mm";

/// A contradiction within the hardware, or with the goal.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HardwareError {
    /// A string gap, an axle or a mass on it was given for a goal other than a yo-yo.
    #[error(
        "a string gap, an axle and hardware on it go with the goal yoyo, not with {0}; remedy: \
         leave them out"
    )]
    NotAYoyo(GoalKind),
    /// A tip or stem was given for a goal other than a top.
    #[error("a tip and a stem go with the goal top, not with {0}; remedy: leave them out")]
    NotATop(GoalKind),
    /// A gap was given without an axle, or the reverse.
    #[error(
        "a string gap and an axle go together; remedy: give both, such as `{}` and `{}`",
        Setting::new(Key::StringGap, "3mm"),
        Setting::new(Key::Axle, "6mm")
    )]
    GapAndAxle,
    /// The axle has a depth, or is no longer than the gap.
    #[error(
        "an axle of {0} does not bridge the string gap; remedy: give DIAMETERxLENGTH with a \
         length well above the gap, and no depth"
    )]
    Axle(Rod),
    /// The mass is not positive.
    #[error("a mass of {0} g for the hardware cannot be used; remedy: give one in g, above zero")]
    Mass(f64),
    /// The tip has no length.
    #[error(
        "a tip of {} has no length; remedy: give one too (`{}`)", .0.diameter,
        Setting::new(Key::Tip, with_length(.0))
    )]
    TipLength(Rod),
    /// The stem has no length.
    #[error(
        "a stem of {} has no length; remedy: give one too (`{}`)", .0.diameter,
        Setting::new(Key::Stem, with_length(.0))
    )]
    StemLength(Rod),
    /// Nothing of the tip is inside or outside.
    #[error("a tip of {0} cannot be held; {DEPTH_REMEDY}")]
    TipDepth(Rod),
    /// Nothing of the stem is inside or outside.
    #[error("a stem of {0} cannot be held; {DEPTH_REMEDY}")]
    StemDepth(Rod),
    /// The tip stands out by less than the radius of its round end.
    #[error(
        "a tip of {0} stands out by less than its radius, so that its end cannot be round; \
         remedy: make it longer or less deep"
    )]
    Blunt(Rod),
}

impl Hardware {
    /// Returns true if there is no hardware.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Checks that its parts are consistent and go with the goal.
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
        let endless = |rod: &Rod| rod.length.is_none();
        if let Some(tip) = self.tip.filter(endless) {
            return Err(HardwareError::TipLength(tip));
        }
        if let Some(stem) = self.stem.filter(endless) {
            return Err(HardwareError::StemLength(stem));
        }
        let unheld = |rod: &Rod| rod.depth_mm() >= rod.length_mm();
        if let Some(tip) = self.tip.filter(unheld) {
            return Err(HardwareError::TipDepth(tip));
        }
        if let Some(stem) = self.stem.filter(unheld) {
            return Err(HardwareError::StemDepth(stem));
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
        .validate()
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
    fn a_text_that_is_no_rod_is_refused_with_a_remedy() {
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

    fn yoyo() -> Hardware {
        Hardware {
            string_gap: "3mm".parse().ok(),
            axle: Some(rod("6mm")),
            ..Hardware::default()
        }
    }

    fn top() -> Hardware {
        Hardware {
            tip: Some(rod("4x12")),
            stem: Some(rod("5x30")),
            ..Hardware::default()
        }
    }

    fn refusal(kind: GoalKind, hardware: Hardware) -> HardwareError {
        match with(kind, hardware) {
            Err(RequestError::Hardware(error)) => error,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn hardware_goes_with_its_goal() {
        assert!(with(GoalKind::Yoyo, yoyo()).is_ok() && with(GoalKind::Top, top()).is_ok());
        assert_eq!(
            refusal(GoalKind::Top, yoyo()),
            HardwareError::NotAYoyo(GoalKind::Top)
        );
        assert_eq!(
            refusal(GoalKind::Stand, top()),
            HardwareError::NotATop(GoalKind::Stand)
        );
    }

    #[test]
    fn an_axle_is_longer_than_its_gap_and_holds_a_positive_mass() {
        let alone = Hardware {
            axle: None,
            ..yoyo()
        };
        assert_eq!(refusal(GoalKind::Yoyo, alone), HardwareError::GapAndAxle);
        let short = Hardware {
            axle: Some(rod("6x3")),
            ..yoyo()
        };
        assert!(matches!(
            refusal(GoalKind::Yoyo, short),
            HardwareError::Axle(_)
        ));
        let weightless = Hardware {
            mass_g: Some(0.0),
            ..yoyo()
        };
        assert_eq!(
            refusal(GoalKind::Yoyo, weightless),
            HardwareError::Mass(0.0)
        );
    }

    #[test]
    fn a_tip_and_a_stem_have_a_length_inside_and_outside() {
        let endless = Hardware {
            tip: Some(rod("4mm")),
            ..top()
        };
        let endless = refusal(GoalKind::Top, endless);
        assert!(matches!(endless, HardwareError::TipLength(_)));
        assert!(endless.to_string().contains("`tip = \"4mmx20mm\"`"));
        let sunk = Hardware {
            stem: Some(rod("4x12x12")),
            ..top()
        };
        assert!(matches!(
            refusal(GoalKind::Top, sunk),
            HardwareError::StemDepth(_)
        ));
        let blunt = Hardware {
            tip: Some(rod("4x12x11")),
            ..top()
        };
        assert!(matches!(
            refusal(GoalKind::Top, blunt),
            HardwareError::Blunt(_)
        ));
    }
}
