//! The request for cuts and pins of a placed goal.

use crate::base::watch::{Cancelled, Watch};
use crate::cut::{GoalAxis, PinSettings, PlanRequest, Seams};
use crate::geom::Vector;
use crate::goal::GoalKind;
use crate::run::{AxisChoice, Placed};

/// Returns what cuts, pins and parts must keep to for this job on its printer. Looks at the outside
/// of the model, which takes some tenths of a second.
///
/// # Errors
/// The watch was stopped.
pub fn request(placed: &Placed, watch: &Watch) -> Result<PlanRequest, Cancelled> {
    let frame = &placed.goal().frame;
    let axis = GoalAxis {
        point: frame.origin,
        direction: frame.axis(),
    };
    let size_mm = placed.solid().mesh().longest_side_mm();
    let usual = PlanRequest::for_printer(&placed.shop.printer, size_mm, axis);
    let outer = placed.solid().mesh();
    let seen = Seams::look(placed.job.seam, outer, &natural_up(placed), watch)?;
    let looked_at = match placed.goal().kind {
        GoalKind::Stand => seen.on_feet(&axis.direction),
        _ => seen,
    };
    Ok(PlanRequest {
        pins: PinSettings {
            spread_ratio: placed.policy.pin_spread_ratio,
            ..usual.pins
        },
        worth_ratio: placed.policy.cut_worth_ratio,
        rods: placed.shop.rods.clone(),
        labels: usual.labels.filter(|_| placed.job.ids.is_engraved()),
        seams: Seams {
            keep_clear: placed.job.keep_clear.clone(),
            ..looked_at
        },
        least_part: placed.job.least_part,
        watch: watch.clone(),
        ..usual
    })
}

/// Returns up as the object stands by itself, or as the job has it.
fn natural_up(placed: &Placed) -> Vector {
    let natural = match &placed.choice {
        Some(AxisChoice::Natural(natural) | AxisChoice::NearNatural { natural, .. }) => {
            natural.up.direction()
        }
        _ => None,
    };
    natural
        .unwrap_or_else(|| placed.goal().frame.axis())
        .normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::rods;
    use crate::geom::{Point, Vector};
    use crate::job::IdStyle;
    use crate::open::scenes::{thick_box, unwatched};

    #[test]
    fn cuts_keep_to_the_goals_axis_the_policy_and_the_shops_rods() {
        let mut placed = thick_box();
        placed.policy.cut_worth_ratio = 0.07;
        placed.shop.rods = rods().unwrap();
        let request = unwatched(&placed);
        assert_eq!(request.worth_ratio, 0.07);
        assert_eq!(request.rods, placed.shop.rods);
        // The middle of the foot, and up.
        let middle = Point::new(10.0, 10.0, 0.0);
        assert!((request.axis.point - middle).norm() < 1e-9);
        assert_eq!(request.axis.direction, Vector::z());
        assert_eq!(request.min_opening_mm, 3.0);
    }

    #[test]
    fn ids_are_sunk_into_cut_faces_only_if_the_job_says_so() {
        let mut placed = thick_box();
        for (ids, is_engraved) in [(IdStyle::None, false), (IdStyle::Engraved, true)] {
            placed.job.ids = ids;
            assert_eq!(unwatched(&placed).labels.is_some(), is_engraved);
        }
    }

    #[test]
    fn the_button_of_a_run_stops_its_plans() {
        let placed = thick_box();
        let watch = Watch::silent();
        let request = request(&placed, &watch).unwrap();
        watch.cancel();
        assert!(request.watch.is_cancelled());
    }
}
