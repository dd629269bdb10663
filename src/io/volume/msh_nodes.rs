//! Reads `$Nodes` of a `.msh` file.

use super::super::values::Kind;
use super::error::VolumeError;
use super::msh_file::{Msh, Version};

impl Msh<'_> {
    /// Reads the nodes.
    pub(super) fn section_nodes(&mut self) -> Result<(), VolumeError> {
        let at = self.source.values.offset();
        self.source.values.line();
        match self.version {
            Version::Two => self.nodes_two()?,
            Version::Four => self.nodes_four()?,
        }
        if let Some(number) = self.nodes.sort() {
            return Err(VolumeError::Twice {
                place: self.source.place(at),
                name: format!("node {number}"),
            });
        }
        self.end("$EndNodes")
    }

    fn nodes_two(&mut self) -> Result<(), VolumeError> {
        let count = self.count("the number of nodes")?;
        let each = [Kind::I32, Kind::F64, Kind::F64, Kind::F64];
        for _ in 0..self.source.claim(count, &each, "nodes")? {
            let number = self.source.whole(Kind::I32, "the number of a node")?;
            self.nodes.push(number);
            self.raw.vertices.push(self.source.point(Kind::F64)?);
        }
        Ok(())
    }

    fn nodes_four(&mut self) -> Result<(), VolumeError> {
        let source = &mut self.source;
        let blocks = source.whole(Kind::U64, "the number of blocks")?;
        for _ in 0..3 {
            source.whole(Kind::U64, "the numbers of nodes")?;
        }
        let head = [Kind::I32, Kind::I32, Kind::I32, Kind::U64];
        for _ in 0..source.claim(blocks, &head, "blocks of nodes")? {
            let dimension = source.whole(Kind::I32, "the dimension of a block")?.min(3);
            source.number(Kind::I32, "the number of a block")?;
            let is_parametric = source.whole(Kind::I32, "0 or 1")? == 1;
            let count = source.whole(Kind::U64, "the number of nodes in a block")?;
            let each = [Kind::U64, Kind::F64, Kind::F64, Kind::F64];
            let count = source.claim(count, &each, "nodes")?;
            for _ in 0..count {
                self.nodes
                    .push(source.whole(Kind::U64, "the number of a node")?);
            }
            for _ in 0..count {
                self.raw.vertices.push(source.point(Kind::F64)?);
                for _ in 0..if is_parametric { dimension } else { 0 } {
                    source.number(Kind::F64, "a parameter of a node")?;
                }
            }
        }
        Ok(())
    }
}
