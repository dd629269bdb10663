//! Covering: whether a triangle lies on a set of sheets, everywhere and to a tolerance.

use std::ops::ControlFlow;

use crate::geom::triangle::closest_on_triangle;
use crate::geom::{Aabb, Bvh, Point, Vector};

/// Points within this distance of a sheet lie on it, mm. Files in single precision round by 3e-5 at
/// 300 mm. No printer resolves two thousandths.
pub(super) const ON_SHEET_MM: f64 = 2e-3;
/// A triangle this near to one sheet is compared with no other, mm.
const AT_ONCE_MM: f64 = 1e-4;
/// Pieces of a triangle that stick out of a sheet by less are not cut off, mm.
const TRIM_MM: f64 = 1e-4;
/// Pieces of this size are decided by their middles, mm.
const LEAST_PIECE_MM: f64 = 1e-3;
/// Greatest number of pieces into which a triangle is cut; one that needs more counts as bare.
const MAX_PIECES: usize = 200_000;

/// The bodies that a sheet belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Whose {
    /// Of any part.
    Any,
    /// Of the part with this index.
    Only(usize),
    /// Of all parts but the one with this index.
    AllBut(usize),
}

/// An oriented triangle on which surfaces may lie.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet {
    /// Its corners, model frame, mm.
    pub(super) corners: [Point; 3],
    /// The parts that may lie on it.
    pub(super) whose: Whose,
}

/// Sheets, ready to be covered.
pub(super) struct Sheets {
    sheets: Vec<Sheet>,
    /// The unit normal of each; `None` for a sliver.
    normals: Vec<Option<Vector>>,
    tree: Bvh,
}

/// The place of a triangle on the sheets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lie {
    /// It lies on sheets, this one among them.
    On(u32),
    /// A point of it lies on none of them.
    Off(Point),
}

/// A triangle that is looked for.
struct Query<'a> {
    corners: &'a [Point; 3],
    normal: Option<Vector>,
    part: Option<usize>,
}

/// A convex piece of a triangle, with the sheets it may lie on.
struct Piece {
    corners: Vec<Point>,
    near: Vec<u32>,
}

impl Whose {
    /// Returns true if a part may have such a sheet; `None` stands for any part.
    fn allows(self, part: Option<usize>) -> bool {
        match (self, part) {
            (Self::Any, _) | (_, None) => true,
            (Self::Only(owner), Some(part)) => owner == part,
            (Self::AllBut(other), Some(part)) => other != part,
        }
    }
}

impl Sheets {
    /// Makes the sheets ready.
    pub(super) fn new(sheets: Vec<Sheet>) -> Self {
        Self {
            normals: sheets
                .iter()
                .map(|sheet| normal_of(&sheet.corners))
                .collect(),
            tree: Bvh::new(sheets.iter().map(|sheet| sheet.corners)),
            sheets,
        }
    }

    /// Returns the sheet nearest to a point, and its distance, mm.
    pub(super) fn nearest(&self, p: &Point) -> Option<(u32, f64)> {
        let nearest = self.tree.closest(p, f64::INFINITY, &[])?;
        Some((nearest.triangle, nearest.distance_squared.sqrt()))
    }

    /// Returns whether a triangle of a part lies on sheets that face as it does. `None` stands for
    /// any part.
    ///
    /// A triangle near one sheet is decided at once, since the distance from a convex sheet is
    /// convex. Others are cut along the sheets beneath them, until each piece lies on one.
    pub(super) fn lie(&self, corners: &[Point; 3], part: Option<usize>) -> Lie {
        let query = Query {
            normal: normal_of(corners),
            corners,
            part,
        };
        let under_middle = Aabb::of_points(&[middle_of(corners)]).inflated(ON_SHEET_MM);
        if let (Some(sheet), _) = self.find_sheet(&query, &under_middle) {
            return Lie::On(sheet);
        }
        let under_all = Aabb::of_points(corners).inflated(ON_SHEET_MM);
        match self.find_sheet(&query, &under_all) {
            (Some(sheet), _) => Lie::On(sheet),
            (None, near) => self.lie_in_pieces(corners, near),
        }
    }

    /// Returns the sheet under all of a triangle, if there is one, of those that meet a box. With
    /// it, or without it, returns the sheets that were tried.
    fn find_sheet(&self, query: &Query, aabb: &Aabb) -> (Option<u32>, Vec<u32>) {
        let mut near = Vec::new();
        let mut best: Option<(u32, f64)> = None;
        self.tree.visit_overlapping(aabb, |sheet, _| {
            if !self.is_open_to(query, sheet) {
                return ControlFlow::Continue(());
            }
            near.push(sheet);
            let limit_mm = best.map_or(ON_SHEET_MM, |(_, off_mm)| off_mm);
            if let Some(off_mm) = self.find_offset_mm(query.corners, sheet, limit_mm) {
                best = Some((sheet, off_mm));
                if off_mm <= AT_ONCE_MM {
                    return ControlFlow::Break(());
                }
            }
            ControlFlow::Continue(())
        });
        (best.map(|(sheet, _)| sheet), near)
    }

    /// Returns true if a triangle may lie on a sheet: it faces the same way, and is of a part that
    /// may.
    fn is_open_to(&self, query: &Query, sheet: u32) -> bool {
        let faces = match (query.normal, self.normals[sheet as usize]) {
            (Some(own), Some(other)) => own.dot(&other) > 0.0,
            _ => true,
        };
        faces && self.sheets[sheet as usize].whose.allows(query.part)
    }

    /// Returns the greatest distance of some points from a sheet, mm; `None` if it is above a
    /// limit.
    fn find_offset_mm(&self, points: &[Point], sheet: u32, limit_mm: f64) -> Option<f64> {
        let mut worst_mm: f64 = 0.0;
        for p in points {
            worst_mm = worst_mm.max(self.distance_mm(p, sheet));
            if worst_mm > limit_mm {
                return None;
            }
        }
        Some(worst_mm)
    }

    fn distance_mm(&self, p: &Point, sheet: u32) -> f64 {
        let corners = &self.sheets[sheet as usize].corners;
        (closest_on_triangle(p, corners).point - p).norm()
    }

    fn lie_in_pieces(&self, corners: &[Point; 3], near: Vec<u32>) -> Lie {
        let mut on = None;
        let mut pieces = vec![Piece {
            corners: corners.to_vec(),
            near,
        }];
        for _ in 0..MAX_PIECES {
            let Some(piece) = pieces.pop() else {
                break;
            };
            let is_on = |sheet: &&u32| {
                let off_mm = self.find_offset_mm(&piece.corners, **sheet, ON_SHEET_MM);
                off_mm.is_some()
            };
            if let Some(sheet) = piece.near.iter().find(is_on) {
                on.get_or_insert(*sheet);
                continue;
            }
            let middle = middle_of(&piece.corners);
            let distances = piece
                .near
                .iter()
                .map(|&sheet| (sheet, self.distance_mm(&middle, sheet)));
            let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
            let Some((sheet, _)) = nearest.filter(|(_, off_mm)| *off_mm <= ON_SHEET_MM) else {
                return Lie::Off(middle);
            };
            if longest_way(&piece.corners).norm() <= LEAST_PIECE_MM {
                on.get_or_insert(sheet);
                continue;
            }
            pieces.extend(self.divide(&piece, &middle, sheet));
        }
        match (on, pieces.pop()) {
            (_, Some(left)) => Lie::Off(middle_of(&left.corners)),
            (Some(sheet), None) => Lie::On(sheet),
            (None, None) => Lie::Off(corners[0]),
        }
    }

    /// Cuts a piece along the sides of a sheet, or in two if it lies beside it or within it.
    fn divide(&self, piece: &Piece, middle: &Point, sheet: u32) -> Vec<Piece> {
        let parts = self.cut_along(&piece.corners, sheet).unwrap_or_else(|| {
            let across = longest_way(&piece.corners).normalize();
            cut(&piece.corners, |p| across.dot(&(p - middle))).into()
        });
        let with_sheets = |corners: Vec<Point>| {
            let aabb = Aabb::of_points(&corners).inflated(ON_SHEET_MM);
            let is_near = |sheet: &u32| {
                let other = Aabb::of_points(&self.sheets[*sheet as usize].corners);
                (0..3).all(|i| aabb.min[i] <= other.max[i] && other.min[i] <= aabb.max[i])
            };
            Piece {
                near: piece.near.iter().copied().filter(is_near).collect(),
                corners,
            }
        };
        parts.into_iter().map(with_sheets).collect()
    }

    /// Cuts a polygon along the three sides of a sheet. `None` if that cuts nothing off it.
    fn cut_along(&self, corners: &[Point], sheet: u32) -> Option<Vec<Vec<Point>>> {
        let [a, b, c] = self.sheets[sheet as usize].corners;
        // A sliver's own normal may be noise, but any cut is a right one.
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
        let (mut inside, mut parts) = (corners.to_vec(), Vec::new());
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let inward = normal.cross(&(to - from)).try_normalize(0.0)?;
            let height = |p: &Point| inward.dot(&(p - from));
            if inside.iter().all(|p| height(p) >= -TRIM_MM) {
                continue;
            }
            if inside.iter().all(|p| height(p) <= TRIM_MM) {
                return None;
            }
            let [above, below] = cut(&inside, height);
            parts.push(below);
            inside = above;
        }
        (!parts.is_empty()).then(|| {
            parts.push(inside);
            parts
        })
    }
}

/// Returns the unit normal of a triangle; `None` for a sliver, whose normal means nothing.
pub(super) fn normal_of(corners: &[Point; 3]) -> Option<Vector> {
    let [a, b, c] = corners;
    let cross = (b - a).cross(&(c - a));
    let length = cross.norm();
    let longest = longest_way(corners).norm();
    (length > 2.0 * ON_SHEET_MM * longest).then(|| cross / length)
}

/// Returns the mean of the corners.
fn middle_of(corners: &[Point]) -> Point {
    let sum: Vector = corners.iter().map(|p| p.coords).sum();
    Point::from(sum / corners.len() as f64)
}

/// Returns the way between the two corners that are farthest apart.
fn longest_way(corners: &[Point]) -> Vector {
    let ways = corners
        .iter()
        .enumerate()
        .flat_map(|(i, p)| corners[i + 1..].iter().map(move |q| q - p));
    ways.max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))
        .unwrap_or_default()
}

/// Cuts a convex polygon where a linear height is zero, into the part above and the part below.
fn cut(polygon: &[Point], height: impl Fn(&Point) -> f64) -> [Vec<Point>; 2] {
    let (mut above, mut below) = (Vec::new(), Vec::new());
    let next = polygon.iter().cycle().skip(1);
    for (p, q) in polygon.iter().zip(next) {
        let (here, there) = (height(p), height(q));
        if here >= 0.0 {
            above.push(*p);
        }
        if here <= 0.0 {
            below.push(*p);
        }
        if here * there < 0.0 {
            let crossing = p + (q - p) * (here / (here - there));
            above.push(crossing);
            below.push(crossing);
        }
    }
    [above, below]
}
