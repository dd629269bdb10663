//! Plane geometry of outlines, by the judge's own hand.

/// Returns the edges of a closed ring.
pub fn edges(ring: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(&from, &to)| [from, to])
}

/// Returns the signed area of a ring, mm²; positive if it goes counterclockwise.
pub fn area_mm2(ring: &[[f64; 2]]) -> f64 {
    0.5 * edges(ring)
        .map(|[a, b]| a[0] * b[1] - a[1] * b[0])
        .sum::<f64>()
}

/// Returns the length of a ring, mm.
pub fn length_mm(ring: &[[f64; 2]]) -> f64 {
    edges(ring).map(|[a, b]| apart(a, b)).sum()
}

/// Returns the distance of two points, mm.
pub fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Returns the distance of a point from a segment, mm.
fn to_edge(at: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let from = [at[0] - a[0], at[1] - a[1]];
    let squared = along[0] * along[0] + along[1] * along[1];
    let share = if squared > 0.0 {
        ((from[0] * along[0] + from[1] * along[1]) / squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (from[0] - share * along[0]).hypot(from[1] - share * along[1])
}

/// Returns the distance of a point from a ring, mm.
pub fn to_ring(at: [f64; 2], ring: &[[f64; 2]]) -> f64 {
    edges(ring)
        .map(|edge| to_edge(at, edge))
        .fold(f64::INFINITY, f64::min)
}

/// Returns true if a point lies inside a ring, by the number of edges to its right.
pub fn is_inside(at: [f64; 2], ring: &[[f64; 2]]) -> bool {
    let crossings = edges(ring).filter(|[a, b]| {
        let spans = (a[1] > at[1]) != (b[1] > at[1]);
        spans && at[0] < a[0] + (at[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
    });
    crossings.count() % 2 == 1
}

/// Returns the least distance of two rings that do not cross, mm; 0 if one lies in the other.
pub fn between(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let is_in = |ring: &[[f64; 2]], other| ring.first().is_some_and(|&at| is_inside(at, other));
    if is_in(a, b) || is_in(b, a) {
        return 0.0;
    }
    let reach = |from: &[[f64; 2]], to: &[[f64; 2]]| {
        from.iter()
            .map(|&at| to_ring(at, to))
            .fold(f64::INFINITY, f64::min)
    };
    reach(a, b).min(reach(b, a))
}

/// Returns a point of a panel on its sheet: seen from inside, turned about the origin and moved.
pub fn placed([x, y]: [f64; 2], turn_rad: f64, at: [f64; 2]) -> [f64; 2] {
    let (sine, cosine) = turn_rad.sin_cos();
    [
        -x * cosine - y * sine + at[0],
        -x * sine + y * cosine + at[1],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

    #[test]
    fn a_square_has_its_area_and_its_distances() {
        assert_eq!((area_mm2(&SQUARE), length_mm(&SQUARE)), (100.0, 40.0));
        assert!(is_inside([5.0, 5.0], &SQUARE) && !is_inside([15.0, 5.0], &SQUARE));
        assert_eq!(to_ring([13.0, 14.0], &SQUARE), 5.0);
        let beside = SQUARE.map(|at| placed(at, std::f64::consts::FRAC_PI_2, [23.0, 0.0]));
        assert!((between(&SQUARE, &beside) - 3.0).abs() < 1e-12);
        let within = SQUARE.map(|[x, y]| [0.2 * x + 2.0, 0.2 * y + 2.0]);
        assert_eq!(between(&SQUARE, &within), 0.0);
    }
}
