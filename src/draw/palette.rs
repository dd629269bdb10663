//! Colours that every colour vision and a grey printer tell apart (Okabe and Ito, "Color universal
//! design", 2008).

/// Red, green, blue.
pub type Color = [u8; 3];

/// The ink of lines and words: almost black.
pub const INK: Color = [26, 28, 31];

/// Paper: white.
pub const PAPER: Color = [255, 255, 255];

/// The surface of the model: light grey.
pub const BODY: Color = [200, 203, 208];

/// The inside of a void: sky blue.
pub const VOID: Color = [86, 180, 233];

/// Cut faces of material: vermilion, hatched.
pub const SECTION: Color = [213, 94, 0];

/// The stripes of cut faces of material: pale orange.
pub const HATCH: Color = [255, 214, 170];

/// The ground of sparse infill: pale blue.
pub const SPARSE: Color = [226, 241, 251];

/// The ground of the densest infill of several: dark blue, so that its stripes show.
pub const DENSE: Color = [58, 110, 150];

/// Hardware: dark grey.
pub const HARDWARE: Color = [84, 88, 96];

/// The stripes of cut hardware: pale grey.
pub const RODS: Color = [222, 225, 230];

/// Ballast: light steel.
pub const BALLAST: Color = [176, 180, 190];

/// The ground of cut ballast, between crossed stripes: darker than hardware.
pub const CROSSED: Color = [52, 56, 64];

/// Pins and their holes: a red that stays dark on a grey printer.
pub const PIN: Color = [200, 16, 46];

/// The light and the dark squares of a build plate.
pub const PLATE: [Color; 2] = [[238, 240, 243], [219, 223, 228]];

/// The colours of parts, in turn: six of Okabe and Ito, then paler and darker ones. Neighbours in
/// this order differ in lightness too.
pub const PARTS: [Color; 12] = [
    [240, 228, 66],
    [0, 114, 178],
    [86, 180, 233],
    [0, 158, 115],
    [230, 159, 0],
    [204, 121, 167],
    [255, 245, 200],
    [150, 100, 40],
    [190, 225, 255],
    [130, 140, 40],
    [170, 240, 190],
    [150, 90, 190],
];

/// The colours of curves in a plot: blue and vermilion (Okabe and Ito), of different lightness.
pub const CURVES: [Color; 2] = [[0, 114, 178], [213, 94, 0]];

/// Returns the colour of the part with this index; colours repeat after twelve parts.
pub fn part_color(index: usize) -> Color {
    PARTS[index % PARTS.len()]
}

/// Returns a colour as CSS and SVG write it: `#rrggbb`.
pub fn hex(color: Color) -> String {
    format!(
        "#{}",
        color.map(|channel| format!("{channel:02x}")).concat()
    )
}

/// Returns the colour between two others: the first for a share of 0, the second for 1.
pub fn mix(from: Color, to: Color, share: f64) -> Color {
    std::array::from_fn(|i| {
        let [from, to] = [from, to].map(|color| f64::from(color[i]));
        (from + (to - from) * share).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the relative luminance of a colour (WCAG 2.2).
    fn luminance(color: Color) -> f64 {
        let linear = color.map(|channel| {
            let share = f64::from(channel) / 255.0;
            if share <= 0.04045 {
                share / 12.92
            } else {
                ((share + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    /// Returns the contrast of two colours, from 1 to 21 (WCAG 2.2).
    fn contrast(a: Color, b: Color) -> f64 {
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        a.max(b) / a.min(b)
    }

    #[test]
    fn ink_stands_out_from_every_colour_and_the_paper() {
        // WCAG 2.2 asks for 3 between the parts of a picture and 4.5 for words.
        assert!(contrast(INK, PAPER) > 4.5);
        for color in PARTS
            .into_iter()
            .chain([BODY, VOID, SECTION, HATCH, PLATE[0], PLATE[1]])
        {
            assert!(contrast(INK, color) >= 3.0, "{color:?}");
        }
    }

    #[test]
    fn parts_that_follow_each_other_differ_in_grey() {
        // A step of 1.3 in luminance is a tenth of the grey scale, which an office printer keeps.
        for pair in PARTS.windows(2) {
            assert!(contrast(pair[0], pair[1]) > 1.3, "{pair:?}");
        }
        assert!(contrast(PARTS[11], PARTS[0]) > 1.3);
    }

    #[test]
    fn cut_faces_voids_and_outsides_differ_in_grey() {
        assert!(
            contrast(SECTION, VOID) > 1.5
                && contrast(SECTION, BODY) > 2.0
                && contrast(SECTION, HATCH) > 2.5
        );
    }
}
