//! The order of `equipoise cells`: its model, the sizes of its cells, their axes and first sites.

use std::path::Path;

use super::args::{CellsArgs, FieldChoice};
use super::cells_error::CellsCommandError;
use crate::base::watch::Watch;
use crate::cells::{
    Axes, MOST_SITES, PlacedAxes, Room, SitesError, Sizes, Start, check_sites, poisson_sites,
    random_sites, samples,
};
use crate::field::{Density, Order as FieldOrder, check};
use crate::geom::{Matrix, Point, Vector, orthonormal_basis};
use crate::io::{OnLine, SitesFileError, decode_axes, decode_sites, read_bytes, read_model};
use crate::mass::{Body, moments_of_mesh};
use crate::mend::mend;
use crate::mesh::{Solid, TriMesh, scaled};
use crate::printer::Printer;

/// Blocks along the model's longest side, if the sizes of its cells are not known before.
const BLOCKS: f64 = 30.0;

/// A model, and what its cells are to be. Places are in the frame of the axes.
pub(super) struct Ordered {
    /// The model, in its own coordinates.
    pub solid: Solid,
    /// The frame.
    pub axes: Axes,
    /// The axes of cells at places of the frame.
    pub placed: Vec<PlacedAxes>,
    /// The model's triangles in the frame.
    pub mesh: TriMesh,
    /// The room of the cells.
    pub room: Room,
    /// The first sites.
    pub sites: Vec<Point>,
    /// The printer that is named.
    pub printer: Option<Printer>,
    /// The wall, mm.
    pub wall_mm: Option<f64>,
    /// The sizes that follow a density.
    pub graded: Option<Graded>,
    /// ∫ 1/a³ over the model: the number of cells of the wished sizes.
    pub wished: f64,
}

/// Sizes of cells that follow a density.
pub(super) struct Graded {
    density: Box<dyn Density>,
    axes: Axes,
    wall_mm: f64,
    longest_mm: f64,
}

impl Graded {
    /// Returns the size of the cell whose walls make the density at a place of the frame, mm.
    ///
    /// Between the places that were checked it stays within two walls and the model's size.
    pub(super) fn size_mm(&self, at: &Point) -> f64 {
        let size_mm = size_mm(self.density.at(&self.axes.to_model(at)), self.wall_mm);
        size_mm.clamp(2.0 * self.wall_mm, self.longest_mm)
    }
}

/// Returns the size of the cell that has a density between walls: d = 1 − (1 − t/a)³.
fn size_mm(density: f64, wall_mm: f64) -> f64 {
    wall_mm / (1.0 - (1.0 - density).cbrt())
}

impl Ordered {
    /// Reads the model and the files that the arguments name, and throws the first sites.
    pub(super) fn of(args: &CellsArgs, watch: &Watch) -> Result<Self, CellsCommandError> {
        let sites = args.cells.sites.as_deref().map(read_sites).transpose()?;
        let density = args.cells.density.as_ref().map(FieldChoice::order);
        let density = density.transpose()?;
        let solid = read_solid(args, watch)?;
        let longest_mm = solid.mesh().longest_side_mm();
        let printer = args.walls.printer.as_deref().map(Printer::find);
        let printer = printer.transpose()?;
        let wall_mm = wall_mm(args, printer.as_ref(), longest_mm)?;
        let axes = axes(args, &solid)?;
        let placed = placed(args)?;
        let mesh = solid.mesh().map_vertices(|at| axes.to_frame(at));
        let volume_mm3 = mesh.signed_volume_mm3();
        let size_mm = args.cells.size.map(|size| size.mm());
        if let Some(size_mm) = size_mm {
            check_size(size_mm, volume_mm3, [longest_mm, wall_mm.unwrap_or(0.0)])?;
        }
        let mean_mm = |count: usize| (volume_mm3 / count.max(1) as f64).cbrt();
        let given_mm = sites.as_ref().map(|sites| mean_mm(sites.len()));
        let block_mm = size_mm.or(given_mm).unwrap_or(longest_mm / BLOCKS);
        let triangles: Vec<_> = mesh.iter_corners().collect();
        let room = Room::of_triangles(&triangles, block_mm.max(longest_mm / MOST_BLOCKS));
        watch.check()?;
        let graded = density.map(|order| graded(&order, &solid, axes, wall_mm));
        let graded = graded.transpose()?;
        let wished = wished(&room, graded.as_ref())?;
        let count = size_mm.map_or(wished, |size_mm| volume_mm3 / size_mm.powi(3));
        // Blocks much smaller than cells take time, and are as exact.
        let room = match &graded {
            Some(_) => Room::of_triangles(&triangles, mean_mm(count.round() as usize)),
            None => room,
        };
        let sites = match sites {
            Some(sites) => place(args, &sites, &room, &axes)?,
            None => throw(
                args,
                &room,
                count.round().max(1.0) as usize,
                graded.as_ref(),
            )?,
        };
        Ok(Self {
            solid,
            axes,
            placed,
            mesh,
            room,
            sites,
            printer,
            wall_mm,
            graded,
            wished,
        })
    }
}

/// The most blocks along the model's longest side. More of them only take time.
const MOST_BLOCKS: f64 = 100.0;

fn read_solid(args: &CellsArgs, watch: &Watch) -> Result<Solid, CellsCommandError> {
    let factor = |longest| args.scaling.scaling().factor(longest);
    let mended = mend(read_model(&args.model)?, Default::default(), factor, watch);
    let mended = mended.map_err(Box::new)?;
    let solid = Solid::new(scaled(&mended.mesh, mended.scale_ratio));
    solid.map_err(|defects| CellsCommandError::NoSolid(Box::new(defects)))
}

/// Returns the sizes that make a density between walls.
fn graded(
    order: &FieldOrder,
    solid: &Solid,
    axes: Axes,
    wall_mm: Option<f64>,
) -> Result<Graded, CellsCommandError> {
    let wall_mm = wall_mm.ok_or(CellsCommandError::NoWall)?;
    let density = order.on(solid);
    check(solid, density.as_ref())?;
    Ok(Graded {
        density,
        axes,
        wall_mm,
        longest_mm: solid.mesh().longest_side_mm(),
    })
}

/// Returns the wall that was ordered, or the least one of the printer; `None` without both.
fn wall_mm(
    args: &CellsArgs,
    printer: Option<&Printer>,
    longest_mm: f64,
) -> Result<Option<f64>, CellsCommandError> {
    let ordered_mm = args.walls.wall.map(|wall| wall.mm());
    Ok(match printer {
        Some(printer) => Some(printer.quantise_wall(ordered_mm, longest_mm)?.wall_mm),
        None => ordered_mm,
    })
}

/// Returns the frame in which the cells are cubes.
fn axes(args: &CellsArgs, solid: &Solid) -> Result<Axes, CellsCommandError> {
    let axes = if let Some(axis) = args.relaxation.axis {
        let axis = Vector::from(axis);
        let axis = (axis / axis.amax().max(f64::MIN_POSITIVE)).try_normalize(0.0);
        let axis = axis.ok_or(CellsCommandError::NoAxis)?;
        let (u, v) = orthonormal_basis(&axis);
        Matrix::from_columns(&[u, v, axis])
    } else if args.relaxation.align {
        let found = Body::new(&moments_of_mesh(solid.mesh()), 1.0)
            .principal()
            .axes;
        let [first, second] = [0, 1].map(|k| found.column(k).into_owned());
        Matrix::from_columns(&[first, second, first.cross(&second)])
    } else {
        Matrix::identity()
    };
    Ok(Axes::new(
        &axes,
        args.relaxation.stretch.unwrap_or([1.0; 3]),
    ))
}

/// Reads the axes of cells at places. There is no other frame beside them.
fn placed(args: &CellsArgs) -> Result<Vec<PlacedAxes>, CellsCommandError> {
    let Some(path) = &args.relaxation.frames else {
        return Ok(Vec::new());
    };
    let rows = decode_axes(&read_bytes(path)?).map_err(in_file(path))?;
    let placed = rows.into_iter().map(|row| {
        let [x, y, z, ax, ay, az, bx, by, bz] = row.value;
        let [first, toward] = [Vector::new(ax, ay, az), Vector::new(bx, by, bz)];
        let axes = PlacedAxes::new(Point::new(x, y, z), &first, &toward);
        axes.ok_or_else(|| CellsCommandError::FlatAxes {
            path: path.clone(),
            line: row.line,
        })
    });
    placed.collect()
}

fn read_sites(path: &Path) -> Result<Vec<OnLine<Point>>, CellsCommandError> {
    decode_sites(&read_bytes(path)?).map_err(in_file(path))
}

fn in_file(path: &Path) -> impl FnOnce(SitesFileError) -> CellsCommandError {
    |source| CellsCommandError::File {
        path: path.to_owned(),
        source,
    }
}

/// Checks the size of a cell against the model's longest side and the wall.
fn check_size(
    size_mm: f64,
    volume_mm3: f64,
    [longest_mm, wall_mm]: [f64; 2],
) -> Result<(), CellsCommandError> {
    if size_mm < 2.0 * wall_mm {
        return Err(CellsCommandError::NoRoom { size_mm, wall_mm });
    }
    if size_mm > longest_mm {
        return Err(CellsCommandError::Larger {
            size_mm,
            longest_mm,
        });
    }
    check_count(volume_mm3 / size_mm.powi(3), size_mm)
}

fn check_count(count: f64, size_mm: f64) -> Result<(), CellsCommandError> {
    let most = MOST_SITES as f64;
    if count > most {
        let least_mm = size_mm * (count / most).cbrt();
        return Err(CellsCommandError::TooMany { count, least_mm });
    }
    Ok(())
}

/// Returns ∫ 1/a³ of the wished sizes; the model's volume if there are none.
fn wished(room: &Room, graded: Option<&Graded>) -> Result<f64, CellsCommandError> {
    let Some(graded) = graded else {
        return Ok(room.volume_mm3());
    };
    let range = 2.0 * graded.wall_mm..=graded.longest_mm;
    for at in samples(room) {
        let at = graded.axes.to_model(&at);
        let density = graded.density.at(&at);
        // The greatest density has a size of two walls, but for rounding.
        if !range.contains(&(size_mm(density, graded.wall_mm) * (1.0 + 1e-12))) {
            return Err(CellsCommandError::NoSuchCells {
                at,
                density,
                least: 1.0 - (1.0 - graded.wall_mm / graded.longest_mm).powi(3),
                wall_mm: graded.wall_mm,
            });
        }
    }
    let sizes = Sizes::of(room, &|at| graded.size_mm(at));
    check_count(sizes.count, sizes.least_mm)?;
    Ok(sizes.count)
}

/// Puts the sites of a file into the frame, and checks them.
fn place(
    args: &CellsArgs,
    sites: &[OnLine<Point>],
    room: &Room,
    axes: &Axes,
) -> Result<Vec<Point>, CellsCommandError> {
    let placed: Vec<Point> = sites
        .iter()
        .map(|site| axes.to_frame(&site.value))
        .collect();
    let line = |site: usize| sites[site - 1].line;
    check_sites(&placed, room).map_err(|source| {
        let lines = match source {
            SitesError::Outside(site) | SitesError::NotFinite(site) => {
                format!("line {}", line(site))
            }
            SitesError::Doubled(one, other) => format!("lines {} and {}", line(one), line(other)),
            _ => format!("{} sites", sites.len()),
        };
        CellsCommandError::Sites {
            path: args.cells.sites.clone().unwrap_or_default(),
            lines,
            source,
        }
    })?;
    Ok(placed)
}

/// Throws the first sites.
fn throw(
    args: &CellsArgs,
    room: &Room,
    count: usize,
    graded: Option<&Graded>,
) -> Result<Vec<Point>, CellsCommandError> {
    let seed = args.cells.seed.unwrap_or_default();
    let mean_mm = (room.volume_mm3() / count as f64).cbrt();
    let size = |at: &Point| graded.map_or(mean_mm, |graded| graded.size_mm(at));
    let sites = match args.cells.start.unwrap_or(Start::Poisson) {
        Start::Random => random_sites(room, count, seed),
        Start::Poisson => poisson_sites(room, count, &size, seed),
    };
    check_sites(&sites, room)?;
    Ok(sites)
}
