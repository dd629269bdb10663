//! Lines, circles and words as SVG, with numbers to a hundredth of a pixel, so that equal drawings
//! are equal bytes.

use std::fmt::Write;

use super::base64::base64;
use super::letters::width_texts;
use super::palette::{Color, INK, PAPER, hex};

/// A place on a drawing: pixels to the right and down.
pub type Spot = [f64; 2];

/// The XML namespace that a file needs; SVG inside a page needs none.
const NAMESPACE: &str = " xmlns=\"http://www.w3.org/2000/svg\"";
/// Width of the rim of paper around words, in their heights: it hides a thick line behind them.
const RIM_RATIO: f64 = 0.25;

/// The look of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// The colour.
    pub color: Color,
    /// The width, pixels; zero for no line.
    pub width: f64,
    /// Lengths of dashes and gaps, pixels; `""` for a solid line.
    pub dashes: &'static str,
}

impl Stroke {
    /// A thin solid line in ink.
    pub const THIN: Self = Self::solid(INK, 1.5);
    /// A thick solid line in ink.
    pub const THICK: Self = Self::solid(INK, 3.0);
    /// A hidden edge, or the path of a part that is drawn apart.
    pub const DASHED: Self = Self {
        dashes: "7 5",
        ..Self::THIN
    };
    /// An axis.
    pub const DASH_DOT: Self = Self {
        dashes: "16 5 3 5",
        ..Self::THIN
    };
    /// No line.
    pub const NONE: Self = Self::solid(INK, 0.0);

    /// Returns a solid line of this colour and width in pixels.
    pub const fn solid(color: Color, width: f64) -> Self {
        Self {
            color,
            width,
            dashes: "",
        }
    }

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

/// The look of a shape: its filling and its outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    /// The colour inside, if any.
    pub fill: Option<Color>,
    /// The outline.
    pub stroke: Stroke,
}

impl Paint {
    /// Returns an outline without a filling.
    pub const fn line(stroke: Stroke) -> Self {
        Self { fill: None, stroke }
    }

    /// Returns a filling with an outline.
    pub const fn filled(color: Color, stroke: Stroke) -> Self {
        Self {
            fill: Some(color),
            stroke,
        }
    }

    fn fill_value(&self) -> String {
        self.fill.map_or_else(|| "none".to_owned(), hex)
    }
}

/// The side of words on which their spot lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The words begin at the spot.
    Start,
    /// The words are centred on the spot.
    Middle,
    /// The words end at the spot.
    End,
}

impl Anchor {
    /// Returns its word in SVG.
    fn value(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// A drawing of a fixed size in pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    size_px: [usize; 2],
    text_px: f64,
    body: String,
}

impl Drawing {
    /// Returns an empty drawing whose words are `text_px` high.
    pub fn new(size_px: [usize; 2], text_px: f64) -> Self {
        Self {
            size_px,
            text_px,
            body: String::new(),
        }
    }

    /// Returns width and height, pixels.
    pub fn size_px(&self) -> [f64; 2] {
        self.size_px.map(|pixels| pixels as f64)
    }

    /// Returns the height of words, pixels.
    pub fn text_px(&self) -> f64 {
        self.text_px
    }

    /// Adds a PNG of this width and height at the upper left, `opacity` from 0 to 1.
    pub fn picture(&mut self, png: &[u8], [width, height]: [usize; 2], opacity: f64) {
        self.add(&format!(
            "<image width=\"{width}\" height=\"{height}\" opacity=\"{opacity}\" href=\"data:image/png;base64,{}\"/>",
            base64(png)
        ));
    }

    /// Adds a line between two spots.
    pub fn line(&mut self, [a, b]: [Spot; 2], stroke: Stroke) {
        self.path(&[vec![a, b]], false, Paint::line(stroke));
    }

    /// Adds lines through spots, closed or open, filled by the even-odd rule.
    pub fn path(&mut self, lines: &[Vec<Spot>], is_closed: bool, paint: Paint) {
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
        self.add(&format!(
            "<path d=\"{data}\" fill=\"{}\" fill-rule=\"evenodd\" {}/>",
            paint.fill_value(),
            paint.stroke.attributes()
        ));
    }

    /// Adds a circle.
    pub fn circle(&mut self, [x, y]: Spot, radius: f64, paint: Paint) {
        let (x, y, r) = (short(x), short(y), short(radius));
        self.add(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{}\" {}/>",
            paint.fill_value(),
            paint.stroke.attributes()
        ));
    }

    /// Adds words with a rim of paper, so that they are legible on any colour.
    ///
    /// Words that would leave the drawing are moved inward. Words that are wider than it are made
    /// smaller.
    pub fn text(&mut self, at: Spot, anchor: Anchor, words: &str) {
        let rim = self.text_px * RIM_RATIO;
        let room = self.size_px()[0];
        let size = self.text_px.min(room / width_texts(words).max(1.0));
        let [x, y] = self.fit(at, anchor, [size * width_texts(words), size]);
        self.add(&format!(
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" font-family=\"sans-serif\" \
             text-anchor=\"{}\" dominant-baseline=\"central\" \
             fill=\"{}\" stroke=\"{}\" stroke-width=\"{rim}\" stroke-linejoin=\"round\" \
             paint-order=\"stroke\">{}</text>",
            short(x),
            short(y),
            short(size),
            anchor.value(),
            hex(INK),
            hex(PAPER),
            escape(words)
        ));
    }

    /// Returns the spot nearest to `at` from which words of this width and height stay inside.
    fn fit(&self, at: Spot, anchor: Anchor, words_px: [f64; 2]) -> Spot {
        let [left, right] = match anchor {
            Anchor::Start => [0.0, 1.0],
            Anchor::Middle => [0.5, 0.5],
            Anchor::End => [1.0, 0.0],
        };
        let [width, height] = self.size_px();
        let x = [left * words_px[0], width - right * words_px[0]];
        let y = [0.5 * words_px[1], height - 0.5 * words_px[1]];
        [within(at[0], x), within(at[1], y)]
    }

    /// Returns drawings side by side, their upper edges on one line.
    pub fn row(drawings: &[Self]) -> Self {
        let mut row = Self::new([0, 0], drawings.first().map_or(0.0, Self::text_px));
        for drawing in drawings {
            let [width, height] = drawing.size_px;
            row.add(&format!(
                "<g transform=\"translate({} 0)\">\n{}</g>",
                row.size_px[0], drawing.body
            ));
            row.size_px = [row.size_px[0] + width, row.size_px[1].max(height)];
        }
        row
    }

    /// Adds an SVG element as it is given.
    pub fn add(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// Returns the drawing as an element inside a page.
    pub fn inline(&self, alt: &str) -> String {
        self.to_svg(alt, "")
    }

    /// Returns the drawing as a file of its own.
    pub fn to_file(&self, alt: &str) -> String {
        self.to_svg(alt, NAMESPACE)
    }

    fn to_svg(&self, alt: &str, namespace: &str) -> String {
        let ([width, height], alt) = (self.size_px, escape(alt));
        format!(
            "<svg{namespace} viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{alt}\">\n{}</svg>\n",
            self.body
        )
    }
}

/// Returns the value nearest to this one between two ends; the lower end if they are exchanged.
fn within(value: f64, [low, high]: [f64; 2]) -> f64 {
    value.min(high).max(low)
}

/// Returns a number to a hundredth, without trailing zeros.
pub fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// Returns text with the characters replaced that end a tag or an attribute.
fn escape(text: &str) -> String {
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
    fn words_cannot_leave_their_tag() {
        let mut drawing = Drawing::new([10, 10], 5.0);
        drawing.text([0.0, 0.0], Anchor::Start, "</text><script>");
        assert!(
            !drawing.inline("\"<").contains("<script")
                && drawing.inline("\"<").contains("aria-label=\"&quot;&lt;\"")
        );
    }

    /// Sums of lengths of some hundred pixels are exact to much less.
    const ROUNDING: f64 = 1e-9;

    #[test]
    fn words_at_an_edge_stay_on_the_drawing() {
        let words = "y 99.4 mm";
        let long_px = 20.0 * width_texts(words);
        for (anchor, before) in [
            (Anchor::Start, 0.0),
            (Anchor::Middle, 0.5 * long_px),
            (Anchor::End, long_px),
        ] {
            for edge in [-50.0, 3.0, 200.0, 399.0, 450.0] {
                let drawing = Drawing::new([400, 100], 20.0);
                let [x, y] = drawing.fit([edge, edge], anchor, [long_px, 20.0]);
                let left = x - before;
                assert!(
                    left >= -ROUNDING && left + long_px <= 400.0 + ROUNDING,
                    "{anchor:?} {edge}: {x}"
                );
                assert!((10.0..=90.0).contains(&y), "{y}");
                assert!(edge != 200.0 || x == 200.0, "{x}: there is room");
            }
        }
    }

    #[test]
    fn words_wider_than_the_drawing_are_made_smaller() {
        let mut drawing = Drawing::new([100, 40], 20.0);
        drawing.text([90.0, 20.0], Anchor::Start, "a name that is far too long");
        assert!(
            !drawing.body.contains("font-size=\"20\""),
            "{}",
            drawing.body
        );
    }

    #[test]
    fn only_a_file_names_its_namespace() {
        let drawing = Drawing::new([10, 20], 5.0);
        assert!(drawing.to_file("x").contains("xmlns") && !drawing.inline("x").contains("xmlns"));
    }
}
