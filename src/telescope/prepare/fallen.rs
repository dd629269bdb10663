//! Poses of a telescope that is to stand: it does so on the way there, too.

use super::asked::Asked;
use super::made::Made;
use super::posing::{ChainPoses, Posed};
use super::sheet::standing;
use super::unposed::Unposed;
use crate::telescope::motion::Opening;

/// Returns the answer that the way to a pose topples, or reaches below the foot; `None` if none
/// does, or if it need not stand.
pub fn find_fallen(asked: &Asked, made: &Made, poses: &ChainPoses) -> Option<Unposed> {
    if !asked.stands() {
        return None;
    }
    poses
        .posed
        .iter()
        .find_map(|posed| fall(asked, made, posed))
}

fn fall(asked: &Asked, made: &Made, posed: &Posed) -> Option<Unposed> {
    let design = &made.best.design;
    let way = Opening {
        keys: posed
            .keys
            .iter()
            .filter_map(|key| key.first())
            .cloned()
            .collect(),
        ..design.opening.clone()
    };
    let standing = standing(&design.telescope, made);
    let name = &posed.name;
    let lowest = standing.lowest_over(&way);
    let below = lowest.filter(|lowest| !standing.is_clear(lowest));
    let least_deg = asked.job.least_angle_deg;
    let angle_deg = standing.worst(&way).1.sagged_rad.to_degrees();
    let reason = match below {
        Some(lowest) => format!(
            "on the way to pose {name}, shell {} reaches {:.1} mm below the foot",
            lowest.shell + 1,
            -lowest.height_mm - standing.foot.height_mm
        ),
        None if angle_deg < least_deg => format!(
            "on the way to pose {name} it topples when leaned by {angle_deg:.1}°, and {least_deg}° \
             are promised"
        ),
        None => return None,
    };
    Some(Unposed {
        reason,
        is_proved: false,
        remedies: Vec::new(),
        hints: vec!["ask for another pose, for a larger foot, or for no stand".to_owned()],
    })
}
