//! Columns for the tests of densities.

use crate::interior::Columns;

/// Returns a leaning block of columns of about 10 × 8 × 5 mm, without mirror symmetry.
pub(super) fn leaning_block(pitch_mm: f64) -> Columns {
    let mut columns = Columns {
        pitch_mm: [pitch_mm; 2],
        starts: vec![0],
        ..Columns::default()
    };
    let [along, across] = [10.0, 8.0].map(|mm: f64| (mm / pitch_mm).round() as i32);
    for j in 0..across {
        for i in 0..along {
            let place = |at: i32| (f64::from(at) + 0.5) * pitch_mm;
            let [x, y] = [place(i) - 4.0, place(j) - 3.0];
            columns.centers.push([x, y]);
            let (floor, roof) = (0.1 * x - 2.0, 3.0 + 0.2 * y + 0.05 * x * x);
            columns.intervals.push([floor, roof]);
            columns.starts.push(columns.intervals.len() as u32);
        }
    }
    columns
}
