//! Linear programmes in three unknowns, by Seidel's method.
//!
//! R. Seidel, "Small-dimensional linear programming and convex hulls made easy", Discrete and
//! Computational Geometry 6, 1991. The rows are met one after the other. A row that the best point
//! so far breaks becomes an equation, and the programme of one unknown less is solved on it.

/// A row a·x ≤ b.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// The coefficients.
    pub a: [f64; 3],
    /// The right side.
    pub b: f64,
}

/// Coefficients below this count as zero: the unknowns and rows are scaled to about one.
const ZERO: f64 = 1e-12;
/// A row that is broken by less than this counts as kept.
const SLACK: f64 = 1e-11;

/// Returns the point of the box `low` to `high` that maximises `objective`·x under the rows;
/// `None` if no point keeps them.
///
/// Rows are kept to 1e-11; coefficients should be of order one. Expected time is linear in the
/// rows if their order is random.
pub fn maximise(objective: [f64; 3], bounds: [[f64; 3]; 2], rows: &[Row]) -> Option<[f64; 3]> {
    let [low, high] = bounds;
    let programme = Programme {
        unknowns: 3,
        objective,
        low,
        high,
    };
    programme.solve(rows)
}

/// The part of a programme that its rows do not change.
struct Programme {
    /// The number of unknowns; the coefficients of the others are zero.
    unknowns: usize,
    objective: [f64; 3],
    low: [f64; 3],
    high: [f64; 3],
}

impl Programme {
    fn solve(&self, rows: &[Row]) -> Option<[f64; 3]> {
        let Self { objective, .. } = *self;
        if self.unknowns == 1 {
            return solve_line(objective[0], [self.low[0], self.high[0]], rows);
        }
        let mut best = [0.0; 3];
        for k in 0..self.unknowns {
            if self.low[k] > self.high[k] + SLACK {
                return None;
            }
            let corner = if objective[k] < 0.0 {
                self.low
            } else {
                self.high
            };
            best[k] = corner[k];
        }
        for (index, row) in rows.iter().enumerate() {
            if dot(&row.a, &best) > row.b + SLACK {
                best = self.solve_on(row, &rows[..index])?;
            }
        }
        Some(best)
    }

    /// Solves with the row as an equation, under the rows before it.
    fn solve_on(&self, row: &Row, before: &[Row]) -> Option<[f64; 3]> {
        let by_size = |&i: &usize, &j: &usize| row.a[i].abs().total_cmp(&row.a[j].abs());
        let pivot = (0..self.unknowns).max_by(by_size)?;
        if row.a[pivot].abs() < ZERO {
            return None;
        }
        // x_pivot = b/p − Σ (a_k/p) x_k over the other unknowns.
        let share = row.a.map(|a| a / row.a[pivot]);
        let constant = row.b / row.a[pivot];
        let others = move || (0..3).filter(move |&k| k != pivot).enumerate();
        let keep = |numbers: &[f64; 3]| {
            let mut kept = [0.0; 3];
            others().for_each(|(at, k)| kept[at] = numbers[k]);
            kept
        };
        let reduce = |a: &[f64; 3]| keep(&[0, 1, 2].map(|k| a[k] - a[pivot] * share[k]));
        let mut unit = [0.0; 3];
        unit[pivot] = 1.0;
        let bounds = [
            Row {
                a: unit,
                b: self.high[pivot],
            },
            Row {
                a: unit.map(|x: f64| -x),
                b: -self.low[pivot],
            },
        ];
        let rows = bounds.iter().chain(before).map(|other| Row {
            a: reduce(&other.a),
            b: other.b - other.a[pivot] * constant,
        });
        let rows: Vec<Row> = rows.collect();
        let smaller = Self {
            unknowns: self.unknowns - 1,
            objective: reduce(&self.objective),
            low: keep(&self.low),
            high: keep(&self.high),
        };
        let found = smaller.solve(&rows)?;
        let mut best = [0.0; 3];
        others().for_each(|(at, k)| best[k] = found[at]);
        best[pivot] = constant - dot(&share, &best);
        Some(best)
    }
}

fn solve_line(objective: f64, [mut low, mut high]: [f64; 2], rows: &[Row]) -> Option<[f64; 3]> {
    for row in rows {
        let (a, b) = (row.a[0], row.b);
        if a > ZERO {
            high = high.min(b / a);
        } else if a < -ZERO {
            low = low.max(b / a);
        } else if b < -SLACK {
            return None;
        }
    }
    if low > high + SLACK {
        return None;
    }
    let x = if objective < 0.0 { low } else { high };
    Some([x, 0.0, 0.0])
}

fn dot(a: &[f64; 3], x: &[f64; 3]) -> f64 {
    a[0] * x[0] + a[1] * x[1] + a[2] * x[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    const CUBE: [[f64; 3]; 2] = [[-1.0; 3], [1.0; 3]];

    /// The best corner of all triples of planes, rows and sides of the box alike.
    fn best_of_all_corners(objective: [f64; 3], rows: &[Row]) -> Option<f64> {
        let mut all = rows.to_vec();
        for k in 0..3 {
            let mut a = [0.0; 3];
            a[k] = 1.0;
            all.push(Row { a, b: 1.0 });
            all.push(Row {
                a: a.map(|x: f64| -x),
                b: 1.0,
            });
        }
        let mut best: Option<f64> = None;
        for i in 0..all.len() {
            for j in 0..i {
                for k in 0..j {
                    let [p, q, r] = [i, j, k].map(|at| &all[at]);
                    let matrix = crate::geom::Matrix::from_row_slice(&[p.a, q.a, r.a].concat());
                    let Some(inverse) = matrix.try_inverse() else {
                        continue;
                    };
                    let x = inverse * crate::geom::Vector::new(p.b, q.b, r.b);
                    let at = [x.x, x.y, x.z];
                    if all.iter().all(|row| dot(&row.a, &at) <= row.b + 1e-9) {
                        let value = dot(&objective, &at);
                        best = Some(best.map_or(value, |best| best.max(value)));
                    }
                }
            }
        }
        best
    }

    #[test]
    fn the_optimum_is_that_of_all_corners() {
        let mut random = Random::new(5);
        let mut infeasible = 0;
        for count in 0..400 {
            let mut unit = || [0; 3].map(|_| random.between(-1.0, 1.0));
            let (objective, normals) = (unit(), (0..count % 9).map(|_| unit()));
            let normals: Vec<[f64; 3]> = normals.collect();
            let rows = normals.into_iter().map(|a| Row {
                a,
                b: random.between(-0.4, 0.8),
            });
            let rows: Vec<Row> = rows.collect();
            let found = maximise(objective, CUBE, &rows).map(|x| dot(&objective, &x));
            let best = best_of_all_corners(objective, &rows);
            match (found, best) {
                (Some(found), Some(best)) => assert!((found - best).abs() < 1e-8, "{found} {best}"),
                (None, None) => infeasible += 1,
                answers => panic!("{answers:?} {rows:?}"),
            }
        }
        assert!(infeasible > 10, "{infeasible}");
    }

    #[test]
    fn without_rows_the_best_corner_of_the_box_is_found() {
        assert_eq!(
            maximise([1.0, -1.0, 2.0], CUBE, &[]),
            Some([1.0, -1.0, 1.0])
        );
    }

    #[test]
    fn rows_that_exclude_each_other_have_no_answer() {
        let rows = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]].map(|a| Row { a, b: -0.5 });
        assert_eq!(maximise([0.0, 0.0, 1.0], CUBE, &rows), None);
        let beyond = [Row {
            a: [1.0, 0.0, 0.0],
            b: -2.0,
        }];
        assert_eq!(maximise([0.0, 0.0, 1.0], CUBE, &beyond), None);
    }

    /// The optimum by an interior-point solver for cones, an oracle of another kind.
    fn optimum_of_clarabel(objective: [f64; 3], rows: &[Row]) -> f64 {
        use clarabel::algebra::CscMatrix;
        use clarabel::solver::{
            DefaultSettingsBuilder, DefaultSolver, IPSolver, SupportedConeT::NonnegativeConeT,
        };
        let mut all: Vec<Row> = rows.to_vec();
        for k in 0..3 {
            let unit = [0, 1, 2].map(|j| if j == k { 1.0 } else { 0.0 });
            all.push(Row { a: unit, b: 1.0 });
            all.push(Row {
                a: unit.map(|x| -x),
                b: 1.0,
            });
        }
        let matrix: Vec<[f64; 3]> = all.iter().map(|row| row.a).collect();
        let right: Vec<f64> = all.iter().map(|row| row.b).collect();
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .build()
            .unwrap();
        let mut solver = DefaultSolver::new(
            &CscMatrix::zeros((3, 3)),
            &objective.map(|c| -c),
            &CscMatrix::from(&matrix),
            &right,
            &[NonnegativeConeT(right.len())],
            settings,
        )
        .unwrap();
        solver.solve();
        -solver.solution.obj_val
    }

    #[test]
    fn programmes_of_many_rows_agree_with_an_interior_point_solver() {
        let mut random = Random::new(11);
        for count in [20, 200, 2000] {
            for _ in 0..10 {
                let rows = (0..count).map(|_| Row {
                    a: [0; 3].map(|_| random.between(-1.0, 1.0)),
                    b: random.between(0.05, 1.0),
                });
                let rows: Vec<Row> = rows.collect();
                let objective = [0; 3].map(|_| random.between(-1.0, 1.0));
                let found = dot(&objective, &maximise(objective, CUBE, &rows).unwrap());
                let expected = optimum_of_clarabel(objective, &rows);
                assert!((found - expected).abs() < 1e-6, "{found} {expected}");
            }
        }
    }
}
