//! Requests for cuts that a printer can make.

use crate::base::watch::Watch;
use crate::cut::joints::shelf::JigShelf;
use crate::cut::least_part::LeastPart;
use crate::cut::request::{GoalAxis, LabelStyle, PinSettings, PlanRequest, PosePreference};
use crate::cut::seam::rules::Seams;
use crate::mesh::TriMesh;
use crate::printer::{Grid, PrintPose, Printer, Quantity, Support};

impl PlanRequest {
    /// Least share of all voids' walls that a cut for cleaning alone must bring into sight. Below
    /// it a kit gets extra joints and tiny parts for no gain.
    pub const WORTH_RATIO: f64 = 0.02;

    /// The usual score of a part beyond two. Each is one more to print, clean and glue.
    pub const PART_WEIGHT: f64 = 0.3;

    /// Least distance of a joint's farthest pins, as a share of its longest diagonal. Whoever puts
    /// the parts together must feel the turn.
    pub const SPREAD_RATIO: f64 = 1.0 / 3.0;

    /// Returns whether a part with this volume of material is below the least. It is too light
    /// against all parts together, or too short for pins.
    pub(crate) fn is_small_part(&self, volume_mm3: f64, part: &TriMesh, whole_mm3: f64) -> bool {
        let pin_mm = self.pins.length_ratio * self.pins.min_diameter_mm;
        let is_light = volume_mm3 < self.least_part.mass_ratio() * whole_mm3;
        is_light || part.aabb().size().max() < self.least_part.length_mm(pin_mm)
    }

    /// Returns the request for a model whose longest side is `size_mm`, with the printer's walls,
    /// openings, pins and grid.
    ///
    /// Cuts keep away from the point of `axis`. Pins are printed, and ids are sunk into the cut
    /// faces. Of a seam only the length counts, and nobody watches. Change `rods`, `labels`,
    /// `seams` and `watch` for anything else.
    pub fn for_printer(printer: &Printer, size_mm: f64, axis: GoalAxis) -> Self {
        let elephant_foot = printer.number(Quantity::ElephantFootMm);
        let elephant_foot_mm = elephant_foot.map_or(0.0, |foot| foot.value);
        let pixel_mm = printer.pixel_x_mm.value.max(printer.pixel_y_mm.value);
        Self {
            worth_ratio: Self::WORTH_RATIO,
            part_weight: Self::PART_WEIGHT,
            wants_wide_joints: false,
            min_opening_mm: printer.min_opening_mm.value,
            cleaning: printer.cleaning_rule(),
            build_volume_mm: printer.usable_volume_mm(),
            wall_mm: printer.least_wall_mm(size_mm).value,
            pins: PinSettings {
                min_diameter_mm: printer.pin_min_diameter_mm.value,
                length_ratio: printer.pin_length_ratio.value,
                clearance_mm: printer.clearance_per_side_mm.value,
                // The chamfer must be wider than the elephant foot at the mouth of a socket on the
                // plate.
                chamfer_mm: printer.chamfer_mm.value.max(elephant_foot_mm),
                bottom_relief_mm: printer.socket_extra_depth_mm.value,
                spread_ratio: Self::SPREAD_RATIO,
                snug_gap_mm: printer.snug_gap_mm(),
                max_step_mm: printer.number(Quantity::SeamStepMm).map(|step| step.value),
            },
            axis,
            pixel_mm,
            hole_step_mm: if printer.grid == Grid::Pixel {
                pixel_mm
            } else {
                0.0
            },
            layer_mm: printer.layer_mm.value,
            pose: PosePreference::for_printer(printer),
            rods: Vec::new(),
            labels: Some(LabelStyle::for_printer(printer)),
            seams: Seams::default(),
            least_part: LeastPart::USUAL,
            jigs: JigShelf::default(),
            watch: Watch::silent(),
        }
    }
}

impl PosePreference {
    /// Returns the pose that suits the printer's support. Powder carries every part, so that its
    /// parts lie on their cut faces.
    fn for_printer(printer: &Printer) -> Self {
        match (printer.print_pose, printer.grid, printer.support) {
            (PrintPose::OpenHollowsUp, ..) => Self::OpenHollowUp,
            (_, _, Support::None) => Self::CutFaceDown,
            (_, Grid::Line, _) => Self::LittleSupport,
            (_, Grid::Pixel, _) => Self::Tilted,
        }
    }
}

impl LabelStyle {
    /// Returns strokes as wide as the printer's least detail, or two pixels if that is more. They
    /// are as deep as the least detail, in whole layers.
    pub fn for_printer(printer: &Printer) -> Self {
        let pixel_mm = printer.pixel_x_mm.value.max(printer.pixel_y_mm.value);
        let feature_mm = printer.min_feature_mm.value;
        let layers = (feature_mm / printer.layer_mm.value).ceil();
        Self {
            stroke_mm: feature_mm.max(2.0 * pixel_mm),
            depth_mm: layers * printer.layer_mm.value,
            numbered: 0,
        }
    }
}
