//! Reads `$NodeData` and `$ElementData` of a `.msh` file.

use super::super::values::Kind;
use super::error::{Place, VolumeError};
use super::msh_file::Msh;
use super::raw::{Array, On, VECTORS};

/// The head of data: its name, its components, and how many have a value.
struct Head {
    name: String,
    components: u64,
    count: u64,
}

/// Data of a file, with the values that are known so far.
struct Data {
    array: Array,
    is_known: Vec<bool>,
    components: usize,
}

impl Msh<'_> {
    /// Reads data with one value for each node or element; data of vectors is passed over.
    pub(super) fn section_data(&mut self, on: On) -> Result<(), VolumeError> {
        let place = self.source.here();
        let head = self.data_head()?;
        let items = match on {
            On::Corners => self.raw.vertices.len(),
            On::Cells => self.raw.cells.len(),
        };
        if items == 0 {
            return Err(VolumeError::Unsupported {
                place,
                found: "data before the nodes or elements that have it".to_owned(),
                remedy: "put $Nodes and $Elements before it",
            });
        }
        let components = self
            .source
            .claim(head.components, &[Kind::F64], "components")?;
        let mut data = Data {
            array: Array {
                name: head.name,
                on,
                is_whole: false,
                values: vec![f64::NAN; items],
                offsets: vec![self.source.values.offset(); items],
            },
            is_known: vec![false; items],
            components,
        };
        for _ in 0..self.source.claim(head.count, &[Kind::I32], "values")? {
            self.value(&mut data)?;
        }
        self.end(match on {
            On::Corners => "$EndNodeData",
            On::Cells => "$EndElementData",
        })?;
        if components != 1 {
            self.raw.ignore(VECTORS);
            return Ok(());
        }
        let array = self.complete(data, place)?;
        self.raw.add_array(array, place)
    }

    /// Reads the values of one node or element.
    fn value(&mut self, data: &mut Data) -> Result<(), VolumeError> {
        let at = self.source.begin();
        let what = "the number of a node or element";
        let number = self.source.whole(Kind::I32, what)?;
        let index = match data.array.on {
            On::Corners => self.nodes.index(number),
            On::Cells => self.cells.index(number),
        };
        // Data of an element that is no tetrahedron has no index.
        if index.is_none() && data.array.on == On::Corners {
            return Err(VolumeError::Unknown {
                place: self.source.place(at),
                thing: "node",
                number,
            });
        }
        for component in 0..data.components {
            let value = self.source.number(Kind::F64, "a value")?;
            if let (0, Some(index)) = (component, index) {
                data.array.values[index as usize] = value;
                data.array.offsets[index as usize] = at;
                data.is_known[index as usize] = true;
            }
        }
        Ok(())
    }

    /// Returns data with a value for everything that needs one.
    fn complete(&self, data: Data, place: Place) -> Result<Array, VolumeError> {
        let Data {
            mut array,
            is_known,
            ..
        } = data;
        let is_used = self.used(array.on);
        let missing = (0..is_known.len()).find(|&item| !is_known[item] && is_used[item]);
        if let Some(item) = missing {
            let (thing, number) = match array.on {
                On::Corners => ("node", self.nodes.number(item)),
                On::Cells => ("element", self.cells.number(item)),
            };
            return Err(VolumeError::NoValue {
                place,
                data: array.name,
                thing,
                number,
            });
        }
        // Nodes of no tetrahedron need no density.
        let values = array.values.iter_mut().zip(&is_known);
        let unused = values.filter(|(_, is_known)| !**is_known);
        unused.for_each(|(value, _)| *value = 0.0);
        Ok(array)
    }

    /// Returns which values tetrahedra need.
    fn used(&self, on: On) -> Vec<bool> {
        if on == On::Cells {
            return vec![true; self.raw.cells.len()];
        }
        let mut is_used = vec![false; self.raw.vertices.len()];
        let corners = self.raw.cells.iter().flatten();
        corners.for_each(|&corner| is_used[corner as usize] = true);
        is_used
    }

    fn data_head(&mut self) -> Result<Head, VolumeError> {
        let source = &mut self.source;
        let mut name = String::new();
        let strings = source.text_whole("the number of names")?;
        source.values.line();
        let most = source.values.left().len() as u64;
        for index in 0..strings.min(most) {
            let line = String::from_utf8_lossy(source.values.line()).into_owned();
            if index == 0 {
                name = line.trim_matches('"').to_owned();
            }
        }
        let reals = source.text_whole("the number of real tags")?;
        for _ in 0..reals.min(most) {
            source.text_word("a real tag")?;
        }
        let tags = source.text_whole("the number of whole tags")?;
        let mut whole = [0, 1, 0];
        for index in 0..tags.min(most) {
            let tag = source.text_whole("a whole tag")?;
            if let Some(kept) = whole.get_mut(index as usize) {
                *kept = tag;
            }
        }
        source.values.line();
        let [_, components, count] = whole;
        Ok(Head {
            name,
            components,
            count,
        })
    }
}
