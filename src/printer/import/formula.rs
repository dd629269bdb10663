//! Cura's formulas, as far as line widths and layers need them: numbers, names of settings, + − ×
//! ÷, brackets and `round`.

/// How deep formulas may refer to each other; real ones go three deep, and a circle would not end.
const MOST_DEPTH: usize = 16;

/// What a formula refers to.
pub(super) enum Setting {
    /// A number.
    Number(f64),
    /// Another formula.
    Formula(String),
}

/// The value of a formula; none where it has words, functions or operators besides those above, or
/// refers to nothing.
pub(super) fn evaluated<'a>(
    formula: &str,
    setting: &impl Fn(&str) -> Option<&'a Setting>,
) -> Option<f64> {
    value_of(formula, setting, 0)
}

fn value_of<'a>(
    formula: &str,
    setting: &impl Fn(&str) -> Option<&'a Setting>,
    depth: usize,
) -> Option<f64> {
    let name = |name: &str| match setting(name)? {
        Setting::Number(number) => Some(*number),
        Setting::Formula(formula) => {
            (depth < MOST_DEPTH).then(|| value_of(formula, setting, depth + 1))?
        }
    };
    let mut parser = Parser {
        rest: formula.trim_start_matches('='),
        name: &name,
        depth: 0,
    };
    let value = parser.sum()?;
    (parser.peek().is_none() && value.is_finite()).then_some(value)
}

/// What is left of a formula.
struct Parser<'f, 'n> {
    rest: &'f str,
    name: &'n dyn Fn(&str) -> Option<f64>,
    depth: usize,
}

impl Parser<'_, '_> {
    /// The next character that is not a blank.
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    /// Whether the next character is this one; if so it is taken.
    fn takes(&mut self, wanted: char) -> bool {
        let is_next = self.peek() == Some(wanted);
        if is_next {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        is_next
    }

    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            if self.takes('+') {
                value += self.product()?;
            } else if self.takes('-') {
                value -= self.product()?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.takes('*') {
                value *= self.factor()?;
            } else if self.takes('/') {
                value /= self.factor()?;
            } else {
                return Some(value);
            }
        }
    }

    /// A number, a name, `round(…)` or a bracket.
    fn factor(&mut self) -> Option<f64> {
        let first = self.peek()?;
        if first == '(' {
            return self.bracketed(&[]);
        }
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let end = self.rest.find(|c| !is_word(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        match word {
            "round" => self.bracketed(&[0.0]),
            _ if first.is_ascii_digit() || first == '.' => word.parse().ok(),
            _ => (self.name)(word),
        }
    }

    /// What stands in brackets; with `digits` the first is rounded to the second, or to these where
    /// there is none.
    fn bracketed(&mut self, digits: &[f64]) -> Option<f64> {
        self.depth += 1;
        if self.depth > MOST_DEPTH || !self.takes('(') {
            return None;
        }
        let value = self.sum()?;
        let digits = if self.takes(',') {
            Some(self.sum()?)
        } else {
            digits.first().copied()
        };
        self.depth -= 1;
        let value = digits.map_or(value, |digits| {
            let scale = 10f64.powf(digits);
            (value * scale).round() / scale
        });
        self.takes(')').then_some(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(formula: &str) -> Option<f64> {
        let nozzle = Setting::Number(0.4);
        let width = Setting::Formula("round(machine_nozzle_size * 0.875, 3)".into());
        let circle = Setting::Formula("circle + 1".into());
        evaluated(formula, &|name: &str| match name {
            "machine_nozzle_size" => Some(&nozzle),
            "line_width" => Some(&width),
            "circle" => Some(&circle),
            _ => None,
        })
    }

    #[test]
    fn widths_are_the_nozzle_times_something_rounded() {
        assert_eq!(value("=line_width"), Some(0.35));
        assert_eq!(value("machine_nozzle_size"), Some(0.4));
        assert_eq!(value(" 2 * (1 + 3) / 4 - .5 "), Some(1.5));
        assert_eq!(value("round(2.6)"), Some(3.0));
    }

    #[test]
    fn what_is_not_understood_has_no_value() {
        for formula in [
            "",
            "1 +",
            "1 if x else 2",
            "extruderValue(0)",
            "circle",
            "1 / 0",
            "(1",
            "1)",
            "'a'",
            "unknown",
        ] {
            assert_eq!(value(formula), None, "{formula}");
        }
        assert_eq!(value(&"(".repeat(10_000)), None);
    }
}
