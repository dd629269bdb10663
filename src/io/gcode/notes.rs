//! Reads the facts out of comments: `key = value`, `key: value`, and Cura's block of settings.

use super::facts::{Facts, Generator, LineWidths, set};

/// Most values of a list; more tools than any printer has.
const MOST_VALUES: usize = 256;
/// The time that CuraEngine writes before it knows better, s.
const PLACEHOLDER_S: f64 = 6666.0;
/// Bytes of Cura's settings that are kept.
const KEPT_SETTINGS: usize = 1 << 18;
/// The mark of the lines that hold Cura's settings.
const SETTINGS: &str = "SETTING_3 ";

/// Facts under way.
#[derive(Debug, Default)]
pub struct Notes {
    facts: Facts,
    /// Time elapsed at the latest layer, as Cura notes it, s.
    elapsed_s: Option<f64>,
    /// Cura's settings, still escaped.
    settings: String,
}

impl Notes {
    /// Takes a comment without its semicolon and without blanks around it.
    pub fn take(&mut self, comment: &str) {
        if let Some(piece) = comment.strip_prefix(SETTINGS) {
            if self.settings.len() + piece.len() <= KEPT_SETTINGS {
                self.settings.push_str(piece);
            }
            return;
        }
        if self.facts.generator.is_none() {
            self.facts.generator = Generator::of_comment(comment);
        }
        // Bambu Studio writes two times in one line; the total, which comes last, counts.
        if let Some((_, total)) = comment.split_once("; total estimated time") {
            self.note("total estimated time", total.trim_start_matches([':', ' ']));
        } else if let Some(at) = comment.find(['=', ':']) {
            self.note(comment[..at].trim_end(), comment[at + 1..].trim());
        }
    }

    /// Returns the height of layers that is known so far, mm.
    pub fn layer_height_mm(&self) -> Option<f64> {
        self.facts.layer_height_mm
    }

    /// Returns the facts at the end of the file.
    pub fn finish(mut self) -> Facts {
        let settings = std::mem::take(&mut self.settings);
        // A line end is an `n` after backslashes.
        for line in settings.replace("\\\\n", "\n").replace("\\n", "\n").lines() {
            if let Some((key, value)) = line.split_once(" = ") {
                self.note(key, value);
            }
        }
        set(&mut self.facts.print_time_s, self.elapsed_s);
        self.facts
    }

    /// Takes a key and its value. The first usable value of a key counts.
    fn note(&mut self, key: &str, value: &str) {
        let facts = &mut self.facts;
        match key {
            "estimated printing time (normal mode)"
            | "estimated printing time"
            | "total estimated time"
            | "model printing time" => set(&mut facts.print_time_s, duration_s(value)),
            "TIME" => {
                let known = positive(value).filter(|time_s| *time_s != PLACEHOLDER_S);
                set(&mut facts.print_time_s, known);
            }
            "TIME_ELAPSED" => self.elapsed_s = positive(value).or(self.elapsed_s),
            "FLAVOR" | "gcode_flavor" => set(&mut facts.flavor, word(value)),
            "use_volumetric_e" => set(&mut facts.is_volumetric, flag(value)),
            "LAYER_COUNT" | "total layer number" | "total layers count" => {
                set(&mut facts.layers, value.parse().ok());
            }
            "layer_height" | "Layer height" => set(&mut facts.layer_height_mm, positive(value)),
            "first_layer_height" | "initial_layer_print_height" | "layer_height_0" => {
                set(&mut facts.first_layer_height_mm, positive(value));
            }
            "fill_density" | "sparse_infill_density" | "infill_sparse_density" => {
                set(&mut facts.infill_ratio, percentage(value));
            }
            "filament used" | "Filament used" => self.note_use(value),
            _ if note_width(&mut facts.line_widths, key, value) => {}
            _ => note_list(facts, key, value),
        }
    }

    /// Takes Cura's lengths in m or volumes in mm³, or Slic3r's length in mm.
    fn note_use(&mut self, value: &str) {
        let value = value.split('(').next().unwrap_or_default();
        let facts = &mut self.facts;
        let units = [("mm3", 1.0), ("mm", 1.0), ("m", 1000.0)];
        let unit = units
            .into_iter()
            .find(|(unit, _)| value.trim_end().ends_with(unit));
        let Some((unit, factor)) = unit else {
            return;
        };
        let bare = value.replace(unit, "");
        let values = amounts(&bare).map(|all| all.iter().map(|v| v * factor).collect());
        let list = if unit == "mm3" {
            &mut facts.filament_used_mm3
        } else {
            &mut facts.filament_used_mm
        };
        fill(list, values);
    }
}

/// Takes a fact that has a value for each tool.
fn note_list(facts: &mut Facts, key: &str, value: &str) {
    let all_positive = |value: &str| amounts(value).filter(|all| all.iter().all(|v| *v > 0.0));
    match key {
        "filament used [mm]" | "total filament length [mm]" => {
            fill(&mut facts.filament_used_mm, amounts(value));
        }
        "filament used [cm3]" => {
            let values = amounts(value).map(|all| all.iter().map(|v| v * 1000.0).collect());
            fill(&mut facts.filament_used_mm3, values);
        }
        "filament used [g]" | "total filament weight [g]" | "total filament used [g]" => {
            fill(&mut facts.filament_used_g, amounts(value));
        }
        "filament_density" => fill(&mut facts.filament_density_g_cm3, all_positive(value)),
        "filament_diameter" | "material_diameter" => {
            fill(&mut facts.filament_diameter_mm, all_positive(value));
        }
        "extrusion_multiplier" | "filament_flow_ratio" => {
            fill(&mut facts.flow_ratios, all_positive(value));
        }
        "nozzle_diameter" => fill(&mut facts.nozzle_diameter_mm, all_positive(value)),
        _ => {}
    }
}

/// Takes the width of a line. Returns false if the key is of another kind.
fn note_width(widths: &mut LineWidths, key: &str, value: &str) -> bool {
    let width = match key {
        "extrusion_width" | "line_width" => &mut widths.usual_mm,
        "external perimeters extrusion width"
        | "external_perimeter_extrusion_width"
        | "outer_wall_line_width"
        | "wall_line_width_0" => &mut widths.external_perimeter_mm,
        "perimeters extrusion width"
        | "perimeter_extrusion_width"
        | "inner_wall_line_width"
        | "wall_line_width_x" => &mut widths.perimeter_mm,
        "infill extrusion width"
        | "infill_extrusion_width"
        | "sparse_infill_line_width"
        | "infill_line_width" => &mut widths.infill_mm,
        "solid infill extrusion width"
        | "solid_infill_extrusion_width"
        | "internal_solid_infill_line_width"
        | "skin_line_width" => &mut widths.solid_infill_mm,
        "top infill extrusion width"
        | "top_infill_extrusion_width"
        | "top_surface_line_width"
        | "roofing_line_width" => &mut widths.top_mm,
        "first layer extrusion width"
        | "first_layer_extrusion_width"
        | "initial_layer_line_width" => &mut widths.first_layer_mm,
        _ => return false,
    };
    set(width, positive(value.trim_end_matches("mm")));
    true
}

/// Fills a list that is still empty.
fn fill(list: &mut Vec<f64>, values: Option<Vec<f64>>) {
    if list.is_empty() {
        *list = values.unwrap_or_default();
    }
}

/// Reads a positive, finite number.
fn positive(value: &str) -> Option<f64> {
    let number = value.trim().parse::<f64>().ok();
    number.filter(|number| number.is_finite() && *number > 0.0)
}

/// Reads numbers between commas; `None` if one is none, or negative, or if all are zero.
fn amounts(value: &str) -> Option<Vec<f64>> {
    let number = |text: &str| {
        let number = text.trim().parse::<f64>().ok();
        number.filter(|number| number.is_finite() && *number >= 0.0)
    };
    let numbers = value.split(',').take(MOST_VALUES).map(number);
    let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
    numbers
        .iter()
        .any(|number| *number > 0.0)
        .then_some(numbers)
}

/// Reads a percentage, with or without its sign, as a ratio.
fn percentage(value: &str) -> Option<f64> {
    let number = value.trim().trim_end_matches('%').parse::<f64>().ok();
    number
        .map(|percent| percent / 100.0)
        .filter(|ratio| (0.0..=1.0).contains(ratio))
}

fn flag(value: &str) -> Option<bool> {
    match value {
        "0" | "false" => Some(false),
        "1" | "true" => Some(true),
        _ => None,
    }
}

fn word(value: &str) -> Option<String> {
    let word: String = value.chars().take(40).collect();
    (!word.is_empty()).then_some(word)
}

/// Reads a time such as `1d 2h 3m 4s`, in s.
fn duration_s(value: &str) -> Option<f64> {
    let mut sum_s = 0.0;
    for word in value.split_whitespace() {
        let (number, unit) = word.split_at_checked(word.len().checked_sub(1)?)?;
        let unit_s = match unit {
            "d" => 86_400.0,
            "h" => 3600.0,
            "m" => 60.0,
            "s" => 1.0,
            _ => return None,
        };
        sum_s += number.parse::<f64>().ok()? * unit_s;
    }
    Some(sum_s).filter(|sum_s| sum_s.is_finite() && *sum_s > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(comments: &[&str]) -> Facts {
        let mut notes = Notes::default();
        comments.iter().for_each(|comment| notes.take(comment));
        notes.finish()
    }

    #[test]
    fn prusa_s_notes_are_read() {
        let facts = facts(&[
            "generated by PrusaSlicer 2.5.0 on 2026-01-01",
            "external perimeters extrusion width = 0.45mm",
            "filament used [mm] = 1234.50, 20",
            "filament used [cm3] = 2.97, 0.05",
            "filament used [g] = 3.68, 0.06",
            "total filament used [g] = 3.74",
            "estimated printing time (normal mode) = 1d 2h 3m 4s",
            "estimated printing time (silent mode) = 9d",
            "filament_density = 1.24,1.27",
            "filament_diameter = 1.75,2.85",
            "fill_density = 15%",
            "layer_height = 0.2",
            "first_layer_height = 0.3",
            "perimeter_extrusion_width = 0",
            "infill_extrusion_width = 110%",
            "use_volumetric_e = 0",
            "gcode_flavor = marlin",
        ]);
        assert_eq!(facts.filament_used_mm, [1234.5, 20.0]);
        assert_eq!(facts.filament_used_g, [3.68, 0.06]);
        assert_eq!(facts.filament_used_mm3, [2970.0, 50.0]);
        assert_eq!(facts.filament_diameter_mm, [1.75, 2.85]);
        assert_eq!(facts.filament_density_g_cm3, [1.24, 1.27]);
        assert_eq!(facts.print_time_s, Some(93_784.0));
        assert_eq!(
            (facts.layer_height_mm, facts.first_layer_height_mm),
            (Some(0.2), Some(0.3))
        );
        assert_eq!(facts.infill_ratio, Some(0.15));
        assert_eq!(facts.line_widths.external_perimeter_mm, Some(0.45));
        assert_eq!(facts.line_widths.perimeter_mm, None);
        assert_eq!(facts.line_widths.infill_mm, None);
        assert_eq!(facts.is_volumetric, Some(false));
        assert_eq!(facts.flavor.as_deref(), Some("marlin"));
    }

    #[test]
    fn bambu_s_notes_are_read() {
        let facts = facts(&[
            "BambuStudio 01.09.07.52",
            "model printing time: 17m 8s; total estimated time: 22m 56s",
            "total layer number: 100",
            "total filament length [mm] : 19.37",
            "total filament weight [g] : 0.00",
            "filament_density: 0",
            "filament_density = 1.26",
            "sparse_infill_density = 20%",
            "outer_wall_line_width = 0.42",
        ]);
        assert_eq!(facts.print_time_s, Some(1376.0));
        assert_eq!(facts.layers, Some(100));
        assert_eq!(facts.filament_used_mm, [19.37]);
        assert!(facts.filament_used_g.is_empty());
        assert_eq!(facts.filament_density_g_cm3, [1.26]);
        assert_eq!(facts.infill_ratio, Some(0.2));
        assert_eq!(facts.line_widths.external_perimeter_mm, Some(0.42));
    }

    #[test]
    fn cura_s_notes_are_read_with_its_settings() {
        let facts = facts(&[
            "FLAVOR:Marlin",
            "TIME:6666",
            "Filament used: 1.5m, 0.25m",
            "Layer height: 0.2",
            "TIME_ELAPSED:10.5",
            "TIME_ELAPSED:99.5",
            "SETTING_3 {\"global_quality\": \"[values]\\\\nmaterial_diam",
            "SETTING_3 eter = 2.85\\\\ninfill_sparse_density = 30\\\\n\"}",
        ]);
        assert_eq!(facts.print_time_s, Some(99.5));
        assert_eq!(facts.filament_used_mm, [1500.0, 250.0]);
        assert_eq!(facts.filament_diameter_mm, [2.85]);
        assert_eq!(facts.infill_ratio, Some(0.3));
    }

    #[test]
    fn nonsense_states_nothing() {
        let nonsense = [
            "layer_height = -1",
            "layer_height = nan",
            "filament_diameter = 1e999",
            "filament_diameter = 1.75,0",
            "fill_density = 400%",
            "estimated printing time (normal mode) = soon",
            "filament used [g] = ",
            "Filament used: manym",
            "LAYER_COUNT:-3",
            "= : =",
            "é: é",
        ];
        assert_eq!(facts(&nonsense), Facts::default());
    }
}
