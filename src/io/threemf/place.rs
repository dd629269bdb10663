//! Places the objects of a package as its build says: resolves components, applies units and
//! transforms.

use std::collections::{BTreeMap, BTreeSet};

use super::archive::Archive;
use super::error::{Limit, ThreeMfError};
use super::orders::find_regions;
use super::read::{Content, Model, Object, Reference, read_model};
use super::transform::Transform;
use crate::mesh::TriMesh;

/// An object at the place that the package's build gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedObject {
    /// The identifier of its triangles in the package.
    pub id: u32,
    /// Its name in the package; empty if it has none.
    pub name: String,
    /// Its triangles in the coordinates of the build, mm.
    pub mesh: TriMesh,
}

/// Returns the objects that the build of the model in part `root` places.
pub fn place_objects(archive: &mut Archive, root: &str) -> Result<Vec<PlacedObject>, ThreeMfError> {
    let models = read_models(archive, root)?;
    // Of a strange package, nobody knows what its author meant by a part that is not printed.
    let is_kit = models.get(root).is_some_and(|model| model.is_kit);
    let regions = match is_kit {
        true => find_regions(archive, &models)?,
        false => BTreeSet::new(),
    };
    let mut builder = Builder {
        models: &models,
        regions: &regions,
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

/// Reads the model in part `root` and all models it refers to; keyed by part.
fn read_models(archive: &mut Archive, root: &str) -> Result<BTreeMap<String, Model>, ThreeMfError> {
    let mut models = BTreeMap::new();
    let mut waiting = vec![root.to_owned()];
    while let Some(part) = waiting.pop() {
        if models.contains_key(&part) {
            continue;
        }
        let model = read_model(&part, &archive.text(&part)?)?;
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

/// Returns every reference in a model: the items of its build and the components of its objects.
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

/// Places objects and counts them against the limits.
struct Builder<'a> {
    models: &'a BTreeMap<String, Model>,
    /// The objects that are regions of other infill within their object.
    regions: &'a BTreeSet<u32>,
    /// The chain of objects that contain the current one, itself included.
    path: Vec<(&'a str, u32)>,
    places: u64,
    triangles: u64,
    found: Vec<PlacedObject>,
}

impl<'a> Builder<'a> {
    /// Places the object that a model of `part` refers to. `outer` maps that model's
    /// coordinates to the build's, both in mm.
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
        check_limit(Limit::Depth, self.path.len() as u64)?;
        self.places += 1;
        check_limit(Limit::Places, self.places)?;
        let inner = Transform {
            shift: reference.transform.shift * unit_mm,
            ..reference.transform
        };
        let map = inner.then(outer);
        if object.is_aside {
            return Ok(());
        }
        self.path.push((part, id));
        self.add(object, model.unit_mm, &map)?;
        self.path.pop();
        Ok(())
    }

    /// Adds the meshes of the object at the end of the path; `unit_mm` is its model's unit.
    fn add(
        &mut self,
        object: &'a Object,
        unit_mm: f64,
        map: &Transform,
    ) -> Result<(), ThreeMfError> {
        let Some(&(part, id)) = self.path.last() else {
            return Ok(());
        };
        match &object.content {
            Content::Components(components) => {
                let first = self.found.len();
                let mut all = components.iter();
                all.try_for_each(|component| self.place(part, component, map))?;
                let mut pieces = self.found[first..].iter();
                if pieces.any(|piece| self.regions.contains(&piece.id)) {
                    self.join(first, id, &object.name);
                }
                Ok(())
            }
            Content::Mesh(mesh) => {
                self.triangles += mesh.triangles().len() as u64;
                check_limit(Limit::Triangles, self.triangles)?;
                let mesh = apply_map(mesh, unit_mm, map);
                if !mesh
                    .vertices()
                    .iter()
                    .all(|p| p.coords.iter().all(|x| x.is_finite()))
                {
                    return Err(ThreeMfError::NotFinite { object: id });
                }
                self.found.push(PlacedObject {
                    id,
                    name: object.name.clone(),
                    mesh,
                });
                Ok(())
            }
        }
    }
}

impl Builder<'_> {
    /// Joins the pieces of an object to one, whose regions face inward as cavities do.
    fn join(&mut self, first: usize, id: u32, name: &str) {
        let pieces = self.found.drain(first..);
        let mesh = pieces.fold(TriMesh::default(), |whole, piece| {
            match self.regions.contains(&piece.id) {
                true => whole.joined(&piece.mesh.reversed()),
                false => whole.joined(&piece.mesh),
            }
        });
        self.found.push(PlacedObject {
            id,
            name: name.to_owned(),
            mesh,
        });
    }
}

/// Converts the mesh to mm and applies the map; reverses the triangles if the map mirrors.
fn apply_map(mesh: &TriMesh, unit_mm: f64, map: &Transform) -> TriMesh {
    let moved = mesh.map_vertices(|p| map.apply(&(p * unit_mm)));
    if map.mirrors() {
        moved.reversed()
    } else {
        moved
    }
}

fn check_limit(limit: Limit, count: u64) -> Result<(), ThreeMfError> {
    if count > limit.most() {
        Err(ThreeMfError::TooMuch { limit })
    } else {
        Ok(())
    }
}
