//! Reads the triangles of a package that get no support.

use std::collections::BTreeMap;

use super::archive::Archive;
use super::error::ThreeMfError;
use super::triangles::BLOCKED;
use super::xml::Scanner;

/// The attribute of a triangle that is painted for supports, without its prefix.
const PAINTED: &str = "custom_supports";

/// Returns the triangles that get no support, by their object and their places in its mesh.
///
/// # Errors
/// The bytes are no package, or its model cannot be read.
pub(super) fn decode_blocked(bytes: &[u8]) -> Result<BTreeMap<u32, Vec<usize>>, ThreeMfError> {
    let mut archive = Archive::open(bytes)?;
    let root = archive.root_part()?;
    let text = archive.text(&root)?;
    let mut found = BTreeMap::new();
    // The model of a large part has millions of tags.
    if !text.contains(PAINTED) {
        return Ok(found);
    }
    let mut scanner = Scanner::new(&root, &text);
    let (mut object, mut triangle) = (None, 0);
    while let Some(tag) = scanner.next_tag()? {
        match tag.name() {
            "object" => {
                object = tag.get("id")?.and_then(|id| id.trim().parse::<u32>().ok());
                triangle = 0;
            }
            "triangle" => {
                let is_blocked = tag.get_prefixed(PAINTED)?.as_deref() == Some(BLOCKED);
                if let Some(id) = object.filter(|_| is_blocked) {
                    found.entry(id).or_insert_with(Vec::new).push(triangle);
                }
                triangle += 1;
            }
            _ => {}
        }
    }
    Ok(found)
}
