//! A checked profile before it is complete: what a printer or a process says, and one laid over the other.

use std::collections::BTreeMap;

use toml::Spanned;

use super::{
    Grid, Material, PrintPose, Quantity, Sourced, Support,
    profile::{ProfileText, Reader},
};

/// An id and the byte at which it stands in its file.
pub(super) type Reference = (String, usize);

/// What one profile says, or one over another.
#[derive(Debug, Default)]
pub(super) struct Layer {
    pub id: String,
    pub name: String,
    pub process: Option<String>,
    pub grid: Option<Grid>,
    pub support: Option<Support>,
    pub print_pose: Option<PrintPose>,
    pub cleaning: Option<String>,
    pub build_volume_mm: Option<Sourced<[f64; 3]>>,
    pub numbers: BTreeMap<Quantity, Sourced<f64>>,
    pub materials: Option<Vec<Reference>>,
    pub default_material: Option<Reference>,
    pub own_materials: Vec<Material>,
}

impl Layer {
    /// What `text` says; everything wrong with it is noted in `reader`.
    pub fn read(reader: &mut Reader, text: &ProfileText) -> Self {
        let numbers = text.numbers.iter();
        Self {
            id: reader.id(&text.id),
            name: reader.words("name", &text.name),
            process: None,
            grid: text.grid,
            support: text.support,
            print_pose: text.print_pose,
            cleaning: text.cleaning.as_ref().map(|cleaning| reader.words("cleaning", cleaning)),
            build_volume_mm: text.build_volume_mm.as_ref().and_then(|volume| reader.build_volume(volume)),
            numbers: numbers.filter_map(|(&key, quoted)| Some((key, reader.number(key, quoted)?))).collect(),
            materials: text.materials.as_ref().map(|list| list.get_ref().iter().map(reference).collect()),
            default_material: text.default_material.as_ref().map(reference),
            own_materials: text.material.iter().filter_map(|material| reader.material(material)).collect(),
        }
    }

    /// This layer, with what it leaves unsaid taken from a process.
    pub fn over(mut self, process: Self) -> Self {
        let default_of = Some(process.id.clone());
        for (key, number) in process.numbers {
            let inherited = Sourced { process_default_of: default_of.clone(), ..number };
            self.numbers.entry(key).or_insert(inherited);
        }
        Self {
            process: default_of,
            grid: self.grid.or(process.grid),
            support: self.support.or(process.support),
            print_pose: self.print_pose.or(process.print_pose),
            cleaning: self.cleaning.or(process.cleaning),
            default_material: self.default_material.or(self
                .materials
                .is_none()
                .then_some(process.default_material)
                .flatten()),
            materials: self.materials.or(process.materials),
            ..self
        }
    }
}

fn reference(id: &Spanned<String>) -> Reference {
    (id.get_ref().clone(), id.span().start)
}
