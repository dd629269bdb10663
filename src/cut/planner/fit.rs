//! Cuts that make parts fit the printer.

use rayon::prelude::*;

use crate::{
    cut::{
        access::void_access::accesses,
        error::CutError,
        geometry::tree::CutTree,
        ids::CutId,
        pieces::{pose::fits, split::Piece},
        planner::{
            layout::Layout,
            score::{Scene, estimate_seam_penalty},
        },
        remark::Remark,
        seam::regions::KeepWhole,
    },
    geom::{Aabb, Plane, Point, Vector, orthonormal_basis},
    mesh::{TriMesh, move_off_vertices},
};

/// Greatest number of extra cuts that make parts fit the build volume.
const MAX_FITTING_CUTS: usize = 8;

/// Places tried for a cut that makes a part fit, as shares of its length from its middle. Among
/// equals the first is taken.
const MIDDLES: [f64; 7] = [0.0, 0.05, -0.05, 0.1, -0.1, 0.15, -0.15];

/// Places tried to each side of the middle where regions are kept whole, and the farthest of them
/// as a share of the length.
const PLACES: i32 = 16;
const FARTHEST_SHARE: f64 = 0.4;
/// Angle between two directions in which planes are tried there.
const STEP_RAD: f64 = std::f64::consts::PI / 12.0;
/// Steps to half a turn, and to a quarter.
const HALF_TURN: u32 = 12;
const QUARTER_TURN: u32 = 6;
/// Price of a place at the end of a part, in the unit of seams. Among equal seams the one nearest
/// to the middle is taken.
const ASIDE_PRICE: f64 = 0.1;
/// Distance of two parallel planes up to which they are much the same, as a share of the length.
const SAME_SHARE: f64 = 0.06;
/// Number of planes that are tried by cutting, and how many of them at once.
const TRIED: usize = 24;
const TRIED_AT_ONCE: usize = 4;

/// Divides pieces that do not fit the build volume until all fit.
///
/// They are bisected across their longest extent. Where regions are kept whole, planes are tried in
/// more directions and places. If none makes all pieces fit, none is made.
pub(crate) fn fit_build_volume(
    scene: &Scene,
    layout: &mut Layout,
    notes: &mut Vec<Remark>,
) -> Result<(), CutError> {
    if !scene.request.seams.keep_whole.is_empty() {
        return fit_around(scene, layout, notes);
    }
    for _ in 0..MAX_FITTING_CUTS {
        let Some(piece) = first_large(scene, layout) else {
            return Ok(());
        };
        let middle = best_middle(scene, &piece.mesh.aabb());
        *layout = with_cut(scene, layout, &middle)?;
        notes.push(last_cut(layout));
    }
    Ok(())
}

/// Divides pieces as [`fit_build_volume`] does, beside the regions that are kept whole.
fn fit_around(scene: &Scene, layout: &mut Layout, notes: &mut Vec<Remark>) -> Result<(), CutError> {
    let before = (layout.tree.planes.clone(), layout.voids.clone());
    let mut of_cuts = Vec::new();
    for _ in 0..MAX_FITTING_CUTS {
        let Some(piece) = first_large(scene, layout) else {
            notes.extend(of_cuts);
            return Ok(());
        };
        let Some(next) = divide_around(scene, layout, piece)? else {
            break;
        };
        *layout = next;
        of_cuts.push(last_cut(layout));
    }
    if first_large(scene, layout).is_none() {
        notes.extend(of_cuts);
    } else if !of_cuts.is_empty() {
        *layout = Layout::new(scene, before.0, before.1)?;
    }
    Ok(())
}

/// Returns the first piece that does not fit.
fn first_large<'a>(scene: &Scene, layout: &'a Layout) -> Option<&'a Piece> {
    let mut pieces = layout.pieces.iter();
    pieces.find(|piece| !fits(piece, &layout.tree.planes, scene.request))
}

/// Returns the remark on the cut that was made last.
fn last_cut(layout: &Layout) -> Remark {
    Remark::FittingCut(CutId::of(layout.tree.planes.len() - 1))
}

/// Returns the layout with one more cut.
fn with_cut(scene: &Scene, layout: &Layout, plane: &Plane) -> Result<Layout, CutError> {
    let plane = move_off_vertices(&scene.material, plane);
    let planes: Vec<Plane> = layout.tree.planes.iter().copied().chain([plane]).collect();
    let voids = accesses(
        &scene.chambers,
        &CutTree::everywhere(&planes),
        scene.request,
    )?;
    Layout::new(scene, planes, voids)
}

/// Returns the plane across the longest side of a box, near its middle, whose seam costs least. It
/// enters no ball to be kept clear if there is such a plane.
fn best_middle(scene: &Scene, aabb: &Aabb) -> Plane {
    let axis = aabb.size().imax();
    let normal = Vector::ith(axis, 1.0);
    let at = |share: f64| Plane {
        normal,
        offset_mm: aabb.center()[axis] + share * aabb.size()[axis],
    };
    let best = MIDDLES.map(at).into_iter().min_by(|a, b| {
        let is_refused = |plane: &Plane| scene.clear.entered(plane).is_some();
        let penalty = |plane: &Plane| estimate_seam_penalty(scene, plane);
        is_refused(a)
            .cmp(&is_refused(b))
            .then(penalty(a).total_cmp(&penalty(b)))
    });
    best.unwrap_or_else(|| at(0.0))
}

/// The worth of a layout, less is better: parts that do not fit, parts below the least, all parts.
type Worth = [usize; 3];

/// Returns the layout in which a piece is divided beside all regions that are kept whole; `None` if
/// no plane does it.
///
/// Planes are rated by their halves' boxes and by their seams. The best are tried by cutting, until
/// one leaves parts that fit.
fn divide_around(
    scene: &Scene,
    layout: &Layout,
    piece: &Piece,
) -> Result<Option<Layout>, CutError> {
    let mut best: Option<(Worth, Layout)> = None;
    for some in planes_around(scene, layout, piece).chunks(TRIED_AT_ONCE) {
        scene.request.watch.check()?;
        let next = some.par_iter().map(|plane| tried(scene, layout, plane));
        let next = next.collect::<Result<Vec<Option<Layout>>, CutError>>()?;
        for next in next.into_iter().flatten() {
            let Some(worth) =
                worth(scene, &next).filter(|_| next.pieces.len() > layout.pieces.len())
            else {
                continue;
            };
            if best.as_ref().is_none_or(|(known, _)| worth < *known) {
                best = Some((worth, next));
            }
        }
        if best
            .as_ref()
            .is_some_and(|([large, small, _], _)| large + small == 0)
        {
            break;
        }
    }
    Ok(best.map(|(_, layout)| layout))
}

/// Returns the layout with one more cut; `None` if this plane cannot be made, as others may.
fn tried(scene: &Scene, layout: &Layout, plane: &Plane) -> Result<Option<Layout>, CutError> {
    match with_cut(scene, layout, plane) {
        Ok(next) => Ok(Some(next)),
        Err(CutError::Cancelled(stopped)) => Err(stopped.into()),
        Err(_) => Ok(None),
    }
}

/// Returns the worth of a layout; `None` if a cut of it enters a region that is kept whole.
fn worth(scene: &Scene, layout: &Layout) -> Option<Worth> {
    let regions = &scene.request.seams.keep_whole;
    let mut partings = layout.tree.partings();
    let is_whole = partings.all(|parting| {
        let mut regions = regions.iter();
        !regions.any(|region| region.is_entered_within(&parting))
    });
    let pieces = layout.pieces.iter();
    let large = pieces.filter(|piece| !fits(piece, &layout.tree.planes, scene.request));
    is_whole.then(|| {
        [
            large.count(),
            layout.count_small(scene),
            layout.pieces.len(),
        ]
    })
}

/// A plane that may divide a piece.
struct Rated {
    plane: Plane,
    /// The number of halves that do not fit.
    large: usize,
    penalty: f64,
    /// Its distance from a like plane that counts as another, mm.
    apart_mm: f64,
}

/// Returns the planes that divide a piece and enter no region in it, the best first, and no two
/// that are much the same.
fn planes_around(scene: &Scene, layout: &Layout, piece: &Piece) -> Vec<Plane> {
    let Some(room_mm) = scene.request.build_volume_mm else {
        return Vec::new();
    };
    let is_in_piece = |region: &&KeepWhole| {
        let mut caps = piece.caps.iter();
        caps.all(|cap| region.is_above(&layout.tree.planes[cap.cut]) == cap.is_above)
    };
    let regions = scene.request.seams.keep_whole.iter();
    let regions: Vec<&KeepWhole> = regions.filter(is_in_piece).collect();
    let directions = directions(&scene.request.axis.direction);
    let rated = directions.par_iter().flat_map_iter(|normal| {
        let planes = planes_across(&piece.mesh, normal).into_iter();
        let free = planes.filter(|(plane, _)| {
            scene.request.seams.allows_lie(plane)
                && scene.clear.entered(plane).is_none()
                && !regions.iter().any(|region| region.is_entered(plane))
        });
        let rate = |(plane, share): (Plane, f64)| Rated {
            plane,
            large: count_large(&piece.mesh, &plane, room_mm),
            penalty: estimate_seam_penalty(scene, &plane) + ASIDE_PRICE * share.abs(),
            apart_mm: SAME_SHARE * length_mm(&piece.mesh, normal),
        };
        free.map(rate).collect::<Vec<_>>()
    });
    let mut rated: Vec<Rated> = rated.collect();
    rated.sort_by(|a, b| {
        let seams = a.penalty.total_cmp(&b.penalty);
        a.large.cmp(&b.large).then(seams)
    });
    let mut chosen: Vec<Rated> = Vec::new();
    for plane in rated {
        let is_same = |known: &Rated| {
            let is_parallel = (known.plane.normal - plane.plane.normal).norm() < 1e-9;
            let apart_mm = (known.plane.offset_mm - plane.plane.offset_mm).abs();
            is_parallel && apart_mm < plane.apart_mm
        };
        if chosen.len() < TRIED && !chosen.iter().any(is_same) {
            chosen.push(plane);
        }
    }
    chosen.into_iter().map(|rated| rated.plane).collect()
}

/// Returns the normals that are tried: the axes of the upright model, and steps between two.
fn directions(up: &Vector) -> Vec<Vector> {
    let up = up.normalize();
    let (u, v) = orthonormal_basis(&up);
    let between = |a: Vector, b: Vector| {
        let steps = (1..HALF_TURN).filter(|step| *step != QUARTER_TURN);
        steps.map(move |step| {
            let (sin, cos) = (STEP_RAD * f64::from(step)).sin_cos();
            a * cos + b * sin
        })
    };
    let slanted = [(up, u), (up, v), (u, v)].into_iter();
    let slanted = slanted.flat_map(|(a, b)| between(a, b));
    [up, u, v].into_iter().chain(slanted).collect()
}

/// Returns the planes across a direction, each with its distance from the middle as a share.
fn planes_across(mesh: &TriMesh, normal: &Vector) -> Vec<(Plane, f64)> {
    let [low, high] = span_mm(mesh, normal);
    let at = |place: i32| {
        let share = FARTHEST_SHARE * f64::from(place) / f64::from(PLACES);
        let plane = Plane {
            normal: *normal,
            offset_mm: 0.5 * (low + high) + share * (high - low),
        };
        (plane, share)
    };
    (-PLACES..=PLACES).map(at).collect()
}

fn span_mm(mesh: &TriMesh, direction: &Vector) -> [f64; 2] {
    let heights = mesh.vertices().iter().map(|p| direction.dot(&p.coords));
    heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    })
}

fn length_mm(mesh: &TriMesh, direction: &Vector) -> f64 {
    let [low, high] = span_mm(mesh, direction);
    high - low
}

/// Counts the halves of a piece that fit the room in no turn of their box about the cut.
fn count_large(mesh: &TriMesh, plane: &Plane, mut room_mm: [f64; 3]) -> usize {
    room_mm.sort_by(f64::total_cmp);
    let is_small = |points: &[Point]| {
        let boxes = (0..QUARTER_TURN).map(|step| {
            let (sin, cos) = (STEP_RAD * f64::from(step)).sin_cos();
            let turned = points.iter().map(|p| {
                let [x, y] = [cos * p.x - sin * p.y, sin * p.x + cos * p.y];
                Point::new(x, y, p.z)
            });
            turned.fold(Aabb::EMPTY, |aabb, p| aabb.grown_over(&p))
        });
        boxes.into_iter().any(|aabb| {
            let mut size: [f64; 3] = aabb.size().into();
            size.sort_by(f64::total_cmp);
            size.iter().zip(room_mm).all(|(size, room)| *size <= room)
        })
    };
    let halves = halves(mesh, plane);
    halves.iter().filter(|half| !is_small(half)).count()
}

/// Returns the points of both halves, in the coordinates of the plane, with those in the cut.
fn halves(mesh: &TriMesh, plane: &Plane) -> [Vec<Point>; 2] {
    let (u, v) = plane.basis();
    let local = |p: &Point| Point::new(u.dot(&p.coords), v.dot(&p.coords), plane.distance(p));
    let points: Vec<Point> = mesh.vertices().iter().map(local).collect();
    let mut halves = [Vec::new(), Vec::new()];
    for p in &points {
        halves[usize::from(p.z < 0.0)].push(*p);
    }
    for [a, b, c] in mesh.triangles() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let [from, to] = [from, to].map(|at| points[*at as usize]);
            // Every edge has two triangles: one of them is enough.
            if from.z < 0.0 && to.z >= 0.0 {
                let meet = from + (to - from) * (from.z / (from.z - to.z));
                halves.iter_mut().for_each(|half| half.push(meet));
            }
        }
    }
    halves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::scenes::{cuboid, request};
    use crate::cut::{Hollowed, PlanRequest, parts, plan};

    /// Returns a bar of 120 mm and the request for a room of 80 mm, with a region from `from_mm` to
    /// `to_mm` along it.
    fn bar(from_mm: f64, to_mm: f64) -> (Hollowed, PlanRequest) {
        let body = Hollowed::new(cuboid([0.0; 3], [120.0, 30.0, 20.0]), Vec::new());
        let corner = |i: usize| {
            let x = [from_mm, to_mm][i & 1];
            Point::new(x, [5.0, 25.0][i >> 1 & 1], [5.0, 15.0][i >> 2 & 1])
        };
        let mut request = request();
        request.build_volume_mm = Some([80.0, 60.0, 50.0]);
        request.seams.keep_whole = vec![KeepWhole::between((0..8).map(corner).collect())];
        (body, request)
    }

    #[test]
    fn a_bar_is_divided_beside_a_region_in_its_middle() {
        let (body, request) = bar(45.0, 75.0);
        let found = plan(&body, &request)
            .unwrap()
            .or_error::<CutError>()
            .unwrap();
        assert!(!found.cuts.is_empty());
        let region = &request.seams.keep_whole[0];
        for cut in &found.cuts {
            assert!(!region.is_entered(&cut.plane().unwrap()), "{cut:?}");
        }
        let parts = parts(&body, &found, &request).unwrap();
        let parts = parts.or_error::<CutError>().unwrap();
        assert!(parts.len() == 2 && parts.iter().all(|part| part.pose.fits));
        assert!(found.joints.iter().all(|joint| joint.is_aligned()));
    }

    #[test]
    fn a_bar_that_is_one_region_stays_whole() {
        let (body, request) = bar(1.0, 119.0);
        let found = plan(&body, &request)
            .unwrap()
            .or_error::<CutError>()
            .unwrap();
        // Along the bar the halves are as long as it is, and across it the region is in the way.
        assert!(found.cuts.is_empty() && found.notes.is_empty());
        let parts = parts(&body, &found, &request).unwrap();
        let parts = parts.or_error::<CutError>().unwrap();
        assert!(parts.len() == 1 && !parts[0].pose.fits);
    }
}
