//! The things of a kit laid out on as many plates as they need.

use super::{Plate, Printer, Spot};

/// A plate with the things on it.
#[derive(Debug, Clone, PartialEq)]
pub struct LaidPlate {
    /// Name of its file in a kit, such as `plate_2.3mf`.
    pub file: String,
    /// Its number from 1, and the number of plates.
    pub number_of: [usize; 2],
    /// Width and depth, mm; `None` if the machine's plate is not known.
    pub size_mm: Option<[f64; 2]>,
    /// Indices of the things on it, with the place of each.
    pub spots: Vec<(usize, Spot)>,
}

impl LaidPlate {
    /// Returns whether all that lies on it fits; `None` if the machine's plate is not known.
    pub fn fits(&self) -> Option<bool> {
        self.size_mm
            .map(|_| self.spots.iter().all(|(_, spot)| spot.fits))
    }
}

impl Printer {
    /// Lays things of these widths and depths, mm, on plates as [`Plate::arrange`] does.
    pub fn lay_out(&self, sizes_mm: &[[f64; 2]]) -> Vec<LaidPlate> {
        let known = self.plate();
        let size_mm = known.as_ref().map(Plate::size_mm);
        let bed = known.unwrap_or_else(|| Plate::for_parts(sizes_mm));
        let spots = bed.arrange(sizes_mm);
        let count = spots.iter().map(|spot| spot.plate + 1).max().unwrap_or(0);
        let plate = |plate: usize| {
            let all = spots.iter().copied().enumerate();
            let mut here: Vec<(usize, Spot)> =
                all.filter(|(_, spot)| spot.plate == plate).collect();
            bed.center(&mut here, sizes_mm);
            LaidPlate {
                file: Plate::file_name([plate + 1, count]),
                number_of: [plate + 1, count],
                size_mm,
                spots: here,
            }
        };
        (0..count).map(plate).collect()
    }
}
