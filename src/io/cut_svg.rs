//! SVG for cutters: mm, hairlines, one group a layer, no transforms.

use std::fmt::Write as _;

use super::drawing::{CutDrawing, CutLayer, DrawnShape, number};

/// Width of the lines, mm: a hairline, which cutters take for a cut.
const HAIRLINE_MM: f64 = 0.1;

/// Writes a drawing as SVG. Its width and height are in mm, and the view box has the same numbers,
/// so that no reader scales it. The same drawing gives the same bytes.
pub fn encode_cut_svg(drawing: &CutDrawing) -> String {
    let [width, height] = drawing.size_mm.map(number);
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n"
    );
    for layer in CutLayer::ALL {
        let mut shapes = drawing.on(layer).peekable();
        if shapes.peek().is_none() {
            continue;
        }
        let [red, green, blue] = drawing.color(layer);
        let _ = writeln!(
            text,
            "<g id=\"{}\" fill=\"none\" stroke=\"#{red:02x}{green:02x}{blue:02x}\" \
             stroke-width=\"{HAIRLINE_MM}\">",
            layer.name()
        );
        for shape in shapes {
            write_shape(&mut text, shape, drawing.size_mm[1]);
        }
        text += "</g>\n";
    }
    text + "</svg>\n"
}

/// Writes a shape; y grows downward in SVG.
fn write_shape(text: &mut String, shape: &DrawnShape, height_mm: f64) {
    let points = |points: &[[f64; 2]]| {
        let pairs = points
            .iter()
            .map(|[x, y]| format!("{},{}", number(*x), number(height_mm - y)));
        pairs.collect::<Vec<_>>().join(" ")
    };
    let _ = match shape {
        DrawnShape::Closed(corners) => {
            writeln!(text, "<polygon points=\"{}\"/>", points(corners))
        }
        DrawnShape::Open(line) => writeln!(text, "<polyline points=\"{}\"/>", points(line)),
        DrawnShape::Circle {
            center_mm: [x, y],
            radius_mm,
        } => writeln!(
            text,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
            number(*x),
            number(height_mm - y),
            number(*radius_mm)
        ),
    };
}
