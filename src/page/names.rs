//! Places for names on a drawing, so that none lies over another.

use crate::draw::Spot;

/// Width of a letter, heights of the words.
const LETTER_TEXTS: f64 = 0.62;

/// Number of ways from a spot in which a name is tried.
const WAYS: usize = 16;

/// Names are wider than high, so that they stand farther off to the sides.
const SIDEWAYS: f64 = 1.3;

/// Distances at which a name is tried, as multiples of the wished one.
const AWAY: [f64; 4] = [1.0, 1.6, 2.2, 3.0];

/// The upright boxes that names and pins fill.
pub(super) struct Names {
    width_px: f64,
    text_px: f64,
    taken: Vec<[Spot; 2]>,
}

impl Names {
    /// Returns an empty drawing of this width, with words of this height, pixels.
    pub(super) fn new(width_px: f64, text_px: f64) -> Self {
        Self {
            width_px,
            text_px,
            taken: Vec::new(),
        }
    }

    /// Keeps the place of a circle free of names.
    pub(super) fn keep_clear(&mut self, [x, y]: Spot, radius_px: f64) {
        let low = [x - radius_px, y - radius_px];
        self.taken.push([low, [x + radius_px, y + radius_px]]);
    }

    /// Places a name at a spot, or near it if that is taken. Returns the middle of the name.
    pub(super) fn place_at(&mut self, spot: Spot, name: &str) -> Spot {
        let around = self.around(spot, self.text_px, [0.0, -1.0]);
        self.take(std::iter::once(spot).chain(around).collect(), name)
    }

    /// Places a name at a distance from a spot, as near to a unit way as is free. Returns the
    /// middle of the name.
    pub(super) fn place_beside(&mut self, spot: Spot, away_px: f64, way: Spot, name: &str) -> Spot {
        let around = self.around(spot, away_px, way);
        self.take(around, name)
    }

    /// Returns places around a spot, from a way to both sides and to the other side.
    fn around(&self, [x, y]: Spot, away_px: f64, [right, down]: Spot) -> Vec<Spot> {
        let turn = |number: usize| {
            let steps = number.div_ceil(2) as f64;
            let sign = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
            sign * steps * std::f64::consts::TAU / WAYS as f64
        };
        let ways = |times: f64| (0..WAYS).map(move |number| (times * away_px, number));
        let spot = |(away_px, number): (f64, usize)| {
            let (sin, cos) = turn(number).sin_cos();
            let way = [right * cos - down * sin, right * sin + down * cos];
            let at = [x + SIDEWAYS * away_px * way[0], y + away_px * way[1]];
            let most = (self.width_px - self.text_px).max(self.text_px);
            [at[0].clamp(self.text_px, most), at[1].max(self.text_px)]
        };
        AWAY.into_iter().flat_map(ways).map(spot).collect()
    }

    /// Takes the first of some places that overlaps least with what is there.
    fn take(&mut self, places: Vec<Spot>, name: &str) -> Spot {
        let letters = name.chars().count() as f64;
        let half = [
            0.5 * LETTER_TEXTS * letters * self.text_px,
            0.5 * self.text_px,
        ];
        let box_at = |[x, y]: Spot| [[x - half[0], y - half[1]], [x + half[0], y + half[1]]];
        let overlap = |place: &Spot| {
            let taken = self.taken.iter();
            taken
                .map(|other| overlap_px2(&box_at(*place), other))
                .sum::<f64>()
        };
        let best = places.into_iter().map(|place| (overlap(&place), place));
        let best = best.min_by(|a, b| a.0.total_cmp(&b.0));
        let place = best.map_or([self.text_px; 2], |(_, place)| place);
        self.taken.push(box_at(place));
        place
    }
}

/// Returns the common area of two boxes, square pixels.
fn overlap_px2(a: &[Spot; 2], b: &[Spot; 2]) -> f64 {
    let side = |axis: usize| a[1][axis].min(b[1][axis]) - a[0][axis].max(b[0][axis]);
    side(0).max(0.0) * side(1).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_goes_where_it_is_wished_if_that_is_free() {
        let mut names = Names::new(400.0, 20.0);
        assert_eq!(names.place_at([200.0, 200.0], "V1"), [200.0, 200.0]);
        let beside = names.place_beside([100.0, 100.0], 30.0, [0.0, -1.0], "N1");
        assert_eq!(beside, [100.0, 70.0]);
    }

    #[test]
    fn names_at_one_spot_do_not_overlap() {
        let mut names = Names::new(400.0, 20.0);
        names.keep_clear([200.0, 200.0], 12.0);
        let places = ["V1", "N1", "N2"].map(|name| names.place_at([200.0, 200.0], name));
        assert_eq!(names.taken.len(), 4);
        for (index, one) in names.taken.iter().enumerate() {
            for other in &names.taken[..index] {
                assert_eq!(overlap_px2(one, other), 0.0, "{places:?}");
            }
        }
    }

    #[test]
    fn names_stay_on_the_drawing() {
        let mut names = Names::new(100.0, 20.0);
        let corner = names.place_beside([2.0, 2.0], 30.0, [-1.0, 0.0], "N1");
        assert!(corner[0] >= 20.0 && corner[1] >= 20.0, "{corner:?}");
    }
}
