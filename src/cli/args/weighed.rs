//! The masses of blocks of infill, as they are typed.

use crate::coupon::WeighedInfill;

/// A text that is not the masses of an infill's blocks.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no infill with its masses; \
     remedy: give the large and the small block, such as 15%=6.52g,2.12g"
)]
pub struct WeighedError(String);

/// Reads the masses of the blocks of an infill, such as `15%=6.52g,2.12g`.
///
/// # Errors
/// The text has another form. Whether the masses can be right is not asked here.
pub(super) fn weighed_infill(text: &str) -> Result<WeighedInfill, WeighedError> {
    let fault = || WeighedError(text.to_owned());
    let (percent, masses) = text.split_once('=').ok_or_else(fault)?;
    let percent = percent.trim().strip_suffix('%').ok_or_else(fault)?;
    let mass = |mass: &str| {
        let mass = mass.trim();
        let number = mass.strip_suffix('g').unwrap_or(mass).trim_end();
        number.parse::<f64>().map_err(|_| fault())
    };
    Ok(WeighedInfill {
        percent: percent.trim_end().parse().map_err(|_| fault())?,
        masses_g: masses.split(',').map(mass).collect::<Result<_, _>>()?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masses_have_a_unit_or_none_and_anything_else_is_refused_with_an_example() {
        for text in ["15%=6.52g,2.12g", "15 % = 6.52 g, 2.12", "15%=6.52,2.12g"] {
            let found = weighed_infill(text).unwrap();
            assert_eq!((found.percent, found.masses_g), (15.0, vec![6.52, 2.12]));
        }
        for text in [
            "", "15", "15=6.52g", "%=1g", "15%", "15%=", "15%=1g,", "15%=1kg", "a%=1g",
        ] {
            let error = weighed_infill(text).unwrap_err().to_string();
            assert!(error.contains("such as 15%=6.52g,2.12g"), "{error}");
        }
    }
}
