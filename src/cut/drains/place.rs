//! The choice among the places for drain holes.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        drains::{
            bore::{OVER_MM, Site, Surfaces},
            hole::DrainHole,
        },
        hollowed::{Hollowed, Void},
        ids::{DrainId, VoidId},
        request::PlanRequest,
    },
    geom::{Point, Vector},
    mesh::spread_points,
    printer::DrainNeed,
};

/// Points on the wall of a void behind which holes are looked for.
const POINTS: usize = 3000;
/// Thicknesses of the wall through which holes are bored, in walls; thicker ones only if no thinner
/// one has a place. Powder clogs in a long hole.
const WALLS: [f64; 3] = [1.6, 3.0, 6.0];
/// Price of a hole that looks up, against one that looks down. The price of a place that is seen as
/// much as the average is 1.
const UPWARD_PRICE: f64 = 0.5;
/// Price of an outside that is as uneven as it may be.
const UNEVEN_PRICE: f64 = 0.5;
/// Price of a wall that is thicker by its least thickness.
const THICK_PRICE: f64 = 0.3;
/// Price of a drain at the top of a void, or a vent at its bottom. It must outdo how much is seen.
const LEVEL_PRICE: f64 = 4.0;
/// Share of a void's height within which a drain is low, and a vent high, enough.
const LEVEL_SLACK: f64 = 0.1;
/// Price of a second hole right beside the first.
const NEAR_PRICE: f64 = 2.0;
/// The same share if the lowest place must drain while the part is printed.
const PRINTED_SLACK: f64 = 0.01;
/// Least distance of two holes, in diameters from middle to middle.
const APART_DIAMETERS: f64 = 3.0;
/// Most holes of a void. With more it is cut.
const MOST_HOLES: usize = 6;

/// Returns the holes of all voids, and the voids that have no place for theirs.
pub(super) fn place(
    hollowed: &Hollowed,
    request: &PlanRequest,
    need: &DrainNeed,
) -> Result<(Vec<DrainHole>, Vec<VoidId>), Cancelled> {
    // A hole through the usual wall; one through a thicker wall is wider in the outside.
    let usual_mm = WALLS[0] * request.wall_mm + 2.0 * OVER_MM;
    let mouth_mm = need.mouth_mm(usual_mm, request.wall_mm);
    let surfaces = Surfaces::new(hollowed, request, mouth_mm);
    let chooser = Chooser {
        surfaces: &surfaces,
        request,
        need,
        up: request.seams.up().unwrap_or(request.axis.direction),
    };
    let (mut holes, mut closed) = (Vec::new(), Vec::new());
    for (index, void) in hollowed.voids.iter().enumerate() {
        request.watch.check()?;
        let known = holes.len();
        match chooser.choose(index, void, &holes)? {
            Some(sites) => holes.extend(sites.into_iter().enumerate().map(|(k, site)| {
                let [from, to] = site.ends;
                let length_mm = (to - from).norm();
                DrainHole {
                    id: DrainId::of(known + k),
                    void: VoidId::of(index),
                    from_mm: from.into(),
                    to_mm: to.into(),
                    diameter_mm: need.diameter_mm,
                    mouth_mm: need.mouth_mm(length_mm, request.wall_mm),
                    plug_gap_mm: need.plug_gap_mm,
                    volume_mm3: 0.0,
                }
            })),
            None => closed.push(VoidId::of(index)),
        }
    }
    Ok((holes, closed))
}

/// A place with its price, whatever the other holes of its void are.
#[derive(Clone, Copy)]
struct Priced {
    site: Site,
    price: f64,
}

/// The height that decides on a hole besides the price of its place.
#[derive(Clone, Copy)]
enum Level {
    /// Nothing.
    Any,
    /// It is low in its void.
    Low,
    /// It is high in its void.
    High,
}

/// The choice of holes.
struct Chooser<'a> {
    surfaces: &'a Surfaces<'a>,
    request: &'a PlanRequest,
    need: &'a DrainNeed,
    up: Vector,
}

impl Chooser<'_> {
    /// Returns the holes of a void; `None` if there are no places for all.
    fn choose(
        &self,
        index: usize,
        void: &Void,
        known: &[DrainHole],
    ) -> Result<Option<Vec<Site>>, Cancelled> {
        let corners: Vec<[Point; 3]> = void.mesh().iter_corners().collect();
        let points: Vec<Point> = spread_points(&corners, POINTS)
            .into_iter()
            .map(|point| point.at)
            .collect();
        for most_walls in WALLS {
            let places = self.places(index, &points, most_walls)?;
            let places: Vec<Priced> = places
                .into_iter()
                .filter(|place| self.is_apart_from_all(&place.site, known))
                .collect();
            if let Some(sites) = self.choose_among(void, &places) {
                return Ok(Some(sites));
            }
        }
        Ok(None)
    }

    /// Returns the places at which a void can be opened, priced.
    fn places(
        &self,
        index: usize,
        points: &[Point],
        most_walls: f64,
    ) -> Result<Vec<Priced>, Cancelled> {
        let places = points.par_iter().map(|point| {
            self.request.watch.check()?;
            let site = self.surfaces.site(index, point, most_walls);
            Ok(site.map(|site| Priced {
                price: self.price(&site),
                site,
            }))
        });
        let places = places.collect::<Result<Vec<Option<Priced>>, Cancelled>>()?;
        Ok(places.into_iter().flatten().collect())
    }

    /// Returns the price of a place: by how much it is seen, and by how well a hole goes there.
    fn price(&self, site: &Site) -> f64 {
        let skin = self.request.seams.skin.as_ref();
        let seen = skin.map_or(1.0, |skin| skin.weight_at(&site.at));
        let upward = 0.5 * (1.0 - site.axis.dot(&self.up));
        let thick = (site.wall_mm / self.request.wall_mm - 1.0).max(0.0);
        seen + UPWARD_PRICE * upward + UNEVEN_PRICE * site.step_ratio + THICK_PRICE * thick
    }

    /// Chooses the holes that a void needs, and more if some of it is out of reach.
    fn choose_among(&self, void: &Void, places: &[Priced]) -> Option<Vec<Site>> {
        let levels = match (self.need.is_liquid, self.need.count) {
            (true, _) => vec![Level::Low, Level::High],
            (false, count) => vec![Level::Any; count],
        };
        let mut chosen: Vec<Site> = Vec::new();
        for level in levels {
            chosen.push(self.cheapest(void, places, &chosen, level)?);
        }
        let reach_mm = self.request.cleaning.reach_mm.unwrap_or(f64::INFINITY);
        while let Some(far) = farthest_beyond(void, &chosen, reach_mm) {
            let is_full = chosen.len() == MOST_HOLES;
            let near = self.nearest(places, &chosen, &far).filter(|_| !is_full)?;
            chosen.push(near);
        }
        Some(chosen)
    }

    /// Returns the cheapest place that is apart from those chosen before.
    fn cheapest(
        &self,
        void: &Void,
        places: &[Priced],
        chosen: &[Site],
        level: Level,
    ) -> Option<Site> {
        let aabb = void.mesh().aabb();
        let size_mm = aabb.size().norm().max(f64::MIN_POSITIVE);
        let (up, slack) = match self.need.printed_up {
            Some(up) => (Vector::from(up), PRINTED_SLACK),
            None => (self.up, LEVEL_SLACK),
        };
        let heights = || void.mesh().vertices().iter().map(|p| up.dot(&p.coords));
        let low_mm = heights().fold(f64::INFINITY, f64::min);
        let high_mm = heights().fold(f64::NEG_INFINITY, f64::max);
        let range_mm = (high_mm - low_mm).max(f64::MIN_POSITIVE);
        let price = |place: &Priced| {
            let height = (up.dot(&place.site.ends[1].coords) - low_mm) / range_mm;
            let off = match level {
                Level::Any => 0.0,
                Level::Low => (height - slack).max(0.0),
                Level::High => (1.0 - LEVEL_SLACK - height).max(0.0),
            };
            let distances = chosen.iter().map(|site| (site.at - place.site.at).norm());
            let near = distances.fold(size_mm, f64::min) / size_mm;
            place.price + LEVEL_PRICE * off + NEAR_PRICE * (1.0 - near)
        };
        let apart = places
            .iter()
            .filter(|place| self.is_apart(&place.site, chosen));
        let cheapest = apart.min_by(|a, b| price(a).total_cmp(&price(b)));
        cheapest.map(|place| place.site)
    }

    /// Returns the place nearest to a point of a void, apart from those chosen before.
    fn nearest(&self, places: &[Priced], chosen: &[Site], to: &Point) -> Option<Site> {
        let distance_mm = |place: &Priced| (place.site.ends[1] - to).norm();
        let apart = places
            .iter()
            .filter(|place| self.is_apart(&place.site, chosen));
        let nearest = apart.min_by(|a, b| distance_mm(a).total_cmp(&distance_mm(b)));
        nearest.map(|place| place.site)
    }

    fn is_apart(&self, site: &Site, chosen: &[Site]) -> bool {
        let mut chosen = chosen.iter();
        chosen.all(|other| (other.at - site.at).norm() >= self.apart_mm())
    }

    fn is_apart_from_all(&self, site: &Site, known: &[DrainHole]) -> bool {
        let mut known = known.iter();
        known.all(|hole| (Point::from(hole.from_mm) - site.at).norm() >= self.apart_mm())
    }

    fn apart_mm(&self) -> f64 {
        APART_DIAMETERS * self.need.diameter_mm
    }
}

/// Returns the point of a void that is farthest from all holes, if it is beyond reach.
fn farthest_beyond(void: &Void, chosen: &[Site], reach_mm: f64) -> Option<Point> {
    let distance_mm = |p: &Point| {
        let distances = chosen.iter().map(|site| (site.ends[1] - p).norm());
        distances.fold(f64::INFINITY, f64::min)
    };
    let farthest = void.mesh().vertices().iter();
    let farthest = farthest.max_by(|a, b| distance_mm(a).total_cmp(&distance_mm(b)))?;
    (distance_mm(farthest) > reach_mm).then_some(*farthest)
}
