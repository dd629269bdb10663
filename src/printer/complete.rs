//! From everything a profile and its parents say to a printer: what is missing or contradicts
//! itself is noted.

use std::collections::BTreeMap;

use super::{
    Material, Printer, Problem, Quantity, SizedWall, Sourced, Tolerance, layer::Layer,
    profile::Reader,
};

/// Notes numbers that contradict each other.
pub(super) fn consistent(reader: &mut Reader, layer: &Layer) {
    let value = |quantity: Quantity| Some((quantity, layer.numbers.get(&quantity)?.value));
    let pairs = [
        (Quantity::LayerLeastMm, Quantity::LayerMm),
        (Quantity::LayerMm, Quantity::LayerMostMm),
        (Quantity::LayerLeastMm, Quantity::LayerMostMm),
        (
            Quantity::ClearancePressPerSideMm,
            Quantity::ClearanceLoosePerSideMm,
        ),
    ];
    for (small, large) in pairs {
        if let (Some((small, less)), Some((large, more))) = (value(small), value(large))
            && less > more
        {
            note(reader, small.key(), less, format!("`{large}` is {more}"));
        }
    }
    rising(reader, &layer.walls_by_part_size);
    within_build_volume(reader, layer);
}

fn note(reader: &mut Reader, key: &str, value: f64, against: String) {
    reader.note(
        0,
        Problem::Contradiction {
            key: key.to_owned(),
            value,
            against,
        },
    );
}

/// Notes a table of walls whose sizes do not rise.
fn rising(reader: &mut Reader, walls: &[SizedWall]) {
    for pair in walls
        .windows(2)
        .filter(|pair| pair[0].up_to_mm >= pair[1].up_to_mm)
    {
        let against = format!("the one before it is {}", pair[0].up_to_mm);
        note(
            reader,
            "walls_by_part_size.up_to_mm",
            pair[1].up_to_mm,
            against,
        );
    }
}

/// Notes a largest part or a corner beyond the build volume.
fn within_build_volume(reader: &mut Reader, layer: &Layer) {
    let Some(volume) = &layer.build_volume_mm else {
        return;
    };
    let part = layer
        .largest_part_mm
        .iter()
        .flat_map(|part| part.value.into_iter().zip(volume.value));
    let part = part.map(|(size, most)| ("largest_part_mm", size, most));
    let corner =
        |corner: &super::ExcludedCorner| corner.size_mm.value.into_iter().zip(volume.value);
    let corners = layer.excluded_corners.iter().flat_map(corner);
    let corners = corners.map(|(size, most)| ("excluded_corners.size_mm", size, most));
    for (key, size, most) in part.chain(corners).filter(|(_, size, most)| size > most) {
        note(
            reader,
            key,
            size,
            format!("the build volume is {most} there"),
        );
    }
}

/// The printer, unless something that every printer needs is unset; each such key is noted.
pub(super) fn complete(
    reader: &mut Reader,
    layer: Layer,
    materials: Vec<Material>,
) -> Option<Printer> {
    let mut needs = Needs {
        reader,
        numbers: layer.numbers,
    };
    let [pixel_x_mm, pixel_y_mm, layer_mm] =
        [Quantity::PixelXMm, Quantity::PixelYMm, Quantity::LayerMm].map(|key| needs.number(key));
    let [min_wall_mm, min_feature_mm, min_opening_mm] = [
        Quantity::MinWallMm,
        Quantity::MinFeatureMm,
        Quantity::MinOpeningMm,
    ]
    .map(|key| needs.number(key));
    let [pin_min_diameter_mm, pin_length_ratio] =
        [Quantity::PinMinDiameterMm, Quantity::PinLengthRatio].map(|key| needs.number(key));
    let [clearance_per_side_mm, socket_extra_depth_mm, chamfer_mm] = [
        Quantity::ClearancePerSideMm,
        Quantity::SocketExtraDepthMm,
        Quantity::ChamferMm,
    ]
    .map(|key| needs.number(key));
    let least_mm = needs.number(Quantity::ToleranceLeastMm);
    let base_mm = needs.numbers.remove(&Quantity::ToleranceBaseMm);
    let ratio = needs.numbers.remove(&Quantity::ToleranceRatio);
    let grid = needs.word("grid", layer.grid);
    let support = needs.word("support", layer.support);
    let print_pose = needs.word("print_pose", layer.print_pose);
    let cleaning = needs.word("cleaning", layer.cleaning);
    let besides = needs.numbers;
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
        min_wall_mm: min_wall_mm?,
        min_feature_mm: min_feature_mm?,
        min_opening_mm: min_opening_mm?,
        pin_min_diameter_mm: pin_min_diameter_mm?,
        pin_length_ratio: pin_length_ratio?,
        clearance_per_side_mm: clearance_per_side_mm?,
        socket_extra_depth_mm: socket_extra_depth_mm?,
        chamfer_mm: chamfer_mm?,
        tolerance: Tolerance {
            least_mm: least_mm?,
            base_mm,
            ratio,
        },
        support: support?,
        print_pose: print_pose?,
        cleaning: cleaning?,
        materials,
        besides,
    })
}

/// Takes what every printer needs, and notes what is not there.
struct Needs<'r, 'a> {
    reader: &'r mut Reader<'a>,
    numbers: BTreeMap<Quantity, Sourced<f64>>,
}

impl Needs<'_, '_> {
    fn number(&mut self, quantity: Quantity) -> Option<Sourced<f64>> {
        let number = self.numbers.remove(&quantity);
        self.word(quantity.key(), number)
    }

    fn word<T>(&mut self, key: &str, value: Option<T>) -> Option<T> {
        if value.is_none() {
            self.reader.note(
                0,
                Problem::Missing {
                    key: key.to_owned(),
                },
            );
        }
        value
    }
}
