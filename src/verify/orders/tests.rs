//! Orders of packages, right and wrong.

use super::*;
use crate::base::dialect::Dialect;
use crate::base::walls::Walls;
use crate::geom::Point;
use crate::io::threemf::{
    Build, Object, Package, PrintSettings, SparseRegion, Transform, decode_objects, decode_orders,
};
use crate::mesh::primitives::cuboid;
use crate::verify::judge_tests::sound_kit;

/// The words of PrusaSlicer.
const DENSITY: &str = "fill_density";
const PATTERN: &str = "fill_pattern";
const KIND: &str = "volume_type";
const LAYER: &str = "layer_height";

/// A kit's package of one part, as it was read, with the kit's own limits and region.
struct Read {
    objects: Vec<PlacedObject>,
    orders: SlicerOrders,
    printer: PrinterLimits,
    infill: InfillOrder,
}

fn read() -> Read {
    read_in(Dialect::Prusa)
}

/// Returns the package of a printer whose slicer reads a dialect.
fn read_in(dialect: Dialect) -> Read {
    let body = cuboid(&Point::origin(), &Point::new(30.0, 30.0, 30.0));
    let region = SparseRegion {
        mesh: cuboid(&Point::new(15.0, 5.0, 5.0), &Point::new(25.0, 25.0, 25.0)),
        pattern: "gyroid".to_owned(),
        percent: 15.0,
    };
    let objects = [Object::with_regions("P01", [1, 2, 3], &body, &[region])];
    let bytes = Package {
        title: "a box".to_owned(),
        description: "A box.".to_owned(),
        job: "box".to_owned(),
        objects: &objects,
        build: Build::Items(vec![(0, Transform::default())]),
        settings: Some(PrintSettings {
            dialect,
            layer_mm: 0.2,
            line_mm: 0.45,
            walls: Walls::default(),
            overhang_deg: None,
        }),
    };
    let bytes = bytes.encode().unwrap();
    Read {
        objects: decode_objects(&bytes).unwrap(),
        orders: decode_orders(&bytes).unwrap().remove(0),
        printer: PrinterLimits {
            process: Some("fdm".to_owned()),
            layer_mm: Some(0.2),
            dialect,
            ..sound_kit().promise.printer
        },
        infill: InfillOrder {
            pattern: "gyroid".to_owned(),
            nominal_ratio: 0.15,
            laid_ratio: 0.142,
            regions: 1,
            volume_mm3: 4000.0,
            mass_g: 0.7,
            slicer_ratio: None,
            beyond: None,
            misses_mm: Vec::new(),
            field: None,
            smooth: None,
            file: Some("modifiers/region.stl".to_owned()),
            inner: Vec::new(),
        },
    }
}

impl Read {
    fn faults(&self) -> String {
        let wanted = Wanted {
            printer: &self.printer,
            infill: Some((&self.infill, "P01")),
        };
        let package = Ordered {
            file: "plate.3mf",
            objects: &self.objects,
            orders: std::slice::from_ref(&self.orders),
        };
        wanted.faults(&package).join("; ")
    }

    fn object(&mut self) -> &mut ObjectOrders {
        let objects = self.orders.objects.values_mut();
        objects.last().unwrap()
    }
}

#[test]
fn a_package_as_it_is_written_orders_what_the_sheet_states() {
    for dialect in Dialect::ALL {
        let read = read_in(*dialect);
        assert_eq!(read.faults(), "", "{dialect}");
        assert_eq!(read.orders.dialect, *dialect);
        assert_eq!(read.objects.len(), 1, "{dialect}");
        let volume_mm3 = read.objects[0].mesh.signed_volume_mm3();
        assert!(
            (volume_mm3 - 23_000.0).abs() < 1e-6,
            "{dialect}: {volume_mm3}"
        );
    }
}

#[test]
fn each_wrong_order_for_a_region_is_named_in_the_other_dialects() {
    for (dialect, key, value, said) in [
        (
            Dialect::Orca,
            "sparse_infill_density",
            "15",
            "infill of 15, not 15%",
        ),
        (
            Dialect::Orca,
            "sparse_infill_pattern",
            "grid",
            "filled with grid, not gyroid",
        ),
        (
            Dialect::Orca,
            "subtype",
            "negative_part",
            "a negative_part, not a modifier_part",
        ),
        (
            Dialect::Orca,
            "wall_loops",
            "2",
            "walls around its region (wall_loops)",
        ),
        (
            Dialect::Cura,
            "infill_sparse_density",
            "20",
            "infill of 20, not 15%",
        ),
        (
            Dialect::Cura,
            "infill_pattern",
            "lightning",
            "with lightning, not gyroid",
        ),
        (Dialect::Cura, "infill_mesh", "false", "a false, not a true"),
        (
            Dialect::Cura,
            "infill_mesh_order",
            "0",
            "in their order (0, not 1)",
        ),
        (
            Dialect::Cura,
            "wall_line_count",
            "2",
            "around its region (wall_line_count)",
        ),
        (Dialect::Cura, "top_layers", "8", "top_layers is 8, not 0"),
    ] {
        let mut read = read_in(dialect);
        let settings = &mut read.object().volumes[1].settings;
        assert!(settings.insert(key.to_owned(), value.to_owned()).is_some() || key == "wall_loops");
        assert!(read.faults().contains(said), "{key}: {}", read.faults());
    }
}

#[test]
fn each_wrong_order_for_a_part_is_named_in_the_other_dialects() {
    for (dialect, key, value, said) in [
        (
            Dialect::Orca,
            "sparse_infill_density",
            "15%",
            "infill of 15%, not 100%",
        ),
        (
            Dialect::Orca,
            "layer_height",
            "0.3",
            "layers of 0.3 mm, not 0.2",
        ),
        (
            Dialect::Cura,
            "infill_sparse_density",
            "20",
            "infill of 20, not 100%",
        ),
        (
            Dialect::Cura,
            "bottom_layers",
            "999999",
            "bottom_layers is 999999",
        ),
    ] {
        let mut read = read_in(dialect);
        let settings = &mut read.object().settings;
        settings.insert(key.to_owned(), value.to_owned());
        assert!(read.faults().contains(said), "{key}: {}", read.faults());
    }
}

#[test]
fn a_plate_in_the_words_of_another_slicer_is_named() {
    let mut read = read_in(Dialect::Orca);
    read.printer.dialect = Dialect::Cura;
    assert_eq!(
        read.faults(),
        "plate.3mf does not say to Cura that its parts are solid"
    );
}

#[test]
fn each_wrong_order_for_a_region_is_named() {
    for (key, value, said) in [
        (DENSITY, "15", "infill of 15, not 15%"),
        (DENSITY, "20%", "infill of 20%, not 15%"),
        (PATTERN, "lightning", "filled with lightning, not gyroid"),
        (KIND, "ModelPart", "a ModelPart, not a ParameterModifier"),
        ("perimeters", "2", "walls around its region (perimeters)"),
    ] {
        let mut read = read();
        let settings = &mut read.object().volumes[1].settings;
        settings.insert(key.to_owned(), value.to_owned());
        assert!(
            read.faults().contains(said),
            "{key} {value}: {}",
            read.faults()
        );
    }
    let mut read = read();
    read.object().volumes[1].settings.remove(DENSITY);
    assert!(
        read.faults().contains("infill of none, not 15%"),
        "{}",
        read.faults()
    );
}

#[test]
fn each_wrong_order_for_a_part_is_named() {
    for (key, value, said) in [
        (DENSITY, "15%", "has an infill of 15%, not 100%"),
        (LAYER, "0.3", "has layers of 0.3 mm, not 0.2"),
    ] {
        let mut read = read();
        let settings = &mut read.object().settings;
        settings.insert(key.to_owned(), value.to_owned());
        assert!(
            read.faults().contains(said),
            "{key} {value}: {}",
            read.faults()
        );
    }
    let mut read = read();
    let body = &mut read.object().volumes[0].settings;
    body.insert(DENSITY.to_owned(), "50%".to_owned());
    assert!(
        read.faults().contains("orders of its own"),
        "{}",
        read.faults()
    );
}

#[test]
fn volumes_that_leave_triangles_out_or_take_them_twice_are_named() {
    for triangles in [12..23, 11..24, 12..25, 13..24] {
        let mut read = read();
        read.object().volumes[1].triangles = triangles.clone();
        let said = read.faults();
        assert!(
            said.contains("do not share its triangles"),
            "{triangles:?}: {said}"
        );
    }
    let mut moved = read();
    moved.object().volumes[0].triangles = 0..10;
    moved.object().volumes[1].triangles = 10..24;
    assert!(moved.faults().contains("a region of"), "{}", moved.faults());
}

#[test]
fn a_region_that_is_lost_or_stays_at_the_origin_is_named() {
    let mut read = read();
    read.object().volumes.clear();
    assert!(
        read.faults().contains("0 volumes of sparse infill"),
        "{}",
        read.faults()
    );
    let mut first = self::read();
    first.orders.moves_volumes = false;
    assert!(
        first.faults().contains("at the origin"),
        "{}",
        first.faults()
    );
    let mut silent = self::read();
    silent.orders.objects.clear();
    assert!(
        silent.faults().contains("does not say"),
        "{}",
        silent.faults()
    );
}

#[test]
fn other_processes_need_no_orders() {
    let mut read = read();
    read.printer.process = Some("sla".to_owned());
    read.orders.objects.clear();
    assert_eq!(read.faults(), "");
}
