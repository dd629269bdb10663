//! Recognises the format of a file from its content alone.

use super::stl::{is_ascii_stl, is_binary_stl};

/// The format that the content of a file looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Format {
    /// No bytes at all.
    Empty,
    /// STL, binary or ASCII, perhaps damaged.
    Stl,
    /// Wavefront OBJ, perhaps damaged.
    Obj,
    /// PLY, perhaps damaged.
    Ply,
    /// A ZIP archive, most likely a 3MF package.
    ThreeMf,
    /// Something else, in words.
    Foreign(&'static str),
}

/// First bytes of formats that people mistake for STL or OBJ, with a name for each.
const SIGNATURES: [(&[u8], &str); 9] = [
    (b"$MeshFormat", "a Gmsh mesh"),
    (b"# vtk DataFile", "a VTK file"),
    (b"glTF", "a binary glTF file"),
    (b"ISO-10303", "a STEP file"),
    (b"OFF", "an OFF file"),
    (b"Kaydara FBX", "an FBX file"),
    (b"BLENDER", "a Blender file"),
    (b"\x1f\x8b", "a gzip archive"),
    (b"<", "a web page or XML file"),
];

/// The first bytes of a ZIP archive.
const ZIP: &[u8] = b"PK\x03\x04";

/// Returns the format of these bytes.
pub(super) fn sniff(bytes: &[u8]) -> Format {
    if bytes.is_empty() {
        Format::Empty
    } else if is_binary_stl(bytes) || is_ascii_stl(bytes) {
        Format::Stl
    } else if bytes.starts_with(ZIP) {
        Format::ThreeMf
    } else if is_ply(bytes) {
        Format::Ply
    } else if let Some((_, name)) = SIGNATURES
        .iter()
        .find(|(start, _)| bytes.starts_with(start))
    {
        Format::Foreign(name)
    } else if looks_like_obj(bytes) {
        Format::Obj
    } else if is_text(bytes) {
        Format::Foreign("a text file")
    } else {
        Format::Stl
    }
}

/// Returns true if the first line is that of a PLY file.
fn is_ply(bytes: &[u8]) -> bool {
    bytes
        .strip_prefix(b"ply")
        .is_some_and(|rest| rest.first().is_none_or(u8::is_ascii_whitespace))
}

/// Returns true if the content is text in which some line is a vertex or a face.
fn looks_like_obj(bytes: &[u8]) -> bool {
    let geometry = |line: &[u8]| matches!(line.trim_ascii_start(), [b'v' | b'f', b' ' | b'\t', ..]);
    is_text(bytes) && bytes.split(|&b| b == b'\n' || b == b'\r').any(geometry)
}

/// Returns true if the bytes are free of control codes that text does not use.
fn is_text(bytes: &[u8]) -> bool {
    bytes
        .iter()
        .all(|&b| b >= b' ' || matches!(b, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_content_decides_and_says_what_it_is() {
        let cases: [(&[u8], Format); 9] = [
            (b"", Format::Empty),
            (b"solid x\nendsolid x\n", Format::Stl),
            (b"\xef\xbb\xbf  SOLID\n", Format::Stl),
            (b"# made by hand\nv 0 0 0\n", Format::Obj),
            (b"\tv\t0 0 0\r", Format::Obj),
            (b"a letter to a friend", Format::Foreign("a text file")),
            (b"PK\x03\x04\x14\x00", Format::ThreeMf),
            (b"ply\nformat ascii 1.0\n", Format::Ply),
            (b"\x00\x01\x02", Format::Stl),
        ];
        for (bytes, format) in cases {
            assert_eq!(sniff(bytes), format, "{:?}", String::from_utf8_lossy(bytes));
        }
    }
}
