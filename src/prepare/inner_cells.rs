//! An inside of cells: one piece whose voids are cells between thin walls, for printers that lay no
//! infill.
//!
//! The goal is solved with two densities: solid, and that of the cells. Theirs is measured once,
//! with the whole inside made of them. What the walls in the written voids truly weigh is made up
//! for afterwards, as is all that differs from a solution.

use std::sync::Arc;

use crate::base::watch::{Phase, Watch};
use crate::comb::{InnerCells, InnerSizes};
use crate::error::{CellsError, Error};
use crate::geom::Vector;
use crate::goal::GoalKind;
use crate::hollow::Fill;
use crate::job::{DrainOrder, Job};
use crate::mesh::TriMesh;
use crate::printer::{Printer, Undrainable};
use crate::run::{Inside, Model, Placed, Shop};
use crate::voids::{Cavity, CavitySpec};

/// The most cells of an inside. A cube of 100 mm holds 8000 of 5 mm.
const MOST_CELLS: usize = 10_000;

/// Returns the sizes of the cells that a job orders; `None` if it orders none.
///
/// # Errors
/// The printer empties no cells, the job orders what they cannot have, or they do not fit.
pub fn sizes(job: &Job, model: &Model, shop: &Shop) -> Result<Option<InnerSizes>, Error> {
    if !job.interior.has_cells() {
        return match job.cell_size {
            Some(size) => Err(CellsError::NoCells { size_mm: size.mm() }.into()),
            None => Ok(None),
        };
    }
    refuse(job)?;
    let mesh = model.solid.mesh();
    let longest_mm = mesh.longest_side_mm();
    let wall_mm = shop.printer.quantise_wall(None, longest_mm)?.wall_mm;
    let usual = InnerSizes::for_printer(&shop.printer, wall_mm);
    let usual = usual.map_err(|why| of_printer(why, &shop.printer))?;
    let size_mm = job.cell_size.map_or(usual.size_mm, |size| size.mm());
    let sizes = InnerSizes { size_mm, ..usual };
    refuse_size(&sizes, mesh)?;
    Ok(Some(sizes))
}

/// Returns the filling that stands for cells where the best voids are searched for.
pub fn fill(sizes: &InnerSizes) -> Fill {
    Fill::new(sizes.cube_density()).unwrap_or(Fill::AIR)
}

/// Divides the inside of a placed goal into cells, and measures how dense they are.
///
/// # Errors
/// The inside cannot be drawn or divided, or nothing of it drains.
pub fn with_cells(
    placed: Placed,
    sizes: Option<InnerSizes>,
    watch: &Watch,
) -> Result<Placed, Error> {
    let Some(sizes) = sizes else {
        return Ok(placed);
    };
    if placed.string_gap_mm().is_some() {
        return Err(CellsError::Halves.into());
    }
    watch.enter(Phase::Shell);
    let keeps = &placed.placement.keeps;
    let printer = &placed.shop.printer;
    let spec = CavitySpec::for_printer(printer, placed.shop.wall.wall_mm, keeps);
    let inside = Cavity::extract(placed.solid(), &spec, watch)?;
    let mut cells = divide(inside.mesh(), sizes, watch)?;
    if printer.prints_in_vat() {
        let turned = cells.turned(&downs(&placed), inside.mesh(), watch);
        cells = turned.map_err(CellsError::from)?;
    }
    let voids = cells.within(inside.mesh(), watch);
    let voids = voids.map_err(CellsError::from)?;
    let none = CellsError::NoneDrains {
        size_mm: sizes.size_mm,
        wall_mm: sizes.wall_mm,
        opening_mm: sizes.opening_mm,
    };
    Ok(Placed {
        fill: Fill::new(voids.density).ok_or(none)?,
        cells: Some(Arc::new(Inside {
            cells,
            solid: voids.solid,
        })),
        ..placed
    })
}

/// Returns the directions that may point to the platform of a vat: the lower corners of a cube
/// along the axes of the model.
///
/// Cells are near cubes along these axes. On its corner a cube encloses the least below openings at
/// its sides.
fn downs(placed: &Placed) -> Vec<Vector> {
    let up = placed.goal().frame.axis();
    let signs =
        (0..8).map(|corner| [0, 1, 2].map(|axis| f64::from(corner >> axis & 1) * 2.0 - 1.0));
    let corners = signs.map(|corner| Vector::from(corner).normalize());
    corners.filter(|corner| corner.dot(&up) < 0.0).collect()
}

fn divide(inside: &TriMesh, sizes: InnerSizes, watch: &Watch) -> Result<InnerCells, CellsError> {
    Ok(InnerCells::divide(inside, sizes, watch)?)
}

/// Refuses what cells cannot have.
fn refuse(job: &Job) -> Result<(), CellsError> {
    if job.goal.kind == GoalKind::Match {
        return Err(CellsError::Match);
    }
    if job.plan.is_some() {
        return Err(CellsError::Cuts);
    }
    if let Some(fill) = job.fill {
        return Err(CellsError::Filling { fill });
    }
    if !job.ballast.is_none() {
        let order = job.ballast.clone();
        return Err(CellsError::Ballast { order });
    }
    if job.goal.kind == GoalKind::Float && !job.plugs {
        return Err(CellsError::Floats);
    }
    if job.drain == DrainOrder::Never {
        return Err(CellsError::Closed);
    }
    Ok(())
}

/// Refuses sizes that do not go with each other, or with the model.
fn refuse_size(sizes: &InnerSizes, model: &TriMesh) -> Result<(), CellsError> {
    let (size_mm, least_mm) = (sizes.size_mm, sizes.least_mm());
    if size_mm < least_mm {
        return Err(CellsError::NoRoom {
            size_mm,
            wall_mm: sizes.wall_mm,
            opening_mm: sizes.opening_mm,
            least_mm,
        });
    }
    let longest_mm = model.longest_side_mm();
    if size_mm > longest_mm {
        return Err(CellsError::Larger {
            size_mm,
            longest_mm,
        });
    }
    let count = model.signed_volume_mm3() / size_mm.powi(3);
    if count > MOST_CELLS as f64 {
        return Err(CellsError::TooMany {
            count,
            size_mm,
            most: MOST_CELLS,
            least_mm: size_mm * (count / MOST_CELLS as f64).cbrt(),
        });
    }
    Ok(())
}

/// Returns the reason why a printer empties no cells.
fn of_printer(why: Undrainable, printer: &Printer) -> CellsError {
    let printer = printer.name.clone();
    match why {
        // No width was asked for, so that none is too narrow.
        Undrainable::Filament | Undrainable::Narrow { .. } => CellsError::Filament { printer },
        Undrainable::Gel => CellsError::Gel { printer },
    }
}
