//! Reads one model of a package: its unit, its objects and its build.

use std::collections::BTreeMap;

use super::archive::part_name;
use super::cura::CURA_PREFIX;
use super::error::{ThreeMfError, xml_fault};
use super::names::OUR_JOB;
use super::transform::Transform;
use super::xml::{Requirement, Scanner, Tag};
use crate::base::units::MM_PER_INCH;
use crate::geom::Point;
use crate::mesh::{MeshError, TriMesh};

/// The model in one part of a package.
#[derive(Debug, Default)]
pub struct Model {
    /// The unit of its numbers, mm.
    pub unit_mm: f64,
    /// Its objects by their identifiers.
    pub objects: BTreeMap<u32, Object>,
    /// The items of its build.
    pub items: Vec<Reference>,
    /// Whether it belongs to a kit of this program.
    pub is_kit: bool,
}

/// An object of a model, in the model's unit.
#[derive(Debug)]
pub struct Object {
    /// Its name; empty if it has none.
    pub name: String,
    /// True for a support structure and for an object that is not printed.
    pub is_aside: bool,
    /// Its settings in Cura's words.
    pub settings: BTreeMap<String, String>,
    /// Its triangles or components.
    pub content: Content,
}

/// The content of an object.
#[derive(Debug)]
pub enum Content {
    /// Triangles.
    Mesh(TriMesh),
    /// Other objects.
    Components(Vec<Reference>),
}

/// A reference to an object, with its place.
#[derive(Debug)]
pub struct Reference {
    /// The part that holds the object; `None` for the model's own part.
    pub part: Option<String>,
    /// The object's identifier.
    pub object: u32,
    /// Its place, in the unit of the referring model.
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
/// Extensions that do not change the shape: parts in several files, colours, names of faces.
const HARMLESS_EXTENSIONS: [&str; 3] = ["production/", "material/", "trianglesets/"];
/// The common beginning of the namespaces of the consortium's extensions.
const CONSORTIUM_PREFIX: &str = "http://schemas.microsoft.com/3dmanufacturing/";
/// The object types that are not the model itself (§4.1.1).
const ASIDE_TYPES: [&str; 3] = ["support", "solidsupport", "other"];

const fn requirement(
    element: &'static str,
    attribute: &'static str,
    expected: &'static str,
) -> Requirement {
    Requirement {
        element,
        attribute,
        expected,
    }
}

const UNIT: Requirement = requirement(
    "model",
    "unit",
    "micron, millimeter, centimeter, inch, foot or meter",
);
const OBJECT_ID: Requirement = requirement("object", "id", "a number from 1 on");
const REFERENCE_ID: Requirement =
    requirement("item or component", "objectid", "the number of an object");
const TRANSFORM: Requirement = requirement(
    "item or component",
    "transform",
    "twelve finite numbers that do not flatten the object",
);
const COORDINATES: [Requirement; 3] = [
    requirement("vertex", "x", "a finite number"),
    requirement("vertex", "y", "a finite number"),
    requirement("vertex", "z", "a finite number"),
];
const CORNERS: [Requirement; 3] = [
    requirement("triangle", "v1", "the number of a vertex"),
    requirement("triangle", "v2", "the number of a vertex"),
    requirement("triangle", "v3", "the number of a vertex"),
];

/// Reads the model in the text of a part.
pub fn read_model(part: &str, text: &str) -> Result<Model, ThreeMfError> {
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
            "object" => read_object(scanner, &tag, part, &mut model),
            _ => scanner.skip(&tag),
        }),
        "build" => {
            model.items = read_references(scanner, &tag, "item")?;
            Ok(())
        }
        "metadata" => {
            model.is_kit |= tag.get("name")?.as_deref() == Some(OUR_JOB);
            scanner.skip(&tag)
        }
        _ => scanner.skip(&tag),
    })?;
    Ok(model)
}

/// Refuses an extension that the model requires and that may change its shape.
fn check_extensions(root: &Tag) -> Result<(), ThreeMfError> {
    let needed = root.get("requiredextensions")?.unwrap_or_default();
    let namespaces = root.namespaces();
    for prefix in needed.split_ascii_whitespace() {
        let declared = namespaces.iter().find(|(name, _)| name == prefix);
        let extension = declared.map_or(prefix, |(_, namespace)| namespace.as_str());
        if !is_harmless(extension) {
            return Err(ThreeMfError::Extension {
                extension: extension.to_owned(),
            });
        }
    }
    Ok(())
}

/// Returns true if the extension, a namespace or an undeclared prefix, leaves the shape as it is.
fn is_harmless(extension: &str) -> bool {
    let name = extension.strip_prefix(CONSORTIUM_PREFIX);
    name.is_some_and(|name| {
        HARMLESS_EXTENSIONS
            .iter()
            .any(|start| name.starts_with(start))
    })
}

fn unit_mm(root: &Tag) -> Result<f64, ThreeMfError> {
    let Some(name) = root.get(UNIT.attribute)? else {
        return Ok(1.0);
    };
    let unit = UNITS.iter().find(|(unit, _)| *unit == name);
    unit.map(|(_, mm)| *mm)
        .ok_or_else(|| root.attribute_fault(&UNIT, &name))
}

fn read_object(
    scanner: &mut Scanner,
    tag: &Tag,
    part: &str,
    model: &mut Model,
) -> Result<(), ThreeMfError> {
    let id = tag.number(&OBJECT_ID)?;
    let name = tag.get("name")?.unwrap_or_default().into_owned();
    let is_aside = tag
        .get("type")?
        .is_some_and(|kind| ASIDE_TYPES.contains(&kind.as_ref()));
    let mut content = Content::Components(Vec::new());
    let mut settings = BTreeMap::new();
    scanner.children(tag, |scanner, tag| {
        match tag.name() {
            "metadatagroup" => read_settings(scanner, &tag, &mut settings)?,
            "mesh" => content = Content::Mesh(read_mesh(scanner, &tag, id)?),
            "components" => {
                content = Content::Components(read_references(scanner, &tag, "component")?)
            }
            _ => scanner.skip(&tag)?,
        }
        Ok(())
    })?;
    match model.objects.insert(
        id,
        Object {
            name,
            is_aside,
            settings,
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

/// Reads the settings in Cura's words among the metadata of an object.
fn read_settings(
    scanner: &mut Scanner,
    opened: &Tag,
    settings: &mut BTreeMap<String, String>,
) -> Result<(), ThreeMfError> {
    scanner.children(opened, |scanner, tag| {
        let name = tag.get("name")?.unwrap_or_default();
        if let Some(key) = name.strip_prefix(CURA_PREFIX) {
            let value = scanner.text().trim().to_owned();
            settings.insert(key.to_owned(), value);
        }
        scanner.skip(&tag)
    })
}

/// Reads the references in the children of `opened` that are called `element`.
fn read_references(
    scanner: &mut Scanner,
    opened: &Tag,
    element: &str,
) -> Result<Vec<Reference>, ThreeMfError> {
    let mut references = Vec::new();
    scanner.children(opened, |scanner, tag| {
        if tag.name() == element {
            references.push(read_reference(&tag)?);
        }
        scanner.skip(&tag)
    })?;
    Ok(references)
}

fn read_reference(tag: &Tag) -> Result<Reference, ThreeMfError> {
    let transform = match tag.get(TRANSFORM.attribute)? {
        Some(text) => {
            Transform::parse(&text).ok_or_else(|| tag.attribute_fault(&TRANSFORM, &text))?
        }
        None => Transform::default(),
    };
    let part = tag.get_prefixed("path")?.map(|path| part_name(&path));
    Ok(Reference {
        part,
        object: tag.number(&REFERENCE_ID)?,
        transform,
    })
}

/// Reads the triangles of a mesh, in the model's unit.
fn read_mesh(scanner: &mut Scanner, opened: &Tag, object: u32) -> Result<TriMesh, ThreeMfError> {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    scanner.children(opened, |scanner, tag| match tag.name() {
        "vertices" => scanner.children(&tag, |scanner, tag| {
            if tag.name() == "vertex" {
                vertices.push(read_vertex(&tag)?);
            }
            scanner.skip(&tag)
        }),
        "triangles" => scanner.children(&tag, |scanner, tag| {
            if tag.name() == "triangle" {
                triangles.push(read_corners(&tag)?);
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

/// Reads a vertex in single precision, as the consortium's own library and the slicers keep it. The
/// judgement then sees the same places as they do.
fn read_vertex(tag: &Tag) -> Result<Point, ThreeMfError> {
    let mut numbers = [0.0; 3];
    for (number, requirement) in numbers.iter_mut().zip(&COORDINATES) {
        let single = tag.number::<f32>(requirement)?;
        if !single.is_finite() {
            return Err(tag.attribute_fault(requirement, &single.to_string()));
        }
        *number = f64::from(single);
    }
    Ok(numbers.into())
}

fn read_corners(tag: &Tag) -> Result<[u32; 3], ThreeMfError> {
    let [a, b, c] = &CORNERS;
    Ok([tag.number(a)?, tag.number(b)?, tag.number(c)?])
}
