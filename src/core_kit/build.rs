//! The object as drawn: its base, panels, shell, brackets and sheets.

use super::asked::Asked;
use super::error::CoreRunError;
use super::pockets::{Pocket, cut_pockets, pockets};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::cladding::{CladShell, CladdingError, Scene, ShellRequest, ShellStyle};
use crate::cutting::{CutSheet, SheetError, SheetOrder, cut_sheets};
use crate::job::core_kit::CoreShell;
use crate::panels::{Bracket, PanelError, PanelSet};
use crate::polyhedra::{NoRoom, Polyhedron, grow_polyhedron};

/// The largest piece without a panel that grows on a part of another cell, mm³.
const CRUMB_MM3: f64 = 2000.0;

/// The object as drawn.
pub struct Built {
    pub base: Polyhedron,
    pub shell: CladShell,
    pub brackets: Vec<Bracket>,
    pub pockets: Vec<Pocket>,
    pub sheets: Vec<CutSheet>,
}

/// A reason why there is no such object.
#[derive(Debug)]
pub enum Refused {
    /// The model is too thin.
    NoRoom(NoRoom),
    /// The base gets no panels.
    Panels(PanelError),
    /// The parts of the shell cannot be cut or joined.
    Shell(CladdingError),
    /// The panels find no place on sheets.
    Sheets(SheetError),
}

/// Draws the object that is asked for.
pub fn build(asked: &Asked, watch: &Watch) -> Result<Verdict<Built, Refused>, CoreRunError> {
    watch.enter(Phase::Columns);
    let base = match grow_polyhedron(asked.ground, &asked.base, watch)? {
        Verdict::Found(base) => base,
        Verdict::No(why) => return Ok(Verdict::No(Refused::NoRoom(why))),
    };
    let panels = match PanelSet::of(&base, &asked.panels) {
        Ok(panels) => panels,
        Err(why) => return Ok(Verdict::No(Refused::Panels(why))),
    };
    watch.enter(Phase::Shell);
    let mut shell = match clad(asked, &base, &panels, watch) {
        Ok(shell) => shell,
        Err(why @ (CladdingError::Cycle { .. } | CladdingError::NoCut { .. })) => {
            return Ok(Verdict::No(Refused::Shell(why)));
        }
        Err(error) => return Err(error.into()),
    };
    let brackets = shell.panels.brackets(&asked.panels)?;
    let pockets = pockets(asked, &shell, &brackets);
    cut_pockets(&mut shell, &pockets)?;
    watch.enter(Phase::Plan);
    let order = SheetOrder {
        cutter: &asked.shop.cutter,
        sheet: &asked.shop.sheet,
        offcuts: &[],
        keeps_grain: false,
    };
    let sheets = match cut_sheets(&shell.panels, &order) {
        Ok(sheets) => sheets,
        Err(why @ SheetError::Nest(_)) => return Ok(Verdict::No(Refused::Sheets(why))),
        Err(error) => return Err(error.into()),
    };
    Ok(Verdict::Found(Built {
        base,
        shell,
        brackets,
        pockets,
        sheets,
    }))
}

/// Makes the shell around the panels of a base.
fn clad(
    asked: &Asked,
    base: &Polyhedron,
    panels: &PanelSet,
    watch: &Watch,
) -> Result<CladShell, CladdingError> {
    let scene = Scene::new(asked.ground, base, asked.gap_mm)?;
    let request = ShellRequest {
        wall_mm: asked.wall_mm,
        style: match asked.job.shell {
            CoreShell::Cups => ShellStyle::Cups,
            CoreShell::Solid => ShellStyle::Solid,
        },
        crumb_mm3: CRUMB_MM3,
        room_mm: asked.room_mm(),
        kit: Some(&asked.screws),
        up: asked.up,
    };
    scene.clad(panels, &request, watch)
}
