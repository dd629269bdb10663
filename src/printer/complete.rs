//! The last step from a profile to a printer: notes contradictions and missing values.

use std::collections::BTreeMap;

use super::{
    ExcludedCorner, Material, Printer, Problem, Quantity, SizedWall, Sourced, Tolerance,
    layer::Layer, reader::Reader,
};

/// Notes values that contradict each other.
pub(super) fn note_contradictions(reader: &mut Reader, layer: &Layer) {
    let value = |quantity: Quantity| Some((quantity, layer.numbers.get(&quantity)?.value));
    let pairs = [
        (Quantity::LayerLeastMm, Quantity::LayerMm),
        (Quantity::LayerMm, Quantity::LayerMostMm),
        (Quantity::LayerLeastMm, Quantity::LayerMostMm),
        (
            Quantity::ClearancePressPerSideMm,
            Quantity::ClearanceLoosePerSideMm,
        ),
        (
            Quantity::ClearancePressPerSideMm,
            Quantity::ClearanceSlidePerSideMm,
        ),
    ];
    for (small, large) in pairs {
        if let (Some((small, less)), Some((large, more))) = (value(small), value(large))
            && less > more
        {
            let against = format!("`{large}` is {more}");
            note(reader, small.key(), less, against);
        }
    }
    note_unsorted(reader, &layer.walls_by_part_size);
    note_beyond_build_volume(reader, layer);
}

fn note(reader: &mut Reader, key: &str, value: f64, against: String) {
    let problem = Problem::Contradiction {
        key: key.to_owned(),
        value,
        against,
    };
    reader.note(0, problem);
}

/// Notes sizes in the table of walls that do not increase.
fn note_unsorted(reader: &mut Reader, walls: &[SizedWall]) {
    for pair in walls
        .windows(2)
        .filter(|pair| pair[0].up_to_mm >= pair[1].up_to_mm)
    {
        let [before_mm, up_to_mm] = [pair[0].up_to_mm, pair[1].up_to_mm];
        let against = format!("the one before it is {before_mm}");
        note(reader, "walls_by_part_size.up_to_mm", up_to_mm, against);
    }
}

/// Notes sides of the largest part or of excluded corners that exceed the build volume.
fn note_beyond_build_volume(reader: &mut Reader, layer: &Layer) {
    let Some(volume) = &layer.build_volume_mm else {
        return;
    };
    let part = layer
        .largest_part_mm
        .iter()
        .flat_map(|part| part.value.into_iter().zip(volume.value));
    let part = part.map(|(size, most)| ("largest_part_mm", size, most));
    let corner = |corner: &ExcludedCorner| corner.size_mm.value.into_iter().zip(volume.value);
    let corners = layer.excluded_corners.iter().flat_map(corner);
    let corners = corners.map(|(size, most)| ("excluded_corners.size_mm", size, most));
    for (key, size, most) in part.chain(corners).filter(|(_, size, most)| size > most) {
        let against = format!("the build volume is {most} there");
        note(reader, key, size, against);
    }
}

/// Builds the printer; `None` if required values are missing, which are all noted.
pub(super) fn complete(
    reader: &mut Reader,
    layer: Layer,
    materials: Vec<Material>,
) -> Option<Printer> {
    let mut needs = Needs {
        reader,
        numbers: layer.numbers,
    };
    let pixel_x_mm = needs.number(Quantity::PixelXMm);
    let pixel_y_mm = needs.number(Quantity::PixelYMm);
    let layer_mm = needs.number(Quantity::LayerMm);
    let min_wall_mm = needs.number(Quantity::MinWallMm);
    let min_feature_mm = needs.number(Quantity::MinFeatureMm);
    let min_opening_mm = needs.number(Quantity::MinOpeningMm);
    let pin_min_diameter_mm = needs.number(Quantity::PinMinDiameterMm);
    let pin_length_ratio = needs.number(Quantity::PinLengthRatio);
    let clearance_per_side_mm = needs.number(Quantity::ClearancePerSideMm);
    let socket_extra_depth_mm = needs.number(Quantity::SocketExtraDepthMm);
    let chamfer_mm = needs.number(Quantity::ChamferMm);
    let tolerance = needs.tolerance();
    let grid = needs.value("grid", layer.grid);
    let support = needs.value("support", layer.support);
    let print_pose = needs.value("print_pose", layer.print_pose);
    let cleaning = needs.value("cleaning", layer.cleaning);
    let optional_numbers = needs.numbers;
    Some(Printer {
        id: layer.id,
        name: layer.name,
        process: layer.process,
        inherits: layer.inherits,
        profile_sha256: String::new(),
        grid: grid?,
        pixel_x_mm: pixel_x_mm?,
        pixel_y_mm: pixel_y_mm?,
        layer_mm: layer_mm?,
        build_volume_mm: layer.build_volume_mm,
        largest_part_mm: layer.largest_part_mm,
        excluded_corners: layer.excluded_corners,
        walls_by_part_size: layer.walls_by_part_size,
        compensates_shrinkage: layer.compensates_shrinkage,
        dialect: layer.dialect,
        infill: layer.infill,
        min_wall_mm: min_wall_mm?,
        min_feature_mm: min_feature_mm?,
        min_opening_mm: min_opening_mm?,
        pin_min_diameter_mm: pin_min_diameter_mm?,
        pin_length_ratio: pin_length_ratio?,
        clearance_per_side_mm: clearance_per_side_mm?,
        socket_extra_depth_mm: socket_extra_depth_mm?,
        chamfer_mm: chamfer_mm?,
        tolerance: tolerance?,
        support: support?,
        print_pose: print_pose?,
        cleaning: cleaning?,
        glue: layer.glue,
        glue_safety: layer.glue_safety,
        materials,
        optional_numbers,
    })
}

/// Takes required values one by one and notes those that are missing.
struct Needs<'r, 'a> {
    reader: &'r mut Reader<'a>,
    numbers: BTreeMap<Quantity, Sourced<f64>>,
}

impl Needs<'_, '_> {
    fn tolerance(&mut self) -> Option<Tolerance> {
        let least_mm = self.number(Quantity::ToleranceLeastMm);
        let base_mm = self.numbers.remove(&Quantity::ToleranceBaseMm);
        let ratio = self.numbers.remove(&Quantity::ToleranceRatio);
        Some(Tolerance {
            least_mm: least_mm?,
            base_mm,
            ratio,
        })
    }

    fn number(&mut self, quantity: Quantity) -> Option<Sourced<f64>> {
        let number = self.numbers.remove(&quantity);
        self.value(quantity.key(), number)
    }

    fn value<T>(&mut self, key: &str, value: Option<T>) -> Option<T> {
        if value.is_none() {
            let key = key.to_owned();
            self.reader.note(0, Problem::Missing { key });
        }
        value
    }
}
