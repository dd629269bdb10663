//! The checked content of one profile, and the merging of a profile with its parent.

use std::collections::BTreeMap;

use toml::Spanned;

use super::{
    ExcludedCorner, Grid, InfillPattern, Material, PrintPose, Quantity, SizedWall, Sourced,
    Support, profile::ProfileText, reader::Reader,
};
use crate::base::dialect::Dialect;

/// An id that a profile refers to.
#[derive(Debug)]
pub(super) struct Reference {
    pub id: String,
    /// Byte offset of the id in its file.
    pub at: usize,
}

/// The values of one profile, or of a profile merged with its parents.
#[derive(Debug, Default)]
pub(super) struct Layer {
    pub id: String,
    pub name: String,
    pub inherits: Vec<String>,
    pub process: Option<String>,
    pub grid: Option<Grid>,
    pub support: Option<Support>,
    pub print_pose: Option<PrintPose>,
    pub cleaning: Option<String>,
    pub glue: Option<String>,
    pub glue_safety: Option<String>,
    pub build_volume_mm: Option<Sourced<[f64; 3]>>,
    pub largest_part_mm: Option<Sourced<[f64; 3]>>,
    pub excluded_corners: Vec<ExcludedCorner>,
    pub walls_by_part_size: Vec<SizedWall>,
    pub compensates_shrinkage: Option<Sourced<bool>>,
    pub dialect: Option<Sourced<Dialect>>,
    pub infill: Option<InfillPattern>,
    pub numbers: BTreeMap<Quantity, Sourced<f64>>,
    pub materials: Option<Vec<Reference>>,
    pub default_material: Option<Reference>,
    pub own_materials: Vec<Material>,
}

impl Layer {
    /// Checks the values of `text`; `reader` collects the faults.
    pub fn read(reader: &mut Reader, text: &ProfileText) -> Self {
        let numbers = text.numbers.iter();
        let mut words =
            |key, text: &Option<Spanned<String>>| text.as_ref().map(|text| reader.words(key, text));
        let (cleaning, glue) = (words("cleaning", &text.cleaning), words("glue", &text.glue));
        let glue_safety = words("glue_safety", &text.glue_safety);
        let infill = reader.infill(text);
        let dialect = text.dialect.as_ref().and_then(|it| reader.dialect(it));
        Self {
            id: reader.id(&text.id),
            name: reader.words("name", &text.name),
            inherits: Vec::new(),
            process: None,
            grid: text.grid,
            support: text.support,
            print_pose: text.print_pose,
            cleaning,
            glue,
            glue_safety,
            build_volume_mm: text
                .build_volume_mm
                .as_ref()
                .and_then(|volume| reader.volume("build_volume_mm", volume)),
            largest_part_mm: text
                .largest_part_mm
                .as_ref()
                .and_then(|volume| reader.volume("largest_part_mm", volume)),
            excluded_corners: text
                .excluded_corners
                .iter()
                .filter_map(|at| reader.corner(at))
                .collect(),
            walls_by_part_size: text
                .walls_by_part_size
                .iter()
                .filter_map(|wall| reader.sized_wall(wall))
                .collect(),
            compensates_shrinkage: text
                .compensates_shrinkage
                .as_ref()
                .and_then(|flag| reader.flag("compensates_shrinkage", flag)),
            dialect,
            infill,
            numbers: numbers
                .filter_map(|(&key, number)| Some((key, reader.number(key, number)?)))
                .collect(),
            materials: text
                .materials
                .as_ref()
                .map(|list| list.get_ref().iter().map(reference).collect()),
            default_material: text.default_material.as_ref().map(reference),
            own_materials: text
                .material
                .iter()
                .filter_map(|material| reader.material(material))
                .collect(),
        }
    }

    /// Marks all numbers of this process as its defaults.
    pub fn into_defaults(mut self) -> Self {
        let id = self.id.clone();
        let walls = self
            .walls_by_part_size
            .iter_mut()
            .map(|wall| &mut wall.wall_mm);
        for number in self.numbers.values_mut().chain(walls) {
            number.process_default_of = Some(id.clone());
        }
        if let Some(flag) = &mut self.compensates_shrinkage {
            flag.process_default_of = Some(id.clone());
        }
        if let Some(dialect) = &mut self.dialect {
            dialect.process_default_of = Some(id.clone());
        }
        if let Some(infill) = &mut self.infill {
            infill.core_ratio.process_default_of = Some(id.clone());
        }
        self.process = Some(id);
        self
    }

    /// Fills the values that this layer does not set with those of its parent.
    pub fn over(mut self, parent: Self) -> Self {
        // A machine's own wall takes precedence over the walls by part size of its process.
        let has_wall =
            self.numbers.contains_key(&Quantity::MinWallMm) || !self.walls_by_part_size.is_empty();
        for (key, number) in parent.numbers {
            self.numbers.entry(key).or_insert(number);
        }
        let has_own = |id: &String, own: &[Material]| own.iter().any(|material| material.id == *id);
        let inherited: Vec<Material> = parent
            .own_materials
            .into_iter()
            .filter(|material| !has_own(&material.id, &self.own_materials))
            .collect();
        Self {
            inherits: std::iter::once(parent.id).chain(parent.inherits).collect(),
            process: parent.process,
            grid: self.grid.or(parent.grid),
            support: self.support.or(parent.support),
            print_pose: self.print_pose.or(parent.print_pose),
            cleaning: self.cleaning.or(parent.cleaning),
            glue: self.glue.or(parent.glue),
            glue_safety: self.glue_safety.or(parent.glue_safety),
            build_volume_mm: self.build_volume_mm.or(parent.build_volume_mm),
            largest_part_mm: self.largest_part_mm.or(parent.largest_part_mm),
            excluded_corners: first_of(self.excluded_corners, parent.excluded_corners),
            walls_by_part_size: if has_wall {
                self.walls_by_part_size
            } else {
                parent.walls_by_part_size
            },
            compensates_shrinkage: self.compensates_shrinkage.or(parent.compensates_shrinkage),
            dialect: self.dialect.or(parent.dialect),
            infill: self.infill.or(parent.infill),
            default_material: self.default_material.or(self
                .materials
                .is_none()
                .then_some(parent.default_material)
                .flatten()),
            materials: self.materials.or(parent.materials),
            own_materials: self.own_materials.into_iter().chain(inherited).collect(),
            ..self
        }
    }
}

/// Returns the first list, or the second if the first is empty.
fn first_of<T>(first: Vec<T>, second: Vec<T>) -> Vec<T> {
    if first.is_empty() { second } else { first }
}

fn reference(id: &Spanned<String>) -> Reference {
    Reference {
        id: id.get_ref().clone(),
        at: id.span().start,
    }
}
