//! Curves by their measures: `arc:R,DEG` and `helix:R,PITCH,TURNS`.

use std::f64::consts::TAU;
use std::fmt;
use std::str::FromStr;

use super::error::NameError;
use super::helix::Helix;
use crate::base::units::Length;
use crate::geom::Point;

/// The most turns of a named helix: each takes its own points.
const MOST_TURNS: f64 = 1000.0;

/// Edges for each turn of a named curve: the sagitta of an edge is 1e-6 of the radius.
const EDGES_PER_TURN: f64 = 2048.0;

/// Least number of edges.
const LEAST_EDGES: usize = 64;

/// How an arc is written.
const ARC_FORM: &str = "arc:R,DEG";
/// How a helix is written.
const HELIX_FORM: &str = "helix:R,PITCH,TURNS";

/// An arc or a helix by its measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NamedCurve {
    /// An arc in a plane.
    Arc {
        /// The radius of its centre line, mm.
        radius_mm: f64,
        /// The angle over which it goes, rad.
        angle_rad: f64,
    },
    /// A helix about the axis of a cylinder.
    Helix {
        /// The radius of its centre line about the axis, mm.
        radius_mm: f64,
        /// The rise of a turn, mm.
        pitch_mm: f64,
        /// The number of turns.
        turns: f64,
    },
}

impl NamedCurve {
    /// Returns the helix of constant curvature and torsion that it is.
    pub fn helix(&self) -> Helix {
        match *self {
            Self::Arc { radius_mm, .. } => Helix {
                curvature: 1.0 / radius_mm,
                torsion: 0.0,
            },
            Self::Helix {
                radius_mm,
                pitch_mm,
                ..
            } => {
                let rise = pitch_mm / TAU;
                let square = radius_mm * radius_mm + rise * rise;
                Helix {
                    curvature: radius_mm / square,
                    torsion: rise / square,
                }
            }
        }
    }

    /// Returns its length, mm.
    pub fn length_mm(&self) -> f64 {
        match *self {
            Self::Arc {
                radius_mm,
                angle_rad,
            } => radius_mm * angle_rad,
            Self::Helix {
                radius_mm,
                pitch_mm,
                turns,
            } => turns * pitch_mm.hypot(TAU * radius_mm),
        }
    }

    /// Returns points along it, the first at the origin with the tangent x, mm.
    pub fn points(&self) -> Vec<Point> {
        let (helix, length_mm) = (self.helix(), self.length_mm());
        let turns = length_mm * helix.curvature.hypot(helix.torsion) / TAU;
        let edges = ((turns * EDGES_PER_TURN).ceil() as usize).max(LEAST_EDGES);
        let at = |i: usize| helix.frame_at(length_mm * i as f64 / edges as f64).origin;
        (0..=edges).map(at).collect()
    }
}

impl fmt::Display for NamedCurve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Arc {
                radius_mm,
                angle_rad,
            } => write!(f, "arc:{radius_mm},{}", angle_rad.to_degrees()),
            Self::Helix {
                radius_mm,
                pitch_mm,
                turns,
            } => write!(f, "helix:{radius_mm},{pitch_mm},{turns}"),
        }
    }
}

impl FromStr for NamedCurve {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Self, NameError> {
        let reader = |form| Reader { text, form };
        match text.split_once(':') {
            Some(("arc", measures)) => reader(ARC_FORM).arc(measures),
            Some(("helix", measures)) => reader(HELIX_FORM).helix(measures),
            _ => Err(NameError::Unknown {
                text: text.to_owned(),
            }),
        }
    }
}

/// Reads the measures of a named curve.
struct Reader<'a> {
    text: &'a str,
    form: &'static str,
}

impl Reader<'_> {
    fn arc(&self, measures: &str) -> Result<NamedCurve, NameError> {
        let [radius, degrees] = self.split(measures)?;
        let degrees = self.number("DEG", degrees)?;
        if !(degrees > 0.0 && degrees < 360.0) {
            return Err(self.range("DEG", "above 0 and below 360"));
        }
        Ok(NamedCurve::Arc {
            radius_mm: self.length("R", radius)?,
            angle_rad: degrees.to_radians(),
        })
    }

    fn helix(&self, measures: &str) -> Result<NamedCurve, NameError> {
        let [radius, pitch, turns] = self.split(measures)?;
        let turns = self.number("TURNS", turns)?;
        if !(turns > 0.0 && turns <= MOST_TURNS) {
            return Err(self.range("TURNS", "above 0 and at most 1000"));
        }
        Ok(NamedCurve::Helix {
            radius_mm: self.length("R", radius)?,
            pitch_mm: self.length("PITCH", pitch)?,
            turns,
        })
    }

    fn split<'a, const N: usize>(&self, measures: &'a str) -> Result<[&'a str; N], NameError> {
        let parts: Vec<&str> = measures.split(',').collect();
        let found = parts.len();
        parts.try_into().map_err(|_| NameError::Count {
            text: self.text.to_owned(),
            found,
            form: self.form,
        })
    }

    fn length(&self, measure: &'static str, text: &str) -> Result<f64, NameError> {
        let length = text.parse::<Length>().map(Length::mm);
        length.map_err(|_| self.unread(measure, "60mm"))
    }

    fn number(&self, measure: &'static str, text: &str) -> Result<f64, NameError> {
        let number = text.trim().parse::<f64>();
        number.map_err(|_| self.unread(measure, "2.5"))
    }

    fn unread(&self, measure: &'static str, example: &'static str) -> NameError {
        NameError::Measure {
            text: self.text.to_owned(),
            measure,
            form: self.form,
            example,
        }
    }

    fn range(&self, measure: &'static str, range: &'static str) -> NameError {
        NameError::Range {
            text: self.text.to_owned(),
            measure,
            range,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve;

    #[test]
    fn a_named_curve_has_the_measures_of_its_name() {
        let arc: NamedCurve = "arc:60,90".parse().unwrap();
        let points = arc.points();
        let last = points[points.len() - 1];
        assert!((last - Point::new(60.0, 60.0, 0.0)).norm() < 1e-11);
        let helix: NamedCurve = "helix:2cm,30,2".parse().unwrap();
        let points = helix.points();
        let length = Curve::of_polyline(points.clone()).unwrap().length_mm();
        assert!((length / helix.length_mm() - 1.0).abs() < 2e-6);
        // After whole turns it is above its start by the rise.
        let risen = (points[points.len() - 1] - points[0]).norm();
        assert!((risen - 60.0).abs() < 1e-9, "{risen}");
        assert_eq!(helix.to_string().parse(), Ok(helix));
    }

    #[test]
    fn a_bad_name_says_how_it_is_written() {
        let says = |text: &str| text.parse::<NamedCurve>().unwrap_err().to_string();
        assert!(says("circle:3").contains("arc:R,DEG"));
        assert!(says("arc").contains("arc:R,DEG"));
        assert!(says("arc:3").contains("has 1 measures"));
        assert!(says("helix:3,2").contains("helix:R,PITCH,TURNS"));
        assert!(says("arc:x,90").contains("R in `arc:x,90`"));
        assert!(says("arc:60,400").contains("below 360"));
        assert!(says("arc:60,nan").contains("below 360"));
        assert!(says("helix:60,10,1e9").contains("at most 1000"));
        assert!(says("helix:-6,10,1").contains("cannot be read"));
    }
}
