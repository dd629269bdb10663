//! The rules of a plan for its seams.

use std::sync::Arc;

use crate::{
    base::{
        watch::{Cancelled, Watch},
        words::choice,
    },
    cut::seam::{
        clear::KeepClear,
        regions::KeepWhole,
        skin::{SeamLie, Skin},
    },
    geom::{Plane, Vector},
    mesh::TriMesh,
};

choice! {
    /// The kind of seam that the planner prefers.
    SeamStyle, "kind of seam" {
        /// Seams where they are seen least.
        Hidden = "hidden",
        /// Short seams, wherever they are.
        Short = "short",
        /// Level seams only, where they are seen least.
        Level = "level",
    }
}

impl SeamStyle {
    /// Returns true for the usual kind.
    pub fn is_hidden(&self) -> bool {
        *self == Self::Hidden
    }
}

/// The rules for seams on the outside. By default only their length counts.
#[derive(Debug, Clone, Default)]
pub struct Seams {
    /// The balls that no seam enters.
    pub keep_clear: Vec<KeepClear>,
    /// The regions that no cut enters. Parts that they keep too large for the printer stay so.
    pub keep_whole: Vec<KeepWhole>,
    /// Weight of walls that lack sight against seams: what they hold stays solid. If `None`, a plan
    /// that lets every void be cleaned comes first, whatever its seams.
    pub lack_weight: Option<f64>,
    /// Plans that were tried already, where seams are weighed: the planner looks for another one.
    pub tried: Vec<Vec<Plane>>,
    /// Price of seams that a plan must stay below, where seams are weighed, in circles about the
    /// model of average weight. `None` if any will do.
    pub dearest_ratio: Option<f64>,
    /// True if only level cuts are made.
    pub only_level: bool,
    /// The outside, looked at; `None` if only the length of a seam counts.
    pub(crate) skin: Option<Arc<Skin>>,
    /// The outside with dear soles; `None` unless the object rests on its feet.
    pub(crate) spared: Option<Arc<Skin>>,
}

impl Seams {
    /// Looks at the outside of a model that stands with this unit direction up, as far as seams of
    /// this kind need it.
    ///
    /// # Errors
    /// The watch was stopped.
    pub fn look(
        style: SeamStyle,
        outer: &TriMesh,
        up: &Vector,
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let is_looked_at = style != SeamStyle::Short;
        let skin = is_looked_at.then(|| Skin::of(outer, up, watch));
        Ok(Self {
            only_level: style == SeamStyle::Level,
            skin: skin.transpose()?.map(Arc::new),
            ..Self::default()
        })
    }

    /// Returns the same rules for an object that rests on its feet with this unit direction up.
    #[must_use]
    pub fn on_feet(self, up: &Vector) -> Self {
        let spare = |skin: &Arc<Skin>| Arc::new(skin.sparing_feet(up));
        Self {
            spared: self.skin.as_ref().map(spare),
            ..self
        }
    }

    /// Returns the same rules with a dear seam across the sole of a foot, though nobody sees it.
    /// They are the same for an object without feet.
    #[must_use]
    pub fn sparing_feet(&self) -> Self {
        Self {
            skin: self.spared.clone().or_else(|| self.skin.clone()),
            ..self.clone()
        }
    }

    /// Returns true if seams are priced by how much of them is seen.
    #[must_use]
    pub fn are_seen(&self) -> bool {
        self.skin.is_some()
    }

    /// Returns true if seams are weighed against what stays solid.
    #[must_use]
    pub fn are_weighed(&self) -> bool {
        self.lack_weight.is_some()
    }

    /// Returns the same rules with nobody to look: only the length of a seam counts.
    #[must_use]
    pub fn unseen(&self) -> Self {
        Self {
            skin: None,
            spared: None,
            lack_weight: None,
            tried: Vec::new(),
            dearest_ratio: None,
            ..self.clone()
        }
    }

    /// Returns whether an endless plane enters no region that is kept whole.
    pub(crate) fn keeps_whole(&self, plane: &Plane) -> bool {
        let mut regions = self.keep_whole.iter();
        !regions.any(|region| region.is_entered(plane))
    }

    /// Returns whether a cut may lie as this plane does.
    pub(crate) fn allows_lie(&self, plane: &Plane) -> bool {
        let is_level = |skin: &Arc<Skin>| skin.is_level(plane);
        !self.only_level || self.skin.as_ref().is_none_or(is_level)
    }

    /// Returns up in the object's frame; `None` if nobody looks at it.
    pub(crate) fn up(&self) -> Option<Vector> {
        self.skin.as_ref().map(|skin| skin.up())
    }

    /// Returns the lie of a cut in the object's frame; `None` if nobody looked at it.
    pub fn lie(&self, plane: &Plane) -> Option<SeamLie> {
        self.skin.as_ref().map(|skin| skin.lie(plane))
    }
}
