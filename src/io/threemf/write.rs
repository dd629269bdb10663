//! Writes 3MF packages: objects with names, colours and places.

use std::io::{Cursor, Write as _};

use quick_xml::escape::escape;
use zip::{CompressionMethod, System, ZipWriter, write::SimpleFileOptions};

use super::cura::{CURA_NAMESPACE, for_body, group_xml};
use super::names::{CONTENT_TYPES, CORE_NAMESPACE, MODEL_PART, MODEL_TYPE, OUR_JOB, RELATIONSHIPS};
use super::nested::{Material, Nested, object_xml};
use super::orca::{ORCA_PART, orca_xml};
use super::settings::{PRUSA_PART, PrintSettings, Subject, prusa_xml};
use super::sparse::{Infill, SparseRegion};
use super::transform::Transform;
use super::triangles::{mesh_xml, round, whole_facets};
use crate::base::dialect::Dialect;
use crate::base::setting::{Key, Setting};
use crate::geom::Point;
use crate::mesh::{TriMesh, foot_area_mm2};

/// A package to be written.
#[derive(Debug, Clone)]
pub struct Package<'a> {
    /// Its title.
    pub title: String,
    /// Its content, in one sentence.
    pub description: String,
    /// The job it belongs to.
    pub job: String,
    /// The objects; those that the build does not place are left out.
    pub objects: &'a [Object],
    /// The places of the objects.
    pub build: Build,
    /// The settings with which slicers print each object; `None` leaves them to the user.
    pub settings: Option<PrintSettings>,
}

/// The places of a package's objects: pairs of an object's index and its map.
#[derive(Debug, Clone, PartialEq)]
pub enum Build {
    /// Each is an item of its own, as for printing.
    Items(Vec<(usize, Transform)>),
    /// All are components of one object with this name.
    Assembly(String, Vec<(usize, Transform)>),
}

impl Build {
    fn places(&self) -> &[(usize, Transform)] {
        match self {
            Self::Items(places) | Self::Assembly(_, places) => places,
        }
    }
}

/// An object of a package, with its triangles already encoded.
#[derive(Debug, Clone)]
pub struct Object {
    name: String,
    color: [u8; 3],
    mesh_xml: String,
    triangles: usize,
    /// The infill of its last triangles, which bound regions inside; empty without regions.
    infill: Vec<Infill>,
    /// Its surface and its regions, each by itself; empty without regions.
    pieces: Vec<TriMesh>,
    /// Area of its section just above its lowest point, mm².
    foot_mm2: f64,
}

/// The reason that a package could not be put together.
#[derive(Debug, thiserror::Error)]
#[error(
    "the 3MF package {title} cannot be put together; remedy: ask for STL files alone (`{}`)",
    Setting::new(Key::Format, "stl")
)]
pub struct PackageError {
    /// Its title.
    title: String,
    /// The error of the archive writer.
    source: zip::result::ZipError,
}

/// The identifier of the colours of a package; objects follow it.
const COLORS_ID: usize = 1;
/// Compression level, 1 to 9. On meshes, 6 takes four times as long as 3 and saves a tenth.
const COMPRESSION_LEVEL: i64 = 3;
/// The namespace of PrusaSlicer's attributes.
const PRUSA_NAMESPACE: &str = "http://schemas.slic3r.org/3mf/2017/06";
/// PrusaSlicer's metadata for the version of a file. Without it, it moves the first volume of an
/// object to its place and leaves the others behind.
pub(super) const PRUSA_VERSION: [&str; 2] = ["slic3rpe:Version3mf", "1"];
/// The namespace of this program's own metadata.
const OUR_NAMESPACE: &str = "urn:equipoise:kit";
/// Permissions of an extracted file, on systems that keep them.
const PERMISSIONS: u32 = 0o644;

impl Object {
    /// Makes an object with a name and a colour (red, green, blue).
    ///
    /// Rounds coordinates to single precision and writes them with the fewest digits that
    /// restore them. Merges corners that coincide then, and leaves out triangles that lose a
    /// corner. A binary STL file of the same mesh holds the same triangles in the same order.
    pub fn new(name: &str, color: [u8; 3], mesh: &TriMesh) -> Self {
        Self::with_blockers(name, color, mesh, |_| false)
    }

    /// Makes an object as [`new`](Self::new), of which PrusaSlicer leaves the blocked triangles
    /// without support. `is_blocked` is asked with the corners of each.
    pub fn with_blockers(
        name: &str,
        color: [u8; 3],
        mesh: &TriMesh,
        is_blocked: impl Fn(&[Point; 3]) -> bool,
    ) -> Self {
        let mesh = round(mesh);
        let whole = whole_facets(&mesh, is_blocked);
        Self {
            name: name.to_owned(),
            color,
            mesh_xml: mesh_xml(&mesh, &whole),
            triangles: whole.len(),
            infill: Vec::new(),
            pieces: Vec::new(),
            foot_mm2: foot_area_mm2(&mesh),
        }
    }

    /// Makes an object as [`new`](Self::new), with regions inside that slicers fill sparsely.
    ///
    /// Where regions overlap the later one holds, so the outermost comes first. For PrusaSlicer all
    /// are turned inward: a program that knows of no regions finds a cavity in place of one.
    /// Corners of different regions stay apart, since it takes those of a volume in one run.
    pub fn with_regions(
        name: &str,
        color: [u8; 3],
        mesh: &TriMesh,
        regions: &[SparseRegion],
    ) -> Self {
        let outside = round(mesh);
        let foot_mm2 = foot_area_mm2(&outside);
        let mut facets = whole_facets(&outside, |_| false).len();
        let mut pieces = vec![outside.clone()];
        let (mut joined, mut infill) = (outside, Vec::new());
        for region in regions {
            infill.push(Infill::of(region, facets));
            let inward = round(&region.mesh.reversed());
            facets += whole_facets(&inward, |_| false).len();
            pieces.push(inward.reversed());
            joined = joined.joined(&inward);
        }
        Self {
            name: name.to_owned(),
            color,
            mesh_xml: mesh_xml(&joined, &whole_facets(&joined, |_| false)),
            triangles: facets,
            infill,
            pieces,
            foot_mm2,
        }
    }

    /// Returns the object with lines that end at the edges of their regions.
    pub fn without_anchors(mut self) -> Self {
        for infill in &mut self.infill {
            infill.is_anchored = false;
        }
        self
    }

    /// Returns it as its settings name it.
    fn subject(&self, id: usize) -> Subject<'_> {
        Subject {
            id,
            name: &self.name,
            triangles: self.triangles,
            infill: &self.infill,
            foot_mm2: self.foot_mm2,
        }
    }

    /// Returns its pieces as nested objects.
    fn nested(&self, id: usize) -> Nested<'_> {
        Nested {
            subject: self.subject(id),
            pieces: &self.pieces,
        }
    }
}

impl Package<'_> {
    /// Returns the bytes of the package: the same for the same input, on any machine.
    pub fn encode(&self) -> Result<Vec<u8>, PackageError> {
        let mut parts = vec![
            (
                "[Content_Types].xml",
                content_types(self.settings.is_some()),
            ),
            ("_rels/.rels", relationships()),
            (MODEL_PART, self.model_xml()),
        ];
        if let Some(settings) = &self.settings {
            let placed = self.placed_objects();
            let objects = placed.iter().map(|(id, object)| object.subject(*id));
            let objects: Vec<Subject> = objects.collect();
            if !self.is_nested() {
                parts.push((PRUSA_PART, prusa_xml(&objects, settings)));
            }
            let reads_orca = match self.has_regions() {
                // The readers of the other dialects would print a cavity.
                true => settings.dialect == Dialect::Orca,
                false => true,
            };
            if reads_orca {
                let first = self.first_piece();
                parts.push((ORCA_PART, orca_xml(&objects, first, settings)));
            }
        }
        archive(&parts).map_err(|source| PackageError {
            title: self.title.clone(),
            source,
        })
    }

    /// Returns the objects that the build places, with their identifiers.
    fn placed_objects(&self) -> Vec<(usize, &Object)> {
        let is_placed =
            |(index, _): &(usize, &Object)| self.build.places().iter().any(|(at, _)| at == index);
        let objects = self.objects.iter().enumerate().filter(is_placed);
        objects
            .map(|(index, object)| (object_id(index), object))
            .collect()
    }

    fn model_xml(&self) -> String {
        let objects = self.objects_xml();
        let (joined, build) = self.build_xml();
        let colors: String = self.objects.iter().map(color_xml).collect();
        let cura = match self.dialect() {
            Some(Dialect::Cura) => format!(" xmlns:cura=\"{CURA_NAMESPACE}\""),
            _ => String::new(),
        };
        let head = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" \
             xmlns=\"{CORE_NAMESPACE}\" xmlns:equipoise=\"{OUR_NAMESPACE}\" \
             xmlns:slic3rpe=\"{PRUSA_NAMESPACE}\"{cura}>\n"
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

    /// Returns the dialect of its settings; `None` without settings.
    fn dialect(&self) -> Option<Dialect> {
        self.settings.as_ref().map(|settings| settings.dialect)
    }

    /// Returns whether regions are objects of their own within their object.
    fn is_nested(&self) -> bool {
        let is_other = |dialect| dialect != Dialect::Prusa;
        self.has_regions() && self.dialect().is_some_and(is_other)
    }

    /// Returns the identifier of the first piece: after the objects and the one that holds them.
    fn first_piece(&self) -> usize {
        object_id(self.objects.len()) + 1
    }

    /// Returns the objects that the build places.
    fn objects_xml(&self) -> String {
        let mut piece = self.first_piece();
        let mut xml = String::new();
        for (id, object) in self.placed_objects() {
            let material = Material {
                id: COLORS_ID,
                index: id - object_id(0),
            };
            if self.is_nested() && !object.pieces.is_empty() {
                let nested = object.nested(id);
                xml += &nested.to_xml(piece, &material, self.settings.as_ref());
                piece += object.pieces.len();
            } else {
                let settings = self
                    .settings
                    .as_ref()
                    .filter(|it| it.dialect == Dialect::Cura);
                let group = settings.map_or_else(String::new, |it| group_xml(&for_body(it)));
                let content = format!("{group}{}", object.mesh_xml);
                xml += &object_xml(id, &object.name, &material, &content);
            }
        }
        xml
    }

    /// Returns whether an object has a region of another infill.
    fn has_regions(&self) -> bool {
        let mut objects = self.placed_objects().into_iter();
        objects.any(|(_, object)| !object.infill.is_empty())
    }

    fn metadata(&self) -> Vec<(&'static str, String)> {
        let [name, number] = PRUSA_VERSION;
        let is_joined = self.has_regions() && !self.is_nested();
        let version = is_joined.then(|| (name, number.to_owned()));
        let application = format!("{} {}", env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
        let usual = [
            ("Title", self.title.clone()),
            ("Description", self.description.clone()),
            ("Application", application),
            (OUR_JOB, self.job.clone()),
        ];
        version.into_iter().chain(usual).collect()
    }

    /// Returns the object that holds the others (empty if there is none), and the items of the
    /// build.
    fn build_xml(&self) -> (String, String) {
        match &self.build {
            Build::Items(places) => (String::new(), places_xml("item", places)),
            Build::Assembly(name, places) => {
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

/// Returns the identifier of the object with this index.
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

/// Writes the places as elements called `element`.
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

fn content_types(has_settings: bool) -> String {
    let settings = if has_settings {
        "<Default Extension=\"config\" ContentType=\"application/xml\"/>"
    } else {
        ""
    };
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types xmlns=\"{CONTENT_TYPES}\"><Default Extension=\"rels\" \
         ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"model\" \
         ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>{settings}</Types>\n"
    )
}

fn relationships() -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships xmlns=\"{RELATIONSHIPS}\"><Relationship \
         Target=\"/{MODEL_PART}\" Id=\"rel0\" Type=\"{MODEL_TYPE}\"/></Relationships>\n"
    )
}

/// Packs the parts into a ZIP archive that does not depend on the time or the machine.
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
