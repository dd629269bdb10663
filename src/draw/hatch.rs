//! The hatching of cut faces. The stripes of printed material, hardware and ballast run in
//! different directions, so that they differ in grey print and to every colour vision.

use super::palette::{
    BALLAST, CROSSED, Color, DENSE, HARDWARE, HATCH, RODS, SECTION, SPARSE, VOID, mix,
};
use super::svg::{Drawing, Paint, Spot, Stroke};

/// Period of the stripes in samples of a shaded picture, and how many of them are stripe: finer
/// stripes merge in print.
const PERIOD_SAMPLES: [usize; 2] = [14, 4];

/// Period of the stripes in pixels of a line drawing: finer stripes hide small pins, coarser ones
/// miss thin walls.
const PERIOD_PX: f64 = 13.0;

/// Width of a stripe of a line drawing, pixels.
const STRIPE_PX: f64 = 1.2;

/// The direction of stripes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stripes {
    /// From the lower left to the upper right.
    Up,
    /// From the upper left to the lower right.
    Down,
    /// Both directions.
    Crossed,
}

/// The filling of a cut face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hatch {
    /// The ground in a shaded picture, the stripes in a line drawing.
    pub dark: Color,
    /// The stripes in a shaded picture, the ground in a line drawing.
    pub pale: Color,
    /// The direction of the stripes.
    pub stripes: Stripes,
}

impl Hatch {
    /// Printed material.
    pub const PRINTED: Self = Self {
        dark: SECTION,
        pale: HATCH,
        stripes: Stripes::Up,
    };
    /// Sparse infill.
    pub const SPARSE: Self = Self {
        dark: SPARSE,
        pale: VOID,
        stripes: Stripes::Crossed,
    };
    /// Axles, tips, stems and dowels.
    pub const RODS: Self = Self {
        dark: HARDWARE,
        pale: RODS,
        stripes: Stripes::Down,
    };
    /// Ballast.
    pub const BALLAST: Self = Self {
        dark: CROSSED,
        pale: BALLAST,
        stripes: Stripes::Crossed,
    };

    /// Returns the filling of one of several densities of infill: 0 for the sparsest of them, 1 for
    /// the densest.
    pub fn infill(share: f64) -> Self {
        Self {
            dark: mix(SPARSE, DENSE, share),
            ..Self::SPARSE
        }
    }

    /// Returns the colour of the sample of a shaded picture at this place to the right and down.
    pub fn color_at(&self, [x, y]: [usize; 2]) -> Color {
        let [period, wide] = PERIOD_SAMPLES;
        let up = (x + y) % period < wide;
        let down = (x + period - y % period) % period < wide;
        let is_stripe = match self.stripes {
            Stripes::Up => up,
            Stripes::Down => down,
            Stripes::Crossed => up || down,
        };
        if is_stripe { self.pale } else { self.dark }
    }

    /// Fills closed lines of a drawing by the even-odd rule, and draws their outline.
    pub fn fill(&self, drawing: &mut Drawing, rings: &[Vec<Spot>], outline: Stroke) {
        drawing.path(rings, true, Paint::filled(self.pale, Stroke::NONE));
        let ways: &[f64] = match self.stripes {
            Stripes::Up => &[1.0],
            Stripes::Down => &[-1.0],
            Stripes::Crossed => &[1.0, -1.0],
        };
        let stripes: Vec<Vec<Spot>> = ways
            .iter()
            .flat_map(|way| clip_lines(rings, *way))
            .collect();
        let paint = Paint::line(Stroke::solid(self.dark, STRIPE_PX));
        drawing.path(&stripes, false, paint);
        drawing.path(rings, true, Paint::line(outline));
    }
}

/// Returns the segments of the lines x + way·y = k · period that lie inside closed lines, by the
/// even-odd rule.
fn clip_lines(rings: &[Vec<Spot>], way: f64) -> Vec<Vec<Spot>> {
    let step = PERIOD_PX * std::f64::consts::SQRT_2;
    let across = |[x, y]: Spot| (x + way * y) / step;
    let all = || rings.iter().flatten().map(|spot| across(*spot));
    let (low, high) = all().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), at| {
        (l.min(at), h.max(at))
    });
    if low > high {
        return Vec::new();
    }
    let lines = low.ceil() as i64..=high.floor() as i64;
    let on_line = |line: i64| {
        let at = line as f64;
        let mut crossings: Vec<Spot> = sides(rings)
            .filter(|(a, b)| (across(*a) <= at) != (across(*b) <= at))
            .map(|(a, b)| between(a, b, (at - across(a)) / (across(b) - across(a))))
            .collect();
        crossings.sort_by(|a, b| a[0].total_cmp(&b[0]));
        crossings
            .chunks_exact(2)
            .map(<[Spot]>::to_vec)
            .collect::<Vec<_>>()
    };
    lines.flat_map(on_line).collect()
}

fn sides(rings: &[Vec<Spot>]) -> impl Iterator<Item = (Spot, Spot)> + '_ {
    rings.iter().flat_map(|ring| {
        ring.iter()
            .zip(ring.iter().cycle().skip(1))
            .map(|(a, b)| (*a, *b))
    })
}

fn between(a: Spot, b: Spot, share: f64) -> Spot {
    [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<Spot> {
        vec![[low, low], [high, low], [high, high], [low, high]]
    }

    /// Returns the total length of the stripes.
    fn length(stripes: &[Vec<Spot>]) -> f64 {
        stripes
            .iter()
            .map(|ends| (ends[0][0] - ends[1][0]).hypot(ends[0][1] - ends[1][1]))
            .sum()
    }

    #[test]
    fn stripes_lie_in_the_material_a_period_apart() {
        let rings = [square(0.0, 400.0), square(100.0, 300.0)];
        for way in [1.0, -1.0] {
            let found = clip_lines(&rings, way);
            // Lines a period apart have a total length of area over period; one line more or less
            // at either end is 1 % of that.
            let expected = (400.0 * 400.0 - 200.0 * 200.0) / PERIOD_PX;
            assert!((length(&found) / expected - 1.0).abs() < 0.02);
            let middle = |ends: &Vec<Spot>| between(ends[0], ends[1], 0.5);
            let is_in_hole =
                |[x, y]: Spot| (100.0..300.0).contains(&x) && (100.0..300.0).contains(&y);
            assert!(found.iter().all(|ends| !is_in_hole(middle(ends))));
        }
    }

    #[test]
    fn material_rods_and_ballast_differ_in_the_direction_of_their_stripes() {
        let of = |hatch: Hatch| {
            let place = |index: usize| [index % 28, index / 28];
            (0..28 * 28)
                .map(|index| hatch.color_at(place(index)) == hatch.pale)
                .collect::<Vec<bool>>()
        };
        let [printed, rods, ballast] = [Hatch::PRINTED, Hatch::RODS, Hatch::BALLAST].map(of);
        let count = |all: &[bool]| all.iter().filter(|is| **is).count();
        assert!(
            printed != rods && count(&printed) == count(&rods) && count(&ballast) > count(&rods)
        );
        // Up stripes repeat one sample right and one up, down stripes one right and one down.
        let is_repeated =
            |i: usize| printed[29 + i] == printed[56 + i] && rods[28 + i] == rods[57 + i];
        assert!((0..26).all(is_repeated));
    }

    #[test]
    fn no_rings_have_no_stripes() {
        assert!(clip_lines(&[], 1.0).is_empty());
    }
}
