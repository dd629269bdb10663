//! The plates with the blocks of a density coupon.

use super::set::{Block, DensitySet, SIDES, SOLID_PERCENT};
use crate::coupon::CouponError;
use crate::geom::{Matrix, Vector};
use crate::io::threemf::{Build, Object, Package, PrintSettings, SparseRegion, Transform};
use crate::mesh::{TriMesh, primitives};
use crate::printer::Printer;

/// The colour of the blocks: the grey of a tool.
const COLOR: [u8; 3] = [150, 150, 150];
/// Share of a layer by which a region ends below the top and above the bottom. Slicers cut layers
/// in their middle, so every layer has it.
const LID_LAYERS: f64 = 0.1;

/// A plate with blocks.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BlockPlate {
    /// Its file.
    pub(super) file: String,
    /// Its bytes.
    pub(super) bytes: Vec<u8>,
    /// Names of its blocks, each with the place of its middle from the front left corner, mm.
    pub(super) spots: Vec<(String, [f64; 2])>,
}

/// Makes the plates with all blocks, for the family of slicers of the printer.
///
/// # Errors
/// A package cannot be put together.
pub(super) fn plates(set: &DensitySet, printer: &Printer) -> Result<Vec<BlockPlate>, CouponError> {
    let objects: Vec<Object> = set.blocks.iter().map(|block| object(set, block)).collect();
    let sides = set.blocks.iter().map(|block| [block.diameter_mm; 2]);
    let sides: Vec<[f64; 2]> = sides.collect();
    let plates = printer.lay_out(&sides).into_iter().map(|laid| {
        let spots = laid.spots.iter().map(|(index, spot)| {
            let middle = [0, 1].map(|axis| spot.low_mm[axis] + 0.5 * sides[*index][axis]);
            (*index, middle)
        });
        let spots: Vec<(usize, [f64; 2])> = spots.collect();
        let places = spots.iter().map(|(index, middle)| {
            let place = Transform {
                linear: Matrix::identity(),
                shift: Vector::new(middle[0], middle[1], 0.0),
            };
            (*index, place)
        });
        let [number, count] = laid.number_of;
        let package = Package {
            title: format!("density coupon of {} {number}", set.printer),
            description: format!("Plate {number} of {count}: blocks of infill to be weighed."),
            job: format!("{}-density", set.printer),
            objects: &objects,
            build: Build::Items(places.collect()),
            settings: Some(settings(printer)),
        };
        let named = |(index, middle): (usize, [f64; 2])| (set.blocks[index].name.clone(), middle);
        Ok(BlockPlate {
            file: laid.file,
            bytes: package.encode()?,
            spots: spots.into_iter().map(named).collect(),
        })
    });
    plates.collect()
}

/// Returns the settings of a block: those of kits, without support.
fn settings(printer: &Printer) -> PrintSettings {
    PrintSettings {
        dialect: printer.dialect(),
        layer_mm: printer.layer_mm.value,
        line_mm: printer.pixel_x_mm.value,
        walls: printer.walls(),
        overhang_deg: None,
    }
}

/// Makes a block: solid print, but for a region of its infill up to the middle of its outer line.
/// The slicer lays its walls first, and the region has no lids of its own.
fn object(set: &DensitySet, block: &Block) -> Object {
    let round = |radius_mm: f64, low_mm: f64, high_mm: f64| -> TriMesh {
        let upright = primitives::cylinder(radius_mm, high_mm - low_mm, SIDES);
        upright.map_vertices(|p| p + Vector::new(0.0, 0.0, low_mm))
    };
    let radius_mm = 0.5 * block.diameter_mm;
    let body = round(radius_mm, 0.0, set.height_mm);
    if block.percent >= SOLID_PERCENT {
        return Object::new(&block.name, COLOR, &body);
    }
    let lid_mm = LID_LAYERS * set.layer_mm;
    let region = SparseRegion {
        mesh: round(
            radius_mm - 0.5 * set.line_mm,
            lid_mm,
            set.height_mm - lid_mm,
        ),
        pattern: set.pattern.clone(),
        percent: block.percent,
    };
    Object::with_regions(&block.name, COLOR, &body, &[region]).without_anchors()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::dialect::Dialect;
    use crate::io::threemf::decode_plate;

    #[test]
    fn every_block_is_on_a_plate_with_its_infill_in_the_words_of_every_family_of_slicers() {
        for (id, dialect) in [
            ("prusa-mk4", Dialect::Prusa),
            ("bambu-x1c", Dialect::Orca),
            ("ultimaker-s5", Dialect::Cura),
        ] {
            let printer = Printer::find(id).unwrap();
            assert_eq!(printer.dialect(), dialect);
            let set = DensitySet::of(&printer, printer.material(None).unwrap()).unwrap();
            let plates = plates(&set, &printer).unwrap();
            let read: Vec<_> = plates
                .iter()
                .flat_map(|plate| decode_plate(&plate.bytes).unwrap())
                .collect();
            assert_eq!(read.len(), set.blocks.len(), "{id}");
            for block in &set.blocks {
                let found = read
                    .iter()
                    .find(|object| object.name == block.name)
                    .unwrap();
                let percents: Vec<f64> = found.regions.iter().map(|it| it.percent).collect();
                let wanted = (block.percent < 100.0).then_some(block.percent);
                assert_eq!(percents, wanted.into_iter().collect::<Vec<f64>>(), "{id}");
                assert_eq!(found.overhang_deg, None);
                assert!((found.outside.aabb().size().z - set.height_mm).abs() < 1e-4);
            }
        }
    }
}
