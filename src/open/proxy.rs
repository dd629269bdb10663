//! A coarse copy of the body, on which plans are compared.
//!
//! Cutting, looking and solving take time in proportion to triangles and columns. A copy with a
//! tenth of them tells plans apart as well: they differ by per cents, and the copy by less.

use super::resolve::Resolver;
use crate::base::watch::{Phase, Watch};
use crate::cut::KeepClear;
use crate::error::Error;
use crate::mesh::Solid;
use crate::run::{Placed, Policy, Solved};
use crate::voids::{Cavity, VoidError, coarsen};

/// Distance by which surfaces of the copy may stray, in walls. With less, the copy saves little;
/// with more, pins and openings that the copy has room for fail in the body.
const STRAY_WALLS: f64 = 0.1;

/// A coarse copy of a body with its goal.
pub struct Proxy {
    placed: Placed,
    solved: Solved,
    cavity: Cavity,
}

impl Proxy {
    /// Copies the body. The goal's moments stay those of the body itself; the solution is that on
    /// coarser columns.
    pub fn new(whole: &Resolver, coarse: Solved) -> Result<Self, Error> {
        let (placed, watch) = (whole.placed(), whole.watch());
        let stray_mm = STRAY_WALLS * placed.shop.wall.wall_mm;
        let mesh = coarsen(placed.solid().mesh(), stray_mm, watch)?;
        let solid = Solid::new(mesh).map_err(VoidError::from)?;
        let mut copy = placed.clone();
        copy.shop.pitch_mm = coarse.columns.pitch_mm;
        // The copy weighs a little less or more. To correct for that would move the voids.
        copy.policy = Policy {
            correction_rounds: 0,
            ..placed.policy
        };
        let grown = |ball: &KeepClear| KeepClear {
            radius_mm: ball.radius_mm + stray_mm,
            ..*ball
        };
        copy.job.keep_clear = placed.job.keep_clear.iter().map(grown).collect();
        match &mut copy.fitted {
            Some(fitted) => fitted.solid = solid,
            None => copy.model.solid = solid,
        }
        Ok(Self {
            placed: copy,
            solved: coarse,
            cavity: whole.coarse_cavity(stray_mm)?,
        })
    }

    /// Returns a resolver for the copy.
    pub fn resolver(&self, watch: &Watch) -> Result<Resolver<'_>, Error> {
        Resolver::of_cavity(
            &self.placed,
            self.solved.clone(),
            self.cavity.clone(),
            watch,
        )
    }
}

/// The body, and a coarse copy of it.
pub struct Bodies<'a> {
    /// The resolver of the body itself.
    pub whole: Resolver<'a>,
    copy: Proxy,
}

impl<'a> Bodies<'a> {
    /// Draws the region that may be emptied, and copies the body.
    pub fn new(placed: &'a Placed, mut solved: Solved, watch: &Watch) -> Result<Self, Error> {
        watch.enter(Phase::Shell);
        let coarse = solved.coarse.take();
        let whole = Resolver::new(placed, solved, watch)?;
        let coarse = coarse.map_or_else(|| whole.solved().clone(), |coarse| *coarse);
        let copy = Proxy::new(&whole, coarse)?;
        Ok(Self { whole, copy })
    }

    /// Returns the resolver of the copy.
    pub fn copy(&self) -> Result<Resolver<'_>, Error> {
        self.copy.resolver(self.whole.watch())
    }
}
