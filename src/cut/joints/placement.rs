//! The pins of a joint, as they are seen along their axes.

use crate::{
    cut::{
        geometry::{
            chart::{Chart, Point2},
            tree::CutTree,
        },
        joints::{
            pattern::{Peg, fits, fits_itself},
            pin_shape::PinSite,
        },
        request::PlanRequest,
    },
    geom::{Plane, Point, Vector},
    mesh::TriMesh,
};

/// What a joint is asked to be fitted into.
pub(crate) struct PinScene<'a> {
    pub(crate) request: &'a PlanRequest,
    pub(crate) tree: &'a CutTree,
    /// The surface of the material before it is cut.
    pub(crate) material: &'a TriMesh,
}

/// The pins of one joint.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placement {
    pub(crate) sites: Vec<PinSite>,
    pub(crate) pegs: Vec<Peg>,
    /// Whether only one way of putting the parts together fits.
    pub(crate) is_one_way: bool,
    /// The diameter of the largest disc of material in the joint, mm.
    pub(crate) widest_mm: f64,
}

/// The way that pins in a joint may stand, and what is in theirs.
#[derive(Clone, Copy)]
pub(crate) struct Facing<'a> {
    /// The pins of other joints, which they must keep off.
    pub(crate) others: &'a [&'a Placement],
    /// Whether they stand out along the plane's normal, not against it.
    pub(crate) is_upward: bool,
}

impl Placement {
    /// Whether at least two pins let the parts together one way only.
    pub(crate) fn is_sound(&self) -> bool {
        self.sites.len() >= 2 && self.is_one_way
    }
}

/// Whether the pattern fits itself in a second way, or another joint, or another joint fits it.
pub(crate) fn is_confused(pattern: &[Peg], placed: &[&Placement]) -> bool {
    let apart = || placed.iter().filter(|placement| placement.pegs.len() >= 2);
    let is_dowelled =
        |placement: &Placement| placement.sites.iter().all(|site| site.dowel.is_some());
    // Either side of a dowelled joint has sockets, and shows the pattern as a mirror does.
    let mirrored: Vec<Vec<Peg>> = apart()
        .filter(|p| is_dowelled(p))
        .map(|p| turned_over(&p.pegs))
        .collect();
    let mut others = apart().map(|placement| &placement.pegs).chain(&mirrored);
    fits_itself(pattern) || others.any(|other| fits(pattern, other) || fits(other, pattern))
}

fn turned_over(pegs: &[Peg]) -> Vec<Peg> {
    pegs.iter()
        .map(|peg| Peg {
            at: Point2::new(peg.at.x, -peg.at.y),
            ..*peg
        })
        .collect()
}

/// A pin's end view, looking along it: from below the plane left and right are swapped.
pub(crate) fn peg(plane: &Plane, pin: &PinSite) -> Peg {
    let sign = plane.normal.dot(&Vector::from(pin.direction)).signum();
    let at = Chart::of_plane(plane).flat(&Point::from(pin.center_mm));
    let at = Point2::new(at.x, at.y * sign);
    Peg {
        at,
        pin_mm: pin.diameter_mm,
        socket_mm: pin.socket_diameter_mm,
    }
}
