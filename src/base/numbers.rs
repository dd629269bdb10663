//! Numbers and quantities as text for people.

/// Digits shown of a number: enough to tell two parts apart on a balance, few enough to read aloud.
const SIGNIFICANT_DIGITS: i32 = 4;

/// Magnitude below which a number is written with a power of ten.
const SMALL: f64 = 1e-3;

/// Returns a number to four digits without trailing zeros: `0.005`, `12.35`, `1234`, `1.5e-7`; `0`
/// for zero of either sign.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if value.abs() < SMALL {
        return format!("{value:.1e}").replace(".0e", "e");
    }
    let decimals = (SIGNIFICANT_DIGITS - 1 - value.abs().log10().floor() as i32).max(0);
    let text = format!("{value:.*}", decimals as usize);
    if decimals == 0 {
        text
    } else {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

/// Returns a number with its unit: `12.35 mm`, `3.251°`, `0.7974`.
pub fn quantity(value: f64, unit: &str) -> String {
    match unit {
        "" => number(value),
        "°" => format!("{}°", number(value)),
        _ => format!("{}\u{a0}{unit}", number(value)),
    }
}

/// Returns a quantity, or a dash for `None`.
pub fn quantity_or_dash(value: Option<f64>, unit: &str) -> String {
    value.map_or_else(|| "—".to_owned(), |value| quantity(value, unit))
}

/// Returns three lengths: `100 × 62.3 × 41.07 mm`.
pub fn extent(size_mm: &[f64; 3]) -> String {
    format!("{}\u{a0}mm", size_mm.map(number).join(" × "))
}

/// Returns the coordinates of a point in mm, or of a direction, with values below a thousandth as
/// zero: `(0.1349, 55.76, 0)`.
pub fn coordinates(at: &[f64; 3]) -> String {
    let rounded = |value: f64| {
        if value.abs() < SMALL {
            number(0.0)
        } else {
            number(value)
        }
    };
    format!("({})", at.map(rounded).join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits_and_small_ones_a_power_of_ten() {
        let shown = [
            1234.5, 12.345_67, 0.004_216, 100.0, -0.5, 1.5e-7, -0.0, 123_456.7,
        ]
        .map(number);
        assert_eq!(
            shown,
            [
                "1234", "12.35", "0.004216", "100", "-0.5", "1.5e-7", "0", "123457"
            ]
        );
    }

    #[test]
    fn units_follow_their_number() {
        assert_eq!(quantity(2.5, "mm"), "2.5\u{a0}mm");
        assert_eq!(quantity(2.5, "°"), "2.5°");
        assert_eq!(quantity_or_dash(None, "rpm"), "—");
    }

    #[test]
    fn coordinates_leave_out_what_is_less_than_a_micrometre() {
        assert_eq!(coordinates(&[6.5e-7, -4e-4, 55.764_5]), "(0, 0, 55.76)");
        assert_eq!(coordinates(&[0.0, -1.0, 0.134_91]), "(0, -1, 0.1349)");
    }
}
