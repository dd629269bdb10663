//! The brief of a run: the model, the shop that prints it, and the goal placed in the model.

use std::sync::Arc;

use super::{AxisChoice, Nested, Policy};
use crate::ballast::Load;
use crate::comb::InnerCells;
use crate::cut::{Hollowed, Rod};
use crate::geom::Vector;
use crate::goal::{Footing, Goal, Hardware, Placement, Request};
use crate::hardware::Fitted;
use crate::hollow::Fill;
use crate::job::{CutMode, Job};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{Solid, TriMesh};
use crate::printer::{Material, Printer, Quantity, WallChoice};
use crate::repair::Repairs;
use crate::thin::Thickened;

/// A model that bounds one solid body, in mm.
#[derive(Debug, Clone)]
pub struct Model {
    /// The body, without hardware.
    pub solid: Solid,
    /// The repairs that were needed.
    pub repairs: Repairs,
    /// The thickening of thin features; `None` if none was asked for, or nothing was thin.
    pub thickened: Option<Thickened>,
    /// SHA-256 of the file.
    pub sha256: String,
    /// Factor from the file's numbers to mm.
    pub scale_ratio: f64,
}

/// The printer with its material, and lengths that it can print.
#[derive(Debug, Clone)]
pub struct Shop {
    /// The printer.
    pub printer: Printer,
    /// Its material.
    pub material: Material,
    /// The wall that is printed.
    pub wall: WallChoice,
    /// Pitch of the finest columns along x and y, mm.
    pub pitch_mm: [f64; 2],
    /// The rods that dowels are cut from; empty if pins are printed.
    pub rods: Vec<Rod>,
}

/// The cells of an inside.
#[derive(Debug, Clone)]
pub struct Inside {
    /// All of them.
    pub cells: InnerCells,
    /// Those that stay solid whatever is emptied, model frame. They do not touch each other.
    pub solid: TriMesh,
}

/// A goal in its model, ready to be solved: waterline and hardware are settled.
#[derive(Debug, Clone)]
pub struct Placed {
    /// The job, bound to the bytes of its model.
    pub job: Job,
    /// The model.
    pub model: Model,
    /// The printer, material and wall.
    pub shop: Shop,
    /// The job's goal with its axis decided.
    pub request: Request,
    /// The choice of the axis, `None` if the job names it.
    pub choice: Option<AxisChoice>,
    /// The goal in the model; its moments count the hardware.
    pub placement: Placement,
    /// The hardware and the solid with its sockets, `None` without hardware.
    pub fitted: Option<Fitted>,
    /// The filling of the voids.
    pub fill: Fill,
    /// The infill that takes the place of voids; `None` for a hollow print.
    pub sparse: Option<Nested>,
    /// The cells that take the place of voids; `None` for an inside without them.
    pub cells: Option<Arc<Inside>>,
    /// The limits of the search for cuts and pins.
    pub policy: Policy,
}

impl Placed {
    /// Returns the solid that is hollowed: the model, with its sockets and with halves apart.
    pub fn solid(&self) -> &Solid {
        self.fitted
            .as_ref()
            .map_or(&self.model.solid, |fitted| &fitted.solid)
    }

    /// Returns the placed goal.
    pub fn goal(&self) -> &Goal {
        &self.placement.goal
    }

    /// Returns the hardware that goes in: what was ordered, and the tip that was chosen.
    pub fn hardware(&self) -> Hardware {
        let tip = self.placement.footing.as_ref().and_then(Footing::tip);
        self.request.hardware_with(tip)
    }

    /// Returns whether hardware was ordered, besides a tip that is left to the run.
    pub fn has_ordered_hardware(&self) -> bool {
        let tip = self.request.ordered_tip().rod();
        !self.request.hardware_with(tip).is_empty()
    }

    /// Returns the density of the printed material, g/cm³.
    pub fn density_g_cm3(&self) -> f64 {
        self.shop.material.density_g_cm3.value
    }

    /// Returns the least wall that the printer makes of a model of this size, mm.
    pub fn minimum_wall_mm(&self) -> f64 {
        let size_mm = self.solid().mesh().longest_side_mm();
        self.shop.printer.least_wall_mm(size_mm).value
    }

    /// Returns the largest step at the rim of a seam, mm; `None` if the profile names none.
    pub fn seam_step_mm(&self) -> Option<f64> {
        let step = self.shop.printer.number(Quantity::SeamStepMm);
        step.map(|step| step.value)
    }

    /// Returns the moments of the hardware in volumes of the printed material, model frame; zero
    /// without hardware.
    pub fn hardware_moments(&self) -> Moments {
        let density_g_cm3 = self.density_g_cm3();
        self.fitted
            .as_ref()
            .map_or(Moments::default(), |fitted| fitted.moments(density_g_cm3))
    }

    /// Returns the direction that points up in the vat, model frame, for which an inside of cells
    /// is made; `None` for other prints.
    pub fn printed_up(&self) -> Option<Vector> {
        let down = self.cells.as_ref()?.cells.sizes.down?;
        Some(-down)
    }

    /// Returns the moments of what is put into the print, model frame: ballast, hardware and the
    /// filling of the voids. With them goes what a slicer lays beyond the written parts. The
    /// regions of infill inside of the voids are `inner`, as [`Voids::inner`](super::Voids::inner).
    pub fn moments_inside(&self, load: &Load, hollowed: &Hollowed, inner: &[TriMesh]) -> Moments {
        let voids = hollowed.voids.iter();
        let voids = voids.map(|void| moments_of_mesh(void.mesh()));
        let volume = voids.fold(Moments::default(), |sum, void| sum + void);
        let filled = match &self.sparse {
            Some(nested) => {
                let inner = inner.iter().map(moments_of_mesh);
                nested.laid(std::iter::once(volume).chain(inner))
            }
            // The walls between cells are part of the written body, and what they leave is air.
            None if self.cells.is_some() => Moments::default(),
            None => volume * self.fill.density_ratio(),
        };
        load.moments() + self.hardware_moments() + filled + self.laid_beyond()
    }

    /// Returns the moments of what a slicer lays beyond the written parts, model frame; zero if it
    /// was not asked.
    pub fn laid_beyond(&self) -> Moments {
        let last = self.job.sliced.last();
        last.map_or(Moments::default(), |round| Moments(round.beyond))
    }

    /// Returns the goal as it is solved, and as its cuts are planned.
    ///
    /// What a slicer lays on hollow parts is made up for when they are written. So cuts and pins
    /// stay where they were when it was weighed. One piece is solved anew.
    #[must_use]
    pub fn as_planned(&self) -> Self {
        let mut planned = self.clone();
        if self.sparse.is_none() {
            planned.job.sliced.clear();
        }
        planned
    }

    /// Returns the body as its surface is printed. Regions of sparse infill are no voids of it.
    pub fn printed(&self, hollowed: &Hollowed) -> Hollowed {
        match self.sparse {
            Some(_) => hollowed.without_empty_voids(),
            None => hollowed.clone(),
        }
    }

    /// Returns whether it stays in one uncut piece, whose voids need drain holes.
    pub fn is_drained(&self) -> bool {
        let job = &self.job;
        job.cut == CutMode::Never && job.plan.is_none() && self.sparse.is_none()
    }

    /// Returns whether regions of infill keep what is too small to print on its own: those of a
    /// match and of a field.
    pub fn keeps_small_regions(&self) -> bool {
        let is_field = |nested: &Nested| nested.field.is_some();
        self.goal().wanted.is_some() || self.sparse.as_ref().is_some_and(is_field)
    }

    /// Returns the gap between the halves of a yo-yo, mm, `None` for one body.
    pub fn string_gap_mm(&self) -> Option<f64> {
        let gap_mm = self.fitted.as_ref().map(|fitted| fitted.gap_mm);
        gap_mm.filter(|gap_mm| *gap_mm > 0.0)
    }

    /// Returns the name of the job in file names: the model's file name without its ending.
    pub fn name(&self) -> String {
        self.job.name()
    }

    /// Returns whether a person ordered the pins.
    pub fn has_ordered_pins(&self) -> bool {
        let order = self.job.plan.as_ref();
        order.is_some_and(|order| order.pins.is_some())
    }
}
