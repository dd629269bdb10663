//! The answers that the questions offer.

use std::fmt;

use crate::base::setting::{Key, Setting};
use crate::cli::flags::flag;
use crate::goal::{GoalKind, Up, UprightPose};
use crate::printer::Printer;
use crate::run::short_reason;

/// The most characters of a choice: it stands behind a mark.
const LINE_CHARS: usize = 76;
/// The least lean of a direction that is reported, degrees.
const LEAST_LEAN_DEG: f64 = 0.5;

/// A goal, in the words of a person who does not know ours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GoalChoice(pub GoalKind);

impl GoalChoice {
    /// Returns all goals that a model alone can have, the commonest first.
    pub fn all() -> Vec<Self> {
        [
            GoalKind::Stand,
            GoalKind::Top,
            GoalKind::Yoyo,
            GoalKind::Float,
            GoalKind::Balance,
        ]
        .map(Self)
        .to_vec()
    }
}

impl fmt::Display for GoalChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = match self.0 {
            GoalKind::Stand => "stand by itself",
            GoalKind::Top => "spin on the table as a top",
            GoalKind::Yoyo => "spin freely about an axis, as a yo-yo does",
            GoalKind::Float => "float upright in water",
            GoalKind::Balance => "run true on a shaft, as a wheel or rotor",
            GoalKind::Match => "handle like another body",
        };
        write!(f, "{:<8} {words}", self.0.word())
    }
}

/// A printer with its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PrinterChoice {
    /// Its id.
    pub id: String,
    name: String,
    process: String,
}

impl From<&Printer> for PrinterChoice {
    fn from(printer: &Printer) -> Self {
        Self {
            id: printer.id.clone(),
            name: printer.name.clone(),
            process: printer.process.clone().unwrap_or_default(),
        }
    }
}

impl fmt::Display for PrinterChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let line = format!("{:<22} {} ({})", self.id, self.name, self.process);
        f.write_str(&clip(line))
    }
}

/// A direction that is up, with the reason for it.
#[derive(Debug, Clone, PartialEq)]
pub struct UpChoice {
    /// The direction; `None` for the default of the goal.
    pub up: Option<Up>,
    words: String,
}

impl fmt::Display for UpChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

impl UpChoice {
    /// Returns the poses of a model that a person may mean, the likeliest first, and the rest of
    /// the file's axes. `name` names the direction of a pose.
    ///
    /// Tops and yo-yos take the nearest axis on which they can spin, unless one is chosen.
    pub fn poses(
        poses: &[UprightPose],
        kind: GoalKind,
        name: impl Fn(&UprightPose) -> Up,
    ) -> Vec<Self> {
        let spins = matches!(kind, GoalKind::Top | GoalKind::Yoyo);
        let mut choices: Vec<Self> = Vec::new();
        for pose in poses {
            let up = name(pose);
            let is_first = choices.is_empty();
            // One reason: a line that wraps is hard to choose from.
            let why = short_reason(pose).map_or(String::new(), |why| format!(": {why}"));
            let side = side_below(up);
            let words = match (is_first, spins) {
                (true, true) => format!("{side} (likeliest) or the nearest that spins"),
                (true, false) => format!("{side} (likeliest{why})"),
                (false, _) => format!("{side} (or{why})"),
            };
            choices.push(Self {
                up: (!is_first).then_some(up),
                words: clip(words),
            });
        }
        let known: Vec<Up> = poses.iter().map(name).collect();
        let others = [Up::Z, Up::Y, Up::X, Up::NegZ, Up::NegY, Up::NegX];
        let others = others.into_iter().filter(|up| !known.contains(up));
        choices.extend(others.map(|up| Self {
            up: Some(up),
            words: side_below(up),
        }));
        choices.push(Self {
            up: Some(Up::Auto),
            words: "whichever works best".to_owned(),
        });
        choices
    }

    /// Returns the axes of the file, for a rotor's shaft.
    pub fn shafts() -> Vec<Self> {
        let axis = |up: Up| Self {
            up: Some(up),
            words: format!("along {up}"),
        };
        [Up::Z, Up::Y, Up::X].map(axis).to_vec()
    }

    /// Returns what to type for it; `None` for the default.
    pub fn typed(&self) -> Option<String> {
        self.up.map(|up| flag(&Setting::new(Key::Up, up)))
    }
}

/// Returns the side of the model that is down with this up. A direction that leans is named by the
/// nearest axis of the file.
fn side_below(up: Up) -> String {
    let axes = [Up::X, Up::Y, Up::Z, Up::NegX, Up::NegY, Up::NegZ];
    let sides = ["−x", "−y", "−z", "+x", "+y", "+z"];
    let angle_deg = |axis: &Up| {
        let angle = axis.direction()?.angle(&up.direction()?);
        Some(angle.to_degrees())
    };
    let angles = axes.iter().map(|axis| angle_deg(axis).unwrap_or_default());
    let nearest = angles.zip(sides).min_by(|a, b| a.0.total_cmp(&b.0));
    match nearest {
        Some((lean_deg, side)) if lean_deg >= LEAST_LEAN_DEG => {
            format!("about the {side} side down, leaning by {lean_deg:.0}°")
        }
        Some((_, "−z")) => "the −z side down, as in the file".to_owned(),
        Some((_, side)) => format!("the {side} side down"),
        None => up.to_string(),
    }
}

/// Returns a line that does not wrap on a terminal of 80 columns.
fn clip(line: String) -> String {
    if line.chars().count() <= LINE_CHARS {
        return line;
    }
    let cut: String = line.chars().take(LINE_CHARS - 1).collect();
    format!("{}…", cut.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::goal::UprightReason;

    #[test]
    fn the_likeliest_pose_is_the_default_and_every_axis_is_there() {
        let pose = |up: Vector| UprightPose {
            up,
            score: 1.0,
            lead: 0.5,
            reasons: vec![UprightReason::FlatFoot],
        };
        let name = |pose: &UprightPose| if pose.up.y > 0.5 { Up::Y } else { Up::Z };
        let poses = [pose(Vector::y()), pose(Vector::z())];
        let choices = UpChoice::poses(&poses, GoalKind::Stand, name);
        assert_eq!(choices[0].typed(), None);
        assert!(
            choices[0]
                .to_string()
                .starts_with("the −y side down (likeliest: flat foot)")
        );
        let top = UpChoice::poses(&poses, GoalKind::Top, name)[0].to_string();
        assert!(
            top.ends_with("(likeliest) or the nearest that spins"),
            "{top}"
        );
        assert_eq!(choices[1].typed().as_deref(), Some("--up=z"));
        assert_eq!(choices.len(), 7, "{choices:?}");
    }

    #[test]
    fn a_direction_that_leans_is_named_by_the_nearest_axis() {
        let leaning = Up::Along([0.0, 0.1046, -0.9945]);
        assert_eq!(side_below(leaning), "about the +z side down, leaning by 6°");
        assert_eq!(side_below(Up::NegX), "the +x side down");
        assert_eq!(side_below(Up::Z), "the −z side down, as in the file");
    }

    #[test]
    fn every_goal_is_offered_once() {
        let offered = GoalChoice::all();
        let is_offered = |kind: &GoalKind| offered.contains(&GoalChoice(*kind));
        let kinds = GoalKind::ALL.iter();
        let asked: Vec<&GoalKind> = kinds.filter(|kind| kind.is_asked_of_a_model()).collect();
        assert!(asked.iter().copied().all(is_offered) && offered.len() == asked.len());
    }
}
