//! The parts of a unit as they lie on the bench, drawn off each other along their pins.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use super::made::Made;
use crate::cladding::{BoundKind, Part};
use crate::geom::{Frame, Plane, Point, Vector};
use crate::mass::Lump;
use crate::mesh::{TriMesh, primitives};
use crate::verify::UnitPromise;

/// Distance between parts on the bench, in lengths of the longest pin: pins stand free of sockets.
const APART_LENGTHS: f64 = 4.0;
/// Sides of a drawn disc.
const SIDES: u32 = 48;

/// Returns the way of each part of the shell off the first part of its unit, mm. Parts that
/// neither a cut nor a pin parts from others of their unit stay.
pub fn bench_shifts(made: &Made, units: &[UnitPromise]) -> Vec<Vector> {
    let shell = &made.built.shell;
    let unit_of = |part: usize| {
        let name = &made.names.parts[part];
        units.iter().position(|unit| unit.parts.contains(name))
    };
    let pieces = shell.parts.iter().enumerate();
    let pieces = pieces.map(|(index, part)| Piece::of(part, unit_of(index)));
    let pieces: Vec<Piece> = pieces.collect();
    let joints = shell.pins.iter().filter(|joint| {
        let [on, into] = joint.parts.map(|part| pieces[part].unit);
        on == into
    });
    let ways = joints.filter_map(|joint| {
        let first = joint.sites.first()?;
        Some((joint.parts, Vector::from(first.direction)))
    });
    let ways: Vec<([usize; 2], Vector)> = ways.collect();
    let lengths = shell.pins.iter().flat_map(|joint| &joint.sites);
    let longest_mm = lengths.map(|site| site.length_mm).fold(0.0, f64::max);
    drawn_apart(&pieces, &ways)
        .into_iter()
        .map(|way| way * (APART_LENGTHS * longest_mm))
        .collect()
}

/// A part as a piece of the cell from which it was cut.
struct Piece {
    /// The index of its unit.
    unit: Option<usize>,
    /// The index of the face of its cell.
    face: usize,
    /// The way off the middle of its cell: half a step off each of its cuts.
    way: Vector,
}

impl Piece {
    fn of(part: &Part, unit: Option<usize>) -> Self {
        let bounds = part.region.bounds().iter();
        let cuts = bounds.filter(|bound| bound.kind == BoundKind::Cut);
        let cuts: Vec<Plane> = cuts.map(|bound| bound.plane).collect();
        Self {
            unit,
            face: part.face,
            way: way_off(&cuts),
        }
    }

    /// Returns what pieces that cuts part have in common.
    fn cell(&self) -> (Option<usize>, usize) {
        (self.unit, self.face)
    }
}

/// Returns half a step off each cut, once. The normals of cuts point out of their piece.
fn way_off(cuts: &[Plane]) -> Vector {
    let once = cuts.iter().enumerate();
    let once = once.filter(|(index, cut)| !cuts[..*index].contains(cut));
    once.fold(Vector::zeros(), |way, (_, cut)| way - cut.normal * 0.5)
}

/// Returns the way of each piece off the first of its unit.
///
/// Both sides of every cut of a cell go apart by a step, each side as one. So pieces lie apart
/// however the cuts meet. A cell with a limb of another goes along the pins of the limb.
fn drawn_apart(pieces: &[Piece], joints: &[([usize; 2], Vector)]) -> Vec<Vector> {
    let mut cells = BTreeMap::new();
    for first in pieces {
        if cells.contains_key(&first.cell()) {
            continue;
        }
        cells.insert(first.cell(), -first.way);
        let mut waiting = vec![first.cell()];
        while let Some(here) = waiting.pop() {
            let from = cells[&here];
            for ([on, into], way) in joints {
                let [on, into] = [&pieces[*on], &pieces[*into]];
                let (near, far, by) = match here {
                    at if at == on.cell() => (on, into, *way),
                    at if at == into.cell() => (into, on, -way),
                    _ => continue,
                };
                if let Entry::Vacant(cell) = cells.entry(far.cell()) {
                    cell.insert(from + near.way + by - far.way);
                    waiting.push(far.cell());
                }
            }
        }
    }
    let placed = pieces.iter().map(|piece| piece.way + cells[&piece.cell()]);
    placed.collect()
}

/// Returns a round piece of ballast as it is drawn: a cylinder of its radius and height.
pub fn disc(lump: &Lump) -> TriMesh {
    let height_mm = 2.0 * lump.shape.half_height_mm();
    let frame = Frame::with_axis(Point::from(lump.center_mm), &Vector::from(lump.axis));
    let body = primitives::cylinder(lump.shape.radius_mm(), height_mm, SIDES);
    body.map_vertices(|p| frame.to_model(&(p - Vector::z() * (0.5 * height_mm))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::LumpShape;

    /// Returns a piece of a unit's cell with cuts of these outward normals.
    fn piece([unit, face]: [usize; 2], cuts: &[Vector]) -> Piece {
        let plane = |normal: &Vector| Plane {
            normal: *normal,
            offset_mm: 3.0,
        };
        let cuts: Vec<Plane> = cuts.iter().map(plane).collect();
        Piece {
            unit: Some(unit),
            face,
            way: way_off(&cuts),
        }
    }

    #[test]
    fn four_parts_of_two_cuts_lie_apart_as_a_grid_and_others_stay() {
        let (x, y) = (Vector::x(), Vector::y());
        // 0 and 1 beside each other, 2 and 3 above them; pins of the second row point back.
        let cuts = [[x, y], [-x, y], [x, -y], [-x, -y]];
        let mut pieces: Vec<Piece> = cuts.iter().map(|cuts| piece([0, 0], cuts)).collect();
        pieces.push(piece([1, 1], &[]));
        let joints = [([0, 1], x), ([3, 2], -x), ([0, 2], y), ([1, 3], y)];
        let ways = drawn_apart(&pieces, &joints);
        assert_eq!(ways, [Vector::zeros(), x, y, x + y, Vector::zeros()]);
    }

    #[test]
    fn three_parts_of_cuts_that_meet_in_a_t_lie_apart_from_each_other() {
        let (x, y) = (Vector::x(), Vector::y());
        // The second cut parts only what lies above the first one.
        let pieces = [
            piece([0, 0], &[x]),
            piece([0, 0], &[-x, y]),
            piece([0, 0], &[-x, -y, -y]),
        ];
        let joints = [([0, 1], x), ([0, 2], x), ([1, 2], y)];
        let ways = drawn_apart(&pieces, &joints);
        assert_eq!(ways, [Vector::zeros(), x - y * 0.5, x + y * 0.5]);
        for ([on, into], way) in joints {
            assert!((ways[into] - ways[on]).dot(&way) > 1.0 - 1e-12);
        }
    }

    #[test]
    fn a_limb_of_another_cell_goes_along_its_pins_with_what_carries_it() {
        let (x, z) = (Vector::x(), Vector::z());
        let pieces = [
            piece([0, 0], &[x]),
            piece([0, 0], &[-x]),
            piece([0, 4], &[]),
        ];
        let ways = drawn_apart(&pieces, &[([0, 1], x), ([2, 1], -z)]);
        assert_eq!(ways, [Vector::zeros(), x, x + z]);
    }

    #[test]
    fn a_disc_is_drawn_where_it_lies() {
        let lump = Lump {
            shape: LumpShape::Disc {
                diameter_mm: 50.0,
                thickness_mm: 10.0,
            },
            mass_g: 150.0,
            center_mm: [10.0, 20.0, 30.0],
            axis: [1.0, 0.0, 0.0],
        };
        let bounds = disc(&lump).aabb();
        assert!(
            (bounds.min - Point::new(5.0, -5.0, 5.0)).norm() < 0.2,
            "{bounds:?}"
        );
        assert!(
            (bounds.max - Point::new(15.0, 45.0, 55.0)).norm() < 0.2,
            "{bounds:?}"
        );
    }
}
