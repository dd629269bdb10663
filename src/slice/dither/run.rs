//! The passes through the layers of a model in two materials.

use std::path::Path;

use super::correct::{Drawn, MOST_CHANGES, Nudge, Sampler, Unit};
use super::order::{DitherError, DitherOrder};
use super::row::{BodyRow, DITHER_FILE, DitherRow, MaterialRow};
use super::voxels::Voxels;
use crate::base::watch::Watch;
use crate::io::layers::{
    LayerPlate, STACK_FILE, StackPlate, StackRow, encode_bits, image_name, read_layers,
};
use crate::kit::KitWriter;
use crate::mass::{Moments, moments_of_mesh};
use crate::printer::Material;
use crate::raster::{Cell, Diffusion};
use crate::slice::error::SliceError;

/// Most pixels of a layer: some 13 bytes each are in memory. A tray of 400 mm at 600 dpi has 90
/// million.
const MOST_PIXELS: f64 = 1e8;

/// Lacking moments, in pixels, that single pixels make up with some to spare.
const FEW: f64 = MOST_CHANGES as f64 / 10.0;

/// The moments of one pass, on the plate, mm³ to mm⁵.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    body: Moments,
    heavy: Moments,
}

impl Sums {
    /// Returns the moments of the print, of the heavier material.
    fn printed(&self, least: f64) -> Moments {
        self.heavy * (1.0 - least) + self.body * least
    }
}

/// Writes a model in two materials: two stacks of images that share its pixels, and their lists.
///
/// Error diffusion gives each pixel a material. Two passes weigh, and the last one writes. Two
/// layers are in memory, and the same input gives the same bytes on any number of threads.
///
/// # Errors
/// The printer cannot set these materials, the field asks for others, or a file cannot be written.
pub fn dither_model(
    order: &DitherOrder,
    writer: &KitWriter,
    watch: &Watch,
) -> Result<DitherRow, SliceError> {
    let [heavy, light] = order.pair()?;
    check_room(order)?;
    let least = light.density_g_cm3.value / heavy.density_g_cm3.value;
    let field = order.field.on(order.solid);
    let voxels = Voxels::of(order.solid, field.as_ref(), order.printer, least)?;
    let Corrections { nudge, changes } = correct(order, &voxels, watch)?;
    let stack = StackWriter {
        writer,
        ids: [&heavy.id, &light.id],
        voxels: &voxels,
    };
    let sums = pass(&voxels, nudge.as_ref(), watch, |layer, cells, _| {
        let here = changes.partition_point(|(at, _)| *at < layer);
        let here = changes[here..].iter().take_while(|(at, _)| *at == layer);
        for (_, at) in here {
            cells[*at] = match cells[*at] {
                Cell::First => Cell::Second,
                _ => Cell::First,
            };
        }
        stack.write(layer, cells)
    })?;
    let printed = Printed {
        materials: [heavy, light],
        sums,
        changed: changes.len(),
    };
    let row = list(order, &voxels, &printed);
    writer.add(STACK_FILE, &json(&stack.list(order, &sums))?)?;
    writer.add(DITHER_FILE, &json(&row)?)?;
    Ok(row)
}

fn json(value: &impl serde::Serialize) -> Result<Vec<u8>, SliceError> {
    Ok((serde_json::to_string_pretty(value)? + "\n").into_bytes())
}

/// Refuses a model that is larger than the printer's room, or whose layers have too many pixels.
///
/// It does so before any pixel is counted.
fn check_room(order: &DitherOrder) -> Result<(), DitherError> {
    let printer = order.printer;
    let size_mm: [f64; 3] = order.solid.mesh().aabb().size().into();
    let rounded_mm = size_mm.map(f64::round);
    if let Some(room) = printer.build_volume_mm.as_ref()
        && (0..3).any(|axis| size_mm[axis] > room.value[axis])
    {
        return Err(DitherError::TooLarge {
            printer: printer.name.clone(),
            size_mm: rounded_mm,
            room_mm: room.value,
        });
    }
    let pixel_mm2 = printer.pixel_x_mm.value * printer.pixel_y_mm.value;
    let pixels = size_mm[0] * size_mm[1] / pixel_mm2;
    if pixels > MOST_PIXELS {
        return Err(DitherError::TooManyPixels {
            printer: printer.name.clone(),
            size_mm: rounded_mm,
            pixels_millions: (pixels / 1e6).round(),
        });
    }
    Ok(())
}

/// What makes up for the pixels that the surface cuts.
struct Corrections {
    /// The change of shares; `None` if none is needed.
    nudge: Option<Nudge>,
    /// The pixels to change at last: their layers and their places in them.
    changes: Vec<(u32, usize)>,
}

/// Finds what makes the pixels weigh what the field does.
fn correct(order: &DitherOrder, voxels: &Voxels, watch: &Watch) -> Result<Corrections, SliceError> {
    let aabb = order
        .solid
        .mesh()
        .map_vertices(|at| at + voxels.shift)
        .aabb();
    let unit = Unit::of(&aabb, &voxels.grid);
    let pixels = moments_of_mesh(order.solid.mesh()).volume() / voxels.grid.voxel_mm3();
    let weigh = |nudge: Option<&Nudge>| {
        let mut sampler = Sampler::new(unit, pixels);
        let sums = pass(voxels, nudge, watch, |layer, cells, shares| {
            let drawn = Drawn {
                layer,
                cells,
                shares,
            };
            sampler.take(&voxels.grid, &drawn);
            Ok(())
        })?;
        let lacking = voxels.wanted - sums.printed(voxels.least);
        let lacking = unit.moments(&(lacking * (1.0 / (1.0 - voxels.least))));
        Ok::<_, SliceError>((sampler, lacking))
    };
    let (sampler, lacking) = weigh(None)?;
    let nudge = match lacking.amax() > FEW {
        true => sampler.nudge(&lacking),
        false => None,
    };
    if nudge.is_none() {
        let changes = sampler.changes(&lacking);
        return Ok(Corrections { nudge, changes });
    }
    let (sampler, lacking) = weigh(nudge.as_ref())?;
    let changes = sampler.changes(&lacking);
    Ok(Corrections { nudge, changes })
}

/// Gives every pixel its material, layer by layer, and hands each layer with its shares on.
fn pass(
    voxels: &Voxels,
    nudge: Option<&Nudge>,
    watch: &Watch,
    mut take: impl FnMut(u32, &mut [Cell], &[f32]) -> Result<(), SliceError>,
) -> Result<Sums, SliceError> {
    let grid = &voxels.grid;
    let mut diffusion = Diffusion::new(&grid.pixels, &grid.layers);
    let mut sums = Sums::default();
    for layer in 0..grid.layers.count {
        watch.check()?;
        let shares = voxels.shares(layer, nudge);
        let mut cells = diffusion.layer(&shares);
        take(layer, &mut cells, &shares)?;
        let [body, heavy] = [false, true].map(|is_heavy| {
            let counts = |cell| cell == Cell::First || !is_heavy && cell == Cell::Second;
            grid.moments(&cells, layer, counts)
        });
        sums.body += body;
        sums.heavy += heavy;
    }
    Ok(sums)
}

/// Writes the images of both materials.
struct StackWriter<'a> {
    writer: &'a KitWriter<'a>,
    ids: [&'a str; 2],
    voxels: &'a Voxels<'a>,
}

impl StackWriter<'_> {
    fn write(&self, layer: u32, cells: &[Cell]) -> Result<(), SliceError> {
        let count = self.voxels.grid.pixels.count;
        let (columns, rows) = (count[0] as usize, count[1] as usize);
        let draw = |wanted: Cell| {
            // Images begin at the greatest y.
            encode_bits(count, |column, row| {
                cells[(rows - 1 - row) * columns + column] == wanted
            })
        };
        let (heavy, light) = rayon::join(|| draw(Cell::First), || draw(Cell::Second));
        for (id, image) in self.ids.iter().zip([heavy?, light?]) {
            let file = format!("{id}/{}", image_name(layer));
            self.writer.add(&file, &image)?;
        }
        Ok(())
    }

    /// Returns the list of both stacks, as that of a kit's plates.
    fn list(&self, order: &DitherOrder, sums: &Sums) -> StackRow {
        let (pixels, layers) = (&self.voxels.grid.pixels, &self.voxels.grid.layers);
        let top_mm = pixels.low_mm[1] + f64::from(pixels.count[1]) * pixels.pitch_mm[1];
        let volumes = [sums.heavy.volume(), (sums.body - sums.heavy).volume()];
        let plates = self
            .ids
            .iter()
            .zip(volumes)
            .map(|(id, volume_mm3)| StackPlate {
                plate: (*id).to_owned(),
                folder: (*id).to_owned(),
                pixel_mm: pixels.pitch_mm,
                corner_mm: [pixels.low_mm[0], top_mm],
                pixels: pixels.count,
                layer_mm: layers.height_mm,
                layers: layers.count,
                volume_mm3,
            });
        StackRow {
            schema: StackRow::SCHEMA,
            job: order.model.to_owned(),
            plates: plates.collect(),
        }
    }
}

/// What was printed.
struct Printed<'a> {
    materials: [&'a Material; 2],
    sums: Sums,
    changed: usize,
}

/// Returns the list of the materials with its figures.
fn list(order: &DitherOrder, voxels: &Voxels, printed: &Printed) -> DitherRow {
    let sums = &printed.sums;
    let volumes = [sums.heavy.volume(), (sums.body - sums.heavy).volume()];
    let material = |which: usize| {
        let material = printed.materials[which];
        MaterialRow {
            id: material.id.clone(),
            folder: material.id.clone(),
            density_g_cm3: material.density_g_cm3.value,
            volume_mm3: volumes[which],
        }
    };
    let heavy_g_cm3 = printed.materials[0].density_g_cm3.value;
    let wanted = BodyRow::of(&voxels.wanted, heavy_g_cm3);
    let reached = BodyRow::of(&sums.printed(voxels.least), heavy_g_cm3);
    DitherRow {
        schema: DitherRow::SCHEMA,
        model: order.model.to_owned(),
        printer: order.printer.id.clone(),
        field: order.field_words.to_owned(),
        origin_mm: voxels.shift.into(),
        materials: [material(0), material(1)],
        off: wanted.off(&reached),
        wanted,
        reached,
        changed: printed.changed,
    }
}

/// Weighs the written images of a model in two materials, by pixel and layer.
///
/// # Errors
/// The images cannot be read again.
pub fn weigh_stacks(folder: &Path, row: &DitherRow, watch: &Watch) -> Result<BodyRow, SliceError> {
    let plates = read_layers(&folder.join(STACK_FILE), watch)?;
    let heavy_g_cm3 = row.materials[0].density_g_cm3;
    let parts = plates.iter().zip(&row.materials);
    let parts = parts.map(|(plate, it)| as_boxes(plate) * (it.density_g_cm3 / heavy_g_cm3));
    let whole = parts.fold(Moments::default(), |sum, part| sum + part);
    Ok(BodyRow::of(&whole, heavy_g_cm3))
}

/// Returns the moments of a plate of pixels that are whole or none.
///
/// A grey pixel may be covered anywhere, for which its reader takes a twelfth of a pixel squared
/// off the second moments. A whole pixel is a box, which has a twelfth more.
fn as_boxes(plate: &LayerPlate) -> Moments {
    let mut moments = plate.whole.moments;
    let [a, b] = plate.frame.axes();
    for (axis, pitch_mm) in [a, b].into_iter().zip(plate.frame.pitch_mm) {
        moments.0[7 + axis] += moments.volume() * pitch_mm * pitch_mm / 6.0;
    }
    moments
}
