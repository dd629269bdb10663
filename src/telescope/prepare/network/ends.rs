//! The ends of a limb where they are when all is out.

use crate::geom::Frame;
use crate::telescope::nest::Telescope;

/// Returns the frame of the last shell when all is out, and that of its mouth.
pub fn last(telescope: &Telescope) -> (Frame, Frame) {
    let frames = telescope.frames(&telescope.open());
    let frame = frames.last().copied().unwrap_or(telescope.start);
    let helix = &telescope.shells[telescope.shells.len() - 1].helix;
    let mouth = frame.frame_to_model(&helix.frame_at(telescope.ends_mm()[1]));
    (frame, mouth)
}

/// Returns the frame at an arc of the root, in the model's frame.
pub fn on_root(telescope: &Telescope, arc_mm: f64) -> Frame {
    telescope
        .start
        .frame_to_model(&telescope.shells[0].helix.frame_at(arc_mm))
}

/// Returns the frames at the root's mouth and at the last mouth, all out.
pub fn mouths(telescope: &Telescope) -> [Frame; 2] {
    let [_, mouth_mm] = telescope.ends_mm();
    [on_root(telescope, mouth_mm), last(telescope).1]
}
