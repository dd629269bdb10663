//! Weighs the layer images of a file.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Component, Path};

use rayon::prelude::*;
use zip::ZipArchive;

use super::error::{LayersError, ReadLayersError, package_fault, setting_fault};
use super::frame::ImageFrame;
use super::grey::GreyImage;
use super::sl1::{CONFIG, SLICER_CONFIG, layer_heights, read_settings};
use super::stack::{STACK_FILE, StackPlate, StackRow, image_name};
use super::sums::{PixelSum, Slab, weigh};
use crate::base::watch::Watch;
use crate::io::gcode::Place;

/// Images that are unpacked at once, a few for each core.
const BATCH: usize = 16;
/// The most layers: a metre in layers of 10 µm.
const MOST_LAYERS: usize = 100_000;
/// Bytes of an image's file that are read.
const MOST_IMAGE: u64 = 1 << 28;
/// Bytes of a list of stacks that are read.
const MOST_LIST: u64 = 1 << 22;

/// The material of a plate, as its images show it.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerPlate {
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
    if path.file_name().is_some_and(|name| name == STACK_FILE) {
        return true;
    }
    let archive = File::open(path)
        .ok()
        .map(BufReader::new)
        .map(ZipArchive::new);
    archive.is_some_and(|zip| zip.is_ok_and(|mut zip| zip.by_name(CONFIG).is_ok()))
}

/// Weighs the images of each plate in a file, whole and within places of the plate.
///
/// # Errors
/// Names the file and the part of it at fault.
pub fn read_layers(
    path: &Path,
    places: &[Place],
    watch: &Watch,
) -> Result<Vec<LayerPlate>, ReadLayersError> {
    let read = if path.file_name().is_some_and(|name| name == STACK_FILE) {
        read_stacks(path, places, watch)
    } else {
        read_sl1(path, places, watch).map(|plate| vec![plate])
    };
    read.map_err(|source| ReadLayersError {
        path: path.to_owned(),
        source,
    })
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
    let is_layer = |name: &String| name.ends_with(".png") && !name.contains('/');
    let mut names: Vec<String> = zip
        .file_names()
        .filter_map(Result::ok)
        .map(Into::into)
        .collect();
    names.retain(is_layer);
    names.sort();
    let stack = Images {
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
        file.take(MOST_IMAGE)
            .read_to_end(&mut bytes)
            .map_err(|error| package_fault(&part, error))?;
        Ok((part, bytes))
    })
}

fn read_stacks(
    path: &Path,
    places: &[Place],
    watch: &Watch,
) -> Result<Vec<LayerPlate>, LayersError> {
    let mut text = String::new();
    File::open(path)
        .and_then(|file| file.take(MOST_LIST).read_to_string(&mut text))
        .map_err(|source| unreadable(STACK_FILE, source))?;
    let list: StackRow =
        serde_json::from_str(&text).map_err(|error| package_fault(STACK_FILE, error))?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let plates = list.plates.iter();
    let weighed =
        plates.map(|plate| read_stack(&folder.join(inside(plate)?), plate, places, watch));
    weighed.collect()
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
    folder: &Path,
    plate: &StackPlate,
    places: &[Place],
    watch: &Watch,
) -> Result<LayerPlate, LayersError> {
    let is_length = |mm: f64| mm.is_finite() && mm > 0.0;
    if !(plate.pixel_mm.into_iter().all(is_length)
        && plate.corner_mm.iter().all(|mm| mm.is_finite()))
    {
        return Err(setting_fault(STACK_FILE, "pixel_mm"));
    }
    if !is_length(plate.layer_mm) {
        return Err(setting_fault(STACK_FILE, "layer_mm"));
    }
    let stack = Images {
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
            .and_then(|file| file.take(MOST_IMAGE).read_to_end(&mut bytes))
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
        for start in (0..self.count).step_by(BATCH) {
            self.watch.check()?;
            let layers = start..(start + BATCH).min(self.count);
            let files: Vec<(usize, (String, Vec<u8>))> = layers
                .map(|layer| Ok((layer, read(layer)?)))
                .collect::<Result<_, LayersError>>()?;
            let weighed = files.par_iter().map(|(layer, (part, bytes))| {
                let image = GreyImage::decode(part, bytes)?;
                if image.count != self.frame.count {
                    return Err(LayersError::Size {
                        part: part.clone(),
                        found: image.count,
                        wanted: self.frame.count,
                    });
                }
                let slab = self.slab(*layer);
                let windows = windows.iter();
                let sums = windows.map(|window| weigh(&image, &self.frame, *window, slab));
                Ok(sums.collect::<Vec<PixelSum>>())
            });
            for layer in weighed.collect::<Result<Vec<_>, LayersError>>()? {
                for (sum, one) in sums.iter_mut().zip(&layer) {
                    sum.add(one);
                }
            }
        }
        let places = sums.split_off(1);
        Ok(LayerPlate {
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
