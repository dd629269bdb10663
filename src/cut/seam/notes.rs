//! The seams of a plan, measured: their length, what is seen of them, and how they lie.

use crate::{
    cut::{
        error::CutError,
        geometry::{
            chart::{Chart, Point2},
            section::{Ring, Section},
        },
        ids::CutId,
        plan::CutPlan,
        request::PlanRequest,
        seam::{
            clear::KeepClear,
            skin::{SeamLie, Stretch},
        },
    },
    geom::{Parting, Plane, Point},
    mesh::TriMesh,
};

/// Radius of the ball about the dearest stretch of a seam, in diagonals: half a face on the shared
/// figures. With less, the next plan crosses the other half; with more, few plans are left.
const SPOT_RATIO: f64 = 0.08;

/// The seam that one cut leaves on the outside.
#[derive(Debug, Clone, PartialEq)]
pub struct SeamNote {
    /// The cut's id.
    pub cut: CutId,
    /// Its length, mm.
    pub length_mm: f64,
    /// What is seen of it, in circles about the model of average weight; `None` if nobody looked.
    pub seen_ratio: Option<f64>,
    /// The price of its slant, in the same unit; 0 if nobody looked.
    pub slant_price: f64,
    /// The lie of the cut in the object's frame; `None` if nobody looked.
    pub lie: Option<SeamLie>,
    /// Heights of its lowest and highest point along up, 0 at the lowest point of the object and 1
    /// at the highest; `None` if nobody looked.
    pub heights: Option<[f64; 2]>,
}

/// Measures the seams of a plan on the outside of its model, in the order of its cuts.
///
/// # Errors
/// A cut of the plan is degenerate, or cuts limit each other in a circle.
pub fn seams(
    outer: &TriMesh,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Vec<SeamNote>, CutError> {
    let partings = plan.partings()?;
    let planes: Vec<Plane> = partings.iter().map(|parting| parting.plane).collect();
    let bridges = plan.bridges(&planes);
    let note = |(index, parting): (usize, &Parting)| {
        let whole = bridges.iter().filter(|bridge| bridge.cut == index);
        let whole: Vec<Point2> = whole.map(|bridge| bridge.at).collect();
        let segments = segments(outer, parting, &whole);
        let skin = request.seams.skin.as_ref();
        let ends = segments.iter().flatten();
        SeamNote {
            cut: plan.cuts[index].id.clone(),
            length_mm: segments.iter().map(|[a, b]| (b - a).norm()).sum(),
            seen_ratio: skin.map(|skin| skin.price_ratio(&parting.plane, segments.iter().copied())),
            slant_price: skin.map_or(0.0, |skin| skin.slant_price(&parting.plane)),
            lie: skin.map(|skin| skin.lie(&parting.plane)),
            heights: skin.map(|skin| {
                let heights = ends.map(|end| skin.height_ratio(end));
                heights.fold([1.0, 0.0], |[low, high]: [f64; 2], h| {
                    [low.min(h), high.max(h)]
                })
            }),
        }
    };
    Ok(partings.iter().enumerate().map(note).collect())
}

/// Returns the ball about the dearest stretch of a plan's seams: a face, if they cross one. `None`
/// if there is no seam, or nobody looked.
///
/// # Errors
/// As for [`seams`].
pub fn dearest_spot(
    outer: &TriMesh,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Option<KeepClear>, CutError> {
    let Some(skin) = request.seams.skin.as_ref() else {
        return Ok(None);
    };
    let partings = plan.partings()?;
    let planes: Vec<Plane> = partings.iter().map(|parting| parting.plane).collect();
    let bridges = plan.bridges(&planes);
    let stretches = partings.iter().enumerate().flat_map(|(index, parting)| {
        let whole = bridges.iter().filter(|bridge| bridge.cut == index);
        let whole: Vec<Point2> = whole.map(|bridge| bridge.at).collect();
        let segments = segments(outer, parting, &whole);
        skin.stretches(&parting.plane, segments.into_iter())
    });
    let stretches: Vec<Stretch> = stretches.collect();
    let radius_mm = SPOT_RATIO * outer.aabb().size().norm();
    let price_about = |at: &Point| -> f64 {
        let near = stretches.iter();
        let near = near.filter(|stretch| (stretch.at - at).norm() < radius_mm);
        near.map(|stretch| stretch.price_mm).sum()
    };
    let priced = stretches
        .iter()
        .map(|stretch| (price_about(&stretch.at), stretch.at));
    let dearest = priced.max_by(|a, b| a.0.total_cmp(&b.0));
    Ok(dearest.map(|(_, at)| KeepClear {
        center_mm: at.into(),
        radius_mm,
    }))
}

/// Returns the segments in which a cut meets the outside. Left out are those beyond its limits, and
/// faces that hold one of the points `whole`.
fn segments(outer: &TriMesh, parting: &Parting, whole: &[Point2]) -> Vec<[Point; 2]> {
    let plane = &parting.plane;
    let (section, chart) = (Section::of_mesh(outer, plane), Chart::of_plane(plane));
    let is_whole = |ring: &Ring| whole.iter().any(|at| ring.holds(at));
    let is_made = |[a, b]: &[Point; 2]| {
        let middle = a + (b - a) * 0.5;
        let mut sides = parting.within.iter();
        sides.all(|(limit, is_above)| (limit.distance(&middle) >= 0.0) == *is_above)
    };
    let cut = section.rings.iter().filter(|ring| !is_whole(ring));
    let segments = cut.flat_map(Ring::segments);
    let segments = segments.map(|ends| ends.map(|end| chart.lift(plane, &end)));
    segments.filter(is_made).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::cut::scenes::{ball, cuboid, plan, plan_by, request, with_balls};
    use crate::cut::seam::clear::ClearBalls;
    use crate::cut::{Cut, CutOrder, PlanRequest, SeamStyle, Seams};
    use crate::geom::Vector;

    fn looked_at(outer: &TriMesh) -> PlanRequest {
        let seams = Seams::look(SeamStyle::Hidden, outer, &Vector::z(), &Watch::silent());
        PlanRequest {
            seams: seams.unwrap(),
            ..request()
        }
    }

    #[test]
    fn the_seam_of_a_level_cut_through_a_box_is_its_outline() {
        let body = with_balls(
            cuboid([0.0; 3], [30.0, 20.0, 20.0]),
            &[[15.0, 10.0, 10.0, 4.0]],
        );
        let cut = Cut {
            id: CutId::of(0),
            point_mm: [0.0, 0.0, 9.0],
            normal: [0.0, 0.0, 1.0],
            within: Vec::new(),
        };
        let order = CutOrder {
            cuts: vec![cut],
            ..CutOrder::default()
        };
        let request = looked_at(body.outer.mesh());
        let plan = plan_by(&body, &request, &order).unwrap();
        let notes = seams(body.outer.mesh(), &plan, &request).unwrap();
        assert!((notes[0].length_mm - 100.0).abs() < 1e-3, "{notes:?}");
        assert_eq!(notes[0].lie, Some(SeamLie::Level));
        let [low, high] = notes[0].heights.unwrap();
        assert!((low - 0.45).abs() < 1e-3 && (high - 0.45).abs() < 1e-3);
    }

    #[test]
    fn the_dearest_spot_lies_on_the_seam_and_keeps_that_cut_away() {
        let body = with_balls(
            cuboid([0.0; 3], [30.0, 20.0, 20.0]),
            &[[15.0, 10.0, 10.0, 4.0]],
        );
        let tilted = Cut {
            id: CutId::of(0),
            point_mm: [15.0, 10.0, 10.0],
            normal: [0.5, 0.0, 1.0],
            within: Vec::new(),
        };
        let order = CutOrder {
            cuts: vec![tilted],
            ..CutOrder::default()
        };
        let outer = body.outer.mesh();
        let looked = looked_at(outer);
        let plan = plan_by(&body, &looked, &order).unwrap();
        let spot = dearest_spot(outer, &plan, &looked).unwrap().unwrap();
        assert!((spot.radius_mm - SPOT_RATIO * outer.aabb().size().norm()).abs() < 1e-9);
        let plane = plan.partings().unwrap()[0].plane;
        assert!(
            plane.distance(&Point::from(spot.center_mm)).abs() < 1e-6,
            "{spot:?}"
        );
        let balls = ClearBalls::new(&[spot], outer, 0.0);
        assert!(balls.entered(&plane).is_some(), "it keeps that cut away");
        assert_eq!(dearest_spot(outer, &plan, &request()), Ok(None));
    }

    #[test]
    fn the_planner_hides_the_seam_of_a_ball_below() {
        let body = with_balls(ball([0.0; 3], 25.0), &[[0.0, 0.0, 0.0, 20.0]]);
        let request = looked_at(body.outer.mesh());
        let plan = plan(&body, &request).unwrap();
        let notes = seams(body.outer.mesh(), &plan, &request).unwrap();
        let [_, high] = notes[0].heights.unwrap();
        assert!(
            high < 0.5 && notes[0].lie == Some(SeamLie::Level),
            "{notes:?}"
        );
    }
}
