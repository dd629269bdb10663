//! The build plate, and the arrangement of a kit's parts on plates.

use super::{ExcludedCorner, Printer};

/// A build plate seen from above, its front left corner at (0, 0), mm of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct Plate {
    /// Width and depth, mm.
    size_mm: [f64; 2],
    /// Corners that must stay free.
    corners: Vec<ExcludedCorner>,
    /// Gap between parts, mm.
    gap_mm: f64,
}

/// The place of a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// Index of its plate, from 0.
    pub plate: usize,
    /// Front left corner of its bounding box, mm.
    pub low_mm: [f64; 2],
    /// True if it is turned by a right angle.
    pub is_turned: bool,
    /// True if it lies on the plate entirely, clear of the excluded corners.
    pub fits: bool,
}

/// Gap between parts, mm. Closer parts fuse or cannot be taken off one by one; with a wider gap,
/// fewer fit.
const GAP_MM: f64 = 5.0;
/// Gap between filament parts, mm: room for the brims of both.
const BRIM_GAP_MM: f64 = 12.0;
/// The process whose parts may have brims.
const FILAMENT: &str = "fdm";
/// Assumed width of a plate of unknown size over the square root of the parts' area: above 1, as
/// shelves leave gaps.
const WIDTH_RATIO: f64 = 1.3;

impl Printer {
    /// Returns the whole build plate; `None` if the build volume is not known.
    pub fn plate(&self) -> Option<Plate> {
        let [width, depth, _] = self.build_volume_mm.as_ref()?.value;
        Some(Plate {
            size_mm: [width, depth],
            corners: self.excluded_corners.clone(),
            gap_mm: match self.process.as_deref() {
                Some(FILAMENT) => BRIM_GAP_MM,
                _ => GAP_MM,
            },
        })
    }
}

/// A row of parts on a plate.
struct Shelf {
    plate: usize,
    /// The y of its front edge.
    front_mm: f64,
    depth_mm: f64,
    /// The x from which it is free.
    free_from_mm: f64,
}

/// Stem and ending of the names of plates in a kit.
const NAME: [&str; 2] = ["plate", ".3mf"];

impl Plate {
    /// Returns the name in a kit of one of several plates, counted from 1.
    pub fn file_name([plate, count]: [usize; 2]) -> String {
        let [stem, ending] = NAME;
        if count == 1 {
            format!("{stem}{ending}")
        } else {
            format!("{stem}_{plate}{ending}")
        }
    }

    /// Returns whether [`Plate::file_name`] gives this name to some plate.
    pub fn is_file_name(name: &str) -> bool {
        let [stem, ending] = NAME;
        let middle = name
            .strip_prefix(stem)
            .and_then(|rest| rest.strip_suffix(ending));
        let is_number = |number: &str| number.parse().is_ok_and(|plate: usize| plate > 0);
        middle.is_some_and(|middle| {
            middle.is_empty() || middle.strip_prefix('_').is_some_and(is_number)
        })
    }

    /// Returns the width and the depth, mm.
    pub fn size_mm(&self) -> [f64; 2] {
        self.size_mm
    }

    /// Assumes a plate that holds parts of these sizes, for a machine whose plate is not known.
    /// The arrangement comes out about as wide as deep.
    pub fn for_parts(sizes_mm: &[[f64; 2]]) -> Self {
        let area: f64 = sizes_mm
            .iter()
            .map(|size| (size[0] + GAP_MM) * (size[1] + GAP_MM))
            .sum();
        let widest = sizes_mm.iter().map(|size| size[0]).fold(0.0, f64::max);
        let width = (area.sqrt() * WIDTH_RATIO).max(widest);
        let depth = sizes_mm.iter().map(|size| size[1] + GAP_MM).sum();
        Self {
            size_mm: [width, depth],
            corners: Vec::new(),
            gap_mm: GAP_MM,
        }
    }

    /// Places parts of these widths and depths on as many plates as they need; the spots are in the
    /// order of the parts.
    ///
    /// First fit by shelves, the deepest part first (Coffman, Garey, Johnson and Tarjan 1980). A
    /// part is turned only if it does not fit otherwise. A part that fits no plate has one of its
    /// own. The result is deterministic.
    pub fn arrange(&self, sizes_mm: &[[f64; 2]]) -> Vec<Spot> {
        let mut order: Vec<usize> = (0..sizes_mm.len()).collect();
        let depth_mm = |part: usize| self.choose_turn(sizes_mm[part]).0[1];
        order.sort_by(|&a, &b| depth_mm(b).total_cmp(&depth_mm(a)));
        let (mut shelves, mut spots) = (Vec::new(), vec![None; sizes_mm.len()]);
        for part in order {
            spots[part] = Some(self.place(&mut shelves, sizes_mm[part]));
        }
        spots.into_iter().flatten().collect()
    }

    /// Moves the things of one plate together, so that they lie in its middle. They stay where they
    /// are if one would then lie on an excluded corner, or if one does not fit.
    pub fn center(&self, spots: &mut [(usize, Spot)], sizes_mm: &[[f64; 2]]) {
        let placed = |(index, spot): &(usize, Spot)| {
            let [x, y] = sizes_mm[*index];
            (spot.low_mm, if spot.is_turned { [y, x] } else { [x, y] })
        };
        let boxes: Vec<([f64; 2], [f64; 2])> = spots.iter().map(placed).collect();
        let shift: [f64; 2] = std::array::from_fn(|axis| {
            let ends = boxes.iter().map(|(low, size)| low[axis] + size[axis]);
            let starts = boxes.iter().map(|(low, _)| low[axis]);
            let (first, last) = (
                starts.fold(f64::INFINITY, f64::min),
                ends.fold(0.0, f64::max),
            );
            0.5 * (self.size_mm[axis] - last - first)
        });
        let moved = |low: [f64; 2]| [low[0] + shift[0], low[1] + shift[1]];
        let all_free = boxes
            .iter()
            .all(|(low, size)| self.is_free(moved(*low), *size));
        if all_free {
            for (_, spot) in spots {
                spot.low_mm = moved(spot.low_mm);
            }
        }
    }

    /// Returns the size of a part as placed, and whether it is turned: only if it fits no other
    /// way.
    fn choose_turn(&self, [x, y]: [f64; 2]) -> ([f64; 2], bool) {
        let fits = |size| self.shelf_start(size, 0.0).is_some();
        let is_turned = !fits([x, y]) && fits([y, x]);
        (if is_turned { [y, x] } else { [x, y] }, is_turned)
    }

    /// Places a part on the first shelf with room, else on a new shelf behind the last, else on a
    /// new plate.
    fn place(&self, shelves: &mut Vec<Shelf>, size_mm: [f64; 2]) -> Spot {
        let (size, is_turned) = self.choose_turn(size_mm);
        let spot = |plate, low_mm, fits| Spot {
            plate,
            low_mm,
            is_turned,
            fits,
        };
        for shelf in shelves.iter_mut().filter(|shelf| size[1] <= shelf.depth_mm) {
            if let Some(left) = self.leftmost([shelf.free_from_mm, shelf.front_mm], size) {
                shelf.free_from_mm = left + size[0] + self.gap_mm;
                return spot(shelf.plate, [left, shelf.front_mm], true);
            }
        }
        let last = shelves.last();
        let behind = last.map(|shelf| (shelf.plate, shelf.front_mm + shelf.depth_mm + self.gap_mm));
        let found = behind.and_then(|(plate, front)| Some((plate, self.shelf_start(size, front)?)));
        let next_plate = last.map_or(0, |shelf| shelf.plate + 1);
        let (plate, low) =
            found.unwrap_or_else(|| (next_plate, self.shelf_start(size, 0.0).unwrap_or_default()));
        let fits = self.is_free(low, size);
        let free_from_mm = if fits {
            low[0] + size[0] + self.gap_mm
        } else {
            f64::INFINITY
        };
        let depth_mm = if fits { size[1] } else { f64::INFINITY };
        shelves.push(Shelf {
            plate,
            front_mm: low[1],
            depth_mm,
            free_from_mm,
        });
        spot(plate, low, fits)
    }

    /// Returns the foremost place, not in front of `front_mm`, at which a new shelf can begin with
    /// a part of that size.
    fn shelf_start(&self, size: [f64; 2], front_mm: f64) -> Option<[f64; 2]> {
        let behind_corners = self
            .corners
            .iter()
            .map(|corner| front_mm.max(corner.size_mm.value[1]));
        let mut fronts: Vec<f64> = std::iter::once(front_mm).chain(behind_corners).collect();
        fronts.sort_by(f64::total_cmp);
        fronts
            .into_iter()
            .find_map(|front| Some([self.leftmost([0.0, front], size)?, front]))
    }

    /// Returns the least x from `from` on at which a part of that size is clear of the corners.
    fn leftmost(&self, [from, front]: [f64; 2], size: [f64; 2]) -> Option<f64> {
        let beside_corners = self
            .corners
            .iter()
            .map(|corner| from.max(corner.size_mm.value[0]));
        let mut lefts: Vec<f64> = std::iter::once(from).chain(beside_corners).collect();
        lefts.sort_by(f64::total_cmp);
        lefts
            .into_iter()
            .find(|&left| self.is_free([left, front], size))
    }

    /// True if a rectangle is on the plate and clear of its corners.
    fn is_free(&self, low: [f64; 2], size: [f64; 2]) -> bool {
        let high = [low[0] + size[0], low[1] + size[1]];
        let is_on = high[0] <= self.size_mm[0] && high[1] <= self.size_mm[1];
        is_on
            && !self
                .corners
                .iter()
                .any(|corner| corner.overlaps([low, high], self.size_mm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::{Corner, Sourced, Sure};

    fn plate(size_mm: [f64; 2], corners: &[(Corner, [f64; 2])]) -> Plate {
        let sourced = |value| Sourced {
            value,
            source: "test".into(),
            sure: Sure::Read,
            process_default_of: None,
        };
        let corners = corners.iter().map(|&(corner, size)| ExcludedCorner {
            corner,
            size_mm: sourced(size),
        });
        Plate {
            size_mm,
            corners: corners.collect(),
            gap_mm: GAP_MM,
        }
    }

    fn box_of(spot: &Spot, [x, y]: [f64; 2]) -> [[f64; 2]; 2] {
        let size = if spot.is_turned { [y, x] } else { [x, y] };
        [
            spot.low_mm,
            [spot.low_mm[0] + size[0], spot.low_mm[1] + size[1]],
        ]
    }

    /// Asserts that the parts lie on the plates, clear of corners and of each other by the gap.
    fn assert_apart(plate: &Plate, sizes: &[[f64; 2]], spots: &[Spot]) {
        for (i, spot) in spots.iter().enumerate() {
            let [low, high] = box_of(spot, sizes[i]);
            assert!(
                spot.fits && plate.is_free(low, [high[0] - low[0], high[1] - low[1]]),
                "{spot:?}"
            );
            for (j, other) in spots
                .iter()
                .enumerate()
                .skip(i + 1)
                .filter(|(_, other)| other.plate == spot.plate)
            {
                let [from, to] = box_of(other, sizes[j]);
                let apart = (0..2)
                    .any(|k| low[k] >= to[k] + GAP_MM - 1e-9 || from[k] >= high[k] + GAP_MM - 1e-9);
                assert!(apart, "{i} {spot:?} and {j} {other:?}");
            }
        }
    }

    #[test]
    fn the_names_of_plates_are_told_from_those_of_parts() {
        for name in [Plate::file_name([1, 1]), Plate::file_name([12, 30])] {
            assert!(Plate::is_file_name(&name), "{name}");
        }
        assert_eq!(Plate::file_name([2, 3]), "plate_2.3mf");
        for name in [
            "plateau.3mf",
            "parts/plate.3mf",
            "plate.stl",
            "plate_0.3mf",
            "assembly.3mf",
        ] {
            assert!(!Plate::is_file_name(name), "{name}");
        }
    }

    #[test]
    fn parts_lie_apart_and_clear_of_the_corners() {
        let free = plate([200.0, 100.0], &[]);
        let cornered = plate(
            [200.0, 100.0],
            &[
                (Corner::FrontLeft, [30.0, 20.0]),
                (Corner::BackRight, [60.0, 15.0]),
            ],
        );
        for seed in 1..40_usize {
            let side = |i: usize| 5.0 + ((i * i * 31 + i * seed * 17) % 60) as f64;
            let sizes: Vec<[f64; 2]> = (0..seed % 13 + 1)
                .map(|i| [side(2 * i), side(2 * i + 1)])
                .collect();
            for plate in [&free, &cornered, &Plate::for_parts(&sizes)] {
                let spots = plate.arrange(&sizes);
                assert_eq!(spots.len(), sizes.len());
                assert_apart(plate, &sizes, &spots);
                assert_eq!(spots, plate.arrange(&sizes));
            }
        }
    }

    #[test]
    fn what_lies_on_a_plate_is_moved_to_its_middle_unless_a_corner_is_in_the_way() {
        let sizes = [[40.0, 20.0], [30.0, 10.0]];
        let centered = |plate: &Plate| {
            let spots = plate.arrange(&sizes).into_iter();
            let mut spots: Vec<(usize, Spot)> = spots.enumerate().collect();
            plate.center(&mut spots, &sizes);
            spots
                .iter()
                .map(|(_, spot)| spot.low_mm)
                .collect::<Vec<_>>()
        };
        // Together they are 75 mm wide and 20 mm deep.
        let free = plate([200.0, 100.0], &[]);
        assert_eq!(centered(&free), [[62.5, 40.0], [107.5, 40.0]]);
        let cornered = plate([200.0, 100.0], &[(Corner::BackRight, [80.0, 60.0])]);
        assert_eq!(centered(&cornered), [[0.0, 0.0], [45.0, 0.0]]);
    }

    #[test]
    fn two_parts_share_a_plate_and_a_third_without_room_gets_the_next() {
        let sizes = [[90.0, 90.0], [90.0, 90.0], [90.0, 90.0]];
        let plates = plate([200.0, 100.0], &[]).arrange(&sizes);
        assert_eq!(
            plates.iter().map(|spot| spot.plate).collect::<Vec<_>>(),
            [0, 0, 1]
        );
    }

    #[test]
    fn a_part_is_turned_only_if_that_helps_and_one_that_fits_nowhere_is_reported() {
        let spots = plate([200.0, 100.0], &[]).arrange(&[
            [90.0, 150.0],
            [150.0, 90.0],
            [10.0, 10.0],
            [300.0, 10.0],
        ]);
        assert_eq!(
            spots.iter().map(|spot| spot.is_turned).collect::<Vec<_>>(),
            [true, false, false, false]
        );
        assert_eq!(
            spots.iter().map(|spot| spot.fits).collect::<Vec<_>>(),
            [true, true, true, false]
        );
        let alone = spots[3].plate;
        assert!(
            spots[..3].iter().all(|spot| spot.plate != alone),
            "{spots:?}"
        );
    }

    #[test]
    fn a_plate_of_unknown_size_holds_everything() {
        let sizes = [[70.0, 20.0], [10.0, 120.0], [30.0, 30.0]];
        let spots = Plate::for_parts(&sizes).arrange(&sizes);
        assert!(
            spots.iter().all(|spot| spot.plate == 0 && spot.fits),
            "{spots:?}"
        );
    }
}
