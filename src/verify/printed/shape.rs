//! The shape of printed material, and of the parts that it may be: moments and boxes.

use super::limits::{ALIKE_MM, CLEARLY_RATIO, FREE_TURN_MM, MISFIT_MM, PLACE_MM};
use super::turns::{free_turns, right_turns};
use crate::geom::hull::convex_hull;
use crate::geom::{Aabb, Matrix, Point, Vector};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::TriMesh;
use crate::repair::weld;
use crate::verify::sparse::sparse_moments;
use crate::verify::{InfillOrder, PartEvidence, PlateSpot, Pose, Shells};

/// A part or jig of the kit, in the coordinates of its file.
#[derive(Debug, Clone)]
pub(super) struct Thing<'a> {
    /// Its name, such as `P01`.
    pub(super) id: &'a str,
    /// Whether it is a jig.
    pub(super) is_jig: bool,
    /// Model coordinates to print coordinates.
    pose: Pose,
    /// The scale of its file against shrinkage.
    scale_ratio: Vector,
    /// Its box.
    pub(super) aabb: Aabb,
    /// Its convex outline seen from above, mm.
    outline: Vec<[f64; 2]>,
    /// The area of its surface, mm².
    pub(super) area_mm2: f64,
    /// Its moments.
    pub(super) moments: Moments,
    /// The moments of what its slicer was found to lay beyond them, model frame and nominal size.
    beyond: Moments,
    /// Its place on a plate; `None` in kits without plates.
    pub(super) spot: Option<&'a PlateSpot>,
}

/// Printed material, in the coordinates of the plate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    /// Its moments.
    pub(super) moments: Moments,
    /// Its box, with half a line on every side.
    pub(super) aabb: Aabb,
}

/// The way in which printed material lies, if it is to be a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// Coordinates of the file to those of the plate, but for a shift.
    turn: Matrix,
    /// Plate coordinates to the turned coordinates of the file.
    shift: Vector,
    /// Its edges over those of the part, in the axes of the file.
    pub(super) size_ratio: [f64; 3],
    /// The spread of its material over that of the part, in the axes of the file.
    pub(super) spread_ratio: [f64; 3],
    /// The edges of the part, mm.
    pub(super) edges_mm: [f64; 3],
    /// Its volume over that of the part.
    pub(super) volume_ratio: f64,
    /// The difference of boxes, centres and spreads after it is scaled to the part's size, mm.
    pub(super) miss_mm: f64,
    /// Whether it lies elsewhere than the kit says.
    pub(super) is_moved: bool,
    /// Whether it is turned otherwise than the kit says.
    pub(super) is_turned: bool,
    /// Whether it is a mirror image.
    pub(super) is_mirrored: bool,
}

impl Fit {
    /// Returns its scale: the geometric mean along the axes.
    pub(super) fn scale_ratio(&self) -> f64 {
        self.size_ratio.iter().product::<f64>().cbrt()
    }
}

impl<'a> Thing<'a> {
    /// Takes a part or a jig whose mesh has nominal size.
    pub(super) fn new(
        read: &'a PartEvidence,
        is_jig: bool,
        scale_ratio: Option<[f64; 3]>,
        spot: Option<&'a PlateSpot>,
    ) -> Self {
        let scale_ratio = Vector::from(scale_ratio.unwrap_or([1.0; 3]));
        let file = read
            .mesh
            .map_vertices(|p| p.coords.component_mul(&scale_ratio).into());
        Self {
            id: &read.id,
            is_jig,
            pose: read.pose,
            scale_ratio,
            aabb: file.aabb(),
            outline: convex_hull(file.vertices().iter().map(|p| [p.x, p.y]).collect()),
            area_mm2: area_mm2(&file),
            moments: moments_of_mesh(&file),
            beyond: Moments::default(),
            spot,
        }
    }

    /// Returns the thing with sparse infill laid in its cavities. Lines end at their walls and at
    /// the borders of regions as at the outside, so that all count as its surface.
    pub(super) fn with_infill(self, read: &PartEvidence, infill: &InfillOrder) -> Self {
        let to_file = |mesh: &TriMesh| {
            mesh.map_vertices(|p| p.coords.component_mul(&self.scale_ratio).into())
        };
        let shells = Shells::of_mesh(&weld(&to_file(&read.mesh)));
        let inner: Vec<TriMesh> = read.inner.iter().map(to_file).collect();
        Self {
            moments: self.moments + sparse_moments(infill, &shells.inner_mesh(), &inner),
            area_mm2: self.area_mm2 + inner.iter().map(area_mm2).sum::<f64>(),
            beyond: infill.beyond(),
            ..self
        }
    }

    /// Returns how the shape fits: as the kit lays the part, unless another pose or its mirror
    /// image fits far better.
    pub(super) fn fit(&self, shape: &Shape) -> Fit {
        let usual_turn = self.usual_turn();
        let usual = self.fit_turned(shape, &usual_turn);
        let right = right_turns().map(|turn| self.fit_turned(shape, &turn));
        let mut others: Vec<Fit> = right.collect();
        let misses = |fit: &Fit| fit.miss_mm > FREE_TURN_MM;
        if misses(&usual) && others.iter().all(misses) {
            let miss_mm = |turn: &Matrix| self.fit_turned(shape, turn).miss_mm;
            let free = free_turns(&usual_turn, miss_mm).map(|turn| self.fit_turned(shape, &turn));
            others.extend(free);
        }
        let best = |is_mirrored: bool| {
            let those = others.iter().filter(|fit| fit.is_mirrored == is_mirrored);
            let least_mm = those
                .clone()
                .map(|fit| fit.miss_mm)
                .fold(f64::INFINITY, f64::min);
            // A symmetric part fits in several poses: the one nearest to the kit's is meant.
            let alike = those.filter(|fit| fit.miss_mm <= least_mm + ALIKE_MM);
            let near = |fit: &&Fit| (usual.turn.transpose() * fit.turn).trace();
            alike
                .max_by(|a, b| near(a).total_cmp(&near(b)))
                .copied()
                .unwrap_or(usual)
        };
        let is_clear = |other: &Fit, than: &Fit| {
            than.miss_mm > MISFIT_MM && other.miss_mm < CLEARLY_RATIO * than.miss_mm
        };
        let (turned, mirrored) = (best(false), best(true));
        let proper = if is_clear(&turned, &usual) {
            Fit {
                is_turned: true,
                is_moved: true,
                ..turned
            }
        } else {
            usual
        };
        if is_clear(&mirrored, &proper) {
            // The material is where it is: it is carried back as it would be glued.
            Fit {
                turn: usual.turn,
                shift: usual.shift,
                ..mirrored
            }
        } else {
            proper
        }
    }

    /// Returns the turn of the file's coordinates on its plate.
    fn usual_turn(&self) -> Matrix {
        if self.spot.is_some_and(|spot| spot.is_turned) {
            Matrix::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
        } else {
            Matrix::identity()
        }
    }

    fn fit_turned(&self, shape: &Shape, turn: &Matrix) -> Fit {
        let (size, wanted) = (shape.aabb.size(), self.turned_box(turn).size());
        let ratio = size.component_div(&wanted);
        let scale = ratio.product().cbrt();
        let edges_mm: f64 = (size / scale - wanted).abs().sum();
        let spreads = [shape.moments, self.moments.rotated(turn)].map(|m| spread_mm2(&m));
        let of_file = |spread_mm2: Matrix| turn.transpose() * spread_mm2 * turn;
        let spread = spreads.map(|spread_mm2| of_file(spread_mm2).diagonal().map(f64::sqrt));
        // Turned freely, both edges across the layers are in the box of both.
        let squares = turn.component_mul(turn).transpose();
        let (shift, is_moved) = self.shift(shape, turn);
        Fit {
            turn: *turn,
            shift,
            size_ratio: (squares * ratio).into(),
            spread_ratio: spread[0].component_div(&spread[1]).into(),
            edges_mm: self.aabb.size().into(),
            volume_ratio: shape.moments.volume() / self.moments.volume(),
            miss_mm: edges_mm + self.misfit_mm(shape, turn, scale),
            is_moved,
            is_turned: false,
            is_mirrored: turn.determinant() < 0.0,
        }
    }

    /// Returns its box after a turn by right angles, or by any angle about the vertical.
    fn turned_box(&self, turn: &Matrix) -> Aabb {
        let [low, high] = [self.aabb.min, self.aabb.max];
        let corners = [low, high].map(|p| Point::from(turn * p.coords));
        let of_corners = Aabb::of_points(&corners);
        if turn[(2, 2)].abs() < 0.5 {
            return of_corners;
        }
        let outline = self
            .outline
            .iter()
            .flat_map(|&[x, y]| [low.z, high.z].map(|z| Point::from(turn * Vector::new(x, y, z))));
        Aabb::of_points(&outline.collect::<Vec<Point>>())
    }

    /// Returns the difference of centres and spreads, mm, for a shape of so many times the size.
    fn misfit_mm(&self, shape: &Shape, turn: &Matrix, scale: f64) -> f64 {
        let place = |moments: &Moments, aabb: &Aabb| {
            let from = middle(aabb);
            let foot = Vector::new(from.x, from.y, aabb.min.z);
            moments.centroid().coords - foot
        };
        let turned = self.moments.rotated(turn);
        let wanted = place(&turned, &self.turned_box(turn));
        let found = place(&shape.moments, &shape.aabb) / scale;
        let (found_mm2, wanted_mm2) = (
            spread_mm2(&shape.moments) / (scale * scale),
            spread_mm2(&turned),
        );
        let spread_mm = (found_mm2 - wanted_mm2).norm() / (2.0 * wanted_mm2.trace().sqrt());
        (found - wanted).norm().hypot(spread_mm)
    }

    /// Returns the shift of a shape to the turned coordinates of the file, and whether it lies
    /// elsewhere than the kit says. The lowest beads lie on the plate, or on a raft.
    ///
    /// Slicers leave out tips that are thinner than a line. So a part is in its place if one of its
    /// sides, its middle or its centre is there. One that was moved is placed by the median of both
    /// sides and the centre.
    fn shift(&self, shape: &Shape, turn: &Matrix) -> (Vector, bool) {
        let wanted = self.turned_box(turn);
        let low = wanted.min - shape.aabb.min;
        let high = wanted.max - shape.aabb.max;
        let center = self.moments.rotated(turn).centroid() - shape.moments.centroid();
        let by_shape = [0, 1].map(|axis| {
            let mut shifts_mm = [low[axis], center[axis], high[axis]];
            shifts_mm.sort_by(f64::total_cmp);
            shifts_mm
        });
        let promised = self.spot.map(|spot| {
            [0, 1].map(|axis| {
                let place_mm = spot.low_mm[axis] + 0.5 * spot.size_mm[axis];
                middle(&wanted)[axis] - place_mm
            })
        });
        let is_there = |promised: &[f64; 2]| {
            (0..2).all(|axis| {
                let between_mm = 0.5 * (low[axis] + high[axis]);
                let mut all = by_shape[axis].into_iter().chain([between_mm]);
                all.any(|mm| (mm - promised[axis]).abs() <= PLACE_MM)
            })
        };
        let kept = promised.filter(is_there);
        let is_moved = promised.is_some() && kept.is_none();
        let [x, y] = kept.unwrap_or(by_shape.map(|[_, median_mm, _]| median_mm));
        (Vector::new(x, y, low.z), is_moved)
    }

    /// Returns moments of the plate in the model frame and in nominal size.
    pub(super) fn to_model(&self, fit: &Fit, plate: &Moments) -> Moments {
        let file = plate.translated(&fit.shift).rotated(&fit.turn.transpose());
        self.pose.moments_to_model(&self.unscaled(&file))
    }

    /// Returns a point of the plate in the model frame.
    pub(super) fn point_to_model(&self, fit: &Fit, plate: &Point) -> Point {
        let file = fit.turn.transpose() * (plate.coords + fit.shift);
        self.pose
            .to_model(&Point::from(file.component_div(&self.scale_ratio)))
    }

    /// Returns its own moments in the model frame and in nominal size.
    pub(super) fn model_moments(&self) -> Moments {
        self.pose.moments_to_model(&self.unscaled(&self.moments)) + self.beyond
    }

    /// Returns the volume of its surfaces and regions of infill in nominal size, mm³.
    pub(super) fn nominal_volume_mm3(&self) -> f64 {
        self.unscaled(&self.moments).volume()
    }

    /// Takes the scale against shrinkage off moments of the file.
    fn unscaled(&self, file: &Moments) -> Moments {
        let inverse = self.scale_ratio.map(f64::recip);
        let by = inverse.product();
        let second = file.second();
        Moments::from_parts(
            file.volume() * by,
            &(file.first().component_mul(&inverse) * by),
            &Matrix::from_fn(|i, j| second[(i, j)] * inverse[i] * inverse[j] * by),
        )
    }
}

/// Returns the area of a surface, mm².
fn area_mm2(mesh: &TriMesh) -> f64 {
    let areas = mesh
        .iter_corners()
        .map(|[a, b, c]| (b - a).cross(&(c - a)).norm());
    0.5 * areas.sum::<f64>()
}

/// Returns the middle of a box.
pub(super) fn middle(aabb: &Aabb) -> Point {
    nalgebra::center(&aabb.min, &aabb.max)
}

/// Returns the second moments about the centre over the volume, mm².
fn spread_mm2(moments: &Moments) -> Matrix {
    let centered = moments.translated(&-moments.centroid().coords);
    centered.second() / moments.volume()
}
