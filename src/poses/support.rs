//! The support under the overhangs of a part: its volume, its mass and what it touches.

use super::columns::Columns;
use super::shape::{Shape, Side};
use crate::geom::{Point, Vector};
use crate::mesh::TriMesh;

/// The rule by which a surface needs support, and the way that support is printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SupportRule {
    /// Angle to the horizontal from which a surface prints without support, degrees.
    pub overhang_deg: f64,
    /// Height of a layer, mm. What hangs lower is printed on the plate.
    pub layer_mm: f64,
}

/// Angle by which slicers support steeper surfaces than they are told to, degrees: PrusaSlicer adds
/// it so that surfaces at the very angle count.
const SLICER_DEG: f64 = 1.0;

/// Share of a column of support that is material.
///
/// This and the next two are fitted to PrusaSlicer 2.5 with the settings of the kit's packages.
/// These are lines of 0.45 mm every 2.5 mm, snug, no sheath, and two dense layers on top. In 26
/// poses of 12 parts, the error is 5 % (root mean square).
const FILL_RATIO: f64 = 0.13;
/// Thickness of the dense layers at the upper end of a column, mm.
const END_MM: f64 = 0.51;
/// Thickness of material along the sides of columns, where lines turn, mm.
const SIDE_MM: f64 = 0.23;

/// The support that a pose needs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Support {
    /// Volume of the columns, mm³, with the air in them.
    pub columns_mm3: f64,
    /// Area of their sides, mm².
    pub sides_mm2: f64,
    /// Area that they carry on the outside of the model, seen from below, mm².
    pub outside_mm2: f64,
    /// Area that they carry in open hollows, mm².
    pub hollow_mm2: f64,
    /// Area that they carry on cut faces and pins, mm².
    pub cut_face_mm2: f64,
    /// Area of the first layer of the part, mm².
    pub foot_mm2: f64,
    /// Area of the plate that the part and its support stand on, mm².
    pub bed_mm2: f64,
}

impl Support {
    /// Estimates the support of a part along the lines of a grid. Its error is that of the grid:
    /// about a line along every rim.
    pub fn of(shape: &Shape, columns: &Columns, up: &Vector, rule: &SupportRule) -> Self {
        let steepest = (rule.overhang_deg + SLICER_DEG).to_radians().cos();
        let cell_mm2 = columns.pitch_mm * columns.pitch_mm;
        let mut sum = Self::default();
        let needs = |triangle: u32| -shape.normals[triangle as usize].dot(up) > steepest;
        let mut held: Vec<Vec<[f64; 2]>> = vec![Vec::new(); columns.lines()];
        for (line, held) in held.iter_mut().enumerate() {
            for gap in columns.gaps(line) {
                let Some(above) = gap.above else { continue };
                if gap.below.is_none() && gap.to_mm < rule.layer_mm {
                    sum.foot_mm2 += cell_mm2;
                    sum.bed_mm2 += cell_mm2;
                    continue;
                }
                let length_mm = gap.to_mm - gap.from_mm;
                if !needs(above) || length_mm < rule.layer_mm {
                    continue;
                }
                held.push([gap.from_mm, gap.to_mm]);
                sum.columns_mm3 += cell_mm2 * length_mm;
                sum.bed_mm2 += if gap.below.is_none() { cell_mm2 } else { 0.0 };
                let area_mm2 = match shape.sides[above as usize] {
                    Side::Outside => &mut sum.outside_mm2,
                    Side::Hollow => &mut sum.hollow_mm2,
                    Side::CutFace => &mut sum.cut_face_mm2,
                };
                *area_mm2 += cell_mm2;
            }
        }
        sum.sides_mm2 = columns.pitch_mm * bare_sides_mm(columns, &held);
        sum
    }

    /// Returns the volume of its material, mm³.
    pub fn material_mm3(&self) -> f64 {
        FILL_RATIO * self.columns_mm3 + END_MM * self.contact_mm2() + SIDE_MM * self.sides_mm2
    }

    /// Returns the area that it carries, mm².
    pub fn contact_mm2(&self) -> f64 {
        self.outside_mm2 + self.hollow_mm2 + self.cut_face_mm2
    }
}

/// Returns the length of the columns' sides that no neighbour covers, mm; times the pitch, their
/// area.
fn bare_sides_mm(columns: &Columns, held: &[Vec<[f64; 2]>]) -> f64 {
    let length = |line: &[[f64; 2]]| line.iter().map(|[from, to]| to - from).sum::<f64>();
    let mut bare_mm = 0.0;
    for (line, here) in held.iter().enumerate() {
        for next in columns.next_lines(line) {
            let there = &held[next];
            if here.is_empty() && there.is_empty() {
                continue;
            }
            let both: f64 = here
                .iter()
                .flat_map(|a| {
                    there
                        .iter()
                        .map(move |b| (a[1].min(b[1]) - a[0].max(b[0])).max(0.0))
                })
                .sum();
            bare_mm += length(here) + length(there) - 2.0 * both;
        }
    }
    bare_mm
}

/// Returns for each triangle of a part in print pose whether support touches it. It then looks down
/// too steeply, and it does not lie on the plate.
pub fn find_overhangs(mesh: &TriMesh, rule: &SupportRule) -> Vec<bool> {
    let steepest = rule.overhang_deg.to_radians().cos();
    let floor_mm = mesh.aabb().min.z;
    let touches = |[a, b, c]: [Point; 3]| {
        let normal = (b - a).cross(&(c - a));
        let is_on_plate = [a, b, c].iter().all(|p| p.z - floor_mm < rule.layer_mm);
        -normal.z > steepest * normal.norm() && !is_on_plate
    };
    mesh.iter_corners().map(touches).collect()
}
