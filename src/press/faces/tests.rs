//! Sections at the cuts of a plan.

use super::*;
use crate::geom::Vector;
use crate::mesh::primitives;

#[test]
fn a_cut_is_looked_at_on_either_side_of_one_that_ends_there() {
    let body = primitives::cuboid(
        &Point::new(-10.0, -10.0, -10.0),
        &Point::new(10.0, 10.0, 10.0),
    );
    let across = Parting::everywhere(Plane {
        normal: Vector::x(),
        offset_mm: 0.0,
    });
    let ending = Parting {
        plane: Plane {
            normal: Vector::y(),
            offset_mm: 4.0,
        },
        within: vec![(across.plane, true)],
    };
    let partings = [across, ending];
    let widths = |index: usize| -> Vec<f64> {
        let found = sections(&body, &partings[index], &partings).unwrap();
        let discs = found.iter().flat_map(Section::largest_discs);
        discs.map(|(_, diameter_mm)| diameter_mm.round()).collect()
    };
    assert_eq!(widths(0), [6.0, 14.0]);
    assert_eq!(
        widths(1),
        [10.0],
        "nothing ends at the one that ends itself"
    );
}
