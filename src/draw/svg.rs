//! Lines, words and circles as SVG: numbers to a hundredth of a pixel, so that equal drawings are
//! equal bytes.

use std::fmt::Write;

use super::base64::base64;
use super::palette::{Color, INK, PAPER, hex};

/// A place on a drawing: pixels to the right and down.
pub type Spot = [f64; 2];

/// The name space of SVG files; what stands inside a page needs none.
const NAME_SPACE: &str = " xmlns=\"http://www.w3.org/2000/svg\"";

/// A line is upright where it goes aside less than this share of its height.
const UPRIGHT_RATIO: f64 = 0.1;

/// The dot at the end of a line, pixels: larger ones hide small pins, smaller ones are lost in
/// print.
const DOT_PX: f64 = 3.5;

/// How a line looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub color: Color,
    /// How wide it is, pixels.
    pub width: f64,
    /// Lengths of dashes and gaps, `""` for a whole line.
    pub dashes: &'static str,
}

impl Stroke {
    /// A whole thin line in ink.
    pub const THIN: Self = Self {
        color: INK,
        width: 1.5,
        dashes: "",
    };
    /// A whole thick line in ink.
    pub const THICK: Self = Self {
        color: INK,
        width: 3.0,
        dashes: "",
    };
    /// A hidden line or an explosion line.
    pub const DASHED: Self = Self {
        color: INK,
        width: 1.5,
        dashes: "7 5",
    };
    /// An axis.
    pub const DASH_DOT: Self = Self {
        color: INK,
        width: 1.5,
        dashes: "16 5 3 5",
    };
    /// No line.
    pub const NONE: Self = Self {
        color: INK,
        width: 0.0,
        dashes: "",
    };

    fn attributes(&self) -> String {
        if self.width == 0.0 {
            return "stroke=\"none\"".to_owned();
        }
        let dashes = if self.dashes.is_empty() {
            String::new()
        } else {
            format!(" stroke-dasharray=\"{}\"", self.dashes)
        };
        format!(
            "stroke=\"{}\" stroke-width=\"{}\"{dashes}",
            hex(self.color),
            self.width
        )
    }
}

/// What words at the edge of a drawing name.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Where it is.
    pub at: Spot,
    /// Its words.
    pub words: String,
    /// What it is drawn as is a circle of this radius, at whose rim the line ends without a dot;
    /// zero for a dot.
    pub radius_px: f64,
    /// Whether it lies behind something: then the line is dashed and the dot hollow.
    pub is_hidden: bool,
}

impl Mark {
    /// A name for what is seen at a spot.
    pub fn new(at: Spot, words: String) -> Self {
        Self {
            at,
            words,
            radius_px: 0.0,
            is_hidden: false,
        }
    }

    /// Where a line from `start` ends: at its rim.
    fn end_from(&self, start: Spot) -> Spot {
        let way = [start[0] - self.at[0], start[1] - self.at[1]];
        let share = (self.radius_px / way[0].hypot(way[1]).max(f64::MIN_POSITIVE)).min(1.0);
        [self.at[0] + share * way[0], self.at[1] + share * way[1]]
    }
}

/// Where words stand against their spot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// To its right.
    Start,
    /// About it.
    Middle,
    /// To its left.
    End,
}

/// A drawing of some pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    size_px: [usize; 2],
    text_px: f64,
    body: String,
}

impl Drawing {
    /// An empty drawing whose words are `text_px` high.
    pub fn new(size_px: [usize; 2], text_px: f64) -> Self {
        Self {
            size_px,
            text_px,
            body: String::new(),
        }
    }

    /// Width and height, pixels.
    pub fn size_px(&self) -> [f64; 2] {
        self.size_px.map(|pixels| pixels as f64)
    }

    /// How high words are, pixels.
    pub fn text_px(&self) -> f64 {
        self.text_px
    }

    /// Adds a picture of this width and height at the upper left, `opacity` from 0 to 1.
    pub fn picture(&mut self, png: &[u8], [width, height]: [usize; 2], opacity: f64) {
        self.add(&format!(
            "<image width=\"{width}\" height=\"{height}\" opacity=\"{opacity}\" href=\"data:image/png;base64,{}\"/>",
            base64(png)
        ));
    }

    /// Adds a line between two spots.
    pub fn line(&mut self, [a, b]: [Spot; 2], stroke: Stroke) {
        self.path(&[vec![a, b]], false, (None, stroke));
    }

    /// Adds lines through spots, closed or not, filled by the even-odd rule.
    pub fn path(
        &mut self,
        lines: &[Vec<Spot>],
        is_closed: bool,
        (fill, stroke): (Option<&str>, Stroke),
    ) {
        let mut data = String::new();
        for line in lines {
            for (index, [x, y]) in line.iter().enumerate() {
                let _ = write!(
                    data,
                    "{}{} {}",
                    if index == 0 { 'M' } else { 'L' },
                    short(*x),
                    short(*y)
                );
            }
            data.push_str(if is_closed { "Z" } else { "" });
        }
        let fill = fill.unwrap_or("none");
        self.add(&format!(
            "<path d=\"{data}\" fill=\"{fill}\" fill-rule=\"evenodd\" {}/>",
            stroke.attributes()
        ));
    }

    /// Adds a circle.
    pub fn circle(&mut self, [x, y]: Spot, radius: f64, (fill, stroke): (Option<&str>, Stroke)) {
        let (x, y, r, fill) = (short(x), short(y), short(radius), fill.unwrap_or("none"));
        self.add(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\" {}/>",
            stroke.attributes()
        ));
    }

    /// Adds words with a rim of paper, so that they are read on anything.
    pub fn text(&mut self, [x, y]: Spot, anchor: Anchor, words: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (size, rim) = (self.text_px, self.text_px * 0.25);
        self.add(&format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"{size}\" font-family=\"sans-serif\" text-anchor=\"{anchor}\" dominant-baseline=\"central\" \
             fill=\"{}\" stroke=\"{}\" stroke-width=\"{rim}\" stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>",
            short(x),
            short(y),
            hex(INK),
            hex(PAPER),
            escaped(words)
        ));
    }

    /// Adds a length between two spots, drawn `aside` of them: extension lines, a line with ticks,
    /// and its words.
    pub fn dimension(&mut self, [a, b]: [Spot; 2], aside: Spot, words: &str) {
        let moved = |[x, y]: Spot, times: f64| [x + times * aside[0], y + times * aside[1]];
        let (from, to) = (moved(a, 1.0), moved(b, 1.0));
        for (end, spot) in [(from, a), (to, b)] {
            self.line(
                [spot, [end[0] + 0.15 * aside[0], end[1] + 0.15 * aside[1]]],
                Stroke {
                    width: 0.8,
                    ..Stroke::THIN
                },
            );
        }
        self.line([from, to], Stroke::THIN);
        for end in [from, to] {
            self.circle(end, 3.0, (Some(&hex(INK)), Stroke::NONE));
        }
        let length = aside[0].hypot(aside[1]).max(f64::MIN_POSITIVE);
        if (from[0] - to[0]).abs() < UPRIGHT_RATIO * (from[1] - to[1]).abs() {
            // Beside an upright line there may be no room.
            let top = if from[1] < to[1] { from } else { to };
            return self.text([top[0], top[1] - self.text_px], Anchor::Middle, words);
        }
        let out = 1.0 + self.text_px / length;
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let anchor = match aside[0] / length {
            lean if lean > 0.5 => Anchor::Start,
            lean if lean < -0.5 => Anchor::End,
            _ => Anchor::Middle,
        };
        self.text(moved(middle, out), anchor, words);
    }

    /// Adds words at the left and right edges, each with a line to what it names, in the order of
    /// their heights.
    pub fn callouts(&mut self, marks: &[Mark]) {
        let [width, height] = self.size_px();
        for (edge, anchor, is_left) in [
            (8.0, Anchor::Start, true),
            (width - 8.0, Anchor::End, false),
        ] {
            let mut side: Vec<&Mark> = marks
                .iter()
                .filter(|mark| (mark.at[0] < 0.5 * width) == is_left)
                .collect();
            side.sort_by(|a, b| a.at[1].total_cmp(&b.at[1]));
            let wanted: Vec<f64> = side.iter().map(|mark| mark.at[1]).collect();
            let heights = spread(
                &wanted,
                1.35 * self.text_px,
                [self.text_px, height - self.text_px],
            );
            for (mark, y) in side.into_iter().zip(heights) {
                let reach = 0.62 * self.text_px * mark.words.chars().count() as f64;
                self.leader([if is_left { edge + reach } else { edge - reach }, y], mark);
                self.text([edge, y], anchor, &mark.words);
            }
        }
    }

    /// Adds the line from words to what they name, on a rim of paper so that it is seen on
    /// anything.
    fn leader(&mut self, start: Spot, mark: &Mark) {
        let end = mark.end_from(start);
        self.line(
            [start, end],
            Stroke {
                color: PAPER,
                width: 5.0,
                dashes: "",
            },
        );
        self.line(
            [start, end],
            if mark.is_hidden {
                Stroke::DASHED
            } else {
                Stroke::THIN
            },
        );
        let fill = hex(if mark.is_hidden { PAPER } else { INK });
        let rim = Stroke {
            color: if mark.is_hidden { INK } else { PAPER },
            width: 1.5,
            dashes: "",
        };
        if mark.radius_px == 0.0 {
            self.circle(end, DOT_PX, (Some(&fill), rim));
        }
    }

    /// Adds a dashed line that is seen on dark colours too.
    pub fn dashed(&mut self, ends: [Spot; 2]) {
        self.line(
            ends,
            Stroke {
                color: PAPER,
                width: 4.5,
                dashes: "",
            },
        );
        self.line(
            ends,
            Stroke {
                width: 2.0,
                ..Stroke::DASHED
            },
        );
    }

    /// Adds SVG as it is.
    pub fn add(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// The drawing inside a page.
    pub fn inline(&self, alt: &str) -> String {
        self.written(alt, "")
    }

    /// The drawing as a file of its own.
    pub fn to_file(&self, alt: &str) -> String {
        self.written(alt, NAME_SPACE)
    }

    fn written(&self, alt: &str, name_space: &str) -> String {
        let ([width, height], alt) = (self.size_px, escaped(alt));
        format!(
            "<svg{name_space} viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{alt}\">\n{}</svg>\n",
            self.body
        )
    }
}

/// Places `gap` apart or more, as near to those wanted (ascending) as fits between two ends.
fn spread(wanted: &[f64], gap: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let mut placed = Vec::with_capacity(wanted.len());
    let mut next = low;
    for &place in wanted {
        placed.push(place.max(next));
        next = place.max(next) + gap;
    }
    let mut last = high;
    for place in placed.iter_mut().rev() {
        *place = place.min(last);
        last = *place - gap;
    }
    placed
}

/// A number to a hundredth without closing zeros.
pub fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// Text between tags and quotes.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_zero_has_no_sign() {
        assert_eq!(
            [1.0, 2.5, -0.001, 1.0 / 3.0].map(short),
            ["1", "2.5", "0", "0.33"]
        );
    }

    #[test]
    fn labels_are_spread_in_order_and_stay_on_the_paper() {
        let placed = spread(&[5.0, 6.0, 50.0, 99.0, 100.0], 10.0, [0.0, 100.0]);
        assert_eq!(placed, [5.0, 15.0, 50.0, 90.0, 100.0]);
    }

    #[test]
    fn a_line_to_a_circle_ends_at_its_rim_and_leaves_it_free() {
        let pin = Mark {
            radius_px: 5.0,
            ..Mark::new([10.0, 20.0], "N1".to_owned())
        };
        assert_eq!(pin.end_from([40.0, 60.0]), [13.0, 24.0]);
        let mut drawing = Drawing::new([100, 100], 5.0);
        drawing.callouts(&[pin]);
        assert!(!drawing.inline("x").contains("<circle"));
    }

    #[test]
    fn words_cannot_leave_their_tag() {
        let mut drawing = Drawing::new([10, 10], 5.0);
        drawing.text([0.0, 0.0], Anchor::Start, "</text><script>");
        assert!(
            !drawing.inline("\"<").contains("<script")
                && drawing.inline("\"<").contains("aria-label=\"&quot;&lt;\"")
        );
    }

    #[test]
    fn a_file_names_its_language_and_a_page_needs_not() {
        let drawing = Drawing::new([10, 20], 5.0);
        assert!(drawing.to_file("x").contains("xmlns") && !drawing.inline("x").contains("xmlns"));
    }
}
