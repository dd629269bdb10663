//! Finds the causes of a wrong print, in the moves first and in the statements of slicers second.

use super::cause::{Cause, CauseKind};
use super::density::Densities;
use super::limits::{
    DENSITY_RATIO, EDGE_MM, EDGE_RATIO, EXTRA_SKIN_MM, FLOW_LIMIT_RATIO, LACKING_SKIN_MM,
    LAYER_RATIO, LINE_RATIO, LONE_EDGE_LOSS, PRINTED_MASS_LIMIT_RATIO, SPREAD_SHARE, SUPPORT_RATIO,
    WHOLE_SPREAD_SHARE, WRONG_LAYER_RATIO,
};
use super::part::PrintedPart;
use super::source::Source;
use crate::verify::{InfillLevel, Promise};

/// The process whose lines have a width.
const FILAMENT: &str = "fdm";
/// Share of sparse infill in a part from which its infill counts as sparse.
const SPARSE_RATIO: f64 = 0.01;
/// The density of a part's infill is that which the file states within this.
const STATED_INFILL_RATIO: f64 = 0.1;
/// Density below which infill counts as sparse though no file states it. Slicers label solid infill
/// as infill too, which looks like 64 % and more at a flow of 90 %.
const DENSE_RATIO: f64 = 0.6;

/// What to do about images with more or less than the parts.
const IMAGES_REMEDY: &str = "slice without support, raft and pad, which images do not tell from the parts, and set corrections \
     of size and first layers to none";

/// The parts of one source.
pub(super) struct Printed<'a> {
    /// The promise of the kit.
    pub(super) promise: &'a Promise,
    /// The source.
    pub(super) source: &'a Source,
    /// The parts in it.
    pub(super) parts: Vec<&'a PrintedPart>,
}

/// Returns the cause that parts are in no file; `None` if none is missing.
pub(super) fn missing_cause(missing: &[String], promise: &Promise) -> Option<Cause> {
    let plates = promise.plates.iter().filter(|plate| {
        let mut holds = plate.holds.iter();
        holds.any(|spot| missing.contains(&spot.id))
    });
    let plates: Vec<&str> = plates.map(|plate| plate.file.as_str()).collect();
    let remedy = match plates.as_slice() {
        [] => "slice the missing parts, and give their files too".to_owned(),
        plates => format!(
            "put all parts on their plates and slice {} again, or give the file of every plate",
            plates.join(" and ")
        ),
    };
    (!missing.is_empty()).then(|| Cause {
        kind: CauseKind::Missing,
        file: None,
        parts: missing.to_vec(),
        finding: format!("{} in no file", are(missing)),
        remedy,
        is_wrong: true,
    })
}

impl Printed<'_> {
    /// Returns all causes of this source.
    pub(super) fn causes(&self) -> Vec<Cause> {
        let causes = [
            self.mirror(),
            self.scale(),
            self.infill(),
            self.layer_height(),
            self.line_width(),
            self.density(),
            self.flow(),
            self.set_flow(),
            self.support(),
        ];
        causes.into_iter().flatten().collect()
    }

    /// Makes a cause of the parts for which a finding holds; `None` if there is none.
    fn cause(
        &self,
        kind: CauseKind,
        parts: &[&PrintedPart],
        finding: String,
        remedy: String,
    ) -> Option<Cause> {
        (!parts.is_empty()).then(|| Cause {
            kind,
            file: Some(self.source.name.clone()),
            parts: parts.iter().map(|part| part.id.clone()).collect(),
            finding,
            remedy,
            is_wrong: kind != CauseKind::SupportInVoid,
        })
    }

    fn those(&self, is_it: impl Fn(&PrintedPart) -> bool) -> Vec<&PrintedPart> {
        let parts = self.parts.iter().copied();
        parts.filter(|part| is_it(part)).collect()
    }

    fn mirror(&self) -> Option<Cause> {
        let parts = self.those(|part| part.is_mirrored);
        let finding = format!("{} printed as a mirror image", are(&ids(&parts)));
        let remedy = "load the kit's own file, and do not mirror it in the slicer";
        self.cause(CauseKind::Mirror, &parts, finding, remedy.to_owned())
    }

    fn scale(&self) -> Option<Cause> {
        let parts = self.those(|part| is_scaled(part, self.promise));
        let percents = |part: &PrintedPart| {
            let [x, y, z] = part.size_ratio.map(|ratio| ratio * 100.0);
            format!("{} has {x:.1} × {y:.1} × {z:.1} %", part.id)
        };
        let listed: Vec<String> = parts.iter().map(|part| percents(part)).collect();
        let finding = format!("{} of the size of its file", listed.join(", "));
        let remedy = "print at 100 %: the kit's files have the right size";
        self.cause(CauseKind::Scale, &parts, finding, remedy.to_owned())
    }

    fn infill(&self) -> Option<Cause> {
        self.lost_region().or_else(|| self.sparse())
    }

    /// Returns the cause that a region of sparse infill is printed solid.
    fn lost_region(&self) -> Option<Cause> {
        let infill = self.promise.infill.as_ref()?;
        let is_solid = |part: &PrintedPart| part.sparse_ratio < SPARSE_RATIO;
        let parts = self.those(|part| wrong_ratio(part, self.promise) > 0.0 && is_solid(part));
        let finding = format!(
            "{} solid: the region of sparse infill is lost",
            are(&ids(&parts))
        );
        let modifier = |level: &InfillLevel| {
            let file = level.file.as_deref().unwrap_or("the region");
            let percent = 100.0 * level.nominal_ratio;
            format!(
                "{file} to the part as a modifier with {percent:.1} % {} infill",
                infill.pattern
            )
        };
        let modifiers: Vec<String> = infill.levels().iter().map(modifier).collect();
        let remedy = format!(
            "slice the kit's plate with {}, or add {}",
            self.promise.printer.dialect.slicers(),
            modifiers.join(", then ")
        );
        self.cause(CauseKind::Infill, &parts, finding, remedy)
    }

    /// Returns the cause that what is meant to be solid is printed with sparse infill.
    fn sparse(&self) -> Option<Cause> {
        let stated = self.source.toolpath.facts.infill_ratio;
        let says_sparse = stated.is_some_and(|ratio| ratio < 1.0);
        let is_as_stated = |part: &PrintedPart| {
            let laid = infill_density_ratio(part, self.promise);
            let both = stated.filter(|_| says_sparse).zip(laid);
            both.is_some_and(|(stated, laid)| (stated - laid).abs() < STATED_INFILL_RATIO)
        };
        let parts = self.those(|part| {
            wrong_ratio(part, self.promise) < 0.0
                && (is_as_stated(part) || is_sparse(part, self.promise))
        });
        let says = match stated {
            Some(ratio) if says_sparse => format!(", and the file states {:.0} %", ratio * 100.0),
            _ => String::new(),
        };
        let least = parts.iter().map(|part| filled_ratio(part, self.promise));
        let least = least.fold(f64::INFINITY, f64::min) * 100.0;
        let finding = format!(
            "{} not solid: its lines fill {least:.0} % of a part{says}",
            are(&ids(&parts))
        );
        let setting = CauseKind::Infill.setting(self.source.slicer());
        let why = match self.promise.infill {
            Some(_) => "only the kit's own region is sparse",
            None => "the kit has its own voids",
        };
        let remedy = format!("set {setting} to 100 %: {why}");
        self.cause(CauseKind::Infill, &parts, finding, remedy)
    }

    fn layer_height(&self) -> Option<Cause> {
        let wanted_mm = self
            .promise
            .printer
            .layer_mm
            .filter(|_| self.is_filament() || self.source.is_images)?;
        let is_other = |mm: f64| (mm / wanted_mm - 1.0).abs() > LAYER_RATIO;
        let parts = self.those(|part| part.layer_mm.is_some_and(is_other));
        let found_mm = parts.first().and_then(|part| part.layer_mm)?;
        let stated = self.source.toolpath.facts.layer_height_mm;
        let found_mm = stated.filter(|mm| is_other(*mm)).unwrap_or(found_mm);
        let finding = format!(
            "layers of {found_mm:.2} mm, where the kit asks for {wanted_mm} mm, in {}",
            ids(&parts).join(", ")
        );
        let setting = CauseKind::LayerHeight.setting(self.source.slicer());
        let remedy = format!("set {setting} to {wanted_mm} mm");
        let cause = self.cause(CauseKind::LayerHeight, &parts, finding, remedy)?;
        Some(Cause {
            is_wrong: (found_mm / wanted_mm - 1.0).abs() > WRONG_LAYER_RATIO,
            ..cause
        })
    }

    fn line_width(&self) -> Option<Cause> {
        let pixel_mm = self
            .promise
            .printer
            .pixel_mm
            .filter(|_| self.is_filament())?;
        let wanted_mm = pixel_mm[0];
        let is_other = |mm: f64| (mm / wanted_mm - 1.0).abs() > LINE_RATIO;
        let parts = self.those(|part| part.line_mm.is_some_and(is_other));
        let found_mm = parts.first().and_then(|part| part.line_mm)?;
        let finding = format!(
            "lines of {found_mm:.2} mm, where the kit asks for {wanted_mm} mm, in {}",
            ids(&parts).join(", ")
        );
        let setting = CauseKind::LineWidth.setting(self.source.slicer());
        let remedy = format!("set {setting} to {wanted_mm} mm");
        self.cause(CauseKind::LineWidth, &parts, finding, remedy)
    }

    fn density(&self) -> Option<Cause> {
        let wanted = self.promise.material.density_g_cm3;
        let densities = Densities::of(self.source, self.promise);
        let is_other = |density: &f64| (density / wanted - 1.0).abs() > DENSITY_RATIO;
        let objects = self.source.toolpath.objects.iter();
        let laid = objects.flat_map(|object| object.deposits.part());
        let laid = laid.filter(|tally| tally.moments.volume() > 0.0);
        let mut stated = laid.filter_map(|tally| densities.stated_of(tally.tool));
        let found = stated.find(is_other)?;
        let finding = format!(
            "the file states a filament of {found} g/cm³, where the kit asks for {wanted} g/cm³"
        );
        let setting = CauseKind::Density.setting(self.source.slicer());
        let remedy = format!(
            "use the kit's material; or set {setting} to {wanted} if that is its density; or \
             prepare the kit again with this filament's density"
        );
        self.cause(CauseKind::Density, &self.parts, finding, remedy)
    }

    /// Returns the cause that the file sets a flow that calibrates no machine.
    fn set_flow(&self) -> Option<Cause> {
        let ratio = self.source.toolpath.flow_ratio();
        let parts = self.those(|_| (ratio - 1.0).abs() > FLOW_LIMIT_RATIO);
        let finding = format!("the file sets a flow of {:.0} % (M221)", ratio * 100.0);
        let remedy = "set the flow to 100 % on the machine and in the slicer";
        self.cause(CauseKind::Flow, &parts, finding, remedy.to_owned())
    }

    fn flow(&self) -> Option<Cause> {
        let sparse = self.infill();
        let parts = self.those(|part| {
            let is_sparse = |cause: &Cause| cause.parts.contains(&part.id);
            wrong_ratio(part, self.promise) != 0.0 && !sparse.as_ref().is_some_and(is_sparse)
        });
        let listed = parts.iter().map(|part| {
            let percent = filled_ratio(part, self.promise) * 100.0;
            format!("{} has {percent:.1} %", part.id)
        });
        let listed: Vec<String> = listed.collect();
        let finding = format!("{} of the material of its solid", listed.join(", "));
        let setting = CauseKind::Flow.setting(self.source.slicer());
        let remedy = if self.source.is_images {
            IMAGES_REMEDY.to_owned()
        } else {
            format!(
                "check {setting}, the density of infill, the scale, the width of lines and the \
                 diameter of filament"
            )
        };
        self.cause(CauseKind::Flow, &parts, finding, remedy)
    }

    fn support(&self) -> Option<Cause> {
        let parts = self.those(|part| part.support_in_voids_mm3 > SUPPORT_RATIO * part.volume_mm3);
        let listed = parts.iter().map(|part| {
            let density_g_mm3 = self.promise.material.density_g_cm3 * 1e-3;
            let mass_g = part.support_in_voids_mm3 * density_g_mm3;
            format!("{mass_g:.2} g in {}", part.id)
        });
        let listed: Vec<String> = listed.collect();
        let finding = format!("support inside voids, {}", listed.join(", "));
        let remedy = "take it out before the parts are glued";
        self.cause(CauseKind::SupportInVoid, &parts, finding, remedy.to_owned())
    }

    fn is_filament(&self) -> bool {
        self.promise.printer.process.as_deref() == Some(FILAMENT)
    }
}

/// Returns true if a part has another size than its file.
///
/// Edges across the layers are known to a part of a line, those along z to a layer. Slicers leave
/// out thin tips, which makes edges shorter: then the spread of the material must say the same. A
/// thin lid on its rim lost 1.3 % of an edge, and its spreads missed by up to 2.1 %.
pub(super) fn is_scaled(part: &PrintedPart, promise: &Promise) -> bool {
    let layer_mm = part.layer_mm.or(promise.printer.layer_mm).unwrap_or(0.0);
    // A part without lines is made of pixels, and its edges are known to one.
    let pixel_mm = promise.printer.pixel_mm.filter(|_| part.line_mm.is_none());
    let [x_mm, y_mm] = pixel_mm.unwrap_or([0.0; 2]);
    let limits_mm = [EDGE_MM + x_mm, EDGE_MM + y_mm, EDGE_MM + layer_mm];
    // Each edge in units of its limit.
    let longer = [0, 1, 2].map(|axis| {
        let limit_mm = limits_mm[axis] + EDGE_RATIO * part.edges_mm[axis];
        (part.size_ratio[axis] - 1.0) * part.edges_mm[axis] / limit_mm
    });
    let edge_loss = part.size_ratio.map(|ratio| 1.0 - ratio);
    let spread_loss = part.spread_ratio.map(|ratio| 1.0 - ratio);
    let is_whole_less = spread_loss.iter().sum::<f64>()
        > WHOLE_SPREAD_SHARE * edge_loss.iter().sum::<f64>()
        && longer.iter().filter(|longer| **longer < -0.5).count() > 1;
    // Spreads that miss as much along the other edges tell nothing along this one.
    let strays = |axis: usize, loss: f64| {
        (0..3).any(|b| b != axis && (spread_loss[b] - edge_loss[b]).abs() > loss)
    };
    (0..3).any(|axis| {
        let is_axis_less = edge_loss[axis] > LONE_EDGE_LOSS
            && spread_loss[axis] > SPREAD_SHARE * edge_loss[axis]
            && !strays(axis, edge_loss[axis]);
        longer[axis] > 1.0 || longer[axis] < -1.0 && (is_axis_less || is_whole_less)
    })
}

/// Returns true if what a part lacks is missing in its infill, rather than in all of its lines.
fn is_sparse(part: &PrintedPart, promise: &Promise) -> bool {
    infill_density_ratio(part, promise).is_some_and(|ratio| ratio < DENSE_RATIO)
}

/// Returns the density of a part's infill if all that is missing were missing there; `None` if it
/// has no infill.
fn infill_density_ratio(part: &PrintedPart, promise: &Promise) -> Option<f64> {
    let filled = filled_ratio(part, promise);
    let laid = filled * part.sparse_ratio;
    (part.sparse_ratio > SPARSE_RATIO).then(|| laid / (laid + 1.0 - filled))
}

/// Returns the volume of a part's lines over that of its solid at the size in which it is printed.
fn filled_ratio(part: &PrintedPart, promise: &Promise) -> f64 {
    if is_scaled(part, promise) {
        part.volume_ratio / part.size_ratio.iter().product::<f64>()
    } else {
        part.volume_ratio
    }
}

/// Returns the volume that is missing or too much, as a share.
///
/// It is 0 if it is within what slicers lay wrong along the surface of any part.
fn wrong_ratio(part: &PrintedPart, promise: &Promise) -> f64 {
    // A kit that was sliced says what is laid beyond its surfaces, and `verify` bounds that.
    let said = part.nominal_mass_g / part.written_mass_g;
    let off = filled_ratio(part, promise) * said - 1.0;
    let skin_mm = if off < 0.0 {
        LACKING_SKIN_MM
    } else {
        EXTRA_SKIN_MM
    };
    let most = PRINTED_MASS_LIMIT_RATIO.max(skin_mm * part.surface_per_mm);
    if off.abs() > most { off } else { 0.0 }
}

fn ids(parts: &[&PrintedPart]) -> Vec<String> {
    parts.iter().map(|part| part.id.clone()).collect()
}

/// Returns names with "is" or "are".
fn are(names: &[String]) -> String {
    let verb = if names.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", names.join(", "))
}
