//! The checks of thin features: what of the model itself the printer can make.

use super::{Check, CheckKind, Limit};
use crate::thin::{LEAST_LENGTH_WALLS, ThinFeatures, ThinPlace};

/// Checks that nothing of the model is lost because it is thinner than the least wall, and that
/// nothing hangs by such a neck.
pub(super) fn thin_checks(found: &ThinFeatures) -> [Check; 2] {
    let wall_mm = found.wall_mm;
    // A feature of the last list is shorter than one wall, and no promise is about it.
    let longest = found.lost.first().or(found.ends.first());
    let words = format!("what is thinner than {wall_mm} mm sticks out by at most");
    let features = Check::new(
        CheckKind::ThinFeatures,
        &words,
        Some(longest.map_or(0.0, |place| place.length_mm)),
        Limit::at_most(LEAST_LENGTH_WALLS * wall_mm, "mm"),
    );
    let words = format!("no piece hangs by a neck thinner than {wall_mm} mm");
    let necks = Check::new(
        CheckKind::ThinNecks,
        &words,
        Some(found.necks.len() as f64),
        Limit::at_most(0.0, ""),
    );
    [
        features.at(longest.map(name_place)),
        necks.at(found.necks.first().map(name_place)),
    ]
}

/// Returns a place as it is typed, in the model's frame.
fn name_place(place: &ThinPlace) -> String {
    let [x, y, z] = [place.at.x, place.at.y, place.at.z];
    format!("{x:.1},{y:.1},{z:.1} mm")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    fn place(length_mm: f64) -> ThinPlace {
        ThinPlace {
            at: Point::new(1.0, 2.0, 3.04),
            length_mm,
        }
    }

    fn features(lost: &[f64], ends: &[f64], necks: &[f64]) -> ThinFeatures {
        let places = |lengths: &[f64]| lengths.iter().map(|&mm| place(mm)).collect();
        ThinFeatures {
            wall_mm: 0.6,
            lost: places(lost),
            ends: places(ends),
            necks: places(necks),
        }
    }

    #[test]
    fn a_long_thin_feature_breaks_a_promise_and_its_place_is_said() {
        let [broken, _] = thin_checks(&features(&[4.0, 2.0], &[1.0], &[]));
        assert!(!broken.pass);
        assert_eq!(broken.value, Some(4.0));
        assert_eq!(broken.detail.as_deref(), Some("1.0,2.0,3.0 mm"));
        let [kept, necks] = thin_checks(&features(&[], &[1.7], &[]));
        assert!(kept.pass && necks.pass);
        assert_eq!(kept.value, Some(1.7));
    }

    #[test]
    fn a_thin_neck_breaks_a_promise() {
        let [kept, broken] = thin_checks(&features(&[], &[], &[9.0]));
        assert!(kept.pass && !broken.pass);
    }
}
