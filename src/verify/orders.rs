//! The orders of a package for a slicer, held against the kit's own: solid parts, and regions of
//! sparse infill as the sheet states them.

#[cfg(test)]
mod tests;

use std::ops::Range;

use super::{InfillLevel, InfillOrder, PrinterLimits, Promise};
use crate::io::threemf::{ObjectOrders, Orders, PlacedObject, SlicerOrders, VolumeOrders};
use crate::mesh::TriMesh;

/// The process whose parts a slicer would fill sparsely by itself.
const FILAMENT: &str = "fdm";
/// The setting of the density of infill, in PrusaSlicer's words.
const DENSITY: &str = "fill_density";
/// The setting of its pattern.
const PATTERN: &str = "fill_pattern";
/// The setting of the height of a layer.
const LAYER: &str = "layer_height";
/// The setting of the kind of a volume.
const KIND: &str = "volume_type";
/// The kind of a volume that is printed.
const PRINTED: &str = "ModelPart";
/// The kind of a volume in which other settings hold.
const MODIFIER: &str = "ParameterModifier";
/// Settings with which a slicer would lay walls or solid layers around a region.
const WALLS: [&str; 3] = ["perimeters", "interface_shells", "extra_perimeters"];
/// Per cent of a solid print.
const SOLID_PERCENT: f64 = 100.0;
/// Two densities are the same within this, per cent.
const SAME_PERCENT: f64 = 1e-6;
/// The volume of a region in single precision differs by no more than this share.
const SAME_VOLUME_RATIO: f64 = 1e-4;

/// The orders that the packages of a kit must give.
pub struct Wanted<'a> {
    /// The limits of the printer.
    pub printer: &'a PrinterLimits,
    /// The regions of sparse infill, with the id of the part that has them.
    pub infill: Option<(&'a InfillOrder, &'a str)>,
}

/// A package as it was read.
pub struct Ordered<'a> {
    /// Its file, relative to the kit.
    pub file: &'a str,
    /// Its objects, in the size in which they are printed.
    pub objects: &'a [PlacedObject],
    /// Its orders; `None` if it gives none.
    pub orders: Option<&'a SlicerOrders>,
}

impl<'a> Wanted<'a> {
    /// Returns the orders that the packages of a kit with these promises must give.
    pub fn of(promise: &'a Promise) -> Self {
        let part = promise.parts.first().map(|part| part.id.as_str());
        Self {
            printer: &promise.printer,
            infill: promise.infill.as_ref().zip(part),
        }
    }

    /// Returns the faults of a package's orders, in words; none for a process without infill.
    pub fn faults(&self, package: &Ordered) -> Vec<String> {
        if self.printer.process.as_deref() != Some(FILAMENT) {
            return Vec::new();
        }
        let file = package.file;
        let Some(orders) = package.orders else {
            return vec![format!("{file} does not say that its parts are solid")];
        };
        let mut faults = Vec::new();
        for object in package.objects {
            let name = &object.name;
            match orders.objects.get(&object.id) {
                None => faults.push(format!("{file} does not say that {name} is solid")),
                Some(found) => {
                    let own = self.object_faults(object, found);
                    faults.extend(
                        own.into_iter()
                            .map(|fault| format!("{file}: {name} {fault}")),
                    );
                }
            }
        }
        let has_regions = |object: &ObjectOrders| object.volumes.len() > 1;
        if !orders.moves_volumes && orders.objects.values().any(has_regions) {
            faults.push(format!("{file} leaves the regions of infill at the origin"));
        }
        faults
    }

    /// Returns what is wrong with the orders for one object, after its name.
    fn object_faults(&self, object: &PlacedObject, orders: &ObjectOrders) -> Vec<String> {
        let mut faults = Vec::new();
        let solid = percent(&orders.settings);
        if !solid.is_some_and(|found| is_same_percent(found, SOLID_PERCENT)) {
            let found = stated(&orders.settings, DENSITY);
            faults.push(format!("has an infill of {found}, not 100%"));
        }
        let layer = orders.settings.get(LAYER).map(|found| found.parse::<f64>());
        if let (Some(wanted), Some(found)) = (self.printer.layer_mm, layer)
            && found.as_ref() != Ok(&wanted)
        {
            let found = stated(&orders.settings, LAYER);
            faults.push(format!("has layers of {found} mm, not {wanted}"));
        }
        if !are_complete(&orders.volumes, object.mesh.triangles().len()) {
            faults.push("has volumes that do not share its triangles".to_owned());
            return faults;
        }
        let (body, regions) = match orders.volumes.split_first() {
            Some((body, regions)) => (Some(body), regions),
            None => (None, &[][..]),
        };
        faults.extend(body.and_then(body_fault));
        let infill = self.infill.filter(|(_, id)| *id == object.name);
        let levels = infill.map_or_else(Vec::new, |(infill, _)| infill.levels());
        match regions.len() {
            0 if infill.is_none() => {}
            _ if infill.is_none() => {
                faults.push("has regions of infill that the sheet does not".to_owned());
            }
            count if count == levels.len() => {
                let pairs = levels.iter().zip(regions);
                let own =
                    pairs.flat_map(|(level, region)| self.region_faults(level, region, object));
                faults.extend(own);
            }
            count => {
                let wanted = levels.len();
                faults.push(format!(
                    "has {count} volumes of sparse infill, not {wanted}"
                ));
            }
        }
        faults
    }

    /// Returns what is wrong with a region of sparse infill.
    fn region_faults(
        &self,
        level: &InfillLevel,
        region: &VolumeOrders,
        object: &PlacedObject,
    ) -> Vec<String> {
        let settings = &region.settings;
        let own_pattern = self.infill.map_or("none", |(infill, _)| &infill.pattern);
        let wanted = level.nominal_ratio * SOLID_PERCENT;
        let scale: f64 = self
            .printer
            .print_scale_ratio
            .map_or(1.0, |s| s.iter().product());
        let volume_mm3 = -volume_mm3(&object.mesh, &region.triangles) / scale;
        let is_own = (volume_mm3 / level.volume_mm3 - 1.0).abs() <= SAME_VOLUME_RATIO;
        let kind = stated(settings, KIND);
        let [density, pattern] = [DENSITY, PATTERN].map(|key| stated(settings, key));
        let walls = WALLS.into_iter().filter(|key| settings.contains_key(*key));
        let faults = [
            (kind != MODIFIER).then(|| format!("has a region that is a {kind}, not a {MODIFIER}")),
            (!percent(settings).is_some_and(|found| is_same_percent(found, wanted)))
                .then(|| format!("has a region with an infill of {density}, not {wanted}%")),
            (pattern != own_pattern)
                .then(|| format!("has a region filled with {pattern}, not {own_pattern}")),
            (!is_own).then(|| {
                let wanted_mm3 = level.volume_mm3;
                format!("has a region of {volume_mm3:.1} mm³, not {wanted_mm3:.1}")
            }),
        ];
        let walls = walls.map(|key| format!("has walls around its region ({key})"));
        faults.into_iter().flatten().chain(walls).collect()
    }
}

/// Returns what is wrong with the printed volume of an object.
fn body_fault(body: &VolumeOrders) -> Option<String> {
    let settings = &body.settings;
    let is_printed = settings.get(KIND).is_none_or(|kind| kind == PRINTED);
    let has_own = [DENSITY, PATTERN, LAYER]
        .iter()
        .any(|key| settings.contains_key(*key));
    (!is_printed || has_own).then(|| "has a body with orders of its own".to_owned())
}

/// Returns whether volumes share the triangles of an object, each once and in order. An object may
/// have no volumes: it is one then.
fn are_complete(volumes: &[VolumeOrders], triangles: usize) -> bool {
    if volumes.is_empty() {
        return true;
    }
    let mut next = 0;
    let follows = volumes.iter().all(|volume| {
        let is_next = volume.triangles.start == next && volume.triangles.end > next;
        next = volume.triangles.end;
        is_next
    });
    follows && next == triangles
}

/// Returns a density as the slicer reads it, per cent. Without its sign it would be a multiple of
/// solid print.
fn percent(settings: &Orders) -> Option<f64> {
    let text = settings.get(DENSITY)?.strip_suffix('%')?;
    text.parse().ok()
}

fn is_same_percent(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_PERCENT
}

/// Returns a setting as it is stated.
fn stated<'a>(settings: &'a Orders, key: &str) -> &'a str {
    settings.get(key).map_or("none", String::as_str)
}

/// Returns the signed volume inside of some triangles that bound a region, mm³.
fn volume_mm3(mesh: &TriMesh, triangles: &Range<usize>) -> f64 {
    let bounding = mesh.triangles().get(triangles.clone()).unwrap_or_default();
    let corner = |index: u32| mesh.vertices()[index as usize].coords;
    let six_fold = bounding.iter().map(|t| {
        let [a, b, c] = t.map(corner);
        a.dot(&b.cross(&c))
    });
    six_fold.sum::<f64>() / 6.0
}
