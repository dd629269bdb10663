//! Scales the extrusion of toolpaths, so that the density of a part follows a field.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::tilt::Tilt;
use crate::base::setting::{Key, Setting};
use crate::base::watch::Watch;
use crate::field::{
    Density, FileError, NotADensity, Order, WordsError, check, is_file_name, read_file,
};
use crate::geom::Point;
use crate::io::gcode::{Feature, Portions, RewriteError, Rewriting, Rewritten, rewrite_text};
use crate::mass::Moments;
use crate::mesh::{MeshDistance, Solid};
use crate::verify::{LocatedPart, LocatedPlate, PrintedError, locate_parts};

/// Longest piece of a bead, mm. Longer ones blur the field: a bar with a ramp misses its centre by
/// a sixth if its lines of 10 mm stay whole.
const PIECE_MM: f64 = 2.0;
/// Least and greatest factor on a line. Scripts that scale sparse infill keep to these; thinner
/// lines break.
const FACTORS: [f64; 2] = [0.2, 5.5];
/// Most that a usual hot end melts, mm³/s: PrusaResearch.ini, filament_max_volumetric_speed of PLA.
pub const MOST_FLOW_MM3_S: f64 = 15.0;
/// The first bytes of a packed program.
const PACKED: [&[u8]; 2] = [b"GCDE", b"PK\x03\x04"];

/// An order to scale toolpaths.
#[derive(Debug, Clone, PartialEq)]
pub struct ScaleOrder {
    /// The G-code of a plate.
    pub toolpaths: PathBuf,
    /// The folder of the kit whose parts it prints.
    pub kit: PathBuf,
    /// The density that the parts get, model frame. `None` takes what the kit states for its
    /// interior; its wall stays solid.
    pub field: Option<Order>,
    /// The density of sparse infill with which they were sliced, over that of solid print. `None`
    /// takes what the kit or the file says; with the kit's own field, sparse infill is refused.
    pub infill_ratio: Option<f64>,
    /// Most that the hot end melts, mm³/s.
    pub most_flow_mm3_s: f64,
    /// A change of the density that the kit states for its interior.
    pub tilt: Option<Tilt>,
}

/// A reason why toolpaths are not scaled.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ScaleError {
    /// The parts of the kit are not found in the toolpaths.
    #[error(transparent)]
    Printed(#[from] PrintedError),
    /// The field is no density.
    #[error(transparent)]
    Field(#[from] NotADensity),
    /// The file is packed.
    #[error(
        "{} is packed; remedy: let the slicer write plain G-code (.gcode)",
        .0.display()
    )]
    Packed(PathBuf),
    /// The outside of the kit is no solid.
    #[error("the model of this kit is no solid; remedy: check the kit (`equipoise verify`)")]
    NoSolid,
    /// The kit states no field, and none was ordered.
    #[error(
        "the kit has no field of its own; remedy: give one (`{}`), or prepare it near a wished \
         infill (`{}`)",
        Setting::new(Key::Field, "ramp:0,0,1@20mm..60mm:0.5..1"),
        Setting::new(Key::Infill, "40%")
    )]
    NoField,
    /// The field that the kit states cannot be read.
    #[error("the kit states a field that is none: {0}; remedy: check the kit (`equipoise verify`)")]
    OwnField(#[from] WordsError),
    /// The file with the kit's field cannot be read.
    #[error(transparent)]
    OwnFile(#[from] FileError),
    /// A part is printed as its mirror image.
    #[error("{0} is printed as its mirror image; remedy: slice its plate again")]
    Mirrored(String),
    /// No bead was scaled.
    #[error(
        "no infill of the kit's parts was found in it, and walls and surfaces are never scaled; \
         remedy: slice with comments on features (;TYPE:), as PrusaSlicer writes them"
    )]
    Nothing,
    /// The file cannot be read.
    #[error("cannot read {}; remedy: check the path and its permissions", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The fault that the system reports.
        source: std::io::Error,
    },
    /// The program cannot be scaled.
    #[error("{}: {source}", path.display())]
    Rewrite {
        /// The file.
        path: PathBuf,
        /// The fault.
        source: RewriteError,
    },
}

/// What was scaled.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scaled {
    /// The parts, in the order of the checklist.
    pub parts: Vec<String>,
    /// What was written.
    pub written: Rewritten,
    /// The change of the kit's own density that brings the centre to its place.
    pub tilt: Option<Tilt>,
    /// The moments of infill that could be more or less, model frame; `None` beside other parts, or
    /// with a field that was ordered.
    #[serde(skip)]
    pub free: Option<Moments>,
}

/// Writes the toolpaths of a kit's plate again, so that the infill of its parts has the density of
/// a field. Perimeters, surfaces, bridges and support stay as they are.
///
/// Extrusion scaling is that of Bukenberger and Lensch, "Tetrahedra of Varying Density and Their
/// Applications", The Visual Computer 37, 2021. Pieces are at most 2 mm long, each scaled by the
/// mean of the field along it.
///
/// # Errors
/// The file fits no part of the kit, its field is no density, or it asks for lines that are too
/// thin or too thick.
pub fn scale_toolpaths(
    order: &ScaleOrder,
    output: &mut dyn Write,
    watch: &Watch,
) -> Result<Scaled, ScaleError> {
    let input = open(&order.toolpaths)?;
    let plate = locate_parts(&order.kit, &order.toolpaths, watch)?;
    if let Some(part) = plate.parts.iter().find(|part| part.is_mirrored) {
        return Err(ScaleError::Mirrored(part.id.clone()));
    }
    let solid = Solid::new(plate.outside.clone()).map_err(|_| ScaleError::NoSolid)?;
    let (field, wall) = match (&order.field, &plate.field) {
        (Some(field), _) => (field.on(&solid), None),
        (None, Some(words)) => {
            let own = own_field(&order.kit, words)?;
            let surface = MeshDistance::new(solid.mesh());
            (own.on(&solid), Some((surface, plate.wall_mm)))
        }
        (None, None) => return Err(ScaleError::NoField),
    };
    check(&solid, field.as_ref())?;
    let portions = OfField {
        field: field.as_ref(),
        tilt: order.tilt,
        wall,
        sparse_ratio: match (order.infill_ratio, &order.field) {
            (None, Some(_)) => plate.laid_ratio.or(plate.stated_ratio),
            (said, _) => said,
        },
        plate: &plate,
    };
    let rewriting = Rewriting {
        portions: &portions,
        piece_mm: PIECE_MM,
        factors: FACTORS,
        most_flow_mm3_s: order.most_flow_mm3_s,
        filament_mm2: std::f64::consts::FRAC_PI_4 * plate.filament_mm * plate.filament_mm,
    };
    let written = rewrite_text(input, output, &rewriting, watch);
    let written = written.map_err(|source| ScaleError::Rewrite {
        path: order.toolpaths.clone(),
        source,
    })?;
    if written.beads == 0 {
        return Err(ScaleError::Nothing);
    }
    let parts = plate.parts.iter().map(|part| part.id.clone());
    let alone = match plate.parts.as_slice() {
        [part] if order.field.is_none() => Some(part),
        _ => None,
    };
    Ok(Scaled {
        parts: parts.collect(),
        free: alone.map(|part| part.moments_to_model(&written.free)),
        tilt: order.tilt,
        written,
    })
}

/// Reads the field that a kit states: words, or the name of a file in it.
fn own_field(kit: &Path, words: &str) -> Result<Order, ScaleError> {
    if !is_file_name(words) {
        return Ok(words.parse()?);
    }
    // Its name alone: no file outside of the kit is read.
    let name = Path::new(words).file_name().unwrap_or_default();
    Ok(read_file(&kit.join(name))?)
}

/// Opens a program as text.
fn open(path: &Path) -> Result<BufReader<File>, ScaleError> {
    let fault = |source| ScaleError::Read {
        path: path.to_owned(),
        source,
    };
    let mut file = File::open(path).map_err(fault)?;
    let mut start = Vec::new();
    Read::by_ref(&mut file)
        .take(4)
        .read_to_end(&mut start)
        .map_err(fault)?;
    if PACKED.contains(&start.as_slice()) {
        return Err(ScaleError::Packed(path.to_owned()));
    }
    file.seek(SeekFrom::Start(0)).map_err(fault)?;
    Ok(BufReader::new(file))
}

/// How much of a bead a field asks for.
struct OfField<'a> {
    field: &'a dyn Density,
    /// The surface of the model, and the thickness of the wall under it that stays solid, mm.
    wall: Option<(MeshDistance, f64)>,
    /// The density of sparse infill as sliced, over that of solid print, if it is known.
    sparse_ratio: Option<f64>,
    plate: &'a LocatedPlate,
    /// A change of the field.
    tilt: Option<Tilt>,
}

impl OfField<'_> {
    /// Returns the part that a place belongs to; `None` beside all parts.
    fn part(&self, at: &Point) -> Option<&LocatedPart> {
        self.plate.parts.iter().find(|part| part.holds(at))
    }

    /// Refuses sparse infill that cannot be scaled.
    fn check_sparse(&self) -> Result<(), String> {
        if self.sparse_ratio.is_some() {
            return Ok(());
        }
        let said = Setting::new(Key::Infill, "40%");
        Err(if self.wall.is_some() {
            // A plate of the kit has its densities already, and no file says where they end.
            format!(
                "a kit's own field needs parts of one infill; remedy: slice the files of its \
                 parts, not its plate, and say with which infill (`{said}`)"
            )
        } else {
            format!("the file does not say how dense its infill is; remedy: say it (`{said}`)")
        })
    }

    /// Returns true if a place of the model lies in a wall that stays solid.
    fn is_wall(&self, at: &Point) -> bool {
        let wall = self.wall.as_ref();
        wall.is_some_and(|(surface, wall_mm)| surface.signed(at) < *wall_mm)
    }
}

impl Portions for OfField<'_> {
    fn takes(&self, feature: Feature, middle: &Point) -> Result<bool, String> {
        if !matches!(feature, Feature::Infill | Feature::SolidInfill) {
            return Ok(false);
        }
        let mut holding = self.plate.parts.iter().filter(|part| part.holds(middle));
        let (first, second) = (holding.next(), holding.next());
        if let (Some(first), Some(second)) = (first, second) {
            let (first, second) = (&first.id, &second.id);
            return Err(format!(
                "{first} and {second} lie too close to tell them apart; \
                 remedy: arrange the plate with more room"
            ));
        }
        if feature == Feature::Infill && first.is_some() {
            self.check_sparse()?;
        }
        Ok(first.is_some())
    }

    fn factor(&self, feature: Feature, at: &Point) -> f64 {
        // A bead may reach out of its part's box by rounding.
        let Some(part) = self.part(at) else {
            return 1.0;
        };
        let place = part.to_model(at);
        let laid = match feature {
            Feature::Infill => self.sparse_ratio.unwrap_or(1.0),
            _ => 1.0,
        };
        let plain = if self.is_wall(&place) {
            1.0
        } else {
            self.field.at(&place)
        };
        // With the kit's own field, solid lines beside sparse infill back skins that slope. They
        // stay as dense as a line must be. The whole is weighed, so what they add is told.
        let is_sparse = self.wall.is_some() && self.sparse_ratio.is_some_and(|r| r < 1.0);
        let is_skin = is_sparse && feature == Feature::SolidInfill;
        let least = if is_skin { FACTORS[0] } else { 0.0 };
        let factor = (plain / laid).max(least);
        match self.tilt.filter(|_| plain < 1.0) {
            None => factor,
            // A trimmed line stays one that can be laid, and no denser than solid.
            Some(tilt) => {
                let most = (1.0 / laid).min(FACTORS[1]).max(factor);
                (factor * tilt.factor(&place)).clamp(FACTORS[0].min(factor), most)
            }
        }
    }

    fn is_free(&self, at: &Point) -> bool {
        let place = self.part(at).map(|part| part.to_model(at));
        place.is_some_and(|place| !self.is_wall(&place) && self.field.at(&place) < 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kit_states_its_field_in_words_or_names_a_file_of_its_own() {
        let room = tempfile::tempdir().unwrap();
        let kit = room.path().join("kit");
        std::fs::create_dir(&kit).unwrap();
        let of = |name: &str, text: &str| std::fs::write(kit.join(name), text).unwrap();
        of("field.toml", "[field]\nsum = [\"uniform:0.4\"]\n");
        let words = own_field(&kit, "uniform:0.4").unwrap();
        let file = own_field(&kit, "field.toml").unwrap();
        assert_eq!(file, Order::Sum(vec![words]));
        // A file outside of the kit is not read.
        std::fs::write(
            room.path().join("other.toml"),
            "[field]\nsum = [\"uniform:0.9\"]\n",
        )
        .unwrap();
        assert!(own_field(&kit, "../other.toml").is_err());
        assert!(own_field(&kit, "nothing").is_err());
    }
}
