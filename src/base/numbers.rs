//! Numbers and quantities as text for people.

/// Digits shown of a number: enough to tell two parts apart on a balance, few enough to read aloud.
const SIGNIFICANT_DIGITS: i32 = 4;

/// Magnitude below which a number is written with a power of ten.
const SMALL: f64 = 1e-3;

/// Speed from which tens of turns per minute are reported, rpm: more cannot be set by hand.
const FAST_RPM: f64 = 1000.0;

/// Grams or cubic centimetres below which a hundredth is reported.
const LIGHT: f64 = 10.0;

/// Most decimals of a small quantity that is measured.
const MOST_DECIMALS: usize = 4;

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

/// Returns a quantity rounded to what a shop measures. That is a tenth of a millimetre, degree or
/// gram, a hundredth of a gram below ten, a whole turn per minute. From a thousand turns on it is
/// ten turns. It is never rounded to zero.
pub fn measured(value: f64, unit: &str) -> String {
    let value = match unit {
        "rpm" if value.abs() >= FAST_RPM => 10.0 * (value / 10.0).round(),
        _ => value,
    };
    let wanted = match unit {
        "rpm" | "mm²" | "mm³" | "s" => 0,
        "g" | "cm³" | "g·mm" if value.abs() < LIGHT => 2,
        "mm" | "°" | "g" | "g·mm" | "cm²" | "cm³" | "%" => 1,
        _ => return quantity(value, unit),
    };
    let is_shown = |decimals: &usize| (value * 10f64.powi(*decimals as i32)).abs() >= 0.5;
    let decimals = (wanted..=MOST_DECIMALS).find(is_shown);
    let text = format!("{value:.*}", decimals.unwrap_or(wanted));
    let text = match text.split_once('.') {
        Some((whole, rest)) if rest.bytes().all(|digit| digit == b'0') => whole.to_owned(),
        _ => text,
    };
    match unit {
        "°" => format!("{text}°"),
        _ => format!("{text}\u{a0}{unit}"),
    }
}

/// Returns a quantity to two digits: enough to compare it with another.
pub fn rough(value: f64, unit: &str) -> String {
    if value == 0.0 {
        return quantity(value, unit);
    }
    let digits = 1 - value.abs().log10().floor() as i32;
    let unit_of_last = 10f64.powi(-digits);
    quantity((value / unit_of_last).round() * unit_of_last, unit)
}

/// Returns three lengths as a shop measures them: `100 × 62.3 × 41.1 mm`.
pub fn measured_extent(size_mm: &[f64; 3]) -> String {
    let sides = size_mm.map(|mm| measured(mm, "mm").replace("\u{a0}mm", ""));
    format!("{}\u{a0}mm", sides.join(" × "))
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
    fn rough_quantities_have_two_digits_and_fast_speeds_whole_tens() {
        let shown = [0.001_234, 0.0891, 2706.0, 17.08, 0.0].map(|value| rough(value, ""));
        assert_eq!(shown, ["0.0012", "0.089", "2700", "17", "0"]);
        assert_eq!(measured(2437.0, "rpm"), "2440\u{a0}rpm");
        assert_eq!(measured(0.1004, "g·mm"), "0.10\u{a0}g·mm");
    }

    #[test]
    fn units_follow_their_number() {
        assert_eq!(quantity(2.5, "mm"), "2.5\u{a0}mm");
        assert_eq!(quantity(2.5, "°"), "2.5°");
        assert_eq!(quantity_or_dash(None, "rpm"), "—");
    }

    #[test]
    fn measured_quantities_have_the_digits_of_the_tool_and_are_never_nothing() {
        let shown = [
            measured(9.856, "°"),
            measured(256.6, "rpm"),
            measured(34.37, "g"),
            measured(6.661, "g"),
            measured(0.02302, "g"),
            measured(0.0004, "g"),
            measured(68.0, "mm"),
            measured(0.004, "mm"),
            measured(-33.56, "°"),
            measured(0.0, "mm"),
            measured(0.7268, ""),
        ]
        .map(|text| text.replace('\u{a0}', " "));
        assert_eq!(
            shown,
            [
                "9.9°",
                "257 rpm",
                "34.4 g",
                "6.66 g",
                "0.02 g",
                "0.0004 g",
                "68 mm",
                "0.004 mm",
                "-33.6°",
                "0 mm",
                "0.7268\u{a0}"
            ]
            .map(|text| text.replace('\u{a0}', ""))
        );
        assert_eq!(
            measured_extent(&[56.32, 100.0, 32.5]),
            "56.3 × 100 × 32.5\u{a0}mm"
        );
    }

    #[test]
    fn coordinates_leave_out_what_is_less_than_a_micrometre() {
        assert_eq!(coordinates(&[6.5e-7, -4e-4, 55.764_5]), "(0, 0, 55.76)");
        assert_eq!(coordinates(&[0.0, -1.0, 0.134_91]), "(0, -1, 0.1349)");
    }
}
