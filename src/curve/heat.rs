//! Heat flow over equally spaced values.

/// Returns values after one implicit step of heat flow: (I − h L) x' = x.
///
/// `step` is h in units of the spacing squared. L is the second difference with natural ends, so
/// the sum of the values stays. Solved directly in linear time.
pub fn flow_heat(values: &[f64], step: f64) -> Vec<f64> {
    let count = values.len();
    if count < 2 {
        return values.to_vec();
    }
    let diagonal = |i: usize| {
        let neighbours = if i == 0 || i + 1 == count { 1.0 } else { 2.0 };
        1.0 + step * neighbours
    };
    let (mut above, mut right) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let (mut last_above, mut last_right) = (0.0, 0.0);
    for (i, value) in values.iter().enumerate() {
        let pivot = diagonal(i) + step * last_above;
        last_above = -step / pivot;
        last_right = (value + step * last_right) / pivot;
        above.push(last_above);
        right.push(last_right);
    }
    for i in (0..count - 1).rev() {
        right[i] -= above[i] * right[i + 1];
    }
    right
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_cosine_fades_as_its_eigenvalue_says_and_the_sum_stays() {
        let count = 400;
        let wave = |i: i32| (PI * (f64::from(i) + 0.5) / f64::from(count)).cos();
        let mut values: Vec<f64> = (0..count).map(|i| 1.0 + wave(i)).collect();
        for _ in 0..100 {
            values = flow_heat(&values, 50.0);
        }
        let amplitude = (values[0] - 1.0) / wave(0);
        assert!((amplitude - 0.734952871).abs() < 1e-9, "{amplitude}");
        assert!((values.iter().sum::<f64>() - f64::from(count)).abs() < 1e-9);
    }

    #[test]
    fn nothing_and_a_single_value_do_not_flow() {
        assert!(flow_heat(&[], 3.0).is_empty());
        assert_eq!(flow_heat(&[7.0], 3.0), [7.0]);
    }
}
