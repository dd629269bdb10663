//! Sparse infill: how much of it a slicer really lays.

use serde::Serialize;

use super::Sourced;

/// Halvings of the range in which a density is sought.
const HALVINGS: usize = 60;

/// A pattern of sparse infill, with what slicers lay of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfillPattern {
    /// Its name, in the words of slicers.
    pub pattern: String,
    /// Pairs of a nominal density and the density laid in the core, both over that of solid print;
    /// ascending.
    pub core_ratio: Sourced<Vec<[f64; 2]>>,
}

impl InfillPattern {
    /// Returns the density that is laid for a nominal one, both over that of solid print.
    ///
    /// Between two rows it lies on the line between them. Outside of the table, the share laid is
    /// that of the nearest row. All of it is solid print, which slicers lay in another pattern.
    pub fn laid_ratio(&self, nominal_ratio: f64) -> f64 {
        if nominal_ratio >= 1.0 {
            return 1.0;
        }
        let rows = &self.core_ratio.value;
        let above = rows.partition_point(|[nominal, _]| *nominal < nominal_ratio);
        match (
            above.checked_sub(1).map(|below| rows[below]),
            rows.get(above),
        ) {
            (Some([from, laid]), Some([to, more])) => {
                laid + (more - laid) * (nominal_ratio - from) / (to - from)
            }
            (Some([nominal, laid]), None) | (None, Some(&[nominal, laid])) => {
                nominal_ratio * laid / nominal
            }
            (None, None) => nominal_ratio,
        }
    }

    /// Returns the pattern of a slicer that lays so much of what this table says; at most solid
    /// print.
    #[must_use]
    pub fn scaled(&self, ratio: f64) -> Self {
        let mut scaled = self.clone();
        for [_, laid] in &mut scaled.core_ratio.value {
            *laid = (*laid * ratio).min(1.0);
        }
        scaled
    }

    /// Returns the density to set for which this one is laid, over that of solid print.
    ///
    /// What lies between the greatest infill and solid print cannot be laid. For that it is nearly
    /// solid print.
    pub fn nominal_ratio(&self, laid_ratio: f64) -> f64 {
        if laid_ratio >= 1.0 {
            return 1.0;
        }
        let mut range = [0.0, 1.0];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (range[0] + range[1]);
            let half = usize::from(self.laid_ratio(middle) > laid_ratio);
            range[half] = middle;
        }
        range[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::printer::{Printer, Quantity, Sure};

    fn table(rows: &[[f64; 2]]) -> InfillPattern {
        InfillPattern {
            pattern: "gyroid".to_owned(),
            core_ratio: Sourced {
                value: rows.to_vec(),
                source: "a test".to_owned(),
                sure: Sure::Measured,
                process_default_of: None,
            },
        }
    }

    #[test]
    fn a_density_between_two_rows_lies_on_the_line_between_them() {
        let infill = table(&[[0.1, 0.09], [0.2, 0.19], [0.5, 0.46]]);
        for (nominal, laid) in [
            (0.1, 0.09),
            (0.15, 0.14),
            (0.2, 0.19),
            (0.35, 0.325),
            (0.5, 0.46),
        ] {
            assert!(
                (infill.laid_ratio(nominal) - laid).abs() < 1e-12,
                "{nominal}"
            );
        }
    }

    #[test]
    fn the_nominal_density_lays_the_one_that_is_asked_for() {
        let printer = Printer::find("prusa-mk4").unwrap();
        let pattern = printer.infill.as_ref().unwrap();
        for laid_ratio in [0.15, 0.4, 0.6, 0.82, 1.0] {
            let nominal = pattern.nominal_ratio(laid_ratio);
            assert!((pattern.laid_ratio(nominal) - laid_ratio).abs() < 1e-9);
        }
    }

    #[test]
    fn outside_of_the_table_the_share_of_the_nearest_row_is_laid() {
        let infill = table(&[[0.1, 0.09], [0.5, 0.45]]);
        assert!((infill.laid_ratio(0.05) - 0.045).abs() < 1e-12);
        assert!((infill.laid_ratio(0.8) - 0.72).abs() < 1e-12);
        assert_eq!(table(&[]).laid_ratio(0.3), 0.3);
        assert_eq!(infill.laid_ratio(1.0), 1.0, "solid print");
    }

    #[test]
    fn filament_printers_have_infill_and_the_others_have_none() {
        for printer in Printer::all().unwrap() {
            let is_filament = printer.process.as_deref() == Some("fdm");
            let least = printer.number(Quantity::LeastInfillRatio);
            let sparse = printer.infill.as_ref().zip(least);
            assert_eq!(sparse.is_some(), is_filament, "{}", printer.id);
            if let Some((infill, least)) = sparse {
                assert_eq!((least.value, infill.laid_ratio(least.value)), (0.15, 0.142));
            }
        }
    }
}
