//! The names of parts, brackets and units on sheets and in files.

use super::build::Built;
use crate::cladding::Unit;

/// The names of an object's things.
pub struct Names {
    /// The ids of the parts, such as `3a`: the number of the panel below, and a letter.
    pub parts: Vec<String>,
    /// The number of that panel for each part, from 1.
    pub panels: Vec<usize>,
}

impl Names {
    /// Names the parts of an object in their order.
    pub fn of(built: &Built) -> Self {
        let panel_of = |face: usize| {
            let mut panels = built.shell.panels.panels.iter();
            panels.position(|panel| panel.face == face).unwrap_or(0) + 1
        };
        let faces = built.shell.parts.iter().map(|part| part.face);
        let panels: Vec<usize> = faces.map(panel_of).collect();
        let named = panels.iter().enumerate().map(|(index, panel)| {
            let earlier = panels[..index].iter().filter(|other| *other == panel);
            format!("{panel}{}", letters(earlier.count()))
        });
        Self {
            parts: named.collect(),
            panels,
        }
    }

    /// Returns the name of a unit: the number of its panel, or the part that it is.
    pub fn unit(&self, built: &Built, unit: &Unit) -> String {
        let panels = built.shell.panels.panels.iter();
        let mut own = panels
            .enumerate()
            .filter(|(_, panel)| panel.face == unit.face);
        match (unit.has_panel, own.next(), unit.parts.first()) {
            (true, Some((index, _)), _) => format!("unit {}", index + 1),
            (_, _, Some(&part)) => format!("part {}", self.parts[part]),
            _ => "unit".to_owned(),
        }
    }
}

/// Returns the name of a bracket.
pub fn bracket_id(index: usize) -> String {
    format!("B{:02}", index + 1)
}

/// Returns the letters of a number from 0: a to z, then aa and so on.
fn letters(mut number: usize) -> String {
    let mut letters = Vec::new();
    loop {
        letters.push(char::from(b'a' + (number % 26) as u8));
        number /= 26;
        if number == 0 {
            break;
        }
        number -= 1;
    }
    letters.iter().rev().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_get_letters_in_their_order() {
        let names = [0, 1, 25, 26, 27, 51, 52, 701, 702].map(letters);
        assert_eq!(names, ["a", "b", "z", "aa", "ab", "az", "ba", "zz", "aaa"]);
    }
}
