//! The printable solid of cells, for a printer that is named.

use std::fmt::Write;

use serde::Serialize;

use super::cells_error::CellsCommandError;
use super::cells_order::Ordered;
use crate::base::numbers::quantity;
use crate::base::units::{format_count, show_mm, show_mm3};
use crate::base::watch::Watch;
use crate::cells::Cell;
use crate::comb::{Comb, CombCell, CombOrder, build};
use crate::io::stl;
use crate::kit::Kit;
use crate::mesh::{bodies, shells};

/// The file of the printable solid.
const SOLID_FILE: &str = "solid.stl";
/// The table of its cells.
const TABLE_FILE: &str = "printed.csv";

/// The facts of a printable solid.
#[derive(Debug, Serialize)]
pub(super) struct PrintedFacts {
    /// The file.
    file: &'static str,
    /// The printer's id.
    printer: String,
    skin_mm: f64,
    /// The free diameter of all openings, mm.
    opening_mm: f64,
    /// The cells that drain, and those that stay solid.
    drained: usize,
    solid: usize,
    /// The openings through inner walls, and the holes to the outside.
    openings: usize,
    holes: usize,
    /// The volume of the print, mm³.
    volume_mm3: f64,
    /// The volume of the print over that of the model.
    density: f64,
    /// The most cells on a way out.
    longest_way: usize,
}

/// Builds the printable solid, and adds it with a table of its cells.
pub(super) fn printed(
    ordered: &Ordered,
    cells: &[Cell],
    kit: &mut Kit,
    watch: &Watch,
) -> Result<Option<PrintedFacts>, CellsCommandError> {
    let (Some(printer), Some(wall_mm)) = (&ordered.printer, ordered.wall_mm) else {
        return Ok(None);
    };
    let order = comb_order(ordered, wall_mm)?;
    if shells(ordered.solid.mesh()).len() > bodies(ordered.solid.mesh()).len() {
        return Err(CellsCommandError::Hollow);
    }
    let in_model = |cell: &Cell| cell.in_model(&ordered.axes);
    let cells: Vec<Cell> = cells.iter().map(in_model).collect();
    let comb = build(&ordered.solid, &cells, &order, watch)?;
    let solid = comb.cells.iter().filter(|cell| cell.is_solid()).count();
    if solid == cells.len() {
        return Err(CellsCommandError::NoneDrains {
            cells: solid,
            opening_mm: order.opening_mm,
            least_mm: order.least_size_mm(),
        });
    }
    let mesh = comb.solid.mesh();
    kit.add(SOLID_FILE, stl::encode(mesh, "cells"));
    kit.add(TABLE_FILE, table(&comb.cells).into_bytes());
    let volume_mm3 = mesh.signed_volume_mm3();
    Ok(Some(PrintedFacts {
        file: SOLID_FILE,
        printer: printer.id.clone(),
        skin_mm: order.skin_mm,
        opening_mm: order.opening_mm,
        drained: cells.len() - solid,
        solid,
        openings: comb.doors.len(),
        holes: comb.escapes.len(),
        volume_mm3,
        density: volume_mm3 / ordered.solid.mesh().signed_volume_mm3(),
        longest_way: longest(&comb),
    }))
}

/// Returns the order for the printer that is named, before anything is divided.
pub(super) fn comb_order(ordered: &Ordered, wall_mm: f64) -> Result<CombOrder, CellsCommandError> {
    let Some(printer) = &ordered.printer else {
        return Err(CellsCommandError::NoWall);
    };
    CombOrder::for_printer(printer, wall_mm).map_err(|why| CellsCommandError::Undrainable {
        printer: printer.id.clone(),
        why: undrainable(why),
    })
}

/// Words why a process empties no closed cells.
fn undrainable(why: crate::printer::Undrainable) -> &'static str {
    use crate::printer::Undrainable;
    match why {
        Undrainable::Filament => "it lays filament, whose support would stay in them",
        Undrainable::Gel => "its support fills them, and is dug out and not drained",
        Undrainable::Narrow { .. } => "their openings would be too narrow",
    }
}

fn longest(comb: &Comb) -> usize {
    comb.cells
        .iter()
        .map(|cell| cell.path.len())
        .max()
        .unwrap_or_default()
}

/// Returns the cells as a table, with the way out of each. Cells and holes are counted from 1.
fn table(cells: &[CombCell]) -> String {
    let mut text = String::from("cell,volume_mm3,density,hole,way\n");
    for (number, cell) in (1..).zip(cells) {
        let hole = cell
            .escape
            .map_or("solid".to_owned(), |hole| (hole + 1).to_string());
        let way: Vec<String> = cell.path.iter().map(|at| (at + 1).to_string()).collect();
        // Writing into a string cannot fail.
        let _ = writeln!(
            text,
            "{number},{},{},{hole},{}",
            cell.volume_mm3,
            cell.density(),
            way.join(" ")
        );
    }
    text
}

/// Words the printable solid in rows.
pub(super) fn rows(printed: &PrintedFacts) -> Vec<[String; 2]> {
    let print = format!(
        "{} for {}: {}, {} of the model's volume",
        printed.file,
        printed.printer,
        show_mm3(printed.volume_mm3),
        quantity(100.0 * printed.density, "%")
    );
    let drains = format!(
        "{} through {} of {} and {} to the outside, over {} at most; {} solid",
        format_count(printed.drained, "cell"),
        format_count(printed.openings, "opening"),
        show_mm(printed.opening_mm),
        format_count(printed.holes, "hole"),
        format_count(printed.longest_way, "cell"),
        format_count(printed.solid, "cell")
    );
    vec![["print".to_owned(), print], ["drains".to_owned(), drains]]
}
