//! Drawings for cutters: lines in mm on a few layers.

/// The purpose of a line in a drawing for a cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CutLayer {
    /// It is burnt into the surface.
    Engrave,
    /// A hole, which is cut before what lies round it.
    Inner,
    /// An outline, which is cut last.
    Outer,
    /// The edge of the sheet, which is not cut.
    Sheet,
}

impl CutLayer {
    /// All layers in the order of the work.
    pub const ALL: [Self; 4] = [Self::Engrave, Self::Inner, Self::Outer, Self::Sheet];

    /// Returns its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Engrave => "ENGRAVE",
            Self::Inner => "CUT_INNER",
            Self::Outer => "CUT_OUTER",
            Self::Sheet => "SHEET",
        }
    }
}

/// The form of a line.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawnShape {
    /// Straight pieces that close.
    Closed(Vec<[f64; 2]>),
    /// Straight pieces from the first point to the last.
    Open(Vec<[f64; 2]>),
    /// A circle.
    Circle {
        /// Its middle, mm.
        center_mm: [f64; 2],
        /// Its radius, mm.
        radius_mm: f64,
    },
}

/// A line of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnLine {
    /// Its purpose.
    pub layer: CutLayer,
    /// Its form, mm.
    pub shape: DrawnShape,
}

/// A colour: red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// A drawing of one sheet, with its origin at the lower left corner.
#[derive(Debug, Clone, PartialEq)]
pub struct CutDrawing {
    /// Width and depth of the sheet, mm.
    pub size_mm: [f64; 2],
    /// The lines.
    pub lines: Vec<DrawnLine>,
    /// The colours by layer, in the order of [`CutLayer::ALL`].
    pub colors: [Rgb; 4],
}

impl CutDrawing {
    /// Returns the lines of a layer, in their order.
    pub(super) fn on(&self, layer: CutLayer) -> impl Iterator<Item = &DrawnShape> {
        let lines = self.lines.iter().filter(move |line| line.layer == layer);
        lines.map(|line| &line.shape)
    }

    /// Returns the colour of a layer.
    pub(super) fn color(&self, layer: CutLayer) -> Rgb {
        let [engrave, inner, outer, sheet] = self.colors;
        match layer {
            CutLayer::Engrave => engrave,
            CutLayer::Inner => inner,
            CutLayer::Outer => outer,
            CutLayer::Sheet => sheet,
        }
    }
}

/// Formats a length, mm, to a ten-thousandth and without needless zeros; never `-0`.
pub(super) fn number(mm: f64) -> String {
    let text = format!("{mm:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_written_short_and_exact() {
        let cases = [
            (1.0, "1"),
            (0.25, "0.25"),
            (-1e-9, "0"),
            (12.345_67, "12.3457"),
        ];
        for (mm, text) in cases {
            assert_eq!(number(mm), text);
        }
    }
}
