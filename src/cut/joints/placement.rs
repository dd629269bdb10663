//! The pins of a joint, and their view along their axes.

use crate::{
    cut::{
        geometry::{
            chart::{Chart, Point2},
            tree::CutTree,
        },
        joints::{
            hold::Hold,
            pattern::{Peg, fits, fits_itself},
            pin_shape::PinSite,
        },
        request::PlanRequest,
    },
    geom::{Plane, Point, Vector},
    mesh::TriMesh,
};

/// The body and the rules for which pins are placed.
pub(crate) struct PinScene<'a> {
    pub(crate) request: &'a PlanRequest,
    pub(crate) tree: &'a CutTree,
    /// Surface of the material before it is cut.
    pub(crate) material: &'a TriMesh,
}

/// The pins of one joint.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placement {
    pub(crate) sites: Vec<PinSite>,
    pub(crate) pegs: Vec<Peg>,
    /// True if the parts fit together in one way only.
    pub(crate) is_one_way: bool,
    /// Diameter of the largest disc of material in the joint, mm.
    pub(crate) widest_mm: f64,
    /// The hold of the pins on the joint.
    pub(crate) hold: Hold,
}

/// Direction of the pins in a joint, and the pins they must avoid.
#[derive(Clone, Copy)]
pub(crate) struct Facing<'a> {
    /// The pins of other joints, which they must keep off.
    pub(crate) others: &'a [&'a Placement],
    /// True if they protrude along the plane's normal, false if against it.
    pub(crate) is_upward: bool,
}

impl Placement {
    /// Returns true if it has at least two pins that let the parts together one way only, and hold
    /// them well enough.
    pub(crate) fn is_sound(&self) -> bool {
        self.sites.len() >= 2 && self.is_one_way && self.hold.is_enough
    }

    /// Returns its rank among the placements of a joint; more is better.
    pub(crate) fn rank(&self) -> impl Ord {
        (self.is_sound(), self.is_one_way, self.sites.len())
    }
}

/// Returns true if the pattern fits itself in a second way, fits another joint, or another joint
/// fits it.
pub(crate) fn is_confused(pattern: &[Peg], placed: &[&Placement]) -> bool {
    let aligned = || placed.iter().filter(|placement| placement.pegs.len() >= 2);
    let is_dowelled =
        |placement: &Placement| placement.sites.iter().all(|site| site.dowel.is_some());
    // Both sides of a dowelled joint have sockets, and one side shows the pattern mirrored.
    let mirrored: Vec<Vec<Peg>> = aligned()
        .filter(|p| is_dowelled(p))
        .map(|p| mirror_pegs(&p.pegs))
        .collect();
    let mut others = aligned().map(|placement| &placement.pegs).chain(&mirrored);
    fits_itself(pattern) || others.any(|other| fits(pattern, other) || fits(other, pattern))
}

fn mirror_pegs(pegs: &[Peg]) -> Vec<Peg> {
    pegs.iter()
        .map(|peg| Peg {
            at: Point2::new(peg.at.x, -peg.at.y),
            ..*peg
        })
        .collect()
}

/// Returns a pin's end view, looking along it: from below the plane left and right are swapped.
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
