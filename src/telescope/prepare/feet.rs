//! The sizes of feet, of one telescope and of a figure alike.

use crate::job::telescope::FootSize;
use crate::printer::Printer;
use crate::telescope::sizes::JointSizes;

/// Step in which the radius of a foot grows, mm.
pub const STEP_MM: f64 = 1.0;

/// Height of a foot in walls, and the least, mm: thinner discs curl.
const HEIGHT_WALLS: f64 = 2.0;
const LEAST_HEIGHT_MM: f64 = 3.0;

/// Room of the plate that is left free around a foot, mm.
const PLATE_ROOM_MM: f64 = 2.0;

/// The greatest foot for a printer whose plate is not known, mm.
const MOST_MM: f64 = 100.0;

/// Angle beyond what is promised for which a foot is chosen, degrees: rounding of files.
const SPARE_DEG: f64 = 0.1;

/// Returns the height of a foot, mm.
pub fn height_mm(sizes: &JointSizes) -> f64 {
    LEAST_HEIGHT_MM.max(HEIGHT_WALLS * sizes.wall_mm)
}

/// Returns the radius of the greatest foot that can be printed, mm.
pub fn most_mm(printer: &Printer) -> f64 {
    let room = printer.usable_volume_mm();
    room.map_or(MOST_MM, |[x, y, _]| 0.5 * x.min(y) - PLATE_ROOM_MM)
}

/// Returns the least radius beside a body of this radius, mm.
pub fn first_mm(body_mm: f64) -> f64 {
    (body_mm + STEP_MM).ceil()
}

/// Returns the radii to try, mm: the one that was ordered, or all between two, the least first.
pub fn radii_mm(ordered: FootSize, [first_mm, most_mm]: [f64; 2]) -> Vec<f64> {
    if let FootSize::Given(radius) = ordered {
        return vec![radius.mm()];
    }
    let radii = std::iter::successors(Some(first_mm), |mm| Some(mm + STEP_MM));
    radii.take_while(|mm| *mm <= most_mm).collect()
}

/// Returns the angle for which a foot is chosen, degrees. One that was ordered needs no room for
/// rounding.
pub fn wanted_deg(ordered: FootSize, least_deg: f64) -> f64 {
    match ordered {
        FootSize::Given(_) => least_deg,
        FootSize::Auto => least_deg + SPARE_DEG,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::units::Length;

    #[test]
    fn radii_go_from_the_least_to_the_greatest_in_whole_steps_unless_one_is_ordered() {
        assert_eq!(radii_mm(FootSize::Auto, [8.0, 10.5]), [8.0, 9.0, 10.0]);
        assert!(radii_mm(FootSize::Auto, [8.0, 7.5]).is_empty());
        let ordered = FootSize::Given(Length::from_mm(4.5).unwrap());
        assert_eq!(radii_mm(ordered, [8.0, 10.0]), [4.5]);
        assert_eq!(wanted_deg(ordered, 5.0), 5.0);
        assert!(wanted_deg(FootSize::Auto, 5.0) > 5.0);
        assert_eq!(first_mm(7.2), 9.0);
    }
}
