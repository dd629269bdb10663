//! Rows for what the machine makes of walls, pins, sockets, cut faces and the solver's pitch.

use super::facts::Facts;
use crate::cut::PinSite;
use crate::geom::{Point, Vector};
use crate::printer::{Grid, whole_steps};
use crate::run::{Placed, WrittenPart};
use crate::sheet::GridRow;

/// How far from a whole number of steps a length may be and still be one, in steps: files round to
/// 1e-5 mm, and cuts keep some 1e-6 mm off vertices.
const WHOLE_TOLERANCE: f64 = 1e-3;

/// A direction whose z is this much of it stands upright in the printer, within 0.03°.
const UPRIGHT: f64 = 1.0 - 1e-7;

/// A grid of the printer along one direction.
#[derive(Clone, Copy)]
struct Ruler {
    along: &'static str,
    steps_of: &'static str,
    step_mm: f64,
}

/// What is asked for and what is drawn, mm.
struct Length {
    what: String,
    asked_mm: f64,
    drawn_mm: f64,
}

/// Every row, equal ones once.
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

/// The printer's grids along x, y and z.
fn rulers(placed: &Placed) -> [Ruler; 3] {
    let printer = &placed.shop.printer;
    let steps_of = printer.grid.steps();
    [
        Ruler {
            along: "x",
            steps_of,
            step_mm: printer.pixel_x_mm.value,
        },
        Ruler {
            along: "y",
            steps_of,
            step_mm: printer.pixel_y_mm.value,
        },
        Ruler {
            along: "z",
            steps_of: "layers",
            step_mm: printer.layer_mm.value,
        },
    ]
}

impl Ruler {
    /// The row of a length that becomes at least its whole steps.
    fn at_least(&self, length: Length) -> GridRow {
        self.row(whole_steps(length.drawn_mm, self.step_mm).max(0.0), length)
    }

    /// The row of a length that becomes the nearest number of steps.
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
            along: self.along.to_owned(),
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

/// The wall along x, y and z.
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

/// The pitch of the solver's columns, where they stand at whole pixels.
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

/// The heights over the plate at which the level cut faces of a part end.
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
            asked_mm: shown_mm(height_mm - moved_mm),
            drawn_mm: shown_mm(height_mm),
        };
        // What lies on the plate is at no height.
        (is_level && length.drawn_mm > 0.0).then(|| ruler.nearest(length))
    })
}

/// A height without what rounding leaves of zero.
fn shown_mm(height_mm: f64) -> f64 {
    const ROUNDING_MM: f64 = 1e-6;
    if height_mm.abs() < ROUNDING_MM {
        0.0
    } else {
        height_mm
    }
}

/// The diameters and lengths of a part's pins and sockets.
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
        // A hole is not made of lines: only its depth is one of layers.
        peg_rows(upright, lengths, rulers)
            .into_iter()
            .filter(move |row| !is_of_lines || row.along == "z")
    });
    pins.chain(sockets)
}

/// The rows of a peg's diameter and length: along the grid where it stands upright, along none
/// where it lies tilted.
fn peg_rows(
    is_upright: bool,
    [diameter, length]: [Length; 2],
    [x, y, z]: [Ruler; 3],
) -> Vec<GridRow> {
    if !is_upright {
        let coarser = if x.step_mm > y.step_mm { x } else { y };
        let tilted = |ruler: Ruler, length| {
            Ruler {
                along: "tilted",
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

/// A pin's diameter and length: as asked by the profile for that diameter, and as drawn.
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

/// A socket's diameter and depth: as asked by the clearance and the extra depth, and as drawn.
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
