//! The object as drawn: its base, panels, shell, brackets and sheets.

use super::asked::Asked;
use super::base::{Base, ByVertices, NoBase, base};
use super::error::CoreRunError;
use super::pockets::{Pocket, cut_pockets, depth_mm, pockets};
use crate::base::verdict::Verdict;
use crate::base::watch::{Phase, Watch};
use crate::cladding::{
    Bolt, CladShell, CladdingError, PinRequest, Rod, RodBore, RodKit, RodRequest, ShellRequest,
    ShellStyle, Sides, bolts, rods,
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
    /// The rods between polyhedra.
    pub rods: Vec<Rod>,
    /// Their bores in the parts over each panel.
    pub rod_bores: Vec<Vec<RodBore>>,
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
///
/// It looks for a base without rods if they find no places and nobody asked for them.
pub fn build(asked: &Asked, watch: &Watch) -> Result<Verdict<Built, Refused>, CoreRunError> {
    let drawn = build_once(asked, watch)?;
    let lacks_rods = matches!(
        drawn,
        Verdict::No(Refused::Shell(CladdingError::NoRods { .. }))
    );
    if !lacks_rods || !asked.job.dowel.is_auto() || asked.job.base.is_some() {
        return Ok(drawn);
    }
    Ok(match build_once(&asked.with_rods(Vec::new()), watch)? {
        Verdict::Found(built) => Verdict::Found(built),
        Verdict::No(_) => drawn,
    })
}

/// Returns true if two rods of a kind join the polyhedra of an order: the base is looked for again,
/// and they find their places.
pub fn is_joined_by(asked: &Asked, kit: &RodKit, watch: &Watch) -> Result<bool, CoreRunError> {
    let other = asked.with_rods(vec![kit.clone()]);
    let Verdict::Found(Base { plan, .. }) = base(&other, watch)? else {
        return Ok(false);
    };
    let bodies = plan.polyhedra.iter();
    let panels = bodies.map(|body| PanelSet::of(body, &other.panels));
    let panels: Result<Vec<PanelSet>, PanelError> = panels.collect();
    let mut panels = match panels {
        Ok(panels) => panels,
        Err(_) => return Ok(false),
    };
    Ok(match add_rods(&other, &plan, &mut panels) {
        Ok(rods) => !rods.is_empty(),
        Err(_) => false,
    })
}

fn build_once(asked: &Asked, watch: &Watch) -> Result<Verdict<Built, Refused>, CoreRunError> {
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
    let bare = match clad(asked, &plan, &panels, watch) {
        Ok(clad) => Bare {
            plan,
            vertices,
            clad,
        },
        Err(why) if is_answer(&why) => return Ok(Verdict::No(Refused::Shell(why))),
        Err(error) => return Err(error.into()),
    };
    furnish(asked, bare, watch)
}

/// A base with its shell, without brackets.
struct Bare {
    plan: BasePlan,
    vertices: Option<ByVertices>,
    clad: Clad,
}

/// A shell, and what joins its polyhedra.
struct Clad {
    shell: CladShell,
    bolts: Vec<Bolt>,
    rods: Vec<Rod>,
    rod_bores: Vec<Vec<RodBore>>,
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
        clad,
    } = bare;
    let mut shell = clad.shell;
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
        bolts: clad.bolts,
        rods: clad.rods,
        rod_bores: clad.rod_bores,
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
            | CladdingError::NoRods { .. }
            | CladdingError::NoCut { .. }
    )
}

/// Makes the shell around the panels of a base, with the bolts through common ones and the rods
/// between others.
fn clad(
    asked: &Asked,
    plan: &BasePlan,
    panels: &[PanelSet],
    watch: &Watch,
) -> Result<Clad, CladdingError> {
    let mut panels = panels.to_vec();
    let rods = add_rods(asked, plan, &mut panels)?;
    let sides = Sides::new(asked.ground, plan, asked.gap_mm)?.with_rods(&rods);
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
    let mut shell = sides.clad(&panels, &request, watch)?;
    let bolts = match &asked.bolt {
        Some(kit) => bolts(plan, &shell.panels, &asked.panels, kit)?,
        None => Vec::new(),
    };
    let holes = asked.bolt.iter();
    let holes = holes.flat_map(|kit| bolts.iter().flat_map(|bolt| bolt.holes(kit)));
    for (panel, hole) in holes {
        shell.panels.panels[panel].holes.push(hole);
    }
    let over = shell.panels.panels.iter();
    let rod_bores = over.map(|panel| sides.rods_over(panel.face)).collect();
    Ok(Clad {
        shell,
        bolts,
        rods,
        rod_bores,
    })
}

/// Finds the rods between polyhedra, and adds their holes to the panels of each.
fn add_rods(
    asked: &Asked,
    plan: &BasePlan,
    panels: &mut [PanelSet],
) -> Result<Vec<Rod>, CladdingError> {
    let before = |at: usize| plan.faces_before(at);
    let sets = panels.iter().cloned().enumerate();
    let set = PanelSet::joined(sets.map(|(at, set)| (set, before(at))));
    let request = RodRequest {
        ground: asked.ground,
        panels: &asked.panels,
        kits: &asked.rods,
        wall_mm: asked.wall_mm,
    };
    let rods = rods(plan, &set, &request)?;
    for (mut index, hole) in rods.iter().flat_map(Rod::holes) {
        for set in panels.iter_mut() {
            if let Some(panel) = set.panels.get_mut(index) {
                panel.holes.push(hole);
                break;
            }
            index -= set.panels.len();
        }
    }
    Ok(rods)
}
