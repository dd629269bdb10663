//! Rings of points in a plane: the outlines of a section, counter-clockwise, and its holes.

/// Returns the two ends of the shortest segment from an outer ring to a hole; `None` without holes.
/// Each end is a corner of one or the nearest point on a side of the other.
pub fn thinnest(rings: &[Vec<[f64; 2]>]) -> Option<[[f64; 2]; 2]> {
    let (outer, holes): (Vec<_>, Vec<_>) = rings.iter().partition(|ring| is_outer(ring));
    let pairs = outer
        .iter()
        .flat_map(|ring| holes.iter().map(move |hole| (ring, hole)));
    let gaps = pairs
        .flat_map(|(ring, hole)| [nearest(ring, hole), nearest(hole, ring)])
        .flatten();
    gaps.min_by(|a, b| length(a).total_cmp(&length(b)))
}

/// Returns true if a ring runs counter-clockwise, as the outlines of material do.
fn is_outer(ring: &[[f64; 2]]) -> bool {
    sides(ring)
        .map(|([ax, ay], [bx, by])| ax * by - ay * bx)
        .sum::<f64>()
        > 0.0
}

fn sides(ring: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
    ring.iter()
        .zip(ring.iter().cycle().skip(1))
        .map(|(a, b)| (*a, *b))
}

/// Returns the corner of one ring that is nearest to a side of another, and its foot there.
fn nearest(corners: &[[f64; 2]], ring: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
    let gaps = corners
        .iter()
        .flat_map(|corner| sides(ring).map(move |side| [*corner, foot(*corner, side)]));
    gaps.min_by(|a, b| length(a).total_cmp(&length(b)))
}

/// Returns the point of a side that is nearest to a point.
fn foot([x, y]: [f64; 2], (a, b): ([f64; 2], [f64; 2])) -> [f64; 2] {
    let along = [b[0] - a[0], b[1] - a[1]];
    let squared = along[0] * along[0] + along[1] * along[1];
    let share = ((x - a[0]) * along[0] + (y - a[1]) * along[1]) / squared.max(f64::MIN_POSITIVE);
    let share = share.clamp(0.0, 1.0);
    [a[0] + share * along[0], a[1] + share * along[1]]
}

fn length([a, b]: &[[f64; 2]; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_thinnest_wall_of_a_square_frame_is_at_the_side_the_hole_is_pushed_to() {
        let outer = vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
        let hole = vec![[1.5, 3.0], [1.5, 7.0], [6.0, 7.0], [6.0, 3.0]];
        let ends = thinnest(&[outer.clone(), hole]).unwrap();
        assert_eq!(length(&ends), 1.5);
        assert!(ends.iter().any(|end| end[0] == 0.0) && ends.iter().any(|end| end[0] == 1.5));
        assert_eq!(thinnest(&[outer]), None);
    }
}
