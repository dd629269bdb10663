//! Further cuts, where the fewest that open every void do not let every void be cleaned.

use rayon::prelude::*;

use super::{
    access::{Opened, VoidAccess, access, accesses},
    error::CutError,
    plan::cut_id,
    score::{Scene, burden},
};
use crate::{
    geom::{Matrix, Plane, Point, Vector, orthonormal_basis},
    mass::{Body, moments_of_mesh},
    mesh::off_vertices,
};

/// Cuts that are made at most so that voids can be seen into. A void that still hides something is winding; cutting on
/// would leave crumbs, and keeping its end solid costs less.
const MAX_SIGHT_CUTS: usize = 3;
/// A further cut must bring at least this share of what is missing, or it is not worth its joint.
const WORTH_RATIO: f64 = 0.1;
/// Where along a direction further cuts are tried: at these shares of the hidden points.
const QUANTILES: [f64; 3] = [0.2, 0.5, 0.8];
/// Of the cuts that are within this share of the best, the least burdensome is taken.
const NEARLY_BEST_RATIO: f64 = 0.05;
/// How many of those are weighed: each costs two passes over the model.
const WEIGHED: usize = 6;

/// Cuts for trial, and how they open the voids.
#[derive(Clone)]
pub(crate) struct Tried {
    pub(crate) planes: Vec<Plane>,
    pub(crate) voids: Vec<VoidAccess>,
    lack_mm2: f64,
}

impl Tried {
    pub(crate) fn new(scene: &Scene, planes: &[Plane]) -> Result<Self, CutError> {
        let planes: Vec<Plane> = planes.iter().map(|plane| off_vertices(&scene.material, plane)).collect();
        let voids = accesses(scene.hollowed, &planes, scene.request)?;
        Ok(Self::of(scene, planes, voids))
    }

    fn of(scene: &Scene, planes: Vec<Plane>, voids: Vec<VoidAccess>) -> Self {
        let lack_mm2 = voids.iter().map(|void| void.lack_mm2(scene.request)).sum();
        Self { planes, voids, lack_mm2 }
    }

    /// Whether every void can be cleaned.
    pub(crate) fn is_clean(&self) -> bool {
        self.voids.iter().all(|void| void.is_clean)
    }

    /// The cleaner of two, the first where they are alike.
    pub(crate) fn or_cleaner(self, other: Self) -> Self {
        if other.lack_mm2 < self.lack_mm2 { other } else { self }
    }

    /// The same cuts and one more; the voids that it does not meet stay as they are.
    fn with(&self, scene: &Scene, plane: Plane) -> Result<Self, CutError> {
        let planes = [&self.planes[..], &[plane]].concat();
        let again = |before: &VoidAccess| {
            let heights =
                scene.hollowed.voids[before.void].mesh().vertices().iter().map(|p| plane.distance(p) > 0.0);
            let above = heights.clone().filter(|&is_above| is_above).count();
            let is_met = above > 0 && above < heights.len();
            if is_met {
                access(scene.hollowed, before.void, &planes, scene.request)
            } else {
                Ok(before.clone())
            }
        };
        let voids = self.voids.iter().map(again).collect::<Result<_, _>>()?;
        Ok(Self::of(scene, planes, voids))
    }
}

/// The cuts with further ones through what stays hidden, until every void can be cleaned or no cut brings much more; each is
/// told in the notes.
pub(crate) fn furthered(scene: &Scene, mut tried: Tried, notes: &mut Vec<String>) -> Result<Tried, CutError> {
    for _ in 0..MAX_SIGHT_CUTS {
        if tried.is_clean() {
            break;
        }
        let Some(next) = one_more(scene, &tried)? else { break };
        if next.lack_mm2 > (1.0 - WORTH_RATIO) * tried.lack_mm2 {
            break;
        }
        notes.push(note(&tried, &next));
        tried = next;
    }
    Ok(tried)
}

/// What a further cut is for.
fn note(before: &Tried, after: &Tried) -> String {
    let changed = before.voids.iter().zip(&after.voids).filter(|(b, a)| a.sight_ratio > b.sight_ratio);
    let percent = |ratio: f64| 100.0 * ratio;
    let told = changed.map(|(b, a)| {
        let (was, is) = (percent(b.sight_ratio), percent(a.sight_ratio));
        format!("void V{}: {was:.0} % of the wall in sight without it, {is:.0} % with it", a.void + 1)
    });
    let told: Vec<String> = told.collect();
    format!("cut {}: so that voids can be cleaned ({})", cut_id(before.planes.len()), told.join("; "))
}

/// The cuts with the one more that lets the void that lacks most be cleaned best.
fn one_more(scene: &Scene, tried: &Tried) -> Result<Option<Tried>, CutError> {
    let lack = |void: &&VoidAccess| void.lack_mm2(scene.request);
    let Some(worst) = tried.voids.iter().max_by(|a, b| lack(a).total_cmp(&lack(b))) else { return Ok(None) };
    let hidden = Opened::new(scene.hollowed, worst.void, &tried.planes, scene.request).hidden()?;
    let planes = through(scene, worst.void, &hidden);
    let more = planes.par_iter().map(|plane| tried.with(scene, off_vertices(&scene.material, plane)));
    let mut more = more.collect::<Result<Vec<Tried>, _>>()?;
    more.sort_by(|a, b| a.lack_mm2.total_cmp(&b.lack_mm2));
    let Some(least_mm2) = more.first().map(|best| best.lack_mm2) else { return Ok(None) };
    let enough_mm2 = least_mm2 + NEARLY_BEST_RATIO * (tried.lack_mm2 - least_mm2);
    let near = more.into_iter().take_while(|next| next.lack_mm2 <= enough_mm2).take(WEIGHED);
    let penalty = |next: &Tried| next.planes.last().map_or(0.0, |plane| burden(scene, plane).penalty(scene));
    let weighed = near.map(|next| (penalty(&next), next));
    Ok(weighed.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, next)| next))
}

/// Planes through hidden points of a void: along the model's axes, the goal's, the void's and those of the points.
fn through(scene: &Scene, void: usize, hidden: &[Point]) -> Vec<Plane> {
    let axis = scene.request.axis.direction.normalize();
    let (u, v) = orthonormal_basis(&axis);
    let mut normals = vec![Vector::x(), Vector::y(), Vector::z(), axis, u, v];
    let own = Body::new(&moments_of_mesh(scene.hollowed.voids[void].mesh()), 1.0).principal().axes;
    normals.extend((0..3).map(|i| own.column(i).into_owned()));
    normals.extend(axes_of(hidden));
    let at = |normal: &Vector| {
        let mut heights: Vec<f64> = hidden.iter().map(|p| normal.dot(&p.coords)).collect();
        heights.sort_by(f64::total_cmp);
        let place = |share: f64| heights.get((share * heights.len() as f64) as usize).copied();
        let normal = *normal;
        QUANTILES.map(place).into_iter().flatten().map(move |offset_mm| Plane { normal, offset_mm })
    };
    normals.iter().flat_map(at).collect::<Vec<_>>()
}

/// The axes along which points are spread most and least.
fn axes_of(points: &[Point]) -> Vec<Vector> {
    let count = points.len().max(1) as f64;
    let middle = points.iter().fold(Vector::zeros(), |sum, p| sum + p.coords) / count;
    let spread = points.iter().fold(Matrix::zeros(), |sum, p| {
        let aside = p.coords - middle;
        sum + aside * aside.transpose()
    });
    let axes = spread.symmetric_eigen().eigenvectors;
    let axes = (0..3).map(|i| axes.column(i).into_owned());
    axes.filter(|axis| (axis.norm() - 1.0).abs() < f64::EPSILON.sqrt()).collect()
}
