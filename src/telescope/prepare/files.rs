//! The files of a telescope's kit besides its parts and papers.

use serde::Serialize;

use super::asked::Asked;
use super::error::TelescopeRunError;
use super::made::{Made, WrittenPart, from_print};
use crate::draw::part_color;
use crate::geom::{Frame, Matrix, Point, Vector};
use crate::io::threemf::{Build, Object, Package, PrintSettings, Transform};
use crate::make::{Arrangement, File, plates, print_settings};
use crate::mesh::TriMesh;
use crate::sheet::telescope::{ShellRow, TelescopeSheet};
use crate::telescope::motion::Key;
use crate::verify::{NESTED_FILE, NESTED_NAME};
use crate::wing::Unwritable;

/// Points of the curve that are written for each shell.
const CURVE_SAMPLES: usize = 40;

/// Returns the points asked for and made, one pair a line.
pub fn curve_csv(asked: &Asked, made: &Made) -> String {
    let design = &made.best.design;
    let wanted = wanted_points(asked, made);
    let reached = design.fit.chain.samples(CURVE_SAMPLES);
    let lines = wanted.iter().zip(&reached).map(|(p, q)| {
        format!(
            "{:.6},{:.6},{:.6},{:.6},{:.6},{:.6}\n",
            p.x, p.y, p.z, q.x, q.y, q.z
        )
    });
    let titles = "asked_x,asked_y,asked_z,made_x,made_y,made_z\n".to_owned();
    [titles].into_iter().chain(lines).collect()
}

/// Returns points of the curve that was asked for.
pub fn wanted_points(asked: &Asked, made: &Made) -> Vec<Point> {
    let shells = made.best.design.telescope.shells.len();
    asked.curve.samples(shells * CURVE_SAMPLES)
}

/// The telescope as plain data: `telescope.toml`.
#[derive(Serialize)]
struct Written<'a> {
    kind: &'static str,
    visible_mm: f64,
    overlap_mm: f64,
    clearance_mm: f64,
    wall_mm: f64,
    order: &'a [Vec<String>],
    shells: &'a [ShellRow],
    turns_deg: Vec<f64>,
}

/// Returns the shells and turns as TOML, for people and other programs.
pub fn telescope_toml(sheet: &TelescopeSheet) -> Result<String, TelescopeRunError> {
    let written = Written {
        kind: "telescope",
        visible_mm: sheet.shells.first().map_or(0.0, |shell| shell.visible_mm),
        overlap_mm: sheet.joint_sizes.overlap_mm,
        clearance_mm: sheet.clearance_mm,
        wall_mm: sheet.wall_mm,
        order: &sheet.order,
        shells: &sheet.shells,
        turns_deg: sheet
            .joint_rows
            .iter()
            .map(|joint| joint.turn_deg)
            .collect(),
    };
    let text = toml::to_string(&written);
    Ok(text.map_err(|error| Unwritable::new("telescope.toml", &error))?)
}

/// Returns the plates, and the parts together, all in and all out.
pub fn packages(asked: &Asked, made: &Made) -> Result<Vec<File>, TelescopeRunError> {
    let scale = Vector::from(asked.shop.printer.print_scale_ratio());
    let printed: Vec<TriMesh> = made
        .parts
        .iter()
        .map(|part| {
            part.read_back
                .map_vertices(|p| p.coords.component_mul(&scale).into())
        })
        .collect();
    let objects: Vec<Object> = made
        .parts
        .iter()
        .zip(&printed)
        .map(|(part, mesh)| Object::new(&part.id, part_color(part.shell), mesh))
        .collect();
    let keys = &made.best.design.opening.keys;
    let ends = [
        ("collapsed.3mf", "all in", keys.first()),
        ("extended.3mf", "all out", keys.last()),
    ];
    let together = ends.into_iter().filter_map(|(file, words, key)| {
        Some((file.to_owned(), together(asked, made, key?, words)))
    });
    let in_place = asked.job.in_place;
    let apart = match in_place {
        true => Vec::new(),
        false => plates(&asked.shop.printer, &printed),
    };
    let jobs = together.chain(apart);
    let settings = print_settings(&asked.shop.printer).map(|usual| PrintSettings {
        // Support between shells could never be taken out.
        overhang_deg: usual.overhang_deg.filter(|_| !in_place),
        ..usual
    });
    let name = asked.job.name();
    let jobs = jobs.map(|(file, (description, build))| {
        let title = file.trim_end_matches(".3mf");
        let package = Package {
            title: format!("{name} {title}"),
            description,
            job: name.clone(),
            objects: &objects,
            build,
            settings,
        };
        Ok((file, package.encode()?))
    });
    let mut files: Vec<File> = jobs.collect::<Result<_, TelescopeRunError>>()?;
    if in_place {
        files.push(nested(name, &printed, settings)?);
    }
    Ok(files)
}

/// Returns the package of all shells in each other as they are printed, as one body of one object.
/// Slicers take several bodies apart and arrange them anew.
fn nested(
    name: String,
    printed: &[TriMesh],
    settings: Option<PrintSettings>,
) -> Result<File, TelescopeRunError> {
    let parts = printed.iter();
    let whole = parts.fold(TriMesh::default(), |all, part| all.joined(part));
    let here = Transform {
        linear: Matrix::identity(),
        shift: Vector::zeros(),
    };
    let package = Package {
        title: format!("{name} in place"),
        description: "All shells in each other, in print pose.".to_owned(),
        job: name,
        objects: &[Object::new(NESTED_NAME, part_color(0), &whole)],
        build: Build::Items(vec![(0, here)]),
        settings,
    };
    Ok((NESTED_FILE.to_owned(), package.encode()?))
}

/// Returns the parts where they are in a state: what was done to print them is undone.
fn together(asked: &Asked, made: &Made, key: &Key, words: &str) -> Arrangement {
    let unscaled = Vector::from(asked.shop.printer.print_scale_ratio()).map(f64::recip);
    let size = Transform {
        linear: Matrix::from_diagonal(&unscaled),
        shift: Vector::zeros(),
    };
    let frames = made.best.design.telescope.frames(key);
    let place = |(index, part): (usize, &WrittenPart)| {
        let placed = frames[part.shell].frame_to_model(&from_print(&part.pose));
        (index, size.then(&transform(&placed)))
    };
    let places = made.parts.iter().enumerate().map(place).collect();
    let description = format!("The telescope, {words}, in the axes of its curve.");
    (description, Build::Assembly(asked.job.name(), places))
}

fn transform(frame: &Frame) -> Transform {
    Transform {
        linear: frame.axes,
        shift: frame.origin.coords,
    }
}
