//! Weighs the layer images of a file.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Component, Path, PathBuf};

use rayon::prelude::*;
use zip::ZipArchive;

use super::error::{LayersError, ReadLayersError, package_fault, setting_fault};
use super::frame::ImageFrame;
use super::grey::GreyImage;
use super::sl1::{CONFIG, MOST_MM, SLICER_CONFIG, layer_heights, read_settings};
use super::stack::{STACK_FILE, StackPlate, StackRow, image_name};
use super::sums::{PixelSum, Slab, weigh};
use crate::base::watch::Watch;
use crate::io::gcode::Place;

/// The most images that are unpacked at once, a few for each core.
const BATCH: u64 = 16;
/// The most pixels that are unpacked at once; of larger images fewer are taken together.
const BATCH_PIXELS: u64 = 1 << 29;
/// The most layers: a metre in layers of 10 µm.
const MOST_LAYERS: usize = 100_000;
/// Bytes of an image's file beyond two for each pixel, which 16 bits take.
const MOST_REST: u64 = 1 << 20;
/// Bytes of a list of stacks that are read.
const MOST_LIST: u64 = 1 << 22;

/// The material of a plate, as its images show it.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerPlate {
    /// The plate's file in the kit, if it is stated.
    pub plate: Option<String>,
    /// All of it.
    pub whole: PixelSum,
    /// What lies in each place that was asked for, in that order.
    pub places: Vec<PixelSum>,
    /// The place of the images on the plate.
    pub frame: ImageFrame,
    /// The height of the layers, but for the first, mm.
    pub layer_mm: f64,
    /// The number of layers.
    pub layers: u64,
}

/// Returns true if a file holds layer images: a list of stacks, or an archive with settings.
pub fn holds_layers(path: &Path) -> bool {
    if list_of(path).is_some() {
        return true;
    }
    let archive = File::open(path)
        .ok()
        .map(BufReader::new)
        .map(ZipArchive::new);
    archive.is_some_and(|zip| zip.is_ok_and(|mut zip| zip.by_name(CONFIG).is_ok()))
}

/// Weighs the images of each plate in a file.
///
/// # Errors
/// Names the file and the part of it at fault.
pub fn read_layers(path: &Path, watch: &Watch) -> Result<Vec<LayerPlate>, ReadLayersError> {
    let read = match list_of(path) {
        Some(list) => read_stacks(&list, watch),
        None => read_sl1(path, &[], watch).map(|plate| vec![plate]),
    };
    read.map_err(|source| at(path, source))
}

/// Weighs what lies in each of these places of one plate in a file, counted from 0.
///
/// # Errors
/// Names the file and the part of it at fault.
pub fn read_layer_places(
    path: &Path,
    plate: usize,
    places: &[Place],
    watch: &Watch,
) -> Result<Vec<PixelSum>, ReadLayersError> {
    let read = match list_of(path) {
        Some(list) => read_list(&list).and_then(|row| {
            let plate = row.plates.get(plate).ok_or(LayersError::NoLayer)?;
            read_stack(&list, plate, places, watch)
        }),
        None => read_sl1(path, places, watch),
    };
    read.map(|plate| plate.places)
        .map_err(|source| at(path, source))
}

fn at(path: &Path, source: LayersError) -> ReadLayersError {
    ReadLayersError {
        path: path.to_owned(),
        source,
    }
}

/// Returns the list of stacks that a path names: by its folder, or as a file of JSON.
fn list_of(path: &Path) -> Option<PathBuf> {
    let inside = path.join(STACK_FILE);
    if inside.is_file() {
        return Some(inside);
    }
    let is_json = path.extension().is_some_and(|end| end == "json");
    is_json.then(|| path.to_owned())
}

fn read_sl1(path: &Path, places: &[Place], watch: &Watch) -> Result<LayerPlate, LayersError> {
    let file = File::open(path).map_err(|source| unreadable("the file", source))?;
    let mut zip = ZipArchive::new(BufReader::new(file))
        .map_err(|error| package_fault("the archive", error))?;
    let settings = read_settings(&mut zip)?;
    let frame = settings
        .frame()
        .map_err(|key| setting_fault(SLICER_CONFIG, key))?;
    let [first_mm, layer_mm] = layer_heights(&settings)?;
    let all: Vec<String> = zip
        .file_names()
        .filter_map(Result::ok)
        .map(Into::into)
        .collect();
    let names = settings.layer_names(&all)?;
    let most_bytes = 2 * frame.area() + MOST_REST;
    let stack = Images {
        plate: None,
        frame,
        first_mm,
        layer_mm,
        count: names.len(),
        places,
        watch,
    };
    stack.weigh(|layer| {
        let part = names[layer].clone();
        let file = zip
            .by_name(&part)
            .map_err(|error| package_fault(&part, error))?;
        let mut bytes = Vec::new();
        file.take(most_bytes)
            .read_to_end(&mut bytes)
            .map_err(|error| package_fault(&part, error))?;
        Ok((part, bytes))
    })
}

fn read_stacks(list: &Path, watch: &Watch) -> Result<Vec<LayerPlate>, LayersError> {
    let row = read_list(list)?;
    let plates = row.plates.iter();
    plates
        .map(|plate| read_stack(list, plate, &[], watch))
        .collect()
}

/// Reads a list of stacks: plates with folders of their own, and no more layers than a print has.
fn read_list(path: &Path) -> Result<StackRow, LayersError> {
    let mut text = String::new();
    File::open(path)
        .and_then(|file| file.take(MOST_LIST).read_to_string(&mut text))
        .map_err(|source| unreadable(STACK_FILE, source))?;
    let row: StackRow =
        serde_json::from_str(&text).map_err(|error| package_fault(STACK_FILE, error))?;
    if row.schema != StackRow::SCHEMA {
        return Err(setting_fault(STACK_FILE, "schema"));
    }
    if row.plates.is_empty() {
        return Err(LayersError::NoLayer);
    }
    let layers: u64 = row.plates.iter().map(|plate| u64::from(plate.layers)).sum();
    if layers > MOST_LAYERS as u64 {
        return Err(LayersError::TooMany { most: MOST_LAYERS });
    }
    let folders: BTreeSet<&str> = row.plates.iter().map(|plate| &plate.folder[..]).collect();
    if folders.len() < row.plates.len() {
        return Err(setting_fault(STACK_FILE, "folder"));
    }
    Ok(row)
}

/// Returns the folder of a stack, which must lie beside the list.
fn inside(plate: &StackPlate) -> Result<&Path, LayersError> {
    let folder = Path::new(&plate.folder);
    let mut components = folder.components();
    let is_plain = |part: Component| matches!(part, Component::Normal(_));
    if components.next().is_some_and(is_plain) && components.next().is_none() {
        Ok(folder)
    } else {
        Err(setting_fault(STACK_FILE, "folder"))
    }
}

fn read_stack(
    list: &Path,
    plate: &StackPlate,
    places: &[Place],
    watch: &Watch,
) -> Result<LayerPlate, LayersError> {
    let folder = list.with_file_name(inside(plate)?);
    let is_length = |mm: f64| mm > 0.0 && mm < MOST_MM;
    if !(plate.pixel_mm.into_iter().all(is_length)
        && plate.corner_mm.iter().all(|mm| mm.abs() < MOST_MM))
    {
        return Err(setting_fault(STACK_FILE, "pixel_mm"));
    }
    if !plate.frame().is_display() {
        return Err(setting_fault(STACK_FILE, "pixels"));
    }
    if !is_length(plate.layer_mm) {
        return Err(setting_fault(STACK_FILE, "layer_mm"));
    }
    let most_bytes = 2 * plate.frame().area() + MOST_REST;
    let stack = Images {
        plate: Some(plate.plate.clone()),
        frame: plate.frame(),
        first_mm: plate.layer_mm,
        layer_mm: plate.layer_mm,
        count: plate.layers as usize,
        places,
        watch,
    };
    stack.weigh(|layer| {
        let part = image_name(layer as u32);
        let mut bytes = Vec::new();
        File::open(folder.join(&part))
            .and_then(|file| file.take(most_bytes).read_to_end(&mut bytes))
            .map_err(|source| unreadable(&part, source))?;
        Ok((part, bytes))
    })
}

fn unreadable(part: &str, source: std::io::Error) -> LayersError {
    LayersError::Unreadable {
        part: part.to_owned(),
        source,
    }
}

/// The images of a plate, in the order of their layers.
struct Images<'a> {
    plate: Option<String>,
    frame: ImageFrame,
    first_mm: f64,
    layer_mm: f64,
    count: usize,
    places: &'a [Place],
    watch: &'a Watch,
}

impl Images<'_> {
    /// Weighs all images. Those of a batch are read one by one, then unpacked and weighed on all
    /// cores; sums are added in the order of the layers.
    fn weigh(
        &self,
        mut read: impl FnMut(usize) -> Result<(String, Vec<u8>), LayersError>,
    ) -> Result<LayerPlate, LayersError> {
        if self.count == 0 {
            return Err(LayersError::NoLayer);
        }
        if self.count > MOST_LAYERS {
            return Err(LayersError::TooMany { most: MOST_LAYERS });
        }
        let whole = [0, 1].map(|way| [0, self.frame.count[way] as usize]);
        let reach = |place: &Place| self.frame.reach(place.min_mm, place.max_mm);
        let windows: Vec<_> = std::iter::once(whole)
            .chain(self.places.iter().map(reach))
            .collect();
        let mut sums = vec![PixelSum::EMPTY; windows.len()];
        let batch = (BATCH_PIXELS / self.frame.area().max(1)).clamp(1, BATCH) as usize;
        for start in (0..self.count).step_by(batch) {
            self.watch.check()?;
            let layers = start..(start + batch).min(self.count);
            let files: Vec<(usize, (String, Vec<u8>))> = layers
                .map(|layer| Ok((layer, read(layer)?)))
                .collect::<Result<_, LayersError>>()?;
            let weighed = files.par_iter().map(|(layer, (part, bytes))| {
                let image = GreyImage::decode(part, bytes, self.frame.count)?;
                let slab = self.slab(*layer);
                let windows = windows.iter();
                let sums = windows.map(|window| weigh(&image, &self.frame, *window, slab));
                Ok::<_, LayersError>(sums.collect::<Vec<PixelSum>>())
            });
            // The first fault is told, whichever thread met it.
            for layer in weighed.collect::<Vec<_>>() {
                for (sum, one) in sums.iter_mut().zip(&layer?) {
                    sum.add(one);
                }
            }
        }
        let places = sums.split_off(1);
        Ok(LayerPlate {
            plate: self.plate.clone(),
            whole: sums[0],
            places,
            frame: self.frame,
            layer_mm: self.layer_mm,
            layers: self.count as u64,
        })
    }

    fn slab(&self, layer: usize) -> Slab {
        if layer == 0 {
            return Slab {
                low_mm: 0.0,
                height_mm: self.first_mm,
            };
        }
        Slab {
            low_mm: self.first_mm + (layer as f64 - 1.0) * self.layer_mm,
            height_mm: self.layer_mm,
        }
    }
}
