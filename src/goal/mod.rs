//! What the object shall do: a request in words becomes a goal with a frame, a support and figures
//! of merit.
//!
//! [`place`] turns a [`Request`] and a solid into a [`Goal`]: the frame in which every later
//! formula holds (origin at the contact, the spin point or the support plane; z along the spin axis
//! or up). [`figures`] then says what a body of given moments does in that frame, and is the same
//! for the solid, the hollowed result and the assembled parts.

mod balance;
mod figures;
mod float;
mod hardware;
mod place;
mod request;
mod resting;
mod sites;
mod stand;
mod support;
mod top;
mod yoyo;

use serde::{Deserialize, Serialize};

use crate::geom::Frame;
use crate::mass::Moments;
use crate::shell::Keep;

pub use balance::{Rotor, Spindle};
pub(crate) use figures::to_rpm;
pub use figures::{Figures, figures};
pub use float::{Afloat, Hydrostatics, Liquid, Water, Waterline};
pub use hardware::{Hardware, HardwareError, Rod, STEEL_G_CM3};
pub use place::{GoalError, Stock, Weighed, place, place_made_of, place_weighed};
pub use request::{GoalKind, Objective, Request, RequestError};
pub use resting::{Resting, resting};
pub use sites::{Contact, SpinPoint, Up};
pub(crate) use support::edges as support_edges;
pub(crate) use top::height_over_origin;

/// What the object shall do, placed in the model.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// What the object shall do.
    pub kind: GoalKind,
    /// The origin (contact, spin point, or the support's centroid) and z (spin axis, up) in model
    /// coordinates.
    pub frame: Frame,
    /// What "best" means; suits the kind.
    pub objective: Objective,
    /// Stand: the convex support polygon, counterclockwise, goal frame, mm; empty for the others.
    pub support: Vec<[f64; 2]>,
    /// Balance: how the rotor runs and where it ends; none for the others.
    pub spindle: Option<Spindle>,
    /// Float: what a body must be to float upright at the waterline; none for the others.
    pub afloat: Option<Afloat>,
    /// The moments of the whole solid in the goal frame, mm.
    pub solid: Moments,
}

/// A goal, what must stay solid for it, and what the user should know.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// The goal.
    pub goal: Goal,
    /// What must stay solid besides the wall, model coordinates.
    pub keeps: Vec<Keep>,
    /// What was found that does not stop the run.
    pub warnings: Vec<Warning>,
}

/// Something about the placement that the user should know.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Warning {
    /// The contact point hangs below the surface.
    #[error(
        "the contact point is in the air: the model begins {missing_mm:.3} mm above it, so that as printed it cannot spin there; put in a \
         tip piece (--tip=DIAMETERxLENGTH), or give another --contact"
    )]
    ContactInAir {
        /// From the contact up along the axis to the surface, mm.
        missing_mm: f64,
    },
    /// A top that stands still on what should be its tip: its centre of mass is lower than the
    /// contact's radius of curvature.
    #[error(
        "it stands still on its foot without spinning, and rights itself when tilted by {rights_to_deg:.0}°: its contact moves as \
         that of a ball of {radius_mm:.0} mm radius, and its centre of mass is only {center_height_mm:.1} mm up; it spins upright as \
         promised, but rubs, and does not fall when it is slow; for a top that falls put in a tip piece (--tip=DIAMETERxLENGTH)"
    )]
    FlatFoot {
        /// The radius of curvature of the contact over a tilt of a degree, mm.
        radius_mm: f64,
        /// The height of the centre of mass, mm.
        center_height_mm: f64,
        /// It rights itself up to this tilt, degrees.
        rights_to_deg: f64,
    },
    /// The spin axis does not pass through the model above the contact.
    #[error(
        "the spin axis passes through no part of the model above the contact point; give another contact"
    )]
    AxisMissesModel,
    /// A part of the model lies lower than the contact.
    #[error(
        "the model reaches {depth_mm:.3} mm below the contact point and will touch a flat floor first"
    )]
    BelowContact {
        /// How far the lowest point lies below the contact, mm.
        depth_mm: f64,
    },
}

/// Small solids the goal tests share.
#[cfg(test)]
pub(crate) mod testing {
    use crate::geom::Point;
    use crate::mesh::{Solid, TriMesh};

    /// The solid whose faces are these convex polygons, wound outward.
    fn of_faces(vertices: &[[f64; 3]], faces: &[&[u32]]) -> Solid {
        let triangles = faces
            .iter()
            .flat_map(|face| face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]));
        let vertices = vertices.iter().map(|v| Point::from(*v)).collect();
        Solid::new(TriMesh::new(vertices, triangles.collect()).unwrap()).unwrap()
    }

    /// The prism over a counterclockwise polygon of the xz plane seen against y, from y = 0 to
    /// `depth`.
    fn prism(polygon: &[[f64; 2]], caps: &[&[u32]], depth: f64) -> Solid {
        let n = polygon.len() as u32;
        let at = |y: f64| polygon.iter().map(move |p| [p[0], y, p[1]]);
        let vertices: Vec<[f64; 3]> = at(0.0).chain(at(depth)).collect();
        let mut faces: Vec<Vec<u32>> = caps.iter().map(|cap| cap.to_vec()).collect();
        faces.extend(
            caps.iter()
                .map(|cap| cap.iter().rev().map(|v| v + n).collect()),
        );
        faces.extend((0..n).map(|i| vec![i, i + n, (i + 1) % n + n, (i + 1) % n]));
        of_faces(
            &vertices,
            &faces.iter().map(Vec::as_slice).collect::<Vec<_>>(),
        )
    }

    /// The axis-aligned block between two corners.
    pub fn block(min: [f64; 3], max: [f64; 3]) -> Solid {
        let corner = |i: usize| {
            [0, 1, 2].map(|axis| {
                if i >> axis & 1 == 0 {
                    min[axis]
                } else {
                    max[axis]
                }
            })
        };
        let vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
        of_faces(
            &vertices,
            &[
                &[0, 2, 3, 1],
                &[4, 5, 7, 6],
                &[0, 1, 5, 4],
                &[2, 6, 7, 3],
                &[0, 4, 6, 2],
                &[1, 3, 7, 5],
            ],
        )
    }

    /// A plate from z = 6 to 8 on two legs of 2 mm, 10 mm wide and 4 deep.
    pub fn arch() -> Solid {
        let outline = [
            [0., 0.],
            [2., 0.],
            [2., 6.],
            [8., 6.],
            [8., 0.],
            [10., 0.],
            [10., 8.],
            [0., 8.],
        ];
        prism(
            &outline,
            &[&[0, 1, 2, 7], &[2, 3, 6, 7], &[3, 4, 5, 6]],
            4.0,
        )
    }

    /// The unit octahedron: it stands on a tip.
    pub fn octahedron() -> Solid {
        let vertices = [
            [1., 0., 0.],
            [-1., 0., 0.],
            [0., 1., 0.],
            [0., -1., 0.],
            [0., 0., 1.],
            [0., 0., -1.],
        ];
        let up: [&[u32]; 4] = [&[0, 2, 4], &[2, 1, 4], &[1, 3, 4], &[3, 0, 4]];
        let down: [&[u32]; 4] = [&[2, 0, 5], &[1, 2, 5], &[3, 1, 5], &[0, 3, 5]];
        of_faces(&vertices, &[up, down].concat())
    }
}
