//! Cura's formulas, as far as line widths and layers need them: numbers, names of settings, + − ×
//! ÷, parentheses and `round`.

/// Greatest depth of references between formulas, and of parentheses. Real ones go three deep, and
/// a circle would not end.
const MAX_DEPTH: usize = 16;

/// The value of a setting to which formulas refer.
pub(super) enum Setting {
    /// A number.
    Number(f64),
    /// Another formula.
    Formula(String),
}

/// Evaluates a formula; `None` if it has other words, functions or operators, or refers to an
/// unknown setting.
pub(super) fn evaluate<'a>(
    formula: &str,
    setting: &impl Fn(&str) -> Option<&'a Setting>,
) -> Option<f64> {
    evaluate_at(formula, setting, 0)
}

/// Evaluates a formula at some depth of references.
fn evaluate_at<'a>(
    formula: &str,
    setting: &impl Fn(&str) -> Option<&'a Setting>,
    depth: usize,
) -> Option<f64> {
    let name = |name: &str| match setting(name)? {
        Setting::Number(number) => Some(*number),
        Setting::Formula(formula) => {
            (depth < MAX_DEPTH).then(|| evaluate_at(formula, setting, depth + 1))?
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

/// The part of a formula that is still to be parsed.
struct Parser<'f, 'n> {
    rest: &'f str,
    name: &'n dyn Fn(&str) -> Option<f64>,
    depth: usize,
}

impl Parser<'_, '_> {
    /// Skips blanks and returns the next character.
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    /// Takes the next character if it is the wanted one, and returns true if so.
    fn accept(&mut self, wanted: char) -> bool {
        let is_next = self.peek() == Some(wanted);
        if is_next {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        is_next
    }

    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            if self.accept('+') {
                value += self.product()?;
            } else if self.accept('-') {
                value -= self.product()?;
            } else {
                return Some(value);
            }
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.accept('*') {
                value *= self.factor()?;
            } else if self.accept('/') {
                value /= self.factor()?;
            } else {
                return Some(value);
            }
        }
    }

    /// Parses a number, a name, `round(…)` or an expression in parentheses.
    fn factor(&mut self) -> Option<f64> {
        let first = self.peek()?;
        if first == '(' {
            return self.parentheses(&[]);
        }
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let end = self.rest.find(|c| !is_word(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        match word {
            "round" => self.parentheses(&[0.0]),
            _ if first.is_ascii_digit() || first == '.' => word.parse().ok(),
            _ => (self.name)(word),
        }
    }

    /// Parses one or two expressions in parentheses. The first is rounded to as many digits as the
    /// second says, or else to `digits` if given.
    fn parentheses(&mut self, digits: &[f64]) -> Option<f64> {
        self.depth += 1;
        if self.depth > MAX_DEPTH || !self.accept('(') {
            return None;
        }
        let value = self.sum()?;
        let digits = if self.accept(',') {
            Some(self.sum()?)
        } else {
            digits.first().copied()
        };
        self.depth -= 1;
        let value = digits.map_or(value, |digits| {
            let scale = 10f64.powf(digits);
            (value * scale).round() / scale
        });
        self.accept(')').then_some(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(formula: &str) -> Option<f64> {
        let nozzle = Setting::Number(0.4);
        let width = Setting::Formula("round(machine_nozzle_size * 0.875, 3)".into());
        let circle = Setting::Formula("circle + 1".into());
        evaluate(formula, &|name: &str| match name {
            "machine_nozzle_size" => Some(&nozzle),
            "line_width" => Some(&width),
            "circle" => Some(&circle),
            _ => None,
        })
    }

    #[test]
    fn formulas_of_line_widths_are_evaluated() {
        assert_eq!(value("=line_width"), Some(0.35));
        assert_eq!(value("machine_nozzle_size"), Some(0.4));
        assert_eq!(value(" 2 * (1 + 3) / 4 - .5 "), Some(1.5));
        assert_eq!(value("round(2.6)"), Some(3.0));
    }

    #[test]
    fn other_formulas_have_no_value() {
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
