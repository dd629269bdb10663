//! Mean curvature flow of a surface towards its medial poles.
//!
//! Tagliasacchi, Alhashim, Olson and Zhang, "Mean Curvature Skeletons", CGF 31 (5), 2012. Every
//! round moves the vertices by a sparse solve, collapses short edges, splits wide triangles and
//! fixes what can shrink no further.

use super::poles::Ball;
use super::surface::{Diamond, Surface};
use super::system::System;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Aabb, Point, Vector};

/// Weight of a vertex's own place and of its pole, against 1 for smoothing. The paper has 0.1 and
/// 0.2, and loses the spikes of an armour. With 0.25 and 0.5 every knob of it gets a branch.
const OWN_WEIGHT: f64 = 0.15;
const POLE_WEIGHT: f64 = 0.25;
/// Edges shorter than this share of the box's diagonal collapse. Longer ones cost detail, shorter
/// ones time.
const SHORT_RATIO: f64 = 0.002;
/// A vertex is fixed if two edges shorter than this share of a short one cannot collapse.
const FIXED_RATIO: f64 = 0.1;
/// Least number of such edges.
const FIXED_EDGES: usize = 2;
/// Cosine of the widest angle of a triangle that is not split: 110°.
const WIDE_COSINE: f64 = -0.342_020_143_325_668_7;
/// The largest |cosine| in a cotangent weight: beyond, slivers would rule the flow.
const MOST_COSINE: f64 = 0.999;
/// The flow ends once the area changes by less than this share of the first area.
const AREA_CHANGE: f64 = 1e-4;
/// Rounds at most. Some 20 to 140 are needed; what does not settle in more is as thin as it gets.
const MOST_ROUNDS: usize = 200;
/// Most vertices, over those at the start, up to which triangles are split. The surface shrinks, so
/// more vertices only come where splits and collapses chase each other.
const MOST_GROWTH: f64 = 1.2;
/// Sweeps of collapses in a round at most; the next round goes on.
const MOST_SWEEPS: usize = 8;

/// A surface on its way to its skeleton.
pub(super) struct Flow {
    pub surface: Surface,
    poles: Vec<Ball>,
    is_fixed: Vec<bool>,
    /// The length below which an edge is short, mm.
    short_mm: f64,
    /// Vertices from which on no triangle is split.
    most_vertices: usize,
}

impl Flow {
    /// Begins the flow of a surface whose vertices have these poles.
    pub fn new(surface: Surface, poles: Vec<Ball>) -> Self {
        let count = surface.at.len();
        let diagonal_mm = Aabb::of_points(&surface.at).size().norm();
        Self {
            short_mm: SHORT_RATIO * diagonal_mm,
            most_vertices: (MOST_GROWTH * count as f64) as usize,
            is_fixed: vec![false; count],
            surface,
            poles,
        }
    }

    /// Contracts the surface until its area hardly changes, and returns the rounds it took.
    pub fn run(&mut self, watch: &Watch) -> Result<usize, Cancelled> {
        let first_mm2 = self.surface.area_mm2();
        let mut area_mm2 = first_mm2;
        for round in 1..=MOST_ROUNDS {
            watch.check()?;
            self.contract();
            self.collapse_short();
            self.split_wide();
            self.fix_stuck();
            let before_mm2 = std::mem::replace(&mut area_mm2, self.surface.area_mm2());
            if (before_mm2 - area_mm2).abs() < AREA_CHANGE * first_mm2 {
                return Ok(round);
            }
        }
        Ok(MOST_ROUNDS)
    }

    /// Moves all vertices by one step of the flow.
    fn contract(&mut self) {
        let living: Vec<u32> = self.surface.vertices().collect();
        let origin = self.surface.place(living[0]);
        let mut row_of = vec![u32::MAX; self.surface.at.len()];
        for (row, v) in living.iter().enumerate() {
            row_of[*v as usize] = row as u32;
        }
        let mut system = System::default();
        for &v in &living {
            self.add_row(&mut system, v, &row_of, &origin);
        }
        system.starts.push(system.columns.len() as u32);
        let place = |v: &u32| (self.surface.place(*v) - origin).into();
        let mut places: Vec<[f64; 3]> = living.iter().map(place).collect();
        system.solve(&mut places, OWN_WEIGHT.hypot(POLE_WEIGHT));
        for (v, place) in living.iter().zip(places) {
            self.surface.at[*v as usize] = origin + Vector::from(place);
        }
    }

    /// Adds the row of a vertex: its weights, its own place and its pole.
    fn add_row(&self, system: &mut System, v: u32, row_of: &[u32], origin: &Point) {
        system.starts.push(system.columns.len() as u32);
        let first = system.columns.len();
        system.columns.extend(self.surface.neighbours(v));
        system.weights.resize(system.columns.len(), 0.0);
        for [a, b, c] in self.surface.star(v) {
            for (from, to, across) in [(a, b, c), (b, c, a), (c, a, b)] {
                let other = if from == v {
                    to
                } else if to == v {
                    from
                } else {
                    continue;
                };
                let columns = &system.columns[first..];
                if let Some(entry) = columns.iter().position(|w| *w == other) {
                    system.weights[first + entry] += self.cotangent(across, [from, to]);
                }
            }
        }
        for column in &mut system.columns[first..] {
            *column = row_of[*column as usize];
        }
        let [own, medial] = [OWN_WEIGHT, POLE_WEIGHT].map(|weight| weight * weight);
        let [place, pole] = [self.surface.place(v), self.poles[v as usize].center];
        let target = ((place - origin) * own + (pole - origin) * medial) / (own + medial);
        system.targets.push(target.into());
        system.is_fixed.push(self.is_fixed[v as usize]);
    }

    /// Returns the weight that the angle at a corner gives the edge across it: its cotangent.
    ///
    /// It is not below zero, and not above the cotangent of a sliver.
    fn cotangent(&self, corner: u32, ends: [u32; 2]) -> f64 {
        let at = self.surface.place(corner);
        let [a, b] = ends.map(|end| self.surface.place(end) - at);
        let lengths = a.norm() * b.norm();
        if lengths <= f64::MIN_POSITIVE {
            return 0.0;
        }
        let cosine = (a.dot(&b) / lengths).clamp(0.0, MOST_COSINE);
        cosine / (1.0 - cosine * cosine).sqrt()
    }

    fn collapse_short(&mut self) {
        for _ in 0..MOST_SWEEPS {
            let mut is_done = true;
            for edge in self.surface.edges() {
                let is_short = edge.iter().all(|v| self.surface.is_alive(*v))
                    && self.surface.length_mm(edge) < self.short_mm;
                if is_short
                    && let Some(diamond) = self.surface.diamond(edge)
                    && self.surface.may_collapse(diamond)
                {
                    self.collapse(edge);
                    is_done = false;
                }
            }
            if is_done {
                return;
            }
        }
    }

    /// Makes an edge its middle, with the nearer of both poles. A fixed end stays where it is.
    fn collapse(&mut self, [a, b]: [u32; 2]) {
        let [is_a_fixed, is_b_fixed] = [a, b].map(|v| self.is_fixed[v as usize]);
        let [at_a, at_b] = [a, b].map(|v| self.surface.place(v));
        let at = match (is_a_fixed, is_b_fixed) {
            (true, false) => at_a,
            (false, true) => at_b,
            _ => nalgebra::center(&at_a, &at_b),
        };
        let [pole_a, pole_b] = [a, b].map(|v| self.poles[v as usize]);
        let is_nearer = (pole_b.center - at).norm() < (pole_a.center - at).norm();
        self.poles[a as usize] = if is_nearer { pole_b } else { pole_a };
        self.is_fixed[a as usize] = is_a_fixed || is_b_fixed;
        self.surface.collapse([a, b], at);
    }

    fn split_wide(&mut self) {
        let mut vertices = self.surface.vertices().count();
        for edge in self.surface.edges() {
            let Some(diamond) = self.surface.diamond(edge) else {
                continue;
            };
            if vertices >= self.most_vertices {
                return;
            }
            if self.surface.length_mm(edge) >= self.short_mm
                && diamond.across.iter().all(|v| self.is_wide(*v, edge))
            {
                self.split(diamond);
                vertices += 1;
            }
        }
    }

    /// Returns true if the angle at a corner across an edge is wider than 110°.
    fn is_wide(&self, corner: u32, ends: [u32; 2]) -> bool {
        let at = self.surface.place(corner);
        let [a, b] = ends.map(|end| self.surface.place(end) - at);
        a.dot(&b) < WIDE_COSINE * a.norm() * b.norm()
    }

    /// Splits an edge below the corner with the wider angle; place and pole lie between those of
    /// its ends.
    fn split(&mut self, diamond: Diamond) {
        let [from, to] = diamond.ends.map(|end| self.surface.place(end));
        let along = to - from;
        let cosine = |v: &u32| {
            let at = self.surface.place(*v);
            (from - at).normalize().dot(&(to - at).normalize())
        };
        let [c, d] = diamond.across;
        let wide = if cosine(&c) < cosine(&d) { c } else { d };
        let share = (self.surface.place(wide) - from).dot(&along) / along.norm_squared();
        let [pole, other] = diamond.ends.map(|end| self.poles[end as usize]);
        self.surface.split(diamond, from + along * share);
        self.is_fixed.push(false);
        self.poles.push(Ball {
            center: pole.center + (other.center - pole.center) * share,
            radius_mm: pole.radius_mm + (other.radius_mm - pole.radius_mm) * share,
        });
    }

    /// Fixes the vertices with edges that are next to nothing and cannot collapse.
    fn fix_stuck(&mut self) {
        let living: Vec<u32> = self.surface.vertices().collect();
        for v in living {
            if self.is_fixed[v as usize] {
                continue;
            }
            let stuck = self.surface.neighbours(v).filter(|w| {
                let edge = [v, *w];
                self.surface.length_mm(edge) < FIXED_RATIO * self.short_mm
                    && !self
                        .surface
                        .diamond(edge)
                        .is_some_and(|diamond| self.surface.may_collapse(diamond))
            });
            let is_stuck = stuck.take(FIXED_EDGES).count() >= FIXED_EDGES;
            self.is_fixed[v as usize] = is_stuck;
        }
    }
}
