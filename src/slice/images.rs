//! Slices each plate of a kit into the images that a machine of pixels shows or jets.

use std::fs;
use std::path::PathBuf;

use rayon::prelude::*;

use super::error::SliceError;
use super::format::SliceFormat;
use super::plates::{find_plates, read_job, read_profile};
use crate::base::watch::Watch;
use crate::geom::{Aabb, Point};
use crate::io::layers::{
    ImageFrame, STACK_FILE, Sl1Settings, StackPlate, StackRow, encode_grey, encode_sl1, image_name,
};
use crate::io::threemf::decode_objects;
use crate::kit::Kit;
use crate::mesh::TriMesh;
use crate::printer::{Grid, Printer};
use crate::raster::{Layers, Pixels, Stack};

/// Layers that are drawn before the next look at the watch.
const BATCH: u32 = 64;
/// Decimals of a stated volume, mm³.
const VOLUME_DECIMALS: f64 = 1000.0;

/// The kit to slice into images, and the format of the files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImageOrder {
    /// The folder of the kit.
    pub kit: PathBuf,
    /// The format: [`SliceFormat::Stack`] or [`SliceFormat::Sl1`].
    pub format: SliceFormat,
    /// The configuration of the machine for an SL1: its display and exposure.
    pub profile: Option<PathBuf>,
}

/// The images of a kit.
#[derive(Debug, Clone, PartialEq)]
pub struct Imaged {
    /// The plates and their figures.
    pub row: StackRow,
    /// The images, to be written as a folder.
    pub files: Kit,
    /// The files that hold all images of the kit, for the judge.
    pub judged: Vec<String>,
}

/// Slices every plate of a kit into images at the pixels and layers of its printer.
///
/// Each pixel's grey is the exact share of it that the section through the middle of the layer
/// covers, rounded to 1/255. The parts lie as on their plate, without support.
///
/// # Errors
/// The folder is no kit, its printer has no pixels, a plate cannot be read, or an SL1 lacks a
/// setting of its machine.
pub fn image_kit(order: &ImageOrder, watch: &Watch) -> Result<Imaged, SliceError> {
    let job = read_job(&order.kit)?;
    let printer = Printer::find(&job.printer.id)?;
    if printer.grid != Grid::Pixel {
        return Err(SliceError::NoPixels {
            printer: printer.name,
        });
    }
    let machine = match order.format {
        SliceFormat::Sl1 => Some(Machine::of(order, &printer)?),
        _ => None,
    };
    let mut imaged = Imaged {
        row: StackRow {
            schema: StackRow::SCHEMA,
            job: job.name(),
            plates: Vec::new(),
        },
        files: Kit::default(),
        judged: Vec::new(),
    };
    for name in find_plates(&order.kit)? {
        let path = order.kit.join(&name);
        let bytes = fs::read(&path).map_err(|source| SliceError::Read { path, source })?;
        let objects = decode_objects(&bytes)?;
        let whole = objects.iter().fold(TriMesh::default(), |whole, object| {
            whole.joined(&object.mesh)
        });
        let stem = name.trim_end_matches(".3mf").to_owned();
        match &machine {
            Some(machine) => imaged.add_sl1(&stem, machine, &whole, watch)?,
            None => imaged.add_stack(&stem, &printer, &whole, watch)?,
        }
    }
    if machine.is_none() {
        let list = serde_json::to_string_pretty(&imaged.row)? + "\n";
        imaged.files.add(STACK_FILE, list.into_bytes());
        imaged.judged.push(STACK_FILE.to_owned());
    }
    Ok(imaged)
}

impl Imaged {
    /// Adds a plate as a folder of images.
    fn add_stack(
        &mut self,
        stem: &str,
        printer: &Printer,
        whole: &TriMesh,
        watch: &Watch,
    ) -> Result<(), SliceError> {
        let pitch_mm = [printer.pixel_x_mm.value, printer.pixel_y_mm.value];
        let pixels = Pixels::over(&whole.aabb(), pitch_mm);
        let top_mm = pixels.low_mm[1] + f64::from(pixels.count[1]) * pitch_mm[1];
        let layers = Layers::up_to(&whole.aabb(), printer.layer_mm.value);
        let mut plate = StackPlate {
            plate: format!("{stem}.3mf"),
            folder: stem.to_owned(),
            pixel_mm: pitch_mm,
            corner_mm: [pixels.low_mm[0], top_mm],
            pixels: pixels.count,
            layer_mm: layers.height_mm,
            layers: layers.count,
            volume_mm3: 0.0,
        };
        let drawn = draw(whole, &plate.frame(), layers, watch)?;
        plate.volume_mm3 = drawn.volume_mm3;
        for (layer, image) in (0u32..).zip(drawn.images) {
            self.files
                .add(&format!("{stem}/{}", image_name(layer)), image);
        }
        self.row.plates.push(plate);
        Ok(())
    }

    /// Adds a plate as an archive for a machine.
    fn add_sl1(
        &mut self,
        stem: &str,
        machine: &Machine,
        whole: &TriMesh,
        watch: &Watch,
    ) -> Result<(), SliceError> {
        let frame = &machine.frame;
        if !fits(&whole.aabb(), frame) {
            return Err(SliceError::BeyondDisplay {
                plate: format!("{stem}.3mf"),
            });
        }
        let layers = Layers::up_to(&whole.aabb(), machine.layer_mm);
        let drawn = draw(whole, frame, layers, watch)?;
        let parts = machine.parts(stem, &drawn);
        let file = format!("{stem}.sl1");
        self.files
            .add(&file, encode_sl1(stem, &parts, &drawn.images)?);
        self.judged.push(file);
        let by_axis = |along: [f64; 2]| frame.axes().map(|axis| along[axis]);
        let sizes_mm = by_axis([0, 1].map(|way| f64::from(frame.count[way]) * frame.pitch_mm[way]));
        let count = frame.axes().map(|axis| frame.count[axis]);
        self.row.plates.push(StackPlate {
            plate: format!("{stem}.3mf"),
            folder: format!("{stem}.sl1"),
            pixel_mm: by_axis(frame.pitch_mm),
            corner_mm: [0.0, sizes_mm[1]],
            pixels: count,
            layer_mm: layers.height_mm,
            layers: layers.count,
            volume_mm3: drawn.volume_mm3,
        });
        Ok(())
    }
}

/// The images of a plate as files, and the volume that they show.
struct Drawn {
    images: Vec<Vec<u8>>,
    volume_mm3: f64,
}

/// Draws all layers of a body that lies on the plate.
fn draw(
    whole: &TriMesh,
    frame: &ImageFrame,
    layers: Layers,
    watch: &Watch,
) -> Result<Drawn, SliceError> {
    let turned = whole.map_vertices(|point| frame.to_image(point));
    let turned = if frame.mirrors() {
        turned.reversed()
    } else {
        turned
    };
    let pixels = Pixels {
        low_mm: [0.0; 2],
        pitch_mm: frame.pitch_mm,
        count: frame.count,
    };
    let stack = Stack::of(&turned, pixels, layers);
    let mut drawn = Drawn {
        images: Vec::with_capacity(layers.count as usize),
        volume_mm3: 0.0,
    };
    for first in (0..layers.count).step_by(BATCH as usize) {
        watch.check()?;
        let batch = first..(first + BATCH).min(layers.count);
        let images = batch.into_par_iter().map(|layer| {
            let image = stack.image(layer);
            let volume_mm3 = image.moments(&pixels, &layers, layer).volume();
            let file = encode_grey(pixels.count, &image.grey(&pixels))?;
            Ok((file, volume_mm3))
        });
        for (file, volume_mm3) in images.collect::<Result<Vec<_>, SliceError>>()? {
            drawn.images.push(file);
            drawn.volume_mm3 += volume_mm3;
        }
    }
    drawn.volume_mm3 = (drawn.volume_mm3 * VOLUME_DECIMALS).round() / VOLUME_DECIMALS;
    Ok(drawn)
}

/// Returns whether a box lies within the display.
fn fits(aabb: &Aabb, frame: &ImageFrame) -> bool {
    let corners = [aabb.min, aabb.max].map(|corner| frame.to_image(&corner));
    let is_within = |corner: &Point| {
        (0..2).all(|way| {
            let size_mm = f64::from(frame.count[way]) * frame.pitch_mm[way];
            (-1e-6..=size_mm + 1e-6).contains(&corner[way])
        })
    };
    corners.iter().all(is_within)
}

/// A machine with a display, as its slicer's configuration describes it.
struct Machine {
    settings: Sl1Settings,
    frame: ImageFrame,
    layer_mm: f64,
}

/// The keys of a configuration that an archive needs: exposure, s, and layers of transition.
const EXPOSURE: [&str; 3] = ["exposure_time", "initial_exposure_time", "faded_layers"];
/// Layers that differ by less have one exposure.
const SAME_LAYER_RATIO: f64 = 0.01;
/// Volume of a millilitre, mm³.
const ML_MM3: f64 = 1000.0;

impl Machine {
    fn of(order: &ImageOrder, printer: &Printer) -> Result<Self, SliceError> {
        let Some(path) = &order.profile else {
            return Err(SliceError::NoDisplay);
        };
        let mut settings = Sl1Settings::of_text(&read_profile(path)?);
        let missing = |key: &str| SliceError::NoSetting {
            path: path.clone(),
            key: key.to_owned(),
        };
        let frame = settings.frame().map_err(missing)?;
        let lacking = EXPOSURE.iter().find(|key| !settings.0.contains_key(**key));
        if let Some(key) = lacking {
            return Err(missing(key));
        }
        let layer_mm = printer.layer_mm.value;
        let exposed_mm = settings.length("layer_height").unwrap_or(layer_mm);
        if (exposed_mm / layer_mm - 1.0).abs() > SAME_LAYER_RATIO {
            return Err(SliceError::OtherLayers {
                exposed_mm,
                layer_mm,
            });
        }
        for key in ["layer_height", "initial_layer_height"] {
            settings.0.insert(key.to_owned(), layer_mm.to_string());
        }
        Ok(Self {
            settings,
            frame,
            layer_mm,
        })
    }

    /// Returns the parts of an archive beside its images.
    fn parts(&self, stem: &str, drawn: &Drawn) -> [(&'static str, String); 2] {
        let of = |key: &str| self.settings.0.get(key).cloned().unwrap_or_default();
        let own = [
            ("action", "print".to_owned()),
            ("expTime", of("exposure_time")),
            ("expTimeFirst", of("initial_exposure_time")),
            ("jobDir", stem.to_owned()),
            ("layerHeight", self.layer_mm.to_string()),
            ("materialName", of("sla_material_settings_id")),
            ("numFade", of("faded_layers")),
            ("numFast", drawn.images.len().to_string()),
            ("numSlow", "0".to_owned()),
            ("printProfile", of("sla_print_settings_id")),
            ("printerModel", of("printer_model")),
            ("printerProfile", of("printer_settings_id")),
            ("printerVariant", of("printer_variant")),
            ("usedMaterial", (drawn.volume_mm3 / ML_MM3).to_string()),
        ];
        let lines = own.map(|(key, value)| format!("{key} = {value}\n"));
        let all = self.settings.0.iter();
        let all: Vec<String> = all
            .map(|(key, value)| format!("{key} = {value}\n"))
            .collect();
        [
            ("config.ini", lines.concat()),
            ("prusaslicer.ini", all.concat()),
        ]
    }
}
