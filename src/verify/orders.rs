//! The orders of a package for a slicer, held against the kit's own: solid parts, and regions of
//! sparse infill as the sheet states them.

#[cfg(test)]
mod tests;

use std::ops::Range;

use super::{InfillLevel, InfillOrder, PrinterLimits, Promise};
use crate::io::threemf::{ObjectOrders, Orders, PlacedObject, SlicerOrders, VolumeOrders, Words};
use crate::mesh::TriMesh;

/// The process whose parts a slicer would fill sparsely by itself.
const FILAMENT: &str = "fdm";
/// Lines along the edge of a region.
const NO_WALLS: &str = "0";
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
    /// Its orders, in every dialect that it has.
    pub orders: &'a [SlicerOrders],
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
        let own = |orders: &&SlicerOrders| orders.dialect == self.printer.dialect;
        if !package.orders.iter().any(|orders| own(&orders)) {
            let (file, slicers) = (package.file, self.printer.dialect.slicers());
            return vec![format!(
                "{file} does not say to {slicers} that its parts are solid"
            )];
        }
        let each = package.orders.iter();
        each.flat_map(|orders| self.dialect_faults(package, orders))
            .collect()
    }

    /// Returns the faults of a package's orders in one dialect.
    fn dialect_faults(&self, package: &Ordered, orders: &SlicerOrders) -> Vec<String> {
        let file = package.file;
        let mut faults = Vec::new();
        for object in package.objects {
            let name = &object.name;
            match orders.objects.get(&object.id) {
                None => faults.push(format!("{file} does not say that {name} is solid")),
                Some(found) => {
                    let judge = ObjectJudge {
                        wanted: self,
                        words: Words::of(orders.dialect),
                        object,
                    };
                    let own = judge.faults(found).into_iter();
                    faults.extend(own.map(|fault| format!("{file}: {name} {fault}")));
                }
            }
        }
        let has_regions = |object: &ObjectOrders| object.volumes.len() > 1;
        if !orders.moves_volumes && orders.objects.values().any(has_regions) {
            faults.push(format!("{file} leaves the regions of infill at the origin"));
        }
        faults
    }
}

/// The judge of the orders for one object in one dialect. Faults are worded to follow its name.
struct ObjectJudge<'a> {
    wanted: &'a Wanted<'a>,
    words: &'static Words,
    object: &'a PlacedObject,
}

impl ObjectJudge<'_> {
    /// Returns what is wrong with the orders.
    fn faults(&self, orders: &ObjectOrders) -> Vec<String> {
        let mut faults = self.whole_faults(orders);
        if !are_complete(&orders.volumes, self.object.mesh.triangles().len()) {
            faults.push("has volumes that do not share its triangles".to_owned());
            return faults;
        }
        let (body, regions) = match orders.volumes.split_first() {
            Some((body, regions)) => (Some(body), regions),
            None => (None, &[][..]),
        };
        faults.extend(body.and_then(|body| self.body_fault(body)));
        let infill = self.wanted.infill;
        let infill = infill.filter(|(_, id)| *id == self.object.name);
        let levels = infill.map_or_else(Vec::new, |(infill, _)| infill.levels());
        match regions.len() {
            0 if infill.is_none() => {}
            _ if infill.is_none() => {
                faults.push("has regions of infill that the sheet does not".to_owned());
            }
            count if count == levels.len() => {
                let pairs = levels.iter().zip(regions).enumerate();
                let own = pairs.flat_map(|(index, (level, region))| {
                    let mut own = self.region_faults(level, region);
                    own.extend(self.nesting_fault(index, region));
                    own
                });
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

    /// Returns what is wrong with the orders for the object as a whole.
    fn whole_faults(&self, orders: &ObjectOrders) -> Vec<String> {
        let (words, settings) = (self.words, &orders.settings);
        let mut faults = Vec::new();
        let solid = self.percent(settings);
        if !solid.is_some_and(|found| is_same_percent(found, SOLID_PERCENT)) {
            let found = stated(settings, words.density);
            faults.push(format!("has an infill of {found}, not 100%"));
        }
        let layer = settings.get(words.layer).map(|found| found.parse::<f64>());
        if let (Some(wanted), Some(found)) = (self.wanted.printer.layer_mm, layer)
            && found.as_ref() != Ok(&wanted)
        {
            let found = stated(settings, words.layer);
            faults.push(format!("has layers of {found} mm, not {wanted}"));
        }
        faults.extend(self.skins(settings));
        faults
    }

    /// Returns the settings by which an object or a region would have skins.
    fn skins(&self, settings: &Orders) -> Vec<String> {
        let bare = self.words.bare.iter();
        let other = bare.filter(|(key, value)| stated(settings, key) != *value);
        other
            .map(|(key, value)| {
                let found = stated(settings, key);
                format!("has skins that no region cuts ({key} is {found}, not {value})")
            })
            .collect()
    }

    /// Returns what is wrong with the printed volume.
    fn body_fault(&self, body: &VolumeOrders) -> Option<String> {
        let (words, settings) = (self.words, &body.settings);
        let is_printed = settings
            .get(words.kind)
            .is_none_or(|kind| kind == words.printed);
        let has_own = [words.density, words.pattern, words.layer]
            .iter()
            .any(|key| settings.contains_key(*key));
        (!is_printed || has_own).then(|| "has a body with orders of its own".to_owned())
    }

    /// Returns the fault of a region that does not hold over those outside of it.
    fn nesting_fault(&self, index: usize, region: &VolumeOrders) -> Option<String> {
        let found = stated(&region.settings, self.words.order?);
        let wanted = index + 1;
        (found != wanted.to_string())
            .then(|| format!("has regions that do not hold in their order ({found}, not {wanted})"))
    }

    /// Returns a density as the slicer reads it, per cent. Without its sign, it would be a multiple
    /// of solid print to PrusaSlicer.
    fn percent(&self, settings: &Orders) -> Option<f64> {
        let text = settings.get(self.words.density)?;
        text.strip_suffix(self.words.sign)?.parse().ok()
    }

    /// Returns what is wrong with a region of sparse infill.
    fn region_faults(&self, level: &InfillLevel, region: &VolumeOrders) -> Vec<String> {
        let (words, settings) = (self.words, &region.settings);
        let own_pattern = self.wanted.infill;
        let own_pattern = own_pattern.map_or("none", |(infill, _)| &infill.pattern);
        let wanted = level.nominal_ratio * SOLID_PERCENT;
        let scale = self.wanted.printer.print_scale_ratio;
        let scale: f64 = scale.map_or(1.0, |s| s.iter().product());
        let volume_mm3 = -volume_mm3(&self.object.mesh, &region.triangles) / scale;
        let is_own = (volume_mm3 / level.volume_mm3 - 1.0).abs() <= SAME_VOLUME_RATIO;
        let kind = stated(settings, words.kind);
        let [density, pattern] = [words.density, words.pattern].map(|key| stated(settings, key));
        let modifier = words.modifier;
        let faults = [
            (kind != modifier).then(|| format!("has a region that is a {kind}, not a {modifier}")),
            (!self
                .percent(settings)
                .is_some_and(|found| is_same_percent(found, wanted)))
            .then(|| format!("has a region with an infill of {density}, not {wanted}%")),
            (pattern != own_pattern)
                .then(|| format!("has a region filled with {pattern}, not {own_pattern}")),
            (!is_own).then(|| {
                let wanted_mm3 = level.volume_mm3;
                format!("has a region of {volume_mm3:.1} mm³, not {wanted_mm3:.1}")
            }),
        ];
        let faults = faults.into_iter().flatten();
        faults
            .chain(self.walls(settings))
            .chain(self.skins(settings))
            .collect()
    }

    /// Returns the settings by which a region would have walls. In some dialects those of its
    /// object hold if it says nothing.
    fn walls(&self, settings: &Orders) -> Vec<String> {
        let words = self.words;
        let laid = words
            .walls
            .iter()
            .filter(|key| settings.contains_key(**key));
        let mut laid: Vec<&str> = laid.copied().collect();
        let needs_none = !words.bare.is_empty();
        if needs_none && stated(settings, words.perimeters) != NO_WALLS {
            laid.push(words.perimeters);
        }
        let walls = laid.into_iter();
        walls
            .map(|key| format!("has walls around its region ({key})"))
            .collect()
    }
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
