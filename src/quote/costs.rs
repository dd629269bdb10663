//! The costs of a kit: what its toolpaths take and what its parts ask for, by the shop's rates.

use serde::Serialize;

use super::error::QuoteError;
use super::rates::ShopRates;
use crate::base::numbers::quantity;
use crate::base::units::{format_count, show_minutes};
use crate::sheet::Checklist;
use crate::slice::Slices;

/// Hundredths of the currency.
const CENTS: f64 = 100.0;
/// Grams in a kilogram.
const G_PER_KG: f64 = 1000.0;
/// Minutes in an hour.
const MIN_PER_H: f64 = 60.0;
/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;
/// Per cent of a whole.
const PERCENT: f64 = 100.0;

/// The price of a kit. All prices are in the shop's currency, and whole hundredths of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Quote {
    /// The job of the kit.
    pub job: String,
    /// The printer's name.
    pub printer: String,
    /// The material's name.
    pub material: String,
    /// The slicer whose toolpaths were counted.
    pub slicer: String,
    /// The currency.
    pub currency: String,
    /// Mass of parts and jigs, g.
    pub parts_g: f64,
    /// Mass of support, brim, skirt and purging, g.
    pub support_g: f64,
    /// Time of the machine, min.
    pub machine_min: u32,
    /// Time of work, min.
    pub work_min: f64,
    /// Number of parts and jigs.
    pub pieces: usize,
    /// Number of joints to glue.
    pub joints: usize,
    /// The costs, line by line.
    pub lines: Vec<QuoteLine>,
    /// The sum of all costs.
    pub costs: f64,
    /// The margin on them.
    pub margin: f64,
    /// The price without tax.
    pub net: f64,
    /// The tax.
    pub tax: f64,
    /// The price.
    pub total: f64,
    /// Things that the kit needs and the price does not hold.
    pub excluded: Vec<String>,
}

/// A line of a quote.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuoteLine {
    /// The thing that is charged.
    pub what: String,
    /// Its amount in words.
    pub amount: String,
    /// The rate in words.
    pub rate: String,
    /// Its price.
    pub price: f64,
}

/// A sum of money, in whole hundredths of the currency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Money(u64);

impl Money {
    /// Rounds an amount to whole hundredths.
    fn of(amount: f64) -> Self {
        Self((amount * CENTS).round() as u64)
    }

    fn amount(self) -> f64 {
        self.0 as f64 / CENTS
    }
}

/// The amounts that are charged.
struct Amounts {
    parts_g: f64,
    support_g: f64,
    machine_min: u32,
    work_min: f64,
    pieces: usize,
    joints: usize,
}

impl Amounts {
    fn of(sheet: &Checklist, slices: &Slices, shop: &ShopRates) -> Self {
        let rates = &shop.rates;
        let beside = slices.plates.iter().map(|plate| {
            let more_g = plate.filament_g.unwrap_or(0.0) - plate.parts_g;
            more_g.max(plate.support_g)
        });
        let glue = sheet.printer.glue.as_ref();
        let hold_min = glue.and_then(|glue| glue.hold_s).unwrap_or(0.0) / S_PER_MIN;
        let (pieces, joints) = (sheet.parts.len() + sheet.jigs.len(), sheet.joints.len());
        Self {
            parts_g: slices.parts_g(),
            support_g: beside.sum(),
            machine_min: slices.plates.iter().map(|plate| plate.minutes).sum(),
            work_min: rates.minutes_per_order
                + rates.minutes_per_part * pieces as f64
                + (rates.minutes_per_joint + hold_min) * joints as f64,
            pieces,
            joints,
        }
    }

    /// Returns the costs, line by line.
    fn lines(&self, shop: &ShopRates, sheet: &Checklist) -> Result<Vec<QuoteLine>, QuoteError> {
        let (rates, material) = (&shop.rates, &sheet.material);
        let per_kg = shop.per_kg(&material.id)?;
        let line = |what: &str, amount: String, [rate, share]: [f64; 2], unit: &str| QuoteLine {
            what: what.to_owned(),
            amount,
            rate: format!("{rate:.2} {}{unit}", rates.currency),
            price: Money::of(rate * share).amount(),
        };
        let by_mass = |what: &str, mass_g: f64| {
            let rate = [per_kg, mass_g / G_PER_KG];
            line(what, quantity(mass_g, "g"), rate, " per kg")
        };
        let by_time = |what: &str, minutes: f64, rate: f64| {
            let rate = [rate, minutes / MIN_PER_H];
            line(what, show_minutes(minutes.ceil() as u32), rate, " per hour")
        };
        let work = format!(
            "Work on {} and {}",
            format_count(self.pieces, "part"),
            format_count(self.joints, "joint")
        );
        let mut lines = vec![
            by_mass(&format!("{}, parts", material.name), self.parts_g),
            by_mass(
                &format!("{}, support, brim and purging", material.name),
                self.support_g,
            ),
            by_time(
                "Machine",
                f64::from(self.machine_min),
                rates.machine_per_hour,
            ),
            by_time(&work, self.work_min, rates.labour_per_hour),
        ];
        if rates.setup > 0.0 {
            lines.push(line("Set-up", "once".to_owned(), [rates.setup, 1.0], ""));
        }
        Ok(lines)
    }
}

impl Quote {
    /// Adds up what a sliced kit costs.
    ///
    /// # Errors
    /// The rates have no price of the kit's material.
    pub fn of(sheet: &Checklist, slices: &Slices, shop: &ShopRates) -> Result<Self, QuoteError> {
        let rates = &shop.rates;
        let amounts = Amounts::of(sheet, slices, shop);
        let lines = amounts.lines(shop, sheet)?;
        let costs = Money(lines.iter().map(|line| Money::of(line.price).0).sum());
        let margin = Money::of(costs.amount() * rates.margin_percent / PERCENT);
        let net = Money(costs.0 + margin.0);
        let tax = Money::of(net.amount() * rates.tax_percent / PERCENT);
        Ok(Self {
            job: sheet.job.clone(),
            printer: sheet.printer.name.clone(),
            material: sheet.material.name.clone(),
            slicer: slices.slicer.clone(),
            currency: rates.currency.clone(),
            parts_g: amounts.parts_g,
            support_g: amounts.support_g,
            machine_min: amounts.machine_min,
            work_min: amounts.work_min,
            pieces: amounts.pieces,
            joints: amounts.joints,
            lines,
            costs: costs.amount(),
            margin: margin.amount(),
            net: net.amount(),
            tax: tax.amount(),
            total: Money(net.0 + tax.0).amount(),
            excluded: excluded(sheet),
        })
    }

    /// Words a price: `12.50 EUR`.
    pub fn price(&self, amount: f64) -> String {
        format!("{amount:.2}\u{a0}{}", self.currency)
    }
}

/// Names what a kit needs and the rates do not price.
fn excluded(sheet: &Checklist) -> Vec<String> {
    let counted = [
        (
            sheet.hardware.len(),
            "piece of hardware",
            "pieces of hardware",
        ),
        (sheet.dowels.len(), "dowel", "dowels"),
        (sheet.ballast.len(), "piece of ballast", "pieces of ballast"),
    ];
    let counted = counted.into_iter().filter(|(count, ..)| *count > 0);
    let counted = counted.map(|(count, one, many)| {
        let name = if count == 1 { one } else { many };
        format!("{count} {name}")
    });
    let filling = sheet.fill.map(|_| "the filling of the voids".to_owned());
    let glue = (!sheet.joints.is_empty()).then(|| "glue".to_owned());
    counted.chain(filling).chain(glue).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::toml_text;
    use crate::printer::Rates;
    use crate::slice::PlateSlice;
    use crate::testing::sample;
    use serde::Deserialize;
    use std::path::PathBuf;

    #[derive(Deserialize)]
    struct Shop {
        rates: Rates,
    }

    /// Returns a sheet of a part of the material `pla`, its slices, and a shop's rates.
    fn order(material: &str) -> (Checklist, Slices, ShopRates) {
        let mut sheet = sample().0;
        sheet.material.id = material.to_owned();
        let plate = PlateSlice {
            plate: "plate.3mf".to_owned(),
            toolpaths: "plate.gcode".to_owned(),
            minutes: 90,
            parts_g: 80.0,
            support_g: 4.0,
            filament_g: Some(90.0),
            layers: 100,
        };
        let slices = Slices {
            schema: Slices::SCHEMA,
            job: sheet.job.clone(),
            slicer: "PrusaSlicer 2.5.0".to_owned(),
            is_untried: false,
            profile_sha256: None,
            plates: vec![plate.clone(), plate],
        };
        let text = Rates::EXAMPLE
            .replace("setup = 0.0", "setup = 7.5")
            .replace("margin_percent = 0", "margin_percent = 20")
            .replace("tax_percent = 0", "tax_percent = 19");
        let shop: Shop = toml_text::read("equipoise.toml", &text).unwrap();
        let rates = ShopRates {
            file: PathBuf::from("equipoise.toml"),
            rates: shop.rates,
        };
        (sheet, slices, rates)
    }

    #[test]
    fn a_price_is_the_sum_of_its_lines_with_margin_and_tax() {
        let (sheet, slices, shop) = order("pla");
        let quote = Quote::of(&sheet, &slices, &shop).unwrap();
        let prices: Vec<f64> = quote.lines.iter().map(|line| line.price).collect();
        // 160 g and 20 g at 25 a kilogram, 3 h at 3; the work depends on the sheet.
        assert_eq!(prices[..3], [4.0, 0.5, 9.0]);
        let hold_min = sheet.printer.glue.as_ref().and_then(|glue| glue.hold_s);
        let hold_min = hold_min.unwrap_or(0.0) / 60.0;
        let pieces = (sheet.parts.len() + sheet.jigs.len()) as f64;
        let minutes = 10.0 + 5.0 * pieces + (5.0 + hold_min) * sheet.joints.len() as f64;
        assert!((prices[3] - minutes / 60.0 * 40.0).abs() <= 0.005);
        assert_eq!(prices[4], 7.5);
        let costs: f64 = prices.iter().sum();
        assert!((quote.costs - costs).abs() < 1e-9);
        assert!((quote.net - 1.2 * costs).abs() <= 0.005 + 1e-9);
        assert!((quote.total - quote.net - quote.tax).abs() < 1e-9);
        assert!((quote.tax - 0.19 * quote.net).abs() <= 0.005 + 1e-9);
    }

    #[test]
    fn support_is_what_the_slicer_states_beyond_the_parts_if_it_states_any() {
        let (sheet, mut slices, shop) = order("pla");
        assert_eq!(Quote::of(&sheet, &slices, &shop).unwrap().support_g, 20.0);
        for plate in &mut slices.plates {
            plate.filament_g = None;
        }
        assert_eq!(Quote::of(&sheet, &slices, &shop).unwrap().support_g, 8.0);
    }

    #[test]
    fn a_material_without_a_price_is_named_with_the_file() {
        let (sheet, slices, shop) = order("wood");
        let refused = Quote::of(&sheet, &slices, &shop).unwrap_err().to_string();
        assert!(
            refused.starts_with("equipoise.toml has no price"),
            "{refused}"
        );
        assert!(refused.contains("`wood = …`"), "{refused}");
    }

    #[test]
    fn what_is_bought_is_said_not_to_be_in_the_price() {
        let (mut sheet, slices, shop) = order("pla");
        sheet.fill = Some(crate::verify::FillOrder { density_g_cm3: 2.3 });
        let quote = Quote::of(&sheet, &slices, &shop).unwrap();
        assert_eq!(quote.excluded, ["the filling of the voids", "glue"]);
    }
}
