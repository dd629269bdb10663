//! Writing 3MF packages: objects with names and colours, each where it belongs.

use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

use quick_xml::escape::escape;
use zip::{CompressionMethod, System, ZipWriter, write::SimpleFileOptions};

use super::{CONTENT_TYPES, CORE_NAMESPACE, MODEL_PART, MODEL_TYPE, RELATIONSHIPS, Transform};
use crate::geom::Point;
use crate::mesh::TriMesh;
use crate::repair::weld;

/// A package to be written.
#[derive(Debug, Clone)]
pub struct Package<'a> {
    /// What it is called.
    pub title: String,
    /// What it shows, in a sentence.
    pub description: String,
    /// The job it belongs to.
    pub job: String,
    /// The objects; those that are placed nowhere are left out.
    pub objects: &'a [Object],
    /// Where each of them lies.
    pub build: Build,
}

/// Where the objects of a package lie; places are indices of its objects with their maps.
#[derive(Debug, Clone, PartialEq)]
pub enum Build {
    /// Each by itself, as things to be printed do.
    Apart(Vec<(usize, Transform)>),
    /// All of them as the components of one object of that name.
    Together(String, Vec<(usize, Transform)>),
}

impl Build {
    fn places(&self) -> &[(usize, Transform)] {
        match self {
            Self::Apart(places) | Self::Together(_, places) => places,
        }
    }
}

/// An object of a package, its triangles already written.
#[derive(Debug, Clone)]
pub struct Object {
    name: String,
    color: [u8; 3],
    mesh_xml: String,
}

/// Why a package could not be put together.
#[derive(Debug, thiserror::Error)]
#[error("the 3MF package {title} cannot be put together; remedy: ask for --format stl")]
pub struct PackageError {
    /// Its title.
    title: String,
    /// What the archive says.
    source: zip::result::ZipError,
}

/// The identifier of the colours of a package; objects follow it.
const COLORS_ID: usize = 1;
/// How hard is compressed, 1 to 9. On meshes 6 takes four times as long as 3 for a tenth less.
const COMPRESSION_LEVEL: i64 = 3;
/// The names of metadata of our own are in this namespace.
const OUR_NAMESPACE: &str = "urn:equipoise:kit";
/// Who may read and write an extracted file, on systems that keep that.
const PERMISSIONS: u32 = 0o644;

impl Object {
    /// An object of that name and colour (red, green, blue).
    ///
    /// Coordinates are rounded to single precision and written with the fewest digits that give
    /// them back; corners that fall together become one, and triangles that lose a corner are left
    /// out, as in a binary STL file of the same mesh: both hold the same triangles in the same
    /// order.
    pub fn new(name: &str, color: [u8; 3], mesh: &TriMesh) -> Self {
        Self {
            name: name.to_owned(),
            color,
            mesh_xml: mesh_xml(mesh),
        }
    }
}

impl Package<'_> {
    /// The bytes of the package: the same for the same input, on any machine.
    pub fn encode(&self) -> Result<Vec<u8>, PackageError> {
        let model = self.model_xml();
        let parts = [
            ("[Content_Types].xml", content_types()),
            ("_rels/.rels", relationships()),
            (MODEL_PART, model),
        ];
        archive(&parts).map_err(|source| PackageError {
            title: self.title.clone(),
            source,
        })
    }

    fn model_xml(&self) -> String {
        let is_placed =
            |(index, _): &(usize, &Object)| self.build.places().iter().any(|(at, _)| at == index);
        let objects: String = self
            .objects
            .iter()
            .enumerate()
            .filter(is_placed)
            .map(object_xml)
            .collect();
        let (joined, build) = self.build_xml();
        let colors: String = self.objects.iter().map(color_xml).collect();
        let head = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" \
             xmlns=\"{CORE_NAMESPACE}\" xmlns:equipoise=\"{OUR_NAMESPACE}\">\n"
        );
        let metadata: String = self
            .metadata()
            .iter()
            .map(|(name, value)| metadata_xml(name, value))
            .collect();
        format!(
            "{head}{metadata}<resources>\n<basematerials id=\"{COLORS_ID}\">{colors}</basematerials>\n{objects}{joined}\
             </resources>\n<build>{build}</build>\n</model>\n"
        )
    }

    fn metadata(&self) -> [(&'static str, String); 4] {
        let application = format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
        [
            ("Title", self.title.clone()),
            ("Description", self.description.clone()),
            ("Application", application),
            ("equipoise:Job", self.job.clone()),
        ]
    }

    /// The object that holds the others, if there is one, and the items of the build.
    fn build_xml(&self) -> (String, String) {
        match &self.build {
            Build::Apart(places) => (String::new(), places_xml("item", places)),
            Build::Together(name, places) => {
                let (id, name) = (object_id(self.objects.len()), escape(name.as_str()));
                let components = places_xml("component", places);
                let object = format!(
                    "<object id=\"{id}\" type=\"model\" name=\"{name}\">\n<components>{components}</components>\n</object>\n"
                );
                (object, format!("<item objectid=\"{id}\"/>"))
            }
        }
    }
}

/// The identifier of the object at that index.
fn object_id(index: usize) -> usize {
    COLORS_ID + 1 + index
}

fn metadata_xml(name: &str, value: &str) -> String {
    format!("<metadata name=\"{name}\">{}</metadata>\n", escape(value))
}

fn color_xml(object: &Object) -> String {
    let [red, green, blue] = object.color;
    format!(
        "<base name=\"{}\" displaycolor=\"#{red:02X}{green:02X}{blue:02X}FF\"/>",
        escape(object.name.as_str())
    )
}

fn object_xml((index, object): (usize, &Object)) -> String {
    let (id, name) = (object_id(index), escape(object.name.as_str()));
    format!(
        "<object id=\"{id}\" type=\"model\" name=\"{name}\" pid=\"{COLORS_ID}\" pindex=\"{index}\">\n{}</object>\n",
        object.mesh_xml
    )
}

/// The places as elements of that name.
fn places_xml(element: &str, places: &[(usize, Transform)]) -> String {
    let place = |(index, map): &(usize, Transform)| {
        let numbers = map.numbers().map(|x| (x + 0.0).to_string()).join(" ");
        format!(
            "<{element} objectid=\"{}\" transform=\"{numbers}\"/>",
            object_id(*index)
        )
    };
    places.iter().map(place).collect()
}

/// The mesh as the format writes it, in single precision.
fn mesh_xml(mesh: &TriMesh) -> String {
    let mesh = weld(&mesh.map_vertices(rounded));
    let mut xml = String::from("<mesh><vertices>");
    for p in mesh.vertices() {
        // Writing into a string cannot fail.
        let _ = write!(
            xml,
            "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>",
            p.x as f32, p.y as f32, p.z as f32
        );
    }
    xml.push_str("</vertices>\n<triangles>");
    for [a, b, c] in mesh
        .triangles()
        .iter()
        .filter(|[a, b, c]| a != b && b != c && c != a)
    {
        let _ = write!(xml, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"/>");
    }
    xml.push_str("</triangles></mesh>\n");
    xml
}

/// The point in single precision, with no −0.0.
fn rounded(p: &Point) -> Point {
    p.map(|x| f64::from(x as f32) + 0.0)
}

fn content_types() -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types xmlns=\"{CONTENT_TYPES}\"><Default Extension=\"rels\" \
         ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"model\" \
         ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n"
    )
}

fn relationships() -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"{RELATIONSHIPS}\"><Relationship \
         Target=\"/{MODEL_PART}\" Id=\"rel0\" Type=\"{MODEL_TYPE}\"/></Relationships>\n"
    )
}

/// The parts in a ZIP archive that says nothing of when and where it was made.
fn archive(parts: &[(&str, String)]) -> Result<Vec<u8>, zip::result::ZipError> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(COMPRESSION_LEVEL))
        .last_modified_time(zip::DateTime::DEFAULT)
        .system(System::Unix)
        .unix_permissions(PERMISSIONS);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        archive.start_file(*name, options.large_file(text.len() > u32::MAX as usize))?;
        archive.write_all(text.as_bytes())?;
    }
    Ok(archive.finish()?.into_inner())
}
