//! The natural up of a run, and the words for it.

use std::fmt;

use crate::base::setting::{Key, Setting};
use crate::goal::{Up, UprightPose, UprightReason};

/// A lead below which the next pose is about as likely. Sampling moves a lead by some hundredths.
const CLEAR_LEAD: f64 = 0.1;
/// The number of reasons that are reported.
const MOST_REASONS: usize = 3;

/// The pose in which the model stands by nature.
#[derive(Debug, Clone, PartialEq)]
pub struct NaturalUp {
    /// Up.
    pub up: Up,
    /// The reasons, the weightiest first; empty if nothing was found and z is taken.
    pub reasons: Vec<UprightReason>,
    /// The next best direction; `None` if there is none.
    pub next: Option<Up>,
    /// True if it is clearly better than the next.
    pub is_clear: bool,
}

impl NaturalUp {
    /// Returns the best of the poses, with their directions as they are typed.
    pub fn of(poses: &[UprightPose], name: impl Fn(&UprightPose) -> Up) -> Self {
        let best = poses.first();
        Self {
            up: best.map_or(Up::Z, &name),
            reasons: best.map_or_else(Vec::new, |best| best.reasons.clone()),
            next: poses.get(1).map(name),
            is_clear: best.is_none_or(|best| best.lead >= CLEAR_LEAD),
        }
    }

    /// Returns the setting that orders it.
    pub fn setting(&self) -> Setting {
        Setting::new(Key::Up, self.up)
    }
}

impl fmt::Display for NaturalUp {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "`{}` was taken as the natural up", self.setting())?;
        let reasons = self.reasons.iter().take(MOST_REASONS);
        let reasons: Vec<String> = reasons.map(words).collect();
        if !reasons.is_empty() {
            write!(f, ": {}", reasons.join(", "))?;
        }
        let Some(next) = self.next else {
            return Ok(());
        };
        let next = Setting::new(Key::Up, next);
        if self.is_clear {
            write!(f, ". The next best is `{next}`")
        } else {
            write!(f, ". About as likely is `{next}`")
        }
    }
}

/// Returns the weightiest reason for a pose in two or three words; `None` if there is none.
pub fn short_reason(pose: &UprightPose) -> Option<String> {
    Some(match pose.reasons.first()? {
        UprightReason::FlatFoot => "flat foot".to_owned(),
        UprightReason::Feet { count } => format!("{count} feet"),
        UprightReason::MirrorPlane => "mirrored halves".to_owned(),
        UprightReason::TopUnlikeBottom => "top unlike bottom".to_owned(),
        UprightReason::StableRest => "rights itself".to_owned(),
        UprightReason::HoldsLiquid => "holds liquid".to_owned(),
        UprightReason::NarrowBelow => "narrow end below".to_owned(),
        UprightReason::FileUp => "nearest to the file's z".to_owned(),
    })
}

/// Returns the words for a reason; "there" is the pose.
fn words(reason: &UprightReason) -> String {
    match reason {
        UprightReason::FlatFoot => "its foot is flat there".to_owned(),
        UprightReason::Feet { count } => format!("it stands on {count} separate feet"),
        UprightReason::MirrorPlane => "its halves mirror each other left and right".to_owned(),
        UprightReason::TopUnlikeBottom => "its top is unlike its bottom".to_owned(),
        UprightReason::StableRest => "it rights itself when it is tilted".to_owned(),
        UprightReason::HoldsLiquid => "it holds liquid as a cup does".to_owned(),
        UprightReason::NarrowBelow => "its narrow end is below".to_owned(),
        UprightReason::FileUp => "of equals it is nearest to the file's z".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;

    fn pose(up: Vector, lead: f64) -> UprightPose {
        let reasons = vec![UprightReason::MirrorPlane, UprightReason::Feet { count: 4 }];
        UprightPose {
            up,
            score: 2.0,
            lead,
            reasons,
        }
    }

    #[test]
    fn the_natural_up_says_why_and_what_to_type_for_the_next_best() {
        let name = |pose: &UprightPose| Up::Along(pose.up.into());
        let words = |lead| {
            let poses = [pose(Vector::y(), lead), pose(Vector::x(), -lead)];
            NaturalUp::of(&poses, name).to_string()
        };
        let clear = words(0.5);
        assert!(clear.starts_with("`up = \"0,1,0\"` was taken"), "{clear}");
        assert!(clear.contains("4 separate feet"), "{clear}");
        assert!(
            clear.ends_with(". The next best is `up = \"1,0,0\"`"),
            "{clear}"
        );
        assert!(words(0.05).ends_with(". About as likely is `up = \"1,0,0\"`"));
    }
}
