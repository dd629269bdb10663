//! A shop's rates: what it charges for material, machines and work.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer};

/// The most that a rate may be, in the shop's currency: more is a slip of the keyboard.
const MOST: f64 = 1e6;

/// A shop's rates, as the table `[rates]` of its `equipoise.toml` has them.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rates {
    /// The currency, as it stands behind every price.
    pub currency: String,
    /// An hour of the machine.
    #[serde(deserialize_with = "rate")]
    pub machine_per_hour: f64,
    /// An hour of work.
    #[serde(deserialize_with = "rate")]
    pub labour_per_hour: f64,
    /// A kilogram of each material, by its id.
    #[serde(deserialize_with = "rates")]
    pub material_per_kg: BTreeMap<String, f64>,
    /// The work on the order as a whole, min: to load the plates, and to test the object.
    #[serde(deserialize_with = "rate")]
    pub minutes_per_order: f64,
    /// The work on each part and jig, min: to take off its support, to clean and to weigh it.
    #[serde(deserialize_with = "rate")]
    pub minutes_per_part: f64,
    /// The work on each joint, min: to glue and to align it. The time to hold it comes on top.
    #[serde(deserialize_with = "rate")]
    pub minutes_per_joint: f64,
    /// The sum that is charged once for every order.
    #[serde(default, deserialize_with = "rate")]
    pub setup: f64,
    /// The margin on all costs, per cent.
    #[serde(default, deserialize_with = "rate")]
    pub margin_percent: f64,
    /// The tax on the net price, per cent.
    #[serde(default, deserialize_with = "rate")]
    pub tax_percent: f64,
}

impl Rates {
    /// The lines of a table of rates, to be filled in.
    pub const EXAMPLE: &str = "[rates]\n\
        currency = \"EUR\"\n\
        machine_per_hour = 3.0\n\
        labour_per_hour = 40.0\n\
        minutes_per_order = 10\n\
        minutes_per_part = 5\n\
        minutes_per_joint = 5\n\
        setup = 0.0            # once for every order\n\
        margin_percent = 0\n\
        tax_percent = 0\n\
        material_per_kg = { pla = 25.0, petg = 28.0 }\n";
}

/// Returns an error unless a rate is one that a shop can have.
fn checked<E: serde::de::Error>(rate: f64) -> Result<f64, E> {
    match (0.0..=MOST).contains(&rate) {
        true => Ok(rate),
        false => Err(E::custom(format!("{rate} is no rate from 0 to {MOST}"))),
    }
}

fn rate<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    checked(f64::deserialize(deserializer)?)
}

fn rates<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<String, f64>, D::Error> {
    let rates = BTreeMap::<String, f64>::deserialize(deserializer)?;
    for rate in rates.values() {
        checked::<D::Error>(*rate)?;
    }
    Ok(rates)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::toml_text;

    #[derive(Debug, Deserialize)]
    struct Shop {
        rates: Rates,
    }

    fn read(text: &str) -> Result<Rates, String> {
        let shop: Result<Shop, _> = toml_text::read("equipoise.toml", text);
        shop.map(|shop| shop.rates)
            .map_err(|fault| fault.to_string())
    }

    #[test]
    fn the_example_is_a_table_of_rates() {
        let rates = read(Rates::EXAMPLE).unwrap();
        assert_eq!(rates.currency, "EUR");
        assert_eq!(rates.material_per_kg["petg"], 28.0);
        assert_eq!(rates.minutes_per_joint, 5.0);
    }

    #[test]
    fn a_wrong_rate_is_named_with_its_place() {
        for (right, wrong, named) in [
            ("machine_per_hour", "machine_per_hours", "2:1"),
            (
                "labour_per_hour = 40.0",
                "labour_per_hour = -1",
                "-1 is no rate",
            ),
            ("setup = 0.0", "setup = nan", "NaN is no rate"),
            ("pla = 25.0", "pla = inf", "inf is no rate"),
            (
                "minutes_per_part = 5",
                "",
                "missing field `minutes_per_part`",
            ),
        ] {
            let text = Rates::EXAMPLE.replace(right, wrong);
            let fault = read(&text).unwrap_err();
            assert!(fault.starts_with("equipoise.toml:"), "{fault}");
            assert!(fault.contains(named) || named == "2:1", "{wrong}: {fault}");
        }
        let misspelt = read(&Rates::EXAMPLE.replace("machine_per_hour", "machine_per_hours"));
        let misspelt = misspelt.unwrap_err();
        assert!(
            misspelt.contains("did you mean `machine_per_hour`"),
            "{misspelt}"
        );
    }
}
