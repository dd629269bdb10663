//! The room of a printer for a part: its build volume without the excluded corners, within the
//! limits of its largest part.

use super::{Printer, Quantity};

impl Printer {
    /// Returns width, depth and height of the usable build volume, mm of the model; `None` if the
    /// build volume is not known.
    ///
    /// It is the largest upright box of the build volume that keeps clear of the excluded corners.
    /// No side is longer than that of the largest part.
    pub fn usable_volume_mm(&self) -> Option<[f64; 3]> {
        let [width, depth, height] = self.build_volume_mm.as_ref()?.value;
        let [x, y] = self.clear_rectangle_mm([width, depth]);
        let largest = self
            .largest_part_mm
            .as_ref()
            .map_or([f64::INFINITY; 3], |largest| largest.value);
        let scale = self.print_scale_ratio();
        let room = [x.min(largest[0]), y.min(largest[1]), height.min(largest[2])];
        Some([room[0] / scale[0], room[1] / scale[1], room[2] / scale[2]])
    }

    /// Returns the scale of written files along x, y and z that gives shrunken parts their nominal
    /// size.
    ///
    /// It differs from 1 only if the profile states a shrinkage and says that the machine does not
    /// compensate it.
    pub fn print_scale_ratio(&self) -> [f64; 3] {
        let is_uncompensated = self
            .compensates_shrinkage
            .as_ref()
            .is_some_and(|flag| !flag.value);
        let scale = |quantity: Quantity| {
            let shrinkage = self
                .number(quantity)
                .filter(|_| is_uncompensated)
                .map_or(0.0, |number| number.value);
            1.0 / (1.0 - shrinkage)
        };
        let [across, up] = [Quantity::ShrinkageXyRatio, Quantity::ShrinkageZRatio].map(scale);
        [across, across, up]
    }

    /// Returns the sides of the largest rectangle of the plate that no excluded corner overlaps,
    /// mm.
    fn clear_rectangle_mm(&self, plate_mm: [f64; 2]) -> [f64; 2] {
        let ends = |axis: usize| {
            let sizes = self
                .excluded_corners
                .iter()
                .map(|corner| corner.size_mm.value[axis]);
            let sizes: Vec<f64> = std::iter::once(0.0).chain(sizes).collect();
            let low = sizes.clone();
            low.into_iter().flat_map(move |low| {
                sizes
                    .clone()
                    .into_iter()
                    .map(move |high| [low, plate_mm[axis] - high])
            })
        };
        let mut best = [0.0; 2];
        for [left, right] in ends(0) {
            for [front, back] in ends(1) {
                let sides = [right - left, back - front];
                let rectangle = [[left, front], [right, back]];
                let is_clear = !self
                    .excluded_corners
                    .iter()
                    .any(|corner| corner.overlaps(rectangle, plate_mm));
                if is_clear
                    && sides[0] > 0.0
                    && sides[1] > 0.0
                    && sides[0] * sides[1] > best[0] * best[1]
                {
                    best = sides;
                }
            }
        }
        best
    }

    /// True if a part of that size fits as it lies, or turned by a right angle on the plate; `None`
    /// if the build volume is not known.
    pub fn fits(&self, size_mm: [f64; 3]) -> Option<bool> {
        let [width, depth, height] = self.usable_volume_mm()?;
        let fits = |x: f64, y: f64| x <= width && y <= depth && size_mm[2] <= height;
        Some(fits(size_mm[0], size_mm[1]) || fits(size_mm[1], size_mm[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::{Corner, ExcludedCorner, Sourced, Sure};

    fn sourced<T>(value: T) -> Sourced<T> {
        Sourced {
            value,
            source: "test".into(),
            sure: Sure::Read,
            process_default_of: None,
        }
    }

    #[test]
    fn a_part_may_be_turned_on_the_plate_but_not_stood_on_end() {
        let form4 = Printer::find("formlabs-form4").unwrap();
        assert_eq!(form4.fits([120.0, 199.0, 210.0]), Some(true));
        assert_eq!(form4.fits([126.0, 126.0, 1.0]), Some(false));
        assert_eq!(form4.fits([10.0, 10.0, 211.0]), Some(false));
        assert_eq!(
            Printer::find("objet-connex350")
                .unwrap()
                .fits([1.0, 1.0, 1.0]),
            None
        );
    }

    #[test]
    fn an_excluded_corner_costs_the_strip_of_least_area() {
        let mut printer = Printer::find("formlabs-form4").unwrap();
        printer.build_volume_mm = Some(sourced([256.0, 256.0, 250.0]));
        let corner = |corner, x, y| ExcludedCorner {
            corner,
            size_mm: sourced([x, y]),
        };
        printer.excluded_corners = vec![corner(Corner::FrontLeft, 18.0, 28.0)];
        assert_eq!(printer.usable_volume_mm(), Some([238.0, 256.0, 250.0]));
        // A corner at the back right would cost 18 mm of width once more; both together cost less
        // depth: 256 − 28 − 6.
        printer
            .excluded_corners
            .push(corner(Corner::BackRight, 30.0, 6.0));
        assert_eq!(printer.usable_volume_mm(), Some([238.0, 250.0, 250.0]));
        printer.largest_part_mm = Some(sourced([300.0, 200.0, 240.0]));
        assert_eq!(printer.usable_volume_mm(), Some([238.0, 200.0, 240.0]));
    }

    #[test]
    fn files_are_nominal_unless_the_machine_does_not_compensate_shrinkage() {
        let mut printer = Printer::find("formlabs-form4").unwrap();
        printer
            .optional_numbers
            .insert(Quantity::ShrinkageXyRatio, sourced(0.02));
        assert_eq!(printer.print_scale_ratio(), [1.0; 3]);
        printer.compensates_shrinkage = Some(sourced(true));
        assert_eq!(printer.print_scale_ratio(), [1.0; 3]);
        printer.compensates_shrinkage = Some(sourced(false));
        assert_eq!(printer.print_scale_ratio(), [1.0 / 0.98, 1.0 / 0.98, 1.0]);
        let room = printer.usable_volume_mm().unwrap();
        assert!(
            (room[0] - 196.0).abs() < 1e-12 && room[2] == 210.0,
            "{room:?}"
        );
    }

    #[test]
    fn corners_that_cover_the_whole_plate_leave_no_room() {
        let mut printer = Printer::find("formlabs-form4").unwrap();
        printer.excluded_corners = vec![ExcludedCorner {
            corner: Corner::BackLeft,
            size_mm: sourced([200.0, 125.0]),
        }];
        assert_eq!(printer.fits([1.0, 1.0, 1.0]), Some(false));
    }
}
