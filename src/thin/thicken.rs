//! Thickening of what is thinner than a wall: balls along its middle are united with the model.

use rayon::prelude::*;

use super::medial::{Touch, Touched};
use super::places::{Cubes, Widths};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{NO_HINT, Point};
use crate::mesh::{ClipError, Csg, Defects, Solid, TriMesh, primitives, shells};

/// The distance between balls, in walls. Wider ones leave dips between them that take larger balls
/// to fill; narrower ones take seconds.
const BALL_SPACING_WALLS: f64 = 0.3;
/// The most balls. Each takes about a millisecond to unite.
const MOST_BALLS: usize = 8_000;
/// The spare width of the balls, as a share of the wall: more than counts as thin, which is 2 %.
const SPARE_RATIO: f64 = 0.03;
/// The subdivisions of a ball: 80 triangles. Its faces are raised so that all of the ball is
/// inside.
const BALL_LEVEL: u32 = 1;
/// The number of times that what is left thin is thickened.
const MOST_ROUNDS: usize = 3;
/// A ball beside one that is wider by this factor stands for an edge of the same feature. A smaller
/// factor takes the tips of cones for edges, a greater one thickens edges.
const EDGE_RATIO: f64 = 1.4;
/// The distance within which a ball is beside another, in radii of the wider one. The edge of a
/// square bar is 1.42 radii from its middle.
const BESIDE_RADII: f64 = 2.0;
/// A surface that moved by less than this did not move, mm: rounding of a boolean.
const MOVED_MM: f64 = 1e-9;

/// A model of which everything is as thick as a wall, or nearly.
#[derive(Debug, Clone)]
pub struct Thickened {
    /// The thicker model.
    pub solid: Solid,
    /// The wall, mm.
    pub wall_mm: f64,
    /// The number of balls that were added; zero if nothing was thin.
    pub balls: usize,
    /// The greatest distance by which the surface moved outward, mm.
    pub moved_mm: f64,
    /// The volume that was added, mm³.
    pub added_mm3: f64,
}

/// The reason that a model cannot be thickened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ThickenError {
    /// Too much of the model is thin.
    #[error(
        "more than {thin_mm2:.0} mm² of the model is thinner than {wall_mm} mm, too much to \
         thicken; remedy: make the model larger, or choose a printer with a thinner wall"
    )]
    TooMuch {
        /// Surface of the thin features, mm².
        thin_mm2: f64,
        /// The wall, mm.
        wall_mm: f64,
    },
    /// The balls could not be united with the model.
    #[error("the thin features could not be thickened: {0}")]
    Clip(#[from] ClipError),
    /// The result is not a solid.
    #[error("the thickened model is not a solid: {0}")]
    NotSolid(#[from] Defects),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Thickens what of a model is lost at this wall, and the necks that are too thin to hold a piece.
///
/// Balls as wide as the wall are united with the model along the middle of each such place. The
/// surface moves outward by at most 0.6 walls there, and nowhere else. Thin ends of at most three
/// walls stay as they are, so sharp edges stay sharp. The answer is the same on any number of
/// threads. Takes some seconds.
///
/// # Errors
/// Too much is thin, or the watch was stopped.
pub fn thicken(solid: &Solid, wall_mm: f64, watch: &Watch) -> Result<Thickened, ThickenError> {
    let mut result = solid.clone();
    let mut balls = 0;
    for _ in 0..MOST_ROUNDS {
        let centers = find_centers(&result, wall_mm, watch)?;
        if centers.is_empty() {
            break;
        }
        balls += centers.len();
        result = unite(&result, &centers, wall_mm, watch)?;
    }
    Ok(Thickened {
        wall_mm,
        balls,
        moved_mm: moved_mm(solid, result.mesh(), wall_mm),
        added_mm3: result.mesh().signed_volume_mm3() - solid.mesh().signed_volume_mm3(),
        solid: result,
    })
}

/// Returns points along the middle of what is weak.
fn find_centers(solid: &Solid, wall_mm: f64, watch: &Watch) -> Result<Vec<Point>, ThickenError> {
    let touched = Touched::of(solid.mesh(), wall_mm, watch)?;
    let weak = Widths::of(&touched, wall_mm).weak_points();
    let weak: Vec<Touch> = weak.into_iter().map(|i| touched.points[i]).collect();
    let all: Vec<[Point; 3]> = solid.mesh().iter_corners().collect();
    let mut triangles: Vec<usize> = weak.iter().map(|touch| touch.triangle).collect();
    triangles.dedup();
    let corners: Vec<[Point; 3]> = triangles.into_iter().map(|i| all[i]).collect();
    let spacing = [BALL_SPACING_WALLS * wall_mm, wall_mm];
    let dense = Touched::of_triangles(&corners, solid.bvh(), spacing, watch)?;
    let places = weak.iter().zip(0..).map(|(touch, i)| (i, touch.at));
    let places = Cubes::of(places, touched.spacing_mm);
    let is_weak = |touch: &&Touch| {
        let mut near = places.around(&touch.at, 1);
        let is_near = |i: u32| (weak[i as usize].at - touch.at).norm() <= touched.spacing_mm;
        touch.width_mm < wall_mm && near.any(is_near)
    };
    let found: Vec<Touch> = dense.points.iter().filter(is_weak).copied().collect();
    let middle = drop_edges(found, wall_mm);
    let centers = thin_out(middle, 0.5 * dense.spacing_mm);
    if centers.len() > MOST_BALLS {
        return Err(ThickenError::TooMuch {
            thin_mm2: weak.len() as f64 * touched.spacing_mm.powi(2),
            wall_mm,
        });
    }
    Ok(centers)
}

/// Returns the middles of balls, the widest first, without the small balls along edges.
fn drop_edges(mut balls: Vec<Touch>, wall_mm: f64) -> Vec<Point> {
    balls.sort_by(|a, b| b.width_mm.total_cmp(&a.width_mm));
    let reach_mm = 0.5 * BESIDE_RADII * wall_mm;
    let centers = balls.iter().zip(0..).map(|(ball, i)| (i, ball.center()));
    let cubes = Cubes::of(centers, reach_mm);
    let mut is_kept = vec![false; balls.len()];
    for (i, ball) in balls.iter().enumerate() {
        let center = ball.center();
        let mut near = cubes.around(&center, 1).map(|j| j as usize);
        is_kept[i] = !near.any(|j| {
            let wider = &balls[j];
            let distance_mm = (wider.center() - center).norm();
            is_kept[j]
                && wider.width_mm > EDGE_RATIO * ball.width_mm
                && distance_mm < 0.5 * BESIDE_RADII * wider.width_mm
        });
    }
    let kept = balls.iter().zip(is_kept).filter(|(_, is_kept)| *is_kept);
    kept.map(|(ball, _)| ball.center()).collect()
}

/// Returns the points without those that lie near an earlier one.
fn thin_out(points: Vec<Point>, least_mm: f64) -> Vec<Point> {
    let cell = |p: &Point| [p.x, p.y, p.z].map(|coordinate| (coordinate / least_mm).floor() as i64);
    let mut taken = std::collections::BTreeSet::new();
    points
        .into_iter()
        .filter(|point| taken.insert(cell(point)))
        .collect()
}

/// Unites a model with balls as wide as the wall about these points.
fn unite(
    solid: &Solid,
    centers: &[Point],
    wall_mm: f64,
    watch: &Watch,
) -> Result<Solid, ThickenError> {
    // Between three balls that touch each other's middle the surface is nearest to the middle.
    let dip_mm = BALL_SPACING_WALLS * wall_mm / 3f64.sqrt();
    let radius_mm = (0.5 * (1.0 + SPARE_RATIO) * wall_mm).hypot(dip_mm) / inner_ratio();
    let ball = |center: &Point| Csg::of_mesh(&primitives::ball(center, radius_mm, BALL_LEVEL));
    let mut bodies: Vec<Csg> = centers.par_iter().map(ball).collect::<Result<_, _>>()?;
    while bodies.len() > 1 {
        watch.check()?;
        let united = bodies.par_chunks(2).map(|pair| match pair {
            [one, other] => one.union(other),
            _ => Ok(pair[0].clone()),
        });
        bodies = united.collect::<Result<_, _>>()?;
    }
    let model = Csg::of_solid(solid)?;
    let whole = bodies
        .iter()
        .try_fold(model, |whole, balls| whole.union(balls))?;
    Ok(Solid::new(outside(
        &whole.without_slivers_watched(watch)?.to_mesh()?,
    ))?)
}

/// Returns the surface without the hollows that balls enclose.
fn outside(mesh: &TriMesh) -> TriMesh {
    let outward = shells(mesh)
        .into_iter()
        .filter(|shell| shell.signed_volume_mm3() > 0.0);
    let joined = outward.reduce(|whole, shell| whole.joined(&shell));
    joined.unwrap_or_default()
}

/// Returns the radius of the ball inside the faces of [`primitives::ball`], as a share of its own.
fn inner_ratio() -> f64 {
    let ball = primitives::ball(&Point::origin(), 1.0, BALL_LEVEL);
    let depths = ball.iter_corners().map(|[a, b, c]| {
        let normal = (b - a).cross(&(c - a)).normalize();
        a.coords.dot(&normal)
    });
    depths.fold(1.0, f64::min)
}

/// Returns the greatest distance of the new surface from the old one, mm.
fn moved_mm(before: &Solid, after: &TriMesh, wall_mm: f64) -> f64 {
    let distance = |point: &Point| {
        let nearest = before.bvh().closest(point, 2.0 * wall_mm, &[NO_HINT]);
        nearest.map_or(2.0 * wall_mm, |nearest| (nearest.point - point).norm())
    };
    let moved = after.vertices().par_iter().map(distance);
    let moved = moved.reduce(|| 0.0, f64::max);
    if moved < MOVED_MM { 0.0 } else { moved }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::thin::find_thin;

    fn cuboid(min: [f64; 3], max: [f64; 3]) -> Csg {
        Csg::of_mesh(&primitives::cuboid(&min.into(), &max.into())).unwrap()
    }

    fn solid(shapes: &[Csg]) -> Solid {
        let [first, rest @ ..] = shapes else {
            panic!("no shapes")
        };
        let whole = rest
            .iter()
            .try_fold(first.clone(), |whole, shape| whole.union(shape));
        whole.unwrap().to_solid().unwrap()
    }

    fn block() -> Csg {
        cuboid([-10.0, -10.0, -10.0], [10.0, 10.0, 10.0])
    }

    fn thickened(shapes: &[Csg]) -> Thickened {
        let thick = thicken(&solid(shapes), 1.0, &Watch::silent()).unwrap();
        let found = find_thin(thick.solid.mesh(), 1.0, &Watch::silent()).unwrap();
        assert!(found.lost.is_empty() && found.necks.is_empty(), "{found:?}");
        thick
    }

    #[test]
    fn a_thick_body_stays_as_it_is() {
        let thick = thickened(&[block()]);
        assert_eq!(
            (thick.balls, thick.moved_mm, thick.added_mm3),
            (0, 0.0, 0.0)
        );
    }

    #[test]
    fn a_thin_pin_becomes_as_thick_as_the_wall_and_no_more() {
        let thick = thickened(&[block(), cuboid([-0.3, -0.3, 5.0], [0.3, 0.3, 18.0])]);
        // From half of 0.6 to half of a wall, with the bumps of the balls.
        assert!((0.15..0.6).contains(&thick.moved_mm), "{}", thick.moved_mm);
        // A round bar of one wall in place of 0.36 mm² over 8 mm, at most 1.5 mm² with bumps.
        assert!(
            (3.0..10.0).contains(&thick.added_mm3),
            "{}",
            thick.added_mm3
        );
    }

    #[test]
    fn a_thin_fin_becomes_as_thick_as_the_wall() {
        let thick = thickened(&[block(), cuboid([-8.0, -0.3, 5.0], [8.0, 0.3, 16.0])]);
        assert!((0.15..0.6).contains(&thick.moved_mm), "{}", thick.moved_mm);
        let long = 16.0 * 6.0;
        assert!(
            (0.3 * long..1.2 * long).contains(&thick.added_mm3),
            "{}",
            thick.added_mm3
        );
    }

    #[test]
    fn a_ball_on_a_thin_neck_holds_afterwards() {
        let ball = primitives::ball(&Point::new(0.0, 0.0, 20.0), 5.0, 4);
        let neck = cuboid([-0.4, -0.4, 5.0], [0.4, 0.4, 20.0]);
        let thick = thickened(&[block(), Csg::of_mesh(&ball).unwrap(), neck]);
        assert!(thick.balls > 0);
    }

    #[test]
    fn a_sheet_that_is_thin_all_over_is_refused() {
        let sheet = solid(&[cuboid([0.0, 0.0, 0.0], [80.0, 80.0, 0.2])]);
        let refused = thicken(&sheet, 1.0, &Watch::silent());
        assert!(
            matches!(refused, Err(ThickenError::TooMuch { .. })),
            "{refused:?}"
        );
    }
}
