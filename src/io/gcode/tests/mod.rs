//! Programs of three families of slicers, and beads whose moments are known.

mod exact;
mod flavors;
mod hostile;
mod packed;

use super::*;
use crate::base::watch::Watch;
use crate::mass::Moments;

/// Reads a program.
fn read(text: impl AsRef<[u8]>) -> Result<Toolpath, GcodeError> {
    read_text(text.as_ref(), &Options::default(), &Watch::silent())
}

/// Asserts that moments agree to a share of their greatest terms about the middle of the plate.
fn assert_close(got: &Moments, want: &Moments, ratio: f64) {
    let volume = want.volume().abs();
    let far_mm = 100.0_f64;
    for (index, (got, want)) in got.0.iter().zip(want.0).enumerate() {
        let scale =
            volume * far_mm.powi([0, 1, 2][usize::from(index > 0) + usize::from(index > 3)]);
        assert!(
            (got - want).abs() <= ratio * scale,
            "moment {index}: {got} {want}"
        );
    }
}
