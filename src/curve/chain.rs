//! Chains of helices.

use super::helix::{Helix, roll};
use crate::geom::{Frame, Point};

/// Pieces of helices of one length, each joined to the one before with a turn about the common
/// tangent.
///
/// The cumulative torsion of the chain jumps by the turn, so a turn has the sign of the torsion.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The frame at the start: point, and tangent, normal and binormal as columns.
    pub start: Frame,
    /// Length of each piece, mm.
    pub piece_mm: f64,
    /// The helix of each piece.
    pub pieces: Vec<Helix>,
    /// The turn before each piece but the first, rad.
    pub turns_rad: Vec<f64>,
}

impl Chain {
    /// Returns the length, mm.
    pub fn length_mm(&self) -> f64 {
        self.piece_mm * self.pieces.len() as f64
    }

    /// Returns the frame at the start of each piece.
    pub fn starts(&self) -> Vec<Frame> {
        let mut frame = self.start;
        let mut starts = Vec::with_capacity(self.pieces.len());
        for (i, piece) in self.pieces.iter().enumerate() {
            if let Some(turn) = i.checked_sub(1).and_then(|joint| self.turns_rad.get(joint)) {
                frame = frame.frame_to_model(&roll(*turn));
            }
            starts.push(frame);
            frame = frame.frame_to_model(&piece.frame_at(self.piece_mm));
        }
        starts
    }

    /// Returns points at equal arc lengths, mm: `per_piece` steps for each piece, and both ends.
    pub fn samples(&self, per_piece: usize) -> Vec<Point> {
        let step = self.piece_mm / per_piece.max(1) as f64;
        let starts = self.starts();
        let pieces = self.pieces.iter().zip(&starts);
        let points = pieces.flat_map(|(piece, start)| {
            let at = move |i| start.to_model(&piece.frame_at(step * i as f64).origin);
            (1..=per_piece).map(at)
        });
        [self.start.origin].into_iter().chain(points).collect()
    }

    /// Returns the chain with each piece cut in two, of the same shape.
    #[must_use]
    pub fn halved(&self) -> Self {
        let pieces = self.pieces.iter().flat_map(|piece| [*piece, *piece]);
        let joints = self.turns_rad.iter().flat_map(|turn| [*turn, 0.0]);
        Self {
            start: self.start,
            piece_mm: 0.5 * self.piece_mm,
            pieces: pieces.collect(),
            turns_rad: [0.0].into_iter().chain(joints).collect(),
        }
    }

    /// Returns the chain moved as a whole: by `motion` after it lies where it lies.
    #[must_use]
    pub fn moved(&self, motion: &Frame) -> Self {
        Self {
            start: motion.frame_to_model(&self.start),
            ..self.clone()
        }
    }

    /// Returns the greatest misfit of neighbours that must nest, mm: what the shapes of the inner
    /// and the outer one differ by over a length.
    ///
    /// It is about hypot(|Δκ| l²/2, κ |Δτ| l³/6) at each joint, to leading order.
    pub fn nesting_misfit_mm(&self) -> f64 {
        let pairs = self.pieces.windows(2);
        let misfits = pairs.map(|pair| {
            let [bend, twist] = nesting_terms(&pair[0], &pair[1], self.piece_mm);
            bend.hypot(twist)
        });
        misfits.fold(0.0, f64::max)
    }
}

/// Returns the misfit of two neighbours by curvature and by torsion, mm, signed.
pub(super) fn nesting_terms(outer: &Helix, inner: &Helix, length_mm: f64) -> [f64; 2] {
    let curvature = 0.5 * (outer.curvature + inner.curvature);
    let bend = 0.5 * (inner.curvature - outer.curvature) * length_mm.powi(2);
    let twist = curvature * (inner.torsion - outer.torsion) * length_mm.powi(3) / 6.0;
    [bend, twist]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain() -> Chain {
        let piece = |curvature, torsion| Helix { curvature, torsion };
        Chain {
            start: Frame::identity(),
            piece_mm: 40.0,
            pieces: vec![piece(0.02, 0.0), piece(0.025, 0.01), piece(0.01, -0.01)],
            turns_rad: vec![0.7, -1.2],
        }
    }

    #[test]
    fn a_chain_cut_in_halves_has_the_same_points() {
        let (whole, halves) = (chain().samples(8), chain().halved().samples(4));
        assert_eq!(whole.len(), 25);
        let apart = whole.iter().zip(&halves).map(|(a, b)| (a - b).norm());
        assert!(apart.fold(0.0, f64::max) < 1e-12);
    }

    #[test]
    fn the_tangent_goes_on_through_a_joint() {
        let chain = chain();
        let starts = chain.starts();
        let end = starts[0].frame_to_model(&chain.pieces[0].frame_at(40.0));
        assert!((end.origin - starts[1].origin).norm() < 1e-13);
        assert!((end.axes.column(0) - starts[1].axes.column(0)).norm() < 1e-15);
        let turned = end.axes.column(2).dot(&starts[1].axes.column(2));
        assert!((turned - 0.7f64.cos()).abs() < 1e-14);
    }

    #[test]
    fn the_misfit_is_that_of_the_worst_joint() {
        // Joint 1: Δκ 0.005, Δτ 0.01, κ 0.0225; joint 2: Δκ −0.015, Δτ −0.02, κ 0.0175.
        let expected = 12f64.hypot(0.0175 * 0.02 * 64000.0 / 6.0);
        assert!((chain().nesting_misfit_mm() - expected).abs() < 1e-12);
    }
}
