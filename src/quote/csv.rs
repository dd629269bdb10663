//! A quote as a table of two lines: the names of the columns, and the values.

use super::costs::Quote;

impl Quote {
    /// Returns the quote as CSV: a line of names, and a line of values with decimal points.
    pub fn to_csv(&self) -> String {
        let money = |amount: f64| format!("{amount:.2}");
        let price = |index: usize| {
            let line = self.lines.get(index);
            money(line.map_or(0.0, |line| line.price))
        };
        let columns = [
            ("job", self.job.clone()),
            ("printer", self.printer.clone()),
            ("material", self.material.clone()),
            ("parts_g", money(self.parts_g)),
            ("support_g", money(self.support_g)),
            ("machine_min", self.machine_min.to_string()),
            ("work_min", money(self.work_min)),
            ("price_parts", price(0)),
            ("price_support", price(1)),
            ("price_machine", price(2)),
            ("price_work", price(3)),
            ("price_setup", price(4)),
            ("margin", money(self.margin)),
            ("net", money(self.net)),
            ("tax", money(self.tax)),
            ("total", money(self.total)),
            ("currency", self.currency.clone()),
        ];
        let [names, values] = [
            columns.iter().map(|(name, _)| (*name).to_owned()).collect(),
            columns.iter().map(|(_, value)| field(value)).collect(),
        ]
        .map(|fields: Vec<String>| fields.join(","));
        format!("{names}\n{values}\n")
    }
}

/// Returns a value as a field of CSV, in quotes if it needs them.
fn field(value: &str) -> String {
    if value.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", value.replace('"', "\"\""))
    } else {
        value.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_with_a_comma_or_a_quote_is_quoted() {
        assert_eq!(field("Prusa MK4"), "Prusa MK4");
        assert_eq!(field("PLA, \"black\""), "\"PLA, \"\"black\"\"\"");
    }
}
