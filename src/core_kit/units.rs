//! The units in the order in which they are joined, with the brackets that go with them.

use super::home::home_panel;
use super::made::Made;
use super::names::bracket_id;
use crate::verify::{JoinPromise, UnitPromise};

/// Returns the units in the order in which they are joined.
pub fn units(made: &Made) -> Vec<UnitPromise> {
    let built = &made.built;
    let assembly = &built.shell.assembly;
    let panel_of = |face: usize| {
        let mut panels = built.shell.panels.panels.iter();
        panels.position(|panel| panel.face == face)
    };
    let units = assembly.order.iter().map(|&unit| &assembly.units[unit]);
    let is_one = assembly.joins.is_empty();
    let before_last = assembly.order.len() - assembly.last;
    units
        .enumerate()
        .map(|(place, unit)| {
            let panel = panel_of(unit.face).filter(|_| unit.has_panel);
            let own = unit
                .parts
                .iter()
                .map(|&part| made.names.parts[part].clone());
            let brackets = built.brackets.iter().enumerate();
            let brackets = brackets
                .filter(|(_, bracket)| {
                    Some(home_panel(&built.plan, &built.shell, bracket).panel) == panel
                })
                .map(|(index, _)| bracket_id(index));
            UnitPromise {
                id: made.names.unit(built, unit),
                panel: panel.map(|panel| panel + 1),
                parts: own.chain(brackets).collect(),
                way: unit.way.into(),
                polyhedron: (!is_one).then_some(unit.polyhedron + 1),
                is_last: !is_one && place >= before_last,
            }
        })
        .collect()
}

/// Returns the ways in which polyhedra come together, with the bolts and rods that then hold them.
pub fn joins(made: &Made) -> Vec<JoinPromise> {
    let built = &made.built;
    let numbers = |indices: &[usize]| indices.iter().map(|at| at + 1).collect();
    let joins = built.shell.assembly.joins.iter().map(|join| {
        let across = |connection: usize| {
            let [a, b] = built.plan.connections[connection].polyhedra;
            let sides = [&join.moving, &join.standing];
            sides
                .iter()
                .all(|side| side.contains(&a) != side.contains(&b))
        };
        let bolts = built.bolts.iter().map(|bolt| bolt.connection);
        let rods = built.rods.iter().map(|rod| rod.connection);
        JoinPromise {
            moving: numbers(&join.moving),
            standing: numbers(&join.standing),
            way: join.way.into(),
            bolts: bolts.filter(|of| across(*of)).count(),
            rods: rods.filter(|of| across(*of)).count(),
        }
    });
    joins.collect()
}
