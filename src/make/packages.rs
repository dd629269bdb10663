//! The 3MF files of a kit: each part, all of them in place, and the plates they are printed on.

use std::path::Path;

use rayon::prelude::*;

use crate::base::watch::Watch;
use crate::cut::PinSite;
use crate::draw::{Color, part_color};
use crate::error::Error;
use crate::geom::{Aabb, Matrix, Point, Vector};
use crate::io::threemf::{Build, Object, Package, PrintSettings, SparseRegion, Transform};
use crate::io::{decode_model, stl};
use crate::job::PartFormat;
use crate::mesh::TriMesh;
use crate::printer::{LaidPlate, Printer, Quantity, Spot, Support};
use crate::run::{Made, Placed, WrittenJig, WrittenPart, WrittenRegion, WrittenSparse};
use crate::verify::{PlateSpot, PromisedPlate};

/// The name of the assembly in a kit.
const ASSEMBLY: &str = "assembly.3mf";

/// The process whose slicers fill parts sparsely unless they are told not to.
const FILAMENT: &str = "fdm";

/// The colour of jigs: the grey of a tool.
const JIG_COLOR: Color = [150, 150, 150];
/// Distance by which a file's coordinates and the sides of a round wall differ from it, mm.
const ROUNDING_MM: f64 = 1e-2;

/// A file of the kit by its path, and its bytes.
pub type File = (String, Vec<u8>);

/// Puts the parts into the files that are judged: their STL files, or their packages read back if
/// the job asks for 3MF alone.
pub fn repack(placed: &Placed, mut made: Made, watch: &Watch) -> Result<Made, Error> {
    if placed.job.format != PartFormat::ThreeMf {
        return Ok(made);
    }
    let scale = Vector::from(placed.shop.printer.print_scale_ratio());
    let parts = std::mem::take(&mut made.parts);
    let parts = parts.into_par_iter().enumerate().map(|(index, part)| {
        watch.check()?;
        let printed = stl::decode(&part.bytes)?;
        let (file, bytes) = pack(placed, &part, &[object(placed, index, &part, &printed)])?;
        let read_back = decode_model(&bytes)?;
        Ok(WrittenPart {
            file,
            bytes,
            read_back: read_back.map_vertices(|p| p.coords.component_div(&scale).into()),
            sparse: part.sparse.clone().map(within_package),
            ..part
        })
    });
    made.parts = parts.collect::<Result<_, Error>>()?;
    let jigs = std::mem::take(&mut made.jigs).into_iter();
    let jigs = jigs.map(|jig| {
        let (file, bytes) = pack_jig(placed, &jig)?;
        let read_back = decode_model(&bytes)?;
        Ok(WrittenJig {
            file,
            bytes,
            read_back: read_back.map_vertices(|p| p.coords.component_div(&scale).into()),
            ..jig
        })
    });
    made.jigs = jigs.collect::<Result<_, Error>>()?;
    Ok(made)
}

/// Returns the sparse infill of a part whose own file holds its regions.
fn within_package(sparse: WrittenSparse) -> WrittenSparse {
    let regions = sparse.regions.into_iter();
    let regions = regions.map(|region| WrittenRegion {
        file: None,
        ..region
    });
    WrittenSparse {
        regions: regions.collect(),
        ..sparse
    }
}

/// A jig's own package, as it lies in print pose.
fn pack_jig(placed: &Placed, jig: &WrittenJig) -> Result<File, Error> {
    let object = [jig_object(jig)?];
    let file = Path::new(&jig.file).with_extension("3mf");
    let description = format!("{}, a tool, in print pose.", jig.id());
    let build = Build::Items(vec![(0, Transform::default())]);
    let file = file.to_string_lossy().into_owned();
    package(placed, &object, file, (description, build))
}

/// A jig as an object of a package.
fn jig_object(jig: &WrittenJig) -> Result<Object, Error> {
    Ok(Object::new(
        &jig.id(),
        JIG_COLOR,
        &decode_model(&jig.bytes)?,
    ))
}

/// The packages of a kit.
#[derive(Debug, Default)]
pub struct Packages {
    /// The files.
    pub files: Vec<File>,
    /// What lies where on the plates among them.
    pub plates: Vec<PromisedPlate>,
}

/// The packages beside the judged files: the assembly, and the plates with the parts and the jigs.
/// Where both formats are asked for, STL parts have their twins too.
pub fn packages(placed: &Placed, made: &Made, watch: &Watch) -> Result<Packages, Error> {
    if placed.job.format == PartFormat::Stl {
        return Ok(Packages::default());
    }
    let parts = &made.parts;
    let jigs = made.jigs.iter();
    let printed = parts.par_iter().map(|part| printed_surface(placed, part));
    let mut printed: Vec<TriMesh> = printed.collect::<Result<_, _>>()?;
    for jig in jigs.clone() {
        printed.push(decode_model(&jig.bytes)?);
    }
    let mut objects: Vec<Object> = (0..parts.len())
        .into_par_iter()
        .map(|i| object(placed, i, &parts[i], &printed[i]))
        .collect();
    for jig in jigs.clone() {
        objects.push(jig_object(jig)?);
    }
    let ids = parts.iter().map(|part| part.part.id.to_string());
    let ids: Vec<String> = ids.chain(jigs.map(WrittenJig::id)).collect();
    let laid = lay_out(&placed.shop.printer, &printed);
    let mut jobs = plates(&placed.shop.printer, &printed);
    // A slicer would take the settings of a region for those of the assembly.
    if placed.sparse.is_none() {
        jobs.insert(0, (ASSEMBLY.to_owned(), together(placed, parts)));
    }
    let shared = jobs.into_par_iter().map(|(file, arrangement)| {
        watch.check()?;
        package(placed, &objects, file, arrangement)
    });
    let twins = (0..parts.len())
        .into_par_iter()
        .filter(|_| placed.job.format == PartFormat::Both);
    let twins = twins.map(|i| {
        watch.check()?;
        pack(placed, &parts[i], &objects[i..=i])
    });
    let jigs = made.jigs.iter();
    let jigs = jigs.filter(|_| placed.job.format == PartFormat::Both);
    let jigs = jigs.map(|jig| pack_jig(placed, jig));
    let jigs = jigs.collect::<Result<Vec<File>, Error>>()?;
    let files: Vec<File> = twins.chain(shared).collect::<Result<_, Error>>()?;
    Ok(Packages {
        files: [files, jigs].concat(),
        plates: laid
            .iter()
            .map(|plate| promise_plate(plate, &ids, &printed))
            .collect(),
    })
}

/// Returns the surface of a part as its file has it, without a region of sparse infill.
fn printed_surface(placed: &Placed, part: &WrittenPart) -> Result<TriMesh, Error> {
    let scale = Vector::from(placed.shop.printer.print_scale_ratio());
    Ok(match &part.sparse {
        Some(sparse) => enlarge(&sparse.outside, &scale),
        None => decode_model(&part.bytes)?,
    })
}

fn enlarge(mesh: &TriMesh, scale: &Vector) -> TriMesh {
    mesh.map_vertices(|p| p.coords.component_mul(scale).into())
}

/// Returns what lies where on a plate, by the names of its things.
fn promise_plate(plate: &LaidPlate, ids: &[String], printed: &[TriMesh]) -> PromisedPlate {
    let spot = |(index, spot): &(usize, Spot)| {
        let size = printed[*index].aabb().size();
        PlateSpot {
            id: ids[*index].clone(),
            low_mm: spot.low_mm,
            size_mm: if spot.is_turned {
                [size.y, size.x]
            } else {
                [size.x, size.y]
            },
            is_turned: spot.is_turned,
        }
    };
    PromisedPlate {
        file: plate.file.clone(),
        size_mm: plate.size_mm,
        holds: plate.spots.iter().map(spot).collect(),
    }
}

/// The description of a package, and the places of its objects.
pub type Arrangement = (String, Build);

/// A part's own package, as it lies in print pose.
fn pack(placed: &Placed, part: &WrittenPart, object: &[Object]) -> Result<File, Error> {
    let file = Path::new(&part.file)
        .with_extension("3mf")
        .to_string_lossy()
        .into_owned();
    let description = format!("Part {} in print pose.", part.part.id);
    let build = Build::Items(vec![(0, Transform::default())]);
    package(placed, object, file, (description, build))
}

/// Returns a part as an object whose sockets take no support.
fn object(placed: &Placed, index: usize, part: &WrittenPart, printed: &TriMesh) -> Object {
    let scale = Vector::from(placed.shop.printer.print_scale_ratio());
    let pose = part.evidence().pose;
    let in_socket = |corners: &[Point; 3]| {
        let [a, b, c] = corners.map(|p| p.coords.component_div(&scale));
        let middle = pose.to_model(&Point::from((a + b + c) / 3.0));
        part.part
            .sockets
            .iter()
            .any(|socket| is_in(socket, &middle))
    };
    let (name, color) = (part.part.id.to_string(), part_color(index));
    match (&part.sparse, &placed.sparse) {
        (Some(written), Some(sparse)) => {
            let regions = written.regions.iter().map(|region| SparseRegion {
                mesh: enlarge(&region.mesh, &scale),
                pattern: sparse.pattern.clone(),
                percent: region.level.nominal_percent(),
            });
            let regions: Vec<SparseRegion> = regions.collect();
            Object::with_regions(&name, color, printed, &regions)
        }
        _ => Object::with_blockers(&name, color, printed, in_socket),
    }
}

/// Returns whether a point of the surface is on a wall of a socket. It is then behind the cut face,
/// and no farther from the axis than the wall.
fn is_in(socket: &PinSite, at: &Point) -> bool {
    let from_mouth = at - Point::from(socket.center_mm);
    let axis = Vector::from(socket.direction);
    let along_mm = from_mouth.dot(&axis);
    let aside_mm = (from_mouth - axis * along_mm).norm();
    let radius_mm = 0.5 * socket.socket_diameter_mm + socket.socket_chamfer_mm;
    along_mm > ROUNDING_MM
        && along_mm < socket.socket_depth_mm + ROUNDING_MM
        && aside_mm < radius_mm + ROUNDING_MM
}

/// Returns the settings that a slicer of filament printers takes from a package: without them it
/// would print the parts with its own infill. Other processes print solid anyway.
pub fn print_settings(printer: &Printer) -> Option<PrintSettings> {
    let overhang_deg = printer.number(Quantity::OverhangDeg).map(|deg| deg.value);
    (printer.process.as_deref() == Some(FILAMENT)).then_some(PrintSettings {
        dialect: printer.dialect(),
        layer_mm: printer.layer_mm.value,
        line_mm: printer.pixel_x_mm.value,
        walls: printer.walls(),
        overhang_deg: overhang_deg.filter(|_| printer.support != Support::None),
    })
}

fn package(
    placed: &Placed,
    objects: &[Object],
    file: String,
    (description, build): Arrangement,
) -> Result<File, Error> {
    let title = Path::new(&file)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy();
    let title = format!("{} {title}", placed.name());
    let bytes = Package {
        title,
        description,
        job: placed.name(),
        objects,
        build,
        settings: print_settings(&placed.shop.printer),
    }
    .encode()?;
    Ok((file, bytes))
}

/// The parts where they belong in the model: what was done to print them is undone.
fn together(placed: &Placed, parts: &[WrittenPart]) -> Arrangement {
    let unscaled = Vector::from(placed.shop.printer.print_scale_ratio()).map(f64::recip);
    let size = Transform {
        linear: Matrix::from_diagonal(&unscaled),
        shift: Vector::zeros(),
    };
    let place = |(index, part): (usize, &WrittenPart)| {
        let pose = part.evidence().pose;
        let back = pose.rotation().transpose();
        (
            index,
            size.then(&Transform {
                linear: back,
                shift: -(back * pose.translation()),
            }),
        )
    };
    let places = parts.iter().enumerate().map(place).collect();
    let description = "The parts where they belong in the model, in its own axes.".to_owned();
    (description, Build::Assembly(placed.name(), places))
}

/// Lays printed things on plates by their boxes.
fn lay_out(printer: &Printer, printed: &[TriMesh]) -> Vec<LaidPlate> {
    let sizes = printed.iter().map(|mesh| mesh.aabb().size());
    let sizes: Vec<[f64; 2]> = sizes.map(|size| [size.x, size.y]).collect();
    printer.lay_out(&sizes)
}

/// Returns the plates with their parts in print pose, each with the name of its file.
pub fn plates(printer: &Printer, printed: &[TriMesh]) -> Vec<(String, Arrangement)> {
    let laid = lay_out(printer, printed).into_iter();
    laid.map(|plate| {
        let place =
            |(index, spot): &(usize, Spot)| (*index, laid_at(&printed[*index].aabb(), spot));
        let words = plate_words(printer, plate.number_of, plate.fits());
        let places = plate.spots.iter().map(place).collect();
        (plate.file, (words, Build::Items(places)))
    })
    .collect()
}

/// Describes a plate and says if its parts fit; `fits` is `None` if its size is not known.
fn plate_words(printer: &Printer, [plate, count]: [usize; 2], fits: Option<bool>) -> String {
    let printer = &printer.name;
    let fit = match fits {
        Some(true) => "",
        Some(false) => " What lies on it is larger than the plate.",
        None => " How large the plate is is not known.",
    };
    format!("Plate {plate} of {count} for {printer}, the parts in print pose.{fit}")
}

/// The motion that lays a part from its own file on its spot.
fn laid_at(aabb: &Aabb, spot: &Spot) -> Transform {
    let turn = Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let linear = if spot.is_turned {
        turn
    } else {
        Matrix::identity()
    };
    // Turned, the box's far side in y is its near side in x.
    let low = if spot.is_turned {
        [-aabb.max.y, aabb.min.x]
    } else {
        [aabb.min.x, aabb.min.y]
    };
    Transform {
        linear,
        shift: Vector::new(spot.low_mm[0] - low[0], spot.low_mm[1] - low[1], 0.0),
    }
}
