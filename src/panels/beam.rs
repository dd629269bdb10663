//! The path of the beam's middle, half a kerf outside of the material.

use super::Outline;

/// Greatest distance of the chords of a round corner from its circle, mm.
const CHORD_MM: f64 = 1e-3;
/// Sine of the turn below which a corner is straight.
const STRAIGHT: f64 = 1e-9;

/// A reason why an outline cannot be cut.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BeamError {
    /// A gap or a hole into which the beam does not go.
    #[error("a gap or a hole at {at_mm:.2?} mm is narrower than the cut of {kerf_mm} mm")]
    TooNarrow {
        /// A corner of it, mm.
        at_mm: [f64; 2],
        /// The width of the cut, mm.
        kerf_mm: f64,
    },
}

/// Returns the path of the beam's middle that leaves an outline of this size standing. It is half
/// of the kerf (mm) to its right, where no material is.
///
/// Outer corners are round. In an inner corner the beam goes as near as half a kerf to the corner
/// itself, so that a square finger sits in it.
///
/// # Errors
/// A gap is narrower than the kerf.
pub fn beam_path(outline: &Outline, kerf_mm: f64) -> Result<Outline, BeamError> {
    if kerf_mm <= 0.0 {
        return Ok(outline.clone());
    }
    let radius_mm = 0.5 * kerf_mm;
    let corners = outline.corners();
    let count = corners.len();
    let mut path = Vec::new();
    for index in 0..count {
        let [before, at, after] = [index + count - 1, index, index + 1].map(|i| corners[i % count]);
        let (Some(arrives), Some(leaves)) = (direction(before, at), direction(at, after)) else {
            continue;
        };
        go_round(&mut path, at, [arrives, leaves], radius_mm);
    }
    let narrow = |at_mm: [f64; 2]| BeamError::TooNarrow { at_mm, kerf_mm };
    let path = Outline::new(path).ok_or(narrow(corners[0]))?;
    let is_turned = path.area_mm2().signum() != outline.area_mm2().signum();
    match path.crossing() {
        Some(at_mm) => Err(narrow(at_mm)),
        None if is_turned => Err(narrow(corners[0])),
        None => match missed(outline, &path, radius_mm) {
            Some(at_mm) => Err(narrow(at_mm)),
            None => Ok(path),
        },
    }
}

/// Returns a corner, or the middle of a side, to which the beam comes too near or not near enough.
/// Such a side is shorter than the beam is wide, and lies beside an inner corner.
fn missed(outline: &Outline, path: &Outline, radius_mm: f64) -> Option<[f64; 2]> {
    let middles = outline
        .edges()
        .map(|[a, b]| [0, 1].map(|k| 0.5 * (a[k] + b[k])));
    let mut points = outline.corners().iter().copied().chain(middles);
    points.find(|at| {
        let distances = path.edges().map(|edge| to_edge_mm(*at, edge));
        let nearest_mm = distances.fold(f64::INFINITY, f64::min);
        (nearest_mm - radius_mm).abs() > CHORD_MM
    })
}

/// Returns the distance from a point to a side, mm.
fn to_edge_mm(at: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    let along = ((at[0] - a[0]) * x + (at[1] - a[1]) * y) / (x * x + y * y);
    let along = along.clamp(0.0, 1.0);
    (at[0] - a[0] - along * x).hypot(at[1] - a[1] - along * y)
}

/// Adds the path round a corner between two directions.
fn go_round(path: &mut Vec<[f64; 2]>, at: [f64; 2], [arrives, leaves]: [[f64; 2]; 2], radius: f64) {
    let [from, to] = [arrives, leaves].map(|[x, y]| [y, -x]);
    let sine = arrives[0] * leaves[1] - arrives[1] * leaves[0];
    let cosine = arrives[0] * leaves[0] + arrives[1] * leaves[1];
    let beside = |normal: [f64; 2]| add(at, normal, radius);
    if sine.abs() < STRAIGHT && cosine > 0.0 {
        path.push(beside(from));
    } else if sine > 0.0 {
        let turn = sine.atan2(cosine);
        let step = 2.0 * (1.0 - (CHORD_MM / radius).min(1.0)).acos();
        let steps = (turn / step).ceil().max(1.0) as usize;
        for index in 0..=steps {
            let (sin, cos) = (turn * index as f64 / steps as f64).sin_cos();
            let normal = [from[0] * cos - from[1] * sin, from[0] * sin + from[1] * cos];
            path.push(beside(normal));
        }
    } else {
        // The sides meet here; the relief is nearer to the corner.
        let middle = add(from, to, 1.0);
        let length = middle[0].hypot(middle[1]).max(STRAIGHT);
        let out = [middle[0] / length, middle[1] / length];
        let meeting_mm = radius * 2.0 / length;
        let relief_mm = meeting_mm - radius;
        let meeting = add(at, out, meeting_mm);
        path.push(add(meeting, arrives, -relief_mm));
        path.push(add(at, out, radius));
        path.push(add(meeting, leaves, relief_mm));
    }
}

fn add(at: [f64; 2], way: [f64; 2], by: f64) -> [f64; 2] {
    [at[0] + by * way[0], at[1] + by * way[1]]
}

fn direction(from: [f64; 2], to: [f64; 2]) -> Option<[f64; 2]> {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    let length = x.hypot(y);
    (length > 0.0).then(|| [x / length, y / length])
}

#[cfg(test)]
mod tests {
    use super::*;

    const KERF_MM: f64 = 0.2;

    /// Returns the distance from a point to a line, mm.
    fn distance_mm(line: &Outline, at: [f64; 2]) -> f64 {
        line.edges()
            .map(|edge| to_edge_mm(at, edge))
            .fold(f64::INFINITY, f64::min)
    }

    fn middles(line: &Outline) -> Vec<[f64; 2]> {
        let middle = |[a, b]: [[f64; 2]; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
        line.edges().map(middle).collect()
    }

    fn notched() -> Outline {
        let corners = [
            [0.0, 0.0],
            [40.0, 0.0],
            [40.0, 30.0],
            [25.0, 30.0],
            [25.0, 10.0],
            [15.0, 10.0],
            [15.0, 30.0],
            [0.0, 30.0],
        ];
        Outline::new(corners).unwrap()
    }

    #[test]
    fn the_beam_stays_half_a_kerf_beside_a_square_and_in_a_hole() {
        let square = Outline::rectangle([0.0; 2], [20.0; 2]);
        let path = beam_path(&square, KERF_MM).unwrap();
        for at in path.corners().iter().copied().chain(middles(&path)) {
            let off_mm = distance_mm(&square, at);
            assert!((off_mm - 0.1).abs() < 1.1e-3, "{at:?}: {off_mm}");
        }
        let grown_mm2 = 400.0 + 80.0 * 0.1 + std::f64::consts::PI * 0.01;
        assert!(
            (path.area_mm2() - grown_mm2).abs() < 1e-3,
            "{}",
            path.area_mm2()
        );
        let hole = Outline::new(square.corners().iter().rev().copied()).unwrap();
        let inside = beam_path(&hole, KERF_MM).unwrap();
        let long = inside
            .edges()
            .filter(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1]) > 1.0);
        let sides: Vec<[[f64; 2]; 2]> = long.collect();
        assert_eq!(sides.len(), 4);
        for at in sides.into_iter().flatten() {
            assert!((distance_mm(&square, at) - 0.1).abs() < 1e-9, "{at:?}");
        }
    }

    #[test]
    fn inner_corners_get_a_relief_that_frees_them() {
        let path = beam_path(&notched(), KERF_MM).unwrap();
        // The beam's edge reaches both inner corners, and its middle never comes nearer than half
        // a kerf to the material elsewhere.
        for corner in [[25.0, 10.0], [15.0, 10.0]] {
            let nearest = path
                .corners()
                .iter()
                .map(|at| (at[0] - corner[0]).hypot(at[1] - corner[1]));
            let nearest_mm = nearest.fold(f64::INFINITY, f64::min);
            assert!((nearest_mm - 0.1).abs() < 1e-9, "{nearest_mm}");
        }
        for at in middles(&path) {
            assert!(distance_mm(&notched(), at) > 0.06, "{at:?}");
        }
    }

    #[test]
    fn a_gap_narrower_than_the_cut_is_refused_with_its_place() {
        let mut corners = notched().corners().to_vec();
        for corner in &mut corners[3..5] {
            corner[0] = 15.15;
        }
        let narrow = Outline::new(corners).unwrap();
        let error = beam_path(&narrow, KERF_MM).unwrap_err();
        assert!(
            error
                .to_string()
                .contains("narrower than the cut of 0.2 mm"),
            "{error}"
        );
        let hole = Outline::rectangle([0.0; 2], [0.1, 5.0]);
        let hole = Outline::new(hole.corners().iter().rev().copied()).unwrap();
        assert!(beam_path(&hole, KERF_MM).is_err());
    }

    #[test]
    fn a_side_shorter_than_the_beam_beside_an_inner_corner_is_refused() {
        let stepped = |step: f64| {
            let corners = [
                [0.0, 0.0],
                [40.0, 0.0],
                [40.0, 20.0],
                [20.0, 20.0],
                [20.0, 20.0 + step],
                [0.0, 20.0 + step],
            ];
            beam_path(&Outline::new(corners).unwrap(), KERF_MM)
        };
        assert!(stepped(1.0).is_ok());
        assert!(stepped(0.05).is_err());
    }

    #[test]
    fn without_a_kerf_the_beam_follows_the_outline() {
        assert_eq!(beam_path(&notched(), 0.0).unwrap(), notched());
    }
}
