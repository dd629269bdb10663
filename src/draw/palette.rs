//! Colours that every colour vision and a grey printer tell apart (Okabe and Ito, "Color universal
//! design", 2008).

/// Red, green, blue.
pub type Color = [u8; 3];

/// The ink of lines and words.
pub const INK: Color = [26, 28, 31];

/// Paper.
pub const PAPER: Color = [255, 255, 255];

/// The surface of the model: light grey.
pub const BODY: Color = [200, 203, 208];

/// The inside of a void: sky blue.
pub const VOID: Color = [86, 180, 233];

/// Material seen where it is cut: vermilion, and hatched as in any drawing.
pub const SECTION: Color = [213, 94, 0];

/// The stripes of the hatching.
pub const HATCH: Color = [255, 214, 170];

/// Hardware: dark grey.
pub const HARDWARE: Color = [84, 88, 96];

/// The stripes of hardware where it is cut: pale grey.
pub const RODS: Color = [222, 225, 230];

/// Ballast: light steel.
pub const BALLAST: Color = [176, 180, 190];

/// The ground of ballast where it is cut, between crossed stripes: darker than hardware.
pub const CROSSED: Color = [52, 56, 64];

/// The squares of a plate, two by two.
pub const PLATE: [Color; 2] = [[238, 240, 243], [219, 223, 228]];

/// Parts, in turn: six of Okabe and Ito, then paler and darker ones; neighbours in this order
/// differ in lightness too.
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

/// The colour of a part.
pub fn part_color(index: usize) -> Color {
    PARTS[index % PARTS.len()]
}

/// A colour as CSS and SVG write it.
pub fn hex(color: Color) -> String {
    format!(
        "#{}",
        color.map(|channel| format!("{channel:02x}")).concat()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The relative luminance of a colour (WCAG 2.2).
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

    /// Their contrast, from 1 to 21 (WCAG 2.2).
    fn contrast(a: Color, b: Color) -> f64 {
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        a.max(b) / a.min(b)
    }

    #[test]
    fn outlines_and_words_stand_out_from_every_colour_and_the_paper() {
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
        // A step of 1.3 in luminance is a step of a tenth of the grey scale, which an office
        // printer keeps.
        for pair in PARTS.windows(2) {
            assert!(contrast(pair[0], pair[1]) > 1.3, "{pair:?}");
        }
        assert!(contrast(PARTS[11], PARTS[0]) > 1.3);
    }

    #[test]
    fn what_is_cut_void_and_outside_differs_in_grey() {
        assert!(
            contrast(SECTION, VOID) > 1.5
                && contrast(SECTION, BODY) > 2.0
                && contrast(SECTION, HATCH) > 2.5
        );
    }
}
