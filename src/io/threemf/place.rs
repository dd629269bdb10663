//! The objects of a package where its build puts them: components resolved, units and transforms
//! applied.

use std::collections::BTreeMap;

use super::{
    Limit, PlacedObject, ThreeMfError, Transform,
    archive::Archive,
    read::{Content, Model, Object, Reference, model},
};
use crate::mesh::TriMesh;

/// The objects that the model in that part builds.
pub fn placed(archive: &mut Archive, root: &str) -> Result<Vec<PlacedObject>, ThreeMfError> {
    let models = models(archive, root)?;
    let mut builder = Builder {
        models: &models,
        path: Vec::new(),
        places: 0,
        triangles: 0,
        found: Vec::new(),
    };
    for item in models.get(root).iter().flat_map(|model| &model.items) {
        builder.place(root, item, &Transform::default())?;
    }
    if builder.triangles == 0 {
        return Err(ThreeMfError::NoTriangles);
    }
    Ok(builder.found)
}

/// The model in that part, and all that its objects are taken from, by their parts.
fn models(archive: &mut Archive, root: &str) -> Result<BTreeMap<String, Model>, ThreeMfError> {
    let mut models = BTreeMap::new();
    let mut waiting = vec![root.to_owned()];
    while let Some(part) = waiting.pop() {
        if models.contains_key(&part) {
            continue;
        }
        let model = model(&part, &archive.text(&part)?)?;
        waiting.extend(references(&model).filter_map(|reference| reference.part.clone()));
        models.insert(part, model);
        if models.len() as u64 > Limit::Models.most() {
            return Err(ThreeMfError::TooMuch {
                limit: Limit::Models,
            });
        }
    }
    Ok(models)
}

/// Every place that a model speaks of.
fn references(model: &Model) -> impl Iterator<Item = &Reference> {
    let components = model
        .objects
        .values()
        .flat_map(|object| match &object.content {
            Content::Components(components) => components.as_slice(),
            Content::Mesh(_) => &[],
        });
    model.items.iter().chain(components)
}

/// Puts objects where they belong, and counts.
struct Builder<'a> {
    models: &'a BTreeMap<String, Model>,
    /// The objects within which the one at work lies.
    path: Vec<(&'a str, u32)>,
    places: u64,
    triangles: u64,
    found: Vec<PlacedObject>,
}

impl<'a> Builder<'a> {
    /// Places what a model of that part refers to; `outer` takes that model's place to the build,
    /// both in mm.
    fn place(
        &mut self,
        part: &'a str,
        reference: &'a Reference,
        outer: &Transform,
    ) -> Result<(), ThreeMfError> {
        let unit_mm = self.models.get(part).map_or(1.0, |model| model.unit_mm);
        let (part, id) = (reference.part.as_deref().unwrap_or(part), reference.object);
        let missing = || ThreeMfError::NoObject {
            part: part.to_owned(),
            object: id,
        };
        let model = self.models.get(part).ok_or_else(missing)?;
        let object = model.objects.get(&id).ok_or_else(missing)?;
        if self.path.contains(&(part, id)) {
            return Err(ThreeMfError::Circle {
                part: part.to_owned(),
                object: id,
            });
        }
        within(Limit::Depth, self.path.len() as u64)?;
        self.places += 1;
        within(Limit::Places, self.places)?;
        let inner = Transform {
            shift: reference.transform.shift * unit_mm,
            ..reference.transform
        };
        let map = inner.then(outer);
        if object.is_aside {
            return Ok(());
        }
        self.path.push((part, id));
        self.take(object, model.unit_mm, &map)?;
        self.path.pop();
        Ok(())
    }

    /// Takes the object on top of the path, of a model in that unit.
    fn take(
        &mut self,
        object: &'a Object,
        unit_mm: f64,
        map: &Transform,
    ) -> Result<(), ThreeMfError> {
        let Some(&(part, id)) = self.path.last() else {
            return Ok(());
        };
        match &object.content {
            Content::Components(components) => components
                .iter()
                .try_for_each(|component| self.place(part, component, map)),
            Content::Mesh(mesh) => {
                self.triangles += mesh.triangles().len() as u64;
                within(Limit::Triangles, self.triangles)?;
                let mesh = laid(mesh, unit_mm, map);
                if !mesh
                    .vertices()
                    .iter()
                    .all(|p| p.coords.iter().all(|x| x.is_finite()))
                {
                    return Err(ThreeMfError::NotFinite { object: id });
                }
                self.found.push(PlacedObject {
                    name: object.name.clone(),
                    mesh,
                });
                Ok(())
            }
        }
    }
}

/// The mesh in mm where the map puts it, turned outward again where the map mirrors it.
fn laid(mesh: &TriMesh, unit_mm: f64, map: &Transform) -> TriMesh {
    let moved = mesh.map_vertices(|p| map.apply(&(p * unit_mm)));
    if map.mirrors() {
        moved.reversed()
    } else {
        moved
    }
}

fn within(limit: Limit, count: u64) -> Result<(), ThreeMfError> {
    if count > limit.most() {
        Err(ThreeMfError::TooMuch { limit })
    } else {
        Ok(())
    }
}
