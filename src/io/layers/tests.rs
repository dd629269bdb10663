//! Layer images are weighed as what they show, and damaged files are refused with the place.

use std::fs;
use std::path::{Path, PathBuf};

use super::{
    LayerPlate, PixelSum, STACK_FILE, StackPlate, StackRow, encode_grey, encode_sl1, image_name,
    read_layer_places, read_layers,
};
use crate::base::watch::Watch;
use crate::io::gcode::Place;

/// Columns and rows of the images.
const COUNT: [u32; 2] = [8, 5];

/// Returns an image with a white rectangle of these columns and rows, and half a pixel beside it.
fn image([left, right]: [usize; 2], [top, bottom]: [usize; 2]) -> Vec<u8> {
    let mut bytes = vec![0; 40];
    for row in top..bottom {
        bytes[row * 8 + left..row * 8 + right].fill(255);
        bytes[row * 8 + right] = 51;
    }
    encode_grey(COUNT, &bytes).unwrap()
}

/// Returns the settings of a display of 16 × 5 mm.
fn settings(orientation: &str, size: [&str; 4]) -> String {
    let [width, height, columns, rows] = size;
    format!(
        "display_width = {width}\ndisplay_height = {height}\ndisplay_pixels_x = {columns}\n\
         display_pixels_y = {rows}\ndisplay_orientation = {orientation}\ndisplay_mirror_x = 1\n\
         display_mirror_y = 0\ninitial_layer_height = 0.2\n"
    )
}

/// Writes an archive of two layers into a folder.
fn archive(folder: &Path, slicer: &str) -> PathBuf {
    let path = folder.join("plate.sl1");
    let parts = [
        ("config.ini", "layerHeight = 0.1\n".to_owned()),
        ("prusaslicer.ini", slicer.to_owned()),
    ];
    let images = [image([2, 5], [1, 3]), image([2, 5], [1, 3])];
    fs::write(&path, encode_sl1("plate", &parts, &images).unwrap()).unwrap();
    path
}

fn read(path: &Path) -> Result<Vec<LayerPlate>, String> {
    read_layers(path, &Watch::silent()).map_err(|error| error.to_string())
}

fn read_places(path: &Path, places: &[Place]) -> Vec<PixelSum> {
    read_layer_places(path, 0, places, &Watch::silent()).unwrap()
}

#[test]
fn a_display_that_lies_shows_x_along_its_columns_and_y_against_its_rows() {
    let folder = tempfile::tempdir().unwrap();
    let path = archive(folder.path(), &settings("landscape", ["16", "5", "8", "5"]));
    let plates = read(&path).unwrap();
    let [plate] = &plates[..] else {
        panic!("one plate")
    };
    // 2 mm × 1 mm pixels: three whole ones and a fifth, in two rows, 0.2 mm and 0.1 mm high. The
    // mirrored columns count from the right.
    let moments = plate.whole.moments;
    assert!((moments.volume() - 2.0 * 3.2 * 2.0 * 0.3).abs() < 1e-12);
    let center = moments.centroid();
    let column = (3.0 * 3.5 + 0.2 * 5.5) / 3.2;
    assert!((center.x - (16.0 - 2.0 * column)).abs() < 1e-12, "{center}");
    assert!((center.y - (5.0 - 2.0)).abs() < 1e-12, "{center}");
    assert!((center.z - 0.15).abs() < 1e-12, "{center}");
    assert_eq!((plate.layers, plate.layer_mm), (2, 0.1));
    assert_eq!(plate.whole.bounds.max.z, 0.2 + 0.1);
    assert_eq!(
        (plate.whole.bounds.min.x, plate.whole.bounds.max.x),
        (6.0, 12.0)
    );
}

#[test]
fn a_display_that_stands_shows_y_along_its_columns_and_x_against_its_rows() {
    let folder = tempfile::tempdir().unwrap();
    // Prusa's SL1: the longer side of the display lies along x, and the image stands.
    let path = archive(folder.path(), &settings("portrait", ["5", "16", "5", "8"]));
    let plates = read(&path).unwrap();
    let center = plates[0].whole.moments.centroid();
    let column = (3.0 * 3.5 + 0.2 * 5.5) / 3.2;
    assert!((center.y - 2.0 * column).abs() < 1e-12, "{center}");
    assert!((center.x - (5.0 - 2.0)).abs() < 1e-12, "{center}");
    assert!(!plates[0].frame.mirrors());
}

#[test]
fn places_of_the_plate_are_weighed_apart_and_add_up() {
    let folder = tempfile::tempdir().unwrap();
    let path = archive(folder.path(), &settings("landscape", ["16", "5", "8", "5"]));
    let place = |low: f64, high: f64| Place {
        min_mm: [low, 0.0],
        max_mm: [high, 5.0],
    };
    let parts = read_places(&path, &[place(0.0, 8.0), place(8.0, 16.0)]);
    let sum = parts[0].moments + parts[1].moments;
    let whole = read(&path).unwrap()[0].whole.moments;
    assert!(parts.iter().all(|part| part.moments.volume() > 0.1));
    for (sum, whole) in sum.0.iter().zip(whole.0) {
        assert!((sum - whole).abs() < 1e-9 * whole.abs().max(1.0));
    }
}

#[test]
fn a_stack_of_images_is_weighed_by_its_list() {
    let folder = tempfile::tempdir().unwrap();
    let images = folder.path().join("plate");
    fs::create_dir(&images).unwrap();
    for layer in 0..3 {
        fs::write(images.join(image_name(layer)), image([0, 4], [0, 5])).unwrap();
    }
    let mut list = StackRow {
        schema: StackRow::SCHEMA,
        job: "box".to_owned(),
        plates: vec![StackPlate {
            plate: "plate.3mf".to_owned(),
            folder: "plate".to_owned(),
            pixel_mm: [0.5, 0.25],
            corner_mm: [10.0, 20.0],
            pixels: COUNT,
            layer_mm: 0.1,
            layers: 3,
            volume_mm3: 0.0,
        }],
    };
    let path = folder.path().join(STACK_FILE);
    let write = |list: &StackRow| fs::write(&path, serde_json::to_string(list).unwrap()).unwrap();
    write(&list);
    let plates = read(&path).unwrap();
    let moments = plates[0].whole.moments;
    assert!((moments.volume() - 4.2 * 5.0 * 0.125 * 0.3).abs() < 1e-12);
    assert!((moments.centroid().y - (20.0 - 0.625)).abs() < 1e-12);
    // A list that leads out of its folder, or says more layers than there are.
    list.plates[0].folder = "../plate".to_owned();
    write(&list);
    assert!(read(&path).unwrap_err().contains("`folder`"));
    list.plates[0].folder = "plate".to_owned();
    list.plates[0].layers = 4;
    write(&list);
    assert!(read(&path).unwrap_err().contains("00003.png"));
    list.plates[0].layers = 3;
    list.plates[0].pixels = [5, 8];
    write(&list);
    let said = read(&path).unwrap_err();
    assert!(
        said.contains("8 × 5 pixels, and 5 × 8 are stated"),
        "{said}"
    );
    for pixels in [[0, 5], [4_000_000_000, 1], [60_000, 60_000]] {
        list.plates[0].pixels = pixels;
        write(&list);
        assert!(read(&path).unwrap_err().contains("`pixels`"));
    }
}

#[test]
fn damaged_archives_are_refused_with_the_part_at_fault() {
    let folder = tempfile::tempdir().unwrap();
    let usual = settings("landscape", ["16", "5", "8", "5"]);
    let refused = |slicer: &str| read(&archive(folder.path(), slicer)).unwrap_err();
    for (wrong, key) in [
        (usual.replace("display_width = 16", ""), "display_width"),
        (usual.replace("= 16", "= nan"), "display_width"),
        (
            usual.replace("pixels_y = 5", "pixels_y = -5"),
            "display_pixels_y",
        ),
    ] {
        let said = refused(&wrong);
        assert!(said.contains(key) && said.contains("remedy"), "{said}");
    }
    let said = refused(&usual.replace("pixels_y = 5", "pixels_y = 6"));
    assert!(said.contains("plate00000.png has 8 × 5 pixels"), "{said}");
    let path = folder.path().join("junk.sl1");
    fs::write(&path, b"PK\x03\x04 and no more").unwrap();
    assert!(read(&path).unwrap_err().contains("the archive"));
    let parts = [
        ("config.ini", "layerHeight = 0.1\n".to_owned()),
        ("prusaslicer.ini", usual),
    ];
    let whole = encode_sl1("a", &parts, &[image([2, 5], [1, 3])]).unwrap();
    let none = encode_sl1("a", &parts, &[]).unwrap();
    fs::write(&path, none).unwrap();
    assert!(read(&path).unwrap_err().contains("no layer"));
    let broken = encode_sl1("a", &parts, &[b"\x89PNG\r\n".to_vec()]).unwrap();
    fs::write(&path, broken).unwrap();
    assert!(read(&path).unwrap_err().contains("a00000.png"));
    // Whatever is cut off or flipped: an answer, and no panic.
    for at in (0..whole.len()).step_by(7) {
        let mut flipped = whole.clone();
        flipped[at] ^= 0x55;
        fs::write(&path, &flipped).unwrap();
        let _ = read(&path);
        fs::write(&path, &whole[..at]).unwrap();
        assert!(read(&path).is_err(), "cut off at {at}");
    }
}
