//! The legend of a picture: samples with their words, and pins as they are drawn.

use super::hatch::Hatch;
use super::palette::{PAPER, VOID};
use super::svg::{Anchor, Drawing, Paint, Spot, Stroke};

/// Width and height of the samples in a legend, in heights of its words.
const SWATCH_TEXTS: [f64; 2] = [1.6, 0.9];
/// Width of a letter, in heights of the words: sans-serif letters are about half as wide as high.
const LETTER_TEXTS: f64 = 0.55;

/// A sample in a legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key {
    /// A cut face with this filling.
    Cut(Hatch),
    /// A void.
    Void,
    /// A pin in its socket.
    Pin,
    /// The widest disc that passes through an opening.
    Disc,
}

/// Draws samples with their words in a row that begins at `start`, half-way up.
pub fn draw_legend(drawing: &mut Drawing, start: Spot, keys: &[(Key, &str)]) {
    let text = drawing.text_px();
    let [wide, high] = SWATCH_TEXTS.map(|texts| texts * text);
    let mut x = start[0];
    for (key, words) in keys {
        let [top, bottom] = [start[1] - 0.5 * high, start[1] + 0.5 * high];
        let ring = vec![[x, top], [x + wide, top], [x + wide, bottom], [x, bottom]];
        let middle = [x + 0.5 * wide, start[1]];
        match key {
            Key::Cut(hatch) => hatch.fill(drawing, &[ring], Stroke::THIN),
            Key::Void => drawing.path(&[ring], true, Paint::filled(VOID, Stroke::THIN)),
            Key::Pin => draw_peg(drawing, middle, [0.6 * high, high]),
            Key::Disc => drawing.circle(middle, 0.5 * high, Paint::filled(VOID, Stroke::DASHED)),
        }
        x += wide + 0.4 * text;
        drawing.text([x, start[1]], Anchor::Start, words);
        x += (LETTER_TEXTS * words.chars().count() as f64 + 1.0) * text;
    }
}

/// Draws a pin as a solid circle in its socket, a dashed one; diameters in pixels.
pub fn draw_peg(drawing: &mut Drawing, at: Spot, [pin_px, socket_px]: [f64; 2]) {
    drawing.circle(at, 0.5 * socket_px, Paint::filled(PAPER, Stroke::DASHED));
    drawing.circle(at, 0.5 * pin_px, Paint::line(Stroke::THIN));
}
