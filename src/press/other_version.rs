//! The papers of another version, which this one cannot print: its numbers are read back.

use crate::sheet::Checklist;

/// A number on the page may be off by this many units of its last digit.
const ROUNDING: f64 = 0.51;

/// Returns what is false of the parts' masses on a job sheet of another version, a sentence each.
///
/// The row of a part begins with its id. It has its mass as a number with the unit g, rounded
/// somehow.
pub(super) fn find_false_masses(sheet: &Checklist, page: &str) -> Vec<String> {
    let rows: Vec<String> = page.split("<tr").skip(1).map(words_of).collect();
    let version = &sheet.tool.version;
    let lacks = |id: &str, mass_g: f64| {
        let of_part = |row: &&String| row.split_whitespace().next() == Some(id);
        !rows.iter().filter(of_part).any(|row| states(row, mass_g))
    };
    let parts = sheet
        .parts
        .iter()
        .filter(|part| lacks(&part.id, part.mass_g));
    let fault = |id: &str, mass_g: f64| {
        format!("the job sheet, of version {version}, does not say that {id} has {mass_g} g")
    };
    parts.map(|part| fault(&part.id, part.mass_g)).collect()
}

/// Returns the words of a piece of a page, without its tags and what follows the row.
fn words_of(piece: &str) -> String {
    let row = piece.split("</tr").next().unwrap_or_default();
    let (mut words, mut is_tag) = (String::new(), true);
    for letter in row.chars() {
        match letter {
            '<' => is_tag = true,
            '>' => {
                is_tag = false;
                words.push(' ');
            }
            _ if is_tag => {}
            _ => words.push(letter),
        }
    }
    words
}

/// Returns whether a row states a mass, rounded to any digit.
fn states(row: &str, mass_g: f64) -> bool {
    let words: Vec<&str> = row.split_whitespace().collect();
    words.windows(2).any(|pair| {
        let is_grams = pair[1].trim_end_matches([',', ';', '.']) == "g";
        let decimals = pair[0].split_once('.').map_or(0, |(_, rest)| rest.len());
        let digit_g = 10f64.powi(-(decimals as i32));
        let is_near = |stated: f64| (stated - mass_g).abs() <= ROUNDING * digit_g;
        is_grams && pair[0].parse().is_ok_and(is_near)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mass_is_read_back_from_its_row_as_rounded_as_it_is() {
        let row = words_of(" class=\"x\"><th>P01</th><td>12.3\u{a0}g, 40 %</td></tr><p>99 g");
        assert!(states(&row, 12.34) && states(&row, 12.26));
        assert!(!states(&row, 12.4) && !states(&row, 99.0) && !states(&row, 40.0));
    }
}
