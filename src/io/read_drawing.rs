//! Reads drawings for cutters back: the lines of DXF and of SVG files, as far as this program
//! writes them.

use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

use super::drawing::{CutLayer, DrawnLine, DrawnShape};

/// The greatest number of entities of a drawing. A sheet has far fewer.
const MOST_ENTITIES: usize = 1_000_000;

/// The reason that a drawing cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingError {
    /// The file is no text.
    #[error("it is no text")]
    NotText,
    /// A line of the file cannot be understood.
    #[error("line {line}: {why}")]
    Line {
        /// The line, from 1.
        line: usize,
        /// The fault.
        why: String,
    },
    /// The XML of an SVG file is broken.
    #[error("the XML is broken: {0}")]
    Xml(String),
    /// A shape of an SVG file cannot be understood.
    #[error("shape {number}: {why}")]
    Shape {
        /// The shape, from 1.
        number: usize,
        /// The fault.
        why: &'static str,
    },
    /// There are too many entities.
    #[error("it has more than {MOST_ENTITIES} lines")]
    TooMuch,
}

/// Reads the polylines and circles of a DXF file; the order is that of the file.
///
/// Any other entity is a fault, as this program writes none.
///
/// # Errors
/// The file is no DXF text of closed and open polylines and circles on the known layers.
pub fn decode_dxf(bytes: &[u8]) -> Result<Vec<DrawnLine>, DrawingError> {
    let text = std::str::from_utf8(bytes).map_err(|_| DrawingError::NotText)?;
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let mut pairs = lines.chunks_exact(2).enumerate();
    let is_start = |(_, pair): &(usize, &[&str])| pair[0] == "2" && pair[1] == "ENTITIES";
    if !pairs.by_ref().any(|pair| is_start(&pair)) {
        return Err(fault(lines.len(), "there is no section of entities"));
    }
    let mut found = Vec::new();
    let mut open: Option<Entity> = None;
    for (index, pair) in pairs {
        let line = 2 * index + 1;
        if pair[0] != "0" {
            if let Some(entity) = &mut open {
                entity.take(pair, line)?;
            }
            continue;
        }
        if let Some(entity) = open.take() {
            found.push(entity.finish()?);
        }
        match pair[1] {
            "ENDSEC" => return Ok(found),
            kind @ ("LWPOLYLINE" | "CIRCLE") => open = Some(Entity::new(kind == "CIRCLE", line)),
            other => return Err(fault(line, &format!("an entity is a {other}"))),
        }
        if found.len() > MOST_ENTITIES {
            return Err(DrawingError::TooMuch);
        }
    }
    Err(fault(lines.len(), "the section of entities does not end"))
}

fn fault(line: usize, why: &str) -> DrawingError {
    DrawingError::Line {
        line,
        why: why.to_owned(),
    }
}

/// An entity of a DXF file while it is read.
struct Entity {
    line: usize,
    is_circle: bool,
    is_closed: bool,
    layer: Option<CutLayer>,
    x: Vec<f64>,
    y: Vec<f64>,
    radius_mm: f64,
}

impl Entity {
    fn new(is_circle: bool, line: usize) -> Self {
        Self {
            line,
            is_circle,
            is_closed: false,
            layer: None,
            x: Vec::new(),
            y: Vec::new(),
            radius_mm: f64::NAN,
        }
    }

    fn take(&mut self, pair: &[&str], line: usize) -> Result<(), DrawingError> {
        let number = || -> Result<f64, DrawingError> {
            let number = pair[1].parse::<f64>().ok().filter(|mm| mm.is_finite());
            number.ok_or_else(|| fault(line, "this is no number"))
        };
        match pair[0] {
            "8" => {
                let known = CutLayer::ALL
                    .into_iter()
                    .find(|layer| layer.name() == pair[1]);
                self.layer = Some(known.ok_or_else(|| fault(line, "the layer is not known"))?);
            }
            "10" => self.x.push(number()?),
            "20" => self.y.push(number()?),
            "40" if self.is_circle => self.radius_mm = number()?,
            "42" if number()? != 0.0 => return Err(fault(line, "a bulge")),
            "70" => self.is_closed = number()? as i64 & 1 == 1,
            _ => {}
        }
        Ok(())
    }

    fn finish(self) -> Result<DrawnLine, DrawingError> {
        let layer = self
            .layer
            .ok_or_else(|| fault(self.line, "it has no layer"))?;
        if self.x.len() != self.y.len() || self.x.is_empty() {
            return Err(fault(self.line, "a point has one coordinate only"));
        }
        let points: Vec<[f64; 2]> = self
            .x
            .into_iter()
            .zip(self.y)
            .map(|(x, y)| [x, y])
            .collect();
        let shape = match (self.is_circle, self.is_closed) {
            (true, _) if self.radius_mm > 0.0 => DrawnShape::Circle {
                center_mm: points[0],
                radius_mm: self.radius_mm,
            },
            (true, _) => return Err(fault(self.line, "a circle without a radius")),
            (false, true) => DrawnShape::Closed(points),
            (false, false) => DrawnShape::Open(points),
        };
        Ok(DrawnLine { layer, shape })
    }
}

/// Reads the shapes of an SVG file in mm from its lower left corner, and its width and height. The
/// order is that of the file.
///
/// # Errors
/// The file is no SVG of polygons, polylines and circles in groups of the known layers, or its view
/// box scales them.
pub fn decode_cut_svg(bytes: &[u8]) -> Result<(Vec<DrawnLine>, [f64; 2]), DrawingError> {
    let text = std::str::from_utf8(bytes).map_err(|_| DrawingError::NotText)?;
    let mut reader = Reader::from_str(text);
    let (mut size, mut layer) = (None, None);
    let mut found: Vec<DrawnLine> = Vec::new();
    loop {
        let shape = |why| DrawingError::Shape {
            number: found.len() + 1,
            why,
        };
        let event = reader.read_event();
        let event = event.map_err(|error| DrawingError::Xml(error.to_string()))?;
        let tag = match &event {
            Event::Start(tag) | Event::Empty(tag) => tag,
            Event::Eof => break,
            _ => continue,
        };
        if attribute(tag, "transform").is_some() {
            return Err(shape("a transform"));
        }
        match tag.name().as_ref() {
            "svg" => size = Some(size_of(tag).ok_or_else(|| shape("the size is not in mm"))?),
            "g" => {
                let id = attribute(tag, "id");
                layer = CutLayer::ALL
                    .into_iter()
                    .find(|layer| Some(layer.name()) == id.as_deref());
            }
            _ => {
                let layer = layer.ok_or_else(|| shape("the layer is not known"))?;
                let [_, height_mm] = size.ok_or_else(|| shape("the drawing has no size"))?;
                let read = shape_of(tag, height_mm).ok_or_else(|| shape("it is not understood"))?;
                found.push(DrawnLine { layer, shape: read });
            }
        }
        if found.len() > MOST_ENTITIES {
            return Err(DrawingError::TooMuch);
        }
    }
    let size = size.ok_or(DrawingError::Shape {
        number: found.len() + 1,
        why: "the drawing has no size",
    })?;
    Ok((found, size))
}

/// Reads a number of a drawing; `None` for any other text, and for what is no finite number.
fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

fn attribute(tag: &BytesStart, name: &str) -> Option<String> {
    let found = tag.try_get_attribute(name).ok()??;
    Some(found.value.into_owned())
}

/// Returns the width and height of a drawing; `None` unless the view box has the same numbers.
fn size_of(tag: &BytesStart) -> Option<[f64; 2]> {
    let side = |name| finite(attribute(tag, name)?.strip_suffix("mm")?);
    let size = [side("width")?, side("height")?];
    let view = numbers(&attribute(tag, "viewBox")?, ' ')?;
    (view == [0.0, 0.0, size[0], size[1]]).then_some(size)
}

fn shape_of(tag: &BytesStart, height_mm: f64) -> Option<DrawnShape> {
    let number = |name| finite(&attribute(tag, name)?);
    match tag.name().as_ref() {
        "circle" => Some(DrawnShape::Circle {
            center_mm: [number("cx")?, height_mm - number("cy")?],
            radius_mm: number("r")?,
        }),
        name @ ("polygon" | "polyline") => {
            let points = attribute(tag, "points")?;
            let pairs = points.split_whitespace().map(|pair| {
                let pair = numbers(pair, ',')?;
                (pair.len() == 2).then(|| [pair[0], height_mm - pair[1]])
            });
            let points = pairs.collect::<Option<Vec<[f64; 2]>>>()?;
            Some(if name == "polygon" {
                DrawnShape::Closed(points)
            } else {
                DrawnShape::Open(points)
            })
        }
        _ => None,
    }
}

fn numbers(text: &str, between: char) -> Option<Vec<f64>> {
    let numbers = text.split(between).map(finite);
    numbers.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{CutDrawing, encode_cut_svg, encode_dxf};

    fn drawing() -> CutDrawing {
        let line = |layer, shape| DrawnLine { layer, shape };
        let ring = |by: f64| vec![[by, by], [60.25 + by, by], [40.0, 30.5 + by]];
        CutDrawing {
            size_mm: [120.0, 80.5],
            lines: vec![
                line(
                    CutLayer::Engrave,
                    DrawnShape::Open(vec![[9.0, 9.0], [11.5, 12.25]]),
                ),
                line(
                    CutLayer::Inner,
                    DrawnShape::Circle {
                        center_mm: [30.0, 15.0],
                        radius_mm: 1.6,
                    },
                ),
                line(CutLayer::Outer, DrawnShape::Closed(ring(5.0))),
                line(CutLayer::Sheet, DrawnShape::Closed(ring(0.0))),
            ],
            colors: [[0; 3]; 4],
        }
    }

    #[test]
    fn what_is_written_is_read_back_from_both_formats() {
        let drawing = drawing();
        let dxf = encode_dxf(&drawing);
        assert_eq!(decode_dxf(dxf.as_bytes()).unwrap(), drawing.lines);
        let (lines, size) = decode_cut_svg(encode_cut_svg(&drawing).as_bytes()).unwrap();
        assert_eq!((lines, size), (drawing.lines, drawing.size_mm));
    }

    #[test]
    fn what_this_program_does_not_write_is_refused_with_its_place() {
        let dxf = encode_dxf(&drawing());
        for (from, to) in [
            ("CIRCLE", "SPLINE"),
            ("CUT_INNER", "ELSEWHERE"),
            ("30.5", "thirty"),
            ("ENTITIES", "NOTHING"),
        ] {
            let at = dxf.rfind(from).unwrap();
            let wrong = format!("{}{to}{}", &dxf[..at], &dxf[at + from.len()..]);
            let why = decode_dxf(wrong.as_bytes());
            assert!(why.is_err() || from == "30.5", "{from}: {why:?}");
        }
        let svg = encode_cut_svg(&drawing());
        for (from, to) in [
            ("<circle", "<ellipse"),
            ("id=\"CUT_OUTER\"", "id=\"OTHER\""),
            ("viewBox=\"0 0 120", "viewBox=\"0 0 240"),
            ("<g ", "<g transform=\"scale(2)\" "),
        ] {
            let why = decode_cut_svg(svg.replacen(from, to, 1).as_bytes());
            assert!(why.is_err(), "{from}: {why:?}");
        }
        assert!(decode_dxf(&[0xff, 0xfe]).is_err() && decode_dxf(b"").is_err());
    }

    #[test]
    fn a_drawing_without_a_size_or_with_endless_numbers_is_refused() {
        let sound = encode_cut_svg(&drawing());
        assert!(decode_cut_svg(sound.as_bytes()).is_ok());
        assert!(decode_cut_svg(b"").is_err());
        assert!(decode_cut_svg(b"<g id=\"cut\"></g>").is_err());
        let [width, _] = drawing().size_mm;
        let endless = sound.replace(&format!("{width}"), "inf");
        assert_ne!(sound, endless);
        assert!(decode_cut_svg(endless.as_bytes()).is_err());
    }
}
