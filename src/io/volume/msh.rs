//! Reads Gmsh's `.msh`, versions 2.2 and 4.1, as text and as binary.

use super::error::VolumeError;
use super::msh_file::Msh;
use super::raw::{On, Raw};
use super::source::Source;

/// Returns the mesh of a file.
pub(super) fn decode(bytes: &[u8]) -> Result<(Raw, Source<'_>), VolumeError> {
    let mut msh = Msh::new(bytes);
    let mut corners = Vec::new();
    while !msh.source.values.left().trim_ascii().is_empty() {
        let at = msh.source.values.offset();
        let section = msh.source.text_word("a section such as $Nodes")?;
        match section.as_str() {
            "$MeshFormat" => msh.header()?,
            "$Nodes" => msh.section_nodes()?,
            "$Elements" => corners.extend(msh.section_elements()?),
            "$NodeData" | "$ElementData" => {
                msh.connect(std::mem::take(&mut corners))?;
                let is_of_nodes = section == "$NodeData";
                msh.section_data(if is_of_nodes { On::Corners } else { On::Cells })?;
            }
            _ if section.starts_with('$') => msh.skip_section(&section)?,
            _ => return Err(msh.source.wrong(at, "a section such as $Nodes")),
        }
    }
    msh.connect(corners)?;
    Ok((msh.raw, msh.source))
}
