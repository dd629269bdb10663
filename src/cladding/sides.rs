//! The shell about a base of several polyhedra: each on its side of the planes between them.
//!
//! Every polyhedron is put together for itself but for one side, which stays open. Then polyhedra
//! come together across the planes: as nothing of either crosses one, no way is barred. The open
//! sides are closed last, when the bolts hold.

use super::divide::{Scene, hold_loose};
use super::error::CladdingError;
use super::joins::joins;
use super::knot::Knot;
use super::ordering::knot;
use super::overlap::barred_mm2;
use super::part::Holding;
use super::part_pins::PartPins;
use super::rod_bore::RodBore;
use super::rods::{Rod, bores_of};
use super::screws::PartScrews;
use super::shell::{CladShell, ShellRequest};
use super::units::{Assembly, FREE_MM2, Unit};
use crate::base::watch::Watch;
use crate::geom::Vector;
use crate::mesh::TriMesh;
use crate::panels::PanelSet;
use crate::polyhedra::{BasePlan, Ground};

/// The area of a side through which a hand passes, mm²: a hole of 100 mm.
pub const HAND_MM2: f64 = 7_900.0;

/// The scenes of all polyhedra of a base.
pub struct Sides<'a> {
    plan: &'a BasePlan,
    scenes: Vec<Scene<'a>>,
}

impl<'a> Sides<'a> {
    /// Prepares a model about a base.
    ///
    /// # Errors
    /// As those of [`Scene::new`].
    pub fn new(ground: &Ground, plan: &'a BasePlan, gap_mm: f64) -> Result<Self, CladdingError> {
        let scenes = plan.polyhedra.iter().enumerate().map(|(index, base)| {
            let scene = Scene::new(ground, base, gap_mm)?;
            Ok(scene.bounded_by(plan.sides(index)))
        });
        Ok(Self {
            plan,
            scenes: scenes.collect::<Result<_, CladdingError>>()?,
        })
    }

    /// Returns the scenes with bores for rods through the parts.
    #[must_use]
    pub fn with_rods(self, rods: &[Rod]) -> Self {
        let scenes = self.scenes.into_iter().enumerate();
        let scenes = scenes.map(|(polyhedron, scene)| {
            let bores = bores_of(self.plan, rods, polyhedron, scene.gap_mm);
            scene.bored_for(bores)
        });
        Self {
            scenes: scenes.collect(),
            ..self
        }
    }

    /// Returns the bores of rods through the parts over a face, by its index in the whole base.
    pub fn rods_over(&self, face: usize) -> Vec<RodBore> {
        let scenes = self.scenes.iter().enumerate();
        let own = scenes.flat_map(|(polyhedron, scene)| {
            let before = self.plan.faces_before(polyhedron);
            let local = face.checked_sub(before);
            scene.rods.iter().filter(move |rod| Some(rod.face) == local)
        });
        own.copied().collect()
    }

    /// Makes the shell around the panels of all polyhedra, which come in their order. Faces, parts
    /// and panels are then counted through the whole base.
    ///
    /// # Errors
    /// As those of [`Scene::clad`], or no side of a polyhedron can be closed last.
    pub fn clad(
        &self,
        panels: &[PanelSet],
        request: &ShellRequest,
        watch: &Watch,
    ) -> Result<CladShell, CladdingError> {
        if let ([scene], [panels]) = (self.scenes.as_slice(), panels) {
            return scene.clad(panels, request, watch);
        }
        let mut shells = Vec::new();
        let mut units = Vec::new();
        for (scene, panels) in self.scenes.iter().zip(panels) {
            let shell = scene.clad_bare(panels, request, watch)?;
            units.push(scene.blocked(&shell.parts, &shell.pins));
            shells.push(shell);
        }
        let mut whole = self.joined(shells);
        hold_loose(&mut whole.parts);
        watch.check()?;
        let meeting = Meeting::new(self, &whole, units);
        whole.assembly = meeting.assembly(request, watch)?;
        Ok(whole)
    }

    /// Joins shells to one.
    fn joined(&self, shells: Vec<CladShell>) -> CladShell {
        let mut whole = CladShell {
            parts: Vec::new(),
            cups: Vec::new(),
            screws: Vec::new(),
            pins: Vec::new(),
            bores_mm3: 0.0,
            panels: PanelSet::joined([]),
            assembly: Assembly::default(),
        };
        let mut sets = Vec::new();
        let mut panels = 0;
        for (polyhedron, shell) in shells.into_iter().enumerate() {
            let face = self.plan.faces_before(polyhedron);
            let first = whole.parts.len();
            let parts = shell.parts.into_iter();
            whole
                .parts
                .extend(parts.map(|part| part.raised(face, first)));
            whole.cups.extend(shell.cups);
            let screws = shell.screws.into_iter();
            whole.screws.extend(screws.map(|screws| PartScrews {
                part: screws.part + first,
                panel: screws.panel + panels,
                ..screws
            }));
            let pins = shell.pins.into_iter();
            whole.pins.extend(pins.map(|pins| PartPins {
                parts: pins.parts.map(|part| part + first),
                ..pins
            }));
            whole.bores_mm3 += shell.bores_mm3;
            panels += shell.panels.panels.len();
            sets.push((shell.panels, face));
        }
        whole.panels = PanelSet::joined(sets);
        whole
    }
}

/// The units of all polyhedra, as they come together.
struct Meeting<'a> {
    sides: &'a Sides<'a>,
    shell: &'a CladShell,
    /// The units of each polyhedron, counted for itself.
    own: Vec<Vec<Unit>>,
    /// The same units counted through the whole base.
    units: Vec<Unit>,
    /// The panels' bodies.
    panels: Vec<TriMesh>,
}

impl<'a> Meeting<'a> {
    fn new(sides: &'a Sides, shell: &'a CladShell, own: Vec<Vec<Unit>>) -> Self {
        let mut units = Vec::new();
        let mut parts = 0;
        for (polyhedron, group) in own.iter().enumerate() {
            let (face, unit) = (sides.plan.faces_before(polyhedron), units.len());
            units.extend(group.iter().map(|of| Unit {
                polyhedron,
                face: of.face + face,
                parts: of.parts.iter().map(|part| part + parts).collect(),
                after: of.after.iter().map(|other| other + unit).collect(),
                ..of.clone()
            }));
            parts += group.iter().map(|of| of.parts.len()).sum::<usize>();
        }
        let panels = shell.panels.panels.iter();
        Self {
            sides,
            shell,
            own,
            units,
            panels: panels.map(|panel| panel.body()).collect(),
        }
    }

    /// Orders all units: polyhedra one by one, what closes them, then what hangs across a plane.
    fn assembly(self, request: &ShellRequest, watch: &Watch) -> Result<Assembly, CladdingError> {
        let plan = self.sides.plan;
        let (mut first, mut last) = (Vec::new(), Vec::new());
        let strays = self.strays();
        let mut start = 0;
        let mut closing_units = Vec::new();
        for polyhedron in 0..self.own.len() {
            watch.check()?;
            let (order, open) = self.closed(polyhedron, request)?;
            let shifted = order.iter().map(|unit| unit + start);
            let stays = |unit: &usize| !strays.contains(unit);
            let shifted: Vec<usize> = shifted.collect();
            first.extend(shifted[..open].iter().copied().filter(stays));
            last.push(shifted[open..].iter().copied().filter(stays).collect());
            closing_units.push(shifted[open]);
            start += self.own[polyhedron].len();
        }
        // The polyhedron at the bottom is closed last.
        let bottom = plan.bottom_face(&request.up);
        let is_lowest = |polyhedron: usize| {
            let own = plan.faces_before(polyhedron)..plan.faces_before(polyhedron + 1);
            bottom.is_some_and(|at| own.contains(&at))
        };
        let mut groups: Vec<(bool, Vec<usize>)> = last
            .into_iter()
            .enumerate()
            .map(|(polyhedron, units)| (is_lowest(polyhedron), units))
            .collect();
        groups.sort_by_key(|(is_lowest, _)| *is_lowest);
        let closing = closing_units
            .iter()
            .find(|unit| groups.last().is_some_and(|(_, own)| own.contains(unit)))
            .copied();
        let last: Vec<usize> = groups.into_iter().flat_map(|(_, units)| units).collect();
        let (units, hanging) = self.hang(&strays)?;
        let count = last.len() + hanging.len();
        Ok(Assembly {
            order: [first, last, hanging].concat(),
            joins: joins(plan, &request.up),
            last: count,
            closing,
            units,
        })
    }

    /// Returns the units, without panels, that hang on a part of another polyhedron, and those that
    /// hang on such units.
    fn strays(&self) -> Vec<usize> {
        let unit_of = |part: usize| {
            self.units
                .iter()
                .position(|unit| unit.parts.contains(&part))
        };
        let mut strays: Vec<usize> = Vec::new();
        loop {
            let next = (0..self.units.len()).find(|&index| {
                let unit = &self.units[index];
                let hangs = unit.parts.iter().any(|&part| {
                    let Holding::Pinned { to, .. } = self.shell.parts[part].holding else {
                        return false;
                    };
                    unit_of(to).is_some_and(|carrier| {
                        self.units[carrier].polyhedron != unit.polyhedron
                            || (carrier != index && strays.contains(&carrier))
                    })
                });
                !unit.has_panel && hangs && !strays.contains(&index)
            });
            match next {
                Some(next) => strays.push(next),
                None => return strays,
            }
        }
    }

    /// Returns the order of a polyhedron's units, counted for itself, and the number of those that
    /// come before it is joined to others.
    ///
    /// The side that stays open is the lowest through which a hand passes, of those whose units
    /// leave past all other polyhedra.
    fn closed(
        &self,
        polyhedron: usize,
        request: &ShellRequest,
    ) -> Result<(Vec<usize>, usize), CladdingError> {
        let base = &self.sides.plan.polyhedra[polyhedron];
        let scene = &self.sides.scenes[polyhedron];
        let faces = base.faces().iter().enumerate();
        let open = faces.filter(|(_, face)| face.area_mm2 > 0.0 && !face.is_locked);
        let mut open: Vec<(bool, f64, usize)> = open
            .map(|(index, face)| {
                let is_narrow = face.area_mm2 < HAND_MM2;
                (is_narrow, request.up.dot(&face.plane.normal), index)
            })
            .collect();
        open.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let start: usize = self.own[..polyhedron].iter().map(Vec::len).sum();
        let mut bars: Vec<usize> = Vec::new();
        for (_, _, face) in open {
            let units = self.own[polyhedron].clone();
            let assembly = scene.closed_by(units, &request.up, Some(face));
            let assembly = assembly.map_err(|waiting| {
                let waiting = waiting.iter().map(|unit| unit + start);
                knot(&self.shell.parts, &self.units, waiting.collect()).error()
            })?;
            let Some(at) = assembly
                .order
                .iter()
                .position(|unit| Some(*unit) == assembly.closing)
            else {
                continue;
            };
            let last = assembly.order[at..].iter().map(|unit| unit + start);
            let barring: Vec<usize> = last.flat_map(|unit| self.barring(unit)).collect();
            if barring.is_empty() {
                return Ok((assembly.order, at));
            }
            bars.extend(barring.iter().map(|&unit| self.units[unit].face));
        }
        bars.sort_unstable();
        bars.dedup();
        Err(CladdingError::Enclosed {
            polyhedron,
            faces: bars,
        })
    }

    /// Returns the units of other polyhedra that bar the way of a unit.
    fn barring(&self, unit: usize) -> Vec<usize> {
        let own = &self.units[unit];
        let others = (0..self.units.len())
            .filter(|&other| self.units[other].polyhedron != own.polyhedron)
            .filter(|&other| self.bars(other, unit, &own.way));
        others.collect()
    }

    /// Returns true if a unit bars another one's way.
    fn bars(&self, other: usize, moving: usize, way: &Vector) -> bool {
        let fixed = self.bodies(other);
        let moving = self.bodies(moving);
        let mut pairs = moving
            .iter()
            .flat_map(|a| fixed.iter().map(move |b| (*a, *b)));
        pairs.any(|(a, b)| barred_mm2(a, b, way) > FREE_MM2)
    }

    fn bodies(&self, unit: usize) -> Vec<&TriMesh> {
        let of = &self.units[unit];
        let parts = of.parts.iter().map(|&part| &self.shell.parts[part].body);
        let panels = self.shell.panels.panels.iter().zip(&self.panels);
        let own = panels.filter(|(panel, _)| of.has_panel && panel.face == of.face);
        parts.chain(own.map(|(_, body)| body)).collect()
    }

    /// Finds ways for strays, and the order in which they are glued on. Each leaves along the
    /// normal of its cell, or square to a plane between polyhedra.
    fn hang(&self, strays: &[usize]) -> Result<(Vec<Unit>, Vec<usize>), CladdingError> {
        let mut units = self.units.clone();
        let mut waiting = strays.to_vec();
        let mut leaving = Vec::new();
        while !waiting.is_empty() {
            let found = waiting.iter().enumerate().find_map(|(at, &unit)| {
                let others = (0..units.len()).filter(|other| {
                    *other != unit && (!strays.contains(other) || waiting.contains(other))
                });
                let others: Vec<usize> = others.collect();
                let away = self.sides.plan.sides(units[unit].polyhedron);
                let away = away.iter().map(|plane| -plane.normal);
                let mut ways = [units[unit].way].into_iter().chain(away);
                let free = ways.find(|way| !others.iter().any(|&o| self.bars(o, unit, way)));
                free.map(|way| (at, way))
            });
            let Some((at, way)) = found else {
                return Err(self.knot_of(waiting, strays).error());
            };
            let unit = waiting.remove(at);
            units[unit].way = way;
            leaving.push(unit);
        }
        leaving.reverse();
        Ok((units, leaving))
    }

    /// Returns the knot of strays that find no way past all the other units.
    fn knot_of(&self, waiting: Vec<usize>, strays: &[usize]) -> Knot<'_> {
        let ways = self.units.iter().map(|unit| {
            let away = self.sides.plan.sides(unit.polyhedron).into_iter();
            let away = away.map(|plane| -plane.normal);
            [unit.way].into_iter().chain(away).collect()
        });
        let standing = (0..self.units.len()).filter(|unit| !strays.contains(unit));
        Knot {
            parts: &self.shell.parts,
            units: &self.units,
            bodies: (0..self.units.len())
                .map(|unit| self.bodies(unit))
                .collect(),
            ways: ways.collect(),
            waiting,
            standing: standing.collect(),
        }
    }
}
