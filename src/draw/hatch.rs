//! How cut faces are filled: what is printed, hardware and ballast differ in the run of their
//! stripes, so that grey printing and every colour vision tell them apart; and the legend that
//! names them.

use super::palette::{BALLAST, CROSSED, Color, HARDWARE, HATCH, RODS, SECTION, VOID, hex};
use super::svg::{Anchor, Drawing, Spot, Stroke};

/// Samples of a shaded picture from one stripe to the next, and how many of them are stripe: fewer
/// melt together in print.
const PERIOD_SAMPLES: [usize; 2] = [14, 4];

/// Pixels of a line drawing from one stripe to the next: fewer hide small pins, more pass thin
/// walls by.
const PERIOD_PX: f64 = 13.0;

/// How wide a stripe of a line drawing is, pixels.
const STRIPE_PX: f64 = 1.2;

/// Width and height of the samples in a legend, in heights of its words.
const SWATCH_TEXTS: [f64; 2] = [1.6, 0.9];

/// What a letter takes in a legend, in heights of its words: sans-serif letters are about half as
/// wide as high.
const LETTER_TEXTS: f64 = 0.55;

/// How stripes run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Runs {
    /// From the lower left to the upper right.
    Up,
    /// From the upper left to the lower right.
    Down,
    /// Both ways.
    Crossed,
}

/// What a cut face is filled with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hatch {
    /// The ground of a shaded picture, and the stripes of a line drawing.
    pub dark: Color,
    /// The stripes of a shaded picture, and the ground of a line drawing.
    pub pale: Color,
    /// How the stripes run.
    pub runs: Runs,
}

impl Hatch {
    /// What is printed.
    pub const PRINTED: Self = Self {
        dark: SECTION,
        pale: HATCH,
        runs: Runs::Up,
    };
    /// Axles, tips, stems and dowels.
    pub const RODS: Self = Self {
        dark: HARDWARE,
        pale: RODS,
        runs: Runs::Down,
    };
    /// Ballast.
    pub const BALLAST: Self = Self {
        dark: CROSSED,
        pale: BALLAST,
        runs: Runs::Crossed,
    };

    /// The colour of a sample of a shaded picture, by its place to the right and down.
    pub fn color_at(&self, [x, y]: [usize; 2]) -> Color {
        let [period, wide] = PERIOD_SAMPLES;
        let up = (x + y) % period < wide;
        let down = (x + period - y % period) % period < wide;
        let is_stripe = match self.runs {
            Runs::Up => up,
            Runs::Down => down,
            Runs::Crossed => up || down,
        };
        if is_stripe { self.pale } else { self.dark }
    }

    /// Fills closed lines of a drawing by the even-odd rule, and draws them.
    pub fn fill(&self, drawing: &mut Drawing, rings: &[Vec<Spot>], outline: Stroke) {
        drawing.path(rings, true, (Some(&hex(self.pale)), Stroke::NONE));
        let ways: &[f64] = match self.runs {
            Runs::Up => &[1.0],
            Runs::Down => &[-1.0],
            Runs::Crossed => &[1.0, -1.0],
        };
        let stripes: Vec<Vec<Spot>> = ways.iter().flat_map(|way| stripes(rings, *way)).collect();
        drawing.path(
            &stripes,
            false,
            (
                None,
                Stroke {
                    color: self.dark,
                    width: STRIPE_PX,
                    dashes: "",
                },
            ),
        );
        drawing.path(rings, true, (None, outline));
    }
}

/// The stretches of the lines x + way·y = k · period that are inside closed lines, by the even-odd
/// rule.
fn stripes(rings: &[Vec<Spot>], way: f64) -> Vec<Vec<Spot>> {
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

/// What a legend names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key {
    /// A cut face.
    Cut(Hatch),
    /// A void.
    Void,
    /// A pin in its socket.
    Pin,
    /// The widest disc that passes an opening.
    Disc,
}

/// Draws samples with their words in a row from a spot: the left end, half-way up.
pub fn legend(drawing: &mut Drawing, start: Spot, keys: &[(Key, &str)]) {
    let text = drawing.text_px();
    let [wide, high] = SWATCH_TEXTS.map(|texts| texts * text);
    let mut x = start[0];
    for (key, words) in keys {
        let [top, bottom] = [start[1] - 0.5 * high, start[1] + 0.5 * high];
        let ring = vec![[x, top], [x + wide, top], [x + wide, bottom], [x, bottom]];
        let middle = [x + 0.5 * wide, start[1]];
        match key {
            Key::Cut(hatch) => hatch.fill(drawing, &[ring], Stroke::THIN),
            Key::Void => drawing.path(&[ring], true, (Some(&hex(VOID)), Stroke::THIN)),
            Key::Pin => draw_peg(drawing, middle, [0.6 * high, high]),
            Key::Disc => drawing.circle(middle, 0.5 * high, (Some(&hex(VOID)), Stroke::DASHED)),
        }
        x += wide + 0.4 * text;
        drawing.text([x, start[1]], Anchor::Start, words);
        x += (LETTER_TEXTS * words.chars().count() as f64 + 1.0) * text;
    }
}

/// Draws a pin, whole, in its socket, dashed; diameters in pixels.
pub fn draw_peg(drawing: &mut Drawing, at: Spot, [pin_px, socket_px]: [f64; 2]) {
    drawing.circle(at, 0.5 * socket_px, (Some("#ffffff"), Stroke::DASHED));
    drawing.circle(at, 0.5 * pin_px, (None, Stroke::THIN));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<Spot> {
        vec![[low, low], [high, low], [high, high], [low, high]]
    }

    /// The length of all stripes together.
    fn length(stripes: &[Vec<Spot>]) -> f64 {
        stripes
            .iter()
            .map(|ends| (ends[0][0] - ends[1][0]).hypot(ends[0][1] - ends[1][1]))
            .sum()
    }

    #[test]
    fn stripes_lie_in_the_material_and_as_far_apart_as_they_should() {
        let rings = [square(0.0, 400.0), square(100.0, 300.0)];
        for way in [1.0, -1.0] {
            let found = stripes(&rings, way);
            // Lines a period apart cover area over period; a line more or less at either end is a
            // hundredth of that.
            let expected = (400.0 * 400.0 - 200.0 * 200.0) / PERIOD_PX;
            assert!((length(&found) / expected - 1.0).abs() < 0.02);
            let middle = |ends: &Vec<Spot>| between(ends[0], ends[1], 0.5);
            let is_in_hole =
                |[x, y]: Spot| (100.0..300.0).contains(&x) && (100.0..300.0).contains(&y);
            assert!(found.iter().all(|ends| !is_in_hole(middle(ends))));
        }
    }

    #[test]
    fn printed_matter_rods_and_ballast_differ_in_the_run_of_their_stripes() {
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
        // Up: the same one to the right and one up; down: one to the right and one down.
        assert!((0..26).all(|i| printed[28 + i + 1] == printed[56 + i] && rods[28 + i] == rods[56 + i + 1]));
    }

    #[test]
    fn nothing_has_no_stripes() {
        assert!(stripes(&[], 1.0).is_empty());
    }
}
