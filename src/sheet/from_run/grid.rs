//! The rows of walls, pins, sockets, cut faces and the solver's pitch as the machine makes them.

use super::facts::Facts;
use crate::cut::PinSite;
use crate::geom::{Point, Vector};
use crate::printer::{Grid, whole_steps};
use crate::run::{Placed, WrittenPart};
use crate::sheet::{Direction, GridRow};

/// Deviation up to which a length counts as a whole number of steps, in steps. Files round to 1e-5
/// mm, and cuts keep about 1e-6 mm off vertices.
const WHOLE_TOLERANCE: f64 = 1e-3;

/// Least z of a unit vector that counts as upright in the printer: within 0.03°.
const UPRIGHT: f64 = 1.0 - 1e-7;

/// The grid of the printer along one direction.
#[derive(Clone, Copy)]
struct Ruler {
    along: Direction,
    steps_of: &'static str,
    step_mm: f64,
}

/// A length as it was ordered and as it is drawn, mm.
struct Length {
    what: String,
    asked_mm: f64,
    drawn_mm: f64,
}

/// Returns all rows, equal ones once.
pub fn grid_rows(facts: &Facts) -> Vec<GridRow> {
    let rulers = rulers(facts.placed);
    let parts = facts.made.parts.iter();
    let faces = parts.clone().flat_map(|part| faces(facts, part, rulers[2]));
    let pegs = parts.flat_map(|part| pegs(facts.placed, part, rulers));
    let mut rows: Vec<GridRow> = Vec::new();
    for row in walls(facts.placed, rulers)
        .chain(pitches(facts.placed, rulers))
        .chain(faces)
        .chain(pegs)
    {
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    rows
}

/// Returns the printer's grids along x, y and z.
fn rulers(placed: &Placed) -> [Ruler; 3] {
    let printer = &placed.shop.printer;
    let steps_of = printer.grid.steps();
    [
        Ruler {
            along: Direction::X,
            steps_of,
            step_mm: printer.pixel_x_mm.value,
        },
        Ruler {
            along: Direction::Y,
            steps_of,
            step_mm: printer.pixel_y_mm.value,
        },
        Ruler {
            along: Direction::Z,
            steps_of: "layers",
            step_mm: printer.layer_mm.value,
        },
    ]
}

impl Ruler {
    /// Returns the row of a length that becomes at least its whole steps.
    fn at_least(&self, length: Length) -> GridRow {
        self.row(whole_steps(length.drawn_mm, self.step_mm).max(0.0), length)
    }

    /// Returns the row of a length that becomes the nearest number of steps.
    fn nearest(&self, length: Length) -> GridRow {
        self.row((length.drawn_mm / self.step_mm).round(), length)
    }

    fn row(
        &self,
        steps: f64,
        Length {
            what,
            asked_mm,
            drawn_mm,
        }: Length,
    ) -> GridRow {
        GridRow {
            what,
            along: self.along,
            asked_mm,
            drawn_mm,
            steps_of: self.steps_of.to_owned(),
            step_mm: self.step_mm,
            steps: steps as u32,
            given_mm: steps * self.step_mm,
            is_whole: (drawn_mm / self.step_mm - steps).abs() <= WHOLE_TOLERANCE,
        }
    }
}

/// Returns the rows of the wall along x, y and z.
fn walls(placed: &Placed, rulers: [Ruler; 3]) -> impl Iterator<Item = GridRow> {
    let size_mm = placed.model.solid.mesh().longest_side_mm();
    let asked_mm = placed
        .shop
        .wall
        .asked_mm
        .unwrap_or(placed.shop.printer.least_wall_mm(size_mm).value);
    let drawn_mm = placed.shop.wall.wall_mm;
    rulers.into_iter().map(move |ruler| {
        ruler.at_least(Length {
            what: "wall".to_owned(),
            asked_mm,
            drawn_mm,
        })
    })
}

/// Returns the rows of the pitch of the solver's columns, if it is at least a pixel.
fn pitches(placed: &Placed, rulers: [Ruler; 3]) -> impl Iterator<Item = GridRow> {
    let asked_mm = placed.job.pitch.map(|pitch| pitch.mm());
    let pitches = placed.shop.pitch_mm.into_iter().zip(rulers);
    let row = move |(drawn_mm, ruler): (f64, Ruler)| {
        let asked_mm = asked_mm.unwrap_or(ruler.step_mm);
        ruler.nearest(Length {
            what: "pitch of the solver".to_owned(),
            asked_mm,
            drawn_mm,
        })
    };
    pitches.map(row).filter(|row| row.steps > 0)
}

/// Returns the rows of the heights of level cut faces over the plate.
fn faces<'a>(
    facts: &'a Facts,
    written: &'a WrittenPart,
    ruler: Ruler,
) -> impl Iterator<Item = GridRow> + 'a {
    let pose = written.evidence().pose;
    let part = &written.part;
    let plan = &facts.made.plan;
    plan.cuts_of(part.id).filter_map(move |cut| {
        let up = (pose.rotation() * Vector::from(cut.normal)).z;
        let height_mm = pose.to_print(&Point::from(cut.point_mm)).z;
        let bounds =
            part.solid.mesh().vertices().iter().filter(|p| {
                (pose.to_print(p).z - height_mm).abs() < WHOLE_TOLERANCE * ruler.step_mm
            });
        let is_level = up.abs() >= UPRIGHT && bounds.count() >= 3;
        let decided = plan
            .moves
            .iter()
            .find(|to| to.cut == cut.id && to.part == part.id);
        let moved_mm = decided.map_or(0.0, |to| to.moved_mm * up);
        let what = format!("cut face {} of {}, height over the plate", cut.id, part.id);
        let length = Length {
            what,
            asked_mm: without_rounding_mm(height_mm - moved_mm),
            drawn_mm: without_rounding_mm(height_mm),
        };
        // A face on the plate has no height.
        (is_level && length.drawn_mm > 0.0).then(|| ruler.nearest(length))
    })
}

/// Returns a height with rounding errors of zero removed.
fn without_rounding_mm(height_mm: f64) -> f64 {
    const ROUNDING_MM: f64 = 1e-6;
    if height_mm.abs() < ROUNDING_MM {
        0.0
    } else {
        height_mm
    }
}

/// Returns the rows of the diameters and lengths of a part's pins and sockets.
fn pegs<'a>(
    placed: &'a Placed,
    written: &'a WrittenPart,
    rulers: [Ruler; 3],
) -> impl Iterator<Item = GridRow> + 'a {
    let pose = written.evidence().pose;
    let is_upright =
        move |pin: &PinSite| (pose.rotation() * Vector::from(pin.direction)).z.abs() >= UPRIGHT;
    let part = &written.part;
    let pins = part
        .pins
        .iter()
        .map(move |pin| (is_upright(pin), pin_lengths(placed, pin)));
    let sockets = part
        .sockets
        .iter()
        .map(move |pin| (is_upright(pin), socket_lengths(placed, pin)));
    let is_of_lines = placed.shop.printer.grid == Grid::Line;
    let pins = pins.flat_map(move |(upright, lengths)| peg_rows(upright, lengths, rulers));
    let sockets = sockets.flat_map(move |(upright, lengths)| {
        // A hole is not made of lines; only its depth is made of layers.
        peg_rows(upright, lengths, rulers)
            .into_iter()
            .filter(move |row| !is_of_lines || row.along == Direction::Z)
    });
    pins.chain(sockets)
}

/// Returns the rows of a peg's diameter and length, along the grid if it stands upright. For a
/// tilted peg they are in the coarser pixels and the layers.
fn peg_rows(
    is_upright: bool,
    [diameter, length]: [Length; 2],
    [x, y, z]: [Ruler; 3],
) -> Vec<GridRow> {
    if !is_upright {
        let coarser = if x.step_mm > y.step_mm { x } else { y };
        let tilted = |ruler: Ruler, length| {
            Ruler {
                along: Direction::Tilted,
                ..ruler
            }
            .nearest(length)
        };
        return vec![tilted(coarser, diameter), tilted(z, length)];
    }
    let again = Length {
        what: diameter.what.clone(),
        ..diameter
    };
    vec![x.nearest(diameter), y.nearest(again), z.nearest(length)]
}

/// Returns a pin's diameter and length, as the profile asks for that diameter and as drawn.
fn pin_lengths(placed: &Placed, pin: &PinSite) -> [Length; 2] {
    let printer = &placed.shop.printer;
    let asked_mm = pin.diameter_mm * printer.pin_length_ratio.value;
    let least_mm = printer.pin_min_diameter_mm.value;
    [
        Length {
            what: "pin, diameter, at least".to_owned(),
            asked_mm: least_mm,
            drawn_mm: pin.diameter_mm,
        },
        Length {
            what: "pin, length".to_owned(),
            asked_mm,
            drawn_mm: pin.length_mm,
        },
    ]
}

/// Returns a socket's diameter and depth, by clearance and extra depth and as drawn.
fn socket_lengths(placed: &Placed, pin: &PinSite) -> [Length; 2] {
    let printer = &placed.shop.printer;
    let asked_mm = pin.diameter_mm + 2.0 * printer.clearance_per_side_mm.value;
    let deep_mm = pin.length_mm + printer.socket_extra_depth_mm.value;
    [
        Length {
            what: "socket, diameter".to_owned(),
            asked_mm,
            drawn_mm: pin.socket_diameter_mm,
        },
        Length {
            what: "socket, depth".to_owned(),
            asked_mm: deep_mm,
            drawn_mm: pin.socket_depth_mm,
        },
    ]
}
