//! The scenes of an object's pictures: its units apart, and its base with the panels.

use super::asked::Asked;
use super::error::CoreRunError;
use super::made::Made;
use super::units::units;
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::page::{CoreView, Picture, ShownThing, draw_core};

/// The width of pictures of parts, in the size of the model: coarse bodies look the same.
const COARSE_RATIO: f64 = 0.002;

/// Draws the pictures of an object.
pub fn pictures(asked: &Asked, made: &Made, watch: &Watch) -> Result<Vec<Picture>, CoreRunError> {
    let units = units(made);
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
    });
    let sheets = panels.iter().enumerate().map(|(index, mesh)| ShownThing {
        id: format!("panel {}", index + 1),
        mesh,
        unit: units
            .iter()
            .position(|unit| unit.panel == Some(index + 1))
            .unwrap_or(0),
        is_panel: true,
    });
    let things: Vec<ShownThing> = printed.chain(sheets).collect();
    let view = CoreView {
        things: &things,
        units: units.iter().map(|unit| unit.id.clone()).collect(),
        ways: units.iter().map(|unit| Vector::from(unit.way)).collect(),
        up: asked.up,
    };
    Ok(draw_core(&view)?)
}
