//! A printer's profile in a slicer's words.

use std::f64::consts::FRAC_PI_4;
use std::fmt::Write as _;

use crate::base::units::MM3_PER_CM3;
use crate::base::walls::Walls;
use crate::printer::{Material, Printer};

/// The process whose plates are sliced.
const FILAMENT: &str = "fdm";
/// Width of a line over the nozzle's diameter: what slicers lay by default.
const LINE_PER_NOZZLE: f64 = 1.125;
/// The diameter of nearly all filament that is sold, mm.
pub(super) const FILAMENT_MM: f64 = 1.75;

/// Steps to which slicers state a mass, in a gram.
const MASS_DECIMALS: f64 = 100.0;

/// The keys for the widths of the lines of parts, besides the usual width.
const LINE_KEYS: [&str; 5] = [
    "perimeter_extrusion_width",
    "external_perimeter_extrusion_width",
    "infill_extrusion_width",
    "solid_infill_extrusion_width",
    "top_infill_extrusion_width",
];
/// The keys by which parts become larger, smaller or hollow.
const SIZE_KEYS: [&str; 2] = ["xy_size_compensation", "spiral_vase"];

/// What a slicer must know of a printer and its material.
///
/// The plate's own file says what else the parts need. Speeds are the slicer's defaults.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceSettings {
    /// Width, depth and height of the build volume, mm.
    room_mm: [f64; 3],
    /// Height of a layer, mm.
    layer_mm: f64,
    /// Width of a line, mm.
    line_mm: f64,
    /// The lines and layers that are laid solid.
    walls: Walls,
    /// Density of the filament, g/cm³.
    density_g_cm3: f64,
    /// Flow of the filament over that of its lines; `None` for what the slicer's own profile says.
    flow_ratio: Option<f64>,
    /// A profile of the slicer, whose settings hold where these say nothing; `None` for its own.
    profile: Option<String>,
}

impl SliceSettings {
    /// Returns the settings of a filament printer; `None` for other processes, and if its plate is
    /// not known.
    pub fn of(printer: &Printer, material: &Material) -> Option<Self> {
        let room_mm = printer.build_volume_mm.as_ref()?.value;
        (printer.process.as_deref() == Some(FILAMENT)).then_some(Self {
            room_mm,
            layer_mm: printer.layer_mm.value,
            line_mm: printer.pixel_x_mm.value,
            walls: printer.walls(),
            density_g_cm3: material.density_g_cm3.value,
            flow_ratio: material.flow_ratio.as_ref().map(|flow| flow.value),
            profile: None,
        })
    }

    /// Returns the same settings over a profile of the slicer: lines of `key = value`.
    #[must_use]
    pub fn over(self, profile: Option<String>) -> Self {
        Self { profile, ..self }
    }

    /// Returns the density of the filament, g/cm³.
    pub fn density_g_cm3(&self) -> f64 {
        self.density_g_cm3
    }

    /// Returns the flow of the filament over that of its lines; `None` if the slicer's profile has
    /// it.
    pub(super) fn flow_ratio(&self) -> Option<f64> {
        self.flow_ratio
    }

    /// Returns the mass of a length of filament in mm, g.
    pub(super) fn filament_g(&self, length_mm: f64) -> f64 {
        let section_mm2 = FRAC_PI_4 * FILAMENT_MM * FILAMENT_MM;
        let mass_g = length_mm * section_mm2 * self.density_g_cm3 / MM3_PER_CM3;
        (mass_g * MASS_DECIMALS).round() / MASS_DECIMALS
    }

    /// Returns the width, depth and height of the build volume, mm.
    pub(super) fn room_mm(&self) -> [f64; 3] {
        self.room_mm
    }

    /// Returns the height of a layer, mm.
    pub(super) fn layer_mm(&self) -> f64 {
        self.layer_mm
    }

    /// Returns the width of a line, mm.
    pub(super) fn line_mm(&self) -> f64 {
        self.line_mm
    }

    /// Returns the lines and layers that are laid solid.
    pub(super) fn walls(&self) -> Walls {
        self.walls
    }

    /// Returns the diameter of the nozzle, mm.
    pub(super) fn nozzle_mm(&self) -> f64 {
        self.line_mm / LINE_PER_NOZZLE
    }

    /// Returns the profile of the slicer over which they hold.
    pub(super) fn profile(&self) -> Option<&str> {
        self.profile.as_deref()
    }

    /// Returns the settings as PrusaSlicer and SuperSlicer read them.
    pub(super) fn to_ini(&self) -> String {
        let [width, depth, height] = self.room_mm;
        let nozzle_mm = self.nozzle_mm();
        let pairs = [
            (
                "bed_shape",
                format!("0x0,{width}x0,{width}x{depth},0x{depth}"),
            ),
            ("max_print_height", height.to_string()),
            ("nozzle_diameter", format!("{nozzle_mm:.3}")),
            ("filament_diameter", FILAMENT_MM.to_string()),
            ("filament_density", self.density_g_cm3.to_string()),
            ("extrusion_width", self.line_mm.to_string()),
            ("layer_height", self.layer_mm.to_string()),
            ("first_layer_height", self.layer_mm.to_string()),
            ("gcode_flavor", "marlin2".to_owned()),
            ("gcode_label_objects", "1".to_owned()),
        ];
        // A shop's profile has a width for every kind of line, and may change sizes.
        let line = || self.line_mm.to_string();
        let widths = LINE_KEYS.iter().map(|key| (*key, line()));
        let flow = self.flow_ratio.iter();
        let flow = flow.map(|ratio| ("extrusion_multiplier", ratio.to_string()));
        let sizes = SIZE_KEYS.iter().map(|key| (*key, "0".to_owned()));
        let pairs = pairs.into_iter().chain(widths).chain(sizes).chain(flow);
        pairs.fold(String::new(), |mut ini, (key, value)| {
            // Writing into a string cannot fail.
            let _ = writeln!(ini, "{key} = {value}");
            ini
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(id: &str) -> Option<SliceSettings> {
        let printer = Printer::find(id).unwrap();
        let material = printer.material(None).unwrap();
        SliceSettings::of(&printer, material)
    }

    #[test]
    fn a_filament_printer_is_worded_with_its_plate_its_lines_and_its_density() {
        let ini = of("prusa-mk4").unwrap().to_ini();
        for line in [
            "bed_shape = 0x0,250x0,250x210,0x210",
            "nozzle_diameter = 0.400",
            "filament_density = 1.24",
            "layer_height = 0.2",
        ] {
            assert!(ini.lines().any(|found| found == line), "{line}: {ini}");
        }
    }

    #[test]
    fn the_flow_of_a_filament_is_set_where_the_profile_says_one() {
        let settings = of("prusa-mk4").unwrap();
        let has_flow =
            |settings: &SliceSettings| settings.to_ini().contains("extrusion_multiplier");
        assert!(!has_flow(&settings), "a shop's own profile has it");
        let flow_ratio = Some(0.97);
        let own = SliceSettings {
            flow_ratio,
            ..settings
        };
        assert!(own.to_ini().contains("extrusion_multiplier = 0.97\n"));
    }

    #[test]
    fn other_processes_have_no_such_settings() {
        assert_eq!(of("formlabs-form3"), None);
    }
}
