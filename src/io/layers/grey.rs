//! An image in grey, and its file.

use std::io::Cursor;

use super::error::LayersError;

/// An image in grey, a byte a pixel: white is hardened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GreyImage {
    /// The number of columns and rows.
    pub count: [u32; 2],
    /// The pixels, row by row from the top.
    pub bytes: Vec<u8>,
}

/// Writes an image in grey as PNG. The bytes are the rows from the top.
///
/// # Errors
/// The number of bytes is not that of the pixels.
pub fn encode_grey(count: [u32; 2], bytes: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, count[0], count[1]);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    // Most rows are like the one above, and it is the number of layers that takes time.
    encoder.set_compression(png::Compression::Fastest);
    encoder.set_filter(png::Filter::Up);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    Ok(file)
}

impl GreyImage {
    /// Reads a PNG file in grey with this number of columns and rows. One with 1, 2, 4 or 16 bits
    /// is brought to 8. Another size is refused before memory is taken for it.
    pub(super) fn decode(part: &str, file: &[u8], wanted: [u32; 2]) -> Result<Self, LayersError> {
        let fault = |reason: String| LayersError::Image {
            part: part.to_owned(),
            reason,
        };
        let mut decoder = png::Decoder::new(Cursor::new(file));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
        let mut reader = decoder
            .read_info()
            .map_err(|error| fault(error.to_string()))?;
        let count = [reader.info().width, reader.info().height];
        if count != wanted {
            return Err(LayersError::Size {
                part: part.to_owned(),
                found: count,
                wanted,
            });
        }
        let (color, _) = reader.output_color_type();
        if color != png::ColorType::Grayscale {
            return Err(fault("it has colours or is transparent".to_owned()));
        }
        let size = reader.output_buffer_size();
        let mut bytes = vec![0; size.ok_or_else(|| fault("it has too many pixels".to_owned()))?];
        reader
            .next_frame(&mut bytes)
            .map_err(|error| fault(error.to_string()))?;
        Ok(Self { count, bytes })
    }
}
