//! A line and few jumps fitted to the cumulative torsion of a curve: a LASSO.

/// Sweeps after which the descent gives up: some hundred do for a dozen knots.
const MAX_SWEEPS: usize = 200_000;

/// Change of all unknowns in one sweep at which the descent has converged, rad.
const CONVERGED: f64 = 1e-13;

/// The twist of a curve from its start to a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnSample {
    /// Arc length from the start, mm.
    pub arc_mm: f64,
    /// Cumulative torsion, rad.
    pub turn_rad: f64,
}

/// The line with jumps nearest to the cumulative torsion T: the least
/// ∫ (T − m s − Σ θ [s ≥ p])² ds + α Σ |θ|.
///
/// This is the torsion problem of Yu, Crane and Coros (2017), with one slope m and the price α of a
/// jump. It is convex, and [`Self::optimality_gap`] shows that it is solved.
#[derive(Debug, Clone, PartialEq)]
pub struct StepFit {
    /// The slope m, the constant torsion of the pieces, rad/mm.
    pub slope: f64,
    /// The jump θ at each knot, rad.
    pub jumps_rad: Vec<f64>,
    /// The greatest violation of the conditions of optimality, in units of the price (rad·mm).
    pub optimality_gap: f64,
}

/// The quadratic form of the problem: the slope is unknown 0, the jumps follow.
struct Problem {
    gram: Vec<Vec<f64>>,
    right: Vec<f64>,
    price: f64,
}

impl StepFit {
    /// Fits equally spaced samples with jumps at `knots_mm`, at a price for each rad of jump
    /// (rad·mm).
    pub fn of(samples: &[TurnSample], knots_mm: &[f64], price: f64) -> Self {
        let problem = Problem::new(samples, knots_mm, price);
        let unknowns = problem.descend();
        Self {
            slope: unknowns[0],
            optimality_gap: problem.optimality_gap(&unknowns),
            jumps_rad: unknowns[1..].to_vec(),
        }
    }
}

impl Problem {
    fn new(samples: &[TurnSample], knots_mm: &[f64], price: f64) -> Self {
        let span = match samples {
            [first, .., last] => last.arc_mm - first.arc_mm,
            _ => 0.0,
        };
        let spacing = span / samples.len().saturating_sub(1).max(1) as f64;
        let count = knots_mm.len() + 1;
        let mut gram = vec![vec![0.0; count]; count];
        let mut right = vec![0.0; count];
        for sample in samples {
            let step = |knot: &f64| f64::from(u8::from(sample.arc_mm >= *knot));
            let row: Vec<f64> = [sample.arc_mm]
                .into_iter()
                .chain(knots_mm.iter().map(step))
                .collect();
            for (i, a) in row.iter().enumerate() {
                right[i] += spacing * a * sample.turn_rad;
                for (sum, b) in gram[i].iter_mut().zip(&row) {
                    *sum += spacing * a * b;
                }
            }
        }
        Self { gram, right, price }
    }

    /// Minimises over one unknown after the other until nothing moves.
    fn descend(&self) -> Vec<f64> {
        let count = self.right.len();
        let mut unknowns = vec![0.0; count];
        for _ in 0..MAX_SWEEPS {
            let mut moved = 0.0f64;
            for i in 0..count {
                let next = self.best(i, &unknowns);
                let scale = if i == 0 { self.gram[0][0].sqrt() } else { 1.0 };
                moved = moved.max((next - unknowns[i]).abs() * scale);
                unknowns[i] = next;
            }
            if moved < CONVERGED {
                break;
            }
        }
        unknowns
    }

    /// Returns the best value of one unknown with the others as they are.
    fn best(&self, i: usize, unknowns: &[f64]) -> f64 {
        let own = self.gram[i][i];
        if own <= 0.0 {
            return 0.0;
        }
        let pull = self.pull(i, unknowns) + own * unknowns[i];
        let threshold = if i == 0 { 0.0 } else { 0.5 * self.price };
        (pull.abs() - threshold).max(0.0).copysign(pull) / own
    }

    /// Returns half of the fall of the squares for each unit of an unknown.
    fn pull(&self, i: usize, unknowns: &[f64]) -> f64 {
        let products = self.gram[i].iter().zip(unknowns);
        self.right[i] - products.map(|(g, x)| g * x).sum::<f64>()
    }

    /// Returns by how much the conditions of Karush, Kuhn and Tucker are violated.
    ///
    /// The pull of a jump equals its price. That of a knot without one is at most the price, and
    /// that of the slope is zero.
    fn optimality_gap(&self, unknowns: &[f64]) -> f64 {
        let gap = |i: usize| {
            let pull = 2.0 * self.pull(i, unknowns);
            match (i, unknowns[i]) {
                (0, _) => pull.abs() / self.gram[0][0].sqrt().max(f64::MIN_POSITIVE),
                (_, 0.0) => (pull.abs() - self.price).max(0.0),
                (_, jump) => (pull - self.price.copysign(jump)).abs(),
            }
        };
        (0..unknowns.len()).map(gap).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const KNOTS: [f64; 4] = [60.0, 120.0, 180.0, 240.0];

    /// A slope of 0.01 with jumps 1, −0.5, 0 and π over 300 mm.
    fn staircase() -> Vec<TurnSample> {
        let jumps = [1.0, -0.5, 0.0, PI];
        let sample = |i: u32| {
            let arc_mm = (f64::from(i) + 0.5) * 0.1;
            let past = KNOTS.iter().zip(jumps).filter(|(knot, _)| arc_mm >= **knot);
            TurnSample {
                arc_mm,
                turn_rad: 0.01 * arc_mm + past.map(|(_, jump)| jump).sum::<f64>(),
            }
        };
        (0..3000).map(sample).collect()
    }

    #[test]
    fn the_staircase_is_shrunk_as_the_reference_says() {
        let cases = [
            (1.0, 0.010179, [0.96726, -0.49107, 0.0, 3.10885]),
            (10.0, 0.011786, [0.67262, -0.41071, 0.0, 2.81421]),
        ];
        for (price, slope, jumps) in cases {
            let found = StepFit::of(&staircase(), &KNOTS, price);
            assert!((found.slope - slope).abs() < 1e-6, "{found:?}");
            for (jump, expected) in found.jumps_rad.iter().zip(jumps) {
                assert!((jump - expected).abs() < 1e-4, "{found:?}");
            }
            assert!(found.optimality_gap < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn without_a_price_the_staircase_comes_back_and_with_a_high_one_no_jump() {
        let free = StepFit::of(&staircase(), &KNOTS, 0.0);
        assert!((free.slope - 0.01).abs() < 1e-10);
        assert!((free.jumps_rad[3] - PI).abs() < 1e-9);
        let dear = StepFit::of(&staircase(), &KNOTS, 1e6);
        assert_eq!(dear.jumps_rad, [0.0; 4]);
        assert!(dear.optimality_gap < 1e-9);
    }

    #[test]
    fn nothing_to_fit_gives_nothing() {
        let found = StepFit::of(&[], &[1.0], 1.0);
        assert_eq!((found.slope, found.jumps_rad), (0.0, vec![0.0]));
    }
}
