//! The object as drawn: its base, panels, shell, brackets and sheets.

use super::asked::Asked;
use super::base::{Base, ByVertices, NoBase, base};
use super::error::CoreRunError;
use super::pockets::{Pocket, cut_pockets, depth_mm, pockets};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::cladding::{
    Bolt, CladShell, CladdingError, PinRequest, ShellRequest, ShellStyle, Sides, bolts,
};
use crate::cutting::{CutSheet, SheetError, SheetOrder, cut_sheets};
use crate::job::core_kit::CoreShell;
use crate::panels::{Bracket, PanelError, PanelSet};
use crate::polyhedra::BasePlan;

/// The largest piece without a panel that grows on a part of another cell, mm³.
const CRUMB_MM3: f64 = 2000.0;

/// The object as drawn.
pub struct Built {
    pub plan: BasePlan,
    /// The yield of the paper's method before its proof, if it made the base.
    pub vertices: Option<ByVertices>,
    pub shell: CladShell,
    pub brackets: Vec<Bracket>,
    /// The bolts between polyhedra.
    pub bolts: Vec<Bolt>,
    pub pockets: Vec<Pocket>,
    pub sheets: Vec<CutSheet>,
}

/// A reason why there is no such object.
#[derive(Debug)]
pub enum Refused {
    /// There is no base.
    Base(NoBase),
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
    let Base { plan, vertices } = match base(asked, watch)? {
        Verdict::Found(base) => base,
        Verdict::No(why) => return Ok(Verdict::No(Refused::Base(why))),
    };
    if plan.polyhedra.len() > 1 && asked.bolt.is_none() {
        let sheet_mm = asked.panels.sheet_mm;
        return Err(CoreRunError::NoBolt { sheet_mm });
    }
    let bodies = plan.polyhedra.iter();
    let panels = bodies.map(|body| PanelSet::of(body, &asked.panels));
    let panels: Vec<PanelSet> = match panels.collect() {
        Ok(panels) => panels,
        Err(why) => return Ok(Verdict::No(Refused::Panels(why))),
    };
    watch.enter(Phase::Shell);
    let (shell, bolts) = match clad(asked, &plan, &panels, watch) {
        Ok(clad) => clad,
        Err(why) if is_answer(&why) => return Ok(Verdict::No(Refused::Shell(why))),
        Err(error) => return Err(error.into()),
    };
    let bare = Bare {
        plan,
        vertices,
        shell,
        bolts,
    };
    furnish(asked, bare, watch)
}

/// A base with its shell and bolts, without brackets.
struct Bare {
    plan: BasePlan,
    vertices: Option<ByVertices>,
    shell: CladShell,
    bolts: Vec<Bolt>,
}

/// Adds brackets and their pockets, and lays the panels out on sheets.
fn furnish(
    asked: &Asked,
    bare: Bare,
    watch: &Watch,
) -> Result<Verdict<Built, Refused>, CoreRunError> {
    let Bare {
        plan,
        vertices,
        mut shell,
        bolts,
    } = bare;
    let brackets = shell.panels.brackets(&asked.panels)?;
    let pockets = pockets(asked, &plan, &shell, &brackets);
    cut_pockets(&mut shell, &pockets)?;
    watch.enter(Phase::Plan);
    let order = SheetOrder {
        cutter: &asked.shop.cutter,
        sheet: &asked.shop.sheet,
        stock: &asked.stock,
        keeps_grain: asked.keeps_grain,
    };
    let sheets = match cut_sheets(&shell.panels, &order) {
        Ok(sheets) => sheets,
        Err(why @ SheetError::Nest(_)) => return Ok(Verdict::No(Refused::Sheets(why))),
        Err(error) => return Err(error.into()),
    };
    Ok(Verdict::Found(Built {
        plan,
        vertices,
        shell,
        brackets,
        bolts,
        pockets,
        sheets,
    }))
}

/// Returns true if an error in making the shell is an answer: another base may do.
fn is_answer(why: &CladdingError) -> bool {
    matches!(
        why,
        CladdingError::Cycle { .. }
            | CladdingError::Enclosed { .. }
            | CladdingError::NoBolts { .. }
            | CladdingError::NoCut { .. }
    )
}

/// Makes the shell around the panels of a base, with the bolts through common ones.
fn clad(
    asked: &Asked,
    plan: &BasePlan,
    panels: &[PanelSet],
    watch: &Watch,
) -> Result<(CladShell, Vec<Bolt>), CladdingError> {
    let sides = Sides::new(asked.ground, plan, asked.gap_mm)?;
    let request = ShellRequest {
        wall_mm: asked.wall_mm,
        style: match asked.job.shell {
            CoreShell::Cups => ShellStyle::Cups,
            CoreShell::Solid => ShellStyle::Solid,
        },
        crumb_mm3: CRUMB_MM3,
        room_mm: asked.room_mm(),
        kit: Some(&asked.screws),
        pins: Some(PinRequest {
            plan: &asked.pins,
            floor_mm: depth_mm(asked),
        }),
        up: asked.up,
    };
    let mut shell = sides.clad(panels, &request, watch)?;
    let Some(kit) = &asked.bolt else {
        return Ok((shell, Vec::new()));
    };
    let bolts = bolts(plan, &shell.panels, &asked.panels, kit)?;
    for (panel, hole) in bolts.iter().flat_map(|bolt| bolt.holes(kit)) {
        shell.panels.panels[panel].holes.push(hole);
    }
    Ok((shell, bolts))
}
