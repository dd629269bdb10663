//! The scenes of an object's pictures: its units apart, and its base with the panels.

use super::asked::Asked;
use super::error::CoreRunError;
use super::made::Made;
use super::units::{joins, units};
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::page::{CoreView, JoinStep, Picture, ShownThing, Stage, draw_core};
use crate::verify::{CorePartKind, JoinPromise, UnitPromise};

/// The width of pictures of parts, in the size of the model: coarse bodies look the same.
const COARSE_RATIO: f64 = 0.002;

/// The pictures of an object, and its view.
pub struct Shown {
    pub pictures: Vec<Picture>,
    pub stage: Stage,
}

/// Draws the pictures and the view of an object.
pub fn pictures(asked: &Asked, made: &Made, watch: &Watch) -> Result<Shown, CoreRunError> {
    let (units, joins) = (units(made), joins(made));
    let size_mm = asked.ground.solid().mesh().longest_side_mm();
    let bodies: Vec<TriMesh> = made
        .built
        .shell
        .parts
        .iter()
        .map(|part| {
            let body = crate::mesh::Csg::of_mesh(&part.body)?;
            body.coarsen(COARSE_RATIO * size_mm).to_mesh()
        })
        .collect::<Result<_, _>>()?;
    watch.check()?;
    let brackets: Vec<TriMesh> = made.brackets().iter().map(|part| part.in_model()).collect();
    let panels = made.built.shell.panels.panels.iter();
    let panels: Vec<TriMesh> = panels.map(|panel| panel.body()).collect();
    let unit_of = |id: &str| {
        units
            .iter()
            .position(|unit| unit.parts.iter().any(|own| own == id))
    };
    let printed = made.parts.iter().zip(bodies.iter().chain(&brackets));
    let printed = printed.map(|(part, mesh)| ShownThing {
        id: part.id.clone(),
        mesh,
        unit: unit_of(&part.id).unwrap_or(0),
        is_panel: false,
        is_bracket: part.kind == CorePartKind::Bracket,
    });
    let sheets = panels.iter().enumerate().map(|(index, mesh)| ShownThing {
        id: format!("panel {}", index + 1),
        mesh,
        unit: units
            .iter()
            .position(|unit| unit.panel == Some(index + 1))
            .unwrap_or(0),
        is_panel: true,
        is_bracket: false,
    });
    let things: Vec<ShownThing> = printed.chain(sheets).collect();
    let view = CoreView {
        things: &things,
        units: units.iter().map(|unit| unit.id.clone()).collect(),
        apart: units.iter().map(|unit| apart(unit, &joins)).collect(),
        steps: steps(&units, &joins),
        up: asked.up,
    };
    Ok(Shown {
        pictures: draw_core(&view)?,
        stage: Stage::of_units(&view, watch)?,
    })
}

/// Returns the way by which a unit is drawn apart: its own, and those of its polyhedron.
fn apart(unit: &UnitPromise, joins: &[JoinPromise]) -> Vector {
    let comes = |join: &&JoinPromise| {
        let own = unit.polyhedron;
        own.is_some_and(|own| join.moving.contains(&own))
    };
    let ways = joins.iter().filter(comes);
    let ways = ways.map(|join| Vector::from(join.way));
    ways.fold(Vector::from(unit.way), |all, way| all + way)
}

/// Returns the steps in which the object is put together: each polyhedron but for what closes it,
/// then the polyhedra, then the rest.
fn steps(units: &[UnitPromise], joins: &[JoinPromise]) -> Vec<JoinStep> {
    let own = |unit: usize| JoinStep {
        name: units[unit].id.clone(),
        moving: vec![unit],
        standing: (0..unit)
            .filter(|&other| {
                let is_beside = units[other].polyhedron == units[unit].polyhedron;
                units[unit].is_last || (is_beside && !units[other].is_last)
            })
            .collect(),
        way: Vector::from(units[unit].way),
    };
    let whole = joins.iter().map(|join| {
        let within = |numbers: &[usize]| {
            let is_in = |unit: &UnitPromise| {
                let own = unit.polyhedron;
                own.is_some_and(|own| numbers.contains(&own)) && !unit.is_last
            };
            (0..units.len())
                .filter(|&unit| is_in(&units[unit]))
                .collect()
        };
        JoinStep {
            name: join.name(),
            moving: within(&join.moving),
            standing: within(&join.standing),
            way: Vector::from(join.way),
        }
    });
    let is_last = |unit: &usize| units[*unit].is_last;
    let before = (0..units.len()).filter(|unit| !is_last(unit)).map(own);
    let after = (0..units.len()).filter(is_last).map(own);
    before.chain(whole).chain(after).collect()
}
