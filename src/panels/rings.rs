//! Places, edges and convex rings in the plane. A ring is a list of corners, counterclockwise.

/// Returns a point turned about the origin, counterclockwise.
pub(super) fn turned([x, y]: [f64; 2], by_rad: f64) -> [f64; 2] {
    let (sin, cos) = by_rad.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

/// Returns the place at x along an edge and at y to its left, mm.
pub(super) fn along([from, to]: [[f64; 2]; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = way[0].hypot(way[1]);
    let way = way.map(|mm| mm / length);
    [
        from[0] + x * way[0] - y * way[1],
        from[1] + x * way[1] + y * way[0],
    ]
}

/// Returns the least and the greatest coordinates of a ring, mm.
pub(super) fn bounds(ring: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    ring.iter().fold(start, |[low, high], at| {
        [
            [low[0].min(at[0]), low[1].min(at[1])],
            [high[0].max(at[0]), high[1].max(at[1])],
        ]
    })
}

/// Returns the edges of a ring in their order.
pub(super) fn edges(ring: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| [*a, *b])
}

/// Returns the area of a ring, mm²; less than zero if it goes clockwise.
pub(super) fn area_mm2(ring: &[[f64; 2]]) -> f64 {
    0.5 * edges(ring)
        .map(|[a, b]| a[0] * b[1] - a[1] * b[0])
        .sum::<f64>()
}

/// Returns a convex ring with every edge moved outward by a distance, mm.
pub(super) fn grown(ring: &[[f64; 2]], by_mm: f64) -> Vec<[f64; 2]> {
    let moved: Vec<[[f64; 2]; 2]> = edges(ring)
        .map(|[a, b]| {
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            let length = x.hypot(y);
            let out = [y / length * by_mm, -x / length * by_mm];
            [[a[0] + out[0], a[1] + out[1]], [x, y]]
        })
        .collect();
    let count = moved.len();
    let corner = |k: usize| {
        let ([p, u], [q, v]) = (moved[(k + count - 1) % count], moved[k]);
        let across = u[0] * v[1] - u[1] * v[0];
        let share = ((q[0] - p[0]) * v[1] - (q[1] - p[1]) * v[0]) / across;
        [p[0] + share * u[0], p[1] + share * u[1]]
    };
    (0..count).map(corner).collect()
}

/// Returns the no-fit polygon of two convex rings: the places of the moving one's origin at which
/// it touches the fixed one. Inside they overlap.
pub(super) fn no_fit_polygon(fixed: &[[f64; 2]], moving: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let turned: Vec<[f64; 2]> = moving.iter().map(|[x, y]| [-x, -y]).collect();
    let start = |ring: &[[f64; 2]]| {
        let lowest = (0..ring.len()).min_by(|&i, &j| {
            ring[i][1]
                .total_cmp(&ring[j][1])
                .then(ring[i][0].total_cmp(&ring[j][0]))
        });
        lowest.unwrap_or(0)
    };
    let (a, b) = (start(fixed), start(&turned));
    let [mut i, mut j] = [0; 2];
    let mut ring = Vec::with_capacity(fixed.len() + turned.len());
    let at = |ring: &[[f64; 2]], k: usize| ring[k % ring.len()];
    while i < fixed.len() || j < turned.len() {
        let ([p, p_next], [q, q_next]) = (
            [at(fixed, a + i), at(fixed, a + i + 1)],
            [at(&turned, b + j), at(&turned, b + j + 1)],
        );
        ring.push([p[0] + q[0], p[1] + q[1]]);
        let (u, v) = (
            [p_next[0] - p[0], p_next[1] - p[1]],
            [q_next[0] - q[0], q_next[1] - q[1]],
        );
        let across = u[0] * v[1] - u[1] * v[0];
        let takes_first = j == turned.len() || (i < fixed.len() && across >= 0.0);
        let takes_second = i == fixed.len() || (j < turned.len() && across <= 0.0);
        i += usize::from(takes_first);
        j += usize::from(takes_second);
    }
    ring
}

/// Returns how deep a point is inside a convex ring, mm; less than zero outside.
pub(super) fn depth_mm(ring: &[[f64; 2]], at: &[f64; 2]) -> f64 {
    let inward = edges(ring).filter_map(|[a, b]| {
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        let length = x.hypot(y);
        (length > 0.0).then(|| (x * (at[1] - a[1]) - y * (at[0] - a[0])) / length)
    });
    inward.fold(f64::INFINITY, f64::min)
}

/// Returns the points in which the edges of two rings cross.
pub(super) fn crossings(a: &[[f64; 2]], b: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    for [p, p_next] in edges(a) {
        for [q, q_next] in edges(b) {
            let (u, v) = (
                [p_next[0] - p[0], p_next[1] - p[1]],
                [q_next[0] - q[0], q_next[1] - q[1]],
            );
            let across = u[0] * v[1] - u[1] * v[0];
            if across == 0.0 {
                continue;
            }
            let way = [q[0] - p[0], q[1] - p[1]];
            let along_a = (way[0] * v[1] - way[1] * v[0]) / across;
            let along_b = (way[0] * u[1] - way[1] * u[0]) / across;
            if (0.0..=1.0).contains(&along_a) && (0.0..=1.0).contains(&along_b) {
                found.push([p[0] + along_a * u[0], p[1] + along_a * u[1]]);
            }
        }
    }
    found
}
