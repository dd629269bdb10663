//! The units in the order in which they are joined, with the brackets that go with them.

use super::home::home_panel;
use super::made::Made;
use super::names::bracket_id;
use crate::verify::UnitPromise;

/// Returns the units in the order in which they are joined.
pub fn units(made: &Made) -> Vec<UnitPromise> {
    let built = &made.built;
    let assembly = &built.shell.assembly;
    let panel_of = |face: usize| {
        let mut panels = built.shell.panels.panels.iter();
        panels.position(|panel| panel.face == face)
    };
    let units = assembly.order.iter().map(|&unit| &assembly.units[unit]);
    units
        .map(|unit| {
            let panel = panel_of(unit.face).filter(|_| unit.has_panel);
            let own = unit
                .parts
                .iter()
                .map(|&part| made.names.parts[part].clone());
            let brackets = built.brackets.iter().enumerate();
            let brackets = brackets
                .filter(|(_, bracket)| Some(home_panel(&built.shell, bracket).1) == panel)
                .map(|(index, _)| bracket_id(index));
            UnitPromise {
                id: made.names.unit(built, unit),
                panel: panel.map(|panel| panel + 1),
                parts: own.chain(brackets).collect(),
                way: unit.way.into(),
            }
        })
        .collect()
}
