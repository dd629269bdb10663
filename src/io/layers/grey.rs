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

/// Writes an image of pixels that are black or white as PNG, a bit a pixel. Columns and rows are
/// counted from the left and the top.
///
/// # Errors
/// The image has no pixels, or too many.
pub fn encode_bits(
    count: [u32; 2],
    is_white: impl Fn(usize, usize) -> bool,
) -> Result<Vec<u8>, png::EncodingError> {
    let (columns, rows) = (count[0] as usize, count[1] as usize);
    let bytes_of = |row: usize| {
        let is_white = &is_white;
        (0..columns.div_ceil(8)).map(move |byte| {
            let bits = (8 * byte..8 * byte + 8).map(|column| {
                let is_white = column < columns && is_white(column, row);
                u8::from(is_white)
            });
            bits.fold(0, |byte, bit| byte << 1 | bit)
        })
    };
    let bytes: Vec<u8> = (0..rows).flat_map(bytes_of).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, count[0], count[1]);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    encoder.set_compression(png::Compression::Fastest);
    encoder.set_filter(png::Filter::NoFilter);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_of_bits_reads_back_as_black_and_white() {
        let is_white = |column: usize, row: usize| (column * 7 + row * 3) % 5 < 2;
        let file = encode_bits([13, 4], is_white).unwrap();
        let read = GreyImage::decode("a", &file, [13, 4]).unwrap();
        for row in 0..4 {
            for column in 0..13 {
                let grey = if is_white(column, row) { 255 } else { 0 };
                assert_eq!(read.bytes[row * 13 + column], grey, "{column} {row}");
            }
        }
    }
}
