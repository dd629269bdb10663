//! Heights of beads: stated in the file, or found from the layers.

/// The height taken if a file tells nothing and a bead lies on the plate's level, mm.
const USUAL_MM: f64 = 0.2;
/// Steps between layers that are believed, as multiples of the file's layer height.
const BELIEVED: [f64; 2] = [0.49, 4.01];
/// Heights that a file may state, mm.
const STATED_MM: [f64; 2] = [1e-3, 100.0];
/// Rise that begins a new layer in a file without marks of layers, mm.
const STEP_MM: f64 = 1e-4;

/// Follows the layers of a file.
///
/// A stated height counts (`;HEIGHT:`, `; LAYER_HEIGHT:`). Cura states none. There the height is
/// the rise over the layer before, or over the plate, from half to four times the file's layer
/// height. Beyond these, as in a spiral vase, the layer height itself counts.
#[derive(Debug, Default)]
pub struct Heights {
    stated_mm: Option<f64>,
    top_mm: f64,
    below_mm: f64,
    has_marks: bool,
    layers: u64,
}

impl Heights {
    /// Takes the height that the file states for the beads that follow; passes over nonsense.
    pub fn state(&mut self, value: &str) {
        let height_mm = value.trim().parse::<f64>().ok();
        let height_mm = height_mm.filter(|mm| (STATED_MM[0]..=STATED_MM[1]).contains(mm));
        self.stated_mm = height_mm.or(self.stated_mm);
    }

    /// Takes a mark of a new layer.
    pub fn begin_layer(&mut self) {
        self.has_marks = true;
        self.layers += 1;
        self.below_mm = self.top_mm;
    }

    /// Returns the number of layers begun so far.
    pub fn layers(&self) -> u64 {
        self.layers
    }

    /// Returns the height of a bead whose top lies at `z_mm`, mm; always positive.
    pub fn of_bead_mm(&mut self, z_mm: f64, usual_mm: Option<f64>) -> f64 {
        if !self.has_marks && (z_mm - self.top_mm).abs() > STEP_MM {
            self.layers += 1;
            self.below_mm = self.top_mm;
        }
        self.top_mm = z_mm;
        if z_mm <= self.below_mm {
            // The next object of a plate printed one by one starts on the plate again.
            self.below_mm = 0.0;
        }
        let rise_mm = z_mm - self.below_mm;
        let usual_mm = usual_mm.filter(|mm| (STATED_MM[0]..=STATED_MM[1]).contains(mm));
        let is_believed = match usual_mm {
            Some(mm) => (BELIEVED[0] * mm..=BELIEVED[1] * mm).contains(&rise_mm),
            None => (STATED_MM[0]..=STATED_MM[1]).contains(&rise_mm),
        };
        let found_mm = if is_believed {
            rise_mm
        } else {
            usual_mm.unwrap_or(USUAL_MM)
        };
        self.stated_mm.unwrap_or(found_mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(got: f64, want: f64) {
        assert!((got - want).abs() < 1e-12, "{got} {want}");
    }

    #[test]
    fn a_stated_height_counts_and_nonsense_does_not() {
        let mut heights = Heights::default();
        heights.state("0.15");
        for nonsense in ["0", "-1", "nan", "1e308", "thick"] {
            heights.state(nonsense);
        }
        close(heights.of_bead_mm(10.0, Some(0.3)), 0.15);
    }

    #[test]
    fn without_a_statement_the_rise_over_the_layer_before_counts() {
        let mut heights = Heights::default();
        for (z, want) in [
            (0.3, 0.3),
            (0.5, 0.2),
            (0.5, 0.2),
            (0.6, 0.1),
            (0.3, 0.3),
            (0.5, 0.2),
        ] {
            close(heights.of_bead_mm(z, None), want);
        }
        assert_eq!(heights.layers(), 5);
    }

    #[test]
    fn a_spiral_and_a_gap_have_the_layer_height_of_the_file() {
        let mut heights = Heights::default();
        heights.begin_layer();
        close(heights.of_bead_mm(0.2, Some(0.2)), 0.2);
        heights.begin_layer();
        close(heights.of_bead_mm(0.201, Some(0.2)), 0.2);
        close(heights.of_bead_mm(0.399, Some(0.2)), 0.199);
        heights.begin_layer();
        close(heights.of_bead_mm(2.0, Some(0.2)), 0.2);
        assert_eq!(heights.layers(), 3);
    }
}
