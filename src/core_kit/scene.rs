//! The scenes of an object's pictures: its units apart, and its base with the panels.

use super::asked::Asked;
use super::bench::{bench_shifts, disc};
use super::error::CoreRunError;
use super::made::Made;
use super::rods::{rod_id, standing_end};
use super::units::{joins, units};
use crate::base::watch::Watch;
use crate::cladding::{PartPins, Rod};
use crate::cut::PinSite;
use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::page::{CoreView, JoinStep, Picture, ShownThing, Stage, ThingKind, draw_core};
use crate::verify::{BallastPromise, CorePartKind, JoinPromise, UnitPromise};

/// The width of pictures of parts, in the size of the model: coarse bodies look the same.
const COARSE_RATIO: f64 = 0.002;

/// The pictures of an object, and its view.
pub struct Shown {
    pub pictures: Vec<Picture>,
    pub stage: Stage,
}

/// Draws the pictures and the view of an object.
pub fn pictures(
    asked: &Asked,
    made: &Made,
    ballast: &[BallastPromise],
    watch: &Watch,
) -> Result<Shown, CoreRunError> {
    let bodies = Bodies::of(asked, made, ballast, watch)?;
    let (units, joins) = (units(made), joins(made));
    let shown = Things {
        made,
        units: &units,
        bodies: &bodies,
        bench: bench_shifts(made, &units),
    };
    let mut things = shown.printed();
    things.extend(shown.panels());
    things.extend(shown.pins());
    things.extend(shown.ballast(ballast));
    things.extend(shown.rods());
    let view = CoreView {
        things: &things,
        units: units.iter().map(|unit| unit.id.clone()).collect(),
        ways: units.iter().map(|unit| Vector::from(unit.way)).collect(),
        apart: units.iter().map(|unit| apart(unit, &joins)).collect(),
        polyhedra: units.iter().map(|unit| unit.polyhedron).collect(),
        steps: steps(&units, &joins),
        up: asked.up,
    };
    Ok(Shown {
        pictures: draw_core(&view)?,
        stage: Stage::of_units(&view, watch)?,
    })
}

/// The meshes of all things that are shown.
struct Bodies {
    parts: Vec<TriMesh>,
    brackets: Vec<TriMesh>,
    panels: Vec<TriMesh>,
    /// The pins of each joint.
    pins: Vec<Vec<TriMesh>>,
    ballast: Vec<TriMesh>,
    rods: Vec<TriMesh>,
}

impl Bodies {
    fn of(
        asked: &Asked,
        made: &Made,
        ballast: &[BallastPromise],
        watch: &Watch,
    ) -> Result<Self, CoreRunError> {
        let size_mm = asked.ground.solid().mesh().longest_side_mm();
        let shell = &made.built.shell;
        let parts = shell.parts.iter().map(|part| {
            let body = crate::mesh::Csg::of_mesh(&part.body)?;
            body.coarsen(COARSE_RATIO * size_mm).to_mesh()
        });
        let parts = parts.collect::<Result<_, _>>()?;
        watch.check()?;
        let pegs = |joint: &PartPins| joint.sites.iter().map(PinSite::protruding_body).collect();
        Ok(Self {
            parts,
            brackets: made.brackets().iter().map(|part| part.in_model()).collect(),
            panels: shell
                .panels
                .panels
                .iter()
                .map(|panel| panel.body())
                .collect(),
            pins: shell.pins.iter().map(pegs).collect(),
            ballast: ballast.iter().map(|piece| disc(&piece.lump)).collect(),
            rods: made.built.rods.iter().map(Rod::body).collect(),
        })
    }
}

/// The things of an object, as they are shown.
struct Things<'a> {
    made: &'a Made,
    units: &'a [UnitPromise],
    bodies: &'a Bodies,
    /// The ways of the shell's parts on the bench, mm.
    bench: Vec<Vector>,
}

impl<'a> Things<'a> {
    /// Returns the index of the unit in which a printed part is.
    fn unit_of(&self, id: &str) -> usize {
        let is_own = |unit: &UnitPromise| unit.parts.iter().any(|own| own == id);
        self.units.iter().position(is_own).unwrap_or(0)
    }

    /// Returns the index of the unit of a panel, which is given by its number.
    fn unit_with(&self, panel: usize) -> usize {
        let is_own = |unit: &UnitPromise| unit.panel == Some(panel);
        self.units.iter().position(is_own).unwrap_or(0)
    }

    fn printed(&self) -> Vec<ShownThing<'a>> {
        let meshes = self.bodies.parts.iter().chain(&self.bodies.brackets);
        let printed = self.made.parts.iter().zip(meshes).enumerate();
        let things = printed.map(|(index, (part, mesh))| ShownThing {
            id: part.id.clone(),
            mesh,
            unit: self.unit_of(&part.id),
            kind: match part.kind {
                CorePartKind::Bracket => ThingKind::Bracket,
                CorePartKind::Shell => ThingKind::Part,
            },
            bench: self.bench.get(index).copied().unwrap_or_default(),
        });
        things.collect()
    }

    fn panels(&self) -> impl Iterator<Item = ShownThing<'a>> {
        let panels = self.bodies.panels.iter().enumerate();
        panels.map(|(index, mesh)| ShownThing {
            id: format!("panel {}", index + 1),
            mesh,
            unit: self.unit_with(index + 1),
            kind: ThingKind::Panel,
            bench: Vector::zeros(),
        })
    }

    /// Returns the pins, each with the part on which it stands.
    fn pins(&self) -> impl Iterator<Item = ShownThing<'a>> {
        let joints = self.made.built.shell.pins.iter().zip(&self.bodies.pins);
        joints.flat_map(|(joint, pegs)| {
            let [from, to] = joint.parts.map(|part| &self.made.names.parts[part]);
            let unit = self.unit_of(from);
            let bench = self.bench[joint.parts[0]];
            pegs.iter()
                .enumerate()
                .map(move |(index, mesh)| ShownThing {
                    id: format!("pin {} from {from} into {to}", index + 1),
                    mesh,
                    unit,
                    kind: ThingKind::Pin,
                    bench,
                })
        })
    }

    /// Returns the rods, each with the panel into which it is glued first.
    fn rods(&self) -> Vec<ShownThing<'a>> {
        let built = &self.made.built;
        let rods = built.rods.iter().zip(&self.bodies.rods).enumerate();
        let things = rods.map(|(index, (rod, mesh))| {
            let end = standing_end(self.made, rod);
            ShownThing {
                id: format!("rod {}", rod_id(index)),
                mesh,
                unit: self.unit_with(rod.panels[end] + 1),
                kind: ThingKind::Rod,
                bench: Vector::zeros(),
            }
        });
        things.collect()
    }

    fn ballast(&self, pieces: &[BallastPromise]) -> Vec<ShownThing<'a>> {
        let pieces = pieces.iter().zip(&self.bodies.ballast).enumerate();
        let things = pieces.map(|(index, (piece, mesh))| ShownThing {
            id: format!("{} {}", piece.id, index + 1),
            mesh,
            unit: self.unit_with(piece.panel),
            kind: ThingKind::Ballast,
            bench: Vector::zeros(),
        });
        things.collect()
    }
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
