//! One model of a package: its unit, its objects, and where its build puts them.

use std::collections::BTreeMap;

use super::{
    ThreeMfError, Transform,
    archive::{part_name, xml_fault},
    xml::{Scanner, Tag, Wanted},
};
use crate::base::units::MM_PER_INCH;
use crate::geom::Point;
use crate::mesh::{MeshError, TriMesh};

/// What one part of a package says.
#[derive(Debug, Default)]
pub struct Model {
    /// The unit of its numbers, mm.
    pub unit_mm: f64,
    /// Its objects by their identifiers.
    pub objects: BTreeMap<u32, Object>,
    /// What its build places.
    pub items: Vec<Reference>,
}

/// An object of a model, in the model's unit.
#[derive(Debug)]
pub struct Object {
    /// Empty without one.
    pub name: String,
    /// Whether it only supports others while they are printed, or is not printed at all.
    pub is_aside: bool,
    /// What it is made of.
    pub content: Content,
}

/// What an object is made of.
#[derive(Debug)]
pub enum Content {
    /// Triangles.
    Mesh(TriMesh),
    /// Other objects.
    Components(Vec<Reference>),
}

/// An object put somewhere.
#[derive(Debug)]
pub struct Reference {
    /// The part that holds it; none for the model's own.
    pub part: Option<String>,
    /// Its identifier.
    pub object: u32,
    /// Where it is put, in the unit of the model that says so.
    pub transform: Transform,
}

/// The units of the core specification (§3.4) in mm.
const UNITS: [(&str, f64); 6] = [
    ("micron", 1e-3),
    ("millimeter", 1.0),
    ("centimeter", 10.0),
    ("inch", MM_PER_INCH),
    ("foot", 12.0 * MM_PER_INCH),
    ("meter", 1e3),
];
/// Extensions that leave the shape as the core's triangles say: parts in several files, colours,
/// names of faces.
const HARMLESS: [&str; 3] = ["production/", "material/", "trianglesets/"];
/// What the names of the consortium's extensions begin with.
const CONSORTIUM: &str = "http://schemas.microsoft.com/3dmanufacturing/";
/// The kinds of objects that are not the model itself (§4.1.1).
const ASIDE: [&str; 3] = ["support", "solidsupport", "other"];

const fn wanted(element: &'static str, attribute: &'static str, expected: &'static str) -> Wanted {
    Wanted {
        element,
        attribute,
        expected,
    }
}

const UNIT: Wanted = wanted(
    "model",
    "unit",
    "micron, millimeter, centimeter, inch, foot or meter",
);
const OBJECT_ID: Wanted = wanted("object", "id", "a number from 1 on");
const REFERENCE_ID: Wanted = wanted("item or component", "objectid", "the number of an object");
const TRANSFORM: Wanted = wanted(
    "item or component",
    "transform",
    "twelve finite numbers that do not flatten the object",
);
const COORDINATES: [Wanted; 3] = [
    wanted("vertex", "x", "a finite number"),
    wanted("vertex", "y", "a finite number"),
    wanted("vertex", "z", "a finite number"),
];
const CORNERS: [Wanted; 3] = [
    wanted("triangle", "v1", "the number of a vertex"),
    wanted("triangle", "v2", "the number of a vertex"),
    wanted("triangle", "v3", "the number of a vertex"),
];

/// The model in the text of that part.
pub fn model(part: &str, text: &str) -> Result<Model, ThreeMfError> {
    let mut scanner = Scanner::new(part, text);
    let root = scanner.next_tag()?.filter(|tag| tag.name() == "model");
    let root = root.ok_or_else(|| xml_fault(part, 1, "there is no <model> in it"))?;
    check_extensions(&root)?;
    let mut model = Model {
        unit_mm: unit_mm(&root)?,
        ..Model::default()
    };
    scanner.children(&root, |scanner, tag| match tag.name() {
        "resources" => scanner.children(&tag, |scanner, tag| match tag.name() {
            "object" => take_object(scanner, &tag, part, &mut model),
            _ => scanner.skip(&tag),
        }),
        "build" => {
            model.items = references(scanner, &tag, "item")?;
            Ok(())
        }
        _ => scanner.skip(&tag),
    })?;
    Ok(model)
}

/// Refuses extensions that the model needs and that may change its shape.
fn check_extensions(root: &Tag) -> Result<(), ThreeMfError> {
    let needed = root.get("requiredextensions")?.unwrap_or_default();
    let namespaces = root.namespaces();
    for prefix in needed.split_ascii_whitespace() {
        let declared = namespaces.iter().find(|(name, _)| name == prefix);
        let extension = declared.map_or(prefix, |(_, namespace)| namespace.as_str());
        let name = extension.strip_prefix(CONSORTIUM);
        if !name.is_some_and(|name| HARMLESS.iter().any(|harmless| name.starts_with(harmless))) {
            return Err(ThreeMfError::Extension {
                extension: extension.to_owned(),
            });
        }
    }
    Ok(())
}

fn unit_mm(root: &Tag) -> Result<f64, ThreeMfError> {
    let Some(name) = root.get(UNIT.attribute)? else {
        return Ok(1.0);
    };
    let unit = UNITS.iter().find(|(unit, _)| *unit == name);
    unit.map(|(_, mm)| *mm)
        .ok_or_else(|| root.not(&UNIT, &name))
}

fn take_object(
    scanner: &mut Scanner,
    tag: &Tag,
    part: &str,
    model: &mut Model,
) -> Result<(), ThreeMfError> {
    let id = tag.number(&OBJECT_ID)?;
    let name = tag.get("name")?.unwrap_or_default().into_owned();
    let is_aside = tag
        .get("type")?
        .is_some_and(|kind| ASIDE.contains(&kind.as_ref()));
    let mut content = Content::Components(Vec::new());
    scanner.children(tag, |scanner, tag| {
        match tag.name() {
            "mesh" => content = Content::Mesh(mesh(scanner, &tag, id)?),
            "components" => content = Content::Components(references(scanner, &tag, "component")?),
            _ => scanner.skip(&tag)?,
        }
        Ok(())
    })?;
    match model.objects.insert(
        id,
        Object {
            name,
            is_aside,
            content,
        },
    ) {
        None => Ok(()),
        Some(_) => Err(ThreeMfError::Twice {
            part: part.to_owned(),
            object: id,
        }),
    }
}

/// The objects that the elements of that name in the one that was opened place.
fn references(
    scanner: &mut Scanner,
    opened: &Tag,
    element: &str,
) -> Result<Vec<Reference>, ThreeMfError> {
    let mut references = Vec::new();
    scanner.children(opened, |scanner, tag| {
        if tag.name() == element {
            references.push(reference(&tag)?);
        }
        scanner.skip(&tag)
    })?;
    Ok(references)
}

fn reference(tag: &Tag) -> Result<Reference, ThreeMfError> {
    let transform = match tag.get(TRANSFORM.attribute)? {
        Some(text) => Transform::parse(&text).ok_or_else(|| tag.not(&TRANSFORM, &text))?,
        None => Transform::default(),
    };
    let part = tag.prefixed("path")?.map(|path| part_name(&path));
    Ok(Reference {
        part,
        object: tag.number(&REFERENCE_ID)?,
        transform,
    })
}

/// The triangles of a mesh, in the model's unit.
fn mesh(scanner: &mut Scanner, opened: &Tag, object: u32) -> Result<TriMesh, ThreeMfError> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    scanner.children(opened, |scanner, tag| match tag.name() {
        "vertices" => scanner.children(&tag, |scanner, tag| {
            if tag.name() == "vertex" {
                vertices.push(vertex(&tag)?);
            }
            scanner.skip(&tag)
        }),
        "triangles" => scanner.children(&tag, |scanner, tag| {
            if tag.name() == "triangle" {
                triangles.push(corners(&tag)?);
            }
            scanner.skip(&tag)
        }),
        _ => scanner.skip(&tag),
    })?;
    TriMesh::new(vertices, triangles).map_err(|error| {
        let MeshError::IndexOutOfRange {
            triangle,
            vertex,
            vertices,
        } = error;
        ThreeMfError::IndexOutOfRange {
            object,
            triangle,
            vertex,
            vertices,
        }
    })
}

/// A vertex in single precision, as the consortium's own library and the slicers keep it: what is
/// judged is what they see.
fn vertex(tag: &Tag) -> Result<Point, ThreeMfError> {
    let mut numbers = [0.0; 3];
    for (number, wanted) in numbers.iter_mut().zip(&COORDINATES) {
        let single = tag.number::<f32>(wanted)?;
        if !single.is_finite() {
            return Err(tag.not(wanted, &single.to_string()));
        }
        *number = f64::from(single);
    }
    Ok(numbers.into())
}

fn corners(tag: &Tag) -> Result<[u32; 3], ThreeMfError> {
    let [a, b, c] = &CORNERS;
    Ok([tag.number(a)?, tag.number(b)?, tag.number(c)?])
}
