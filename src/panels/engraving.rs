//! Text in strokes, for a laser that engraves lines.

/// Width of a character over its height, and the distance between two.
const WIDTH: f64 = 0.5;
const PITCH: f64 = 0.75;

/// Returns the width of a text, mm.
pub fn width_mm(text: &str, height_mm: f64) -> f64 {
    let gaps = text.chars().count().saturating_sub(1);
    height_mm * (WIDTH + PITCH * gaps as f64)
}

/// Returns the strokes of a text with its lower left corner at a place, mm; each is a line of two
/// or more points. Characters look as on a display of seven strokes; others are left out.
pub fn engraved(text: &str, at_mm: [f64; 2], height_mm: f64) -> Vec<Vec<[f64; 2]>> {
    let characters = text.chars().enumerate();
    let lines = characters.flat_map(|(index, character)| {
        let shift = PITCH * index as f64;
        lines_of(character).iter().map(move |line| {
            let place = |&[x, y]: &[f64; 2]| {
                [
                    at_mm[0] + height_mm * (WIDTH * x + shift),
                    at_mm[1] + height_mm * y,
                ]
            };
            line.iter().map(place).collect()
        })
    });
    lines.collect()
}

/// Returns the lines of a character in a box of one by one, none on top of another.
fn lines_of(character: char) -> &'static [&'static [[f64; 2]]] {
    const LOW: [f64; 2] = [0.0, 0.0];
    const HIGH: [f64; 2] = [0.0, 1.0];
    const MIDDLE: [f64; 2] = [0.0, 0.5];
    const RIGHT_LOW: [f64; 2] = [1.0, 0.0];
    const RIGHT_HIGH: [f64; 2] = [1.0, 1.0];
    const RIGHT_MIDDLE: [f64; 2] = [1.0, 0.5];
    match character {
        '0' => &[&[LOW, HIGH, RIGHT_HIGH, RIGHT_LOW, LOW]],
        '1' => &[&[[0.5, 0.0], [0.5, 1.0]]],
        '2' => &[&[HIGH, RIGHT_HIGH, RIGHT_MIDDLE, MIDDLE, LOW, RIGHT_LOW]],
        '3' => &[&[HIGH, RIGHT_HIGH, RIGHT_LOW, LOW], &[MIDDLE, RIGHT_MIDDLE]],
        '4' => &[&[HIGH, MIDDLE, RIGHT_MIDDLE], &[RIGHT_HIGH, RIGHT_LOW]],
        '5' => &[&[RIGHT_HIGH, HIGH, MIDDLE, RIGHT_MIDDLE, RIGHT_LOW, LOW]],
        '6' => &[&[RIGHT_HIGH, HIGH, LOW, RIGHT_LOW, RIGHT_MIDDLE, MIDDLE]],
        '7' => &[&[HIGH, RIGHT_HIGH, RIGHT_LOW]],
        '8' => &[
            &[LOW, HIGH, RIGHT_HIGH, RIGHT_LOW, LOW],
            &[MIDDLE, RIGHT_MIDDLE],
        ],
        '9' => &[&[LOW, RIGHT_LOW, RIGHT_HIGH, HIGH, MIDDLE, RIGHT_MIDDLE]],
        'A' => &[&[LOW, HIGH, RIGHT_HIGH, RIGHT_LOW], &[MIDDLE, RIGHT_MIDDLE]],
        'B' => &[
            &[
                LOW,
                HIGH,
                [0.8, 1.0],
                [0.8, 0.5],
                RIGHT_MIDDLE,
                RIGHT_LOW,
                LOW,
            ],
            &[MIDDLE, [0.8, 0.5]],
        ],
        'C' => &[&[RIGHT_HIGH, HIGH, LOW, RIGHT_LOW]],
        'D' => &[&[
            LOW,
            HIGH,
            [0.7, 1.0],
            [1.0, 0.7],
            [1.0, 0.3],
            [0.7, 0.0],
            LOW,
        ]],
        '-' => &[&[MIDDLE, RIGHT_MIDDLE]],
        '+' => &[&[MIDDLE, RIGHT_MIDDLE], &[[0.5, 0.25], [0.5, 0.75]]],
        '.' => &[&[[0.4, 0.0], [0.6, 0.0]]],
        _ => &[],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_lie_side_by_side_and_unlike_each_other() {
        let strokes = engraved("90", [10.0, 5.0], 4.0);
        let x = |line: &Vec<[f64; 2]>| line.iter().map(|at| at[0]).fold(0.0, f64::max);
        assert_eq!(strokes.len(), 2);
        assert!(x(&strokes[0]) < strokes[1][0][0], "{strokes:?}");
        let all: Vec<_> = "0123456789ABCD".chars().map(lines_of).collect();
        for (index, one) in all.iter().enumerate() {
            assert!(!one.is_empty() && !all[..index].contains(one), "{index}");
        }
        assert!(engraved("?", [0.0; 2], 4.0).is_empty());
    }
}
