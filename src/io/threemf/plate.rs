//! Reads a plate with its orders, in the words of no slicer.

use std::ops::Range;

use super::blocked::decode_blocked;
use super::decode_objects;
use super::error::ThreeMfError;
use super::orders::{ObjectOrders, Orders, SlicerOrders, VolumeOrders, decode_orders};
use super::place::PlacedObject;
use super::sparse::SparseRegion;
use super::words::Words;
use crate::base::dialect::Dialect;
use crate::geom::Point;
use crate::mesh::{BRIM_MM, GOOD_FOOT_MM2, TriMesh, foot_area_mm2};

/// Degrees of a right angle: Cura takes its angle of overhangs from the vertical.
const RIGHT_DEG: f64 = 90.0;

/// An object of a plate, with what the plate orders for it. All is in the coordinates of the
/// plate, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct PlateObject {
    /// Its name.
    pub name: String,
    /// The surface of what is printed, without the regions.
    pub outside: TriMesh,
    /// Number of lines along a wall.
    pub perimeters: usize,
    /// Angle to the horizontal from which surfaces print without support, degrees; `None` for no
    /// support.
    pub overhang_deg: Option<f64>,
    /// Width of its brim, mm; `None` without one.
    pub brim_mm: Option<f64>,
    /// Its regions of sparse infill, facing outward. Where they overlap, the later one holds.
    pub regions: Vec<SparseRegion>,
    /// The triangles of its surface that get no support, by their places in it.
    pub blocked: Vec<usize>,
}

/// Reads the objects of a plate, each with what the plate orders for it.
///
/// # Errors
/// The bytes are no package, or an object has no orders by which it can be printed.
pub fn decode_plate(bytes: &[u8]) -> Result<Vec<PlateObject>, ThreeMfError> {
    // All dialects of a package say the same.
    let orders = decode_orders(bytes)?.into_iter().next();
    let orders = orders.unwrap_or_default();
    let mut blocked = decode_blocked(bytes)?;
    let objects = decode_objects(bytes)?.into_iter();
    let objects = objects.map(|object| {
        let blocked = blocked.remove(&object.id).unwrap_or_default();
        read_object(object, &orders, blocked)
    });
    objects.collect()
}

/// Puts an object and its orders together.
fn read_object(
    object: PlacedObject,
    orders: &SlicerOrders,
    blocked: Vec<usize>,
) -> Result<PlateObject, ThreeMfError> {
    let reader = Reader {
        words: Words::of(orders.dialect),
        name: &object.name,
    };
    let none = ObjectOrders::default();
    let own = orders.objects.get(&object.id).unwrap_or(&none);
    let perimeters = reader.number(&own.settings, reader.words.perimeters, "")?;
    let (body, regions) = match own.volumes.split_first() {
        Some((body, regions)) => (body.triangles.clone(), regions),
        None => (0..object.mesh.triangles().len(), &[][..]),
    };
    let outside = take(&object.mesh, body);
    let regions = regions
        .iter()
        .map(|region| reader.region(&object.mesh, region));
    Ok(PlateObject {
        perimeters: perimeters as usize,
        overhang_deg: reader.overhang_deg(&own.settings, orders.dialect)?,
        brim_mm: brim_mm(&own.settings, &outside, orders.dialect),
        regions: regions.collect::<Result<_, _>>()?,
        blocked,
        outside,
        name: object.name.clone(),
    })
}

/// Reads the settings of one object.
struct Reader<'a> {
    words: &'static Words,
    name: &'a str,
}

impl Reader<'_> {
    /// Returns a setting.
    fn text<'o>(&self, orders: &'o Orders, key: &'static str) -> Result<&'o str, ThreeMfError> {
        let text = orders.get(key).map(String::as_str);
        text.ok_or_else(|| ThreeMfError::NoOrder {
            object: self.name.to_owned(),
            key,
        })
    }

    /// Returns a setting that is a number with this sign after it.
    fn number(&self, orders: &Orders, key: &'static str, sign: &str) -> Result<f64, ThreeMfError> {
        let text = self.text(orders, key)?;
        let number = text
            .strip_suffix(sign)
            .and_then(|it| it.parse::<f64>().ok());
        let number = number.filter(|it| it.is_finite() && *it >= 0.0);
        number.ok_or_else(|| ThreeMfError::NoOrder {
            object: self.name.to_owned(),
            key,
        })
    }

    /// Returns the angle from which surfaces print without support; `None` for no support.
    fn overhang_deg(&self, orders: &Orders, dialect: Dialect) -> Result<Option<f64>, ThreeMfError> {
        if !matches!(self.text(orders, self.words.support)?, "1" | "true") {
            return Ok(None);
        }
        let angle_deg = self.number(orders, self.words.angle, "")?;
        Ok(Some(match dialect {
            Dialect::Cura => RIGHT_DEG - angle_deg,
            Dialect::Prusa | Dialect::Orca => angle_deg,
        }))
    }

    /// Returns a region of an object's mesh, which bounds it facing inward.
    fn region(&self, mesh: &TriMesh, region: &VolumeOrders) -> Result<SparseRegion, ThreeMfError> {
        let words = self.words;
        if self.text(&region.settings, words.kind)? != words.modifier {
            return Err(ThreeMfError::NoOrder {
                object: self.name.to_owned(),
                key: words.kind,
            });
        }
        Ok(SparseRegion {
            mesh: take(mesh, region.triangles.clone()).reversed(),
            pattern: self.text(&region.settings, words.pattern)?.to_owned(),
            percent: self.number(&region.settings, words.density, words.sign)?,
        })
    }
}

/// Returns the width of the brim, mm. Cura has none for a single object: it is the one that its
/// foot needs.
fn brim_mm(orders: &Orders, outside: &TriMesh, dialect: Dialect) -> Option<f64> {
    match dialect {
        Dialect::Cura => (foot_area_mm2(outside) < GOOD_FOOT_MM2).then_some(BRIM_MM),
        Dialect::Prusa | Dialect::Orca => orders.get("brim_width")?.parse().ok(),
    }
}

/// Returns some triangles of a mesh as a mesh of their own, in their order.
fn take(mesh: &TriMesh, triangles: Range<usize>) -> TriMesh {
    const NONE: u32 = u32::MAX;
    let some = mesh.triangles().get(triangles).unwrap_or_default();
    let mut place = vec![NONE; mesh.vertices().len()];
    let mut vertices: Vec<Point> = Vec::new();
    let mut own = |index: u32| {
        let place = &mut place[index as usize];
        if *place == NONE {
            *place = vertices.len() as u32;
            vertices.push(mesh.vertices()[index as usize]);
        }
        *place
    };
    let triangles: Vec<[u32; 3]> = some.iter().map(|t| t.map(&mut own)).collect();
    // Every corner was just given a place.
    TriMesh::new(vertices, triangles).unwrap_or_default()
}
