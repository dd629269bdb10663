//! Hints: what is worth a try for a kit that breaks a promise.

use crate::base::setting::{Key, Setting};
use crate::base::watch::{Cancelled, Watch};
use crate::run::Placed;
use crate::thin::{ThickenError, find_thin, thicken};
use crate::verify::{CheckKind, FigureName};

/// Returns what may help a broken check, `None` if nothing is known to.
pub fn hint(kind: &CheckKind) -> Option<String> {
    let open = Setting::open;
    Some(match kind {
        CheckKind::Contact | CheckKind::Lean => format!(
            "let it spin on a tip below its centre of mass (`{}` and `{}`)",
            Setting::new(Key::Contact, "center"),
            Setting::new(Key::Tip, "auto")
        ),
        CheckKind::AxisOffset
        | CheckKind::AxisTilt
        | CheckKind::MatchMass
        | CheckKind::MatchCenter
        | CheckKind::MatchInertia => format!(
            "a finer pitch (`{}`) brings the written parts nearer to the optimum",
            open(Key::Pitch)
        ),
        CheckKind::Dominance
        | CheckKind::PromisedFigure {
            figure: FigureName::DominanceRatio,
        } => format!(
            "spin it about the axis of its largest moment (`{}`)",
            Setting::new(Key::Up, "principal")
        ),
        CheckKind::Wall => format!(
            "give a thicker wall (`{}`), so that what is lost at sharp edges does not count",
            open(Key::Wall)
        ),
        CheckKind::BuildVolume => format!(
            "make it smaller (`{}`), or choose a printer with more room",
            open(Key::Size)
        ),
        CheckKind::SocketWall => format!(
            "give a thicker wall (`{}`), or align the parts by dowels (`{}`)",
            open(Key::Wall),
            Setting::new(Key::Pins, "dowel")
        ),
        CheckKind::ThinFeatures | CheckKind::ThinNecks => format!(
            "thicken what is thin (`{}`)",
            Setting::new(Key::Thicken, true)
        ),
        CheckKind::Waterline => format!(
            "leave the waterline free (`{}`)",
            Setting::new(Key::Waterline, "auto")
        ),
        kind if kind.void().is_some() || *kind == CheckKind::VoidsAsStated => format!(
            "make it larger with the same wall, or edit cuts.toml and give it back (`{}`)",
            open(Key::Plan)
        ),
        _ => return None,
    })
}

/// Returns whether nothing of the model is thin any more when it is thickened.
pub fn can_thicken(placed: &Placed, watch: &Watch) -> Result<bool, Cancelled> {
    let wall_mm = placed.minimum_wall_mm();
    match thicken(&placed.model.solid, wall_mm, watch) {
        Ok(thick) => {
            let left = find_thin(thick.solid.mesh(), wall_mm, watch)?;
            Ok(left.lost.is_empty() && left.necks.is_empty())
        }
        Err(ThickenError::Cancelled(stopped)) => Err(stopped),
        Err(_) => Ok(false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hint_names_the_setting_to_change() {
        let hint = hint(&CheckKind::Lean).unwrap();
        assert!(hint.contains("`contact = \"center\"`"), "{hint}");
        // Ballast does nothing for what stands, however soon it topples.
        assert_eq!(super::hint(&CheckKind::Standing), None);
    }

    #[test]
    fn a_promised_dominance_is_helped_like_dominance_itself() {
        let promised = CheckKind::PromisedFigure {
            figure: FigureName::DominanceRatio,
        };
        assert_eq!(hint(&promised), hint(&CheckKind::Dominance));
    }
}
