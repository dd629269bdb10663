//! The panel to which a bracket is screwed.

use crate::cladding::CladShell;
use crate::panels::Bracket;

/// Returns the flange by which a bracket is screwed to its panel, and the index of that panel. It
/// is the one of both that is joined first; the other one is glued on when it comes.
pub fn home_panel(shell: &CladShell, bracket: &Bracket) -> (usize, usize) {
    let panels = shell.panels.edges[bracket.edge].panels;
    let place = |panel: usize| {
        let face = shell.panels.panels[panel].face;
        let assembly = &shell.assembly;
        let is_own =
            |unit: &usize| assembly.units[*unit].has_panel && assembly.units[*unit].face == face;
        assembly.order.iter().position(is_own)
    };
    let flange = usize::from(place(panels[1]) < place(panels[0]));
    (flange, panels[flange])
}
