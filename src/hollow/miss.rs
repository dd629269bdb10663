//! The miss of a match: how far all densities are from the moments that are wanted.

use super::graded::Graded;
use super::nearest::nearest;
use crate::base::numbers::rough;
use crate::field::DensityRange;
use crate::goal::Goal;
use crate::mass::{Body, Moments};

/// The distance of all densities from a match, and the nearest of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MatchMiss {
    /// The nearest moments, goal frame, mm.
    pub nearest: Moments,
    /// The least and the greatest volume of material, mm³.
    pub volumes_mm3: [f64; 2],
    /// Least distance from the wanted moments, in units of the solid's volume and radius of
    /// gyration; proved, positive.
    pub least_miss: f64,
}

/// The obstacle of a match.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Obstacle {
    /// Even the densest is too light.
    TooHeavy,
    /// Even the lightest is too heavy.
    TooLight,
    /// The mass can be had, but not all together.
    Together,
}

impl MatchMiss {
    /// Measures the miss of wanted moments that no density of the range has.
    pub fn of(graded: &Graded, range: DensityRange) -> Self {
        let found = nearest(graded, range);
        let interior_mm3 = graded.columns.moments().volume();
        let volume = |density: f64| graded.shell.volume() + density * interior_mm3;
        Self {
            nearest: found.moments,
            volumes_mm3: [range.low(), range.high()].map(volume),
            least_miss: found.bound,
        }
    }

    fn obstacle(&self, goal: &Goal) -> Obstacle {
        let wanted = goal.wanted.unwrap_or_default().moments;
        let [least_mm3, greatest_mm3] = self.volumes_mm3;
        match wanted.volume() {
            volume if volume > greatest_mm3 => Obstacle::TooHeavy,
            volume if volume < least_mm3 => Obstacle::TooLight,
            _ => Obstacle::Together,
        }
    }

    /// Returns the reason in sentences, with its numbers.
    pub fn explain(&self, goal: &Goal) -> String {
        let wanted = goal.wanted.unwrap_or_default();
        let density = wanted.density_g_mm3;
        let [least_g, greatest_g] = self.volumes_mm3.map(|mm3| mm3 * density);
        let mass_g = wanted.moments.volume() * density;
        let why = match self.obstacle(goal) {
            Obstacle::TooHeavy => format!(
                "it is to weigh {mass_g:.2} g, and at its densest it weighs {greatest_g:.2} g"
            ),
            Obstacle::TooLight => format!(
                "it is to weigh {mass_g:.2} g, and at its lightest it weighs {least_g:.2} g"
            ),
            Obstacle::Together => {
                "no infill of these densities has the wanted mass, centre and inertia together"
                    .to_owned()
            }
        };
        let then = Body::new(&wanted.moments, density);
        let now = Body::new(&self.nearest, density);
        let off = (now.inertia_g_mm2 - then.inertia_g_mm2).amax();
        let too_much_g = now.mass_g - mass_g;
        let word = if too_much_g < 0.0 { "light" } else { "heavy" };
        let percent = |ratio: f64| rough(100.0 * ratio, "%");
        format!(
            "Impossible: {why}. The nearest is {} too {word}, its centre of mass {} off. Its \
             moments of inertia are up to {} off, {} of their sum. It is proved that all miss by \
             {} or more, in mass, centre and inertia together.",
            rough(too_much_g.abs(), "g"),
            rough((now.center - then.center).norm(), "mm"),
            rough(off, "g·mm²"),
            percent(off / then.inertia_g_mm2.trace()),
            percent(self.least_miss),
        )
        // Non-breaking blanks are for pages.
        .replace('\u{a0}', " ")
    }

    /// Returns changes that may make the match possible.
    pub fn remedies(&self, goal: &Goal) -> &'static [&'static str] {
        match self.obstacle(goal) {
            Obstacle::TooHeavy => &[
                "use a denser material",
                "make the model larger, if only its handling counts",
            ],
            Obstacle::TooLight => &[
                "use a lighter material, or a printer with thinner walls",
                "make the model smaller, if only its handling counts",
            ],
            Obstacle::Together => &[
                "use a denser material, which leaves more room for the infill to vary",
                "compare the mass, centre and inertia with those of the model: are they of the \
                 same size and in the same axes?",
            ],
        }
    }
}
