//! An object whose regions are objects of their own within it: so do OrcaSlicer and Cura have them.

use quick_xml::escape::escape;

use super::cura::{for_body, for_region, group_xml};
use super::settings::{PrintSettings, Subject};
use super::triangles::{mesh_xml, whole_facets};
use crate::base::dialect::Dialect;
use crate::mesh::TriMesh;

/// The words between the name of a part and the number of its region.
pub const REGION: &str = " sparse infill ";

/// The colour of an object.
pub struct Material {
    /// The identifier of the list of colours.
    pub id: usize,
    /// Its place in that list.
    pub index: usize,
}

/// An object and its pieces: its surface, then its regions.
pub struct Nested<'a> {
    /// The object as its settings name it.
    pub subject: Subject<'a>,
    /// Its pieces, facing outward.
    pub pieces: &'a [TriMesh],
}

impl Nested<'_> {
    /// Writes the pieces, numbered from `first` on, and the object that they are components of.
    pub fn to_xml(
        &self,
        first: usize,
        material: &Material,
        settings: Option<&PrintSettings>,
    ) -> String {
        let mut xml = String::new();
        let mut components = String::new();
        for (number, piece) in self.pieces.iter().enumerate() {
            let id = first + number;
            let mesh = mesh_xml(piece, &whole_facets(piece, |_| false));
            let content = self.group(number, settings) + &mesh;
            xml += &object_xml(
                id,
                &piece_name(self.subject.name, number),
                material,
                &content,
            );
            components += &format!("<component objectid=\"{id}\"/>");
        }
        let (id, name) = (self.subject.id, escape(self.subject.name));
        xml + &format!(
            "<object id=\"{id}\" type=\"model\" name=\"{name}\">\n\
             <components>{components}</components>\n</object>\n"
        )
    }

    /// Returns Cura's settings of a piece; nothing for other slicers.
    fn group(&self, number: usize, settings: Option<&PrintSettings>) -> String {
        let settings = settings.filter(|it| it.dialect == Dialect::Cura);
        let Some(settings) = settings else {
            return String::new();
        };
        let region = number
            .checked_sub(1)
            .and_then(|at| self.subject.infill.get(at));
        group_xml(&match region {
            Some(infill) => for_region(infill, number),
            None => for_body(settings),
        })
    }
}

/// Returns the name of a piece of an object: 0 is its body, and its regions follow.
pub fn piece_name(object: &str, number: usize) -> String {
    match number {
        0 => object.to_owned(),
        _ => format!("{object}{REGION}{number}"),
    }
}

/// Writes an object with a colour and its content.
pub fn object_xml(id: usize, name: &str, material: &Material, content: &str) -> String {
    let (colors, index, name) = (material.id, material.index, escape(name));
    format!(
        "<object id=\"{id}\" type=\"model\" name=\"{name}\" pid=\"{colors}\" pindex=\"{index}\">\n\
         {content}</object>\n"
    )
}
