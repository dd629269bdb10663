//! Pockets in the parts for the heads of bracket screws, which stand out of their panel.

use super::asked::Asked;
use super::error::CoreRunError;
use super::home::home_panel;
use crate::cladding::CladShell;
use crate::cutter::FastenerShape;
use crate::geom::{Frame, Point, Vector};
use crate::mesh::{Csg, TriMesh, primitives};
use crate::panels::Bracket;
use crate::polyhedra::BasePlan;
use crate::verify::BossPromise;

/// Room about a head, mm.
const ROOM_MM: f64 = 0.5;
/// Number of sides of a pocket.
const SIDES: u32 = 32;
/// Distance by which a pocket begins below the floor of its part, mm: within the gap.
const START_MM: f64 = 0.25;

/// A pocket over a panel.
pub struct Pocket {
    /// The index of the panel.
    pub panel: usize,
    /// The point at which it enters the parts.
    foot: Point,
    /// The normal of the panel.
    up: Vector,
    depth_mm: f64,
    diameter_mm: f64,
}

impl Pocket {
    /// Returns it as the bore that it is.
    pub fn promise(&self) -> BossPromise {
        BossPromise {
            foot_mm: self.foot.into(),
            depth_mm: self.depth_mm,
            bore_mm: self.diameter_mm,
        }
    }

    fn body(&self) -> TriMesh {
        let frame = Frame::with_axis(self.foot - self.up * START_MM, &self.up);
        let length_mm = self.depth_mm + START_MM;
        primitives::cylinder(0.5 * self.diameter_mm, length_mm, SIDES)
            .map_vertices(|p| frame.to_model(p))
    }
}

/// Returns the depth of the pockets in the parts, mm; 0 without heads.
pub fn depth_mm(asked: &Asked) -> f64 {
    let FastenerShape::Screw { head_height_mm, .. } = asked.bracket_screw.shape else {
        return 0.0;
    };
    (head_height_mm + ROOM_MM - asked.gap_mm).max(0.0)
}

/// Returns the pockets for the screws of all brackets.
pub fn pockets(
    asked: &Asked,
    plan: &BasePlan,
    shell: &CladShell,
    brackets: &[Bracket],
) -> Vec<Pocket> {
    let FastenerShape::Screw {
        head_diameter_mm, ..
    } = asked.bracket_screw.shape
    else {
        return Vec::new();
    };
    let screws = brackets.iter().flat_map(|bracket| {
        let home = home_panel(plan, shell, bracket);
        let screws = bracket.screws[home.flange].map(|inner| (home.panel, inner));
        screws.into_iter().filter(move |_| home.is_screwed)
    });
    screws
        .map(|(panel, inner)| {
            let up = shell.panels.panels[panel].frame.axis();
            Pocket {
                panel,
                foot: inner + up * (asked.panels.sheet_mm + asked.gap_mm),
                up,
                depth_mm: depth_mm(asked),
                diameter_mm: head_diameter_mm + 2.0 * ROOM_MM,
            }
        })
        .collect()
}

/// Cuts the pockets out of the parts over their panels.
pub fn cut_pockets(shell: &mut CladShell, pockets: &[Pocket]) -> Result<(), CoreRunError> {
    for pocket in pockets {
        let face = shell.panels.panels[pocket.panel].face;
        let body = pocket.body();
        let near = body.aabb();
        for (part, cup) in shell.parts.iter().zip(&mut shell.cups) {
            let own = cup.body.aabb();
            let meets = (0..3).all(|k| own.min[k] < near.max[k] && near.min[k] < own.max[k]);
            if part.face == face && meets {
                let cut = Csg::of_mesh(&cup.body)?.subtract(&Csg::of_mesh(&body)?)?;
                cup.body = cut.to_mesh()?;
            }
        }
    }
    Ok(())
}
