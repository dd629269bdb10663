//! The panel to which a bracket is screwed.

use crate::cladding::CladShell;
use crate::panels::Bracket;
use crate::polyhedra::BasePlan;

/// The panel that carries a bracket.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Home {
    /// The flange of the bracket on that panel.
    pub flange: usize,
    /// The index of the panel.
    pub panel: usize,
    /// False if the bracket is glued there too: heads of screws would stand in the panel of
    /// another polyhedron that bears on it.
    pub is_screwed: bool,
}

/// Returns the panel that carries a bracket.
///
/// It is the one of both that is joined first; the other one is glued on when it comes. A panel
/// that bears on another polyhedron comes second, for heads have no room there. Where the bracket
/// would then come through that panel, it is glued to it in spite of that.
pub fn home_panel(plan: &BasePlan, shell: &CladShell, bracket: &Bracket) -> Home {
    let panels = shell.panels.edges[bracket.edge].panels;
    let place = |panel: usize| {
        let face = shell.panels.panels[panel].face;
        let assembly = &shell.assembly;
        let is_own =
            |unit: &usize| assembly.units[*unit].has_panel && assembly.units[*unit].face == face;
        assembly.order.iter().position(is_own)
    };
    let bears = |panel: usize| {
        let face = plan.face(shell.panels.panels[panel].face);
        face.is_some_and(|face| face.is_locked)
    };
    let [first, second] = panels.map(|panel| (bears(panel), place(panel)));
    let mut flange = usize::from(second < first);
    let normals = panels.map(|panel| shell.panels.panels[panel].frame.axis());
    // It leaves with its panel. Where both panels meet at more than 90°, its other flange would
    // leave through the other panel, if that stood there before.
    let is_later = [first, second][flange].1 > [first, second][1 - flange].1;
    if is_later && normals[0].dot(&normals[1]) > 0.0 {
        flange = 1 - flange;
    }
    Home {
        flange,
        panel: panels[flange],
        is_screwed: ![first, second][flange].0,
    }
}
