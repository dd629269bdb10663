//! The whole shell of a base, from the model to cups with bores and the order of assembly.

use rayon::prelude::*;

use super::cups::{Cup, CupRequest, ShellStyle};
use super::divide::Scene;
use super::error::CladdingError;
use super::part::Part;
use super::part_pins::{PartPins, PinRequest, socket_keep};
use super::rod_bore::RodBore;
use super::rooms::Room;
use super::screws::{PartScrews, ScrewKit, ScrewRequest};
use super::units::Assembly;
use crate::base::watch::Watch;
use crate::cut::PinSite;
use crate::geom::Vector;
use crate::mesh::Csg;
use crate::panels::PanelSet;
use crate::shell::Keep;

/// The order for a shell.
#[derive(Debug, Clone, Copy)]
pub struct ShellRequest<'a> {
    /// The wall of the parts, mm.
    pub wall_mm: f64,
    /// The style of the parts.
    pub style: ShellStyle,
    /// The largest piece without a panel that may grow on a part of another cell, mm³.
    pub crumb_mm3: f64,
    /// The printer's room, mm; `None` for any size.
    pub room_mm: Option<[f64; 3]>,
    /// The screws and inserts; `None` for parts that are glued.
    pub kit: Option<&'a ScrewKit>,
    /// The pins between parts; `None` for parts that are only glued to one another.
    pub pins: Option<PinRequest<'a>>,
    /// The direction up of the object as it stands. The unit at the bottom closes it.
    pub up: Vector,
}

/// The shell of a base.
#[derive(Debug, Clone, PartialEq)]
pub struct CladShell {
    /// The parts, solid.
    pub parts: Vec<Part>,
    /// The same parts as they are printed, in their order: hollow, with bores.
    pub cups: Vec<Cup>,
    /// The screws.
    pub screws: Vec<PartScrews>,
    /// The pins between parts.
    pub pins: Vec<PartPins>,
    /// The volume of all bores, mm³.
    pub bores_mm3: f64,
    /// The panels with the holes for the screws.
    pub panels: PanelSet,
    /// The units and their order.
    pub assembly: Assembly,
}

impl Scene<'_> {
    /// Makes the shell around the panels of the base.
    ///
    /// # Errors
    /// As those of [`Scene::divide`], [`Scene::fit`], [`Scene::cup`] and [`Scene::assembly`].
    pub fn clad(
        &self,
        panels: &PanelSet,
        request: &ShellRequest,
        watch: &Watch,
    ) -> Result<CladShell, CladdingError> {
        let bare = self.clad_bare(panels, request, watch)?;
        let units = self.blocked(&bare.parts, &bare.pins);
        let assembly = self.ordered(&bare.parts, units, &request.up)?;
        Ok(CladShell { assembly, ..bare })
    }

    /// Makes the shell without units.
    pub(super) fn clad_bare(
        &self,
        panels: &PanelSet,
        request: &ShellRequest,
        watch: &Watch,
    ) -> Result<CladShell, CladdingError> {
        let wall_mm = request.wall_mm;
        if !(wall_mm > 0.0 && wall_mm.is_finite()) {
            return Err(CladdingError::NotPositive {
                name: "the wall",
                value_mm: wall_mm,
            });
        }
        let mut parts = self.divide(request.crumb_mm3, watch)?;
        if let Some(size_mm) = request.room_mm {
            parts = self.fit(parts, &Room { size_mm, wall_mm }, watch)?;
        }
        let screws = request.kit.map_or_else(Vec::new, |kit| {
            let order = ScrewRequest {
                panels,
                kit,
                wall_mm,
            };
            self.screws(&parts, &order)
        });
        let pins = self.pins(&parts, &screws, request)?;
        let cups = (0..parts.len()).into_par_iter().map(|index| {
            let own = Fastened {
                screws: screws.iter().find(|screws| screws.part == index),
                pegs: PartPins::on(&pins, index, 0),
                sockets: PartPins::on(&pins, index, 1),
                rods: self.rods_over(parts[index].face).collect(),
            };
            self.finished(&parts[index], &own, request, watch)
        });
        let cups: Vec<(Cup, f64)> = cups.collect::<Result<_, CladdingError>>()?;
        let (cups, bores): (Vec<Cup>, Vec<f64>) = cups.into_iter().unzip();
        let mut panels = panels.clone();
        if let Some(kit) = request.kit {
            for screws in &screws {
                panels.panels[screws.panel].holes.extend(screws.holes(kit));
            }
        }
        Ok(CladShell {
            bores_mm3: bores.iter().sum(),
            parts,
            cups,
            screws,
            pins,
            panels,
            assembly: Assembly::default(),
        })
    }

    /// Hollows a part, bores it for its screws and rods, and gives it its pins and sockets. Returns
    /// it with the volume of its bores, mm³.
    fn finished(
        &self,
        part: &Part,
        fastened: &Fastened,
        request: &ShellRequest,
        watch: &Watch,
    ) -> Result<(Cup, f64), CladdingError> {
        let own = fastened.screws.zip(request.kit);
        let mut cup = match request.style {
            ShellStyle::Solid => Cup::solid(part),
            ShellStyle::Cups => {
                let below_mm = 3.0 * request.wall_mm;
                let keeps = own.map_or_else(Vec::new, |(screws, kit)| screws.keeps(kit, below_mm));
                let rods = fastened.rods.iter().map(|rod| rod.keep(request.wall_mm));
                let keeps = [keeps, fastened.socket_keeps(request), rods.collect()].concat();
                let order = CupRequest {
                    wall_mm: request.wall_mm,
                    keeps: &keeps,
                };
                self.cup(part, &order, watch)?
            }
        };
        let whole_mm3 = cup.body.signed_volume_mm3();
        let screwed = own.map_or_else(Vec::new, |(screws, kit)| screws.bores(kit));
        let spanned = fastened.rods.iter().map(|rod| rod.body());
        for bore in screwed.into_iter().chain(spanned) {
            watch.check()?;
            let bored = Csg::of_mesh(&cup.body)?.subtract(&Csg::of_mesh(&bore)?)?;
            cup.body = bored.to_mesh()?;
        }
        let bores_mm3 = whole_mm3 - cup.body.signed_volume_mm3();
        watch.check()?;
        fastened.pin(&mut cup)?;
        Ok((cup, bores_mm3))
    }
}

/// The pieces that fasten a part.
struct Fastened<'a> {
    screws: Option<&'a PartScrews>,
    /// The pins that stand on it, and those whose sockets it has.
    pegs: Vec<&'a PinSite>,
    sockets: Vec<&'a PinSite>,
    /// The bores of rods that pass it.
    rods: Vec<&'a RodBore>,
}

impl Fastened<'_> {
    /// Returns the material about sockets that stays solid.
    fn socket_keeps(&self, request: &ShellRequest) -> Vec<Keep> {
        let wall_mm = request.pins.map_or(0.0, |pins| pins.plan.wall_mm);
        let keep = |site: &&PinSite| socket_keep(site, wall_mm);
        self.sockets.iter().map(keep).collect()
    }

    /// Adds the pins of a part, and takes its sockets away.
    fn pin(&self, cup: &mut Cup) -> Result<(), CladdingError> {
        if self.pegs.is_empty() && self.sockets.is_empty() {
            return Ok(());
        }
        let bare_mm3 = cup.body.signed_volume_mm3();
        let mut body = Csg::of_mesh(&cup.body)?;
        for peg in &self.pegs {
            body = body.union(&Csg::of_mesh(&peg.pin_body())?)?;
        }
        // A mesh that only went through the engine differs by rounding: what is not there is zero.
        let pinned_mm3 = match self.pegs.is_empty() {
            true => bare_mm3,
            false => body.to_mesh()?.signed_volume_mm3(),
        };
        for socket in &self.sockets {
            body = body.subtract(&Csg::of_mesh(&socket.socket_body())?)?;
        }
        cup.body = body.to_mesh()?;
        let taken_mm3 = match self.sockets.is_empty() {
            true => 0.0,
            false => pinned_mm3 - cup.body.signed_volume_mm3(),
        };
        cup.pins_mm3 = [pinned_mm3 - bare_mm3, taken_mm3];
        Ok(())
    }
}
