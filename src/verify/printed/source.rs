//! The files of toolpaths, and the pieces of material in them.

use std::path::PathBuf;

use super::error::PrintedError;
use super::images::{read_image_places, read_images};
use super::limits::FLOW_LIMIT_RATIO;
use super::names::showable;
use super::shape::Shape;
use crate::base::watch::Watch;
use crate::geom::{Aabb, Vector};
use crate::io::gcode::{Deposits, Feature, Label, Options, Place, Slicer, Toolpath, read_gcode};
use crate::io::layers::holds_layers;
use crate::verify::Promise;

/// Edge of the cubes by which support is counted, mm: a third of the least opening of a void.
pub(super) const SUPPORT_CELL_MM: f64 = 1.5;
/// Width of a line if nothing tells it, mm.
const USUAL_LINE_MM: f64 = 0.45;
/// Share of a bead's height by which its sides are rounded off: 1 - π/4.
const ROUNDED: f64 = 1.0 - std::f64::consts::FRAC_PI_4;

/// A plate of toolpaths.
#[derive(Debug, Clone)]
pub(super) struct Source {
    path: PathBuf,
    /// The index of the plate in its file.
    index: usize,
    /// The file, with the number of the plate if it has several.
    pub(super) name: String,
    /// What is printed.
    pub(super) toolpath: Toolpath,
    /// The plate of the kit that it says it prints.
    pub(super) plate: Option<String>,
    /// Whether the file holds images of layers, and no lines.
    pub(super) is_images: bool,
}

/// Material that is printed as one object.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Its label; empty without one.
    pub(super) label: String,
    /// The number of the copy, from 0.
    pub(super) copy: i64,
    /// The material.
    pub(super) deposits: Deposits,
}

/// The width of lines and the height of layers, as they are laid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lines {
    /// The mean height of beads, mm.
    pub(super) height_mm: f64,
    /// The width of the outermost line, mm.
    pub(super) width_mm: f64,
}

/// Reads all plates of all files.
///
/// # Errors
/// A file cannot be read, or none is given.
pub(super) fn read_sources(files: &[PathBuf], watch: &Watch) -> Result<Vec<Source>, PrintedError> {
    if files.is_empty() {
        return Err(PrintedError::NoFile);
    }
    let mut sources = Vec::new();
    for path in files {
        if holds_layers(path) {
            let plates = read_images(path, watch)?.into_iter().enumerate();
            sources.extend(plates.map(|(index, (plate, toolpath))| {
                let name = path.display();
                Source {
                    path: path.clone(),
                    index,
                    name: match &plate {
                        Some(plate) => format!("{name}, {plate}"),
                        None => name.to_string(),
                    },
                    plate,
                    toolpath,
                    is_images: true,
                }
            }));
            continue;
        }
        let plates = read_gcode(path, &options(Vec::new()), watch)?;
        for (index, mut plate) in plates.into_iter().enumerate() {
            take_off_calibration(&mut plate.toolpath);
            let number = plate.number.map(|number| format!(", plate {number}"));
            sources.push(Source {
                path: path.clone(),
                index,
                name: format!("{}{}", path.display(), number.unwrap_or_default()),
                toolpath: plate.toolpath,
                plate: None,
                is_images: false,
            });
        }
    }
    Ok(sources)
}

fn options(places: Vec<Place>) -> Options {
    Options {
        places,
        support_cell_mm: Some(SUPPORT_CELL_MM),
        ..Options::default()
    }
}

/// Takes the calibration of filaments off what is laid. With it a machine lays lines of the volume
/// that is meant.
fn take_off_calibration(toolpath: &mut Toolpath) {
    let ratios = &toolpath.facts.flow_ratios;
    let objects = toolpath.objects.iter_mut();
    let objects = objects.map(|object| &mut object.deposits);
    for deposits in objects.chain(&mut toolpath.places) {
        for tally in &mut deposits.tallies {
            let by = calibration(ratios, tally.tool).recip();
            tally.moments = tally.moments * by;
            tally.flowed_mm3 *= by;
        }
    }
}

/// Returns the calibration of a tool's filament; 1 if none is stated, or one that calibrates none.
pub(super) fn calibration(stated: &[f64], tool: u16) -> f64 {
    let ratio = stated.get(usize::from(tool)).or(stated.first());
    let is_one = |ratio: &&f64| (**ratio - 1.0).abs() <= FLOW_LIMIT_RATIO;
    ratio.filter(is_one).copied().unwrap_or(1.0)
}

impl Source {
    /// Returns its labelled objects, or all of its material as one piece without labels.
    pub(super) fn pieces(&self) -> Vec<Piece> {
        let objects = self.toolpath.objects.iter();
        let is_there = |deposits: &Deposits| deposits.part_moments().volume() > 0.0;
        let labelled = objects.clone().filter_map(|object| {
            let label = object.label.as_ref()?;
            is_there(&object.deposits).then(|| Piece {
                label: words(label),
                copy: label.copy.unwrap_or(0),
                deposits: object.deposits.clone(),
            })
        });
        let labelled: Vec<Piece> = labelled.collect();
        if !labelled.is_empty() {
            return labelled;
        }
        let whole = objects.filter(|object| is_there(&object.deposits));
        let piece = whole.map(|object| Piece {
            label: String::new(),
            copy: 0,
            deposits: object.deposits.clone(),
        });
        piece.collect()
    }

    /// Reads the file again, and returns the material in each of these places.
    pub(super) fn read_places(
        &self,
        places: Vec<Place>,
        watch: &Watch,
    ) -> Result<Vec<Deposits>, PrintedError> {
        if self.is_images {
            return read_image_places(&self.path, self.index, &places, watch);
        }
        let plates = read_gcode(&self.path, &options(places), watch)?;
        let plate = plates.into_iter().nth(self.index);
        Ok(plate.map_or_else(Vec::new, |mut plate| {
            take_off_calibration(&mut plate.toolpath);
            plate.toolpath.places
        }))
    }

    /// Returns the height of its layers, mm; `None` for toolpaths, whose lines tell it.
    pub(super) fn image_layer_mm(&self) -> Option<f64> {
        let stated = self.toolpath.facts.layer_height_mm;
        stated.filter(|_| self.is_images)
    }

    /// Returns the slicer that wrote it.
    pub(super) fn slicer(&self) -> Option<Slicer> {
        let generator = self.toolpath.facts.generator.as_ref();
        generator.map(|generator| generator.slicer)
    }

    /// Returns the shape of a piece. Nozzle paths are half a line inside of the material.
    pub(super) fn shape(&self, piece: &Piece, promise: &Promise) -> Shape {
        let paths = piece.deposits.part_bounds();
        let line_mm = self.line_mm(piece, promise);
        let margin = Vector::new(0.5 * line_mm, 0.5 * line_mm, 0.0);
        let mut min = paths.min - margin;
        // Lines in the air are round and thicker than a layer: they seem to reach below the plate.
        let laid = piece
            .deposits
            .part()
            .filter(|tally| !is_in_air(tally.feature));
        let foot_mm = laid
            .map(|tally| tally.bounds.min.z)
            .fold(f64::INFINITY, f64::min);
        if foot_mm.is_finite() {
            min.z = foot_mm;
        }
        Shape {
            moments: piece.deposits.part_moments(),
            aabb: Aabb {
                min,
                max: paths.max + margin,
            },
        }
    }

    /// Returns the width of the outermost line: as stated, as laid, or the usual one.
    fn line_mm(&self, piece: &Piece, promise: &Promise) -> f64 {
        let stated = &self.toolpath.facts.line_widths;
        let laid = || lines_of(&piece.deposits, promise).map(|lines| lines.width_mm);
        let known = stated.external_perimeter_mm.or(stated.usual_mm);
        known.or_else(laid).unwrap_or(USUAL_LINE_MM)
    }
}

/// Returns the width and height of the lines of the outermost perimeter; `None` if there are none.
/// A file that names no features has one kind of lines.
///
/// Some slicers lay rounded lines, others rectangles of the same width: the one nearer to the width
/// that the kit asks for is taken.
pub(super) fn lines_of(deposits: &Deposits, promise: &Promise) -> Option<Lines> {
    let of = |feature: Feature| {
        let tallies = deposits.part().filter(|tally| tally.feature == feature);
        tallies.fold([0.0; 3], |[volume, side, length], tally| {
            [
                volume + tally.moments.volume(),
                side + tally.side_mm2,
                length + tally.length_mm,
            ]
        })
    };
    let outer = [Feature::ExternalPerimeter, Feature::Other].map(of);
    let [volume_mm3, side_mm2, length_mm] = outer.into_iter().find(|sums| sums[2] > 0.0)?;
    let (height_mm, section_mm2) = (side_mm2 / length_mm, volume_mm3 / length_mm);
    let rectangle_mm = section_mm2 / height_mm;
    let rounded_mm = rectangle_mm + ROUNDED * height_mm;
    let wanted_mm = promise
        .printer
        .pixel_mm
        .map_or(rounded_mm, |[width_mm, _]| width_mm);
    let aside = |mm: &f64| (mm - wanted_mm).abs();
    let width_mm = if aside(&rectangle_mm) < aside(&rounded_mm) {
        rectangle_mm
    } else {
        rounded_mm
    };
    Some(Lines {
        height_mm,
        width_mm,
    })
}

/// Returns true for lines without a layer below them.
fn is_in_air(feature: Feature) -> bool {
    matches!(
        feature,
        Feature::Bridge | Feature::InternalBridge | Feature::OverhangPerimeter
    )
}

/// Returns a label's name, or its number if it has no name.
fn words(label: &Label) -> String {
    if label.name.is_empty() {
        showable(&label.to_string())
    } else {
        showable(&label.name)
    }
}
